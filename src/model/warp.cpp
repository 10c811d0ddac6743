// Warp: space that is tapered, twisted and bent. Knows no objects.
#include "model/warp.h"

#include "model/round.h"

namespace {

constexpr Real RADIAN(57.2957795);  // degrees
constexpr Real TURN_PER_RADIAN(0.15915494);

// The middle of a bend's circle is at least this many times farther from the axis than the surface.
constexpr Real CLEAR(1.2);

// Lower limit of the factor by which a bend shortens lengths along the axis.
constexpr Real LEAST_SQUEEZE(0.0625);

// A bend is left out if its half angle is below LEAST_END (radians), or the radius of its circle is above LARGEST.
constexpr Real LEAST_END(0.005);
constexpr Real LARGEST(8000);

Angle fromRadians(Real a)
{
    return turns(a * TURN_PER_RADIAN);
}

// atan(x) / x from s = x^2, 0..1, with an error of at most 1/8000 (Abramowitz and Stegun, 4.4.49).
Real arcOverTangent(Real square)
{
    const Real& s = square;
    return Real(0.999866) + s * (Real(-0.3302995) + s * (Real(0.180141) + s * (Real(-0.085133) + s * Real(0.0208351))));
}

// sin(a) / a and (1 - cos(a)) / a for angles of up to a quarter turn. The series keep their precision for tiny angles.
Real sineOverAngle(Real a)
{
    const Real s = a * a;
    return Real(1) - s * (Real(1.0 / 6) - s * (Real(1.0 / 120) - s * (Real(1.0 / 5040) - s * Real(1.0 / 362880))));
}

Real cosineLackOverAngle(Real a)
{
    const Real s = a * a;
    return a * (Real(0.5) - s * (Real(1.0 / 24) - s * (Real(1.0 / 720) - s * Real(1.0 / 40320))));
}

}  // namespace

void Warp::set(const WarpAmounts& amounts, const Vector& surface, const Vector& field, const Vector& steep)
{
    const Real height = surface.y, wide = ::max(surface.x, surface.z);
    asked_ = amounts_ = amounts;
    height_ = height;
    slope_ = amounts.part[WARP_TAPER] / height;
    twist_ = amounts.part[WARP_TWIST] / RADIAN / shiftUp(height, 1);
    most_ = Real(1) + absolute(amounts.part[WARP_TAPER]);
    // The limit itself is limited to more than the greatest bend, because its degrees could overflow 16.16.
    const Real limit = ::min(shiftUp(height, 1) / (wide * most_ * CLEAR), Real(4)) * RADIAN;
    const Real degrees = ::min(absolute(amounts.part[WARP_BEND]), limit);
    flipped_ = amounts.part[WARP_BEND] < Real(0);
    amounts_.part[WARP_BEND] = flipped_ ? -degrees : degrees;
    end_ = shiftDown(degrees / RADIAN, 1);
    if (end_ < LEAST_END || end_ * LARGEST < height)
        end_ = amounts_.part[WARP_BEND] = Real(0);
    bend_ = end_ / height;
    radius_ = end_ == Real(0) ? Real(0) : height / end_;

    endSine_ = sine(fromRadians(end_));
    endCosine_ = cosine(fromRadians(end_));
    endAcross_ = height * cosineLackOverAngle(end_);
    endUp_ = height * sineOverAngle(end_);
    if (end_ > Real(0))
        most_ = most_ * Real(1.5);
    least_ = leastWithin(::max(field.x, field.z));
    leastSteep_ = leastWithin(::max(steep.x, steep.z));

    // Extents of the warped field: tapering and twisting widen it; the ends of a bent object come towards the middle of the
    // circle.
    field_ = field;
    if (slope_ != Real(0) || twist_ != Real(0))
        field_.x = field_.z = (field.x + field.z) * (Real(1) + absolute(amounts.part[WARP_TAPER]));
    inward_ = field_.x + endAcross_ + (field.y - height) * endSine_;
    field_.y += field_.x * endSine_;
}

// The least factor by which the warp multiplies a distance within `wide` units of the axis.
Real Warp::leastWithin(Real wide) const
{
    // A distance along the axis may become a slanting one, and a step across the axis a longer one.
    const Real narrow = Real(1) - absolute(amounts_.part[WARP_TAPER]);
    Real spread = Real(1) / narrow + wide * absolute(slope_) / narrow + wide * absolute(twist_);
    // The bend presses together what lies towards the middle of the circle.
    if (end_ > Real(0))
        spread = spread / (Real(1) - ::min(wide * bend_, Real(0.75)));
    return Real(1) / ::min(spread, Real(200));
}

// Computes taper and twist at a height.
void Warp::turnAt(Real y, Way& way) const
{
    way.y = y;
    way.width = Real(1) + slope_ * clamp(y, -height_, height_);
    way.turnSine = Real(0);
    way.turnCosine = Real(1);
    if (twist_ != Real(0)) {
        const Angle angle = fromRadians(twist_ * y);
        way.turnSine = sine(angle);
        way.turnCosine = cosine(angle);
    }
}

