// Rings of seeds and outlines, for all primitives with round parts (round.h).
#include "model/round.h"

#include "model/sphere.h"
#include "model/stop.h"

namespace {

// A ring of no more seeds than this is so small that it bends noticeably within one seed's cell.
constexpr int POLAR_SEEDS = 12;

// A seed's cell is made a little larger than needed, because half axes are rounded to 1/64 of the spacing.
constexpr Real CELL_SPARE(1.04);

}  // namespace

int stepsIn(Real length, Real spacing)
{
    const int32_t steps = (rawFromReal(length) + rawFromReal(spacing) - 1) / rawFromReal(spacing);
    return steps < 1 ? 1 : steps;
}

namespace {

bool isStretched(const Vector& stretch)
{
    return !(stretch == Vector{Real(1), Real(1), Real(1)});
}

}  // namespace

Quarter::Quarter(const Vector& stretch)
{
    arcs_[0] = arcs_[STEPS] = Real(0);
    if (!isStretched(stretch))
        return;
    for (int i = 0; i < STEPS; ++i) {
        const Angle from = static_cast<Angle>(i) * (QUARTER / STEPS), to = from + QUARTER / STEPS;
        arcs_[i + 1] = arcs_[i] + ::length({stretch.x * (sine(to) - sine(from)), Real(0), stretch.z * (cosine(to) - cosine(from))});
    }
}

Angle Quarter::longitude(Real arc) const
{
    int i = 0;
    while (i < STEPS - 1 && arcs_[i + 1] <= arc)
        ++i;
    const Real step = arcs_[i + 1] - arcs_[i], rest = min(arc - arcs_[i], step);
    const Angle inStep = static_cast<Angle>(mulDiv(rawFromReal(rest), QUARTER / STEPS, rawFromReal(step)));
    return static_cast<Angle>(i) * (QUARTER / STEPS) + inStep;
}

Real Quarter::wayTo(Angle longitude) const
{
    const Angle step = longitude / (QUARTER / STEPS);
    const int i = step < STEPS ? static_cast<int>(step) : STEPS - 1;
    const Angle rest = longitude - static_cast<Angle>(i) * (QUARTER / STEPS);
    return arcs_[i] + portion(arcs_[i + 1] - arcs_[i], static_cast<int32_t>(rest), QUARTER / STEPS);
}

// The factor is the area between a unit step up the surface and one along the ring, divided by the length of the latter.
Real stretchedStep(Real step, const Vector& stretch, Real normalSine, Real normalCosine, Real sine, Real cosine)
{
    const Real area = ::length({stretch.y * stretch.z * normalCosine * sine, stretch.x * stretch.z * normalSine,
                                stretch.x * stretch.y * normalCosine * cosine});
    return step * (area / ::length({stretch.x * cosine, Real(0), stretch.z * sine}));
}

int thinning(Real step, Real spacing)
{
    constexpr Real TOO_CLOSE(0.70710678);
    int level = 0;
    for (; step < spacing * TOO_CLOSE && level < 4; ++level)
        step = shiftUp(step, 1);
    return level;
}

RingMaker::RingMaker(SeedMaker& maker, const Vector& stretch, Real spacing)
    : maker_(maker), stretch_(stretch), spacing_(spacing), stretched_(isStretched(stretch)),
      round_(stretch.x == stretch.z), flat_(max(stretch.x, stretch.z) > shiftUp(min(stretch.x, stretch.z), 1)), quarter_(stretch)
{
}

int RingMaker::seedsOf(const Ring& ring) const
{
    const Real around = ring.around();
    if (!stretched_)
        return seedsInRing(around, spacing_, 1 << 30);
    const int count = floorToInt(shiftUp(around * quarter_.length(), 2) / spacing_);
    const int fewest = flat_ ? 2 : 4;
    return count < fewest ? fewest : count;
}

