// What the files of src/dos share: the first megabyte, the transfer buffer, ports, and the functions that open and close
// each part. No file outside src/dos includes this header.
#ifndef FB_PC_H
#define FB_PC_H

#include <stddef.h>
#include <stdint.h>

#include "dpmi.h"

namespace pc {

// Returns a selector for the first megabyte and the 64 KB above it, with base 0. The first call allocates it.
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

// The keyboard buffer of the BIOS, a ring: offsets of the next key to read and of the next to write, equal when it is empty.
constexpr uint32_t KEYS_HEAD = 0x41a;
constexpr uint32_t KEYS_TAIL = 0x41c;

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

// The buffer in DOS memory through which names and data go to DOS and back. It begins at offset 0 of its segment.
struct Transfer {
    uint16_t segment;
    uint32_t bytes;  // at least 4 KB, less than 64 KB
};
Transfer transfer();

// Returns registers for dpmi::realInterrupt(), all 0 except eax.
inline dpmi::RealRegs regs(uint32_t eax)
{
    dpmi::RealRegs r = {0, 0, 0, 0, 0, 0, 0, eax, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    return r;
}
// Returns the carry flag in the results of a real-mode call.
inline bool carry(const dpmi::RealRegs& r)
{
    return (r.flags & 1) != 0;
}

// The parts of src/dos, in the order in which machine::start() opens them; stop() closes them in reverse order. A close
// function is harmless when its part was never opened.
void openTraps();   // processor exceptions: end the program in an orderly way
void closeTraps();
const char* openBreak();  // Ctrl-C, Ctrl-Break and critical errors; returns null, or what is wrong
void closeBreak();
bool breakSeen();
void noteBreak();  // reports a Ctrl-C that came as a key
void openClock();
void closeClock();
void closeMouse();

}  // namespace pc

#endif
