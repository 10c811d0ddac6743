// What the primitives with round parts share: rings of seeds about the object's y axis (report, Appendix C, Figure 8,
// "this method can be generalized to some other primitives"), and distances from that axis.
#ifndef FB_ROUND_H
#define FB_ROUND_H

#include "model/seed.h"
#include "math/vec.h"

// A ring of seeds about the y axis, in the object's own space. Directions are given in the half plane through the axis:
// sine and cosine of the latitude, 0 away from the axis, a quarter turn along +y.
struct Ring {
    Real core;                      // distance of its roots from the axis, units; 0: one root on the axis for all
    Real height;                    // y of its roots
    Real radius;                    // length of its paths
    Real pathSine, pathCosine;      // latitude of the paths
    Real normalSine, normalCosine;  // latitude of the surface's normal: the same, but where the object tapers
    Real across;                    // half way to the next ring, along the surface, units
};

// Number of seeds of a ring: as many as fit `spacing` units apart, four at least.
int seedsOf(const Ring& ring, Real spacing);

// Adds the ring's roots, evenly spaced (one, when they lie on the axis). Returns the index of the first.
int addRoots(SeedMaker& maker, const Ring& ring, Real spacing);

// Begins a ring and adds its seeds, the first in the plane x = 0; `root` is the index of its first root.
void addSeeds(SeedMaker& maker, const Ring& ring, Real spacing, int root);

// The least number of steps of at most `spacing` units that `length` units are, 1 at least.
int stepsIn(Real length, Real spacing);

// whole * part / of, with 64 bits between; the result must fit.
inline Real portion(Real whole, int32_t part, int32_t of)
{
    return realFromRaw(mulDiv(rawFromReal(whole), part, of));
}

// part / of as a share of a quarter turn, for 0 <= part <= of.
inline Angle quarterTurn(Real part, Real of)
{
    return static_cast<Angle>(mulDiv(rawFromReal(part), 1 << 30, rawFromReal(of)));
}

constexpr Real PI(3.14159265);
constexpr Real HALF_PI(1.57079633);

// Length of a vector of up to 16000 units, good to 1/100000 of itself and the last bit: for distances that are needed
// often. Two orders of magnitude quicker than length() on a 386, which computes every bit. Wants makeNormalTable().
Real lengthQuick(const Vector& v);

#endif
