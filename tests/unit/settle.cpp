// Seeds on the surface: how near, by both methods, and each of the report's optimizations and answers to gaps at work,
// with what it may not change. The truth is in double precision throughout.
#include <algorithm>
#include <cstddef>
#include <cstring>

#include "help.h"
#include "stick.h"
#include "test.h"

namespace {

struct Error {
    double worst = 0;
    double sum = 0;
    long count = 0;
    long beyond = 0;
    // `steep`: how much the field changes over a unit there. Where a small neighbour makes it steep, a quarter of a unit is
    // near enough.
    void add(double e, double limit, double steep)
    {
        worst = std::fmax(worst, e);
        sum += e;
        ++count;
        beyond += e > limit && e > 0.25 * steep;
    }
};

// A seed that is drawn: settled, and not passed over.
bool settled(const Scene& scene, const SoftObject& object, int i)
{
    const Seed& s = object.seed(i);
    if (!takesPart(object, i) || !(s.flags & SEED_VALID))
        return false;
    // A placed seed that cannot be seen may wait, and stays where it was.
    return !(scene.printed || (s.flags & SEED_PLACED)) || (s.flags & SEED_FRONT);
}

// How far the field at the settled seeds of a scene is from the isovalue.
void measure(const Scene& scene, Error& error, double limit)
{
    for (size_t o = 0; o < scene.objects.size(); ++o) {
        const SoftObject& object = *scene.objects[o];
        const Truth truth = scene.truth(o);
        for (int i = 0; i < object.seedSlots(); ++i)
            if (settled(scene, object, i)) {
                const Vec p = vec(object.seedPoint(object.seed(i)));
                error.add(std::fabs(truth.field(p) - 0.5), limit, size(truth.slope(p)));
            }
    }
}

// Balls of any size anywhere, all linked, moving.
void wander(bool printed, Error& error, double limit, uint32_t& unsettled)
{
    Random random;
    unsettled = 0;
    for (int round = 0; round < 40; ++round) {
        Scene scene;
        scene.printed = printed;
        const int count = 2 + random.below(4);
        std::vector<Vec> speed;
        for (int i = 0; i < count; ++i) {
            scene.ball(random.between(6, 45), random.between(-25, 25), random.between(-20, 20), random.between(-25, 25),
                       random.between(1.5, 4));
            speed.push_back({random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)});
        }
        scene.linkAll();
        for (int frame = 0; frame < 8; ++frame) {
            scene.counts = Counts{};
            scene.update();
            unsettled += scene.counts.unsettled;
            measure(scene, error, limit);
            for (int i = 0; i < count; ++i)
                scene.objects[static_cast<size_t>(i)]->translate(vector(speed[static_cast<size_t>(i)].x, speed[static_cast<size_t>(i)].y, speed[static_cast<size_t>(i)].z));
        }
    }
}


// Two balls alike on the x axis, linked.
Scene pair(double size, double apart, bool printed)
{
    Scene scene;
    scene.printed = printed;
    scene.ball(size, -apart / 2, 0, 0);
    scene.ball(size, apart / 2, 0, 0);
    scene.link(0, 1);
    return scene;
}

// Where a path first leaves the surface, from its rest outwards; 2 when it does not before its own field ends.
double along(const Truth& truth, const Vec& root, const Vec& path)
{
    if (truth.field(root + path) <= 0.5)
        return 1;
    double inside = 1, outside = 1;
    while (truth.field(root + path * outside) > 0.5) {
        inside = outside;
        outside += 0.002;
        if (outside > 2)
            return 2;
    }
    for (int i = 0; i < 40; ++i) {
        const double middle = (inside + outside) / 2;
        (truth.field(root + path * middle) > 0.5 ? inside : outside) = middle;
    }
    return inside;
}

bool identical(const std::vector<Voxel>& a, const std::vector<Voxel>& b)
{
    if (a.size() != b.size())
        return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i].x != b[i].x || a[i].y != b[i].y || a[i].z != b[i].z || a[i].wide != b[i].wide || a[i].high != b[i].high ||
            a[i].tiltX != b[i].tiltX || a[i].tiltY != b[i].tiltY || a[i].brightness != b[i].brightness ||
            a[i].reach != b[i].reach || a[i].slopeX != b[i].slopeX || a[i].slopeY != b[i].slopeY)
            return false;
    return true;
}

int activeSeeds(const Scene& scene)
{
    int count = 0;
    for (const auto& object : scene.objects)
        for (int i = 1; i < object->seedSlots(); i += 2)
            count += (object->seed(i).flags & SEED_ACTIVE) != 0;
    return count;
}

}  // namespace

TEST(default_seeds_lie_on_the_surface)
{
    Error error;
    uint32_t unsettled;
    wander(false, error, 0.0145, unsettled);
    note("%ld seeds: field within %.5f of the isovalue, %.6f on average; %ld beyond", error.count, error.worst, error.sum / error.count, error.beyond);
    CHECK(error.count > 100000);
    // One in fifty thousand may be caught between two crossings of its path.
    CHECK(error.beyond <= error.count / 50000);
}

