// Gather, the first pass of a frame: the viewer, the light, and the neighbours whose fields may reach an object's seeds, all
// brought into the object's own space. Seeds never turn; the world turns round them.
#ifndef FB_GATHER_H
#define FB_GATHER_H

#include "fields.h"
#include "model/body.h"
#include "model/softobj.h"

// The number of object slots (model/body.h); all other objects may be neighbours of one.
constexpr int SLOTS_MAX = Bodies::LINK_WORDS * 32;
constexpr int NEIGHBOURS_MAX = SLOTS_MAX - 1;

// Neighbours are gathered when they are this many units out of range, so that what comes into range can be told from what leaps
// into it (odometer.h).
constexpr Real GATHER_SLACK(1);

// No field of strength 1 changes by more than this over a length of one size.
constexpr Real STEEPEST_OF_ALL(1.6);

// See Neighbourhood::steep. FAR_SIZES is a squared proportion; STEEP is that times the neighbour's size, units. THIN_TIP: a
// tapering neighbour is taken to be so many times as steep as its size says.
constexpr Real FAR_SIZES(16), STEEP(1024), THIN_TIP(16);

// Which object's seeds show a place on the surface is decided by claims. An object's claim is its field; but where a small object
// blends with a large one, the field of the large one counts less. Its paths only graze the surface around the small object, which
// the paths of the small one meet squarely. So it is between objects of like sizes if their link is heavy: each side of the bulge
// between them is nearer to one of them, and is met squarely by the paths of the other. The colour does not follow claims: it is
// that of the strongest field.
// A small object shows more if the large one is more than GUEST_SIZES times as large, and the large one shows less if it is more
// than HOST_SIZES times as large; in between both show the same surface. A link heavier than 1 counts like a larger proportion: by
// the square of its weight, up to CLAIM_WEIGHT_MOST. A weak object counts as a larger one, by its strength: its seeds rest deep
// inside, and see little of what blends with it.
constexpr Real GUEST_SIZES(3), HOST_SIZES(4), CLAIM_WEIGHT_MOST(6);

// Distances from the cores of neighbours are less than this wrong, 1/16 unit.
constexpr int32_t ROUNDED16 = 8;

// A neighbour in the own space of the object that is being updated, and its field along the current path. Lengths are in units
// of own space. In core space a neighbour is turned to its own axes and scaled to the size CORE_SIZE.
struct Neighbour : Along {
    const SoftObject* object;
    int slot;              // SoftObject::slot()
    const Real* weights;   // of the object's links, by slot
    Vector centre;
    Real size;          // distance from its core at which its field ends
    Real inverse16;     // CORE_SIZE / size
    Real stretch16;     // the greatest length in core space of one unit of own space: inverse16, or more if it is shaped
    Real steepStretch16;  // the same, only where its field is steep
    Real greatestWeight;  // the greatest weight by which it digs into any object; 1 if it is a member of the body
    Real ratio;         // (own size / size)^2, the factor of its share of the gradient
    Real strength;      // factor of its field
    bool ordinary;      // it is a member of the body, its strength is 1, and no hollow is sampled in it
    bool digs;          // it is no member of the body, but digs into a member
    bool samples;       // its seeds sample a hollow of the head
    bool inRange;       // its field may reach the object's seeds now; else it may do so GATHER_SLACK nearer
    bool segment;       // its core is a segment, half16 long to each side of the centre, whether or not the object tapers
    Real weight;        // weight by which it digs into the head, 0 if it does not
    Real claim, ownClaim;  // factors, 1 or less, of its field and of the own field where the claims of the two are compared
    Real grain;         // length over which its field changes as much as a plain field does over its size
    int32_t x16, y16, z16, size16;  // centre and size, 1/16 unit
    int32_t outer16;    // its field reaches no place that is farther from its centre, 1/16 unit; size16 if it is a POINT
    int32_t half16, axis[3];        // half length of the segment, 1/16 unit, and its direction, 1.0 = 2^14
    Vector direction;   // the segment's, unit length
    // Of a neighbour that is no POINT:
    Vector toCore[3];   // the rows of the matrix from own space to core space
    Vector offset;      // the object's own centre in core space
    // Along the current path:
    int root;           // index of the root that `toRoot` belongs to, -1 at first
    Vector toRoot;      // from the centre to the root; of an OTHER, the root in core space
    Vector step;        // of an OTHER: the path in core space
    Vector halfGradient;  // of an OTHER: half the gradient of t there, times CORE_SIZE^2
    Real share;         // by how much the body's field changes with its field, dF/df, where that is known (Path::shared_)

