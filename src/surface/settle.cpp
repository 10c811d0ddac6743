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
constexpr Real LONGEST_STEP(0.25);
// Of the field per position: flatter, and Newton's method has no say.
constexpr Real FLAT(-0.06);
constexpr int NEWTON_STEPS = 5;
// Positions: where paths begin and end to be searched, and in which steps. The own field ends at 2.
constexpr Real FIRST(0.7), LAST(1.98), SEARCH_STEP(0.16);
// Of the field: a seed that is this far inside where it was nearest to the surface is still inside a frame later; and
// a valley this shallow above the isovalue is looked into.
constexpr Real DEEP(0.06), VALLEY(0.12);
// Positions where a path that was inside comes out first: where objects part, where one sinks into another, in a neck.
constexpr int EXITS = 2;
constexpr Real EXIT[EXITS] = {Real(1.15), Real(1.5)};
// Of the field: a neighbour that is weaker than the own by less is near.
constexpr Real BORDER(0.25);
// What a field changes by at most over its size.
constexpr Real STEEPEST(1.3);
// Cosine (1.0 = 2^14) by which the middle of a patch must face away, more than its seeds differ, to be out of sight as a whole.
constexpr int32_t TURNED = 2000;
// Cosines (1.0 = 2^14) by which a seed faces away that is looked at less often.
constexpr int32_t LITTLE_AWAY = 2000, WELL_AWAY = 5000;
// Difference of the positions of two seeds, as a length in spacings, that activates the one between.
constexpr Real PARTED(1.5);

}  // namespace

Settler::Settler(SoftObject& object, const OwnFrame& own, const Neighbour* neighbours, int count, const FrameContext& frame,
                 uint32_t updates)
    : object_(object), own_(own), neighbours_(neighbours), bodies_(*frame.bodies), counts_(*frame.counts), frame_(updates)
{
    complete_ = true;
    memset(numberOf_, -1, sizeof numberOf_);
    for (int i = 0; i < count; ++i) {
        from_[i].root = -1;
        const int slot = neighbours[i].object->slot();
        numberOf_[slot] = static_cast<int8_t>(i);
        complete_ = complete_ && bodies_.weight(object_.slot(), slot) == Real(1);
        for (int j = 0; j < i && complete_; ++j)
            complete_ = bodies_.weight(neighbours[j].object->slot(), slot) == Real(1);
    }
}

void Settler::setPatch(const Patch& patch)
{
    reached_ = 0;
    smallest_ = object_.laidSize();
    for (int word = 0; word < static_cast<int>(sizeof patch.reached / sizeof patch.reached[0]); ++word)
        for (uint32_t bits = patch.reached[word]; bits != 0; bits &= bits - 1) {
            const int i = 32 * word + __builtin_ctz(bits);
            reachedBy_[reached_++] = static_cast<uint8_t>(i);
            smallest_ = least(smallest_, neighbours_[i].size);
        }
}

// What is the same for all seeds of a root.
void Settler::setRoot(const Neighbour& near, const Seed& s, FromRoot& to) const
{
    to.root = s.root;
    const Vector& root = object_.root(s.root);
    if (near.kind == Neighbour::POINT) {
        const Vector e = (root - near.centre) * near.inverse16;
        const Vector d = s.path * near.inverse16;
        to.a = shiftDown(dot(e, e), 8);
        to.c = shiftDown(dot(d, d), 8);
        to.twice16 = e * shiftDown(near.inverse16, 3);
        to.apart = root - near.centre;
    } else {
        to.apart = near.inCore(root) + near.offset;
    }
}

// Adds up the fields at one position of the path at hand.
struct Settler::Sum {
    Settler& settler;
    Real position, sum, slope, strongest;

    Sum(Settler& of, Real at) : settler(of), position(at), strongest(0)
    {
        const Real t = shiftDown(at * at, 2);
        const FieldStep own = t < Real(1) ? geoffQuick(t) : FieldStep{Real(0), Real(0)};
        settler.ownField_ = sum = own.value;
        settler.ownSlope_ = own.slope;
        slope = shiftDown(own.slope * at, 1);
    }
    // A neighbour's, from its t < 1.
    void add(Along& along, Real param)
    {
        const FieldStep field = geoffQuick(param < Real(0) ? Real(0) : param);
        along.value = field.value;
        along.slope = field.slope;
        sum += field.value;
        slope += field.slope * along.change;
        if (field.value > strongest)
            strongest = field.value;
    }
    Sample sample()
    {
        Sample all{sum - ISOVALUE, slope, strongest - settler.ownField_};
        if (!settler.complete_)
            settler.blend(position, all);
        return all;
    }
};

