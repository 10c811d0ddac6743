// Real: a real number for the purposes of the representation (report, Section III, Data Structures: "can be easily redefined as
// a single- or double-precision floating point number or as a fixed-point representation").
//
// One define chooses: FB_REAL is FB_FIXED (the default: 16.16, the same bits on every machine), FB_FLOAT or FB_DOUBLE. The rest
// of the program uses only the names below and compiles with all three.
//
// 16.16: one sign bit, 15 integer bits, 16 fraction bits; range -32768 .. 32767.99998, step 1/65536. Products are rounded
// towards minus infinity (by a shift), quotients towards zero. Sums must stay in range. A squared distance stays in range only
// up to 181 units, so no squared distance is formed from unscaled coordinates as a Real (see SoftObject::plainParam and
// squareOf()).
#ifndef FB_REAL_H
#define FB_REAL_H

#include <stdint.h>

#define FB_FIXED 0
#define FB_FLOAT 1
#define FB_DOUBLE 2

#ifndef FB_REAL
#define FB_REAL FB_FIXED
#endif

#if defined(__i386__)
#define FB_I386 1
#else
#define FB_I386 0
#endif

// Keeps code that is seldom needed from being inlined into code that runs often.
#define SELDOM __attribute__((noinline))

// Upper 32 bits of the signed 64-bit product: one imul on the 386.
inline int32_t mulHigh(int32_t a, int32_t b)
{
    return static_cast<int32_t>((static_cast<int64_t>(a) * b) >> 32);
}

// (a * b) >> 16, with a 64-bit product.
inline int32_t mulShift16(int32_t a, int32_t b)
{
#if FB_I386
    int32_t low;
    int32_t high;
    asm("imull %3\n\tshrdl $16, %%edx, %%eax" : "=a"(low), "=&d"(high) : "%0"(a), "rm"(b) : "cc");
    return low;
#else
    return static_cast<int32_t>((static_cast<int64_t>(a) * b) >> 16);
#endif
}

// a * b / c with a 64-bit product, truncated towards zero. The quotient must fit 32 bits and c must not be 0. The 386 does each
// step with one instruction; without libgcc there is no other 64-bit division.
inline int32_t mulDiv(int32_t a, int32_t b, int32_t c)
{
#if FB_I386
    int32_t quotient;
    int32_t high;
    asm("imull %3\n\tidivl %4" : "=&a"(quotient), "=&d"(high) : "0"(a), "rm"(b), "rm"(c) : "cc");
    return quotient;
#else
    return static_cast<int32_t>(static_cast<int64_t>(a) * b / c);
#endif
}

// a / b, rounded down; the quotient must fit 32 bits. `*rest` receives the remainder.
inline uint32_t quotient64(uint64_t a, uint32_t b, uint32_t* rest)
{
#if FB_I386
    uint32_t low = static_cast<uint32_t>(a), high = static_cast<uint32_t>(a >> 32);
    asm("divl %2" : "+a"(low), "+d"(high) : "rm"(b) : "cc");
    *rest = high;
    return low;
#else
    *rest = static_cast<uint32_t>(a % b);
    return static_cast<uint32_t>(a / b);
#endif
}

// a / b, rounded down, for any 64-bit a and any 32-bit b but 0. `*rest` receives the remainder.
inline uint64_t divide64(uint64_t a, uint32_t b, uint32_t* rest)
{
    // Long division in two digits of 32 bits: the remainder of the first digit, which is below b, goes into the second.
    const uint32_t high = quotient64(a >> 32, b, rest);
    const uint32_t low = quotient64(static_cast<uint64_t>(*rest) << 32 | static_cast<uint32_t>(a), b, rest);
    return static_cast<uint64_t>(high) << 32 | low;
}
inline uint64_t divide64(uint64_t a, uint32_t b)
{
    uint32_t rest;
    return divide64(a, b, &rest);
}

#if FB_REAL == FB_FIXED

struct Real {
    int32_t raw;  // value * 65536

    Real() = default;
    constexpr Real(int whole) : raw(static_cast<int32_t>(static_cast<uint32_t>(whole) << 16)) {}
    constexpr Real(long whole) : Real(static_cast<int>(whole)) {}
    // For constants only: a double computed at run time would need the x87, and the link fails without x87 support.
    constexpr Real(double value) : raw(static_cast<int32_t>(value * 65536 + (value < 0 ? -0.5 : 0.5))) {}

    static constexpr Real fromRaw(int32_t raw)
    {
        Real r{0};
        r.raw = raw;
        return r;
    }

    constexpr Real operator-() const { return fromRaw(-raw); }
    constexpr Real& operator+=(Real b) { raw += b.raw; return *this; }
    constexpr Real& operator-=(Real b) { raw -= b.raw; return *this; }
};

