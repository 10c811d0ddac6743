// The fields of the object and of its neighbours along one path: their sum at a position, with its slope, and the direction in
// which it falls. What becomes of the sum where not all are linked with all stands in blend.cpp.
#include "path.h"

namespace {

// Positions: where paths begin to be searched, and those that are hollowed out or of weak objects.
constexpr Real FIRST(0.7), FIRST_DEEP(0.06);
// Of the field, over the size: no field changes by more.
constexpr Real STEEPEST_OF_ALL(1.6);

}  // namespace

Path::Path(const SoftObject& object, const Neighbourhood& all, const Bodies& bodies, Nearby& nearby, Counts& counts)
    : object_(object), all_(all), bodies_(bodies), nearby_(nearby), counts_(counts),
      ownPlain_(object.strength() == Real(1) && !all.hollow && !object.warped()), common_(all.common), warped_(object.warped()),
      restParam_(object.restParam()), first_(all.deep ? FIRST_DEEP : FIRST), last_(all.last)
{
    const Real restOfPath = (shiftDown(last_ - first_, 1) + Real(0.02)) * object.longestPath();
    for (int i = 0; i < all.count; ++i) {
        from_[i].root = -1;
        const Real reach = Real(1) + restOfPath * shiftDown(all.neighbours[i].steep16, 4);
        reachT_[i] = reach < Real(100) ? reach * reach : Real(10000);
    }
}

// What is the same for all seeds of a root.
void Path::setRoot(const Neighbour& near, const Seed& s, FromRoot& to) const
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

// ---- A look at one position

// Adds up the fields at one position of the path at hand.
template <bool COMMON>
struct Path::Sum {
    Path& path;
    Real position, sum, slope, strongest;
    bool touched;

    // Begins with the own field.
    Sum(Path& of, Real at) : path(of), position(at), strongest(0), touched(false)
    {
        path.lookedAt_ = at;
        if (!COMMON && !of.ownPlain_) {
            addOwn(of);
            return;
        }
        const Real t = shiftDown(at * at, 2);
        const FieldStep own = t < Real(1) ? geoffQuick(t) : FieldStep{Real(0), Real(0)};
        path.ownField_ = sum = own.value;
        path.ownSlope_ = own.slope;
        slope = shiftDown(own.slope * at, 1);
    }

    // The own field of an object that is not as strong as most, or of one whose seeds sample a hollow: it digs, and the head is
    // among its neighbours.
    SELDOM void addOwn(Path& of)
    {
        const Real t = of.ownParam(position), strength = of.object_.strength();
        const FieldStep own = t < Real(1) ? geoffQuick(most(t, Real(0))) : FieldStep{Real(0), Real(0)};
        of.ownField_ = sum = own.value * strength;
        of.ownSlope_ = own.slope * strength;
        slope = of.ownRate(position);
        of.headField_ = Real(0);
        if (of.all_.hollow) {
            sum = -(sum * of.all_.weight);
            slope = -(slope * of.all_.weight);
        }
    }

    // The field of a neighbour.
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

    // The same of a neighbour that is not as strong as most, or digs, or has a hollow.
    SELDOM void addOdd(Along& along)
    {
        const Neighbour& near = *along.near;
        along.value = along.value * near.strength;
        along.slope = along.slope * near.strength;
        const Real weight = near.digs ? -near.weight : Real(1);
        sum += along.value * weight;
        slope += along.slope * weight * along.change;
        if (path.all_.hollow && near.object == path.all_.head)
            path.headField_ = along.value;
        else if (!near.digs && along.value > strongest)
            strongest = along.value;
    }

    // What that makes of the body's field.
    Sample sample()
    {
        Sample all{sum - ISOVALUE, slope, strongest - path.ownField_};
        path.shared_ = false;
        if (!path.complete_)
            COMMON ? path.blend(position, all) : path.blendOdd(position, all);
        if (!COMMON && path.all_.hollow)
            all = {-all.excess, -all.slope, strongest - path.headField_};
        return all;
    }
};

