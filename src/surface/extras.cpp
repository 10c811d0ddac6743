// Settles the seeds that lie beside regular ones: oversampled seeds between two that have parted, fine seeds on both sides of
// those, on walls, and where a path meets the surface again.
#include "settle.h"

#include "math/whole.h"
#include "search.h"

namespace {

// In units of the field. If the field in the middle of a path is so far below the isovalue no other object is likely to raise it to
// an island; and where a neighbour is stronger by as much, the island belongs to the neighbour.
constexpr Real LEFT_ALONE(-0.2);
// Two neighbouring seeds have parted, and the oversampled seed between them is needed, if their positions differ by more than this
// many spacings. Between objects with a heavy link the surface bends more.
constexpr Real PARTED(1.5), PARTED_HEAVY(1);
// In units of the field: where a path leaves an island the own field must be stronger than any other by this. Nearer to another
// object's part of the surface, in the crease between the two, a scale would fit neither side.
constexpr Real CLEARLY(-0.06);
// Parts of a wall's height: where its two fine seeds are placed.
constexpr Real LOWER(0.33), UPPER(0.67);
// The search across a wall: the number of its steps, and the least part of the remaining width that a step leaves on either side.
constexpr int ACROSS_STEPS = 4;
constexpr Real LEAST_LEFT(0.2);
// Cosine of path and normal (1.0 = 2^14). A seed whose path meets an island at a smaller one is left out: the path only grazes it.
constexpr int32_t GRAZING = 1500;
// Spacings. The surface may go on for this distance from a seed to a border before an oversampled seed towards the neighbour N is
// needed (on shaped objects always), one towards the next seed of the ring, and a fine seed. Where nothing digs, and so no side of
// a dent is steep to all paths, the first two may be twice as far: rays find what is missed (picture/outlines.h).
constexpr Real LEFT_OPEN(0.55), LEFT_OPEN_SHAPED(-100), LEFT_OPEN_NEXT(1), LEFT_OPEN_FINE(1.5);
// No oversampled seed is needed between two that both face away by this cosine (1.0 = 2^14).
constexpr int32_t FAR_AWAY = 7500;

}  // namespace

void Settler::setGaps()
{
    alike_ = min(object_.spacing() * (heavy_ ? PARTED_HEAVY : PARTED) / object_.radius(), Real(9));
    const Real far = object_.spacing() * Real(all_.dented || all_.hollow ? 1 : 2);
    open_ = far * (object_.shaped() ? LEFT_OPEN_SHAPED : LEFT_OPEN);
    openNext_ = far * LEFT_OPEN_NEXT;
    openFine_ = object_.spacing() * LEFT_OPEN_FINE;
}

// Whether two neighbouring seeds may leave a gap between their scales. If both are on the surface they do when they have parted. If
// only one is, the surface goes on from it to the border with another object, which may be no farther away than `open`. (Beyond the
// border it may belong to a guest.) Nothing is known about the surface at a seed that sleeps.
inline bool Settler::mayGape(const Seed& s, const Seed& n, Real open) const
{
    if (s.flags & n.flags & SEED_VALID) {
        if (absolute(s.position - n.position) <= alike_)
            return false;
        if (((s.flags ^ n.flags) & SEED_GUEST) == 0)
            return true;
    }
    const Seed& own = isOnOwn(s) ? s : n;
    return isOnOwn(own) && !(n.flags & SEED_ASLEEP) && (!(own.flags & SEED_BORDER) || realFromRaw(own.apart << 8) > open);
}

// The neighbouring seed from which `s` has parted, so that the oversampled seed between them is needed: its neighbour N, or else
// the next seed of its ring, if the border passes between these two and not between `s` and N. Null if there is none.
inline const Seed* Settler::parted(const Seed& s) const
{
    if (s.neighbour >= 0 && mayGape(s, object_.regular(s.neighbour), open_))
        return &object_.regular(s.neighbour);
    const Seed* const next = &s + 1;
    return &s < last_ && ((s.flags ^ next->flags) & (SEED_VALID | SEED_GUEST)) && !object_.shaped() && next->root == s.root &&
           mayGape(s, *next, openNext_) ? next : nullptr;
}

namespace {

// These end seeds that are not needed any more: the fine seeds of regular seed i, but for those on islands; its seeds on islands;
// its oversampled and fine seeds.
void putAwayFine(SoftObject& object, int i)
{
    Seed* const fine = object.fine(i);
    for (int which = 0; which < SoftObject::FINE_ISLAND && fine != nullptr; ++which)
        fine[which].flags = 0;
}

void putAwayIsland(SoftObject& object, int i)
{
    if (Seed* const fine = object.fine(i))
        fine[SoftObject::FINE_ISLAND].flags = fine[SoftObject::FINE_ISLAND_END].flags = 0;
}

void putAway(SoftObject& object, int i)
{
    if (Seed* const extra = object.extra(i))
        extra->flags = 0;
    putAwayFine(object, i);
}

}  // namespace