constexpr Real operator+(Real a, Real b) { return Real::fromRaw(a.raw + b.raw); }
constexpr Real operator-(Real a, Real b) { return Real::fromRaw(a.raw - b.raw); }
constexpr Real operator*(Real a, Real b)
{
#if FB_I386
    // The compiler would also shift the high half of the product, which is not used.
    if (!__builtin_is_constant_evaluated() && !(__builtin_constant_p(a.raw) && __builtin_constant_p(b.raw)))
        return Real::fromRaw(mulShift16(a.raw, b.raw));
#endif
    return Real::fromRaw(static_cast<int32_t>((static_cast<int64_t>(a.raw) * b.raw) >> 16));
}
constexpr bool operator<(Real a, Real b) { return a.raw < b.raw; }
constexpr bool operator>(Real a, Real b) { return a.raw > b.raw; }
constexpr bool operator<=(Real a, Real b) { return a.raw <= b.raw; }
constexpr bool operator>=(Real a, Real b) { return a.raw >= b.raw; }
constexpr bool operator==(Real a, Real b) { return a.raw == b.raw; }
constexpr bool operator!=(Real a, Real b) { return a.raw != b.raw; }

// Quotient truncated towards zero. A division by zero and a quotient out of range give the largest value with the quotient's
// sign (the processor would stop the program instead).
inline Real operator/(Real a, Real b)
{
    const uint32_t top = a.raw < 0 ? 0u - static_cast<uint32_t>(a.raw) : static_cast<uint32_t>(a.raw);
    const uint32_t bottom = b.raw < 0 ? 0u - static_cast<uint32_t>(b.raw) : static_cast<uint32_t>(b.raw);
    if ((top >> 15) >= bottom)
        return Real::fromRaw((a.raw ^ b.raw) < 0 ? -INT32_MAX : INT32_MAX);
    return Real::fromRaw(mulDiv(a.raw, 65536, b.raw));
}

// value / 2^n and value * 2^n.
constexpr Real shiftDown(Real a, int n) { return Real::fromRaw(a.raw >> n); }
constexpr Real shiftUp(Real a, int n) { return Real::fromRaw(static_cast<int32_t>(static_cast<uint32_t>(a.raw) << n)); }

// The largest integer not above the value.
constexpr int floorToInt(Real a) { return a.raw >> 16; }

// Conversion from and to raw 16.16, for tables, files and dumps, whatever type Real is.
constexpr Real realFromRaw(int32_t raw) { return Real::fromRaw(raw); }
constexpr int32_t rawFromReal(Real a) { return a.raw; }

#else

#if FB_REAL == FB_FLOAT
typedef float Real;
#else
typedef double Real;
#endif

constexpr Real realFromRaw(int32_t raw) { return static_cast<Real>(raw) / 65536; }
constexpr int32_t rawFromReal(Real a) { return static_cast<int32_t>(a * 65536); }
constexpr Real shiftDown(Real a, int n) { return a / static_cast<Real>(1u << n); }
constexpr Real shiftUp(Real a, int n) { return a * static_cast<Real>(1u << n); }
constexpr int floorToInt(Real a)
{
    const int whole = static_cast<int>(a);
    return whole - (static_cast<Real>(whole) > a);
}

#endif

constexpr Real absolute(Real a) { return a < Real(0) ? -a : a; }
constexpr Real min(Real a, Real b) { return b < a ? b : a; }
constexpr Real max(Real a, Real b) { return a < b ? b : a; }
constexpr Real clamp(Real a, Real low, Real high) { return a < low ? low : high < a ? high : a; }

// a / b for quotients known to be in range, b not 0: without the checks of operator/.
inline Real quotient(Real a, Real b)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulDiv(a.raw, 65536, b.raw));
#else
    return a / b;
#endif
}

// Square root; 0 for values below 0. In 16.16 it is exact to the last bit (rounded down).
Real squareRoot(Real a);

// Integer square root, rounded down.
uint32_t squareRoot64(uint64_t a);

// An angle: a whole turn is 2^32, so that angles wrap around by themselves.
typedef uint32_t Angle;
constexpr Angle QUARTER = 0x40000000u;  // a quarter turn

// Sine and cosine with 30 fraction bits, good to 2^-27. They are computed in integers, so they are the same on every machine
// and for every type of Real.
int32_t sine30(Angle a);
inline int32_t cosine30(Angle a) { return sine30(a + QUARTER); }
Real sine(Angle a);
inline Real cosine(Angle a) { return sine(a + QUARTER); }

// A number of turns as an angle; only the fraction counts.
Angle turns(Real t);

#endif