// Takes up the path of a seed: finds out which neighbours may reach it, and looks at the position where the seed is. Those that
// do not reach it there are kept if they might elsewhere on the path. False: none reaches it there.
bool Settler::begin(const Seed& s, Sample* sample)
{
    root_ = object_.root(s.root);
    path_ = s.path;
    const Real position = s.position;
    Sum sum(*this, position);
    Along* along = along_;
    bool touched = false;
    for (int i = 0; i < reached_; ++i) {
        const Neighbour& near = neighbours_[reachedBy_[i]];
        FromRoot& from = from_[reachedBy_[i]];
        if (from.root != s.root)
            setRoot(near, s, from);
        along->near = &near;
        along->from = &from;
        Real param;
        if (near.kind == Neighbour::POINT) {
            along->b = shiftDown(dot(path_, from.twice16), 4);
            param = along->pointChange(position);
            if (param >= Real(1)) {
                // Farther out the path leads away from it, or does not come near enough.
                if (along->change >= Real(0) ? position <= Real(1) || along->pointParam(Real(1)) >= Real(1)
                                      : along->pointParam(Real(1.5)) >= Real(1) && along->pointParam(Real(1.9)) >= Real(1))
                    continue;
                along->value = along->slope = Real(0);
                ++along;
                continue;
            }
        } else {
            along->step = near.inCore(path_);
            param = along->coreChange(position);
            if (param >= Real(1)) {
                if (along->coreParam(Real(1.3)) >= Real(1))
                    continue;
                along->value = along->slope = Real(0);
                ++along;
                continue;
            }
        }
        touched = true;
        sum.add(*along, param);
        ++along;
    }
    touched_ = static_cast<int>(along - along_);
    ++counts_.iterations;
    *sample = sum.sample();
    return touched;
}

Sample Settler::look(Real position)
{
    ++counts_.iterations;
    Sum sum(*this, position);
    for (Along *along = along_, *const end = along_ + touched_; along < end; ++along) {
        const Real param = along->near->kind == Neighbour::POINT ? along->pointChange(position) : along->coreChange(position);
        if (param >= Real(1))
            along->value = along->slope = Real(0);
        else
            sum.add(*along, param);
    }
    return sum.sample();
}

// The body's field where not all are linked with all at weight 1 (model/body.h), from the fields that were found. With
// x_i = f_i / the strongest, dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2.
void Settler::blend(Real position, Sample& sample)
{
    // Those that have a field here, the own first.
    struct Part {
        Real f, slope, change;  // F, dF/dt, dt/dp
        Real x, x2, g, linked;  // linked: sum of w_ik x_i^2
        int slot, at;
    };
    Part parts[NEIGHBOURS_MAX + 1];
    int count = 0;
    Real strongest(0);
    const auto add = [&](Real f, Real slope, Real change, int slot, int at) {
        share_[at] = Real(1);
        if (f <= Real(0))
            return;
        strongest = most(strongest, f);
        parts[count++] = {f, slope, change, Real(0), Real(0), f, Real(0), slot, at};
    };
    add(ownField_, ownSlope_, shiftDown(position, 1), object_.slot(), 0);
    for (int i = 0; i < touched_; ++i)
        add(along_[i].value, along_[i].slope, along_[i].change, along_[i].near->object->slot(), i + 1);
    if (count < 2 || strongest <= Real(0.0005))
        return;
    const Real inverse = quotient(Real(1), strongest);
    for (int i = 0; i < count; ++i) {
        parts[i].x = parts[i].f * inverse;
        parts[i].x2 = parts[i].x * parts[i].x;
    }
    bool plain = true;
    Real below(0), above(0);
    for (int i = 0; i < count; ++i) {
        Part& a = parts[i];
        for (int j = i + 1; j < count; ++j) {
            Part& b = parts[j];
            const Real w = bodies_.weight(a.slot, b.slot);
            plain = plain && w == Real(1);
            if (w == Real(0))
                continue;
            a.g += w * b.f;
            b.g += w * a.f;
            a.linked += w * b.x2;
            b.linked += w * a.x2;
        }
        below += a.x2;
        above += a.x2 * a.g;
    }
    if (plain)
        return;
    const Real share = quotient(Real(1), below), field = above * share, twice = inverse + inverse;
    sample.excess = field - ISOVALUE;
    sample.slope = Real(0);
    for (int i = 0; i < count; ++i) {
        const Part& a = parts[i];
        const Real part = (a.x * (a.g - field) * twice + a.x2 + a.linked) * share;
        share_[a.at] = part;
        sample.slope += part * a.slope * a.change;
    }
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
        if (*position < FIRST || *position > LAST)
            return false;
        if (absolute(step) <= SHORT_STEP)
            return true;
        *sample = look(*position);
    }
    return false;
}

