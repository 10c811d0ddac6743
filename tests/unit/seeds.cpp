// Tests of the layout of seeds (report, Appendix C): their number, their even distribution, and their neighbours.
#include <algorithm>
#include <cstring>

#include "model/cone.h"
#include "model/stop.h"
#include "model/torus.h"
#include "help.h"
#include "stick.h"
#include "test.h"

namespace {

// Slots of the first seed of each ring, and one past the last ring.
std::vector<int> rings(const SoftObject& object)
{
    std::vector<int> starts;
    for (int i = 0; i < object.seedSlots(); i += 2)
        if (i == 0 || object.seed(i).path.y != object.seed(i - 2).path.y)
            starts.push_back(i);
    starts.push_back(object.seedSlots());
    return starts;
}

// The number of seeds of a sphere by the report's rings, in double precision.
void expected(double radius, double spacing, int* regular, int* first)
{
    const int n = static_cast<int>(std::ceil(M_PI * radius / spacing - 1e-6));
    *regular = 0;
    for (int k = 0; k < n; ++k) {
        const double latitude = -M_PI / 2 + M_PI * (k + 0.5) / n;
        const int count = std::max(4, static_cast<int>(std::floor(2 * M_PI * radius * std::cos(latitude) / spacing)));
        *regular += count;
        if (k == 0)
            *first = count;
    }
}

// The share of seeds whose nearest neighbour is at the distance of the spacing within 35%.
double evenness(const SoftObject& object, double spacing)
{
    std::vector<Vec> points;
    for (int i = 0; i < object.seedSlots(); i += 2)
        points.push_back(vec(object.seedPoint(object.seed(i))));
    std::sort(points.begin(), points.end(), [](const Vec& a, const Vec& b) { return a.y < b.y; });
    size_t good = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        double nearest = 1e9;
        for (size_t j = i + 1; j < points.size() && points[j].y - points[i].y < 2 * spacing; ++j)
            nearest = std::fmin(nearest, size(points[i] - points[j]));
        for (size_t j = i; j-- > 0 && points[i].y - points[j].y < 2 * spacing;)
            nearest = std::fmin(nearest, size(points[i] - points[j]));
        good += std::fabs(nearest - spacing) <= 0.35 * spacing;
    }
    return static_cast<double>(good) / static_cast<double>(points.size());
}

}  // namespace

TEST(the_report_s_counts)
{
    Model model;
    CHECK(model.makeFourSpheres());
    CHECK(model.resample(Real(2), makeEngine));
    SAME(model.count(), 4);
    const int counts[] = {316, 496, 716, 968};
    const int sizes[] = {20, 25, 30, 35};
    for (int i = 0; i < 4; ++i) {
        SAME(model.actor(i).object->seeds(), counts[i]);
        NEAR(number(model.actor(i).object->size()), sizes[i], 0);
        NEAR(number(model.actor(i).object->radius()), sizes[i] / 2.0, 0);
    }
    SAME(model.seeds(), 2496);
    SAME(model.oversampledSeeds(), 2480);
}

TEST(counts_at_every_spacing)
{
    for (double spacing : {0.25, 0.3, 0.5, 0.75, 1.0, 1.3, 2.0, 3.0, 4.0, 6.5, 8.0}) {
        for (double size : {20.0, 25.0, 30.0, 35.0}) {
            Scene scene;
            const SoftObject& ball = scene.ball(size, 0, 0, 0, spacing);
            int regular, first = 0;
            expected(size / 2, number(real(spacing)), &regular, &first);
            // A ring whose length is a whole number of spacings may be rounded either way; this happens in a few of many rings.
            const int slack = static_cast<int>(size / 2 / spacing / 5);
            NEAR(ball.seeds(), regular, slack);
            SAME(ball.seeds() - ball.oversampledSeeds(), first);
            SAME(ball.seedSlots(), 2 * ball.seeds());
        }
    }
}

