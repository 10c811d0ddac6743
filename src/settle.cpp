// How seeds settle and are drawn by default: the surface of the report's update(), found with less work.
//
// What is different from the printed method (printed.cpp):
// - A run of seeds (a Patch) that no neighbour reaches rests at position 1.0 exactly, and needs no look at the field.
// - Along a path the squared distance to a neighbour's centre is a polynomial of the position, so that a look costs a
//   few multiplications. Its derivative comes along: Newton's method instead of slope -1.
// - The normal is the gradient, put together from the slopes of the last look, instead of three more samples.
// - A scale is as large as the part of the surface that is the seed's own, in each direction as the viewer sees it. The
//   seed keeps it, counted from the object's centre, as long as neither the seed nor the viewer's side of it changes.
#include "shade.h"
#include "softobj.h"

namespace {

// A seed is looked for to within 0.01 of the field. Newton's last step is taken without another look when it is short.
constexpr Real SHORT_STEP(0.05);     // of the position: what remains after it is below 2 SHORT_STEP^2 in the field
constexpr Real LONGEST_STEP(0.25);   // of the position
constexpr int LOOK_LIMIT = 8;        // then the surface is bracketed and bisected
constexpr Real FLAT(-0.2);           // slope above which Newton's method is not trusted

// No valid seed lies farther out: there its own field is 0.013, and a neighbour that makes up the rest alone is stronger by
// more than the overshoot.
constexpr Real POSITION_MOST(1.85);
// Squared distance / squared size from which a neighbour is left out: its field is 0.006 there, inside the tolerance.
constexpr Real TOUCHING(0.9);
// Where a path is looked at for the first time outside the surface, when nothing is known of it.
const Real PROBES[] = {Real(1.15), Real(1.35), POSITION_MOST};
const Real PROBES_BETWEEN[] = {Real(1.08), Real(1.25), Real(1.45), Real(1.6)};
constexpr Real NEARLY(0.04);  // of the field: how near the isovalue it must have come there to be looked at in between
// Squared distance / squared size up to which a neighbour alone fills what the own field lacks at POSITION_MOST: its
// field is 0.477 there, which with the own 0.013 is the isovalue but for the tolerance.
constexpr Real BURYING(0.265);
constexpr Real DISPLACEMENT(0.008);  // of the field at the seed's last place: less is taken as not moved

// A neighbour in range, as the seeds of this object see it.
struct Near {
    const SoftObject* object;
    Real weight;
    bool plain;      // weight 1
    bool quick;      // both cores are points: the polynomial below holds
    Vector fromIt;   // from its centre to this object's centre
    Real reach;      // its size
    Real ratio;      // weight (own size / its size)^2: its share of the gradient
    Real a0, c0;     // t = a0 + position (b + position c0)
    Vector twice;    // b = path . twice; in 16.16: scaled by 2^12 and used with mulHigh
    Real swing;      // length of twice: how much b changes over a unit
    Real touching;   // b below this: its field reaches the seed at rest
    Real meeting;    // b below this: its field reaches the path somewhere up to POSITION_MOST
    Real burying;    // b below this: the whole stretch of the path up to POSITION_MOST lies inside the surface
    Vector fromIt16; // fromIt / 16
    uint32_t mark;   // for SoftObject::Patch::reached
};

// b of a path, see Near.
inline Real alongPath(const Near& near, const Vector& path)
{
#if FB_REAL == FB_FIXED
    return shiftUp(Real::fromRaw(mulHigh(path.x.raw, near.twice.x.raw) + mulHigh(path.y.raw, near.twice.y.raw) +
                                 mulHigh(path.z.raw, near.twice.z.raw)), 4);
#else
    return dot(path, near.twice);
#endif
}

// How long seeds wait (travel()): units of travel for a field difference of 1 in sizes, for a facing of 1 in radii.
constexpr Real WAIT_FIELD(0.3);
constexpr Real WAIT_FACING(1.0);
constexpr Real WAIT_APART(0.45);  // and for a difference of 1 in squared distance / squared size

constexpr int32_t OVER_BACK = 128;  // 1/256 unit: how far a seed beyond the border is set back

constexpr Real TWICE_LIMIT(7.9);  // units of twice, so that its scaled form fits

inline Vector scaledTwice(const Vector& v)
{
#if FB_REAL == FB_FIXED
    return {shiftUp(v.x, 12), shiftUp(v.y, 12), shiftUp(v.z, 12)};
#else
    return v;
#endif
}

}  // namespace

