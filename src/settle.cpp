// How seeds settle and are drawn by default: the surface of the report's update(), found with less work.
//
// What is different from the printed method (printed.cpp):
// - A run of seeds (a Patch) that no neighbour reaches rests at position 1.0 exactly, and needs no look at the field.
// - Along a path the squared distance to a neighbour's centre is a polynomial of the position, so that a look costs a
//   few multiplications. Its derivative comes along: Newton's method instead of slope -1.
// - The normal is the gradient, put together from the slopes of the last look, instead of three more samples.
// - A scale is as large as the part of the surface that is the seed's own, in each direction as the viewer sees it.
#include "shade.h"
#include "softobj.h"

namespace {

// Of the field. Newton's last step is taken without another look when it is short (see SHORT_STEP).
constexpr Real LOCATION_TOLERANCE(0.01);
constexpr Real SHORT_STEP(0.05);     // of the position: what remains after it is below 2 SHORT_STEP^2 in the field
constexpr Real LONGEST_STEP(0.25);   // of the position
constexpr int LOOK_LIMIT = 8;        // then the surface is bracketed and bisected
constexpr Real FLAT(-0.2);           // slope above which Newton's method is not trusted
constexpr Real POSITION_MOST(1.98);  // the own field ends at 2
constexpr Real DISPLACEMENT(0.004);  // of the position: less is taken as not moved

// A neighbour in range, as the seeds of this object see it.
struct Near {
    const SoftObject* object;
    Real weight;
    bool plain;      // weight 1
    bool quick;      // both cores are points: the polynomial below holds
    bool yields;     // smaller than this object: a seed may pass it by
    Vector fromIt;   // from its centre to this object's centre
    Real reach;      // its size
    Real ratio;      // weight (own size / its size)^2: its share of the gradient
    Real a0, c0;     // t = a0 + position (b + position c0)
    Vector twice;    // b = path . twice; in 16.16: scaled by 2^12 and used with mulHigh
    Vector fromIt16; // fromIt / 16
};

// b of a path, see Near.
inline Real alongPath(const Near& near, const Vector& path)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw((mulHigh(path.x.raw, near.twice.x.raw) + mulHigh(path.y.raw, near.twice.y.raw) +
                          mulHigh(path.z.raw, near.twice.z.raw)) << 4);
#else
    return dot(path, near.twice);
#endif
}

constexpr Real TWICE_LIMIT(7.9);  // units of twice, so that its scaled form fits

inline Vector scaledTwice(const Vector& v)
{
#if FB_REAL == FB_FIXED
    return {Real::fromRaw(v.x.raw << 12), Real::fromRaw(v.y.raw << 12), Real::fromRaw(v.z.raw << 12)};
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
    bool reaches(const Near& near, const SoftObject::Patch& patch) const;
    void rest(SoftObject::Patch& patch);
    void settleSeed(Seed& s);
    Real lookAt(Real position, Real& slope);
    bool bracket(Real& position, Real& slope);
    void shade(Seed& s, Real position);
    void addNear(const Link& link);

    SoftObject& o_;
    const Look& look_;
    Near near_[NEAR_MOST];
    int nearCount_ = 0;

    // Of the patch and seed at hand.
    const Near* active_[NEAR_MOST];
    int activeCount_ = 0;
    Vector path_;
    Point root_;
    Real b_[NEAR_MOST];
    Real own_, ownSlope_;            // of the last look
    Real slopes_[NEAR_MOST];         // dF/dt of each active neighbour, weight not included
    Vector from_[NEAR_MOST];         // not quick ones: from the nearest point of the core, / 16
    bool strongest_;                 // no neighbour is stronger than the overshoot allows
    Real overshoot_;
    EyeSide eye_;
    ShadeSetup shadeSetup_;
};

void Settler::addNear(const Link& link)
{
    const SoftObject& other = *link.object;
    Near& n = near_[nearCount_++];
    n.object = &other;
    n.weight = link.weight;
    n.plain = link.weight == Real(1);
    n.yields = other.size() < o_.size() * Real(0.8);
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
    n.quick = true;
}

