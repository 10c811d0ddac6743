// From seeds to voxels: what a seed looks like.
#include "voxels.h"

namespace {

inline int32_t magnitude(int32_t a)
{
    return a < 0 ? -a : a;
}

inline int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

inline int32_t limited(int32_t a, int32_t most)
{
    return a > most ? most : a < -most ? -most : a;
}

inline int32_t product(const Direction14& a, const int32_t b[3])
{
    return (a.x * b[0] + a.y * b[1] + a.z * b[2]) >> 14;
}

// A half axis of a cell on the picture plane; both sums of products are one, each 16 bits wide.
inline uint32_t onPicture(const int8_t axis[3], const Shading& v)
{
    return static_cast<uint32_t>(axis[0]) * v.cell[0] + static_cast<uint32_t>(axis[1]) * v.cell[1] +
           static_cast<uint32_t>(axis[2]) * v.cell[2];
}

inline int32_t width(uint32_t both)
{
    return magnitude(static_cast<int32_t>(both + 0x8000) >> 16);
}

inline int32_t height(uint32_t both)
{
    return magnitude(static_cast<int16_t>(both));
}

inline void shade(const Shading& v, const Seed& s, int32_t facing, Voxel& voxel)
{
    placeVoxel(v, s, voxel);
    const int32_t normalX = v.turned ? product(s.normal, v.right) : s.normal.x;
    const int32_t normalY = v.turned ? product(s.normal, v.up) : s.normal.y;
    const int32_t depth = v.depth + voxel.z;
    // The tangent plane: depth changes by n.x depth / (n . to eye) for a unit across the view.
    const uint32_t rise = (static_cast<uint32_t>(depth) << 8) / static_cast<uint32_t>(facing);
    const int32_t steep = smaller(static_cast<int32_t>(rise), STEEPEST_TILT);
    const int16_t tiltX = static_cast<int16_t>(normalX * steep >> 14);
    const int16_t tiltY = static_cast<int16_t>(normalY * steep >> 14);
    voxel.tiltX = tiltX;
    voxel.tiltY = tiltY;
    // Half width and height. Beside each other, cells of a ring make a band: rectangles as wide as the way from one to the
    // next need not cover the whole of their cells, only, together, the band.
    const uint32_t along = onPicture(s.cellAlong, v);
    int32_t wide = width(along), high = height(along);
    if (s.cellArea <= v.wholeMost) {
        const uint32_t across = onPicture(s.cellAcross, v);
        wide = (wide + width(across)) >> v.cellShift;
        high = (high + height(across)) >> v.cellShift;
    } else {
        const uint32_t area = static_cast<uint32_t>(mulHigh(s.cellArea * (facing >> 3), v.areaShare));
        wide >>= v.cellShift;
        high >>= v.cellShift;
        if (wide > high)
            high += static_cast<int32_t>(area / static_cast<uint32_t>(wide));
        else if (high > 0)
            wide += static_cast<int32_t>(area / static_cast<uint32_t>(high));
    }
    wide = smaller(wide + (wide >> MARGIN_SHIFT) + MARGIN_UNITS, 0x7fff);
    high = smaller(high + (high >> MARGIN_SHIFT) + MARGIN_UNITS, 0x7fff);
    voxel.wide = static_cast<int16_t>(wide);
    voxel.high = static_cast<int16_t>(high);
    voxel.reach = 0;
    voxel.cutX = voxel.cutY = voxel.slopeX = voxel.slopeY = 0;
    voxel.cutAt = 0;
    // Where a round surface bends out of sight its tangent plane goes on: the scale ends there. The limb is cos^2 radius / 2
    // away across the view, with cos the cosine of normal and viewer; along the plane that is cos radius / 2 deep.
    const int32_t reach = (v.horizonShare * facing >> 16) + 1;
    if (reach < 256 && (magnitude(tiltX) * wide + magnitude(tiltY) * high) >> 11 >= reach)
        voxel.reach = static_cast<uint8_t>(reach);
    if (voxel.brightness == 0)
        return;
    // How the brightness changes across the scale, 1/8 step a unit; not at all when that is next to nothing.
    int32_t slopeX = (v.gradient[0] + (tiltX * v.gradientAhead >> 4)) >> 8;
    int32_t slopeY = (v.gradient[1] + (tiltY * v.gradientAhead >> 4)) >> 8;
    int32_t corner = (magnitude(slopeX) * wide + magnitude(slopeY) * high) >> 8;
    if (corner < FLAT_SHADING)
        return;
    for (; corner > SHADING_MOST * 8; corner >>= 1) {
        slopeX >>= 1;
        slopeY >>= 1;
    }
    voxel.slopeX = static_cast<int8_t>(limited(slopeX, 127));
    voxel.slopeY = static_cast<int8_t>(limited(slopeY, 127));
}

}  // namespace

int findSeeds(Shading* shading, SoftObject& object, Patch* patch, Seen* seen)
{
    Seen* to = seen;
    uint32_t some = 0, all = 0xff;
    const auto find = [&](Seed& s, Voxel* voxel) {
        if (!(s.flags & SEED_VALID))
            return;
        int32_t facing = 0;
        if (s.flags & SEED_MEASURED) {
            facing = facingOf(s, *shading);
            if (facing <= shading->limb)
                return;
        }
        *to++ = {&s, facing, voxel};
        some |= s.flags;
        all &= s.flags;
    };
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        Voxel* voxel = patch->voxels == nullptr ? nullptr : patch->voxels + ring * PATCH_SEEDS;
        for (int i = patch->first[ring], end = i + patch->count[ring]; i < end; ++i) {
            find(object.regular(2 * i), voxel);
            if (voxel != nullptr)
                ++voxel;
            Seed* const extra = patch->extras ? object.extra(2 * i) : nullptr;
            if (extra != nullptr && (extra->flags & SEED_ACTIVE))
                find(*extra, nullptr);
        }
    }
    shading->flags = some | all << 8;
    return static_cast<int>(to - seen);
}

void shadeSeedsC(const Shading* shading, const Seen* seen, int count)
{
    for (const Seen* const end = seen + count; seen < end; ++seen)
        shade(*shading, *seen->seed, seen->facing, *seen->voxel);
}
