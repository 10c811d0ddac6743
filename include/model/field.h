// The implicit function of one primitive: the "Geoff" blending function (report, Appendix A, Implicit Function).
//
//     F(t) = 1 - 22/9 t + 17/9 t^2 - 4/9 t^3,   t = r^2 / R^2
//
// r is the distance to the core, R the size of the primitive, where the field reaches zero. A polynomial in r^2 needs no
// square root. F(0) = 1, F(1/4) = 1/2, F(1) = 0, and the slope at t = 1 is 0 too, so the field ends smoothly.
#ifndef FB_FIELD_H
#define FB_FIELD_H

#include "math/real.h"

// "In the FB system, I use an isovalue of 0.5": the unblended surface lies at r = R/2.
constexpr Real ISOVALUE(0.5);

// F and dF/dt. `t` is 0 or more; from 1 on both are 0.
Real geoff(Real t);
Real geoffSlope(Real t);

// F and dF/dt together, for the loop that settles seeds: from a table of steps of 1/1024 in t, value good to 0.0013 and
// slope to 0.003, without a multiplication. 0 <= t < 1.
struct FieldStep {
    Real value;
    Real slope;
};
constexpr int FIELD_STEPS = 1024;
extern FieldStep fieldSteps[FIELD_STEPS];

// The own field of an object along a seed's path by steps of 1/1024 of the position p, as t = p^2 / 4: F, dF/dt and dF/dp. And
// dF/dt of the neighbour's if the two make up the isovalue there.
// OWN_FIRST / 1024 <= p < (OWN_FIRST + OWN_STEPS) / 1024.
struct OwnStep {
    Real value;
    Real slope;
    Real steep;
    Real otherSlope;
};
constexpr int OWN_FIRST = 940;
constexpr int OWN_STEPS = 1000;
extern OwnStep ownSteps[OWN_STEPS];

inline const OwnStep& ownQuick(Real position)
{
    // In bytes, for one shift less.
    static_assert(sizeof(OwnStep) == 16 || FB_REAL != FB_FIXED, "a shift tells where a step lies");
#if FB_REAL == FB_FIXED
    const intptr_t from = reinterpret_cast<intptr_t>(ownSteps) - OWN_FIRST * static_cast<intptr_t>(sizeof(OwnStep));
    return *reinterpret_cast<const OwnStep*>(from + (position.raw >> 2 & ~15));
#else
    return ownSteps[(rawFromReal(position) >> 6) - OWN_FIRST];
#endif
}

// Fills both tables. Call once before any object is updated.
void makeFieldSteps();

inline const FieldStep& geoffQuick(Real t)
{
    return fieldSteps[rawFromReal(t) >> 6];
}

#endif
