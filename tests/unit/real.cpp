// Tests of Real in its three kinds (16.16, float, double): what all kinds guarantee, and what 16.16 guarantees in addition.
#include "math/real.h"

#include <cmath>
#include <cstdlib>

#include "help.h"
#include "test.h"

TEST(real_conversions)
{
    NEAR(number(Real(3)), 3, 0);
    NEAR(number(Real(-7)), -7, 0);
    NEAR(number(Real(0.25)), 0.25, 0);
    NEAR(number(Real(-0.3)), -0.3, STEP / 2 + 1e-7);
    SAME(rawFromReal(Real(1)), 65536);
    SAME(rawFromReal(Real(-1.5)), -98304);
    CHECK(realFromRaw(65536) == Real(1));
    CHECK(realFromRaw(-32768) == Real(-0.5));
    // Each kind of Real keeps raw values unchanged as far as its precision allows.
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const int32_t raw = static_cast<int32_t>(random.bits()) >> 8;
        SAME(rawFromReal(realFromRaw(raw)), raw);
    }
}

TEST(real_arithmetic)
{
    Random random;
    for (int i = 0; i < 20000; ++i) {
        const double x = random.between(-150, 150), y = random.between(-150, 150);
        const Real a = real(x), b = real(y);
        const double ax = number(a), by = number(b);
        NEAR(number(a + b), ax + by, EXACT * 300);
        NEAR(number(a - b), ax - by, EXACT * 300);
        NEAR(number(a * b), ax * by, STEP + EXACT * 22500);
        if (std::fabs(by) > 0.01 && std::fabs(ax / by) < 30000)
            NEAR(number(a / b), ax / by, STEP + EXACT * 30000);
        NEAR(number(-a), -ax, 0);
        NEAR(number(absolute(a)), std::fabs(ax), 0);
        CHECK((a < b) == (ax < by));
        CHECK((a > b) == (ax > by));
        CHECK((a <= b) == (ax <= by));
        CHECK((a >= b) == (ax >= by));
        CHECK((a == b) == (ax == by));
        CHECK((a != b) == (ax != by));
        NEAR(number(min(a, b)), std::fmin(ax, by), 0);
        NEAR(number(max(a, b)), std::fmax(ax, by), 0);
        SAME(floorToInt(a), std::floor(ax));
        NEAR(number(shiftDown(a, 3)), ax / 8, STEP);
        NEAR(number(shiftUp(a, 3)), ax * 8, EXACT * 1200);
    }
    NEAR(number(clamp(Real(5), Real(-1), Real(2))), 2, 0);
    NEAR(number(clamp(Real(-5), Real(-1), Real(2))), -1, 0);
    NEAR(number(clamp(Real(1), Real(-1), Real(2))), 1, 0);
    Real sum(1);
    sum += Real(2);
    sum -= Real(0.5);
    NEAR(number(sum), 2.5, 0);
    SAME(floorToInt(Real(-0.5)), -1);
    SAME(floorToInt(Real(-2)), -2);
}

TEST(square_roots)
{
    Random random;
    NEAR(number(squareRoot(Real(0))), 0, 0);
    NEAR(number(squareRoot(Real(-4))), 0, 0);
    NEAR(number(squareRoot(Real(4))), 2, EXACT * 2);
    for (int i = 0; i < 2000; ++i) {
        const Real a = real(random.between(0, 32000));
        NEAR(number(squareRoot(a)), std::sqrt(number(a)), STEP + EXACT * 200);
    }
    // The integer root is exact: root^2 <= a < (root + 1)^2.
    const uint64_t ends[] = {0, 1, 2, 3, 4, 0xffffffffull, 0x100000000ull, 0xfffffffe00000000ull, 0xfffffffe00000001ull,
                             ~0ull};
    for (uint64_t a : ends) {
        const uint64_t root = squareRoot64(a);
        CHECK(root * root <= a);
        CHECK(root == 0xffffffffull || (root + 1) * (root + 1) > a);
    }
    for (int i = 0; i < 20000; ++i) {
        const uint64_t a = (static_cast<uint64_t>(random.bits()) << 32 | random.bits()) >> random.below(64);
        const uint64_t root = squareRoot64(a);
        CHECK(root * root <= a);
        CHECK(root == 0xffffffffull || (root + 1) * (root + 1) > a);
    }
}

