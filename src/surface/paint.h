// Paint: which colours and which brightness the voxels of a painted object get (surface/finish.h). Only objects that have a paint
// (model/paint.h) need it.
#ifndef FB_SURFPAINT_H
#define FB_SURFPAINT_H

#include "gather.h"
#include "model/paint.h"
#include "surface/finish.h"
#include "surface/voxel.h"

// Lists the voxels of one object in their colours. Made once for an object and a frame.
class Painter {
public:
    Painter(const SoftObject& object, const OwnFrame& own, VoxelList& list);

    bool shines() const { return paint_.shines(); }
    // Whether all voxels are in the object's own colour.
    bool isPlain() const { return paint_.pattern == PATTERN_NONE && !paint_.mixes; }

    // Lists a voxel that the shader has made of a seed, or two voxels where an edge of the pattern goes through it. If the object
    // shines, the voxel has one brightness for now, and its slopes are set later (slopes.h). Returns its place in the list.
    Voxel* add(const Seed& s, const Voxel& voxel);

private:
    struct Spot;
    Vector place(const Seed& s) const { return object_.root(s.root) + s.path * s.position; }
    Voxel* put(const Voxel& voxel, uint8_t number);
    bool cut(const Direction14& inward, int32_t apart, Voxel* voxel) const;
    Spot spotAt(const Vector& place, const Direction14& normal, uint8_t mix) const;

    const SoftObject& object_;
    const Paint& paint_;
    const OwnFrame& own_;
    const Polish polish_;
    VoxelList& list_;
    const PatternMap pattern_; // own space: a ball's seeds do not turn with it unless it rides, but its pattern does
    Vector from_;         // own space: vector from the middle of the pattern to the object's centre
    Real reach2_;         // squared distance from a seed within which an edge is near, in grains
};

// Sorts the voxels of a list in place by the numbers of their colours, and sets the list's runs.
void sortByColour(VoxelList& list, const Paint& paint);

#endif