TEST(printed_seeds_lie_on_the_surface)
{
    Error error;
    uint32_t unsettled;
    wander(true, error, 0.003, unsettled);
    note("%ld seeds: field within %.5f of the isovalue, %.6f on average; %ld beyond, %u unsettled", error.count, error.worst, error.sum / error.count, error.beyond, unsettled);
    CHECK(error.count > 100000);
    // Those beyond are the ones that reached the limit of iterations, and are counted.
    CHECK(error.beyond <= static_cast<long>(unsettled));
}

// --- The report's optimizations

TEST(position_measures_deformation)
{
    for (bool printed : {false, true}) {
        double before = 1;
        for (double apart : {60.0, 29.0, 27.0, 25.0, 23.0}) {
            Scene scene = pair(20, apart, printed);
            scene.update();
            const SoftObject& ball = *scene.objects[0];
            const Truth truth = scene.truth(0);
            double most = 0;
            for (int i = 0; i < ball.seedSlots(); i += 2) {
                if (!settled(scene, ball, i))
                    continue;
                const Seed& s = ball.seed(i);
                const double position = number(s.position);
                most = std::fmax(most, position);
                // 1 on the unblended surface; elsewhere the distance from the core in radii.
                const double exact = along(truth, vec(ball.centre()), vec(s.path));
                // (Where the field is flat, several positions are as good.)
                if (std::fabs(truth.field(vec(ball.seedPoint(s))) - 0.5) > 0.003)
                    NEAR(position, exact, 0.012);
                if (apart == 60)
                    NEAR(position, 1, printed ? 1e-3 : 0);
            }
            CHECK(apart == 60 ? most < 1.002 : most > before + 0.005);
            before = most;
        }
    }
}

// One goes round along two large ones, in small steps. What it turned the normals of must be as if it had never been there.
TEST(a_small_ball_leaves_no_trace)
{
    Scene scene;
    scene.ball(60, -8, 0, 16);
    scene.ball(40, 24, 8, 10);
    scene.ball(10, 30, 0, 0);
    scene.linkAll();
    int spots = 0, seen = 0;
    double sum = 0;
    for (int step = 0; step <= 350; ++step) {
        const double angle = step * 2 * 3.14159265358979 / 350;
        scene.objects[2]->moveTo(point(30 * std::cos(angle), 30 * std::sin(angle), 0));
        scene.update();
        if (step % 50 != 0)
            continue;
        for (size_t o = 0; o < 2; ++o) {
            const SoftObject& ball = *scene.objects[o];
            const Truth truth = scene.truth(o);
            for (int i = 0; i < ball.seedSlots(); i += 2) {
                const Seed& s = ball.seed(i);
                if (!(s.flags & SEED_PLACED) || !(s.flags & SEED_KEPT) || !settled(scene, ball, i))
                    continue;
                const Vec n = truth.normal(vec(ball.seedPoint(s)));
                const double error = std::fabs(s.voxel.brightness - std::fmax(0, dot(n, vec(scene.light)) * 63));
                ++seen;
                sum += error;
                spots += error > 16;
            }
        }
    }
    note("%d seeds, %.2f of 64 steps off on average; %d by more than a quarter of the ramp", seen, sum / seen, spots);
    CHECK(seen > 500);
    CHECK(spots <= 2);
    // 0.4 where seeds are not shaded anew.
    CHECK(sum / seen < 0.32);
}

TEST(normal_is_the_path_where_nothing_blends)
{
    for (bool printed : {false, true}) {
        Scene scene = pair(20, 19, printed);
        scene.update();
        size_t drawn = 0;
        for (size_t o = 0; o < 2; ++o)
            drawn += scene.draw(o).size();
        // At work: not every seed that is drawn had its normal taken from the field.
        CHECK(scene.counts.normals > 20);
        CHECK(scene.counts.normals < drawn);
        if (printed)
            SAME(scene.counts.samples, 3 * scene.counts.normals);
        // And far apart none has.
        Scene far = pair(20, 60, printed);
        far.update();
        CHECK(far.draw(0).size() > 100);
        SAME(far.counts.normals, 0);
        SAME(far.counts.samples, 0);
        // What it may not change: the brightness of the surface.
        double worstRest = 0, worst = 0, sum = 0;
        int rest = 0, count = 0;
        const SoftObject& ball = *scene.objects[0];
        const Truth truth = scene.truth(0);
        for (int i = 0; i < ball.seedSlots(); ++i) {
            const Seed& s = ball.seed(i);
            if (!settled(scene, ball, i) || (!printed && std::fabs(number(s.position) - 1) > 1e-6 && !(s.flags & SEED_FRONT)))
                continue;
            const Vec n = truth.normal(vec(ball.seedPoint(s)));
            const double lit = std::fmax(0, dot(n, vec(scene.light)) * 63);
            const double error = std::fabs(s.voxel.brightness - lit);
            const bool still = std::fabs(number(s.position) - 1) < (printed ? number(printed::DEFORMITY) : 1e-6);
            if (still) {
                ++rest;
                worstRest = std::fmax(worstRest, error);
            } else {
                ++count;
                worst = std::fmax(worst, error);
                sum += error;
            }
        }
        note("%s: %d seeds by their path within %.2f of 64 steps; %d by the field within %.2f, %.2f on average", printed ? "printed" : "default",
             rest, worstRest, count, worst, sum / count);
        CHECK(rest > 50 && count > 20);
        // Below the tolerances the surface may lean a little already.
        CHECK(worstRest < 4);
        CHECK(sum / count < (printed ? 2.5 : 1));
    }
}

