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
    bool face;                  // it lies on a face square to y, where that way is one of the stretched object
    int number;
    Real spacing;
};

// Adds rings. Seeds that follow each other above the same point of the core share a root.
class LoopMaker {
public:
    LoopMaker(SeedMaker& maker, const SoftObject& object)
        : maker_(maker), stretch_(object.stretch()), stretched_(object.stretched()), quarter_(object.stretch())
    {
    }

    // Four sides, each from one corner's diagonal to the next, so that corners of all rings lie above each other. Round a
    // plate, where no ring has sharp corners, the seeds are spaced evenly all the way.
    void make(const Loop& loop)
    {
        loop_ = loop;
        const Real round = loop.radius * loop.pathCosine;
        if (stretched_) {
            // A corner's way from a side that looks to x to the diagonal, and from there on.
            const Real toDiagonal = quarter_.wayTo(0x20000000u);
            arcs_[1] = round * toDiagonal;
            arcs_[0] = round * (quarter_.length() - toDiagonal);
        } else {
            arcs_[0] = arcs_[1] = shiftDown(round * HALF_PI, 1);
        }
        arc_ = stretched_ ? arcs_[0] + arcs_[1] : round * HALF_PI;
        begun_ = false;
        if (loop_.x == Real(0) || loop_.z == Real(0)) {
            const Real around = shiftUp(edgeOf(0) + edgeOf(1), 1) + shiftUp(arc_, 2);
            const int count = countOf(around, FEWEST_IN_RING);
            for (int i = 0; i < count; ++i) {
                Real at = portion(around, i, count);
                int side = 0;
                for (; side < 3 && at >= lengthOf(side); ++side)
                    at -= lengthOf(side);
                add(side, at, portion(around, 1, 2 * count), false);
            }
            return;
        }
        for (int side = 0; side < 4; ++side) {
            const Real length = lengthOf(side);
            const int count = countOf(length, 1);
            for (int i = 0; i < count; ++i)
                add(side, portion(length, i, count), portion(length, 1, 2 * count), i == 0);
        }
    }

private:
    SeedMaker& maker_;
    Vector stretch_;
    bool stretched_;
    Quarter quarter_;
    Loop loop_{};
    Real arc_{0};              // length of a round corner, as stretched,
    Real arcs_[2] = {Real(0), Real(0)};  // of its half beside a side that looks to x, and to z
    bool begun_ = false;
    Vector root_{Real(0), Real(0), Real(0)};
    int rootIndex_ = -1;

    // The straight part of a side, as stretched.
    Real edgeOf(int side) const
    {
        const Real edge = shiftUp((side & 1) == 0 ? loop_.z : loop_.x, 1);
        return stretched_ ? edge * ((side & 1) == 0 ? stretch_.z : stretch_.x) : edge;
    }
    // All of it, from diagonal to diagonal.
    Real lengthOf(int side) const { return stretched_ ? edgeOf(side) + shiftUp(arcs_[side & 1], 1) : edgeOf(side) + arc_; }

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

    // The number of the root at a place, which the seed that follows gets: that of the seed before, or a new one. With the first
    // seed the ring begins.
    int rootFor(const Vector& place)
    {
        if (!begun_)
            maker_.beginRing();
        begun_ = true;
        if (rootIndex_ < 0 || !(place == root_)) {
            root_ = place;
            rootIndex_ = maker_.addRoot(place);
        }
        return rootIndex_;
    }

    // The seed `at` units along a side, with half the way to the next.
    void add(int side, Real at, Real half, bool corner)
    {
        const Real edge = edgeOf(side);
        const Real halfArc = stretched_ ? arcs_[side & 1] : shiftDown(arc_, 1);
        const Real factor = (side & 1) == 0 ? stretch_.z : stretch_.x;
        const Real halfEdge = (side & 1) == 0 ? loop_.z : loop_.x;
        const Real out = (side & 1) == 0 ? loop_.x : loop_.z;
        // From the side's outward direction to the seed's, within the half plane of constant y.
        Real s(0), c(1), along;
        if (corner) {
            s = c = ROOT_HALF;
            along = halfEdge;
        } else if (at < halfArc) {
            turned(side, halfArc - at, &s, &c);
            along = halfEdge;
        } else if (at <= halfArc + edge) {
            along = stretched_ ? halfEdge - (at - halfArc) / factor : halfEdge - (at - halfArc);
        } else {
            turned(side, at - halfArc - edge, &s, &c);
            s = -s;
            along = -halfEdge;
        }
        if (stretched_) {
            addStretched(side, {c, Real(0), s}, {out, loop_.height, along}, half);
            return;
        }
        const Vector root = onSide(side, {out, loop_.height, along});
        const bool sharp = corner && arc_ < loop_.spacing;
        const Real wide = sharp ? half * CORNER_PART : half;
        const Real high = sharp ? loop_.across * CORNER_PART : loop_.across;
        const Real inward = -(high * loop_.pathSine);
        maker_.addSeed(rootFor(root), onSide(side, {loop_.pathCosine * c, loop_.pathSine, loop_.pathCosine * s}),
                       onSide(side, {wide * s, Real(0), -(wide * c)}),
                       onSide(side, {inward * c, high * loop_.pathCosine, inward * s}));
    }

