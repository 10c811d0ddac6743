// Voxel: what a seed looks like, draw() lists and show() puts on the screen (report, Section III, Algorithms: "converts
// the seed list to a list of scales (called Voxels in the source code)").
#ifndef FB_VOXEL_H
#define FB_VOXEL_H

#include "math/vec.h"

// A scale in space. A seed keeps its own as long as nothing about it changes, wherever the object goes.
struct Voxel {
    int32_t x, y, z;     // from the object's centre, axes of the view, 1/256 unit
    int16_t halfWidth, halfHeight;  // half extents along X and Y, 1/256 unit, 0 or more
    int16_t tiltX, tiltY;    // slopes of the depth across the scale, 8 bits of fraction
    int8_t brightness;       // of the middle, 0..63; below 0, to DARK_MIDDLE, where only a part of the scale is lit: it has a slope
    uint8_t reach;           // what lies farther behind the middle than this, 1/32 unit, is left out: there the surface has bent
                             // out of sight; 0: all is drawn
    int8_t cutX, cutY;       // slopes in the middle of a function across the scale, 1/8 a unit; both 0: it is not cut
    int8_t slopeX, slopeY;   // how the brightness changes across, 1/8 step a unit; no more than SHADING_MOST to any corner
    int16_t cutAt;           // that function in the middle, 1/64; where it is negative nothing is drawn
    int8_t curveXX, curveXY, curveYY;  // by how much cutX changes along x, cutX along y and cutY along x, cutY along y, 1/16 a
                             // squared unit; all 0: the scale ends at a straight line
    int8_t unused;           // 0
};

// Steps of brightness: 0..63, the 64-step ramp.
constexpr int BRIGHTEST = 63;

// Whether part of a voxel is left out by the function across it.
inline bool isCut(const Voxel& v)
{
    return (v.cutX | v.cutY) != 0;
}

// Lambert's (report, The Rendering Technique) from the cosine of normal and light, 1.0 = 2^14; below 0 where the side is dark.
inline int32_t lambert(int32_t cosine)
{
    return (cosine * BRIGHTEST + 8192) >> 14;
}

constexpr int SHADING_MOST = 64;
constexpr int DARK_MIDDLE = -30;

constexpr int VOXELS_AT_ONCE = 1024;

// Voxels of a list that have one ramp: those from where the run before ends to before `end`.
struct RampRun {
    const uint8_t* ramp;
    int end;
};
constexpr int RUNS_MOST = 240;

// The list of scales: voxels of one object.
struct VoxelList {
    int32_t x, y, z;       // the object's centre from the eye, 1/256 unit
    const uint8_t* ramp;   // palette index of each brightness, and of SHADING_MOST more at both ends like those; 0 is the
                           // background's, and taken for it when gaps are closed
    int32_t reach;         // no voxel lies farther than this from the centre along any axis, 1/256 unit
    int count;             // voxels in the list
    int runs;              // 0: all have `ramp`; else they have those of the runs
    RampRun run[RUNS_MOST];
    Voxel voxels[VOXELS_AT_ONCE];
    uint8_t number[VOXELS_AT_ONCE];  // of a painted object: of each voxel, the number of its colour

    // Empties the list for an object, the centre of which is `place` from the eye, and no part of which lies farther from it
    // than `most`.
    void begin(const Vector& place, Real most, const uint8_t* objectRamp)
    {
        x = rawFromReal(place.x) >> 8;
        y = rawFromReal(place.y) >> 8;
        z = rawFromReal(place.z) >> 8;
        reach = rawFromReal(most) >> 8;
        ramp = objectRamp;
        count = runs = 0;
    }
    // Where the next voxel may be written, and that it has been.
    Voxel* room() { return voxels + count; }
    void take() { ++count; }
};

#endif
