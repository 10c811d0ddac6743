// Patches: which seeds belong to which patch, and the measures of a patch that follow from where its seeds rest.
#include "patch.h"

#include "math/normal.h"
#include "math/whole.h"
#include "model/stop.h"
#include "rt.h"

namespace {

// --- The measures of a patch

// The direction of a unit vector.
Direction14 direction(const Vector& way)
{
    return {static_cast<int16_t>(rawFromReal(way.x) >> 2), static_cast<int16_t>(rawFromReal(way.y) >> 2),
            static_cast<int16_t>(rawFromReal(way.z) >> 2)};
}

Vector restOf(const SoftObject& object, const Seed& s)
{
    return object.root(s.root) + s.path;
}

Vector restNormalOf(const SoftObject& object, const Seed& s)
{
    // A seed that has left its rest has another normal now.
    return unitVector(s.flags & SEED_RESTING ? s.normal : object.restNormal(s));
}

// The mean length of a patch's paths; of a shaped object, whose paths are not parallel to normals, their mean extent along `axis`.
// `share` is 1 / the number of seeds.
Real pathOf(const SoftObject& object, const Patch& patch, const Vector& axis, Real share)
{
    Real path(0);
    if (object.shaped())
        forSeeds(object, patch, [&](const Seed& s) { path += dot(s.path, axis) * share; });
    else if (object.tapers())
        forSeeds(object, patch, [&](const Seed& s) { path += length(s.path) * share; });
    else
        path = object.radius();
    return path;
}

// The greatest distance, 1/16 unit, between the end of a shaped object's path and the end of the patch's mean path.
SELDOM int16_t leanOf(const SoftObject& object, const Patch& patch, const Vector& axis, Real path)
{
    Real most(0);
    forSeeds(object, patch, [&](const Seed& s) { most = ::max(most, length(s.path - axis * path)); });
    return static_cast<int16_t>(steps16(most) + 1);
}

void measure(const SoftObject& object, Patch& patch)
{
    int count = 0;
    for (int ring = 0; ring < PATCH_RINGS; ++ring)
        count += patch.count[ring];
    const Real share = Real(1) / Real(count);

    Vector middle{Real(0), Real(0), Real(0)}, axis = middle;
    forSeeds(object, patch, [&](const Seed& s) {
        middle = middle + restOf(object, s);
        axis = axis + restNormalOf(object, s);
    });
    middle = middle * share;
    axis = unit(axis * share);
    Square radius(0), spread(0);
    patch.ridged = false;
    forSeeds(object, patch, [&](const Seed& s) {
        patch.ridged |= s.beyond >= 0;
        const Square away = squareOf(restOf(object, s) - middle);
        const Square aside = squareOf(restNormalOf(object, s) - axis);
        radius = radius < away ? away : radius;
        spread = spread < aside ? aside : spread;
    });
    const Real path = pathOf(object, patch, axis, share);

    const Direction14 d = direction(axis);
    patch.axis[0] = d.x;
    patch.axis[1] = d.y;
    patch.axis[2] = d.z;
    patch.spread = static_cast<int16_t>(rawFromReal(min(lengthOf(spread), Real(1.9))) >> 2);
    patch.middle[0] = static_cast<int16_t>(steps16(middle.x));
    patch.middle[1] = static_cast<int16_t>(steps16(middle.y));
    patch.middle[2] = static_cast<int16_t>(steps16(middle.z));
    patch.radius = static_cast<int16_t>(steps16(lengthOf(radius) + shiftDown(object.spacing(), 1)) + 2);
    patch.tight = static_cast<int16_t>(steps16(lengthOf(radius)) + 1);
    const int32_t out = (d.x * patch.middle[0] + d.y * patch.middle[1] + d.z * patch.middle[2]) >> 14;
    const int32_t aside = magnitude(patch.middle[0]) + magnitude(patch.middle[1]) + magnitude(patch.middle[2]);
    patch.behind = static_cast<int16_t>(out - (aside * patch.spread >> 14) - patch.radius - 1);
    patch.path = static_cast<int16_t>(steps16(path) + 1);
    patch.lean = object.shaped() ? leanOf(object, patch, axis, path) : 0;
}

void beginPatch(const SoftObject& object, Patch& patch)
{
    patch.state = PATCH_REST;
    patch.extras = patch.fine = patch.islands = patch.settled = patch.asleep = patch.moved = false;
    patch.blocker = static_cast<uint8_t>(object.slot());
    // Where the surface of a weak object, or of a hollow, lies is not known yet.
    patch.nearest = object.rests() ? 64 : 0;
    patch.farthest = 64;
    patch.due = 0;
    patch.travelled = 0;
    patch.bend.known = false;
}

// --- Which seeds make a patch

// A band of patches: the number of its rings, from `ring` on, and the number of patches that its longest ring needs.
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

// The seeds of a patch: in each of its rings `count` seeds from `first` on.
struct Run {
    int first[PATCH_RINGS], count[PATCH_RINGS];
};

// Divides a band of a stretched object into patches. Rings of such an object leave out seeds, each in other places (thinning() in
// model/round.h). The patches follow the fullest ring of the band, and a seed of another ring joins the patch of that seed of the
// fullest ring that is nearest to it.
class Follower {
public:
    Follower(const SoftObject& object, int ring, int rings) : object_(object), rings_(rings), fullest_(0)
    {
        for (int k = 0; k < rings; ++k) {
            start_[k] = at_[k] = object.ringStart(ring + k);
            end_[k] = object.ringStart(ring + k + 1);
            near_[k] = known_[k][0].i = known_[k][1].i = -1;
            if (end_[k] - at_[k] > end_[fullest_] - at_[fullest_])
                fullest_ = k;
        }
        last_ = at_[fullest_];
    }

