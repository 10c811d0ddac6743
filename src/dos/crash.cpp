// Processor exceptions: a wild pointer or a division by zero ends in text mode, with everything put back, a line that
// says what happened and where, and exit status 1. asm/start/trap.S catches them and stores the registers.
#include "machine.h"
#include "pc.h"
#include "rt.h"

#ifndef FB_RT
#include <sys/exceptn.h>
#endif

extern "C" {

// The registers at the exception, in the order that trap.S knows.
struct TrapState {
    uint32_t number, error, eip, cs, eflags, esp, ss;
    uint32_t eax, ebx, ecx, edx, esi, edi, ebp, ds, es;
};
TrapState trapState;
uint16_t trapData;  // the program's ds, for entries that come with any other

constexpr uint32_t TRAP_STACK_BYTES = 8192;
__attribute__((aligned(16))) uint8_t trapStack[TRAP_STACK_BYTES];

extern const uint8_t trapEntries[];  // 8 bytes each
[[noreturn]] void crashed();

}  // extern "C"

namespace {

constexpr int TRAPS = 15;
constexpr uint32_t ENTRY_BYTES = 8;

// Not taken: 1 (debuggers), 2 (NMI), 8 and 9 (never a program's own doing), 15 (reserved).
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
    // DJGPP's libc has taken the exceptions, int 75h, and the keyboard, from which it makes a Ctrl-C an exception. All of
    // it is put away until closeTraps(): here Ctrl-C is a key like others.
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

// Reached from trap.S, with the program's segments and a fresh stack.
void crashed()
{
    if (crashing)
        exit(1);
    crashing = true;
    machine::stop();
    const TrapState& s = trapState;
    char text[160];
    // Exceptions 10 to 14 come with a code, which mostly is the selector that was wrong.
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
