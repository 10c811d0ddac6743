// Shade: what a settled seed looks like to the viewer: a voxel with its place, extents, tilt and brightness.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "patch.h"
#include "surface/voxel.h"

// Steps of brightness: 0..63, the 64-step ramp.
constexpr int BRIGHTEST = 63;

// Brightness of a surface that faces along `normal` under a light from `light` (both 1.0 = 2^14): Lambert's cosine, 8 bits of
// fraction, 0..63 * 256 (report, The Rendering Technique).
inline int32_t brightness8(const Direction14& normal, const int32_t light[3])
{
    const int32_t cosine = (normal.x * light[0] + normal.y * light[1] + normal.z * light[2]) >> 14;
    return cosine <= 0 ? 0 : cosine * BRIGHTEST >> 6;
}

// How the seeds of one object are turned into voxels; made once for an object and a frame.
class Shader {
public:
    Shader(const SoftObject& object, const OwnFrame& own, const FrameContext& frame);

    // To be called before the seeds of a patch: from where the viewer sees it.
    void setPatch(const Patch& patch);

    // Fills in the voxel of a valid seed. False: it faces away.
    bool shade(const Seed& s, bool oversampled, Voxel* voxel);

private:
    void extents(const Seed& s, int32_t side, bool oversampled, Voxel* voxel);
    void slopes(const Seed& s, bool oversampled, Voxel* voxel) const;
    void end(int32_t facing, int32_t depth, Voxel* voxel) const;

    const SoftObject& object_;
    const OwnFrame& own_;
    bool grown_;
    int32_t spacing_;        // 1/256 unit of the world
    int32_t limb_;           // a seed that faces the viewer less than this is not drawn, 1/32 unit
    int32_t generalHorizon_; // radius of curvature at the edge of the object, 1/32 unit
    int32_t horizon_;        // of the patch
    int32_t depth_;          // of the object's centre along the viewing axis, 1/32 unit
    int32_t away_[2];        // the centre from the eye, across the view, 1/32 unit
    // Of the patch: the axes of the picture plane, sheared along the ray through its middle, so that a part of a vector along
    // the view shows sideways; 1.0 = 2^14.
    int32_t column_[3], row_[3];
    // Of the seed: half axes of its cell as they fall on the picture, 1/64 spacing with 8 bits of fraction.
    int32_t alongX_, alongY_, acrossX_, acrossY_;
};

#endif
