// How far things have come between two frames.
#include "odometer.h"

#include "math/alloc.h"
#include "math/normal.h"
#include "rt.h"

namespace {

// A way as long as any, when it is not known how far things have come.
constexpr Way EVERYWHERE = 1 << 20;

// As many steps of what goes round as never make it seem to go back: by them all is due.
constexpr uint16_t ALL_DUE = 1 << 14;

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

// Room for the stands of so many neighbours. What stood there is lost. False: no memory.
bool Odometer::makeRoom(int count)
{
    free(stands_);
    stands_ = allocate<Stand>(static_cast<uint32_t>(count + 4));
    room_ = stands_ == nullptr ? 0 : count + 4;
    return stands_ != nullptr;
}

// How far the viewer has come. A quarter of the size is about how far a neighbour has to come to turn the surface as the viewer's
// way does.
inline Way Odometer::wayOfEye(const SoftObject& object, const OwnFrame& own)
{
    const Real away = most(nearLength(own.eye), Real(1));
    const Real turned = least(roundLength(own.eye - eye_), away) / away;
    eye_ = own.eye;
    return wayOf(turned * shiftDown(object.laidSize(), 2));
}

bool Odometer::advance(const SoftObject& object, const OwnFrame& own, const Neighbourhood& all, uint32_t linksVersion)
{
    bool holds = !fresh_ && linksVersion == linksVersion_ && all.common == common_ && all.count <= room_;
    linksVersion_ = linksVersion;
    common_ = all.common;
    fresh_ = all.count > room_ && !makeRoom(all.count);
    if (fresh_) {
        leapt_ = true;
        came_ = EVERYWHERE;
        return false;
    }
    const Way eyeWay = wayOfEye(object, own);
    eyeStayed_ = eyeWay == 0;
    const Real reach = object.reach();
    Stand stands[NEIGHBOURS_MAX];
    int8_t standBySlot[SLOTS_MAX];
    memset(standBySlot, -1, sizeof standBySlot);
    Way farthest = 0;
    came_ = 0;
    movedCount_ = 0;
    int stayed = 0, within = 0;
    for (int i = 0; i < all.count; ++i) {
        const Neighbour& near = all.neighbours[i];
        const int slot = near.object->slot(), before = standBySlot_[slot];
        standBySlot[slot] = static_cast<int8_t>(i);
        stands[i] = standOf(object, near);
        within += stands[i].inRange;
        if (!holds)
            continue;
        if (before < 0) {
            // It was out of range by GATHER_SLACK.
            holds = !stands[i].inRange;
            continue;
        }
        stayed += stands_[before].inRange;
        const Way way = wayOf(cameWithin(near, stands[i], stands_[before], reach));
        farthest = way > farthest ? way : farthest;
        // What is shaped comes farther in some places than in most.
        Way came = near.object->shaped() ? wayOf(cameWithin(near, stands[i], stands_[before], Real(0))) : way;
        came = way / 2 > came ? way / 2 : came;
        came_ = came > came_ ? came : came_;
        if (came > 0)
            moved_[movedCount_++] = {static_cast<uint8_t>(slot), static_cast<uint16_t>(came < ALL_DUE ? came : ALL_DUE)};
    }
    if (all.count > 0)
        memcpy(stands_, stands, static_cast<size_t>(all.count) * sizeof stands[0]);
    memcpy(standBySlot_, standBySlot, sizeof standBySlot);
    // One that was in range and is not even near any more has leapt.
    holds = holds && stayed == within_;
    within_ = within;
    leapt_ = !holds;
    if (!holds)
        came_ = EVERYWHERE;
    bound_ += farthest;
    reading_ += came_ + eyeWay;
    return holds;
}

bool Odometer::count(Patch& patch) const
{
    uint16_t way = leapt_ ? ALL_DUE : 0;
    for (const Moved *moved = moved_, *const end = moved_ + movedCount_; moved < end; ++moved)
        if (isListed(patch.listed, moved->slot))
            way = moved->way > way ? moved->way : way;
    patch.came = static_cast<uint16_t>(patch.came + way);
    return way > 0;
}

bool Odometer::hasMoved(const Neighbourhood& all, const Few& few) const
{
    bool moved = leapt_;
    for (int i = 0; i < few.count; ++i)
        for (int j = 0; j < movedCount_ && !moved; ++j)
            moved = moved_[j].slot == all.neighbours[few.number[i]].object->slot();
    return moved;
}