// Settles the seeds of one object. Holds what is constant over its update.
class Settler {
public:
    Settler(SoftObject& object, const Look& look) : o_(object), look_(look) {}
    void settle();

private:
    enum Reach { UNREACHED, REACHED, BURIED };
    Reach reachOf(const SoftObject::Patch& patch, uint32_t& reached);
    void rest(SoftObject::Patch& patch);
    void bury(SoftObject::Patch& patch);
    bool waits(const Seed& s) const
    {
        return (s.flags & SEED_WAITS) && static_cast<int16_t>(s.due - travel_) > 0;
    }
    template <bool PLAIN>
    void settlePatches();
    template <bool PLAIN>
    void settleSeed(Seed& s);
    template <bool PLAIN>
    Real lookAt(Real position, Real& slope);
    template <bool PLAIN>
    bool newton(Real& position, Real field, Real slope);
    void travel();
    void wait(Seed& s, uint8_t flags, Real units);
    void lookFrom(const Seed& s);
    void restTapered(Seed& s);
    template <bool PLAIN>
    bool bracket(Real& position);
    template <bool PLAIN>
    void shade(Seed& s, Real position);
    void addNear(const Link& link);

    SoftObject& o_;
    const Look& look_;
    Near near_[NEAR_MOST];
    int nearCount_ = 0;

    // Of the patch at hand, and of those the ones that reach the seed at hand.
    const Near* active_[NEAR_MOST];
    int activeCount_ = 0;
    const Near* touch_[NEAR_MOST];
    int touchCount_ = 0;
    int rootIndex_ = -1;
    Vector path_;                    // not in the plain case, where the root is the centre
    Point root_;
    Skew skew_;
    Real b_[NEAR_MOST];
    Real ownSlope_;                  // of the last look
    Real slopes_[NEAR_MOST];         // dF/dt of each active neighbour, weight not included
    Vector from_[NEAR_MOST];         // not quick ones: from the nearest point of the core, / 16
    Real strength_;                  // by how much the strongest neighbour is stronger than the overshoot allows
    Real buried_;                    // least excess of the field where bracket() looked in vain
    Real overshoot_;
    uint32_t looks_ = 0;
    uint16_t travel_ = 0;
    Real waiting_, waitingApart_;    // units of travel for a difference of 1 in the field, in squared distance
    int32_t facingWait_;             // 1/16 unit of travel for a facing of 1/32 unit, 16 bits of fraction
    Real parting_;                   // difference of positions that activates the seed between
    EyeSide eye_;
    Real horizon_;                   // of the object in general
    int32_t setBack_;                // 2^31 / radius
    ShadeSetup shadeSetup_;
};

void Settler::addNear(const Link& link)
{
    const SoftObject& other = *link.object;
    Near& n = near_[nearCount_++];
    n.object = &other;
    n.mark = static_cast<uint32_t>(other.number()) * 0x9e3779b1u | 1;
    n.weight = link.weight;
    n.plain = link.weight == Real(1);
    n.fromIt = o_.centre() - other.centre();
    n.reach = other.size();
    const Real proportion = least(o_.size() / other.size(), Real(20));
    n.ratio = proportion * proportion * link.weight;
    n.fromIt16 = n.fromIt * Real(1.0 / 16);
    n.quick = false;
    if (o_.coreReach() > Real(0) || other.coreReach() > Real(0))
        return;
    // E = fromIt, R its size: |E + position path|^2 / R^2.
    const Real inverse = Real(16) / other.size();
    const Vector e = n.fromIt * inverse;
    const Real r = o_.radius() * inverse;
    if (absolute(e.x) > Real(80) || absolute(e.y) > Real(80) || absolute(e.z) > Real(80) || r > Real(80))
        return;
    n.a0 = shiftDown(dot(e, e), 8);
    n.c0 = shiftDown(r * r, 8);
    const Vector twice = e * (inverse * Real(1.0 / 128));
    if (absolute(twice.x) > TWICE_LIMIT || absolute(twice.y) > TWICE_LIMIT || absolute(twice.z) > TWICE_LIMIT)
        return;
    n.twice = scaledTwice(twice);
    n.swing = length(twice) + Real(0.0001);
    // At rest, or a way further out where other neighbours may have pulled the seed.
    n.touching = most(TOUCHING - n.a0 - n.c0, (TOUCHING - n.a0 - n.c0 * Real(1.44)) * Real(1 / 1.2));
    n.meeting = most(n.touching, most((TOUCHING - n.a0 - n.c0 * Real(2.25)) * Real(1 / 1.5),
                                      (TOUCHING - n.a0 - n.c0 * (POSITION_MOST * POSITION_MOST)) * (Real(1) / POSITION_MOST)));
    // t is convex along the path: what holds at both ends of the stretch holds between.
    n.burying = least(BURYING - n.a0 - n.c0,
                      (BURYING - n.a0 - n.c0 * (POSITION_MOST * POSITION_MOST)) * (Real(1) / POSITION_MOST));
    if (!n.plain && n.weight < Real(1))
        n.burying = -n.a0 - n.c0;  // too weak to bury alone
    n.quick = true;
}

