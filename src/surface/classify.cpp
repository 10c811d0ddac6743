// Patches: how they are made, and what is known of all seeds of a patch at once.
#include "math/normal.h"
#include "model/stop.h"
#include "patch.h"
#include "rt.h"

namespace {

int32_t steps16(Real units)
{
    return rawFromReal(units) >> 12;
}

Direction14 direction(const Vector& unitVector)
{
    return {static_cast<int16_t>(rawFromReal(unitVector.x) >> 2), static_cast<int16_t>(rawFromReal(unitVector.y) >> 2),
            static_cast<int16_t>(rawFromReal(unitVector.z) >> 2)};
}

// Of a shaped object, whose paths lead aside: how far along its axis they lead a patch, units, and how far from there one of them
// does at most, 1/16 unit.
SELDOM int16_t leanOf(const SoftObject& object, const Patch& patch, const Vector& axis, Real share, Real* path)
{
    Real up(0), most(0);
    forSeeds(patch, [&](int i) { up += dot(object.seed(i).path, axis) * share; });
    forSeeds(patch, [&](int i) { most = ::most(most, length(object.seed(i).path - axis * up)); });
    *path = up;
    return static_cast<int16_t>(steps16(most) + 1);
}

void setPatch(const SoftObject& object, Patch& patch)
{
    const Real part(1.0 / 16384);
    Vector middle{Real(0), Real(0), Real(0)}, axis = middle;
    Real path(0);
    Square radius(0), spread(0);
    const auto rest = [&](const Seed& s) { return object.root(s.root) + s.path; };
    const auto normal = [&](const Seed& s) {
        // When an object is warped anew, its seeds have long left their rest.
        const Direction14 n = s.flags & SEED_RESTING ? s.normal : object.restNormal(s);
        return Vector{part * Real(static_cast<int>(n.x)), part * Real(static_cast<int>(n.y)), part * Real(static_cast<int>(n.z))};
    };
    int count = 0;
    for (int ring = 0; ring < PATCH_RINGS; ++ring)
        count += patch.count[ring];
    const Real share = Real(1) / Real(count);
    forSeeds(patch, [&](int i) {
        const Seed& s = object.seed(i);
        middle = middle + rest(s) * share;
        axis = axis + normal(s) * share;
        if (object.tapers() && !object.shaped())
            path += length(s.path) * share;
    });
    if (!object.tapers() && !object.shaped())
        path = object.radius();
    axis = unit(axis);
    patch.lean = object.shaped() ? leanOf(object, patch, axis, share, &path) : 0;
    forSeeds(patch, [&](int i) {
        const Seed& s = object.seed(i);
        const Square away = squareOf(rest(s) - middle), aside = squareOf(normal(s) - axis);
        radius = radius < away ? away : radius;
        spread = spread < aside ? aside : spread;
    });
    const Direction14 d = direction(axis);
    patch.axis[0] = d.x;
    patch.axis[1] = d.y;
    patch.axis[2] = d.z;
    patch.spread = static_cast<int16_t>(rawFromReal(least(lengthOf(spread), Real(1.9))) >> 2);
    patch.middle[0] = static_cast<int16_t>(steps16(middle.x));
    patch.middle[1] = static_cast<int16_t>(steps16(middle.y));
    patch.middle[2] = static_cast<int16_t>(steps16(middle.z));
    patch.radius = static_cast<int16_t>(steps16(lengthOf(radius) + shiftDown(object.spacing(), 1)) + 2);
    patch.tight = static_cast<int16_t>(steps16(lengthOf(radius)) + 1);
    patch.path = static_cast<int16_t>(steps16(path) + 1);
}

void beginPatch(const SoftObject& object, Patch& patch)
{
    patch.state = PATCH_REST;
    patch.extras = patch.fine = patch.behind = patch.settled = patch.stale = false;
    patch.blocker = static_cast<uint8_t>(object.slot());
    patch.nearest = patch.farthest = 64;
    patch.due = patch.listDue = 0;
    memset(patch.listed, 0, sizeof patch.listed);
    memset(patch.near, 0, sizeof patch.near);
    patch.bend.known = false;
}

struct Step {
    int32_t x, y, z;  // 1/16 unit
};

inline int32_t square(const Step& s)
{
    return s.x * s.x + s.y * s.y + s.z * s.z;
}

// A place of own space on the patch's axis, `out` (1/16 unit) above where it rests.
inline Step above(const Patch& patch, int32_t out)
{
    return {patch.middle[0] + (patch.axis[0] * out >> 14), patch.middle[1] + (patch.axis[1] * out >> 14),
            patch.middle[2] + (patch.axis[2] * out >> 14)};
}

inline Step fromCore(const Neighbour& near, const Step& at)
{
    if (near.kind == Neighbour::POINT)
        return {at.x - near.x16, at.y - near.y16, at.z - near.z16};
    if (near.segment) {
        // On the segment, as near as can be.
        const Step d{at.x - near.x16, at.y - near.y16, at.z - near.z16};
        const int32_t along = (d.x * near.axis[0] + d.y * near.axis[1] + d.z * near.axis[2]) >> 14;
        const int32_t on = along > near.half16 ? near.half16 : along < -near.half16 ? -near.half16 : along;
        return {d.x - (near.axis[0] * on >> 14), d.y - (near.axis[1] * on >> 14), d.z - (near.axis[2] * on >> 14)};
    }
    const Vector v = near.fromCore16({realFromRaw(at.x << 12), realFromRaw(at.y << 12), realFromRaw(at.z << 12)});
    return {floorToInt(v.x), floorToInt(v.y), floorToInt(v.z)};
}

inline bool within(const Step& away, int32_t distance)
{
    return square(away) < distance * distance;
}

// The patch's axis times what leads from a place to the eye, 1/16 unit.
inline int32_t facing(const Patch& patch, const Step& toEye)
{
    return (patch.axis[0] * toEye.x + patch.axis[1] * toEye.y + patch.axis[2] * toEye.z) >> 14;
}

Step toEyeFrom(const Step& place, const OwnFrame& own)
{
    return {(own.eye32[0] >> 1) - place.x, (own.eye32[1] >> 1) - place.y, (own.eye32[2] >> 1) - place.z};
}

}  // namespace

