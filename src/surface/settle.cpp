// Settling seeds, one settler for every scene. Along a path the field of every neighbour is a function of the position;
// Newton's method follows its sum to the isovalue, from where the seed was in the frame before.
#include "settle.h"

#include "math/normal.h"
#include "model/paint.h"
#include "rt.h"

namespace {

// Of the field: a seed that is this near the isovalue is on the surface.
constexpr Real TOLERANCE(0.004);
// Of the position: after a step as short as this another look would change nothing that is seen.
constexpr Real SHORT_STEP(0.05);
constexpr Real LONGEST_STEP(0.15);
// Of the field per position: flatter, and Newton's method has no say.
constexpr Real FLAT(-0.06);
constexpr int NEWTON_STEPS = 5;
// Positions: where paths begin to be searched, and those that are hollowed out or of weak objects; and in which steps.
constexpr Real FIRST(0.7), FIRST_DEEP(0.06), SEARCH_FIRST(0.88), SEARCH_STEP(0.16);
// At position COVERED_AT the own field is .23. A neighbour whose t is less than `there` at it is stronger by more than the overshoot
// tolerance; and if its t is less than `atRest` at position 1, then between the two the body's field is above the isovalue. What is
// not linked with the object must have that field alone. The roots of both.
constexpr Real COVERED_AT(1.36), BETWEEN(1.18);
constexpr Cover COVER_LINKED{Real(0.4), Real(0.7), Real(0.632), Real(0.836)};
constexpr Cover COVER_UNLINKED{Real(0.18), Real(0.18), Real(0.424), Real(0.424)};
// Of the field: what is linked with the object and this strong is the one that keeps its seeds off the surface.
constexpr Real COVERING(0.28);
// Of the field: what missing links take at least to be counted.
constexpr Real NEGLIGIBLE(0.002);
// Units: no seed waits while neighbours come so far in a frame.
constexpr Real HURRY(2);
// Of the field: a valley this shallow above the isovalue is looked into.
constexpr Real VALLEY(0.12);
// Of the field, times the greatest strength: a neighbour that is weaker than the own by less is near.
constexpr Real BORDER(0.25);
// What a field changes by at most over its size.
constexpr Real STEEPEST(1.3);
// Cosine (1.0 = 2^14) by which the middle of a patch must face away, more than its seeds differ, to be out of sight as a whole.
constexpr int32_t TURNED = 500;
// Cosines (1.0 = 2^14) by which a seed faces away that is looked at less often.
constexpr int32_t LITTLE_AWAY = 2000, WELL_AWAY = 5000;
// Position beyond which a path that is hollowed out leaves the surface for good; and the one where what closes again over a hollow
// is found.
constexpr Real OUTERMOST(0.8), CLOSING(0.95);
// Of the field, over the size: no field changes by more.
constexpr Real STEEPEST_OF_ALL(1.6);
// Spacings: how far beyond the border of its part a seed still has a scale that reaches into it.
constexpr Real SHARED(1.5);
// Difference of the positions of two seeds, as a length in spacings, that activates the one between.
constexpr Real PARTED(1.5);
// How far the border of two parts of a hollow's wall goes at most when what digs comes by a unit.
constexpr Real BORDER_SPEED(16);
// Units: how far neighbours may come at most before a patch that lies inside is looked at again.
constexpr Real LONGEST_WAIT(6);
// Positions: by how much a seed may leave the range that those of its patch were found in before all neighbours are asked.
constexpr Real RANGE(0.05);

}  // namespace

Settler::Settler(SoftObject& object, const OwnFrame& own, const Neighbourhood& all, const FrameContext& frame,
                 const Odometer& odometer, uint32_t updates)
    : object_(object), own_(own), all_(all), bodies_(*frame.bodies), counts_(*frame.counts), now_(odometer.reading()),
      came_(realFromRaw(static_cast<int32_t>(odometer.came() << 6))), updates_(updates), ownWeights_(bodies_.weights(object.slot())),
      hollow_(all.hollow), common_(all.common), ownPlain_(object.strength() == Real(1) && !all.hollow && !object.warped()),
      restParam_(object.restParam()), warped_(object.warped()), first_(all.deep ? FIRST_DEEP : FIRST),
      last_(all.last), border_(BORDER * most(object.strength(), Real(1)))
{
    const Real restOfPath = (shiftDown(last_ - first_, 1) + Real(0.02)) * object.longestPath();
    for (int i = 0; i < all.count; ++i) {
        from_[i].root = -1;
        border_ = most(border_, BORDER * all.neighbours[i].strength);
        const Real reach = Real(1) + restOfPath * shiftDown(all.neighbours[i].steep16, 4);
        reachT_[i] = reach < Real(100) ? reach * reach : Real(10000);
    }
    listed_.count = 0;
    for (int i = 0; i < all.count; ++i)
        listed_.number[listed_.count++] = static_cast<uint8_t>(i);
    allComplete_ = false;
    setComplete(listed_);
    allComplete_ = listed_.complete;
}

void Settler::findComplete(Few& few) const
{
    if (common_) {
        few.complete = true;
        for (int i = 0; i < few.count && few.complete; ++i) {
            const int slot = all_.neighbours[few.number[i]].object->slot();
            few.complete = ownWeights_[slot] == Real(1);
            for (int j = 0; j < i && few.complete; ++j)
                few.complete = bodies_.weight(all_.neighbours[few.number[j]].object->slot(), slot) == Real(1);
        }
        return;
    }
    uint32_t members[Bodies::LINK_WORDS] = {};
    const auto add = [&](int slot) { members[slot / 32] |= 1u << slot % 32; };
    const auto linked = [&](int slot) {
        const uint32_t* const plain = bodies_.plainLinks(slot);
        uint32_t missing = 0;
        for (int word = 0; word < Bodies::LINK_WORDS; ++word)
            missing |= members[word] & ~(plain[word] | (word == slot / 32 ? 1u << slot % 32 : 0));
        return missing == 0;
    };
    if (!hollow_)
        add(object_.slot());
    for (int i = 0; i < few.count; ++i)
        if (!all_.neighbours[few.number[i]].digs)
            add(all_.neighbours[few.number[i]].object->slot());
    few.complete = !all_.inner && (hollow_ || linked(object_.slot()));
    for (int i = 0; i < few.count && few.complete; ++i) {
        const Neighbour& near = all_.neighbours[few.number[i]];
        const int slot = near.object->slot();
        if (!near.digs)
            few.complete = linked(slot) && (!hollow_ || bodies_.weight(slot, object_.slot()) == -all_.weight);
        for (int j = 0; near.digs && j < few.count && few.complete; ++j) {
            const Neighbour& member = all_.neighbours[few.number[j]];
            few.complete = member.digs || bodies_.weight(member.object->slot(), slot) == -near.weight;
        }
    }
}