TEST(what_has_not_moved_is_kept)
{
    for (bool printed : {false, true}) {
        Scene scene = pair(20, 19, printed);
        scene.update();
        CHECK(scene.draw(0).size() > 50 && scene.draw(1).size() > 50);
        CHECK(scene.counts.normals > 0);
        // A last step that took no further look may be made good once.
        for (auto& object : scene.objects)
            object->setRecalc();
        scene.update();
        std::vector<Voxel> before[2] = {scene.draw(0), scene.draw(1)};
        for (int again = 0; again < 3; ++again) {
            for (auto& object : scene.objects)
                object->setRecalc();
            scene.counts = Counts{};
            scene.update();
            for (size_t o = 0; o < 2; ++o) {
                const std::vector<Voxel> after = scene.draw(o);
                CHECK(identical(before[o], after));
            }
            CHECK(!printed || scene.counts.updated > 50);  // by default they need not even be looked at
            // One look tells that a seed is where it was; none needs its normal again.
            SAME(scene.counts.normals, 0);
            if (printed)
                SAME(scene.counts.samples, 0);
        }
        // Nothing changed at all: nothing is looked at.
        scene.counts = Counts{};
        scene.update();
        SAME(scene.counts.updated, 0);
        CHECK(identical(before[0], scene.draw(0)));
    }
}

TEST(neighbours_out_of_range_are_left_out)
{
    for (bool printed : {false, true}) {
        // Two that blend, and a third, linked to both, too far away to matter.
        Scene with = pair(20, 19, printed), without = pair(20, 19, printed);
        Stick* stick = new Stick(3, 12, 6);
        with.add(stick, 0, 60, 0);
        with.linkAll();
        stick->looks = 0;
        with.objects[0]->update(with.look());
        without.objects[0]->update(without.look());
        SAME(stick->looks, 0);
        SAME(with.counts.iterations, without.counts.iterations);
        SAME(with.counts.updated, without.counts.updated);
        CHECK(with.counts.iterations > 0);
        // What it may not change: the surface.
        for (int i = 0; i < with.objects[0]->seedSlots(); ++i)
            CHECK(with.objects[0]->seed(i).position == without.objects[0]->seed(i).position);
        // Nearer it is asked.
        stick->moveTo(point(-9, 20, 0));
        with.objects[0]->update(with.look());
        CHECK(stick->looks > 0);
    }
}

TEST(seeds_that_face_away_are_left_out)
{
    for (bool printed : {false, true}) {
        // All blending is at the back, then all at the front.
        uint32_t updated[2];
        for (int side = 0; side < 2; ++side) {
            Scene scene;
            scene.printed = printed;
            scene.ball(30, 0, 0, 0);
            scene.ball(30, 0, 0, 33);
            scene.link(0, 1);
            if (side == 1)
                scene.eye = point(0, 0, 120);
            scene.objects[0]->update(scene.look());
            updated[side] = scene.counts.updated;
        }
        note("%s: %u updated when the blend is hidden, %u when it is seen", printed ? "printed" : "default", updated[0], updated[1]);
        CHECK(updated[0] * 10 < updated[1] * 9);
        // What it may not change: no seed that was left out lies on a part of the surface that faces the viewer.
        Random random;
        double worst = -1;
        int leftOut = 0, facing = 0;
        for (int round = 0; round < 30; ++round) {
            Scene scene;
            scene.printed = printed;
            for (int k = 0; k < 4; ++k)
                scene.ball(random.between(18, 36), random.between(-20, 20), random.between(-20, 20), random.between(-22, 22), 3);
            scene.linkAll();
            scene.update();
            for (size_t o = 0; o < 4; ++o) {
                const SoftObject& ball = *scene.objects[o];
                const Truth truth = scene.truth(o);
                for (int i = 0; i < ball.seedSlots(); i += 2) {
                    const Seed& s = ball.seed(i);
                    if (printed ? (s.flags & SEED_FRONT) != 0 : (s.flags & SEED_VALID) != 0)
                        continue;
                    // Where it would be, and whether it would be its own object's there.
                    const double position = along(truth, vec(ball.centre()), vec(s.path));
                    const Vec p = vec(ball.centre()) + vec(s.path) * position;
                    double strongest = 0;
                    for (size_t k = 1; k < 4; ++k)
                        strongest = std::fmax(strongest, truth.part(k, p));
                    if (position > 1.9 || strongest > truth.part(0, p))
                        continue;
                    ++leftOut;
                    const Vec toEye = vec(scene.eye) - p;
                    const double cosine = dot(truth.normal(p), toEye) / size(toEye);
                    worst = std::fmax(worst, cosine);
                    facing += cosine > 0.1;
                }
            }
        }
        note("%s: %d left out, %d of them facing the viewer; the worst by a cosine of %.3f", printed ? "printed" : "default", leftOut, facing, worst);
        CHECK(leftOut > 500);
        // Its tolerance covers almost all of those that blending pulls out.
        CHECK(facing <= (printed ? leftOut / 50 : 0));
    }
}

