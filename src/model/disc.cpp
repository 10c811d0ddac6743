// Seeds on a disc: rings outwards along the lower face, round the rim, and inwards along the upper face.
#include "model/disc.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

Disc::Disc(int number, Real size, Real discRadius) : SoftObject(number, size, max(discRadius, Real(0))) {}

// Disc::fromCore() for a plate of radius `core`.
static inline Vector fromPlate(const Vector& q, Real core)
{
    const Real away = lengthQuick({q.x, Real(0), q.z});
    if (away <= core)
        return {Real(0), q.y, Real(0)};
    const Real share = quotient(away - core, away);
    return {q.x * share, q.y, q.z * share};
}

Vector Disc::fromCore(const Vector& q) const
{
    return fromPlate(q, coreReach16());
}

Real Disc::plainParam(const Vector& q, Vector* slope) const
{
    // Far above or below the core it need not be known how far the nearest point of the core lies aside.
    if (absolute(q.y) >= Real(CORE_SIZE)) {
        *slope = q;
        return Real(1);
    }
    const Vector v = fromPlate(q, coreReach16());
    *slope = v;
    return paramOf(v);
}

void Disc::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    // The lower half of the outline: the face, then a quarter circle of the rim.
    const Real rim = radius() * HALF_PI;
    Outline outline(stretch());
    outline.line(discRadius(), Real(1), Real(0));
    outline.arc(rim, 0u - QUARTER, 0);
    const int rings = stepsIn(outline.length(), shiftDown(spacing, 1));
    RingMaker ringMaker(maker, stretch(), spacing);
    Ring ring{};
    ring.radius = radius();
    int root = 0;
    // Ring k and ring rings - 1 - k mirror each other in the plane of the core, and share their roots.
    for (int k = 0; k < rings; ++k) {
        const int mirrored = rings - 1 - k;
        const int below = k < mirrored ? k : mirrored;
        const Real at = outline.at(2 * below + 1, rings, &ring.across);
        Angle latitude = 0u - QUARTER;
        ring.core = discRadius();
        if (at < discRadius())
            ring.core = at;
        else
            latitude += quarterTurn(min(at - discRadius(), rim), rim);
        if (k == mirrored)
            latitude = 0;
        else if (k > mirrored)
            latitude = 0u - latitude;
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        const int roots = ring.core == Real(0) ? 1 : ringMaker.seedsOf(ring);
        if (k > mirrored) {
            root -= roots;
            ringMaker.addSeeds(ring, k, root);
        } else {
            ringMaker.addRoots(ring);
            ringMaker.addSeeds(ring, k, root);
            if (k < mirrored)
                root += roots;
        }
    }
}

void Disc::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, axis().x, axis().y, axis().z, discRadius(), this->size()};
    describeAs("disc", numbers, 8, to, size);
}
