// Settling seeds, one settler for every scene: first one seed, then a patch of them. Newton's method follows the field along a
// seed's path (path.h) to the isovalue, from where the seed was in the frame before; what it loses is searched (search.h).
#include "settle.h"

#include "border.h"
#include "math/whole.h"
#include "model/paint.h"
#include "rt.h"
#include "search.h"

namespace {

// Of the field, times the greatest strength: a neighbour that is weaker than the own by less is near.
constexpr Real BORDER(0.25);
// Position beyond which a path that is hollowed out leaves the surface for good.
constexpr Real OUTERMOST(0.8);
// By how much of the field an object's own changes at most over a length of the object's size.
constexpr Real STEEPEST(1.3);
// Cosine (1.0 = 2^14) by which the middle of a patch must face away, more than its seeds differ, to be out of sight as a whole.
constexpr int32_t TURNED = 500;
// Units: no seed waits while neighbours come so far in a frame.
constexpr Real HURRY(2);
// Cosines (1.0 = 2^14) by which a seed faces away that is looked at less often, and that needs no other one beside it.
constexpr int32_t LITTLE_AWAY = 2000, WELL_AWAY = 5000, FAR_AWAY = 7500;
// Of the field: where it is so far below the isovalue in the middle of a path, hardly any other object raises it; and where another
// is stronger by as much, the surface is that one's.
constexpr Real LEFT_ALONE(-0.2);
// Every so many frames it is the turn of a patch that all its seeds are looked at.
constexpr uint32_t TURNS = 4;
// Positions: by how much a seed may leave the range that those of its patch were found in before all neighbours are asked.
constexpr Real RANGE(0.05);
// Difference of the positions of two seeds, as a length in spacings, that activates the one between.
constexpr Real PARTED(1.5);
// Of the field: by so much the own is stronger than any other where a path leaves an island. In a crease beside what belongs to
// another object a scale would stand for neither side.
constexpr Real CLEARLY(-0.06);
// Of a link: beyond this weight the field rises half way between two objects, and islands are left when they part.
constexpr Real HEAVY(1);
// Cosine of path and normal (1.0 = 2^14): what a path only grazes its seed stands badly for.
constexpr int32_t GRAZING = 1500;
// Spacings: how far the surface may go on from a seed to a border without an oversampled one towards the neighbour N (not at all on
// shaped objects), without one towards the next of its ring, and without a fine one.
constexpr Real LEFT_OPEN(0.5), LEFT_OPEN_SHAPED(-100), LEFT_OPEN_NEXT(1), LEFT_OPEN_FINE(1.5);

}  // namespace

Settler::Settler(SoftObject& object, const OwnFrame& own, Neighbourhood& all, const FrameContext& frame,
                 const Odometer& odometer, uint32_t updates)
    : path_(object, all, *frame.bodies, nearby_, *frame.counts), nearby_(object, all, *frame.bodies),
      cover_(object, all, nearby_, path_), object_(object), own_(own), all_(all), counts_(*frame.counts), now_(odometer.reading()),
      travelled_(realFromRaw(static_cast<int32_t>(odometer.lastTravel() << 6))), updates_(updates),
      heavy_(frame.bodies->heaviest(object.slot()) > HEAVY),
      weakest_(ISOVALUE / (Real(1) + shiftUp(frame.bodies->heaviest(object.slot()), 1))),
      last_(&object.regular(object.seedSlots() - 2))
{
    Real strongest = max(object.strength(), Real(1));
    for (int i = 0; i < all.count; ++i)
        strongest = max(strongest, all.neighbours[i].strength);
    border_ = BORDER * strongest;
    alike_ = min(object.spacing() * PARTED / object.radius(), Real(9));
    open_ = object.spacing() * (object.shaped() ? LEFT_OPEN_SHAPED : LEFT_OPEN);
    openNext_ = object.spacing() * LEFT_OPEN_NEXT;
    openFine_ = object.spacing() * LEFT_OPEN_FINE;
}

