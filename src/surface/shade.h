// Shade: what settled seeds look like to the viewer: voxels with place, extents, tilt and brightness.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "patch.h"
#include "surface/voxel.h"

// How an object was seen in the frame before, and from that how often its patches are shaded anew: what moves little before the
// viewer is shaded in turns.
struct ViewBefore {
    int32_t seen[10] = {};
    uint32_t frames = 0;
    uint32_t mask = 0;  // a patch is shaded when its number and that of the frame have none of these bits in their sum

    // To be called once a frame.
    void turn(const OwnFrame& own);
};

// Lists what the viewer sees of the patches of one object, from patch `first` on, while the list holds fewer than `room` voxels
// with another patch. Returns the patch that is to come next, or `count`. The listed voxels stay those of the patches.
int shadePatches(SoftObject& object, const OwnFrame& own, const FrameContext& frame, Patch* patches, int count, int first,
                 ViewBefore& before, VoxelList& list, int room);

#endif
