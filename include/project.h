// From voxels to scales: the perspective transformation of the seeds' scales (report, The Rendering Technique), done for
// every scale of a frame. It stands twice, like the loops of blit.h: in C++ (src/project.cpp) and in assembly
// (asm/project.S); both do the same, bit for bit.
#ifndef FB_PROJECT_H
#define FB_PROJECT_H

#include "blit.h"
#include "voxel.h"

// Depth steps (1/128 unit) from pixel to pixel; a surface seen more edge-on than this is taken as this steep.
constexpr int32_t STEEPEST = 400;
// Width and height up to which, together, no corner of a sloped scale leaves the 16 bits of a depth while its middle is
// in the table's range.
constexpr int SLOPED_MOST = 24;

// What a depth makes of lengths.
struct Factors {
    int32_t x, y;    // focal 2^12 / z: 1/256 unit to 1/2^20 pixel
    int32_t zx, zy;  // z 2^15 / focal: a tilt to the change of depth from pixel to pixel, 1/2^16 of 1/128 unit
};

// The camera in the terms of the loop, and the part of the screen that was drawn to.
struct Lens {
    const Factors* factors;    // one for each 1/8 unit of depth from LENS_NEAR to LENS_FAR units
    int32_t centreX, centreY;  // pixels with 12 bits of fraction, and half a pixel more
    int32_t left, top, right, bottom;  // in and out: a rectangle that grows to hold every scale
};
constexpr int LENS_NEAR = 76, LENS_FAR = 256;
constexpr int LENS_STEPS = (LENS_FAR - LENS_NEAR) * 8;

extern "C" {

// Makes scales of up to `count` voxels, in their order, and returns how many voxels were dealt with; `*made` tells the
// number of scales (those that cover no pixel's centre make none). It stops at a voxel that is not its business: one of
// colour GAP, out of the table's depths, not wholly on the screen, or larger than SLOPED_MOST there.
int projectC(Lens* lens, const Voxel* voxels, int count, Scale* scales, int* made);
#if FB_ASM
int projectA(Lens* lens, const Voxel* voxels, int count, Scale* scales, int* made);
#endif

}

#if FB_ASM
#define projectScales projectA
#else
#define projectScales projectC
#endif

#endif
