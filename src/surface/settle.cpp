// How seeds settle by default: the surface of the report's update(), found with less work.
//
// What is different from the printed method (printed.cpp):
// - A run of seeds (a Patch) that no neighbour reaches rests at position 1.0 exactly, and needs no look at the field.
// - Along a path the squared distance to a neighbour's centre is a polynomial of the position, so that a look costs a
//   few multiplications. Its derivative comes along: Newton's method instead of slope -1.
// - The normal is the gradient, put together from the slopes of the last look, instead of three more samples.
// - A seed that one neighbour alone reaches is placed by the profile of the pair (profile.h), without a look.
// - A scale is as large as the part of the surface that is the seed's own, in each direction as the viewer sees it. The
//   seed keeps it, counted from the object's centre, as long as neither the seed nor the viewer's side of it changes. Where
//   the seeds beside it differ much in brightness, that changes across the scale.
// Where all that are in range are balls of weight 1, what is often is done by ride.h; the rest of their case, and all of the
// others, is here.
#include "surface/ride.h"
#include "model/softobj.h"

namespace {

// Where a path is looked at for the first time outside the surface, when nothing is known of it; how much farther out then,
// and how often where it may come out between.
constexpr Real PROBE(1.15);
constexpr Real PROBE_STEP(0.2);
constexpr int BETWEEN = 3;
// What is searched for again is looked at where it was nearest, and so far on; alone there when the field allows to wait for
// more than so many steps of travel; there and a step on, but nowhere else, for more than so many.
constexpr Real HINT_STEP(0.06);
constexpr Real HINT_FAR(0.3);  // where it slopes much
constexpr int HINT_ALONE = 10;
constexpr int HINT_NO_SEARCH = 6;
// Of the field: where it is so much above the isovalue at its lowest, as far as can be told from slopes, it is not searched
// any further.
constexpr Real VALLEY(0.008);
constexpr Real BARELY(0.003);  // of the field: by how much more than the isovalue is taken for outside all the same
constexpr Real NEARLY(0.04);  // of the field: how near the isovalue it must have come there to be looked at in between
// Squared distance / squared size up to which a neighbour alone fills what the own field lacks at POSITION_MOST: its
// field is 0.492 there, which with the own 0.013 is a little more than the isovalue.
constexpr Real BURYING(0.255);
// Steps of brightness between two seeds side by side from which on it changes across them; and where there are but a few of
// them on an object, which is up to this size in spacings.
constexpr int UNEVEN = 13;
constexpr int UNEVEN_SMALL = 1;
constexpr Real SMALL(8);
// Squared proportion of sizes from which on a neighbour turns the normals of seeds that it hardly moves.
constexpr Real RATIO_LIGHT(4);
constexpr Real KEPT(0.1);  // units: a seed between two that has moved by less lies as it did

// A neighbour in range, as the seeds of this object see it.
struct Near : RideNear {
    const SoftObject* object;
    Real weight;
    bool plain;      // weight 1
    bool quick;      // both cores are points: the polynomial of RideNear holds
    Vector fromIt;   // from its centre to this object's centre
    Real reach;      // its size
    Real bend;       // 2 ratio / size^2: its share of how the gradient changes
    Real change;     // length of twice: how much b changes over a unit
    Real meeting;    // see meetingSum
    Real a0Pace;       // how a0 and twice change in an update, if all goes on like this; the latter scaled by 2^16
    Vector twicePace;
    Real waitField;  // steps of travel that seeds wait for a difference of 1 in the field
};

// b of a path.
inline Real alongPath(const Near& near, const Vector& path)
{
    return shiftUp(alongSum(path, near.twice), B_SHIFT);
}

// How b of a path changes in an update, if all goes on like this.
inline Real alongPace(const Near& near, const Vector& path)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulHigh(path.x.raw, near.twicePace.x.raw) + mulHigh(path.y.raw, near.twicePace.y.raw) +
                         mulHigh(path.z.raw, near.twicePace.z.raw));
#else
    return dot(path, near.twicePace);
#endif
}

// How long seeds wait, as a way that a neighbour goes: for a difference of 1 in squared distance / squared size on this side
// of where its field ends, and of where it buries, and for a field difference of 1, in its sizes; for a facing of 1, in
// radii. The first two are what the distance allows.
constexpr Real WAIT_APART(0.45);
constexpr Real WAIT_BURIED(0.95);
constexpr Real WAIT_FIELD(0.5);
constexpr Real WAIT_FACING(0.9);

// Of the distance to the eye a unit of its way at most changes by how far a path points away, and so does the way itself.
constexpr Real WAIT_AWAY(1 / 1.8);

// What is known of directions to the eye is uncertain by so many units. The most steps for one that are waited for.
constexpr Real AWAY_DOUBT(0.3);
constexpr int AWAY_STEPS = 500;

// Travel is counted in steps, this many for an update in which all moves as fast as is assumed.
constexpr int TRAVEL_STEPS = 64;

static_assert(RECHECK == 10 * TRAVEL_STEPS, "ten updates");

// Seeds that stay where they are wait if the field takes at least so many steps to change by the tolerance.
constexpr int KEPT_STEPS = 20;

// Of SoftObject::Patch::reached: the bit that stands for many.
constexpr uint32_t MANY = 1u << 31;

// Assumed speeds, units an update: never less than this nor more; given up when all is so many times as fast, or as slow.
constexpr Real SPEED_LEAST(1.0 / 64);
constexpr Real SPEED_MOST(100);
constexpr Real SPEED_CHANGE(3);

// Of SoftObject::turning_: from here on nobody counts on how others move. Updates that they are counted on at most.
constexpr Real TURNING_WILD(0.25);
constexpr int PACE_MOST = 16;

constexpr Real TWICE_LIMIT(7.9);  // units of twice, so that its scaled form fits
// In spacings, how far an oversampled seed may rest from the run that it belongs to.
constexpr Real BESIDE(0.75);

