// Where a path leaves the surface. Most seeds are followed from where they were in the frame before. If that fails, the path is
// searched in steps, and the crossing found by bisection.
#include "search.h"

#include "math/whole.h"
#include "model/round.h"

namespace {

constexpr int BISECTIONS = 12;
// The search of a whole path takes no more steps than this, however steep neighbours are: they are a unit long on a path of thirty.
constexpr int STEPS_MOST = 64;
// Positions: where a search begins, and the length of its steps.
constexpr Real SEARCH_FIRST(0.88), SEARCH_STEP(0.16);
// Positions: COVERED_LATE is tested after COVERED_AT for a neighbour that is stronger; BETWEEN and BETWEEN_LATE are evaluated in
// case the path leaves the surface between position 1 and these two.
constexpr Real COVERED_LATE(1.62), BETWEEN(1.18), BETWEEN_LATE(1.49);
// In units of the field: where it comes this near to the isovalue from above, the path may leave the surface beside that place.
constexpr Real VALLEY(0.12);
// In units of the field: how far the field may be off the cubic curve that stands for it.
constexpr Real CUBIC_SPARE(0.03);
// The result of crossings() where the surface may be crossed more than once.
constexpr int MORE = 2;

}  // namespace

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

namespace {

// A position and the sample taken there.
struct Look {
    Real position;
    Sample sample;
};

inline Look lookAt(Path& path, Real position)
{
    return {position, path.look(position)};
}

// The position between two looks where the slope is 0, if it changes linearly.
Real turnBetween(const Look& a, const Look& b)
{
    return a.position + (b.position - a.position) * (a.sample.slope / (a.sample.slope - b.sample.slope));
}

}  // namespace

bool isInside(Path& path, Real* position, Sample* sample, Real* margin)
{
    Real lowest(9);
    static constexpr Real PLACES[] = {COVERED_AT, COVERED_LATE, FAINT_AT};
    const int places = path.all().claims ? 3 : 2;
    for (int i = 0; i < places; ++i) {
        const Real at = PLACES[i];
        if (*position != at)
            *sample = path.look(at);
        *position = at;
        if (sample->excess <= Real(0))
            return false;
        lowest = min(lowest, sample->excess);
        // Beyond FAINT_AT a seed shows nothing that belongs to another object, whatever its claim.
        const Real dominance = at == FAINT_AT ? path.fieldLead() : sample->dominance;
        if (dominance <= OVERSHOOT)
            continue;
        lowest = min(lowest, path.look(Real(1)).excess);
        if (lowest < VALLEY)
            lowest = min(lowest, path.look(BETWEEN).excess);
        if (lowest < VALLEY && at != COVERED_AT)
            lowest = min(lowest, path.look(BETWEEN_LATE).excess);
        *margin = min(lowest, dominance - OVERSHOOT);
        return lowest > Real(0);
    }
    return false;
}

