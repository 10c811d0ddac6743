// How the light changes around seeds beside a border, oversampled and fine seeds. Across other scales the brightness changes as it
// does from seed to seed (slopes.h), but about these some seeds are missing.
#include "border.h"
#include "math/whole.h"
#include "settle.h"
#include "surface/voxel.h"

namespace {

// The turn of a normal is measured over a step: at position 1 this part of the spacing, but no more than this part of the object's
// radius.
constexpr Real OF_SPACING(0.75), OF_RADIUS(0.125);
// Units of the world: no shorter step is divided by, so that `perTurn` times any turn fits 32 bits.
constexpr Real SHORTEST(0.125);
// Where the cosine of normal and light is smaller (1.0 = 2^14) the whole scale is dark.
constexpr int32_t DARK = -2000;
// Limit of Seed::lightChange.
constexpr int32_t GREATEST = INT16_MAX;

inline Real cosineOf(int32_t part14)
{
    return realFromRaw(part14 * 4);
}

}  // namespace

// By Lambert's law the brightness changes as the normal turns towards the light. A normal turns by equal amounts along two steps,
// each along the other: so one step along the surface, towards the light, tells how the brightness changes over any other.
void Settler::findLightChange(Seed& s)
{
    // Beside the rim of a hollow Seed::normal is not that of the surface at the seed (hollow.cpp).
    const Normal here = nearby_.dented() ? normalise(path_.outward(s.position)) : Normal{s.normal.x, s.normal.y, s.normal.z};
    const int32_t n[] = {here.x, here.y, here.z}, (&light)[3] = own_.light, (&eye)[3] = own_.eye16;
    const int32_t lit = dot(n, light) >> 14;
    if (lit < DARK || dot(n, eye) <= 0)
        return;
    const Real radius = object_.slants() ? nearLength(s.path) : object_.laidRadius();
    const Real length = min(object_.spacing() * OF_SPACING, radius * OF_RADIUS) * s.position;
    const auto part = [&](int i) { return cosineOf(light[i] - (n[i] * lit >> 14)) * length; };
    const Vector step{part(0), part(1), part(2)};
    // The step ends on a path beside the seed's, at a position a little farther out or in.
    const auto wayPart = [&](int i) { return realFromRaw(s.way[i] * (65536 / 127)); };
    const Vector way{wayPart(0), wayPart(1), wayPart(2)};
    const Real out = dot(step, way);
    const Normal there = normalise(path_.outwardBeside(s, s.position + quotient(out, radius), step - way * out));
    // 1/128 step a unit, for a turn of 1.
    const int32_t perTurn = rawFromReal(quotient(Real(BRIGHTEST), max(length * own_.growth, SHORTEST))) >> 9;
    const auto change = [&](int32_t turn) { return static_cast<int16_t>(limited(turn * perTurn >> 14, GREATEST)); };
    s.lightChange[0] = change(there.x - n[0]);
    s.lightChange[1] = change(there.y - n[1]);
    s.lightChange[2] = change(there.z - n[2]);
}
