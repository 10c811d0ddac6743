// From voxels to pixels: the perspective transformation of the seeds' scales (report, The Rendering Technique) and their
// drawing, in one go for all that are of ordinary size and place. It stands twice, like the loops of blit.h: in C++
// (src/picture/scales.cpp) and in assembly (asm/scales.S); both do the same, bit for bit.
#ifndef FB_SCALES_H
#define FB_SCALES_H

#include "math/real.h"
#include "picture/blit.h"
#include "surface/voxel.h"

// Depth steps (1/128 unit) from pixel to pixel; a surface seen more edge-on than this is taken as this steep.
constexpr int32_t STEEPEST = 400;
// The widest and highest scale that there is a loop for.
constexpr int LARGEST = 40;

// Modulo 2^32, as the processor does it: no place or tilt whatever does harm.
constexpr int32_t wrappedSum(int32_t a, int32_t b)
{
    return static_cast<int32_t>(static_cast<uint32_t>(a) + static_cast<uint32_t>(b));
}
constexpr int32_t wrappedProduct(int32_t a, int32_t b)
{
    return static_cast<int32_t>(static_cast<uint32_t>(a) * static_cast<uint32_t>(b));
}

// Whether there is more to a voxel than a rectangle of one colour.
inline bool isFine(const Voxel& v)
{
    return (v.reach | v.slopeX | v.slopeY | v.cutX | v.cutY) != 0;
}

// How far away a voxel's pixels may be, 1/128 unit, when its middle is at `z`.
constexpr int32_t NO_END = 0x7fffffff;
inline int32_t endOf(const Voxel& v, int32_t z)
{
    return v.reach != 0 ? z + v.reach * 4 : NO_END;
}

// Of a slope of brightness or of what cuts, and Factors::zx or zy: the change from pixel to pixel, 8 bits of fraction.
inline int32_t shadeStep(int slope, int32_t factor)
{
    return wrappedProduct(slope, factor) >> 10;
}

// Of one of a voxel's curves, and Factors::zx or zy of its axes: the change of the step from pixel to pixel, 8 bits of fraction.
inline int32_t curveStep(int curve, int32_t factor, int32_t other)
{
    return wrappedProduct(wrappedProduct(curve, factor) >> 10, other) >> 16;
}

// What cuts a voxel, from the middle of its scale's first pixel on. `way(a, b)` is what a change by `a` from column to column and
// by `b` from row to row makes of the way to there from the middle of the scale.
template <class Way>
inline void setCut(const Voxel& v, int32_t zx, int32_t zy, Way way, FineScale* scale)
{
    const int32_t across = shadeStep(v.cutX, zx), down = -shadeStep(v.cutY, zy);
    const int32_t xx = curveStep(v.curveXX, zx, zx), xy = -curveStep(v.curveXY, zx, zy), yy = curveStep(v.curveYY, zy, zy);
    const int32_t acrossFirst = wrappedSum(across, way(xx, xy)), downFirst = wrappedSum(down, way(xy, yy));
    // Half way it changes as it does on the whole way.
    scale->cut = v.cutAt * 4 + way(wrappedSum(across, acrossFirst) >> 1, wrappedSum(down, downFirst) >> 1);
    // A step that begins in the middle of a pixel has half of the change ahead that it makes to the step.
    scale->cutStep = wrappedSum(acrossFirst, -(xx >> 1));
    scale->cutRow = wrappedSum(downFirst, -(yy >> 1));
    scale->cutXX = xx;
    scale->cutXY = xy;
    scale->cutYY = yy;
}

inline void setUncut(FineScale* scale)
{
    scale->cut = scale->cutStep = scale->cutRow = scale->cutXX = scale->cutXY = scale->cutYY = 0;
}

// Whether all depths of a scale fit the Z-buffer: from its first pixel on, which lies `z` away, they change by `across` up to
// the last column and by `down` up to the last row.
inline bool depthsFit(int32_t z, int32_t across, int32_t down)
{
    const uint32_t end = Z_EMPTY;
    return static_cast<uint32_t>(z) < end && static_cast<uint32_t>(z + across) < end && static_cast<uint32_t>(z + down) < end &&
           static_cast<uint32_t>(z + across + down) < end;
}

