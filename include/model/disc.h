// The soft disc: its core is a flat round plate, so its surface is a box with round corners swept round an axis (the
// "offset surfaces from polygons" of the report's Appendix C, for the polygon of many corners).
#ifndef FB_DISC_H
#define FB_DISC_H

#include "model/softobj.h"

class Disc : public SoftObject {
public:
    // The core is a plate of radius `discRadius` (0 and more; less is taken as 0), square to the object's y axis. The
    // surface lies size / 2 from it.
    Disc(int number, Real size, Real discRadius);

    Vector fromCore(const Vector& q) const override;
    Vector coreExtent16() const override { return {coreReach16(), Real(0), coreReach16()}; }
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    void describe(char* to, int size) const override;

    Real discRadius() const { return coreReach(); }
};

#endif
