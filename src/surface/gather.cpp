// Brings the viewer, the light and the neighbours of an object into its own space.
#include "gather.h"

#include "math/normal.h"
#include "math/whole.h"
#include "model/model.h"
#include "rt.h"

namespace {

static_assert(Model::OBJECTS_MOST <= SLOTS_MAX, "all other objects have room among the neighbours");

// 1/16 unit: no neighbour reaches farther.
constexpr int32_t FARTHEST16 = 1 << 14;

// Sets the rest of a neighbour that is stretched or warped. Distances to it are judged by their lower bounds, from its core only.
SELDOM void orientShaped(Neighbour& near)
{
    const SoftObject& other = *near.object;
    const Vector by = other.toCoreAxes({Real(1), Real(1), Real(1)});
    near.toCore[0] = near.toCore[0] * by.x;
    near.toCore[1] = near.toCore[1] * by.y;
    near.toCore[2] = near.toCore[2] * by.z;
    const Real narrowing = other.narrowing();
    near.stretch16 = near.inverse16 / narrowing;
    near.steepStretch16 = near.inverse16 / other.steepest();
    near.grain = near.grain * narrowing;
    near.size16 = (rawFromReal(near.size * narrowing) >> 12) + 1;
    near.outer16 = FARTHEST16;
}

// Tangent of half the angle of the widest view whose sides are looked at: wider ones would leave 16.16.
constexpr Real WIDEST(16);

// A neighbour whose size is a smaller part than this of the distance over which it might be felt is left out: it is too small to be
// seen, and core space as large as that distance would leave 16.16.
constexpr Real UNSEEN(0.002);

static SELDOM bool isUnseen(const SoftObject& object, const SoftObject& other)
{
    return other.size() < (object.reach() + other.reach()) * UNSEEN;
}

// No neighbour of this size or more is tiny, unless the object's paths are longer than LONG_PATH; units.
constexpr Real SMALL(6), LONG_PATH(50);

// Whether a neighbour is so small, compared with the object's paths and the distance to their roots, that the products of fields.h,
// whose unit is its size, could overflow. In core space they cannot.
SELDOM bool isTiny(const SoftObject& object, const Neighbour& near)
{
    // No root is farther from the neighbour than `away`. In its sizes that is squared, and multiplied by 32 times a path: 64^2 and
    // 32 * 512 are within 2^15.
    const Vector& c = near.centre;
    const Real away = absolute(c.x) + absolute(c.y) + absolute(c.z) + object.laidReach();
    return shiftDown(away, 6) > near.size || shiftDown(away, 5) * shiftDown(object.longestPath(), 4) > near.size * near.size;
}

// Sets what is special about a neighbour that is no POINT: its axis, and the map from own space to its core space. Of that map
// only the row for the axis matters of a SEGMENT.
void orient(const SoftObject& object, bool tiny, Neighbour& near)
{
    const SoftObject& other = *near.object;
    near.half = shiftDown(other.segmentHalf16(), 4);
    near.segment = near.half > Real(0) && !other.shaped();
    near.kind = near.segment && !other.tapers() && !tiny ? Neighbour::SEGMENT : Neighbour::OTHER;
    near.half16 = rawFromReal(near.half * near.size) >> 12;
    const int32_t half16 = near.segment ? near.half16 : rawFromReal(other.coreReach() / object.growth()) >> 12;
    near.outer16 = near.size16 + half16 + ROUNDED16;
    // Axis i of the neighbour in own axes.
    const Matrix& turn = other.turn();
    const auto axis = [&](int i) { return object.toOwnAxes({turn.m[0][i], turn.m[1][i], turn.m[2][i]}); };
    near.direction = axis(1);
    store14(near.direction, near.axis);
    near.along16 = near.toCore[1] = near.direction * near.inverse16;
    if (near.kind == Neighbour::SEGMENT) {
        near.toCore[0] = near.toCore[2] = {Real(0), Real(0), Real(0)};
        return;
    }
    near.toCore[0] = axis(0) * near.inverse16;
    near.toCore[2] = axis(2) * near.inverse16;
    if (other.shaped())
        orientShaped(near);
    near.offset = other.toCoreAxes(other.toOwnAxes(object.centre() - other.centre())) * (Real(CORE_SIZE) / other.size());
}

}  // namespace

Vector Neighbour::fromCore16(const Vector& q) const
{
    const Vector v = object->awayFromCore(inCore(q) + offset);
    return v * (size * object->narrowing());  // core space has CORE_SIZE = 16 to a size
}