    // The same on a stretched box, whose seeds lie evenly by the way on the stretched surface; `towards` and `from`: the seed's
    // direction in the plane of constant y, and its root, for side 0.
    void addStretched(int side, const Vector& towards, const Vector& from, Real half)
    {
        const Vector root = onSide(side, from), out = onSide(side, towards), round = onSide(side, {towards.z, Real(0), -towards.x});
        Vector across{-(out.x * loop_.across * loop_.pathSine), loop_.across * loop_.pathCosine,
                      -(out.z * loop_.across * loop_.pathSine)};
        if (loop_.face) {
            across.x = across.x / stretch_.x;
            across.z = across.z / stretch_.z;
        } else {
            const Real step = stretchedStep(shiftUp(loop_.across, 1), stretch_, loop_.pathSine, loop_.pathCosine, out.x, out.z);
            const int level = thinning(step, loop_.spacing);
            if (thinned(loop_.number, level))
                return;
            across = {shiftUp(across.x, level), shiftUp(across.y, level), shiftUp(across.z, level)};
        }
        const Real along = half / length({round.x * stretch_.x, Real(0), round.z * stretch_.z});
        maker_.addSeed(rootFor(root), {out.x * loop_.pathCosine, loop_.pathSine, out.z * loop_.pathCosine}, round * along, across);
    }

    // Sine and cosine of an angle that is `length` units of a round corner beside a side.
    void turned(int side, Real length, Real* s, Real* c) const
    {
        if (stretched_) {
            // Longitudes count from z; the angle, from where the side looks to.
            const Real way = length / (loop_.radius * loop_.pathCosine);
            const Angle on = (side & 1) == 0 ? 0x40000000u - quarter_.longitude(quarter_.length() - way) : quarter_.longitude(way);
            *s = sine(on);
            *c = cosine(on);
            return;
        }
        const Angle angle = quarterTurn(min(length, arc_), arc_);
        *s = sine(angle);
        *c = cosine(angle);
    }
};

}  // namespace

Box::Box(int number, Real size, Real x, Real y, Real z)
    : SoftObject(number, size,
                 length({shiftDown(max(x, Real(0)), 1), shiftDown(max(y, Real(0)), 1), shiftDown(max(z, Real(0)), 1)})),
      halfMade_{shiftDown(max(x, Real(0)), 1), shiftDown(max(y, Real(0)), 1), shiftDown(max(z, Real(0)), 1)}
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
    // A stretched face is gone over in steps of the stretched object.
    const Vector wide = stretchedOut(h);
    const Real face = min(wide.x, wide.z), round = radius() * HALF_PI, side = shiftUp(h.y, 1);
    const Real whole = shiftUp(face + round, 1) + side;
    Outline outline(stretch());
    outline.plain(face);
    outline.arc(round, 0xc0000000u, 0);
    outline.line(side, Real(0), Real(1));
    outline.arc(round, 0, 0x40000000u);
    outline.plain(face);
    const int rings = stepsIn(outline.length(), spacing);
    Loop loop{};
    loop.radius = radius();
    loop.spacing = spacing;
    LoopMaker loops(maker, *this);
    for (int k = 0; k < rings; ++k) {
        const Real at = outline.at(2 * k + 1, 2 * rings, &loop.across);
        const bool upper = at > shiftDown(whole, 1);
        const Real fromPole = upper ? whole - at : at;
        Real height = h.y;
        Vector inset{Real(0), Real(0), Real(0)};
        Angle latitude = 0;
        if (fromPole < face) {
            const Real in = face - fromPole;
            inset = stretched() ? Vector{in / stretch().x, Real(0), in / stretch().z} : Vector{in, Real(0), in};
            latitude = 0x40000000u;
        } else if (fromPole < face + round) {
            latitude = 0x40000000u - quarterTurn(fromPole - face, round);
        } else {
            height = h.y - (fromPole - face - round);
        }
        loop.x = max(h.x - inset.x, Real(0));
        loop.z = max(h.z - inset.z, Real(0));
        loop.face = fromPole < face;
        loop.number = k;
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
    const Real numbers[] = {centre().x, centre().y, centre().z,      m.m[0][0],       m.m[1][0],       m.m[2][0],   axis().x,
                            axis().y,   axis().z,   shiftUp(h.x, 1), shiftUp(h.y, 1), shiftUp(h.z, 1), this->size()};
    describeAs("box", numbers, 13, to, size);
}
