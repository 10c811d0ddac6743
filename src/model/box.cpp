// Seeds on a box: rings round its y axis, from the middle of the lower face outwards, up the sides, and inwards along the upper
// face.
#include "model/box.h"

#include "model/round.h"

namespace {

constexpr int FEWEST_IN_RING = 4;
constexpr Real ROOT_HALF(0.70710678);

// A seed on the diagonal of a ring with sharp corners has a cell that reaches into the corner: its half axes grow by sqrt(2).
constexpr Real CORNER_PART(1.4142136);

// A ring of seeds: a rectangle in a plane of constant y, with round corners.
struct Loop {
    Real x, z;                  // half edges of the rectangle that carries its roots
    Real height;                // y of the roots
    Real radius;                // of the object
    Real pathSine, pathCosine;  // latitude of the paths
    Real halfStep;              // half the distance to the next ring along the surface
    bool face;                  // the ring is on a face perpendicular to y, where `halfStep` is measured on the stretched object
    int number;
    Real spacing;
};

// Adds rings. Consecutive seeds above the same point of the core share a root.
class LoopMaker {
public:
    LoopMaker(SeedMaker& maker, const SoftObject& object)
        : maker_(maker), stretch_(object.stretch()), stretched_(object.stretched()), quarter_(object.stretch())
    {
    }

