// The clock: counter 0 of the interval timer, which counts 65,536 ticks of 1/1193182 s between two timer interrupts, and
// the BIOS's count of those interrupts. No interrupt is taken and the interrupts keep their rate, so that the time of
// day goes on as ever.
//
// Most BIOSes leave the counter in mode 3, where it counts down by two, twice over. Mode 2 counts down by one: the only
// thing changed here, at a moment right after an interrupt, so that not even a part of a tick is lost.
#include "machine.h"
#include "pc.h"
#include "rt.h"

namespace {

constexpr uint16_t COUNTER = 0x40;
constexpr uint16_t COMMAND = 0x43;
constexpr uint8_t LATCH = 0x00;
constexpr uint8_t MODE_2 = 0x34;  // counter 0, both bytes
constexpr uint8_t MODE_3 = 0x36;
constexpr uint8_t READ_STATUS = 0xe2;  // of counter 0: the next byte read from it holds the mode in bits 1 to 3
constexpr uint16_t PIC = 0x20;
constexpr uint8_t READ_REQUESTS = 0x0a;  // OCW3: the next read gives the requests not yet served
constexpr uint8_t TIMER_REQUEST = 0x01;

constexpr uint32_t BIOS_TICKS = 0x46c;        // interrupts since midnight
constexpr uint32_t TICKS_A_DAY = 0x1800b0;    // the count begins again here

bool open = false;
bool changed;         // the mode was not 2 and is to be put back
uint32_t lastTicks;   // of the BIOS, at the last look
uint32_t daysTicks;   // of the days gone by
uint64_t origin;
uint64_t last;

uint32_t readCounter()
{
    pc::outPort(COMMAND, LATCH);
    const uint32_t low = pc::inPort(COUNTER);
    return low | uint32_t(pc::inPort(COUNTER)) << 8;
}

void setMode(uint8_t mode)
{
    // A divisor of 0 counts as 65,536.
    pc::outPort(COMMAND, mode);
    pc::outPort(COUNTER, 0);
    pc::outPort(COUNTER, 0);
}

// Returns right after a timer interrupt; gives up after some time on a machine where none come.
void awaitTick()
{
    const uint32_t ticks = pc::peek32(BIOS_TICKS);
    uint32_t before = readCounter();
    for (int wraps = 0; wraps < 8 && pc::peek32(BIOS_TICKS) == ticks;) {
        const uint32_t now = readCounter();
        if (now > before)
            ++wraps;
        before = now;
    }
}

// Timer ticks since some midnight. (Counter and BIOS do not change at the same instant: between the two stands an
// interrupt that has been requested and not yet served.)
uint64_t readClock()
{
    uint32_t ticks;
    uint32_t count;
    uint8_t requests;
    uint32_t again = pc::peek32(BIOS_TICKS);
    do {
        ticks = again;
        count = readCounter();
        pc::outPort(PIC, READ_REQUESTS);
        requests = pc::inPort(PIC);
        again = pc::peek32(BIOS_TICKS);
    } while (again != ticks);
    if (ticks < lastTicks)
        daysTicks += TICKS_A_DAY;
    lastTicks = ticks;
    const uint32_t phase = (0x10000 - count) & 0xffff;
    uint64_t now = uint64_t(ticks + daysTicks) << 16 | phase;
    if ((requests & TIMER_REQUEST) != 0 && phase < 0x8000)
        now += 0x10000;
    return now;
}

}  // namespace

namespace pc {

void openClock()
{
    outPort(COMMAND, READ_STATUS);
    changed = (inPort(COUNTER) >> 1 & 3) != 2;
    if (changed) {
        awaitTick();
        setMode(MODE_2);
    }
    lastTicks = 0;
    daysTicks = 0;
    last = 0;
    // The counter takes the new divisor with its next input pulse; the first reading must not come before.
    readCounter();
    origin = readClock();
    open = true;
}

void closeClock()
{
    if (!open)
        return;
    open = false;
    if (changed) {
        awaitTick();
        setMode(MODE_3);
    }
}

}  // namespace pc

namespace machine {

uint64_t clock()
{
    if (open) {
        const uint64_t now = readClock() - origin;
        // Never back, whatever the hardware (or an emulation of it) says; a negative difference is a huge one.
        if (int64_t(now - last) > 0)
            last = now;
    }
    return last;
}

void standStill(bool) {}

void date(char* to, int size)
{
    dpmi::RealRegs day = pc::regs(0x2a00);
    dpmi::RealRegs hour = pc::regs(0x2c00);
    if (!dpmi::realInterrupt(0x21, &day) || !dpmi::realInterrupt(0x21, &hour)) {
        to[0] = '\0';
        return;
    }
    snprintf(to, size_t(size), "%04u-%02u-%02u %02u:%02u:%02u", unsigned(day.ecx & 0xffff), unsigned(day.edx >> 8 & 0xff),
             unsigned(day.edx & 0xff), unsigned(hour.ecx >> 8 & 0xff), unsigned(hour.ecx & 0xff),
             unsigned(hour.edx >> 8 & 0xff));
}

void describe(char* to, int size)
{
    dpmi::RealRegs dos = pc::regs(0x3000);
    if (!dpmi::realInterrupt(0x21, &dos))
        dos.eax = 0;
    snprintf(to, size_t(size), "DOS %u.%02u 80%d86", unsigned(dos.eax & 0xff), unsigned(dos.eax >> 8 & 0xff),
             dpmi::processor());
}

}  // namespace machine