TEST(circle)
{
    double worst = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        const Angle a = i * 42949u + (i << 3);
        const double truth = std::sin(a * (M_PI / 2147483648.0));
        worst = std::fmax(worst, std::fabs(sine30(a) / 1073741824.0 - truth));
        NEAR(number(sine(a)), truth, STEP + 1e-7);
        NEAR(number(cosine(a)), std::cos(a * (M_PI / 2147483648.0)), STEP + 1e-7);
    }
    // The precision is that stated in the header.
    NEAR(worst, 0, std::ldexp(1.0, -27));
    SAME(sine30(0), 0);
    SAME(sine30(0x40000000u), 0x40000000);
    SAME(sine30(0x80000000u), 0);
    SAME(sine30(0xc0000000u), -0x40000000);
    SAME(cosine30(0), 0x40000000);
    note("sine within 2^%.1f", std::log2(worst));
}

TEST(angles)
{
    SAME(turns(Real(0.25)), 0x40000000u);
    SAME(turns(Real(1.5)), 0x80000000u);
    SAME(turns(Real(-0.25)), 0xc0000000u);
    SAME(turns(Real(3)), 0);
}

TEST(wide_arithmetic)
{
    Random random;
    for (int i = 0; i < 20000; ++i) {
        const int32_t a = static_cast<int32_t>(random.bits()) >> random.below(31);
        const int32_t b = static_cast<int32_t>(random.bits()) >> random.below(31);
        const int32_t c = static_cast<int32_t>(random.bits()) >> random.below(31);
        SAME(mulHigh(a, b), (static_cast<int64_t>(a) * b) >> 32);
        if (c != 0) {
            const int64_t quotient = static_cast<int64_t>(a) * b / c;
            if (quotient == static_cast<int32_t>(quotient))
                SAME(mulDiv(a, b, c), quotient);
        }
        const uint32_t u = random.bits() >> random.below(31), v = random.bits(), w = random.bits() >> random.below(31);
        if (w != 0) {
            const uint64_t top = static_cast<uint64_t>(u) << 32 | v;
            uint32_t rest;
            CHECK(divide64(top, w, &rest) == top / w);
            SAME(rest, top % w);
            CHECK(divide64(top, w) == top / w);
        }
    }
}

#if FB_REAL == FB_FIXED

TEST(fixed_point_rounds_as_stated)
{
    // Products are rounded towards minus infinity, quotients towards zero.
    SAME((Real::fromRaw(-1) * Real(0.5)).raw, -1);
    SAME((Real::fromRaw(1) * Real(0.5)).raw, 0);
    SAME((Real::fromRaw(-1) / Real(2)).raw, 0);
    SAME((Real::fromRaw(3) / Real(2)).raw, 1);
    Random random;
    for (int i = 0; i < 20000; ++i) {
        const int32_t a = static_cast<int32_t>(random.bits()) >> random.below(20);
        const int32_t b = static_cast<int32_t>(random.bits()) >> random.below(20);
        const int64_t product = (static_cast<int64_t>(a) * b) >> 16;
        if (product == static_cast<int32_t>(product))
            SAME((Real::fromRaw(a) * Real::fromRaw(b)).raw, product);
        if (b != 0) {
            const int64_t quotient = static_cast<int64_t>(a) * 65536 / b;
            const bool fits = std::llabs(quotient) < INT32_MAX;
            if (fits)
                SAME((Real::fromRaw(a) / Real::fromRaw(b)).raw, quotient);
        }
    }
}

TEST(fixed_point_division_never_traps)
{
    SAME((Real(1) / Real(0)).raw, INT32_MAX);
    SAME((Real(0) / Real(0)).raw, INT32_MAX);
    SAME((Real(-1) / Real(0)).raw, -INT32_MAX);
    SAME((Real(30000) / Real::fromRaw(1)).raw, INT32_MAX);
    SAME((Real(-30000) / Real::fromRaw(1)).raw, -INT32_MAX);
    SAME((Real(30000) / Real::fromRaw(-1)).raw, -INT32_MAX);
    SAME((Real::fromRaw(INT32_MIN) / Real::fromRaw(1)).raw, -INT32_MAX);
    // A quotient near the end of the range is either correct or the largest number.
    Random random;
    for (int i = 0; i < 200000; ++i) {
        const int32_t a = static_cast<int32_t>(random.bits()), b = static_cast<int32_t>(random.bits()) >> random.below(31);
        if (b == 0)
            continue;
        const int64_t exact = static_cast<int64_t>(a) * 65536 / b;
        const int64_t got = (Real::fromRaw(a) / Real::fromRaw(b)).raw;
        if (std::llabs(exact) < INT32_MAX)
            SAME(got, exact);
        else
            SAME(got, exact < 0 ? -INT32_MAX : INT32_MAX);
    }
}

#endif