constexpr Real PACE_LIMIT(60);    // and units of what twicePace is made from

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
    static_assert(static_cast<int>(REACHES_NONE) == SoftObject::PATCH_AT_REST &&
                  static_cast<int>(REACHES_BURYING) == SoftObject::PATCH_BURIED &&
                  static_cast<int>(REACHES_SOME) == SoftObject::PATCH_MIXED, "the states of patches");
    REGISTERS SELDOM int32_t facesAway(Real across, Real own) const;
    bool passed(int16_t due) const { return static_cast<int16_t>(due - travel_) < 0; }
    int16_t later(int32_t steps) const { return static_cast<int16_t>(travel_ + steps - 1); }
    SoftObject::PatchState reachOf(SoftObject::Patch& patch, uint32_t& reached) const;
    void activate(uint32_t reached);
    int16_t idleUntil(const SoftObject::Patch& patch) const;
    void rest(SoftObject::Patch& patch);
    void bury(SoftObject::Patch& patch);
    bool judge(SoftObject::Patch& patch, Seed* s);
    SELDOM bool become(SoftObject::Patch& patch, Seed* s, SoftObject::PatchState state, uint32_t reached);
    void settlePatches();
    void settleSeed(Seed& s);
    static void profileFor(RideNear* near);
    static void stays(Seed* s);
    static void held(Seed* s);
    static void lost(Seed* s, Real from);
    void follow(Seed& s, Real off, Real slope);
    template <bool PLAIN>
    REGISTERS void settleAt(Seed& s, Real position, bool settled);
    template <bool PLAIN>
    Real lookAt(Real position, Real& slope);
    bool newton(Real position, Real step);
    void travel();
    void wait(Seed& s, uint8_t flags, int32_t steps) const;
    void wait(Seed& s, uint8_t flags, Real difference, Real steps) const;
    Real waitField() const;
    int32_t waitFacing() const;
    Real fieldPace(const Vector& path, Real position) const;
    REGISTERS SELDOM int32_t holdSteps(const Vector& path, Real position, Real most) const;
    REGISTERS SELDOM int32_t keptSteps(const Vector& path, Real position, Real off) const;
    void lookFrom(const Seed& s);
    void restTapered(Seed& s);
    template <bool PLAIN>
    bool search();
    template <bool PLAIN>
    REGISTERS SELDOM bool bracket(Real from);
    template <bool PLAIN>
    REGISTERS void shade(Seed& s, Real position);
    static void shadeAcross(Seed* seed);
    void addNear(const Link& link);
    void knowNear();

    SoftObject& o_;
    const Look& look_;
    // One object is settled at a time. At fixed addresses all this needs no register to find it.
    static inline Near near_[NEAR_MOST];
    static inline Profile profiles_[NEAR_MOST];
    static inline int nearCount_;
    static inline bool plain_;  // all are balls of weight 1: see ride.h
    static inline Settler* settler_;

    // Of the patch at hand, and of those the ones that reach the seed at hand.
    static inline uint32_t activated_;  // as Patch::reached
    static inline ShadeFrame& frame_ = ride.shade;
    static inline const Pull* (&touch_)[NEAR_MOST] = frame_.pulls;
    static const Near& touch(int n) { return *reinterpret_cast<const Near*>(touch_[n]); }
    static inline int32_t& touchCount_ = frame_.count;
    static inline int rootIndex_;
    static inline Vector path_;  // not in the plain case, where the root is the centre
    static inline Point root_;
    static inline Real (&b_)[NEAR_MOST] = ride.b;
    static inline Real& ownSlope_ = frame_.ownSlope;  // of the last look
    static inline Real (&slopes_)[NEAR_MOST] = frame_.slopes;
    static inline Vector from_[NEAR_MOST];  // not quick ones: from the nearest point of the core, / 16
    static inline Real& strength_ = ride.strength;
    static inline Real ownBend_;  // 2 / size^2
    static inline Real buried_;  // least excess of the field where bracket() looked in vain
    static inline Real found_;       // by newton() or bracket()
    static inline Real inside_, position_, excess_, slope_;  // of search()
    static inline bool again_;       // it did so only where it had come nearest before
    static inline Real& overshoot_ = ride.overshoot;
    static inline uint32_t updated_;
    static inline uint16_t travel_;
    static inline int32_t& paceSteps_ = ride.paceSteps;
    static inline bool keptWait_;  // those that stay where they are wait too
    static inline int even_;    // see setSlopes()
    static inline bool bent_;   // what lies about where it did may face another way
    static inline bool woken_;  // by a jump of it
    static inline int32_t& waitAway_ = ride.waitAway;
    static inline Vector toEye_;  // unit length, from the centre
    static inline Real eyeSlowness_;
    static inline Real distance_;  // to the centre
    static inline Real& awayShare_ = ride.awayShare;  // see facesAway()
    static inline Real& awayEdge_ = ride.awayEdge;
    static inline Real& waitAlong_ = ride.waitAlong;
    static inline Real awayOwn_;
    static inline Real horizon_;  // of the object in general
    static inline EyeSide& eye_ = frame_.eye;
    static inline Skew& skew_ = frame_.skew;
};

// Steps of travel while something goes so far; `slowness` is 1 / its speed.
inline Real waitSteps(Real units, Real slowness)
{
    return least(units * slowness, Real(WAIT_MOST / TRAVEL_STEPS)) * Real(TRAVEL_STEPS);
}

// Whether each component is less than `most` from 0.
inline bool within(const Vector& v, Real most)
{
    return absolute(v.x) < most && absolute(v.y) < most && absolute(v.z) < most;
}

