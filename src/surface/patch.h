// Patch: up to nine neighbouring seeds, from three rings, that are judged together by the seed in their middle. Most seeds need no
// work of their own in a frame, because their patch rests, lies inside a neighbour or faces away from the viewer.
#ifndef FB_PATCH_H
#define FB_PATCH_H

#include "bend.h"
#include "gather.h"

// The report's overshoot tolerance: a seed belongs to the surface as long as no neighbour's field exceeds the own field by more.
constexpr Real OVERSHOOT(0.05);

// The number of adjacent rings that a patch has seeds of, and the largest number of seeds from each.
constexpr int PATCH_RINGS = 3;
constexpr int PATCH_SEEDS = 3;

// Upper bound on the seeds of a patch, with oversampled and fine ones.
constexpr int PATCH_SEEDS_MOST = (2 + SoftObject::FINE_SEEDS) * PATCH_RINGS * PATCH_SEEDS;

enum PatchState : uint8_t {
    PATCH_REST,    // no neighbour reaches it: all its seeds are at rest
    PATCH_OFF,     // all of it is off the surface: inside the body, where a neighbour is stronger than the own object, or dug away
    PATCH_AWAY,    // a neighbour reaches it, but it faces away from the viewer, is hidden or is out of sight
    PATCH_MIXED,   // a neighbour reaches it, and its seeds are settled one by one
};

// Converts units to 1/16 units, rounding down.
inline int32_t steps16(Real units)
{
    return rawFromReal(units) >> 12;
}

// Lengths in 1/16 unit of own space, directions with 1.0 = 2^14.
struct Patch {
    int32_t first[PATCH_RINGS];  // of each ring, the number of its first regular seed in the patch
    uint8_t count[PATCH_RINGS];  // and how many there are
    PatchState state;
    uint8_t blocker;    // Seed::blocker of the middle seed, when that was not on the surface the last time
    bool settled;       // its seeds were settled in the last update
    bool asleep;        // all its seeds but the middle one are SEED_ASLEEP
    bool extras;        // some of its oversampled seeds take part
    bool fine;          // some of its fine seeds take part
    bool moved;         // since it was settled its voxels have gone on (keeper.h), or its seeds were laid out anew
    bool ridged;        // some of its seeds lie beside a ridge (Seed::beyond)
    bool islands;       // it has seeds on islands, where the paths of its regular seeds return to the surface
    int32_t middleSeed; // slot of the middle seed
    int16_t middle[3];  // the mean of the places where its seeds rest
    int16_t radius;     // of a ball round the middle that contains those places and half a cell more
    int16_t tight;      // of a ball round the middle that just contains those places
    int16_t axis[3];    // the mean of the normals at rest, unit length
    int16_t spread;     // the greatest length of the difference of such a normal and the axis
    int16_t behind;     // if one of its seeds at rest faces a viewer at V, then axis * V + spread * |V| is at least this
    int16_t path;       // the mean length of its paths; of a shaped object, their extent along the axis
    int16_t lean;       // the greatest distance between a path's end and `path` along the axis; 0 if the object is not shaped
    uint8_t nearest, farthest;          // the range of positions that contains those of its seeds, 1/64
    uint32_t due;       // the odometer's reading (odometer.h) at which the patch is due
    uint16_t travelled; // count of travel, 1/1024 unit, that wraps around: each update adds the greatest of a neighbour that may
                        // reach its paths, where the scene is not ordinary
    Bend bend;
};

// Calls each(seed) for every regular seed of an object's patch.
template <class Object, class Each>
inline void forSeeds(Object& object, const Patch& patch, Each each)
{
    auto* const seeds = &object.regular(0);
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        auto* s = seeds + patch.first[ring];
        for (int left = patch.count[ring]; left > 0; --left)
            each(*s++);
    }
}

// The number of patches that the seeds of an object make.
int patchesOf(const SoftObject& object);

// Fills in that many patches, all at rest; not all of them if the user wants to stop.
void makePatches(const SoftObject& object, Patch* patches);

// Measures the patches anew after the seeds have been laid out elsewhere. `reading` is the odometer's: all patches are due at once.
void reshapePatches(const SoftObject& object, Patch* patches, int count, uint32_t reading);

// A ball, 1/16 unit. boundOf() returns one that contains the seeds of a patch where they are now; a ball of `restRadius` round the
// patch's middle contains them at rest. boundOfPaths() returns one that contains all places that its seeds may move to.
struct Bound {
    int32_t x, y, z, radius;
};
Bound boundOf(const Patch& patch, int32_t restRadius);
Bound boundOfPaths(const Patch& patch, const Neighbourhood& all);

// Whether a neighbour's field reaches into a ball. The distance from its centre nearly always tells. (The steps are in the order
// that takes the fewest registers.)
bool reachesFromCore(const Neighbour& near, const Bound& ball);
inline bool reaches(const Neighbour& near, const Bound& ball)
{
    const int32_t x = ball.x - near.x16;
    int32_t away = x * x;
    const int32_t y = ball.y - near.y16;
    away += y * y;
    const int32_t z = ball.z - near.z16;
    away += z * z;
    const int32_t outer = near.outer16 + ball.radius;
    if (away >= outer * outer)
        return false;
    if (near.kind == Neighbour::POINT)
        return true;
    const int32_t inner = near.size16 - ROUNDED16 + ball.radius;
    return (near.segment && away < inner * inner) || reachesFromCore(near, ball);
}

// By how much all seeds of a patch, if they were at `position`, would be nearer to a neighbour's core than `part` of its size, 1/16
// unit: a lower bound, rounded up. 0 or less if some would not be nearer.
int32_t depthWithin(const Patch& patch, const Neighbour& near, Real position, Real part);

// Whether a patch lies outside the view with its seeds where they are, where they rest, and anywhere in between.
bool outOfSight(const Patch& patch, const OwnFrame& own);

// Whether a patch is hidden behind what is drawn already, with its seeds where they are, or as if all of them were at `position`.
bool isHidden(const Patch& patch, const OwnFrame& own);
bool isHidden(const Patch& patch, Real position, const OwnFrame& own);

// Whether a patch at rest faces away from the viewer.
inline bool restsAway(const Patch& patch, const OwnFrame& own)
{
    const int32_t most = patch.axis[0] * own.eye16[0] + patch.axis[1] * own.eye16[1] + patch.axis[2] * own.eye16[2] +
                         patch.spread * own.distance16;
    return most >> 14 < own.limb16 + patch.behind;
}

// The cosine of a seed's normal and the direction to the viewer, 1.0 = 2^14, approximately.
int32_t facing(const SoftObject& object, const Seed& s, const OwnFrame& own);

#endif