TEST(seeds_rest_on_the_unblended_surface)
{
    for (double spacing : {0.5, 2.0, 8.0}) {
        Scene scene;
        const SoftObject& ball = scene.ball(25, 3, -4, 5, spacing);
        const Truth truth = scene.truth(0);
        for (int i = 0; i < ball.seedSlots(); ++i) {
            const Seed& s = ball.seed(i);
            if ((i & 1) != 0 && ball.seed(i - 1).neighbour < 0)
                continue;  // seeds of the first ring have no oversampled one
            NEAR(size(vec(s.path)), 12.5, 40 * STEP + EXACT * 100 + 1e-6);
            SAME(s.root, 0);
            NEAR(number(s.position), (i & 1) == 0 ? 1 : number(s.position), 0);
            const Vec rest = vec(ball.centre()) + vec(s.path);
            NEAR(truth.field(rest), 0.5, 1e-5 + 40 * STEP / 12.5);
            NEAR(s.normal.x / 16384.0, number(s.path.x) / 12.5, 1.0 / 250);
            NEAR(s.normal.y / 16384.0, number(s.path.y) / 12.5, 1.0 / 250);
            NEAR(s.normal.z / 16384.0, number(s.path.z) / 12.5, 1.0 / 250);
        }
    }
}

TEST(seeds_are_even)
{
    double worst = 1;
    for (double spacing : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
        for (double size : {20.0, 25.0, 30.0, 35.0, 60.0}) {
            if (size / spacing > 80)
                continue;
            Scene scene;
            const double share = evenness(scene.ball(size, 0, 0, 0, spacing), spacing);
            worst = std::fmin(worst, share);
            if (!CHECK(share >= 0.99))
                note("size %g spacing %g: %.4f", size, spacing, share);
        }
    }
    note("at least %.2f%% of the seeds have their nearest neighbour within 35%% of the spacing", worst * 100);
}

TEST(every_point_has_a_seed_near_it)
{
    // An even distribution also leaves out no part of the sphere.
    Random random;
    Scene scene;
    const SoftObject& ball = scene.ball(35, 0, 0, 0, 2);
    for (int k = 0; k < 2000; ++k) {
        const Vec p = vec(withLength(vector(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)), Real(17.5)));
        double nearest = 1e9;
        for (int i = 0; i < ball.seedSlots(); i += 2)
            nearest = std::fmin(nearest, size(p - vec(ball.seed(i).path)));
        CHECK(nearest < 2 * 0.85);
    }
}

TEST(neighbour_rule_of_the_oversampled_seeds)
{
    // "The neighbor of seed S on ring K [is] the seed N on ring K-1 that is closest to S's successor. The new oversampled
    // seed O is interpolated halfway between S and N." Here by looking at every seed of the ring.
    for (double spacing : {0.7, 2.0, 5.0}) {
        for (double radius : {20.0, 35.0}) {
            Scene scene;
            const SoftObject& ball = scene.ball(radius, 0, 0, 0, spacing);
            const std::vector<int> starts = rings(ball);
            int extra = 0;
            for (size_t k = 0; k + 1 < starts.size(); ++k) {
                for (int i = starts[k]; i < starts[k + 1]; i += 2) {
                    const Seed& s = ball.seed(i);
                    if (k == 0) {
                        SAME(s.neighbour, -1);
                        continue;
                    }
                    ++extra;
                    CHECK(s.neighbour >= starts[k - 1] && s.neighbour < starts[k] && s.neighbour % 2 == 0);
                    const int after = i + 2 == starts[k + 1] ? starts[k] : i + 2;
                    const Vec target = vec(ball.seed(after).path);
                    double nearest = 1e9;
                    for (int j = starts[k - 1]; j < starts[k]; j += 2)
                        nearest = std::fmin(nearest, size(vec(ball.seed(j).path) - target));
                    // Two seeds may be equally near.
                    NEAR(size(vec(ball.seed(s.neighbour).path) - target), nearest, 2e-3);
                    const Vec middle = (vec(s.path) + vec(ball.seed(s.neighbour).path)) * 0.5;
                    const Vec o = vec(ball.seed(i + 1).path);
                    NEAR(size(o - middle * (radius / 2 / size(middle))), 0, 1e-3);
                }
            }
            SAME(extra, ball.oversampledSeeds());
        }
    }
}

