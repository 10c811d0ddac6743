// The soft cylinder: its core is a segment, the report's "spine [...] from which all unblended surface points are equidistant".
// The report only sketches it (Section III, Data Structures, and Appendix C).
#ifndef FB_CYLINDER_H
#define FB_CYLINDER_H

#include "model/softobj.h"

class Cylinder : public SoftObject {
public:
    // The core is `length` units long (below 0 is taken as 0), along the object's y axis, and its middle is the centre. The
    // ends are round: the surface reaches size / 2 beyond the core.
    Cylinder(int number, Real size, Real length);

    Vector fromCore(const Vector& q) const override;
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    Real segmentHalf16() const override { return coreReach16(); }
    Vector coreExtent16() const override { return {Real(0), coreReach16(), Real(0)}; }
    void describe(char* to, int size) const override;

    Real length() const { return shiftUp(coreReach(), 1); }
};

#endif
