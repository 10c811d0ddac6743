// The soft cone, or tapered cylinder: its core is a segment, and its size goes evenly from one end to the other.
#ifndef FB_CONE_H
#define FB_CONE_H

#include "model/softobj.h"

class Cone : public SoftObject {
public:
    // The core is `length` units long, along the object's y axis, its middle in the centre; the size is `size1` at its
    // lower end, `size2` at its upper one, and at any point p what it is at the core's point nearest to p. The ends are
    // round. size() is the larger of the two. A length below leastLength() is taken as that.
    Cone(int number, Real size1, Real size2, Real length);

    // The side slopes by 45 degrees at most.
    static Real leastLength(Real size1, Real size2) { return shiftDown(absolute(size1 - size2), 1); }

    Vector fromCore(const Point& p) const override;
    Real sizeAt(const Point& p) const override;
    Real tangentAt(const Point& root) const override;
    Real taperedParam(const Point& p, Vector* slope) const override;
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    Real horizonRadius(const Point& eye) const override;
    Real horizonAt(const Point& root, Real general) const override;
    Real coreReach() const override { return half_; }
    void placeCore() override;
    void describe(char* to, int size) const override;

    Real size1() const { return size1_; }
    Real size2() const { return size2_; }
    Real length() const { return shiftUp(half_, 1); }

private:
    // From the core's middle along the axis: the nearest point of the core to `p`.
    Real along(const Point& p) const { return clamp(dot(p - centre(), axis_), -half_, half_); }
    Real sizeAlong(Real along) const { return mean_ + along * taper_; }

    Real size1_, size2_;
    Real half_;                      // of the core's length
    Real mean_, taper_;              // size at distance s from the middle: mean + s taper
    Real normalSine_, normalCosine_; // latitude of the side's normal
    Real size1Made_, size2Made_, halfMade_, sizeMade_;  // as made: scaling never adds up errors
    Vector axis_;                    // unit length, in the world
};

#endif
