// The body's field where its members are not all linked with all at weight 1, or something digs into it (model/body.h): from the
// fields along the path that were just looked at. It sets the share that each of them has in the change of the body's.
#include "model/body.h"
#include "path.h"

namespace {

// Of the field: what missing links take at least to be counted; and what is too weak to be divided by.
constexpr Real NEGLIGIBLE(0.002), NOTHING(0.0005);

// A member of the body that has a field F at the position; `lack` is the sum in its derivative.
struct Linked {
    Real f, lack;
    const Real* weights;
    int slot, at;  // at: its place on the list; -1: the object
};

// D = sum of (1 - w_ik) f_i f_k (f_i + f_k) over all pairs, and for each member that sum in the derivative; `*squares` becomes Q,
// the sum of f_i^2.
Real findLacks(Linked* parts, const Linked* end, Real* squares)
{
    Real lacks(0), sumOfSquares(0);
    for (Linked* a = parts; a < end; ++a) {
        sumOfSquares += a->f * a->f;
        for (Linked* b = parts; b < a; ++b) {
            const Real w = b->weights[a->slot];
            if (w == Real(1))
                continue;
            const Real one = w == Real(0) ? a->f : a->f - w * a->f, sum = a->f + b->f, product = one * b->f;
            lacks += product * sum;
            a->lack += product + (w == Real(0) ? b->f : b->f - w * b->f) * sum;
            b->lack += product + one * sum;
        }
    }
    *squares = sumOfSquares;
    return lacks;
}

}  // namespace

// The sum of the fields, less D / Q. Its derivative with respect to f_i is
// 1 - (sum of (1 - w_ik) f_k (2 f_i + f_k) - 2 f_i D / Q) / Q.
void Path::blend(Real position, Sample& sample)
{
    // The own first.
    Linked parts[NEIGHBOURS_MAX + 1];
    Linked* end = parts;
    Real strongest(0);
    const auto add = [&](Real f, int slot, int at) {
        *end++ = {f, Real(0), bodies_.weights(slot), slot, at};
        strongest = max(strongest, f);
    };
    if (ownField_ > Real(0))
        add(ownField_, object_.slot(), -1);
    for (int i = 0; i < touched_; ++i)
        if (near_[i]->value > Real(0))
            add(near_[i]->value, near_[i]->object->slot(), i);
    // In a crowd all fields are small, and their squares need the digits.
    const bool faint = strongest < Real(0.125) && strongest > Real(0);
    for (Linked* a = parts; a < end && faint; ++a)
        a->f = quotient(a->f, strongest);
    Real squares(0);
    const Real lacks = findLacks(parts, end, &squares);
    if (absolute(lacks) <= squares * NEGLIGIBLE)
        return;
    const Real inverse = quotient(Real(1), squares), lack = lacks * inverse, twice = lack + lack;
    sample.excess -= faint ? lack * strongest : lack;
    shared_ = true;
    for (int i = 0; i <= touched_; ++i)
        share_[i] = Real(1);
    for (const Linked* a = parts; a < end; ++a) {
        const Real lost = (a->lack - a->f * twice) * inverse;
        const Real rate = a->at < 0 ? shiftDown(ownSlope_ * position, 1) : near_[a->at]->slope * near_[a->at]->change;
        share_[a->at + 1] = Real(1) - lost;
        sample.slope -= lost * rate;
    }
}

// ---- Where something digs, or strengths differ

// A member of the body that has a field F at the position; x is that over the strongest one, g the sum of what it is linked with
// and what digs into it, `linked` the sum of w_ik x_i^2.
struct Path::Part {
    Real f, rate;  // F, dF/dp
    const Real* weights;
    int slot, at;  // at: its place in share_
    Real g, linked;
    Real x, x2;
};

// What digs into the body and is none of it, and has a field F there; the weight is that by which it digs into the head.
struct Path::Digger {
    Real f, rate;
    Real weight;
    int slot, at;
};

// The sum of all fields, as if all members were linked with all and dug into like the head, and what that changes by over a
// position; the strongest member's field, and that of those that take a path from the object. Where not all of that is so, each
// of them.
struct Path::Parts {
    Real sum{0}, slope{0}, strongest{0}, rival{0};
    Part* end = members;
    Digger* lastDigger = diggers;
    Part members[NEIGHBOURS_MAX + 1];
    Digger diggers[NEIGHBOURS_MAX + 1];
};

inline void Path::addMember(Parts& parts, Real f, Real rate, const SoftObject& object, int at) const
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
    part.at = at;
}

inline void Path::addDigger(Parts& parts, Real f, Real rate, Real weight, const SoftObject& object, int at) const
{
    parts.sum -= f * weight;
    parts.slope -= rate * weight;
    if (!complete_)
        *parts.lastDigger++ = {f, rate, weight, object.slot(), at};
}

// The own field: it digs, if the seeds sample a hollow.
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
        addDigger(parts, ownField_, rate, all_.weight, object_, 0);
    else
        addMember(parts, ownField_, rate, object_, 0);
}

// The field of a neighbour. False: it does not reach the position.
inline bool Path::addNear(Real position, const Vector* path, int at, Parts& parts)
{
    Neighbour& near = *near_[at];
    if (path != nullptr)
        near.aim(*path);
    const Real t = near.param(position);
    if (t >= Real(1)) {
        near.value = near.slope = Real(0);
        return false;
    }
    const FieldStep field = geoffQuick(max(t, Real(0)));
    const bool plain = near.strength == Real(1);
    near.value = plain ? field.value : field.value * near.strength;
    near.slope = plain ? field.slope : field.slope * near.strength;
    if (near.value <= Real(0))
        return true;
    const Real rate = near.slope * near.change;
    if (near.digs) {
        addDigger(parts, near.value, rate, near.weight, *near.object, at + 1);
        return true;
    }
    addMember(parts, near.value, rate, *near.object, at + 1);
    if (all_.hollow && near.object == all_.head)
        headField_ = near.value;
    else
        parts.rival = max(parts.rival, near.value);
    return true;
}

// Looks at a position where something is odd about the object or the neighbours. False: none of them reaches that position.
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

// Whether the members are all linked with each other at weight 1, and whatever digs does it by the same weight as into the head.
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

// Adds up for each of them what it is linked with, and returns the sum of x_i^2. `inverse`: of the strongest field.
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

// The same for what members of a body dig into each other: what B digs into A by more than A into B.
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
// dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2; of what digs only the last sum, in which its
// weights are below 0.
void Path::blendOdd(Parts& parts, Sample& sample)
{
    const Real inverse = quotient(Real(1), parts.strongest), twice = inverse + inverse;
    const Real share = quotient(Real(1), addLinks(parts.members, parts.end, inverse));
    if (all_.inner)
        addInner(parts.members, parts.end);
    for (int i = 0; i <= touched_; ++i)
        share_[i] = Real(1);
    Real slope(0), above(0);
    for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger) {
        Real linked(0);
        for (Part* a = parts.members; a < parts.end; ++a) {
            const Real w = a->weights[digger->slot];
            a->g += w * digger->f;
            linked += w * a->x2;
        }
        share_[digger->at] = linked * share;
        slope += share_[digger->at] * digger->rate;
    }
    for (const Part* a = parts.members; a < parts.end; ++a)
        above += a->x2 * a->g;
    const Real field = above * share;
    for (const Part* a = parts.members; a < parts.end; ++a) {
        share_[a->at] = (a->x * (a->g - field) * twice + a->x2 + a->linked) * share;
        slope += share_[a->at] * a->rate;
    }
    sample.excess = field - ISOVALUE;
    sample.slope = slope;
}
