// Seeds on a torus: rings about its axis, one beside the other round the tube.
#include "model/torus.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

Torus::Torus(int number, Real size, Real ring)
    : SoftObject(number, size), ring_(most(ring, leastRing(size))), ringMade_(ring_), sizeMade_(size),
      axis_{Real(0), Real(1), Real(0)}
{
}

void Torus::placeCore()
{
    ring_ = ringMade_ * (size() / sizeMade_);
    axis_ = {turn().m[0][1], turn().m[1][1], turn().m[2][1]};
}

Vector Torus::fromCore(const Point& p) const
{
    const Vector v = p - centre();
    const Vector upright = axis_ * dot(v, axis_);
    const Vector across = v - upright;
    const Real away = lengthQuick(across);
    // Close to the axis a direction has few bits and is made square to it with care; on it all of the circle is equally
    // near, and any direction serves.
    if (away < Real(1)) {
        Vector out = unit(across);
        if (out == Vector{Real(0), Real(0), Real(0)})
            out = {turn().m[0][0], turn().m[1][0], turn().m[2][0]};
        out = out - axis_ * dot(out, axis_);
        return upright + (across - withLength(out, ring_));
    }
    return upright + across * ((away - ring_) / away);
}

Real Torus::horizonRadius(const Point& eye) const
{
    // Seen from above the edge is that of the tube; from the side it is partly the top, which bends as the ring does.
    return radius() + ring_ * (Real(1) - squaredCosine(eye - centre(), axis_));
}

void Torus::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    const int rings = stepsIn(radius() * PI, shiftDown(spacing, 1));
    Ring ring{};
    ring.core = ring_;
    ring.radius = radius();
    ring.across = portion(radius() * PI, 1, rings);
    // From the inside of the hole, below, out and up and in again. Ring k and the one as far from the end mirror each
    // other in the plane of the core, and share their roots.
    const uint32_t step = 0x80000000u / static_cast<uint32_t>(rings);
    int root = 0;
    for (int k = 0; k < rings; ++k) {
        const int mirrored = rings - 1 - k;
        const int below = k < mirrored ? k : mirrored;
        Angle latitude = 0x80000000u + static_cast<uint32_t>(2 * below + 1) * step;
        if (k == mirrored)
            latitude = 0;
        else if (k > mirrored)
            latitude = 0u - latitude;
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        if (k > mirrored) {
            root -= seedsOf(ring, spacing);
            addSeeds(maker, ring, spacing, root);
        } else {
            addRoots(maker, ring, spacing);
            addSeeds(maker, ring, spacing, root);
            if (k < mirrored)
                root += seedsOf(ring, spacing);
        }
    }
}

void Torus::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, axis_.x, axis_.y, axis_.z, ring_, this->size()};
    describeAs("torus", numbers, 8, to, size);
}
