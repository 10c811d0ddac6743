// The body's field where its members are not all linked with each other at weight 1, or something digs into it (model/body.h). It
// is computed from the fields just evaluated on the path, and with it each field's share: by how much the body's field follows it.
#include "model/body.h"
#include "path.h"

namespace {

// In units of the field: what missing links take away counts only above NEGLIGIBLE; no field below NOTHING is divided by.
constexpr Real NEGLIGIBLE(0.002), NOTHING(0.0005);
// Among more members than this the sum over all pairs might overflow, unless their fields are scaled to 0.5.
constexpr int CROWD = 64;
// In units of the field: the sum of the fields that a member takes part in (Part::g) counts up to this, so that the mean of such
// sums stays within 16.16. So far inside the body it does not matter how far.
constexpr Real DEEP(240);

// A member of the body that has a field f at the position; `lack` is dD/df, where D is the sum of (1 - w_ik) f_i f_k (f_i + f_k)
// over all pairs of members.
struct Linked {
    Real f, lack;
    Neighbour* near;  // null: the object itself
};

// Adds to the `lack` of two members what their link, of weight w, leaves to be missing, and returns the term of the two in D.
inline __attribute__((always_inline)) Real addLack(Linked& a, Linked& b, Real w)
{
    const Real one = w == Real(0) ? a.f : a.f - w * a.f, sum = a.f + b.f, product = one * b.f;
    a.lack += product + (w == Real(0) ? b.f : b.f - w * b.f) * sum;
    b.lack += product + one * sum;
    return product * sum;
}

}  // namespace

// The body's field is the sum of the fields less D / Q, where Q is the sum of f_i^2. Its derivative with respect to f_i is
// 1 - (sum of (1 - w_ik) f_k (2 f_i + f_k) - 2 f_i D / Q) / Q.
void Path::blend(Real position, const Fields& fields, Sample& sample)
{
    Linked own{ownField_, Real(0), nullptr}, parts[NEIGHBOURS_MAX];
    Linked* end = parts;
    for (int i = 0; i < touched_; ++i) {
        Neighbour& near = *near_[i];
        if (near.value > Real(0))
            *end++ = {near.value, Real(0), &near};
        else
            near.share = Real(1);
    }
    // Small fields are scaled up, the strongest to 1, because their squares would lose too many digits; in a crowd it becomes 0.5.
    const Real strongest = max(ownField_, fields.strongest);
    const bool crowd = end - parts >= CROWD, scaled = crowd || (strongest < Real(0.125) && strongest > Real(0));
    const Real one = crowd ? strongest + strongest : strongest;
    if (scaled) {
        own.f = quotient(own.f, one);
        for (Linked* a = parts; a < end; ++a)
            a->f = quotient(a->f, one);
    }
    Real lacks(0), squares = own.f * own.f;
    for (Linked* a = parts; a < end; ++a) {
        squares += a->f * a->f;
        const int slot = a->near->slot;
        if (nearby_.weight(slot) != Real(1))
            lacks += addLack(*a, own, nearby_.weight(slot));
        for (Linked* b = parts; b < a; ++b) {
            const Real w = b->near->weights[slot];
            if (w != Real(1))
                lacks += addLack(*a, *b, w);
        }
    }
    if (absolute(lacks) <= squares * NEGLIGIBLE)
        return;
    const Real inverse = quotient(Real(1), squares), lack = lacks * inverse, twice = lack + lack;
    sample.excess -= scaled ? lack * one : lack;
    shared_ = true;
    // Returns what is missing from a member's share.
    const auto lost = [&](const Linked& a) { return (a.lack - a.f * twice) * inverse; };
    const Real ownLost = lost(own);
    ownShare_ = Real(1) - ownLost;
    sample.slope -= ownLost * shiftDown(ownSlope_ * position, 1);
    for (const Linked* a = parts; a < end; ++a) {
        const Real nearLost = lost(*a);
        a->near->share = Real(1) - nearLost;
        sample.slope -= nearLost * (a->near->slope * a->near->change);
    }
}

