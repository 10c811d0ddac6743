// Finishes, patterns and the colours of voxels.
#include "paint.h"

#include "math/normal.h"
#include "math/whole.h"
#include "rt.h"
#include "voxels.h"

namespace {

// A product of cosines, 1.0 = 2^14.
inline int32_t times(int32_t a, int32_t b)
{
    return a * b >> 14;
}

inline int32_t along(const Direction14& n, const int32_t axis[3])
{
    return dot(n, axis) >> 14;
}

constexpr int32_t ONE = 1 << 14;

// Share of the light that a shiny surface scatters, 1.0 = 2^14.
constexpr int32_t SCATTERED = ONE * 3 / 4;

// The surroundings that a mirror shows: light by the height of the reflected direction, -1 straight down, 1 straight up. The ground
// is dark towards the horizon, the sky bright above it; between these corners the light changes linearly. All have 1.0 = 2^14.
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

// The highlight of a finish that shines: the 16th power of the cosine of the normal and the direction half way between light and
// viewer.
int32_t highlight(int32_t cosine)
{
    if (cosine <= 0)
        return 0;
    for (int i = 0; i < 4; ++i)
        cosine = times(cosine, cosine);
    return cosine;
}

// Spacings: no scale reaches farther than this along the surface from its seed.
constexpr Real FARTHEST(2);

// The ray of sight through a voxel: how far it leads aside over a unit of depth, 10 fraction bits.
struct Shear {
    int32_t x, y;

    Shear(const VoxelList& list, const Voxel& voxel)
    {
        const int32_t depth = (list.z + voxel.z) >> 2, most = 5 << 10;
        x = depth <= 0 ? 0 : limited(((list.x + voxel.x) << 8) / depth, most);
        y = depth <= 0 ? 0 : limited(((list.y + voxel.y) << 8) / depth, most);
    }
};

// The sine of an angle in turns.
Real wave(Real turns)
{
    return sine(static_cast<Angle>(rawFromReal(turns)) << 16);
}

}  // namespace

Polish::Polish(const SoftObject& object, const OwnFrame& own) : own_(own), mirror_(object.shown()->paint()->finish == FINISH_MIRROR)
{
    const Vector up = object.toOwnAxes({Real(0), Real(1), Real(0)});
    const Normal half = normalise({realFromRaw((own.light[0] - own.ahead[0]) * 4), realFromRaw((own.light[1] - own.ahead[1]) * 4),
                                   realFromRaw((own.light[2] - own.ahead[2]) * 4)});
    up_[0] = rawFromReal(up.x) >> 2;
    up_[1] = rawFromReal(up.y) >> 2;
    up_[2] = rawFromReal(up.z) >> 2;
    half_[0] = half.x;
    half_[1] = half.y;
    half_[2] = half.z;
    upAhead_ = dot(up_, own.ahead) >> 14;
}

int32_t Polish::brightness8(const Direction14& normal) const
{
    int32_t light;
    if (mirror_) {
        light = surroundings(upAhead_ - 2 * times(along(normal, own_.ahead), along(normal, up_)));
    } else {
        const int32_t cosine = along(normal, own_.light);
        light = cosine <= 0 ? 0 : times(cosine, SCATTERED);
    }
    light += times(ONE - light, highlight(along(normal, half_)));
    return (light > ONE ? ONE : light < 0 ? 0 : light) * BRIGHTEST >> 6;
}

// The pattern at a place: `number` is the number of the colour there. If an edge of the pattern is near, `beyond` is the number of
// the colour beyond the edge, `inward` the direction away from the edge, and `apart` the distance to the edge.
struct Painter::Spot {
    uint8_t number, beyond;
    bool edge;
    Direction14 inward;
    int32_t apart;  // 1/256 unit
};

Painter::Painter(const SoftObject& object, const OwnFrame& own, VoxelList& list)
    : object_(object), paint_(*object.shown()->paint()), own_(own), polish_(object, own), list_(list),
      from_{Real(0), Real(0), Real(0)}
{
    if (paint_.pattern == PATTERN_NONE)
        return;
    // A hollow shows the pattern of the object that it is in.
    const SoftObject& shown = *object.shown();
    if (&shown != &object)
        from_ = object.toOwnAxes(object.centre() - shown.centre()) * quotient(Real(1), object.growth());
    for (int i = 0; i < 3; ++i) {
        const Matrix& turn = shown.turn();
        axis_[i] = object.toOwnAxes({turn.m[0][i], turn.m[1][i], turn.m[2][i]});
    }
    edge_ = paint_.grain * (shown.size() / paint_.made);
    inverse_ = object.growth() / edge_;
    const Real reach = clamp(object.spacing() * FARTHEST / edge_, Real(0), Real(10));
    reach2_ = reach * reach;
}

