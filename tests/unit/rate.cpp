// Tests of the frame rate controller, with a simulated clock that depends on the number of seeds.
#include "app/rate.h"

#include "app/options.h"
#include "help.h"
#include "machine.h"
#include "test.h"

namespace {

// A simulated machine, on which each seed of the model takes a share of a second per frame, and the frame itself another share.
struct Run {
    Model model;
    Rate rate;
    double seedsASecond, frame;
    int changes = 0, atOnce = 0;
    double largestStep = 1;

    Run(double seedsASecond, double frame = 0) : seedsASecond(seedsASecond), frame(frame) {}

    void add(double size, double x, double z)
    {
        SoftObject* const ball = make<Sphere>(model.count() + 1, real(size));
        ball->moveTo(point(x, 0, z));
        CHECK(model.add(ball, {255, 255, 255}, Motion()));
    }
    double seconds() const { return frame + model.seeds() / seedsASecond; }
    void play(int frames)
    {
        for (int i = 0; i < frames; ++i) {
            rate.add(static_cast<uint64_t>(seconds() * machine::CLOCK_HZ), model);
            Real spacing;
            int now = 0;
            for (int at; (at = rate.next(model, model.camera, &spacing)) >= 0; ++now) {
                SoftObject& object = *model.actor(at).object;
                const double by = number(spacing) / number(object.spacing());
                largestStep = std::fmax(largestStep, std::fmax(by, 1 / by));
                CHECK(object.resample(spacing, makeEngine));
            }
            changes += now;
            atOnce = std::max(atOnce, now);
        }
    }
    double spacing(int i) const { return number(model.actor(i).object->spacing()); }
};

void fourBalls(Run& run)
{
    run.add(20, -30, 0);
    run.add(25, -10, 0);
    run.add(30, 10, 0);
    run.add(35, 30, 0);
    CHECK(run.model.resample(Real(2), makeEngine));
}

}  // namespace

TEST(a_rate_is_held)
{
    // Machines from four times too slow to ten times too fast.
    for (double times : {0.25, 0.5, 0.9, 1.5, 4.0, 10.0}) {
        for (int frames : {5, 10, 30}) {
            Run run(2500 * frames * times, 0.1 / frames);
            fourBalls(run);
            run.rate.hold(frames);
            run.play(150);
            const double reached = 1 / run.seconds();
            note("%d wanted, %g times the machine: %.1f a second, spacings %.2f to %.2f after %d changes", frames, times, reached,
                 number(run.model.finest()), number(run.model.coarsest()), run.changes);
            CHECK(reached > 0.95 * frames && reached < 1.3 * frames);
            // One object changes at a time (or two while a frame takes four times too long), by less than a third. Then nothing
            // changes.
            CHECK(run.atOnce == 1 || (times < 0.5 && run.atOnce == 2));
            CHECK(run.largestStep < 1.35);
            run.changes = 0;
            run.play(300);
            SAME(run.changes, 0);
        }
    }
}

TEST(a_rate_is_held_by_what_shows_least)
{
    // Near and far, thick and thin objects: on a slow machine the seeds are kept where they are most visible.
    Run run(3000);
    run.add(30, -20, -60);
    run.add(30, 20, 100);
    run.add(8, 0, -40);
    CHECK(run.model.resample(Real(2), makeEngine));
    run.rate.hold(5);
    run.play(200);
    CHECK(run.spacing(0) < run.spacing(1));
    CHECK(run.spacing(2) < run.spacing(0));
    // When near and far objects change places, the spacings follow.
    run.model.actor(1).object->moveTo(point(20, 0, -60));
    run.model.actor(0).object->moveTo(point(-20, 0, 100));
    run.play(200);
    CHECK(run.spacing(1) < run.spacing(0));
    // Seen from behind, what was far is near.
    run.model.camera.eye = point(0, 0, 120);
    run.model.camera.axes = viewAlong(vector(0, 0, -1), vector(0, 1, 0), vector(-1, 0, 0));
    run.play(200);
    CHECK(run.spacing(0) < run.spacing(1));
}

TEST(a_rate_has_its_limits)
{
    // Spacings get no finer than a pixel, however fast the machine, and no coarser than the objects allow.
    Run fast(1e9);
    fourBalls(fast);
    fast.rate.hold(10);
    fast.play(400);
    CHECK(number(fast.model.finest()) >= 0.25 && number(fast.model.finest()) < 1);
    Run slow(10);
    fourBalls(slow);
    slow.rate.hold(10);
    slow.play(400);
    CHECK(number(slow.model.coarsest()) > 6 && slow.model.coarsest() <= SPACING_MOST);
    // Without memory nothing gets finer.
    Run poor(1e6);
    fourBalls(poor);
    poor.rate.hold(10);
    poor.rate.refused();
    poor.play(50);
    SAME(poor.changes, 0);
    // No rate is held unless one is set.
    Run none(100);
    fourBalls(none);
    Real spacing;
    SAME(none.rate.frames(), 0);
    SAME(none.rate.next(none.model, none.model.camera, &spacing), -1);
}

TEST(a_rate_is_held_by_many)
{
    // Of forty small balls on a slow machine several change at once, but never more than a third.
    Run run(5000);
    for (int i = 0; i < 40; ++i)
        run.add(10, -40 + 2 * i, i);
    CHECK(run.model.resample(Real(2), makeEngine));
    run.rate.hold(4);
    run.play(200);
    CHECK(1 / run.seconds() > 3.8 && 1 / run.seconds() < 5);
    CHECK(run.atOnce <= 40 / 3);
}
