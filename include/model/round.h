// The common part of the primitives with round parts: rings of seeds about the object's y axis (report, Appendix C, Figure 8,
// "this method can be generalized to some other primitives"), and quick lengths. Nothing here knows a particular primitive.
#ifndef FB_ROUND_H
#define FB_ROUND_H

#include "math/normal.h"
#include "model/seed.h"

// A ring of seeds about the y axis, in the object's own space before any stretch. Directions in the half plane through the axis
// are given by sine and cosine of a latitude, which is 0 pointing away from the axis and a quarter turn along +y.
struct Ring {
    Real core;                      // distance of the roots from the axis, units; 0: all seeds share one root on the axis
    Real height;                    // y of the roots
    Real radius;                    // length of the paths
    Real pathSine, pathCosine;      // latitude of the paths
    Real normalSine, normalCosine;  // latitude of the surface's normal; it differs from that of the paths if the object tapers
    Real halfStep;                  // half the distance to the next ring along the surface, units

    // Distance of its seeds from the axis, units; 0 where the tube of a strong torus meets itself across the hole.
    Real around() const
    {
        const Real away = core + radius * pathCosine;
        return away > Real(0) ? away : Real(0);
    }
};

// The least number, at least 1, of equal steps of at most `spacing` units into which `length` units can be divided.
int stepsIn(Real length, Real spacing);

// A quarter of the ellipse that a unit circle about the y axis becomes when it is stretched: it converts between arc length
// along the ellipse and longitude on the circle. Longitude 0 points along z. Without a stretch the table is empty (all zero).
class Quarter {
public:
    explicit Quarter(const Vector& stretch);
    Real length() const { return arcs_[STEPS]; }
    // longitude(): the longitude, up to a quarter turn, after the arc length `arc`; wayTo(): the arc length up to a
    // longitude.
    Angle longitude(Real arc) const;
    Real wayTo(Angle longitude) const;

private:
    static constexpr int STEPS = 32;
    Real arcs_[STEPS + 1];
};

// The distance between two rings on the stretched surface that are `step` apart on the unstretched one, at a place whose normal
// has the given latitude and longitude.
Real stretchedStep(Real step, const Vector& stretch, Real normalSine, Real normalCosine, Real sine, Real cosine);

// Where rings are farther apart on one side of an object than on another, some rings leave out their seeds on the side where
// they lie too close: at level L only one ring of 2^L keeps them. thinning() returns the level for a distance `step` between
// rings; thinned() says whether a ring leaves its seeds out. Rings kept at a higher level are also kept at all lower levels: those
// whose number ends like 5 in binary. So ring 0, at an end of the object, leaves its seeds out from level 1 on.
int thinning(Real step, Real spacing);
inline bool thinned(int ring, int level)
{
    return ((ring ^ 5) & ((1 << level) - 1)) != 0;
}

// Makes rings of seeds on an object, stretched or not.
class RingMaker {
public:
    RingMaker(SeedMaker& maker, const Vector& stretch, Real spacing);
    // Lets the seeds of the rings that follow be `spacing` units apart.
    void setSpacing(Real spacing) { spacing_ = spacing; }

    // The number of seeds of a ring: as many as fit `spacing` units apart, at least four (two, if the ring is flat).
    int seedsOf(const Ring& ring) const;

    // Adds the ring's roots and returns the index of the first. They are evenly spaced; there is only one if it lies on the
    // axis. On an object stretched differently along x and z, addSeeds() adds the roots off the axis instead.
    int addRoots(const Ring& ring);

    // Begins ring number `k` of the object and adds its seeds, the first in the plane x = 0; `root` is the index of the ring's
    // first root.
    void addSeeds(const Ring& ring, int k, int root);

    // Adds roots and seeds of ring number `k` of an object that is its own mirror image in the plane y = 0. Its ring number
    // rings - 1 - k is the image of this one, and shares its roots. `latitude` is that of the lower one of the two; the sines and
    // cosines of `ring` are set from it.
    void addMirrored(Ring& ring, int k, int rings, Angle latitude);

private:
    void addStretched(const Ring& ring, int k, int root);

