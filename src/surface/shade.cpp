// From settled seeds to voxels, in whole numbers, because it is done for every seed that is seen.
#include "shade.h"

#include "math/normal.h"

namespace {

inline int32_t product(const Direction14& a, const int32_t b[3])
{
    return (a.x * b[0] + a.y * b[1] + a.z * b[2]) >> 14;
}

inline int32_t magnitude(int32_t a)
{
    return a < 0 ? -a : a;
}

inline int32_t limited(int32_t a, int32_t most)
{
    return a > most ? most : a < -most ? -most : a;
}

// Nearer than this (1/32 unit) nothing is drawn.
constexpr int32_t NEAREST = 32;

// No scale is stretched to more than two and a half times its cell by blending: cosine of path and normal.
constexpr int32_t LEAST_COSINE = 6500;

// What a scale is larger than its cell to each side: a part of the cell (1/32), and what places are uncertain by (1/256 unit).
constexpr int32_t MARGIN = 1;
constexpr int32_t MARGIN_UNITS = 14;

// Beyond this cosine of path and normal a cell lies in no even band of its ring; inverse, 12 bits of fraction.
constexpr int32_t UNEVEN = 4329;

// Change of brightness (1/8 step) from the middle of a scale to its corner below which it has one brightness.
constexpr int32_t FLAT = 8;

}  // namespace

Shader::Shader(const SoftObject& object, const OwnFrame& own, const FrameContext& frame)
    : object_(object), own_(own), grown_(object.size() != object.laidSize()), turned_(!object.isBall()),
      spacing_(rawFromReal(object.spacing() * own.growth) >> 8)
{
    const Vector place = object.centre() - frame.eye;
    depth_ = rawFromReal(place.z) >> 11;
    away_[0] = rawFromReal(place.x) >> 11;
    away_[1] = rawFromReal(place.y) >> 11;
    // On a ball a scale that is seen nearly edge-on adds next to nothing to those before it; on flat parts it may be all
    // there is.
    limb_ = object.coreReach() > Real(0) ? own.distance32 >> 7 : own.distance32 * 5 >> 7;
    generalHorizon_ = rawFromReal(object.horizonRadius(own.eye)) >> 11;
    horizon_ = generalHorizon_;
    inverseRadius_ = (1 << 24) / ((rawFromReal(shiftDown(object.laidSize(), 1)) >> 10) + 1);
}

void Shader::setPatch(const Patch& patch)
{
    // The middle of the patch in the view, 1/32 unit.
    int32_t view[3];
    const int32_t* const axes[] = {own_.right, own_.up, own_.ahead};
    for (int i = 0; i < 3; ++i)
        view[i] = turned_ ? (patch.middle[0] * axes[i][0] + patch.middle[1] * axes[i][1] + patch.middle[2] * axes[i][2]) >> 13
                          : patch.middle[i] * 2;
    const int32_t depth = depth_ + view[2] < NEAREST ? NEAREST : depth_ + view[2];
    const int32_t shearX = limited(((away_[0] + view[0]) << 12) / depth, 5 << 12);
    const int32_t shearY = limited(((away_[1] + view[1]) << 12) / depth, 5 << 12);
    for (int i = 0; i < 3; ++i) {
        column_[i] = own_.right[i] - (own_.ahead[i] * shearX >> 12);
        row_[i] = own_.up[i] - (own_.ahead[i] * shearY >> 12);
    }
    if (object_.roots() > 1) {
        const Seed& s = object_.seed(patch.centre);
        horizon_ = rawFromReal(object_.horizonAt(object_.root(s.root), realFromRaw(generalHorizon_ << 11))) >> 11;
    }
}

// Place, tilt and brightness. False: it faces away.
inline bool Shader::place(const Seed& s, Voxel* voxel)
{
    Vector place = object_.root(s.root) + (s.flags & SEED_RESTING ? s.path : s.path * s.position);
    if (grown_)
        place = place * own_.growth;
    const int32_t x = rawFromReal(place.x) >> 8, y = rawFromReal(place.y) >> 8, z = rawFromReal(place.z) >> 8;
    const Direction14 n = s.normal;
    facing_ = (n.x * (own_.eye32[0] - (x >> 3)) + n.y * (own_.eye32[1] - (y >> 3)) + n.z * (own_.eye32[2] - (z >> 3))) >> 14;
    if (facing_ <= limb_)
        return false;
    int32_t nx = n.x, ny = n.y;
    if (turned_) {
        voxel->x = (x * own_.right[0] + y * own_.right[1] + z * own_.right[2]) >> 14;
        voxel->y = (x * own_.up[0] + y * own_.up[1] + z * own_.up[2]) >> 14;
        voxel->z = (x * own_.ahead[0] + y * own_.ahead[1] + z * own_.ahead[2]) >> 14;
        nx = product(n, own_.right);
        ny = product(n, own_.up);
    } else {
        voxel->x = x;
        voxel->y = y;
        voxel->z = z;
    }
    const int32_t depth = depth_ + (voxel->z >> 3);
    if (depth < NEAREST)
        return false;
    // The tangent plane: depth changes by n.x depth / (n . to eye) for a unit across the view.
    const int32_t steep = (depth << 8) / facing_;
    voxel->tiltX = static_cast<int16_t>(limited(nx * steep >> 14, 20000));
    voxel->tiltY = static_cast<int16_t>(limited(ny * steep >> 14, 20000));
    voxel->cutX = voxel->cutY = 0;
    voxel->cutAt = 0;
    voxel->brightness = static_cast<uint8_t>((s.brightness8 + 128) >> 8);
    return true;
}

