// Strips: how they are made, and what is known of all seeds of a strip at once.
#include "math/normal.h"
#include "strip.h"

namespace {

// Squared distance over squared size below which a neighbour's field alone is 0.49, which with what is left of the own
// field is more than the isovalue; in 1/256.
constexpr int32_t ENCLOSING = 65;

// Cosine (1.0 = 2^14) of a strip's axis to the viewer below which it is taken to be hidden by its own object however far
// blending pulls it.
constexpr int32_t HIDDEN = -13100;

int32_t steps16(Real units)
{
    return rawFromReal(units) >> 12;
}

Direction14 direction(const Vector& unitVector)
{
    return {static_cast<int16_t>(rawFromReal(unitVector.x) >> 2), static_cast<int16_t>(rawFromReal(unitVector.y) >> 2),
            static_cast<int16_t>(rawFromReal(unitVector.z) >> 2)};
}

void setStrip(const SoftObject& object, Strip& strip)
{
    const Real share = Real(1) / Real(static_cast<int>(strip.count)), part(1.0 / 16384);
    Vector middle{Real(0), Real(0), Real(0)}, axis = middle;
    Real path(0);
    const auto rest = [&](const Seed& s) { return object.root(s.root) + s.path; };
    const auto normal = [&](const Seed& s) {
        return Vector{part * Real(static_cast<int>(s.normal.x)), part * Real(static_cast<int>(s.normal.y)),
                      part * Real(static_cast<int>(s.normal.z))};
    };
    for (int i = 0; i < strip.count; ++i) {
        const Seed& s = object.seed(2 * (strip.first + i));
        middle = middle + rest(s) * share;
        axis = axis + normal(s) * share;
        path += length(s.path) * share;
    }
    axis = unit(axis);
    Real radius(0), spread(0);
    for (int i = 0; i < strip.count; ++i) {
        const Seed& s = object.seed(2 * (strip.first + i));
        radius = most(radius, length(rest(s) - middle));
        spread = most(spread, length(normal(s) - axis));
    }
    const Direction14 d = direction(axis);
    strip.axis[0] = d.x;
    strip.axis[1] = d.y;
    strip.axis[2] = d.z;
    strip.spread = static_cast<int16_t>(rawFromReal(least(spread, Real(1.9))) >> 2);
    strip.middle[0] = static_cast<int16_t>(steps16(middle.x));
    strip.middle[1] = static_cast<int16_t>(steps16(middle.y));
    strip.middle[2] = static_cast<int16_t>(steps16(middle.z));
    strip.radius = static_cast<int16_t>(steps16(radius + shiftDown(object.spacing(), 1)) + 2);
    strip.path = static_cast<int16_t>(steps16(path) + 1);
    strip.state = STRIP_NEW;
}

struct Step {
    int32_t x, y, z;  // 1/16 unit
};

inline int32_t square(const Step& s)
{
    return s.x * s.x + s.y * s.y + s.z * s.z;
}

// A place of own space on the strip's axis, `out` (1/16 unit) above where it rests.
inline Step above(const Strip& strip, int32_t out)
{
    return {strip.middle[0] + (strip.axis[0] * out >> 14), strip.middle[1] + (strip.axis[1] * out >> 14),
            strip.middle[2] + (strip.axis[2] * out >> 14)};
}

inline Step fromCore(const Neighbour& near, const Step& at)
{
    if (near.point)
        return {at.x - near.x16, at.y - near.y16, at.z - near.z16};
    const Vector v = near.fromCore16({realFromRaw(at.x << 12), realFromRaw(at.y << 12), realFromRaw(at.z << 12)});
    return {floorToInt(v.x), floorToInt(v.y), floorToInt(v.z)};
}

inline bool within(const Step& away, int32_t distance)
{
    return square(away) < distance * distance;
}

// Whether the neighbour's field alone encloses the strip wherever its seeds may lie on their paths: a convex distance that
// is small enough at both ends is so between them.
bool encloses(const Neighbour& near, const Strip& strip, const Step& atRest)
{
    const auto deep = [&](const Step& away, int32_t radius) {
        const int32_t reach = (near.size16 * 129 >> 8) - 1 - radius;  // sqrt(ENCLOSING / 256) = 0.504
        static_assert(ENCLOSING == 65, "its root");
        return reach > 0 && within(away, reach);
    };
    return near.object->coreConvex() && deep(atRest, strip.radius) &&
           deep(fromCore(near, above(strip, strip.path)), 2 * strip.radius);
}

// The strip's axis times what leads from a place to the eye, 1/16 unit.
inline int32_t facing(const Strip& strip, const Step& toEye)
{
    return (strip.axis[0] * toEye.x + strip.axis[1] * toEye.y + strip.axis[2] * toEye.z) >> 14;
}

Step toEyeFrom(const Step& place, const OwnFrame& own)
{
    return {(own.eye32[0] >> 1) - place.x, (own.eye32[1] >> 1) - place.y, (own.eye32[2] >> 1) - place.z};
}

// Whether the gradient of a neighbour's field points away from the eye wherever the strip's seeds may settle: at both ends
// of their paths, and between them, where the scalar product is at most a quarter of the squared way larger.
bool pointsAway(const Neighbour& near, const Strip& strip, const Step& atRest, const OwnFrame& own)
{
    const int32_t sway = strip.radius * 2, distance = own.distance32 >> 1;
    const auto away = [&](const Step& v, const Step& place) {
        const Step e = toEyeFrom(place, own);
        const int32_t product = ((v.x * e.x + v.y * e.y) >> 4) + (v.z * e.z >> 4);
        const int32_t doubt = (sway * (distance + near.size16) >> 4) + (strip.path * strip.path >> 6);
        return product + doubt < 0;
    };
    const Step end = above(strip, strip.path);
    return away(atRest, above(strip, 0)) && away(fromCore(near, end), end);
}

}  // namespace