// What a patch has besides where not all is common.
void Settler::setOdd(const Patch& patch)
{
    if (object_.shaped())
        smallest_ = smallest_ * object_.narrowing();
    if (object_.strength() > Real(1))
        smallest_ = smallest_ / object_.strength();
    dented_ = all_.inner || hollow_;
    if (all_.dented || hollow_)
        forNeighbours(patch.listed, [&](int slot) {
            const int i = all_.numberOf[slot];
            if (i < 0)
                return;
            dented_ = dented_ || all_.neighbours[i].digs;
            smallest_ = least(smallest_, all_.neighbours[i].grain);
        });
}

bool Settler::setPatch(const Patch& patch, bool oversampled)
{
    nearest_ = realFromRaw(patch.nearest << 10);
    farthest_ = realFromRaw(patch.farthest << 10);
    patch_ = &patch;
    turn_ = static_cast<uint32_t>(patch.centre) / 2 + updates_;
    near_.count = 0;
    listed_.count = -1;
    smallest_ = object_.laidSize();
    dented_ = false;
    if (!common_)
        setOdd(patch);
    if (!isListed(patch.near)) {
        near_.complete = true;
        return false;
    }
    // Oversampled seeds lie between those of the patch and those beside it.
    const Bound ball = boundOf(patch, oversampled ? patch.radius : patch.tight);
    forNeighbours(patch.near, [&](int slot) {
        const int i = all_.numberOf[slot];
        if (i < 0 || !reaches(all_.neighbours[i], ball))
            return;
        near_.number[near_.count++] = static_cast<uint8_t>(i);
        smallest_ = least(smallest_, all_.neighbours[i].grain);
    });
    setComplete(near_);
    return near_.count > 0;
}

// All neighbours that may reach the patch, when they are needed.
const Settler::Few& Settler::listed()
{
    if (listed_.count < 0) {
        listed_.count = 0;
        forNeighbours(patch_->listed, [&](int slot) {
            if (all_.numberOf[slot] >= 0)
                listed_.number[listed_.count++] = static_cast<uint8_t>(all_.numberOf[slot]);
        });
        setComplete(listed_);
    }
    return listed_;
}

// Those that may reach a position on its paths.
const Settler::Few& Settler::those(Real position)
{
    return position < nearest_ || position > farthest_ ? listed() : near_;
}

// What is the same for all seeds of a root.
void Settler::setRoot(const Neighbour& near, const Seed& s, FromRoot& to) const
{
    // Of a shaped object each path has a length of its own.
    to.root = object_.shaped() ? -1 : s.root;
    const Vector& root = object_.root(s.root);
    if (near.kind == Neighbour::OTHER) {
        to.apart = near.inCore(root) + near.offset;
        return;
    }
    const auto inSizes = [&](const Vector& v) {
        return Vector{shiftDown(v.x * near.inverse16, 4), shiftDown(v.y * near.inverse16, 4), shiftDown(v.z * near.inverse16, 4)};
    };
    to.apart = root - near.centre;
    const Vector e = inSizes(to.apart), d = inSizes(s.path);
    to.a = dot(e, e);
    to.c = dot(d, d);
    to.twice16 = e * shiftUp(near.inverse16, 1);
    to.y = near.kind == Neighbour::SEGMENT ? shiftDown(dot(to.apart, near.toCore[1]), 4) : Real(0);
}

