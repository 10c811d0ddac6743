// Moves the eye around the scene.
#include "app/orbit.h"

namespace {

// The steepest view from above or below, degrees; the factor and the most steps by which the eye is drawn back into the
// space where it may be; the range of distances, 1.0 = the scene's own.
constexpr Real OVER_MOST(85);
constexpr Real SHORTER(0.9);
constexpr int SHORTER_MOST = 100;
constexpr Real DISTANCE_LEAST(0.125), DISTANCE_MOST(4);

// Returns the mean of the centres of all objects. Each is divided first, so that the sum does not overflow.
Point middleOf(const Model& model)
{
    const Real share = Real(1) / Real(model.count());
    Vector sum{Real(0), Real(0), Real(0)};
    for (int i = 0; i < model.count(); ++i)
        sum = sum + toVector(model.actor(i).object->centre()) * share;
    return toPoint(sum);
}

}  // namespace

void Orbit::turn(Real round, Real over)
{
    round_ += round;
    if (round_ > Real(180))
        round_ -= Real(360);
    if (round_ < Real(-180))
        round_ += Real(360);
    over_ = clamp(over_ + over, -OVER_MOST, OVER_MOST);
}

void Orbit::approach(Real factor)
{
    distance_ = clamp(distance_ * factor, DISTANCE_LEAST, DISTANCE_MOST);
}

Camera Orbit::from(const Camera& camera, const Model& model)
{
    const Real none(0);
    if (round_ == none && over_ == none && distance_ == Real(1)) {
        away_ = false;
        return camera;
    }
    if (!away_)
        middle_ = middleOf(model);
    away_ = true;
    const Point pivot = camera.looks == Camera::AHEAD ? middle_ : camera.target;
    // First turn over the scene, about the axis to the viewer's right; then turn around it, about the upright axis. Going to
    // the right turns the eye and the view axes counterclockwise as seen from above.
    const Vector upright{none, Real(1), none};
    const Matrix matrix = Matrix::rotation(upright, fromDegrees(-round_)) * Matrix::rotation(camera.axes.right, fromDegrees(over_));
    Camera moved = camera;
    // Shorten the distance on the same line until the eye is inside the space where it may be.
    Vector arm = matrix * ((camera.eye - pivot) * distance_);
    for (int i = 0; i < SHORTER_MOST && !isInSpace(pivot + arm); ++i)
        arm = arm * SHORTER;
    moved.eye = pivot + arm;
    moved.axes = turnedBy(matrix, camera.axes);
    return moved;
}
