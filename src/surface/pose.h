// Where a neighbour stands, and how far it comes between two frames.
#ifndef FB_POSE_H
#define FB_POSE_H

#include "gather.h"

// About the length of a vector, never less than nine tenths of it.
inline Real roundLength(const Vector& v)
{
    const Real x = absolute(v.x), y = absolute(v.y), z = absolute(v.z), greatest = max(max(x, y), z);
    return greatest + (x + y + z - greatest) * Real(0.375);
}

// How far a neighbour has come, units: no place of its field that the object could meet has come farther than `farthest`; what is
// neither stretched nor warped has come that far where the object has its centre, too.
struct Travelled {
    Real farthest, middle;
};

// A neighbour's centre and axes in the space of an object; of what is shaped, the map into its core space.
class Pose {
public:
    // It stands where a neighbour does now.
    void take(const Neighbour& near);

    // The same, and how far the neighbour has come since it stood here. `reach` is the object's.
    Travelled follow(const Neighbour& near, Real reach)
    {
        if (near.kind != Neighbour::POINT)
            return followTurned(near, reach);
        const Real way = roundLength(near.centre - place_) + absolute(near.size - size_);
        place_ = near.centre;
        size_ = near.size;
        return {way, way};
    }

private:
    SELDOM Travelled followTurned(const Neighbour& near, Real reach);
    Real travelAsCore(const Neighbour& near, const Pose& before) const;
    Real travelAsMapped(const Neighbour& near, const Pose& before, Real reach) const;

    Vector place_;
    Real size_;
    Vector axes_[3];    // of a point these are not known
    WarpAmounts warp_;
};

#endif
