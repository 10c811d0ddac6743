// Seeds on a cylinder with round ends: rings up its outline, from pole to pole.
#include "model/cylinder.h"

#include "model/round.h"

Cylinder::Cylinder(int number, Real size, Real length) : SoftObject(number, size, shiftDown(max(length, Real(0)), 1)) {}

Vector Cylinder::fromCore(const Vector& q) const
{
    return {q.x, q.y - clamp(q.y, -coreReach16(), coreReach16()), q.z};
}

void Cylinder::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    layOutCapsule(maker, stretch(), radius(), coreReach(), spacing);
}

void Cylinder::describe(char* to, int size) const
{
    const Point a = centre() - axis() * coreReach(), b = centre() + axis() * coreReach();
    const Real numbers[] = {a.x, a.y, a.z, b.x, b.y, b.z, this->size()};
    describeAs("cylinder", numbers, 7, to, size);
}
