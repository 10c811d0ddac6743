// Where another object of the body takes over from a seed's own: found to first order, from the gradients of the two fields. Also
// the colour to which the objects' colours mix there.
#include "border.h"

#include "model/paint.h"

namespace {

// Two gradients count as the same if they differ by less than ALIKE times the own one.
constexpr Real ALIKE(0.2);

// The gradient of a neighbour's field at the end of the vector `from` the path's root, times half the squared size of the object,
// over 2^shift. Beyond the end of the field the vector from the core may be too long for 16.16.
inline __attribute__((always_inline)) Vector gradientOf(const Path& path, const Neighbour& near, const Vector& from, int shift)
{
    if (near.slope == Real(0))
        return {Real(0), Real(0), Real(0)};
    return path.fromCore(near, from) * (shiftDown(near.slope, shift) * near.ratio);
}

// The gradient of the own field at a seed, times half the squared size of the object, over 2^shift.
inline Vector ownGradientOf(const Path& path, const Seed& s, const Vector& from, int shift)
{
    const Real slope = shiftDown(path.ownSlope(), shift);
    return path.object().slants() ? path.ownGradient(s.position, slope) : from * slope;
}

// As Path::strongest(), where something digs, strengths differ or the object is shaped: the strongest neighbour that does not dig,
// or null. In a hollow `*g`, the own gradient, `*change`, the slope of the own field along the path, and `*slot` become those of
// the object that has the hollow, because it is that object's border.
SELDOM const Neighbour* strongestOdd(const Path& path, const Vector& from, int shift, Vector* g, Real* change, int* slot)
{
    const Neighbour* const host = path.host();
    if (host != nullptr) {
        *g = gradientOf(path, *host, from, shift);
        *change = host->slope * host->change;
        *slot = host->slot;
    }
    return path.strongest(host);
}

// The direction of a gradient, and its length.
struct Steepest {
    Normal way;
    Real length;

    explicit Steepest(const Vector& g)
        : way(normalise(g)), length(dot(g, unitVector(way)))
    {
    }
};

// Sets the border of a seed where one field is `ahead` of another. The gradient of their difference is given in the units of
// gradientOf().
inline __attribute__((always_inline)) void setBorder(const Path& path, Seed& s, Real ahead, const Steepest& steepest, int shift)
{
    const Real size = path.object().laidSize();
    const Real distance = shiftDown(clamp(ahead * size, Real(-100), Real(100)) * size, shift + 1);
    const bool isNear = absolute(distance) < min(steepest.length, Real(1000)) * BORDER_FAR;
    const Real apart = isNear ? quotient(distance, steepest.length) : BORDER_FAR;
    s.apart = static_cast<int16_t>(rawFromReal(apart) >> 8);
    s.border = directionOf(steepest.way);
}

}  // namespace

bool findBorder(const Path& path, Seed& s, Real fieldLead)
{
    // Gradients here are multiplied by half the squared size of the object, over 2^shift.
    const int shift = path.gradientShift();
    const Vector from = path.from(s.position);
    Vector g = ownGradientOf(path, s, from, shift);
    Real change = path.ownRate(path.lookedAt());
    int slot = path.object().slot();
    const Neighbour* const other =
        path.all().ordinary ? path.strongest() : strongestOdd(path, from, shift, &g, &change, &slot);
    if (other == nullptr)
        return true;
    // The fields were evaluated before the last step of Newton's method.
    fieldLead += (other->slope * other->change - change) * (s.position - path.lookedAt());
    const Vector own = g;
    g = g - gradientOf(path, *other, from, shift);
    const Steepest steepest(g);
    if (other->slot < slot && fieldLead > -other->value * TIE &&
        steepest.length < nearLength(own) * ALIKE)
        return false;
    setBorder(path, s, -fieldLead, steepest, shift);
    return true;
}

void findGuestBorder(const Path& path, Seed& s, const Neighbour& host)
{
    const int shift = path.gradientShift();
    const Vector from = path.from(s.position);
    const Neighbour* const third = path.strongest(&host);
    const bool own = third == nullptr || third->value < path.ownField();
    const Vector g = own ? ownGradientOf(path, s, from, shift) : gradientOf(path, *third, from, shift);
    const Real change = own ? path.ownRate(path.lookedAt()) : third->slope * third->change;
    const Real field = own ? path.ownField() : third->value;
    const Real ahead = host.value - field + (host.slope * host.change - change) * (s.position - path.lookedAt());
    setBorder(path, s, ahead, Steepest(gradientOf(path, host, from, shift) - g), shift);
}

bool findNearer(const Path& path, Seed& s, Real fieldLead)
{
    const Seed before = s;
    const bool own = findBorder(path, s, fieldLead);
    if (own && before.apart < s.apart)
        s = before;
    return own;
}

void mix(const Path& path, Seed& s)
{
    const Paint& own = *path.all().head->paint();
    // Objects that dig do not lend their colours.
    Real fields = path.all().hollow ? Real(0) : path.ownField();
    Vector sum = own.at * fields;
    for (int i = 0; i < path.touched(); ++i) {
        const Neighbour& near = path.near(i);
        if (near.digs)
            continue;
        sum = sum + near.object->paint()->at * near.value;
        fields += near.value;
    }
    s.mix = fields > Real(0) ? own.paints->numberAt(sum * quotient(Real(1), fields), own.shines()) : own.number;
}