void putAway(SoftObject& object, Patch& patch)
{
    if (patch.extras)
        forSeeds(object, patch, [&](const Seed& s) { putAway(object, object.slotOf(s)); });
    patch.extras = patch.fine = false;
}

// Whether a seed is off the surface, or faces so far away that nothing beside it is seen.
bool Settler::isAway(const Seed& s) const
{
    return !(s.flags & SEED_VALID) || facing(object_, s, own_) < -FAR_AWAY;
}

// Lays out and activates the oversampled seed of a regular one, between that and another. Returns false if nobody would see it.
bool Settler::layOutExtra(const Seed& s, const Seed& other)
{
    if (isAway(s) && isAway(other))
        return false;
    const int i = object_.slotOf(s);
    Seed& extra = object_.seed(i + 1);
    if (object_.layOutBetween(i, object_.slotOf(other)))
        putAway(object_, i);
    if (!(extra.flags & SEED_ACTIVE)) {
        extra.flags = SEED_ACTIVE | SEED_FOLLOW;
        extra.lightChange[0] = Seed::LIGHT_UNKNOWN;
        extra.position = s.position;
    }
    return true;
}

// Activates those oversampled seeds of a patch that are needed, and ends the others.
inline void Settler::layOutExtras(Patch& patch)
{
    const bool had = patch.extras;
    bool any = false;
    forSeeds(object_, patch, [&](const Seed& s) {
        const Seed* const other = parted(s);
        if (other != nullptr && layOutExtra(s, *other))
            any = true;
        else if (had)
            putAway(object_, object_.slotOf(s));
    });
    patch.extras = any;
}

// Settles the oversampled seed of regular seed i. Returns false if it does not take part.
inline bool Settler::settleExtra(int i)
{
    Seed* const extra = object_.extra(i);
    if (extra == nullptr || !(extra->flags & SEED_ACTIVE))
        return false;
    if (!(extra->flags & SEED_VALID) && isCovered(*extra))
        extra->flags &= SEED_ACTIVE | stillOff();
    else
        settle(*extra);
    return true;
}

void Settler::oversample(Patch& patch)
{
    layOutExtras(patch);
    const bool hadFine = patch.fine;
    patch.fine = false;
    if (!patch.extras)
        return;
    setPatch(patch, true);
    forSeeds(object_, patch, [&](const Seed& s) {
        const int i = object_.slotOf(s);
        if (!settleExtra(i))
            return;
        if (settleFine(i))
            patch.fine = true;
        else if (hadFine)
            putAwayFine(object_, i);
    });
}

// Settles fine seed `which` of regular seed i, which begins at a position.
inline void Settler::settleFineSeed(int i, int which, Real position, Seed& s)
{
    if (!(s.flags & SEED_ACTIVE)) {
        object_.layOutFine(i, which);
        s.flags = SEED_ACTIVE | SEED_FOLLOW;
        s.lightChange[0] = Seed::LIGHT_UNKNOWN;
        s.position = position;
    }
    settle(s);
}

// Settles those fine seeds of regular seed i that are needed. Returns false if none is.
bool Settler::settleFine(int i)
{
    const Seed& extra = *object_.extra(i);
    const Seed* const ends[] = {&object_.regular(i), &object_.regular(extra.neighbour)};
    const bool needed[] = {mayGape(*ends[0], extra, openFine_), mayGape(*ends[1], extra, openFine_)};
    const bool oneRoot = ends[0]->root == ends[1]->root;
    Seed* const fine = (needed[0] || needed[1]) && !object_.shaped() ? object_.madeFine(i) : nullptr;
    if (fine == nullptr)
        return false;
    Seed &lower = fine[SoftObject::FINE_LOWER], &upper = fine[SoftObject::FINE_UPPER];
    lower.flags = upper.flags = 0;
    for (int which = SoftObject::FINE_NEAR; which <= SoftObject::FINE_FAR; ++which) {
        Seed& s = fine[which];
        if (!needed[which]) {
            s.flags = 0;
            continue;
        }
        const Seed *from = ends[which], *to = &extra;
        if (oneRoot) {
            settleFineSeed(i, which, from->position, s);
            // A wall is looked for on that side of this seed where the positions differ more.
            if (absolute(from->position - s.position) > absolute(to->position - s.position))
                to = &s;
            else
                from = &s;
        }
        if ((lower.flags | upper.flags) & SEED_ACTIVE)
            continue;
        // Their cells are as large as that of the oversampled seed.
        lower = upper = extra;
        lower.lightChange[0] = upper.lightChange[0] = Seed::LIGHT_UNKNOWN;
        settleOnWall(*from, *to, LOWER, lower);
        settleOnWall(*from, *to, UPPER, upper);
    }
    return true;
}

