// What only dents and hollows need. Where something digs into an object the surface has a hollow, and two sets of seeds sample its
// wall: those of the dented object and those of the digging one. This file decides who samples which part of the wall, and how long
// a seed waits that is not on the wall, or not in its own part of it.
#include "border.h"
#include "model/round.h"
#include "settle.h"

namespace {

// Spacings: a seed up to this far beyond the border of its part still has a scale that reaches into its part.
constexpr Real BEYOND_PART(1.5);
// Units: additional overlap of the scales at that border, because it is found only to first order.
constexpr Real OVERLAP(0.18);
// Upper bound on how far the border of two parts of a hollow's wall moves when the digging object moves by one unit.
constexpr Real BORDER_SPEED(16);
// Distance of a patch's paths where one of them is judged for all, as a multiple of their distance at rest.
constexpr Real APART(1.25);
// The position at which the field tells whether the surface has closed again over a hollow.
constexpr Real CLOSING(0.95);

// ---- Who samples the wall

// The neighbour that a seed shares the wall with.
struct Rival {
    const Neighbour* near;  // null: there is none
    Vector from;            // vector from its core to the seed
    Real steepest;          // steepness of its field at the seed, times half the squared size of the seed's object
};

// The rival of a seed is the neighbour whose field is the steepest at the seed: for a seed of the dented object, among those whose
// seeds sample a hollow in it; for a seed that samples a hollow, among those that dig, and the dented object.
Rival rivalOf(const Path& path, Real position)
{
    const Neighbourhood& all = path.all();
    const Neighbour* const host = path.host();
    Rival rival{nullptr, {Real(0), Real(0), Real(0)}, Real(0)};
    for (int i = 0; i < path.touched(); ++i) {
        const Neighbour& near = path.near(i);
        if (near.slope == Real(0) || !(all.hollow ? near.digs || &near == host : near.samples))
            continue;
        const Vector v = path.fromCore(near, path.from(position));
        const Real steep = -(near.slope * near.ratio * nearLength(v) * (near.digs ? near.weight : Real(1)));
        if (steep > rival.steepest)
            rival = {&near, v, steep};
    }
    return rival;
}

// About the unit vector in the direction of a vector; a zero vector stays as it is.
Vector quickUnit(const Vector& v)
{
    const Real size = lengthQuick(v);
    return size == Real(0) ? v : Vector{quotient(v.x, size), quotient(v.y, size), quotient(v.z, size)};
}

// The lead of a seed's object over its rival is by how much more steeply its field falls. With g minus the gradient of all fields
// together, and a and b unit vectors away from the own and the rival's core, the lead is (g.a + g.b) / (1 + a.b). Without other
// fields that is the difference of the two steepnesses; returned is what the other fields add to this. `out` has the direction of
// a, `own` is the steepness of the own field.
SELDOM Real leadOfOthers(const Vector& g, const Vector& out, Real own, const Rival& rival)
{
    const Vector a = quickUnit(out), b = quickUnit(rival.from);
    const Vector others = g - a * own + b * rival.steepest;
    return dot(others, a + b) / max(Real(1) + dot(a, b), Real(0.05));
}

// The lead of a seed's object over its rival; `out` leads away from the own core, and `g` is the direction outward.
Real leadOf(const Path& path, const Vector& out, const Vector& g, const Rival& rival)
{
    const bool hollow = path.all().hollow;
    Real own = -(path.ownSlope() * nearLength(out));
    if (hollow)
        own = own * path.all().weight;
    const Real lead = own - rival.steepest;
    // Beside a far smaller neighbour `g` is scaled, and the others' part of the lead is left out.
    if (path.touched() <= 1 || path.gradientShift() != 0)
        return lead;
    return lead + leadOfOthers(hollow ? -g : g, out, own, rival);
}

// By how much the steepness of a digging field changes when its core is a unit farther away: the derivative of -F' r, which is
// -F' - 2 t F'', times `factor`. `slope` is -F', and F'' is 34/9 - 24/9 t.
Real changeOf(Real slope, Real t, Real strength, Real factor)
{
    return (slope - strength * t * (Real(68.0 / 9) - t * Real(48.0 / 9))) * factor;
}

// The wall of a hollow is sampled twice: by the paths of the dented object, and by those of the digging one. Each object has the
// part where its paths are nearer to the normal: where its own field is the steeper one, if there are no others. Returns how far a
// seed that has just settled lies on its own side of the border of the two parts: units, to first order. If that is at most
// `margin` to either side, the function sets the seed's border. `*g`, the direction outward, then becomes that in the middle of
// what the border leaves of the seed's cell, because at a sharp rim the two differ.
Real findOwnPart(Path& path, Seed& s, Real margin, Vector* g)
{
    const SoftObject& object = path.object();
    const bool hollow = path.all().hollow;
    const Vector out = object.slants() ? path.ownGradient(s.position, Real(1)) : path.from(s.position);
    const Rival rival = rivalOf(path, s.position);
    if (rival.near == nullptr)
        return BORDER_FAR;
    const Real lead = leadOf(path, out, *g, rival);
    // The vector from the core of the digging object.
    const Neighbour& other = *rival.near;
    const Vector wall = hollow ? out : rival.from;
    const Real rate = hollow ? changeOf(-path.ownSlope(), path.ownParam(s.position), object.strength(), path.all().weight)
                             : changeOf(-other.slope, other.t, other.strength, other.weight * other.ratio);
    const Real change = absolute(rate);
    const Real apart = absolute(lead) < change * BORDER_FAR ? lead / change : lead < Real(0) ? -BORDER_FAR : BORDER_FAR;
    if (absolute(apart) > margin)
        return apart;
    s.apart = static_cast<int16_t>(rawFromReal(apart + OVERLAP) >> 8);
    s.border = directionOf(normalise((rate < Real(0)) == hollow ? -wall : wall));
    const Real half = shiftDown(object.spacing() * s.position, 1);
    if (apart < half) {
        const Real turn = change * shiftDown(half - max(apart, -half), 1);
        const Vector across = withLength(hollow ? -wall : wall, hollow ? turn : min(turn, rival.steepest));
        *g = *g + across * realFromRaw(65536 >> path.gradientShift());
    }
    return apart;
}

}  // namespace

