// Moves the eye around the scene.
#include "app/orbit.h"

namespace {

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

bool within(const Point& p)
{
    const Real edge(SPACE);
    return absolute(p.x) <= edge && absolute(p.y) <= edge && absolute(p.z) <= edge;
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
    const Point about = camera.looks == Camera::AHEAD ? middle_ : camera.target;
    // First turn over the scene, about the axis to the viewer's right; then turn around it, about the upright axis. Going to
    // the right turns the eye and the view axes counterclockwise as seen from above.
    const Vector upright{none, Real(1), none};
    const Matrix by = Matrix::rotation(upright, fromDegrees(-round_)) * Matrix::rotation(camera.axes.right, fromDegrees(over_));
    Camera moved = camera;
    // Shorten the distance on the same line until the eye is inside the space where it may be.
    Vector arm = by * ((camera.eye - about) * distance_);
    for (int i = 0; i < SHORTER_MOST && !within(about + arm); ++i)
        arm = arm * SHORTER;
    moved.eye = about + arm;
    moved.axes = turnedBy(by, camera.axes);
    return moved;
}
