// The soft torus: its core is a circle.
#ifndef FB_TORUS_H
#define FB_TORUS_H

#include "model/softobj.h"

class Torus : public SoftObject {
public:
    // The core is a circle of radius `ring` about the object's y axis. The tube, of radius size / 2, must not touch itself: a
    // ring below leastRing() is replaced by it.
    Torus(int number, Real size, Real ring);

    // The smallest ring for a size: it leaves a hole whose radius is a quarter of the tube's.
    static Real leastRing(Real size) { return size * Real(0.625); }

    Vector fromCore(const Vector& q) const override;
    Real plainParam(const Vector& q, Vector* slope) const override;
    Vector coreExtent16() const override { return {coreReach16(), Real(0), coreReach16()}; }
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    bool ringsClose() const override { return true; }
    void describe(char* to, int size) const override;


    Real ring() const { return coreReach(); }
};

#endif