void Settler::addNear(const Link& link)
{
    const SoftObject& other = *link.object;
    Near& n = near_[nearCount_];
    n.profile = &profiles_[nearCount_];
    n.bit = nearCount_ < 31 ? 1u << nearCount_ : MANY;
    n.more = nullptr;
    if (nearCount_ == 0)
        ride.inRange = &n;
    else
        near_[nearCount_ - 1].more = &n;
    ++nearCount_;
    n.profile->clear();
    n.object = &other;
    const Real slowness = Real(1) / link.speed;
    n.waitField = waitSteps(other.size() * WAIT_FIELD, slowness);
    n.waitFacing = rawFromReal(waitSteps(o_.radius() * WAIT_FACING, slowness)) / eye_.distance32();
    n.weight = link.weight;
    n.plain = link.weight == Real(1);
    n.fromIt = o_.centre() - other.centre();
    n.reach = other.size();
    const Real proportion = least(o_.size() / other.size(), Real(20));
    n.pull.ratio = proportion * proportion * link.weight;
    n.pull.fromIt16 = n.fromIt * Real(1.0 / 16);
    n.quick = false;
    if (o_.coreReach() > Real(0) || other.coreReach() > Real(0))
        return;
    // E = fromIt, R its size: |E + position path|^2 / R^2.
    const Real inverse = Real(16) / other.size();
    const Vector e = n.fromIt * inverse;
    const Real r = o_.radius() * inverse;
    if (!within(e, Real(104)) || r > Real(104))
        return;
    n.a0 = shiftDown(dot(e, e), 8);
    n.c0 = shiftDown(r * r, 8);
    const Vector twice = e * (inverse * Real(1.0 / 128));
    if (!within(twice, TWICE_LIMIT))
        return;
    n.twice = scaledTwice(twice);
    n.change = nearLength(twice) + Real(0.0001);
#if FB_REAL == FB_FIXED
    n.swing = shiftUp(n.change, 11);
#else
    n.swing = shiftDown(n.change, 1);
#endif
    // At rest, or a way further out where other neighbours may have pulled the seed.
    n.touching = most(TOUCHING - n.a0 - n.c0, (TOUCHING - n.a0 - n.c0 * Real(1.44)) * Real(1 / 1.2));
    n.meeting = most(n.touching, most((TOUCHING - n.a0 - n.c0 * Real(2.25)) * Real(1 / 1.5),
                                      (TOUCHING - n.a0 - n.c0 * (POSITION_MOST * POSITION_MOST)) * (Real(1) / POSITION_MOST)));
    // t is convex along the path: what holds at both ends of the stretch holds between.
    const Real near = BURYING - n.a0 - n.c0;
    n.burying = (BURYING - n.a0 - n.c0 * (POSITION_MOST * POSITION_MOST)) * (Real(1) / POSITION_MOST);
    // A difference there is more in t.
    Real buried = n.reach * WAIT_BURIED;
    if (n.burying < near)
        buried = buried * Real(1.5);
    else
        n.burying = near;
    if (!n.plain && n.weight < Real(1))
        n.burying = -n.a0 - n.c0;  // too weak to bury alone
    n.meetingSum = sumBelow(n.meeting);
    n.touchingSum = sumBelow(n.touching);
    n.buryingSum = sumBelow(n.burying);
    n.meetingRunSum = sumBelow(n.meeting + n.change * (o_.spacing_ * BESIDE));
    n.bend = shiftDown(n.pull.ratio * inverse * inverse, 7);
    n.quick = true;

    n.waitApart = waitSteps(n.reach * WAIT_APART, slowness);
    n.waitBuried = waitSteps(buried, slowness);
    const Vector none{Real(0), Real(0), Real(0)};
    Vector pace = link.pace * -inverse;
    pace = within(pace, PACE_LIMIT) ? pace : none;
    n.a0Pace = shiftDown(dot(e, pace), 7);
    Vector twicePace = pace * inverse;
    twicePace = within(twicePace, PACE_LIMIT) ? twicePace : none;
#if FB_REAL == FB_FIXED
    n.twicePace = {shiftUp(twicePace.x, 9), shiftUp(twicePace.y, 9), shiftUp(twicePace.z, 9)};
#else
    n.twicePace = twicePace * (Real(1) / 128);
#endif
    keptWait_ = keptWait_ && stepsOf(DISPLACEMENT, n.waitField) >= KEPT_STEPS;
    n.halfSquare = shiftDown(PLACED_LEAST * n.reach * (n.reach / distance_), 1);
    n.awayLimit = awayOwn_ - dot(n.fromIt, toEye_) - AWAY_DOUBT;
    const Real reach = absolute(n.fromIt.x) + absolute(n.fromIt.y) + absolute(n.fromIt.z) + o_.radius();
    // How far it goes away from the eye in an update, if all goes on like this; half its speed for what else it may do, and
    // what the eye does.
    const Real closing = most(-dot(link.pace, toEye_), Real(0)) + shiftDown(link.speed, 1) + o_.eyeSpeed_ * (reach / distance_);
    n.waitAway = least(waitSteps(Real(1), Real(1) / closing), Real(AWAY_STEPS));
}

// Up to which position the own field is more than this.
inline Real ownReaches(Real field)
{
    int low = (rawFromReal(PROBE) >> 6) + 1, high = rawFromReal(POSITION_MOST) >> 6;
    while (low < high) {
        const int middle = (low + high + 1) >> 1;
        if (ownSteps[middle - OWN_FIRST].value > field)
            low = middle;
        else
            high = middle - 1;
    }
    return realFromRaw(low << 6);
}

// Where others are in range than before, or one along whose motion nobody can wait, nobody does.
void Settler::knowNear()
{
    uint32_t mark = static_cast<uint32_t>(nearCount_);
    bool quick = true;
    for (int i = 0; i < nearCount_; ++i) {
        mark = mark * 0x9e3779b1u + static_cast<uint32_t>(near_[i].object->number());
        quick = quick && near_[i].quick;
    }
    if (mark == o_.nearMark_ && quick)
        return;
    o_.nearMark_ = mark;
    if (!woken_)
        o_.travel_ = static_cast<uint16_t>(o_.travel_ + SoftObject::TRAVEL_JUMP);
    travel_ = o_.travel_;
    woken_ = true;
}

void Settler::settle()
{
    nearCount_ = 0;
    keptWait_ = true;
    ride.first = ride.inRange = nullptr;
    activated_ = 0;
    rootIndex_ = -1;
    updated_ = 0;
    ride.placed = ride.several = ride.looks = ride.normals = ride.unsettled = 0;
    eye_.set(look_.eye - o_.centre_, o_.radius_, o_.coreReach());
    horizon_ = o_.horizonRadius(look_.eye);
    eye_.horizon(horizon_);
    travel();
    distance_ = realFromRaw(eye_.distance32() << 11);
    const Normal toEye = normalise(look_.eye - o_.centre_);
    toEye_ = {realFromRaw(toEye.x * 4), realFromRaw(toEye.y * 4), realFromRaw(toEye.z * 4)};
    awayShare_ = PLACED_LEAST * (o_.radius() / distance_);
    awayOwn_ = PLACED_LEAST * awayShare_ * o_.radius();
    // Not from within, where terms grow without limit.
    awayEdge_ = distance_ > Real(8) && distance_ > o_.radius() ? PLACED_LEAST * o_.radius() - AWAY_DOUBT : Real(-2000);
    waitAlong_ = least(waitSteps(Real(1), eyeSlowness_), Real(AWAY_STEPS));
    Link links[NEAR_MOST];
    const int count = o_.findNear(links);
    for (int i = 0; i < count; ++i)
        addNear(links[i]);
    knowNear();

    o_.displaced_ = false;
    // A seed stays valid a way past the border where a neighbour becomes stronger: as a distance, about a unit at the usual
    // spacings. The fields of the two change by about 3 / size a unit there. Farther where one is more than twice as large
    // as the other: the surface bends more sharply between them.
    Real past(1.8);
    for (int i = 0; i < nearCount_; ++i)
        if (near_[i].reach > shiftUp(o_.size_, 1) || o_.size_ > shiftUp(near_[i].reach, 1))
            past = Real(2.8);
    overshoot_ = least((past + Real(0.1) * o_.spacing_) / o_.size_, Real(0.7));
    ride.placedMost = ownReaches(shiftDown(ISOVALUE - overshoot_, 1));
    ride.evenMost = ownReaches(shiftDown(ISOVALUE, 1));
    bool bent = false;
    for (int i = 0; i < nearCount_; ++i)
        bent = bent || near_[i].pull.ratio > RATIO_LIGHT;
    bent_ = bent || o_.bent_;
    o_.bent_ = bent;
    ride.kept = bent_ ? Real(0) : KEPT / o_.radius_;
    ride.keptTwice = ride.kept + ride.kept;
    // A small one makes a bump of few seeds.
    ride.parting = Real(bent_ ? 0.5 : 4.0) * o_.spacing_ / o_.radius_;
    ride.partingTwice = ride.parting + ride.parting;
    skew_.root(o_.centre_ - look_.eye, o_.radius_ * POSITION_MOST);
    frame_.setBack = mulDiv(1 << 30, 1 << 17, rawFromReal(most(o_.radius_, Real(2))));
    frame_.light.set(look_.light, o_.spacing_);

    plain_ = o_.isBall();
    for (int i = 0; i < nearCount_; ++i)
        plain_ = plain_ && near_[i].quick && near_[i].plain;
    ride.travel = static_cast<int32_t>(static_cast<uint32_t>(travel_) << 16);
    ride.later = travel_ - 1;
    ride.awayAlong = (rawFromReal(awayEdge_) + 2047) >> 11 << 14;
    ride.keptWait = keptWait_ || bent_;
    ride.profileFor = profileFor;
    ride.stays = stays;
    ride.held = held;
    ride.lost = lost;
    ride.rough = shadeAcross;
    const bool coarse = bent_ || o_.size_ < o_.spacing_ * SMALL;
    even_ = coarse ? EVEN_SMALL : EVEN;
    ride.uneven = coarse ? UNEVEN_SMALL : UNEVEN;
    ride.unevenTwice = 2 * ride.uneven;
    ride.shaded = nullptr;
    ownBend_ = shiftDown(o_.inverse_ * o_.inverse_, 7);
    settler_ = this;
    settlePatches();
    look_.counts->iterations += static_cast<uint32_t>(ride.looks + ride.placed);
    look_.counts->updated += updated_ + static_cast<uint32_t>(ride.placed + ride.several);
    look_.counts->normals += static_cast<uint32_t>(ride.normals);
    look_.counts->unsettled += static_cast<uint32_t>(ride.unsettled);
}

