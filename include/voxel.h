// Voxel: what draw() makes of a seed and show() puts on the screen (report, Section III, Algorithms: "converts the seed
// list to a list of scales (called Voxels in the source code)").
#ifndef FB_VOXEL_H
#define FB_VOXEL_H

#include "vec.h"

struct Voxel {
    Vector place;      // from the eye, axes of the world, units
    int16_t wide;      // half extents along X and Y, 1/256 unit, 0 or more
    int16_t high;
    uint8_t colour;    // palette index
};

#endif
