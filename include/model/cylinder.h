// The soft cylinder: its core is a segment, the report's "spine [...] from which all unblended surface points are
// equidistant". Completed from the report's sketch (Section III, Data Structures, and Appendix C).
#ifndef FB_CYLINDER_H
#define FB_CYLINDER_H

#include "model/softobj.h"

class Cylinder : public SoftObject {
public:
    // The core is `length` units long (0 and more; less is taken as 0), along the object's y axis, its middle in the
    // centre. The ends are round: the surface reaches size / 2 beyond the core.
    Cylinder(int number, Real size, Real length);

    Vector fromCore(const Point& p) const override;
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    Real horizonRadius(const Point& eye) const override;
    Real horizonAt(const Point& root, Real general) const override;
    Real coreReach() const override { return half_; }
    void placeCore() override;
    void describe(char* to, int size) const override;

    Real length() const { return shiftUp(half_, 1); }

private:
    Real half_;      // of the core's length
    Real halfMade_;  // the same, and the size, as made: scaling never adds up errors
    Real sizeMade_;
    Vector axis_;    // of the core, unit length, in the world
};

#endif
