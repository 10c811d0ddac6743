// Products and quotients wider than 32 bits. A 32-bit compiler calls libgcc to divide 64-bit numbers, and the stock
// build has no libgcc; on the i386 one instruction each does it.
#ifndef FB_WIDE_H
#define FB_WIDE_H

#include <stdint.h>

namespace wide {

// a * b / c, rounded down, with a product of 64 bits. c must not be 0 and the quotient must fit: 0xffffffff when it
// does not.
inline uint32_t mulDiv(uint32_t a, uint32_t b, uint32_t c) {
#if defined(__i386__)
    uint32_t low;
    uint32_t high;
    __asm__("mull %3" : "=a"(low), "=d"(high) : "0"(a), "rm"(b) : "cc");
    if (high >= c) {
        return 0xffffffffu;
    }
    __asm__("divl %2" : "+a"(low), "+d"(high) : "rm"(c) : "cc");
    return low;
#else
    const uint64_t quotient = c == 0 ? ~uint64_t(0) : uint64_t(a) * b / c;
    return quotient > 0xffffffffu ? 0xffffffffu : uint32_t(quotient);
#endif
}

// a / b, rounded down, any 64-bit number by any 32-bit one but 0; `*rest`, when given, is what is left over.
inline uint64_t divide(uint64_t a, uint32_t b, uint32_t* rest = nullptr) {
#if defined(__i386__)
    // Long division in two digits of 32 bits: the rest of the first, below b, goes into the second.
    uint32_t high = uint32_t(a >> 32);
    uint32_t left = 0;
    __asm__("divl %2" : "+a"(high), "+d"(left) : "rm"(b) : "cc");
    uint32_t low = uint32_t(a);
    __asm__("divl %2" : "+a"(low), "+d"(left) : "rm"(b) : "cc");
    if (rest != nullptr) {
        *rest = left;
    }
    return uint64_t(high) << 32 | low;
#else
    if (rest != nullptr) {
        *rest = uint32_t(a % b);
    }
    return a / b;
#endif
}

}  // namespace wide

#endif