// Adds up how far neighbours and viewer have moved against the object since its last update. One sum must do for all of
// them, so each has a speed that seeds which wait for it have reckoned with, and the sum grows by how much the fastest of
// them, measured by that, has moved. The speeds follow slowly what is seen; downwards does not matter to who waits.
void Settler::travel()
{
    Real fastest(0), assumed(0);
    const auto step = [&](Vector& last, const Vector& now, Vector& moved, Real growth, Real& way, Real speed) {
        moved = now - last;
        last = now;
        way = nearLength(moved) + growth;
        assumed = most(assumed, speed);
        fastest = most(fastest, speed > Real(0) ? least(way / speed, Real(100)) : Real(100));
    };
    bool balls = o_.coreReach() == Real(0), grows = false;
    const Real growth = absolute(o_.size_ - o_.sizeSeen_);
    o_.sizeSeen_ = o_.size_;
    Real eyeWay;
    Vector eyeMoved;
    step(o_.eyeApart_, look_.eye - o_.centre_, eyeMoved, Real(0), eyeWay, o_.eyeSpeed_);
    for (List<Link>::Node* node = o_.skel_.first(); node != nullptr; node = node->next) {
        Link& link = node->item;
        const SoftObject& other = *link.object;
        const Real grown = absolute(other.size_ - link.size) + growth;
        grows = grows || grown > Real(0);
        step(link.apart, other.centre_ - o_.centre_, link.moved, grown, link.way, link.speed);
        link.size = other.size_;
        balls = balls && other.coreReach() == Real(0);
    }
    const bool anew = fastest > SPEED_CHANGE || (fastest * SPEED_CHANGE < Real(1) && assumed > SPEED_LEAST);
    const auto settleSpeed = [&](Real& speed, Real way) {
        if (anew)
            speed = way;
        else if (fastest > Real(1.0625))
            speed += shiftDown(speed, 6);
        else if (way < speed * fastest)
            speed -= shiftDown(speed, 5);
        speed = clamp(speed, SPEED_LEAST, SPEED_MOST);
    };
    settleSpeed(o_.eyeSpeed_, eyeWay);
    Real turning = anew || grows ? Real(1) : Real(0);
    const Real share = anew || fastest < Real(0.01) ? Real(1) : Real(1) / fastest;
    for (List<Link>::Node* node = o_.skel_.first(); node != nullptr; node = node->next) {
        Link& link = node->item;
        settleSpeed(link.speed, link.way);
        const Vector pace = anew ? Vector{Real(0), Real(0), Real(0)} : link.moved * share, change = pace - link.pace;
        link.pace = pace;
        turning = most(turning, least((absolute(change.x) + absolute(change.y) + absolute(change.z)) / link.speed, Real(1)));
    }
    // Where a turn may matter seeds are looked at every time, and when others move on otherwise than was thought.
    woken_ = !balls || o_.linksChanged_ || anew || (turning > o_.turning_ && o_.turning_ < TURNING_WILD);
    o_.turning_ = least(most(turning + shiftDown(turning, 1), o_.turning_ - shiftDown(o_.turning_, 3)), Real(1));
    paceSteps_ = floorToInt(least(Real(0.5) / o_.turning_, Real(PACE_MOST)) * Real(TRAVEL_STEPS));
    o_.linksChanged_ = false;
    const int32_t steps = woken_ ? SoftObject::TRAVEL_JUMP : floorToInt(fastest * Real(TRAVEL_STEPS)) + 1;
    o_.travel_ = static_cast<uint16_t>(o_.travel_ + steps);
    travel_ = o_.travel_;
    eyeSlowness_ = Real(1) / o_.eyeSpeed_;
    waitAway_ = rawFromReal(waitSteps(WAIT_AWAY * Real(1.0 / 32), eyeSlowness_));
}

// Nothing to see of this seed until things have moved on by `steps`, 0 or more.
inline void Settler::wait(Seed& s, uint8_t flags, int32_t steps) const
{
    s.flags = flags;
    s.wakes = later(lesser(steps, WAIT_MOST));
}

inline void Settler::wait(Seed& s, uint8_t flags, Real difference, Real steps) const
{
    wait(s, flags, stepsOf(difference, steps));
}

// The least of those that reach the seed at hand.
inline Real Settler::waitField() const
{
    Real steps(WAIT_MOST);
    for (int n = 0; n < touchCount_; ++n)
        steps = least(steps, touch(n).waitField);
    return steps;
}

inline int32_t Settler::waitFacing() const
{
    int32_t steps = INT32_MAX;
    for (int n = 0; n < touchCount_; ++n)
        steps = touch(n).waitFacing < steps ? touch(n).waitFacing : steps;
    return steps;
}

