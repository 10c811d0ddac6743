// SoftObject: pose, graph and field of any primitive. The layout of its seeds is in layout.cpp.
#include "model/softobj.h"

#include "math/normal.h"
#include "math/alloc.h"
#include "math/text.h"
#include "model/stop.h"

namespace {

// Seeds are laid out anew when scaling has changed their spacing by more than this share of the spacing asked for.
constexpr Real DRIFT_MAX(0.25);

// Seeds rest at this param() or farther out. Where an object too weak for that blends with others, its surface lies farther out
// too.
constexpr Real REST_LEAST(0.140625);

// Distance from the core, in core space, beyond which a field is so much less steep than at its steepest that no warp makes up
// for it.
constexpr Real STEEP_AT(0.65 * CORE_SIZE);

// Returns a vector close to `v` whose length equals that of `like`: the largest component of `v` takes up the difference. Each
// call is exact to half a last bit and has no bias, so that a distance survives a million turns.
Vector withLengthOf(const Vector& v, const Vector& like)
{
#if FB_REAL == FB_FIXED
    const auto square = [](const Vector& u) {
        return static_cast<int64_t>(u.x.raw) * u.x.raw + static_cast<int64_t>(u.y.raw) * u.y.raw +
               static_cast<int64_t>(u.z.raw) * u.z.raw;
    };
    Vector r = v;
    Real* largest = &r.x;
    if (absolute(r.y) > absolute(*largest))
        largest = &r.y;
    if (absolute(r.z) > absolute(*largest))
        largest = &r.z;
    if (*largest == Real(0))
        return r;
    const int64_t lack = square(like) - square(r);
    const uint32_t twice = 2 * static_cast<uint32_t>(rawFromReal(absolute(*largest)));
    const int32_t change = static_cast<int32_t>(divide64(static_cast<uint64_t>(lack < 0 ? -lack : lack) + twice / 2, twice));
    const bool outwards = (lack > 0) == (*largest > Real(0));
    *largest += Real::fromRaw(outwards ? change : -change);
    return r;
#else
    return withLength(v, length(like));
#endif
}

}  // namespace

SoftObject::SoftObject(int number, Real size, Real coreReach, bool tapers)
    : number_(number), centre_{Real(0), Real(0), Real(0)}, turn_(Matrix::identity()), size_(size),
      radius_(shiftDown(size, 1)), inverse_(Real(CORE_SIZE) / size), coreReach_(coreReach),
      stretch_{Real(1), Real(1), Real(1)}, unstretch_{Real(1), Real(1), Real(1)}, mostStretch_(1), stretched_(false),
      warped_(false), shaped_(false),
      ball_(!tapers && coreReach == Real(0)), reach_(coreReach + size), extent_{reach_, reach_, reach_},
      sizeMade_(size), coreReachMade_(coreReach), coreReach16_(coreReach * (Real(CORE_SIZE) / size)), strength_(1),
      restParam_(0.25), restRoot_(0.5), rests_(true), slot_(0), recalc_(true), tapers_(tapers),
      displaced_(false), unfinished_(false), ramp_(nullptr), surface_(nullptr), makeSurface_(nullptr)
{
    laid_.size = size;
}

SoftObject::~SoftObject()
{
    for (const List<Link>::Node* node = skel_.first(); node != nullptr; node = node->next)
        node->item.object->unlink(this);
    for (const List<Link>::Node* node = dents_.first(); node != nullptr; node = node->next)
        node->item.object->digs_.remove({this, Real(0)});
    for (const List<Link>::Node* node = digs_.first(); node != nullptr; node = node->next)
        node->item.object->dents_.remove({this, Real(0)});
    destroy(surface_);
    laid_.release();
}

// --- Operations

Point SoftObject::toWorld(const Vector& v) const
{
    const Vector grown = size_ == laid_.size ? v : v * growth();
    return centre_ + (turnsSeeds() ? turn_ * grown : grown);
}

void SoftObject::place(const Point& centre, Real wanted)
{
    const Real size = clamp(wanted, Real(MIN_SIZE), Real(MAX_SIZE));
    if (centre == centre_ && size == size_)
        return;
    const Point before = centre_;
    const Real reachBefore = reach_;
    centre_ = centre;
    if (size != size_)
        setGrown(size);
    recalc_ = true;
    tellNeighbours(before, reachBefore);
}