// The cell of the unblended surface that is the seed's own, grown with the position, as it falls along the path onto the
// tangent plane. A half axis e becomes e - u (e.n) / (u.n) with u the path.
inline void Shader::cell(const Seed& s)
{
    const auto along = [&](const int32_t a[3]) { return s.along[0] * a[0] + s.along[1] * a[1] + s.along[2] * a[2]; };
    const auto across = [&](const int32_t a[3]) { return s.across[0] * a[0] + s.across[1] * a[1] + s.across[2] * a[2]; };
    // 1/64 spacing, 8 bits of fraction.
    int32_t ax, ay, cx, cy;
    if (turned_) {
        ax = along(column_) >> 6;
        ay = along(row_) >> 6;
        cx = across(column_) >> 6;
        cy = across(row_) >> 6;
    } else {
        ax = s.along[0] * 256 + (s.along[2] * column_[2] >> 6);
        ay = s.along[1] * 256 + (s.along[2] * row_[2] >> 6);
        cx = s.across[0] * 256 + (s.across[2] * column_[2] >> 6);
        cy = s.across[1] * 256 + (s.across[2] * row_[2] >> 6);
    }
    int32_t size = spacing_;
    uneven_ = false;
    if (!(s.flags & SEED_RESTING)) {
        const int32_t ux = rawFromReal(s.path.x) >> 10, uy = rawFromReal(s.path.y) >> 10, uz = rawFromReal(s.path.z) >> 10;
        int32_t cosine = mulShift16((ux * s.normal.x + uy * s.normal.y + uz * s.normal.z) >> 6, inverseRadius_) >> 2;
        if (cosine < LEAST_COSINE)
            cosine = LEAST_COSINE;
        const int32_t inverse = (1 << 26) / cosine;  // 12 bits of fraction
        uneven_ = inverse > UNEVEN;
        // (e.n) / (u.n), 1/64 spacing with 8 bits of fraction.
        const int32_t n[] = {s.normal.x, s.normal.y, s.normal.z};
        const int32_t offAlong = (along(n) >> 6) * (inverse >> 4) >> 8;
        const int32_t offAcross = (across(n) >> 6) * (inverse >> 4) >> 8;
        const int32_t ox = mulShift16((ux * column_[0] + uy * column_[1] + uz * column_[2]) >> 6, inverseRadius_) >> 2;
        const int32_t oy = mulShift16((ux * row_[0] + uy * row_[1] + uz * row_[2]) >> 6, inverseRadius_) >> 2;
        ax -= offAlong * ox >> 14;
        ay -= offAlong * oy >> 14;
        cx -= offAcross * ox >> 14;
        cy -= offAcross * oy >> 14;
        size = size * (rawFromReal(s.position) >> 8) >> 8;
    }
    along_.x = ax * size >> 14;
    along_.y = ay * size >> 14;
    across_.x = cx * size >> 14;
    across_.y = cy * size >> 14;
}

// Makes the cell so many times as long, 1/16.
inline void Shader::stretch(int32_t along16, int32_t across16)
{
    along_.x = along_.x * along16 >> 4;
    along_.y = along_.y * along16 >> 4;
    across_.x = across_.x * across16 >> 4;
    across_.y = across_.y * across16 >> 4;
}

// Half width and height of the scale. Beside each other, cells of a ring make a band: rectangles as wide as the way from one
// to the next need not cover the whole of their cells, only, together, the band.
inline void Shader::extents(bool whole, Voxel* voxel) const
{
    const int32_t ax = magnitude(along_.x), ay = magnitude(along_.y);
    int32_t width = ax, height = ay;
    if (whole) {
        width += magnitude(across_.x);
        height += magnitude(across_.y);
    } else if (ax > ay) {
        height += magnitude(across_.y - across_.x * ((along_.y << 6) / along_.x) / 64);
    } else if (ay > 0) {
        width += magnitude(across_.x - across_.y * ((along_.x << 6) / along_.y) / 64);
    }
    voxel->wide = static_cast<int16_t>(limited(width + (width >> 5) * MARGIN + MARGIN_UNITS, 32000));
    voxel->high = static_cast<int16_t>(limited(height + (height >> 5) * MARGIN + MARGIN_UNITS, 32000));
}

