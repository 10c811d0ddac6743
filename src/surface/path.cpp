// The fields of the object and of its neighbours along one path: their sum at a position, its slope, and the direction in which
// the sum falls. Where not all objects are linked with each other, blend.cpp turns the sum into the body's field.
#include "path.h"

#include "math/normal.h"

namespace {

// Positions where the search of a path begins: usually, and where dents or weak fields may leave the surface deep inside.
constexpr Real FIRST(0.7), FIRST_DEEP(0.06);
// About how far a field follows a cubic curve: a neighbour's in its sizes, the own one in positions.
constexpr Real SMOOTH(0.8), SMOOTH_OWN(0.96);

}  // namespace

Path::Path(const SoftObject& object, Neighbourhood& all, const Bodies& bodies, Nearby& nearby, Counts& counts)
    : object_(object), all_(all), bodies_(bodies), nearby_(nearby), counts_(counts), warped_(object.warped()),
      ownPlain_(!warped_ && object.strength() == Real(1) && !all.hollow && !all.inner), restParam_(object.restParam()),
      first_(all.deep ? FIRST_DEEP : FIRST), last_(all.last), middle_(all.deep ? shiftDown(first_ + last_, 1) : COVERED_AT),
      restOfPath_((max(last_ - middle_, middle_ - first_) + Real(0.02)) * object.longestPath())
{
}

// Prepares neighbours for a root, but for those that know it: sets what the paths of all seeds of the root have in common.
void Path::setRoots(Neighbour* const* first, Neighbour* const* end, const Seed& s) const
{
    const Vector& root = object_.root(s.root);
    for (Neighbour* const* at = first; at < end; ++at) {
        Neighbour& near = **at;
        if (near.root == s.root)
            continue;
        // All paths have one length, but in a tapering object it differs from root to root, and in a shaped one from path to path.
        const bool known = near.root >= 0 && !object_.tapers();
        near.root = object_.shaped() ? -1 : s.root;
        if (near.kind == Neighbour::OTHER) {
            near.toRoot = near.inCore(root) + near.offset;
            continue;
        }
        const auto inSizes = [&](const Vector& v) {
            return Vector{shiftDown(v.x * near.inverse16, 4), shiftDown(v.y * near.inverse16, 4),
                          shiftDown(v.z * near.inverse16, 4)};
        };
        near.toRoot = root - near.centre;
        const Vector e = inSizes(near.toRoot);
        near.a = dot(e, e);
        if (!known) {
            const Vector d = inSizes(s.path);
            near.c = dot(d, d);
        }
        near.twice16 = e * shiftUp(near.inverse16, 1);
        if (near.kind == Neighbour::SEGMENT)
            near.y = shiftDown(dot(near.toRoot, near.along16), 4);
    }
}

Real Neighbour::otherParam(Real p)
{
    t = object->param(toRoot + step * p, &halfGradient);
    // Beyond the end of the field the derivative is not needed.
    change = t < Real(1) ? dotDown(halfGradient, step, 7) : Real(0);
    return t;
}

// ---- Evaluating the fields at one position

// Makes the neighbours on a list those that are evaluated from now on, and prepares each of them for the root of a seed.
void Path::take(const NeighbourList& list, const Seed& s)
{
    if (list_ != &list) {
        list_ = &list;
        setNear(list);
        findOdd();
    }
    // Most often all of them know the root.
    Neighbour *const *first = near_, *const *const end = near_ + touched_;
    while (first < end && (*first)->root == s.root)
        ++first;
    if (first < end)
        setRoots(first, end, s);
    rootOfList_ = object_.shaped() ? -1 : s.root;
}

inline void Path::setNear(const NeighbourList& list)
{
    near_ = list.near;
    touched_ = list.count;
    complete_ = list.complete;
}

// Finds out whether something is odd or special about the object or these neighbours. (It stands alone because that is quicker.)
void Path::findOdd()
{
    odd_ = !ownPlain_;
    special_ = all_.claims;
    for (int i = 0; i < touched_; ++i) {
        odd_ |= !near_[i]->ordinary;
        special_ |= near_[i]->kind == Neighbour::OTHER;
    }
    special_ |= odd_;
}

// Evaluates the own field of an object that is not warped and has strength 1.
inline Fields Path::own(Real position)
{
    const Real t = shiftDown(position * position, 2);
    const FieldStep field = t < Real(1) ? geoffQuick(t) : FieldStep{Real(0), Real(0)};
    ownField_ = field.value;
    ownSlope_ = field.slope;
    return {field.value, shiftDown(field.slope * position, 1), Real(0), 0};
}

