// What only dents and hollows need. Where something digs into an object the surface has a hollow, and two sets of seeds sample its
// wall: those of the object and those of what digs. Here stands who samples which part of the wall, and how long a seed waits that
// is not on the wall, or not in its own part of it.
#include "border.h"
#include "model/round.h"
#include "settle.h"

namespace {

// Spacings: how far beyond the border of its part a seed still has a scale that reaches into it.
constexpr Real SHARED(1.5);
// Units: by how much more than others the two sides of that border overlap, which is found to first order.
constexpr Real OVERLAP(0.18);
// How far the border of two parts of a hollow's wall moves at most when what digs moves by a unit.
constexpr Real BORDER_SPEED(16);
// How far the paths of a patch are apart where all of it is judged by one: of how far they are where they rest.
constexpr Real APART(1.25);
// The position that tells whether the surface has closed again over a hollow.
constexpr Real CLOSING(0.95);

// ---- Who samples the wall

// The one that a seed shares the wall with.
struct Rival {
    const Neighbour* near;  // null: there is none
    Vector from;            // what leads from its core to the seed
    Real steepest;          // how steep its field is there, times half the squared size of the seed's object
};

// The rival of a seed is what digs the most steeply where the seed is. To a seed of what digs, the object that is dented is one,
// too.
Rival rivalOf(const Path& path, Real position)
{
    const Neighbourhood& all = path.all();
    Rival rival{nullptr, {Real(0), Real(0), Real(0)}, Real(0)};
    for (int i = 0; i < path.touched(); ++i) {
        const Neighbour& near = path.near(i);
        if (near.slope == Real(0) || !(all.hollow ? near.digs || near.object == all.head : near.samples))
            continue;
        const Vector v = path.fromCore(near, position);
        const Real steep = -(near.slope * near.ratio * nearLength(v) * (near.digs ? near.weight : Real(1)));
        if (steep > rival.steepest)
            rival = {&near, v, steep};
    }
    return rival;
}

// A vector of the same direction and unit length, about.
Vector quickUnit(const Vector& v)
{
    const Real size = lengthQuick(v);
    return size == Real(0) ? v : Vector{quotient(v.x, size), quotient(v.y, size), quotient(v.z, size)};
}

// The lead of a seed's object over its rival is by how much more steeply its field falls. Without other fields that is the
// difference of the two; returned is what the others add to it. `g` is the way in which all fields fall together, `out` that of the
// seed's path, `own` how steep the own field is. With a and b as unit vectors along `out` and along the rival's path, the lead is
// (g.a + g.b) / (1 + a.b).
SELDOM Real leadOf(const Vector& g, const Vector& out, Real own, const Rival& rival)
{
    const Vector a = quickUnit(out), b = quickUnit(rival.from);
    const Vector others = g - a * own + b * rival.steepest;
    return dot(others, a + b) / max(Real(1) + dot(a, b), Real(0.05));
}

// By how much the steepness of a digging field changes from a place to one that is a unit farther from its core: F'' is
// 34/9 - 24/9 t.
Real changeOf(Real slope, Real t, Real strength, Real factor)
{
    return (slope - strength * t * (Real(68.0 / 9) - t * Real(48.0 / 9))) * factor;
}

// A surface that something has dug is sampled twice: by the paths of what is dented, and by those of what digs. Each has the part
// where its paths are nearer to the normal: where its own field is the steeper one, if there are no others. Returned is how far a
// seed that has just settled is on its own side of the border of the two parts, units, to first order; where that is no more than
// `shared` to either side it sets the seed's border. `*g`, the direction outward, becomes that in the middle of what the border
// leaves of the seed's cell: rims are sharp.
Real findShare(Path& path, Seed& s, Real shared, Vector* g)
{
    const SoftObject& object = path.object();
    const bool hollow = path.all().hollow;
    const Vector out = object.slants() ? path.ownGradient(s.position, Real(1)) : path.from(s.position);
    const Rival rival = rivalOf(path, s.position);
    if (rival.near == nullptr)
        return BORDER_FAR;
    Real own = -(path.ownSlope() * nearLength(out));
    if (hollow)
        own = own * path.all().weight;
    Real lead = own - rival.steepest;
    if (path.touched() > 1)
        lead += leadOf(hollow ? -*g : *g, out, own, rival);
    // Away from the core of what digs.
    const Neighbour& other = *rival.near;
    const Vector wall = hollow ? out : rival.from;
    const Real rate = hollow ? changeOf(-path.ownSlope(), path.ownParam(s.position), object.strength(), path.all().weight)
                             : changeOf(-other.slope, other.t, other.strength, other.weight * other.ratio);
    const Real change = absolute(rate);
    const Real apart = absolute(lead) < change * BORDER_FAR ? lead / change : lead < Real(0) ? -BORDER_FAR : BORDER_FAR;
    if (absolute(apart) > shared)
        return apart;
    s.apart = static_cast<int16_t>(rawFromReal(apart + OVERLAP) >> 8);
    s.border = directionOf(normalise((rate < Real(0)) == hollow ? -wall : wall));
    const Real half = shiftDown(object.spacing() * s.position, 1);
    if (apart < half) {
        const Real turn = change * shiftDown(half - max(apart, -half), 1);
        *g = *g + withLength(hollow ? -wall : wall, hollow ? turn : min(turn, rival.steepest));
    }
    return apart;
}

}  // namespace

// Shares the wall with others, for a seed that has found the surface. False: the surface there is the others' to sample.
bool Settler::findDented(Seed& s, Vector* g)
{
    const Real shared = object_.spacing() * SHARED, apart = findShare(path_, s, shared, g);
    if (apart < -shared) {
        s.flags |= SEED_FOLLOW;
        putOff(s, -apart - shared, BORDER_SPEED);
        return false;
    }
    if (apart < shared)
        s.flags |= SEED_BORDER;
    return true;
}

// Whether a path that led into a hollow may leave the surface farther out again.
bool Settler::hasClosed(const Seed& s)
{
    Sample sample;
    path_.begin(nearby_.listed(), s, CLOSING, &sample);
    return sample.excess > Real(0);
}

// ---- What is off the surface waits

// A seed that is not on the surface, or not in its own part of it, by `hold` of the field that changes by `push` at most when the
// neighbours come by a unit: until when it need not be looked at. It waits longer if all neighbours reach the path already: the
// fields of those that do not begin gently.
void Settler::putOff(Seed& s, Real hold, Real push) const
{
    s.flags |= SEED_OFF;
    const Real longest = path_.touched() == all_.count ? LONGEST_WAIT : LIST_SLACK;
    s.due = static_cast<uint16_t>(patch_->travelled + travelUntil(hold, push, longest));
}

bool Settler::isOff(const Patch& patch, const Seed& s)
{
    return (s.flags & SEED_OFF) && static_cast<int16_t>(patch.travelled - s.due) < 0;
}

// What becomes of a patch the middle of which has just been found off the surface: whether all of it is. The own field is about the
// same at one position of all its paths; where they come near the surface they are little farther apart than where they rest.
PatchState Settler::probeOff(const Patch& patch, Seed& s) const
{
    if (s.flags & SEED_FOLLOW)
        return PATCH_MIXED;
    const Real hold = off_ - gradientBound_ * realFromRaw(patch.tight << 12) * APART;
    if (hold <= Real(0))
        return PATCH_MIXED;
    putOff(s, hold, gradientBound_);
    return PATCH_INSIDE;
}
