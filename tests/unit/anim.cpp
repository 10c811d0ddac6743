// Tests of the animation: it depends on the time alone, repeats exactly, and follows the report's circles.
#include "model/anim.h"
#include "model/scene.h"

#include <string>

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

// Which objects of a scene turn their own axes when the animation is begun: a letter for each, T or -.
static std::string turning(const std::string& scene)
{
    Model model;
    SceneEnd end;
    CHECK(readSceneText("T.FB", scene.data(), static_cast<uint32_t>(scene.size()), model, &end) == nullptr);
    Anim::move(model, 0);
    const Matrix before = model.item(0).pose.turn;
    Anim::chooseRiders(model);
    // The poses are those of before.
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            CHECK(model.item(0).pose.turn.m[i][j] == before.m[i][j]);
    std::string letters;
    for (int i = 0; i < model.count(); ++i)
        letters += model.actor(i).object->turnsSeeds() ? 'T' : '-';
    return letters;
}

TEST(balls_ride_with_those_that_turn_as_they_do)
{
    const std::string group = "group g\nspin g axis 0.3 1 0 period 9\n";
    const std::string pair = group + "sphere a size 20 at -8 0 0 in g\nsphere b size 20 at 8 3 0 in g\n";
    CHECK(turning(pair + "blend all\n") == "TT");
    // Without links, out of reach of each other, or in a group that stands still, nothing rides.
    CHECK(turning(pair) == "--");
    CHECK(turning(group + "sphere a size 20 at -28 0 0 in g\nsphere b size 20 at 28 3 0 in g\nblend all\n") == "--");
    CHECK(turning("group g\nsphere a size 20 in g\nsphere b size 20 at 8 0 0 in g\nblend all\n") == "--");
    // The neighbour does not turn with the ball, or moves more than the group turns.
    CHECK(turning(group + "sphere a size 20 at 8 0 0 in g\nsphere b size 20 at 8 0 -9\nblend all\n") == "--");
    CHECK(turning(pair + "path b y 9 1.5 0\nblend all\n") == "--");
    // Cylinders always turn.
    CHECK(turning(group + "sphere a size 20 at 28 0 0 in g\ncylinder c size 10 length 9 at 28 0 -20\nblend all\n") == "-T");
}

TEST(a_riding_ball_is_the_same_ball)
{
    // Two worlds: in one the ball rides. Its field is the same in both, and its seeds turn with the group.
    const std::string scene = "group g\nspin g axis 0 1 0 period 8\nsphere a size 20 at -8 0 0 in g\n"
                              "sphere b size 20 at 8 0 0 in g\nblend all\n";
    Model one, two;
    SceneEnd end;
    for (Model* model : {&one, &two})
        CHECK(readSceneText("T.FB", scene.data(), static_cast<uint32_t>(scene.size()), *model, &end) == nullptr);
    Anim::chooseRiders(two);
    Anim::move(one, 65536 * 2);
    Anim::move(two, 65536 * 2);  // a quarter turn
    const SoftObject &still = *one.actor(0).object, &rider = *two.actor(0).object;
    CHECK(!still.turnsSeeds() && rider.turnsSeeds());
    NEAR(size(vec(still.centre()) - vec(rider.centre())), 0, 0.001);
    const Vector v{Real(3), Real(1), Real(-2)};
    NEAR(size(vec(still.toWorld(v)) - vec(still.centre()) - vec(v)), 0, 0.001);
    // A quarter turn about y takes (x, y, z) to (z, y, -x), and toOwnAxes() undoes it.
    const Vector quarter{Real(-2), Real(1), Real(-3)};
    NEAR(size(vec(rider.toWorld(v)) - vec(rider.centre()) - vec(quarter)), 0, 0.001);
    NEAR(size(vec(rider.toOwnAxes(quarter)) - vec(v)), 0, 0.001);
    const Point beside = rider.centre() + Vector{Real(4), Real(5), Real(6)};
    NEAR(number(rider.fieldFunc(beside)), number(still.fieldFunc(beside)), 0.001);
}
