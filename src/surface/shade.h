// Shade: what settled seeds look like to the viewer: voxels with place, extents, tilt and brightness.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "keeper.h"
#include "surface/voxel.h"

// Adds the voxels of all seeds that the viewer sees to the list, patch by patch from patch `first` on, as long as the voxels of
// another patch are sure to fit into `room`. `keeper` has the voxels of earlier frames. Returns the patch to go on with, or
// `count`.
int shadePatches(SoftObject& object, const OwnFrame& own, const FrameContext& frame, Patch* patches, int count, int first,
                 VoxelList& list, int room, Keeper& keeper);

#endif