// The rings from `ring` on that one band of patches has, the most seeds of one of them, and how many patches that takes.
struct Band {
    int rings, runs;

    Band(const SoftObject& object, int ring)
    {
        const int left = object.rings() - ring;
        rings = left < PATCH_RINGS ? left : PATCH_RINGS;
        int most = 0;
        for (int k = ring; k < ring + rings; ++k) {
            const int count = object.ringStart(k + 1) - object.ringStart(k);
            most = count > most ? count : most;
        }
        runs = (most + PATCH_SEEDS - 1) / PATCH_SEEDS;
    }
};

// The seeds of a patch: of each of its rings so many, one behind the other.
struct Run {
    int first[PATCH_RINGS], count[PATCH_RINGS];
};

// The rings of a stretched object leave out seeds, each at other places (thinning() in model/round.h). The patches of a band
// follow the fullest of its rings, and the seeds of the others come to those of that one that they lie nearest to.
class Follower {
public:
    Follower(const SoftObject& object, int ring, int rings) : object_(object), rings_(rings), fullest_(0)
    {
        for (int k = 0; k < rings; ++k) {
            start_[k] = at_[k] = object.ringStart(ring + k);
            end_[k] = object.ringStart(ring + k + 1);
            near_[k] = -1;
            if (end_[k] - at_[k] > end_[fullest_] - at_[fullest_])
                fullest_ = k;
        }
        last_ = at_[fullest_];
    }

