// Tests of kept voxels: those of what stands still are the same, byte for byte, whether they have been kept or are made in this
// frame, and those of what turns evenly go on near the truth.
#include <cstring>

#include "help.h"
#include "model/torus.h"
#include "test.h"

namespace {

constexpr int CHANGES = 7;

// Changes a scene of three balls, in one of CHANGES ways.
void change(Scene& scene, int which)
{
    switch (which) {
    case 0: break;
    case 1: scene.objects[1]->moveTo(point(17, 6, -9)); break;
    case 2: scene.eye = point(1, 0.5, -119); break;
    case 3: scene.light = unit(vector(0.4, 0.8, -0.4)); break;
    case 4: scene.objects[1]->setSize(real(23)); break;
    case 5:
        scene.objects[0]->unlink(scene.objects[1].get());
        scene.objects[1]->unlink(scene.objects[0].get());
        scene.found = false;
        break;
    case 6: scene.objects[2]->moveTo(point(-30, -20, 12)); break;
    }
    // What is seen or lit otherwise has to be updated, as in the program, for what was updated is drawn as it was seen then.
    for (size_t i = 0; i < scene.objects.size() && (which == 2 || which == 3); ++i)
        scene.objects[i]->setRecalc();
}

std::unique_ptr<Scene> balls()
{
    auto scene = std::make_unique<Scene>();
    scene->ball(30, 0, 0, 0);
    scene->ball(24, 15, 4, -8);
    scene->ball(26, -32, -20, 10);
    scene->link(0, 1);
    return scene;
}

// The voxels that a scene has after changes 0 to `last` and eight frames after each. If it is not `drawn` in these frames nothing
// can have been kept.
std::vector<Voxel> voxelsAfter(int last, bool drawn)
{
    const auto scene = balls();
    std::vector<Voxel> voxels;
    for (int which = 0; which <= last; ++which) {
        change(*scene, which);
        for (int frame = 0; frame < 8; ++frame) {
            scene->update();
            if (!drawn && (which < last || frame < 7))
                continue;
            voxels.clear();
            for (size_t i = 0; i < scene->objects.size(); ++i)
                for (const Voxel& v : scene->draw(i))
                    voxels.push_back(v);
        }
    }
    return voxels;
}

}  // namespace

TEST(what_stands_still_looks_the_same_whether_its_voxels_are_kept_or_not)
{
    std::vector<Voxel> before;
    for (int last = 0; last < CHANGES; ++last) {
        const std::vector<Voxel> kept = voxelsAfter(last, true), made = voxelsAfter(last, false);
        CHECK(made.size() > 400);
        CHECK(kept.size() == made.size() && memcmp(kept.data(), made.data(), made.size() * sizeof(Voxel)) == 0);
        // The change is seen.
        CHECK(before.size() != made.size() || memcmp(before.data(), made.data(), made.size() * sizeof(Voxel)) != 0);
        before = made;
    }
}

namespace {

// A torus that turns before each frame, held against one that is turned likewise, but only seen in that frame.
struct Turning {
    // How many voxels go on, and how many of these should have gone out of sight, as none is near; how far they are from where they
    // should be, units; and by how much their brightness differs.
    long moved = 0, all = 0, gone = 0;
    double worst = 0, sum = 0, light = 0;

    // It is judged from a frame on; `degrees` gives the turn before each frame.
    Turning(int frames, int judgedFrom, double (*degrees)(int))
    {
        Scene seen = torus();
        for (int i = 0; i < frames; ++i) {
            turn(seen, degrees(i));
            seen.update();
            const std::vector<Voxel> voxels = seen.draw(0);
            if (i < judgedFrom)
                continue;
            // The same turns, as each of them is rounded.
            Scene fresh = torus();
            for (int k = 0; k <= i; ++k)
                turn(fresh, degrees(k));
            fresh.update();
            judge(voxels, fresh.draw(0));
        }
    }

private:
    static Scene torus()
    {
        Scene scene;
        scene.add(new Torus(1, real(16), real(40)), 3, -2, 5);
        return scene;
    }
    static void turn(Scene& scene, double degrees)
    {
        if (degrees != 0)
            scene.objects[0]->rotate(point(3, -2, 5), unit(vector(1, 0.4, 0.3)),
                                     static_cast<Angle>(static_cast<int64_t>(degrees / 90 * QUARTER)));
    }
    void judge(const std::vector<Voxel>& voxels, const std::vector<Voxel>& made)
    {
        for (const Voxel& v : voxels) {
            ++all;
            const Apart apart = fromNearest(v, made);
            if (apart.distance == 0 && apart.light == 0)
                continue;
            ++moved;
            sum += apart.distance;
            light += apart.light;
            worst = std::fmax(worst, apart.distance);
            gone += apart.distance > 0.5;
        }
    }
};

}  // namespace

