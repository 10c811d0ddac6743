// Settles seeds: first one seed, then a patch of seeds. From where a seed was in the frame before, Newton's method follows the
// field along its path (path.h) to the isovalue. Where that loses the surface the whole path is searched (search.h).
#include "settle.h"

#include "border.h"
#include "math/whole.h"
#include "model/paint.h"
#include "rt.h"
#include "search.h"

namespace {

// In units of the field, for strength 1: the border to a neighbour is near where its field is weaker than the own one by less.
constexpr Real BORDER(0.25);
// A path through a hollow that leaves the surface beyond this position does not enter it again.
constexpr Real OUTERMOST(0.8);
// A field of strength 1 is taken to change by this over a length of the object's size. (Where it is steepest it changes by 1.6.)
constexpr Real STEEPEST(1.3);
// A patch is taken to face away if its middle does so by this cosine (1.0 = 2^14) plus the spread of its normals.
constexpr int32_t TURNED = 500;
// A normal leans if the cosine of it and the one at rest is less (1.0 = 2^14).
constexpr int32_t LEANING = 15500;
// Margin of the range of positions that the seeds of a patch are in. A seed that leaves the range is settled in the fields of all
// neighbours on the patch's list.
constexpr Real RANGE(0.05);
// Cosine of path and normal (1.0 = 2^14). In a place that belongs to another object a seed is not shown if its path meets the
// surface at a smaller one.
constexpr int32_t SQUARE = 8000;
// A normal has hardly turned if none of its components changed by more (1.0 = 2^14).
constexpr int32_t HARDLY_TURNED = 600;

}  // namespace

Settler::Settler(SoftObject& object, const OwnFrame& own, Neighbourhood& all, const FrameContext& frame,
                 const Odometer& odometer)
    : path_(object, all, *frame.bodies, nearby_, *frame.counts), nearby_(object, all, *frame.bodies),
      cover_(object, all, nearby_, path_), object_(object), own_(own), all_(all), counts_(*frame.counts), now_(odometer.reading()),
      heavy_(frame.bodies->heaviest(object.slot()) > HEAVY),
      weakest_(ISOVALUE / (Real(1) + shiftUp(frame.bodies->heaviest(object.slot()), 1))),
      last_(&object.regular(object.seedSlots() - 2))
{
    Real strongest = max(object.strength(), Real(1));
    for (int i = 0; i < all.count; ++i)
        strongest = max(strongest, all.neighbours[i].strength);
    border_ = BORDER * strongest;
    setGaps();
}

// ---- One seed

// Puts a seed at rest, for no neighbour reaches it.
static void rest(const SoftObject& object, Seed& s)
{
    if (!(s.flags & SEED_RESTING)) {
        s.position = Real(1);
        object.layAtRest(s, object.restNormal(s));
    }
    s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_VALID | SEED_RESTING);
}

// Sets position, normal and flags of a seed. If the path meets no surface of its own object the seed is left without SEED_VALID,
// and the return value says by how much of the field the path lies inside.
Real Settler::settle(Seed& s)
{
    Sample sample;
    Real position = s.position;
    const bool follows = isOnOwn(s) || (s.flags & SEED_FOLLOW) || (all_.hollow && (s.flags & SEED_VALID));
    const Followed followed = follows ? followOn(s, &position, &sample) : LOST;
    if (followed == ALONE) {
        rest(object_, s);
        return Real(0);
    }
    ++counts_.updated;
    s.flags &= SEED_ACTIVE;
    bool found = followed != LOST;
    Real margin(9);
    if (!found) {
        margin = search(s, &position, &sample);
        found = sample.excess <= Real(0);
    }
    s.position = position;
    const bool claimed = found && sample.dominance <= OVERSHOOT;
    if (claimed) {
        const Direction14 before = s.normal;
        place(s, sample.dominance);
        const bool isExtra = s.area == 0;
        if ((s.flags & SEED_VALID) && (isExtra || isBesideBorder(s)))
            keepLightChange(s, before);
        else
            s.lightIsOld = true;
        return Real(0);
    }
    if (nearby_.dented()) {
        if (found)
            off_ = Real(0);
        putOff(s, found ? sample.dominance - OVERSHOOT : off_, followed == LOST ? gradientBound_ : path_.steepestGradient());
    }
    s.blocker = nextBlocker();
    return found ? min(margin, sample.dominance - OVERSHOOT) : margin;
}