void Settler::settle()
{
    Link links[NEAR_MOST];
    const int count = o_.findNear(links);
    for (int i = 0; i < count; ++i)
        addNear(links[i]);

    o_.displaced_ = false;
    // A seed stays valid a way past the border where a neighbour becomes stronger: as a distance, about one spacing and
    // a half. The fields of the two change by about 3 / size a unit there.
    overshoot_ = least(Real(1.2) * o_.spacing_ / o_.size_, Real(0.7));
    parting_ = Real(1.0) * o_.spacing_ / o_.radius_;
    eye_.set(look_.eye - o_.centre_, o_.radius_, o_.coreReach());
    horizon_ = o_.horizonRadius(look_.eye);
    eye_.horizon(horizon_);
    travel();
    skew_.root(o_.centre_ - look_.eye, o_.radius_ * POSITION_MOST);
    setBack_ = mulDiv(1 << 30, 1 << 17, rawFromReal(most(o_.radius_, Real(2))));
    shadeSetup_.set(look_.light, o_.spacing_);

    bool plain = o_.isBall();
    for (int i = 0; i < nearCount_; ++i)
        plain = plain && near_[i].quick && near_[i].plain;
    if (plain)
        settlePatches<true>();
    else
        settlePatches<false>();
    look_.counts->iterations += looks_;
}

// Adds up how far neighbours and viewer have moved against the object since its last update, and finds how long seeds may
// wait: a field changes by at most about 2 / size a unit, a normal turns by about 1 / radius.
void Settler::travel()
{
    const auto step = [](Vector& last, const Vector& now) {
        const Vector d = now - last;
        last = now;
        return absolute(d.x) + absolute(d.y) + absolute(d.z);
    };
    Real farthest(0), smallest = o_.size_;
    bool balls = o_.coreReach() == Real(0);
    for (List<Link>::Node* node = o_.skel_.first(); node != nullptr; node = node->next) {
        const SoftObject& other = *node->item.object;
        farthest = most(farthest, step(node->item.apart, other.centre_ - o_.centre_) +
                                      absolute(other.size_ - node->item.size));
        node->item.size = other.size_;
        smallest = least(smallest, other.size_);
        balls = balls && other.coreReach() == Real(0);
    }
    const Real eye = step(o_.eyeApart_, look_.eye - o_.centre_);
    const Real sum = farthest + shiftDown(eye, 3) + absolute(o_.size_ - o_.sizeSeen_);
    o_.sizeSeen_ = o_.size_;
    // Where a turn may matter seeds are looked at every time.
    const int32_t steps = (rawFromReal(least(sum, Real(1000))) >> 12) + 1;
    o_.travel_ = static_cast<uint16_t>(o_.travel_ + (balls && steps < SoftObject::TRAVEL_JUMP ? steps : SoftObject::TRAVEL_JUMP));
    travel_ = o_.travel_;
    waiting_ = smallest * WAIT_FIELD;
    waitingApart_ = smallest * WAIT_APART;
    facingWait_ = mulDiv(rawFromReal(o_.radius_ * WAIT_FACING), 16, eye_.distance32());
}

