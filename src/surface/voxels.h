// The innermost loops of shading: they find the seeds of a patch that the viewer sees, and compute their voxels.
#ifndef FB_VOXELS_H
#define FB_VOXELS_H

#include "math/whole.h"
#include "patch.h"
#include "surface/voxel.h"

// A seed that the viewer sees.
struct Seen {
    const Seed* seed;
    int32_t facing;         // dot product of its unit normal and the vector from the seed to the eye, steps of places; above 0
};

// What shading needs to know of the frame, the object and the patch. Own space is the object's own coordinate system. Positions
// in own space are 16-bit whole numbers of "steps of places", a step being 2^placeShift in raw Real. The cell of a seed is its
// part of the surface. Unit vectors have 14 fraction bits.
struct Shading {
    const Seed* seeds;      // the object's regular seeds
    const Vector* roots;
    int32_t placeShift;     // a raw Real shifted right by this is in steps of places
    int32_t eye[3];         // the eye in own space, 8 steps of places
    int32_t light[3];       // unit vector towards the light, own axes
    int32_t limb;           // a seed with a Seen::facing up to this is not drawn
    int32_t turned;         // 0: own space has the axes and the scale of the view, and the next five fields are not used
    int32_t right[3], up[3];  // axes of the view in own axes, divided by the length of a step of places in 1/256 unit
    int32_t toRight[3], toUp[3], toAhead[3];  // the axes multiplied by that length: they take positions to 1/256 unit of the view
    int32_t depth;          // depth of the object's centre, 1/256 unit
    int32_t leastPosition;  // cells grow in proportion to the seed's position, or to this if it is greater; 8 fraction bits
    uint32_t cell[3];       // axes of the picture plane, sheared along the ray: column in the upper 16 bits, row in the lower
    int32_t cellShift;      // shifts half axes of cells on the picture plane right to 1/256 unit
    int32_t areaShare;      // area of a cell on the picture plane = area * (facing / 8) * areaShare / 2^32
    int32_t wholeBefore;    // the scales of seeds with a smaller Seen::facing cover the whole cell, others only its share of a band
    int32_t deepest;        // upper bound of the change of depth from the centre of a scale that ends to its corners, 1/256 unit
    int32_t front;          // Voxel::front of all voxels that end (Voxel::back)
    int32_t horizonShare;   // takes Seen::facing to Voxel::back in 2^-16: radius of curvature / distance of the eye, 12 fraction
                            // bits, times a step of places in 1/256 unit
    int32_t gradient[2];    // gradient of the brightness along x and y of the view, 1/8 step per unit, 12 fraction bits
    int32_t gradientAhead;  // and along the ray of sight, 4 fraction bits
};

// Seeds from the first to before the second of these depths are drawn, 1/256 unit.
constexpr int32_t NEAREST_DEPTH = 256, FARTHEST_DEPTH = 1 << 22;

// Upper bound of a voxel's tilts, 8 fraction bits.
constexpr int32_t STEEPEST_TILT = 18000;

// A scale exceeds its cell to each side by 2^-MARGIN_SHIFT of the half extent and by the rounding error of positions, 1/256 unit.
constexpr int MARGIN_SHIFT = 5;
constexpr int32_t MARGIN_UNITS = 14;

// A scale whose brightness changes by less than this from its centre to its corner (1/8 step) is drawn in one brightness.
constexpr int32_t FLAT_SHADING = 8;

// Upper bound of that change. Greater slopes are halved until they fit, because so far from the centre the brightness does not
// really go on changing at the centre's slope.
constexpr int32_t STEEPEST_SHADING = 240;
static_assert(-DARK_MIDDLE * 8 + STEEPEST_SHADING < SHADING_MOST * 8, "no corner of a scale is beyond the ends of a ramp");

// Sets a voxel's slopes of brightness, 1/8 step per unit, or none if they would not show. Half extents and brightness are known.
inline void setSlopes(int32_t x, int32_t y, Voxel* voxel)
{
    const int32_t light = voxel->brightness;
    voxel->brightness = static_cast<int8_t>(max32(light, 0));
    voxel->slopeX = voxel->slopeY = 0;
    int32_t corner = (magnitude(x) * voxel->halfWidth + magnitude(y) * voxel->halfHeight) >> 8;
    if (corner < FLAT_SHADING)
        return;
    for (; corner > STEEPEST_SHADING; corner >>= 1) {
        x >>= 1;
        y >>= 1;
    }
    // The centre is dark, and the light does not even reach a corner.
    if (corner + light * 8 <= 0)
        return;
    voxel->brightness = static_cast<int8_t>(light);
    voxel->slopeX = static_cast<int8_t>(limited(x, 127));
    voxel->slopeY = static_cast<int8_t>(limited(y, 127));
}

// Cosines of path and normal. The first is a lower bound, so that blending stretches no scale to more than two and a half times its
// cell. Below the second a cell no longer forms an even band with its neighbours in the ring.
constexpr int32_t LEAST_COSINE = 6500, ASLANT = 15500;

// Upper bound of the area of a cell, in the units of Seed::area.
constexpr int32_t AREA_MOST = 16383;

// Computes the position of a seed in own space, in steps of places.
inline void findPlace(const Shading& v, const Seed& s, int32_t place[3])
{
    if (s.flags & SEED_RESTING) {
        for (int i = 0; i < 3; ++i)
            place[i] = s.place[i];
        return;
    }
    const Vector to = v.roots[s.root] + s.path * s.position;
    place[0] = rawFromReal(to.x) >> v.placeShift;
    place[1] = rawFromReal(to.y) >> v.placeShift;
    place[2] = rawFromReal(to.z) >> v.placeShift;
}

// Returns whether the viewer sees a seed, and then sets *seen and the position of its voxel.
bool findSeed(const Shading& v, const Seed& s, Seen* seen, Voxel* voxel);

extern "C" {

// Both routines exist twice: in C++ (voxels.cpp), the readable reference, and in assembly (asm/voxels.S). Both write the same bits.

// Finds the regular seeds of a patch that the viewer sees, and sets the positions of their voxels. Returns their number.
int findSeedsC(const Shading* shading, const Patch* patch, Seen* seen, Voxel* voxels);

// Sets all other fields of the voxels of `count` seeds, which are not cut. The caller guarantees that their depths are from
// NEAREST_DEPTH to before FARTHEST_DEPTH.
void shadeSeedsC(const Shading* shading, const Seen* seen, Voxel* voxels, int count);
#if FB_ASM
int findSeedsA(const Shading* shading, const Patch* patch, Seen* seen, Voxel* voxels);
void shadeSeedsA(const Shading* shading, const Seen* seen, Voxel* voxels, int count);
#endif

}

#if FB_ASM
#define findSeeds findSeedsA
#define shadeSeeds shadeSeedsA
#else
#define findSeeds findSeedsC
#define shadeSeeds shadeSeedsC
#endif

// Cuts a voxel along a straight line. The unit vector (x, y, z), axes of the view, 1.0 = 2^14, is perpendicular to the line and
// points to the side that stays; the voxel's centre is `apart` away from the line on that side, 1/256 unit. (shearX, shearY) is
// the slope of the ray of sight along x and y per unit of depth, 10 fraction bits. Returns false when nothing of the voxel is left.
bool cutVoxel(int32_t x, int32_t y, int32_t z, int32_t apart, int32_t shearX, int32_t shearY, Voxel* voxel);

#endif
