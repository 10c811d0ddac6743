// Tests of the animation: it depends on the time alone, repeats exactly, and follows the report's circles.
#include "model/anim.h"

#include "help.h"
#include "test.h"

TEST(places_follow_from_time_alone)
{
    Model one, two;
    CHECK(one.makeFourSpheres() && two.makeFourSpheres());
    // One model is moved to every frame, the other to every seventh. Both have the same positions at the same times, in 16.16 bit
    // by bit.
    for (Time t = 0; t < 60 * 65536; t += 6554) {
        Anim::move(one, t);
        if (t / 6554 % 7 != 0)
            continue;
        Anim::move(two, t);
        for (int i = 0; i < 4; ++i)
            NEAR(size(vec(one.actor(i).object->centre()) - vec(two.actor(i).object->centre())), 0, EXACT * 100);
    }
    // Time can also go back to the start.
    Anim::move(one, 12345);
    Anim::move(one, 0);
    Anim::move(two, 0);
    for (int i = 0; i < 4; ++i)
        NEAR(size(vec(one.actor(i).object->centre()) - vec(two.actor(i).object->centre())), 0, EXACT * 100);
}

TEST(circular_paths)
{
    Model model;
    CHECK(model.makeFourSpheres());
    double least = 1e9, most = 0;
    for (Time t = 0; t < 60 * 65536; t += 3000) {
        for (int i = 0; i < 4; ++i) {
            const Point p = placeAt(model.actor(i).motion, t);
            const double r = size(vec(p) - vec(model.actor(i).motion.centre));
            least = std::fmin(least, r);
            most = std::fmax(most, r);
        }
    }
    note("%.4f to %.4f units from the centre", least, most);
    CHECK(most - least < 0.01);
    CHECK(least > 5 && most < 60);
}

TEST(the_minute_keeps_moving)
{
    // No object stands still or jumps: each moves at most 40 units per second.
    Model model;
    CHECK(model.makeFourSpheres());
    for (int i = 0; i < 4; ++i) {
        Point before = placeAt(model.actor(i).motion, 0);
        for (Time t = 655; t < 60 * 65536; t += 655) {
            const Point now = placeAt(model.actor(i).motion, t);
            const double moved = size(vec(now) - vec(before));
            CHECK(moved > 0.01 && moved < 0.4);
            before = now;
        }
    }
}

TEST(any_time_will_do)
{
    // Times have 48 bits; none of them causes a visible overflow.
    Model model;
    CHECK(model.makeFourSpheres());
    for (Time t : {Time(0), Time(1), Time(65536) * 86400, (Time(1) << 47), (Time(1) << 48) - 1}) {
        Anim::move(model, t);
        for (int i = 0; i < 4; ++i)
            CHECK(size(vec(model.actor(i).object->centre())) < 100);
    }
}
