// The soft box: its core is a solid box, so its surface is a box with round edges and corners (the "offset surfaces from
// polygons" of the report's Appendix C, for a polyhedron).
#ifndef FB_BOX_H
#define FB_BOX_H

#include "model/softobj.h"

class Box : public SoftObject {
public:
    // The core's edges are `x`, `y` and `z` units long, along the object's own axes, and its middle is the centre. Values below
    // 0 are taken as 0: the core may also be a plate, a segment or a point. The surface lies size / 2 outside the core.
    Box(int number, Real size, Real x, Real y, Real z);

    Vector fromCore(const Vector& q) const override;
    Vector coreExtent16() const override { return half16_; }
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    void describe(char* to, int size) const override;

    // Half extents of the core.
    Vector half() const { return {grown(halfMade_.x), grown(halfMade_.y), grown(halfMade_.z)}; }

private:
    Vector halfMade_;  // when made, so that repeated scaling adds up no errors
    Vector half16_;    // in core space
};

#endif