TEST(small_displacements_are_none)
{
    for (bool printed : {false, true}) {
        Scene scene = pair(20, 19, printed);
        scene.update();
        scene.draw(0);
        for (auto& object : scene.objects)
            object->setRecalc();
        scene.update();
        scene.draw(0);
        const SoftObject& ball = *scene.objects[0];
        std::vector<Real> before;
        for (int i = 0; i < ball.seedSlots(); ++i)
            before.push_back(ball.seed(i).position);
        // At work: the neighbour moved by a two-thousandth of a unit; no seed moved, no normal is taken.
        scene.counts = Counts{};
        scene.objects[1]->translate(vector(0.0005, 0, 0));
        scene.objects[0]->update(scene.look());
        scene.draw(0);
        long moved = 0;
        for (int i = 0; i < ball.seedSlots(); ++i)
            moved += settled(scene, ball, i) && (ball.seed(i).flags & SEED_FRONT) != 0 && ball.seed(i).position != before[static_cast<size_t>(i)];
        SAME(moved, 0);
        SAME(scene.counts.normals, 0);
        CHECK(!printed || scene.counts.updated > 20);
        // A whole unit is no small displacement.
        scene.counts = Counts{};
        scene.objects[1]->translate(vector(1, 0, 0));
        scene.objects[0]->update(scene.look());
        scene.draw(0);
        CHECK(scene.counts.normals > 20);
        // What it may not change: however slowly the neighbour creeps away, the seeds stay on the surface.
        double worst = 0;
        for (int step = 0; step < 300; ++step) {
            scene.objects[1]->translate(vector(0.01, 0.003, 0));
            scene.update();
            if (step % 10 != 9)
                continue;
            Error error;
            measure(scene, error, 0.02);
            worst = std::fmax(worst, error.worst);
            SAME(error.beyond, 0);
        }
        note("%s: field within %.5f of the isovalue while it creeps", printed ? "printed" : "default", worst);
    }
}

TEST(neighbours_are_not_told_while_nothing_is_displaced)
{
    for (bool printed : {false, true}) {
        Scene scene = pair(20, 80, printed);
        scene.update();
        CHECK(!scene.objects[0]->recalc() && !scene.objects[1]->recalc());
        // At work: far away it moves, and the other is not told.
        scene.objects[0]->translate(vector(1, 0, 0));
        CHECK(scene.objects[0]->recalc());
        CHECK(!scene.objects[1]->recalc());
        scene.update();
        // "This works as long as there are no huge jumps": here they are safe, in and out.
        scene.objects[0]->moveTo(point(30, 0, 0));
        CHECK(scene.objects[1]->recalc());
        scene.update();
        scene.objects[0]->moveTo(point(-60, 0, 0));
        CHECK(scene.objects[1]->recalc());
        scene.update();
        for (int i = 0; i < scene.objects[1]->seedSlots(); i += 2)
            if (settled(scene, *scene.objects[1], i))
                NEAR(number(scene.objects[1]->seed(i).position), 1, 1.1e-3);
        scene.objects[0]->translate(vector(-1, 0, 0));
        CHECK(!scene.objects[1]->recalc());
        // Blending ones tell each other of everything.
        Scene near = pair(20, 19, printed);
        near.update();
        near.objects[1]->translate(vector(0.1, 0, 0));
        CHECK(near.objects[0]->recalc());
        near.update();
        near.objects[1]->scale(Real(1.0625));
        CHECK(near.objects[0]->recalc());
        near.update();
        near.objects[1]->rotate(near.objects[0]->centre(), vector(0, 0, 1), 0x01000000u);
        CHECK(near.objects[0]->recalc());
    }
}

TEST(telling_fewer_changes_nothing)
{
    // A wild ride, once with the flags as they are and once with every object told every time: the same positions.
    for (bool printed : {false, true}) {
        Scene told = pair(20, 50, printed), free = pair(20, 50, printed);
        told.ball(26, 0, 40, 0);
        free.ball(26, 0, 40, 0);
        told.linkAll();
        free.linkAll();
        Random random;
        long worst = 0;
        for (int frame = 0; frame < 60; ++frame) {
            const size_t which = static_cast<size_t>(random.below(3));
            const Point to = point(random.between(-40, 40), random.between(-30, 30), random.between(-30, 30));
            for (Scene* scene : {&told, &free})
                scene->objects[which]->moveTo(to);
            for (auto& object : told.objects)
                object->setRecalc();
            told.update();
            free.update();
            long differ = 0;
            for (size_t o = 0; o < 3; ++o)
                for (int i = 0; i < told.objects[o]->seedSlots(); ++i) {
                    const Seed& a = told.objects[o]->seed(i);
                    const Seed& b = free.objects[o]->seed(i);
                    if (!takesPart(*told.objects[o], i) && !takesPart(*free.objects[o], i))
                        continue;
                    differ += (a.flags & (SEED_VALID | SEED_ACTIVE)) != (b.flags & (SEED_VALID | SEED_ACTIVE)) ||
                              ((a.flags & SEED_VALID) != 0 && std::fabs(number(a.position) - number(b.position)) > 0.003);
                }
            worst = std::max(worst, differ);
        }
        // Where a seed starts from decides between two crossings of its path, and how near the tolerance lets it stop.
        note("%s: at most %ld seeds of %d differ in a frame", printed ? "printed" : "default", worst,
             told.objects[0]->seeds() + told.objects[1]->seeds() + told.objects[2]->seeds());
        CHECK(worst <= 20);
    }
}