// Nothing to see of this seed until things have moved by `units` (0..100).
inline void Settler::wait(Seed& s, uint8_t flags, Real units)
{
    s.flags = static_cast<uint8_t>(flags | SEED_WAITS);
    s.due = static_cast<int16_t>(travel_ + (rawFromReal(units) >> 12));
}

// Which neighbours reach the patch: they become the active ones.
Settler::Reach Settler::reachOf(const SoftObject::Patch& patch, uint32_t& reached)
{
    activeCount_ = 0;
    bool touched = false;
    for (int i = 0; i < nearCount_; ++i) {
        const Near& near = near_[i];
        if (near.quick) {
            const Real b = alongPath(near, patch.middle), change = near.swing * patch.radius;
            if (b + change < near.burying)
                return BURIED;
            touched |= b - change < near.touching;
            if (b - change < near.meeting) {
                active_[activeCount_++] = &near;
                reached += near.mark;
            }
        } else {
            const Vector v = near.object->fromCore(o_.centre_ + patch.middle);
            const Real limit = near.reach + patch.radius;
            if (absolute(v.x) < limit && absolute(v.y) < limit && absolute(v.z) < limit) {
                touched = true;
                active_[activeCount_++] = &near;
                reached += near.mark;
            }
        }
    }
    return touched ? REACHED : UNREACHED;
}

void Settler::bury(SoftObject::Patch& patch)
{
    Seed* s = o_.seeds_ + 2 * patch.first;
    for (int i = 2 * patch.count; i > 0; --i, ++s) {
        s->position = Real(1);
        s->flags = 0;
    }
    patch.state = SoftObject::PATCH_BURIED;
}

void Settler::rest(SoftObject::Patch& patch)
{
    Seed* s = o_.seeds_ + 2 * patch.first;
    for (int i = patch.count; i > 0; --i, s += 2) {
        s->position = Real(1);
        s->flags = SEED_VALID;
        s->voxel.brightness = s->restBrightness;
        s[1].flags = 0;
    }
    patch.state = SoftObject::PATCH_AT_REST;
    patch.laid = o_.drift_;
    if (o_.tapers_)
        patch.stale = SoftObject::STALE_ALL;  // from paths to normals
}

// The field at a position of the path at hand (0.95 .. POSITION_MOST), its slope along the path, and what the normal
// needs. PLAIN: all neighbours are quick and have weight 1.
template <bool PLAIN>
inline Real Settler::lookAt(Real position, Real& slope)
{
    ++looks_;
    const FieldStep& own = geoffQuick(shiftDown(position * position, 2));
    Real field = own.value, steep = own.slope * shiftDown(position, 1), strongest(0);
    ownSlope_ = own.slope;
    for (int n = 0; n < touchCount_; ++n) {
        const Near& near = *touch_[n];
        Real t, change;
        if (PLAIN || near.quick) {
            const Real c = position * near.c0;
            change = b_[n] + c;
            t = near.a0 + position * change;
            change += c;
        } else {
            Vector v;
            t = near.object->param(root_ + path_ * position, &v);
            from_[n] = v * Real(1.0 / 16);
            const Real inverse = Real(16) / near.reach;
            change = shiftDown(dot(v * inverse, path_ * inverse), 7);
        }
        if (static_cast<uint32_t>(rawFromReal(t)) >= 65536) {
            slopes_[n] = Real(0);
            continue;
        }
        const FieldStep& step = geoffQuick(t);
        slopes_[n] = step.slope;
        Real part = step.value, partSlope = step.slope * change;
        if (!PLAIN && !near.plain) {
            part = part * near.weight;
            partSlope = partSlope * near.weight;
        }
        field += part;
        steep += partSlope;
        strongest = most(strongest, part);
    }
    slope = steep;
    strength_ = strongest - own.value - overshoot_;
    return field;
}

// a / b where the quotient is known to fit.
inline Real quotient(Real a, Real b)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulDiv(a.raw, 65536, b.raw));
#else
    return a / b;
#endif
}

