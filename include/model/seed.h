// Seed: a sample of the implicit surface that may move along one fixed path only (report, Section III, Figure 6), and the
// interface through which a primitive lays its seeds out (Appendix C).
#ifndef FB_SEED_H
#define FB_SEED_H

#include "math/vec.h"

// The states of a seed. Only a method of finding the surface (model/surface.h) sets and clears them.
//
//   state         set when                                 cleared when
//   SEED_VALID    the seed settled on the surface, where   its path leaves the surface in a neighbour's territory, or
//                 its own object has the strongest claim   nowhere
//                 (gather.h)
//   SEED_GUEST    in that place another object's field is  it is not any more
//                 the stronger: the seed shows that
//                 object's colour
//   SEED_ACTIVE   an oversampled seed takes part           its regular seed and that seed's neighbour are in the same
//                                                          state again
//   SEED_RESTING  no neighbour reaches the seed: it is at  a neighbour reaches it
//                 position 1 with the normal of the
//                 unblended surface
//   SEED_BORDER   a neighbour is about as strong there     no neighbour is
//   SEED_ASLEEP   its patch lies inside a neighbour,       the patch does not any more
//                 faces away or is hidden: the seed is not
//                 settled
//   SEED_FOLLOW   the seed is not on the surface, but its  the seed settles
//                 path is likely to leave the surface near
//                 its position: it wakes up, or another
//                 object is stronger there, or it is on a
//                 part of a hollow's wall that another
//                 object samples, or where an equal field
//                 stands first
//   SEED_OFF      an object digs near the seed, which      the seed settles anew
//                 cannot be on the surface before `due`
//   SEED_FRONT    /P only: its path does not point away    its path points away
//                 from the viewer
//   SEED_KEPT     /P only: normal and brightness hold for  the seed moves
//                 the present position
enum SeedFlag : uint8_t {
    SEED_VALID = 1,
    SEED_ACTIVE = 2,
    SEED_RESTING = 4,
    SEED_FRONT = 8,
    SEED_OFF = 8,        // shares the bit of SEED_FRONT, which only /P uses
    SEED_KEPT = 16,
    SEED_GUEST = 16,     // shares the bit of SEED_KEPT, which only /P uses
    SEED_BORDER = 32,
    SEED_ASLEEP = 64,
    SEED_FOLLOW = 128,
};

// A unit vector in whole numbers: 14 fraction bits (1.0 = 2^14).
struct Direction14 {
    int16_t x, y, z;
};

// A seed lies at root + position * path in the object's own space: centred on the origin, along the object's own axes, as large
// as when the seeds were laid out. Seeds never turn; the world turns round them. Lengths are in units.
struct Seed {
    Vector path;         // vector from the root to the unblended surface
    Real position;       // factor of the path; 1.0 on the unblended surface
    int32_t neighbour;   // slot of the seed N of the ring before (Appendix C, Oversampling); -1: there is none. For an
                         // oversampled seed: slot of the seed on its other side
    Direction14 normal;  // of the surface at the seed
    union {
        Direction14 border;  // with SEED_BORDER: direction in which the own field gains fastest on the strongest neighbour's (with
                             // SEED_GUEST: in which the host's field does so on the second strongest)
        int16_t place[3];    // with SEED_RESTING: resting place, in steps given by SoftObject::placeShift()
    };
    union {
        int16_t apart;   // with SEED_BORDER: distance to where the two fields are equal, 1/256 unit, positive on its own side
        int16_t out;     // with SEED_RESTING: dot product of normal and `place`, in the steps of `place`
        uint16_t due;    // with SEED_OFF: value of Patch::travelled (surface/patch.h) at which the seed is looked at again
    };
    uint16_t root;       // index of the root point, which several seeds may share
    uint8_t flags;       // SeedFlag
    uint8_t mix;         // number of the colour at the seed, where colours mix (model/paint.h)
    uint8_t blocker;     // without SEED_VALID: index (in Bodies) of the neighbour that was the strongest there
    // The seed's cell, its part of the unblended surface: two half axes, 1/64 of the spacing each, and the area of the
    // parallelogram that they span, (1/64 spacing)^2. The cells of a ring form a band; the area is 0 for an oversampled seed,
    // whose cell is in no band.
    int8_t along[3], across[3];
    int8_t way[3];       // direction of the path, 1.0 = 127
    uint16_t area;
    static constexpr int16_t LIGHT_UNKNOWN = INT16_MIN;
    int16_t lightChange[3];  // of a seed that settled beside a border, an oversampled or a fine one: the gradient of the brightness
                             // along the surface, own axes, 1/128 step per unit of the world. Its component along the normal
                             // does not count. The first is LIGHT_UNKNOWN until it has been found
    uint8_t host;        // with SEED_GUEST: index (in Bodies) of the object whose field is the strongest
    bool lightIsOld;     // lightChange was kept when the seed settled last, or is unknown: the next time it is found anew
    uint8_t spare[2];    // pads a seed to 64 bytes, so that an index becomes an address by a shift
    int32_t beyond;      // of a regular seed beside a ridge, where the surface bends outwards sharply: slot of the regular seed on
                         // the other side; else -1. Its oversampled and fine seeds have the same
};

// Receives the seeds of a primitive, ring by ring, in the object's own space (Appendix C: "canonical" space). A layout runs
// twice: with a SeedMaker that counts, then with one that stores.
class SeedMaker {
public:
    virtual ~SeedMaker() {}

    // Adds a root point (relative to the centre) and returns its index.
    virtual int addRoot(const Vector& fromCentre) = 0;

    // Starts the next ring: seeds that follow each other around the primitive, beside the ring before.
    virtual void beginRing() = 0;

    // Returns true if only the number of seeds of the ring is wanted: `seeds` seeds then count as added, with one common root
    // or, if `various`, with several roots.
    virtual bool countRing(int /* seeds */, bool /* various */) { return false; }

    // Sets the distance from the root at which the seeds added from now on rest, units, instead of the object's radius. For
    // objects that taper.
    virtual void restAt(Real) {}

    // Adds a seed to the ring: it rests at distance `radius` from its root in the direction `direction` (unit vector). `along`
    // and `across` are the half axes of its cell: half the vector to the next seed of the ring, and half the vector to the next
    // ring, units.
    virtual void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) = 0;
};

#endif