// ---- Where something digs, or strengths differ

// A member of the body that has a field f at the position: x is f over the strongest member's field, g the weighted sum of its own
// field, the fields that it is linked with and those that dig into it (model/body.h), `linked` the sum of w_ik x_i^2.
struct Path::Part {
    Real f, rate;  // f, df/dp
    const Real* weights;
    int slot;
    Real* share;
    Real g, linked;
    Real x, x2;
};

// An object outside the body that digs into it and has a field f at the position; `weight` is that with which it digs into the head
// (Neighbourhood::head).
struct Path::Digger {
    Real f, rate;
    Real weight;
    int slot;
    Real* share;
};

// The fields at a position: their sum, as if all members were linked with each other at weight 1 and dug into as the head is, and
// the slope of the sum; the strongest member's field; and the strongest field of a rival, a member that could take the path from
// the object. Members and diggers are listed only where the body's field may differ from the sum.
struct Path::Parts {
    Real sum{0}, slope{0}, strongest{0}, rival{0};
    Part* end = members;
    Digger* lastDigger = diggers;
    Part members[NEIGHBOURS_MAX + 1];
    Digger diggers[NEIGHBOURS_MAX + 1];
};

inline void Path::addMember(Parts& parts, Real f, Real rate, const SoftObject& object, Real* share) const
{
    parts.sum += f;
    parts.slope += rate;
    parts.strongest = max(parts.strongest, f);
    if (complete_)
        return;
    Part& part = *parts.end++;
    part.f = f;
    part.rate = rate;
    part.slot = object.slot();
    part.weights = bodies_.weights(part.slot);
    part.share = share;
}

inline void Path::addDigger(Parts& parts, Real f, Real rate, Real weight, const SoftObject& object, Real* share) const
{
    parts.sum -= f * weight;
    parts.slope -= rate * weight;
    if (!complete_)
        *parts.lastDigger++ = {f, rate, weight, object.slot(), share};
}

// Adds the own field, which digs if the seeds sample a hollow.
void Path::addOwn(Real position, Parts& parts)
{
    const Real t = ownParam(position), strength = object_.strength();
    const FieldStep own = t < Real(1) ? geoffQuick(max(t, Real(0))) : FieldStep{Real(0), Real(0)};
    ownField_ = own.value * strength;
    ownSlope_ = own.slope * strength;
    headField_ = Real(0);
    if (ownField_ <= Real(0))
        return;
    const Real rate = ownRate(position);
    if (all_.hollow)
        addDigger(parts, ownField_, rate, all_.weight, object_, &ownShare_);
    else
        addMember(parts, ownField_, rate, object_, &ownShare_);
}

// Adds the field of neighbour i. Returns false when it does not reach the position.
inline bool Path::addNear(Real position, const Vector* path, int i, Parts& parts)
{
    Neighbour& near = *near_[i];
    if (path != nullptr)
        near.aim(*path);
    const Real t = near.param(position);
    if (t >= Real(1)) {
        near.value = near.slope = Real(0);
        return false;
    }
    if (near.kind != Neighbour::OTHER)
        near.findChange(position);
    const FieldStep field = geoffQuick(max(t, Real(0)));
    const bool plain = near.strength == Real(1);
    near.value = plain ? field.value : field.value * near.strength;
    near.slope = plain ? field.slope : field.slope * near.strength;
    if (near.value <= Real(0))
        return true;
    const Real rate = near.slope * near.change;
    if (near.digs) {
        addDigger(parts, near.value, rate, near.weight, *near.object, &near.share);
        return true;
    }
    addMember(parts, near.value, rate, *near.object, &near.share);
    if (all_.hollow && near.isDugBy(object_.slot()))
        headField_ = max(headField_, near.value);
    else
        parts.rival = max(parts.rival, near.value * near.claim + ownField_ * (Real(1) - near.ownClaim));
    return true;
}