// Where the path of one seed leaves the surface far farther out than the path beside it, the surface between them is a wall along
// which paths run, such as the side of a thin neck. It is searched across: seed `s`, which brings its cell, gets the position at a
// part of the wall's height, and a path between the two that meets the surface there. Its flags become 0 if there is no wall, or
// that place belongs to another object.
void Settler::settleOnWall(const Seed& a, const Seed& b, Real height, Seed& s)
{
    s.flags = 0;
    if (absolute(a.position - b.position) <= alike_ || nearby_.dented())
        return;
    const Seed &foot = a.position < b.position ? a : b, &top = &foot == &a ? b : a;
    const Real position = foot.position + (top.position - foot.position) * height;
    Real outside = path_.lookOn(foot, position).excess, inside = path_.lookOn(top, position).excess;
    if (outside >= Real(0) || inside <= Real(0))
        return;
    ++counts_.updated;
    Real from(0), to(1);
    Sample sample;
    for (int i = 0; i < ACROSS_STEPS; ++i) {
        const Real share = from + clamp(quotient(outside, outside - inside), LEAST_LEFT, Real(1) - LEAST_LEFT) * (to - from);
        object_.layBetween(s, foot, top, position, share);
        sample = path_.lookOn(s, position);
        if (absolute(sample.excess) <= TOLERANCE)
            break;
        if (sample.excess < Real(0)) {
            from = share;
            outside = sample.excess;
        } else {
            to = share;
            inside = sample.excess;
        }
    }
    if (sample.dominance > OVERSHOOT)
        return;
    if (placeAt(s, position, sample.dominance))
        findLightChange(s);
}

// Whether a neighbour that is linked with the object by more than HEAVY may reach the paths of the current patch.
bool Settler::mayHaveIslands()
{
    if (nearby_.dented())
        return false;
    const NeighbourList& onPaths = nearby_.listed();
    for (int i = 0; i < onPaths.count; ++i)
        if (nearby_.weight(onPaths.near[i]->slot) > HEAVY)
            return true;
    return false;
}

// Where links are heavy the field rises again half way to the other object. The paths of any seeds may then meet the surface again,
// even if their patch rests or faces away.
void Settler::settleIslands(Patch& patch)
{
    setPatch(patch);
    const bool may = patch.state != PATCH_OFF && mayHaveIslands(), had = patch.islands;
    patch.islands = false;
    forSeeds(object_, patch, [&](const Seed& s) {
        const int i = object_.slotOf(s);
        if (had)
            putAwayIsland(object_, i);
        patch.islands |= may && settleIsland(i);
    });
}

// Places seeds where the path of regular seed i enters an island and where it leaves it again. Returns false if the path meets no
// island, or only grazes it.
bool Settler::settleIsland(int i)
{
    const Seed& onPath = object_.regular(i);
    const bool valid = (onPath.flags & SEED_VALID) != 0;
    if (!valid && !(onPath.flags & SEED_ASLEEP))
        return false;
    const Sample middle = path_.beginSearch(onPath);
    Real outside, inside;
    if (middle.excess < LEFT_ALONE || middle.dominance > -LEFT_ALONE ||
        !comesBack(path_, valid ? onPath.position : Real(1), weakest_, &outside, &inside))
        return false;
    const bool enters = placeOnIsland(i, SoftObject::FINE_ISLAND, inside, outside);
    const bool leaves = leavesAgain(path_, &inside, &outside) && placeOnIsland(i, SoftObject::FINE_ISLAND_END, inside, outside);
    if (enters)
        findLightChange(object_.fine(i)[SoftObject::FINE_ISLAND]);
    if (leaves)
        findLightChange(object_.fine(i)[SoftObject::FINE_ISLAND_END]);
    return enters || leaves;
}

// Places fine seed `which` of regular seed i on an island, between two positions of the current path. Returns false if the path
// only grazes the island, or if the surface there belongs to another object.
bool Settler::placeOnIsland(int i, int which, Real inside, Real outside)
{
    Sample sample;
    Real position;
    bisect(path_, inside, outside, &position, &sample);
    // An island has no guests.
    if (all_.claims)
        sample.dominance = path_.fieldLead();
    if (sample.dominance > (which == SoftObject::FINE_ISLAND_END ? CLEARLY : OVERSHOOT))
        return false;
    Seed s = object_.regular(i);
    if (!placeAt(s, position, sample.dominance))
        return false;
    Seed* const fine = magnitude(cosineOfPath(s)) < GRAZING ? nullptr : object_.madeFine(i);
    if (fine != nullptr)
        fine[which] = s;
    return fine != nullptr;
}