// ---- One seed

// Sets position, normal and flags of a seed. One that finds no surface of its own object is left without SEED_VALID; returned is
// then by how much of the field it lies inside.
Real Settler::settle(Seed& s)
{
    Sample sample;
    Real position = s.position;
    const Followed followed = s.flags & (SEED_VALID | SEED_FOLLOW) ? followOn(s, &position, &sample) : LOST;
    if (followed == ALONE) {
        restThere(s);
        return Real(0);
    }
    ++counts_.updated;
    if (followed == STILL && (s.flags & SEED_VALID) && !(s.flags & SEED_RESTING) && sample.dominance <= OVERSHOOT) {
        keep(s, sample.dominance);
        return Real(0);
    }
    s.still = 0;
    s.flags &= SEED_ACTIVE;
    bool found = followed != LOST;
    Real margin(9);
    if (!found) {
        margin = search(s, &position, &sample);
        found = sample.excess <= Real(0);
    }
    s.position = position;
    if (found && sample.dominance <= OVERSHOOT) {
        place(s, sample.dominance);
        return Real(0);
    }
    // Where another object is the stronger, the path may leave the surface before that in a later frame: where a valley or haste
    // tells so it is searched again in the next one, else when its turn comes.
    if (found && margin > VALLEY && turn_ != 0)
        s.flags |= SEED_FOLLOW;
    if (nearby_.dented()) {
        off_ = found ? Real(0) : off_;
        putOff(s, found ? sample.dominance - OVERSHOOT : off_, followed == LOST ? gradientBound_ : path_.steepestGradient());
    }
    s.blocker = static_cast<uint8_t>(cover_.strongest());
    return found ? min(margin, sample.dominance - OVERSHOOT) : margin;
}

// Follows a seed from where it was, in the fields of those neighbours that reach it there.
inline Settler::Followed Settler::followOn(Seed& s, Real* position, Sample* sample)
{
    // A path into a hollow may leave the surface farther out now, where that has closed again.
    const bool closed = nearby_.dented() && !all_.hollow && *position <= OUTERMOST && hasClosed(s);
    bool touched = path_.begin(nearby_.at(*position), s, *position, sample);
    if (!touched && *position != Real(1)) {
        *position = Real(1);
        touched = path_.begin(nearby_.listed(), s, *position, sample);
    }
    if (!touched && all_.restsAtOne)
        return ALONE;
    const bool still = *position == s.position && absolute(sample->excess) <= TOLERANCE;
    if (closed || !follow(path_, position, sample))
        return LOST;
    if (nearby_.isBeyond(*position)) {
        // Where it is now, others may reach it.
        path_.begin(nearby_.listed(), s, *position, sample);
        if (!follow(path_, position, sample))
            return LOST;
    }
    return still ? STILL : FOUND;
}

// Leaves a seed where nothing blends with it.
void Settler::restThere(Seed& s)
{
    if (!(s.flags & SEED_RESTING)) {
        object_.layAtRest(s, object_.restNormal(s));
        s.flags &= SEED_ACTIVE;
    }
    s.position = Real(1);
    s.still = travelled_ < shiftDown(nearby_.smallest(), 3);
    s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_VALID | SEED_RESTING);
}

// Leaves a seed as it is: it has not moved, and what is known of it holds.
inline void Settler::keep(Seed& s, Real dominance)
{
    s.still = s.still == 0 || travelled_ * Real(3) > shiftDown(nearby_.smallest(), 3) ? 1 : 3;
    if (mixes())
        mix(path_, s);
    // But the border may have moved.
    if (dominance > -shiftDown(border_, 1) && !nearby_.dented()) {
        findBorder(path_, s, dominance);
        s.flags |= SEED_BORDER;
    }
}