TEST(voxels_of_what_turns_evenly_go_on)
{
    const Turning even(30, 10, [](int) { return 1.6; });
    const Turning torn(30, 10, [](int i) { return i % 2 == 0 ? 3.0 : -1.5; });
    note("evenly: %ld of %ld voxels go on, off by %.3f units on average, %.2f at most, and by %.2f steps of brightness, %ld should "
         "have gone; unevenly: %ld of %ld", even.moved, even.all, even.sum / even.moved, even.worst, even.light / even.moved,
         even.gone, torn.moved, torn.all);
    CHECK(even.all > 5000 && torn.all > 5000);
    CHECK(even.moved > even.all / 10);
    CHECK(even.sum < 0.1 * even.moved);
    // A seed that turns out of sight may still be shown for a few frames: the next one is a spacing away.
    CHECK(even.worst < 2.2);
    CHECK(even.gone < even.moved / 1000);
    CHECK(even.light < even.moved);
    CHECK(torn.moved == 0);
}

TEST(what_turns_otherwise_or_stands_is_made_anew)
{
    // In the last frames it turns fast; or only faster than before; or it stands.
    const Turning fast(27, 25, [](int i) { return i < 25 ? 0.8 : 2.0 * (i - 23); });
    const Turning faster(27, 25, [](int i) { return i < 25 ? 0.8 : 1.4; });
    const Turning stopped(40, 32, [](int i) { return i < 30 ? 0.8 : 0.0; });
    CHECK(fast.all > 1000 && faster.all > 1000 && stopped.all > 2000);
    CHECK(fast.moved == 0 && faster.moved == 0 && stopped.moved == 0);
    // It has turned slowly and then stood, and turns on as slowly: the old steps do not count.
    const Turning one(24, 23, [](int i) { return i < 19 || i > 22 ? 0.07 : 0.0; });
    const Turning other(27, 26, [](int i) { return i < 22 || i > 25 ? 0.07 : 0.0; });
    CHECK(one.all > 500 && other.all > 500);
    CHECK(one.moved == 0 && other.moved == 0);
}

TEST(what_grows_has_no_old_extents)
{
    // A ball grows by a twenty-fifth of its size in each frame. Its scales keep their extents while they go on, and would part.
    Scene scene;
    SoftObject& ball = scene.ball(30, 0, 0, 0, 2);
    double size = 30, narrow = 1;
    long all = 0;
    for (int i = 0; i < 12; ++i) {
        size *= 1.04;
        ball.setSize(real(size));
        scene.update();
        const std::vector<Voxel> voxels = scene.draw(0);
        Scene fresh;
        SoftObject& other = fresh.ball(30, 0, 0, 0, 2);
        other.setSize(real(size));
        fresh.update();
        const std::vector<Voxel> made = fresh.draw(0);
        long area = 0, fits = 0;
        for (const Voxel& v : voxels)
            area += long{v.halfWidth} * v.halfHeight;
        for (const Voxel& v : made)
            fits += long{v.halfWidth} * v.halfHeight;
        all += static_cast<long>(voxels.size());
        narrow = std::fmin(narrow, static_cast<double>(area) / fits);
    }
    note("%ld voxels; their area is at least %.3f of what it should be", all, narrow);
    CHECK(all > 2000);
    CHECK(narrow > 0.98);
}
