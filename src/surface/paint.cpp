// Finishes, patterns and the colours of voxels.
#include "paint.h"

#include "math/normal.h"
#include "rt.h"

namespace {

// A product of cosines, 1.0 = 2^14.
inline int32_t times(int32_t a, int32_t b)
{
    return a * b >> 14;
}

inline int32_t along(const Direction14& n, const int32_t axis[3])
{
    return (n.x * axis[0] + n.y * axis[1] + n.z * axis[2]) >> 14;
}

constexpr int32_t ONE = 1 << 14;

// Of the light that falls on what shines, the share that is scattered.
constexpr int32_t SCATTERED = ONE * 3 / 4;

// What a mirror shows of its surroundings by the height of where it looks, -1 straight down, 1 straight up: a dark ground,
// a horizon, a sky that is bright above it. Straight lines between.
struct Corner {
    int32_t height, light;
};
constexpr Corner SURROUNDINGS[] = {{-ONE, ONE / 2}, {-ONE * 3 / 10, ONE / 12}, {ONE * 3 / 10, ONE}, {ONE, ONE / 2}};

int32_t surroundings(int32_t height)
{
    const Corner* c = SURROUNDINGS;
    while (c < SURROUNDINGS + 2 && height > c[1].height)
        ++c;
    return c->light + (height - c->height) * (c[1].light - c->light) / (c[1].height - c->height);
}

// The cosine of the normal and what is half way between light and viewer, to the 16th.
int32_t highlight(int32_t cosine)
{
    if (cosine <= 0)
        return 0;
    for (int i = 0; i < 4; ++i)
        cosine = times(cosine, cosine);
    return cosine;
}

// Spacings: no scale reaches farther along the surface.
constexpr Real FARTHEST(2);

// A cosine of 14 bits of fraction.
inline Real part(int32_t cosine14)
{
    return realFromRaw(cosine14 * 4);
}

// A sine, of turns.
Real wave(Real turns)
{
    return sine(static_cast<Angle>(rawFromReal(turns)) << 16);
}

}  // namespace

void polish(SoftObject& object, const OwnFrame& own)
{
    const Finish finish = object.paint()->finish;
    if (finish == FINISH_MATT)
        return;
    const Vector up = object.toOwnAxes({Real(0), Real(1), Real(0)});
    const int32_t up14[] = {rawFromReal(up.x) >> 2, rawFromReal(up.y) >> 2, rawFromReal(up.z) >> 2};
    const Normal half = normalise({realFromRaw((own.light[0] - own.ahead[0]) * 4), realFromRaw((own.light[1] - own.ahead[1]) * 4),
                                   realFromRaw((own.light[2] - own.ahead[2]) * 4)});
    const int32_t half14[] = {half.x, half.y, half.z};
    const int32_t upAhead = (up14[0] * own.ahead[0] + up14[1] * own.ahead[1] + up14[2] * own.ahead[2]) >> 14;
    for (int i = 0; i < object.seedSlots(); ++i) {
        Seed& s = object.seed(i);
        if (!(s.flags & SEED_VALID))
            continue;
        int32_t light;
        if (finish == FINISH_SHINY) {
            const int32_t cosine = along(s.normal, own.light);
            light = cosine <= 0 ? 0 : times(cosine, SCATTERED);
        } else {
            light = surroundings(upAhead - 2 * times(along(s.normal, own.ahead), along(s.normal, up14)));
        }
        light += times(ONE - light, highlight(along(s.normal, half14)));
        light = light > ONE ? ONE : light < 0 ? 0 : light;
        s.brightness8 = static_cast<int16_t>(light * BRIGHTEST >> 6);
    }
}

Grain::Grain(const SoftObject& object) : paint_(*object.paint())
{
    for (int i = 0; i < 3; ++i) {
        const Matrix& turn = object.turn();
        const Vector axis{turn.m[0][i], turn.m[1][i], turn.m[2][i]};
        axis_[i] = object.toOwnAxes(axis);
    }
    if (paint_.pattern == PATTERN_NONE)
        return;
    edge_ = paint_.grain * (object.size() / paint_.made);
    inverse_ = object.growth() / edge_;
    const Real reach = clamp(object.spacing() * FARTHEST / edge_, Real(0), Real(10));
    reach2_ = reach * reach;
}

Grain::Spot Grain::at(const Vector& place, const Direction14& normal, uint8_t mix) const
{
    Spot spot{mix, paint_.other, false, {0, 0, 0}, 0};
    if (paint_.pattern == PATTERN_NONE)
        return spot;
    Real u[3];
    for (int i = 0; i < 3; ++i)
        u[i] = dot(place, axis_[i]) * inverse_;
    if (paint_.pattern == PATTERN_MARBLE) {
        // A light and a dark vein in two grains.
        const Real bent = u[0] * Real(0.5) + Real(0.3) * wave(u[1] * Real(0.35) + Real(0.2)) +
                          Real(0.2) * wave(u[2] * Real(0.55) + u[1] * Real(0.2));
        const Real share = Real(0.5) + Real(0.5) * wave(bent);
        const Vector& from = paint_.paints->placeOf(mix);
        spot.number = paint_.paints->numberAt(from + (paint_.otherAt - from) * share, paint_.shines());
        return spot;
    }
    // Checks are cubes, stripes are slices along x.
    const int axes = paint_.pattern == PATTERN_CHECKS ? 3 : 1;
    bool odd = false;
    Real nearest = reach2_;
    int edge = -1;
    for (int i = 0; i < axes; ++i) {
        const int whole = floorToInt(u[i]);
        odd = odd != ((whole & 1) != 0);
        u[i] -= Real(whole);
        const Real apart = u[i] < Real(0.5) ? u[i] : Real(1) - u[i];
        if (apart * apart >= nearest)
            continue;
        // The way along the surface.
        const Vector& axis = axis_[i];
        const Real cosine = axis.x * part(normal.x) + axis.y * part(normal.y) + axis.z * part(normal.z);
        const Real slant = Real(1) - cosine * cosine;
        if (apart * apart >= nearest * slant)
            continue;
        nearest = quotient(apart * apart, slant);
        edge = i;
    }
    if (edge >= 0) {
        const bool above = u[edge] < Real(0.5);
        const Vector inward = above ? axis_[edge] : axis_[edge] * Real(-1);
        spot.edge = true;
        spot.apart = rawFromReal((above ? u[edge] : Real(1) - u[edge]) * edge_) >> 8;
        spot.inward = {static_cast<int16_t>(rawFromReal(inward.x) >> 2), static_cast<int16_t>(rawFromReal(inward.y) >> 2),
                       static_cast<int16_t>(rawFromReal(inward.z) >> 2)};
    }
    if (odd) {
        spot.number = paint_.other;
        spot.beyond = mix;
    }
    return spot;
}

void sortByColour(VoxelList& list, const Paint& paint)
{
    int first[RUNS_MOST + 1] = {};
    for (int i = 0; i < list.count; ++i)
        ++first[list.number[i] + 1];
    list.runs = 0;
    for (int n = 0; n < RUNS_MOST; ++n) {
        if (first[n + 1] > 0)
            list.run[list.runs++] = {paint.ramps + n * paint.rampRoom, first[n] + first[n + 1]};
        first[n + 1] += first[n];
    }
    for (int i = 0; i < list.count; ++i)
        list.voxels[first[list.number[i]]++] = list.store + i;
}
