// Seeds on a box: rings round its y axis, from the middle of the lower face out, up the sides, and in along the upper face.
#include "model/box.h"

#include "rt.h"
#include "model/round.h"
#include "math/text.h"

namespace {

constexpr int FEWEST_IN_RING = 4;
constexpr Real ROOT_HALF(0.70710678);

// A seed on the diagonal of a ring with sharp corners has a part of the surface that reaches into the corner.
constexpr Real CORNER_PART(1.4142136);

// A ring of seeds: a rectangle in a plane of constant y, with round corners.
struct Loop {
    Real x, z;                  // half edges of the rectangle on which its roots lie
    Real height;                // y of its roots
    Real radius;                // of the object
    Real pathSine, pathCosine;  // latitude of the paths
    Real across;                // half way to the next ring, along the surface
    Real spacing;
};

// Adds rings. Seeds that follow each other above the same point of the core share a root.
class LoopMaker {
public:
    explicit LoopMaker(SeedMaker& maker) : maker_(maker) {}

    // Four sides, each from one corner's diagonal to the next, so that corners of all rings lie above each other. Round a
    // plate, where no ring has sharp corners, the seeds are spaced evenly all the way.
    void make(const Loop& loop)
    {
        loop_ = loop;
        arc_ = loop.radius * loop.pathCosine * HALF_PI;
        maker_.beginRing();
        if (loop_.x == Real(0) || loop_.z == Real(0)) {
            const Real around = shiftUp(edgeOf(0) + edgeOf(1), 1) + shiftUp(arc_, 2);
            const int count = countOf(around, FEWEST_IN_RING);
            for (int i = 0; i < count; ++i) {
                Real at = portion(around, i, count);
                int side = 0;
                for (; side < 3 && at >= edgeOf(side) + arc_; ++side)
                    at -= edgeOf(side) + arc_;
                add(side, at, portion(around, 1, 2 * count), false);
            }
            return;
        }
        for (int side = 0; side < 4; ++side) {
            const Real length = edgeOf(side) + arc_;
            const int count = countOf(length, 1);
            for (int i = 0; i < count; ++i)
                add(side, portion(length, i, count), portion(length, 1, 2 * count), i == 0);
        }
    }

private:
    SeedMaker& maker_;
    Loop loop_{};
    Real arc_{0};  // length of a round corner
    Vector root_{Real(0), Real(0), Real(0)};
    int rootIndex_ = -1;

    // The straight part of a side.
    Real edgeOf(int side) const { return shiftUp((side & 1) == 0 ? loop_.z : loop_.x, 1); }

    // The number of steps whose length is nearest to the spacing.
    int countOf(Real length, int fewest) const
    {
        const int count = floorToInt(length / loop_.spacing + Real(0.5));
        return count < fewest ? fewest : count;
    }

    // A vector of side 0, which looks to +x and runs to -z, as it lies on another side: a quarter turn each.
    static Vector onSide(int side, const Vector& v)
    {
        switch (side) {
        case 0: return v;
        case 1: return {v.z, v.y, -v.x};
        case 2: return {-v.x, v.y, -v.z};
        default: return {-v.z, v.y, v.x};
        }
    }

