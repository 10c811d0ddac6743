// The services of a DPMI 0.9 host as functions: descriptors, memory, DOS memory, vectors, exceptions and real-mode
// interrupts. Each function is one int 31h; the comment begins with its DPMI number. For src/dos and src/rt only.
#ifndef FB_DPMI_H
#define FB_DPMI_H

#include <stddef.h>
#include <stdint.h>

namespace dpmi {

// The registers of a real-mode call, in the order that DPMI prescribes (50 bytes).
struct RealRegs {
    uint32_t edi, esi, ebp, reserved, ebx, edx, ecx, eax;
    uint16_t flags, es, ds, fs, gs, ip, cs, sp, ss;
} __attribute__((packed));

// A real-mode address.
struct RealAddress {
    uint16_t segment;
    uint16_t offset;
};

// A protected-mode address.
struct FarAddress {
    uint32_t offset;
    uint16_t selector;
};

// 0000h: allocates one descriptor; returns 0 when there is none left.
inline uint16_t allocateDescriptor()
{
    uint32_t eax = 0x0000;
    bool carry;
    __asm__ volatile("int $0x31" : "+a"(eax), "=@ccc"(carry) : "c"(1) : "memory");
    return carry ? 0 : uint16_t(eax);
}

// 0002h: returns a permanent descriptor for the 64 KB of a real-mode segment; 0 on failure.
inline uint16_t segmentDescriptor(uint16_t segment)
{
    uint32_t eax = 0x0002;
    bool carry;
    __asm__ volatile("int $0x31" : "+a"(eax), "=@ccc"(carry) : "b"(uint32_t(segment)) : "memory");
    return carry ? 0 : uint16_t(eax);
}

// 0006h: returns the linear address at which a segment begins.
inline uint32_t segmentBase(uint16_t selector)
{
    uint32_t eax = 0x0006;
    uint32_t ecx = 0;
    uint32_t edx = 0;
    __asm__ volatile("int $0x31" : "+a"(eax), "+c"(ecx), "+d"(edx) : "b"(uint32_t(selector)) : "cc", "memory");
    return ecx << 16 | (edx & 0xffff);
}

// 0007h: sets the linear address at which a segment begins.
inline bool setSegmentBase(uint16_t selector, uint32_t base)
{
    uint32_t eax = 0x0007;
    bool carry;
    __asm__ volatile("int $0x31"
                     : "+a"(eax), "=@ccc"(carry)
                     : "b"(uint32_t(selector)), "c"(base >> 16), "d"(base & 0xffff)
                     : "memory");
    return !carry;
}

// 0008h: sets the limit, the last valid offset; from 1 MB on its low twelve bits must be set. A segment register that holds
// the selector keeps the old limit until it is loaded again.
inline bool setSegmentLimit(uint16_t selector, uint32_t limit)
{
    uint32_t eax = 0x0008;
    bool carry;
    __asm__ volatile("int $0x31"
                     : "+a"(eax), "=@ccc"(carry)
                     : "b"(uint32_t(selector)), "c"(limit >> 16), "d"(limit & 0xffff)
                     : "memory");
    return !carry;
}

// Returns the last valid offset of a segment, as the processor sees it (lsl); 0 for an invalid selector.
inline uint32_t segmentLimit(uint16_t selector)
{
    uint32_t limit = 0;
    // volatile, because the limit of a selector can change between two calls.
    __asm__ volatile("lsll %1, %0" : "+r"(limit) : "r"(uint32_t(selector)) : "cc");
    return limit;
}

// 0100h: allocates DOS memory, in paragraphs of 16 bytes; returns false when there is not enough.
inline bool allocateDos(uint16_t paragraphs, uint16_t* segment, uint16_t* selector)
{
    uint32_t eax = 0x0100;
    uint32_t ebx = paragraphs;
    uint32_t edx = 0;
    bool carry;
    __asm__ volatile("int $0x31" : "+a"(eax), "+b"(ebx), "+d"(edx), "=@ccc"(carry) : : "memory");
    *segment = uint16_t(eax);
    *selector = uint16_t(edx);
    return !carry;
}

// 0101h: frees DOS memory.
inline void freeDos(uint16_t selector)
{
    uint32_t eax = 0x0101;
    __asm__ volatile("int $0x31" : "+a"(eax) : "d"(uint32_t(selector)) : "cc", "memory");
}

// 0200h, 0201h: get and set a vector of the real-mode interrupt table.
inline RealAddress realVector(int number)
{
    uint32_t eax = 0x0200;
    uint32_t ecx = 0;
    uint32_t edx = 0;
    __asm__ volatile("int $0x31" : "+a"(eax), "+c"(ecx), "+d"(edx) : "b"(number) : "cc", "memory");
    return {uint16_t(ecx), uint16_t(edx)};
}
inline void setRealVector(int number, RealAddress to)
{
    uint32_t eax = 0x0201;
    __asm__ volatile("int $0x31"
                     : "+a"(eax)
                     : "b"(number), "c"(uint32_t(to.segment)), "d"(uint32_t(to.offset))
                     : "cc", "memory");
}

// 0202h, 0203h: get and set the handler of a processor exception 0..31.
inline bool exceptionHandler(int number, FarAddress* is)
{
    uint32_t eax = 0x0202;
    uint32_t ecx = 0;
    uint32_t edx = 0;
    bool carry;
    __asm__ volatile("int $0x31" : "+a"(eax), "+c"(ecx), "+d"(edx), "=@ccc"(carry) : "b"(number) : "memory");
    *is = {edx, uint16_t(ecx)};
    return !carry;
}
inline bool setExceptionHandler(int number, FarAddress to)
{
    uint32_t eax = 0x0203;
    bool carry;
    __asm__ volatile("int $0x31"
                     : "+a"(eax), "=@ccc"(carry)
                     : "b"(number), "c"(uint32_t(to.selector)), "d"(to.offset)
                     : "memory");
    return !carry;
}

// 0300h: executes a real-mode interrupt with these registers, which then hold its results. ss:sp = 0 lets the host supply
// the stack. Returns false when the host refuses.
inline bool realInterrupt(int number, RealRegs* regs)
{
    uint32_t eax = 0x0300;
    bool carry;
    regs->ss = 0;
    regs->sp = 0;
    regs->flags = 0x202;
    __asm__ volatile("int $0x31" : "+a"(eax), "=@ccc"(carry) : "b"(number), "c"(0), "D"(regs) : "memory");
    return !carry;
}

// 0400h: returns the processor, 3 for a 386, 4 for a 486 and so on.
inline int processor()
{
    uint32_t eax = 0x0400;
    uint32_t ebx = 0;
    uint32_t ecx = 0;
    uint32_t edx = 0;
    __asm__ volatile("int $0x31" : "+a"(eax), "+b"(ebx), "+c"(ecx), "+d"(edx) : : "cc", "memory");
    return int(ecx & 0xff);
}

// 0501h: allocates memory, counted in bytes; returns false when there is not enough.
inline bool allocateMemory(uint32_t bytes, uint32_t* linear, uint32_t* handle)
{
    uint32_t eax = 0x0501;
    uint32_t ebx = bytes >> 16;
    uint32_t ecx = bytes & 0xffff;
    uint32_t esi = 0;
    uint32_t edi = 0;
    bool carry;
    __asm__ volatile("int $0x31" : "+a"(eax), "+b"(ebx), "+c"(ecx), "+S"(esi), "+D"(edi), "=@ccc"(carry) : : "memory");
    *linear = ebx << 16 | (ecx & 0xffff);
    *handle = esi << 16 | (edi & 0xffff);
    return !carry;
}

// 0502h: frees memory of allocateMemory().
inline void freeMemory(uint32_t handle)
{
    uint32_t eax = 0x0502;
    __asm__ volatile("int $0x31" : "+a"(eax) : "S"(handle >> 16), "D"(handle & 0xffff) : "cc", "memory");
}

// Return the program's own selectors.
inline uint16_t codeSelector()
{
    uint16_t selector;
    __asm__("movw %%cs, %0" : "=r"(selector));
    return selector;
}
inline uint16_t dataSelector()
{
    uint16_t selector;
    __asm__("movw %%ds, %0" : "=r"(selector));
    return selector;
}

}  // namespace dpmi

#endif
