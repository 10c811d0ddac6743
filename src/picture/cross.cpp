// Crossings: where a scale is cut at the border to another object, the surface goes on as that object's. Seeds of the other object
// may be missing there, because their paths leave the surface elsewhere. A crossing tells where to test that when all objects are
// drawn (missed.h).
#include "math/whole.h"
#include "picture/view.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// A scale is seen where the Z-buffer differs from its depth by no more than this, 1/128 unit.
constexpr int32_t SEEN = 256;

// The component of a step of one pixel in a direction: -1, 0 or 1. `other` is the other component of the direction.
inline int stepOf(int32_t component, int32_t other)
{
    return 2 * magnitude(component) < magnitude(other) ? 0 : component < 0 ? -1 : 1;
}

// Whether a scale that is cut ends at a border, or at an edge of a pattern, where nothing is missing. A cut that curves is the limb
// of the surface.
inline bool crossesBorder(const Voxel& v)
{
    return (v.curveXX | v.curveXY | v.curveYY) == 0 && !isCutNowhere(v);
}

}  // namespace

// Notes the crossings of every second scale that has been drawn. Missing surface that one of them finds is followed from pixel to
// pixel, so that the next one would find the same.
void View::noteCrossings(const VoxelList& list)
{
    const Voxel* const end = list.voxels + list.count;
    bool isSecond = true;
    for (const Voxel* voxel = list.voxels; voxel < end; ++voxel)
        if (isCut(*voxel) && crossesBorder(*voxel) && crossingCount_ < CROSSINGS_MOST) {
            isSecond = !isSecond;
            if (!isSecond)
                noteCrossing(*voxel);
        }
}

// Notes the pixel of the place on the border that is closest to the scale's centre, if the scale is seen beside that place.
void View::noteCrossing(const Voxel& voxel)
{
    const int32_t z = lens_.z + voxel.z, square = voxel.cutX * voxel.cutX + voxel.cutY * voxel.cutY;
    Factors near;
    const Factors* const f = factorsOf(lens_, z, &near);
    // The cut function falls from cutAt / 64 to 0 on the way (aside, up), 1/256 unit.
    const int32_t share = (voxel.cutAt * 8192) / square;
    const int32_t aside = -(share * voxel.cutX >> 8), up = -(share * voxel.cutY >> 8);
    const int32_t x = lens_.x + voxel.x + aside, y = lens_.y + voxel.y + up;
    if (f == nullptr || magnitude(x) > 2 * z || magnitude(y) > 2 * z)
        return;
    const int32_t column = (centreX_ + (x * f->x >> 8)) >> FRACTION, row = (centreY_ - (y * f->y >> 8)) >> FRACTION;
    if (column < 1 || column >= WIDTH - 1 || row < 1 || row >= HEIGHT - 1)
        return;
    const int border = row * WIDTH + column;
    const int inwards = stepOf(voxel.cutX, voxel.cutY) - stepOf(voxel.cutY, voxel.cutX) * WIDTH;
    const int32_t depth = (z + ((voxel.tiltX * aside + voxel.tiltY * up) >> 8)) >> 1;
    if (depth > 0 && depth < Z_EMPTY && magnitude(zbuffer_[border + inwards] - depth) <= SEEN)
        crossings_[crossingCount_++] = {static_cast<uint16_t>(border), static_cast<uint16_t>(depth),
                                        static_cast<int16_t>(-inwards)};
}
