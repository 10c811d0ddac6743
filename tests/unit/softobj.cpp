// Tests of SoftObject: the operations of the report's Section III, the graph of links, and the field.
#include "help.h"
#include "stick.h"
#include "test.h"

namespace {

// A million steps in the ordinary build; fewer with the sanitizers, which take ten times as long.
#if defined(__SANITIZE_ADDRESS__)
constexpr int STEPS = 50000;
#else
constexpr int STEPS = 1000000;
#endif

Vec onSegment(const Vec& p, const Vec& a, const Vec& b)
{
    const Vec d = b - a;
    const double t = dot(p - a, d) / dot(d, d);
    return a + d * (t < 0 ? 0 : t > 1 ? 1 : t);
}

}  // namespace

TEST(translation)
{
    Scene scene;
    Stick* stick = new Stick(1, 12, 8);
    scene.add(stick, 0, 0, 0);
    std::vector<Vec> before;
    for (int i = 0; i < stick->seedSlots(); ++i)
        before.push_back(vec(stick->seedPoint(stick->seed(i))));
    scene.update();
    CHECK(!stick->recalc());
    stick->translate(vector(3.5, -20, 7.25));
    CHECK(stick->recalc());
    for (int i = 0; i < stick->seedSlots(); i += 2) {
        const Vec moved = vec(stick->seedPoint(stick->seed(i)));
        NEAR(size(moved - before[static_cast<size_t>(i)] - Vec{3.5, -20, 7.25}), 0, 1e-4);
    }
    CHECK(stick->centre() == point(3.5, -20, 7.25));
    NEAR(size(stick->a() - Vec{3.5 - 8, -20, 7.25}), 0, 1e-4);
    // If nothing has moved, there is nothing to do.
    scene.update();
    stick->translate(vector(0, 0, 0));
    CHECK(!stick->recalc());
    stick->moveTo(point(1, 2, 3));
    CHECK(stick->centre() == point(1, 2, 3));
    // Moving to and fro any number of times leads back to the start, in 16.16 bit by bit.
    const Point start = stick->centre();
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const Vector by = vector(random.between(-5, 5), random.between(-5, 5), random.between(-5, 5));
        stick->translate(by);
        stick->translate(-by);
    }
    NEAR(size(vec(stick->centre()) - vec(start)), 0, EXACT * 1e5);
}

TEST(rotation_places_seeds_and_core)
{
    Scene scene;
    Stick* stick = new Stick(1, 10, 9);
    scene.add(stick, 2, 0, 0);
    // A quarter turn about the z axis through the origin.
    stick->rotate(point(0, 0, 0), vector(0, 0, 1), 0x40000000u);
    CHECK(stick->recalc());
    NEAR(size(vec(stick->centre()) - Vec{0, 2, 0}), 0, 1e-3);
    NEAR(size(stick->a() - Vec{0, 2 - 9, 0}), 0, 1e-3);
    NEAR(size(stick->b() - Vec{0, 2 + 9, 0}), 0, 1e-3);
    for (int i = 0; i < stick->seedSlots(); i += 2) {
        // Each seed still rests at the same distance from the core.
        const Vec p = vec(stick->seedPoint(stick->seed(i)));
        NEAR(size(p - onSegment(p, stick->a(), stick->b())), 5, 2e-3);
    }
    // Of a ball only the position turns.
    SoftObject& ball = scene.ball(20, 10, 0, 0);
    ball.rotate(point(0, 0, 0), vector(0, 1, 0), 0x80000000u);
    NEAR(size(vec(ball.centre()) - Vec{-10, 0, 0}), 0, 1e-3);
    for (int i = 0; i < ball.seedSlots(); i += 2)
        NEAR(size(vec(ball.seedPoint(ball.seed(i))) - vec(ball.centre())), 10, 1e-3);
}

TEST(a_million_rotations_keep_path_lengths)
{
    Scene scene;
    Stick* stick = new Stick(1, 6, 2);
    scene.add(stick, 0, 0, 0, 6);
    for (int i = 0; i < STEPS; ++i)
        stick->rotate(point(0, 0, 0), i & 1 ? vector(1, 2, 3) : vector(-2, 1, 0.5), 12345678u + static_cast<uint32_t>(i));
    double worst = 0, core = 0;
    for (int i = 0; i < stick->seedSlots(); ++i) {
        if ((i & 1) != 0 && stick->seed(i - 1).neighbour < 0)
            continue;
        worst = std::fmax(worst, std::fabs(size(vec(stick->seed(i).path)) - 3));
        if (i & 1)
            continue;
        const Vec p = vec(stick->seedPoint(stick->seed(i)));
        core = std::fmax(core, std::fabs(size(p - onSegment(p, stick->a(), stick->b())) - 3));
    }
    note("%d steps, %d seeds: path lengths within %.6f units, places within %.6f", STEPS, stick->seeds(), worst, core);
    CHECK(worst < 0.002);
    CHECK(core < 0.004);
    NEAR(size(stick->b() - stick->a()), 4, 0.002);
}

TEST(scaling)
{
    Scene scene;
    Stick* stick = new Stick(1, 12, 8);
    scene.add(stick, 0, 0, 0);
    scene.update();
    stick->scale(Real(1.125));
    CHECK(stick->recalc());
    NEAR(number(stick->size()), 13.5, 1e-4);
    NEAR(number(stick->radius()), 6.75, 1e-4);
    NEAR(size(stick->b() - stick->a()), 18, 2e-3);
    // Limits: the size stays within its range.
    stick->scale(Real(100));
    NEAR(number(stick->size()), MAX_SIZE, 0.01);
    for (int i = 0; i < 10; ++i)
        stick->scale(Real(0.125));
    NEAR(number(stick->size()), MIN_SIZE, 0.01);
}

