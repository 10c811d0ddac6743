// Gather: what one object sees in a frame, in its own axes: the viewer, the light, and the neighbours whose fields may reach
// its seeds. Seeds never turn; the world turns round them.
#ifndef FB_GATHER_H
#define FB_GATHER_H

#include "fields.h"
#include "model/body.h"
#include "model/softobj.h"

// Most neighbours of an object at a time; further ones are left out. And the slots that objects have (model/body.h).
constexpr int NEIGHBOURS_MAX = 127;
constexpr int SLOTS_MAX = 128;

// Neighbours are gathered a little before they come into range, units, so that what holds now holds for a while.
constexpr Real GATHER_SLACK(3);

// Of the field, over the size: no field changes by more.
constexpr Real STEEPEST_OF_ALL(1.6);

// A neighbour in the own space of the object that is being updated, and what is known of its field along the path at hand.
struct Neighbour : Along {
    const SoftObject* object;
    Vector centre;      // units of own space, as all that follows
    Real size;          // where its field ends, from its core
    Real inverse16;     // CORE_SIZE / size
    Real stretch16;       // how long a unit of own space is in its core space at most: inverse16, or more if it is shaped
    Real steepStretch16;       // the same where its field is steep
    Real share;         // the greatest weight of what digs; of a member 1
    Real ratio;         // squared proportion of the own size to `size`: its share of the gradient
    Real strength;      // what its field is multiplied by
    bool plain;         // it is one of the body, its strength is 1, and it is not the head of a hollow
    bool digs;          // it is none of the body, and digs into some of it
    bool samples;       // its seeds sample a hollow in the head
    bool inRange;       // of the object; else within GATHER_SLACK of that
    bool segment;       // its core is a segment to each side of its centre, half16 long; whether or not it tapers
    Real weight;        // by which it digs into the head; 0: not
    Real grain;         // over this length its field changes as a plain one does over its size
    int32_t x16, y16, z16, size16;  // centre and size in 1/16 unit
    int32_t half16, axis[3];        // its direction, 1.0 = 2^14
    Vector direction;   // of the segment, unit length
    Vector toCore[3];   // the rows of the map from own space to its core space; no point
    Vector offset;      // and the own centre there
    // Of what leads along its paths:
    int root;           // index of the root for which it is known; -1: none yet
    Vector toRoot;      // from the centre to the root; neither point nor segment: the root in core space
    Vector step, halfGradient;  // neither point nor segment: the path at hand in core space, and half the gradient of t there, times
                        // CORE_SIZE^2

    // It takes up a path, and is looked at; what stands in Along is set, but F.
    void aim(const Vector& path);
    Real param(Real p) { return kind == OTHER ? otherParam(p) : nearParam(p); }
    Real otherParam(Real p);

    // What its field changes by at most over a unit, as it counts in that of a body whose members are linked.
    Real steepestGradient() const
    {
        return shiftDown(steepStretch16 * strength * share * STEEPEST_OF_ALL, 4);
    }

    // A vector of own space in core space, and half a gradient times CORE_SIZE^2 (see SoftObject::param()) in own space, where
    // it is times size^2.
    Vector inCore(const Vector& v) const { return {dot(toCore[0], v), dot(toCore[1], v), dot(toCore[2], v)}; }
    Vector fromCoreSpace(const Vector& v) const
    {
        const Real scale = size * size * Real(1.0 / (CORE_SIZE * CORE_SIZE));
        return (toCore[0] * v.x + toCore[1] * v.y + toCore[2] * v.z) * scale;
    }
    // The vector from its core to a place of own space, in 1/16 unit; not for a point. If it is shaped, the vector may be shorter.
    Vector fromCore16(const Vector& q) const;
};

inline void Neighbour::aim(const Vector& path)
{
    if (kind == OTHER)
        step = inCore(path);
    else
        aimNear(path);
}

// All neighbours of an object.
struct Neighbourhood {
    int count;
    const SoftObject* head;  // the object itself; if its seeds sample a hollow, the object that has the hollow
    bool hollow;        // its seeds sample a hollow
    Real weight;        // in that case, the weight by which the object digs into the head
    bool inner;         // some objects of the body dig into others of it
    bool ordinary;        // nothing digs, all strengths are 1, and the object is not shaped
    bool simple;        // all is common, and all neighbours are points or segments
    bool restsAtOne;         // the surface lies at position 1 where no neighbour reaches
    bool dented;        // some neighbours dig
    bool deep;          // paths are searched from near their roots
    Real last;          // position where the own field ends
    Neighbour neighbours[NEIGHBOURS_MAX];
    Neighbour* bySlot[SLOTS_MAX];  // null: out of range
};

// The frame as one object sees it: own axes, counted from its centre.
struct OwnFrame {
    Vector eye;                   // units of the world
    int32_t eye32[3];             // the same, 1/32 unit of own space
    int32_t distance32;           // of the eye, 1/32 unit of own space
    int32_t limb;                 // what faces the eye by no more than this cosine is not drawn, 1.0 = 2^14
    int32_t eye16[3], distance16, limb16;  // the same in 1/16 unit; the limb: times the distance
    int32_t light[3];             // unit vector towards the light, 1.0 = 2^14
    int32_t right[3], up[3], ahead[3];  // axes of the view, 1.0 = 2^14
    Real growth;                  // units of the world in a unit of own space
    // What bounds the view, where it cuts through the object: unit vectors inwards (1.0 = 2^14), and how far that way from the
    // centre the view begins (1/16 unit). And whether the object lies beyond one of the bounds.
    struct Side {
        int32_t inward[3], begin;
    } sides[4];
    int sideCount;
    bool outOfSight;
    const Hider* hider;           // FrameContext::hider
    int32_t centre[3];            // of the object from the eye, axes of the view, 1/256 unit of the world
};

// On a ball a scale that is seen nearly edge-on adds next to nothing to those before it; on flat parts it may be all there is.
constexpr int32_t LIMB_OF_BALL = 1300, LIMB = 1 << 7;

// Of an object that is out of sight nothing else is known.
OwnFrame ownFrame(const SoftObject& object, const FrameContext& frame);

// Fills in the neighbours in range, and those that nearly are.
void gather(const SoftObject& object, const FrameContext& frame, Neighbourhood& all);

#endif