    // Takes up a path; evaluates t at a position of the path, or at position 1. All set their fields of Along; the field's value is
    // not computed, and only an OTHER's derivative of t is.
    void aim(const Vector& path);
    Real param(Real p) { return kind == OTHER ? otherParam(p) : nearParam(p); }
    Real restParam() { return kind == OTHER ? otherParam(Real(1)) : nearRestParam(); }
    Real otherParam(Real p);

    // Whether the object with this slot, whose seeds sample a hollow, digs into the neighbour.
    bool isDugBy(int digger) const { return weights[digger] < Real(0) && !digs; }

    // An upper bound of the change of its field over a unit, as that counts in the field of a body whose members are all linked.
    Real steepestGradient() const
    {
        return shiftDown(steepStretch16 * strength * greatestWeight * STEEPEST_OF_ALL, 4);
    }

    // Turns a vector of own space into core space; and half a gradient times CORE_SIZE^2 (see SoftObject::param()) into own
    // space, where its factor is size^2 instead.
    Vector inCore(const Vector& v) const { return {dot(toCore[0], v), dot(toCore[1], v), dot(toCore[2], v)}; }
    Vector fromCoreSpace(const Vector& v) const
    {
        // The gradient of a warped object may be so long that it has to be scaled first.
        const Real scale = size * size * Real(1.0 / (CORE_SIZE * CORE_SIZE));
        return toCore[0] * (v.x * scale) + toCore[1] * (v.y * scale) + toCore[2] * (v.z * scale);
    }
    // Returns the vector, 1/16 unit, from its core to a place of own space, units; not to be called of a POINT. Of a shaped
    // neighbour the vector may be too short, never too long.
    Vector fromCore16(const Vector& q) const;
};

inline void Neighbour::aim(const Vector& path)
{
    if (kind == OTHER)
        step = inCore(path);
    else
        aimNear(path);
}

// All neighbours of an object, and what holds for them together.
struct Neighbourhood {
    int count;
    const SoftObject* head;  // the object itself, or, if its seeds sample a hollow, the object that has the hollow
    bool hollow;        // the object's seeds sample a hollow
    Real weight;        // in that case, the weight by which the object digs into the head
    bool inner;         // some members of the body dig into other members
    bool ordinary;      // nothing digs, all strengths are 1, and the object is not shaped
    bool steep;         // the gradient of some neighbour's field, times the squared own size, may leave 16.16: the squared
                        // proportion of the own size to the neighbour's exceeds FAR_SIZES, or its weight, strength or shape
                        // make it as steep
    bool restsAtOne;    // the surface lies at position 1 where no neighbour reaches
    bool dented;        // some neighbours dig
    uint32_t samplers;  // differs where others of these sample a hollow of the head
    bool claims;        // some claims differ from the fields, or several objects may have the hollow
    bool deep;          // paths are searched from near their roots on
    Real last;          // the position up to which paths are searched: little before the own field ends
    Neighbour neighbours[NEIGHBOURS_MAX];
    Neighbour* bySlot[SLOTS_MAX];  // null where that object is no neighbour
};

// The viewer and the light in an object's own space, whose origin is the object's centre.
struct OwnFrame {
    Vector eye;                   // units of the world
    int32_t eye32[3];             // 1/32 unit of own space
    int32_t distance32;           // from the centre to the eye, 1/32 unit of own space
    int32_t limb;                 // a seed is not drawn unless the cosine of its normal and the viewer exceeds this, 1.0 = 2^14
    int32_t eye16[3], distance16;  // eye32 and distance32 in 1/16 unit
    int32_t limb16;               // limb times distance16
    int32_t light[3];             // unit vector towards the light, 1.0 = 2^14
    int32_t right[3], up[3], ahead[3];  // axes of the view, 1.0 = 2^14
    Real growth;                  // length in the world of one unit of own space
    // The planes at the sides of the view that cut through the object: the unit normal that points into the view (1.0 = 2^14),
    // and the signed distance of the plane from the centre along it (1/16 unit).
    struct Side {
        int32_t inward[3], begin;
    } sides[4];
    int sideCount;
    bool outOfSight;              // the whole object lies outside one of the planes
    const Hider* hider;           // FrameContext::hider
    int32_t centre[3];            // the object's centre from the eye, axes of the view, 1/256 unit of the world
};

// OwnFrame::limb of balls, and of other objects. On a ball a scale that is seen nearly edge-on adds next to nothing to the
// scales in front of it; on flat parts it may be all there is.
constexpr int32_t LIMB_OF_BALL = 1300, LIMB = 1 << 7;

// Describes the frame as an object sees it. If the object is out of sight only outOfSight is set.
void findOwnFrame(const SoftObject& object, const FrameContext& frame, OwnFrame& own);

// Collects the neighbours that are in range or within GATHER_SLACK of it.
void gather(const SoftObject& object, const FrameContext& frame, Neighbourhood& all);

#endif