// Follows a seed from where it was, in the fields of the neighbours that reach it there.
inline Settler::Followed Settler::followOn(Seed& s, Real* position, Sample* sample)
{
    // The surface may have closed again farther out on a path into a hollow.
    const bool closed = nearby_.dented() && !all_.hollow && *position <= OUTERMOST && hasClosed(s);
    bool touched = path_.begin(nearby_.at(*position), s, *position, sample);
    if (!touched && *position != Real(1)) {
        *position = Real(1);
        touched = path_.begin(nearby_.listed(), s, *position, sample);
    }
    if (!touched && all_.restsAtOne)
        return ALONE;
    if (closed || !follow(path_, position, sample))
        return LOST;
    if (nearby_.isBeyond(*position)) {
        // Where the seed is now other neighbours may reach it.
        path_.begin(nearby_.listed(), s, *position, sample);
        if (!follow(path_, position, sample))
            return LOST;
    }
    return FOUND;
}

// Sets the border of a seed that is on the surface, if it is near, and whether the seed is a guest. Returns false where the surface
// is left to the strongest neighbour.
inline bool Settler::settleBorder(Seed& s, Real dominance)
{
    // Where no claim differs from its field the lead of the claims is that of the fields.
    const Real lead = all_.claims ? path_.fieldLead() : dominance;
    if (all_.claims) {
        showHost(s);
        // Where the two fields are the same there is no host: one of the objects has the surface, as findBorder() decides.
        const Neighbour* const host = path_.strongest();
        if (host != nullptr && host->claim < Real(1) && lead > host->value * TIE)
            return makeGuest(s, *host);
    }
    if (lead <= -border_)
        return true;
    const bool dented = (s.flags & SEED_BORDER) && nearby_.dented();
    if (!(dented ? findNearer(path_, s, lead) : findBorder(path_, s, lead)))
        return false;
    s.flags |= SEED_BORDER;
    return true;
}

// Where a seed samples a hollow in several objects: lets it show that one whose field is the strongest.
void Settler::showHost(Seed& s) const
{
    const Neighbour* const host = path_.host();
    if (host == nullptr || host->object == all_.head)
        return;
    s.host = static_cast<uint8_t>(host->slot);
    s.flags |= SEED_GUEST;
}

// Lets a seed show a place that belongs to a neighbour. Returns false if the seed would show it badly.
bool Settler::makeGuest(Seed& s, const Neighbour& host)
{
    if (path_.ownField() < FAINT || cosineOfPath(s) < SQUARE)
        return false;
    findGuestBorder(path_, s, host);
    s.host = static_cast<uint8_t>(host.slot);
    s.flags |= SEED_GUEST | SEED_BORDER;
    return true;
}

// The slot of the neighbour whose field was the strongest where the current path was evaluated last: the blocker of a seed there.
uint8_t Settler::nextBlocker() const
{
    const Neighbour* const near = path_.strongest();
    return static_cast<uint8_t>(near == nullptr ? object_.slot() : near->slot);
}

// Leaves the surface at a seed to the strongest neighbour. Its path goes on leaving the surface there.
inline void Settler::leaveToStrongest(Seed& s)
{
    s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_FOLLOW);
    s.blocker = nextBlocker();
}

