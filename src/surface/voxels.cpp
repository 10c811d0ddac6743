// From seeds to voxels, the readable reference for asm/voxels.S.
#include "voxels.h"

namespace {

// Both sides of a cut overlap: each goes on for this distance beyond the line, 1/256 unit.
constexpr int32_t CUT_MARGIN = 12;

// A vector of own space projected onto the picture plane along the ray of sight.
struct OnPicture {
    int32_t x, y;

    // x and y are computed with one sum of products: each takes 16 bits of it.
    OnPicture(const int8_t axis[3], const Shading& v)
    {
        const uint32_t both = static_cast<uint32_t>(axis[0]) * v.cell[0] + static_cast<uint32_t>(axis[1]) * v.cell[1] +
                              static_cast<uint32_t>(axis[2]) * v.cell[2];
        x = static_cast<int32_t>(both + 0x8000) >> 16;
        y = static_cast<int16_t>(both);
    }
};

inline int32_t product(const int8_t axis[3], const Direction14& n)
{
    return axis[0] * n.x + axis[1] * n.y + axis[2] * n.z;
}

// The cell of a seed that is not at rest: the cell of the unblended surface is scaled by the position and projected along the path
// onto the tangent plane. A half axis e becomes p (e - u (e.n) / (u.n)), with position p, unit vector u along the path, normal n.
struct Fall {
    int32_t position;  // p, 8 fraction bits
    int32_t share;     // p / (u.n), 8 fraction bits
    OnPicture way;     // u
    bool torn;         // the cell does not form an even band with its neighbours any more