// Finds the planes at the sides of the view that cut through the object, and whether it lies outside one of them.
static void setSides(const SoftObject& object, const FrameContext& frame, const Vector& toCentre, OwnFrame& own)
{
    own.sideCount = 0;
    own.outOfSight = false;
    // Nothing that matters is outside so wide a view.
    if (frame.sideways == Real(0) || frame.sideways > WIDEST || frame.upward > WIDEST)
        return;
    // As far as seeds can be pulled out, and a margin for the size of scales.
    const Real reached = object.reach() + object.spacing() * Real(2);
    const int32_t reach = rawFromReal(reached) >> 12;
    const Vector inwards[] = {{Real(1), Real(0), frame.sideways}, {Real(-1), Real(0), frame.sideways},
                              {Real(0), Real(1), frame.upward}, {Real(0), Real(-1), frame.upward}};
    for (const Vector& inward : inwards) {
        // Most objects are well inside. The length of `inward` is no more than the sum of its components.
        if (dot(inward, toCentre) >= reached * (Real(1) + inward.z))
            continue;
        const Normal n = normalise(inward);
        const Vector u = unitVector(n);
        const int32_t inside = rawFromReal(dot(u, toCentre)) >> 12;
        own.outOfSight = inside < -reach;
        if (own.outOfSight)
            return;
        if (inside >= reach)
            continue;
        OwnFrame::Side& side = own.sides[own.sideCount++];
        store14(object.toOwnAxes(frame.axes.toWorld(u)), side.inward);
        // `begin` is -inside / growth, rounded up.
        const int32_t growth = max32(rawFromReal(object.growth()) >> 8, 1);
        side.begin = (-inside * 256 + (inside < 0 ? growth - 1 : 0)) / growth;
    }
}

void findOwnFrame(const SoftObject& object, const FrameContext& frame, OwnFrame& own)
{
    const Vector toCentre = frame.inView(object.centre());
    setSides(object, frame, toCentre, own);
    if (own.outOfSight)
        return;
    own.growth = object.growth();
    // In own space the eye is farther away if the object has shrunk.
    const Real most = min(own.growth, Real(1)) * Real(1000);
    const Vector toEye = frame.eye - object.centre();
    own.eye = object.toOwnAxes({clamp(toEye.x, -most, most), clamp(toEye.y, -most, most), clamp(toEye.z, -most, most)});
    const Vector eye = object.size() == object.laidSize() ? own.eye : own.eye * quotient(Real(1), own.growth);
    own.eye32[0] = rawFromReal(eye.x) >> 11;
    own.eye32[1] = rawFromReal(eye.y) >> 11;
    own.eye32[2] = rawFromReal(eye.z) >> 11;
    // An eye in the very centre is moved aside, for no division may be by 0.
    own.distance32 = (rawFromReal(nearLength(eye)) >> 11) + 1;
    if (own.distance32 < 4)
        own.distance32 = 4;
    // `limb` is meant for the distance of the centre. Parts of the object that are nearer to the eye need a smaller one.
    const Real extent = object.shaped() ? object.laidReach() : object.coreReach() / own.growth + object.laidRadius();
    const int32_t extent32 = rawFromReal(extent) >> 11;
    const int32_t limb = object.isBall() ? LIMB_OF_BALL : LIMB;
    own.limb = own.distance32 > extent32 ? mulDiv(limb, own.distance32 - extent32, own.distance32) : 0;
    own.distance16 = own.distance32 >> 1;
    own.limb16 = own.distance16 * own.limb >> 14;
    for (int i = 0; i < 3; ++i)
        own.eye16[i] = own.eye32[i] >> 1;
    store14(object.toOwnAxes(frame.light), own.light);
    store14(object.toOwnAxes(frame.axes.right), own.right);
    store14(object.toOwnAxes(frame.axes.up), own.up);
    store14(object.toOwnAxes(frame.axes.ahead), own.ahead);
    own.hider = frame.hider;
    own.centre[0] = rawFromReal(toCentre.x) >> 8;
    own.centre[1] = rawFromReal(toCentre.y) >> 8;
    own.centre[2] = rawFromReal(toCentre.z) >> 8;
}

// Whether a member of the object's own body digs into it.
static bool dentedFromWithin(const SoftObject& object, const Bodies& bodies)
{
    for (const List<Link>::Node* node = object.dents().first(); node != nullptr; node = node->next)
        if (bodies.members(object) == bodies.members(*node->item.object) && node->item.weight != Real(0))
            return true;
    return false;
}