// The greatest difference of a neighbour's claim and the own one at the position evaluated last.
Real Path::dominantClaim() const
{
    Real most = -ownField_;
    for (int i = 0; i < touched_; ++i)
        most = max(most, near_[i]->value * near_[i]->claim - ownField_ * near_[i]->ownClaim);
    return most;
}

Real Path::fieldLead() const
{
    const Neighbour *const at = host(), *const other = strongest(at);
    return (other == nullptr ? Real(0) : other->value) - (at == nullptr ? ownField_ : at->value);
}

// Whether the sum of the fields is the body's field where no more than one neighbour reaches the position.
inline bool Path::addsUp() const
{
    for (int i = 0; i < touched_; ++i)
        if (near_[i]->value > Real(0))
            return nearby_.weight(near_[i]->slot) == Real(1);
    return true;
}

// Evaluates the fields at a position where nothing is odd about the object and the neighbours. A neighbour that is neither point
// nor segment must have its t there already. `path` is the path that becomes current; null: it is current already. Returns false
// when no neighbour reaches the position.
inline bool Path::lookPlain(Real position, const Vector* path, Sample* sample)
{
    ++counts_.iterations;
    lookedAt_ = position;
    shared_ = false;
    Fields fields = own(position);
    addFields(near_, near_ + touched_, position, path, &fields);
    *sample = {fields.sum - ISOVALUE, fields.slope, fields.strongest - ownField_};
    if (!complete_ && (fields.reaching > 1 || !addsUp()))
        blend(position, fields, *sample);
    return fields.reaching != 0;
}

// Evaluates the fields at a position in every case. Parameters and result are those of lookPlain().
bool Path::lookAnywhere(Real position, const Vector* path, Sample* sample)
{
    if (odd_) {
        ++counts_.iterations;
        lookedAt_ = position;
        return lookOdd(position, path, sample);
    }
    for (int i = 0; i < touched_; ++i) {
        Neighbour& near = *near_[i];
        if (near.kind != Neighbour::OTHER)
            continue;
        if (path != nullptr)
            near.aim(*path);
        near.otherParam(position);
    }
    const bool touched = lookPlain(position, path, sample);
    if (all_.claims)
        sample->dominance = dominantClaim();
    return touched;
}

Sample Path::look(Real position)
{
    Sample sample;
    if (special_)
        lookAnywhere(position, nullptr, &sample);
    else
        lookPlain(position, nullptr, &sample);
    return sample;
}

bool Path::begin(const NeighbourList& list, const Seed& s, Real position, Sample* sample)
{
    makeCurrent(list, s);
    return special_ ? lookAnywhere(position, &s.path, sample) : lookPlain(position, &s.path, sample);
}

Sample Path::beginSearch(const Seed& s)
{
    Sample sample;
    begin(nearby_.listed(), s, middle_, &sample);
    leaveOut();
    return sample;
}

void Path::beginDeepSearch(const Seed& s)
{
    makeCurrent(nearby_.listed(), s);
    for (int i = 0; i < touched_; ++i) {
        near_[i]->aim(s.path);
        near_[i]->param(middle_);
    }
    leaveOut();
}

// Whether a neighbour may reach some position of the path, judged by its t in the middle.
inline bool Path::mayReach(const Neighbour& near) const
{
    if (near.t < Real(1))
        return true;
    const Real reach = Real(1) + restOfPath_ * shiftDown(near.stretch16, 4);
    return near.t < (reach < Real(100) ? reach * reach : Real(10000));
}

// Leaves out the neighbours that reach no position of the path.
void Path::leaveOut()
{
    shortList_.count = 0;
    for (int i = 0; i < touched_; ++i)
        if (mayReach(*near_[i]))
            shortList_.add(*near_[i]);
    if (shortList_.count == touched_)
        return;
    shortList_.complete = true;
    if (!complete_)
        nearby_.setComplete(shortList_);
    setNear(shortList_);
    list_ = nullptr;
}

// The own t at a position of the path of a warped object; sets ownChange_ and ownOut_.
Real Path::warpedParam(Real position)
{
    const Real inward = Real(CORE_SIZE) / object_.laidSize();
    const Vector step = seed_->path * inward;
    const Real t = object_.param(root() * inward + step * position, &ownOut_);
    ownChange_ = t < Real(1) ? dotDown(ownOut_, step, 7) : Real(0);
    return t;
}

// ---- Results of the last evaluation

// The factor of a neighbour's part in the sum of gradients (sumGradients()).
inline __attribute__((always_inline)) Real Path::pushOf(const Neighbour& near, int shift) const
{
    Real slope = shared_ ? near.slope * near.share : near.slope;
    if (!shared_ && near.digs)
        slope = -(slope * near.weight);
    return -(shiftDown(slope, shift) * near.ratio);
}

