// Ctrl-C, Ctrl-Break and the critical errors of DOS. DOS and the BIOS call real-mode vectors for these at any time. A few
// bytes of real-mode code in DOS memory handle them: a break sets a flag that broken() reads; a critical error (for
// example no disk in the drive) makes the DOS call fail that caused it.
#include "pc.h"

namespace {

constexpr int BIOS_BREAK = 0x1b;
constexpr int DOS_BREAK = 0x23;
constexpr int CRITICAL_ERROR = 0x24;

// Bit 7 of this byte in the BIOS data area is a trace of a break. Another may be a Ctrl-C in the keyboard buffer.
constexpr uint32_t BIOS_BREAK_FLAG = 0x471;

// Offsets in the block in DOS memory: the flag, then the two handlers.
constexpr uint16_t FLAG = 0;
constexpr uint16_t ON_BREAK = 1;
constexpr uint16_t ON_ERROR = 8;
constexpr uint8_t realModeCode[] = {
    0x00,                                // flag
    0x2e, 0xc6, 0x06, 0x00, 0x00, 0x01,  // movb $1, %cs:flag
    0xcf,                                // iret: the interrupted code goes on
    0xb0, 0x03,                          // movb $3, %al: make the DOS call fail
    0xcf,                                // iret
};
constexpr uint16_t PARAGRAPHS = 1;
static_assert(sizeof realModeCode <= PARAGRAPHS * 16, "the code fits its block");

bool open = false;
bool seen = false;
uint16_t segment;
uint16_t selector;
dpmi::RealAddress oldBiosBreak;
dpmi::RealAddress oldDosBreak;
dpmi::RealAddress oldCriticalError;
uint8_t oldChecking;

// int 21h, AH=33h: whether DOS checks for Ctrl-C in every call. This is off while the program runs.
uint8_t breakChecking()
{
    dpmi::RealRegs r = pc::regs(0x3300);
    dpmi::realInterrupt(0x21, &r);
    return uint8_t(r.edx);
}
void setBreakChecking(uint8_t on)
{
    dpmi::RealRegs r = pc::regs(0x3301);
    r.edx = on;
    dpmi::realInterrupt(0x21, &r);
}

}  // namespace

namespace pc {

const char* openBreak()
{
    if (!dpmi::allocateDos(PARAGRAPHS, &segment, &selector))
        return "out of DOS memory";
    copyToLow(uint32_t(segment) << 4, realModeCode, sizeof realModeCode);
    oldBiosBreak = dpmi::realVector(BIOS_BREAK);
    oldDosBreak = dpmi::realVector(DOS_BREAK);
    oldCriticalError = dpmi::realVector(CRITICAL_ERROR);
    dpmi::setRealVector(BIOS_BREAK, {segment, ON_BREAK});
    dpmi::setRealVector(DOS_BREAK, {segment, ON_BREAK});
    dpmi::setRealVector(CRITICAL_ERROR, {segment, ON_ERROR});
    oldChecking = breakChecking();
    setBreakChecking(0);
    seen = false;
    open = true;
    return nullptr;
}

void closeBreak()
{
    if (!open)
        return;
    // The program has handled this break already. Its traces would make DOS break the program a second time in the next
    // DOS call (FreeDOS checks the flag of the BIOS), so they are removed.
    if (breakSeen())
        poke16(KEYS_HEAD, peek16(KEYS_TAIL));
    poke8(BIOS_BREAK_FLAG, uint8_t(peek8(BIOS_BREAK_FLAG) & 0x7f));
    open = false;
    setBreakChecking(oldChecking);
    dpmi::setRealVector(CRITICAL_ERROR, oldCriticalError);
    dpmi::setRealVector(DOS_BREAK, oldDosBreak);
    dpmi::setRealVector(BIOS_BREAK, oldBiosBreak);
    dpmi::freeDos(selector);
}

bool breakSeen()
{
    if (open && peek8((uint32_t(segment) << 4) + FLAG) != 0)
        seen = true;
    return seen;
}

void noteBreak()
{
    seen = true;
}

}  // namespace pc