// From a position near the surface, and what a look there found. False: the method does not apply here. Leaves the last
// look's terms for the normal.
template <bool PLAIN>
inline bool Settler::newton(Real& position, Real field, Real slope)
{
    for (int i = 0; i < LOOK_LIMIT; ++i) {
        if (slope > FLAT)
            return false;
        const Real step = clamp(quotient(ISOVALUE - field, slope), -LONGEST_STEP, LONGEST_STEP);
        position += step;
        if (position < Real(0.95) || position > POSITION_MOST)
            return false;
        if (absolute(step) <= SHORT_STEP)
            return true;
        field = lookAt<PLAIN>(position, slope);
    }
    ++look_.counts->unsettled;
    return false;
}

// From nothing: where the path leaves the surface before POSITION_MOST. Inside at 1, where the own field alone is the
// isovalue. False: it does not leave.
template <bool PLAIN>
bool Settler::bracket(Real& position)
{
    Real slope;
    Real inside(1), outside(0);
    // Looks outwards until the path has left; true if it has.
    const auto leaves = [&](const Real* probe, int count) {
        inside = Real(1);
        for (; count > 0; --count, ++probe) {
            const Real excess = lookAt<PLAIN>(*probe, slope) - ISOVALUE;
            if (excess < Real(0)) {
                outside = *probe;
                return true;
            }
            buried_ = least(buried_, excess);
            inside = *probe;
        }
        return false;
    };
    buried_ = Real(1);
    // Where it nearly left it may have between the places looked at, and gone into something else.
    if (!leaves(PROBES, 3) && !(buried_ < NEARLY && leaves(PROBES_BETWEEN, 4)))
        return false;
    position = shiftDown(inside + outside, 1);
    for (int i = 0; i < LOOK_LIMIT; ++i) {
        const Real difference = lookAt<PLAIN>(position, slope) - ISOVALUE;
        if (difference >= Real(0))
            inside = position;
        else
            outside = position;
        // Where the field is flat a step of Newton's goes nowhere: halved instead.
        Real next = slope < FLAT ? position - quotient(difference, slope) : shiftDown(inside + outside, 1);
        if (absolute(next - position) <= shiftDown(SHORT_STEP, 1)) {
            position = next;
            return true;
        }
        if (next <= inside || next >= outside)
            next = shiftDown(inside + outside, 1);
        position = next;
    }
    return true;
}

inline void Settler::lookFrom(const Seed& s)
{
    if (s.root == rootIndex_)
        return;
    rootIndex_ = s.root;
    eye_.root(root_ - o_.centre_);
    skew_.root(root_ - look_.eye, o_.radius_ * POSITION_MOST);
    eye_.horizon(o_.horizonAt(root_, horizon_));
    if (o_.tapers_)
        eye_.rootRadius(shiftDown(o_.sizeAt(root_), 1));
}

// The normal of an object that tapers is not the path, so beside placed seeds the ones at rest are shaded like them.
void Settler::restTapered(Seed& s)
{
    s.position = Real(1);
    lookFrom(s);
    touchCount_ = 0;
    Real slope;
    lookAt<false>(Real(1), slope);
    shade<false>(s, Real(1));
}

