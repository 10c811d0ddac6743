// Tests of occlusion: seeds hidden by nearer objects are neither settled nor drawn, and reappear when those objects go away.
#include <cstdlib>
#include <cstring>

#include "help.h"
#include "picture/view.h"
#include "test.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

int32_t steps(double units) { return static_cast<int32_t>(std::lround(units * 256)); }

// Makes a frame like the demo: the objects are updated and drawn in order, the nearest first.
void play(Scene& scene, View& view, bool hides)
{
    scene.findBodies();
    scene.bodies->spreadRecalc();
    scene.counts = Counts{};
    scene.hider = nullptr;
    view.begin();
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        scene.objects[i]->update(scene.frame());
        scene.show(i, {&view});
        scene.hider = hides ? &view : nullptr;
    }
    view.end();
}

// Two balls that blend, behind a larger one which hides both of them or none.
struct Behind {
    Scene scene;
    View view;

    explicit Behind(double aside)
    {
        scene.ball(60, aside, 0, -10);
        scene.ball(20, -6, 0, 40);
        scene.ball(20, 6, 0, 40);
        scene.link(1, 2);
        if (!view.open())
            std::abort();
    }
};

long drawnPixels(const View& view)
{
    return std::count_if(view.zbuffer(), view.zbuffer() + WIDTH * HEIGHT, [](uint16_t z) { return z != Z_EMPTY; });
}

}  // namespace

TEST(a_ball_is_hidden_when_all_before_it_is_nearer)
{
    View view;
    CHECK(view.open());
    // A wall of 80 by 60 units at a distance of 100.
    Voxel wall{};
    wall.z = steps(100);
    wall.halfWidth = static_cast<int16_t>(steps(40));
    wall.halfHeight = static_cast<int16_t>(steps(30));
    wall.brightness = 40;
    const Camera& camera = view.camera();
    Random random;
    long hidden = 0, seen = 0, outside = 0;
    for (int k = 0; k < 20000; ++k) {
        view.begin();
        CHECK(show(view, wall) == 1);
        const double z = random.between(78, 300), radius = random.between(0.5, 12);
        const double x = random.between(-90, 90) * z / 100, y = random.between(-70, 70) * z / 100;
        const int32_t place[] = {steps(x), steps(y), steps(z)};
        const bool isHidden = view.hides(place, steps(radius));
        // By how many pixels the square around the ball's projection lies within the wall; negative if it extends beyond the wall's
        // edge.
        const double within = std::min((40 / 100.0 - (std::fabs(x) + radius) / z) * number(camera.focalX),
                                       (30 / 100.0 - (std::fabs(y) + radius) / z) * number(camera.focalY));
        // By how many pixels the ball lies beside the screen.
        const double beside = std::max((std::fabs(x) - radius) / z * number(camera.focalX) - WIDTH / 2,
                                       (std::fabs(y) - radius) / z * number(camera.focalY) - HEIGHT / 2);
        if (std::fabs(beside) < 1)
            continue;
        outside += beside > 0;
        if (beside > 0)
            CHECK(isHidden || std::fabs(x) > z || std::fabs(y) > z || z - radius < 76);
        else if (z - radius < 99.9 || within < -4)
            CHECK(!isHidden);
        else if (within > 1 && z - radius > 100.1)
            CHECK(isHidden);
        else
            continue;
        ++(isHidden ? hidden : seen);
    }
    CHECK(hidden > 1000 && seen > 1000 && outside > 1000);
}

TEST(what_is_hidden_is_not_settled)
{
    Behind open(0), hidden(0);
    play(open.scene, open.view, false);
    play(hidden.scene, hidden.view, true);
    CHECK(open.scene.counts.updated > 100);
    note("%u seeds looked for, %u where they are hidden", open.scene.counts.updated, hidden.scene.counts.updated);
    CHECK(hidden.scene.counts.updated < open.scene.counts.updated / 3);
    SAME(std::memcmp(open.view.frame(), hidden.view.frame(), WIDTH * HEIGHT), 0);
    SAME(std::memcmp(open.view.zbuffer(), hidden.view.zbuffer(), WIDTH * HEIGHT * sizeof(uint16_t)), 0);
}

TEST(what_was_hidden_comes_back)
{
    // The objects behind do not move and have no neighbour that moves.
    Behind was(0), never(80);
    for (int i = 0; i < 3; ++i)
        play(was.scene, was.view, true);
    was.scene.objects[0]->moveTo(point(80, 0, -10));
    for (int i = 0; i < 3; ++i) {
        play(was.scene, was.view, true);
        play(never.scene, never.view, false);
        const long drawn = drawnPixels(never.view);
        long wrong = 0;
        for (int at = 0; at < WIDTH * HEIGHT; ++at)
            wrong += std::abs(was.view.zbuffer()[at] - never.view.zbuffer()[at]) > 64;
        CHECK(drawn > 1000);
        CHECK(wrong <= drawn / 500);
    }
    // Once all of it is visible, no seed has to be updated any more.
    SAME(was.scene.counts.updated, 0u);
}
