// Seeds on a disc: rings out along the lower face, round the rim, and back along the upper face.
#include "model/disc.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

Disc::Disc(int number, Real size, Real discRadius)
    : SoftObject(number, size), disc_(most(discRadius, Real(0))), discMade_(disc_), sizeMade_(size),
      axis_{Real(0), Real(1), Real(0)}
{
}

void Disc::placeCore()
{
    disc_ = discMade_ * (size() / sizeMade_);
    axis_ = {turn().m[0][1], turn().m[1][1], turn().m[2][1]};
}

Vector Disc::fromCore(const Point& p) const
{
    const Vector v = p - centre();
    const Vector upright = axis_ * dot(v, axis_);
    const Vector across = v - upright;
    const Real away = lengthQuick(across);
    return away <= disc_ ? upright : upright + across * ((away - disc_) / away);
}

Real Disc::horizonRadius(const Point& eye) const
{
    // Seen from above the edge is the rim; from the side the faces are, and they do not bend at all.
    const Real above = squaredCosine(eye - centre(), axis_);
    const Real flattest = radius() + shiftUp(disc_, 1);
    return above * flattest <= radius() ? flattest : radius() / above;
}

void Disc::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    // The lower half of the outline: the face, and a quarter circle of the rim.
    const Real rim = radius() * HALF_PI;
    const Real half = disc_ + rim;
    const int rings = stepsIn(half, shiftDown(spacing, 1));
    Ring ring{};
    ring.radius = radius();
    ring.across = portion(half, 1, rings);
    int root = 0;
    // Ring k and the one as far from the end mirror each other in the plane of the core, and share their roots.
    for (int k = 0; k < rings; ++k) {
        const int mirrored = rings - 1 - k;
        const int below = k < mirrored ? k : mirrored;
        const Real at = portion(half, 2 * below + 1, rings);
        Angle latitude = 0xc0000000u;
        ring.core = disc_;
        if (at < disc_)
            ring.core = at;
        else
            latitude += quarterTurn(least(at - disc_, rim), rim);
        if (k == mirrored)
            latitude = 0;
        else if (k > mirrored)
            latitude = 0u - latitude;
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        const int roots = ring.core == Real(0) ? 1 : seedsOf(ring, spacing);
        if (k > mirrored) {
            root -= roots;
            addSeeds(maker, ring, spacing, root);
        } else {
            addRoots(maker, ring, spacing);
            addSeeds(maker, ring, spacing, root);
            if (k < mirrored)
                root += roots;
        }
    }
}

void Disc::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, axis_.x, axis_.y, axis_.z, disc_, this->size()};
    describeAs("disc", numbers, 8, to, size);
}
