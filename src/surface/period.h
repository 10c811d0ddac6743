// Coherence over time: how long something that changes evenly may go on by its last steps before it is found anew. Shared by
// reckon.h, where seeds go on, and keeper.h, where voxels do.
#ifndef FB_PERIOD_H
#define FB_PERIOD_H

#include "math/real.h"

// It is found anew once in a period of 1, 2, 4 or 8 frames.
constexpr int LONGEST_PERIOD = 8;

// Units: a greater spacing counts as this one.
constexpr Real COARSE(2);

// The error of a single step that is tolerated, 1/256 unit. It grows with the square of the seeds' spacing, because who wants finer
// seeds wants to see more. At COARSE it is 1/4 unit.
inline int32_t toleratedError(Real spacing)
{
    constexpr Real TOLERATED(16);
    const Real counted = min(spacing, COARSE);
    return rawFromReal(counted * counted * TOLERATED) >> 16;
}

// Corrects a step that has led from `before` elsewhere than to `now`; 2^shift such steps were made. Returns about the error.
template <class Step>
inline int32_t correctStep(int32_t now, int32_t before, int shift, Step& step)
{
    const int32_t error = now - before - step;
    step = static_cast<Step>(step + (error >> shift));
    return error ^ error >> 31;
}

// The next period, from the last one and from the error at the end of that.
inline int periodAfter(int period, int32_t error, int32_t tolerated)
{
    if (error < (period == 1 ? tolerated : tolerated / 2))
        return period < LONGEST_PERIOD ? period * 2 : period;
    if (period == 1 || error >= tolerated * 8)
        return 1;
    return error < (period == 2 ? tolerated * 4 : tolerated * 2) ? period : period / 2;
}

#endif
