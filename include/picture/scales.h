// From voxels to pixels: one loop that projects the seeds' scales (report, The Rendering Technique) and draws them, as far as they
// have ordinary size and position. Like the loops of blit.h it exists twice, in C++ (src/picture/scales.cpp) and in assembly
// (asm/scales.S); both write the same bits.
#ifndef FB_SCALES_H
#define FB_SCALES_H

#include "math/real.h"
#include "math/whole.h"
#include "picture/blit.h"
#include "surface/voxel.h"

// Upper bound of the change of depth from pixel to pixel, 1/128 unit. A surface seen more edge-on is drawn with this slope.
constexpr int32_t STEEPEST = 400;
// Greatest width and height, in pixels, of a scale that the loop draws.
constexpr int LARGEST = 40;

// Sums and products that wrap around modulo 2^32 like the processor's, so that no position or tilt is undefined behaviour in C++.
constexpr int32_t wrappedSum(int32_t a, int32_t b)
{
    return static_cast<int32_t>(static_cast<uint32_t>(a) + static_cast<uint32_t>(b));
}
constexpr int32_t wrappedProduct(int32_t a, int32_t b)
{
    return static_cast<int32_t>(static_cast<uint32_t>(a) * static_cast<uint32_t>(b));
}

// Sets the least and the greatest depth of a voxel's pixels; its centre is at depth `z`, 1/128 unit.
inline void setEnds(const Voxel& v, int32_t z, Scale* scale)
{
    scale->zLeast = v.back != 0 ? max32(z - v.front * 4, 0) : 0;
    scale->zMost = v.back != 0 ? min32(z + v.back * 4, Z_EMPTY) : Z_EMPTY;
}

// The change from pixel to pixel, 8 fraction bits, of a brightness or cut function with this slope. `factor` is Factors::zx or zy.
inline int32_t shadeStep(int slope, int32_t factor)
{
    return wrappedProduct(slope, factor) >> 10;
}

// The change of the cut function's step from pixel to pixel, 8 fraction bits, from one of a voxel's curvatures and the factors
// (Factors::zx or zy) of its two axes.
inline int32_t curveStep(int curve, int32_t factor, int32_t other)
{
    return wrappedProduct(wrappedProduct(curve, factor) >> 10, other) >> 16;
}

// Sets the cut function of a scale after setUncut(): its value and its steps at the centre of the first pixel. `toFirst(a, b)`
// returns by how much a function changes between the middle of the scale and the centre of that pixel if it changes by `a` per
// column and by `b` per row. Of a voxel that is cut nowhere the function is constant.
template <class ToFirst>
inline void setCut(const Voxel& v, int32_t zx, int32_t zy, ToFirst toFirst, Scale* scale)
{
    scale->cut = v.cutAt * 4;
    scale->averages = isCutStraight(v);
    if (scale->averages && isCutNowhere(v))
        return;
    const int32_t across = shadeStep(v.cutX, zx), down = -shadeStep(v.cutY, zy);
    const int32_t xx = curveStep(v.curveXX, zx, zx), xy = -curveStep(v.curveXY, zx, zy), yy = curveStep(v.curveYY, zy, zy);
    const int32_t acrossFirst = wrappedSum(across, toFirst(xx, xy)), downFirst = wrappedSum(down, toFirst(xy, yy));
    // The slope of a quadratic function half way is its average slope on the whole way.
    scale->cut += toFirst(wrappedSum(across, acrossFirst) >> 1, wrappedSum(down, downFirst) >> 1);
    // The average slope of a step is the slope half a pixel ahead; the drawing loop adds a whole pixel's change before each step,
    // so half of it is taken off here.
    scale->cutStep = wrappedSum(acrossFirst, -(xx >> 1));
    scale->cutRow = wrappedSum(downFirst, -(yy >> 1));
    scale->cutXX = xx;
    scale->cutXY = xy;
    scale->cutYY = yy;
}

inline void setUncut(Scale* scale)
{
    scale->cut = scale->cutStep = scale->cutRow = scale->cutXX = scale->cutXY = scale->cutYY = scale->dome = 0;
    scale->averages = false;
}

// Factors of the perspective projection at one depth z.
struct Factors {
    int32_t x, y;    // focal 2^12 / z: takes lengths in 1/256 unit to 2^-20 pixel
    int32_t zx, zy;  // z 2^15 / focal: takes a tilt to the change of depth from pixel to pixel, 2^-16 of 1/128 unit
};
// The table of factors covers the depths from LENS_NEAR to before LENS_FAR units in LENS_FINENESS steps per unit.
constexpr int LENS_NEAR = 76, LENS_FAR = 423;
constexpr int LENS_FINENESS = 16;
constexpr int LENS_STEPS = (LENS_FAR - LENS_NEAR) * LENS_FINENESS;

// Where the surface bulges, the tangent plane of each scale passes in front of the centres of the scales beside it, so that a pixel
// would show the edge of one scale instead of the middle of another. That is seen most next to a border and where a patch bends
// unevenly, for there normals turn fast. A scale that is cut along a straight line, or nowhere (voxel.h), is therefore domed: its
// depth grows with the squared distance from its centre, by 5/16 unit at a distance of one unit, so that of overlapping scales a
// pixel shows the one whose centre is nearest. There the brightness of neighbouring scales differs most as well, and would jump
// from one to the other: so it is averaged (Scale::averages). A scale that reaches farther than DOMED units from its centre along x
// or y has no dome. So no dome makes a pixel deeper by more than DOME_MOST, 1/128 unit, and depths within the table of factors
// still fit the Z-buffer.
constexpr int DOMED = 6, DOME_MOST = 2 * DOMED * DOMED * 5 * 128 / 16;
// Units, 9 fraction bits: a pixel that is wider than this counts as this wide, so that domes fit 16 bits. The narrower side of a
// pixel counts.
constexpr int32_t WIDEST_PIXEL = 10000;

