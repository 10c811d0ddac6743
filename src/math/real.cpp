// Arithmetic of more than one instruction: square roots, sine and cosine. All of it is done in integers, because seeds and
// paths are made with these functions and must be the same on every machine.
#include "math/real.h"

namespace {

// a * b / 2^30, rounded down; the result must fit 32 bits.
inline int32_t times(int32_t a, int32_t b)
{
#if FB_I386
    int32_t low = a, high;
    asm("imull %2\n\tshrdl $30, %1, %0" : "+a"(low), "=&d"(high) : "rm"(b) : "cc");
    return low;
#else
    return static_cast<int32_t>((static_cast<int64_t>(a) * b) >> 30);
#endif
}

}  // namespace

uint32_t squareRoot64(uint64_t a)
{
    if (a == 0)
        return 0;
    // The radicand is shifted so that its upper word has 29 or 30 bits, and no quotient below exceeds 32 bits.
    const int up = (__builtin_clzll(a) & ~1) - 2;
    const uint64_t wide = up < 0 ? a >> 2 : a << up;
    const uint32_t top = static_cast<uint32_t>(wide >> 32);
    // Start with a straight line that is within 4% of the root, then three steps of Newton's method: the first gives 16 bits of
    // the root, the other two give all bits.
    uint32_t root = top / 49152 + 11469;
    root = (root + top / root) << 15;
    uint32_t rest;
    root = (root >> 1) + (quotient64(wide, root, &rest) >> 1);
    root = (root >> 1) + (quotient64(wide, root, &rest) >> 1);
    root = up < 0 ? root << 1 : root >> (up >> 1);
    // Correct the error of rounding in the steps above.
    const auto square = [](uint32_t r) { return static_cast<uint64_t>(r) * r; };
    while (square(root) > a)
        --root;
    while (root != UINT32_MAX && square(root + 1) <= a)
        ++root;
    return root;
}

Real squareRoot(Real a)
{
    if (a <= Real(0))
        return Real(0);
#if FB_REAL == FB_FIXED
    return Real::fromRaw(static_cast<int32_t>(squareRoot64(static_cast<uint64_t>(a.raw) << 16)));
#elif FB_REAL == FB_FLOAT
    return __builtin_sqrtf(a);
#else
    return __builtin_sqrt(a);
#endif
}

int32_t sine30(Angle a)
{
    // Fold the angle into the first quarter, where x = 0 .. 1 (30 fraction bits) stands for 0 .. pi/2.
    uint32_t x = a & 0x3fffffffu;
    if (a & QUARTER)
        x = QUARTER - x;
    // sin(x pi/2) by its Taylor series up to x^13; the next term is below 2^-30 at x = 1. The coefficients are (pi/2)^n / n!,
    // scaled by 2^30.
    const int32_t part = static_cast<int32_t>(x), square = times(part, part);
    int32_t sum = 61;                            // +(pi/2)^13/13!
    sum = -3864 + times(sum, square);            // -(pi/2)^11/11!
    sum = 172272 + times(sum, square);           // +(pi/2)^9/9!
    sum = -5026995 + times(sum, square);         // -(pi/2)^7/7!
    sum = 85569306 + times(sum, square);         // +(pi/2)^5/5!
    sum = -693598668 + times(sum, square);       // -(pi/2)^3/3!
    sum = 1686629713 + times(sum, square);       // pi/2
    int32_t value = times(sum, part);
    if (value > 0x40000000)
        value = 0x40000000;
    return a & 0x80000000u ? -value : value;
}

Real sine(Angle a)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw((sine30(a) + (1 << 13)) >> 14);
#else
    return static_cast<Real>(sine30(a)) / (1 << 30);
#endif
}

Angle turns(Real t)
{
#if FB_REAL == FB_FIXED
    return static_cast<Angle>(t.raw) << 16;
#else
    return static_cast<Angle>(static_cast<int32_t>((t - static_cast<Real>(floorToInt(t))) * 65536)) << 16;
#endif
}