// The shift that brings the largest ratio of a neighbour that reaches the seed to 8 or less, and the sum of all gradients to a
// length that leaves room for what is made of it.
SELDOM int Path::findGradientShift() const
{
    constexpr Real LARGEST(8), LONGEST(16);  // the latter in 1/256 of the length
    Real largest(0);
    for (int i = 0; i < touched_; ++i)
        if (near_[i]->slope != Real(0))
            largest = max(largest, near_[i]->ratio);
    int shift = 0;
    while (shiftDown(largest, shift) > LARGEST)
        ++shift;
    // The bounds keep all of this within 16.16.
    const int bySize = shift;
    Real sum(0);
    for (int i = 0; i < touched_; ++i) {
        const Neighbour& near = *near_[i];
        if (near.slope == Real(0))
            continue;
        const Vector v = near.kind == Neighbour::OTHER ? near.fromCoreSpace(near.halfGradient) : near.toRoot;
        const Real long256 = shiftDown(max(absolute(v.x), max(absolute(v.y), absolute(v.z))), 8);
        sum = min(sum + long256 * min(absolute(pushOf(near, shift)), Real(100)), Real(10000));
    }
    while (shiftDown(sum, shift - bySize) > LONGEST)
        ++shift;
    return shift;
}

// The gradient of a field is 2 F' / size^2 times the vector from its core. Each vector is added with the factor -F' times the
// squared proportion of the own size to the neighbour's, over 2^shift. `slants`: the path may not lead away from the own core's
// nearest point.
inline __attribute__((always_inline)) Vector Path::sumGradients(Real position, int shift, bool slants) const
{
    Real own = -(shared_ ? ownSlope_ * ownShare_ : ownSlope_);
    if (!shared_ && all_.hollow)
        own = -(own * all_.weight);
    own = shiftDown(own, shift);
    Vector g{Real(0), Real(0), Real(0)};
    // The vector from a point core to the seed is the vector to the root and the way along the path, which is added up in `along`.
    Real along = slants ? Real(0) : own;
    for (int i = 0; i < touched_; ++i) {
        const Neighbour& near = *near_[i];
        if (near.slope == Real(0))
            continue;
        const Real push = pushOf(near, shift);
        if (near.kind == Neighbour::OTHER) {
            g = g + near.fromCoreSpace(near.halfGradient) * push;
            continue;
        }
        along += push;
        g = g + near.toRoot * push;
        if (near.kind == Neighbour::SEGMENT)
            g = g - near.direction * (near.k * near.size * push);
    }
    g = g + seed_->path * (along * position);
    return slants ? g + ownGradient(position, own) : g;
}

Vector Path::outward(Real position) const
{
    const int shift = gradientShift();
    const bool slants = object_.slants();
    return shift == 0 ? sumGradients(position, 0, slants) : sumGradients(position, shift, slants);
}

Vector Path::outwardBeside(const Seed& s, Real position, const Vector& distance)
{
    Seed beside = s;
    beside.path = s.path + distance * (Real(1) / position);
    // What the neighbours know of a root holds for paths of one length (setRoots()). That is the length of the seed's own path, but
    // not of the path beside it.
    const NeighbourList& list = nearby_.at(position);
    take(list, s);
    Sample sample;
    begin(list, beside, position, &sample);
    const Vector out = sumGradients(position, gradientShift(), !object_.isBall() || object_.slants());
    seed_ = nullptr;
    return out;
}

Vector Path::ownGradient(Real position, Real factor) const
{
    return (warped_ ? ownOut_ : object_.slopeAt(root() + from(position))) * shiftDown(factor * object_.laidSize(), 4);
}

Real Path::gradientBound() const
{
    // The gradient of a field is 2 f' r / R^2, and r / R is at most r^2 / R^2 + 1/4; 0.1 allows for changes of the gradient itself.
    Real sum(0);
    for (int i = 0; i < touched_; ++i)
        sum += (Real(0.1) - near_[i]->slope * (near_[i]->t + Real(0.25))) * near_[i]->steepStretch16 * near_[i]->greatestWeight;
    return shiftDown(sum, 3);
}

Real Path::steepestGradient() const
{
    Real sum(0);
    for (int i = 0; i < touched_; ++i)
        sum += near_[i]->steepestGradient();
    // Where not all objects are linked with each other, some fields have a share above 1 in the body's field.
    return complete_ ? sum : sum + shiftDown(sum, 2);
}

Real Path::smoothStep() const
{
    Real sheerest16(0);
    for (int i = 0; i < touched_; ++i)
        sheerest16 = max(sheerest16, near_[i]->steepStretch16);
    const Real sizes = shiftDown(sheerest16 * nearLength(seed_->path), 4);
    return SMOOTH < sizes * SMOOTH_OWN ? SMOOTH / sizes : SMOOTH_OWN;
}
