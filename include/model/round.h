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

// The least number of steps of at most `spacing` units that `length` units are, 1 at least.
int stepsIn(Real length, Real spacing);

// A quarter of the ellipse that a circle of radius 1 square to y becomes when it is stretched: longitudes by the length of the way
// there. Longitude 0 points along z. It is not there for what is not stretched.
class Quarter {
public:
    explicit Quarter(const Vector& stretch);
    Real length() const { return way_[STEPS]; }
    // The longitude, up to a quarter turn, after a way; and the way to a longitude.
    Angle longitude(Real way) const;
    Real wayTo(Angle longitude) const;

private:
    static constexpr int STEPS = 32;
    Real way_[STEPS + 1];
};

// How far rings lie apart that are `step` apart on the unstretched surface, at a place where its normal has a latitude and a
// longitude.
Real stretchedStep(Real step, const Vector& stretch, Real normalSine, Real normalCosine, Real sine, Real cosine);

// Where rings are farther apart in one direction than in another, some leave out their seeds where they lie too close: the
// power of two of which every such ring has them. The rings of a higher level are among those of all lower ones.
int thinning(Real step, Real spacing);
inline bool thinned(int ring, int level)
{
    return ((ring ^ 5) & ((1 << level) - 1)) != 0;
}

// Makes rings of seeds on an object that is stretched, or not.
class RingMaker {
public:
    RingMaker(SeedMaker& maker, const Vector& stretch, Real spacing);

    // Number of seeds of a ring: as many as fit `spacing` units apart, four at least (two, when it is flat).
    int seedsOf(const Ring& ring) const;

    // Adds the ring's roots, evenly spaced (one, when they lie on the axis), unless addSeeds() will. Returns the index of the
    // first.
    int addRoots(const Ring& ring);

    // Begins a ring, number `k` of the object, and adds its seeds, the first in the plane x = 0; `root` is the index of its
    // first root.
    void addSeeds(const Ring& ring, int k, int root);

private:
    void addStretched(const Ring& ring, int k, int root);

    SeedMaker& maker_;
    Vector stretch_;
    Real spacing_;
    bool stretched_;
    bool round_, flat_;  // both ways across are stretched alike; one is twice the other or more
    Quarter quarter_;
};

// The outline of a round object in the half plane through its axis, from below: its parts in their order, and places along it,
// evenly spaced on the stretched object.
class Outline {
public:
    explicit Outline(const Vector& stretch);

    // Adds a part of so many units along which the latitude of the normal goes from one to another, or stays.
    void arc(Real length, Angle from, Angle to);
    void line(Real length, Real normalSine, Real normalCosine);
    // One that is given in units of the stretched object.
    void plain(Real length);

    // The length of the stretched outline.
    Real length() const { return stretched_ ? after_[parts_] : before_[parts_]; }
    // The place, in units of the outline as it was added, at part / of its stretched length; `*across` receives what is 1 / of
    // there.
    Real at(int32_t part, int32_t of, Real* across) const;

private:
    static constexpr int PARTS_MOST = 128, ARC_PARTS = 24;
    void add(Real length, Real factor);

    Vector stretch_;
    Real across_;     // greatest factor square to the axis
    bool stretched_;
    int parts_ = 0;
    Real before_[PARTS_MOST + 1], after_[PARTS_MOST + 1];  // where each part begins, unstretched and stretched
};

// Seeds on what surrounds a segment along the y axis, `half` units to each side of the centre; 0: on a ball.
void layOutCapsule(SeedMaker& maker, const Vector& stretch, Real radius, Real half, Real spacing);

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
