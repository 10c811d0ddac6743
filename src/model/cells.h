// How a seed's cell and the direction of its path are stored; for layout.cpp, between.cpp and reshape.cpp.
#ifndef FB_CELLS_H
#define FB_CELLS_H

#include "math/normal.h"
#include "model/softobj.h"

// Number of roots that the 16 bits of Seed::root can tell apart.
constexpr int ROOTS_MAX = UINT16_MAX + 1;

// Value of `neighbour` in an oversampled seed that has not been laid out yet.
constexpr int32_t NOT_LAID = -2;

// A part of a half axis or of a direction, limited to what a seed has room for.
inline int8_t toCell(int32_t steps)
{
    return static_cast<int8_t>(steps > 127 ? 127 : steps < -127 ? -127 : steps);
}

// Stores a half axis of a seed's cell in 1/64 of the spacing; `inverse` is 64 / spacing.
inline void setAxis(int8_t* to, const Vector& half, Real inverse)
{
    const auto cell = [&](Real part) { return toCell(floorToInt(part * inverse + Real(0.5))); };
    to[0] = cell(half.x);
    to[1] = cell(half.y);
    to[2] = cell(half.z);
}

// A half axis as a vector, in 1/64 of the spacing.
inline Vector vectorOf(const int8_t steps[3])
{
    return {Real(static_cast<int>(steps[0])), Real(static_cast<int>(steps[1])), Real(static_cast<int>(steps[2]))};
}

// The direction of a vector of any length.
inline Direction14 direction(const Vector& v)
{
    const Normal n = normalise(v);
    return {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

// Stores the direction of a seed's path: a unit vector, or that of `path`.
inline void setWay(Seed& s, const Direction14& n)
{
    s.way[0] = toCell((n.x * 127 + 8192) >> 14);
    s.way[1] = toCell((n.y * 127 + 8192) >> 14);
    s.way[2] = toCell((n.z * 127 + 8192) >> 14);
}

inline void setWay(Seed& s)
{
    setWay(s, direction(s.path));
}

// Computes the area of the cell of a seed with normal `n`.
inline void setArea(Seed& s, const Direction14& n)
{
    const int8_t *const a = s.along, *const b = s.across;
    const int32_t area = ((a[1] * b[2] - a[2] * b[1]) * n.x + (a[2] * b[0] - a[0] * b[2]) * n.y +
                          (a[0] * b[1] - a[1] * b[0]) * n.z) >> 14;
    s.area = static_cast<uint16_t>((area < 0 ? -area : area) + 1);
}

#endif