int RingMaker::addRoots(const Ring& ring)
{
    if (ring.core == Real(0))
        return maker_.addRoot({Real(0), ring.height, Real(0)});
    if (!round_)
        return 0;
    const int count = seedsOf(ring);
    const uint32_t step = 0xffffffffu / static_cast<uint32_t>(count);
    int first = 0;
    for (int i = 0; i < count; ++i) {
        const Angle longitude = static_cast<uint32_t>(i) * step;
        const int root = maker_.addRoot({ring.core * sine(longitude), ring.height, ring.core * cosine(longitude)});
        if (i == 0)
            first = root;
    }
    return first;
}

void RingMaker::addSeeds(const Ring& ring, int k, int root)
{
    if (stretched_) {
        addStretched(ring, k, root);
        return;
    }
    const int count = seedsOf(ring);
    maker_.beginRing();
    if (maker_.countRing(count, ring.core != Real(0)) || stopAsked())
        return;
    const uint32_t step = 0xffffffffu / static_cast<uint32_t>(count);
    // A seed's cell is widest at its outer edge, which makes a difference in the small rings about a pole.
    Real around = ring.around();
    if (count <= POLAR_SEEDS)
        around += ring.halfStep * absolute(ring.normalSine);
    const Real along = around * sine(step / 2) * CELL_SPARE, across = ring.halfStep * CELL_SPARE;
    const int nextRoot = ring.core == Real(0) ? 0 : 1;
    for (int i = 0; i < count; ++i, root += nextRoot) {
        const Angle longitude = static_cast<uint32_t>(i) * step;
        const Real s = sine(longitude), c = cosine(longitude);
        const Real inward = -(across * ring.normalSine);
        maker_.addSeed(root, {ring.pathCosine * s, ring.pathSine, ring.pathCosine * c}, {along * c, Real(0), -(along * s)},
                       {inward * s, across * ring.normalCosine, inward * c});
    }
}

void RingMaker::addMirrored(Ring& ring, int k, int rings, Angle latitude)
{
    const int mirrored = rings - 1 - k;
    if (k == mirrored)
        latitude = 0;
    else if (k > mirrored)
        latitude = 0u - latitude;
    ring.pathSine = ring.normalSine = sine(latitude);
    ring.pathCosine = ring.normalCosine = cosine(latitude);
    const int roots = ring.core == Real(0) ? 1 : seedsOf(ring);
    if (k > mirrored)
        root_ -= roots;
    else
        addRoots(ring);
    addSeeds(ring, k, root_);
    if (k < mirrored)
        root_ += roots;
}

// Places the seeds at equal arc lengths round the ellipse, starting at its sharper end.
void RingMaker::addStretched(const Ring& ring, int k, int root)
{
    const int count = seedsOf(ring);
    const Real around = ring.around(), whole = shiftUp(quarter_.length(), 2);
    const bool sideways = stretch_.x > stretch_.z;
    if (stopAsked())
        return;
    // Half the arc length to the next seed, first on the stretched unit circle, then on this ring.
    Real half = portion(whole, 1, 2 * count) * CELL_SPARE;
    half = count <= POLAR_SEEDS ? half * (around + ring.halfStep * absolute(ring.normalSine)) : half * around;
    const uint32_t step = 0xffffffffu / static_cast<uint32_t>(count);
    bool begun = false;
    int level = 0;
    for (int i = 0; i < count; ++i) {
        Real way = portion(whole, i, count);
        if (sideways)
            way += quarter_.length();
        int turns = 0;
        for (; way >= quarter_.length() && turns < 4; ++turns)
            way -= quarter_.length();
        Angle longitude = static_cast<Angle>(i) * step;
        if (!round_)
            longitude = static_cast<Angle>(turns) * QUARTER +
                        ((turns & 1) == 0 ? quarter_.longitude(way) : QUARTER - quarter_.longitude(quarter_.length() - way));
        const Real s = sine(longitude), c = cosine(longitude);
        // On a circle the level is the same all round.
        if (!round_ || i == 0)
            level = thinning(stretchedStep(shiftUp(ring.halfStep, 1), stretch_, ring.normalSine, ring.normalCosine, s, c),
                             spacing_);
        if (thinned(k, level))
            continue;
        if (!begun)
            maker_.beginRing();
        begun = true;
        const Real along = half / ::length({stretch_.x * c, Real(0), stretch_.z * s});
        const Real across = shiftUp(ring.halfStep * CELL_SPARE, level), inward = -(across * ring.normalSine);
        const int own = ring.core == Real(0) ? root
                        : round_             ? root + i
                                             : maker_.addRoot({ring.core * s, ring.height, ring.core * c});
        maker_.addSeed(own, {ring.pathCosine * s, ring.pathSine, ring.pathCosine * c}, {along * c, Real(0), -(along * s)},
                       {inward * s, across * ring.normalCosine, inward * c});
    }
}

