// The soft disc: its core is a flat round plate, so its surface is a plate with a round rim (the "offset surfaces from
// polygons" of the report's Appendix C, for a polygon of many corners).
#ifndef FB_DISC_H
#define FB_DISC_H

#include "model/softobj.h"

class Disc : public SoftObject {
public:
    // The core is a plate of radius `discRadius` (below 0 is taken as 0), perpendicular to the object's y axis. The surface
    // lies size / 2 away from it.
    Disc(int number, Real size, Real discRadius);

    Vector fromCore(const Vector& q) const override;
    Real plainParam(const Vector& q, Vector* slope) const override;
    Vector coreExtent16() const override { return {coreReach16(), Real(0), coreReach16()}; }
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    void describe(char* to, int size) const override;

    Real discRadius() const { return coreReach(); }
};

#endif
