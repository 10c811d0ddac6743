// Seeds on a cone with round ends: rings up its outline. Paths are square to the core, not to the slanting side: along
// them the own field is the same polynomial of the position as everywhere.
#include "model/cone.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

Cone::Cone(int number, Real size1, Real size2, Real length)
    : SoftObject(number, most(size1, size2), true), size1_(size1), size2_(size2),
      half_(shiftDown(most(length, leastLength(size1, size2)), 1)), mean_(size1), taper_(0), normalSine_(0), normalCosine_(1),
      size1Made_(size1), size2Made_(size2), halfMade_(half_), sizeMade_(most(size1, size2)),
      axis_{Real(0), Real(1), Real(0)}
{
    const Real wide = shiftDown(size1 - size2, 1);
    const Vector side = unit({wide, shiftUp(half_, 1), Real(0)});
    if (side.y > Real(0)) {
        normalSine_ = side.x;
        normalCosine_ = side.y;
    }
    placeCore();
}

void Cone::placeCore()
{
    const Real scale = size() / sizeMade_;
    half_ = halfMade_ * scale;
    size1_ = size1Made_ * scale;
    size2_ = size2Made_ * scale;
    mean_ = shiftDown(size1_ + size2_, 1);
    taper_ = halfMade_ > Real(0) ? shiftDown(size2Made_ - size1Made_, 1) / halfMade_ : Real(0);
    axis_ = {turn().m[0][1], turn().m[1][1], turn().m[2][1]};
}

Vector Cone::fromCore(const Point& p) const
{
    return p - centre() - axis_ * along(p);
}

Real Cone::sizeAt(const Point& p) const
{
    return sizeAlong(along(p));
}

Real Cone::tangentAt(const Point& root) const
{
    const Real s = along(root), local = shiftDown(sizeAlong(s), 1);
    // The roots of the ends have round caps.
    return absolute(s) < half_ - Real(0.01) ? local * normalCosine_ : local;
}

// t = d^2 / R^2 with the size R at the nearest point of the core: half its gradient is d / R^2 - axis d^2 taper / R^3,
// the second part on the side only.
Real Cone::taperedParam(const Point& p, Vector* slope) const
{
    const Vector v = p - centre();
    const Real s = dot(v, axis_), on = clamp(s, -half_, half_);
    const Vector d = v - axis_ * on;
    const Real local = sizeAlong(on);
    if (absolute(d.x) >= local || absolute(d.y) >= local || absolute(d.z) >= local) {
        *slope = d;
        return Real(1);
    }
    const Vector q = d * (Real(16) / local);
    const Real t = shiftDown(dot(q, q), 8);
    const Real larger = size() / local;
    Vector w = d;
    if (s == on)
        w = w - axis_ * (t * local * taper_);
    *slope = w * (larger * larger);
    return t;
}

Real Cone::horizonRadius(const Point& eye) const
{
    const Real across = Real(1) - squaredCosine(eye - centre(), axis_);
    const Real flattest = size() + length();
    return across * flattest <= radius() ? flattest : radius() / across;
}

Real Cone::horizonAt(const Point& root, Real general) const
{
    const Real s = along(root);
    return absolute(s) < half_ - Real(0.01) ? general : shiftDown(sizeAlong(s), 1);
}

void Cone::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    const Real radius1 = shiftDown(size1_, 1), radius2 = shiftDown(size2_, 1);
    const Real cap1 = radius1 * HALF_PI, cap2 = radius2 * HALF_PI;
    const Real side = ::length({radius1 - radius2, length(), Real(0)});
    const Real outline = cap1 + side + cap2;
    const int rings = stepsIn(outline, spacing);
    Ring ring{};
    ring.across = portion(outline, 1, 2 * rings);
    int root1 = -1, root2 = -1;
    for (int k = 0; k < rings; ++k) {
        const Real at = portion(outline, 2 * k + 1, 2 * rings);
        Angle latitude = 0;
        int* shared = nullptr;
        if (at < cap1) {
            latitude = quarterTurn(at, cap1) - 0x40000000u;
            ring.height = -half_;
            ring.radius = radius1;
            shared = &root1;
        } else if (at < cap1 + side) {
            const Real share = (at - cap1) / side;
            ring.height = length() * share - half_;
            ring.radius = shiftDown(sizeAlong(ring.height), 1);
        } else {
            latitude = quarterTurn(least(at - cap1 - side, cap2), cap2);
            ring.height = half_;
            ring.radius = radius2;
            shared = &root2;
        }
        ring.pathSine = ring.normalSine = sine(latitude);
        ring.pathCosine = ring.normalCosine = cosine(latitude);
        if (shared == nullptr) {
            ring.normalSine = normalSine_;
            ring.normalCosine = normalCosine_;
        }
        int root = shared == nullptr ? -1 : *shared;
        if (root < 0)
            root = addRoots(maker, ring, spacing);
        if (shared != nullptr)
            *shared = root;
        maker.restAt(ring.radius);
        addSeeds(maker, ring, spacing, root);
    }
}

void Cone::describe(char* to, int size) const
{
    const Point a = centre() - axis_ * half_, b = centre() + axis_ * half_;
    const Real numbers[] = {a.x, a.y, a.z, size1_, b.x, b.y, b.z, size2_};
    describeAs("cone", numbers, 8, to, size);
}
