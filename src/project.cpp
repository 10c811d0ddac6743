// The perspective transformation of scales in C++: what asm/project.S does, said plainly.
#include "project.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

inline int32_t limited(int32_t step)
{
    return step > STEEPEST ? STEEPEST : step < -STEEPEST ? -STEEPEST : step;
}

}  // namespace

int projectC(Lens* lens, const Voxel* voxels, int count, Scale* scales, int* made)
{
    Scale* const first = scales;
    int i = 0;
    for (; i < count; ++i) {
        const Voxel& v = voxels[i];
        const uint32_t step = static_cast<uint32_t>((v.z >> 5) - LENS_NEAR * 8);
        if (step >= static_cast<uint32_t>(LENS_STEPS) || v.colour == GAP)
            break;
        const Factors& f = lens->factors[step];
        int32_t column, row;
        if (__builtin_mul_overflow(v.x, f.x, &column) || __builtin_mul_overflow(v.y, f.y, &row))
            break;
        // The pixels whose centres lie in the rectangle.
        column = lens->centreX + (column >> 8);
        row = lens->centreY - (row >> 8);
        const int32_t halfWide = v.shape.wide * f.x >> 8, halfHigh = v.shape.high * f.y >> 8;
        const int left = (column - halfWide) >> 12, right = (column + halfWide) >> 12;
        const int top = (row - halfHigh) >> 12, bottom = (row + halfHigh) >> 12;
        if (left < 0 || right > WIDTH || top < 0 || bottom > HEIGHT)
            break;
        if (left >= right || top >= bottom)
            continue;
        const int wide = right - left, high = bottom - top;
        if (wide + high > SLOPED_MOST)
            break;
        // The plane of the surface: from the scale's middle to the middle of its first pixel, and on from there.
        const int32_t across = limited(v.shape.tiltX * f.zx >> 16), down = -limited(v.shape.tiltY * f.zy >> 16);
        scales->left = static_cast<int16_t>(left);
        scales->top = static_cast<int16_t>(top);
        scales->wide = static_cast<int16_t>(wide);
        scales->high = static_cast<int16_t>(high);
        scales->z = (v.z >> 1) + ((across * (((left + 1) << 12) - column) + down * (((top + 1) << 12) - row)) >> 12);
        scales->zStep = across;
        scales->zRow = down - across * wide;
        scales->colour = v.colour;
        ++scales;
        lens->left = left < lens->left ? left : lens->left;
        lens->top = top < lens->top ? top : lens->top;
        lens->right = right > lens->right ? right : lens->right;
        lens->bottom = bottom > lens->bottom ? bottom : lens->bottom;
    }
    *made = static_cast<int>(scales - first);
    return i;
}
