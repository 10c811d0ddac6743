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

// What a scale is larger than its cell: a part of the spacing (1.0 = 64 * 256), and what places of seeds are uncertain by
// (1/256 unit).
constexpr int32_t MARGIN = 64 * 256 * 3 / 64;
constexpr int32_t MARGIN_UNITS = 6;

// A cell whose path and normal part by more than this cosine says lies in no even band of its ring (inverse, 12 bits of
// fraction).
constexpr int32_t UNEVEN = 4329;

// Change of brightness (1/8 step) from the middle of a scale to its corner below which it has one brightness.
constexpr int32_t FLAT = 12;

}  // namespace

Shader::Shader(const SoftObject& object, const OwnFrame& own, const FrameContext& frame)
    : object_(object), own_(own), grown_(object.size() != object.laidSize()),
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
}

void Shader::setPatch(const Patch& patch)
{
    // The middle of the patch in the view, 1/32 unit.
    int32_t view[3];
    const int32_t* const axes[] = {own_.right, own_.up, own_.ahead};
    for (int i = 0; i < 3; ++i)
        view[i] = (patch.middle[0] * axes[i][0] + patch.middle[1] * axes[i][1] + patch.middle[2] * axes[i][2]) >> 13;
    const int32_t depth = depth_ + view[2] < NEAREST ? NEAREST : depth_ + view[2];
    const int32_t shearX = limited(((away_[0] + view[0]) << 12) / depth, 5 << 12);
    const int32_t shearY = limited(((away_[1] + view[1]) << 12) / depth, 5 << 12);
    for (int i = 0; i < 3; ++i) {
        column_[i] = own_.right[i] - (own_.ahead[i] * shearX >> 12);
        row_[i] = own_.up[i] - (own_.ahead[i] * shearY >> 12);
    }
    if (object_.roots() > 1) {
        const Seed& s = object_.seed(2 * patch.first[0]);
        horizon_ = rawFromReal(object_.horizonAt(object_.root(s.root), realFromRaw(generalHorizon_ << 11))) >> 11;
    }
}

bool Shader::shade(const Seed& s, bool oversampled, Voxel* voxel)
{
    // The seed's place from the centre, own axes.
    Vector place = object_.root(s.root) + (s.flags & SEED_RESTING ? s.path : s.path * s.position);
    if (grown_)
        place = place * own_.growth;
    const int32_t x = rawFromReal(place.x) >> 8, y = rawFromReal(place.y) >> 8, z = rawFromReal(place.z) >> 8;
    const int32_t facing = (s.normal.x * (own_.eye32[0] - (x >> 3)) + s.normal.y * (own_.eye32[1] - (y >> 3)) +
                            s.normal.z * (own_.eye32[2] - (z >> 3))) >> 14;
    if (facing <= limb_)
        return false;
    voxel->x = (x * own_.right[0] + y * own_.right[1] + z * own_.right[2]) >> 14;
    voxel->y = (x * own_.up[0] + y * own_.up[1] + z * own_.up[2]) >> 14;
    voxel->z = (x * own_.ahead[0] + y * own_.ahead[1] + z * own_.ahead[2]) >> 14;
    const int32_t depth = depth_ + (voxel->z >> 3);
    if (depth < NEAREST)
        return false;
    extents(s, facing, oversampled, voxel);
    // The tangent plane: depth changes by n.x depth / (n . to eye) for a unit across the view.
    const int32_t steep = (depth << 8) / facing;
    voxel->tiltX = static_cast<int16_t>(limited(product(s.normal, own_.right) * steep >> 14, 20000));
    voxel->tiltY = static_cast<int16_t>(limited(product(s.normal, own_.up) * steep >> 14, 20000));
    end(facing, depth, voxel);
    voxel->brightness = static_cast<uint8_t>((brightness8(s.normal, own_.light) + 128) >> 8);
    slopes(s, oversampled, voxel);
    return true;
}