    SeedMaker& maker_;
    Vector stretch_;
    Real spacing_;
    bool stretched_;
    bool round_, flat_;  // x and z are stretched alike; one is stretched more than twice as much as the other
    Quarter quarter_;
    int root_ = 0;  // for addMirrored(): the number of roots below ring k, or its image
};

// The outline of a round object in the half plane through its axis, from bottom to top: a sequence of parts. It finds places
// that are evenly spaced along the outline of the stretched object.
class Outline {
public:
    explicit Outline(const Vector& stretch);

    // Adds a part of `length` units: an arc, along which the latitude of the normal changes from one value to another, or a
    // straight line with a constant normal.
    void arc(Real length, Angle from, Angle to);
    void line(Real length, Real normalSine, Real normalCosine);
    // Adds a part whose length is already that on the stretched object.
    void plain(Real length);

    // The length of the stretched outline.
    Real length() const { return stretched_ ? after_[parts_] : before_[parts_]; }
    // Returns the place at the fraction part / of of the stretched length, measured along the unstretched outline; `*step`
    // receives the length there of the fraction 1 / of.
    Real at(int32_t part, int32_t of, Real* step) const;

private:
    static constexpr int PARTS_MOST = 128, ARC_PARTS = 24;
    void add(Real length, Real factor);

    Vector stretch_;
    Real widest_;     // the larger stretch factor perpendicular to the axis
    bool stretched_;
    int parts_ = 0;
    Real before_[PARTS_MOST + 1], after_[PARTS_MOST + 1];  // start of each part, unstretched and stretched
};

// Lays seeds out round a segment along the y axis, `half` units to each side of the centre (0: on a ball).
void layOutCapsule(SeedMaker& maker, const Vector& stretch, Real radius, Real half, Real spacing);

// whole * part / of, computed with a 64-bit product; the result must fit 32 bits.
inline Real portion(Real whole, int32_t part, int32_t of)
{
    return realFromRaw(mulDiv(rawFromReal(whole), part, of));
}

// The fraction part / of of a quarter turn, for 0 <= part <= of.
inline Angle quarterTurn(Real part, Real of)
{
    return static_cast<Angle>(mulDiv(rawFromReal(part), 1 << 30, rawFromReal(of)));
}

constexpr Real PI(3.14159265);
constexpr Real HALF_PI(1.57079633);

// Length of a vector of up to 16000 units, with an error of at most 1/100000 of it plus one last bit: for distances needed
// often. On a 386 it is two orders of magnitude quicker than length(), which is exact. makeNormalTable() must have been called.
inline Real lengthQuick(const Vector& v)
{
#if FB_REAL == FB_FIXED
    uint32_t x = static_cast<uint32_t>(v.x.raw < 0 ? -v.x.raw : v.x.raw);
    uint32_t y = static_cast<uint32_t>(v.y.raw < 0 ? -v.y.raw : v.y.raw);
    uint32_t z = static_cast<uint32_t>(v.z.raw < 0 ? -v.z.raw : v.z.raw);
    const uint32_t bits = x | y | z;
    if (bits == 0)
        return Real(0);
    // Compute the square, look up a root of 15 bits in the table, and double its precision by one step of Newton's method.
    const int excess = 18 - __builtin_clz(bits);
    uint64_t square;
    uint32_t root;
    if (excess > 0) {
        square = static_cast<uint64_t>(x) * x + static_cast<uint64_t>(y) * y + static_cast<uint64_t>(z) * z;
        const uint32_t few = static_cast<uint32_t>(square >> (2 * excess));
        root = static_cast<uint32_t>(static_cast<uint64_t>(few) * inverseRoots[few >> 20] >> 28) << excess;
    } else {
        x <<= -excess;
        y <<= -excess;
        z <<= -excess;
        square = x * x + y * y + z * z;
        root = static_cast<uint32_t>(square * inverseRoots[square >> 20] >> 28);
    }
    uint32_t rest;
    root = (root + quotient64(square, root, &rest)) >> 1;
    return Real::fromRaw(static_cast<int32_t>(excess > 0 ? root : root >> -excess));
#else
    return squareRoot(dot(v, v));
#endif
}

#endif
