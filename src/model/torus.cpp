// Seeds on a torus: rings about its axis that lie beside each other round the tube.
#include "model/torus.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

Torus::Torus(int number, Real size, Real ring) : SoftObject(number, size, max(ring, leastRing(size))) {}

// Torus::fromCore() for a circle of radius `core`.
static inline Vector fromCircle(const Vector& q, Real core)
{
    const Real away = lengthQuick({q.x, Real(0), q.z});
    // On the axis all points of the circle are equally near, and any direction serves; close to it a direction would have few
    // bits.
    if (away < Real(0.01))
        return {away - core, q.y, Real(0)};
    const Real share = (away - core) / away;
    return {q.x * share, q.y, q.z * share};
}

Vector Torus::fromCore(const Vector& q) const
{
    return fromCircle(q, coreReach16());
}

Real Torus::plainParam(const Vector& q, Vector* slope) const
{
    // Far above or below the core it need not be known how far the nearest point of the core lies aside.
    if (absolute(q.y) >= Real(CORE_SIZE)) {
        *slope = q;
        return Real(1);
    }
    const Vector v = fromCircle(q, coreReach16());
    *slope = v;
    return paramOf(v);
}

void Torus::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    // The lower half of the tube's outline, from the side of the hole to the outside.
    Outline outline(stretch());
    outline.arc(radius() * PI, 0x80000000u, 0xffffffffu);
    const int rings = stepsIn(outline.length(), shiftDown(spacing, 1));
    RingMaker ringMaker(maker, stretch(), spacing);
    Ring ring{};
    ring.core = this->ring();
    ring.radius = radius();
    // The rings go from the hole along the lower half outwards and along the upper half back. Ring k and ring rings - 1 - k
    // mirror each other in the plane of the core, and share their roots.
    const uint32_t step = 0x80000000u / static_cast<uint32_t>(rings);
    int root = 0;
    for (int k = 0; k < rings; ++k) {
        const int mirrored = rings - 1 - k;
        const int below = k < mirrored ? k : mirrored;
        const Real at = outline.at(2 * below + 1, rings, &ring.across);
        Angle latitude = 0x80000000u + static_cast<uint32_t>(2 * below + 1) * step;
        if (stretched())
            latitude = 0x80000000u + 2 * quarterTurn(at, radius() * PI);
        if (k == mirrored)
            latitude = 0;
        else if (k > mirrored)
            latitude = 0u - latitude;
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        if (k > mirrored) {
            root -= ringMaker.seedsOf(ring);
            ringMaker.addSeeds(ring, k, root);
        } else {
            ringMaker.addRoots(ring);
            ringMaker.addSeeds(ring, k, root);
            if (k < mirrored)
                root += ringMaker.seedsOf(ring);
        }
    }
}

void Torus::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, axis().x, axis().y, axis().z, ring(), this->size()};
    describeAs("torus", numbers, 8, to, size);
}
