// Nearby: the neighbours that the paths of a patch may meet, so that its seeds evaluate no other fields; and whether all of them
// are linked with each other, so that the field of the body is the sum of theirs.
#ifndef FB_NEARBY_H
#define FB_NEARBY_H

#include "patch.h"

// Some neighbours of an object. The list is `complete` if they and the object are all linked with each other at weight 1, and every
// digging one digs with one weight into all the others. Then the body's field F is the sum of their fields, less those that dig.
struct NeighbourList {
    int count;
    bool complete;
    Neighbour* near[NEIGHBOURS_MAX];

    void add(Neighbour& neighbour)
    {
        near[count] = &neighbour;
        ++count;
    }
};

// Made once for an object and a frame; asked about one patch after another.
class Nearby {
public:
    Nearby(const SoftObject& object, Neighbourhood& all, const Bodies& bodies);

    // Chooses the patch. Returns false if no neighbour reaches its seeds where they are.
    bool setPatch(const Patch& patch, bool oversampled);

    // The neighbours that may reach some place on the paths of the patch; and those that may reach them at one position.
    const NeighbourList& listed() { return listed_.count < 0 ? findListed() : listed_; }
    const NeighbourList& at(Real position) { return isBeyond(position) ? listed() : near_; }
    // Whether a position is outside the range that the patch's seeds are in, so that other neighbours may reach it.
    bool isBeyond(Real position) const { return position < nearest_ || position > farthest_; }

    // The neighbours that reach the seeds where they are.
    const NeighbourList& reaching() const { return near_; }

    // The smallest grain (gather.h) of these neighbours and the object.
    Real smallest() const { return smallest_; }
    // Whether something digs near the paths, or the seeds sample a hollow.
    bool dented() const { return dented_; }

    void setComplete(NeighbourList& list) const
    {
        list.complete = allComplete_;
        if (!list.complete)
            findComplete(list);
    }
    // The weight of the object's link with another; 0 if there is none.
    Real weight(int slot) const { return ownWeights_[slot]; }

private:
    void findComplete(NeighbourList& list) const;
    bool isComplete(const NeighbourList& list) const;
    bool areAllOne(const NeighbourList& list) const;
    bool areLinked(const NeighbourList& list) const;
    bool digAlike(const NeighbourList& list, const Neighbour& digging) const;
    SELDOM void setOdd();
    const NeighbourList& findListed();

    const SoftObject& object_;
    Neighbourhood& all_;
    const Bodies& bodies_;
    const Real* const ownWeights_;  // weights of the object's links, by slot
    const bool allComplete_;  // all objects of the body are linked at weight 1, so that every list is complete

    // Of the current patch:
    const Patch* patch_;
    NeighbourList near_, listed_;  // reaching() and listed(); listed_.count is -1 until it is asked for
    Real smallest_;
    bool dented_;
    Real nearest_, farthest_;  // the range of its seeds' positions, with a margin
};

#endif
