// Path: the field of the body along the path of one seed. Along a path the field of every neighbour is a function of the
// position; a Path evaluates the fields at one position after another, adds them up, and remembers the fields at the last position.
// The own field is that of the object to which the seed belongs.
#ifndef FB_PATH_H
#define FB_PATH_H

#include "nearby.h"

// The position at which the own field has fallen to .23. A neighbour that is stronger there stays stronger farther out (cover.h).
constexpr Real COVERED_AT(1.36);

// A seed in a place that belongs to another object is not shown if the own field is weaker than FAINT there: its scale would be
// coarse. FAINT_AT is about the position where the own field has fallen to that.
constexpr Real FAINT(0.05), FAINT_AT(1.71);

// The body's field at a position of a path: its excess over the isovalue, its slope along the path, and the strongest
// neighbour's claim (gather.h) less the own one. For seeds that sample a hollow, excess and slope have the opposite sign, because
// their paths begin in the cavity and the body lies outside; and the field of the object that has the hollow stands for the own
// one.
struct Sample {
    Real excess, slope, dominance;
};

// Evaluates fields along the paths of one object's seeds in a frame, one path after another. The current path is the one that was
// begun last.
class Path {
public:
    Path(const SoftObject& object, Neighbourhood& all, const Bodies& bodies, Nearby& nearby, Counts& counts);

    // Makes the path of a seed current, with only the neighbours on `list`, and evaluates the fields at a position. Returns false
    // when none of these neighbours reaches the position.
    bool begin(const NeighbourList& list, const Seed& s, Real position, Sample* sample);

    // Makes the path of a seed current for a search of its whole length, with the neighbours that reach some part of it. Returns
    // the sample at middle().
    Sample beginSearch(const Seed& s);
    // As beginSearch(), but without a sample.
    SELDOM void beginDeepSearch(const Seed& s);

    // Evaluates the fields at a position of the current path.
    Sample look(Real position);
    // Makes the path of a seed current, with the neighbours that may reach it at a position, and evaluates the fields there.
    Sample lookOn(const Seed& s, Real position)
    {
        Sample sample;
        begin(nearby_.at(position), s, position, &sample);
        return sample;
    }

    // The direction in which the body's field falls (own axes) at the position evaluated last, or a short step from it. Its length
    // is half the gradient times the squared own size, over 2^gradientShift(): beside a small neighbour that alone would leave
    // 16.16.
    Vector outward(Real position) const;
    // As outward(), at a position of the path that passes a seed's path at a distance. There is no current path afterwards.
    Vector outwardBeside(const Seed& s, Real position, const Vector& distance);
    // The shift of gradients at the position evaluated last: 0, unless there is a far smaller or steeper neighbour.
    int gradientShift() const { return all_.steep ? findGradientShift() : 0; }

    // The member of the body among the neighbours whose field was the strongest at the position evaluated last, but for `other`;
    // null if there is none.
    const Neighbour* strongest(const Neighbour* other = nullptr) const;
    // Where the seeds sample a hollow: the object that has it there, of those that the object digs into the one whose field was the
    // strongest; null if none reaches the position, and elsewhere.
    const Neighbour* host() const;
    // The strongest neighbour's field less the own one there, or that of the host less the next one. It differs from
    // Sample::dominance where claims are not fields, or the object digs into several members.
    Real fieldLead() const;

    // Must be called when the lists of `nearby` change.
    void forgetList() { list_ = nullptr; }

    // Prepares a neighbour's field along the path of a seed, so that the neighbour alone can be evaluated at positions. There is no
    // current path afterwards.
    void aim(Neighbour& near, const Seed& s);

    // Upper bounds on how much the neighbours' fields together change when each neighbour moves by one unit: at the position
    // evaluated last, and anywhere on the path.
    Real gradientBound() const;
    Real steepestGradient() const;

    // About the greatest distance of two positions between which the field still follows the cubic curve given by the fields and
    // slopes at both.
    Real smoothStep() const;

    // The positions between which paths are searched.
    Real first() const { return first_; }
    Real last() const { return last_; }
    // The position in between that a search evaluates first.
    Real middle() const { return middle_; }

    const SoftObject& object() const { return object_; }
    const Neighbourhood& all() const { return all_; }
    // The number of neighbours that are evaluated along the current path, and each of these neighbours.
    int touched() const { return touched_; }
    const Neighbour& near(int i) const { return *near_[i]; }
    // The vector to a position of the current path from its root; and that from the core of a neighbour to the same place.
    Vector from(Real position) const { return seed_->path * position; }
    Vector fromCore(const Neighbour& near, const Vector& from) const;

    // The position evaluated last, and F and dF/dt of the own field there.
    Real lookedAt() const { return lookedAt_; }
    Real ownField() const { return ownField_; }
    Real ownSlope() const { return ownSlope_; }
    // The own t (model/field.h) at a position; and dF/dp of the own field, at the position evaluated last.
    Real ownParam(Real position) { return warped_ ? warpedParam(position) : position * position * restParam_; }
    Real ownRate(Real position) const
    {
        return warped_ ? ownSlope_ * ownChange_ : ownSlope_ * position * shiftUp(restParam_, 1);
    }
    // For an object whose paths slant: half the gradient of the own t at a position, times the squared size and a factor.
    SELDOM Vector ownGradient(Real position, Real factor) const;

private:
    struct Part;
    struct Digger;
    struct Parts;

