// Processor exceptions: after a wild pointer or a division by zero the program restores the machine, prints in text mode
// what happened and where, and ends with exit status 1. asm/start/trap.S catches the exception and stores the registers.
#include "machine.h"
#include "pc.h"
#include "rt.h"

#ifndef FB_RT
#include <sys/exceptn.h>
#endif

extern "C" {

// The registers at the exception; trap.S knows their offsets.
struct TrapState {
    uint32_t number, error, eip, cs, eflags, esp, ss;
    uint32_t eax, ebx, ecx, edx, esi, edi, ebp, ds, es;
};
TrapState trapState;
uint16_t trapData;  // the program's ds, because ds may have any value at an exception

constexpr uint32_t TRAP_STACK_BYTES = 8192;
__attribute__((aligned(16))) uint8_t trapStack[TRAP_STACK_BYTES];

extern const uint8_t trapEntries[];  // entry points, ENTRY_BYTES each
[[noreturn]] void crashed();

}  // extern "C"

namespace {

constexpr int TRAPS = 15;
constexpr uint32_t ENTRY_BYTES = 8;

// Bit i is set when exception i is handled. Not handled: 1 (debuggers), 2 (NMI), 8 and 9 (no program causes these), 15
// (reserved; not even in the range of TRAPS).
constexpr uint32_t TAKEN = 0x7cf9;

bool open = false;
bool crashing = false;
dpmi::FarAddress old[TRAPS];
bool taken[TRAPS];

const char* nameOf(uint32_t number)
{
    switch (number) {
        case 0:
            return "division by zero";
        case 3:
            return "breakpoint";
        case 4:
            return "overflow";
        case 5:
            return "bounds";
        case 6:
            return "invalid instruction";
        case 7:
            return "no coprocessor";
        case 10:
            return "invalid task";
        case 11:
            return "segment not present";
        case 12:
            return "stack";
        case 13:
            return "general protection";
        case 14:
            return "page";
        default:
            return "unknown";
    }
}

}  // namespace

namespace pc {

void openTraps()
{
#ifndef FB_RT
    // DJGPP's libc has hooked the exceptions, int 75h and the keyboard, where it turns Ctrl-C into an exception. All these
    // hooks are removed until closeTraps(): here Ctrl-C is an ordinary key.
    __djgpp_exception_toggle();
#endif
    trapData = dpmi::dataSelector();
    const uint16_t code = dpmi::codeSelector();
    for (int i = 0; i < TRAPS; ++i)
        taken[i] = (TAKEN >> i & 1) != 0 && dpmi::exceptionHandler(i, &old[i]) &&
                   dpmi::setExceptionHandler(i, {uint32_t(uintptr_t(trapEntries)) + uint32_t(i) * ENTRY_BYTES, code});
    open = true;
}

void closeTraps()
{
    if (!open)
        return;
    open = false;
    for (int i = 0; i < TRAPS; ++i)
        if (taken[i])
            dpmi::setExceptionHandler(i, old[i]);
#ifndef FB_RT
    __djgpp_exception_toggle();
#endif
}

}  // namespace pc

// trap.S goes on here, with the program's segments and a fresh stack.
void crashed()
{
    if (crashing)
        exit(1);
    crashing = true;
    machine::stop();
    const TrapState& s = trapState;
    char text[160];
    // Exceptions 10 to 14 have an error code, which in most cases is the wrong selector.
    char code[16] = "";
    if (s.number >= 10)
        snprintf(code, sizeof code, ", code %04x", unsigned(s.error & 0xffff));
    snprintf(text, sizeof text, "DEMO: exception %02xh (%s) at %04x:%08x%s\n", unsigned(s.number), nameOf(s.number),
             unsigned(s.cs & 0xffff), unsigned(s.eip), code);
    machine::err(text);
    snprintf(text, sizeof text, "eax=%08x ebx=%08x ecx=%08x edx=%08x esi=%08x edi=%08x\n", unsigned(s.eax),
             unsigned(s.ebx), unsigned(s.ecx), unsigned(s.edx), unsigned(s.esi), unsigned(s.edi));
    machine::err(text);
    snprintf(text, sizeof text, "ebp=%08x esp=%04x:%08x ds=%04x es=%04x eflags=%08x\n", unsigned(s.ebp),
             unsigned(s.ss & 0xffff), unsigned(s.esp), unsigned(s.ds & 0xffff), unsigned(s.es & 0xffff),
             unsigned(s.eflags));
    machine::err(text);
    exit(1);
}
