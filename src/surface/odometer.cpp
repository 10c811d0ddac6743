// How far things have come between two frames.
#include "odometer.h"

#include "math/alloc.h"
#include "math/normal.h"
#include "rt.h"

namespace {

// A way as long as any, when it is not known how far things have come.
constexpr Way EVERYWHERE = 1 << 20;

// About the length of a vector, never less than nine tenths of it.
Real about(const Vector& v)
{
    const Real x = absolute(v.x), y = absolute(v.y), z = absolute(v.z), greatest = most(most(x, y), z);
    return greatest + (x + y + z - greatest) * Real(0.375);
}

}  // namespace

Way wayUntil(Real hold, Real push, Real longest)
{
    if (hold <= Real(0))
        return 0;
    return wayOf(hold < push * longest ? hold / push : longest);
}

Odometer::~Odometer()
{
    free(stands_);
}

// `reach`: how far from the own centre seeds may be. No place of a neighbour's field in that ball has come farther.
Way Odometer::wayBetween(const Neighbour& near, const Stand& now, const Stand& before, Real reach)
{
    const Vector by = now.place - before.place;
    if (near.kind == Neighbour::POINT)
        return wayOf(about(by) + absolute(now.size - before.size));
    const Real longest(100);
    const Vector most{absolute(by.x) + about(now.toCore[0] - before.toCore[0]) * reach,
                      absolute(by.y) + about(now.toCore[1] - before.toCore[1]) * reach,
                      absolute(by.z) + about(now.toCore[2] - before.toCore[2]) * reach};
    Real way = least(about(most), longest) * near.size * Real(1.0 / CORE_SIZE);
    if (near.object->warped()) {
        // A share of the width, and degrees.
        const auto change = [&](int part) { return absolute(now.warp.part[part] - before.warp.part[part]); };
        way += (change(WARP_TAPER) + (change(WARP_TWIST) + change(WARP_BEND)) * Real(0.0174533)) * near.object->reach();
    }
    return wayOf(way);
}

bool Odometer::advance(const SoftObject& object, const OwnFrame& own, const Neighbourhood& all, uint32_t linksVersion)
{
    bool holds = !fresh_ && linksVersion == linksVersion_;
    linksVersion_ = linksVersion;
    if (all.count > room_) {
        free(stands_);
        room_ = all.count + 4;
        stands_ = allocate<Stand>(static_cast<uint32_t>(room_));
        holds = false;
        if (stands_ == nullptr) {
            room_ = 0;
            fresh_ = true;
            came_ = EVERYWHERE;
            return false;
        }
    }
    fresh_ = false;
    // A quarter of the size is about how far a neighbour has to come to turn the surface as the viewer's way does.
    const Real eyeAway = most(nearLength(own.eye), Real(1));
    const Real turned = least(about(own.eye - eye_), eyeAway) / eyeAway;
    eye_ = own.eye;
    const Way eyeWay = wayOf(turned * shiftDown(object.laidSize(), 2));

    const Real reach = object.reach();
    Stand stands[NEIGHBOURS_MAX];
    int8_t standBySlot[SLOTS_MAX];
    memset(standBySlot, -1, sizeof standBySlot);
    Way farthest = 0;
    came_ = 0;
    for (int i = 0; i < all.count; ++i) {
        const Neighbour& near = all.neighbours[i];
        const int slot = near.object->slot(), before = standBySlot_[slot];
        standBySlot[slot] = static_cast<int8_t>(i);
        stands[i] = {near.kind == Neighbour::POINT ? near.centre : near.offset,
                     {near.toCore[0], near.toCore[1], near.toCore[2]},
                     near.size,
                     near.object->warp().amounts()};
        if (!holds)
            continue;
        if (before < 0) {
            // It was out of range by GATHER_SLACK.
            holds = !object.inRange(*near.object);
            continue;
        }
        const Way way = wayBetween(near, stands[i], stands_[before], reach);
        farthest = way > farthest ? way : farthest;
        const Way atCentre = wayBetween(near, stands[i], stands_[before], Real(0));
        // What turns comes farther than that elsewhere.
        came_ = atCentre > came_ ? atCentre : came_;
        came_ = way / 2 > came_ ? way / 2 : came_;
    }
    if (all.count > 0)
        memcpy(stands_, stands, static_cast<size_t>(all.count) * sizeof stands[0]);
    memcpy(standBySlot_, standBySlot, sizeof standBySlot);
    if (!holds)
        came_ = EVERYWHERE;
    bound_ += farthest;
    reading_ += came_ + eyeWay;
    return holds;
}