    Fall(const Seed& s, const Shading& v) : position(rawFromReal(s.position) >> 8), way(s.way, v)
    {
        if (position < v.leastPosition)
            position = v.leastPosition;
        int32_t cosine = product(s.way, s.normal) >> 7;
        torn = magnitude(cosine) < ASLANT;
        if (magnitude(cosine) < LEAST_COSINE)
            cosine = cosine < 0 ? -LEAST_COSINE : LEAST_COSINE;
        share = (position << 14) / cosine;
    }
    OnPicture of(const int8_t axis[3], const Seed& s, const Shading& v) const
    {
        OnPicture e(axis, v);
        const int32_t off = ((product(axis, s.normal) >> 7) * share) >> 14;
        e.x = (e.x * position - way.x * off) >> 8;
        e.y = (e.y * position - way.y * off) >> 8;
        return e;
    }
    int32_t area(int32_t rest) const
    {
        return min32((rest * magnitude(share) >> 8) * position >> 8, AREA_MOST);
    }
};

// Half extents of a scale, 1/256 unit.
struct Extents {
    int32_t halfWidth, halfHeight;
};

// Half extents of a seed's scale. `cell` is the area of the seed's cell, or 0 if the scale has to cover the whole cell, and
// onPicture(axis) projects a half axis of the cell.
template <class Project>
inline Extents extentsOf(const Seed& s, int32_t cell, int32_t facing, const Shading& v, Project onPicture)
{
    const OnPicture along = onPicture(s.along);
    int32_t halfWidth = magnitude(along.x), halfHeight = magnitude(along.y);
    if (cell == 0 || facing < v.wholeBefore) {
        const OnPicture across = onPicture(s.across);
        return {(halfWidth + magnitude(across.x)) >> v.cellShift, (halfHeight + magnitude(across.y)) >> v.cellShift};
    }
    // The cells of a ring form a band. A rectangle that is as long as the step to the next seed need not cover its whole cell; it
    // is enough that all rectangles together cover the band.
    const uint32_t area = static_cast<uint32_t>(mulHigh(cell * (facing >> 3), v.areaShare));
    halfWidth >>= v.cellShift;
    halfHeight >>= v.cellShift;
    // In a band that is about diagonal, rectangles that are long in x would stand beside others that are long in y, and corners
    // of the band between the two would not be covered. There each rectangle is longer in x and y alike.
    if (halfWidth * 3 > halfHeight * 2 && halfHeight * 3 > halfWidth * 2) {
        const int32_t share = static_cast<int32_t>(area / static_cast<uint32_t>(halfWidth + halfHeight));
        halfWidth += share;
        halfHeight += share;
    } else if (halfWidth > halfHeight) {
        halfHeight += static_cast<int32_t>(area / static_cast<uint32_t>(halfWidth));
    } else if (halfHeight > 0) {
        halfWidth += static_cast<int32_t>(area / static_cast<uint32_t>(halfHeight));
    }
    return {halfWidth, halfHeight};
}

inline Extents extentsOf(const Seed& s, int32_t facing, const Shading& v)
{
    if (s.flags & SEED_RESTING)
        return extentsOf(s, s.area, facing, v, [&](const int8_t axis[3]) { return OnPicture(axis, v); });
    const Fall fall(s, v);
    return extentsOf(s, fall.torn ? 0 : fall.area(s.area), facing, v, [&](const int8_t axis[3]) { return fall.of(axis, s, v); });
}

// An extent with the margin by which scales overlap.
inline int32_t withMargin(int32_t extent)
{
    return min32(extent + (extent >> MARGIN_SHIFT) + MARGIN_UNITS, 0x7fff);
}

// Sets the extents of a voxel, and where it ends. Beyond the limb, where a round surface bends out of sight, its tangent plane
// would go on, so the scale has to end there. With c the cosine of normal and viewer, the limb is c^2 radius / 2 away across the
// view; the plane gets c radius / 2 deeper there, which is `back`. The limb is a curve, and so it is nearer to the corners: on a
// ball, a corner that is e away from the centre lies beyond the limb where the plane gets at least back - e^2 / (4 back) deeper.
// (Where the plane gets less than half as deep as `back`, that is so only on balls hardly larger than a scale.)
inline void setExtents(const Shading& v, int32_t facing, Extents extents, Voxel& voxel)
{
    extents = {withMargin(extents.halfWidth), withMargin(extents.halfHeight)};
    voxel.back = voxel.front = 0;
    const int32_t back = (v.horizonShare * facing >> 16) + 1;
    const int32_t deep = (magnitude(voxel.tiltX) * extents.halfWidth + magnitude(voxel.tiltY) * extents.halfHeight) >> 8;
    const int32_t square = extents.halfWidth * extents.halfWidth + extents.halfHeight * extents.halfHeight;
    if (back < 256 && (deep >= back * 8 || (deep >= back * 4 && (back * 8 - deep) * back * 32 <= square))) {
        voxel.back = static_cast<uint8_t>(back);
        voxel.front = static_cast<uint8_t>(v.front);
        if (deep > v.deepest)
            extents = {extents.halfWidth * v.deepest / deep, extents.halfHeight * v.deepest / deep};
    }
    voxel.halfWidth = static_cast<int16_t>(extents.halfWidth);
    voxel.halfHeight = static_cast<int16_t>(extents.halfHeight);
}

// Sets all of a voxel but its place.
inline void shade(const Shading& v, const Seed& s, int32_t facing, Voxel& voxel)
{
    const int32_t normalX = v.turned ? dot(s.normal, v.right) >> 14 : s.normal.x;
    const int32_t normalY = v.turned ? dot(s.normal, v.up) >> 14 : s.normal.y;
    const int32_t depth = v.depth + voxel.z;
    // On the tangent plane the depth changes by n.x depth / (n . vector to the eye) over a unit along x, and likewise along y.
    const uint32_t rise = (static_cast<uint32_t>(depth) << 8) / static_cast<uint32_t>(facing);
    const int32_t steep = min32(static_cast<int32_t>(rise), STEEPEST_TILT);
    voxel.tiltX = static_cast<int16_t>(normalX * steep >> 14);
    voxel.tiltY = static_cast<int16_t>(normalY * steep >> 14);
    setExtents(v, facing, extentsOf(s, facing, v), voxel);
    voxel.cutX = voxel.cutY = voxel.slopeX = voxel.slopeY = 0;
    voxel.cutAt = 0;
    voxel.curveXX = voxel.curveXY = voxel.curveYY = 0;
    const int32_t light = lambert(dot(s.normal, v.light) >> 14);
    voxel.brightness = static_cast<int8_t>(light <= DARK_MIDDLE ? 0 : light);
    if (light <= DARK_MIDDLE)
        return;
    const int32_t slopeX = (v.gradient[0] + voxel.tiltX * v.gradientAhead) >> 12;
    const int32_t slopeY = (v.gradient[1] + voxel.tiltY * v.gradientAhead) >> 12;
    setSlopes(slopeX, slopeY, &voxel);
}

}  // namespace