// What is known of a neighbour's field along the path of a seed before any position is looked at.
inline void Settler::aim(const Neighbour& near, FromRoot& from, const Seed& s, Along& along) const
{
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

// Takes up the path of a seed that is searched: as those see it that reach some of it.
void Settler::beginSearch(const Seed& s)
{
    root_ = object_.root(s.root);
    path_ = s.path;
    const Real middle = shiftDown(first_ + last_, 1);
    Few few;
    few.count = 0;
    for (int i = 0; i < listed().count; ++i) {
        const int number = listed_.number[i];
        Along& along = along_[few.count];
        aim(all_.neighbours[number], from_[number], s, along);
        if (along.param(middle) < reachT_[number])
            few.number[few.count++] = static_cast<uint8_t>(number);
    }
    few.complete = true;
    if (!listed_.complete)
        setComplete(few);
    complete_ = few.complete;
    touched_ = few.count;
}

// Adds up the fields at one position of the path at hand.
template <bool COMMON>
struct Settler::Sum {
    Settler& settler;
    Real position, sum, slope, strongest;
    bool touched;

    Sum(Settler& of, Real at) : settler(of), position(at), strongest(0), touched(false)
    {
        settler.lookedAt_ = at;
        if (!COMMON && !of.ownPlain_) {
            addOwn(of);
            return;
        }
        const Real t = shiftDown(at * at, 2);
        const FieldStep own = t < Real(1) ? geoffQuick(t) : FieldStep{Real(0), Real(0)};
        settler.ownField_ = sum = own.value;
        settler.ownSlope_ = own.slope;
        slope = shiftDown(own.slope * at, 1);
    }
    // The own field of an object that is not as strong as most, or of one whose seeds sample a hollow: it digs, and the head is
    // among its neighbours.
    SELDOM void addOwn(Settler& of)
    {
        const Real t = of.ownParam(position), strength = of.object_.strength();
        const FieldStep own = t < Real(1) ? geoffQuick(most(t, Real(0))) : FieldStep{Real(0), Real(0)};
        of.ownField_ = sum = own.value * strength;
        of.ownSlope_ = own.slope * strength;
        slope = of.ownRate(position);
        of.headField_ = Real(0);
        if (of.hollow_) {
            sum = -(sum * of.all_.weight);
            slope = -(slope * of.all_.weight);
        }
    }
    // The same of a neighbour that is not as strong as most, or digs, or has a hollow.
    SELDOM void addOdd(Along& along)
    {
        const Neighbour& near = *along.near;
        along.value = along.value * near.strength;
        along.slope = along.slope * near.strength;
        const Real weight = near.digs ? -near.weight : Real(1);
        sum += along.value * weight;
        slope += along.slope * weight * along.change;
        if (settler.hollow_ && near.object == settler.all_.head)
            settler.headField_ = along.value;
        else if (!near.digs && along.value > strongest)
            strongest = along.value;
    }
    void add(Along& along)
    {
        const Real param = along.t = along.param(position);
        if (param >= Real(1)) {
            along.value = along.slope = Real(0);
            return;
        }
        touched = true;
        const FieldStep field = geoffQuick(param < Real(0) ? Real(0) : param);
        along.value = field.value;
        along.slope = field.slope;
        if (!COMMON && !along.near->plain) {
            addOdd(along);
            return;
        }
        sum += field.value;
        slope += field.slope * along.change;
        if (field.value > strongest)
            strongest = field.value;
    }
    Sample sample()
    {
        Sample all{sum - ISOVALUE, slope, strongest - settler.ownField_};
        settler.shared_ = false;
        if (!settler.complete_)
            COMMON ? settler.blend(position, all) : settler.blendOdd(position, all);
        if (!COMMON && settler.hollow_)
            all = {-all.excess, -all.slope, strongest - settler.headField_};
        return all;
    }
};

// The own t at a position of the path of a warped object; sets ownChange_.
Real Settler::warpedParam(Real position)
{
    const Real inward = Real(CORE_SIZE) / object_.laidSize();
    const Vector step = path_ * inward;
    Vector out;
    const Real t = object_.param(root_ * inward + step * position, &out);
    ownChange_ = t < Real(1) ? shiftDown(dot(out, step), 7) : Real(0);
    return t;
}

// Takes up the path of a seed as a few neighbours see it, and looks at a position. False: none of them reaches that.
template <bool COMMON>
inline bool Settler::beginAs(const Few& few, const Seed& s, Real position, Sample* sample)
{
    root_ = object_.root(s.root);
    path_ = s.path;
    complete_ = few.complete;
    touched_ = few.count;
    Sum<COMMON> sum(*this, position);
    Along* along = along_;
    for (int i = 0; i < few.count; ++i, ++along) {
        aim(all_.neighbours[few.number[i]], from_[few.number[i]], s, *along);
        sum.add(*along);
    }
    ++counts_.iterations;
    *sample = sum.sample();
    return sum.touched;
}

template <bool COMMON>
inline Sample Settler::lookAs(Real position)
{
    ++counts_.iterations;
    Sum<COMMON> sum(*this, position);
    for (Along *along = along_, *const end = along_ + touched_; along < end; ++along)
        sum.add(*along);
    return sum.sample();
}

bool Settler::beginOdd(const Few& few, const Seed& s, Real position, Sample* sample)
{
    return beginAs<false>(few, s, position, sample);
}

Sample Settler::lookOdd(Real position)
{
    return lookAs<false>(position);
}

bool Settler::begin(const Few& few, const Seed& s, Real position, Sample* sample)
{
    return common_ ? beginAs<true>(few, s, position, sample) : beginOdd(few, s, position, sample);
}

Sample Settler::look(Real position)
{
    return common_ ? lookAs<true>(position) : lookOdd(position);
}

// The body's field where not all are linked with all at weight 1 (model/body.h), from the fields that were found: their sum, less
// D / Q, with D = sum of (1 - w_ik) f_i f_k (f_i + f_k) over all pairs and Q = sum of f_i^2. Its derivative with respect to f_i is
// 1 - (sum of (1 - w_ik) f_k (2 f_i + f_k) - 2 f_i D / Q) / Q.
void Settler::blend(Real position, Sample& sample)
{
    // Those that have a field here, the own first.
    struct Part {
        Real f, lack;  // F; the sum in its derivative
        const Real* weights;
        int slot, at;  // at: its number in along_; -1: the object
    };
    Part parts[NEIGHBOURS_MAX + 1];
    Part* end = parts;
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
    for (Part* a = parts; a < end && faint; ++a)
        a->f = quotient(a->f, strongest);
    Real lacks(0), squares(0);
    for (Part* a = parts; a < end; ++a) {
        squares += a->f * a->f;
        for (Part* b = parts; b < a; ++b) {
            const Real w = b->weights[a->slot];
            if (w == Real(1))
                continue;
            const Real one = w == Real(0) ? a->f : a->f - w * a->f, sum = a->f + b->f, product = one * b->f;
            lacks += product * sum;
            a->lack += product + (w == Real(0) ? b->f : b->f - w * b->f) * sum;
            b->lack += product + one * sum;
        }
    }
    if (absolute(lacks) <= squares * NEGLIGIBLE)
        return;
    const Real inverse = quotient(Real(1), squares), lack = lacks * inverse, twice = lack + lack;
    sample.excess -= faint ? lack * strongest : lack;
    shared_ = true;
    for (int i = 0; i <= touched_; ++i)
        share_[i] = Real(1);
    for (const Part* a = parts; a < end; ++a) {
        const Real lost = (a->lack - a->f * twice) * inverse;
        const Real rate = a->at < 0 ? shiftDown(ownSlope_ * position, 1) : along_[a->at].slope * along_[a->at].change;
        share_[a->at + 1] = Real(1) - lost;
        sample.slope -= lost * rate;
    }
}

// The same where something digs, or strengths differ (model/body.h). With
// x_i = f_i / the strongest, dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2; of what digs
// only the last sum, in which its weights are below 0.
void Settler::blendOdd(Real position, Sample& sample)
{
    shared_ = true;
    // Those that have a field here, the own first.
    struct Part {
        Real f, rate;       // F, dF/dp
        Real x, x2, g, linked;  // linked: sum of w_ik x_i^2
        const Real* weights;
        int slot, at;
    };
    Part parts[NEIGHBOURS_MAX + 1];
    Part* end = parts;
    Real strongest(0);
    share_[0] = Real(1);
    if (ownField_ > Real(0) && !hollow_) {
        strongest = ownField_;
        end->f = end->g = ownField_;
        end->rate = ownRate(position);
        end->linked = Real(0);
        end->weights = ownWeights_;
        end->slot = object_.slot();
        end->at = 0;
        ++end;
    }
    for (int i = 0; i < touched_; ++i) {
        const Along& along = along_[i];
        share_[i + 1] = Real(1);
        if (along.value <= Real(0) || along.near->digs)
            continue;
        strongest = most(strongest, along.value);
        end->f = end->g = along.value;
        end->rate = along.slope * along.change;
        end->linked = Real(0);
        end->slot = along.near->object->slot();
        end->weights = bodies_.weights(end->slot);
        end->at = i + 1;
        ++end;
    }
    bool plain = !all_.inner && !dented_;
    if ((plain && end - parts < 2) || strongest <= Real(0.0005))
        return;
    for (const Part* a = parts + 1; a < end && plain; ++a)
        for (const Part* b = parts; b < a && plain; ++b)
            plain = b->weights[a->slot] == Real(1);
    if (plain)
        return;
    const Real inverse = quotient(Real(1), strongest);
    Real below(0), above(0);
    for (Part* a = parts; a < end; ++a) {
        a->x = a->f * inverse;
        a->x2 = a->x * a->x;
        below += a->x2;
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
        if (all_.inner)
            for (Part* b = parts; b < a; ++b) {
                // What B digs into A by more than A into B.
                const Real w = a->weights[b->slot] - b->weights[a->slot];
                a->g += w * b->f;
                b->linked += w * a->x2;
            }
    }
    Real digging(0);
    const auto dig = [&](Real f, Real rate, int slot, int at) {
        Real linked(0);
        for (Part* a = parts; a < end; ++a) {
            const Real w = a->weights[slot];
            a->g += w * f;
            linked += w * a->x2;
        }
        share_[at] = linked;
        digging += linked * rate;
    };
    if (hollow_)
        dig(ownField_, ownRate(position), object_.slot(), 0);
    for (int i = 0; i < touched_ && all_.dented; ++i)
        if (along_[i].near->digs)
            dig(along_[i].value, along_[i].slope * along_[i].change, along_[i].near->object->slot(), i + 1);
    for (const Part* a = parts; a < end; ++a)
        above += a->x2 * a->g;
    const Real share = quotient(Real(1), below), field = above * share, twice = inverse + inverse;
    sample.excess = field - ISOVALUE;
    Real slope(0);
    for (const Part* a = parts; a < end; ++a) {
        const Real part = (a->x * (a->g - field) * twice + a->x2 + a->linked) * share;
        share_[a->at] = part;
        slope += part * a->rate;
    }
    sample.slope = slope;
    sample.slope += digging * share;
    if (hollow_)
        share_[0] = share_[0] * share;
    for (int i = 0; i < touched_ && all_.dented; ++i)
        if (along_[i].near->digs)
            share_[i + 1] = share_[i + 1] * share;
}

// Newton's method from a sample already taken. True: `*position` is on the surface, and `*sample` was taken there or a
// short step before.
bool Settler::follow(Real* position, Sample* sample)
{
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        if (absolute(sample->excess) <= TOLERANCE && sample->slope <= FLAT)
            return true;
        if (sample->slope > FLAT)
            return false;
        const Real step = clamp(quotient(-sample->excess, sample->slope), -LONGEST_STEP, LONGEST_STEP);
        *position += step;
        if (*position < first_ || *position > last_)
            return false;
        if (absolute(step) <= SHORT_STEP)
            return true;
        *sample = look(*position);
    }
    return false;
}

