// Where another object of the body takes over from a seed's own: found to first order, from the gradients of the two fields. Also
// the colour to which the objects' colours mix there.
#include "border.h"

#include "model/paint.h"

namespace {

// Two fields count as the same where the own one exceeds the neighbour's by less than TIE times the latter, and their gradients
// differ by less than ALIKE times the own gradient.
constexpr Real TIE(0.004), ALIKE(0.2);

// The neighbour with the strongest field at the position evaluated last.
const Neighbour* strongestOf(const Path& path)
{
    const Neighbour* other = &path.near(0);
    for (int i = 1; i < path.touched(); ++i)
        if (path.near(i).value > other->value)
            other = &path.near(i);
    return other;
}

// The gradient of a neighbour's field at a position, times half the squared size of the object, over 2^shift. Beyond the end of the
// field the vector from the core may be too long for 16.16.
inline Vector gradientOf(const Path& path, const Neighbour& near, Real position, int shift)
{
    if (near.slope == Real(0))
        return {Real(0), Real(0), Real(0)};
    return path.fromCore(near, position) * (shiftDown(near.slope, shift) * near.ratio);
}

// As strongestOf(), where something digs, strengths differ or the object is shaped: the strongest neighbour that does not dig, or
// null. Sets `*change`, the slope of the own field along the path, and `*g`, its gradient, if the object is shaped; in a hollow
// both become those of the object that has the hollow, because it is that object's border.
SELDOM const Neighbour* strongestOdd(const Path& path, const Seed& s, int shift, Vector* g, Real* change)
{
    *change = path.ownRate(path.lookedAt());
    if (path.object().shaped())
        *g = path.ownGradient(s.position, shiftDown(path.ownSlope(), shift));
    const Neighbour* other = nullptr;
    for (int i = 0; i < path.touched(); ++i) {
        const Neighbour& near = path.near(i);
        if (path.all().hollow && near.object == path.all().head) {
            *g = gradientOf(path, near, s.position, shift);
            *change = near.slope * near.change;
        } else if (!near.digs && (other == nullptr || near.value > other->value)) {
            other = &near;
        }
    }
    return other;
}

}  // namespace

bool findBorder(const Path& path, Seed& s, Real dominance)
{
    // Gradients here are multiplied by half the squared size of the object, over 2^shift.
    const int shift = path.gradientShift();
    Vector g = path.from(s.position) * shiftDown(path.ownSlope(), shift);
    Real change = shiftDown(path.ownSlope() * path.lookedAt(), 1);
    const Neighbour* const other = path.all().ordinary ? strongestOf(path) : strongestOdd(path, s, shift, &g, &change);
    if (other == nullptr)
        return true;
    // The fields were evaluated before the last step of Newton's method.
    dominance += (other->slope * other->change - change) * (s.position - path.lookedAt());
    const Vector own = g;
    g = g - gradientOf(path, *other, s.position, shift);
    const Normal n = normalise(g);
    const Real steep = dot(g, {realFromRaw(n.x * 4), realFromRaw(n.y * 4), realFromRaw(n.z * 4)});
    const Real size = path.object().laidSize();
    if (other->object->slot() < path.all().head->slot() && dominance > -other->value * TIE && steep < nearLength(own) * ALIKE)
        return false;
    const Real distance = shiftDown(clamp(-dominance * size, Real(-100), Real(100)) * size * Real(0.5), shift);
    const Real apart = clamp(absolute(distance) < steep * BORDER_FAR ? distance / steep : BORDER_FAR, -BORDER_FAR, BORDER_FAR);
    s.apart = static_cast<int16_t>(rawFromReal(apart) >> 8);
    s.border = directionOf(n);
    return true;
}

bool findNearer(const Path& path, Seed& s, Real dominance)
{
    const Seed before = s;
    const bool own = findBorder(path, s, dominance);
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
