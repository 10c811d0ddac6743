// Paint: what a finish makes of the brightness of an object's seeds, what a pattern has at a place of the object, and voxels
// sorted by their colours. Only for objects that have a paint (model/paint.h).
#ifndef FB_SURFPAINT_H
#define FB_SURFPAINT_H

#include "gather.h"
#include "model/paint.h"
#include "surface/voxel.h"

// Sets the brightness of the object's seeds as its finish has it, from their normals.
void polish(SoftObject& object, const OwnFrame& own);

// The pattern of an object, for the length of a frame.
class Grain {
public:
    explicit Grain(const SoftObject& object);

    // What the pattern has at a place: the number of the colour there, in a body where the mixture has number `mix`; and if an
    // edge of the pattern is near, the number of the colour beyond, which way leads away from the edge and how far it is, as
    // cut() of the shader takes it.
    struct Spot {
        uint8_t number, beyond;
        bool edge;
        Direction14 inward;
        int32_t apart;  // 1/256 unit
    };
    // `place` from the centre in units of own space, `normal` of the surface there; own axes.
    Spot at(const Vector& place, const Direction14& normal, uint8_t mix) const;

private:
    const Paint& paint_;
    Vector axis_[3];      // of the pattern, own axes: a ball's seeds do not turn with it, but its pattern does
    Real inverse_, edge_; // own space to grains; a grain in units of the world
    Real reach2_;         // how far from a seed an edge is near, squared, in grains
};

// Sorts the voxels of a list by the numbers of their colours into runs.
void sortByColour(VoxelList& list, const Paint& paint);

#endif
