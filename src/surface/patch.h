// Patch: neighbouring seeds of three rings, judged as one by the seed in their midst. Most seeds of a frame need no look of
// their own: their patch rests, lies inside a neighbour or faces away.
#ifndef FB_PATCH_H
#define FB_PATCH_H

#include "gather.h"

// The report's overshoot tolerance: by how much a neighbour's field may be stronger than that of a seed's own object.
constexpr Real OVERSHOOT(0.05);

// A patch has seeds of this many rings beside each other, and at most so many of each.
constexpr int PATCH_RINGS = 3;
constexpr int PATCH_SEEDS = 3;

enum PatchState : uint8_t {
    PATCH_REST,    // no neighbour reaches it
    PATCH_INSIDE,  // it lies inside a neighbour, or where that is stronger
    PATCH_AWAY,    // a neighbour reaches it, and it faces away from the viewer, or is hidden
    PATCH_MIXED,   // its seeds are settled
};

// How the surface of a patch bends, from the normals of its seeds.
struct Bend {
    int16_t turn[6];    // by how much the normal turns along x, y, z on a way along the same, along y or x on one along the other,
                        // so for z and x, y and z; 1.0 = 2^13 over 256 steps of places (voxels.h); along the normal as much as
                        // along the way on which it turns most
    Direction14 normal;
    bool ball;          // it bends as a ball does; nothing else is known
    bool known;         // it has been measured since the patch rests, or does not any more
    bool stale;         // seeds have settled since it was measured
    bool gentle;        // over so many spacings that no scale ends but next to the limb (shade.cpp)
};

// By how much the normal turns on a way along `v`, any length: as Bend::turn.
inline void turnAlong(const Bend& bend, const int32_t v[3], int32_t to[3])
{
    const int16_t(&t)[6] = bend.turn;
    to[0] = (t[0] * v[0] + t[3] * v[1] + t[4] * v[2]) >> 14;
    to[1] = (t[3] * v[0] + t[1] * v[1] + t[5] * v[2]) >> 14;
    to[2] = (t[4] * v[0] + t[5] * v[1] + t[2] * v[2]) >> 14;
}

// Units as 1/16 units.
inline int32_t steps16(Real units)
{
    return rawFromReal(units) >> 12;
}

// Lengths in 1/16 unit of own space, directions with 1.0 = 2^14.
struct Patch {
    int32_t first[PATCH_RINGS];  // of each ring, the number of its first regular seed in the patch
    uint8_t count[PATCH_RINGS];  // and how many there are
    PatchState state;
    uint8_t blocker;    // Seed::blocker, when the one in the middle was not on the surface the last time
    bool stale;         // its lists have to be made anew
    bool reached;       // one that has come since the frame before reaches its seeds where they are
    bool stirred;       // and one did so then, or does so now; where all is common both are taken for granted
    bool settled;       // its seeds were looked at in this frame
    bool asleep;        // all but the one in the middle sleep
    bool extras;        // oversampled seeds of it take part
    bool fine;          // and fine ones
    bool islands;       // and seeds on islands, where the paths of its regular ones come back
    int32_t facing;     // of a settled patch: cosine of the surface in the middle and the direction to the viewer
    int32_t centre;     // slot of the seed in the middle
    int16_t middle[3];  // of where its seeds rest
    int16_t radius;     // of a ball round the middle that holds all of those places and half a cell more
    int16_t tight;      // of one that just holds them
    int16_t axis[3];    // the mean of their normals
    int16_t spread;     // greatest length of the difference of a normal to the axis
    int16_t behind;     // where one of its seeds at rest faces a viewer, the axis times his place, and `spread` times his distance
                        // more, is no less than this
    int16_t path;       // mean length of their paths; of a shaped object, along the axis
    int16_t lean;       // how far from there one of them leads at most; 0: all lead along their normals
    uint8_t nearest, farthest;          // between which positions its seeds are, 1/64
    uint32_t due, listDue;              // readings of the odometer (odometer.h) when it, and when its lists are due
    uint16_t travelled;      // how far those on its lists have come in all, 1/1024 unit; it goes round
    // Its lists, a bit for the slot of each neighbour: those that may reach some place on its paths, and those that may reach
    // its seeds where they are.
    uint32_t listed[SLOTS_MAX / 32], near[SLOTS_MAX / 32];
    Bend bend;
};

// Calls `each` with every regular seed of an object's patch.
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

// Calls `each` with the slot of every neighbour on a list.
template <class Each>
inline void forNeighbours(const uint32_t list[SLOTS_MAX / 32], Each each)
{
    for (int word = 0; word < SLOTS_MAX / 32; ++word)
        for (uint32_t bits = list[word]; bits != 0; bits &= bits - 1)
            each(32 * word + __builtin_ctz(bits));
}

inline bool isListed(const uint32_t list[SLOTS_MAX / 32])
{
    uint32_t any = 0;
    for (int word = 0; word < SLOTS_MAX / 32; ++word)
        any |= list[word];
    return any != 0;
}

inline bool isListed(const uint32_t list[SLOTS_MAX / 32], int slot)
{
    return (list[slot >> 5] >> (slot & 31) & 1) != 0;
}

// How many patches the seeds of an object make.
int patchesOf(const SoftObject& object);

// Fills them in.
void makePatches(const SoftObject& object, Patch* patches);

// Measures them anew, when the seeds rest elsewhere. They are due at once, by the reading of the odometer.
void reshapePatches(const SoftObject& object, Patch* patches, int count, uint32_t reading);

// Makes the lists of a patch anew. They hold until a neighbour has come nearer by LIST_SLACK.
void classify(Patch& patch, const Neighbourhood& all);
constexpr Real LIST_SLACK = GATHER_SLACK;

// A ball round the seeds of a patch where they are, 1/16 unit, from one round where they rest.
struct Bound {
    int32_t x, y, z, radius;
};
Bound boundOf(const Patch& patch, int32_t restRadius);

// Whether a neighbour's field reaches into a ball; most neighbours are points.
bool reachesFromCore(const Neighbour& near, const Bound& ball);
inline bool reaches(const Neighbour& near, const Bound& ball)
{
    if (near.kind != Neighbour::POINT)
        return reachesFromCore(near, ball);
    const int32_t x = ball.x - near.x16, y = ball.y - near.y16, z = ball.z - near.z16, reach = near.size16 + ball.radius;
    return x * x + y * y + z * z < reach * reach;
}

// Whether all seeds of a patch, if they were at one position, would lie nearer to a neighbour's core than a part of its size.
bool isWithin(const Patch& patch, const Neighbour& near, Real position, Real part);

// Whether a patch lies beside the view, where its seeds are, where they rest, and in between.
bool outOfSight(const Patch& patch, const OwnFrame& own);

// Whether a patch is hidden behind what is nearer: where its seeds are, or if they all were at one position.
bool isHidden(const Patch& patch, const OwnFrame& own);
bool isHidden(const Patch& patch, Real position, const OwnFrame& own);

// Whether a patch at rest faces away from the viewer.
inline bool restsAway(const Patch& patch, const OwnFrame& own)
{
    const int32_t most = patch.axis[0] * own.eye16[0] + patch.axis[1] * own.eye16[1] + patch.axis[2] * own.eye16[2] +
                         patch.spread * own.distance16;
    return most >> 14 < own.limb16 + patch.behind;
}

// Cosine of the surface at a seed and the direction to the viewer, 1.0 = 2^14, about.
int32_t facing(const SoftObject& object, const Seed& s, const OwnFrame& own);

#endif