// Where a round surface bends out of sight its tangent plane goes on: the scale ends there. The limb is cos^2 radius / 2
// away across the view, with cos the cosine of normal and viewer; along the plane that is cos radius / 2 deep.
inline void Shader::end(Voxel* voxel) const
{
    const int32_t curvature = horizon_ > 8000 ? 8000 : horizon_;
    const int32_t reach = curvature * facing_ / (2 * own_.distance32) + 1;
    voxel->reach = 0;
    if (reach < 256 && (magnitude(voxel->tiltX) * voxel->wide + magnitude(voxel->tiltY) * voxel->high) >> 11 >= reach)
        voxel->reach = static_cast<uint8_t>(reach);
}

// How the brightness changes across the scale, from its change along two ways.
inline void Shader::slopes(const Way& along, const Way& across, Voxel* voxel)
{
    voxel->slopeX = voxel->slopeY = 0;
    const int32_t det = along.x * across.y - along.y * across.x;
    if (magnitude(det) < 512)
        return;
    // Per unit, in 1/8 step.
    const int32_t inverse = (1 << 28) / det;
    const auto slope = [inverse](int32_t top) {
        return static_cast<int32_t>(static_cast<int64_t>(top) * inverse >> 25);
    };
    int32_t x = slope(along.change * across.y - across.change * along.y);
    int32_t y = slope(along.x * across.change - across.x * along.change);
    int32_t corner = (magnitude(x) * voxel->wide + magnitude(y) * voxel->high) >> 8;
    if (corner < FLAT)
        return;
    for (; corner > SHADING_MOST * 8; corner >>= 1) {
        x /= 2;
        y /= 2;
    }
    voxel->slopeX = static_cast<int8_t>(limited(x, 127));
    voxel->slopeY = static_cast<int8_t>(limited(y, 127));
}

bool Shader::shade(const Seed& s, bool oversampled, Voxel* voxel)
{
    if (!place(s, voxel))
        return false;
    cell(s);
    extents(oversampled || uneven_, voxel);
    end(voxel);
    voxel->slopeX = voxel->slopeY = 0;
    if (oversampled || s.neighbour < 0)
        return true;
    // Half way along the ring: to the next seed of it, or at its end from the one before. Half way across: from N.
    const Seed &next = (&s)[2], &last = (&s)[-2], &n = object_.seed(s.neighbour);
    along_.change = across_.change = 0;
    if (&next <= &object_.seed(object_.seedSlots() - 2) && (next.flags & SEED_VALID) && next.neighbour >= s.neighbour)
        along_.change = (next.brightness8 - s.brightness8) >> 1;
    else if (last.flags & SEED_VALID)
        along_.change = (s.brightness8 - last.brightness8) >> 1;
    if (n.flags & SEED_VALID)
        across_.change = (s.brightness8 - n.brightness8 + (along_.change * s.aside >> 5)) >> 1;
    slopes(along_, across_, voxel);
    return true;
}

Shader::Way Shader::wayTo(const Vector& from, const Vector& to, int32_t change) const
{
    const Vector v = to - from;
    const int32_t x = rawFromReal(v.x) >> 8, y = rawFromReal(v.y) >> 8, z = rawFromReal(v.z) >> 8;
    return {(x * column_[0] + y * column_[1] + z * column_[2]) >> 15, (x * row_[0] + y * row_[1] + z * row_[2]) >> 15,
            change >> 1};
}

bool Shader::shadePatch(const Patch& patch, const Patch* patches, Voxel* voxel)
{
    const Seed& s = object_.seed(patch.centre);
    if (!place(s, voxel))
        return false;
    cell(s);
    stretch(patch.width16 + 4, 16 * PATCH_RINGS);
    extents(uneven_, voxel);
    end(voxel);
    const auto rests = [&](int beside) {
        const Seed& seed = object_.seed(patches[beside].centre);
        return object_.root(seed.root) + seed.path * seed.position;
    };
    const auto way = [&](int from, int to) {
        return wayTo(rests(from), rests(to), object_.seed(patches[to].centre).brightness8 - object_.seed(patches[from].centre).brightness8);
    };
    const int here = static_cast<int>(&patch - patches);
    slopes(way(patch.before, patch.next), way(patch.above < 0 ? here : patch.above, patch.below < 0 ? here : patch.below), voxel);
    return true;
}
