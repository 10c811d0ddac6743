// Nearby: which neighbours the paths of a patch may meet, so that a seed asks no others; and whether all of these are linked
// with each other, so that their fields need only be added up.
#ifndef FB_NEARBY_H
#define FB_NEARBY_H

#include "patch.h"

// The neighbours to look at, and whether they and the object are all linked with each other at weight 1, and what digs does it with
// one weight into all of them: then the sum of the fields, less what digs, is F.
struct NeighbourList {
    int count;
    bool complete;
    Neighbour* near[NEIGHBOURS_MAX];

    void add(Neighbour& neighbour) { near[count++] = &neighbour; }
};

// Those of one object in a frame, for one patch after the other.
class Nearby {
public:
    Nearby(const SoftObject& object, Neighbourhood& all, const Bodies& bodies);

    // Takes up a patch. False: no neighbour reaches its seeds where they are.
    bool setPatch(const Patch& patch, bool oversampled);

    // Those that may reach some place on the paths of the patch; those that reach its seeds where they are; and those that may
    // reach a position.
    const NeighbourList& listed() { return listed_.count < 0 ? findListed() : listed_; }
    const NeighbourList& at(Real position) { return isBeyond(position) ? listed() : near_; }
    // Whether a position is not one where the seeds of the patch are, so that others may reach it.
    bool isBeyond(Real position) const { return position < nearest_ || position > farthest_; }

    const NeighbourList& reaching() const { return near_; }

    // The size of the smallest of them, or of the object.
    Real smallest() const { return smallest_; }
    // Whether something digs where the paths are, or the seeds sample a hollow.
    bool dented() const { return dented_; }

    void setComplete(NeighbourList& list) const
    {
        list.complete = allComplete_;
        if (!list.complete)
            findComplete(list);
    }
    // The weight of the object's link with another; 0: there is none.
    Real weight(int slot) const { return ownWeights_[slot]; }

private:
    void findComplete(NeighbourList& list) const;
    bool isComplete(const NeighbourList& list) const;
    bool areAllOne(const NeighbourList& list) const;
    bool areLinked(const NeighbourList& list) const;
    bool digAlike(const NeighbourList& list, const Neighbour& digging) const;
    SELDOM void setOdd(const Patch& patch);
    const NeighbourList& findListed();

    const SoftObject& object_;
    Neighbourhood& all_;
    const Bodies& bodies_;
    const Real* const ownWeights_;  // of the object's links, by slots
    bool allComplete_;  // all neighbours of the object, whatever patch they reach, and it are linked at weight 1

    // Of the patch.
    const Patch* patch_;
    NeighbourList near_, listed_;  // listed_.count -1: not needed yet
    Real smallest_;
    bool dented_;
    Real nearest_, farthest_;  // between which positions its seeds are, and a little more
};

#endif
