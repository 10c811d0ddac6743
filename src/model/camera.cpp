// The axes of a view (camera.h).
#include "model/camera.h"

namespace {

ViewAxes withTurned(const Vector& right, const Vector& up, const Vector& ahead)
{
    ViewAxes axes;
    axes.turned = !(axes == ViewAxes{right, up, ahead, true});
    if (axes.turned) {
        axes.right = right;
        axes.up = up;
        axes.ahead = ahead;
    }
    return axes;
}

}  // namespace

ViewAxes viewAlong(const Vector& ahead, const Vector& up, const Vector& right)
{
    // Limits of the sine of the angle between the view and the upward direction. Below `upright` the product does not tell
    // which side is to the right; below `steep` it does, but with few digits, so it is made a unit vector and perpendicular
    // again.
    const Real upright(0.01), steep(0.1);
    const Vector forward = unit(ahead);
    if (forward == Vector{Real(0), Real(0), Real(0)})
        return ViewAxes();
    Vector aside = cross(unit(up), forward);
    const Real sine = length(aside);
    if (sine < steep) {
        aside = sine < upright ? right : unit(aside);
        aside = aside - forward * dot(aside, forward);
    }
    aside = unit(aside);
    return withTurned(aside, cross(forward, aside), forward);
}

ViewAxes leaned(const ViewAxes& axes, Angle angle)
{
    const Real c = cosine(angle), s = sine(angle);
    return withTurned(axes.right * c - axes.up * s, axes.up * c + axes.right * s, axes.ahead);
}

ViewAxes turnedBy(const Matrix& by, const ViewAxes& axes)
{
    return viewAlong(by * axes.ahead, by * axes.up, by * axes.right);
}