template <bool COMMON>
inline bool Path::beginAs(const Few& few, const Seed& s, Real position, Sample* sample)
{
    root_ = object_.root(s.root);
    path_ = s.path;
    complete_ = few.complete;
    touched_ = few.count;
    Sum<COMMON> sum(*this, position);
    Along* along = along_;
    for (int i = 0; i < few.count; ++i, ++along) {
        aim(few.number[i], s, *along);
        sum.add(*along);
    }
    ++counts_.iterations;
    *sample = sum.sample();
    return sum.touched;
}

template <bool COMMON>
inline Sample Path::lookAs(Real position)
{
    ++counts_.iterations;
    Sum<COMMON> sum(*this, position);
    for (Along *along = along_, *const end = along_ + touched_; along < end; ++along)
        sum.add(*along);
    return sum.sample();
}

bool Path::beginOdd(const Few& few, const Seed& s, Real position, Sample* sample)
{
    return beginAs<false>(few, s, position, sample);
}

Sample Path::lookOdd(Real position)
{
    return lookAs<false>(position);
}

bool Path::begin(const Few& few, const Seed& s, Real position, Sample* sample)
{
    return common_ ? beginAs<true>(few, s, position, sample) : beginOdd(few, s, position, sample);
}

Sample Path::look(Real position)
{
    return common_ ? lookAs<true>(position) : lookOdd(position);
}

void Path::beginSearch(const Seed& s)
{
    root_ = object_.root(s.root);
    path_ = s.path;
    const Few& listed = nearby_.listed();
    const Real middle = shiftDown(first_ + last_, 1);
    Few few;
    few.count = 0;
    for (int i = 0; i < listed.count; ++i) {
        const int number = listed.number[i];
        Along& along = along_[few.count];
        aim(number, s, along);
        if (along.param(middle) < reachT_[number])
            few.number[few.count++] = static_cast<uint8_t>(number);
    }
    few.complete = true;
    if (!listed.complete)
        nearby_.setComplete(few);
    complete_ = few.complete;
    touched_ = few.count;
}

// The own t at a position of the path of a warped object; sets ownChange_.
Real Path::warpedParam(Real position)
{
    const Real inward = Real(CORE_SIZE) / object_.laidSize();
    const Vector step = path_ * inward;
    Vector out;
    const Real t = object_.param(root_ * inward + step * position, &out);
    ownChange_ = t < Real(1) ? shiftDown(dot(out, step), 7) : Real(0);
    return t;
}

// ---- What is asked after a look

// Each field pushes away from its core by its slope over its squared size.
Vector Path::outward(Real position) const
{
    Real own = -(shared_ ? ownSlope_ * share_[0] : ownSlope_);
    if (!shared_ && all_.hollow)
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
    return object_.slants() ? g + ownGradient(position, own) : g;
}

Vector Path::ownGradient(Real position, Real share) const
{
    return object_.slopeAt(root_ + path_ * position) * shiftDown(share * object_.laidSize(), 4);
}

Real Path::pushes() const
{
    // The gradient of a field is 2 f' r / R^2, and r / R no more than r^2 / R^2 + 1/4; a little more for what that changes.
    Real sum(0);
    for (int i = 0; i < touched_; ++i)
        sum += (Real(0.1) - along_[i].slope * (along_[i].t + Real(0.25))) * along_[i].near->push16;
    return shiftDown(sum, 3);
}

Real Path::pushMost() const
{
    Real sum(0);
    for (int i = 0; i < touched_; ++i)
        sum += along_[i].near->push16 * along_[i].near->strength;
    return shiftDown(sum * STEEPEST_OF_ALL, complete_ ? 4 : 3);
}

Real Path::steepest() const
{
    Real own = shiftDown(object_.strength() * (all_.hollow ? most(all_.weight, Real(1)) : Real(1)), 1) * STEEPEST_OF_ALL;
    if (warped_)
        own = own * (object_.longestPath() / (object_.laidRadius() * object_.narrowing()));
    return own + pushMost() * object_.longestPath();
}
