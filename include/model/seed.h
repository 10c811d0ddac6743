// Seed: a sample of the implicit surface that may move along one fixed path only (report, Section III, Figure 6), and
// what a primitive lays its seeds out with (Appendix C).
#ifndef FB_SEED_H
#define FB_SEED_H

#include "math/vec.h"

// The states of a seed. A method of finding the surface (model/surface.h) sets and clears them; nobody else does.
//
//   state         set                                      cleared
//   SEED_VALID    it settled on the surface, where its     its path leaves the surface in a neighbour's territory, or
//                 own object is the strongest              nowhere
//   SEED_ACTIVE   an oversampled seed takes part           its regular seed and that one's neighbour lie alike again
//   SEED_RESTING  no neighbour reaches it: it is at        a neighbour reaches it
//                 position 1 with the normal of the
//                 unblended surface
//   SEED_BORDER   a neighbour is about as strong there     none is
//   SEED_ASLEEP   its patch lies inside a neighbour,       the patch does not any more
//                 faces away or is hidden: it is not settled
//   SEED_FOLLOW   it is not on the surface, but its path   it settles
//                 is likely to leave the surface near its
//                 position: it wakes up, or another is the
//                 stronger there, or it is on a part of a
//                 hollow's wall that is another's
//   SEED_OFF      something digs near it, and it will not  it settles anew
//                 be on the surface before `due`
//   SEED_FRONT    /P only: its path does not point away    it does
//                 from the viewer
//   SEED_KEPT     /P only: normal and brightness hold for  the seed moved
//                 the present position
enum SeedFlag : uint8_t {
    SEED_VALID = 1,
    SEED_ACTIVE = 2,
    SEED_RESTING = 4,
    SEED_FRONT = 8,
    SEED_OFF = 8,        // the bit of SEED_FRONT, which only /P has
    SEED_KEPT = 16,
    SEED_BORDER = 32,
    SEED_ASLEEP = 64,
    SEED_FOLLOW = 128,
};

// A unit vector in whole numbers: each component is scaled by 2^14.
struct Direction14 {
    int16_t x, y, z;
};

// seed = root + position * path, in the object's own space: centred on the origin, axis-aligned, as large as when the
// seeds were laid out. Seeds never turn; the world turns round them. Lengths in units.
struct Seed {
    Vector path;         // from root to the unblended surface
    Real position;       // along the path; 1.0 on the unblended surface
    int32_t neighbour;   // slot of the seed N of the ring before (Appendix C, Oversampling); -1 in the first ring. Of an
                         // oversampled one: of the seed on its other side
    Direction14 normal;  // of the surface at the seed
    union {
        Direction14 border;  // of a SEED_BORDER one: in which the own field gains most on the strongest neighbour's,
        int16_t place[3];    // of a SEED_RESTING one: where it is, steps of places (SoftObject::placeShift()),
    };
    union {
        int16_t apart;   // and how far the seed is on its own side of where the two are equal, 1/256 unit
        int16_t out;     // and its normal times that
        uint16_t due;    // of a SEED_OFF one: what its patch has counted when it is looked at again
    };
    uint16_t root;       // index of the root point: seeds share them
    uint8_t flags;       // SeedFlag
    uint8_t mix;         // number of the colour there, where colours mix (model/paint.h)
    union {
        uint8_t still;   // 0: it moved when it was looked at last; 1: it did not; 3: nor the time before
        uint8_t blocker; // of one that is not SEED_VALID: slot of the neighbour that was the strongest there
    };
    // The part of the unblended surface that is the seed's own: its half axes, 1/64 of the spacing, and the area between them,
    // that squared; 0, of an oversampled seed: it lies in no band of its ring.
    int8_t along[3], across[3];
    int8_t way[3];       // along the path, 1.0 = 127
    uint16_t area;
    uint8_t spare[14];   // it has 64 bytes: by its number it is found with a shift
};

// Receives the seeds of a primitive, ring by ring, in the object's own space (Appendix C: "canonical" space). It is run
// twice: once to count, once to fill.
class SeedMaker {
public:
    virtual ~SeedMaker() {}

    // Adds a root point and returns its index.
    virtual int addRoot(const Vector& fromCentre) = 0;

    // Starts the next ring: seeds that follow each other around the primitive, beside the ring before.
    virtual void beginRing() = 0;

    // Whether the number of seeds in the ring is all that is asked for: `seeds` of them count as added, above one root or
    // above `various`.
    virtual bool countRing(int /* seeds */, bool /* various */) { return false; }

    // Seeds added from now on rest this far from their roots, units, and not the object's radius: for objects that
    // taper.
    virtual void restAt(Real) {}

    // Adds a seed to the ring: it rests `radius` away from its root along `direction` (unit length). `along` and
    // `across` are the half axes of the part of the surface that is its own: half way to the next seed of the ring,
    // half way to the next ring (lengths in units).
    virtual void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) = 0;
};

#endif