TEST(the_graph)
{
    Scene scene;
    SoftObject& a = scene.ball(20, -6, 0, 0);
    SoftObject& b = scene.ball(20, 6, 0, 0);
    const Point middle = point(0, 0, 0);
    const double alone = number(a.fieldFunc(middle));
    NEAR(alone, trueGeoff(0.09), 1e-3);
    // Each end of a link has its own weight. Linking again sets a new weight and makes no second entry.
    const auto weight = [&](const SoftObject& from, const SoftObject& to) {
        double found = 0;
        int links = 0;
        for (const List<Link>::Node* node = from.skel().first(); node != nullptr; node = node->next)
            if (node->item.object == &to) {
                found = number(node->item.weight);
                ++links;
            }
        CHECK(links <= 1);
        return found;
    };
    CHECK(a.link(&b, Real(1)));
    NEAR(weight(a, b), 1, 0);
    NEAR(weight(b, a), 0, 0);
    scene.update();
    CHECK(!a.recalc());
    CHECK(a.link(&b, Real(0.5)));
    CHECK(a.recalc());
    NEAR(weight(a, b), 0.5, 0);
    scene.update();
    a.unlink(&b);
    CHECK(a.recalc());
    CHECK(a.skel().empty());
    scene.update();
    a.unlink(&b);
    CHECK(!a.recalc());
}

// Nothing of an object's field reaches beyond its box, which turns and grows with it, and along its axis a stick is long and thin.
TEST(box_about_the_field)
{
    Scene scene;
    Random random;
    Stick* const stick = new Stick(1, 10, 20);
    scene.add(stick, 1, 2, 3);
    const auto reaches = [&](double x, double y, double z) {
        const Vec c = vec(stick->centre());
        return !stick->isFar(point(c.x + x, c.y + y, c.z + z));
    };
    CHECK(reaches(29.5, 0, 0) && !reaches(30.5, 0, 0) && reaches(0, 9.5, -9.5) && !reaches(0, 10.5, 0) && !reaches(0, 0, -10.5));
    stick->rotate(stick->centre(), {Real(0), Real(1), Real(0)}, QUARTER);
    CHECK(reaches(0, 0, -29.5) && !reaches(0, 0, 30.5) && !reaches(10.5, 0, 0));
    stick->scale(Real(2));
    CHECK(reaches(19.5, 19.5, 59) && !reaches(0, 0, 61) && !reaches(20.5, 0, 0));
    int beyond = 0;
    for (int i = 0; i < 20000; ++i) {
        stick->rotate(stick->centre(), {real(random.between(-1, 1)), real(random.between(-1, 1)), Real(0.1)}, 0x01234567);
        const Vec c = vec(stick->centre());
        const Point p = point(c.x + random.between(-60, 60), c.y + random.between(-60, 60), c.z + random.between(-60, 60));
        const Vec f = vec(p) - onSegment(vec(p), stick->a(), stick->b());
        beyond += stick->isFar(p);
        CHECK(!stick->isFar(p) || dot(f, f) > 20 * 20 * 0.999);
    }
    CHECK(beyond > 5000);
}

TEST(field_of_a_primitive)
{
    Scene scene;
    Random random;
    const SoftObject& ball = scene.ball(35, 4, -3, 2);
    const SoftObject& small = scene.ball(5, 0, 0, 0, 1);
    Stick* stick = new Stick(3, 14, 10);
    scene.add(stick, 1, 2, 3);
    for (int i = 0; i < 20000; ++i) {
        const Point p = point(random.between(-60, 60), random.between(-60, 60), random.between(-60, 60));
        const Vec d = vec(p) - vec(ball.centre());
        NEAR(number(ball.fieldFunc(p)), trueGeoff(dot(d, d) / (35.0 * 35)), 4e-4);
        const Vec e = vec(p) * 0.1;
        NEAR(number(small.fieldFunc(point(e.x, e.y, e.z))), trueGeoff(dot(e, e) / 25), 4e-4);
        const Vec f = vec(p) - onSegment(vec(p), stick->a(), stick->b());
        NEAR(number(stick->fieldFunc(p)), trueGeoff(dot(f, f) / (14.0 * 14)), 6e-4);
    }
    // Far away the field is zero everywhere, and nothing overflows.
    for (double far : {100.0, 181.0, 182.0, 255.0, 300.0, 1000.0, 8000.0}) {
        CHECK(ball.fieldFunc(point(far, 0, 0)) == Real(0));
        CHECK(ball.fieldFunc(point(-far, far, far)) == Real(0));
        CHECK(ball.fieldFunc(point(0, 0, -far)) == Real(0));
    }
    // The smallest and the largest size.
    SoftObject& large = scene.ball(MAX_SIZE, 0, 0, 0, 8);
    SoftObject& tiny = scene.ball(MIN_SIZE, 0, 0, 0, 0.25);
    for (int i = 0; i < 5000; ++i) {
        const Vec p{random.between(-110, 110), random.between(-110, 110), random.between(-110, 110)};
        NEAR(number(large.fieldFunc(point(p.x, p.y, p.z))), trueGeoff(dot(p, p) / 10000), 5e-4);
        const Point q = point(p.x / 100, p.y / 100, p.z / 100);
        const Vec e = vec(q);
        NEAR(number(tiny.fieldFunc(q)), trueGeoff(dot(e, e)), 5e-4);
    }
}