// Sets the size and everything that depends on it.
void SoftObject::setGrown(Real size)
{
    size_ = size;
    radius_ = size * restRoot_;
    inverse_ = Real(CORE_SIZE) / size;
    coreReach_ = grown(coreReachMade_);
    measureReach();
    if (laid_.seeds != nullptr) {
        const Real drift = growth();
        if (drift > Real(1) + DRIFT_MAX || drift < Real(1) - DRIFT_MAX) {
            // Seeds that are laid out anew are not displaced any more.
            tellNeighbours();
            resample(laid_.spacing, makeSurface_);
        }
    }
}

void SoftObject::rotate(const Point& about, const Vector& axis, Angle angle)
{
    const Matrix by = Matrix::rotation(axis, angle);
    const Vector arm = centre_ - about;
    translate(withLengthOf(by * arm, arm) - arm);
    setTurn(by * turn_);
}

void SoftObject::setTurn(const Matrix& turn)
{
    // Makes the columns perpendicular and of unit length again, because a product of many rotations drifts.
    Vector x{turn.m[0][0], turn.m[1][0], turn.m[2][0]};
    Vector y{turn.m[0][1], turn.m[1][1], turn.m[2][1]};
    x = unit(x);
    y = unit(y - x * dot(x, y));
    const Vector z = cross(x, y);
    const Vector columns[] = {x, y, z};
    Matrix square = Matrix::identity();
    bool same = true;
    for (int j = 0; j < 3; ++j) {
        square.m[0][j] = columns[j].x;
        square.m[1][j] = columns[j].y;
        square.m[2][j] = columns[j].z;
        for (int i = 0; i < 3; ++i)
            same = same && square.m[i][j] == turn_.m[i][j];
    }
    if (same)
        return;
    turn_ = square;
    // The seeds of a ball that does not ride stay where they are.
    if (!turnsSeeds())
        return;
    measureExtent();
    recalc_ = true;
    // Neighbours do not feel the turn of a ball.
    if (!ball_)
        tellNeighbours();
}

void SoftObject::setStrength(Real wanted)
{
    strength_ = clamp(wanted, STRENGTH_LEAST, STRENGTH_MOST);
    findRest();
}

void SoftObject::findRest()
{
    // Find the t where the object's field equals the isovalue: 1/4 for a strength of 1, farther out for more. For the wall of a
    // hollow the level is different: the field of the dented object is between the isovalue and 1 there, so the digging object
    // takes away 0 to 1/2. Seeds rest where it takes away the mean, half the isovalue.
    const SoftObject* const dented = hollowed();
    Real strength = strength_, level = ISOVALUE;
    if (dented != nullptr) {
        strength = strength * hollowLink()->weight;
        level = shiftDown(ISOVALUE, 1);
    }
    Real inside(0), outside(1);
    for (int i = 0; i < 20; ++i) {
        const Real middle = shiftDown(inside + outside, 1);
        (strength * geoff(middle) > level ? inside : outside) = middle;
    }
    restParam_ = strength_ == Real(1) && dented == nullptr ? Real(0.25) : max(inside, REST_LEAST);
    restRoot_ = squareRoot(restParam_);
    rests_ = inside >= REST_LEAST && dented == nullptr;
    radius_ = size_ * restRoot_;
    if (warped_)
        makeWarp(warp_.asked());
}

void SoftObject::measureReach()
{
    shaped_ = stretched_ || warped_;
    ball_ = !tapers_ && !shaped_ && coreReachMade_ == Real(0);
    reach_ = coreReach_ + size_;
    if (shaped_)
        reach_ = reach_ * mostStretch_ * warp_.most();
    measureExtent();
}

// Finds how far the field reaches along each axis of the world: farther by the size than the box around the core, which turns with
// the object. For a shaped object it is the ball of reach().
void SoftObject::measureExtent()
{
    extent_ = {reach_, reach_, reach_};
    if (coreReach_ == Real(0) || shaped_)
        return;
    const Vector core = coreExtent16();
    const auto along = [&](const Real row[3]) {
        const Real most = absolute(row[0]) * core.x + absolute(row[1]) * core.y + absolute(row[2]) * core.z;
        return min(size_ + quotient(most, inverse_), reach_);
    };
    extent_ = {along(turn_.m[0]), along(turn_.m[1]), along(turn_.m[2])};
}

void SoftObject::setStretch(const Vector& factors)
{
    stretch_ = factors;
    unstretch_ = {Real(1) / factors.x, Real(1) / factors.y, Real(1) / factors.z};
    mostStretch_ = max(factors.x, max(factors.y, factors.z));
    stretched_ = !(factors == Vector{Real(1), Real(1), Real(1)});
    measureReach();
    recalc_ = true;
}

