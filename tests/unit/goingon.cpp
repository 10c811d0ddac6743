// Tests of patches that blend and whose voxels go on: what moves evenly stays near the truth and need not be settled, and what does
// not is found anew at once.
#include "help.h"
#include "model/stop.h"
#include "test.h"

namespace {

// How far voxels are from the nearest ones of a scene without a past, units, and by how much their brightness and its slopes differ
// (Voxel::slopeX, slopeY).
struct Distance {
    double sum = 0, worst = 0, light = 0, slopes = 0;
    long count = 0;

    void add(const std::vector<Voxel>& voxels, const std::vector<Voxel>& fresh)
    {
        for (const Voxel& v : voxels) {
            const Apart apart = fromNearest(v, fresh);
            sum += apart.distance;
            light += apart.light;
            slopes += apart.slopes;
            worst = std::fmax(worst, apart.distance);
            ++count;
        }
    }
};

// A ball, and another one that blends with it at a place that a function gives for each frame.
struct Pair {
    Scene scene;
    SoftObject* other;

    explicit Pair(const Vec& at, double spacing = 2, double weight = 1)
    {
        scene.ball(30, 0, 0, 0, spacing);
        other = &scene.ball(24, at.x, at.y, at.z, spacing);
        scene.link(0, 1, weight);
    }
    // A frame, as the program makes it: the voxels of both objects. `updated` receives how many seeds were settled.
    std::vector<Voxel> frame(uint32_t* updated)
    {
        scene.counts = Counts{};
        scene.update();
        std::vector<Voxel> all = scene.draw(0);
        const std::vector<Voxel> more = scene.draw(1);
        all.insert(all.end(), more.begin(), more.end());
        *updated = scene.counts.updated;
        return all;
    }
};

// Plays frames and holds each from `from` on against a scene without a past. Returns the mean number of seeds settled in them;
// `all` receives that of the scenes without a past.
double play(int frames, int from, Vec (*at)(int), Distance& distance, double spacing = 2, double weight = 1, double* all = nullptr)
{
    Pair pair(at(0), spacing, weight);
    double settled = 0, settledAnew = 0;
    for (int i = 0; i < frames; ++i) {
        const Vec place = at(i);
        pair.other->moveTo(point(place.x, place.y, place.z));
        uint32_t updated, anew;
        const std::vector<Voxel> voxels = pair.frame(&updated);
        if (i < from)
            continue;
        settled += updated;
        Pair fresh(place, spacing, weight);
        distance.add(voxels, fresh.frame(&anew));
        settledAnew += anew;
    }
    if (all != nullptr)
        *all = settledAnew / (frames - from);
    return settled / (frames - from);
}

}  // namespace

TEST(what_blends_evenly_goes_on)
{
    // The same way in steps of a quarter of a unit, and to and fro, so that no step is like the one before.
    Distance even, torn;
    const double evenly = play(40, 10, [](int i) { return Vec{12 + i * 0.2, 4 + i * 0.15, -6}; }, even);
    const double toAndFro = play(40, 10, [](int i) { return Vec{12 + i % 2 * 4.0, 4 + i % 2 * 3.0, -6}; }, torn);
    note("settled: %.0f seeds of what moves evenly, %.0f of what does not; voxels are off by %.3f and %.3f on average, %.2f and "
         "%.2f at most; brightness by %.2f and %.2f, its slopes by %.1f and %.1f", evenly, toAndFro, even.sum / even.count,
         torn.sum / torn.count, even.worst, torn.worst, even.light / even.count, torn.light / torn.count, even.slopes / even.count,
         torn.slopes / torn.count);
    CHECK(evenly < 0.7 * toAndFro);
    CHECK(even.sum < 0.1 * even.count);
    CHECK(even.worst < 2.5);
    CHECK(even.light < 1.0 * even.count);
    CHECK(even.slopes < 3.0 * even.count);
    CHECK(torn.sum < 0.1 * torn.count);
}

