// Voxel: a seed's scale in space. draw() makes lists of voxels and show() draws them (report, Section III, Algorithms:
// "converts the seed list to a list of scales (called Voxels in the source code)").
#ifndef FB_VOXEL_H
#define FB_VOXEL_H

#include "math/vec.h"

// A scale in space: a rectangle that faces the viewer, with the depths of the surface's tangent plane. It may be cut: a function
// that is linear or quadratic across the scale (the cut function) tells where nothing is drawn.
struct Voxel {
    int32_t x, y, z;         // centre relative to the object's centre, axes of the view, 1/256 unit
    int16_t halfWidth, halfHeight;  // half extents along x and y, 1/256 unit, 0 or more
    int16_t tiltX, tiltY;    // slopes of the depth along x and y, 8 fraction bits
    int8_t brightness;       // at the centre, 0..63; DARK_MIDDLE + 1..-1 if only a part of the scale is lit (it has slopes then)
    uint8_t back;            // pixels farther behind the centre than this, 1/32 unit, are not drawn, because there the surface has
                             // bent out of sight; 0: pixels are drawn however far before or behind the centre they are
    int8_t cutX, cutY;       // slopes of the cut function at the centre, 1/8 per unit; both 0: the scale is not cut
    int8_t slopeX, slopeY;   // slopes of the brightness, 1/8 step per unit; at most SHADING_MOST steps to any corner
    int16_t cutAt;           // cut function at the centre, 1/64; pixels where the function is negative are not drawn
    int8_t curveXX, curveXY, curveYY;  // second derivatives of the cut function, 1/16 per squared unit; all 0: the scale is cut
                             // along a straight line
    uint8_t front;           // if `back` is not 0: pixels farther before the centre than this, 1/32 unit, are not drawn, because
                             // there the tangent plane lies far before the surface
};

// The brightest of the 64 steps 0..63 of a ramp.
constexpr int BRIGHTEST = 63;

// The greatest value of `back` and `front`.
constexpr int ENDS_MOST = 255;

// Whether a cut function ends the voxel.
inline bool isCut(const Voxel& v)
{
    return (v.cutX | v.cutY) != 0;
}

// Whether it does so along a straight line.
inline bool isCutStraight(const Voxel& v)
{
    return isCut(v) && (v.curveXX | v.curveXY | v.curveYY) == 0;
}

// The greatest value of `cutAt`.
constexpr int CUT_MOST = 32000;

// Lets a voxel count as cut along a straight line, so that it is domed (picture/scales.h), though nothing of it is cut away; and
// tells whether a straight cut is one of these. (One whose cut function is as great as theirs has its line as far out of reach.)
inline void cutNowhere(Voxel* v)
{
    v->cutX = 1;
    v->cutAt = CUT_MOST;
}
inline bool isCutNowhere(const Voxel& v)
{
    return v.cutAt == CUT_MOST;
}

// Lambert's law (report, The Rendering Technique): brightness from the cosine of normal and light, 1.0 = 2^14; negative if unlit.
inline int32_t lambert(int32_t cosine)
{
    return (cosine * BRIGHTEST + 8192) >> 14;
}

// Upper bound of the change of brightness from the centre of a scale to its corners, steps.
constexpr int SHADING_MOST = 64;
// A ramp also tells its steps: as a signed byte, ramp[STEP_OF + i] is the step, 0..63, that has palette index i, less STEP_BIAS; it
// is not negative if none has. So its sum with any brightness that a ramp has fits a signed byte.
constexpr int STEP_OF = BRIGHTEST + 1 + SHADING_MOST;
constexpr int STEP_BIAS = BRIGHTEST + 1;
static_assert(SHADING_MOST + STEP_BIAS <= 128 && BRIGHTEST + SHADING_MOST - 1 <= 127, "the least and the greatest sum");
// A scale whose centre is this dark, or darker, has brightness 0 and no slopes.
constexpr int DARK_MIDDLE = -30;

constexpr int VOXELS_AT_ONCE = 1024;

// Consecutive voxels of a list that have one ramp: from the end of the previous run to before `end`.
struct RampRun {
    const uint8_t* ramp;
    int end;
};
constexpr int RUNS_MOST = 240;

// The list of scales: voxels of one object.
struct VoxelList {
    int32_t x, y, z;       // the object's centre relative to the eye, axes of the view, 1/256 unit
    const uint8_t* ramp;   // palette index of each brightness; both ends are repeated, so that -SHADING_MOST..63 + SHADING_MOST are
                           // valid too; and the step of each index (STEP_OF). No index is 0: that is the background, which gaps
                           // are recognised by
    int32_t extent;        // no voxel's centre is farther than this from the object's centre along any axis, 1/256 unit
    int count;             // voxels in the list
    bool bordered;         // some voxels are cut at a border to another object
    int guests;            // voxels at the end of `voxels` that belong to other objects
    int runs;              // number of runs, each with its own ramp; 0: all voxels have `ramp`
    RampRun run[RUNS_MOST];
    Voxel voxels[VOXELS_AT_ONCE];
    uint8_t number[VOXELS_AT_ONCE];  // of a painted object: the number of each voxel's colour; of a guest: the slot of its host

    // Empties the list for an object with its centre at `place` relative to the eye. `most` is the upper bound of the distance of
    // its parts from the centre.
    void begin(const Vector& place, Real most, const uint8_t* objectRamp)
    {
        x = rawFromReal(place.x) >> 8;
        y = rawFromReal(place.y) >> 8;
        z = rawFromReal(place.z) >> 8;
        extent = rawFromReal(most) >> 8;
        ramp = objectRamp;
        count = guests = runs = 0;
        bordered = false;
    }
    // The caller writes the next voxel to *room() and then calls take().
    Voxel* room() { return voxels + count; }
    void take() { ++count; }
    // Room for a voxel that belongs to another object. There is none if count + guests is VOXELS_AT_ONCE.
    Voxel* roomForGuest(uint8_t slot)
    {
        const int at = VOXELS_AT_ONCE - ++guests;
        number[at] = slot;
        return voxels + at;
    }
};

#endif