// How the field changes in an update at a place of the path at hand, the last one that was looked at.
inline Real Settler::fieldPace(const Vector& path, Real position) const
{
    Real sum(0);
    for (int n = 0; n < touchCount_; ++n) {
        const Near& near = touch(n);
        sum += slopes_[n] * (near.a0Pace + position * alongPace(near, path));
    }
    return sum;
}

// How long the field at such a place stays more than `most` less than it is.
int32_t Settler::holdSteps(const Vector& path, Real position, Real most) const
{
    const Real wait = waitField();
    const int32_t least = stepsOf(most, wait);
    // By how fast it falls, but allowing for half of what is possible more it is at most twice that: not worth the while where
    // even that hardly lasts beyond the next update.
    if (least >= paceSteps_ || 2 * least <= TRAVEL_STEPS)
        return least;
    const Real pace = fieldPace(path, position);
    if (pace >= Real(0))
        return lesser(2 * least, paceSteps_);
    const Real falls = Real(TRAVEL_STEPS / 2) / wait - pace - shiftDown(pace, 2);
    const int32_t steps = floorToInt(::least(::least(most, Real(1)) / falls, Real(PACE_MOST)) * Real(TRAVEL_STEPS));
    return steps < least ? least : lesser(steps, paceSteps_);
}

// How long a seed stays where it is when the field there is off the isovalue by so much.
int32_t Settler::keptSteps(const Vector& path, Real position, Real off) const
{
    const Real pace = fieldPace(path, position);
    const Real room = pace < Real(0) ? DISPLACEMENT + off : DISPLACEMENT - off;
    if (room <= Real(0))
        return 0;
    const Real doubt = absolute(pace) + shiftDown(absolute(pace), 2) + Real(1.0 / 4096);
    return floorToInt(least(room / doubt * Real(TRAVEL_STEPS), Real(paceSteps_)));
}

// What becomes of the patch and which neighbours reach it, and until when.
SoftObject::PatchState Settler::reachOf(SoftObject::Patch& patch, uint32_t& reached) const
{
    bool touched = false;
    int32_t rest = WAIT_MOST, further = RECHECK;
    reached = 0;
    for (int i = 0; i < nearCount_; ++i) {
        const Near& near = near_[i];
        if (near.quick) {
            const Real b = alongPath(near, patch.middle);
            const Real change = absolute(alongPath(near, patch.half)) + shiftDown(near.change * patch.wide, 1) + RUN_DOUBT;
            const Real nearest = b - change, meeting = shiftUp(near.meetingRunSum, B_SHIFT);
            if (b + change < near.burying) {
                patch.due = later(stepsOf(near.burying - b - change, near.waitBuried));
                return SoftObject::PATCH_BURIED;
            }
            if (nearest < near.touching)
                touched = true;
            else
                rest = lesser(rest, stepsOf(nearest - near.touching, near.waitApart));
            if (nearest < meeting)
                reached |= near.bit;
            else
                further = lesser(further, stepsOf(nearest - meeting, near.waitApart));
        } else {
            const Vector v = near.object->fromCore(o_.centre_ + patch.middle);
            const Real limit = near.reach + patch.radius;
            if (absolute(v.x) < limit && absolute(v.y) < limit && absolute(v.z) < limit) {
                touched = true;
                reached |= near.bit;
            }
        }
    }
    patch.due = later(touched ? further : rest);
    return touched ? SoftObject::PATCH_MIXED : SoftObject::PATCH_AT_REST;
}

// The neighbours that reach a patch become the active ones.
void Settler::activate(uint32_t reached)
{
    if (reached == activated_)
        return;
    activated_ = reached;
    RideNear** last = &ride.first;
    const auto add = [&](Near& near) {
        *last = &near;
        last = &near.next;
    };
    Near* near = near_;
    for (uint32_t rest = reached & ~MANY; rest != 0; rest >>= 1, ++near)
        if (rest & 1)
            add(*near);
    if (reached & MANY)
        for (int i = 31; i < nearCount_; ++i)
            add(near_[i]);
    *last = nullptr;
}

void Settler::bury(SoftObject::Patch& patch)
{
    Seed* s = o_.seeds_ + 2 * patch.first;
    for (int i = 2 * patch.count; i > 0; --i, ++s) {
        s->position = Real(1);
        s->flags = 0;
    }
    patch.state = SoftObject::PATCH_BURIED;
    patch.back = true;
    patch.turned = false;
}

void Settler::rest(SoftObject::Patch& patch)
{
    Seed* s = o_.seeds_ + 2 * patch.first;
    for (int i = patch.count; i > 0; --i, s += 2) {
        s->position = Real(1);
        s->flags = SEED_VALID | SEED_FRONT;
        s->voxel.brightness = s->restBrightness;
        s[1].flags = 0;
    }
    patch.state = SoftObject::PATCH_AT_REST;
    patch.extras = false;
    patch.turned = false;
    patch.laid = o_.drift_;
    if (o_.tapers_)
        patch.stale = SoftObject::STALE_ALL;  // from paths to normals
}