TEST(accuracy_and_iteration_limit)
{
    Random random;
    for (bool printed : {false, true}) {
        for (int round = 0; round < 20; ++round) {
            Scene scene;
            scene.printed = printed;
            for (int k = 0; k < 5; ++k)
                scene.ball(random.between(8, 60), random.between(-15, 15), random.between(-15, 15), random.between(-15, 15), 3);
            scene.linkAll();
            scene.update();
            CHECK(scene.counts.updated > 0);
            // No seed takes longer than the limit, however badly they are placed.
            CHECK(scene.counts.iterations <= scene.counts.updated * static_cast<uint32_t>(printed ? printed::ITERATION_LIMIT : 24));
            if (!printed)
                continue;
            // Those beyond the accuracy are the ones that reached the limit, and are counted.
            Error error;
            measure(scene, error, number(printed::LOCATION_TOLERANCE) + 0.0006);
            CHECK(error.beyond <= static_cast<long>(scene.counts.unsettled));
        }
    }
}

// --- Answers to gaps

TEST(scales_grow_with_deformation)
{
    // As printed: half a scale is SCALE spacings at rest, and grows by MAGNIFICATION with the deformity.
    Scene scene = pair(20, 19, true);
    scene.update();
    const std::vector<Voxel> voxels = scene.draw(0);
    std::vector<double> expected;
    const SoftObject& ball = *scene.objects[0];
    for (int i = 0; i < ball.seedSlots(); ++i)
        if (settled(scene, ball, i))
            expected.push_back(2 * number(printed::SCALE) *
                               (1 + std::fabs(number(ball.seed(i).position) - 1) * number(printed::MAGNIFICATION)));
    SAME(voxels.size(), expected.size());
    double most = 0, least = 99;
    for (size_t i = 0; i < voxels.size() && i < expected.size(); ++i) {
        NEAR(voxels[i].wide / 256.0, expected[i], 1.0 / 128);
        SAME(voxels[i].wide, voxels[i].high);
        most = std::fmax(most, expected[i]);
        least = std::fmin(least, expected[i]);
    }
    CHECK(most > least * 1.15);
    // By default a scale is as large as the part of the surface that is its own: larger where that is pulled apart.
    Scene quick = pair(20, 19, false);
    quick.update();
    Scene far = pair(20, 60, false);
    far.update();
    const auto largest = [](const std::vector<Voxel>& list) {
        int most = 0;
        for (const Voxel& v : list)
            most = std::max(most, std::max<int>(v.wide, v.high));
        return most;
    };
    const int atRest = largest(far.draw(0)), blending = largest(quick.draw(0));
    note("default: half a scale up to %.2f units at rest, %.2f blending", atRest / 256.0, blending / 256.0);
    CHECK(blending * 10 > atRest * 11);
    CHECK(atRest > 256 && atRest < 512);
}

TEST(overshoot_tolerance)
{
    for (bool printed : {false, true}) {
        // Two alike: the border lies half way between them.
        Scene scene = pair(24, 18, printed);
        scene.update();
        const SoftObject& ball = *scene.objects[0];  // the left one
        const Truth truth = scene.truth(0);
        int beyond = 0;
        double farthest = 0, strongest = -1;
        for (int i = 0; i < ball.seedSlots(); ++i) {
            if (!settled(scene, ball, i))
                continue;
            const Vec p = vec(ball.seedPoint(ball.seed(i)));
            beyond += p.x > 0;
            farthest = std::fmax(farthest, p.x);
            strongest = std::fmax(strongest, truth.part(1, p) - truth.part(0, p));
        }
        note("%s: %d seeds beyond the border, the farthest by %.2f units and %.4f of the field", printed ? "printed" : "default", beyond, farthest,
             strongest);
        // By default no more are wanted than keep the border closed.
        CHECK(beyond > (printed ? 5 : 1));
        // Not far, though: that ground is the other's.
        CHECK(farthest < 2 * 4);
        if (printed)
            CHECK(strongest <= number(printed::OVERSHOOT) + 0.002);
    }
}

TEST(oversampled_seeds_take_part_where_positions_part)
{
    // As printed: exactly where S and N differ by more than the tolerance.
    Scene scene = pair(20, 19, true);
    scene.update();
    int active = 0;
    for (size_t o = 0; o < 2; ++o) {
        const SoftObject& ball = *scene.objects[o];
        for (int i = 0; i < ball.seedSlots(); i += 2) {
            const Seed& s = ball.seed(i);
            const bool wanted = s.neighbour >= 0 && absolute(s.position - ball.seed(s.neighbour).position) > printed::OVERSAMPLE;
            CHECK(((ball.seed(i + 1).flags & SEED_ACTIVE) != 0) == wanted);
            active += wanted;
        }
    }
    CHECK(active > 10);
    note("printed: %d active", active);
    for (bool printed : {false, true}) {
        // None at rest; some where it blends, and they are drawn; none after it has come apart again.
        Scene far = pair(20, 60, printed);
        far.update();
        SAME(activeSeeds(far), 0);
        Scene near = pair(20, 19, printed);
        near.update();
        const int there = activeSeeds(near);
        // As printed, wherever positions differ; by default, only beside what is inside or far apart.
        CHECK(there > (printed ? 10 : 1));
        int drawn = 0;
        for (size_t o = 0; o < 2; ++o)
            for (int i = 1; i < near.objects[o]->seedSlots(); i += 2)
                drawn += settled(near, *near.objects[o], i);
        note("%s: %d active, %d drawn", printed ? "printed" : "default", there, drawn);
        CHECK(drawn > (printed ? 5 : 0));
        near.objects[0]->moveTo(point(-40, 0, 0));
        near.update();
        SAME(activeSeeds(near), 0);
    }
}

