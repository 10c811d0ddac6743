// Patches: how they are made, and what is known of all seeds of a patch at once.
#include "math/normal.h"
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
    Real path(0), radius(0), spread(0);
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
        path += length(s.path) * share;
    });
    axis = unit(axis);
    forSeeds(patch, [&](int i) {
        const Seed& s = object.seed(i);
        radius = most(radius, length(rest(s) - middle));
        spread = most(spread, length(normal(s) - axis));
    });
    const Direction14 d = direction(axis);
    patch.axis[0] = d.x;
    patch.axis[1] = d.y;
    patch.axis[2] = d.z;
    patch.spread = static_cast<int16_t>(rawFromReal(least(spread, Real(1.9))) >> 2);
    patch.middle[0] = static_cast<int16_t>(steps16(middle.x));
    patch.middle[1] = static_cast<int16_t>(steps16(middle.y));
    patch.middle[2] = static_cast<int16_t>(steps16(middle.z));
    patch.radius = static_cast<int16_t>(steps16(radius + shiftDown(object.spacing(), 1)) + 2);
    patch.path = static_cast<int16_t>(steps16(path) + 1);
    patch.state = PATCH_NEW;
    patch.barren = false;
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
    const Vector v = near.fromCore16({realFromRaw(at.x << 12), realFromRaw(at.y << 12), realFromRaw(at.z << 12)});
    return {floorToInt(v.x), floorToInt(v.y), floorToInt(v.z)};
}

inline bool within(const Step& away, int32_t distance)
{
    return square(away) < distance * distance;
}

// The square root of a squared distance.
int32_t root(uint32_t square)
{
    if (square == 0)
        return 0;
    // To 26 to 30 bits, which the table of reciprocal roots is for.
    const int shift = (__builtin_clz(square) - 2) & ~1;
    const uint32_t scaled = shift >= 0 ? square << shift : square >> -shift;
    const uint32_t r = static_cast<uint32_t>(static_cast<uint64_t>(scaled) * inverseRoots[scaled >> 20] >> 28);
    return static_cast<int32_t>(shift >= 0 ? r >> (shift / 2) : r << (-shift / 2));
}

// A neighbour's field at a distance from its core, 1/16 unit.
Real fieldAt(const Neighbour& near, int32_t distance)
{
    if (distance >= near.size16)
        return Real(0);
    const Real u = realFromRaw(distance < 0 ? 0 : distance * near.inverse >> 8);
    const Real t = u * u;
    return t < Real(1) ? geoffQuick(t).value : Real(0);
}

// A stretch of all paths of a patch: the part of space that the seeds may be in, and the own field at its ends.
struct Stretch {
    int32_t from, to;  // positions, 1/16
    Real most, least;  // of the own field there
};
constexpr Real own(double p)
{
    return Real(p >= 2 ? 0.0 : 1 - p * p / 4 * (22.0 / 9 - p * p / 4 * (17.0 / 9 - p * p / 4 * 4 / 9)));
}
constexpr Stretch STRETCHES[] = {{16, 20, own(1), own(1.25)}, {20, 25, own(1.25), own(1.5625)}, {25, 32, own(1.5625), own(2)}};

inline Step middleOf(const Patch& patch, const Stretch& stretch)
{
    return above(patch, patch.path * (stretch.from + stretch.to - 32) >> 5);
}

inline int32_t radiusOf(const Patch& patch, const Stretch& stretch)
{
    return (patch.radius * stretch.to >> 4) + (patch.path * (stretch.to - stretch.from) >> 5) + 1;
}

