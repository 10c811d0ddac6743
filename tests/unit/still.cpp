// Tests of what stands still: its voxels are the same, byte for byte, whether they have been kept or are made in this frame.
#include <cstring>

#include "help.h"
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
