// Whether one neighbour alone keeps seeds inside the body. The two fields are judged as if they were alone: then no path leaves the
// surface before position 1. From there to COVERED_AT they exceed the isovalue together, because the neighbour's t is nearly always
// convex along the path, so that it lies below the straight line between its values at the two positions. Beyond COVERED_AT the
// neighbour is the stronger of the two. Objects that are not linked with each other, and a torus, may make an exception.
#include "cover.h"

#include "search.h"

// At position COVERED_AT the own field is .23. A neighbour whose t is less than `there` exceeds that by more than the overshoot
// tolerance; and if its t is less than `atRest` at position 1, the body's field is above the isovalue between the two positions.
// The smaller the weight of its link, the stronger the neighbour must be.
constexpr Cover::Limits Cover::LIMITS[] = {
    {Real(1), Real(0.414), Real(0.69), Real(0.643), Real(0.83)},
    {Real(0.75), Real(0.35), Real(0.6), Real(0.591), Real(0.774)},
    {Real(0.5), Real(0.28), Real(0.49), Real(0.529), Real(0.7)},
    {Real(0.25), Real(0.24), Real(0.34), Real(0.489), Real(0.583)},
    {Real(0), Real(0.2), Real(0.22), Real(0.447), Real(0.469)},
};

// Chooses a blocker.
void Cover::find(int blocker)
{
    blocker_ = blocker;
    near_ = all_.bySlot[blocker];
    // The t of a warped neighbour need not be convex. Where a neighbour's claim is weaker than its field, paths may show guests.
    const bool judged = near_ != nullptr && all_.ordinary && !near_->object->warped() && near_->claim == Real(1);
    limits_ = nullptr;
    if (!judged)
        return;
    limits_ = LIMITS;
    while (nearby_.weight(blocker) < limits_->weight)
        ++limits_;
}

bool Cover::coversPath(const Seed& s)
{
    path_.aim(*near_, s);
    const Real there = near_->param(COVERED_AT);
    if (there >= limits_->there)
        return false;
    const Real atRest = near_->restParam();
    return atRest < limits_->atRest && (there <= atRest || !isHeavy());
}

int32_t Cover::coversAll(const Patch& patch)
{
    take(patch.blocker);
    if (limits_ == nullptr || object_.tapers() || isHeavy())
        return 0;
    const int32_t there = near_->object->slants() ? 0 : depthWithin(patch, *near_, COVERED_AT, limits_->rootThere);
    const int32_t atRest = there <= 0 ? 0 : depthWithin(patch, *near_, Real(1), limits_->rootAtRest);
    return there < atRest ? there : atRest;
}
