// Measures how far the neighbours of an object and the viewer travel between two frames.
#include "odometer.h"

#include "math/alloc.h"
#include "math/normal.h"
#include "rt.h"

namespace {

// A travel longer than any that is waited for, when it is not known how far things have travelled.
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
    leapt_ = fresh_ || linksVersion != linksVersion_ || all.ordinary != ordinary_ || all.head != head_ ||
             all.samplers != samplers_ || all.count > room_;
    head_ = all.head;
    samplers_ = all.samplers;
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
    forgetFar(all);
    const Travel eyeTravel = travelOfEye(object, own);
    eyeStayed_ = eyeTravel == 0;
    const Real reach = object.reach();
    Travel longest = 0;
    const Neighbour* near = all.neighbours;
    Known* known = known_;
    for (int i = 0, count = all.count; i < count; ++i, ++near, ++known) {
        if (i == count_ || known->slot != near->slot) {
            insert(*near, i);
            continue;
        }
        known->inRange = near->inRange;
        known->travelled = travelOf(known->pose.follow(*near, reach));
        longest = known->travelled > longest ? known->travelled : longest;
    }
    if (!leapt_)
        lastTravel_ = longest;
    reading_ += lastTravel_ + eyeTravel;
}

// Forgets the neighbours that are not gathered any more. One that was in range has leapt out of it.
inline void Odometer::forgetFar(const Neighbourhood& all)
{
    const Known *from = known_, *const end = known_ + count_;
    // Most often all of them are.
    while (from < end && all.bySlot[from->slot] != nullptr)
        ++from;
    Known* to = known_ + (from - known_);
    for (; from < end; ++from) {
        if (all.bySlot[from->slot] != nullptr)
            *to++ = *from;
        else
            leapt_ |= from->inRange;
    }
    count_ = static_cast<int>(to - known_);
}

// Takes in a neighbour that was not gathered in the last call: it has come within GATHER_SLACK of the range, or, if it is in range
// already, it has leapt. It gets the place that it has among the neighbours, whose order stays the same as long as links do.
void Odometer::insert(const Neighbour& near, int number)
{
    Known& known = known_[number];
    memmove(&known + 1, &known, static_cast<size_t>(count_ - number) * sizeof known);
    ++count_;
    known.slot = static_cast<uint8_t>(near.slot);
    known.inRange = near.inRange;
    known.travelled = 0;
    known.pose.take(near);
    leapt_ |= near.inRange;
}

bool Odometer::addTravel(Patch& patch, const Neighbourhood& all) const
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