// Searches the whole path of a seed, in the fields of the neighbours that reach some place on it.
inline Real Settler::search(const Seed& s, Real* position, Sample* sample)
{
    if (nearby_.dented() || !all_.restsAtOne) {
        path_.beginDeepSearch(s);
        return searchDeep(path_, position, sample, &off_, &gradientBound_);
    }
    // Most paths lie inside already by the fields of the neighbours that reach the patch where it is.
    Real margin;
    *position = path_.middle();
    path_.begin(nearby_.reaching(), s, *position, sample);
    if (isInside(path_, position, sample, &margin))
        return margin;
    *sample = path_.beginSearch(s);
    *position = path_.middle();
    return ::search(path_, position, sample);
}

// Sees to it that a seed knows how the light changes around it. `before` is the normal that the seed had the time before. While the
// normal hardly turns the change of the light stays about the same, and it is enough to find it every second time.
inline void Settler::keepLightChange(Seed& s, const Direction14& before)
{
    const Direction14& n = s.normal;
    const int32_t turned = max32(max32(magnitude(n.x - before.x), magnitude(n.y - before.y)), magnitude(n.z - before.z));
    const bool known = !s.lightIsOld && turned <= HARDLY_TURNED && s.lightChange[0] != Seed::LIGHT_UNKNOWN;
    if (!known)
        findLightChange(s);
    s.lightIsOld = known;
}

// Gives a seed that is on the surface its normal, its colour where colours mix, and the border to a neighbour. The seed is left
// without SEED_VALID where the surface belongs to the neighbour, or is another one (findDented()).
inline void Settler::place(Seed& s, Real dominance)
{
    Vector out = path_.outward(s.position);
    if (nearby_.dented() && !findDented(s, &out))
        return;
    s.normal = directionOf(normalise(out));
    s.flags |= SEED_VALID;
    if (mixes())
        mix(path_, s);
    if (settleBorder(s, dominance))
        ++counts_.normals;
    else
        leaveToStrongest(s);
}

// Activates a seed at a position of the current path that is on the surface, and places it there. Returns false if it shows nothing
// there.
bool Settler::placeAt(Seed& s, Real position, Real dominance)
{
    s.position = position;
    s.flags = SEED_ACTIVE;
    place(s, dominance);
    return (s.flags & SEED_VALID) != 0;
}

// Whether the object's colours mix with those of the objects that it is linked with.
inline bool Settler::mixes() const
{
    return object_.paint() != nullptr && object_.paint()->mixes;
}

// ---- A patch of seeds

// The margin, in units of the field, by which the middle seed of a patch must lie inside so that all of the patch does. The other
// seeds are no farther away than the radius of the patch, over which a field changes by STEEPEST at most; and two fields change,
// the strongest neighbour's and the own one that it is compared with.
static Real enough(const Patch& patch, Real size)
{
    return clamp(realFromRaw(patch.radius << 12) / size * (STEEPEST + STEEPEST), Real(0.2), Real(0.9));
}

bool Settler::setPatch(const Patch& patch, bool oversampled)
{
    patch_ = &patch;
    path_.forgetList();
    return nearby_.setPatch(patch, oversampled);
}

// Whether a patch is hidden, as if all its seeds were at `position`, and so is left unsettled.
inline bool Settler::staysHidden(const Patch& patch, Real position)
{
    const bool hidden = isHidden(patch, position, own_);
    hidden_ |= hidden;
    return hidden;
}

// How far the normals of a patch's seeds lean away from that of its middle seed, as Patch::spread. Where a link is heavy the
// surface bulges between the two objects, and its normals spread more than at rest; so they do where the middle one leans itself.
inline int32_t Settler::spreadOf(const Patch& patch, const Seed& middle) const
{
    if (heavy_)
        return 2 * patch.spread;
    const Direction14& n = middle.normal;
    const int32_t cosine = (n.x * patch.axis[0] + n.y * patch.axis[1] + n.z * patch.axis[2]) >> 14;
    return cosine < LEANING ? patch.spread + (patch.spread >> 2) : patch.spread;
}

