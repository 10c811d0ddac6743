// How far things have come between two frames.
#include "odometer.h"

#include "math/alloc.h"
#include "math/normal.h"
#include "rt.h"

namespace {

// A way as long as any, when it is not known how far things have come.
constexpr Travel EVERYWHERE = 1 << 20;

// As many steps of what goes round as never make it seem to go back: by them all is due.
constexpr uint16_t ALL_DUE = 1 << 14;

}  // namespace

Travel travelUntil(Real hold, Real push, Real longest)
{
    if (hold <= Real(0))
        return 0;
    return travelOf(hold < push * longest ? hold / push : longest);
}

Odometer::~Odometer()
{
    free(known_);
}

// Room for so many neighbours. What was known of them is lost. False: no memory.
bool Odometer::makeRoom(int count)
{
    free(known_);
    count_ = 0;
    known_ = allocate<Known>(static_cast<uint32_t>(count + 4));
    room_ = known_ == nullptr ? 0 : count + 4;
    return known_ != nullptr;
}

// How far the viewer has come. A quarter of the size is about how far a neighbour has to come to turn the surface as the viewer's
// way does.
inline Travel Odometer::travelOfEye(const SoftObject& object, const OwnFrame& own)
{
    const Real away = max(nearLength(own.eye), Real(1));
    const Real turned = min(roundLength(own.eye - eye_), away) / away;
    eye_ = own.eye;
    return travelOf(turned * shiftDown(object.laidSize(), 2));
}

bool Odometer::advance(const SoftObject& object, const OwnFrame& own, const Neighbourhood& all, uint32_t linksVersion)
{
    leapt_ = fresh_ || linksVersion != linksVersion_ || all.ordinary != ordinary_ || all.count > room_;
    linksVersion_ = linksVersion;
    ordinary_ = all.ordinary;
    fresh_ = all.count > room_ && !makeRoom(all.count);
    lastTravel_ = EVERYWHERE;
    if (fresh_)
        return false;
    if (leapt_)
        count_ = 0;
    const Travel eyeTravel = travelOfEye(object, own);
    eyeStayed_ = eyeTravel == 0;
    const Real reach = object.reach();
    Travel farthest = 0, longest = 0;
    for (int i = 0; i < all.count; ++i) {
        const Neighbour& near = all.neighbours[i];
        Known& known = known_[i];
        if ((i >= count_ || known.slot != near.object->slot()) && !isKnown(all, i))
            continue;
        known.inRange = near.inRange;
        // What is shaped comes farther in some places than in most.
        const Travelled units = known.pose.follow(near, reach);
        const Travel outermost = travelOf(units.farthest), middle = travelOf(units.middle);
        const Travel travelled = outermost / 2 > middle ? outermost / 2 : middle;
        farthest = outermost > farthest ? outermost : farthest;
        longest = travelled > longest ? travelled : longest;
        known.travelled = static_cast<uint16_t>(travelled < ALL_DUE ? travelled : ALL_DUE);
    }
    if (count_ > all.count)
        forgetFar(all);
    if (!leapt_)
        lastTravel_ = longest;
    bound_ += farthest;
    reading_ += lastTravel_ + eyeTravel;
    return !leapt_;
}

// Whether a neighbour was gathered in the last call, too; if not, it is from now on. It was out of range by GATHER_SLACK then, or
// has leapt.
bool Odometer::isKnown(const Neighbourhood& all, int number)
{
    const Neighbour& near = all.neighbours[number];
    Known& known = known_[number];
    if (count_ == room_ || (number < count_ && all.bySlot[known.slot] == nullptr))
        forgetFar(all);
    const uint8_t slot = static_cast<uint8_t>(near.object->slot());
    if (number < count_ && known.slot == slot)
        return true;
    // The others move up.
    count_ = count_ < room_ ? count_ + 1 : room_;
    memmove(&known + 1, &known, static_cast<size_t>(count_ - 1 - number) * sizeof known);
    known.slot = slot;
    known.inRange = near.inRange;
    known.travelled = 0;
    known.pose.take(near);
    leapt_ |= near.inRange;
    return false;
}

// Forgets those that are not even near any more. One that was in range has leapt.
void Odometer::forgetFar(const Neighbourhood& all)
{
    Known* to = known_;
    for (const Known *from = known_, *const end = known_ + count_; from < end; ++from)
        if (all.bySlot[from->slot] != nullptr)
            *to++ = *from;
        else
            leapt_ |= from->inRange;
    count_ = static_cast<int>(to - known_);
}

bool Odometer::count(Patch& patch) const
{
    uint16_t way = leapt_ ? ALL_DUE : 0;
    for (const Known *known = known_, *const end = known_ + count_; known < end; ++known)
        if (known->travelled > way && isListed(patch.listed, known->slot))
            way = known->travelled;
    patch.travelled = static_cast<uint16_t>(patch.travelled + way);
    return way > 0;
}

bool Odometer::hasMoved(const Neighbourhood& all, const NeighbourList& list) const
{
    bool moved = leapt_;
    for (int i = 0; i < list.count && !moved; ++i)
        moved = known_[list.near[i] - all.neighbours].travelled > 0;
    return moved;
}
