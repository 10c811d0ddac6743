// The soft sphere: its core is a point. It is the one complete primitive of the report.
#ifndef FB_SPHERE_H
#define FB_SPHERE_H

#include "model/softobj.h"

class Sphere : public SoftObject {
public:
    Sphere(int number, Real size) : SoftObject(number, size) {}

    Vector fromCore(const Vector& q) const override { return q; }
    void layOutSeeds(SeedMaker& maker, Real spacing) const override;
    void describe(char* to, int size) const override;
};

// The rings that approximate a sphere of `radius` (Appendix C, Figure 8): their number, and the number of seeds in the ring at
// the latitude whose cosine is `cosine30` (30 fraction bits). seedsInRing() serves every primitive with round parts.
int ringCount(Real radius, Real spacing);
int seedsInRing(Real radius, Real spacing, int32_t cosine30);

#endif
