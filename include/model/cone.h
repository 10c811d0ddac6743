// The soft cone, or tapered cylinder: its core is a segment, and its size changes linearly from one end to the other.
#ifndef FB_CONE_H
#define FB_CONE_H

#include "model/softobj.h"

class Cone : public SoftObject {
public:
    // The core is `length` units long, along the object's y axis, and its middle is the centre. The size is `size1` at the
    // lower end and `size2` at the upper end; for any point p it is the size at the core's point nearest to p. The ends are
    // round. size() is the larger of the two. A length below leastLength() is replaced by it.
    Cone(int number, Real size1, Real size2, Real length);

    // The least length for which the side slopes by 45 degrees at most.
    static Real leastLength(Real size1, Real size2) { return shiftDown(absolute(size1 - size2), 1); }

    Vector fromCore(const Vector& q) const override;
    Real segmentHalf16() const override { return coreReach16(); }
    Real plainParam(const Vector& q, Vector* slope) const override;
    Vector coreExtent16() const override { return {Real(0), coreReach16(), Real(0)}; }
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    void describe(char* to, int size) const override;

    Real size1() const { return grown(size1Made_); }
    Real size2() const { return grown(size2Made_); }
    Real length() const { return shiftUp(coreReach(), 1); }

private:
    // The size at height y above the core's middle: in units, and in core space.
    Real sizeAlong(Real y) const { return shiftDown(size1() + size2(), 1) + y * taper_; }
    Real size16Along(Real y) const { return mean16_ + y * taper_; }

    Real size1Made_, size2Made_, lengthMade_;  // when made, so that repeated scaling adds up no errors
    Real mean16_, taper_;                      // size at height y above the middle, core space: mean16_ + y taper_
};

#endif
