// Tests of moving the eye around a scene: its position, and the point that it sees in the middle of the picture.
#include "app/orbit.h"
#include "help.h"
#include "test.h"

namespace {

// Four objects around a centre that is not the origin.
void fill(Model& model)
{
    const Vector places[] = {vector(30, 10, 0), vector(-10, 10, 0), vector(10, 30, 20), vector(10, -10, -20)};
    for (const Vector& place : places) {
        Actor actor;
        std::snprintf(actor.name, sizeof actor.name, "s%d", model.count() + 1);
        actor.kind = kindNamed("sphere");
        actor.measure[0] = Real(20);
        actor.motion.centre = toPoint(place);
        CHECK(model.addItem(actor) != nullptr);
    }
    Anim::move(model, 0);
}

// The point in the middle of the picture at this distance from the eye.
Vec seen(const Camera& camera, double distance) { return vec(camera.eye) + vec(camera.axes.ahead) * distance; }

}  // namespace

TEST(about_a_scene)
{
    Model model;
    fill(model);
    model.camera.eye = point(10, 10, -110);
    const Vec middle{10, 10, 0};
    Orbit orbit;
    Camera camera = orbit.from(model.camera, model);
    CHECK(camera.eye == model.camera.eye && !camera.axes.turned);
    // After a quarter turn to the right the scene is seen from its right side.
    for (int i = 0; i < 18; ++i)
        orbit.turn(Real(5), Real(0));
    camera = orbit.from(model.camera, model);
    CHECK(size(vec(camera.eye) - Vec{120, 10, 0}) < 0.1);
    CHECK(size(seen(camera, 110) - middle) < 0.1);
    NEAR(number(camera.axes.up.y), 1, 1e-3);
    // The centre does not follow the objects while the eye is away from its place.
    model.actor(0).object->translate(vector(0, 40, 0));
    const Camera later = orbit.from(model.camera, model);
    CHECK(later.eye == camera.eye && later.axes == camera.axes);
    // The eye goes up as far as it can, and nearer.
    for (int i = 0; i < 40; ++i)
        orbit.turn(Real(0), Real(5));
    orbit.approach(Real(0.5));
    camera = orbit.from(model.camera, model);
    NEAR(size(vec(camera.eye) - middle), 55, 0.1);
    CHECK(size(seen(camera, 55) - middle) < 0.1);
    CHECK(camera.eye.y > Real(60) && camera.axes.up.y > Real(0.05));
    // The eye returns to its place.
    orbit.reset();
    camera = orbit.from(model.camera, model);
    CHECK(camera.eye == model.camera.eye && !camera.axes.turned);
    // A full circle ends where it began.
    for (int i = 0; i < 72; ++i)
        orbit.turn(Real(-5), Real(0));
    camera = orbit.from(model.camera, model);
    CHECK(camera.eye == model.camera.eye && !camera.axes.turned);
}

TEST(about_what_the_eye_looks_at)
{
    Model model;
    fill(model);
    model.camera.looks = Camera::AT_POINT;
    model.camera.target = point(40, 0, 30);
    model.camera.eye = point(-20, 50, -60);
    Anim::move(model, 0);
    const Vec target = vec(model.camera.target);
    const double away = size(vec(model.camera.eye) - target);
    Random random;
    for (int i = 0; i < 500; ++i) {
        Orbit orbit;
        orbit.turn(real(random.between(-180, 180)), real(random.between(-85, 85)));
        const double factor = random.between(0.2, 4);
        orbit.approach(real(factor));
        const Camera camera = orbit.from(model.camera, model);
        const double distance = size(vec(camera.eye) - target);
        CHECK(distance < away * factor + 0.1);
        CHECK(size(seen(camera, distance) - target) < 0.3);
        CHECK(absolute(camera.eye.x) <= Real(SPACE) && absolute(camera.eye.y) <= Real(SPACE) &&
              absolute(camera.eye.z) <= Real(SPACE));
        // Only the edge of the space may keep the eye nearer than requested.
        const double most =
            std::fmax(std::fabs(number(camera.eye.x)), std::fmax(std::fabs(number(camera.eye.y)), std::fabs(number(camera.eye.z))));
        CHECK(distance > away * factor - 0.5 || most > 200);
    }
}
