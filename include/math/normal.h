// Normal: a unit vector in whole numbers, and quick lengths from the same table, for computations done for every seed of a
// frame.
#ifndef FB_NORMAL_H
#define FB_NORMAL_H

#include "math/vec.h"

// A unit normal with 14 fraction bits (1.0 = 2^14); its error is about 1/250.
struct Normal {
    int32_t x, y, z;
};

// A direction with 14 fraction bits, a Normal or a Direction14 (model/seed.h), as a vector.
template <class Direction>
inline Vector unitVector(const Direction& n)
{
    return {realFromRaw(n.x * 4), realFromRaw(n.y * 4), realFromRaw(n.z * 4)};
}

// Stores the components of a unit vector, 1.0 = 2^14.
inline void store14(const Vector& v, int32_t* to)
{
    to[0] = rawFromReal(v.x) >> 2;
    to[1] = rawFromReal(v.y) >> 2;
    to[2] = rawFromReal(v.z) >> 2;
}

// The component of a unit vector along an axis, 1.0 = 2^14 in both and in the result.
template <class Direction>
inline int32_t componentAlong(const Direction& n, const int32_t axis[3])
{
    return (n.x * axis[0] + n.y * axis[1] + n.z * axis[2]) >> 14;
}

// Fills the table that normalise() uses. Call it once before any object is made.
void makeNormalTable();

extern uint16_t inverseRoots[769];  // 2^28 / sqrt(s) for s = (i + 1/2) 2^20

// The direction of a vector of any length in range; a zero vector gives (0, 0, -1), the direction to the viewer.
inline Normal normalise(const Vector& v)
{
#if FB_REAL == FB_FIXED
    int32_t x = v.x.raw, y = v.y.raw, z = v.z.raw;
    const uint32_t bits = static_cast<uint32_t>(x < 0 ? ~x : x) | static_cast<uint32_t>(y < 0 ? ~y : y) |
                          static_cast<uint32_t>(z < 0 ? ~z : z);
    if (bits == 0)
        return {0, 0, -16384};
    // Shifts the components to 14 bits and a sign, so that the sum of squares has 27 to 30 bits.
    const int excess = 18 - __builtin_clz(bits);
    if (excess >= 0) {
        x >>= excess;
        y >>= excess;
        z >>= excess;
    } else {
        x *= 1 << -excess;
        y *= 1 << -excess;
        z *= 1 << -excess;
    }
    const int32_t inverse = inverseRoots[static_cast<uint32_t>(x * x + y * y + z * z) >> 20];
    return {(x * inverse) >> 14, (y * inverse) >> 14, (z * inverse) >> 14};
#else
    const Real size = length(v);
    if (!(size > Real(0)))
        return {0, 0, -16384};
    return {static_cast<int32_t>(v.x / size * 16384), static_cast<int32_t>(v.y / size * 16384),
            static_cast<int32_t>(v.z / size * 16384)};
#endif
}

// A little more than the length of a vector (each component up to 10000 units): by 0.3 to 1.2 %.
inline Real nearLength(const Vector& v)
{
#if FB_REAL == FB_FIXED
    const Normal n = normalise(v);
    const Vector along{Real::fromRaw(n.x * 4), Real::fromRaw(n.y * 4), Real::fromRaw(n.z * 4)};
    const Real l = dot(v, along);
    return l + shiftDown(l, 7);
#else
    return length(v);
#endif
}

#endif