TEST(what_blends_evenly_goes_on_between_fine_seeds)
{
    // There less of an error is tolerated, but the rounding of the brightness is none.
    Distance even, torn;
    const double evenly = play(30, 10, [](int i) { return Vec{12 + i * 0.1, 4 + i * 0.07, -6}; }, even, 1);
    const double toAndFro = play(30, 10, [](int i) { return Vec{12 + i % 2 * 4.0, 4 + i % 2 * 3.0, -6}; }, torn, 1);
    note("settled: %.0f seeds of what moves evenly, %.0f of what does not; voxels are off by %.3f on average, brightness by %.2f",
         evenly, toAndFro, even.sum / even.count, even.light / even.count);
    CHECK(evenly < 0.7 * toAndFro);
    CHECK(even.sum < 0.05 * even.count);
    CHECK(even.light < 0.5 * even.count);
}

TEST(what_blends_evenly_goes_on_although_a_link_is_heavy)
{
    // Nearer than where islands arise.
    Distance even;
    double all;
    const double evenly = play(30, 10, [](int i) { return Vec{12 + i * 0.1, 4 + i * 0.07, -6}; }, even, 2, 1.5, &all);
    note("settled: %.0f of %.0f seeds; voxels are off by %.3f on average", evenly, all, even.sum / even.count);
    CHECK(evenly < 0.5 * all);
    CHECK(even.count > 0 && even.sum < 0.1 * even.count);
}

TEST(what_shows_nothing_goes_on_however_the_viewer_moves)
{
    // The viewer goes to and fro, so that nothing changes evenly; the other ball comes nearer slowly.
    Pair pair({12, 4, -6});
    double settled = 0, all = 0;
    for (int i = 0; i < 30; ++i) {
        const Vec place{12 + i * 0.1, 4, -6};
        const auto look = [&](Pair& at, uint32_t* updated) {
            at.scene.eye = point(i % 2 * 3.0, 0, -120);
            at.other->moveTo(point(place.x, place.y, place.z));
            at.frame(updated);
        };
        uint32_t updated, anew;
        look(pair, &updated);
        Pair fresh(place);
        look(fresh, &anew);
        if (i < 10)
            continue;
        settled += updated;
        all += anew;
    }
    note("settled: %.0f of %.0f seeds", settled, all);
    CHECK(settled < 0.8 * all);
}

TEST(what_stops_or_leaps_is_found_anew)
{
    // After twenty even steps the ball stops, or leaps: from the frame after the next on, or at once, nothing is left of its way.
    Distance stopped, leapt;
    play(30, 25, [](int i) { return Vec{12 + std::min(i, 20) * 0.2, 4, -6}; }, stopped);
    play(22, 21, [](int i) { return i <= 20 ? Vec{12 + i * 0.2, 4, -6} : Vec{-10, 12, -8}; }, leapt);
    note("voxels are off by %.3f after a stop and by %.3f after a leap, %.2f and %.2f at most", stopped.sum / stopped.count,
         leapt.sum / leapt.count, stopped.worst, leapt.worst);
    CHECK(stopped.count > 0 && leapt.count > 0);
    CHECK(stopped.sum < 0.04 * stopped.count);
    CHECK(leapt.sum < 0.03 * leapt.count);
    CHECK(stopped.light < 0.3 * stopped.count);
    CHECK(leapt.light < 0.3 * leapt.count);
}

TEST(what_is_passed_fast_is_settled_in_each_frame)
{
    // The ball passes by, as evenly as it can, at nearly four units a frame, and reaches new patches in each; or at one unit.
    Distance fast, slow;
    double all, allSlow;
    const double settled = play(13, 3, [](int i) { return Vec{-24 + i * 3.8, 12, -9}; }, fast, 2, 1, &all);
    const double settledSlow = play(13, 3, [](int i) { return Vec{-6 + i * 1.0, 12, -9}; }, slow, 2, 1, &allSlow);
    note("settled: %.0f of %.0f seeds, passing slowly %.0f of %.0f; voxels are off by %.4f on average, brightness by %.3f", settled,
         all, settledSlow, allSlow, fast.sum / fast.count, fast.light / fast.count);
    CHECK(settled > 0.9 * all);
    CHECK(settledSlow < 0.9 * allSlow);
}

