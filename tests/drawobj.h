// Draws one object of a frame as the program does.
#ifndef FB_DRAWOBJ_H
#define FB_DRAWOBJ_H

#include "model/softobj.h"
#include "picture/view.h"
#include "surface/voxel.h"

inline void drawObject(SoftObject& object, const FrameContext& frame, View& view)
{
    static VoxelList list;
    object.update(frame);
    int next = 0;
    do {
        object.draw(frame, list, VOXELS_AT_ONCE, &next);
        view.show(list);
    } while (next != 0);
}

#endif
