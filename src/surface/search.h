// Search: where a path leaves the surface, found by Newton's method from the seed's last position, or along the whole path.
#ifndef FB_SEARCH_H
#define FB_SEARCH_H

#include "path.h"

// In units of the field: where the field differs from the isovalue by no more, a seed is on the surface.
constexpr Real TOLERANCE(0.004);
// Positions: after a step of Newton's method as short as SHORT_STEP another evaluation would change nothing visible; LONGEST_STEP
// limits the steps.
constexpr Real SHORT_STEP(0.05), LONGEST_STEP(0.15);
// Slope of the field per position: where the field falls less steeply, Newton's method is not trusted.
constexpr Real FLAT(-0.06);
constexpr int NEWTON_STEPS = 5;

// Newton's method, from the sample at `*position`, which is on the surface if the field differs from the isovalue by no more than
// TOLERANCE. Returns true when it ends with `*position` on the surface; `*sample` was then taken there or a short step before.
inline bool follow(Path& path, Real* position, Sample* sample);

// Whether a seed lies inside a neighbour, judged at a few positions: from COVERED_AT on, or from a certain position farther out,
// the neighbour is the stronger one, and the path does not leave the surface before. (Where claims are not fields, FAINT_AT is such
// a place, too.) If so, `*margin` becomes the least amount of the field by which these conditions hold. `*position` and `*sample`
// become those of the last of these positions that was evaluated.
bool isInside(Path& path, Real* position, Sample* sample, Real* margin);

// Searches for the first position where the path leaves the surface. `*position` and `*sample` become that position and the sample
// there. Where the path never leaves the surface, `*position` is about where the field is lowest, and the excess of `*sample` is
// above 0. Returns the least excess in the valleys before that position: how nearly the path left the surface earlier.
Real search(Path& path, Real* position, Sample* sample);

// Searches the path of a weak object, or of one that something digs into, for the last position where it leaves the surface,
// because the surface there hides the surface farther in. On a path that samples a hollow it searches for the first one. Positions
// where a neighbour is the stronger one count only if there are no others. Where there is none at all, `*off` becomes the amount of
// the field by which the path misses the surface. `*gradientBound` bounds the change of that when the neighbours come nearer by one
// unit.
SELDOM Real searchDeep(Path& path, Real* position, Sample* sample, Real* off, Real* gradientBound);

// Whether the current path comes back to the surface beyond position `from`, however far the field falls in between, while the own
// object is the strongest and its field above `weakest`. The path comes back between `*outside` and `*inside`.
bool comesBack(Path& path, Real from, Real weakest, Real* outside, Real* inside);

// Whether the current path then leaves the surface again: between `*inside`, which moves on, and `*outside`. Returns false when
// another object becomes the stronger one before, or the path ends.
bool leavesAgain(Path& path, Real* inside, Real* outside);

// Finds where the path crosses the surface between a position inside and one outside; the excess of `*sample` becomes 0.
void bisect(Path& path, Real inside, Real outside, Real* position, Sample* sample);

inline bool follow(Path& path, Real* position, Sample* sample)
{
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        if (sample->slope > FLAT)
            return false;
        if (absolute(sample->excess) <= TOLERANCE)
            return true;
        const Real step = clamp(quotient(-sample->excess, sample->slope), -LONGEST_STEP, LONGEST_STEP);
        *position += step;
        if (*position < path.first() || *position > path.last())
            return false;
        if (absolute(step) <= SHORT_STEP)
            return true;
        *sample = path.look(*position);
    }
    return false;
}

#endif