// Whether no seed of the patch can be on the surface of its own object: all along the paths either the fields sum up to
// more than the isovalue, or one of them is stronger than the own.
bool inside(const Patch& patch, const Reached& reached)
{
    for (const Stretch& stretch : STRETCHES) {
        const Step middle = middleOf(patch, stretch);
        const int32_t radius = radiusOf(patch, stretch);
        Real sum = stretch.least;
        bool proved = false;
        for (int i = 0; i < reached.count && !proved; ++i) {
            const Neighbour& near = *reached.near[i];
            const Real field = fieldAt(near, root(static_cast<uint32_t>(square(fromCore(near, middle)))) + radius);
            sum += field;
            proved = sum > ISOVALUE || field > stretch.most + OVERSHOOT;
        }
        if (!proved)
            return false;
    }
    return true;
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

// Whether the gradient of a neighbour's field points away from the eye wherever the patch's seeds may settle: at both ends
// of their paths, and between them, where the scalar product is at most a quarter of the squared way larger.
bool pointsAway(const Neighbour& near, const Patch& patch, const Step& atRest, const OwnFrame& own)
{
    const int32_t sway = patch.radius * 2, distance = own.distance32 >> 1;
    const auto away = [&](const Step& v, const Step& place) {
        const Step e = toEyeFrom(place, own);
        const int32_t product = ((v.x * e.x + v.y * e.y) >> 4) + (v.z * e.z >> 4);
        const int32_t doubt = (sway * (distance + near.size16) >> 4) + (patch.path * patch.path >> 6);
        return product + doubt < 0;
    };
    const Step end = above(patch, patch.path);
    return away(atRest, above(patch, 0)) && away(fromCore(near, end), end);
}

// Whether the patch is hidden behind its own object: behind the ball round its root that the unblended surface touches, where
// it is too far round for blending to pull it out beside that. `front` is as of facing().
bool hidden(const Patch& patch, const Reached& reached, const OwnFrame& own, int32_t front)
{
    // Cosine of path and direction to the eye, 1.0 = 2^14.
    const int32_t distance = own.distance32 >> 1;
    const int32_t along = front + patch.path + patch.radius + (distance * patch.spread >> 14);
    if (along >= 0)
        return false;
    const int32_t cosine = (along << 12) / distance;
    const Real sine2 = realFromRaw(65536 - (cosine * cosine >> 8));
    // Beyond this position it would show: t = p^2 / 4 = 1 / (4 sine^2).
    const Real t = sine2 < Real(0.36) ? Real(0.69) : Real(0.25) / sine2;
    constexpr Stretch NEAR{16, 26, Real(0), Real(0)};  // up to t = 0.69
    const Step middle = middleOf(patch, NEAR);
    const int32_t radius = radiusOf(patch, NEAR);
    Real sum = geoffQuick(t).value;
    for (int i = 0; i < reached.count; ++i) {
        const Neighbour& near = *reached.near[i];
        sum += fieldAt(near, root(static_cast<uint32_t>(square(fromCore(near, middle)))) - radius);
        if (sum >= ISOVALUE)
            return false;
    }
    return true;
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
        for (int run = 0; run < band.runs; ++run, ++patches) {
            for (int k = 0; k < PATCH_RINGS; ++k) {
                patches->first[k] = patches->count[k] = 0;
                if (k >= band.rings)
                    continue;
                const int start = object.ringStart(ring + k), inRing = object.ringStart(ring + k + 1) - start;
                patches->first[k] = start + inRing * run / band.runs;
                patches->count[k] = static_cast<uint8_t>(start + inRing * (run + 1) / band.runs - patches->first[k]);
            }
            setPatch(object, *patches);
        }
    }
}

bool restsAway(const Patch& patch, const OwnFrame& own)
{
    const int32_t doubt = ((own.distance32 >> 1) * patch.spread >> 14) + patch.radius;
    return facing(patch, toEyeFrom(above(patch, 0), own)) < -doubt;
}

static PatchState judge(const Patch& patch, const OwnFrame& own, const Reached& reached)
{
    // Asked only where it is likely: it costs as much as settling a seed.
    if (patch.barren && inside(patch, reached))
        return PATCH_INSIDE;
    const Step rest = above(patch, 0);
    const int32_t front = facing(patch, toEyeFrom(rest, own)), distance = own.distance32 >> 1;
    if (front >= 0)
        return PATCH_MIXED;
    if (hidden(patch, reached, own, front))
        return PATCH_AWAY;
    // Seeds that are pushed in are seen from farther round.
    const int32_t doubt = (distance * patch.spread >> 14) + patch.radius + (patch.path >> 2);
    if (front >= -doubt)
        return PATCH_MIXED;
    for (int i = 0; i < reached.count; ++i)
        if (!pointsAway(*reached.near[i], patch, fromCore(*reached.near[i], rest), own))
            return PATCH_MIXED;
    return PATCH_AWAY;
}

void classify(Patch& patch, const OwnFrame& own, const Neighbour* neighbours, int count)
{
    const Step rest = above(patch, 0);
    // Seeds that a neighbour pulls out may come within reach of another: half way along what is left of their paths.
    const Step beyond = above(patch, patch.path >> 1);
    const int32_t beyondRadius = (patch.path >> 1) + patch.radius + (patch.radius >> 1);
    bool touched = false;
    Reached reached;
    reached.count = 0;
    memset(patch.reached, 0, sizeof patch.reached);
    for (int i = 0; i < count; ++i) {
        const Neighbour& near = neighbours[i];
        if (within(fromCore(near, rest), near.size16 + patch.radius))
            touched = true;
        else if (!within(fromCore(near, beyond), near.size16 + beyondRadius))
            continue;
        reached.near[reached.count++] = &near;
        patch.reached[i >> 5] |= 1u << (i & 31);
    }
    patch.state = touched ? judge(patch, own, reached) : PATCH_REST;
}