// Searches the whole path of a seed, in the fields of those neighbours that reach some of it.
inline Real Settler::search(const Seed& s, Real* position, Sample* sample)
{
    if (nearby_.dented() || !all_.restsAtOne) {
        path_.beginDeepSearch(s);
        return searchDeep(path_, position, sample, &off_, &gradientBound_);
    }
    // Most are sure to lie inside by the fields alone that reach the patch where it is.
    Real margin;
    *position = path_.middle();
    path_.begin(nearby_.reaching(), s, *position, sample);
    if (isInside(path_, position, sample, &margin))
        return margin;
    *sample = path_.beginSearch(s);
    *position = path_.middle();
    return ::search(path_, position, sample);
}

// Gives a seed that is on the surface its normal, and what else there is to know of it there.
inline void Settler::place(Seed& s, Real dominance)
{
    Vector out = path_.outward(s.position);
    if (nearby_.dented() && !findDented(s, &out))
        return;
    s.normal = directionOf(normalise(out));
    s.flags |= SEED_VALID;
    if (mixes())
        mix(path_, s);
    if (dominance > -border_) {
        s.flags & SEED_BORDER ? findNearer(path_, s, dominance) : findBorder(path_, s, dominance);
        s.flags |= SEED_BORDER;
    }
    ++counts_.normals;
}

// Whether its colours mix with those of what it is linked with.
inline bool Settler::mixes() const
{
    return object_.paint() != nullptr && object_.paint()->mixes;
}

// ---- A patch of seeds

// By how much of the field the seed in the middle of a patch must lie inside, for all of the patch to do so: the other seeds
// are no farther away than the radius of the patch, over which a field changes as STEEPEST says; and two fields change, the
// strongest and the one that it is compared with.
static Real enough(const Patch& patch, Real size)
{
    return clamp(realFromRaw(patch.radius << 12) / size * (STEEPEST + STEEPEST), Real(0.2), Real(0.9));
}

bool Settler::setPatch(const Patch& patch, bool oversampled)
{
    patch_ = &patch;
    path_.leave();
    const bool reached = nearby_.setPatch(patch, oversampled);
    const bool hurries = travelled_ > min(HURRY, shiftDown(nearby_.smallest(), 2));
    turn_ = hurries || nearby_.dented() ? 0 : (static_cast<uint32_t>(patch.centre) / 2 + updates_) % TURNS;
    return reached;
}

PatchState Settler::probe(Patch& patch)
{
    Seed& s = object_.seed(patch.centre);
    patch.due = now_;
    if (!(s.flags & SEED_VALID) && patch.state == PATCH_MIXED && isCovered(s))
        return PATCH_MIXED;
    const Real least = enough(patch, nearby_.smallest());
    const bool stays = !patch.stirred && patch.state == PATCH_MIXED && (s.flags & SEED_VALID);
    const Real margin = stays ? Real(0) : settle(s);
    if (!(s.flags & SEED_VALID)) {
        patch.blocker = s.blocker;
        if (nearby_.dented())
            return probeOff(patch, s);
        if (margin <= least)
            return PATCH_MIXED;
        // The own field, with which the strongest is compared, changes as well.
        patch.due += travelUntil(margin - least, shiftUp(path_.gradientBound(), 1), LONGEST_WAIT);
        return PATCH_INSIDE;
    }
    patch.facing = facing(object_, s, own_);
    const int32_t away = own_.limb - patch.facing - patch.spread - TURNED;
    if (away > 0) {
        patch.due += travelOf(realFromRaw(away * 4) * shiftDown(object_.laidSize(), 2));
        return PATCH_AWAY;
    }
    if (isHidden(patch, s.position, own_)) {
        hidden_ = true;
        return PATCH_AWAY;
    }
    return PATCH_MIXED;
}

