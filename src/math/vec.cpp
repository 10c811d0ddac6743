// The operations of Point, Vector and Matrix that need more than a line (vec.h).
#include "math/vec.h"

Real lengthOf(Square square)
{
#if FB_REAL == FB_FIXED
    const uint32_t root = squareRoot64(square);
    return Real::fromRaw(root > INT32_MAX ? INT32_MAX : static_cast<int32_t>(root));
#else
    return squareRoot(square);
#endif
}

Vector withLength(const Vector& v, Real newLength)
{
#if FB_REAL == FB_FIXED
    // Short vectors are scaled up first, because their length alone has too few bits to divide by.
    int32_t x = v.x.raw, y = v.y.raw, z = v.z.raw;
    const int32_t limit = 1 << 28;
    if ((x | y | z) == 0)
        return v;
    if (x >= 2 * limit || x <= -2 * limit || y >= 2 * limit || y <= -2 * limit || z >= 2 * limit || z <= -2 * limit) {
        x >>= 2;
        y >>= 2;
        z >>= 2;
    }
    while (x < limit && x > -limit && y < limit && y > -limit && z < limit && z > -limit) {
        x *= 2;
        y *= 2;
        z *= 2;
    }
    const int32_t size = static_cast<int32_t>(
        squareRoot64(static_cast<uint64_t>(static_cast<int64_t>(x) * x) +
                     static_cast<uint64_t>(static_cast<int64_t>(y) * y) +
                     static_cast<uint64_t>(static_cast<int64_t>(z) * z)));
    return {Real::fromRaw(mulDiv(x, newLength.raw, size)), Real::fromRaw(mulDiv(y, newLength.raw, size)),
            Real::fromRaw(mulDiv(z, newLength.raw, size))};
#else
    const Real size = length(v);
    return size > Real(0) ? v * (newLength / size) : v;
#endif
}

Vector projection(const Vector& v, const Vector& onto)
{
    const Vector direction = unit(onto);
    return direction * dot(v, direction);
}

Matrix Matrix::translation(const Vector& by)
{
    Matrix r = identity();
    r.m[0][3] = by.x;
    r.m[1][3] = by.y;
    r.m[2][3] = by.z;
    return r;
}

Matrix Matrix::scaling(Real by)
{
    Matrix r = identity();
    for (int i = 0; i < 3; ++i)
        r.m[i][i] = by;
    return r;
}

Matrix Matrix::rotation(const Vector& axis, Angle angle)
{
    Matrix r = identity();
    const Vector a = unit(axis);
    if (a == Vector{Real(0), Real(0), Real(0)})
        return r;
    // Rodrigues' formula: cos I + sin [a]x + (1 - cos) a a^T.
    const Real c = cosine(angle), s = sine(angle), d = Real(1) - c;
    r.m[0][0] = c + a.x * a.x * d;
    r.m[0][1] = a.x * a.y * d - a.z * s;
    r.m[0][2] = a.x * a.z * d + a.y * s;
    r.m[1][0] = a.y * a.x * d + a.z * s;
    r.m[1][1] = c + a.y * a.y * d;
    r.m[1][2] = a.y * a.z * d - a.x * s;
    r.m[2][0] = a.z * a.x * d - a.y * s;
    r.m[2][1] = a.z * a.y * d + a.x * s;
    r.m[2][2] = c + a.z * a.z * d;
    return r;
}

Matrix operator*(const Matrix& a, const Matrix& b)
{
    Matrix r;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            Real sum(0);
            for (int k = 0; k < 4; ++k)
                sum += a.m[i][k] * b.m[k][j];
            r.m[i][j] = sum;
        }
    }
    return r;
}

Point operator*(const Matrix& a, const Point& p)
{
    return toPoint(a * toVector(p)) + Vector{a.m[0][3], a.m[1][3], a.m[2][3]};
}

Vector operator*(const Matrix& a, const Vector& v)
{
    return {a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z, a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
            a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}
