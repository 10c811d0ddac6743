// Measures how far the neighbours of an object and the viewer travel between two frames.
#include "odometer.h"

#include "math/alloc.h"
#include "math/normal.h"
#include "rt.h"

namespace {

// A travel longer than any that is waited for, when it is not known how far things have travelled. It is long even in the 16 bits
// of a reading that a seed stores.
constexpr Travel EVERYWHERE = 3 << 19;

// The largest travel that may be added to a 16-bit count that wraps around without its seeming to run backwards. It makes
// everything due.
constexpr Travel ALL_DUE = 1 << 14;

}  // namespace

Travel travelUntil(Real margin, Real gradientBound, Real longest)
{
    if (margin <= Real(0))
        return 0;
    return travelOf(margin < gradientBound * longest ? margin / gradientBound : longest);
}

Odometer::~Odometer()
{
    free(known_);
}

// Makes room for `count` neighbours and forgets those that were known. Returns false when there is no memory.
bool Odometer::makeRoom(int count)
{
    free(known_);
    count_ = 0;
    known_ = allocate<Known>(static_cast<uint32_t>(count + 4));
    room_ = known_ == nullptr ? 0 : count + 4;
    return known_ != nullptr;
}

// The viewer's travel round the object, turned into one of neighbours: when the viewer turns by an angle, a neighbour would have to
// travel about that angle times a quarter of the object's size to turn the surface as much.
inline Travel Odometer::travelOfEye(const SoftObject& object, const OwnFrame& own)
{
    const Real away = max(nearLength(own.eye), Real(1));
    const Real turned = min(roundLength(own.eye - eye_), away) / away;
    eye_ = own.eye;
    return travelOf(turned * shiftDown(object.laidSize(), 2));
}

void Odometer::advance(const SoftObject& object, const OwnFrame& own, const Neighbourhood& all, uint32_t linksVersion)
{
    leapt_ = fresh_ || linksVersion != linksVersion_ || all.ordinary != ordinary_ || all.count > room_;
    linksVersion_ = linksVersion;
    ordinary_ = all.ordinary;
    fresh_ = all.count > room_ && !makeRoom(all.count);
    lastTravel_ = EVERYWHERE;
    if (fresh_) {
        reading_ += lastTravel_;
        return;
    }
    if (leapt_)
        count_ = 0;
    const Travel eyeTravel = travelOfEye(object, own);
    eyeStayed_ = eyeTravel == 0;
    const Real reach = object.reach();
    Travel longest = 0;
    const Neighbour* near = all.neighbours;
    Known* known = known_;
    for (int i = 0, count = all.count; i < count; ++i, ++near, ++known) {
        if ((i >= count_ || known->slot != near->slot) && !isKnown(all, i))
            continue;
        known->inRange = near->inRange;
        known->travelled = travelOf(known->pose.follow(*near, reach));
        longest = known->travelled > longest ? known->travelled : longest;
    }
    if (count_ > all.count)
        forgetFar(all);
    if (!leapt_)
        lastTravel_ = longest;
    reading_ += lastTravel_ + eyeTravel;
}

// Whether neighbour `number` was gathered in the last call, too. If not it becomes known now: it has come within GATHER_SLACK of
// the range, or, if it is in range already, it has leapt.
bool Odometer::isKnown(const Neighbourhood& all, int number)
{
    const Neighbour& near = all.neighbours[number];
    Known& known = known_[number];
    if (count_ == room_ || (number < count_ && all.bySlot[known.slot] == nullptr))
        forgetFar(all);
    const uint8_t slot = static_cast<uint8_t>(near.slot);
    if (number < count_ && known.slot == slot)
        return true;
    // The entries behind it move up.
    count_ = count_ < room_ ? count_ + 1 : room_;
    memmove(&known + 1, &known, static_cast<size_t>(count_ - 1 - number) * sizeof known);
    known.slot = slot;
    known.inRange = near.inRange;
    known.travelled = 0;
    known.pose.take(near);
    leapt_ |= near.inRange;
    return false;
}

// Forgets the neighbours that are not gathered any more. One that was in range has leapt out of it.
void Odometer::forgetFar(const Neighbourhood& all)
{
    Known* to = known_;
    for (const Known *from = known_, *const end = known_ + count_; from < end; ++from) {
        if (all.bySlot[from->slot] == nullptr) {
            leapt_ |= from->inRange;
            continue;
        }
        if (to != from)
            *to = *from;
        ++to;
    }
    count_ = static_cast<int>(to - known_);
}

bool Odometer::count(Patch& patch, const Neighbourhood& all) const
{
    Travel travel = leapt_ ? ALL_DUE : 0;
    const Bound paths = boundOfPaths(patch, all);
    for (int i = 0; i < count_; ++i) {
        const Travel travelled = known_[i].travelled < ALL_DUE ? known_[i].travelled : ALL_DUE;
        if (travelled <= travel)
            continue;
        // It may have left the paths in this call; some of its places travel twice as far.
        const int32_t margin = steps16(GATHER_SLACK) + static_cast<int32_t>(travelled >> 5);
        if (reaches(all.neighbours[i], {paths.x, paths.y, paths.z, paths.radius + margin}))
            travel = travelled;
    }
    patch.travelled = static_cast<uint16_t>(patch.travelled + travel);
    return travel > 0;
}
