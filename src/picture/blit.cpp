// The innermost loops in C++, the readable reference for asm/blit.S. 64-bit host builds draw with these; the tests compare the
// assembly with them.
#include "picture/blit.h"

#include "rt.h"
#include "surface/voxel.h"

using machine::WIDTH;

namespace {

// Draws a pixel of a scale that averages. `shade` is its brightness in steps of the ramp. `there` is the step that the
// pixel shows, less STEP_BIAS, and not negative if the ramp has no such colour; the sum is one byte, as in the assembly.
inline void average(const uint8_t* ramp, int32_t z, int32_t shade, uint16_t* depth, uint8_t* pixel)
{
    const int32_t nearer = *depth - z;
    const int32_t there = static_cast<int8_t>(ramp[STEP_OF + *pixel]);
    const bool averages = there < 0 && nearer < AVERAGED && nearer >= -AVERAGED;
    if (nearer > 0)
        *depth = static_cast<uint16_t>(z);
    if (nearer > 0 || (nearer < 0 && averages))
        *pixel = ramp[averages ? (static_cast<int8_t>(there + shade) >> 1) + STEP_BIAS / 2 : shade];
}

// Draws a row of a scale; `pixels` and `depths` point one past its last pixel, so x runs from -width to before 0. `both` holds
// the depth in its lower half and the brightness (8 fraction bits) in its upper half.
template <bool CUT>
inline void scaleRow(const Scale& scale, uint8_t* pixels, uint16_t* depths, uint32_t both, uint32_t step, uint32_t cut,
                    uint32_t cutStep)
{
    const uint32_t least = static_cast<uint32_t>(scale.zLeast), range = static_cast<uint32_t>(scale.zMost) - least;
    for (int x = -scale.width; x != 0; ++x) {
        const uint32_t z = static_cast<uint16_t>(both);
        const int32_t shade = static_cast<int32_t>(both) >> 24;
        const bool inside = z - least <= range && (!CUT || static_cast<int32_t>(cut) >= 0);
        if (CUT && scale.averages) {
            if (inside)
                average(scale.ramp, static_cast<int32_t>(z), shade, depths + x, pixels + x);
        } else if (inside && z < depths[x]) {
            depths[x] = static_cast<uint16_t>(z);
            pixels[x] = scale.ramp[shade];
        }
        both += step;
        if (CUT) {
            step += static_cast<uint32_t>(scale.dome);
            cutStep += static_cast<uint32_t>(scale.cutXX);
            cut += cutStep;
        }
    }
}

// Packs a depth and a brightness (or their steps) into one word. The depth stays within 16 bits at every pixel, so one addition
// changes both without an overflow into the brightness.
inline uint32_t together(int32_t z, int32_t shade)
{
    return static_cast<uint32_t>(z) + (static_cast<uint32_t>(shade) << 16);
}

}  // namespace

void blitScale(uint8_t* frame, uint16_t* zbuffer, const Scale& scale)
{
    const int end = scale.top * WIDTH + scale.left + scale.width;
    uint8_t* pixels = frame + end;
    uint16_t* depths = zbuffer + end;
    const uint32_t width = static_cast<uint32_t>(scale.width);
    const uint32_t step = together(scale.zStep, scale.shadeStep);
    uint32_t down = together(scale.zRow, scale.shadeRow) + step * width;
    const bool isCut = (scale.cut | scale.cutStep | scale.cutRow | scale.cutXX | scale.cutXY | scale.cutYY | scale.dome) != 0;
    uint32_t both = together(scale.z, scale.shade), cut = static_cast<uint32_t>(scale.cut);
    uint32_t cutStep = static_cast<uint32_t>(scale.cutStep), cutRow = static_cast<uint32_t>(scale.cutRow);
    for (int y = scale.height; y > 0; --y) {
        if (isCut)
            scaleRow<true>(scale, pixels, depths, both, step, cut, cutStep);
        else
            scaleRow<false>(scale, pixels, depths, both, step, 0, 0);
        both += down;
        down += static_cast<uint32_t>(scale.dome);
        cutStep += static_cast<uint32_t>(scale.cutXY);
        cutRow += static_cast<uint32_t>(scale.cutYY);
        cut += cutRow;
        pixels += WIDTH;
        depths += WIDTH;
    }
}

void clearRows(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count)
{
    for (; count > 0; --count, ++rows, frame += WIDTH, zbuffer += WIDTH) {
        const int touched = rows->to - rows->from;
        if (touched <= 0)
            continue;
        memset(frame + rows->from, 0, static_cast<size_t>(touched));
        memset(zbuffer + rows->from, 0xff, static_cast<size_t>(touched) * sizeof *zbuffer);
    }
}

int drawnRunsC(const uint8_t* row, const uint16_t*, const Span* within, Span* runs)
{
    int count = 0;
    for (int x = within->from;; ++count) {
        while (x < within->to && row[x] == 0)
            ++x;
        if (x == within->to)
            return count;
        runs[count].from = static_cast<int16_t>(x);
        while (x < within->to && row[x] != 0)
            ++x;
        runs[count].to = static_cast<int16_t>(x);
    }
}

void copyRowsC(uint8_t* screen, const uint8_t* frame, const Span* rows, int count)
{
    for (; count > 0; --count, ++rows, screen += WIDTH, frame += WIDTH) {
        if (rows->to > rows->from)
            memcpy(screen + rows->from, frame + rows->from, static_cast<size_t>(rows->to - rows->from));
    }
}