    // The seed `at` units along a side, with half the way to the next.
    void add(int side, Real at, Real half, bool corner)
    {
        const Real edge = edgeOf(side);
        const Real halfArc = shiftDown(arc_, 1), halfEdge = shiftDown(edge, 1);
        const Real out = (side & 1) == 0 ? loop_.x : loop_.z;
        // From the side's outward direction to the seed's, within the half plane of constant y.
        Real s(0), c(1), along;
        if (corner) {
            s = c = ROOT_HALF;
            along = halfEdge;
        } else if (at < halfArc) {
            turned(halfArc - at, &s, &c);
            along = halfEdge;
        } else if (at <= halfArc + edge) {
            along = halfEdge - (at - halfArc);
        } else {
            turned(at - halfArc - edge, &s, &c);
            s = -s;
            along = -halfEdge;
        }
        const Vector root = onSide(side, {out, loop_.height, along});
        if (rootIndex_ < 0 || !(root == root_)) {
            root_ = root;
            rootIndex_ = maker_.addRoot(root);
        }
        const bool sharp = corner && arc_ < loop_.spacing;
        const Real wide = sharp ? half * CORNER_PART : half;
        const Real high = sharp ? loop_.across * CORNER_PART : loop_.across;
        const Real inward = -(high * loop_.pathSine);
        maker_.addSeed(rootIndex_, onSide(side, {loop_.pathCosine * c, loop_.pathSine, loop_.pathCosine * s}),
                       onSide(side, {wide * s, Real(0), -(wide * c)}),
                       onSide(side, {inward * c, high * loop_.pathCosine, inward * s}));
    }

    // Sine and cosine of an angle that is `length` units of a round corner.
    void turned(Real length, Real* s, Real* c) const
    {
        const Angle angle = quarterTurn(least(length, arc_), arc_);
        *s = sine(angle);
        *c = cosine(angle);
    }
};

}  // namespace

Box::Box(int number, Real size, Real x, Real y, Real z)
    : SoftObject(number, size,
                 length({shiftDown(most(x, Real(0)), 1), shiftDown(most(y, Real(0)), 1), shiftDown(most(z, Real(0)), 1)})),
      halfMade_{shiftDown(most(x, Real(0)), 1), shiftDown(most(y, Real(0)), 1), shiftDown(most(z, Real(0)), 1)}
{
    const Real toCore = Real(CORE_SIZE) / this->size();
    half16_ = halfMade_ * toCore;
}

Vector Box::fromCore(const Vector& q) const
{
    return {q.x - clamp(q.x, -half16_.x, half16_.x), q.y - clamp(q.y, -half16_.y, half16_.y),
            q.z - clamp(q.z, -half16_.z, half16_.z)};
}

void Box::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    // The outline: half of the lower face's narrower way, a quarter circle, the side, and back. The rings lie in the middles
    // of equal parts of it.
    const Vector h = half();
    const Real face = least(h.x, h.z), round = radius() * HALF_PI, side = shiftUp(h.y, 1);
    const Real outline = shiftUp(face + round, 1) + side;
    const int rings = stepsIn(outline, spacing);
    Loop loop{};
    loop.radius = radius();
    loop.across = portion(outline, 1, 2 * rings);
    loop.spacing = spacing;
    LoopMaker loops(maker);
    for (int k = 0; k < rings; ++k) {
        const Real at = portion(outline, 2 * k + 1, 2 * rings);
        const bool upper = at > shiftDown(outline, 1);
        const Real fromPole = upper ? outline - at : at;
        Real inset(0), height = h.y;
        Angle latitude = 0;
        if (fromPole < face) {
            inset = face - fromPole;
            latitude = 0x40000000u;
        } else if (fromPole < face + round) {
            latitude = 0x40000000u - quarterTurn(fromPole - face, round);
        } else {
            height = h.y - (fromPole - face - round);
        }
        loop.x = h.x - inset;
        loop.z = h.z - inset;
        loop.height = upper ? height : -height;
        loop.pathSine = upper ? sine(latitude) : -sine(latitude);
        loop.pathCosine = cosine(latitude);
        loops.make(loop);
    }
}

void Box::describe(char* to, int size) const
{
    const Matrix& m = turn();
    const Vector h = half();
    const Real numbers[] = {centre().x,      centre().y,      centre().z,      m.m[0][0], m.m[1][0], m.m[2][0],   axis().x, axis().y,
                            axis().z,        shiftUp(h.x, 1), shiftUp(h.y, 1), shiftUp(h.z, 1),      this->size()};
    describeAs("box", numbers, 13, to, size);
}