// What a depth makes of lengths.
struct Factors {
    int32_t x, y;    // focal 2^12 / z: 1/256 unit to 1/2^20 pixel
    int32_t zx, zy;  // z 2^15 / focal: a tilt to the change of depth from pixel to pixel, 1/2^16 of 1/128 unit
};
constexpr int LENS_NEAR = 76, LENS_FAR = 432;
// Steps of depth in a unit.
constexpr int LENS_FINENESS = 16;
constexpr int LENS_STEPS = (LENS_FAR - LENS_NEAR) * LENS_FINENESS;

// The camera and the object in the terms of the loop, and what it has drawn.
struct Lens {
    int32_t x, y, z;                   // the object's centre from the eye, 1/256 unit
    const uint8_t* ramp;               // as VoxelList's
    const Factors* factors;            // one for each step of depth from LENS_NEAR to LENS_FAR units
    int32_t centreX, centreY;          // pixels with 12 bits of fraction, and half a pixel more
    uint8_t* frame;                    // as for blitScales()
    uint16_t* zbuffer;
    int32_t left, top, right, bottom;  // in and out: a rectangle that grows to hold at least all that is drawn; each lies on
                                       // the screen, so what does not make it larger needs no test for the screen's edges
    int32_t empty;                     // in and out: counts voxels that cover no pixel's centre on the screen
    uint32_t tiltAdd, tiltBits;        // limitTilts()
    int32_t focalX, focalY;            // pixels with 12 bits of fraction, 64 to 500 pixels
};

// The factors of a depth nearer than the table, computed: such scales are few, and large. False: they are too large for the
// products of the loop. A table's zx and zy are larger than these, so limitTilts() holds for them too.
constexpr int LENS_NEXT = 1;
constexpr int32_t FACTOR_MOST = 0xffff;
inline bool nearFactors(const Lens& lens, int32_t depth, Factors* near)
{
    if (depth < LENS_NEXT * 256 || depth >= LENS_NEAR * 256)
        return false;
    near->x = lens.focalX * 256 / depth;
    near->y = lens.focalY * 256 / depth;
    if (near->x > FACTOR_MOST || near->y > FACTOR_MOST)
        return false;
    near->zx = mulDiv(depth, 1 << 19, lens.focalX);
    near->zy = mulDiv(depth, 1 << 19, lens.focalY);
    return true;
}

// Finds out which tilts need no test for STEEPEST as long as no zx or zy is more than `most`: where tiltX and tiltY as one double
// word, plus tiltAdd, have none of tiltBits, both lie in -TILT - 1 .. TILT, and `most` makes no more of that.
inline void limitTilts(Lens* lens, uint32_t most)
{
    const uint32_t tilts = (static_cast<uint32_t>(STEEPEST) << 16) / (most | 1);
    uint32_t tilt = 1 << 14;
    while (tilt != 0 && tilt + 1 > tilts)
        tilt >>= 1;
    lens->tiltAdd = tilt * 0x10001;
    lens->tiltBits = tilt == 0 ? 0xffffffff : ~((2 * tilt - 1) * 0x10001);
}

// The step that a depth lies in, 1/256 unit; below 0 or LENS_STEPS and more beyond the table.
inline int32_t lensStep(int32_t depth)
{
    return (depth >> 4) - LENS_NEAR * LENS_FINENESS;
}

// The factors for a depth, `near` for those that are computed. Null: there are none.
inline const Factors* factorsOf(const Lens& lens, int32_t depth, Factors* near)
{
    const uint32_t step = static_cast<uint32_t>(lensStep(depth));
    if (step < static_cast<uint32_t>(LENS_STEPS))
        return lens.factors + step;
    return nearFactors(lens, depth, near) ? near : nullptr;
}

extern "C" {

// Draws voxels up to before `end`, in their order, and returns the first that was not dealt with. It stops at a voxel that is
// not its business: one behind the table's depths or all too near, larger than LARGEST, or so large and so tilted that a depth
// would leave its 16 bits. Places times factors fit 32 bits, for the caller sees to that.
const Voxel* drawScalesC(Lens* lens, const Voxel* voxels, const Voxel* end);
#if FB_ASM
const Voxel* drawScalesA(Lens* lens, const Voxel* voxels, const Voxel* end);
#endif

}

#if FB_ASM
#define drawScales drawScalesA
#else
#define drawScales drawScalesC
#endif

#endif