// Decides whether a seed that has found the surface samples it. Returns false when the rival samples that part of the wall.
bool Settler::findDented(Seed& s, Vector* g)
{
    const Real margin = object_.spacing() * BEYOND_PART, apart = findOwnPart(path_, s, margin, g);
    if (apart < -margin) {
        s.flags |= SEED_FOLLOW;
        putOff(s, -apart - margin, BORDER_SPEED);
        return false;
    }
    if (apart < margin)
        s.flags |= SEED_BORDER;
    return true;
}

// Whether the surface has closed over a hollow, so that a path that led into it may leave the surface farther out again.
bool Settler::hasClosed(const Seed& s)
{
    Sample sample;
    path_.begin(nearby_.listed(), s, CLOSING, &sample);
    return sample.excess > Real(0);
}

// ---- Seeds off the surface wait

// Lets a seed wait that is off the surface, or outside its own part of it: the field would have to change by `hold`, and it changes
// by at most `gradientBound` when the neighbours come nearer by a unit. The wait may be longer if all neighbours reach the path
// already. A neighbour that does not is not part of the bound, but its field begins gently and does not matter within GATHER_SLACK.
void Settler::putOff(Seed& s, Real hold, Real gradientBound) const
{
    s.flags |= SEED_OFF;
    const Real longest = path_.touched() == all_.count ? LONGEST_WAIT : GATHER_SLACK;
    s.due = static_cast<uint16_t>(patch_->travelled + travelUntil(hold, gradientBound, longest));
}

bool Settler::isOff(const Patch& patch, const Seed& s)
{
    return (s.flags & SEED_OFF) && static_cast<int16_t>(patch.travelled - s.due) < 0;
}

// The state of a patch whose middle seed has just been found off the surface: PATCH_OFF if all of the patch is off it. At one
// position the own field is about the same on all paths of the patch, and near the surface the paths are little farther apart than
// where the seeds rest.
PatchState Settler::probeOff(const Patch& patch, Seed& s) const
{
    if (s.flags & SEED_FOLLOW)
        return PATCH_MIXED;
    const Real hold = off_ - gradientBound_ * realFromRaw(patch.tight << 12) * APART;
    if (hold <= Real(0))
        return PATCH_MIXED;
    putOff(s, hold, gradientBound_);
    return PATCH_OFF;
}
