// Shade: what a settled seed looks like to the viewer: a voxel with its place, extents, tilt and brightness.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "patch.h"
#include "surface/voxel.h"

// Turns the seeds of one object into voxels. Made once for an object and a frame.
class Shader {
public:
    Shader(const SoftObject& object, const OwnFrame& own, const FrameContext& frame);

    // To be called before the seeds of a patch: from where the viewer sees it.
    void setPatch(const Patch& patch);

    // Fills in the voxel of a valid seed. False: it faces away.
    bool shade(const Seed& s, bool oversampled, Voxel* voxel);

    // Fills in the one voxel of a coarse patch.
    bool shadePatch(const Patch& patch, const Patch* patches, Voxel* voxel);

private:
    // Half of a way along the surface as it falls on the picture, 1/256 unit, and what the brightness changes by over it, 8
    // bits of fraction.
    struct Way {
        int32_t x, y, change;
    };

    bool place(const Seed& s, Voxel* voxel);
    void cell(const Seed& s);
    void stretch(int32_t along16, int32_t across16);
    void extents(bool whole, Voxel* voxel) const;
    void end(Voxel* voxel) const;
    Way wayTo(const Vector& from, const Vector& to, int32_t change) const;
    static void slopes(const Way& along, const Way& across, Voxel* voxel);

    const SoftObject& object_;
    const OwnFrame& own_;
    bool grown_;
    bool turned_;             // own axes are not those of the world
    int32_t spacing_;         // 1/256 unit of the world
    int32_t limb_;            // a seed that faces the viewer less than this is not drawn, 1/32 unit
    int32_t generalHorizon_;  // radius of curvature at the edge of the object, 1/32 unit
    int32_t horizon_;         // of the patch
    int32_t depth_;           // of the object's centre along the viewing axis, 1/32 unit
    int32_t away_[2];         // the centre from the eye, across the view, 1/32 unit
    int32_t inverseRadius_;   // 2^24 / radius in 1/64 unit
    // Of the patch: the axes of the picture plane, sheared along the ray through its middle, so that a part of a vector along
    // the view shows sideways; 1.0 = 2^14.
    int32_t column_[3], row_[3];
    // Of the seed.
    int32_t facing_;          // its normal times the vector to the eye, 1/32 unit
    bool uneven_;             // blending has torn its ring out of line
    Way along_, across_;      // half axes of its cell
};

#endif