int stripsOf(const SoftObject& object)
{
    int strips = 0;
    for (int k = 0; k < object.rings(); ++k)
        strips += (object.ringStart(k + 1) - object.ringStart(k) + STRIP_SEEDS - 1) / STRIP_SEEDS;
    return strips;
}

void makeStrips(const SoftObject& object, Strip* strips)
{
    for (int k = 0; k < object.rings(); ++k) {
        const int start = object.ringStart(k), inRing = object.ringStart(k + 1) - start;
        const int runs = (inRing + STRIP_SEEDS - 1) / STRIP_SEEDS;
        for (int r = 0; r < runs; ++r, ++strips) {
            strips->first = start + inRing * r / runs;
            strips->count = static_cast<uint8_t>(start + inRing * (r + 1) / runs - strips->first);
            setStrip(object, *strips);
        }
    }
}

bool restsAway(const Strip& strip, const OwnFrame& own)
{
    const int32_t doubt = ((own.distance32 >> 1) * strip.spread >> 14) + strip.radius;
    return facing(strip, toEyeFrom(above(strip, 0), own)) < -doubt;
}

StripState classify(const Strip& strip, const OwnFrame& own, const Neighbour* neighbours, int count, Reached& reached)
{
    const Step rest = above(strip, 0);
    // Seeds that a neighbour pulls out may come within reach of another: half way along what is left of their paths.
    const Step beyond = above(strip, strip.path >> 1);
    const int32_t beyondRadius = (strip.path >> 1) + strip.radius + (strip.radius >> 1);
    bool touched = false;
    reached.count = 0;
    for (const Neighbour* near = neighbours; near < neighbours + count; ++near) {
        const Step away = fromCore(*near, rest);
        if (within(away, near->size16 + strip.radius)) {
            touched = true;
            if (encloses(*near, strip, away))
                return STRIP_INSIDE;
        } else if (!within(fromCore(*near, beyond), near->size16 + beyondRadius)) {
            continue;
        }
        reached.near[reached.count++] = near;
    }
    if (!touched)
        return STRIP_REST;

    const Step toEye = toEyeFrom(rest, own);
    const int32_t front = facing(strip, toEye), distance = own.distance32 >> 1;
    if (front >= 0)
        return STRIP_MIXED;
    if (front < distance * (HIDDEN / 4) >> 12)
        return STRIP_AWAY;
    // Seeds that are pushed in are seen from farther round.
    const int32_t doubt = (distance * strip.spread >> 14) + strip.radius + (strip.path >> 2);
    if (front >= -doubt)
        return STRIP_MIXED;
    for (int i = 0; i < reached.count; ++i)
        if (!pointsAway(*reached.near[i], strip, fromCore(*reached.near[i], rest), own))
            return STRIP_MIXED;
    return STRIP_AWAY;
}
