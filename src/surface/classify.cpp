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

void setPatch(const SoftObject& object, Patch& patch)
{
    const Real part(1.0 / 16384);
    Vector middle{Real(0), Real(0), Real(0)}, axis = middle;
    Real path(0);
    Square radius(0), spread(0);
    const auto rest = [&](const Seed& s) { return object.root(s.root) + s.path; };
    const auto normal = [&](const Seed& s) {
        return Vector{part * Real(static_cast<int>(s.normal.x)), part * Real(static_cast<int>(s.normal.y)),
                      part * Real(static_cast<int>(s.normal.z))};
    };
    int count = 0;
    for (int ring = 0; ring < PATCH_RINGS; ++ring)
        count += patch.count[ring];
    const Real share = Real(1) / Real(count);
    forSeeds(patch, [&](int i) {
        const Seed& s = object.seed(i);
        middle = middle + rest(s) * share;
        axis = axis + normal(s) * share;
        if (object.tapers())
            path += length(s.path) * share;
    });
    if (!object.tapers())
        path = object.radius();
    axis = unit(axis);
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
    patch.state = PATCH_REST;
    patch.extras = patch.settled = patch.stale = false;
    patch.blocker = static_cast<uint8_t>(object.slot());
    patch.nearest = patch.farthest = 64;
    patch.due = patch.listDue = 0;
    memset(patch.listed, 0, sizeof patch.listed);
    memset(patch.near, 0, sizeof patch.near);
    patch.bend.stale = true;
    patch.voxels = nullptr;
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

int patchesOf(const SoftObject& object)
{
    int patches = 0;
    for (int ring = 0; ring < object.rings(); ring += PATCH_RINGS)
        patches += Band(object, ring).runs;
    return patches;
}

void makePatches(const SoftObject& object, Patch* patches)
{
    for (int ring = 0; ring < object.rings(); ring += PATCH_RINGS) {
        const Band band(object, ring);
        for (int run = 0; run < band.runs && !stopAsked(); ++run, ++patches) {
            for (int k = 0; k < PATCH_RINGS; ++k) {
                patches->first[k] = patches->count[k] = 0;
                if (k >= band.rings)
                    continue;
                const int start = object.ringStart(ring + k), inRing = object.ringStart(ring + k + 1) - start;
                patches->first[k] = start + inRing * run / band.runs;
                patches->count[k] = static_cast<uint8_t>(start + inRing * (run + 1) / band.runs - patches->first[k]);
            }
            const int k = patches->count[band.rings / 2] > 0 ? band.rings / 2 : 0;
            patches->centre = 2 * (patches->first[k] + patches->count[k] / 2);
            setPatch(object, *patches);
        }
    }
}

bool restsAway(const Patch& patch, const OwnFrame& own)
{
    // The eye is no farther from the patch than this.
    const int32_t aside = (patch.middle[0] < 0 ? -patch.middle[0] : patch.middle[0]) +
                          (patch.middle[1] < 0 ? -patch.middle[1] : patch.middle[1]) +
                          (patch.middle[2] < 0 ? -patch.middle[2] : patch.middle[2]);
    const int32_t doubt = (((own.distance32 >> 1) + aside) * patch.spread >> 14) + patch.radius;
    return facing(patch, toEyeFrom(above(patch, 0), own)) < -doubt;
}

Bound boundOf(const Patch& patch, int32_t restRadius)
{
    const int32_t position = (patch.nearest + patch.farthest) >> 1, half = (patch.farthest - patch.nearest + 1) >> 1;
    const Step middle = above(patch, patch.path * (position - 64) >> 6);
    const int32_t widest = patch.farthest > 64 ? patch.farthest : 64;
    return {middle.x, middle.y, middle.z, (restRadius * widest + patch.path * half) >> 6};
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
    const int32_t radius = half + patch.radius + (patch.radius >> 1) + slack;
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
