// Whether one neighbour alone keeps seeds off the surface. From position 1, before which no path can leave the surface, to
// COVERED_AT the two fields together are above the isovalue, for the neighbour's t is convex and lies below the straight line
// between those it has there; and beyond the neighbour is the stronger of the two.
#include "cover.h"

#include "search.h"

// At position COVERED_AT the own field is .23. A neighbour whose t is less than `there` at it is stronger by more than the
// overshoot tolerance; and if its t is less than `atRest` at position 1, then between the two the body's field is above the
// isovalue. What is not linked with the object must have that field alone.
constexpr Cover::Limits Cover::LINKED{Real(0.414), Real(0.69), Real(0.643), Real(0.83)};
constexpr Cover::Limits Cover::UNLINKED{Real(0.18), Real(0.18), Real(0.424), Real(0.424)};

// Of the field: what is linked with the object and this strong is the one that keeps its seeds off the surface.
static constexpr Real COVERING(0.28);

// Takes up a neighbour.
void Cover::find(int blocker)
{
    blocker_ = blocker;
    number_ = all_.numberOf[blocker];
    // The t of what is warped need not be convex.
    const bool judged = number_ >= 0 && all_.common && !all_.neighbours[number_].object->warped();
    limits_ = !judged ? nullptr : nearby_.allComplete() || nearby_.isLinked(blocker) ? &LINKED : &UNLINKED;
}

bool Cover::hidesPath(const Seed& s)
{
    Along along;
    path_.aim(number_, s, along);
    return along.param(COVERED_AT) < limits_->there && along.param(Real(1)) < limits_->atRest;
}

bool Cover::hidesAll(const Patch& patch)
{
    take(patch.blocker);
    if (limits_ == nullptr || object_.tapers())
        return false;
    const Neighbour& near = all_.neighbours[number_];
    return !near.object->slants() && isWithin(patch, near, COVERED_AT, limits_->rootThere) &&
           isWithin(patch, near, Real(1), limits_->rootAtRest);
}

int Cover::strongest() const
{
    int slot = object_.slot();
    Real most(-1);
    for (int i = 0; i < path_.touched(); ++i) {
        const Along& along = path_.along(i);
        const int candidate = along.near->object->slot();
        const Real value = along.value > COVERING && nearby_.isLinked(candidate) ? along.value + Real(1) : along.value;
        if (value > most && !along.near->digs) {
            most = value;
            slot = candidate;
        }
    }
    return slot;
}
