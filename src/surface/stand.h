// Where a neighbour stands, and how far it has come between two frames.
#ifndef FB_STAND_H
#define FB_STAND_H

#include "gather.h"

// Its centre and its axes, in the space of an object; of what is shaped, the map into its core space.
struct Stand {
    Vector place;
    Real size;
    Vector axes[3];    // of a point these are not known
    WarpAmounts warp;
    bool inRange;  // of the object
};

Stand standOf(const SoftObject& object, const Neighbour& near);

// Units that no place of its field has come farther than: of what is shaped, none that is at most `reach` from the object's centre.
Real cameWithin(const Neighbour& near, const Stand& now, const Stand& before, Real reach);

// About the length of a vector, never less than nine tenths of it.
Real roundLength(const Vector& v);

#endif