// Between a position inside and one outside.
void Settler::bisect(Real inside, Real outside, Real* position, Sample* sample)
{
    for (int i = 0; i < 12; ++i) {
        *position = shiftDown(inside + outside, 1);
        *sample = look(*position);
        if (absolute(sample->excess) <= TOLERANCE)
            return;
        if (sample->slope <= FLAT) {
            const Real step = quotient(-sample->excess, sample->slope);
            const Real to = *position + step;
            if (to > inside && to < outside && absolute(step) <= SHORT_STEP) {
                *position = to;
                return;
            }
        }
        if (sample->excess > Real(0))
            inside = *position;
        else
            outside = *position;
    }
}

// Looks for the first place where the path leaves the surface, and returns by how much the field exceeds the isovalue at least
// where it had a valley before. When the path leaves it nowhere, `*sample` exceeds it as well.
Real Settler::search(Real* position, Sample* sample)
{
    *position = COVERED_AT;
    *sample = look(COVERED_AT);
    if (sample->excess > Real(0) && sample->dominance > OVERSHOOT) {
        // Another object is the stronger for good. Has the path left the surface before?
        Real lowest = least(sample->excess, look(Real(1)).excess);
        if (lowest < VALLEY)
            lowest = least(lowest, look(BETWEEN).excess);
        if (lowest > Real(0))
            return least(lowest, sample->dominance - OVERSHOOT);
    }
    Real before = SEARCH_FIRST;
    Sample there = look(before);
    Real lowest(9);
    *position = before;
    *sample = there;
    if (there.excess < Real(0)) {
        // The path does not even begin inside: its own field is not half of what the surface takes.
        sample->excess = Real(1);
        *position = Real(1);
        return Real(0);
    }
    while (before < last_) {
        const Real at = least(before + SEARCH_STEP, last_);
        const Sample now = look(at);
        if (now.excess <= Real(0)) {
            bisect(before, at, position, sample);
            sample->excess = Real(0);
            return lowest;
        }
        if (there.slope < Real(0) && now.slope > Real(0)) {
            // A valley between the two: its floor is about where straight slopes cross 0.
            Real floor = there.excess < now.excess ? before : at;
            Sample deepest = there.excess < now.excess ? there : now;
            if (deepest.excess < VALLEY) {
                floor = before + (at - before) * (there.slope / (there.slope - now.slope));
                deepest = look(floor);
                if (deepest.excess < Real(0)) {
                    bisect(before, floor, position, sample);
                    sample->excess = Real(0);
                    return lowest;
                }
            }
            if (deepest.excess < lowest) {
                lowest = deepest.excess;
                *position = floor;
                *sample = deepest;
            }
        }
        before = at;
        there = now;
    }
    if (there.excess < lowest) {
        lowest = there.excess;
        *position = last_;
        *sample = there;
    }
    return lowest;
}

// What the fields along the path at hand change by at most, all together, when the neighbours come by a unit.
Real Settler::pushMost() const
{
    Real sum(0);
    for (int i = 0; i < touched_; ++i)
        sum += along_[i].near->push16 * along_[i].near->strength;
    return shiftDown(sum * STEEPEST_OF_ALL, complete_ ? 4 : 3);
}