// Half width and height: the cell of the unblended surface that is the seed's own, grown with the position, as it falls along
// the path onto the tangent plane. A half axis e becomes e - u (e.n) / (u.n) with u the path.
void Shader::extents(const Seed& s, int32_t, bool oversampled, Voxel* voxel)
{
    const auto along = [&](const int32_t axis[3]) { return s.along[0] * axis[0] + s.along[1] * axis[1] + s.along[2] * axis[2]; };
    const auto across = [&](const int32_t axis[3]) { return s.across[0] * axis[0] + s.across[1] * axis[1] + s.across[2] * axis[2]; };
    alongX_ = along(column_) >> 6;
    alongY_ = along(row_) >> 6;
    acrossX_ = across(column_) >> 6;
    acrossY_ = across(row_) >> 6;
    int32_t size = spacing_;
    bool whole = oversampled;
    if (!(s.flags & SEED_RESTING)) {
        const int32_t ux = rawFromReal(s.path.x) >> 10, uy = rawFromReal(s.path.y) >> 10, uz = rawFromReal(s.path.z) >> 10;
        const int32_t radius = rawFromReal(object_.radius()) >> 10;
        int32_t cosine = (ux * s.normal.x + uy * s.normal.y + uz * s.normal.z) / (radius < 1 ? 1 : radius);
        if (cosine < LEAST_COSINE)
            cosine = LEAST_COSINE;
        const int32_t inverse = (1 << 26) / cosine;  // 12 bits of fraction
        whole = whole || inverse > UNEVEN;
        // (e.n) / (u.n), 1/64 spacing with 8 bits of fraction.
        const int32_t n[] = {s.normal.x, s.normal.y, s.normal.z};
        const int32_t offAlong = (along(n) >> 6) * (inverse >> 4) >> 8;
        const int32_t offAcross = (across(n) >> 6) * (inverse >> 4) >> 8;
        const int32_t uX = (ux * column_[0] + uy * column_[1] + uz * column_[2]) / (radius < 1 ? 1 : radius);
        const int32_t uY = (ux * row_[0] + uy * row_[1] + uz * row_[2]) / (radius < 1 ? 1 : radius);
        alongX_ -= offAlong * uX >> 14;
        alongY_ -= offAlong * uY >> 14;
        acrossX_ -= offAcross * uX >> 14;
        acrossY_ -= offAcross * uY >> 14;
        size = size * (rawFromReal(s.position) >> 8) >> 8;
    }
    const int32_t ax = magnitude(alongX_), ay = magnitude(alongY_);
    int32_t width = ax, height = ay;
    // Beside each other, cells of a ring make a band: rectangles as wide as the way from one to the next need not cover the
    // whole of their cells, only, together, the band. Where the surface is much deformed the ring is no even band.
    if (whole) {
        width += magnitude(acrossX_);
        height += magnitude(acrossY_);
    } else if (ax > ay) {
        height += magnitude(acrossY_ - acrossX_ * (alongY_ * 64 / alongX_) / 64);
    } else if (ay > 0) {
        width += magnitude(acrossX_ - acrossY_ * (alongX_ * 64 / alongY_) / 64);
    }
    voxel->wide = static_cast<int16_t>(((width + MARGIN) * size >> 14) + MARGIN_UNITS);
    voxel->high = static_cast<int16_t>(((height + MARGIN) * size >> 14) + MARGIN_UNITS);
}

// Where a round surface bends out of sight its tangent plane goes on: the scale ends there. The limb is cos^2 radius / 2
// away across the view, with cos the cosine of normal and viewer; along the plane that is cos radius / 2 deep.
void Shader::end(int32_t facing, int32_t, Voxel* voxel) const
{
    const int32_t curvature = horizon_ > 8000 ? 8000 : horizon_;
    const int32_t reach = curvature * facing / (2 * own_.distance32) + 1;
    voxel->reach = 0;
    if (reach < 256 && (magnitude(voxel->tiltX) * voxel->wide + magnitude(voxel->tiltY) * voxel->high) >> 11 >= reach)
        voxel->reach = static_cast<uint8_t>(reach);
}

// How the brightness changes across the scale, from what it is at the next seed of the ring and at N of the ring before: two
// ways on the surface with the change along each.
void Shader::slopes(const Seed& s, bool oversampled, Voxel* voxel) const
{
    voxel->slopeX = voxel->slopeY = 0;
    const int index = static_cast<int>(&s - &object_.seed(0));
    if (oversampled || s.neighbour < 0)
        return;
    const int32_t here = brightness8(s.normal, own_.light);
    // Half way along the ring: forwards, or at its end backwards.
    int32_t along = 0;
    const Seed* next = index + 2 < object_.seedSlots() ? &s + 2 : &s;
    const Seed* last = index >= 2 ? &s - 2 : &s;
    if ((next->flags & SEED_VALID) && next->neighbour >= s.neighbour)
        along = (brightness8(next->normal, own_.light) - here) >> 1;
    else if (last->flags & SEED_VALID)
        along = (here - brightness8(last->normal, own_.light)) >> 1;
    const Seed& n = object_.seed(s.neighbour);
    int32_t across = 0;
    if (n.flags & SEED_VALID)
        across = (here - brightness8(n.normal, own_.light) + (along * 2 * s.aside >> 6)) >> 1;
    const int32_t det = (alongX_ * acrossY_ - alongY_ * acrossX_) >> 8;
    if (magnitude(det) < 256)
        return;
    // Steps with 8 bits over 1/64 spacing with 8 bits, to 1/8 step a unit.
    const auto slope = [&](int32_t top) {
        // top: 16 bits of fraction and det 8, of steps * half axes
        return limited(top / det, 1 << 20);
    };
    int32_t gx = slope(along * acrossY_ - across * alongY_), gy = slope(alongX_ * across - acrossX_ * along);
    gx = mulDiv(gx, 64 * 8 * 256 / 256, spacing_ < 1 ? 1 : spacing_);
    gy = mulDiv(gy, 64 * 8 * 256 / 256, spacing_ < 1 ? 1 : spacing_);
    int32_t corner = (magnitude(gx) * voxel->wide + magnitude(gy) * voxel->high) >> 8;
    if (corner < FLAT)
        return;
    for (; corner > SHADING_MOST * 8; corner >>= 1) {
        gx /= 2;
        gy /= 2;
    }
    voxel->slopeX = static_cast<int8_t>(limited(gx, 127));
    voxel->slopeY = static_cast<int8_t>(limited(gy, 127));
}
