// The axes of a view.
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
    // Nearer than this (a sine) to the upward direction, which side is to the right cannot be told from it; nearer than the other
    // it can, but the product has few digits left.
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
