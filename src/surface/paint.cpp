// The colours and the brightness of voxels.
#include "paint.h"

#include "math/whole.h"
#include "rt.h"
#include "voxels.h"

namespace {

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

}  // namespace

// The brightness of finishes, in an object's own axes.
static Polish polishOf(const SoftObject& object, const OwnFrame& own)
{
    int32_t up[3];
    store14(object.toOwnAxes({Real(0), Real(1), Real(0)}), up);
    return {own.light, own.ahead, up};
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
    : object_(object), paint_(*object.shown()->paint()), own_(own), polish_(polishOf(object, own)), list_(list),
      pattern_(*object.shown(), object), from_{Real(0), Real(0), Real(0)}
{
    if (paint_.pattern == PATTERN_NONE)
        return;
    // A hollow shows the pattern of the object that it is in.
    const SoftObject& shown = *object.shown();
    if (&shown != &object)
        from_ = object.toOwnAxes(object.centre() - shown.centre()) * quotient(Real(1), object.growth());
    const Real reach = clamp(object.spacing() * FARTHEST / pattern_.grain(), Real(0), Real(10));
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
        voxel.brightness = static_cast<int8_t>(polish_.brightness(paint_.finish, {s.normal.x, s.normal.y, s.normal.z}));
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
    return cutVoxel(componentAlong(inward, own_.right), componentAlong(inward, own_.up), componentAlong(inward, own_.ahead), apart,
                    shear.x, shear.y, voxel);
}

// The pattern at `place` (own space). `normal` is the surface's normal there, `mix` the number of its colour without a pattern.
Painter::Spot Painter::spotAt(const Vector& place, const Direction14& normal, uint8_t mix) const
{
    Real u[3];
    pattern_.toGrains(place + from_, u);
    Spot spot{pattern_.numberAt(u, mix), mix, false, {0, 0, 0}, 0};
    if (spot.number == mix)
        spot.beyond = paint_.other;
    Real nearest = reach2_;
    int edge = -1;
    for (int i = 0; i < pattern_.edgedAxes(); ++i) {
        u[i] -= Real(floorToInt(u[i]));
        const Real apart = u[i] < Real(0.5) ? u[i] : Real(1) - u[i];
        if (apart * apart >= nearest)
            continue;
        // The distance along the surface is `apart` divided by the sine of the angle between the normal and the axis.
        const Real cosine = dot(pattern_.axis(i), unitVector(normal));
        const Real slant = Real(1) - cosine * cosine;
        if (apart * apart >= nearest * slant)
            continue;
        nearest = quotient(apart * apart, slant);
        edge = i;
    }
    if (edge >= 0) {
        const bool above = u[edge] < Real(0.5);
        const Vector inward = above ? pattern_.axis(edge) : pattern_.axis(edge) * Real(-1);
        spot.edge = true;
        spot.apart = rawFromReal((above ? u[edge] : Real(1) - u[edge]) * pattern_.grain()) >> 8;
        spot.inward = {static_cast<int16_t>(rawFromReal(inward.x) >> 2), static_cast<int16_t>(rawFromReal(inward.y) >> 2),
                       static_cast<int16_t>(rawFromReal(inward.z) >> 2)};
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
