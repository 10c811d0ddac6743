// Paint: what a finish makes of the brightness of an object's seeds, and the colours of its voxels. Only for objects that have
// a paint (model/paint.h).
#ifndef FB_SURFPAINT_H
#define FB_SURFPAINT_H

#include "gather.h"
#include "model/paint.h"
#include "surface/voxel.h"

// What a finish that shines makes of an object's brightness. Made once for a frame.
class Polish {
public:
    Polish(const SoftObject& object, const OwnFrame& own);

    // Brightness of a surface that faces along `normal`, 0..63 with 8 bits of fraction.
    int32_t brightness8(const Direction14& normal) const;

private:
    const OwnFrame& own_;
    const bool mirror_;
    int32_t up_[3], half_[3];  // own axes: the height of the world, and what is half way between light and viewer
    int32_t upAhead_;          // the height of where the viewer looks
};

// Lists the voxels of one object in their colours. Made once for a frame.
class Painter {
public:
    Painter(const SoftObject& object, const OwnFrame& own, VoxelList& list);

    bool shines() const { return paint_.shines(); }

    // Lists what the shader has made of a seed; in two voxels where an edge of a pattern goes through it. What shines has one
    // brightness there, and its slopes are still to come (slopes.h).
    void add(const Seed& s, const Voxel& voxel);

private:
    struct Spot;
    Vector place(const Seed& s) const { return object_.root(s.root) + s.path * s.position; }
    void put(const Voxel& voxel, uint8_t number);
    bool cut(const Direction14& inward, int32_t apart, Voxel* voxel) const;
    Spot spotAt(const Vector& place, const Direction14& normal, uint8_t mix) const;

    const SoftObject& object_;
    const Paint& paint_;
    const OwnFrame& own_;
    const Polish polish_;
    VoxelList& list_;
    Vector axis_[3];      // of the pattern, own axes: a ball's seeds do not turn with it, but its pattern does
    Vector from_;         // own space: from the middle of the pattern to the object's centre
    Real inverse_, edge_; // own space to grains; a grain in units of the world
    Real reach2_;         // how far from a seed an edge is near, squared, in grains
};

// Sorts the voxels of a list by the numbers of their colours into runs.
void sortByColour(VoxelList& list, const Paint& paint);

#endif