TEST(what_went_on_is_settled_in_the_end)
{
    // The objects stop, and nobody tells them that anything changes: what went on must be settled all the same.
    Pair pair({12, 4, -6});
    uint32_t updated;
    for (int i = 0; i < 21; ++i) {
        pair.other->moveTo(point(12 + i * 0.2, 4, -6));
        pair.frame(&updated);
    }
    std::vector<Voxel> voxels;
    for (int i = 0; i < 8; ++i)
        voxels = pair.frame(&updated);
    CHECK(updated == 0);
    Pair fresh({12 + 20 * 0.2, 4, -6});
    Distance distance;
    distance.add(voxels, fresh.frame(&updated));
    note("voxels are off by %.3f on average, %.2f at most", distance.sum / distance.count, distance.worst);
    CHECK(distance.count > 0 && distance.sum < 0.04 * distance.count);
}

TEST(what_moved_in_an_update_that_was_stopped_is_found_later)
{
    // A ball that digs into another leaps half a unit, the user stops the update, and nothing moves after that.
    const auto dented = [](const Vec& at) {
        Scene scene;
        scene.ball(30, 0, 0, 0);
        scene.ball(16, at.x, at.y, at.z);
        scene.dent(0, 1);
        return scene;
    };
    const Vec before{8, 4, -12}, after{8.4, 4.3, -12};
    Scene scene = dented(before), fresh = dented(after);
    for (int i = 0; i < 4; ++i) {
        scene.update();
        scene.draw(0);
    }
    scene.objects[1]->moveTo(point(after.x, after.y, after.z));
    stopSource = [] { return true; };
    scene.update();
    stopSource = nullptr;
    scene.draw(0);
    scene.update();
    fresh.update();
    const std::vector<Voxel> voxels = scene.draw(0), made = fresh.draw(0);
    Distance distance;
    distance.add(voxels, made);
    note("voxels are off by %.4f on average, %.2f at most", distance.sum / distance.count, distance.worst);
    SAME(voxels.size(), made.size());
    CHECK(distance.sum < 0.03 * distance.count);
}

TEST(what_goes_on_gets_no_brighter_than_the_light_allows)
{
    // A small ball goes past a large one, so that the surface between them turns fast. The light is that of the eye.
    Pair pair({-26, 30, -10});
    pair.scene.light = unit(vector(0, 0, -1));
    int brightest = 0;
    uint32_t updated;
    for (int i = 0; i < 80; ++i) {
        pair.other->moveTo(point(-26 + i * 0.65, 30, -10));
        for (const Voxel& v : pair.frame(&updated))
            brightest = std::max<int>(brightest, v.brightness);
    }
    note("the brightest step is %d", brightest);
    CHECK(brightest >= BRIGHTEST - 1 && brightest <= BRIGHTEST + 4);
}

TEST(what_turns_into_sight_is_shown)
{
    // The viewer goes round two balls that blend and rest, at several places. What a scene without a past shows is held against
    // what is shown.
    long shown = 0, missing = 0, settled = 0, anew = 0;
    for (const Vec& other : {Vec{12, 4, -6}, Vec{-14, 2, 5}, Vec{6, -12, 8}, Vec{2, 10, 12}, Vec{-8, -8, -8}}) {
        Pair pair(other);
        for (int i = 0; i < 60; ++i) {
            const double angle = (i - 30) * 0.02;
            const auto look = [&](Pair& at, uint32_t* updated) {
                at.scene.eye = point(120 * std::sin(angle), 10, -120 * std::cos(angle));
                for (auto& object : at.scene.objects)
                    object->setRecalc();
                return at.frame(updated);
            };
            uint32_t updated, all;
            const std::vector<Voxel> voxels = look(pair, &updated);
            if (i < 10)
                continue;
            Pair fresh(other);
            for (const Voxel& v : look(fresh, &all)) {
                ++shown;
                missing += fromNearest(v, voxels).distance > 1.5;
            }
            settled += updated;
            anew += all;
        }
    }
    note("%ld of %ld voxels are missing; %ld of %ld seeds were settled", missing, shown, settled, anew);
    CHECK(settled < anew / 2);
    CHECK(missing < shown / 250);
}

TEST(what_has_come_into_sight_does_not_go_on_like_what_has_gone)
{
    // The other ball goes past so fast that all seeds of some patches change from one frame to the next.
    Distance past;
    play(60, 5, [](int i) { return Vec{22 * std::cos(i * 0.1), 2, -12 + 10 * std::sin(i * 0.1)}; }, past);
    note("voxels are off by %.4f on average, %.2f at most", past.sum / past.count, past.worst);
    CHECK(past.sum < 0.042 * past.count);
}
