// Seeds on a torus: rings about its axis that lie beside each other round the tube.
#include "model/torus.h"

#include "model/round.h"

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
    return flatParam(q, slope, [&] { return fromCircle(q, coreReach16()); });
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
    // The rings go from the hole along the lower half outwards and along the upper half back.
    const uint32_t step = 0x80000000u / static_cast<uint32_t>(rings);
    for (int k = 0; k < rings; ++k) {
        const int mirrored = rings - 1 - k, below = k < mirrored ? k : mirrored;
        const Real at = outline.at(2 * below + 1, rings, &ring.halfStep);
        const Angle turn = stretched() ? 2 * quarterTurn(at, radius() * PI) : static_cast<uint32_t>(2 * below + 1) * step;
        ringMaker.addMirrored(ring, k, rings, 0x80000000u + turn);
    }
}

void Torus::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, axis().x, axis().y, axis().z, ring(), this->size()};
    describeAs("torus", numbers, 8, to, size);
}