// Evaluates the fields at a position where something is odd about the object or the neighbours. Returns false when no neighbour
// reaches the position.
bool Path::lookOdd(Real position, const Vector* path, Sample* sample)
{
    Parts parts;
    addOwn(position, parts);
    bool touched = false;
    for (int i = 0; i < touched_; ++i)
        touched |= addNear(position, path, i, parts);
    sample->dominance = parts.rival - (all_.hollow ? headField_ : ownField_);
    sample->excess = parts.sum - ISOVALUE;
    sample->slope = parts.slope;
    shared_ = !complete_ && parts.strongest > NOTHING && !isSum(parts);
    if (shared_)
        blendOdd(parts, *sample);
    if (all_.hollow) {
        sample->excess = -sample->excess;
        sample->slope = -sample->slope;
    }
    return touched;
}

// Whether all members are linked with each other at weight 1, and each digger digs into all of them with the weight that it has for
// the head: then the sum of the fields is the body's field.
bool Path::isSum(const Parts& parts)
{
    for (const Part* a = parts.members; a < parts.end; ++a) {
        for (const Part* b = parts.members; b < a; ++b)
            if (b->weights[a->slot] != Real(1) || a->weights[b->slot] != Real(1))
                return false;
        for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger)
            if (a->weights[digger->slot] != -digger->weight)
                return false;
    }
    return true;
}

namespace {

// Adds the links of each member to its g and `linked`, sets x, and returns the sum of x_i^2. `inverse` is 1 / the strongest field.
template <class Part>
Real addLinks(Part* parts, const Part* end, Real inverse)
{
    Real squares(0);
    for (Part* a = parts; a < end; ++a) {
        a->x = a->f * inverse;
        a->x2 = a->x * a->x;
        a->linked = Real(0);
        a->g = a->f;
        squares += a->x2;
        for (Part* b = parts; b < a; ++b) {
            const Real w = b->weights[a->slot];
            if (w == Real(0))
                continue;
            const bool one = w == Real(1);
            a->g += one ? b->f : w * b->f;
            b->g += one ? a->f : w * a->f;
            a->linked += one ? b->x2 : w * b->x2;
            b->linked += one ? a->x2 : w * a->x2;
        }
    }
    return squares;
}

// Corrects g and `linked` for members that dig into each other: addLinks() took a pair's weight in the sum of B for both sums, but
// in the sum of A it may be another.
template <class Part>
void addInner(Part* parts, const Part* end)
{
    for (Part* a = parts; a < end; ++a)
        for (Part* b = parts; b < a; ++b) {
            const Real w = a->weights[b->slot] - b->weights[a->slot];
            a->g += w * b->f;
            b->linked += w * a->x2;
        }
}

}  // namespace

// The field is the sum of x_k^2 g_k over the sum of x_i^2. With x_i = f_i / the strongest,
// dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2. For a digger only the sum of w_ik x_i^2
// counts, with weights below 0.
void Path::blendOdd(Parts& parts, Sample& sample)
{
    const Real inverse = quotient(Real(1), parts.strongest), twice = inverse + inverse;
    const Real share = quotient(Real(1), addLinks(parts.members, parts.end, inverse));
    if (all_.inner)
        addInner(parts.members, parts.end);
    ownShare_ = Real(1);
    for (int i = 0; i < touched_; ++i)
        near_[i]->share = Real(1);
    Real slope(0), above(0);
    for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger) {
        Real linked(0);
        for (Part* a = parts.members; a < parts.end; ++a) {
            const Real w = a->weights[digger->slot];
            a->g += w * digger->f;
            linked += w * a->x2;
        }
        *digger->share = linked * share;
        slope += *digger->share * digger->rate;
    }
    for (const Part* a = parts.members; a < parts.end; ++a)
        above += a->x2 * clamp(a->g, -DEEP, DEEP);
    const Real field = above * share;
    for (const Part* a = parts.members; a < parts.end; ++a) {
        *a->share = (a->x * (a->g - field) * twice + a->x2 + a->linked) * share;
        slope += *a->share * a->rate;
    }
    sample.excess = field - ISOVALUE;
    sample.slope = slope;
}
