// Where a path leaves the surface. Most seeds are followed from where they were in the frame before; what is not found there is
// looked for in steps along the path, and bisected.
#include "search.h"

namespace {

// Positions: after a step as short as this another look would change nothing that is seen; and no step is longer than that.
constexpr Real SHORT_STEP(0.05), LONGEST_STEP(0.15);
// Of the field per position: where the field falls by less, Newton's method is not trusted.
constexpr Real FLAT(-0.06);
constexpr int NEWTON_STEPS = 5;
constexpr int BISECTIONS = 12;
// Positions: where a search begins, and its steps.
constexpr Real SEARCH_FIRST(0.88), SEARCH_STEP(0.16);
// Positions: where it is asked after COVERED_AT whether a neighbour is the stronger; and what is looked at between 1 and each of
// the two, in case the path leaves the surface there.
constexpr Real COVERED_LATE(1.62), BETWEEN(1.18), BETWEEN_LATE(1.49);
// Positions: the steps in which a path is followed that has left the surface, and how far it is followed.
constexpr Real RETURN_STEP(0.08), RETURN_FAR(0.4);
// Of the field: a valley this shallow above the isovalue is looked into.
constexpr Real VALLEY(0.12);

}  // namespace

bool follow(Path& path, Real* position, Sample* sample)
{
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        if (absolute(sample->excess) <= TOLERANCE && sample->slope <= FLAT)
            return true;
        if (sample->slope > FLAT)
            return false;
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

namespace {

// Finds where the path leaves the surface between a position inside and one outside.
void bisect(Path& path, Real inside, Real outside, Real* position, Sample* sample)
{
    for (int i = 0; i < BISECTIONS; ++i) {
        *position = shiftDown(inside + outside, 1);
        *sample = path.look(*position);
        if (absolute(sample->excess) <= TOLERANCE)
            break;
        if (sample->slope <= FLAT) {
            const Real step = quotient(-sample->excess, sample->slope);
            const Real to = *position + step;
            if (to > inside && to < outside && absolute(step) <= SHORT_STEP) {
                *position = to;
                break;
            }
        }
        if (sample->excess > Real(0))
            inside = *position;
        else
            outside = *position;
    }
    sample->excess = Real(0);
}

// What was seen at a position.
struct Look {
    Real position;
    Sample sample;
};

inline Look lookAt(Path& path, Real position)
{
    return {position, path.look(position)};
}

// Whether the seed is sure to lie inside a neighbour: from COVERED_AT or COVERED_LATE on that is the stronger one, and the path has
// not left the surface before. `*margin` becomes by how much of the field both hold. Position and sample are those of the last of
// the two that was looked at.
bool isInside(Path& path, Real* position, Sample* sample, Real* margin)
{
    Real lowest(9);
    static constexpr Real PLACES[] = {COVERED_AT, COVERED_LATE};
    for (const Real at : PLACES) {
        if (*position != at)
            *sample = path.look(at);
        *position = at;
        if (sample->excess <= Real(0))
            return false;
        lowest = least(lowest, sample->excess);
        if (sample->dominance <= OVERSHOOT)
            continue;
        lowest = least(lowest, path.look(Real(1)).excess);
        if (lowest < VALLEY)
            lowest = least(lowest, path.look(BETWEEN).excess);
        if (lowest < VALLEY && at == COVERED_LATE)
            lowest = least(lowest, path.look(BETWEEN_LATE).excess);
        *margin = least(lowest, sample->dominance - OVERSHOOT);
        return lowest > Real(0);
    }
    return false;
}

// The lowest place of a valley between two looks. Unless it is too high to matter, its floor is looked for: it is about where a
// slope that changes evenly is 0.
Look floorBetween(Path& path, const Look& a, const Look& b)
{
    const Look& lower = a.sample.excess < b.sample.excess ? a : b;
    if (lower.sample.excess >= VALLEY)
        return lower;
    return lookAt(path, a.position + (b.position - a.position) * (a.sample.slope / (a.sample.slope - b.sample.slope)));
}

}  // namespace

Real search(Path& path, Real* position, Sample* sample)
{
    Real margin;
    if (isInside(path, position, sample, &margin))
        return margin;
    Look before = lookAt(path, SEARCH_FIRST), lowest{SEARCH_FIRST, {Real(9), Real(0), Real(0)}};
    if (before.sample.excess < Real(0)) {
        // The path does not even begin inside: its own field is not half of what the surface takes.
        *position = Real(1);
        *sample = before.sample;
        sample->excess = Real(1);
        return Real(0);
    }
    while (before.position < path.last()) {
        const Look now = lookAt(path, least(before.position + SEARCH_STEP, path.last()));
        Real outside = now.position;
        bool left = now.sample.excess <= Real(0);
        if (!left && before.sample.slope < Real(0) && now.sample.slope > Real(0)) {
            const Look floor = floorBetween(path, before, now);
            left = floor.sample.excess < Real(0);
            outside = floor.position;
            if (!left && floor.sample.excess < lowest.sample.excess)
                lowest = floor;
        }
        if (left) {
            bisect(path, before.position, outside, position, sample);
            return lowest.sample.excess;
        }
        before = now;
        // From there on it is so for good.
        if (before.position >= COVERED_AT && before.sample.dominance > OVERSHOOT)
            break;
    }
    if (before.sample.excess < lowest.sample.excess)
        lowest = before;
    *position = lowest.position;
    *sample = lowest.sample;
    return lowest.sample.excess;
}

bool comesBack(Path& path, Real from, bool far, Real* position, Sample* sample)
{
    const Real left = from, end = far ? path.last() : from + RETURN_FAR, step = far ? SEARCH_STEP : RETURN_STEP;
    while (from < end) {
        const Real outside = from;
        const Sample now = path.look(from += step);
        if (now.excess > Real(0)) {
            if (outside == left)
                return false;
            bisect(path, from, outside, position, sample);
            return true;
        }
        if (now.dominance > OVERSHOOT || (!far && now.excess < -VALLEY))
            return false;
    }
    return false;
}

namespace {

// Whether the path leaves the surface between a place and one farther out; `*from` becomes where it is inside, and `*highest` the
// most that the field exceeds the isovalue by where it was looked at.
bool leaves(Path& path, const Look& inner, const Look& outer, Real* from, Real* highest)
{
    if (outer.sample.excess > Real(0))
        return false;
    *from = inner.position;
    if (inner.sample.excess > Real(0))
        return true;
    if (inner.sample.slope <= Real(0) || outer.sample.slope >= Real(0))
        return false;
    // There is a hill between the two. Its top is about where a slope that changes evenly is 0.
    *from += (outer.position - inner.position) * (inner.sample.slope / (inner.sample.slope - outer.sample.slope));
    const Real top = path.look(*from).excess;
    *highest = most(*highest, top);
    return top > Real(0);
}

}  // namespace

// Far from the surface the steps are long: no field is steeper than steepest(), so the surface cannot be nearer than that allows.
Real searchDeep(Path& path, Real* position, Sample* sample, Real* off)
{
    const bool hollow = path.all().hollow;
    const Real half = quotient(Real(0.5), path.steepest()), end = hollow ? path.last() : path.first();
    Look now = lookAt(path, hollow ? path.first() : path.last());
    Real deepest = now.sample.excess, highest = deepest, inside(0), outside(0);
    *position = now.position;
    *sample = now.sample;
    bool found = false;
    while (now.position != end) {
        const Look before = now;
        const Real step = absolute(before.sample.excess) * half, longer = most(step, SEARCH_STEP);
        now = lookAt(path, hollow ? least(before.position + longer, end) : most(before.position - longer, end));
        if (step > SEARCH_STEP) {
            // Between the two it is no nearer to the surface than this.
            const Real between = shiftDown(shiftDown(before.sample.excess, 1) + now.sample.excess, 1);
            deepest = least(deepest, between);
            highest = most(highest, between);
        }
        const Look &inner = hollow ? before : now, &outer = hollow ? now : before;
        Real from;
        if (leaves(path, inner, outer, &from, &highest)) {
            const bool ours = least(inner.sample.dominance, outer.sample.dominance) <= OVERSHOOT;
            if (ours || !found) {
                inside = from;
                outside = outer.position;
            }
            found = true;
            if (ours || hollow)
                break;
        }
        if (now.sample.excess < deepest) {
            deepest = now.sample.excess;
            *position = now.position;
            *sample = now.sample;
        }
        highest = most(highest, now.sample.excess);
    }
    if (found) {
        bisect(path, inside, outside, position, sample);
        return Real(9);
    }
    sample->excess = Real(1);
    if (highest <= Real(0)) {
        // All that is there lies outside.
        *off = -highest;
        *position = Real(1);
        return Real(0);
    }
    *off = deepest;
    return most(deepest, Real(0));
}