// Sets the warp. Its height is that of the surface on which seeds rest.
void SoftObject::makeWarp(const WarpAmounts& amounts)
{
    const Real radius = Real(CORE_SIZE) * restRoot_;
    const Vector core = coreExtent16(), surface = stretchedOut(core + Vector{radius, radius, radius});
    const Vector field = stretchedOut(core + Vector{Real(CORE_SIZE), Real(CORE_SIZE), Real(CORE_SIZE)});
    warp_.set(amounts, surface, field, stretchedOut(core + Vector{STEEP_AT, STEEP_AT, STEEP_AT}));
    measureReach();
}

void SoftObject::setWarp(const WarpAmounts& amounts)
{
    if ((warped_ || amounts == NO_WARP) && amounts == warp_.asked())
        return;
    const bool laid = laid_.seeds != nullptr;
    if (laid && laid_.plainSeeds == nullptr && !keepPlain(laid_))
        return;
    tellNeighbours();
    warped_ = true;
    makeWarp(amounts);
    if (laid) {
        reshape();
        surface_->reshape();
    }
    recalc_ = true;
    tellNeighbours();
}

// "If the object is transformed, this flag is set and it will tell all its neighbors to set their recalc flags", but "if an
// object has no displaced seeds [...] it will not tell its neighbors". Our addition: it also tells a neighbour that is in
// range, so that huge jumps are safe.
void SoftObject::tellNeighbours(const Point& before, Real reachBefore)
{
    const auto reaches = [&](const SoftObject& other) {
        return inRange(other) || isNearer(before, other.centre_, reachBefore + other.reach_);
    };
    for (const List<Link>::Node* node = skel_.first(); node != nullptr; node = node->next) {
        if (!node->item.object->recalc_ && (displaced_ || reaches(*node->item.object)))
            node->item.object->recalc_ = true;
    }
    for (int i = 0; i < 2; ++i)
        for (const List<Link>::Node* node = (i == 0 ? digs_ : dents_).first(); node != nullptr; node = node->next)
            if (reaches(*node->item.object))
                node->item.object->recalc_ = true;
}

bool SoftObject::link(SoftObject* other, Real weight)
{
    Link* there = skel_.find({other, Real(0)});
    if (there != nullptr)
        there->weight = weight;
    else if (!skel_.append({other, weight}))
        return false;
    recalc_ = true;
    return true;
}

void SoftObject::unlink(SoftObject* other)
{
    if (skel_.remove({other, Real(0)}))
        recalc_ = true;
}

bool SoftObject::dent(SoftObject* other, Real weight)
{
    recalc_ = true;
    Link* there = dents_.find({other, Real(0)});
    if (there != nullptr) {
        there->weight = weight;
        other->digs_.find({this, Real(0)})->weight = weight;
        return true;
    }
    if (!dents_.append({other, weight}))
        return false;
    if (other->digs_.append({this, weight}))
        return true;
    dents_.remove({other, Real(0)});
    return false;
}

void SoftObject::undent(SoftObject* other)
{
    if (!dents_.remove({other, Real(0)}))
        return;
    other->digs_.remove({this, Real(0)});
    // The other object may have a surface again.
    recalc_ = other->recalc_ = true;
}

bool SoftObject::hasSurface() const
{
    const auto some = [](const List<Link>& list) {
        for (const List<Link>::Node* node = list.first(); node != nullptr; node = node->next)
            if (node->item.weight != Real(0))
                return true;
        return false;
    };
    return !some(digs_) || some(skel_);
}

const Link* SoftObject::hollowLink() const
{
    if (digs_.empty() || hasSurface())
        return nullptr;
    const Link* most = nullptr;
    Real deepest(0);
    for (const List<Link>::Node* node = digs_.first(); node != nullptr; node = node->next) {
        const Link& link = node->item;
        if (link.weight == Real(0) || !link.object->hasSurface())
            continue;
        const Real depth = depthIn(*link.object);
        if (most == nullptr || depth > deepest || (depth == deepest && link.object->number() < most->object->number())) {
            most = &link;
            deepest = depth;
        }
    }
    return most;
}

