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
    int slot, at;  // at: its number on the path; -1: the object
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
        strongest = most(strongest, f);
    };
    if (ownField_ > Real(0))
        add(ownField_, object_.slot(), -1);
    for (int i = 0; i < touched_; ++i)
        if (along_[i].value > Real(0))
            add(along_[i].value, along_[i].near->object->slot(), i);
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
        const Real rate = a->at < 0 ? shiftDown(ownSlope_ * position, 1) : along_[a->at].slope * along_[a->at].change;
        share_[a->at + 1] = Real(1) - lost;
        sample.slope -= lost * rate;
    }
}

// ---- Where something digs, or strengths differ

// A member of the body that has a field F at the position; x is that over the strongest one, g the sum of what it is linked with
// and what digs into it, `linked` the sum of w_ik x_i^2.
struct Path::Part {
    Real f;
    Real g, linked;
    Real x, x2;
    const Real* weights;
    int slot, at;  // at: its number on the path; -1: the object
};

// What digs into the body and is none of it, and has a field F there.
struct Path::Digger {
    Real f;
    int slot, at;
};

// All of them, and the strongest member's field.
struct Path::Parts {
    Part members[NEIGHBOURS_MAX + 1];
    Part* end = members;
    Digger diggers[NEIGHBOURS_MAX + 1];
    Digger* lastDigger = diggers;
    Real strongest{0};
};

// Lists them, the own first.
void Path::findParts(Parts& parts) const
{
    const auto add = [&](Real f, int slot, int at, bool digs) {
        if (f <= Real(0))
            return;
        if (digs) {
            *parts.lastDigger++ = {f, slot, at};
            return;
        }
        parts.strongest = most(parts.strongest, f);
        Part& part = *parts.end++;
        part.f = part.g = f;
        part.weights = bodies_.weights(slot);
        part.slot = slot;
        part.at = at;
    };
    add(ownField_, object_.slot(), -1, all_.hollow);
    for (int i = 0; i < touched_; ++i)
        add(along_[i].value, along_[i].near->object->slot(), i, along_[i].near->digs);
}

// Whether the members are all linked with each other at weight 1, and whatever digs does it with one weight into all of them:
// then F is their sum, less what digs.
bool Path::isSum(const Parts& parts)
{
    const Part* const first = parts.members;
    for (const Part* a = first + 1; a < parts.end; ++a) {
        for (const Part* b = first; b < a; ++b)
            if (b->weights[a->slot] != Real(1) || a->weights[b->slot] != Real(1))
                return false;
        for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger)
            if (a->weights[digger->slot] != first->weights[digger->slot])
                return false;
    }
    return true;
}

Real Path::sumOf(const Parts& parts)
{
    Real sum(0);
    for (const Part* a = parts.members; a < parts.end; ++a)
        sum += a->f;
    for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger)
        sum += parts.members->weights[digger->slot] * digger->f;
    return sum;
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

// The body's field: the sum of x_k^2 g_k over the sum of x_i^2, with x_i = f_i / the strongest. `*share` becomes one over the
// latter, `*inverse` one over the strongest.
Real Path::fieldOf(Parts& parts, Real* share, Real* inverse) const
{
    *inverse = quotient(Real(1), parts.strongest);
    *share = quotient(Real(1), addLinks(parts.members, parts.end, *inverse));
    if (all_.inner)
        addInner(parts.members, parts.end);
    Real above(0);
    for (Part* a = parts.members; a < parts.end; ++a) {
        for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger)
            a->g += a->weights[digger->slot] * digger->f;
        above += a->x2 * a->g;
    }
    return above * *share;
}

// dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2; of what digs only the last sum, in which its
// weights are below 0.
void Path::blendOdd(Real position, Sample& sample)
{
    Parts parts;
    findParts(parts);
    shared_ = true;
    for (int i = 0; i <= touched_; ++i)
        share_[i] = Real(1);
    if (parts.strongest <= NOTHING)
        return;
    const auto rateOf = [&](int at) { return at < 0 ? ownRate(position) : along_[at].slope * along_[at].change; };
    Real slope(0);
    if (isSum(parts)) {
        sample.excess = sumOf(parts) - ISOVALUE;
        for (const Part* a = parts.members; a < parts.end; ++a)
            slope += rateOf(a->at);
        for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger) {
            const Real weight = parts.members->weights[digger->slot];
            share_[digger->at + 1] = weight;
            slope += weight * rateOf(digger->at);
        }
        sample.slope = slope;
        return;
    }
    Real share, inverse;
    const Real field = fieldOf(parts, &share, &inverse), twice = inverse + inverse;
    for (const Part* a = parts.members; a < parts.end; ++a) {
        const Real part = (a->x * (a->g - field) * twice + a->x2 + a->linked) * share;
        share_[a->at + 1] = part;
        slope += part * rateOf(a->at);
    }
    for (const Digger* digger = parts.diggers; digger < parts.lastDigger; ++digger) {
        Real linked(0);
        for (const Part* a = parts.members; a < parts.end; ++a)
            linked += a->weights[digger->slot] * a->x2;
        share_[digger->at + 1] = linked * share;
        slope += linked * share * rateOf(digger->at);
    }
    sample.excess = field - ISOVALUE;
    sample.slope = slope;
}
