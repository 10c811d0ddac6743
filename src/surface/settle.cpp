// Settling seeds, one settler for every scene. Along a path the field of every neighbour is a function of the position;
// Newton's method follows its sum to the isovalue, from where the seed was in the frame before.
#include "settle.h"

#include "math/normal.h"

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
constexpr Real DEEP(0.1), VALLEY(0.12);
// Difference of the positions of two seeds, as a length in spacings, that activates the one between.
constexpr Real PARTED(1.5);

// A neighbour's field along the path at hand.
struct Along {
    const Neighbour* near;
    Real a, b, c;       // a point: t = a + p (b + p c)
    Vector from, step;  // else: from + p step, in its core space
    // At the last position looked at.
    Real value, slope;  // F and dF/dt
    Real change;        // dt/dp
    Vector out;         // half the gradient of t in its core space, times CORE_SIZE^2; no point
};

// The body's field at a position: its excess over the isovalue, its slope along the path, how much stronger than the own
// field the strongest neighbour's is.
struct Sample {
    Real excess, slope, dominance;
};

// A neighbour as the seeds of one root see it: what is the same for all of them.
struct FromRoot {
    const Neighbour* near;
    Real a, c;       // a point: squared distance of the root and squared length of the paths, over squared size
    Vector twice16;  // 32 (root - centre) / size^2
    Vector from;     // else: the root in its core space
};

// Settles seeds one by one; what is the same for several is worked out once.
class Path {
public:
    Path(SoftObject& object, const Patch& patch, const Neighbour* neighbours, const FrameContext& frame);

    // Settles one seed.
    void settle(Seed& s);

private:
    void setRoot(const Seed& s);
    bool touch(const Seed& s);
    Sample look(Real position);
    bool mutual() const;
    void blend(Real position, Sample& sample);
    bool follow(Real* position, Sample* sample);
    bool search(Real* position, Sample* sample);
    bool bisect(Real inside, Real outside, Real* position, Sample* sample);
    Vector outward(Real position) const;

    SoftObject& object_;
    const Bodies& bodies_;
    Counts& counts_;
    int reached_ = 0;
    FromRoot near_[NEIGHBOURS_MAX];
    bool complete_;       // all that reach the patch are linked with each other at weight 1

    // The path at hand.
    int rootIndex_ = -1;
    Vector root_, path_;
    bool plain_;          // the sum of the fields is F
    int touched_;
    Along along_[NEIGHBOURS_MAX];
    Real own_, ownSlope_;             // F and dF/dt of the own field at the last position
    Real share_[NEIGHBOURS_MAX + 1];  // dF/df of the own and each touched neighbour's field, if not plain
};

Path::Path(SoftObject& object, const Patch& patch, const Neighbour* neighbours, const FrameContext& frame)
    : object_(object), bodies_(*frame.bodies), counts_(*frame.counts)
{
    for (int word = 0; word < static_cast<int>(sizeof patch.reached / sizeof patch.reached[0]); ++word)
        for (uint32_t bits = patch.reached[word]; bits != 0; bits &= bits - 1)
            near_[reached_++].near = neighbours + 32 * word + __builtin_ctz(bits);
    complete_ = true;
    for (int i = 0; i < reached_ && complete_; ++i) {
        const int slot = near_[i].near->object->slot();
        complete_ = bodies_.weight(object_.slot(), slot) == Real(1);
        for (int j = 0; j < i && complete_; ++j)
            complete_ = bodies_.weight(near_[j].near->object->slot(), slot) == Real(1);
    }
    plain_ = complete_;
}

void Path::setRoot(const Seed& s)
{
    rootIndex_ = s.root;
    root_ = object_.root(s.root);
    for (int i = 0; i < reached_; ++i) {
        FromRoot& to = near_[i];
        const Neighbour& near = *to.near;
        if (near.kind == Neighbour::POINT) {
            const Vector e = (root_ - near.centre) * near.inverse16;
            const Vector d = s.path * near.inverse16;
            to.a = shiftDown(dot(e, e), 8);
            to.c = shiftDown(dot(d, d), 8);
            to.twice16 = e * shiftDown(near.inverse16, 3);
        } else {
            to.from = near.inCore(root_) + near.offset;
        }
    }
}