    // Finds the next patch. Returns false when there is none.
    bool next(Run& run)
    {
        bool late = false;
        int left = 0;
        for (int k = 0; k < rings_; ++k) {
            left += end_[k] - at_[k];
            // The patch before had no room for all the seeds that belong to it.
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
    // Of each ring: its first seed, its end (exclusive), and the first seed of the next patch.
    int start_[PATCH_RINGS], end_[PATCH_RINGS], at_[PATCH_RINGS];
    int near_[PATCH_RINGS];  // the seed of the fullest ring that is nearest to the seed before at_[], or -1
    struct Known {
        int i, from, nearest;  // findNearest() of seed i found `nearest` when it started at `from`
    } known_[PATCH_RINGS][2];
    int last_;               // the end (exclusive) of the patches so far, in the fullest ring

    // Whether seed i of ring k belongs to the patches so far.
    bool isWithin(int k, int i)
    {
        return i < end_[k] && (last_ == end_[fullest_] || (k == fullest_ ? i : nearest(k, i)) < last_);
    }

    Square between(int i, int n) const
    {
        return squareOf(restOf(object_, object_.regular(2 * i)) - restOf(object_, object_.regular(2 * n)));
    }

    // The seed of the fullest ring that is nearest to seed i of ring k. The last two answers of each ring are remembered.
    int nearest(int k, int i)
    {
        Known& known = known_[k][i == at_[k] ? 0 : 1];
        if (known.i != i || known.from != near_[k])
            known = {i, near_[k], findNearest(k, i)};
        return known.nearest;
    }

    // Searches onwards from the nearest seed of the seed before; where that fails, everywhere.
    int findNearest(int k, int i) const
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
        // Rings are closed: a first seed may be nearest to one near the end, but belongs to the first patch all the same.
        return i == start_[k] && 2 * n > start + end ? start : n;
    }
};

// Calls each(run) with the seeds of every patch of an object.
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

}  // namespace

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
        patch.middleSeed = 2 * (run.first[middle] + run.count[middle] / 2);
        measure(object, patch);
        beginPatch(object, patch);
    });
}

void reshapePatches(const SoftObject& object, Patch* patches, int count, uint32_t reading)
{
    for (int i = 0; i < count; ++i) {
        measure(object, patches[i]);
        patches[i].due = reading;
        patches[i].moved = true;
        patches[i].bend.known = false;
    }
}
