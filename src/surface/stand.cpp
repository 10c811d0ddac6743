// How far a neighbour comes: no farther than the farthest place of its core, and what its size changes by.
#include "stand.h"

namespace {

// What is neither stretched nor warped, by what its core does.
Real cameAsCore(const Neighbour& near, const Stand& now, const Stand& before)
{
    const Real way = roundLength(now.place - before.place) + absolute(now.size - before.size);
    if (near.kind == Neighbour::POINT)
        return way;
    const Vector extent = near.object->coreExtent16() * (near.size * Real(1.0 / CORE_SIZE));
    return way + roundLength(now.axes[0] - before.axes[0]) * extent.x + roundLength(now.axes[1] - before.axes[1]) * extent.y +
           roundLength(now.axes[2] - before.axes[2]) * extent.z;
}

// What is, by its map into core space.
Real cameAsMapped(const Neighbour& near, const Stand& now, const Stand& before, Real reach)
{
    const Vector by = now.place - before.place;
    const Real longest(100);
    const Vector most{absolute(by.x) + roundLength(now.axes[0] - before.axes[0]) * reach,
                      absolute(by.y) + roundLength(now.axes[1] - before.axes[1]) * reach,
                      absolute(by.z) + roundLength(now.axes[2] - before.axes[2]) * reach};
    const Real way = least(roundLength(most), longest) * near.size * Real(1.0 / CORE_SIZE);
    if (!near.object->warped())
        return way;
    // A share of the width, and degrees.
    const auto change = [&](int part) { return absolute(now.warp.part[part] - before.warp.part[part]); };
    return way + (change(WARP_TAPER) + (change(WARP_TWIST) + change(WARP_BEND)) * Real(0.0174533)) * near.object->reach();
}

}  // namespace

Real roundLength(const Vector& v)
{
    const Real x = absolute(v.x), y = absolute(v.y), z = absolute(v.z), greatest = most(most(x, y), z);
    return greatest + (x + y + z - greatest) * Real(0.375);
}

Stand standOf(const SoftObject& object, const Neighbour& near)
{
    Stand stand;
    stand.size = near.size;
    stand.inRange = object.inRange(*near.object);
    stand.place = near.centre;
    if (near.kind == Neighbour::POINT)
        return stand;
    const bool shaped = near.object->shaped();
    const Real unit = shaped ? Real(1) : near.size * Real(1.0 / CORE_SIZE);
    if (shaped)
        stand.place = near.offset;
    for (int i = 0; i < 3; ++i)
        stand.axes[i] = near.toCore[i] * unit;
    stand.warp = near.object->warp().amounts();
    return stand;
}

Real cameWithin(const Neighbour& near, const Stand& now, const Stand& before, Real reach)
{
    return near.object->shaped() ? cameAsMapped(near, now, before, reach) : cameAsCore(near, now, before);
}