// Finds out which neighbours reach the path where the seed may lie. False: none.
bool Path::touch(const Seed& s)
{
    if (s.root != rootIndex_)
        setRoot(s);
    path_ = s.path;
    bool reached = false;
    Along* along = along_;
    for (const FromRoot *from = near_, *const end = near_ + reached_; from < end; ++from) {
        along->near = from->near;
        if (from->near->kind == Neighbour::POINT) {
            const Real b = shiftDown(dot(path_, from->twice16), 4);
            if (from->a + b + from->c < Real(1)) {
                reached = true;
            } else {
                // Out of reach at rest: within reach on the way out?
                const auto beyond = [&](Real p) { return from->a + p * (b + p * from->c) >= Real(1); };
                if (b + from->c + from->c >= Real(0) || (beyond(Real(1.4)) && beyond(Real(1.9))))
                    continue;
            }
            along->a = from->a;
            along->b = b;
            along->c = from->c;
        } else {
            along->from = from->from;
            along->step = from->near->inCore(path_);
            Vector unused;
            if (from->near->param(along->from + along->step, &unused) < Real(1))
                reached = true;
            else if (from->near->param(along->from + along->step * Real(1.5), &unused) >= Real(1))
                continue;
        }
        ++along;
    }
    touched_ = static_cast<int>(along - along_);
    return reached;
}

// Whether those that touch the path are all linked with each other at weight 1.
bool Path::mutual() const
{
    for (int i = 0; i < touched_; ++i) {
        const int slot = along_[i].near->object->slot();
        if (bodies_.weight(object_.slot(), slot) != Real(1))
            return false;
        for (int j = 0; j < i; ++j)
            if (bodies_.weight(along_[j].near->object->slot(), slot) != Real(1))
                return false;
    }
    return true;
}

Sample Path::look(Real position)
{
    ++counts_.iterations;
    const Real t = shiftDown(position * position, 2);
    const FieldStep own = t < Real(1) ? geoffQuick(t) : FieldStep{Real(0), Real(0)};
    own_ = own.value;
    ownSlope_ = own.slope;
    Real sum = own.value, slope = shiftDown(own.slope * position, 1), strongest(0);
    for (Along *along = along_, *const end = along_ + touched_; along < end; ++along) {
        Real param;
        if (along->near->kind == Neighbour::POINT) {
            const Real outer = position * along->c;
            param = along->a + position * (along->b + outer);
            along->change = along->b + outer + outer;
        } else {
            param = along->near->param(along->from + along->step * position, &along->out);
            along->change = shiftDown(dot(along->out, along->step), 7);
        }
        if (param >= Real(1)) {
            along->value = along->slope = Real(0);
            continue;
        }
        const FieldStep field = geoffQuick(param < Real(0) ? Real(0) : param);
        along->value = field.value;
        along->slope = field.slope;
        sum += field.value;
        slope += field.slope * along->change;
        if (field.value > strongest)
            strongest = field.value;
    }
    Sample sample{sum - ISOVALUE, slope, strongest - own.value};
    if (!plain_)
        blend(position, sample);
    return sample;
}

// The body's field where not all are linked with all at weight 1 (model/body.h), from the fields that look() found. With
// x_i = f_i / the strongest, dF/df_k = (2 x_k (g_k - F) / strongest + x_k^2 + sum of w_ik x_i^2) / sum of x_i^2.
void Path::blend(Real position, Sample& sample)
{
    const int count = touched_ + 1;
    Real f[NEIGHBOURS_MAX + 1], x2[NEIGHBOURS_MAX + 1], x[NEIGHBOURS_MAX + 1], g[NEIGHBOURS_MAX + 1];
    int slot[NEIGHBOURS_MAX + 1];
    f[0] = own_;
    slot[0] = object_.slot();
    Real strongest = own_;
    for (int i = 1; i < count; ++i) {
        f[i] = along_[i - 1].value;
        slot[i] = along_[i - 1].near->object->slot();
        strongest = most(strongest, f[i]);
    }
    if (strongest <= Real(0.0005)) {
        for (int i = 0; i < count; ++i)
            share_[i] = Real(1);
        return;
    }
    const Real inverse = Real(1) / strongest;
    Real below(0), above(0);
    for (int i = 0; i < count; ++i) {
        x[i] = f[i] * inverse;
        x2[i] = x[i] * x[i];
        g[i] = f[i];
        for (int j = 0; j < count; ++j)
            if (j != i && f[j] > Real(0))
                g[i] += bodies_.weight(slot[i], slot[j]) * f[j];
        below += x2[i];
        above += x2[i] * g[i];
    }
    const Real field = above / below, share = Real(1) / below;
    sample.excess = field - ISOVALUE;
    // Slopes, each multiplied by what it counts.
    Real slope(0);
    const Real twice = inverse + inverse;
    for (int k = 0; k < count; ++k) {
        Real part = x[k] * (g[k] - field) * twice + x2[k];
        for (int i = 0; i < count; ++i)
            if (i != k)
                part += bodies_.weight(slot[i], slot[k]) * x2[i];
        share_[k] = part * share;
    }
    slope = share_[0] * shiftDown(ownSlope_ * position, 1);
    for (int k = 1; k < count; ++k)
        slope += share_[k] * along_[k - 1].slope * along_[k - 1].change;
    sample.slope = slope;
}

