// Which seeds of a patch the viewer sees, and from those to their voxels: the innermost loops of shading.
#ifndef FB_VOXELS_H
#define FB_VOXELS_H

#include "math/whole.h"
#include "patch.h"
#include "surface/voxel.h"

// A seed that the viewer sees, and its normal times the vector to the eye in steps of places, more than 0.
struct Seen {
    const Seed* seed;
    int32_t facing;
};

// What the frame, the object and the patch are to the voxels of seeds. Directions have 14 bits of fraction. Places of own space
// are whole numbers of 16 bits, in steps that are a power of 2 in raw Real.
struct Shading {
    const Seed* seeds;      // the object's regular ones
    const Vector* roots;
    int32_t placeShift;     // bits of Real below those of places
    int32_t eye[3];         // own space: 8 steps of places
    int32_t light[3];       // unit vector towards the light, own axes
    int32_t limb;           // a seed that faces the viewer no more than this is not drawn, steps of places
    int32_t turned;         // 0: own space is that of the view, and the next fields are not used
    int32_t right[3], up[3];  // axes of the view in own axes, over what a step of places is
    int32_t toRight[3], toUp[3], toAhead[3];  // the same times what takes places to 1/256 unit of the world
    int32_t depth;          // of the object's centre along the viewing axis, 1/256 unit
    int32_t leastPosition;  // cells grow with the position from here on, 8 bits of fraction
    uint32_t cell[3];       // axes of the picture plane, sheared along the ray: column in the upper half, row in the lower
    int32_t cellShift;      // takes half axes of cells on the picture plane to 1/256 unit
    int32_t areaShare;      // the area of a cell times facing / 8, times this: 2^32 times that on the picture plane
    int32_t wholeMost;      // a cell of no larger area is covered as a whole
    int32_t deepest;        // a scale that ends changes its depth to no corner by more than this, 1/256 unit
    int32_t horizonShare;   // of the radius of curvature: half of it over the distance of the eye, 12 bits of fraction
    int32_t gradient[2];    // of the brightness across the view, 1/8 step a unit with 12 bits of fraction
    int32_t gradientAhead;  // the same along it, 4 bits of fraction
};

// Depths between which seeds are drawn, 1/256 unit.
constexpr int32_t NEAREST_DEPTH = 256, FARTHEST_DEPTH = 1 << 22;

// No depth changes more than this across a scale, 8 bits of fraction.
constexpr int32_t STEEPEST_TILT = 20000;

// What a scale is larger than its cell to each side: a part of the cell (2^-5), and what places are uncertain by (1/256 unit).
constexpr int MARGIN_SHIFT = 5;
constexpr int32_t MARGIN_UNITS = 14;

// Change of brightness (1/8 step) from the middle of a scale to its corner below which it has one brightness.
constexpr int32_t FLAT_SHADING = 8;

// And the most that it is let to be: half of what says more, for there the brightness does not go on as it does in the middle.
constexpr int32_t STEEPEST_SHADING = 240;

// Sets how the brightness changes across a voxel that has its extents, 1/8 step a unit: not at all when that is next to nothing.
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
    // Not even a corner of it is lit.
    if (corner + light * 8 <= 0)
        return;
    voxel->brightness = static_cast<int8_t>(light);
    voxel->slopeX = static_cast<int8_t>(limited(x, 127));
    voxel->slopeY = static_cast<int8_t>(limited(y, 127));
}

// No scale is stretched to more than two and a half times its cell by blending: cosine of path and normal. Below the other cosine
// a cell lies in no even band of its ring.
constexpr int32_t LEAST_COSINE = 6500, UNEVEN = 15500;

// The largest area of a cell.
constexpr int32_t AREA_MOST = 16383;

// Where a seed is in own space, in steps of places.
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

// Whether the viewer sees a seed. If so, `*seen` and the place of the voxel are set.
bool findSeed(const Shading& v, const Seed& s, Seen* seen, Voxel* voxel);

extern "C" {

// Both stand twice, in C++ (voxels.cpp), which says what they do, and in assembly (asm/voxels.S); both do the same, bit for bit.

// Finds the regular seeds of a patch that the viewer sees, and sets the places of their voxels. Returns how many there are.
int findSeedsC(const Shading* shading, const Patch* patch, Seen* seen, Voxel* voxels);

// Writes the rest of the voxels of `count` seeds, uncut. All are NEAREST_DEPTH or more in front of the eye and less than
// FARTHEST_DEPTH.
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

// Ends a voxel at a straight line: inwards of it leads (x, y, z), axes of the view, 1.0 = 2^14, and the middle is `apart` inwards,
// 1/256 unit. (shearX, shearY) is how far the ray of sight leads aside over a unit of depth, 10 bits of fraction. False: nothing
// is left.
bool cutVoxel(int32_t x, int32_t y, int32_t z, int32_t apart, int32_t shearX, int32_t shearY, Voxel* voxel);

#endif
