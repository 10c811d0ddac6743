// Seeds on a cylinder with round ends: rings up its outline, from pole to pole.
#include "model/cylinder.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

Cylinder::Cylinder(int number, Real size, Real length) : SoftObject(number, size, shiftDown(most(length, Real(0)), 1)) {}

Vector Cylinder::fromCore(const Vector& q) const
{
    return {q.x, q.y - clamp(q.y, -coreReach16(), coreReach16()), q.z};
}

void Cylinder::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    // The outline: a quarter circle, the side, a quarter circle. The rings lie in the middles of equal parts of it.
    const Real cap = radius() * HALF_PI, body = length();
    const Real outline = shiftUp(cap, 1) + body;
    const int rings = stepsIn(outline, spacing);
    Ring ring{};
    ring.radius = radius();
    ring.across = portion(outline, 1, 2 * rings);
    int bottom = -1, top = -1;
    for (int k = 0; k < rings; ++k) {
        const Real at = portion(outline, 2 * k + 1, 2 * rings);
        Angle latitude = 0;
        int* shared = nullptr;
        if (at < cap) {
            latitude = quarterTurn(at, cap) - 0x40000000u;
            ring.height = -coreReach();
            shared = &bottom;
        } else if (at < cap + body) {
            ring.height = at - cap - coreReach();
        } else {
            latitude = quarterTurn(least(at - cap - body, cap), cap);
            ring.height = coreReach();
            shared = &top;
        }
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        // "In the case of cylinders, all seeds in each end cap have a common root."
        int root = shared == nullptr ? -1 : *shared;
        if (root < 0)
            root = addRoots(maker, ring, spacing);
        if (shared != nullptr)
            *shared = root;
        addSeeds(maker, ring, spacing, root);
    }
}

void Cylinder::describe(char* to, int size) const
{
    const Point a = centre() - axis() * coreReach(), b = centre() + axis() * coreReach();
    const Real numbers[] = {a.x, a.y, a.z, b.x, b.y, b.z, this->size()};
    describeAs("cylinder", numbers, 7, to, size);
}