    // The next patch. False: there are no more.
    bool next(Run& run)
    {
        bool late = false;
        int left = 0;
        for (int k = 0; k < rings_; ++k) {
            left += end_[k] - at_[k];
            // The patch before had no room for all of its seeds.
            late = late || (isWithin(k, at_[k]) && isWithin(k, at_[k] + PATCH_SEEDS - 1));
        }
        if (left == 0)
            return false;
        if (!late)
            last_ = last_ + PATCH_SEEDS < end_[fullest_] ? last_ + PATCH_SEEDS : end_[fullest_];
        int count = 0;
        for (int k = 0; k < PATCH_RINGS; ++k) {
            run.first[k] = k < rings_ ? at_[k] : 0;
            run.count[k] = 0;
            while (k < rings_ && run.count[k] < PATCH_SEEDS && isWithin(k, at_[k])) {
                near_[k] = nearest(k, at_[k]);
                ++at_[k];
                ++run.count[k];
            }
            count += run.count[k];
        }
        return count > 0 || next(run);
    }

private:
    const SoftObject& object_;
    int rings_, fullest_;
    // Of each ring: its first seed, the end, the first of the next patch.
    int start_[PATCH_RINGS], end_[PATCH_RINGS], at_[PATCH_RINGS];
    int near_[PATCH_RINGS];  // what is nearest to the seed before that one; -1: there is none
    int last_;               // of the fullest: the end of the patches so far

    // Whether a seed of a ring belongs to the patches so far.
    bool isWithin(int k, int i) const
    {
        return i < end_[k] && (last_ == end_[fullest_] || (k == fullest_ ? i : nearest(k, i)) < last_);
    }

    Square between(int i, int n) const
    {
        const auto rest = [&](int number) {
            const Seed& s = object_.regular(2 * number);
            return object_.root(s.root) + s.path;
        };
        return squareOf(rest(i) - rest(n));
    }

    // The seed of the fullest ring that is nearest to one: some way on from that of the seed before, or anywhere.
    int nearest(int k, int i) const
    {
        const int start = start_[fullest_], end = end_[fullest_];
        const Square far = squareOf({object_.spacing() * Real(2.5), Real(0), Real(0)});
        int n = near_[k];
        if (n >= 0)
            while (n + 1 < end && between(i, n + 1) <= between(i, n))
                ++n;
        if (n >= 0 && between(i, n) < far)
            return n;
        n = start;
        for (int j = start + 1; j < end; ++j)
            if (between(i, j) < between(i, n))
                n = j;
        // What lies just before the first of them is first.
        return i == start_[k] && 2 * n > start + end ? start : n;
    }
};

// Calls `each` with the seeds of every patch of an object.
template <class Each>
void forPatches(const SoftObject& object, Each each)
{
    for (int ring = 0; ring < object.rings(); ring += PATCH_RINGS) {
        const Band band(object, ring);
        Run run;
        if (object.stretched()) {
            Follower follower(object, ring, band.rings);
            while (follower.next(run))
                each(run);
            continue;
        }
        for (int i = 0; i < band.runs; ++i) {
            for (int k = 0; k < PATCH_RINGS; ++k) {
                run.first[k] = run.count[k] = 0;
                if (k >= band.rings)
                    continue;
                const int start = object.ringStart(ring + k), inRing = object.ringStart(ring + k + 1) - start;
                run.first[k] = start + inRing * i / band.runs;
                run.count[k] = start + inRing * (i + 1) / band.runs - run.first[k];
            }
            each(run);
        }
    }
}

int patchesOf(const SoftObject& object)
{
    int patches = 0;
    forPatches(object, [&](const Run&) { ++patches; });
    return patches;
}

void makePatches(const SoftObject& object, Patch* patches)
{
    forPatches(object, [&](const Run& run) {
        if (stopAsked())
            return;
        Patch& patch = *patches++;
        int middle = 0, rings = 0;
        for (int k = 0; k < PATCH_RINGS; ++k) {
            patch.first[k] = run.first[k];
            patch.count[k] = static_cast<uint8_t>(run.count[k]);
            if (run.count[k] > 0)
                rings = k + 1;
        }
        for (int k = 0; k < PATCH_RINGS; ++k)
            if (run.count[k] > 0 && (run.count[middle] == 0 || k == rings / 2))
                middle = k;
        patch.centre = 2 * (run.first[middle] + run.count[middle] / 2);
        setPatch(object, patch);
        beginPatch(object, patch);
    });
}

void reshapePatches(const SoftObject& object, Patch* patches, int count, uint32_t reading)
{
    for (int i = 0; i < count; ++i) {
        setPatch(object, patches[i]);
        patches[i].due = reading;
        patches[i].stale = true;
        patches[i].bend.known = false;
    }
}

