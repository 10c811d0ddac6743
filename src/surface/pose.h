// Pose: where a neighbour is and how it is turned, and how far it travels between two frames.
#ifndef FB_POSE_H
#define FB_POSE_H

#include "gather.h"

// Roughly the length of a vector, never less than nine tenths of it.
inline Real roundLength(const Vector& v)
{
    const Real x = absolute(v.x), y = absolute(v.y), z = absolute(v.z), greatest = max(max(x, y), z);
    return greatest + (x + y + z - greatest) * Real(0.375);
}

// A neighbour's centre and axes in an object's own space; of a shaped neighbour, the map into its core space instead.
class NeighbourPose {
public:
    // Takes the present pose of a neighbour.
    void take(const Neighbour& near);

    // Takes the present pose, and returns how far the neighbour has travelled from the one before, units: as far as the farthest
    // place of its core. A shaped one travels as far as it does at the object's centre, but at least half as far as in any place no
    // farther than `reach`, the object's, from there.
    Real follow(const Neighbour& near, Real reach)
    {
        if (!near.object->isBall())
            return followTurned(near, reach);
        const Real travelled = roundLength(near.centre - place_) + absolute(near.size - size_);
        place_ = {near.centre.x, near.centre.y, near.centre.z};
        size_ = near.size;
        return travelled;
    }

private:
    SELDOM Real followTurned(const Neighbour& near, Real reach);
    Real followCore(const Neighbour& near);
    Real travelAsMapped(const Neighbour& near, const NeighbourPose& before, Real reach) const;

    Vector place_;
    Real size_;
    Vector axes_[3];    // not set for a ball
    WarpAmounts warp_;
};

#endif