    // Adds a ring of four sides, each from one corner's diagonal to the next, so that the corners of all rings lie above each
    // other. Where the core is a plate or less and no ring has sharp corners, the seeds are evenly spaced all the way round
    // instead.
    void make(const Loop& loop)
    {
        loop_ = loop;
        const Real round = loop.radius * loop.pathCosine;
        if (stretched_) {
            // Arc lengths of a round corner: from a side that looks towards x to the diagonal, and from there on.
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
    Real arc_{0};              // length of a round corner, stretched
    Real arcs_[2] = {Real(0), Real(0)};  // its half beside a side that looks towards x, and towards z
    bool begun_ = false;
    Vector root_{Real(0), Real(0), Real(0)};
    int rootIndex_ = -1;

    // Length of the straight part of a side, stretched.
    Real edgeOf(int side) const
    {
        const Real edge = shiftUp((side & 1) == 0 ? loop_.z : loop_.x, 1);
        return stretched_ ? edge * ((side & 1) == 0 ? stretch_.z : stretch_.x) : edge;
    }
    // Length of a whole side, from diagonal to diagonal.
    Real lengthOf(int side) const { return stretched_ ? edgeOf(side) + shiftUp(arcs_[side & 1], 1) : edgeOf(side) + arc_; }

    // The number of equal steps whose length is nearest to the spacing.
    int countOf(Real length, int fewest) const
    {
        const int count = floorToInt(length / loop_.spacing + Real(0.5));
        return count < fewest ? fewest : count;
    }

    // Turns a vector of side 0, which looks towards +x and runs towards -z, to another side: a quarter turn for each.
    static Vector onSide(int side, const Vector& v)
    {
        switch (side) {
        case 0: return v;
        case 1: return {v.z, v.y, -v.x};
        case 2: return {-v.x, v.y, -v.z};
        default: return {-v.z, v.y, v.x};
        }
    }

    // Returns the index of the root at a place for the next seed: the previous seed's root if it is at the same place, else a
    // new one. Begins the ring with its first seed.
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

    // Adds the seed `at` units along a side; `half` is half the distance to the next seed.
    void add(int side, Real at, Real half, bool corner)
    {
        const Real edge = edgeOf(side);
        const Real halfArc = stretched_ ? arcs_[side & 1] : shiftDown(arc_, 1);
        const Real factor = (side & 1) == 0 ? stretch_.z : stretch_.x;
        const Real halfEdge = (side & 1) == 0 ? loop_.z : loop_.x;
        const Real out = (side & 1) == 0 ? loop_.x : loop_.z;
        // Sine and cosine of the angle from the side's outward direction to the seed's, in the plane of constant y.
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
        const Real high = sharp ? loop_.halfStep * CORNER_PART : loop_.halfStep;
        const Real inward = -(high * loop_.pathSine);
        maker_.addSeed(rootFor(root), onSide(side, {loop_.pathCosine * c, loop_.pathSine, loop_.pathCosine * s}),
                       onSide(side, {wide * s, Real(0), -(wide * c)}),
                       onSide(side, {inward * c, high * loop_.pathCosine, inward * s}));
    }

    // The same for a stretched box, whose seeds are evenly spaced on the stretched surface. `towards` is the seed's direction
    // in the plane of constant y and `from` its root, both as on side 0.
    void addStretched(int side, const Vector& towards, const Vector& from, Real half)
    {
        const Vector root = onSide(side, from), out = onSide(side, towards), round = onSide(side, {towards.z, Real(0), -towards.x});
        Vector across{-(out.x * loop_.halfStep * loop_.pathSine), loop_.halfStep * loop_.pathCosine,
                      -(out.z * loop_.halfStep * loop_.pathSine)};
        if (loop_.face) {
            across.x = across.x / stretch_.x;
            across.z = across.z / stretch_.z;
        } else {
            const Real step = stretchedStep(shiftUp(loop_.halfStep, 1), stretch_, loop_.pathSine, loop_.pathCosine, out.x, out.z);
            const int level = thinning(step, loop_.spacing);
            if (thinned(loop_.number, level))
                return;
            across = {shiftUp(across.x, level), shiftUp(across.y, level), shiftUp(across.z, level)};
        }
        const Real along = half / length({round.x * stretch_.x, Real(0), round.z * stretch_.z});
        maker_.addSeed(rootFor(root), {out.x * loop_.pathCosine, loop_.pathSine, out.z * loop_.pathCosine}, round * along, across);
    }

    // Sine and cosine of the angle to which a length of `length` units along a round corner corresponds, counted from the side.
    void turned(int side, Real length, Real* s, Real* c) const
    {
        if (stretched_) {
            // Longitudes count from z, but the angle counts from the direction in which the side looks.
            const Real way = length / (loop_.radius * loop_.pathCosine);
            const Angle on = (side & 1) == 0 ? QUARTER - quarter_.longitude(quarter_.length() - way) : quarter_.longitude(way);
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
    // The outline: half of the lower face along its narrower way, a quarter circle, the side, and the same back on the upper
    // face. The rings lie in the middles of equal parts of it.
    const Vector h = half();
    // On a face, rings are spaced in units of the stretched object.
    const Vector wide = stretchedOut(h);
    const Real face = min(wide.x, wide.z), round = radius() * HALF_PI, side = shiftUp(h.y, 1);
    const Real whole = shiftUp(face + round, 1) + side;
    Outline outline(stretch());
    outline.plain(face);
    outline.arc(round, 0u - QUARTER, 0);
    outline.line(side, Real(0), Real(1));
    outline.arc(round, 0, QUARTER);
    outline.plain(face);
    const int rings = stepsIn(outline.length(), spacing);
    Loop loop{};
    loop.radius = radius();
    loop.spacing = spacing;
    LoopMaker loops(maker, *this);
    for (int k = 0; k < rings; ++k) {
        const Real at = outline.at(2 * k + 1, 2 * rings, &loop.halfStep);
        const bool upper = at > shiftDown(whole, 1);
        const Real fromPole = upper ? whole - at : at;
        Real height = h.y;
        Vector inset{Real(0), Real(0), Real(0)};
        Angle latitude = 0;
        if (fromPole < face) {
            const Real in = face - fromPole;
            inset = stretched() ? Vector{in / stretch().x, Real(0), in / stretch().z} : Vector{in, Real(0), in};
            latitude = QUARTER;
        } else if (fromPole < face + round) {
            latitude = QUARTER - quarterTurn(fromPole - face, round);
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