// Newton's method from a sample already taken. True: `*position` is on the surface, and `*sample` was taken there or a
// short step before.
bool Path::follow(Real* position, Sample* sample)
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
bool Path::bisect(Real inside, Real outside, Real* position, Sample* sample)
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
bool Path::search(Real* position, Sample* sample)
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
Vector Path::outward(Real position) const
{
    const Real own = plain_ ? ownSlope_ : ownSlope_ * share_[0];
    const Vector place = root_ + path_ * position;
    Vector g;
    if (object_.tapers()) {
        object_.param(place * (Real(CORE_SIZE) / object_.laidSize()), &g);
        g = g * -shiftDown(own * object_.laidSize(), 4);
    } else {
        g = path_ * -(own * position);
    }
    for (int i = 0; i < touched_; ++i) {
        const Along& along = along_[i];
        if (along.slope == Real(0))
            continue;
        const Neighbour& near = *along.near;
        const Real push = -((plain_ ? along.slope : along.slope * share_[i + 1]) * near.ratio);
        if (near.kind == Neighbour::POINT)
            g = g + (place - near.centre) * push;
        else
            g = g + near.fromCoreSpace(along.out) * push;
    }
    return g;
}

void Path::settle(Seed& s)
{
    if (!touch(s)) {
        if (!(s.flags & SEED_RESTING)) {
            s.position = Real(1);
            s.normal = object_.restNormal(s);
        }
        s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_VALID | SEED_RESTING);
        return;
    }
    plain_ = complete_ || mutual();
    ++counts_.updated;
    const bool wasValid = (s.flags & SEED_VALID) != 0;
    s.flags &= SEED_ACTIVE;
    Real position = s.position;
    Sample sample = look(position);
    if (!wasValid && (sample.excess > DEEP || sample.dominance > OVERSHOOT + DEEP))
        return;
    if (!follow(&position, &sample)) {
        const bool found = search(&position, &sample);
        s.position = position;
        if (!found)
            return;
    }
    s.position = position;
    if (sample.dominance > OVERSHOOT)
        return;
    const Normal n = normalise(outward(position));
    s.normal = {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
    s.flags |= SEED_VALID;
    ++counts_.normals;
}

// Whether the seed between a seed and its neighbour N is needed: only one of the two is on the surface, or they have parted.
bool parted(const SoftObject& object, const Seed& s)
{
    if (s.neighbour < 0)
        return false;
    const Seed& n = object.seed(s.neighbour);
    if ((s.flags ^ n.flags) & SEED_VALID)
        return true;
    return (s.flags & SEED_VALID) && absolute(s.position - n.position) * object.radius() > object.spacing() * PARTED;
}

}  // namespace

void settle(SoftObject& object, Patch& patch, const Neighbour* neighbours, const FrameContext& frame)
{
    Path path(object, patch, neighbours, frame);
    uint8_t valid = 0;
    forSeeds(patch, [&](int i) {
        Seed& s = object.seed(i);
        path.settle(s);
        valid |= s.flags;
    });
    patch.barren = !(valid & SEED_VALID);
}

void oversample(SoftObject& object, const Patch& patch, const Neighbour* neighbours, const FrameContext& frame)
{
    bool any = false;
    forSeeds(patch, [&](int i) {
        Seed& extra = object.seed(i + 1);
        if (!parted(object, object.seed(i))) {
            extra.flags = 0;
            return;
        }
        any = true;
        if (!(extra.flags & SEED_ACTIVE)) {
            extra.flags = SEED_ACTIVE | SEED_VALID;
            extra.position = object.seed(i).position;
        }
    });
    if (!any)
        return;
    Path path(object, patch, neighbours, frame);
    forSeeds(patch, [&](int i) {
        if (object.seed(i + 1).flags & SEED_ACTIVE)
            path.settle(object.seed(i + 1));
    });
}

void rest(SoftObject& object, const Patch& patch)
{
    forSeeds(patch, [&](int i) {
        Seed& s = object.seed(i);
        s.position = Real(1);
        s.normal = object.restNormal(s);
        s.flags = SEED_VALID | SEED_RESTING;
        object.seed(i + 1).flags = 0;
    });
}

void lose(SoftObject& object, const Patch& patch)
{
    forSeeds(patch, [&](int i) {
        object.seed(i).flags = object.seed(i + 1).flags = 0;
        object.seed(i).position = Real(1);
    });
}