TEST(roots_are_shared)
{
    // All seeds of a sphere have one root, and so have those of each cap of the stick. The root of an oversampled seed between two
    // roots is the point of the core nearest to the midpoint of the two seeds, so that its path is perpendicular to the core.
    Scene scene;
    const SoftObject& ball = scene.ball(30, 1, 2, 3);
    for (int i = 0; i < ball.seedSlots(); ++i)
        SAME(ball.seed(i).root, 0);
    Stick* stick = new Stick(2, 12, 10);
    scene.add(stick, 0, 0, 0);
    const int left = stick->seed(0).root;
    int inCap = 0;
    for (int i = 0; i < stick->seedSlots(); i += 2)
        inCap += stick->seed(i).root == left;
    CHECK(inCap > 20);
    for (int i = 0; i < stick->seedSlots(); i += 2) {
        const Seed& s = stick->seed(i);
        if (s.neighbour < 0)
            continue;
        const Seed& n = stick->seed(s.neighbour);
        const Seed& o = stick->seed(i + 1);
        const auto root = [&](const Seed& seed) { return vec(stick->seedPoint(seed)) - vec(seed.path) * number(seed.position); };
        if (s.root == n.root) {
            SAME(o.root, s.root);
        } else {
            const Vec middle = (root(s) + vec(s.path) + root(n) + vec(n.path)) * 0.5;
            // The core lies along the x axis, 10 to each side.
            NEAR(size(Vec{std::clamp(middle.x, -10.0, 10.0), 0, 0} - root(o)), 0, 1e-3);
        }
        NEAR(size(vec(o.path)), 6, 20 * STEP + EXACT * 100 + 1e-6);
    }
}

TEST(resampling_keeps_the_place)
{
    Scene scene;
    SoftObject& ball = scene.ball(20, 7, 8, 9, 2);
    CHECK(ball.resample(Real(4), makeEngine));
    const int coarse = ball.seeds();
    CHECK(coarse < 100);
    CHECK(ball.recalc());
    CHECK(ball.centre() == point(7, 8, 9));
    NEAR(size(vec(ball.seedPoint(ball.seed(0))) - vec(ball.centre())), 10, 1e-3);
    CHECK(ball.resample(Real(2), makeEngine));
    SAME(ball.seeds(), 316);
    NEAR(number(ball.spacing()), 2, 0);
}

TEST(thin_objects_have_closer_seeds)
{
    Model model;
    Actor described;
    described.kind = kindNamed("sphere");
    const double sizes[] = {20, 9, 6, 3};
    for (double size : sizes) {
        described.measure[0] = real(size);
        CHECK(model.addItem(described) != nullptr);
    }
    for (double spacing : {2.0, 1.0, 4.0}) {
        CHECK(model.resample(real(spacing), makeEngine));
        // Thin objects have a finer spacing: one 6 thick has as many seeds around it as one 9 thick. No spacing is less than half.
        const double expected[] = {1, 1, 6 / 9.0, 0.5};
        int seeds = 0;
        for (int i = 0; i < 4; ++i) {
            NEAR(number(model.actor(i).object->spacing()), spacing * expected[i], 1e-3);
            seeds += model.actor(i).object->seeds();
        }
        SAME(model.seedsAt(real(spacing)), seeds);
        NEAR(model.actor(1).object->seeds(), model.actor(2).object->seeds(), 1);
        NEAR(number(model.coarsest()), spacing, 0);
        NEAR(number(model.coarsestAsked()), spacing, 1e-3);
    }
    CHECK(model.actor(3).object->resample(Real(3), makeEngine));
    NEAR(number(model.coarsestAsked()), 6, 1e-3);
    // An object that is added later.
    described.measure[0] = real(6);
    CHECK(model.addItem(described) != nullptr);
    NEAR(number(model.actor(4).object->spacing()), 4 * 6 / 9.0, 1e-3);
    // A flat object is as thin as it is flat.
    described.measure[0] = real(12);
    described.stretch = {real(1), real(0.5), real(1.4)};
    CHECK(model.addItem(described) != nullptr);
    NEAR(number(model.actor(5).object->spacing()), 4 * 6 / 9.0, 1e-3);
}

