// Patch: neighbouring seeds of a few rings, near enough to each other to be judged as one. Most seeds of a frame need no look
// of their own: their patch rests, lies inside a neighbour or faces away.
#ifndef FB_PATCH_H
#define FB_PATCH_H

#include "gather.h"

// The report's overshoot tolerance: by how much a neighbour's field may be stronger than that of a seed's own object.
constexpr Real OVERSHOOT(0.05);

// A patch has seeds of this many rings beside each other, and at most so many of each.
constexpr int PATCH_RINGS = 3;
constexpr int PATCH_SEEDS = 4;

enum PatchState : uint8_t {
    PATCH_NEW,     // not judged since the seeds were laid out
    PATCH_REST,    // no neighbour reaches it
    PATCH_INSIDE,  // a neighbour's surface encloses it
    PATCH_AWAY,    // a neighbour reaches it, and wherever it settles it faces away from the viewer
    PATCH_MIXED,   // its seeds are settled one by one
};

// Lengths in 1/16 unit of own space, directions with 1.0 = 2^14.
struct Patch {
    int32_t first[PATCH_RINGS];  // of each ring, the number of its first regular seed in the patch
    uint8_t count[PATCH_RINGS];  // and how many there are
    PatchState state;
    bool barren;        // none of its seeds was on the surface when they were settled last
    int16_t middle[3];  // of where its seeds rest
    int16_t radius;     // of a ball round it that holds all of those, and half a cell more
    int16_t axis[3];    // the mean of their normals
    int16_t spread;     // greatest length of the difference of a normal to the axis
    int16_t path;       // mean length of their paths
    uint32_t reached[(NEIGHBOURS_MAX + 31) / 32];  // of a PATCH_MIXED one: the neighbours that may reach it, by bits
};

// Calls `each` with the slot of every regular seed of a patch.
template <class Each>
inline void forSeeds(const Patch& patch, Each each)
{
    for (int ring = 0; ring < PATCH_RINGS; ++ring)
        for (int i = patch.first[ring], end = i + patch.count[ring]; i < end; ++i)
            each(2 * i);
}

// The neighbours that may reach a patch.
struct Reached {
    const Neighbour* near[NEIGHBOURS_MAX];
    int count;
};

// How many patches the seeds of an object make.
int patchesOf(const SoftObject& object);

// Fills them in.
void makePatches(const SoftObject& object, Patch* patches);

// Finds out what becomes of a patch in this frame: its state, and the neighbours that reach it.
void classify(Patch& patch, const OwnFrame& own, const Neighbour* neighbours, int count);

// Whether a patch at rest faces away from the viewer.
bool restsAway(const Patch& patch, const OwnFrame& own);

#endif