bool restsAway(const Patch& patch, const OwnFrame& own)
{
    // The eye is no farther from the patch than this.
    const int32_t aside = (patch.middle[0] < 0 ? -patch.middle[0] : patch.middle[0]) +
                          (patch.middle[1] < 0 ? -patch.middle[1] : patch.middle[1]) +
                          (patch.middle[2] < 0 ? -patch.middle[2] : patch.middle[2]);
    const int32_t doubt = (((own.distance32 >> 1) + aside) * patch.spread >> 14) + patch.radius;
    return facing(patch, toEyeFrom(above(patch, 0), own)) < ((own.distance32 >> 1) * own.limb >> 14) - doubt;
}

Bound boundOf(const Patch& patch, int32_t restRadius)
{
    const int32_t position = (patch.nearest + patch.farthest) >> 1, half = (patch.farthest - patch.nearest + 1) >> 1;
    const Step middle = above(patch, patch.path * (position - 64) >> 6);
    const int32_t widest = patch.farthest > 64 ? patch.farthest : 64;
    int32_t radius = restRadius * widest + patch.path * half;
    if (patch.lean != 0)
        radius += patch.lean * (position < 64 ? 64 - patch.nearest : widest - 64);
    return {middle.x, middle.y, middle.z, radius >> 6};
}

bool reaches(const Neighbour& near, const Bound& ball)
{
    return within(fromCore(near, {ball.x, ball.y, ball.z}), near.size16 + ball.radius);
}

bool isWithin(const Patch& patch, const Neighbour& near, Real position, Real part)
{
    const int32_t at = rawFromReal(position) >> 10, size = near.size16 * (rawFromReal(part) >> 8) >> 8;
    const int32_t left = size - (patch.tight * (at > 64 ? at : 64) >> 6);
    return left > 0 && within(fromCore(near, above(patch, patch.path * (at - 64) >> 6)), left);
}

void classify(Patch& patch, const Neighbourhood& all)
{
    // Half way along what is left of the paths when their seeds are at rest, where the own field ends; or along all of them.
    const int32_t half = all.deep ? patch.path * (rawFromReal(all.last) >> 10) >> 7 : patch.path >> 1;
    const Step beyond = above(patch, all.deep ? half - patch.path : half);
    const int32_t slack = steps16(LIST_SLACK);
    const int32_t radius = half + patch.radius + (patch.radius >> 1) + patch.lean + slack;
    memset(patch.listed, 0, sizeof patch.listed);
    memset(patch.near, 0, sizeof patch.near);
    Bound ball = boundOf(patch, patch.radius);
    ball.radius += slack;
    for (int i = 0; i < all.count; ++i) {
        const Neighbour& near = all.neighbours[i];
        if (!within(fromCore(near, beyond), near.size16 + radius))
            continue;
        const int slot = near.object->slot();
        patch.listed[slot >> 5] |= 1u << (slot & 31);
        if (reaches(near, ball))
            patch.near[slot >> 5] |= 1u << (slot & 31);
    }
}

bool outOfSight(const Patch& patch, const OwnFrame& own)
{
    if (own.sideCount == 0)
        return false;
    const Bound ball = boundOf(patch, patch.radius);
    // Scales may be that much larger than their cells.
    const int32_t radius = ball.radius * 2;
    const int32_t growth = rawFromReal(own.growth) >> 8;
    for (int i = 0; i < own.sideCount; ++i) {
        const OwnFrame::Side& side = own.sides[i];
        const int32_t inside = (side.inward[0] * ball.x + side.inward[1] * ball.y + side.inward[2] * ball.z) >> 14;
        if (side.inside + ((inside + radius) * growth >> 8) < 0)
            return true;
    }
    return false;
}

int32_t facing(const SoftObject& object, const Seed& s, const OwnFrame& own)
{
    const Vector place = object.root(s.root) + s.path * s.position;
    const int32_t product = (s.normal.x * (own.eye32[0] - (rawFromReal(place.x) >> 11)) +
                             s.normal.y * (own.eye32[1] - (rawFromReal(place.y) >> 11)) +
                             s.normal.z * (own.eye32[2] - (rawFromReal(place.z) >> 11))) >> 14;
    return (product << 12) / (own.distance32 >> 2);
}