void Settler::settle()
{
    Link links[NEAR_MOST];
    const int count = o_.findNear(links);
    for (int i = 0; i < count; ++i)
        addNear(links[i]);

    o_.displaced_ = false;
    o_.spread_ = Real(1);
    // A seed stays valid a way past the border where a neighbour becomes stronger: as a distance, about one spacing and
    // a half. The fields of the two change by about 3 / size a unit there.
    overshoot_ = least(Real(4.5) * o_.spacing_ / o_.size_, Real(0.35));
    eye_.set(look_.eye - o_.centre_, o_.radius_, o_.spacing_);
    shadeSetup_.set(look_.light, o_.spacing_);

    for (int p = 0; p < o_.patchCount_; ++p) {
        SoftObject::Patch& patch = o_.patches_[p];
        activeCount_ = 0;
        for (int n = 0; n < nearCount_; ++n)
            if (reaches(near_[n], patch))
                active_[activeCount_++] = &near_[n];
        if (activeCount_ == 0) {
            if (patch.state != SoftObject::PATCH_AT_REST)
                rest(patch);
            continue;
        }
        patch.state = SoftObject::PATCH_MIXED;
        Seed* s = o_.seeds_ + 2 * patch.first;
        for (int i = patch.count; i > 0; --i, s += 2) {
            settleSeed(s[0]);
            Seed& extra = s[1];
            if (s->neighbour >= 0 && (s->flags & SEED_DEFORMED) &&
                absolute(s->position - o_.seeds_[s->neighbour].position) * o_.radius_ > o_.spacing_ * Real(0.35)) {
                settleSeed(extra);
                extra.flags |= SEED_ACTIVE;
            } else {
                extra.flags = 0;
            }
        }
    }
}

bool Settler::reaches(const Near& near, const SoftObject::Patch& patch) const
{
    const Real limit = near.reach + patch.radius;
    const Vector v = near.quick ? near.fromIt + patch.middle : near.object->fromCore(o_.centre_ + patch.middle);
    if (absolute(v.x) >= limit || absolute(v.y) >= limit || absolute(v.z) >= limit)
        return false;
    const Vector h = v * Real(0.25);
    const Real q = limit * Real(0.25);
    return dot(h, h) < q * q;
}

void Settler::rest(SoftObject::Patch& patch)
{
    Seed* s = o_.seeds_ + 2 * patch.first;
    for (int i = patch.count; i > 0; --i, s += 2) {
        s->position = Real(1);
        s->flags = SEED_VALID;
        s->brightness = s->restBrightness;
        s->wide = s->restWide;
        s->high = s->restHigh;
        s[1].flags = 0;
    }
    patch.state = SoftObject::PATCH_AT_REST;
}

// The field at a position of the path at hand, its slope along the path, and what the normal needs.
inline Real Settler::lookAt(Real position, Real& slope)
{
    ++look_.counts->iterations;
    geoffQuick(least(shiftDown(position * position, 2), Real(0.999)), own_, ownSlope_);
    Real field = own_;
    slope = ownSlope_ * shiftDown(position, 1);
    const Real limit = own_ + overshoot_;
    strongest_ = true;
    for (int n = 0; n < activeCount_; ++n) {
        const Near& near = *active_[n];
        Real t, change;
        if (near.quick) {
            const Real c = position * near.c0;
            t = near.a0 + position * (b_[n] + c);
            change = b_[n] + c + c;
        } else {
            const Vector v = near.object->fromCore(root_ + path_ * position);
            t = near.object->coreParam(v);
            from_[n] = v * Real(1.0 / 16);
            const Real inverse = Real(16) / near.reach;
            change = shiftDown(dot(v * inverse, path_ * inverse), 7);
        }
        if (t >= Real(1) || t < Real(0)) {
            slopes_[n] = Real(0);
            continue;
        }
        Real part, partSlope;
        geoffQuick(t, part, partSlope);
        slopes_[n] = partSlope;
        Real steep = partSlope * change;
        if (!near.plain) {
            part = part * near.weight;
            steep = steep * near.weight;
        }
        field += part;
        slope += steep;
        if (part > limit)
            strongest_ = false;
    }
    return field;
}

// The first crossing of the isovalue along the path, for the cases that Newton's method does not settle: outwards in
// small steps from the unblended surface (where the own field alone is the isovalue), then by bisection. False: none.
bool Settler::bracket(Real& position, Real& slope)
{
    Real inside(1), outside(1);
    do {
        inside = outside;
        outside += Real(0.0625);
        if (outside > POSITION_MOST)
            return false;
    } while (lookAt(outside, slope) > ISOVALUE);
    for (int i = 0; i < 5; ++i) {
        const Real middle = shiftDown(inside + outside, 1);
        if (lookAt(middle, slope) > ISOVALUE)
            inside = middle;
        else
            outside = middle;
    }
    position = shiftDown(inside + outside, 1);
    lookAt(position, slope);
    return true;
}

