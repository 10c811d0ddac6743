// Seed: a sample of the implicit surface that may move along one fixed path only (report, Section III, Figure 6), and
// what a primitive lays its seeds out with (Appendix C).
#ifndef FB_SEED_H
#define FB_SEED_H

#include "math/vec.h"
#include "surface/voxel.h"

// What is known of a seed. VALID: it settled on the surface, in a region that belongs to its own object. FRONT: its
// scale may face the viewer; with the default method only if it is VALID, so that this bit alone tells what to draw.
// PLACED: a neighbour reaches it and its position is a place where its path leaves the surface; its normal is not its
// path. ACTIVE: for an oversampled seed, that it takes part. KEPT: brightness and what is known of its scale hold for the
// present position.
enum SeedFlag : uint8_t {
    SEED_VALID = 1,
    SEED_PLACED = 2,
    SEED_ACTIVE = 4,
    SEED_KEPT = 8,
    SEED_FRONT = 128,  // the sign: the quickest bit to ask for
};

// seed = root + position * path. All lengths in units, 16.16 unless said otherwise.
struct Seed {
    Vector path;         // from root to the unblended surface: as long as the object's radius
    Real position;       // along the path; 1.0 on the unblended surface
    int32_t neighbour;   // index of the seed N of the ring before (Appendix C, Oversampling); -1 in the first ring. Of the
                         // oversampled seed: how many bytes further on than the seed before it N lies; 0 in the first ring
    Voxel voxel;         // of a KEPT seed: its scale, at the present position; its brightness always
    uint8_t flags;       // SeedFlag
    uint8_t restBrightness;
    uint16_t root;       // index of the root point: seeds share them
    int16_t dirX, dirY, dirZ;    // the path's direction, unit length = 2^14
    int16_t wakes;               // up to which travel of the object (SoftObject) nothing happens to it; only where a
                                 // neighbour reaches its patch
    int8_t along[3], across[3];  // half axes of the part of the surface that is its own, 1/64 spacing
};

// A run of seeds of a ring. Where they rest, counted from the object's centre: none is farther than wide / 2 from the straight
// line from middle - half to middle + half.
struct SeedRun {
    Vector middle, half;
    Real wide;
    int32_t count;
    bool turned;   // the viewer has moved on since the placed seeds were laid
    bool extras;   // oversampled seeds among them take part
    bool back;     // none of it can be seen
};

// Receives the seeds of a primitive, ring by ring, in the object's own space: centred on the origin and axis-aligned
// ("canonical" space, Appendix C). It is run twice: once to count, once to fill.
class SeedMaker {
public:
    virtual ~SeedMaker() {}

    // Adds a root point and returns its index.
    virtual int addRoot(const Vector& fromCentre) = 0;

    // Starts the next ring: seeds that follow each other around the primitive, beside the ring before.
    virtual void beginRing() = 0;

    // Seeds added from now on rest this far from their roots, units, and not the object's radius: for objects that
    // taper.
    virtual void restAt(Real) {}

    // Adds a seed to the ring: it rests `radius` away from its root along `direction` (unit length). `along` and
    // `across` are the half axes of the part of the surface that is its own: half way to the next seed of the ring,
    // half way to the next ring (lengths in units).
    virtual void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) = 0;
};

#endif
