// The clock combines counter 0 of the interval timer, which counts 65,536 ticks of 1/1193182 s between two timer
// interrupts, with the BIOS's count of these interrupts. The timer interrupt is not taken over and keeps its rate, so
// that the time of day stays right.
//
// Most BIOSes leave the counter in mode 3, in which it counts down by two, twice per interrupt. Mode 2 counts down by one.
// The mode is the only thing changed here, right after an interrupt, so that not even a part of a tick is lost.
#include "machine.h"
#include "pc.h"
#include "rt.h"

namespace {

constexpr uint16_t COUNTER = 0x40;
constexpr uint16_t COMMAND = 0x43;
constexpr uint8_t LATCH = 0x00;
constexpr uint8_t MODE_2 = 0x34;  // both modes: for counter 0, low byte then high byte
constexpr uint8_t MODE_3 = 0x36;
constexpr uint8_t READ_STATUS = 0xe2;  // the next byte read from counter 0 has its mode in bits 1 to 3
constexpr uint16_t PIC = 0x20;
constexpr uint8_t READ_REQUESTS = 0x0a;  // OCW3: the next read returns the interrupt requests not yet served
constexpr uint8_t TIMER_REQUEST = 0x01;

constexpr uint32_t BIOS_TICKS = 0x46c;        // address of the number of timer interrupts since midnight
constexpr uint32_t TICKS_A_DAY = 0x1800b0;    // at this number the count returns to 0

bool open = false;
bool changed;         // the mode was not 2 and must be restored
uint32_t lastTicks;   // tick count of the BIOS at the last reading
uint32_t daysTicks;   // ticks of the days before this one
uint64_t origin;      // readClock() at the start
uint64_t last;        // last result of machine::clock()

uint32_t readCounter()
{
    pc::outPort(COMMAND, LATCH);
    const uint32_t low = pc::inPort(COUNTER);
    return low | uint32_t(pc::inPort(COUNTER)) << 8;
}

void setMode(uint8_t mode)
{
    // A divisor of 0 means 65,536.
    pc::outPort(COMMAND, mode);
    pc::outPort(COUNTER, 0);
    pc::outPort(COUNTER, 0);
}

// Returns right after a timer interrupt. Gives up after eight wraps of the counter when no interrupt comes.
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

// Returns timer ticks since the midnight before the start. The counter wraps around a little before the BIOS counts: in
// between, the interrupt has been requested but not served. The request register of the PIC shows this case.
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
    // The counter loads the new divisor at its next input pulse; this reading makes sure that the pulse has passed.
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
        // The clock must never go back, whatever the hardware or its emulation returns. The difference is compared with a
        // sign, so that a step back is negative.
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
