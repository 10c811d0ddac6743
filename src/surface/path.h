// Path: the field of the body along the path of one seed. Along a path the field of every neighbour is a function of the
// position; this adds them up at one position after the other, and knows what each of them was at the last.
#ifndef FB_PATH_H
#define FB_PATH_H

#include "nearby.h"

// A neighbour as the seeds of one root see it: what is the same for all of them. Lengths in its sizes, if not said otherwise.
struct FromRoot {
    int root;        // index of the root; -1: none yet
    Real a, c;       // squared distance of the root from the centre, squared length of the paths
    Vector twice16;  // 32 (root - centre) / size^2, units
    Vector apart;    // from the centre to the root, units; neither point nor segment: the root in core space
    Real y;          // a segment: where the root lies along it
};

// A neighbour's field along the path at hand. Its t (model/field.h) is a + p (b + p c), less k (2 y - k) for a segment.
struct Along {
    const Neighbour* near;
    const FromRoot* from;
    Real b;
    Real stepY;         // a segment: what the path leads along it
    Vector step;        // neither point nor segment: the path in its core space
    // At the last position looked at.
    Real value, slope;  // F and dF/dt
    Real t, change;     // and dt/dp
    Real k;             // where the nearest point of the segment lies along it
    Vector out;         // neither point nor segment: half the gradient of t in its core space, times CORE_SIZE^2

    // t at a position; sets what else there is to know there but F.
    Real param(Real p);
};

// The body's field at a position: its excess over the isovalue, its slope along the path, how much stronger than the own
// field the strongest neighbour's is.
struct Sample {
    Real excess, slope, dominance;
};

// The field along the paths of one object's seeds in a frame, one after the other: the path at hand is the one that was taken
// up last. In a hollow inside and outside change places.
class Path {
public:
    Path(const SoftObject& object, const Neighbourhood& all, const Bodies& bodies, Nearby& nearby, Counts& counts);

    // Takes up the path of a seed as a few neighbours see it, and looks at a position. False: none of them reaches that.
    bool begin(const Few& few, const Seed& s, Real position, Sample* sample);

    // Takes up the path of a seed that is searched: as those see it that reach some of it.
    void beginSearch(const Seed& s);

    // Looks at a position of the path at hand.
    Sample look(Real position);

    // The direction in which the field falls at a position that has just been looked at, any length, own axes.
    Vector outward(Real position) const;

    // What is known of a neighbour's field along the path of a seed, which need not be taken up, before any position is looked at.
    void aim(int number, const Seed& s, Along& along);

    // What the fields may change by, all together, when the neighbours come by a unit: where they were looked at last, and
    // anywhere on the path.
    Real pushes() const;
    Real pushMost() const;
    // What they change by at most, all together and the own one, over a position.
    Real steepest() const;

    // Positions: where paths are searched.
    Real first() const { return first_; }
    Real last() const { return last_; }

    const SoftObject& object() const { return object_; }
    const Neighbourhood& all() const { return all_; }
    // How many neighbours see the path at hand, and what each of them makes of it.
    int touched() const { return touched_; }
    const Along& along(int i) const { return along_[i]; }
    // What leads to a place on it, from the root and from the core of a neighbour.
    Vector from(Real position) const { return path_ * position; }
    Vector fromCore(const Along& along, Real position) const;

    // The last position looked at, and F and dF/dt of the own field there.
    Real lookedAt() const { return lookedAt_; }
    Real ownField() const { return ownField_; }
    Real ownSlope() const { return ownSlope_; }
    // The own t at a position; and dF/dp, when that has been looked at.
    Real ownParam(Real position) { return warped_ ? warpedParam(position) : position * position * restParam_; }
    Real ownRate(Real position) const
    {
        return warped_ ? ownSlope_ * ownChange_ : ownSlope_ * position * shiftUp(restParam_, 1);
    }
    // Half the gradient of the own t at a position, times its squared size and a share: of an object whose paths slant.
    SELDOM Vector ownGradient(Real position, Real share) const;

private:
    template <bool COMMON> struct Sum;
    struct Part;

    void setRoot(const Neighbour& near, const Seed& s, FromRoot& to) const;
    // The same as begin() and look(); whether all is common (Neighbourhood::common) is known at compile time.
    template <bool COMMON> bool beginAs(const Few& few, const Seed& s, Real position, Sample* sample);
    template <bool COMMON> Sample lookAs(Real position);
    SELDOM bool beginOdd(const Few& few, const Seed& s, Real position, Sample* sample);
    SELDOM Sample lookOdd(Real position);
    SELDOM Real warpedParam(Real position);
    // The body's field from those that were found (blend.cpp).
    SELDOM void blend(Real position, Sample& sample);
    SELDOM void blendOdd(Real position, Sample& sample);
    int findParts(Real position, Part* parts, Real* strongest);
    Real addDents(Real position, Part* parts, int count);

    const SoftObject& object_;
    const Neighbourhood& all_;
    const Bodies& bodies_;
    Nearby& nearby_;
    Counts& counts_;
    const bool ownPlain_;           // the object's strength is 1, and it is neither a hollow nor warped
    const bool common_;             // Neighbourhood::common
    const bool warped_;             // the object is
    const Real restParam_;          // t of the own field at position 1, unless it is warped
    const Real first_, last_;
    FromRoot from_[NEIGHBOURS_MAX];
    Real reachT_[NEIGHBOURS_MAX];   // t in the middle of a path, beyond which no place on it is reached

    // Of the path at hand.
    Vector root_, path_;
    bool complete_;
    bool shared_;                   // share_ holds at the position looked at last; else all are 1
    int touched_;
    Along along_[NEIGHBOURS_MAX];
    Real headField_;                // of a hollow: the field of what is hollowed out
    Real lookedAt_;
    Real ownField_, ownSlope_;
    Real ownChange_;                // and dt/dp, of a warped object
    Real share_[NEIGHBOURS_MAX + 1];  // dF/df of the own and each touched neighbour's field, if shared_
};

inline void Path::aim(int number, const Seed& s, Along& along)
{
    const Neighbour& near = all_.neighbours[number];
    FromRoot& from = from_[number];
    if (from.root != s.root)
        setRoot(near, s, from);
    along.near = &near;
    along.from = &from;
    if (near.kind == Neighbour::OTHER) {
        along.step = near.inCore(s.path);
    } else {
        along.b = shiftDown(dot(s.path, from.twice16), 4);
        if (near.kind == Neighbour::SEGMENT)
            along.stepY = shiftDown(dot(s.path, near.toCore[1]), 4);
    }
}

inline Real Along::param(Real p)
{
    if (near->kind == Neighbour::OTHER) {
        const Real t = near->object->param(from->apart + step * p, &out);
        // Where the field has ended the product might leave 16.16, and nobody asks for it.
        change = t < Real(1) ? shiftDown(dot(out, step), 7) : Real(0);
        return t;
    }
    const Real outer = p * from->c, inner = b + outer;
    change = inner + outer;
    const Real t = from->a + p * inner;
    if (near->kind == Neighbour::POINT)
        return t;
    const Real y = from->y + p * stepY;
    k = clamp(y, -near->half, near->half);
    change -= k * (stepY + stepY);
    return t - k * (y + y - k);
}

inline __attribute__((always_inline)) Vector Path::fromCore(const Along& along, Real position) const
{
    if (along.near->kind == Neighbour::OTHER)
        return along.near->fromCoreSpace(along.out);
    const Vector v = along.from->apart + path_ * position;
    return along.near->kind == Neighbour::SEGMENT ? v - along.near->direction * (along.k * along.near->size) : v;
}

#endif