template <bool PLAIN>
void Settler::settleSeed(Seed& s)
{
    const Vector path{s.path.x, s.path.y, s.path.z};
    if (!PLAIN) {
        path_ = path;
        root_ = o_.roots_[s.root];
    }

    // Which neighbours are near enough to matter, or one so near that the seed lies inside anyway?
    int touching = 0;
    bool touched = false;
    Real apart(1);
    for (int n = 0; n < activeCount_; ++n) {
        const Near& near = *active_[n];
        if (PLAIN || near.quick) {
            const Real b = alongPath(near, path);
            const Real beyond = b - near.touching;
            if (beyond < Real(0)) {
                if (b < near.burying) {
                    s.position = Real(1);
                    o_.displaced_ = true;
                    wait(s, 0, (near.burying - b) * waitingApart_);
                    return;
                }
                touched = true;
            } else {
                apart = least(apart, beyond);
            }
            if (b < near.meeting) {
                b_[touching] = b;
                touch_[touching++] = &near;
            }
        } else {
            // At rest, or a way further out where other neighbours may have pulled the seed.
            Vector unused;
            touched = touched || near.object->param(root_ + path, &unused) < TOUCHING ||
                      near.object->param(root_ + path * Real(1.2), &unused) < TOUCHING;
            touch_[touching++] = &near;
        }
    }
    touchCount_ = touching;
    if (!touched) {
        if (!PLAIN && o_.tapers_) {
            restTapered(s);
            return;
        }
        s.position = Real(1);
        // One that was at rest before lies as it did.
        wait(s, s.flags & SEED_PLACED ? SEED_VALID : SEED_VALID | (s.flags & (SEED_KEPT | SEED_FRONT)), apart * waitingApart_);
        s.voxel.brightness = s.restBrightness;
        return;
    }
    if (!PLAIN)
        lookFrom(s);
    const int32_t away = eye_.away(eye_.along(s));
    if (away > 0) {
        s.flags = SEED_WAITS;
        s.due = static_cast<int16_t>(travel_ + (away * facingWait_ >> 16));
        return;
    }
    ++look_.counts->updated;
    o_.displaced_ = true;
    Real position = s.position;
    bool settled = false;
    if (s.flags & (SEED_VALID | SEED_PLACED)) {
        Real slope;
        const Real field = lookAt<PLAIN>(position, slope);
        if ((s.flags & SEED_KEPT) && strength_ <= Real(0) && absolute(field - ISOVALUE) <= DISPLACEMENT)
            return;  // where it was, and what is known of it holds
        settled = newton<PLAIN>(position, field, slope);
    }
    if (!settled && !bracket<PLAIN>(position)) {
        // Inside everywhere: buried by this much of the field at least.
        s.position = Real(1);
        wait(s, 0, buried_ * waiting_);
        return;
    }
    s.position = position;
    if (strength_ > Real(0)) {
        wait(s, SEED_PLACED, strength_ * waiting_);
        return;
    }
    shade<PLAIN>(s, position);
}

// Brightness, extents and tilt from the gradient of the field, put together from the last look.
template <bool PLAIN>
inline void Settler::shade(Seed& s, Real position)
{
    // -grad F, but for a factor: path position (ownSlope + sum slope ratio) + sum slope ratio fromIt.
    Real along = ownSlope_;
    Vector g{Real(0), Real(0), Real(0)};
    for (int n = 0; n < touchCount_; ++n) {
        const Near& near = *touch_[n];
        const Real share = slopes_[n] * near.ratio;
        if (PLAIN || near.quick) {
            along += share;
            g = g - near.fromIt16 * share;
        } else {
            g = g - from_[n] * share;
        }
    }
    if (!PLAIN && o_.tapers_) {
        Vector slope;
        o_.param(root_ + s.path * position, &slope);
        g = g - slope * shiftDown(along, 4);
    } else {
        g = g - s.path * shiftDown(along * position, 4);
    }
    const Normal normal = normalise(g);
    const int32_t cosine = (normal.x * s.dirX + normal.y * s.dirY + normal.z * s.dirZ) >> 14;
    const int32_t facing = eye_.facing(normal, cosine, position);
    if (!eye_.faces(facing)) {
        s.flags = SEED_VALID | SEED_PLACED | SEED_WAITS;
        s.due = static_cast<int16_t>(travel_ + (-facing * facingWait_ >> 16));
        return;
    }
    ++look_.counts->normals;
    s.flags = SEED_VALID | SEED_PLACED | SEED_KEPT | SEED_FRONT;
    if (strength_ + overshoot_ > Real(0))
        s.flags |= SEED_OVER;
    s.voxel.brightness = shadeSetup_.brightness(normal);
    const Vector out = s.path * position;
    const int32_t depth = skew_.depth(out);
    shadeSetup_.extents(s, normal, cosine, position, skew_.x(out), skew_.y(out));
    int32_t shiftX, shiftY;
    // Blending flattens: the horizon may be farther.
    layDown(normal.x, normal.y, facing, depth, 2 * eye_.horizon(), s, shiftX, shiftY);
    // A tangent plane lies before the surface, the more the larger the scale: set back, so that of two scales the smaller
    // one, which is nearer to its seed, wins. And beyond the border the neighbour's own seeds come first.
    int32_t back = mulHigh(s.voxel.wide * s.voxel.wide + s.voxel.high * s.voxel.high, setBack_) >> 6;
    if (s.flags & SEED_OVER)
        back += OVER_BACK;
    const Vector place = PLAIN ? out : (root_ - o_.centre_) + out;
    s.voxel.x = (rawFromReal(place.x) >> 8) + shiftX;
    s.voxel.y = (rawFromReal(place.y) >> 8) + shiftY;
    s.voxel.z = (rawFromReal(place.z) >> 8) + back;
}

