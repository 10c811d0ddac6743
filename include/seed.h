// Seed: a sample of the implicit surface that may move along one fixed path only (report, Section III, Figure 6), and
// what a primitive lays its seeds out with (Appendix C).
#ifndef FB_SEED_H
#define FB_SEED_H

#include "vec.h"

// What is known of a seed. VALID: it settled on the surface, in a region that belongs to its own object. FRONT: its
// scale may face the viewer. PLACED: a neighbour reaches it and its position is a place where its path leaves the surface;
// its normal is not its path. ACTIVE: for an oversampled seed, that it takes part. KEPT: brightness and extents hold for the
// present position. EDGE: a seed beside it is not valid, or parted from it. OVER: valid, but past the border where a
// neighbour is stronger.
enum SeedFlag : uint8_t {
    SEED_VALID = 1,
    SEED_FRONT = 2,
    SEED_PLACED = 4,
    SEED_ACTIVE = 8,
    SEED_KEPT = 16,
    SEED_EDGE = 32,
    SEED_OVER = 128,
};

// seed = root + position * path. All lengths in units, 16.16 unless said otherwise.
struct Seed {
    Vector path;         // from root to the unblended surface: as long as the object's radius
    Real position;       // along the path; 1.0 on the unblended surface
    int32_t neighbour;   // index of the seed N of the ring before (Appendix C, Oversampling); -1 in the first ring. Of the
                         // oversampled seed: how many bytes further on than the seed before it N lies; 0 in the first ring
    uint16_t root;       // index of the root point: seeds share them
    uint8_t flags;       // SeedFlag
    uint8_t brightness;  // 0..63, of the surface at the present position
    int16_t wide, high;  // half extents of the scale along X and Y of a PLACED seed, 1/256 unit
    int16_t dirX, dirY, dirZ;    // the path's direction, unit length = 2^14
    int16_t tiltX, tiltY;        // Voxel's, at the present position
    int16_t shiftX, shiftY;      // from the seed to the middle of its scale, 1/256 unit
    uint8_t restBrightness;
    int16_t due;                 // EDGE: how many seeds further on the one beside it lies
    int16_t wakes;               // up to which travel of the object (SoftObject) nothing happens to it; only where a
                                 // neighbour reaches its patch
    int8_t along[3], across[3];  // half axes of the part of the surface that is its own, 1/64 spacing
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
