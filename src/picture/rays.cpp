// Rays of sight, one for a pixel, searched from a depth near which the surface should be.
#include "rays.h"

#include "math/whole.h"

namespace {

// No pixel is begun after LOOKS_MOST evaluations of the field in a frame, nor after as many as looksAt() allows.
constexpr int LOOKS_MOST = 3500, LOOKS_AT_ONE = 28000;
// The first step along the ray, 1/128 unit.
constexpr int STEP = 128;
// Upper bounds of findDepth(). STEPS: of the steps along the ray towards a stronger field. MAX_GROWTH: of the ratio of each of them
// to the one before; it is large because the ray may first lead along the surface. THICKEST: of the steps back towards the eye.
constexpr int STEPS = 3, MAX_GROWTH = 5, THICKEST = 12;
// No surface is near a point where the field is this much below the isovalue.
constexpr Real NEAR(0.2);

}  // namespace

int looksAt(Real spacing, int atOne)
{
    const Real cube = max(spacing * spacing * spacing, Real(1));
    return floorToInt(quotient(Real(atOne), cube));
}

Rays::Rays(View& view, FieldProbe& probe, const Tint& tint, Real spacing)
    : view_(view), probe_(probe), tint_(tint),
      looksMost_(probe.model() == nullptr ? 0 : min32(looksAt(spacing, LOOKS_AT_ONE), LOOKS_MOST))
{
}

Real Rays::excess(int at, int depth)
{
    ++looks_;
    int strongest;
    return probe_.implicitAt(view_.pointAt(at, depth), &strongest) - ISOVALUE;
}

// Takes steps of the secant method.
bool Rays::findInside(int at, int* depth, Real* here, int maxGrowth)
{
    for (int i = 0, step = STEP; *here <= Real(0); ++i) {
        if (i == STEPS || *here < -NEAR || *depth + step <= 0 || *depth + step >= Z_EMPTY)
            return false;
        const Real there = excess(at, *depth + step), rise = there - *here;
        const bool rises = rise > Real(0);
        const Real left = rises ? -there : -*here, slope = absolute(rise);
        if (left > slope * Real(maxGrowth))
            return false;
        const int on = left > Real(0) ? floorToInt(quotient(left, slope) * Real(magnitude(step))) + STEP / 4 : 0;
        *depth += rises ? step : 0;
        *here = rises ? there : *here;
        step = (step > 0) == rises ? on : -on;
    }
    return true;
}

bool Rays::findDepth(int at, int* depth)
{
    int outside = *depth;
    Real here = excess(at, outside);
    if (!findInside(at, &outside, &here, MAX_GROWTH))
        return false;
    // From there looks for a point outside, towards the eye, and interpolates between the last two points.
    Real within = here;
    for (int i = 0; here > Real(0); ++i) {
        if (i == THICKEST || outside <= STEP)
            return false;
        within = here;
        outside -= STEP;
        here = excess(at, outside);
    }
    *depth = outside + floorToInt(quotient(-here, within - here) * Real(STEP));
    return true;
}

bool Rays::show(int at, int depth)
{
    const Point p = view_.pointAt(at, depth);
    ++looks_;
    const int strongest = probe_.strongestAt(p);
    const uint8_t entry = strongest < 0 ? 0 : tint_.entry(p, strongest);
    if (entry == 0)
        return false;
    view_.setPixel(at, depth, entry);
    return true;
}
