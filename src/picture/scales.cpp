// From voxels to pixels in C++, the readable reference for asm/scales.S.
#include "picture/scales.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// The pixels along one axis, `from` to before `to`, whose centres lie in a scale's rectangle. The loop leaves a TOO_LARGE scale to
// its caller.
struct Extent {
    enum Kind { DRAWN, EMPTY, TOO_LARGE } kind;
    int from, to;

    int length() const { return to - from; }
};

// Clips a rectangle with this centre and half extent (pixels, 12 fraction bits) to the screen along one axis. The range *least to
// before *most grows to contain it.
inline Extent extentOf(int32_t middle, int32_t half, int screen, int32_t* least, int32_t* most)
{
    int from = (middle - half) >> 12, to = (middle + half) >> 12;
    if (from < *least) {
        if (from < 0) {
            if (to - from > LARGEST)
                return {Extent::TOO_LARGE, from, to};
            from = 0;
        }
        *least = from;
    }
    if (to > *most) {
        if (to > screen) {
            if (to - from > LARGEST)
                return {Extent::TOO_LARGE, from, to};
            to = screen;
        }
        *most = to;
    }
    const int length = to - from;
    return {length <= 0 ? Extent::EMPTY : length > LARGEST ? Extent::TOO_LARGE : Extent::DRAWN, from, to};
}

// Sets all of a Scale but its rectangle and its depths: brightness, least and greatest depth, and cut function. (toColumn,
// toRow) leads from the middle of the scale to the centre of its first pixel, 12 fraction bits.
inline void addShading(const Lens& lens, const Voxel& v, const Factors& f, int32_t depth, int32_t toColumn, int32_t toRow,
                       Scale* scale)
{
    const int width = scale->width;
    setEnds(v, depth >> 1, scale);
    scale->ramp = lens.ramp;
    const int32_t shadeAcross = shadeStep(v.slopeX, f.zx), shadeDown = -shadeStep(v.slopeY, f.zy);
    const auto toFirst = [&](int32_t across, int32_t down) {
        return wrappedSum(wrappedProduct(across, toColumn), wrappedProduct(down, toRow)) >> 12;
    };
    scale->shade = v.brightness * 256 + 128 + toFirst(shadeAcross, shadeDown);
    scale->shadeStep = shadeAcross;
    scale->shadeRow = wrappedSum(shadeDown, -wrappedProduct(shadeAcross, width));
    setUncut(scale);
    if (!isCut(v))
        return;
    setCut(v, f.zx, f.zy, toFirst, scale);
    if (scale->averages)
        setDome(domeOf(v, f), toColumn, toRow, scale);
}

}  // namespace

const Voxel* drawScalesC(Lens* lens, const Voxel* voxels, const Voxel* end)
{
    for (; voxels < end; ++voxels) {
        const Voxel& v = *voxels;
        const int32_t depth = wrappedSum(lens->z, v.z);
        Factors near;
        const Factors* factors = factorsOf(*lens, depth, &near);
        if (factors == nullptr)
            break;
        const Factors& f = *factors;
        const int32_t column = lens->centreX + (wrappedProduct(wrappedSum(lens->x, v.x), f.x) >> 8);
        const Extent columns = extentOf(column, v.halfWidth * f.x >> 8, WIDTH, &lens->left, &lens->right);
        if (columns.kind == Extent::TOO_LARGE)
            break;
        const int32_t row = lens->centreY - (wrappedProduct(wrappedSum(lens->y, v.y), f.y) >> 8);
        Extent rows{Extent::EMPTY, 0, 0};
        if (columns.kind == Extent::DRAWN)
            rows = extentOf(row, v.halfHeight * f.y >> 8, HEIGHT, &lens->top, &lens->bottom);
        if (rows.kind == Extent::TOO_LARGE)
            break;
        if (rows.kind == Extent::EMPTY) {
            ++lens->empty;
            continue;
        }
        // The scale lies in the tangent plane of the surface. The depth at its middle is known; from there it is extrapolated to
        // the centre of the first pixel.
        const int32_t across = limited(wrappedProduct(v.tiltX, f.zx) >> 16, STEEPEST);
        const int32_t down = -limited(wrappedProduct(v.tiltY, f.zy) >> 16, STEEPEST);
        const int32_t toColumn = ((columns.from + 1) << 12) - column, toRow = ((rows.from + 1) << 12) - row;
        Scale scale;
        scale.left = static_cast<int16_t>(columns.from);
        scale.top = static_cast<int16_t>(rows.from);
        scale.width = static_cast<int16_t>(columns.length());
        scale.height = static_cast<int16_t>(rows.length());
        scale.z = (depth >> 1) + ((across * toColumn + down * toRow) >> 12);
        scale.zStep = across;
        scale.zRow = down - across * scale.width;
        if (!depthsFit(scale.z, across * (scale.width - 1), down * (scale.height - 1)))
            break;
        addShading(*lens, v, f, depth, toColumn, toRow, &scale);
        blitScale(lens->frame, lens->zbuffer, scale);
    }
    return voxels;
}