TEST(brightness_changes_across_scales_as_over_the_surface)
{
    // Where a pair bends sharply: against brightness a little beside the seed, on the plane that touches the surface there.
    // Ways across the picture are taken to be those of the viewing axis, and no longer than twice as long on the surface.
    double sum = 0, off = 0;
    int changing = 0, wrongWay = 0;
    for (double distance = 11; distance < 20; distance += 0.5) {
        Scene scene = pair(20, distance, false);
        scene.update();
        for (size_t o = 0; o < 2; ++o) {
            const SoftObject& ball = *scene.objects[o];
            const Truth truth = scene.truth(o);
            for (int i = 0; i < ball.seedSlots(); ++i) {
                const Seed& s = ball.seed(i);
                if (!(s.flags & SEED_FRONT) || (s.voxel.slopeX | s.voxel.slopeY) == 0)
                    continue;
                const Vec p = vec(ball.seedPoint(s)), n = truth.normal(p), way = p - vec(toVector(scene.eye));
                const double cosine = -dot(n, way) / size(way);
                if (cosine < 0.55)
                    continue;
                const auto change = [&](const Vec& across) {
                    const Vec along = across + way * (-dot(n, across) / dot(n, way));
                    const double h = 0.02, here = dot(truth.normal(p + along * h), vec(scene.light)),
                                 there = dot(truth.normal(p - along * h), vec(scene.light));
                    return 63 * (here - there) / (2 * h);
                };
                const double x = change({1, 0, 0}), y = change({0, 1, 0}), ourX = s.voxel.slopeX / 8.0, ourY = s.voxel.slopeY / 8.0;
                // Those that were limited are too small.
                const double corner = (std::fabs(x) * s.voxel.wide + std::fabs(y) * s.voxel.high) / 256;
                wrongWay += x * ourX + y * ourY <= 0;
                ++changing;
                if (corner > SHADING_MOST)
                    continue;
                sum += std::hypot(x, y);
                off += std::hypot(x - ourX, y - ourY);
            }
        }
    }
    note("%d scales, %d of them the wrong way, off by %.1f%%", changing, wrongWay, 100 * off / sum);
    CHECK(changing > 20);
    SAME(wrongWay, 0);
    CHECK(off < 0.2 * sum);
}

// --- Drawing

TEST(drawing_in_parts)
{
    // However little room there is for voxels at a time, they are the same.
    for (bool printed : {false, true}) {
        Scene scene = pair(30, 26, printed);
        scene.update();
        const std::vector<Voxel> whole = scene.draw(0, VOXELS_AT_ONCE);
        CHECK(whole.size() > 200);
        for (int room : {DRAW_ROOM, DRAW_ROOM + 1, 100, 333}) {
            CHECK(identical(whole, scene.draw(0, room)));
        }
    }
}

TEST(seeds_at_rest_lie_as_the_viewer_sees_them)
{
    // Their scales are kept while the viewer moves little. However slowly he goes on, they are never far from what they
    // would be made anew: compared with a scene that he has just come to.
    for (double step : {0.006, 0.013, 0.1, 3.0}) {
        Scene scene;
        const SoftObject& ball = scene.ball(20, 0, 0, 0);
        scene.eye = point(-20, 5, -70);
        scene.update();
        double worstSize = 0, worstTilt = 0, worstPlace = 0;
        long compared = 0, apart = 0, draws = 0;
        const int frames = static_cast<int>(40 / step);
        for (int frame = 0; frame < frames; ++frame) {
            scene.eye.x += real(step);
            scene.draw(0);
            ++draws;
            if (frame % (frames / 10 > 0 ? frames / 10 : 1) != 0 && frame != frames - 1)
                continue;
            Scene fresh;
            const SoftObject& other = fresh.ball(20, 0, 0, 0);
            fresh.eye = scene.eye;
            fresh.update();
            fresh.draw(0);
            constexpr int SHOWN = SEED_VALID | SEED_KEPT | SEED_FRONT;
            for (int i = 0; i < ball.seedSlots(); i += 2) {
                const Seed& a = ball.seed(i);
                const Seed& b = other.seed(i);
                const bool shown = (a.flags & SHOWN) == SHOWN, known = (b.flags & SHOWN) == SHOWN;
                if (!shown && !known)
                    continue;
                ++compared;
                if (shown != known) {
                    ++apart;
                    continue;
                }
                SAME(a.voxel.brightness, b.voxel.brightness);
                // Where a ring runs aslant its band may be covered by wide scales or by high ones.
                worstSize = std::fmax(worstSize, std::abs(a.voxel.wide + a.voxel.high - b.voxel.wide - b.voxel.high) / 256.0);
                worstPlace = std::fmax(worstPlace, size(Vec{double(a.voxel.x - b.voxel.x), double(a.voxel.y - b.voxel.y), double(a.voxel.z - b.voxel.z)}) / 256);
                // Where the surface bends away the tilt changes fast, and no matter: scales are cut short there.
                if (std::abs(b.voxel.tiltX) < 512 && std::abs(b.voxel.tiltY) < 512)
                    worstTilt = std::fmax(worstTilt, std::fmax(std::abs(a.voxel.tiltX - b.voxel.tiltX), std::abs(a.voxel.tiltY - b.voxel.tiltY)) / 256.0);
            }
        }
        note("%g units a frame: scales of %ld seeds within %.3f units of size, %.3f of place, %.3f of tilt; %.1f%% only in one",
             step, compared, worstSize, worstPlace, worstTilt, 100.0 * apart / compared);
        CHECK(compared > 1000);
        CHECK(worstSize < 0.6);
        CHECK(worstPlace < 1);
        CHECK(worstTilt < 0.4);
        CHECK(apart * 20 < compared);
    }
}

