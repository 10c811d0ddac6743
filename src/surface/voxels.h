// Which seeds of a patch the viewer sees, and from those to their voxels: the innermost loops of shading.
#ifndef FB_VOXELS_H
#define FB_VOXELS_H

#include "patch.h"
#include "surface/voxel.h"

// A seed that the viewer sees, and its normal times the vector to the eye in steps of places, more than 0; or 0: it has not been
// measured.
struct Seen {
    Seed* seed;
    int32_t facing;
    Voxel* voxel;     // the one kept for it; null: there is none
};

// Seed::cellArea of a cell that is to be covered as a whole; larger ones are areas. 0: the cell has not been measured.
constexpr uint16_t WHOLE_CELL = 1;

// What the frame, the object and the patch are to the voxels of seeds. Directions have 14 bits of fraction.
struct Shading {
    int32_t eye[3];         // own space: 8 steps of places
    int32_t limb;           // a seed that faces the viewer no more than this is not drawn, steps of places
    uint32_t flags;         // out: those that some seen seeds have, and in the second byte those that all have
    int32_t turned;         // 0: own space is that of the view, and the next fields are not used
    int32_t right[3], up[3];  // axes of the view in own axes, over what a step of places is
    int32_t toRight[3], toUp[3], toAhead[3];  // the same times what takes places to 1/256 unit of the world
    int32_t depth;          // of the object's centre along the viewing axis, 1/256 unit
    uint32_t cell[3];       // axes of the picture plane, sheared along the ray: column in the upper half, row in the lower
    int32_t cellShift;      // takes half axes of cells on the picture plane to 1/256 unit
    int32_t areaShare;      // the area of a cell times facing / 8, times this: 2^32 times that on the picture plane
    uint32_t wholeMost;     // a cell of no larger area is covered as a whole
    int32_t horizonShare;   // of the radius of curvature: half of it over the distance of the eye, 12 bits of fraction
    int32_t gradient[2];    // of the brightness across the view, 1/8 step a unit with 8 bits of fraction
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

// A measured seed's normal times the vector to the eye, steps of places.
inline int32_t facingOf(const Seed& s, const Shading& v)
{
    return ((s.normal.x * v.eye[0] + s.normal.y * v.eye[1] + s.normal.z * v.eye[2]) >> 11) - s.height;
}

// Finds the valid seeds of a patch that the viewer sees, and all that have not been measured. Returns how many there are.
int findSeeds(Shading* shading, SoftObject& object, Patch* patch, Seen* seen);

extern "C" {

// Writes the voxels of `count` measured seeds, uncut. All are NEAREST_DEPTH or more in front of the eye and less than
// FARTHEST_DEPTH. It stands twice, in C++ (voxels.cpp), which says what it does, and in assembly (asm/voxels.S); both do the
// same, bit for bit.
void shadeSeedsC(const Shading* shading, const Seen* seen, int count);
#if FB_ASM
void shadeSeedsA(const Shading* shading, const Seen* seen, int count);
#endif

}

#if FB_ASM
#define shadeSeeds shadeSeedsA
#else
#define shadeSeeds shadeSeedsC
#endif

// Writes the place and the brightness of one alone.
inline void placeVoxel(const Shading& v, const Seed& s, Voxel& voxel)
{
    const auto along = [&](const int32_t axis[3]) {
        return (s.place[0] * axis[0] + s.place[1] * axis[1] + s.place[2] * axis[2]) >> 14;
    };
    voxel.x = v.turned ? along(v.toRight) : s.place[0];
    voxel.y = v.turned ? along(v.toUp) : s.place[1];
    voxel.z = v.turned ? along(v.toAhead) : s.place[2];
    voxel.brightness = static_cast<uint8_t>((s.brightness8 + 128) >> 8);
}

#endif
