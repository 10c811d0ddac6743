// Voxel: what draw() makes of a seed and show() puts on the screen (report, Section III, Algorithms: "converts the seed
// list to a list of scales (called Voxels in the source code)").
#ifndef FB_VOXEL_H
#define FB_VOXEL_H

#include "vec.h"

struct Voxel {
    Vector place;      // from the eye, axes of the world, units
    int16_t wide;      // half extents along X and Y, 1/256 unit, 0 or more
    int16_t high;
    int16_t tiltX;     // slope of the depth across the scale: n.x / cosine of the angle at which it is seen, 8 bits of
    int16_t tiltY;     // fraction, within +-16; 0 for a scale that faces the viewer
    uint8_t colour;    // palette index; 0 is the background's, and taken for it when gaps are closed
};

#endif
