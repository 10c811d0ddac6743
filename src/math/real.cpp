// Arithmetic that is no single instruction: roots and the circle. Integers throughout: the model's seeds and paths are
// made with these, so they must come out the same on every machine.
#include "math/real.h"

uint32_t squareRoot64(uint64_t a)
{
    // Digit by digit, two bits of the radicand for one of the root; no division.
    uint64_t root = 0;
    uint64_t bit = 1ull << 62;
    while (bit > a)
        bit >>= 2;
    while (bit != 0) {
        if (a >= root + bit) {
            a -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
        bit >>= 2;
    }
    return static_cast<uint32_t>(root);
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
    // Folded into the first quarter, where x = 0 .. 1 (2.30) stands for 0 .. pi/2.
    uint32_t x = a & 0x3fffffffu;
    if (a & 0x40000000u)
        x = 0x40000000u - x;
    // sin(x pi/2) by its Taylor series up to x^13: the next term is below 2^-30 at x = 1.
    // Coefficients (pi/2)^n / n! scaled by 2^30.
    const int64_t square = (static_cast<int64_t>(x) * x) >> 30;
    int64_t sum = 61;                                   // +(pi/2)^13/13!
    sum = -3864 + ((sum * square) >> 30);               // -(pi/2)^11/11!
    sum = 172272 + ((sum * square) >> 30);              // +(pi/2)^9/9!
    sum = -5026995 + ((sum * square) >> 30);            // -(pi/2)^7/7!
    sum = 85569306 + ((sum * square) >> 30);            // +(pi/2)^5/5!
    sum = -693598668 + ((sum * square) >> 30);          // -(pi/2)^3/3!
    sum = 1686629713 + ((sum * square) >> 30);          // pi/2
    int64_t value = (sum * x) >> 30;
    if (value > 0x40000000)
        value = 0x40000000;
    return static_cast<int32_t>(a & 0x80000000u ? -value : value);
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
