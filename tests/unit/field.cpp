// Tests of the Geoff function and its table against the polynomial in double precision.
#include "model/field.h"

#include "help.h"
#include "test.h"

TEST(geoff_function)
{
    NEAR(number(geoff(Real(0))), 1, 0);
    NEAR(number(geoff(Real(0.25))), 0.5, 4 * STEP + EXACT * 4);
    NEAR(number(geoff(Real(1))), 0, 0);
    NEAR(number(geoff(Real(7))), 0, 0);
    NEAR(number(geoffSlope(Real(1))), 0, 0);
    NEAR(number(geoffSlope(Real(0))), -22.0 / 9, 2 * STEP + EXACT * 4);
    // The field ends smoothly: value and slope just inside t = 1.
    NEAR(number(geoff(Real(0.999))), 0, 1e-4);
    NEAR(number(geoffSlope(Real(0.999))), 0, 0.01);
    for (int i = 0; i < 65536; i += 7) {
        const Real t = realFromRaw(i);
        NEAR(number(geoff(t)), trueGeoff(number(t)), 4 * STEP + EXACT * 8);
        NEAR(number(geoffSlope(t)), trueSlope(number(t)), 5 * STEP + EXACT * 8);
        CHECK(geoff(t) + Real(4 * 0.0000153) >= geoff(realFromRaw(i + 7)));
    }
}

TEST(field_table_is_as_good_as_stated)
{
    double value = 0, slope = 0;
    for (int i = 0; i < 65536; ++i) {
        const Real t = realFromRaw(i);
        const FieldStep& step = geoffQuick(t);
        const Real f = step.value, s = step.slope;
        value = std::fmax(value, std::fabs(number(f) - trueGeoff(number(t))));
        slope = std::fmax(slope, std::fabs(number(s) - trueSlope(number(t))));
    }
    note("value within %.5f, slope within %.5f", value, slope);
    CHECK(value <= 0.00003);
    CHECK(slope <= 0.008);
}

TEST(isovalue_is_the_report_s)
{
    NEAR(number(ISOVALUE), 0.5, 0);
}