// All patches of the object, seed by seed where a neighbour reaches them.
template <bool PLAIN>
void Settler::settlePatches()
{
    Seed* const seeds = o_.seeds_;
    for (int p = 0; p < o_.patchCount_; ++p) {
        SoftObject::Patch& patch = o_.patches_[p];
        uint32_t reached = 0;
        const Reach reach = reachOf(patch, reached);
        if (reach == UNREACHED) {
            if (patch.state != SoftObject::PATCH_AT_REST)
                rest(patch);
            continue;
        }
        if (reach == BURIED) {
            o_.displaced_ = true;
            if (patch.state != SoftObject::PATCH_BURIED)
                bury(patch);
            continue;
        }
        if (!PLAIN && o_.tapers_ && patch.state != SoftObject::PATCH_MIXED)
            patch.stale = SoftObject::STALE_ALL;  // from normals to paths
        if (patch.state != SoftObject::PATCH_MIXED)
            patch.laid = o_.drift_;
        patch.state = SoftObject::PATCH_MIXED;
        if (patch.stale != SoftObject::STALE_NONE)
            o_.posePatch(patch, true);
        Seed* s = seeds + 2 * patch.first;
        Seed* const end = s + 2 * patch.count;
        if (patch.reached != reached) {
            // One that it does not know of came near: nobody waits any longer.
            patch.reached = reached;
            for (Seed* each = s; each < end; ++each)
                each->flags = static_cast<uint8_t>(each->flags & ~SEED_WAITS);
        }
        if (patch.turned) {
            patch.turned = false;
            for (Seed* each = s; each < end; ++each)
                if (each->flags & SEED_PLACED)
                    each->flags = static_cast<uint8_t>(each->flags & ~SEED_KEPT);
        }
        bool extras = false;
        for (; s < end; s += 2) {
            if (!waits(s[0]))
                settleSeed<PLAIN>(s[0]);
            Seed& extra = s[1];
            if (s->neighbour < 0)
                continue;
            Seed& other = seeds[s->neighbour];
            const uint8_t either = s->flags | other.flags;
            if (!(either & SEED_PLACED) || !(either & SEED_VALID)) {
                extra.flags = 0;
                continue;
            }
            const bool belt = ((s->flags ^ other.flags) & SEED_VALID) != 0;
            if (!belt && absolute(s->position - other.position) <= parting_) {
                extra.flags = 0;
                continue;
            }
            extras = true;
            if (!waits(extra))
                settleSeed<PLAIN>(extra);
            extra.flags |= SEED_ACTIVE;
            if (belt) {
                // A gap may show between the one that is on the surface and the other.
                Seed& valid = s->flags & SEED_VALID ? *s : other;
                if ((valid.flags & (SEED_FRONT | SEED_PLACED)) == (SEED_FRONT | SEED_PLACED)) {
                    valid.flags |= SEED_EDGE;
                    valid.due = static_cast<int16_t>(&valid == s ? &other - s : s - &other);
                }
            }
        }
        patch.extras = extras;
    }
}

void SoftObject::updateQuick(const Look& look)
{
    Settler(*this, look).settle();
}

// How a seed at rest lies in the view, for as long as the object stays about where it is.
inline void SoftObject::layAtRest(Seed& s, const Vector& root, const EyeSide& eye, const Skew& skew, const ShadeSetup& shadeSetup)
{
    s.flags = static_cast<uint8_t>((s.flags | SEED_KEPT) & ~SEED_FRONT);
    const int32_t along = eye.along(s);
    if (!eye.seen(along))
        return;
    s.flags |= SEED_FRONT;
    const int32_t depth = skew.depth(s.path);
    shadeSetup.restExtents(s, skew.x(s.path), skew.y(s.path));
    int32_t shiftX, shiftY;
    layDown(s.dirX, s.dirY, eye.restFacing(along), depth, eye.horizon(), s, shiftX, shiftY);
    s.voxel.x = (rawFromReal(root.x + s.path.x) >> 8) + shiftX;
    s.voxel.y = (rawFromReal(root.y + s.path.y) >> 8) + shiftY;
    s.voxel.z = rawFromReal(root.z + s.path.z) >> 8;
}