PatchState Settler::probe(Patch& patch)
{
    Seed& s = object_.seed(patch.middleSeed);
    patch.due = now_;
    if (!(s.flags & SEED_VALID) && patch.state == PATCH_MIXED && isCovered(s))
        return PATCH_MIXED;
    const Real least = enough(patch, nearby_.smallest());
    const Real margin = settle(s);
    if (!(s.flags & SEED_VALID)) {
        patch.blocker = s.blocker;
        if (nearby_.dented())
            return probeOff(patch, s);
        if (margin <= least)
            return PATCH_MIXED;
        // The own field, with which the strongest is compared, changes as well.
        patch.due += travelUntil(margin - least, shiftUp(path_.gradientBound(), 1), LONGEST_WAIT);
        return PATCH_OFF;
    }
    const int32_t away = own_.limb - facing(object_, s, own_) - spreadOf(patch, s) - TURNED;
    // A guest's normal, beyond the crease to another object, tells nothing about the patch.
    if (away > 0 && isOnOwn(s)) {
        patch.due += travelOf(realFromRaw(away * 4) * shiftDown(object_.laidSize(), 2));
        return PATCH_AWAY;
    }
    return staysHidden(patch, s.position) ? PATCH_AWAY : PATCH_MIXED;
}

// Stores the range of positions that the seeds of a patch are in.
static void setRange(Patch& patch, Real nearest, Real farthest)
{
    patch.nearest = static_cast<uint8_t>(rawFromReal(nearest - RANGE) >> 10);
    patch.farthest = static_cast<uint8_t>(rawFromReal(farthest + RANGE) >> 10);
}

void Settler::settleOthers(Patch& patch)
{
    const Seed& centre = object_.regular(patch.middleSeed);
    uint8_t blocker = patch.blocker;
    Real nearest(9), farthest(0);
    forSeeds(object_, patch, [&](Seed& s) {
        if (&s != &centre)
            settleBeside(centre, s, &blocker);
        nearest = min(nearest, s.position);
        farthest = max(farthest, s.position);
    });
    patch.asleep = false;
    setRange(patch, nearest, farthest);
}

// Settles a seed beside the patch's middle seed, `centre`. `*blocker` is the blocker of the last seed that was off the surface.
inline void Settler::settleBeside(const Seed& centre, Seed& s, uint8_t* blocker)
{
    // A seed that has slept or rested is likely to be at the position of the middle seed, or to have the blocker of the last one.
    const bool woken = (s.flags & SEED_ASLEEP) || ((s.flags & SEED_RESTING) && !(centre.flags & SEED_RESTING));
    if (woken)
        s.blocker = *blocker;
    if ((!(s.flags & SEED_VALID) || (woken && !(centre.flags & SEED_VALID))) && isCovered(s)) {
        s.flags &= stillOff();
        return;
    }
    if (woken) {
        s.position = centre.position;
        s.flags = SEED_FOLLOW;
    }
    settle(s);
    if (!(s.flags & SEED_VALID))
        *blocker = s.blocker;
}

void rest(SoftObject& object, Patch& patch)
{
    patch.nearest = patch.farthest = 64;
    patch.bend.known = patch.asleep = false;
    putAway(object, patch);
    forSeeds(object, patch, [&](Seed& s) { rest(object, s); });
}

void sleep(SoftObject& object, Patch& patch)
{
    putAway(object, patch);
    if (patch.asleep)
        return;
    patch.asleep = true;
    const Seed& centre = object.regular(patch.middleSeed);
    forSeeds(object, patch, [&](Seed& s) {
        if (&s != &centre)
            s.flags = SEED_ASLEEP;
    });
}

void cover(SoftObject& object, Patch& patch)
{
    sleep(object, patch);
    object.seed(patch.middleSeed).flags = 0;
    patch.state = PATCH_OFF;
}