Vector Warp::out(const Vector& place, Way& way) const
{
    if (way.y != place.y) {
        turnAt(place.y, way);
        way.sine = Real(0);
        way.cosine = Real(1);
        if (end_ != Real(0)) {
            const Real on = clamp(place.y, -height_, height_), turn = on / radius_;
            const Angle angle = fromRadians(turn);
            way.sine = sine(angle);
            way.cosine = cosine(angle);
            way.beyond = place.y - on;
            way.middle[0] = on * cosineLackOverAngle(turn);
            way.middle[1] = on * sineOverAngle(turn);
        }
    }
    way.plain = place;
    way.squeeze = Real(1);
    const Vector wide{place.x * way.width, place.y, place.z * way.width};
    Vector& v = way.twisted;
    v = {wide.x * way.turnCosine + wide.z * way.turnSine, wide.y, wide.z * way.turnCosine - wide.x * way.turnSine};
    if (end_ == Real(0))
        return v;
    const Real x = flipped_ ? -v.x : v.x;
    if (within(place.y))
        way.squeeze = ::max(Real(1) - x * bend_, LEAST_SQUEEZE);
    const Real across = way.middle[0] + x * way.cosine + way.beyond * way.sine;
    return {flipped_ ? -across : across, way.middle[1] + way.beyond * way.cosine - x * way.sine, v.z};
}

// Undoes the bend. On entry `across` and `up` are coordinates in bent space: towards the middle of the circle, and along the
// circle's tangent at the centre. On return they are the coordinates before the bend.
void Warp::unbend(Real& across, Real& up, Way& way) const
{
    const Real inward = radius_ - across;
    const bool below = up < Real(0);
    const Real height = absolute(up);
    if (inward > Real(0) && height * endCosine_ <= inward * endSine_) {
        const Real away = lengthQuick({inward, up, Real(0)});
        way.sine = quotient(up, away);
        way.cosine = quotient(inward, away);
        if (height <= inward) {
            // Radius times the tangent, computed without rounding the tangent first.
            up = up * (radius_ / inward);
            const Real tangent = up * bend_;
            up = up * arcOverTangent(tangent * tangent);
        } else {
            const Real tangent = quotient(inward, height), on = (HALF_PI - tangent * arcOverTangent(tangent * tangent)) * radius_;
            up = below ? -on : on;
        }
        across = radius_ - away;
        way.squeeze = ::max(Real(1) - across * bend_, LEAST_SQUEEZE);
        return;
    }
    // Beyond the end of the arc the axis runs along its tangent.
    way.sine = below ? -endSine_ : endSine_;
    way.cosine = endCosine_;
    const Real fromX = across - endAcross_, fromY = below ? up + endUp_ : up - endUp_;
    across = fromX * way.cosine - fromY * way.sine;
    up = (below ? -height_ : height_) + fromX * way.sine + fromY * way.cosine;
}

void Warp::back(const Vector& place, Way& way) const
{
    Vector v = place;
    way.sine = Real(0);
    way.cosine = way.squeeze = Real(1);
    if (end_ != Real(0)) {
        Real across = flipped_ ? -v.x : v.x;
        unbend(across, v.y, way);
        v.x = flipped_ ? -across : across;
    }
    way.twisted = way.plain = v;
    if (slope_ == Real(0) && twist_ == Real(0)) {
        way.y = v.y;
        way.width = way.turnCosine = Real(1);
        way.turnSine = Real(0);
        return;
    }
    turnAt(v.y, way);
    v = {v.x * way.turnCosine - v.z * way.turnSine, v.y, v.z * way.turnCosine + v.x * way.turnSine};
    way.plain = slope_ == Real(0) ? v : Vector{v.x / way.width, v.y, v.z / way.width};
}

Vector Warp::stepOut(const Way& way, const Vector& step) const
{
    const Real y = way.plain.y, widening = within(y) ? slope_ * step.y : Real(0);
    const Real x = step.x * way.width + way.plain.x * widening, z = step.z * way.width + way.plain.z * widening;
    const Real turn = twist_ * step.y;
    const Vector v{x * way.turnCosine + z * way.turnSine + way.twisted.z * turn, step.y,
                   z * way.turnCosine - x * way.turnSine - way.twisted.x * turn};
    if (end_ == Real(0))
        return v;
    const Real across = flipped_ ? -v.x : v.x, along = v.y * way.squeeze, out = across * way.cosine + along * way.sine;
    return {flipped_ ? -out : out, along * way.cosine - across * way.sine, v.z};
}

Vector Warp::slopeOut(const Way& way, const Vector& slope) const
{
    Vector g = slope;
    const Vector& plain = way.plain;
    const Real y = plain.y, s = way.turnSine, c = way.turnCosine;
    if (slope_ != Real(0)) {
        const Real inverse = Real(1) / way.width;
        const Real along = within(y) ? (g.x * plain.x + g.z * plain.z) * slope_ * inverse : Real(0);
        g = {g.x * inverse, g.y - along, g.z * inverse};
    }
    if (twist_ != Real(0)) {
        // The change of the twist's angle with the height contributes to the gradient along the axis.
        const Real x = plain.x * way.width, z = plain.z * way.width;
        g = {g.x * c + g.z * s, g.y + twist_ * (g.z * x - g.x * z), g.z * c - g.x * s};
    }
    if (end_ == Real(0))
        return g;
    const Real across = flipped_ ? -g.x : g.x, along = quotient(g.y, way.squeeze);
    const Real x = across * way.cosine + along * way.sine;
    return {flipped_ ? -x : x, along * way.cosine - across * way.sine, g.z};
}