Real search(Path& path, Real* position, Sample* sample)
{
    Real margin;
    if (isInside(path, position, sample, &margin))
        return margin;
    Look before = lookAt(path, SEARCH_FIRST), lowest{SEARCH_FIRST, {Real(9), Real(0), Real(0)}};
    if (before.sample.excess < Real(0)) {
        // Neighbours without a link to the object pull the body's field below the own one: the path leaves the surface before, or
        // it does not even begin inside.
        if (path.look(path.first()).excess > Real(0)) {
            bisect(path, path.first(), before.position, position, sample);
            return Real(9);
        }
        *position = Real(1);
        *sample = before.sample;
        sample->excess = Real(1);
        return Real(0);
    }
    while (before.position < path.last()) {
        const Look now = lookAt(path, min(before.position + SEARCH_STEP, path.last()));
        Real outside = now.position;
        bool left = now.sample.excess <= Real(0);
        if (!left && before.sample.slope < Real(0) && now.sample.slope > Real(0)) {
            const Look floor = lookAt(path, turnBetween(before, now));
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
        // Beyond COVERED_AT, a neighbour that is stronger stays stronger.
        if (before.position >= COVERED_AT && before.sample.dominance > OVERSHOOT)
            break;
    }
    if (before.sample.excess < lowest.sample.excess)
        lowest = before;
    *position = lowest.position;
    *sample = lowest.sample;
    return lowest.sample.excess;
}

bool comesBack(Path& path, Real from, Real weakest, Real* outside, Real* inside)
{
    Look before = lookAt(path, from);
    bool out = before.sample.excess <= TOLERANCE;
    while (before.position < path.last() && path.ownField() > weakest) {
        const Look now = lookAt(path, min(before.position + SEARCH_STEP, path.last()));
        const bool isOut = now.sample.excess <= Real(0);
        // Between two positions outside, the field may rise above the isovalue and fall again.
        const bool hill = isOut && before.sample.slope > Real(0) && now.sample.slope < Real(0);
        *outside = before.position;
        *inside = hill ? turnBetween(before, now) : now.position;
        if (out && (hill ? path.look(*inside).excess > Real(0) : !isOut))
            return true;
        if (now.sample.dominance > OVERSHOOT)
            return false;
        out = isOut;
        before = now;
    }
    return false;
}

bool leavesAgain(Path& path, Real* inside, Real* outside)
{
    for (Real to = *inside; to < path.last(); *inside = to) {
        to = min(to + SEARCH_STEP, path.last());
        const Sample now = path.look(to);
        *outside = to;
        if (now.excess <= Real(0))
            return true;
        if (now.dominance > OVERSHOOT)
            return false;
    }
    return false;
}

namespace {

// The search of a whole path, of a weak object or where something digs: where the path leaves the surface, or how far off the
// surface all of it is.
class DeepSearch {
public:
    explicit DeepSearch(Path& path) : path_(path), hollow_(path.all().hollow), smoothStep_(path.smoothStep()) {}

    // Searches from one position to another, outwards or inwards.
    void run(Real from, Real to);

    bool found() const { return found_; }
    Real gradientBound() const { return gradientBound_; }
    Real inside() const { return inside_; }
    Real outside() const { return outside_; }
    // The least and the greatest excess of the field over the isovalue; and the position and the sample of the least one.
    Real deepest() const { return deepest_; }
    Real highest() const { return highest_; }
    Real deepestAt() const { return deepestAt_; }
    const Sample& deepestSample() const { return deepestSample_; }

private:
    bool scan(const Look& begin, const Look& end);
    void add(const Look& at);
    bool leaves(const Look& inner, const Look& outer, Real* from);
    int crossings(const Look& begin, const Look& end);

    Path& path_;
    const bool hollow_;
    const Real smoothStep_;
    bool found_ = false;
    Real inside_{0}, outside_{0};
    Real gradientBound_{0};
    Real deepest_{9}, highest_{-9}, deepestAt_{1};
    Sample deepestSample_{Real(9), Real(0), Real(0)};
};

void DeepSearch::run(Real from, Real to)
{
    const int steps = min32(stepsIn(absolute(to - from), smoothStep_), STEPS_MOST);
    Look before = lookAt(path_, from);
    add(before);
    for (int i = 1; i <= steps; ++i) {
        const Look now = lookAt(path_, i < steps ? from + portion(to - from, i, steps) : to);
        add(now);
        if (scan(before, now))
            return;
        before = now;
    }
}

// Takes a look into account.
void DeepSearch::add(const Look& at)
{
    highest_ = max(highest_, at.sample.excess);
    gradientBound_ = max(gradientBound_, path_.gradientBound());
    if (at.sample.excess >= deepest_)
        return;
    deepest_ = at.sample.excess;
    deepestAt_ = at.position;
    deepestSample_ = at.sample;
}

// Whether the path leaves the surface between two looks a step apart; if so, it is inside at `*from`.
bool DeepSearch::leaves(const Look& inner, const Look& outer, Real* from)
{
    if (outer.sample.excess > Real(0))
        return false;
    *from = inner.position;
    if (inner.sample.excess > Real(0))
        return true;
    if (inner.sample.slope <= Real(0) || outer.sample.slope >= Real(0))
        return false;
    // There is a hill between the two looks.
    *from = turnBetween(inner, outer);
    const Real top = path_.look(*from).excess;
    highest_ = max(highest_, top);
    return top > Real(0);
}

// The field between two looks is taken for a cubic curve, which crosses the isovalue no more often than the polygon of its four
// control points does. Returns how often the field crosses it: 0, 1, or MORE if it may do so more than once. If 0, the field comes
// no nearer to the isovalue than the control points (less CUBIC_SPARE), which updates the least and the greatest excess.
int DeepSearch::crossings(const Look& begin, const Look& end)
{
    const Real third = (end.position - begin.position) * Real(1.0 / 3);
    const Real one = begin.sample.excess + begin.sample.slope * third, other = end.sample.excess - end.sample.slope * third;
    // Excess counts as positive on the side of the isovalue where the first look lies.
    const bool outside = begin.sample.excess <= Real(0);
    const auto off = [&](Real excess) { return outside ? -excess : excess; };
    const Real a = off(begin.sample.excess), b = off(end.sample.excess);
    const Real nearest = min(min(a, b), min(off(one), off(other))) - CUBIC_SPARE;
    if (nearest > Real(0)) {
        deepest_ = min(deepest_, off(nearest));
        highest_ = max(highest_, off(nearest));
        return 0;
    }
    const auto clear = [](Real excess) { return absolute(excess) > CUBIC_SPARE; };
    const bool allClear = clear(a) && clear(b) && clear(one) && clear(other);
    return a > Real(0) && b < Real(0) && allClear && (off(one) > Real(0) || off(other) < Real(0)) ? 1 : MORE;
}

// Searches between two looks, the half nearer to `begin` first. Returns true when the search has found what it wants and may end.
bool DeepSearch::scan(const Look& begin, const Look& end)
{
    const Look &inner = hollow_ ? begin : end, &outer = hollow_ ? end : begin;
    const bool ownInner = inner.sample.dominance <= OVERSHOOT, ownOuter = outer.sample.dominance <= OVERSHOOT;
    const Real step = absolute(begin.position - end.position);
    const int count = crossings(begin, end);
    if (count == 0)
        return false;
    if (step > SEARCH_STEP && (count == MORE || ownInner != ownOuter)) {
        const Look middle = lookAt(path_, shiftDown(begin.position + end.position, 1));
        add(middle);
        return scan(begin, middle) || scan(middle, end);
    }
    Real from;
    if (!leaves(inner, outer, &from))
        return false;
    const bool ours = ownInner || ownOuter;
    if (ours || !found_) {
        inside_ = from;
        outside_ = outer.position;
    }
    found_ = true;
    return ours || hollow_;
}

}  // namespace

Real searchDeep(Path& path, Real* position, Sample* sample, Real* off, Real* gradientBound)
{
    const bool hollow = path.all().hollow;
    DeepSearch search(path);
    search.run(hollow ? path.first() : path.last(), hollow ? path.last() : path.first());
    *gradientBound = search.gradientBound();
    if (search.found()) {
        bisect(path, search.inside(), search.outside(), position, sample);
        return Real(9);
    }
    *position = search.deepestAt();
    *sample = search.deepestSample();
    sample->excess = Real(1);
    if (search.highest() <= Real(0)) {
        // The whole path lies outside.
        *off = -search.highest();
        *position = Real(1);
        return Real(0);
    }
    *off = search.deepest();
    return max(*off, Real(0));
}