bool findSeed(const Shading& v, const Seed& s, Seen* seen, Voxel* voxel)
{
    // A seed at rest counts as valid.
    if (!(s.flags & (SEED_VALID | SEED_RESTING)))
        return false;
    int32_t place[3], facing;
    findPlace(v, s, place);
    if (s.flags & SEED_RESTING)
        facing = ((s.normal.x * v.eye[0] + s.normal.y * v.eye[1] + s.normal.z * v.eye[2]) >> 11) - s.out;
    else
        facing = (s.normal.x * (v.eye[0] - (place[0] >> 3)) + s.normal.y * (v.eye[1] - (place[1] >> 3)) +
                  s.normal.z * (v.eye[2] - (place[2] >> 3))) >> 11;
    if (facing <= v.limb)
        return false;
    // More than 511 units from the object's centre the sum wraps around, which takes the voxel far out of the view.
    const auto along = [&](const int32_t axis[3]) {
        const auto part = [&](int i) { return static_cast<uint32_t>(place[i]) * static_cast<uint32_t>(axis[i]); };
        return static_cast<int32_t>(part(0) + part(1) + part(2)) >> 14;
    };
    voxel->x = v.turned ? along(v.toRight) : place[0];
    voxel->y = v.turned ? along(v.toUp) : place[1];
    voxel->z = v.turned ? along(v.toAhead) : place[2];
    *seen = {&s, facing};
    return true;
}

int findSeedsC(const Shading* shading, const Patch* patch, Seen* seen, Voxel* voxels)
{
    int count = 0;
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        const Seed* s = shading->seeds + patch->first[ring];
        for (const Seed* const end = s + patch->count[ring]; s < end; ++s)
            if (findSeed(*shading, *s, seen + count, voxels + count))
                ++count;
    }
    return count;
}

void shadeSeedsC(const Shading* shading, const Seen* seen, Voxel* voxels, int count)
{
    for (int i = 0; i < count; ++i)
        shade(*shading, *seen[i].seed, seen[i].facing, voxels[i]);
}

bool cutVoxel(int32_t x, int32_t y, int32_t z, int32_t apart, int32_t shearX, int32_t shearY, Voxel* voxel)
{
    // On the tilted scale a step across the view is also a step along the ray of sight.
    const int32_t ahead = (z + ((x * shearX + y * shearY) >> 10)) >> 2;
    int32_t cutX = x + (voxel->tiltX * ahead >> 6), cutY = y + (voxel->tiltY * ahead >> 6);
    const int32_t most = magnitude(cutX) | magnitude(cutY);
    if (most == 0)
        return true;
    // Scale the function to slopes of 7 bits and a sign.
    const int shift = most < 128 ? 0 : 25 - __builtin_clz(static_cast<uint32_t>(most));
    cutX >>= shift;
    cutY >>= shift;
    const int32_t at = (apart + CUT_MARGIN) * 512 >> shift;
    const int32_t corner = (magnitude(cutX) * voxel->halfWidth + magnitude(cutY) * voxel->halfHeight) >> 5;
    if (at >= corner)
        return true;
    if (at <= -corner)
        return false;
    voxel->cutX = static_cast<int8_t>(cutX);
    voxel->cutY = static_cast<int8_t>(cutY);
    voxel->cutAt = static_cast<int16_t>(limited(at, CUT_MOST));
    return true;
}
