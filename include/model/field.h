// The implicit function of one primitive: the "Geoff" blending function (report, Appendix A, Implicit Function). Knows no
// objects.
//
//     F(t) = 1 - 22/9 t + 17/9 t^2 - 4/9 t^3,   t = r^2 / R^2
//
// r is the distance from the core and R the size of the primitive, where the field reaches zero. A polynomial in r^2 needs no
// square root. F(0) = 1, F(1/4) = 1/2, F(1) = 0, and the slope at t = 1 is 0 too, so the field ends smoothly.
#ifndef FB_FIELD_H
#define FB_FIELD_H

#include "math/real.h"

// "In the FB system, I use an isovalue of 0.5": the unblended surface lies at r = R/2.
constexpr Real ISOVALUE(0.5);

// F and dF/dt for t >= 0; both are 0 from t = 1 on.
inline Real geoff(Real t)
{
    if (t >= Real(1))
        return Real(0);
    return Real(1) - t * (Real(22.0 / 9) - t * (Real(17.0 / 9) - t * Real(4.0 / 9)));
}

inline Real geoffSlope(Real t)
{
    if (t >= Real(1))
        return Real(0);
    return t * (Real(34.0 / 9) - t * Real(12.0 / 9)) - Real(22.0 / 9);
}

// The table: F and dF/dt at the middle of each of FIELD_STEPS equal steps of t from 0 to 1.
struct FieldStep {
    Real value;
    Real slope;
};
constexpr int FIELD_STEPS = 256;
extern FieldStep fieldSteps[FIELD_STEPS];

// Fills the table. Call once before any object is updated.
void makeFieldSteps();

// F and dF/dt for 0 <= t < 1 from the table, interpolating F linearly within a step. The errors are at most 2e-5 and 0.008.
inline FieldStep geoffQuick(Real t)
{
    const int32_t raw = rawFromReal(t), off = (raw & 255) - 128;
    const FieldStep& step = fieldSteps[raw >> 8];
    // Both factors are so small that their product fits 32 bits.
    return {step.value + realFromRaw(rawFromReal(step.slope) * off >> 16), step.slope};
}

#endif