// Sets the place and the size of a neighbour in own space. `away` leads from the object to it in the world; `growth` and `shrink`
// are the object's SoftObject::growth() and 1 over that.
static void place(const SoftObject& object, Real growth, Real shrink, const Vector& away, Neighbour& near)
{
    const SoftObject& other = *near.object;
    near.kind = Neighbour::POINT;
    near.root = -1;
    near.segment = false;
    Vector centre = object.toOwnAxes(away);
    Real size = other.size(), inverse16 = other.inverse16();
    if (growth != Real(1)) {
        centre = centre * shrink;
        size = size * shrink;
        inverse16 = inverse16 * growth;
    }
    near.centre = centre;
    near.size = size;
    near.inverse16 = near.stretch16 = near.steepStretch16 = inverse16;
    const Real proportion = min(quotient(object.size(), other.size()), Real(60));
    near.ratio = proportion * proportion;
    near.x16 = rawFromReal(centre.x) >> 12;
    near.y16 = rawFromReal(centre.y) >> 12;
    near.z16 = rawFromReal(centre.z) >> 12;
    near.size16 = near.outer16 = (rawFromReal(size) >> 12) + 1;
}

// The greatest weight by which an object digs into others.
static Real greatestWeight(const SoftObject& digger)
{
    Real greatest(0);
    for (const List<Link>::Node* node = digger.digs().first(); node != nullptr; node = node->next)
        greatest = max(greatest, node->item.weight);
    return greatest;
}

// Sets how much a neighbour's field counts.
static void weigh(const SoftObject& object, const Bodies& bodies, const Neighbourhood& all, Neighbour& near)
{
    const SoftObject& other = *near.object;
    near.strength = other.strength();
    near.ordinary = !near.digs && near.strength == Real(1) && !(all.hollow && near.isDugBy(object.slot()));
    near.weight = Real(0);
    near.greatestWeight = Real(1);
    near.samples = false;
    if (near.digs) {
        near.weight = -bodies.weight(all.head->slot(), other.slot());
        near.greatestWeight = greatestWeight(other);
        near.samples = other.hollowed() == all.head;
    }
    near.grain = near.ordinary ? near.size : near.size / (max(near.strength, Real(1)) * max(near.weight, Real(1)));
}

// Sets by how much a neighbour's claim and the own one differ from their fields. `weight` is that of their link. Returns true if
// one of them differs. What digs has no claim.
static bool setClaims(const SoftObject& object, bool hollow, Real weight, Neighbour& near)
{
    const auto isPlain = [](const SoftObject& o) {
        return !o.shaped() && o.paint() == nullptr && o.hasSurface();
    };
    if (near.digs || hollow)
        return false;
    const Real heavy = clamp(weight * weight, Real(1), CLAIM_WEIGHT_MOST);
    const auto counted = [](const SoftObject& o) { return quotient(o.size(), o.strength()); };
    const Real own = counted(object), other = counted(*near.object);
    if (own * GUEST_SIZES < other * heavy && isPlain(object) && isPlain(*near.object))
        near.claim = quotient(own * GUEST_SIZES, other * heavy);
    else if (other * HOST_SIZES < own * heavy && isPlain(object) && isPlain(*near.object))
        near.ownClaim = quotient(other * HOST_SIZES, own * heavy);
    return near.claim < Real(1) || near.ownClaim < Real(1);
}

// Collects those of `count` objects that are not too far away along any axis to reach an object, but for itself. Returns their
// number. Most objects are far: this loop stands alone because it is quicker so.
SELDOM static int findNear(SoftObject* const* from, int count, const SoftObject& object, const SoftObject** near)
{
    const Point centre = object.centre();
    const Real range = object.reach() + GATHER_SLACK;
    int found = 0;
    for (SoftObject* const* const end = from + count; from < end; ++from) {
        const SoftObject& other = **from;
        const Real most = other.reach() + range;
        if (absolute(other.centre().x - centre.x) < most && absolute(other.centre().y - centre.y) < most &&
            absolute(other.centre().z - centre.z) < most && &other != &object)
            near[found++] = &other;
    }
    return found;
}

// Whether a neighbour that is heavy, strong or no ball, but not far smaller than the object, makes the neighbourhood steep.
SELDOM static bool isSteep(const Bodies& bodies, const Neighbour& near)
{
    const SoftObject& other = *near.object;
    Real times = near.strength * max(max(bodies.heaviest(near.slot), near.greatestWeight), Real(1));
    if (other.tapers())
        times = times * THIN_TIP;
    else if (other.shaped())
        times = quotient(times, max(other.steepest(), Real(1) / THIN_TIP));
    // (The product of the two bounds is within 16.16.)
    return min(near.ratio * near.size, STEEP) * min(times, Real(30)) > STEEP;
}

