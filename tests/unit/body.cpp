// Tests of bodies: links join objects to bodies, and an object that moves tells the others of its body.
#include "help.h"
#include "model/anim.h"
#include "model/probe.h"
#include "test.h"

namespace {

// The numbers of the objects of a body, in order.
std::vector<int> members(const Scene& scene, size_t i)
{
    SoftObject* const* list = scene.bodies->members(*scene.objects[i]);
    std::vector<int> numbers;
    for (int k = 0; k < scene.bodies->memberCount(*scene.objects[i]); ++k)
        numbers.push_back(list[k]->number());
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

}  // namespace

TEST(bodies_are_what_links_join)
{
    Scene scene;
    for (int i = 0; i < 7; ++i)
        scene.ball(10, 30.0 * i, 0, 0, 4);
    scene.link(0, 3);
    scene.link(3, 5);
    scene.link(1, 6, 0.5);
    scene.findBodies();
    const std::vector<int> first{1, 4, 6}, second{2, 7}, third{3};
    for (size_t i : {0, 3, 5})
        CHECK(members(scene, i) == first);
    for (size_t i : {1, 6})
        CHECK(members(scene, i) == second);
    CHECK(members(scene, 2) == third);
    const auto weight = [&](size_t a, size_t b) {
        return number(scene.bodies->weight(scene.objects[a]->slot(), scene.objects[b]->slot()));
    };
    NEAR(weight(0, 3), 1, 0);
    NEAR(weight(3, 0), 1, 0);
    NEAR(weight(1, 6), 0.5, 0);
    NEAR(weight(0, 5), 0, 0);
    NEAR(weight(2, 2), 0, 0);
    // Bodies are found anew when links have changed.
    scene.objects[3]->unlink(scene.objects[5].get());
    scene.objects[5]->unlink(scene.objects[3].get());
    scene.link(2, 5, 2);
    scene.findBodies();
    CHECK((members(scene, 0) == std::vector<int>{1, 4}));
    CHECK((members(scene, 5) == std::vector<int>{3, 6}));
    NEAR(weight(2, 5), 2, 0);
    NEAR(weight(3, 5), 0, 0);
}

TEST(bodies_of_any_graph)
{
    // Compares the bodies of random graphs of all sizes with a search of the test's own.
    Random random;
    for (int round = 0; round < 60; ++round) {
        Scene scene;
        const size_t count = static_cast<size_t>(1 + random.below(40));
        for (size_t i = 0; i < count; ++i)
            scene.ball(4, 0, 0, 0, 8);
        std::vector<size_t> mark(count);
        for (size_t i = 0; i < count; ++i)
            mark[i] = i;
        for (int k = random.below(40); k > 0; --k) {
            const size_t a = static_cast<size_t>(random.below(static_cast<int>(count)));
            const size_t b = static_cast<size_t>(random.below(static_cast<int>(count)));
            if (a == b)
                continue;
            scene.link(a, b);
            const size_t from = mark[b], to = mark[a];
            for (size_t& m : mark)
                m = m == from ? to : m;
        }
        scene.findBodies();
        for (size_t i = 0; i < count; ++i) {
            std::vector<int> expected;
            for (size_t j = 0; j < count; ++j)
                if (mark[j] == mark[i])
                    expected.push_back(static_cast<int>(j) + 1);
            CHECK(members(scene, i) == expected);
        }
    }
}

TEST(bodies_are_told_of_movement)
{
    // A chain: objects 0 and 2 are not linked, but in range of each other; 3 is linked, but out of range; 4 is in range, but a body
    // of its own.
    Scene scene;
    scene.ball(20, 0, 0, 0, 4);
    scene.ball(20, 8, 0, 0, 4);
    scene.ball(20, 16, 0, 0, 4);
    scene.ball(20, 90, 0, 0, 4);
    scene.ball(20, 4, 0, 0, 4);
    scene.link(0, 1);
    scene.link(1, 2);
    scene.link(2, 3);
    scene.update();
    for (auto& object : scene.objects)
        CHECK(!object->recalc());
    scene.objects[0]->translate(vector(0, 1, 0));
    scene.bodies->spreadRecalc();
    CHECK(scene.objects[1]->recalc());
    CHECK(scene.objects[2]->recalc());
    CHECK(!scene.objects[3]->recalc());
    CHECK(!scene.objects[4]->recalc());
    // If nothing has moved, no object is told.
    scene.update();
    scene.bodies->spreadRecalc();
    for (auto& object : scene.objects)
        CHECK(!object->recalc());
}

TEST(what_digs_into_bodies)
{
    // 1 and 2 blend, 3 digs into 2 alone, 4 blends with 5 and digs into 1 and 5, 6 digs into 3, 7 digs with a weight of 0.
    Scene scene;
    for (int i = 0; i < 7; ++i)
        scene.ball(20, 8.0 * i, 0, 0, 8);
    scene.link(0, 1);
    scene.link(3, 4, 0.5);
    scene.dent(1, 2, 1.5);
    scene.dent(0, 3);
    scene.dent(4, 3, 2);
    scene.dent(2, 5);
    scene.dent(0, 6, 0);
    scene.findBodies();
    const auto diggers = [&](size_t i) {
        std::vector<int> numbers;
        for (int k = 0; k < scene.bodies->diggerCount(*scene.objects[i]); ++k)
            numbers.push_back(scene.bodies->diggers(*scene.objects[i])[k]->number());
        std::sort(numbers.begin(), numbers.end());
        return numbers;
    };
    const std::vector<int> none;
    CHECK((members(scene, 0) == std::vector<int>{1, 2}) && (diggers(0) == std::vector<int>{3, 4}) && diggers(1) == diggers(0));
    CHECK((members(scene, 3) == std::vector<int>{4, 5}) && diggers(3) == none && diggers(4) == none);
    CHECK((members(scene, 2) == std::vector<int>{3}) && diggers(2) == none);
    CHECK((members(scene, 6) == std::vector<int>{7}));
    for (size_t i = 0; i < 7; ++i)
        CHECK(scene.objects[i]->hasSurface() == (i != 2 && i != 5));
    // An object that only digs has the seeds of a hollow, which lie farther out.
    CHECK(scene.objects[2]->hollowed() == scene.objects[1].get() && scene.objects[3]->hollowed() == nullptr);
    CHECK(scene.objects[5]->hollowed() == nullptr && scene.objects[6]->hollowed() == nullptr);
    CHECK(scene.objects[2]->laidInVain() && !scene.objects[3]->laidInVain());
    CHECK(scene.objects[2]->resample(Real(8), makeEngine) && !scene.objects[2]->laidInVain());
    CHECK(number(scene.objects[2]->radius()) > 13 && number(scene.objects[3]->radius()) == 10);
    const auto weight = [&](size_t a, size_t b) {
        return number(scene.bodies->weight(scene.objects[a]->slot(), scene.objects[b]->slot()));
    };
    NEAR(weight(1, 2), -1.5, 0);
    NEAR(weight(2, 1), 0, 0);
    NEAR(weight(4, 3), -1.5, 0);  // the link's weight minus the dent's
    NEAR(weight(3, 4), 0.5, 0);
    // When an object that digs into a body moves, all members of the body and all other objects that dig there are told, but no
    // others.
    scene.update();
    scene.objects[2]->translate(vector(0, 1, 0));
    scene.bodies->spreadRecalc();
    for (size_t i = 0; i < 7; ++i)
        CHECK(scene.objects[i]->recalc() == (i < 4 || i == 5));
    scene.update();
    // An object that is deleted takes its dents with it; one that digs no more has a visible surface.
    scene.objects[1]->undent(scene.objects[2].get());
    CHECK(scene.objects[2]->hasSurface() && scene.objects[2]->recalc() && scene.objects[1]->recalc());
    scene.objects.erase(scene.objects.begin() + 5);
    CHECK(scene.objects[2]->dents().empty());
    scene.objects.erase(scene.objects.begin());
    CHECK(!scene.objects[2]->digs().empty() && scene.objects[2]->digs().first()->next == nullptr);
    scene.findBodies();
    CHECK(diggers(0) == none);
}

// The field at a point is that of the body with the greatest field there, by the formula of body.h, and the point belongs to the
// member of that body whose own field is the strongest.
TEST(field_of_bodies_at_a_point)
{
    Random random;
    int blended = 0, rises = 0;
    for (int round = 0; round < 40; ++round) {
        constexpr int BALLS = 6, DIGGER = 5;
        Model model;
        Truth truth;
        double weights[BALLS][BALLS] = {};
        int body[BALLS];
        for (int i = 0; i < BALLS; ++i) {
            Motion motion{};
            const double size = random.between(15, 30);
            motion.centre = point(random.between(-20, 20), random.between(-20, 20), random.between(-20, 20));
            truth.balls.push_back({vec(motion.centre), size});
            CHECK(model.add(make<Sphere>(i + 1, real(size)), {255, 0, 0}, motion));
            body[i] = i;
        }
        Anim::move(model, 0);
        for (int i = 0; i < BALLS; ++i)
            truth.balls[static_cast<size_t>(i)].size = number(model.actor(i).object->size());
        for (int links = 1 + random.below(6); links > 0; --links) {
            const int a = random.below(DIGGER), b = random.below(DIGGER);
            if (a == b)
                continue;
            weights[a][b] = weights[b][a] = 0.5 * (1 + random.below(3));
            CHECK(model.link(model.actor(a).object, model.actor(b).object, real(weights[a][b])));
            for (int i = 0, from = body[a]; i < BALLS; ++i)
                if (body[i] == from)
                    body[i] = body[b];
        }
        weights[0][DIGGER] = -1;
        CHECK(model.dent(model.actor(0).object, model.actor(DIGGER).object, Real(1)));
        CHECK(model.prepareBodies() != nullptr);
        // Some points lie near the one before.
        FieldProbe probe(&model);
        Vec place{0, 0, 0};
        for (int sample = 0; sample < 50; ++sample) {
            const double way = sample % 3 == 0 ? 20 : 4;
            const Vec middle = sample % 3 == 0 ? Vec{0, 0, 0} : place;
            place = middle + Vec{random.between(-way, way), random.between(-way, way), random.between(-way, way)};
            const Point at = point(place.x, place.y, place.z);
            // The greatest field of a body, the next smaller one, and the strongest field of a member of the former.
            double expected = 0, second = 0, most = 0;
            bool reached = false;
            for (int one = 0; one < DIGGER; ++one) {
                double above = 0, below = 0, own = 0;
                // Each body counts once.
                if (std::find(body, body + one, body[one]) != body + one)
                    continue;
                for (size_t i = 0; i < DIGGER; ++i) {
                    if (body[i] != body[one])
                        continue;
                    const double f = truth.part(i, vec(at));
                    own = std::fmax(own, f);
                    double g = f;
                    for (size_t k = 0; k < BALLS; ++k)
                        g += weights[i][k] * truth.part(k, vec(at));
                    above += f * f * g;
                    below += f * f;
                }
                const double field = below > 1e-6 ? above / below : 0;
                second = std::fmax(second, std::fmin(field, expected));
                if (field > expected) {
                    expected = field;
                    most = own;
                }
                reached |= own > 0.001;
            }
            int found;
            NEAR(number(probe.implicitAt(at, &found)), expected, 0.01);
            blended += expected > most + 0.02;
            if (expected > 0.1) {
                const Vector gradient = probe.gradient();
                const double way[] = {number(gradient.x), number(gradient.y), number(gradient.z)};
                for (int axis = 0; axis < 3; ++axis) {
                    int other;
                    const auto beside = [&](double off) {
                        const Vec there = place + Vec{axis == 0 ? off : 0, axis == 1 ? off : 0, axis == 2 ? off : 0};
                        return number(probe.implicitAt(point(there.x, there.y, there.z), &other, model.actor(found).object));
                    };
                    const double rise = (beside(0.25) - beside(-0.25)) / 0.5;
                    NEAR(way[axis] / CORE_SIZE, rise, 0.003 + 0.03 * std::fabs(rise));
                }
                rises += expected > most + 0.02;
            }
            if (reached && expected > second + 0.02)
                NEAR(truth.part(static_cast<size_t>(found), vec(at)), most, 0.002);
        }
    }
    note("%d of 2000 points have a field of more than one", blended);
    CHECK(blended > 200 && rises > 150);
}