// The same for a path that is hollowed out, or a weak object's: the last place where the path leaves the surface, for what lies
// before it is hidden; of those where no neighbour is stronger, if there are any. In a hollow it is the first. What is far from
// the surface is taken in long steps. Where nothing is found `off_` says by how much of the field.
Real Settler::searchDeep(Real* position, Sample* sample)
{
    // What the sum of the fields changes by at most over a position.
    Real own = shiftDown(object_.strength() * (hollow_ ? most(all_.weight, Real(1)) : Real(1)), 1) * STEEPEST_OF_ALL;
    if (warped_)
        own = own * (object_.longestPath() / (object_.laidRadius() * object_.narrowing()));
    const Real half = quotient(Real(0.5), own + pushMost() * object_.longestPath()), end = hollow_ ? last_ : first_;
    Real at = hollow_ ? first_ : last_, deepest(9), highest(-9), inside(0), outside(0);
    bool found = false;
    Sample now = look(at);
    while (true) {
        if (now.excess < deepest) {
            deepest = now.excess;
            *position = at;
            *sample = now;
        }
        highest = most(highest, now.excess);
        if (at == end)
            break;
        const Real before = at, step = absolute(now.excess) * half;
        const Sample there = now;
        at = hollow_ ? least(at + most(step, SEARCH_STEP), end) : most(at - most(step, SEARCH_STEP), end);
        now = look(at);
        if (step > SEARCH_STEP) {
            // Between the two it is no nearer to the surface than this.
            const Real between = shiftDown(shiftDown(there.excess, 1) + now.excess, 1);
            deepest = least(deepest, between);
            highest = most(highest, between);
        }
        const Sample &inner = hollow_ ? there : now, &outer = hollow_ ? now : there;
        const Real in = hollow_ ? before : at, out = hollow_ ? at : before;
        if (outer.excess > Real(0))
            continue;
        Real from = in;
        if (inner.excess <= Real(0)) {
            if (inner.slope <= Real(0) || outer.slope >= Real(0))
                continue;
            // A hill between the two: its top is about where straight slopes cross 0.
            from = in + (out - in) * (inner.slope / (inner.slope - outer.slope));
            const Real top = look(from).excess;
            highest = most(highest, top);
            if (top <= Real(0))
                continue;
        }
        const bool ours = least(inner.dominance, outer.dominance) <= OVERSHOOT;
        if (ours || !found) {
            inside = from;
            outside = out;
        }
        found = true;
        if (ours || hollow_)
            break;
    }
    if (found) {
        bisect(inside, outside, position, sample);
        sample->excess = Real(0);
        return Real(9);
    }
    if (highest <= Real(0)) {
        // All that is there lies outside.
        off_ = -highest;
        sample->excess = Real(1);
        *position = Real(1);
        return Real(0);
    }
    off_ = deepest;
    sample->excess = Real(1);
    return most(deepest, Real(0));
}

// Whether a path that led into a hollow may leave the surface farther out again.
bool Settler::hasClosed(const Seed& s)
{
    Sample sample;
    begin(listed(), s, CLOSING, &sample);
    return sample.excess > Real(0);
}

// For how long at most; the fields of those that do not reach the path yet begin gently.
Real Settler::longestOff() const
{
    return touched_ == all_.count ? LONGEST_WAIT : LIST_SLACK;
}

// A seed of what is dented, or of a hollow, that is not on the surface, or not in its own part of it, by `hold` of the field
// that changes by `push` when the neighbours come by a unit: until when it need not be looked at.
void Settler::putOff(Seed& s, Real hold, Real push) const
{
    s.flags |= SEED_OFF;
    s.due = static_cast<uint16_t>(now_ + until(hold, push, longestOff()));
}

// For how long that is so of all seeds of a patch.
Way Settler::offFor(const Patch& patch) const
{
    Way way = wayOf(LONGEST_WAIT);
    forSeeds(patch, [&](int i) {
        const Seed& s = object_.seed(i);
        const Way seeds = s.flags & SEED_OFF ? static_cast<uint16_t>(s.due - now_) : 0;
        way = seeds < way ? seeds : way;
    });
    return way;
}

bool Settler::isOff(const Seed& s) const
{
    return (s.flags & SEED_OFF) && came_ < LONGEST_WAIT && static_cast<int16_t>(static_cast<uint16_t>(now_) - s.due) < 0;
}

// Adds half the gradient of the own t at a position, times its squared size and a share: of an object whose paths slant.
void Settler::addSlanting(Vector& to, Real share, Real position) const
{
    to = to + object_.slopeAt(root_ + path_ * position) * shiftDown(share * object_.laidSize(), 4);
}

// The direction in which the field falls at a position that has just been looked at, any length, own axes: each field pushes
// away from its core by its slope over its squared size.
Vector Settler::outward(Real position) const
{
    Real own = -(shared_ ? ownSlope_ * share_[0] : ownSlope_);
    if (!shared_ && hollow_)
        own = -(own * all_.weight);
    Vector g{Real(0), Real(0), Real(0)};
    // Points push along the path, and from where they stand to the root.
    Real along = object_.slants() ? Real(0) : own;
    for (int i = 0; i < touched_; ++i) {
        const Along& to = along_[i];
        if (to.slope == Real(0))
            continue;
        Real slope = shared_ ? to.slope * share_[i + 1] : to.slope;
        if (!shared_ && to.near->digs)
            slope = -(slope * to.near->weight);
        const Real push = -(slope * to.near->ratio);
        if (to.near->kind == Neighbour::OTHER) {
            g = g + to.near->fromCoreSpace(to.out) * push;
            continue;
        }
        along += push;
        g = g + to.from->apart * push;
        if (to.near->kind == Neighbour::SEGMENT)
            g = g - to.near->direction * (to.k * to.near->size * push);
    }
    g = g + path_ * (along * position);
    if (object_.slants())
        addSlanting(g, own, position);
    return g;
}

// From the core of a neighbour to the place at hand.
inline __attribute__((always_inline)) Vector Settler::fromCore(const Along& along, Real position) const
{
    if (along.near->kind == Neighbour::OTHER)
        return along.near->fromCoreSpace(along.out);
    const Vector v = along.from->apart + path_ * position;
    return along.near->kind == Neighbour::SEGMENT ? v - along.near->direction * (along.k * along.near->size) : v;
}

// What all other fields make of the lead that one whose paths lead `out` has on one whose paths lead `from`: they are `own` and
// `steepest` steep, all together push along `g`. With a and b as unit vectors along the paths, (g.a + g.b) / (1 + a.b) is the lead.
Real Settler::leadOf(const Vector& g, const Vector& out, Real own, const Vector& from, Real steepest) const
{
    const Vector a = unit(out), b = unit(from);
    const Vector rest = (hollow_ ? -g : g) - a * own + b * steepest;
    return dot(rest, a + b) / most(Real(1) + dot(a, b), Real(0.05));
}