TEST(seeds_for_a_hollow_are_laid_out_after_a_stop_too)
{
    Model model;
    Actor described;
    described.kind = kindNamed("sphere");
    for (double size : {30, 20}) {
        described.measure[0] = real(size);
        CHECK(model.addItem(described) != nullptr);
    }
    SoftObject &dented = *model.actor(0).object, &digger = *model.actor(1).object;
    CHECK(model.link(&dented, &digger, Real(1)) && model.dent(&dented, &digger, Real(1)));
    CHECK(model.resample(Real(2), makeEngine) && model.prepareBodies() != nullptr);
    // Without the link the second ball only digs. The user stops the layout of its seeds for the hollow.
    model.unlink(&dented, &digger);
    stopSource = [] { return true; };
    CHECK(model.prepareBodies() == nullptr && digger.laidInVain());
    stopSource = nullptr;
    CHECK(model.prepareBodies() != nullptr && !digger.laidInVain());
    NEAR(size(vec(digger.regular(0).path)), number(digger.laidRadius()), 1e-3);
}

TEST(equal_objects_have_equal_seeds)
{
    // Seeds are copied from an object of the same kind, measures and size if there is one; the result must be the same.
    for (const char* kind : {"sphere", "torus", "cone", "box"}) {
        Model model;
        Actor described;
        described.kind = kindNamed(kind);
        const double measures[] = {20, 30, 12, 8};
        for (int i = 0; i < MEASURES_MOST; ++i)
            described.measure[i] = real(measures[i]);
        CHECK(model.addItem(described) != nullptr && model.addItem(described) != nullptr);
        // The third object differs.
        described.measure[0] = Real(24);
        CHECK(model.addItem(described) != nullptr);
        for (double spacing : {2.0, 1.5}) {
            CHECK(model.resample(real(spacing), makeEngine));
            SoftObject& copy = *model.actor(1).object;
            SoftObject* const alone = described.kind->make(9, model.actor(1).measure);
            CHECK(alone != nullptr && alone->resample(real(spacing), makeEngine));
            SAME(copy.seeds(), alone->seeds());
            SAME(copy.oversampledSeeds(), alone->oversampledSeeds());
            SAME(copy.rings(), alone->rings());
            int unlike = 0;
            for (int i = 0; i < copy.seedSlots(); ++i) {
                const Seed &a = copy.seed(i), &b = alone->seed(i);
                unlike += !(a.path == b.path) || !(copy.root(a.root) == alone->root(b.root)) || a.neighbour != b.neighbour ||
                          a.normal.x != b.normal.x || a.normal.y != b.normal.y || a.flags != b.flags;
            }
            SAME(unlike, 0);
            CHECK(model.actor(2).object->seeds() != copy.seeds());
            destroy(alone);
        }
    }
}

TEST(what_limits_a_spacing_is_told_for_whichever_object)
{
    // The second object has too many roots; the first gets its old seeds again.
    Model model;
    CHECK(model.add(make<Sphere>(1, Real(20)), {255, 0, 0}, Motion{}));
    CHECK(model.add(make<Torus>(2, Real(20), Real(40)), {0, 0, 255}, Motion{}));
    CHECK(model.resample(Real(2), makeEngine));
    const int seeds = model.seeds();
    CHECK(!model.resample(real(0.25), makeEngine));
    CHECK(std::strstr(SoftObject::resampleTrouble(), "object 2") != nullptr);
    CHECK(std::strstr(SoftObject::resampleTrouble(), "is the limit") != nullptr);
    SAME(model.seeds(), seeds);
}

