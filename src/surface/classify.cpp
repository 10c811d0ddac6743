// What can be said of all seeds of a patch at once: which neighbours may reach the patch, and whether it lies within one of them,
// is out of the view or is hidden.
#include "patch.h"

#include "math/whole.h"
#include "rt.h"

namespace {

struct Step {
    int32_t x, y, z;  // 1/16 unit
};

inline int32_t square(const Step& s)
{
    return s.x * s.x + s.y * s.y + s.z * s.z;
}

// The point of own space on the patch's axis that lies `out` (1/16 unit) above the middle of the seeds at rest.
inline Step above(const Patch& patch, int32_t out)
{
    return {patch.middle[0] + (patch.axis[0] * out >> 14), patch.middle[1] + (patch.axis[1] * out >> 14),
            patch.middle[2] + (patch.axis[2] * out >> 14)};
}

// The vector from a neighbour's core to a point of own space.
inline Step fromCore(const Neighbour& near, const Step& at)
{
    if (near.kind == Neighbour::POINT)
        return {at.x - near.x16, at.y - near.y16, at.z - near.z16};
    if (near.segment) {
        // The nearest point of the segment lies `on` along it from its centre.
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

// The bounding sphere of the seeds of a patch, if they are between two positions (1/64); `restRadius` is its radius at rest.
inline Bound boundOf(const Patch& patch, int32_t restRadius, int32_t nearest, int32_t farthest)
{
    if (nearest == 64 && farthest == 64)
        return {patch.middle[0], patch.middle[1], patch.middle[2], restRadius};
    const int32_t position = (nearest + farthest) >> 1, half = (farthest - nearest + 1) >> 1;
    const Step middle = above(patch, patch.path * (position - 64) >> 6);
    const int32_t widest = farthest > 64 ? farthest : 64;
    // The radius is the root of across^2 + along^2, which is at most the longer one plus half the shorter one.
    const int32_t across = restRadius * widest, along = patch.path * half;
    int32_t radius = across > along ? across + (along >> 1) : along + (across >> 1);
    if (patch.lean != 0)
        radius += patch.lean * (position < 64 ? 64 - nearest : widest - 64);
    return {middle.x, middle.y, middle.z, radius >> 6};
}

}  // namespace

Bound boundOf(const Patch& patch, int32_t restRadius)
{
    return boundOf(patch, restRadius, patch.nearest, patch.farthest);
}

bool reachesFromCore(const Neighbour& near, const Bound& ball)
{
    return within(fromCore(near, {ball.x, ball.y, ball.z}), near.size16 + ball.radius);
}

int32_t depthWithin(const Patch& patch, const Neighbour& near, Real position, Real part)
{
    const int32_t position64 = rawFromReal(position) >> 10, size = near.size16 * (rawFromReal(part) >> 8) >> 8;
    const int32_t left = size - (patch.tight * (position64 > 64 ? position64 : 64) >> 6);
    if (left <= 0)
        return 0;
    // The depth is left - distance = (left^2 - distance^2) / (left + distance), and the distance is less than `left`.
    const int32_t distance2 = square(fromCore(near, above(patch, patch.path * (position64 - 64) >> 6)));
    return (left * left - distance2 + 2 * left - 1) / (2 * left);
}

// From where the seeds rest to position 2, where a field of strength 1 ends; in a deep neighbourhood, the whole paths. `half` is
// half the length of that part.
Bound boundOfPaths(const Patch& patch, const Neighbourhood& all)
{
    const int32_t half = all.deep ? patch.path * (rawFromReal(all.last) >> 10) >> 7 : patch.path >> 1;
    const Step middle = above(patch, all.deep ? half - patch.path : half);
    return {middle.x, middle.y, middle.z, half + patch.radius + (patch.radius >> 1) + patch.lean};
}

bool outOfSight(const Patch& patch, const OwnFrame& own)
{
    if (own.sideCount == 0)
        return false;
    const int32_t nearest = patch.nearest < 64 ? patch.nearest : 64, farthest = patch.farthest > 64 ? patch.farthest : 64;
    const Bound ball = boundOf(patch, patch.radius, nearest, farthest);
    // The radius is doubled because scales may be larger than their cells.
    const int32_t radius = ball.radius * 2;
    for (int i = 0; i < own.sideCount; ++i) {
        const OwnFrame::Side& side = own.sides[i];
        const int32_t inside = (side.inward[0] * ball.x + side.inward[1] * ball.y + side.inward[2] * ball.z) >> 14;
        if (inside + radius < side.begin)
            return true;
    }
    return false;
}

// Whether a sphere in own space is hidden behind what is nearer.
static bool isHidden(const Bound& ball, const OwnFrame& own)
{
    const int32_t growth = rawFromReal(own.growth) >> 8;
    const auto along = [&](const int32_t axis[3], int i) {
        const int32_t distance = (axis[0] * ball.x + axis[1] * ball.y + axis[2] * ball.z) >> 14;
        return own.centre[i] + (distance * growth >> 4);
    };
    const int32_t place[] = {along(own.right, 0), along(own.up, 1), along(own.ahead, 2)};
    return own.hider->hides(place, ball.radius * growth >> 4);
}

bool isHidden(const Patch& patch, const OwnFrame& own)
{
    return own.hider != nullptr && isHidden(boundOf(patch, patch.radius), own);
}

bool isHidden(const Patch& patch, Real position, const OwnFrame& own)
{
    if (own.hider == nullptr)
        return false;
    const int32_t position64 = rawFromReal(position) >> 10, widest = position64 > 64 ? position64 : 64;
    const Step middle = above(patch, patch.path * (position64 - 64) >> 6);
    return isHidden(Bound{middle.x, middle.y, middle.z, (patch.radius + patch.lean) * widest >> 6}, own);
}

int32_t facing(const SoftObject& object, const Seed& s, const OwnFrame& own)
{
    const Vector place = object.root(s.root) + s.path * s.position;
    const int32_t product = (s.normal.x * (own.eye32[0] - (rawFromReal(place.x) >> 11)) +
                             s.normal.y * (own.eye32[1] - (rawFromReal(place.y) >> 11)) +
                             s.normal.z * (own.eye32[2] - (rawFromReal(place.z) >> 11))) >> 14;
    return (product << 12) / (own.distance32 >> 2);
}