Outline::Outline(const Vector& stretch)
    : stretch_(stretch), widest_(max(stretch.x, stretch.z)), stretched_(isStretched(stretch))
{
    before_[0] = after_[0] = Real(0);
}

void Outline::add(Real length, Real factor)
{
    before_[parts_ + 1] = before_[parts_] + length;
    after_[parts_ + 1] = after_[parts_] + length * factor;
    ++parts_;
}

void Outline::plain(Real length)
{
    add(length, Real(1));
}

void Outline::line(Real length, Real normalSine, Real normalCosine)
{
    add(length, ::length({widest_ * normalSine, stretch_.y * normalCosine, Real(0)}));
}

void Outline::arc(Real length, Angle from, Angle to)
{
    if (!stretched_) {
        add(length, Real(1));
        return;
    }
    const int32_t turn = static_cast<int32_t>(to - from) / (2 * ARC_PARTS);
    const Real before = before_[parts_];
    for (int i = 0; i < ARC_PARTS; ++i) {
        const Angle latitude = from + static_cast<Angle>(turn * (2 * i + 1));
        line(before + portion(length, i + 1, ARC_PARTS) - before_[parts_], sine(latitude), cosine(latitude));
    }
}

Real Outline::at(int32_t part, int32_t of, Real* step) const
{
    const Real way = portion(length(), part, of);
    *step = portion(length(), 1, of);
    if (!stretched_)
        return way;
    int i = 0;
    while (i < parts_ - 1 && after_[i + 1] <= way)
        ++i;
    const Real before = before_[i + 1] - before_[i], after = after_[i + 1] - after_[i];
    if (after == Real(0))
        return before_[i];
    const Real share = before / after;
    *step = *step * share;
    return before_[i] + min((way - after_[i]) * share, before);
}

void layOutCapsule(SeedMaker& maker, const Vector& stretch, Real radius, Real half, Real spacing)
{
    // The outline is a quarter circle, the side and a quarter circle. The rings lie in the middles of equal parts of it.
    const Real cap = radius * HALF_PI, body = shiftUp(half, 1);
    Outline outline(stretch);
    outline.arc(cap, 0u - QUARTER, 0);
    outline.line(body, Real(0), Real(1));
    outline.arc(cap, 0, QUARTER);
    const int rings = stepsIn(outline.length(), spacing);
    RingMaker ringMaker(maker, stretch, spacing);
    Ring ring{};
    ring.radius = radius;
    int bottom = -1, top = -1;
    for (int k = 0; k < rings; ++k) {
        const Real at = outline.at(2 * k + 1, 2 * rings, &ring.halfStep);
        Angle latitude = 0;
        int* shared = nullptr;
        if (at < cap) {
            latitude = quarterTurn(at, cap) - QUARTER;
            ring.height = -half;
            shared = &bottom;
        } else if (at < cap + body) {
            ring.height = at - cap - half;
        } else {
            latitude = quarterTurn(min(at - cap - body, cap), cap);
            ring.height = half;
            shared = &top;
        }
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        // "In the case of cylinders, all seeds in each end cap have a common root."
        int root = shared == nullptr ? -1 : *shared;
        if (root < 0)
            root = ringMaker.addRoots(ring);
        if (shared != nullptr)
            *shared = root;
        ringMaker.addSeeds(ring, k, root);
    }
}
