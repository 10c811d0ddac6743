// Tests of Point, Vector and Matrix against double precision.
#include "math/vec.h"

#include "help.h"
#include "test.h"

namespace {

void close(const Vec& a, const Vec& b, double tolerance)
{
    NEAR(a.x, b.x, tolerance);
    NEAR(a.y, b.y, tolerance);
    NEAR(a.z, b.z, tolerance);
}

Vector any(Random& random, double most)
{
    return vector(random.between(-most, most), random.between(-most, most), random.between(-most, most));
}

}  // namespace

TEST(points_and_vectors)
{
    // "Can be subtracted to give a vector, and adding a vector to a point gives a new point."
    const Point p = point(1, 2, 3), q = point(4, -6, 8);
    const Vector v = q - p;
    close(vec(v), {3, -8, 5}, 0);
    close(vec(p + v), vec(q), 0);
    close(vec(q - v), vec(p), 0);
    close(vec(toVector(p)), {1, 2, 3}, 0);
    close(vec(toPoint(v)), {3, -8, 5}, 0);
    close(vec(-v), {-3, 8, -5}, 0);
    close(vec(v * Real(0.5)), {1.5, -4, 2.5}, 0);
    CHECK(p + v == q);
    CHECK(!(p == q));
    CHECK(v == v && !(v == -v));
}

TEST(products)
{
    Random random;
    for (int i = 0; i < 5000; ++i) {
        const Vector a = any(random, 100), b = any(random, 100);
        const Vec x = vec(a), y = vec(b);
        NEAR(number(dot(a, b)), x.x * y.x + x.y * y.y + x.z * y.z, 3 * STEP + EXACT * 40000);
        close(vec(cross(a, b)), {x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x},
              2 * STEP + EXACT * 40000);
    }
}

TEST(lengths)
{
    Random random;
    for (double most : {0.01, 1.0, 50.0, 5000.0, 18000.0}) {
        for (int i = 0; i < 2000; ++i) {
            const Vector v = any(random, most);
            NEAR(number(length(v)), size(vec(v)), STEP + EXACT * 40000);
        }
    }
    NEAR(number(length(vector(0, 0, 0))), 0, 0);
    // A length beyond the range of Real becomes the largest fixed-point number.
#if FB_REAL == FB_FIXED
    SAME(length(vector(32767, 32767, -32767)).raw, INT32_MAX);
#endif
}

TEST(new_length_same_direction)
{
    Random random;
    for (double most : {0.001, 0.1, 10.0, 300.0, 20000.0}) {
        for (int i = 0; i < 2000; ++i) {
            const Vector v = any(random, most);
            const double before = size(vec(v));
            if (before < 3 * STEP)
                continue;
            const double wanted = random.between(0.5, 100);
            const Vector w = withLength(v, real(wanted));
            NEAR(size(vec(w)), wanted, 3 * STEP + EXACT * 500);
            // The direction is as accurate as the bits of v allow.
            const Vec d = vec(v) * (1 / before), e = vec(w) * (1 / size(vec(w)));
            close(e, d, 4 * STEP / wanted + EXACT * 10);
        }
    }
    const Vector zero = vector(0, 0, 0);
    CHECK(withLength(zero, Real(5)) == zero);
    CHECK(unit(zero) == zero);
#if FB_REAL == FB_FIXED
    // The largest components there are.
    const Vector far{Real::fromRaw(INT32_MIN), Real::fromRaw(INT32_MAX), Real::fromRaw(INT32_MIN)};
    NEAR(size(vec(unit(far))), 1, 3 * STEP);
#endif
}

TEST(projections)
{
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const Vector v = any(random, 50), onto = any(random, 50);
        const Vec d = vec(onto) * (1 / size(vec(onto)));
        if (size(vec(onto)) < 1)
            continue;
        const Vec p = vec(projection(v, onto));
        close(p, d * dot(vec(v), d), 200 * STEP * 2 + EXACT * 1000);
        // The rest is perpendicular to the direction.
        NEAR(dot(vec(v) - p, d), 0, 500 * STEP + EXACT * 1000);
    }
    CHECK(projection(vector(1, 2, 3), vector(0, 0, 0)) == vector(0, 0, 0));
}

TEST(matrices)
{
    const Matrix one = Matrix::identity();
    const Point p = point(3, -4, 5);
    CHECK(one * p == p);
    CHECK(one * toVector(p) == toVector(p));
    // A translation changes a point but not a vector.
    const Matrix shift = Matrix::translation(vector(10, 20, 30));
    CHECK(shift * p == point(13, 16, 35));
    CHECK(shift * toVector(p) == toVector(p));
    CHECK(Matrix::scaling(Real(2)) * p == point(6, -8, 10));
    // First scaling, then translation; and the other way round.
    CHECK((shift * Matrix::scaling(Real(2))) * p == point(16, 12, 40));
    CHECK((Matrix::scaling(Real(2)) * shift) * p == point(26, 32, 70));
    const Matrix same = one * shift;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            CHECK(same.m[i][j] == shift.m[i][j]);
}

TEST(rotations)
{
    // A quarter turn about z takes x to y: anticlockwise as seen from the tip of the axis.
    close(vec(Matrix::rotation(vector(0, 0, 7), 0x40000000u) * vector(1, 0, 0)), {0, 1, 0}, 2 * STEP + 1e-7);
    close(vec(Matrix::rotation(vector(1, 0, 0), 0x40000000u) * vector(0, 1, 0)), {0, 0, 1}, 2 * STEP + 1e-7);
    close(vec(Matrix::rotation(vector(0, 1, 0), 0x40000000u) * vector(0, 0, 1)), {1, 0, 0}, 2 * STEP + 1e-7);
    const Matrix none = Matrix::rotation(vector(0, 0, 0), 0x12345678u);
    CHECK(none * vector(1, 2, 3) == vector(1, 2, 3));
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const Vector axis = any(random, 10), v = any(random, 50);
        if (size(vec(axis)) < 1)
            continue;
        const Angle angle = random.bits();
        const Matrix turn = Matrix::rotation(axis, angle);
        const Vector w = turn * v;
        NEAR(size(vec(w)), size(vec(v)), 300 * 2 * STEP + EXACT * 1000 + 1e-6);
        // Rodrigues' formula in double precision.
        const Vec a = vec(axis) * (1 / size(vec(axis))), x = vec(v);
        const double c = std::cos(angle * (M_PI / 2147483648.0)), s = std::sin(angle * (M_PI / 2147483648.0));
        const Vec cr{a.y * x.z - a.z * x.y, a.z * x.x - a.x * x.z, a.x * x.y - a.y * x.x};
        close(vec(w), x * c + cr * s + a * (dot(a, x) * (1 - c)), 300 * 3 * STEP + EXACT * 1000 + 1e-6);
        // The inverse rotation leads back.
        close(vec(Matrix::rotation(axis, 0u - angle) * w), x, 900 * 2 * STEP + EXACT * 2000 + 1e-6);
    }
}
