// Seeds on a disc: rings outwards along the lower face, round the rim, and inwards along the upper face.
#include "model/disc.h"

#include "model/round.h"

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
    return flatParam(q, slope, [&] { return fromPlate(q, coreReach16()); });
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
    for (int k = 0; k < rings; ++k) {
        const int mirrored = rings - 1 - k, below = k < mirrored ? k : mirrored;
        const Real at = outline.at(2 * below + 1, rings, &ring.halfStep);
        const bool onFace = at < discRadius();
        ring.core = onFace ? at : discRadius();
        ringMaker.addMirrored(ring, k, rings, (onFace ? 0 : quarterTurn(min(at - discRadius(), rim), rim)) - QUARTER);
    }
}

void Disc::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, axis().x, axis().y, axis().z, discRadius(), this->size()};
    describeAs("disc", numbers, 8, to, size);
}
