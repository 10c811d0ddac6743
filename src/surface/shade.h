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
    // Two ways, the half axes of a cell, and twice the area that they span.
    struct Cell {
        Way along, across;
        int32_t area;
        bool uneven;  // blending has torn its ring out of line
    };

    template <bool TURNED>
    bool shadeAs(const Seed& s, bool oversampled, Voxel* voxel) const;
    template <bool TURNED>
    int32_t place(const Seed& s, Voxel* voxel) const;
    template <bool TURNED>
    void cell(const Seed& s, Cell& c) const;
    static void extents(const Cell& c, bool whole, Voxel* voxel);
    void end(int32_t facing, Voxel* voxel) const;
    void changes(const Seed& s, Cell& c) const;
    Way wayTo(const Vector& from, const Vector& to, int32_t change) const;
    static void slopes(const Cell& c, Voxel* voxel);
    static void setSlopes(int32_t x, int32_t y, Voxel* voxel);
    void roundSlopes(Voxel* voxel) const;

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
    const Seed* lastSeed_;    // the last regular one
    int32_t gradient_[3];     // of the brightness over a ball, 1/8 step a unit with 8 bits of fraction
    // Of the patch: the axes of the picture plane, sheared along the ray through its middle, so that a part of a vector along
    // the view shows sideways; 1.0 = 2^14. The same times the spacing, 6 bits of fraction.
    int32_t column_[3], row_[3];
    int32_t cellColumn_[3], cellRow_[3];
    int32_t horizonShare_;    // of the horizon: half of it over the distance of the eye, 16 bits of fraction
    int32_t gradientAhead_;   // how the brightness of a ball changes with the depth, 1/8 step a unit with 4 bits of fraction
};

#endif
