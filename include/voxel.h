// Voxel: what draw() makes of a seed and show() puts on the screen (report, Section III, Algorithms: "converts the seed
// list to a list of scales (called Voxels in the source code)").
#ifndef FB_VOXEL_H
#define FB_VOXEL_H

#include <stdint.h>

// The colour of a voxel that is not drawn, but tells where a gap between scales may show.
constexpr uint8_t GAP = 0;

// Half the size of a scale, and how it is tilted.
struct ScaleShape {
    int16_t wide;      // half extents along X and Y, 1/256 unit, 0 or more
    int16_t high;
    int16_t tiltX;     // slope of the depth across the scale: n.x / cosine of the angle at which it is seen, 8 bits of
    int16_t tiltY;     // fraction, within +-16; 0 for a scale that faces the viewer
};

struct Voxel {
    int32_t x, y, z;   // from the eye, axes of the world, 1/256 unit
    ScaleShape shape;
    uint8_t colour;    // palette index
};

#endif
