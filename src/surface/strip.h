// Strip: a run of neighbouring seeds of one ring, small enough to be judged as one. Most seeds of a frame need no look of
// their own: their strip rests, lies inside a neighbour or faces away.
#ifndef FB_STRIP_H
#define FB_STRIP_H

#include "gather.h"

// Most seeds of a strip.
constexpr int STRIP_SEEDS = 10;

enum StripState : uint8_t {
    STRIP_NEW,     // not judged since the seeds were laid out
    STRIP_REST,    // no neighbour reaches it
    STRIP_INSIDE,  // a neighbour's surface encloses it
    STRIP_AWAY,    // a neighbour reaches it, and wherever it settles it faces away from the viewer
    STRIP_MIXED,   // its seeds are settled one by one
};

// Lengths in 1/16 unit of own space, directions with 1.0 = 2^14.
struct Strip {
    int32_t first;      // number of its first regular seed
    int16_t middle[3];  // of where its seeds rest
    int16_t radius;     // of a ball round it that holds all of those, and half a cell more
    int16_t axis[3];    // the mean of their normals
    int16_t spread;     // greatest length of the difference of a normal to the axis
    int16_t path;       // mean length of their paths
    uint8_t count;
    StripState state;
};

// The neighbours that may reach a strip.
struct Reached {
    const Neighbour* near[NEIGHBOURS_MAX];
    int count;
};

// How many strips the seeds of an object make.
int stripsOf(const SoftObject& object);

// Fills them in.
void makeStrips(const SoftObject& object, Strip* strips);

// What becomes of a strip in this frame; where it is STRIP_MIXED, `reached` receives the neighbours that matter.
StripState classify(const Strip& strip, const OwnFrame& own, const Neighbour* neighbours, int count, Reached& reached);

// Whether a strip at rest faces away from the viewer.
bool restsAway(const Strip& strip, const OwnFrame& own);

#endif