// The field at a position of the path at hand (0.95 .. POSITION_MOST), its slope along the path, and what the normal
// needs. PLAIN: all neighbours are quick and have weight 1.
template <bool PLAIN>
inline Real Settler::lookAt(Real position, Real& slope)
{
    if (PLAIN) {
        rideLook(position);
        slope = ride.slope;
        return ride.excess + ISOVALUE;
    }
    ++ride.looks;
    const OwnStep& own = ownQuick(position);
    Real field = own.value, steep = own.steep;
    ownSlope_ = own.slope;
    Real strongest(0);
    for (int n = 0; n < touchCount_; ++n) {
        const Near& near = touch(n);
        Real t, change;
        if (near.quick) {
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
        if (!near.plain) {
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

// From a position near the surface, and the step that a look there gave. False: the method does not apply here. Else found_
// is the position, and the last look's terms are left for the normal.
bool Settler::newton(Real position, Real step)
{
    for (int i = 1; i < LOOK_LIMIT; ++i) {
        step = clamp(step, -LONGEST_STEP, LONGEST_STEP);
        position += step;
        if (position < PLACED_LEAST || position > POSITION_MOST)
            return false;
        found_ = position;
        if (absolute(step) <= SHORT_STEP)
            return true;
        Real slope;
        const Real field = lookAt<false>(position, slope);
        if (slope > FLAT)
            return false;
        step = quotient(ISOVALUE - field, slope);
    }
    ++ride.unsettled;
    return false;
}

// Where a path may leave the surface, looked at from 1 outwards. False: nowhere, or only where the seed would not be valid;
// found_ is then where it came nearest to it. Else position_ is a place outside, excess_ and slope_ what was found there, and
// inside_ one farther in.
template <bool PLAIN>
bool Settler::search()
{
    const auto leaves = [this](Real position) {
        position_ = position;
        excess_ = lookAt<PLAIN>(position, slope_) - ISOVALUE;
        return excess_ < BARELY;
    };
    if (leaves(PROBE))
        return true;
    Real low = position_, lowSlope = slope_;
    if (bent_ && lowSlope > Real(0)) {
        // A small one close by may leave a gap before it.
        const Real excess = excess_;
        if (leaves(Real(1)))
            return true;
        if (slope_ < Real(0) && leaves(Real(1) + (PROBE - Real(1)) * (slope_ / (slope_ - lowSlope))))
            return true;
        excess_ = excess;
        position_ = low;
    }
    buried_ = excess_;
    found_ = inside_ = low;
    if (leaves(touchCount_ == 1 ? ride.placedMost : POSITION_MOST))
        return true;
    Real high = position_, highSlope = slope_;
    // It may have left between the two, and gone into something else.
    for (int i = 0; i < BETWEEN; ++i) {
        if (excess_ < buried_) {
            buried_ = excess_;
            found_ = position_;
        }
        if (lowSlope >= Real(0) || (i > 0 && buried_ > NEARLY))
            return false;
        const Real place =
            highSlope > Real(0) ? low + (high - low) * (lowSlope / (lowSlope - highSlope)) : low + PROBE_STEP;
        if (place >= high)
            return false;
        if (leaves(place)) {
            inside_ = low;
            return true;
        }
        if (slope_ < Real(0)) {
            low = place;
            lowSlope = slope_;
        } else {
            high = place;
            highSlope = slope_;
        }
    }
    return false;
}

// From nothing: where the path leaves the surface before POSITION_MOST. Inside at 1, where the own field alone is the
// isovalue. False: it does not leave, or only where the seed would not be valid. found_ is the place, or where it came nearest
// to it. If `from` is not 1 that was such a place: it is looked at first, and if the field there is well above the isovalue,
// alone.
template <bool PLAIN>
bool Settler::bracket(Real from)
{
    inside_ = Real(1);
    again_ = from != Real(1);
    bool out = false;
    if (again_) {
        position_ = from;
        excess_ = lookAt<PLAIN>(from, slope_) - ISOVALUE;
        out = excess_ < BARELY;
        if (!out) {
            // Where it slopes, it comes nearer elsewhere.
            buried_ = excess_ - shiftDown(slope_ * slope_, 2);
            const Real way = clamp(shiftDown(absolute(slope_), 1), HINT_STEP, HINT_FAR);
            found_ = clamp(slope_ < Real(0) ? from + way : from - way, PROBE, POSITION_MOST);
            const int32_t steps = stepsOf(buried_, waitField());
            if (buried_ > NEARLY && steps > HINT_ALONE)
                return false;
            const Real first = excess_, firstSlope = slope_;
            position_ = found_;
            excess_ = lookAt<PLAIN>(found_, slope_) - ISOVALUE;
            out = excess_ < BARELY;
            if (!out && steps > HINT_NO_SEARCH) {
                buried_ = least(buried_, excess_);
                return false;
            }
            // Where it falls on one side and rises on the other, the least of it lies between.
            if (!out && (firstSlope < Real(0)) != (slope_ < Real(0))) {
                const Real share = firstSlope / (firstSlope - slope_);
                buried_ = first + shiftDown(firstSlope * (found_ - from) * share, 1);
                if (buried_ > VALLEY) {
                    found_ = from + (found_ - from) * share;
                    return false;
                }
            }
        }
        again_ = false;
    }
    if (!out && !search<PLAIN>())
        return false;
    Real inside = inside_, position = position_, outside = position, excess = excess_, slope = slope_;
    for (int i = 0;; ++i) {
        // Where the field is flat a step of Newton's goes nowhere: halved instead.
        Real next = slope < FLAT ? position - quotient(excess, slope) : shiftDown(inside + outside, 1);
        found_ = next;
        if (i > 0 && absolute(next - position) <= shiftDown(SHORT_STEP, 1))
            return true;
        if (next <= inside || next >= outside)
            found_ = next = shiftDown(inside + outside, 1);
        if (i == LOOK_LIMIT)
            return true;
        position = next;
        excess = lookAt<PLAIN>(position, slope) - ISOVALUE;
        if (excess >= Real(0))
            inside = position;
        else
            outside = position;
    }
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

// Whether the seed at hand faces away wherever on its path it may lie, and whoever owns the surface there; if so, steps of
// travel that it stays like that, else -1. `across`: EyeSide::along() in units, `own`: by how much it is less than
// awayEdge_.
//
// The gradient is a sum of vectors away from the centres of all fields that reach the place p. When each of them points away
// from the eye, it does. With e the unit vector to the eye, D its distance, c a centre, r the radius, that is for the own
// field r cos(path, e) < position r, and for the others (p - c).(e D - position path) < 0, or
// (centre - c).e + position (path.e - path.(centre - c) / D) - position^2 r^2 / D < 0, where path.(centre - c) is
// b size^2 / 2. The middle term is at most what it is at PLACED_LEAST, or if it grows what it is at POSITION_MOST.
int32_t Settler::facesAway(Real across, Real own) const
{
    int32_t wait = stepsOf(own, Real(AWAY_MOST), waitAlong_);
    const Real share = across * awayShare_;
    for (int n = 0; n < touchCount_; ++n) {
        const Near& near = touch(n);
        if (!near.quick)
            return -1;
        Real term = share - b_[n] * near.halfSquare;
        if (term > Real(0))
            term += term;  // POSITION_MOST / PLACED_LEAST, rounded up
        const Real beyond = near.awayLimit - term;
        if (beyond <= Real(0))
            return -1;
        wait = lesser(wait, stepsOf(beyond, Real(AWAY_MOST), near.waitAway));
    }
    // Half of it is sure whatever they do.
    const int32_t counted = 2 * paceSteps_;
    return wait <= counted ? wait : wait < 2 * counted ? counted : wait >> 1;
}

// The first seed between two balls.
void Settler::profileFor(RideNear* ofRide)
{
    const Near& near = static_cast<const Near&>(*ofRide);
    near.profile->make(near.a0, near.c0, -near.change * settler_->o_.radius_, ride.placedMost);
}

// Where it was, and what is known of it holds, unless its normal may have turned all the same.
void Settler::stays(Seed* s)
{
    if (bent_) {
        settler_->shade<true>(*s, s->position);
        return;
    }
    const int32_t steps = settler_->keptSteps(s->path, s->position, ride.excess);
    if (steps > 0)
        settler_->wait(*s, s->flags, steps);
}

void Settler::held(Seed* s)
{
    settler_->wait(*s, SEED_PLACED, settler_->holdSteps(s->path, s->position, strength_));
}

void Settler::lost(Seed* s, Real from)
{
    settler_->settleAt<true>(*s, from, false);
}

// From where it was; `off` and `slope`: what a look there gave.
void Settler::follow(Seed& s, Real off, Real slope)
{
    Real position = s.position;
    bool settled = false;
    if (slope <= FLAT) {
        const Real step = quotient(-off, slope);
        if (absolute(step) <= SHORT_STEP) {
            position += step;
            settled = position >= PLACED_LEAST && position <= POSITION_MOST;
        } else {
            settled = newton(position, step);
            position = found_;
        }
    }
    settleAt<false>(s, settled ? position : Real(1), settled);
}

// Settled there, or to be looked for from there.
template <bool PLAIN>
inline void Settler::settleAt(Seed& s, Real position, bool settled)
{
    if (!settled) {
        settled = bracket<PLAIN>(position);
        position = found_;
    }
    s.position = position;
    if (!settled) {
        // Inside everywhere: buried by this much of the field at least.
        wait(s, 0, PLAIN && again_ ? holdSteps(s.path, position, buried_) : stepsOf(buried_, waitField()));
        return;
    }
    if (strength_ > Real(0)) {
        if (PLAIN)
            held(&s);
        else
            wait(s, SEED_PLACED, stepsOf(strength_, waitField()));
        return;
    }
    shade<PLAIN>(s, position);
}

// Where not all are balls of weight 1; else see ride.h.
void Settler::settleSeed(Seed& s)
{
    path_ = s.path;
    root_ = o_.roots_[s.root];

    // Which neighbours are near enough to matter, or one so near that the seed lies inside anyway?
    int touching = 0;
    bool touched = false;
    int32_t wait = WAIT_MOST;
    for (RideNear* active = ride.first; active != nullptr; active = active->next) {
        const Near& near = static_cast<const Near&>(*active);
        if (near.quick) {
            const Real b = alongPath(near, s.path);
            const Real beyond = b - near.touching;
            if (beyond < Real(0)) {
                if (b < near.burying) {
                    s.position = Real(1);
                    this->wait(s, 0, near.burying - b, near.waitBuried);
                    return;
                }
                touched = true;
            } else {
                wait = lesser(wait, stepsOf(beyond, near.waitApart));
                if (b >= near.meeting)
                    continue;
            }
            b_[touching] = b;
        } else {
            // At rest, or a way further out where other neighbours may have pulled the seed.
            Vector unused;
            touched = touched || near.object->param(root_ + path_, &unused) < TOUCHING ||
                      near.object->param(root_ + path_ * Real(1.2), &unused) < TOUCHING;
        }
        touch_[touching++] = &near.pull;
    }
    touchCount_ = touching;
    if (!touched) {
        if (o_.tapers_) {
            restTapered(s);
            return;
        }
        s.position = Real(1);
        // One that was at rest before lies as it did; the others are to be laid.
        const bool lies = (s.flags & (SEED_KEPT | SEED_PLACED)) == SEED_KEPT;
        this->wait(s, lies ? SEED_VALID | SEED_KEPT | (s.flags & SEED_FRONT) : SEED_VALID | SEED_FRONT, wait);
        s.voxel.brightness = s.restBrightness;
        return;
    }
    lookFrom(s);
    const int32_t along = eye_.along(s);
    bool notFacing = true;
    if (o_.isBall()) {
        const Real across = realFromRaw(along >> 14 << 11);
        const Real own = awayEdge_ - across;
        notFacing = own > Real(0);
        const int32_t away = notFacing ? facesAway(across, own) : -1;
        if (away >= 0) {
            // Where it is held to be does not matter; should it come round again it is looked for from there.
            this->wait(s, s.flags & SEED_VALID ? SEED_VALID | SEED_PLACED : s.flags & SEED_PLACED, away);
            return;
        }
    }
    if (notFacing) {
        const int32_t away = eye_.away(along);
        if (away > 0) {
            this->wait(s, 0, mulShift16(away, waitAway_));
            return;
        }
    }
    ++updated_;
    s.wakes = static_cast<int16_t>(travel_);
    if (!(s.flags & (SEED_VALID | SEED_PLACED))) {
        settleAt<false>(s, s.position, false);
        return;
    }
    Real slope;
    const Real off = lookAt<false>(s.position, slope) - ISOVALUE;
    if (!(s.flags & SEED_KEPT) || bent_ || strength_ > Real(0) || absolute(off) > DISPLACEMENT)
        follow(s, off, slope);
}

// Brightness, extents and tilt from the gradient of the field, put together from the last look.
template <bool PLAIN>
inline void Settler::shade(Seed& s, Real position)
{
    const int32_t over = strength_ + overshoot_ > Real(0) ? OVER_BACK : 0;
    int32_t facing;
    if (PLAIN) {
        facing = shadeSeed(&frame_, &s, position, over);
    } else {
        Real along = ownSlope_;
        Vector g{Real(0), Real(0), Real(0)};
        for (int n = 0; n < touchCount_; ++n) {
            const Near& near = touch(n);
            if (near.quick)
                addPull(near.pull, slopes_[n], along, g);
            else
                g = g - from_[n] * (slopes_[n] * near.pull.ratio);
        }
        if (o_.tapers_) {
            Vector slope;
            o_.param(root_ + s.path * position, &slope);
            g = g - slope * shiftDown(along, 4);
        } else {
            g = g - s.path * shiftDown(along * position, 4);
        }
        facing = lieOn(frame_, s, g, position, over, root_ - o_.centre_);
    }
    if (facing <= 0) {
        wait(s, SEED_VALID | SEED_PLACED, mulShift16(-facing, waitFacing()));
        return;
    }
    ++ride.normals;
    s.flags = SEED_VALID | SEED_PLACED | SEED_KEPT | SEED_FRONT;
    if (PLAIN) {
        ride.shaded = &s;
        ride.facing = facing;
    }
}

// How the brightness changes across the seed that has just been shaded, where only balls reach it.
//
// The normal is n = -grad F / |grad F|, so along a tangent t of the surface the brightness n.light changes by
// -(H t).light' / |grad F|, with H the derivatives of the gradient and light' the light less what of it is along n. Of a
// ball with the seed at v from its centre, field f(q), q = v^2 / R^2, H has 2 f' / R^2 of the unit matrix and 4 f'' / R^4 of
// the product of v with itself. All is counted in 2 / (own R)^2, as the gradient is (addPull()).
//
// In whole numbers: lengths in 1/256 unit, directions with 14 bits of fraction, shares of the gradient and what bends it with
// 10.
void Settler::shadeAcross(Seed* seed)
{
    Seed& s = *seed;
    const Real position = s.position;
    const Normal n = frame_.normal, light = frame_.light.light();
    const auto product = [](const Normal& a, const Normal& b) { return (a.x * b.x + a.y * b.y + a.z * b.z) >> 14; };
    const Normal place{s.voxel.x, s.voxel.y, rawFromReal(s.path.z * position) >> 8};
    const int32_t facing = product(n, light), outward = product(place, n);
    const int32_t aside = product(place, light) - (facing * outward >> 14);
    // Of a product of a length.
    const auto units = [](int32_t a, int32_t length) { return static_cast<int32_t>(static_cast<int64_t>(a) * length >> 8); };
    const auto bend = [](Real t, Real share, int32_t off) {
        return mulShift16(rawFromReal(share * (Real(34.0 / 9) - t * Real(24.0 / 9))) * 4, off);
    };
    int32_t along = rawFromReal(ownSlope_) >> 6, pulled = 0;
    int32_t bent = bend(shiftDown(position * position, 2), ownBend_, aside);
    int32_t x = 0, y = 0, z = 0;
    for (int i = 0; i < touchCount_; ++i) {
        const Near& near = touch(i);
        const int32_t share = rawFromReal(slopes_[i] * near.pull.ratio) >> 6;
        if (share == 0)
            continue;
        const Normal from{rawFromReal(near.fromIt.x) >> 8, rawFromReal(near.fromIt.y) >> 8, rawFromReal(near.fromIt.z) >> 8};
        const int32_t out = product(from, n);
        const Real t = near.a0 + position * (ride.b[i] + position * near.c0);
        const int32_t part = bend(t, near.bend, aside + product(from, light) - (facing * out >> 14));
        along += share;
        pulled += units(share, out);
        bent += part;
        x += units(part, from.x);
        y += units(part, from.y);
        z += units(part, from.z);
    }
    x += units(bent, place.x) + mulDiv(along, light.x, 1 << 14);
    y += units(bent, place.y) + mulDiv(along, light.y, 1 << 14);
    z += units(bent, place.z) + mulDiv(along, light.z, 1 << 14);
    const int32_t steep = -(units(along, outward) + pulled);
    if (steep < 16)
        return;
    // A way across the picture is a longer one on the surface, twice as long at most.
    const int32_t depth = skew_.depth(s.path * position);
    const int32_t longer = 2 * ride.facing > depth ? (depth << 8) / ride.facing : 512, deep = units(longer, z);
    const auto change = [steep](int32_t c) {
        const int32_t most = steep >> 2;
        return mulDiv(c < -most ? -most : c > most ? most : c, -8 * BRIGHTEST, steep);
    };
    x = change(x + mulDiv(n.x, deep, 1 << 14));
    y = change(y + mulDiv(n.y, deep, 1 << 14));
    setSlopes(s.voxel, x, y, even_);
}

// Of a patch to which nothing happened: until when nothing will, nor to the seeds that its own are paired with.
int16_t Settler::idleUntil(const SoftObject::Patch& patch) const
{
    int32_t steps = static_cast<int16_t>(patch.due - travel_);
    const auto wait = [&](const Seed& s) { steps = lesser(steps, static_cast<int16_t>(s.wakes - travel_)); };
    Seed* s = o_.seeds_ + 2 * patch.first;
    for (int i = patch.count; i > 0 && steps > 0; --i, s += 2) {
        wait(s[0]);
        wait(pairedWith(s, s[1]));
        if (s[1].flags & SEED_ACTIVE)
            wait(s[1]);
    }
    return static_cast<int16_t>(travel_ + (steps < 0 ? 0 : steps));
}

// Judges a patch anew. True: seed by seed where a neighbour reaches it.
inline bool Settler::judge(SoftObject::Patch& patch, Seed* s)
{
    uint32_t reached;
    SoftObject::PatchState state;
    if (plain_) {
        state = static_cast<SoftObject::PatchState>(rideReach(&patch));
        reached = ride.reached;
        patch.due = later(ride.holds);
    } else {
        state = reachOf(patch, reached);
    }
    // When one that they do not know of came near, those that may be seen wait no longer.
    if (woken_ || patch.state != state || state != SoftObject::PATCH_MIXED || (reached & (~patch.reached | MANY)))
        return become(patch, s, state, reached);
    patch.reached = reached;
    return true;
}

bool Settler::become(SoftObject::Patch& patch, Seed* s, SoftObject::PatchState state, uint32_t reached)
{
    const uint8_t before = patch.state;
    patch.idle = patch.due;
    o_.displaced_ |= state != SoftObject::PATCH_AT_REST;
    if (state != SoftObject::PATCH_MIXED) {
        if (before != state && state == SoftObject::PATCH_AT_REST)
            rest(patch);
        else if (before != state)
            bury(patch);
        for (int i = patch.count; i > 0; --i, s += 2)
            s->wakes = patch.due;
        return false;
    }
    const bool known = before == SoftObject::PATCH_MIXED && !woken_;
    for (int i = 2 * patch.count; i > 0; --i, ++s)
        if (!known || (s->flags & SEED_VALID))
            s->wakes = later(0);
    patch.reached = reached;
    if (before != SoftObject::PATCH_MIXED) {
        patch.laid = o_.drift_;
        if (o_.tapers_)
            patch.stale = SoftObject::STALE_ALL;  // from normals to paths
    }
    patch.state = SoftObject::PATCH_MIXED;
    return true;
}

// All patches of the object, seed by seed where a neighbour reaches them.
void Settler::settlePatches()
{
    Seed* s = o_.seeds_;
    SoftObject::Patch* patch = o_.patches_;
    for (int p = o_.patchCount_; p > 0; --p, s += 2 * patch->count, ++patch) {
        const uint8_t before = patch->state;
        if (before != SoftObject::PATCH_UNKNOWN && !woken_ && !patch->turned && !passed(patch->idle)) {
            o_.displaced_ |= before != SoftObject::PATCH_AT_REST;
            continue;
        }
        if ((before != SoftObject::PATCH_MIXED || woken_ || passed(patch->due)) && !judge(*patch, s))
            continue;
        activate(patch->reached);
        if (patch->stale != SoftObject::STALE_NONE)
            o_.posePatch(*patch, true);
        const int32_t busy = plain_ ? rideSeeds(patch, s) : throughSeeds(*patch, s, [this](Seed& seed) { settleSeed(seed); });
        o_.displaced_ = true;
        patch->idle = busy ? static_cast<int16_t>(travel_) : idleUntil(*patch);
    }
}

void SoftObject::updateQuick(const Look& look)
{
    Settler(*this, look).settle();
}
