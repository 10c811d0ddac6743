// From voxels to pixels in C++: what asm/scales.S does, said plainly.
#include "picture/scales.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

inline int32_t limited(int32_t step)
{
    return step > STEEPEST ? STEEPEST : step < -STEEPEST ? -STEEPEST : step;
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
        // The pixels whose centres lie in the rectangle: columns, then rows.
        const int32_t column = lens->centreX + (wrappedProduct(wrappedSum(lens->x, v.x), f.x) >> 8);
        const int32_t halfWide = v.wide * f.x >> 8;
        int left = (column - halfWide) >> 12, right = (column + halfWide) >> 12;
        if (left < lens->left) {
            if (left < 0) {
                if (right - left > LARGEST)
                    break;
                left = 0;
            }
            lens->left = left;
        }
        if (right > lens->right) {
            if (right > WIDTH) {
                if (right - left > LARGEST)
                    break;
                right = WIDTH;
            }
            lens->right = right;
        }
        const int wide = right - left;
        if (wide <= 0) {
            ++lens->empty;
            continue;
        }
        if (wide > LARGEST)
            break;
        const int32_t row = lens->centreY - (wrappedProduct(wrappedSum(lens->y, v.y), f.y) >> 8);
        const int32_t halfHigh = v.high * f.y >> 8;
        int top = (row - halfHigh) >> 12, bottom = (row + halfHigh) >> 12;
        if (top < lens->top) {
            if (top < 0) {
                if (bottom - top > LARGEST)
                    break;
                top = 0;
            }
            lens->top = top;
        }
        if (bottom > lens->bottom) {
            if (bottom > HEIGHT) {
                if (bottom - top > LARGEST)
                    break;
                bottom = HEIGHT;
            }
            lens->bottom = bottom;
        }
        const int high = bottom - top;
        if (high <= 0) {
            ++lens->empty;
            continue;
        }
        if (high > LARGEST)
            break;
        // The plane of the surface: from the scale's middle to the middle of its first pixel, and on from there.
        const int32_t across = limited(wrappedProduct(v.tiltX, f.zx) >> 16);
        const int32_t down = -limited(wrappedProduct(v.tiltY, f.zy) >> 16);
        const int32_t toColumn = ((left + 1) << 12) - column, toRow = ((top + 1) << 12) - row;
        FineScale scale;
        scale.left = static_cast<int16_t>(left);
        scale.top = static_cast<int16_t>(top);
        scale.wide = static_cast<int16_t>(wide);
        scale.high = static_cast<int16_t>(high);
        scale.z = (depth >> 1) + ((across * toColumn + down * toRow) >> 12);
        scale.zStep = across;
        scale.zRow = down - across * wide;
        if (!depthsFit(scale.z, across * (wide - 1), down * (high - 1)))
            break;
        if (!isFine(v)) {
            scale.colour = lens->ramp[v.brightness];
            blitScalesC(lens->frame, lens->zbuffer, &scale, 1);
            continue;
        }
        scale.zMost = endOf(v, depth >> 1);
        const int32_t shadeAcross = shadeStep(v.slopeX, f.zx), shadeDown = -shadeStep(v.slopeY, f.zy);
        scale.ramp = lens->ramp;
        const int32_t toFirst = wrappedSum(wrappedProduct(shadeAcross, toColumn), wrappedProduct(shadeDown, toRow));
        scale.shade = v.brightness * 256 + 128 + (toFirst >> 12);
        scale.shadeStep = shadeAcross;
        scale.shadeRow = wrappedSum(shadeDown, -wrappedProduct(shadeAcross, wide));
        const int32_t cutAcross = shadeStep(v.cutX, f.zx), cutDown = -shadeStep(v.cutY, f.zy);
        const int32_t cutToFirst = wrappedSum(wrappedProduct(cutAcross, toColumn), wrappedProduct(cutDown, toRow));
        scale.cut = isCut(v) ? v.cutAt * 32 + (cutToFirst >> 12) : 0;
        scale.cutStep = cutAcross;
        scale.cutRow = wrappedSum(cutDown, -wrappedProduct(cutAcross, wide));
        blitFine(lens->frame, lens->zbuffer, scale);
    }
    return voxels;
}