// The dome of a voxel that is cut along a straight line, as Scale::dome: 1/128 unit, and it fits 16 bits. It is rounded down:
// next to the eye, where pixels are narrow, there is none.
inline int32_t domeOf(const Voxel& v, const Factors& f)
{
    if (v.halfWidth > DOMED * 256 || v.halfHeight > DOMED * 256)
        return 0;
    const int32_t pixel = min32(min32(f.zx, f.zy) >> 6, WIDEST_PIXEL);
    return 5 * pixel * pixel >> 14;
}

// Whether the depths of all pixels of a scale fit the Z-buffer, with a dome or without. `z` is the depth of the first pixel; it
// changes by `across` up to the last column and by `down` up to the last row, so that it is enough to look at the four corners.
inline bool depthsFit(int32_t z, int32_t across, int32_t down)
{
    const uint32_t end = Z_EMPTY - DOME_MOST;
    return static_cast<uint32_t>(z) < end && static_cast<uint32_t>(z + across) < end && static_cast<uint32_t>(z + down) < end &&
           static_cast<uint32_t>(z + across + down) < end;
}

// Domes a scale whose plane is set. (toColumn, toRow) leads from its centre to the centre of its first pixel, 12 fraction bits.
inline void setDome(int32_t dome, int32_t toColumn, int32_t toRow, Scale* scale)
{
    const int32_t across = dome * toColumn >> 12, down = dome * toRow >> 12;
    scale->dome = dome;
    scale->z += (across * toColumn + down * toRow) >> 13;
    scale->zRow += down + dome / 2 - (across + dome / 2) * scale->width;
    scale->zStep += across + dome / 2;
}

// The loop's input (the camera, the object, the buffers) and its running results.
struct Lens {
    int32_t x, y, z;                   // the object's centre relative to the eye, 1/256 unit
    const uint8_t* ramp;               // see VoxelList::ramp
    const Factors* factors;            // LENS_STEPS entries, the nearest depth first
    int32_t centreX, centreY;          // screen centre plus half a pixel, 12 fraction bits
    uint8_t* frame;                    // as for blitScale()
    uint16_t* zbuffer;
    int32_t left, top, right, bottom;  // in and out: a rectangle that grows to contain all that is drawn. It never leaves the
                                       // screen, so a scale that does not enlarge it needs no test against the screen's edges
    int32_t empty;                     // in and out: counts voxels that cover no pixel's centre on the screen
    uint32_t tiltAdd, tiltBits;        // set by limitTilts()
    int32_t focalX, focalY;            // focal lengths, pixels with 12 fraction bits
};

// Computes the factors of a depth nearer than the table; scales that near are few, and large. Returns false when the depth is
// not within LENS_NEAREST..LENS_NEAR or the factors are too large for the products of the loop. The zx and zy of the table are
// larger than these, so the bound given to limitTilts() holds for these as well.
constexpr int LENS_NEAREST = 1;
constexpr int32_t FACTOR_MOST = 0xffff;
inline bool nearFactors(const Lens& lens, int32_t depth, Factors* near)
{
    if (depth < LENS_NEAREST * 256 || depth >= LENS_NEAR * 256)
        return false;
    near->x = lens.focalX * 256 / depth;
    near->y = lens.focalY * 256 / depth;
    if (near->x > FACTOR_MOST || near->y > FACTOR_MOST)
        return false;
    near->zx = mulDiv(depth, 1 << 19, lens.focalX);
    near->zy = mulDiv(depth, 1 << 19, lens.focalY);
    return true;
}

// Sets tiltAdd and tiltBits, with which the assembly tests at once whether one of a voxel's tilts may exceed STEEPEST. `most` is an
// upper bound of zx and zy. If tiltX and tiltY, taken together as one 32-bit word, plus tiltAdd have none of tiltBits set,
// both lie within -tilt - 1 .. tilt, and no factor up to `most` takes such a tilt beyond STEEPEST.
inline void limitTilts(Lens* lens, uint32_t most)
{
    const uint32_t tilts = (static_cast<uint32_t>(STEEPEST) << 16) / (most | 1);
    uint32_t tilt = 1 << 14;
    while (tilt != 0 && tilt + 1 > tilts)
        tilt >>= 1;
    lens->tiltAdd = tilt * 0x10001;
    lens->tiltBits = tilt == 0 ? 0xffffffff : ~((2 * tilt - 1) * 0x10001);
}

// The index of a depth (1/256 unit) in the table of factors. It is negative or >= LENS_STEPS for depths outside the table.
inline int32_t lensStep(int32_t depth)
{
    return (depth >> 4) - LENS_NEAR * LENS_FINENESS;
}

// Returns the factors for a depth: from the table, or computed into `near`. Returns null when there are none (nearFactors()).
inline const Factors* factorsOf(const Lens& lens, int32_t depth, Factors* near)
{
    const uint32_t step = static_cast<uint32_t>(lensStep(depth));
    if (step < static_cast<uint32_t>(LENS_STEPS))
        return lens.factors + step;
    return nearFactors(lens, depth, near) ? near : nullptr;
}

extern "C" {

// Draws the voxels from `voxels` to before `end` in order. Returns `end`, or the first voxel that it cannot draw: one beyond the
// table's depths or too near for nearFactors(), one larger than LARGEST, or one so large and tilted that a depth would overflow
// 16 bits. The caller guarantees that positions times factors fit 32 bits.
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