// Between a position inside and one outside.
bool Settler::bisect(Real inside, Real outside, Real* position, Sample* sample)
{
    for (int i = 0; i < 12; ++i) {
        *position = shiftDown(inside + outside, 1);
        *sample = look(*position);
        if (absolute(sample->excess) <= TOLERANCE)
            return true;
        if (sample->slope <= FLAT) {
            const Real step = quotient(-sample->excess, sample->slope);
            const Real to = *position + step;
            if (to > inside && to < outside && absolute(step) <= SHORT_STEP) {
                *position = to;
                return true;
            }
        }
        if (sample->excess > Real(0))
            inside = *position;
        else
            outside = *position;
    }
    return true;
}

// Looks for the first place where the path leaves the surface. False: there is none, and `*position` is where the field was
// lowest.
bool Settler::search(Real* position, Sample* sample)
{
    Real before = FIRST, lowest = FIRST;
    Sample there = look(before);
    if (there.excess < Real(0)) {
        *position = Real(1);
        return false;
    }
    Real least = there.excess;
    while (before < LAST) {
        const Real at = ::least(before + SEARCH_STEP, LAST);
        Sample now = look(at);
        if (now.excess > Real(0) && there.slope < Real(0) && now.slope > Real(0) && now.excess < VALLEY) {
            // A valley between the two: its floor is about where straight slopes cross 0.
            const Real floor = before + (at - before) * (there.slope / (there.slope - now.slope));
            const Sample deepest = look(floor);
            if (deepest.excess < Real(0))
                return bisect(before, floor, position, sample);
            if (deepest.excess < least) {
                least = deepest.excess;
                lowest = floor;
            }
        }
        if (now.excess <= Real(0))
            return bisect(before, at, position, sample);
        if (now.excess < least) {
            least = now.excess;
            lowest = at;
        }
        before = at;
        there = now;
    }
    *position = lowest;
    return false;
}

// The direction in which the field falls at a position that has just been looked at, any length, own axes: each field pushes
// away from its core by its slope over its squared size.
Vector Settler::outward(Real position) const
{
    const Real own = -(complete_ ? ownSlope_ : ownSlope_ * share_[0]);
    Vector g{Real(0), Real(0), Real(0)};
    // Points push along the path, and from where they stand to the root.
    Real along = object_.tapers() ? Real(0) : own;
    for (int i = 0; i < touched_; ++i) {
        const Along& to = along_[i];
        if (to.slope == Real(0))
            continue;
        const Real push = -((complete_ ? to.slope : to.slope * share_[i + 1]) * to.near->ratio);
        if (to.near->kind == Neighbour::POINT) {
            along += push;
            g = g + to.from->apart * push;
        } else {
            g = g + to.near->fromCoreSpace(to.out) * push;
        }
    }
    g = g + path_ * (along * position);
    if (object_.tapers()) {
        Vector slope;
        object_.param((root_ + path_ * position) * (Real(CORE_SIZE) / object_.laidSize()), &slope);
        g = g + slope * shiftDown(own * object_.laidSize(), 4);
    }
    return g;
}