// Notes between which positions the seeds of a patch are.
inline void Settler::setRange(Patch& patch, Real nearest, Real farthest) const
{
    patch.nearest = static_cast<uint8_t>(rawFromReal(nearest - RANGE) >> 10);
    patch.farthest = static_cast<uint8_t>(rawFromReal(farthest + RANGE) >> 10);
    if (nearby_.isBeyond(nearest) || nearby_.isBeyond(farthest)) {
        // The list of those near them is made anew in the next frame.
        memcpy(patch.near, patch.listed, sizeof patch.near);
        patch.stale = true;
    }
}

void Settler::settleOthers(Patch& patch)
{
    const Seed& centre = object_.regular(patch.centre);
    const bool someAway = !(centre.flags & SEED_VALID) || patch.facing < patch.spread;
    uint8_t blocker = patch.blocker;
    Real nearest(9), farthest(0);
    forSeeds(object_, patch, [&](Seed& s) {
        if (&s != &centre)
            settleBeside(centre, s, someAway, &blocker);
        nearest = min(nearest, s.position);
        farthest = max(farthest, s.position);
    });
    patch.asleep = false;
    setRange(patch, nearest, farthest);
}

// Settles a seed of the patch that `centre` is in the middle of. `*blocker` is that of the seed that was not on the surface last.
inline void Settler::settleBeside(const Seed& centre, Seed& s, bool someAway, uint8_t* blocker)
{
    // What has slept or rested is likely to be where the one in the middle is, or kept off by what kept off the last one.
    const bool woken = (s.flags & SEED_ASLEEP) || ((s.flags & SEED_RESTING) && !(centre.flags & SEED_RESTING));
    if (woken)
        s.blocker = *blocker;
    else if (waits(s, someAway))
        return;
    if ((!(s.flags & SEED_VALID) || (woken && !(centre.flags & SEED_VALID))) && isCovered(s)) {
        s.flags &= stillOff();
        return;
    }
    if (woken) {
        s.position = centre.position;
        s.flags = SEED_FOLLOW;
        s.still = 0;
    }
    settle(s);
    if (!(s.flags & SEED_VALID))
        *blocker = s.blocker;
}

// Coherence over time: a seed that did not move when it was looked at waits for a frame, and so does one that faces away a
// little; one that did not move twice, or faces well away, waits for three. What is far off the surface waits for a frame, where
// all scales of the patch meet.
inline bool Settler::waits(const Seed& s, bool someAway) const
{
    if (!(s.flags & SEED_VALID))
        return (turn_ & 1) != 0 && !patch_->extras && !(s.flags & SEED_FOLLOW);
    if (!patch_->stirred || (s.still & turn_) != 0)
        return true;
    if (!someAway || turn_ == 0)
        return false;
    const int32_t away = -facing(object_, s, own_);
    return away > WELL_AWAY || (away > LITTLE_AWAY && (turn_ & 1) != 0);
}

// Whether so much of the surface lies between two seeds beside each other that their scales may leave a gap. Where only one is on
// the surface, it goes on to the border at least; `open` says how far it may do so. Of what sleeps nothing is known.
inline bool Settler::mayGape(const Seed& s, const Seed& n, Real open) const
{
    if (s.flags & n.flags & SEED_VALID)
        return absolute(s.position - n.position) > alike_;
    const Seed& valid = s.flags & SEED_VALID ? s : n;
    return (valid.flags & SEED_VALID) && !(n.flags & SEED_ASLEEP) &&
           (!(valid.flags & SEED_BORDER) || realFromRaw(valid.apart << 8) > open);
}

// The seed from which another has parted, so that the one between is needed: its neighbour N, or else the next of its ring, when
// the border passes between the two and not between the seed and N. Null: there is none.
inline const Seed* Settler::parted(const Seed& s) const
{
    if (s.neighbour >= 0 && mayGape(s, object_.regular(s.neighbour), open_))
        return &object_.regular(s.neighbour);
    const Seed* const next = &s + 1;
    return &s < last_ && ((s.flags ^ next->flags) & SEED_VALID) && !object_.shaped() && next->root == s.root &&
           mayGape(s, *next, openNext_) ? next : nullptr;
}