// How deep the middle of the object lies in another one: the other's field there, or minus the distance from its reach.
Real SoftObject::depthIn(const SoftObject& other) const
{
    const Real field = other.fieldFunc(centre_);
    return field > Real(0) ? field : min(other.reach_ - nearLength(centre_ - other.centre_), Real(0));
}

// --- The field

Real SoftObject::plainParam(const Vector& q, Vector* slope) const
{
    const Vector v = fromCore(q);
    *slope = v;
    return paramOf(v);
}

Real SoftObject::warpedParam(const Vector& q, Vector* slope) const
{
    *slope = q;
    const Real outside = warp_.outside(q);
    if (outside >= Real(0))
        return Real(1) + shiftDown(min(outside * narrowing(), Real(1000)), 3);
    Warp::Way way;
    warp_.back(q, way);
    const Real t = plainParam(unstretched(way.plain), slope);
    if (t < Real(1))
        *slope = warp_.slopeOut(way, unstretched(*slope));
    return t;
}

Vector SoftObject::awayFromCore(const Vector& q) const
{
    if (!warped_)
        return fromCore(q);
    Warp::Way way;
    const Real far(8000);
    warp_.back({clamp(q.x, -far, far), clamp(q.y, -far, far), clamp(q.z, -far, far)}, way);
    return fromCore(unstretched(way.plain));
}

Vector SoftObject::slopeAt(const Vector& place) const
{
    Vector slope;
    param(toCoreAxes(place) * (Real(CORE_SIZE) / laid_.size), &slope);
    return toCoreAxes(slope);
}

Real SoftObject::fieldNear(const Point& p, FieldPlace* place) const
{
    const Vector v = p - centre_;
    if (isBall()) {
        // No component of the vector is longer than the object's size, so that the squares fit.
        place->slope = v * inverse_;
        place->param = shiftDown(dot(place->slope, place->slope), 8);
    } else {
        place->param = paramAt(v, &place->slope);
    }
    return strength_ * geoff(place->param);
}

// The square of a place's distance from the core over that of the size, given the place from the centre in the axes of the world.
// `*slope` receives half the gradient of it, in core axes and core space, times CORE_SIZE^2; it is not set where the field ends.
inline Real SoftObject::paramAt(const Vector& v, Vector* slope) const
{
    const Real end = size_ + coreReach_;
    const Vector q = toCoreAxes(toOwnAxes(v));
    if (stretched_ && !warped_ && (absolute(q.x) >= end || absolute(q.y) >= end || absolute(q.z) >= end))
        return Real(1);
    return param(q * inverse_, slope);
}

Vector SoftObject::gradientAt(const FieldPlace& place) const
{
    static_assert(CORE_SIZE == 2 << 3, "half a gradient times CORE_SIZE^2, shifted, is a gradient times CORE_SIZE");
    return (isBall() ? place.slope : turn_ * toCoreAxes(place.slope)) *
           shiftDown(strength_ * geoffSlope(place.param) * inverse_, 3);
}

void SoftObject::describeAs(const char* kind, const Real* numbers, int count, char* to, int size) const
{
    int used = snprintf(to, static_cast<size_t>(size), "%s %d", kind, number_);
    for (int i = 0; i < count && used < size; ++i) {
        char text[24];
        formatReal(text, sizeof text, numbers[i]);
        used += snprintf(to + used, static_cast<size_t>(size - used), " %s", text);
    }
}

void SoftObject::describeShape(int which, char* to, int size) const
{
    static const char* const WORDS[SHAPES] = {"stretch", "taper", "twist", "bend"};
    to[0] = 0;
    const Matrix& m = turn_;
    Real numbers[12] = {centre_.x,   centre_.y,   centre_.z,   m.m[0][0], m.m[1][0], m.m[2][0],
                        m.m[0][1], m.m[1][1], m.m[2][1], stretch_.x,  stretch_.y,  stretch_.z};
    if (which > 0) {
        numbers[9] = warp_.amounts().part[which - 1];
        numbers[10] = warp_.height() * shiftDown(size_, 4);
    }
    if (which == 0 ? stretched_ : warped_ && numbers[9] != Real(0))
        describeAs(WORDS[which], numbers, which == 0 ? 12 : 11, to, size);
}

// --- A frame

void SoftObject::update(const FrameContext& frame)
{
    if (!recalc_ && !unfinished_)
        return;
    unfinished_ = surface_->update(frame);
    recalc_ = stopAsked();
}

void SoftObject::draw(const FrameContext& frame, VoxelList& list, int room, int* next)
{
    surface_->draw(frame, list, room, next);
}