// Which way and how far it is to where the strongest neighbour's field is as strong as the own, to first order.
void Settler::findBorder(Seed& s, Real dominance) const
{
    const Along* other = along_;
    for (int i = 1; i < touched_; ++i)
        if (along_[i].value > other->value)
            other = along_ + i;
    // Gradients, times half the squared size of the object.
    const Vector place = path_ * s.position;
    Vector g = place * ownSlope_;
    const Real push = other->slope * other->near->ratio;
    if (other->near->kind == Neighbour::POINT)
        g = g - (other->from->apart + place) * push;
    else
        g = g - other->near->fromCoreSpace(other->out) * push;
    const Real steep = nearLength(g), size = object_.laidSize();
    const Real distance = clamp(-dominance * size, Real(-100), Real(100)) * size * Real(0.5);
    s.apart = static_cast<int16_t>(rawFromReal(clamp(absolute(distance) < steep * Real(30) ? distance / steep : Real(30), Real(-30), Real(30))) >> 8);
    const Normal n = normalise(g);
    s.border = {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

// The mean of the objects' colours, by their fields at the position looked at last.
void Settler::mix(Seed& s) const
{
    const Paint& own = *object_.paint();
    Vector sum = own.at * ownField_;
    Real fields = ownField_;
    for (int i = 0; i < touched_; ++i) {
        sum = sum + along_[i].near->object->paint()->at * along_[i].value;
        fields += along_[i].value;
    }
    s.mix = own.paints->numberAt(sum * quotient(Real(1), fields), own.shines());
}

Real Settler::settle(Seed& s)
{
    Sample sample;
    bool touched = begin(s, &sample);
    if (!touched && s.position != Real(1)) {
        s.position = Real(1);
        touched = begin(s, &sample);
    }
    if (!touched) {
        if (!(s.flags & SEED_RESTING))
            s.normal = object_.restNormal(s);
        s.brightness8 = brightness8(s.normal, own_.light);
        s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_VALID | SEED_RESTING);
        return Real(0);
    }
    ++counts_.updated;
    const bool wasValid = (s.flags & SEED_VALID) != 0;
    s.flags &= SEED_ACTIVE;
    Real position = s.position;
    if (!wasValid && !bodies_.leapt()) {
        Real margin = most(sample.excess, sample.dominance - OVERSHOOT);
        for (int i = 0; margin > DEEP && i < EXITS; ++i) {
            const Sample there = look(EXIT[i]);
            margin = least(margin, most(there.excess, there.dominance - OVERSHOOT));
        }
        if (margin > DEEP)
            return margin;
    }
    const bool still = absolute(sample.excess) <= TOLERANCE;
    if ((!wasValid && bodies_.leapt()) || !follow(&position, &sample)) {
        const bool found = search(&position, &sample);
        s.position = position;
        if (!found)
            return sample.excess;
    }
    s.position = position;
    if (sample.dominance > OVERSHOOT)
        return sample.dominance - OVERSHOOT;
    const Normal n = normalise(outward(position));
    s.normal = {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
    s.brightness8 = brightness8(s.normal, own_.light);
    s.still = still;
    s.flags |= SEED_VALID;
    if (object_.paint() != nullptr && object_.paint()->mixes)
        mix(s);
    if (sample.dominance > -BORDER) {
        s.flags |= SEED_BORDER;
        findBorder(s, sample.dominance);
    }
    ++counts_.normals;
    return Real(0);
}

// By how much of the field the seed in the middle of a patch must lie inside, for all of the patch to do so: the other seeds
// are no farther than the patch reaches, and a field changes by about its size at most over that of its object.
static Real enough(const Patch& patch, Real size)
{
    return clamp(realFromRaw(patch.radius << 12) / size * STEEPEST, Real(0.1), Real(0.6));
}

bool Settler::blocked(const Patch& patch, const Seed& s, Real margin)
{
    const int i = numberOf_[patch.blocker];
    if (i < 0 || bodies_.leapt() || neighbours_[i].kind != Neighbour::POINT)
        return false;
    FromRoot& from = from_[i];
    if (from.root != s.root)
        setRoot(neighbours_[i], s, from);
    const Real b = shiftDown(dot(s.path, from.twice16), 4);
    const auto insideAt = [&](Real p) {
        const Real param = from.a + p * (b + p * from.c);
        if (param >= Real(0.6))
            return false;
        const Real own = geoffQuick(least(shiftDown(p * p, 2), Real(0.999))).value;
        const Real field = geoffQuick(most(param, Real(0))).value;
        return field - own > OVERSHOOT + margin || (complete_ && own + field > ISOVALUE + margin);
    };
    bool inside = insideAt(s.position);
    for (int i = 0; inside && i < EXITS; ++i)
        inside = insideAt(EXIT[i]);
    return inside;
}

bool Settler::stillInside(const Patch& patch)
{
    const int i = numberOf_[patch.blocker];
    return i >= 0 && blocked(patch, object_.seed(patch.centre), enough(patch, neighbours_[i].size));
}

// Of those that touch the seed that was settled last, the one with the strongest field.
int Settler::strongest() const
{
    int slot = 0;
    Real most(0);
    for (int i = 0; i < touched_; ++i) {
        if (along_[i].value > most) {
            most = along_[i].value;
            slot = along_[i].near->object->slot();
        }
    }
    return slot;
}

PatchState Settler::probe(Patch& patch)
{
    Seed& s = object_.seed(patch.centre);
    const Real margin = settle(s);
    if (!(s.flags & SEED_VALID)) {
        patch.blocker = static_cast<uint8_t>(strongest());
        return margin > enough(patch, smallest_) ? PATCH_INSIDE : PATCH_MIXED;
    }
    patch.facing = facing(object_, s, own_);
    return patch.facing < -(patch.spread + TURNED) ? PATCH_AWAY : PATCH_MIXED;
}

void Settler::settleRest(Patch& patch)
{
    const Seed& centre = object_.seed(patch.centre);
    const bool someAway = !(centre.flags & SEED_VALID) || patch.facing < patch.spread;
    forSeeds(patch, [&](int i) {
        Seed& s = object_.seed(i);
        if (&s == &centre)
            return;
        if (s.flags & SEED_ASLEEP) {
            // It has slept: it is likely to be where the one in the middle is.
            s.position = centre.position;
            s.flags = SEED_VALID;
        } else if (waits(s, someAway)) {
            s.brightness8 = brightness8(s.normal, own_.light);
            return;
        } else if (!(s.flags & SEED_VALID) && blocked(patch, s, DEEP)) {
            return;
        }
        settle(s);
        if (!(s.flags & SEED_VALID))
            patch.blocker = static_cast<uint8_t>(strongest());
    });
}

// Coherence over time: a seed that did not move when it was looked at waits for a frame, and so does one that faces away a
// little; one that faces well away waits for three.
bool Settler::waits(const Seed& s, bool someAway) const
{
    if ((s.flags & (SEED_VALID | SEED_RESTING)) != SEED_VALID || bodies_.hurried())
        return false;
    uint32_t mask = s.still;
    if (someAway) {
        const int32_t away = -facing(object_, s, own_);
        mask |= away > WELL_AWAY ? 3 : away > LITTLE_AWAY ? 1 : 0;
    }
    const uint32_t turn = static_cast<uint32_t>(&s - &object_.seed(0)) / 2 + frame_;
    return (turn & mask) != 0;
}

namespace {

// Whether the seed between a seed and its neighbour N is needed: only one of the two is on the surface, or they have parted.
bool parted(const SoftObject& object, const Seed& s)
{
    if (s.neighbour < 0)
        return false;
    const Seed& n = object.seed(s.neighbour);
    if (n.flags & SEED_ASLEEP)
        return false;
    if ((s.flags ^ n.flags) & SEED_VALID)
        return true;
    return (s.flags & SEED_VALID) && absolute(s.position - n.position) * object.radius() > object.spacing() * PARTED;
}

}  // namespace

void Settler::oversample(const Patch& patch)
{
    bool any = false;
    forSeeds(patch, [&](int i) {
        Seed& extra = object_.seed(i + 1);
        if (!parted(object_, object_.seed(i))) {
            extra.flags = 0;
            return;
        }
        any = true;
        if (!(extra.flags & SEED_ACTIVE)) {
            extra.flags = SEED_ACTIVE | SEED_VALID;
            extra.position = object_.seed(i).position;
        }
    });
    if (!any)
        return;
    setPatch(patch);
    forSeeds(patch, [&](int i) {
        if (object_.seed(i + 1).flags & SEED_ACTIVE)
            settle(object_.seed(i + 1));
    });
}

void rest(SoftObject& object, const Patch& patch, const OwnFrame& own)
{
    forSeeds(patch, [&](int i) {
        Seed& s = object.seed(i);
        object.seed(i + 1).flags = 0;
        if (s.flags != (SEED_VALID | SEED_RESTING)) {
            s.position = Real(1);
            s.normal = object.restNormal(s);
        }
        s.brightness8 = brightness8(s.normal, own.light);
        s.flags = SEED_VALID | SEED_RESTING;
    });
}

void light(SoftObject& object, const Patch& patch, const OwnFrame& own)
{
    forSeeds(patch, [&](int i) {
        Seed& s = object.seed(i);
        s.brightness8 = brightness8(s.normal, own.light);
    });
}

void sleep(SoftObject& object, const Patch& patch)
{
    forSeeds(patch, [&](int i) {
        object.seed(i + 1).flags = 0;
        if (i != patch.centre)
            object.seed(i).flags = SEED_ASLEEP;
    });
}