// Takes into account a neighbour of far different size, with a heavy link, or where something is not ordinary.
SELDOM static void takeOdd(const SoftObject& object, const Bodies& bodies, Neighbour& near, Neighbourhood& all)
{
    all.claims |= setClaims(object, all.hollow, bodies.weight(object.slot(), near.slot), near);
    all.steep |= isSteep(bodies, near);
}

// Takes a neighbour into account in what holds for all of them together.
static inline void takeIn(const SoftObject& object, Neighbour& near, const Bodies& bodies, Neighbourhood& all)
{
    if (near.ratio > FAR_SIZES)
        all.steep = true;
    if (!near.ordinary) {
        all.ordinary = false;
        takeOdd(object, bodies, near, all);
        if (near.samples)
            all.samplers = all.samplers * 31 + static_cast<uint32_t>(near.slot) + 1;
    }
    if (!near.digs && dentedFromWithin(*near.object, bodies))
        all.inner = true;
}

// Adds those of `count` objects that are near enough to the neighbours. `digs`: they are no members of the body, but dig into it.
static void gatherFrom(SoftObject* const* from, int count, bool digs, const SoftObject& object, const Bodies& bodies,
                       Neighbourhood& all)
{
    const SoftObject* found[NEIGHBOURS_MAX];
    const int reaching = count == 0 ? 0 : findNear(from, count, object, found);
    if (reaching == 0)
        return;
    const Real growth = object.growth(), shrink = quotient(Real(1), growth);
    const bool longPaths = object.longestPath() > LONG_PATH;
    const Point centre = object.centre();
    const Real reach = object.reach();
    // Only members of far different size or strength, or with heavy links, have claims that differ from their fields. (To an object
    // that is weak or strong itself all others are large; .01 allows for the rounding of the quotient.)
    const Real* const weights = bodies.weights(object.slot());
    const Real large = object.strength() == Real(1) ? object.size() * GUEST_SIZES : Real(0);
    const Real small = quotient(object.size(), HOST_SIZES) + Real(0.01);
    Neighbour* next = all.neighbours + all.count;
    for (int i = 0; i < reaching; ++i) {
        const SoftObject& other = *found[i];
        const Real range = reach + other.reach();
        const Vector away = other.centre() - centre;
        const auto square = squareOf(away);
        if (square >= squareOf(range + GATHER_SLACK) || (other.size() < SMALL && isUnseen(object, other)))
            continue;
        Neighbour& near = *next++;
        near.object = &other;
        near.slot = other.slot();
        near.weights = bodies.weights(near.slot);
        all.bySlot[near.slot] = &near;
        near.digs = digs;
        near.inRange = square < squareOf(range);
        place(object, growth, shrink, away, near);
        weigh(object, bodies, all, near);
        near.claim = near.ownClaim = Real(1);
        near.change = Real(0);  // until the field is evaluated where it reaches
        const Real weight = weights[near.slot];
        if (other.size() > large || other.size() < small || weight > Real(1))
            takeOdd(object, bodies, near, all);
        const bool tiny = (near.size < SMALL || longPaths) && isTiny(object, near);
        if (tiny || !other.isBall()) {
            orient(object, tiny, near);
            all.steep |= isSteep(bodies, near);
        }
        takeIn(object, near, bodies, all);
    }
    all.count = static_cast<int>(next - all.neighbours);
}

void gather(const SoftObject& object, const FrameContext& frame, Neighbourhood& all)
{
    const Bodies& bodies = *frame.bodies;
    all.count = 0;
    const SoftObject* const hollowed = object.hollowed();
    all.hollow = hollowed != nullptr;
    all.head = all.hollow ? hollowed : &object;
    all.weight = all.hollow ? -bodies.weight(all.head->slot(), object.slot()) : Real(0);
    all.inner = dentedFromWithin(*all.head, bodies);
    all.restsAtOne = object.rests() && !all.hollow;
    all.ordinary = object.strength() == Real(1) && !all.hollow && !object.shaped();
    all.last = object.restRoot() == Real(0.5) ? Real(1.98) : Real(0.99) / object.restRoot();
    all.steep = false;
    all.claims = all.hollow;
    all.samplers = 0;
    memset(all.bySlot, 0, sizeof all.bySlot);
    gatherFrom(bodies.diggers(*all.head), bodies.diggerCount(*all.head), true, object, bodies, all);
    all.dented = all.count > 0;
    gatherFrom(bodies.members(*all.head), bodies.memberCount(*all.head), false, object, bodies, all);
    all.deep = all.inner || all.dented || !all.restsAtOne;
    all.ordinary = all.ordinary && !all.inner;
}