void Settler::settleSeed(Seed& s)
{
    path_ = s.path;
    root_ = o_.roots_[s.root];

    // Is any neighbour near enough to matter at the unblended surface?
    bool reached = false;
    for (int n = 0; n < activeCount_; ++n) {
        const Near& near = *active_[n];
        if (near.quick) {
            b_[n] = alongPath(near, path_);
            reached |= near.a0 + near.c0 + b_[n] < Real(1);
        } else {
            reached |= near.object->coreParam(near.object->fromCore(root_ + path_)) < Real(1);
        }
    }
    if (!reached) {
        if (s.flags != SEED_VALID) {
            s.position = Real(1);
            s.flags = SEED_VALID;
        }
        s.brightness = s.restBrightness;
        s.wide = s.restWide;
        s.high = s.restHigh;
        return;
    }
    if (eye_.pathAway(s)) {
        s.flags = SEED_DEFORMED;
        return;
    }
    ++look_.counts->updated;
    const uint8_t before = s.flags;
    Real position = before & SEED_VALID ? s.position : Real(1);
    Real slope;
    bool settled = false;
    for (int i = 0; i < LOOK_LIMIT; ++i) {
        const Real difference = lookAt(position, slope) - ISOVALUE;
        if (!strongest_ && position == Real(1))
            break;  // buried at rest already
        if (slope > FLAT)
            break;
        if (i == 0 && (before & SEED_KEPT) && absolute(difference) <= DISPLACEMENT && strongest_)
            return;  // where it was, and what is known of it holds
        const Real step = clamp(-difference / slope, -LONGEST_STEP, LONGEST_STEP);
        position += step;
        if (absolute(step) <= SHORT_STEP) {
            settled = true;
            break;
        }
        position = clamp(position, Real(1), POSITION_MOST);
    }
    if (!settled) {
        if (!strongest_ && position == Real(1)) {
            bool yields = true;
            for (int n = 0; n < activeCount_; ++n)
                yields = yields && active_[n]->yields;
            if (!yields) {
                s.flags = SEED_DEFORMED;
                s.position = Real(1);
                o_.displaced_ = true;
                return;
            }
        }
        settled = bracket(position, slope);
    }
    o_.displaced_ = true;
    if (!settled || !strongest_) {
        s.flags = SEED_DEFORMED;
        s.position = Real(1);
        return;
    }
    s.position = position;
    o_.spread_ = most(o_.spread_, position);
    shade(s, position);
}

// Brightness and extents from the gradient of the field, put together from the last look.
void Settler::shade(Seed& s, Real position)
{
    ++look_.counts->normals;
    // -grad F, but for a factor: path position (ownSlope + sum slope ratio) + sum slope ratio fromIt.
    Real along = ownSlope_;
    Vector g{Real(0), Real(0), Real(0)};
    for (int n = 0; n < activeCount_; ++n) {
        const Real share = slopes_[n] * active_[n]->ratio;
        if (active_[n]->quick) {
            along += share;
            g = g - active_[n]->fromIt16 * share;
        } else {
            g = g - from_[n] * share;
        }
    }
    g = g - s.path * shiftDown(along * position, 4);
    const Normal normal = normalise(g);
    s.brightness = shadeSetup_.brightness(normal);
    const bool front = eye_.faces(normal, s, position);
    s.flags = static_cast<uint8_t>(SEED_VALID | SEED_DEFORMED | SEED_KEPT | (front ? SEED_FRONT : 0));
    if (front)
        shadeSetup_.extents(s, normal, position);
}

void SoftObject::updateQuick(const Look& look)
{
    Settler(*this, look).settle();
}

int SoftObject::drawQuick(const Look& look, Voxel* voxels, int room, int* next)
{
    EyeSide eye;
    eye.set(look.eye - centre_, radius_, spacing_);
    Voxel* v = voxels;
    const Voxel* const full = voxels + room - 2 * PATCH_SEEDS;
    int p = *next;
    for (; p < patchCount_ && v <= full; ++p) {
        const Patch& patch = patches_[p];
        const EyeSide::Side side = eye.side(patch.middle, patch.axis, patch.radius, patch.spread);
        if (patch.state == PATCH_AT_REST) {
            if (side == EyeSide::BACK)
                continue;
            const Seed* s = seeds_ + 2 * patch.first;
            for (int i = patch.count; i > 0; --i, s += 2) {
                if (side == EyeSide::EITHER && !eye.pathFaces(*s))
                    continue;
                v->place = (roots_[s->root] - look.eye) + s->path;
                v->wide = s->wide;
                v->high = s->high;
                v->colour = ramp_[s->brightness];
                ++v;
            }
            continue;
        }
        const Seed* s = seeds_ + 2 * patch.first;
        for (int i = 2 * patch.count; i > 0; --i, ++s) {
            if (!(s->flags & SEED_VALID))
                continue;
            if (s->flags & SEED_DEFORMED) {
                if (!(s->flags & SEED_FRONT))
                    continue;
                v->place = (roots_[s->root] - look.eye) + s->path * s->position;
            } else {
                if (!eye.pathFaces(*s))
                    continue;
                v->place = (roots_[s->root] - look.eye) + s->path;
            }
            v->wide = s->wide;
            v->high = s->high;
            v->colour = ramp_[s->brightness];
            ++v;
        }
    }
    *next = p < patchCount_ ? p : 0;
    return static_cast<int>(v - voxels);
}