// A surface that something has dug is sampled twice: by the paths of what is dented, and by those of what digs. Each has the
// part where its paths are nearer to the normal: where its own field is the steeper one, if there are no others. Returns how far the seed is on its
// own side, units, to first order, and where that is no more than `shared` to either side sets its border. `*g`, the direction outward, becomes that in the middle of what the
// border leaves of the seed's cell: rims are sharp.
Real Settler::findShare(Seed& s, Real shared, Vector* g)
{
    const Real far(30);
    Vector out = path_ * s.position;
    if (object_.slants())
        out = object_.slopeAt(root_ + out) * shiftDown(object_.laidSize(), 4);
    // Steepnesses, times half the squared size of the object.
    Real own = -(ownSlope_ * nearLength(out)), steepest(0);
    if (hollow_)
        own = own * all_.weight;
    const Along* other = nullptr;
    Vector from = out;
    for (int i = 0; i < touched_; ++i) {
        const Along& along = along_[i];
        const Neighbour& near = *along.near;
        if (along.slope == Real(0) || !(hollow_ ? near.digs || near.object == all_.head : near.samples))
            continue;
        const Vector v = fromCore(along, s.position);
        const Real steep = -(along.slope * near.ratio * nearLength(v) * (near.digs ? near.weight : Real(1)));
        if (steep <= steepest)
            continue;
        steepest = steep;
        other = &along;
        from = v;
    }
    if (other == nullptr)
        return far;
    Real lead = own - steepest;
    if (touched_ > 1)
        lead += leadOf(*g, out, own, from, steepest);
    // What the digging field's steepness changes by over a unit away from its core: F'' is 34/9 - 24/9 t.
    Real t = ownParam(s.position), slope = -ownSlope_, factor = all_.weight, strength = object_.strength();
    if (!hollow_) {
        t = other->t;
        slope = -other->slope;
        factor = other->near->weight * other->near->ratio;
        strength = other->near->strength;
        out = from;
    }
    const Real rate = (slope - strength * t * (Real(68.0 / 9) - t * Real(48.0 / 9))) * factor;
    const Real most = absolute(rate);
    const Real apart = absolute(lead) < most * far ? lead / most : lead < Real(0) ? -far : far;
    if (absolute(apart) > shared)
        return apart;
    s.apart = static_cast<int16_t>(rawFromReal(apart) >> 8);
    const Normal n = normalise((rate < Real(0)) == hollow_ ? -out : out);
    s.border = {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
    const Real half = shiftDown(object_.spacing() * s.position, 1);
    if (apart >= half)
        return apart;
    const Real change = most * shiftDown(half - (apart < -half ? -half : apart), 1);
    *g = *g + withLength(hollow_ ? -out : out, hollow_ ? change : least(change, steepest));
    return apart;
}

// The same for a seed that has found the surface. False: the surface there is the others' to sample.
bool Settler::findDented(Seed& s, Vector* g)
{
    const Real shared = object_.spacing() * SHARED, apart = findShare(s, shared, g);
    if (apart < -shared) {
        s.flags |= SEED_COVERED;
        putOff(s, -apart - shared, BORDER_SPEED);
        return false;
    }
    if (apart < shared)
        s.flags |= SEED_BORDER;
    return true;
}

// The strongest neighbour but for those that dig; null: there is none. `*g` and `*change` become gradient and change of the own
// field; in a hollow what is dented stands for the object.
const Along* Settler::strongestOther(const Seed& s, Vector* g, Real* change) const
{
    *change = ownRate(lookedAt_);
    if (object_.shaped())
        *g = object_.slopeAt(root_ + path_ * s.position) * shiftDown(ownSlope_ * object_.laidSize(), 4);
    const Along* other = nullptr;
    for (int i = 0; i < touched_; ++i) {
        const Along& along = along_[i];
        if (hollow_ && along.near->object == all_.head) {
            *g = fromCore(along, s.position) * (along.slope * along.near->ratio);
            *change = along.slope * along.change;
        } else if (!along.near->digs && (other == nullptr || along.value > other->value)) {
            other = &along;
        }
    }
    return other;
}

// Which way and how far it is to where the strongest neighbour's field is as strong as the own, to first order.
void Settler::findBorder(Seed& s, Real dominance) const
{
    // Gradients, times half the squared size of the object.
    Vector g = path_ * s.position * ownSlope_;
    Real change = shiftDown(ownSlope_ * lookedAt_, 1);
    const Along* other = along_;
    if (common_) {
        for (int i = 1; i < touched_; ++i)
            if (along_[i].value > other->value)
                other = along_ + i;
    } else {
        other = strongestOther(s, &g, &change);
        if (other == nullptr)
            return;
    }
    // The fields were looked at before the last step.
    dominance += (other->slope * other->change - change) * (s.position - lookedAt_);
    g = g - fromCore(*other, s.position) * (other->slope * other->near->ratio);
    const Normal n = normalise(g);
    const Real steep = dot(g, {realFromRaw(n.x * 4), realFromRaw(n.y * 4), realFromRaw(n.z * 4)}), size = object_.laidSize();
    const Real distance = clamp(-dominance * size, Real(-100), Real(100)) * size * Real(0.5);
    s.apart = static_cast<int16_t>(rawFromReal(clamp(absolute(distance) < steep * Real(30) ? distance / steep : Real(30), Real(-30), Real(30))) >> 8);
    s.border = {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

// The mean of the objects' colours, by their fields at the position looked at last.
void Settler::mix(Seed& s) const
{
    const Paint& own = *all_.head->paint();
    // What digs has no say.
    Real fields = hollow_ ? Real(0) : ownField_;
    Vector sum = own.at * fields;
    for (int i = 0; i < touched_; ++i) {
        if (along_[i].near->digs)
            continue;
        sum = sum + along_[i].near->object->paint()->at * along_[i].value;
        fields += along_[i].value;
    }
    s.mix = fields > Real(0) ? own.paints->numberAt(sum * quotient(Real(1), fields), own.shines()) : own.number;
}

// The same where the seed has a border already: the nearer one of the two.
void Settler::findNearer(Seed& s, Real dominance) const
{
    const Seed before = s;
    findBorder(s, dominance);
    if (before.apart < s.apart)
        s = before;
}

// What the fields along the path at hand may change by, all together, when the neighbours come by a unit.
Real Settler::pushes() const
{
    // The gradient of a field is 2 f' r / R^2, and r / R no more than r^2 / R^2 + 1/4; a little more for what that changes.
    Real sum(0);
    for (int i = 0; i < touched_; ++i)
        sum += (Real(0.1) - along_[i].slope * (along_[i].t + Real(0.25))) * along_[i].near->push16;
    return shiftDown(sum, 3);
}

// How far neighbours may come that change a field by `push` in a unit until it has changed by `hold`, at most `longest`.
Way Settler::until(Real hold, Real push, Real longest)
{
    if (hold <= Real(0))
        return 0;
    return wayOf(hold < push * longest ? hold / push : longest);
}

// Leaves a seed where nothing blends with it.
void Settler::restThere(Seed& s)
{
    if (!(s.flags & SEED_RESTING)) {
        s.normal = object_.restNormal(s);
        s.flags &= SEED_ACTIVE;
    }
    s.position = Real(1);
    s.still = came_ < shiftDown(smallest_, 3);
    s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_VALID | SEED_RESTING);
}

// Whether one neighbour alone keeps a seed off the surface, wherever it was before: from position 1, before which no path can leave
// the surface, to COVERED_AT the two fields together are above the isovalue, for the neighbour's t is convex and lies below the
// straight line between those it has there; and beyond the neighbour is the stronger of the two.
bool Settler::isCovered(const Seed& s)
{
    if (dented_)
        return isOff(s);
    if (cover_ == nullptr)
        return false;
    Along along;
    aim(all_.neighbours[blocker_], from_[blocker_], s, along);
    return along.param(COVERED_AT) < cover_->there && along.param(Real(1)) < cover_->atRest;
}

// Takes up the neighbour that was the strongest where a seed of the patch was not on the surface the last time, and what it takes
// for it alone to keep seeds off.
void Settler::setBlocker(const Patch& patch)
{
    blocker_ = all_.numberOf[patch.blocker];
    // The t of what is warped need not be convex.
    const bool judged = blocker_ >= 0 && common_ && !all_.neighbours[blocker_].object->warped();
    cover_ = !judged ? nullptr : allComplete_ || isLinked(patch.blocker) ? &COVER_LINKED : &COVER_UNLINKED;
}

// Whether the object is linked with another at weight 1.
bool Settler::isLinked(int slot) const
{
    return (bodies_.plainLinks(object_.slot())[slot / 32] >> slot % 32 & 1) != 0;
}

// Sets position, normal and flags of a seed. One that finds no surface of its own object is left without SEED_VALID; returned is
// then by how much of the field it lies inside.
Real Settler::settle(Seed& s)
{
    Sample sample;
    Real position = s.position;
    bool found = false, still = false;
    Real margin(9);
    if (s.flags & (SEED_VALID | SEED_COVERED)) {
        // What is hollowed out may have closed before that.
        const bool closed = dented_ && !hollow_ && position <= OUTERMOST && hasClosed(s);
        bool touched = begin(those(position), s, position, &sample);
        if (!touched && position != Real(1)) {
            position = Real(1);
            touched = begin(listed(), s, position, &sample);
        }
        if (!touched && all_.rests) {
            restThere(s);
            return Real(0);
        }
        still = position == s.position && absolute(sample.excess) <= TOLERANCE;
        found = !closed && follow(&position, &sample);
        if (found && (position < nearest_ || position > farthest_)) {
            // Where it is now, others may reach it.
            begin(listed(), s, position, &sample);
            found = follow(&position, &sample);
        }
    }
    ++counts_.updated;
    if (still && found && (s.flags & SEED_VALID) && !(s.flags & SEED_RESTING) && sample.dominance <= OVERSHOOT) {
        // It has not moved: what is known of it holds.
        s.still = s.still == 0 || came_ * Real(3) > shiftDown(smallest_, 3) ? 1 : 3;
        if (object_.paint() != nullptr && object_.paint()->mixes)
            mix(s);
        // But the border may have.
        if (sample.dominance > -shiftDown(border_, 1) && !dented_) {
            findBorder(s, sample.dominance);
            s.flags |= SEED_BORDER;
        }
        return Real(0);
    }
    s.still = 0;
    s.flags &= SEED_ACTIVE;
    if (!found) {
        beginSearch(s);
        margin = dented_ || !all_.rests ? searchDeep(&position, &sample) : search(&position, &sample);
        found = sample.excess <= Real(0);
    }
    s.position = position;
    // Where another object is the stronger, the path may leave the surface before that in the next frame: it is searched again.
    if (!found || sample.dominance > OVERSHOOT) {
        if (dented_) {
            off_ = found ? Real(0) : off_;
            putOff(s, found ? sample.dominance - OVERSHOOT : off_, pushMost() * Real(found ? 2 : 1));
        }
        return found ? least(margin, sample.dominance - OVERSHOOT) : margin;
    }
    Vector out = outward(position);
    if (dented_ && !findDented(s, &out))
        return Real(0);
    const Normal n = normalise(out);
    s.normal = {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
    s.flags |= SEED_VALID;
    if (object_.paint() != nullptr && object_.paint()->mixes)
        mix(s);
    if (sample.dominance > -border_) {
        if (s.flags & SEED_BORDER)
            findNearer(s, sample.dominance);
        else
            findBorder(s, sample.dominance);
        s.flags |= SEED_BORDER;
    }
    ++counts_.normals;
    return Real(0);
}

// Of those that see the path at hand, the slot of the one whose field is the strongest where it was looked at last.
int Settler::strongest() const
{
    int slot = object_.slot();
    Real most(-1);
    for (int i = 0; i < touched_; ++i) {
        const int candidate = along_[i].near->object->slot();
        const Real value = along_[i].value > COVERING && isLinked(candidate) ? along_[i].value + Real(1) : along_[i].value;
        if (value > most && !along_[i].near->digs) {
            most = value;
            slot = candidate;
        }
    }
    return slot;
}

// By how much of the field the seed in the middle of a patch must lie inside, for all of the patch to do so: the other seeds
// are no farther than the patch reaches, and a field changes by about its size at most over that of its object; two change, the
// strongest and what it is compared with.
static Real enough(const Patch& patch, Real size)
{
    return clamp(realFromRaw(patch.radius << 12) / size * (STEEPEST + STEEPEST), Real(0.2), Real(0.9));
}

bool Settler::isCovered(const Patch& patch)
{
    setBlocker(patch);
    if (dented_)
        return false;
    if (cover_ == nullptr || object_.tapers())
        return false;
    const Neighbour& near = all_.neighbours[blocker_];
    return !near.object->slants() && isWithin(patch, near, COVERED_AT, cover_->rootThere) && isWithin(patch, near, Real(1), cover_->rootAtRest);
}

// The same for a patch that is dented, or of a hollow, the middle of which has been found off the surface: whether all of it is.
// The own field is the same at one position of all its paths, unless it is warped; they are no farther from each other there than twice where they rest.
PatchState Settler::probeOff(Patch& patch, const Seed& s) const
{
    if ((s.flags & SEED_COVERED) || warped_)
        return PATCH_MIXED;
    const Real push = pushMost(), hold = off_ - push * realFromRaw(patch.radius << 13);
    if (hold <= Real(0))
        return PATCH_MIXED;
    patch.due += until(hold, push, longestOff());
    return PATCH_INSIDE;
}

PatchState Settler::probe(Patch& patch)
{
    Seed& s = object_.seed(patch.centre);
    patch.due = now_;
    if (!(s.flags & SEED_VALID) && patch.state == PATCH_MIXED && isCovered(s))
        return PATCH_MIXED;
    const Real least = enough(patch, smallest_);
    const Real margin = settle(s);
    const Real push = pushes();
    if (!(s.flags & SEED_VALID)) {
        patch.blocker = static_cast<uint8_t>(strongest());
        if (dented_)
            return probeOff(patch, s);
        if (margin <= least)
            return PATCH_MIXED;
        // The own field, with which the strongest is compared, changes as well.
        patch.due += until(margin - least, push + push, LONGEST_WAIT);
        return PATCH_INSIDE;
    }
    patch.facing = facing(object_, s, own_);
    const int32_t away = own_.limb - patch.facing - patch.spread - TURNED;
    if (away > 0) {
        patch.due += wayOf(realFromRaw(away * 4) * shiftDown(object_.laidSize(), 2));
        return PATCH_AWAY;
    }
    return PATCH_MIXED;
}

// Between which positions the seeds of a patch are.
void Settler::setRange(Patch& patch) const
{
    Real nearest(9), farthest(0);
    forSeeds(patch, [&](int i) {
        const Real position = object_.seed(i).position;
        nearest = least(nearest, position);
        farthest = most(farthest, position);
    });
    patch.nearest = static_cast<uint8_t>(rawFromReal(nearest - RANGE) >> 10);
    patch.farthest = static_cast<uint8_t>(rawFromReal(farthest + RANGE) >> 10);
    if (nearest < nearest_ || farthest > farthest_) {
        // The list of those near them is made anew in the next frame.
        memcpy(patch.near, patch.listed, sizeof patch.near);
        patch.stale = true;
    }
}

void Settler::settleRest(Patch& patch)
{
    const Seed& centre = object_.seed(patch.centre);
    const bool someAway = !(centre.flags & SEED_VALID) || patch.facing < patch.spread;
    forSeeds(patch, [&](int i) {
        Seed& s = object_.seed(i);
        if (&s == &centre)
            return;
        if (!(s.flags & SEED_VALID) && isCovered(s)) {
            s.flags &= SEED_OFF;
            return;
        }
        if (s.flags & SEED_ASLEEP) {
            // It has slept: it is likely to be where the one in the middle is.
            s.position = centre.position;
            s.flags = SEED_COVERED;
            s.still = 0;
        } else if (waits(s, someAway)) {
            return;
        }
        settle(s);
        if (!(s.flags & SEED_VALID)) {
            patch.blocker = static_cast<uint8_t>(strongest());
            setBlocker(patch);
        }
    });
    if (dented_ && !patch.extras)
        patch.due += offFor(patch);
    setRange(patch);
}

// Coherence over time: a seed that did not move when it was looked at waits for a frame, and so does one that faces away a
// little; one that did not move twice, or faces well away, waits for three.
bool Settler::waits(const Seed& s, bool someAway) const
{
    if (dented_ || !(s.flags & SEED_VALID) || came_ > least(HURRY, shiftDown(smallest_, 2)))
        return false;
    uint32_t mask = s.still;
    if (someAway) {
        const int32_t away = -facing(object_, s, own_);
        mask |= away > WELL_AWAY ? 3 : away > LITTLE_AWAY ? 1 : 0;
    }
    return (turn_ & mask) != 0;
}

namespace {

// Whether the seed between a seed and its neighbour N is needed: only one of the two is on the surface, or they have parted.
bool parted(const SoftObject& object, const Seed& s)
{
    if (s.neighbour < 0)
        return false;
    const Seed& n = object.regular(s.neighbour);
    if (n.flags & SEED_ASLEEP)
        return false;
    if ((s.flags ^ n.flags) & SEED_VALID)
        return true;
    return (s.flags & SEED_VALID) && absolute(s.position - n.position) * object.radius() > object.spacing() * PARTED;
}

// The oversampled seed of a regular one is not needed; none of a patch is.
void putAway(SoftObject& object, int i)
{
    if (Seed* const extra = object.extra(i))
        extra->flags = 0;
}

void putAway(SoftObject& object, Patch& patch)
{
    if (patch.extras)
        forSeeds(patch, [&](int i) { putAway(object, i); });
    patch.extras = false;
}

}  // namespace

void Settler::oversample(Patch& patch)
{
    const bool had = patch.extras;
    bool any = false;
    forSeeds(patch, [&](int i) {
        if (!parted(object_, object_.seed(i))) {
            if (had)
                putAway(object_, i);
            return;
        }
        any = true;
        Seed& extra = object_.seed(i + 1);
        if (!(extra.flags & SEED_ACTIVE)) {
            extra.flags = SEED_ACTIVE | SEED_COVERED;
            extra.position = object_.seed(i).position;
            extra.still = 0;
        }
    });
    patch.extras = any;
    if (!any)
        return;
    patch.due = now_;
    setPatch(patch, true);
    setBlocker(patch);
    forSeeds(patch, [&](int i) {
        Seed* const extra = object_.extra(i);
        if (extra == nullptr || !(extra->flags & SEED_ACTIVE))
            return;
        if (!(extra->flags & SEED_VALID) && isCovered(*extra))
            extra->flags &= SEED_ACTIVE | SEED_OFF;
        else if (!waits(*extra, false))
            settle(*extra);
    });
}

void rest(SoftObject& object, Patch& patch)
{
    patch.nearest = patch.farthest = 64;
    patch.bend.known = false;
    putAway(object, patch);
    forSeeds(patch, [&](int i) {
        Seed& s = object.seed(i);
        if (s.flags != (SEED_VALID | SEED_RESTING)) {
            s.position = Real(1);
            s.normal = object.restNormal(s);
        }
        s.flags = SEED_VALID | SEED_RESTING;
    });
}

void sleep(SoftObject& object, Patch& patch)
{
    putAway(object, patch);
    forSeeds(patch, [&](int i) {
        if (i != patch.centre)
            object.seed(i).flags = SEED_ASLEEP;
    });
}

void cover(SoftObject& object, Patch& patch)
{
    sleep(object, patch);
    object.seed(patch.centre).flags = 0;
    patch.state = PATCH_INSIDE;
}
