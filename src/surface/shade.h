// Shade: what settled seeds look like to the viewer: voxels with place, extents, tilt and brightness.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "patch.h"
#include "surface/voxel.h"

// Lists what the viewer sees of the patches of one object, from patch `first` on, while the list holds fewer than `room` voxels
// with another patch. `turn` counts the frames of the object. Returns the patch that is to come next, or `count`.
int shadePatches(SoftObject& object, const OwnFrame& own, const FrameContext& frame, Patch* patches, int count, int first,
                 int turn, VoxelList& list, int room);

#endif