namespace {

// What object `o` shows in two scenes: seeds shown in one only, and in both but with other voxels; the worst of sizes.
struct Apart {
    int shown = 0, one = 0, other = 0;
    double worst = 0;
};
Apart compare(Scene& a, Scene& b, size_t o, int wanted, int unwanted)
{
    constexpr int SHOWN = SEED_VALID | SEED_KEPT | SEED_FRONT;
    a.draw(o);
    b.draw(o);
    Apart apart;
    for (int i = 0; i < a.objects[o]->seedSlots(); ++i) {
        const Seed& s = a.objects[o]->seed(i);
        const Seed& t = b.objects[o]->seed(i);
        if (!takesPart(*a.objects[o], i) || !takesPart(*b.objects[o], i) || (t.flags & wanted) != wanted || (t.flags & unwanted))
            continue;
        const bool inA = (s.flags & SHOWN) == SHOWN, inB = (t.flags & SHOWN) == SHOWN;
        apart.shown += inA || inB;
        if (inA != inB)
            ++apart.one;
        else if (inA && std::memcmp(&s.voxel, &t.voxel, offsetof(Voxel, brightness) + 1) != 0)
            ++apart.other;
        if (inA && inB)
            apart.worst = std::fmax(apart.worst, std::fmax(std::abs(s.voxel.wide - t.voxel.wide), std::abs(s.voxel.high - t.voxel.high)) / 256.0);
    }
    return apart;
}

}  // namespace

TEST(what_was_kept_of_a_seed_goes_when_it_changes)
{
    // Seen again and again on the way, or at the end only: what is drawn is the same.
    for (int kind = 0; kind < 2; ++kind) {
        Scene often, once;
        for (Scene* scene : {&often, &once})
            scene->add(kind == 0 ? static_cast<SoftObject*>(new Sphere(1, Real(20))) : new Stick(1, 14, 12), 5, -3, 10);
        const auto both = [&](auto change) {
            for (Scene* scene : {&often, &once})
                change(*scene, *scene->objects[0]);
            often.update();
            often.draw(0);
        };
        both([](Scene&, SoftObject&) {});
        const auto same = [&] {
            once.update();
            const Apart apart = compare(often, once, 0, 0, 0);
            CHECK(apart.shown > 40);
            SAME(apart.one, 0);
            SAME(apart.other, 0);
            CHECK(identical(often.draw(0), once.draw(0)));
        };
        both([](Scene&, SoftObject& o) { o.rotate(o.centre(), vector(0.2, 1, 0.3), 0x10000000u); });
        same();
        both([](Scene& s, SoftObject& o) { s.light = unit(vector(-1, 0.2, -1)), o.shadeRest(s.light); });
        same();
        both([](Scene&, SoftObject& o) { o.scale(real(1.1)); });
        same();
        both([](Scene&, SoftObject& o) { o.translate(vector(30, 10, 20)); });
        both([](Scene&, SoftObject& o) { o.scale(real(0.6)); });
        both([](Scene& s, SoftObject& o) { CHECK(o.resample(real(2.5))), o.shadeRest(s.light); });
        same();
    }
    // A neighbour comes and goes: what is at rest again lies as if it had always been.
    Scene visited = pair(20, 60, false), alone = pair(20, 60, false);
    visited.update();
    visited.draw(0);
    for (int step = 0; step < 40; ++step) {
        visited.objects[1]->translate(vector(step < 20 ? -2 : 0.25, 0.02, 0));
        visited.update();
        visited.draw(0);
    }
    alone.objects[1]->moveTo(visited.objects[1]->centre());
    alone.update();
    const Apart back = compare(visited, alone, 0, SEED_VALID, SEED_PLACED);
    CHECK(back.shown > 100);
    SAME(back.one, 0);
    SAME(back.other, 0);
    // Two that move together past the viewer.
    Scene moving = pair(20, 19, false), moved = pair(20, 19, false);
    for (int step = 0; step < 100; ++step) {
        moving.update();
        moving.draw(0);
        moving.draw(1);
        for (auto& object : moving.objects)
            object->translate(vector(0.5, 0.3, -0.4));
    }
    for (size_t o = 0; o < 2; ++o)
        moved.objects[o]->moveTo(moving.objects[o]->centre());
    moving.update();
    moved.update();
    const Apart apart = compare(moving, moved, 0, SEED_PLACED, 0);
    note("two move together: of %d placed seeds shown %d only in one, sizes within %.3f units", apart.shown, apart.one, apart.worst);
    CHECK(apart.shown > 30);
    CHECK(apart.one * 10 < apart.shown);
    CHECK(apart.worst < 0.6);
}

