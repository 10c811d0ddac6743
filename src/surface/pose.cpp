// How far a neighbour travels: at most as far as the farthest place of its core, plus the change of its size.
#include "pose.h"

void NeighbourPose::take(const Neighbour& near)
{
    size_ = near.size;
    place_ = near.centre;
    if (near.object->isBall())
        return;
    const bool shaped = near.object->shaped();
    const Real unit = shaped ? Real(1) : near.size * Real(1.0 / CORE_SIZE);
    if (shaped)
        place_ = near.offset;
    for (int i = 0; i < 3; ++i)
        axes_[i] = near.toCore[i] * unit;
    warp_ = near.object->warp().amounts();
}

Real NeighbourPose::followTurned(const Neighbour& near, Real reach)
{
    if (!near.object->shaped())
        return followCore(near);
    const NeighbourPose before = *this;
    take(near);
    // Some places of a shaped neighbour travel farther than most, which are taken to travel like the object's centre.
    const Real farthest = travelAsMapped(near, before, reach);
    return max(travelAsMapped(near, before, Real(0)), shiftDown(farthest, 1));
}

// Follows a neighbour that is neither stretched nor warped: its travel is that of its core. Axes along which the core does not
// extend do not matter.
Real NeighbourPose::followCore(const Neighbour& near)
{
    const Real unit = near.size * Real(1.0 / CORE_SIZE);
    const Vector extent = near.object->coreExtent16();
    Real travelled = roundLength(near.centre - place_) + absolute(near.size - size_);
    place_ = near.centre;
    size_ = near.size;
    const auto turn = [&](int i, Real half16) __attribute__((always_inline)) {
        if (half16 == Real(0))
            return;
        const Vector axis = near.toCore[i] * unit;
        travelled += roundLength(axis - axes_[i]) * (half16 * unit);
        axes_[i] = axis;
    };
    turn(0, extent.x);
    turn(1, extent.y);
    turn(2, extent.z);
    return travelled;
}

// The travel of a shaped neighbour, from its map into core space: an upper bound for all places no farther than `reach` from the
// object's centre.
Real NeighbourPose::travelAsMapped(const Neighbour& near, const NeighbourPose& before, Real reach) const
{
    const Vector by = place_ - before.place_;
    // What leaps farther than this has travelled far enough, and its travel might leave 16.16.
    const Real longest(100);
    const auto along = [&](int i, Real moved) {
        return min(absolute(moved), longest) + min(roundLength(axes_[i] - before.axes_[i]) * reach, longest);
    };
    const Vector most{along(0, by.x), along(1, by.y), along(2, by.z)};
    const Real travelled = min(roundLength(most), longest) * near.size * Real(1.0 / CORE_SIZE);
    if (!near.object->warped())
        return travelled;
    // A taper is a share of the width; twist and bend are degrees.
    const auto change = [&](int part) { return absolute(warp_.part[part] - before.warp_.part[part]); };
    return travelled + (change(WARP_TAPER) + (change(WARP_TWIST) + change(WARP_BEND)) * Real(0.0174533)) * near.object->reach();
}
