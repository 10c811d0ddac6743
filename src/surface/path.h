// Path: the field of the body along the path of one seed. Along a path the field of every neighbour is a function of the
// position; this adds them up at one position after the other, and knows what each of them was at the last.
#ifndef FB_PATH_H
#define FB_PATH_H

#include "nearby.h"

// The position at which the own field is .23; a neighbour that is stronger there is so for good (cover.h).
constexpr Real COVERED_AT(1.36);

// The body's field at a position: its excess over the isovalue, its slope along the path, how much stronger than the own
// field the strongest neighbour's is.
struct Sample {
    Real excess, slope, dominance;
};

// The field along the paths of one object's seeds in a frame, one after the other: the path at hand is the one that was taken
// up last. In a hollow inside and outside change places.
class Path {
public:
    Path(const SoftObject& object, Neighbourhood& all, const Bodies& bodies, Nearby& nearby, Counts& counts);

    // Takes up the path of a seed in the fields of a few neighbours, and looks at a position. False: none of them reaches that.
    bool begin(const NeighbourList& list, const Seed& s, Real position, Sample* sample);

    // Takes up the path of a seed that is searched, in the fields of those neighbours that reach some of it, and looks at middle().
    Sample beginSearch(const Seed& s);
    // The same without a look.
    SELDOM void beginDeepSearch(const Seed& s);

    // Looks at a position of the path at hand; and of that of a seed, in the fields of those neighbours that may reach it there.
    Sample look(Real position);
    Sample lookOn(const Seed& s, Real position)
    {
        Sample sample;
        begin(nearby_.at(position), s, position, &sample);
        return sample;
    }

    // The direction in which the field falls at a position that has just been looked at, any length, own axes.
    Vector outward(Real position) const;

    // To be called when the lists of `nearby` change.
    void leave() { asked_ = nullptr; }

    // Finds what there is to know of a neighbour's field along the path of a seed before any position is looked at. No path is at
    // hand afterwards.
    void aim(Neighbour& near, const Seed& s);

    // By how much the neighbours' fields may change, all together, when each neighbour moves by a unit: at the position looked at
    // last, and anywhere on the path.
    Real gradientBound() const;
    Real steepestGradient() const;

    // How far two positions may be apart for the field in between to follow from what it is there and changes by, about.
    Real smoothStep() const;

    // Positions: where paths are searched.
    Real first() const { return first_; }
    Real last() const { return last_; }
    // The position in between that is looked at first.
    Real middle() const { return middle_; }

    const SoftObject& object() const { return object_; }
    const Neighbourhood& all() const { return all_; }
    // How many neighbours are looked at along the path at hand, and each of them.
    int touched() const { return touched_; }
    const Neighbour& near(int i) const { return *near_[i]; }
    // What leads to a place on it, from the root and from the core of a neighbour.
    Vector from(Real position) const { return seed_->path * position; }
    Vector fromCore(const Neighbour& near, Real position) const;

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
    struct Part;
    struct Digger;
    struct Parts;

    void setRoot(Neighbour& near, const Seed& s) const;
    void take(const NeighbourList& list, const Seed& s);
    void setNear(const NeighbourList& list);
    SELDOM void findOdd();
    bool mayReach(const Neighbour& near) const;
    void leaveOut();
    const Vector& root() const { return object_.root(seed_->root); }
    Fields own(Real position);
    bool lookPlain(Real position, const Vector* path, Sample* sample);
    SELDOM bool lookAnywhere(Real position, const Vector* path, Sample* sample);
    SELDOM Real warpedParam(Real position);
    // The body's field from those that were found (blend.cpp).
    SELDOM void blend(Real position, Sample& sample);
    SELDOM bool lookOdd(Real position, const Vector* path, Sample* sample);
    void addMember(Parts& parts, Real f, Real rate, const SoftObject& object, int at) const;
    void addDigger(Parts& parts, Real f, Real rate, Real weight, const SoftObject& object, int at) const;
    void addOwn(Real position, Parts& parts);
    bool addNear(Real position, const Vector* path, int at, Parts& parts);
    static bool isSum(const Parts& parts);
    SELDOM void blendOdd(Parts& parts, Sample& sample);

    const SoftObject& object_;
    Neighbourhood& all_;
    const Bodies& bodies_;
    Nearby& nearby_;
    Counts& counts_;
    const bool warped_;             // the object is
    const bool ownPlain_;           // it is not, its strength is 1, nothing digs within its body, and it samples no hollow
    const Real restParam_;          // t of the own field at position 1, unless it is warped
    const Real first_, last_, middle_;
    const Real restOfPath_;         // units: how far a path leads from its middle to either side

    // Of the path at hand.
    const NeighbourList* asked_ = nullptr;      // the list of the neighbours whose fields are looked at; null: a part of it
    NeighbourList part_;                      // that part
    Neighbour* const* near_;        // as they stand there
    int touched_ = 0;
    int rootOfAsked_ = -1;            // the root that is known to all of them; -1: none
    bool odd_;                      // not ownPlain_, or some of them are not Neighbour::plain
    bool others_;                   // some of them are neither points nor segments
    const Seed* seed_;
    bool complete_;
    bool shared_;                   // share_ holds at the position looked at last; else all are 1
    Real headField_;                // of a hollow: the field of what is hollowed out
    Real lookedAt_;
    Real ownField_, ownSlope_;
    Real ownChange_;                // of a warped object: dt/dp, and half the gradient of t in core space, times CORE_SIZE^2
    Vector ownOut_;
    Real share_[NEIGHBOURS_MAX + 1];  // dF/df of the own and each touched neighbour's field, if shared_
};

inline void Path::aim(Neighbour& near, const Seed& s)
{
    if (near.root != s.root) {
        setRoot(near, s);
        rootOfAsked_ = -1;
    }
    near.aim(s.path);
}

inline __attribute__((always_inline)) Vector Path::fromCore(const Neighbour& near, Real position) const
{
    if (near.kind == Neighbour::OTHER)
        return near.fromCoreSpace(near.halfGradient);
    const Vector v = near.toRoot + from(position);
    return near.kind == Neighbour::SEGMENT ? v - near.direction * (near.k * near.size) : v;
}

#endif