void SoftObject::drawQuick(const Look& look, VoxelList& list, int room, int* next)
{
    EyeSide eye;
    eye.set(look.eye - centre_, radius_, coreReach());
    const Real horizon = horizonRadius(look.eye);
    const bool manyRoots = rootCount_ > 1;
    eye.horizon(horizon);
    ShadeSetup shadeSetup;
    shadeSetup.set(look.light, spacing_);
    int p = *next;
    if (p == 0) {
        const Vector moved = (look.eye - centre_) - eyeDrawn_;
        const Real sum = absolute(moved.x) + absolute(moved.y) + absolute(moved.z);
        const int32_t steps = rawFromReal(least(sum, Real(100))) >> 10;
        // Less is left to add up, or slow moves would count for nothing.
        if (steps >= DRIFT_LEAST) {
            drift_ = static_cast<uint16_t>(drift_ + steps);
            eyeDrawn_ = look.eye - centre_;
        }
    }
    int root = -1;
    Skew skew;
    Vector rootPlace{Real(0), Real(0), Real(0)};  // from the centre
    const auto lookFrom = [&](int r) {
        root = r;
        skew.root(roots_[root] - look.eye, radius_);
        rootPlace = roots_[root] - centre_;
        eye.root(rootPlace);
        if (manyRoots)
            eye.horizon(horizonAt(roots_[root], horizon));
        if (tapers_)
            eye.rootRadius(tangentAt(roots_[root]));
    };
    if (!manyRoots)
        lookFrom(0);
    const int16_t mark = static_cast<int16_t>(rawFromReal(spacing_ * Real(1.5) + Real(1.5)) >> 8);
    const Voxel** to = list.voxels;
    const Voxel** const full = to + room - 4 * PATCH_SEEDS;
    const Voxel* const gapsFull = list.gap + GAPS_AT_ONCE - 2 * PATCH_SEEDS;
    Voxel* gap = list.gap;
    constexpr int SHOWN = SEED_VALID | SEED_KEPT | SEED_FRONT;
    for (; p < patchCount_ && to <= full && gap <= gapsFull; ++p) {
        Patch& patch = patches_[p];
        if (patch.state == PATCH_BURIED || patch.state == PATCH_UNKNOWN)
            continue;
        const bool atRest = patch.state == PATCH_AT_REST;
        const bool again = static_cast<int16_t>(drift_ - patch.laid) >= 0 || patch.stale == STALE_ALL;
        if (again) {
            patch.laid = static_cast<uint16_t>(drift_ + DRIFT_KEPT);
            patch.turned = !atRest;
            patch.back = atRest && eye.side(patch.axis, patch.across, patch.radius32, patch.spread) == EyeSide::BACK;
        }
        if (patch.back)
            continue;
        if (patch.stale == STALE_ALL)
            posePatch(patch, false);
        Seed* s = seeds_ + 2 * patch.first;
        const Seed* const end = s + 2 * patch.count;
        const int step = patch.extras && !atRest ? 1 : 2;
        if (again) {
            for (Seed* each = s; each < end; each += step)
                if (!(each->flags & SEED_PLACED))
                    each->flags = static_cast<uint8_t>(each->flags & ~SEED_KEPT);
        }
        for (; s < end; s += step) {
            if (manyRoots && s->root != root && (s->flags & SEED_VALID))
                lookFrom(s->root);
            if ((s->flags & SHOWN) != SHOWN) {
                if ((s->flags & (SEED_VALID | SEED_PLACED | SEED_KEPT)) != SEED_VALID)
                    continue;
                layAtRest(*s, rootPlace, eye, skew, shadeSetup);
                if (!(s->flags & SEED_FRONT))
                    continue;
            }
            *to++ = &s->voxel;
            if (s->flags & SEED_EDGE) {
                // A place where the surface is stretched so much that a gap may show.
                const Vector place = rootPlace + s->path * s->position + (s[s->due].path - s->path) * Real(0.625);
                *gap = {rawFromReal(place.x) >> 8, rawFromReal(place.y) >> 8, rawFromReal(place.z) >> 8, mark, mark, 0, 0, GAP};
                *to++ = gap++;
            }
        }
    }
    list.count = static_cast<int>(to - list.voxels);
    *next = p < patchCount_ ? p : 0;
}