namespace {

// The fine seeds of a regular one are not needed, but for those on an island; nor is its oversampled one; none of a patch is.
void putAwayFine(SoftObject& object, int i, int end = SoftObject::FINE_ISLAND)
{
    Seed* const fine = object.fine(i);
    for (int which = 0; which < end && fine != nullptr; ++which)
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

void putAway(SoftObject& object, Patch& patch)
{
    if (patch.extras || patch.islands)
        forSeeds(object, patch, [&](const Seed& s) {
            const int i = object.slotOf(s);
            putAway(object, i);
            putAwayFine(object, i, SoftObject::FINE_SEEDS);
        });
    patch.extras = patch.fine = patch.islands = false;
}

}  // namespace

// Whether a seed is not on the surface, or faces so far away that what lies beside it is not seen.
bool Settler::isAway(const Seed& s) const
{
    return !(s.flags & SEED_VALID) || facing(object_, s, own_) < -FAR_AWAY;
}

// Lays out the oversampled seed of a regular one between that and another. False: nobody would see it.
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
        extra.position = s.position;
        extra.still = 0;
    }
    return true;
}

void Settler::oversample(Patch& patch)
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
    const bool hadFine = patch.fine;
    patch.fine = false;
    if (!any)
        return;
    patch.due = now_;
    setPatch(patch, true);
    forSeeds(object_, patch, [&](const Seed& s) {
        const int i = object_.slotOf(s);
        Seed* const extra = object_.extra(i);
        if (extra == nullptr || !(extra->flags & SEED_ACTIVE))
            return;
        if (!(extra->flags & SEED_VALID) && isCovered(*extra))
            extra->flags &= SEED_ACTIVE | stillOff();
        else if (!waits(*extra, false))
            settle(*extra);
        if (settleFine(i))
            patch.fine = true;
        else if (hadFine)
            putAwayFine(object_, i);
    });
}

// Settles those fine seeds of a regular one that are needed. False: none is.
bool Settler::settleFine(int i)
{
    const Seed& extra = *object_.extra(i);
    const Seed* const ends[] = {&object_.regular(i), &object_.regular(extra.neighbour)};
    const bool needed[] = {mayGape(*ends[0], extra, openFine_), mayGape(*ends[1], extra, openFine_)};
    const bool oneRoot = !object_.shaped() && ends[0]->root == ends[1]->root;
    Seed* const fine = (needed[0] || needed[1]) && oneRoot ? object_.madeFine(i) : nullptr;
    if (fine == nullptr)
        return false;
    fine[SoftObject::FINE_BEHIND].flags = 0;
    for (int which = SoftObject::FINE_NEAR; which <= SoftObject::FINE_FAR; ++which) {
        Seed& s = fine[which];
        if (!needed[which]) {
            s.flags = 0;
            continue;
        }
        if (!(s.flags & SEED_ACTIVE)) {
            object_.layOutFine(i, which);
            s.flags = SEED_ACTIVE | SEED_FOLLOW;
            s.position = ends[which]->position;
            s.still = 0;
        }
        if (!waits(s, false))
            settle(s);
        if (((ends[which]->flags ^ extra.flags) & SEED_VALID) && !nearby_.dented())
            settleBehind(s.flags & SEED_VALID ? s : extra.flags & SEED_VALID ? extra : *ends[which],
                         fine[SoftObject::FINE_BEHIND]);
    }
    return true;
}

// Where necks are thin their surface hangs over: the path of a valid seed beside the border leaves the surface, and may come back
// behind that, where another seed stands for it.
void Settler::settleBehind(const Seed& valid, Seed& s)
{
    Sample sample;
    s = valid;
    s.flags = 0;
    if (!comesBack(path_, s, &s.position, &sample) || sample.dominance > OVERSHOOT)
        return;
    s.flags = SEED_ACTIVE;
    place(s, sample.dominance);
}

