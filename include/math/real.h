// Real: a real number for the purposes of the representation (report, Section III, Data Structures: "can be easily
// redefined as a single- or double-precision floating point number or as a fixed-point representation").
//
// One define chooses: FB_REAL is FB_FIXED (the default: 16.16, the same bits on every machine), FB_FLOAT or FB_DOUBLE.
// Everything else in the program is written against the few names below and compiles with all three.
//
// 16.16: one sign bit, 15 bits of units, 16 bits of fraction; range -32768 .. 32767.99998, step 1/65536. Products and
// quotients are rounded towards minus infinity (the shift) and towards zero (the division). Sums must stay in range:
// a squared distance does only up to 181 units, so no squared distance is ever formed from unscaled coordinates (see
// SoftObject::coreParam).
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

// For functions of the innermost loops: arguments in registers, where the compiler would pass them through memory; and what
// is seldom needed stays out of the way of what often is.
#if FB_I386
#define REGISTERS __attribute__((regparm(3)))
#else
#define REGISTERS
#endif
#define SELDOM __attribute__((noinline))

// High 32 bits of the signed 64-bit product: one imul on the 386.
inline int32_t mulHigh(int32_t a, int32_t b)
{
    return static_cast<int32_t>((static_cast<int64_t>(a) * b) >> 32);
}

// (a * b) >> 16 on 64 bits between.
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

// a * b / c on 64 bits between, truncated towards zero; the quotient must fit 32 bits and c must not be 0.
// The 386 has both steps as one instruction each; without libgcc there is no other 64-bit division.
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

// a / b, rounded down; the quotient must fit 32 bits.
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

// a / b, rounded down, any 64-bit number by any 32-bit one but 0; `*rest` is what is left over.
inline uint64_t divide64(uint64_t a, uint32_t b, uint32_t* rest)
{
    // Long division in two digits of 32 bits: the rest of the first, below b, goes into the second.
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
    // For constants only: a double met at run time would need the x87, and the link without it fails.
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
    // The compiler shifts the high half of the product too, for nobody.
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

// Quotient truncated towards zero. Division by zero and quotients out of range give the largest value of their sign
// (the processor would stop the program instead).
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

// Largest integer not above the value.
constexpr int floorToInt(Real a) { return a.raw >> 16; }

// To and from raw 16.16, for tables, files and dumps, whatever Real is.
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

// a / b where the quotient is known to fit.
inline Real quotient(Real a, Real b)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulDiv(a.raw, 65536, b.raw));
#else
    return a / b;
#endif
}

// Square root; 0 for values below 0. Exact to the last bit (rounded down) for 16.16.
Real squareRoot(Real a);

// Integer square root, rounded down.
uint32_t squareRoot64(uint64_t a);

// An angle: the whole turn is 2^32, so that it wraps by itself.
typedef uint32_t Angle;

// Sine and cosine scaled by 2^30, good to 2^-27; computed in integers, so the same on every machine and for every Real.
int32_t sine30(Angle a);
inline int32_t cosine30(Angle a) { return sine30(a + 0x40000000u); }
Real sine(Angle a);
inline Real cosine(Angle a) { return sine(a + 0x40000000u); }

// A number of turns (any Real; only the fraction counts) as an angle.
Angle turns(Real t);

#endif
