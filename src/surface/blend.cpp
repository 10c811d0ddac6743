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
    Real f, rate;  // F, dF/dp
    Real g, linked;
    Real x, x2;
    const Real* weights;
    int slot, at;  // at: its place in share_
};

// Lists them, the own first, and returns how many there are.
int Path::findParts(Real position, Part* parts, Real* strongest)
{
    Part* end = parts;
    const auto add = [&](Real f, Real rate, int slot, int at) {
        *strongest = most(*strongest, f);
        end->f = end->g = f;
        end->rate = rate;
        end->linked = Real(0);
        end->weights = bodies_.weights(slot);
        end->slot = slot;
        end->at = at;
        ++end;
    };
    share_[0] = Real(1);
    if (ownField_ > Real(0) && !all_.hollow)
        add(ownField_, ownRate(position), object_.slot(), 0);
    for (int i = 0; i < touched_; ++i) {
        const Along& along = along_[i];
        share_[i + 1] = Real(1);
        if (along.value > Real(0) && !along.near->digs)
            add(along.value, along.slope * along.change, along.near->object->slot(), i + 1);
    }
    return static_cast<int>(end - parts);
}

namespace {

// Whether they are all linked with each other at weight 1.
template <class Part>
bool areAllLinked(const Part* parts, const Part* end)
{
    for (const Part* a = parts + 1; a < end; ++a)
        for (const Part* b = parts; b < a; ++b)
            if (b->weights[a->slot] != Real(1))
                return false;
    return true;
}

// Adds up for each of them what it is linked with, and returns the sum of x_i^2. `inverse`: of the strongest field.
template <class Part>
Real addLinks(Part* parts, const Part* end, Real inverse)
{
    Real squares(0);
    for (Part* a = parts; a < end; ++a) {
        a->x = a->f * inverse;
        a->x2 = a->x * a->x;
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

// Takes off what digs into them and is none of the body, and returns what that changes by over a position; the shares of what
// digs still lack the division by the sum of squares.
Real Path::addDents(Real position, Part* parts, int count)
{
    Real digging(0);
    const auto dig = [&](Real f, Real rate, int slot, int at) {
        Real linked(0);
        for (Part *a = parts, *const end = parts + count; a < end; ++a) {
            const Real w = a->weights[slot];
            a->g += w * f;
            linked += w * a->x2;
        }
        share_[at] = linked;
        digging += linked * rate;
    };
    if (all_.hollow)
        dig(ownField_, ownRate(position), object_.slot(), 0);
    for (int i = 0; i < touched_ && all_.dented; ++i)
        if (along_[i].near->digs)
            dig(along_[i].value, along_[i].slope * along_[i].change, along_[i].near->object->slot(), i + 1);
    return digging;
}

// The field is the sum of x_k^2 g_k over the sum of x_i^2. With x_i = f_i / the strongest,
// dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2; of what digs only the last sum, in which its
// weights are below 0.
void Path::blendOdd(Real position, Sample& sample)
{
    shared_ = true;
    Part parts[NEIGHBOURS_MAX + 1];
    Real strongest(0);
    const int count = findParts(position, parts, &strongest);
    const Part* const end = parts + count;
    const bool mayBePlain = !all_.inner && !nearby_.dented();
    if (strongest <= NOTHING || (mayBePlain && areAllLinked(parts, end)))
        return;
    const Real inverse = quotient(Real(1), strongest), twice = inverse + inverse;
    const Real share = quotient(Real(1), addLinks(parts, end, inverse));
    if (all_.inner)
        addInner(parts, end);
    const Real digging = addDents(position, parts, count);
    Real above(0);
    for (const Part* a = parts; a < end; ++a)
        above += a->x2 * a->g;
    const Real field = above * share;
    sample.excess = field - ISOVALUE;
    Real slope(0);
    for (const Part* a = parts; a < end; ++a) {
        const Real part = (a->x * (a->g - field) * twice + a->x2 + a->linked) * share;
        share_[a->at] = part;
        slope += part * a->rate;
    }
    sample.slope = slope + digging * share;
    if (all_.hollow)
        share_[0] = share_[0] * share;
    for (int i = 0; i < touched_ && all_.dented; ++i)
        if (along_[i].near->digs)
            share_[i + 1] = share_[i + 1] * share;
}