// Whether a neighbour that the object has a heavy link with may reach the paths of a patch.
bool Settler::mayHaveIslands(const Patch& patch) const
{
    bool heavy = false;
    forNeighbours(patch.listed, [&](int slot) { heavy = heavy || nearby_.weight(slot) > HEAVY; });
    return heavy && !nearby_.dented();
}

// Where links are heavy the field rises again half way to the other object: the paths of any seeds may come back to the surface,
// whether their patch rests or faces away. Where none has, they take turns.
void Settler::settleIslands(Patch& patch)
{
    setPatch(patch);
    const bool may = mayHaveIslands(patch), had = patch.islands;
    if (may && !had && (turn_ & 1) != 0)
        return;
    patch.islands = false;
    forSeeds(object_, patch, [&](const Seed& s) {
        const int i = object_.slotOf(s);
        if (had)
            putAwayIsland(object_, i);
        patch.islands |= may && settleIsland(i);
    });
}

// The path of a regular seed enters an island and leaves it again. False: it does not come back, or only grazes what it comes back
// to.
bool Settler::settleIsland(int i)
{
    const Seed& onPath = object_.regular(i);
    const bool valid = (onPath.flags & SEED_VALID) != 0;
    if (!valid && !(onPath.flags & SEED_ASLEEP))
        return false;
    const Sample middle = path_.beginSearch(onPath);
    Real outside, inside;
    if (middle.excess < LEFT_ALONE || middle.dominance > -LEFT_ALONE ||
        !comesBackFar(path_, valid ? onPath.position : Real(1), weakest_, &outside, &inside))
        return false;
    const bool enters = placeOnIsland(i, SoftObject::FINE_ISLAND, inside, outside);
    return (leavesAgain(path_, &inside, &outside) && placeOnIsland(i, SoftObject::FINE_ISLAND_END, inside, outside)) || enters;
}

// Places a seed on an island, between two positions of the path at hand. False: it would only graze it, or is another object's.
bool Settler::placeOnIsland(int i, int which, Real inside, Real outside)
{
    Sample sample;
    Seed s = object_.regular(i);
    s.flags = 0;
    bisect(path_, inside, outside, &s.position, &sample);
    if (sample.dominance > (which == SoftObject::FINE_ISLAND_END ? CLEARLY : OVERSHOOT))
        return false;
    place(s, sample.dominance);
    s.flags |= SEED_ACTIVE;
    const int32_t cosine = (s.way[0] * s.normal.x + s.way[1] * s.normal.y + s.way[2] * s.normal.z) >> 7;
    Seed* const fine = magnitude(cosine) < GRAZING ? nullptr : object_.madeFine(i);
    if (fine != nullptr)
        fine[which] = s;
    return fine != nullptr;
}

void rest(SoftObject& object, Patch& patch)
{
    patch.nearest = patch.farthest = 64;
    patch.bend.known = patch.asleep = false;
    putAway(object, patch);
    forSeeds(object, patch, [&](Seed& s) {
        if (s.flags != (SEED_VALID | SEED_RESTING)) {
            s.position = Real(1);
            object.layAtRest(s, object.restNormal(s));
        }
        s.flags = SEED_VALID | SEED_RESTING;
    });
}

void sleep(SoftObject& object, Patch& patch)
{
    putAway(object, patch);
    if (patch.asleep)
        return;
    patch.asleep = true;
    const Seed& centre = object.regular(patch.centre);
    forSeeds(object, patch, [&](Seed& s) {
        if (&s != &centre)
            s.flags = SEED_ASLEEP;
    });
}

void cover(SoftObject& object, Patch& patch)
{
    sleep(object, patch);
    object.seed(patch.centre).flags = 0;
    patch.state = PATCH_INSIDE;
}
