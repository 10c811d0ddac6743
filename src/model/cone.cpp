// Seeds on a cone with round ends: rings from one end of its outline to the other. Paths are perpendicular to the core, not to
// the slanting side, so that along a path the own field is the same polynomial of the position as in every other primitive.
#include "model/cone.h"

#include "model/round.h"

Cone::Cone(int number, Real size1, Real size2, Real length)
    : SoftObject(number, max(size1, size2), shiftDown(max(length, leastLength(size1, size2)), 1), true),
      size1Made_(size1), size2Made_(size2), lengthMade_(this->length()), mean16_(0), taper_(0)
{
    mean16_ = shiftDown(size1 + size2, 1) * (Real(CORE_SIZE) / size());
    taper_ = coreReach() > Real(0) ? shiftDown(size2 - size1, 1) / coreReach() : Real(0);
}

Vector Cone::fromCore(const Vector& q) const
{
    return {q.x, q.y - clamp(q.y, -coreReach16(), coreReach16()), q.z};
}

// t = d^2 / R^2, with d the vector from the core's nearest point and R the size there. Half its gradient is d / R^2 - axis d^2
// taper / R^3; the second term exists on the side only, not on the ends.
Real Cone::plainParam(const Vector& q, Vector* slope) const
{
    const Real on = clamp(q.y, -coreReach16(), coreReach16());
    const Vector d{q.x, q.y - on, q.z};
    const Real local = size16Along(on);
    *slope = d;
    if (absolute(d.x) >= local || absolute(d.y) >= local || absolute(d.z) >= local)
        return Real(1);
    const Real larger = Real(CORE_SIZE) / local;
    const Vector v = d * larger;
    const Real t = shiftDown(dot(v, v), 8);
    if (q.y == on)
        slope->y = -(t * local * taper_);
    *slope = *slope * (larger * larger);
    return t;
}

// The outline has a corner where each end meets the side. Each of the three parts is divided into equal steps of its own, so that
// no cell reaches across a corner.
void Cone::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    enum Part { END1, SIDE, END2, PARTS };
    const Real radius1 = size1() * restRoot(), radius2 = size2() * restRoot();
    const Vector normal = unit({(size1Made_ - size2Made_) * restRoot(), lengthMade_, Real(0)});
    const Real lengths[PARTS] = {radius1 * HALF_PI, ::length({radius1 - radius2, length(), Real(0)}), radius2 * HALF_PI};
    // Seeds are closer where the cone is thin. On a stretched one they would become too uneven.
    const bool plain = stretch() == Vector{Real(1), Real(1), Real(1)};
    const Real toThickest = spacing / closeness(radius());
    const auto spacingAt = [&](Real thick) { return plain ? toThickest * closeness(thick) : spacing; };
    RingMaker ringMaker(maker, stretch(), spacing);
    Ring ring{};
    int number = 0;
    for (int part = END1; part < PARTS; ++part) {
        // The values of an end; on the side they change from ring to ring.
        const Angle start = part == END1 ? 0u - QUARTER : 0;
        ring.height = part == END1 ? -coreReach() : coreReach();
        ring.radius = part == END1 ? radius1 : radius2;
        Outline outline(stretch());
        if (part == SIDE)
            outline.line(lengths[part], normal.x, normal.y);
        else
            outline.arc(lengths[part], start, start + QUARTER);
        const int rings = stepsIn(outline.length(), part == SIDE ? spacing : spacingAt(ring.radius));
        int root = -1;
        for (int k = 0; k < rings; ++k) {
            const Real at = outline.at(2 * k + 1, 2 * rings, &ring.halfStep);
            if (part == SIDE) {
                ring.height = length() * (at / lengths[part]) - coreReach();
                ring.radius = sizeAlong(ring.height) * restRoot();
                ring.pathSine = Real(0);
                ring.pathCosine = Real(1);
                ring.normalSine = normal.x;
                ring.normalCosine = normal.y;
            } else {
                const Angle latitude = start + quarterTurn(min(at, lengths[part]), lengths[part]);
                ring.pathSine = ring.normalSine = sine(latitude);
                ring.pathCosine = ring.normalCosine = cosine(latitude);
            }
            ringMaker.setSpacing(spacingAt(ring.radius));
            // All seeds of an end have a common root.
            if (part == SIDE || root < 0)
                root = ringMaker.addRoots(ring);
            maker.restAt(ring.radius);
            ringMaker.addSeeds(ring, number++, root);
        }
    }
}

void Cone::describe(char* to, int size) const
{
    const Point a = centre() - axis() * coreReach(), b = centre() + axis() * coreReach();
    const Real numbers[] = {a.x, a.y, a.z, size1(), b.x, b.y, b.z, size2()};
    describeAs("cone", numbers, 8, to, size);
}