Voxel* Painter::put(const Voxel& voxel, uint8_t number)
{
    Voxel* const place = list_.room();
    list_.number[list_.count] = number;
    *place = voxel;
    list_.take();
    return place;
}

Voxel* Painter::add(const Seed& s, const Voxel& shaded)
{
    Voxel voxel = shaded;
    if (paint_.shines()) {
        voxel.brightness = static_cast<int8_t>((polish_.brightness8(s.normal) + 128) >> 8);
        voxel.slopeX = voxel.slopeY = 0;
    }
    const uint8_t mix = paint_.mixes && !(s.flags & SEED_RESTING) ? s.mix : paint_.number;
    if (paint_.pattern == PATTERN_NONE)
        return put(voxel, mix);
    const Spot spot = spotAt(place(s), s.normal, mix);
    if (!spot.edge || isCut(voxel))
        return put(voxel, spot.number);
    // A voxel that the edge does not cut in two keeps the colour of its middle.
    const Direction14 outward{static_cast<int16_t>(-spot.inward.x), static_cast<int16_t>(-spot.inward.y),
                              static_cast<int16_t>(-spot.inward.z)};
    Voxel within = voxel, beyond = voxel;
    cut(spot.inward, spot.apart, &within);
    if (!isCut(within) || !cut(outward, -spot.apart, &beyond) || !isCut(beyond))
        return put(voxel, spot.number);
    Voxel* const shown = put(within, spot.number);
    put(beyond, spot.beyond);
    return shown;
}

bool Painter::cut(const Direction14& inward, int32_t apart, Voxel* voxel) const
{
    const Shear shear(list_, *voxel);
    return cutVoxel(along(inward, own_.right), along(inward, own_.up), along(inward, own_.ahead), apart, shear.x, shear.y, voxel);
}

// The pattern at `place` (own space). `normal` is the surface's normal there, `mix` the number of its colour without a pattern.
Painter::Spot Painter::spotAt(const Vector& place, const Direction14& normal, uint8_t mix) const
{
    Spot spot{mix, paint_.other, false, {0, 0, 0}, 0};
    Real u[3];
    for (int i = 0; i < 3; ++i)
        u[i] = dot(place + from_, axis_[i]) * inverse_;
    if (paint_.pattern == PATTERN_MARBLE) {
        // There are one light and one dark vein every two grains.
        const Real bent = u[0] * Real(0.5) + Real(0.3) * wave(u[1] * Real(0.35) + Real(0.2)) +
                          Real(0.2) * wave(u[2] * Real(0.55) + u[1] * Real(0.2));
        const Real share = Real(0.5) + Real(0.5) * wave(bent);
        const Vector& from = paint_.paints->placeOf(mix);
        spot.number = paint_.paints->numberAt(from + (paint_.otherAt - from) * share, paint_.shines());
        return spot;
    }
    // Checks are cubes; stripes are slices along the x axis.
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
        // The distance along the surface is `apart` divided by the sine of the angle between the normal and the axis.
        const Real cosine = dot(axis_[i], unitVector(normal));
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
    int16_t to[VOXELS_AT_ONCE];
    for (int i = 0; i < list.count; ++i)
        ++first[list.number[i] + 1];
    list.runs = 0;
    for (int n = 0; n < RUNS_MOST; ++n) {
        if (first[n + 1] > 0)
            list.run[list.runs++] = {paint.ramps + n * paint.rampRoom, first[n] + first[n + 1]};
        first[n + 1] += first[n];
    }
    for (int i = 0; i < list.count; ++i)
        to[i] = static_cast<int16_t>(first[list.number[i]]++);
    // Each exchange brings one voxel to its final place.
    for (int i = 0; i < list.count; ++i) {
        while (to[i] != i) {
            const int other = to[i];
            const auto voxel = list.voxels[i];
            list.voxels[i] = list.voxels[other];
            list.voxels[other] = voxel;
            to[i] = to[other];
            to[other] = static_cast<int16_t>(other);
        }
    }
}