TEST(how_much_of_a_cells_depth_shows)
{
    // x / depth and y / depth of places about a root: exact near the viewer, with one depth for all where he is far.
    Random random;
    double worstNear = 0, worstFar = 0;
    int near = 0, far = 0;
    for (int i = 0; i < 200000; ++i) {
        const double reach = random.between(1, 100), x = random.between(-400, 400), y = random.between(-400, 400);
        const double z = random.below(4) ? random.between(0, 500) : random.between(-300, 60);
        const Vec out{random.between(-0.57, 0.57) * reach, random.between(-0.57, 0.57) * reach, random.between(-0.57, 0.57) * reach};
        Skew skew;
        skew.root(vector(x, y, z), real(reach));
        const Vector place = vector(out.x, out.y, out.z);
        NEAR(skew.depth(place) / 32.0, z + out.z, 0.07);
        const auto limited = [](double s) { return s > 4 ? 4 : s < -4 ? -4 : s; };
        const double depth = std::fmax(z + out.z, 1);
        const double sideways[2] = {limited((x + out.x) / depth), limited((y + out.y) / depth)};
        const double got[2] = {skew.x(place) / 256.0, skew.y(place) / 256.0};
        for (int axis = 0; axis < 2; ++axis) {
            // Lengths have 5 bits of fraction and their inverse as many as fit.
            const double doubt = 0.016 + 0.04 / depth * (1 + std::fabs(sideways[axis])) + 0.02 * std::fabs(sideways[axis]);
            const double error = std::fabs(got[axis] - sideways[axis]);
            CHECK(std::fabs(got[axis]) <= 5);
            if (z < 2 * reach - 0.2 || z < 3.8) {
                ++near;
                worstNear = std::fmax(worstNear, error - doubt);
            } else if (z > 2 * reach + 0.2 && z > 4.2 && std::fabs(x) < 2 * z && std::fabs(y) < 2 * z) {
                ++far;
                // The depth of the root for that of the place.
                worstFar = std::fmax(worstFar, error - doubt - std::fabs(sideways[axis] * out.z / z));
            }
        }
    }
    CHECK(near > 10000 && far > 10000);
    NEAR(worstNear, 0, 0.001);
    NEAR(worstFar, 0, 0.001);
}

TEST(weights_and_missing_links)
{
    for (bool printed : {false, true}) {
        // A link without weight, and no link: each its own ball, even where they overlap.
        for (int kind = 0; kind < 2; ++kind) {
            Scene scene;
            scene.printed = printed;
            scene.ball(20, -7, 0, 0);
            scene.ball(20, 7, 0, 0);
            if (kind == 1)
                scene.link(0, 1, 0);
            scene.update();
            for (int i = 0; i < scene.objects[0]->seedSlots(); i += 2)
                if (settled(scene, *scene.objects[0], i))
                    NEAR(number(scene.objects[0]->seed(i).position), 1, 0.01);
        }
        for (double weight : {0.25, 0.5, 1.5, 2.0}) {
            Scene scene;
            scene.printed = printed;
            scene.ball(24, -11, 0, 0);
            scene.ball(20, 11, 0, 0);
            scene.link(0, 1, weight);
            scene.update();
            Error error;
            measure(scene, error, 0.02);
            CHECK(error.count > 100);
            if (!CHECK(error.beyond <= (printed ? static_cast<long>(scene.counts.unsettled) : 0)))
                note("%s, weight %g: %ld of %ld beyond, up to %.4f", printed ? "printed" : "default", weight, error.beyond, error.count, error.worst);
        }
    }
}

TEST(other_primitives_settle_too)
{
    // A stick through a ball: seeds of both on the surface of the two together.
    for (bool printed : {false, true}) {
        Scene scene;
        scene.printed = printed;
        Stick* stick = new Stick(1, 14, 12);
        scene.add(stick, -9, 0, 0);
        scene.ball(24, 8, 3, 0);
        scene.link(0, 1);
        double worst = 0;
        long count = 0, beyond = 0;
        for (int frame = 0; frame < 10; ++frame) {
            scene.counts = Counts{};
            scene.update();
            for (size_t o = 0; o < 2; ++o)
                for (int i = 0; i < scene.objects[o]->seedSlots(); ++i) {
                    if (!settled(scene, *scene.objects[o], i))
                        continue;
                    const Vec p = vec(scene.objects[o]->seedPoint(scene.objects[o]->seed(i)));
                    const Vec d = stick->b() - stick->a();
                    const double t = std::fmin(1, std::fmax(0, dot(p - stick->a(), d) / dot(d, d)));
                    const Vec e = p - (stick->a() + d * t), f = p - vec(scene.objects[1]->centre());
                    const double error = std::fabs(trueGeoff(dot(e, e) / 196) + trueGeoff(dot(f, f) / 576) - 0.5);
                    worst = std::fmax(worst, error);
                    ++count;
                    beyond += error > 0.02;
                }
            scene.objects[1]->translate(vector(-1, 0.2, 0.5));
            stick->rotate(stick->centre(), vector(0, 0.3, 1), 0x02000000u);
        }
        note("%s: %ld seeds within %.4f, %ld beyond", printed ? "printed" : "default", count, worst, beyond);
        CHECK(count > 3000);
        CHECK(beyond <= (printed ? count / 1000 : 0));
    }
}