    void setRoots(Neighbour* const* first, Neighbour* const* end, const Seed& s) const;
    void makeCurrent(const NeighbourList& list, const Seed& s)
    {
        seed_ = &s;
        if (list_ != &list || rootOfList_ != s.root)
            take(list, s);
    }
    void take(const NeighbourList& list, const Seed& s);
    void setNear(const NeighbourList& list);
    SELDOM void findOdd();
    Real pushOf(const Neighbour& near, int shift) const;
    SELDOM int findGradientShift() const;
    Vector sumGradients(Real position, int shift, bool slants) const;
    bool mayReach(const Neighbour& near) const;
    void leaveOut();
    const Vector& root() const { return object_.root(seed_->root); }
    Fields own(Real position);
    SELDOM Real dominantClaim() const;
    bool addsUp() const;
    bool lookPlain(Real position, const Vector* path, Sample* sample);
    SELDOM bool lookAnywhere(Real position, const Vector* path, Sample* sample);
    SELDOM Real warpedParam(Real position);
    // How fields make the body's field where that is not their plain sum (blend.cpp).
    SELDOM void blend(Real position, const Fields& fields, Sample& sample);
    SELDOM bool lookOdd(Real position, const Vector* path, Sample* sample);
    void addMember(Parts& parts, Real f, Real rate, const SoftObject& object, Real* share) const;
    void addDigger(Parts& parts, Real f, Real rate, Real weight, const SoftObject& object, Real* share) const;
    void addOwn(Real position, Parts& parts);
    bool addNear(Real position, const Vector* path, int i, Parts& parts);
    static bool isSum(const Parts& parts);
    SELDOM void blendOdd(Parts& parts, Sample& sample);

    const SoftObject& object_;
    Neighbourhood& all_;
    const Bodies& bodies_;
    Nearby& nearby_;
    Counts& counts_;
    const bool warped_;             // the object is warped
    const bool ownPlain_;           // it is not warped, its strength is 1, it samples no hollow, and no member digs into another
    const Real restParam_;          // t of the own field at position 1, unless the object is warped
    const Real first_, last_, middle_;
    const Real restOfPath_;         // units: the searched part of a path leads no farther than this from its middle

    // The current path:
    const NeighbourList* list_ = nullptr;  // the neighbours that are evaluated; null: those on shortList_, or none are set
    NeighbourList shortList_;       // those neighbours on a list that reach some position of the path
    Neighbour* const* near_;        // the neighbours of list_ or shortList_
    int touched_ = 0;               // their number
    int rootOfList_ = -1;           // index of the root for which all neighbours of list_ are prepared; -1: none
    bool odd_;                      // not ownPlain_, or some neighbours are not Neighbour::ordinary
    bool special_;                  // lookPlain() alone does not do: odd_, or the cores of some neighbours are neither points nor
                                    // segments, or claims are not fields
    const Seed* seed_;
    bool complete_;
    bool shared_;                   // shares hold at the position evaluated last; else they are 1, of a digging field -weight
    Real headField_;                // of a hollow: the strongest field of an object that has it
    Real lookedAt_;
    Real ownField_, ownSlope_;
    Real ownChange_;                // of a warped object: dt/dp
    Vector ownOut_;                 // of a warped object: half the gradient of t in core space, times CORE_SIZE^2
    Real ownShare_;                 // as Neighbour::share, of the own field
};

inline void Path::aim(Neighbour& near, const Seed& s)
{
    if (near.root != s.root) {
        Neighbour* const one = &near;
        setRoots(&one, &one + 1, s);
        rootOfList_ = -1;
    }
    near.aim(s.path);
}

inline const Neighbour* Path::strongest(const Neighbour* other) const
{
    const Neighbour* strongest = nullptr;
    Real most(-1);
    for (int i = 0; i < touched_; ++i) {
        const Neighbour& near = *near_[i];
        if (near.value > most && !near.digs && &near != other) {
            most = near.value;
            strongest = &near;
        }
    }
    return strongest;
}

inline const Neighbour* Path::host() const
{
    const Neighbour* host = nullptr;
    for (int i = 0; i < touched_ && all_.hollow; ++i)
        if (near_[i]->isDugBy(object_.slot()) && near_[i]->value > Real(0) && (host == nullptr || near_[i]->value > host->value))
            host = near_[i];
    return host;
}

inline __attribute__((always_inline)) Vector Path::fromCore(const Neighbour& near, const Vector& from) const
{
    if (near.kind == Neighbour::OTHER)
        return near.fromCoreSpace(near.halfGradient);
    const Vector v = near.toRoot + from;
    return near.kind == Neighbour::SEGMENT ? v - near.direction * (near.k * near.size) : v;
}

#endif