TEST(oversampled_seeds_need_no_memory_until_they_are_needed)
{
    Scene scene;
    SoftObject& ball = scene.ball(20, 0, 0, 0, 2);
    int laid = 0;
    for (int i = 0; i < ball.seedSlots(); i += 2)
        laid += ball.extra(i) != nullptr;
    SAME(laid, 0);
    // One of them, and those beside it.
    const int slot = ball.seedSlots() / 2 | 1;
    CHECK(&ball.seed(slot) == ball.extra(slot) && ball.extra(slot) == ball.extra(slot - 1));
    for (int i = 0; i < ball.seedSlots(); i += 2)
        laid += ball.extra(i) != nullptr;
    CHECK(laid >= 1 && laid <= 8);
    CHECK(ball.layOutExtras());
    for (int i = 0; i < ball.seedSlots(); i += 2)
        CHECK(ball.extra(i) != nullptr);
}

TEST(an_oversampled_seed_of_a_warped_object_finds_back_to_its_place)
{
    Scene scene;
    SoftObject& cone = scene.add(new Cone(1, real(16), real(10), real(30)), 0, 0, 0, 2);
    cone.setWarp({{real(0.3), real(40), real(50)}});
    int lost = 0, moved = 0;
    for (int i = 0; i < cone.seedSlots() - 2; i += 2) {
        const int neighbour = cone.regular(i).neighbour, next = i + 2;
        if (neighbour < 0 || neighbour == next || cone.regular(i).root != cone.regular(next).root)
            continue;
        const Vec before = vec(cone.root(cone.seed(i + 1).root) + cone.seed(i + 1).path);
        moved += cone.layOutBetween(i, next) && cone.layOutBetween(i, neighbour);
        lost += size(vec(cone.root(cone.seed(i + 1).root) + cone.seed(i + 1).path) - before) > 1e-3;
    }
    CHECK(moved > 100);
    SAME(lost, 0);
}

TEST(oversampled_seeds_lie_beside_theirs_where_a_ring_begins_without_a_neighbour)
{
    int headless = 0;
    for (int tip = 20; tip <= 40; ++tip) {
        Scene scene;
        SoftObject& cone = scene.add(new Cone(1, real(6), real(tip), real(100)), 0, 0, 0, 6);
        cone.setStretch({real(0.3), real(0.5), real(0.6)});
        CHECK(cone.resample(real(6), makeEngine) && cone.layOutExtras());
        const auto place = [&](const Seed& s) { return vec(cone.root(s.root) + s.path); };
        bool begins = false;  // the ring has begun without a neighbour
        double farthest = 0;
        for (int i = 2; i < cone.seedSlots(); i += 2) {
            const Seed& s = cone.regular(i);
            if (s.root != cone.regular(i - 2).root)
                begins = s.neighbour < 0;
            if (s.neighbour < 0)
                continue;
            headless += begins;
            farthest = std::fmax(farthest, size(place(cone.seed(i + 1)) - place(s)));
        }
        CHECK(farthest < 2 * number(cone.spacing()));
    }
    note("%d seeds in such rings", headless);
    CHECK(headless > 0);
}

TEST(no_cell_of_a_cone_reaches_across_a_corner)
{
    const double sizes[][3] = {{30, 6, 30}, {12, 30, 20}, {22, 10, 24}, {9, 26, 40}};
    for (const auto& size : sizes)
        for (double spacing : {1.0, 2.0, 3.0}) {
            Scene scene;
            SoftObject& cone = scene.add(new Cone(1, real(size[0]), real(size[1]), real(size[2])), 0, 0, 0, spacing);
            const double corner = number(cone.coreReach());
            double farthest = -1e9;
            for (int i = 0; i < cone.seedSlots(); i += 2) {
                const Seed& s = cone.seed(i);
                // Half of the cell along the axis. Cells are made 4 % larger than needed.
                const double half = std::fabs(s.across[1] * number(cone.spacing()) / 64) / 1.04;
                const double height = std::fabs(number(cone.root(s.root).y) + number(s.path.y));
                const bool onEnd = std::fabs(number(s.path.y)) > 0.001;
                farthest = std::fmax(farthest, (onEnd ? corner - height : height - corner) + half);
            }
            note("size %g tip %g length %g, spacing %g: cells end %.3f spacings beyond the corners at most", size[0], size[1],
                 size[2], spacing, farthest / spacing);
            CHECK(farthest < 0.06 * spacing);
        }
}
