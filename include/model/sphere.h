// The soft sphere: its core is a point. The report's one complete primitive.
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

// Of the rings that approximate a sphere of `radius` (Appendix C, Figure 8): how many there are, and how many seeds lie
// in the one at a latitude with cosine `cosine30` (2.30). Used by every primitive with round parts.
int ringCount(Real radius, Real spacing);
int seedsInRing(Real radius, Real spacing, int32_t cosine30);

#endif
