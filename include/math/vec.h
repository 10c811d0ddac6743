// Point, Vector, Matrix: the report's simple types (Section III, Data Structures), with the operations it names. Components are
// in the model's units and of type Real, so in 16.16 each must stay within +-32767.
#ifndef FB_VEC_H
#define FB_VEC_H

#include "math/real.h"

// A 3-D direction vector. "Can be added and subtracted, equated to points, and the length modified without changing
// the direction. Dot products and projections are also defined."
struct Vector {
    Real x, y, z;
};

// A location in 3-space. "Can be subtracted to give a vector, and adding a vector to a point gives a new point."
struct Point {
    Real x, y, z;
};

constexpr Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vector operator*(const Vector& a, Real b) { return {a.x * b, a.y * b, a.z * b}; }
constexpr Vector operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Point operator+(const Point& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Point operator-(const Point& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr bool operator==(const Vector& a, const Vector& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
constexpr bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// "Points can be equated to vectors."
constexpr Vector toVector(const Point& p) { return {p.x, p.y, p.z}; }
constexpr Point toPoint(const Vector& v) { return {v.x, v.y, v.z}; }

// Dot product. In 16.16 the sum must stay below 32768, so both lengths must be below 181, or one of them small.
constexpr Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector cross(const Vector& a, const Vector& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// dot(a, b) / 2^shift for vectors of which at least one is short (components below 8192); in 16.16 it is limited to the range.
// `shift` is at most 15.
#if FB_REAL == FB_FIXED
inline Real dotDown(const Vector& a, const Vector& b, int shift)
{
    const int64_t product = int64_t(a.x.raw) * b.x.raw + int64_t(a.y.raw) * b.y.raw + int64_t(a.z.raw) * b.z.raw;
    const int64_t raw = product >> (16 + shift);
    return Real::fromRaw(static_cast<int32_t>(raw > INT32_MAX ? INT32_MAX : raw < -INT32_MAX ? -INT32_MAX : raw));
}
#else
inline Real dotDown(const Vector& a, const Vector& b, int shift) { return shiftDown(dot(a, b), shift); }
#endif

// The square of a length, for components of any size in range: it allows lengths to be compared without square roots.
#if FB_REAL == FB_FIXED
typedef uint64_t Square;

inline Square squareOf(const Vector& v)
{
    const int64_t x = v.x.raw, y = v.y.raw, z = v.z.raw;
    return static_cast<uint64_t>(x * x) + static_cast<uint64_t>(y * y) + static_cast<uint64_t>(z * z);
}
inline Square squareOf(Real a) { return static_cast<uint64_t>(static_cast<int64_t>(a.raw) * a.raw); }
#else
typedef Real Square;

inline Square squareOf(const Vector& v) { return dot(v, v); }
inline Square squareOf(Real a) { return a * a; }
#endif
Real lengthOf(Square square);

// Whether two points are less than a distance apart. Most that are not are too far apart along the first axis already.
inline bool isNearer(const Point& a, const Point& b, Real than)
{
    return absolute(a.x - b.x) < than && absolute(a.y - b.y) < than && absolute(a.z - b.z) < than &&
           squareOf(a - b) < squareOf(than);
}

// Euclidean length.
inline Real length(const Vector& v) { return lengthOf(squareOf(v)); }

// The vector with the direction of `v` and the given length; the zero vector has no direction and stays zero.
Vector withLength(const Vector& v, Real newLength);
inline Vector unit(const Vector& v) { return withLength(v, Real(1)); }

// The component of `v` along `onto`, which need not have unit length; a zero `onto` gives zero.
Vector projection(const Vector& v, const Vector& onto);

// A 4x4 matrix for column vectors, m[row][column]. "Can be equated and multiplied by matrices to give new matrices, and
// multiplied by points and vectors to give new points and vectors." The last row of every matrix of this program is 0 0 0 1.
// Column 3, the translation, is added to points but not to vectors.
struct Matrix {
    Real m[4][4];

    static constexpr Matrix identity()
    {
        return {{{Real(1), Real(0), Real(0), Real(0)},
                 {Real(0), Real(1), Real(0), Real(0)},
                 {Real(0), Real(0), Real(1), Real(0)},
                 {Real(0), Real(0), Real(0), Real(1)}}};
    }
    static Matrix translation(const Vector& by);
    static Matrix scaling(Real by);
    // Turn by `angle` about an axis through the origin, anticlockwise when the axis points at the reader in a right-handed
    // system. The axis need not have unit length; a zero axis gives the identity.
    static Matrix rotation(const Vector& axis, Angle angle);
};

Matrix operator*(const Matrix& a, const Matrix& b);
Point operator*(const Matrix& a, const Point& p);
Vector operator*(const Matrix& a, const Vector& v);
// Undoes a rotation: turnedBack(a, a * v) is v. The inverse of a rotation is its transpose.
inline __attribute__((always_inline)) Vector turnedBack(const Matrix& a, const Vector& v)
{
    return {a.m[0][0] * v.x + a.m[1][0] * v.y + a.m[2][0] * v.z, a.m[0][1] * v.x + a.m[1][1] * v.y + a.m[2][1] * v.z,
            a.m[0][2] * v.x + a.m[1][2] * v.y + a.m[2][2] * v.z};
}

#endif
