// What the files of src/dos share: the first megabyte, the transfer buffer, ports, and each other's start and end.
// Nothing outside src/dos includes this.
#ifndef FB_PC_H
#define FB_PC_H

#include <stddef.h>
#include <stdint.h>

#include "dpmi.h"

namespace pc {

// A selector for the first megabyte and the 64 KB above it, from linear address 0. Made at the first call.
uint16_t lowMemory();

inline uint8_t peek8(uint32_t at)
{
    uint8_t value;
    __asm__ volatile("movw %w1, %%fs\n\tmovb %%fs:(%2), %0" : "=q"(value) : "r"(uint32_t(lowMemory())), "r"(at) : "memory");
    return value;
}
inline uint16_t peek16(uint32_t at)
{
    uint16_t value;
    __asm__ volatile("movw %w1, %%fs\n\tmovw %%fs:(%2), %0" : "=r"(value) : "r"(uint32_t(lowMemory())), "r"(at) : "memory");
    return value;
}
inline uint32_t peek32(uint32_t at)
{
    uint32_t value;
    __asm__ volatile("movw %w1, %%fs\n\tmovl %%fs:(%2), %0" : "=r"(value) : "r"(uint32_t(lowMemory())), "r"(at) : "memory");
    return value;
}
inline void poke8(uint32_t at, uint8_t value)
{
    __asm__ volatile("movw %w0, %%fs\n\tmovb %1, %%fs:(%2)" : : "r"(uint32_t(lowMemory())), "q"(value), "r"(at) : "memory");
}
inline void poke16(uint32_t at, uint16_t value)
{
    __asm__ volatile("movw %w0, %%fs\n\tmovw %1, %%fs:(%2)" : : "r"(uint32_t(lowMemory())), "r"(value), "r"(at) : "memory");
}
void copyToLow(uint32_t to, const void* from, uint32_t bytes);
void copyFromLow(void* to, uint32_t from, uint32_t bytes);

inline uint8_t inPort(uint16_t port)
{
    uint8_t value;
    __asm__ volatile("inb %1, %0" : "=a"(value) : "Nd"(port));
    return value;
}
inline void outPort(uint16_t port, uint8_t value)
{
    __asm__ volatile("outb %0, %1" : : "a"(value), "Nd"(port));
}

// The buffer in DOS memory through which names and bytes go to DOS and back: at offset 0 of a segment.
struct Transfer {
    uint16_t segment;
    uint32_t bytes;  // 4 KB at least, below 64 KB
};
Transfer transfer();

// Empty registers for dpmi::realInterrupt().
inline dpmi::RealRegs regs(uint32_t eax)
{
    dpmi::RealRegs r = {0, 0, 0, 0, 0, 0, 0, eax, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    return r;
}
// The carry flag of a real-mode call's results.
inline bool carry(const dpmi::RealRegs& r)
{
    return (r.flags & 1) != 0;
}

// The rooms of this house, in the order in which machine::start() opens them; stop() closes them the other way round.
// Each close is harmless when the room was never opened.
void openTraps();   // processor exceptions end the program tidily
void closeTraps();
const char* openBreak();  // Ctrl-C, Ctrl-Break and critical errors; null, or what is wrong
void closeBreak();
bool breakSeen();
void noteBreak();  // a Ctrl-C that came as a key
void openClock();
void closeClock();
void closeMouse();

}  // namespace pc

#endif
