// Tests of patches: each seed is in exactly one patch, and the state of a patch is true of each of its seeds, tested for every seed
// in double precision. surface.cpp tests that no visible seed is missing.
#include "../../src/surface/nearby.h"

#include <algorithm>

#include "help.h"
#include "model/stop.h"
#include "test.h"
#include "truth.h"

namespace {

SoftObject* makeUsual(int kind, int number)
{
    Real measures[MEASURES_MOST];
    for (int i = 0; i < KINDS[kind].measures; ++i)
        measures[i] = KINDS[kind].measure[i].usual;
    return KINDS[kind].make(number, measures);
}

std::vector<Patch> patchesIn(const SoftObject& object)
{
    std::vector<Patch> patches(static_cast<size_t>(patchesOf(object)));
    makePatches(object, patches.data());
    return patches;
}

// The position of a seed at rest in the world.
Vec restOf(const SoftObject& object, const Seed& s)
{
    return vec(object.toWorld(object.root(s.root) + s.path));
}

// Places objects of all kinds, turned at random, in a small space.
void scatter(Scene& scene, std::vector<const Kind*>& kinds, Random& random, int count, double room)
{
    for (int i = 0; i < count; ++i) {
        const int kind = random.below(KIND_COUNT);
        kinds.push_back(&KINDS[kind]);
        SoftObject& object = scene.add(makeUsual(kind, i + 1), random.between(-room, room), random.between(-room, room),
                                       random.between(-room, room));
        object.rotate(object.centre(), vector(random.between(-1, 1), random.between(-1, 1), 1), random.bits());
        if (random.below(2))
            object.setSize(real(number(object.size()) * random.between(0.8, 1.2)));
    }
    scene.linkAll();
    scene.findBodies();
}

}  // namespace

TEST(patches_hold_every_seed_once)
{
    for (int kind = 0; kind < KIND_COUNT; ++kind) {
        for (double spacing : {0.7, 2.0, 8.0}) {
            Scene scene;
            const SoftObject& object = scene.add(makeUsual(kind, 1), 0, 0, 0, spacing);
            const std::vector<Patch> patches = patchesIn(object);
            std::vector<int> held(static_cast<size_t>(object.seeds()), 0);
            for (const Patch& patch : patches) {
                bool middle = false;
                int seeds = 0;
                forSeeds(object, patch, [&](const Seed& s) {
                    const int i = object.slotOf(s);
                    SAME(i % 2, 0);
                    CHECK(&s == &object.regular(i));
                    CHECK(i >= 0 && i < object.seedSlots());
                    ++held[static_cast<size_t>(i / 2)];
                    middle = middle || i == patch.middleSeed;
                    ++seeds;
                });
                CHECK(middle);
                CHECK(seeds >= 1 && seeds <= PATCH_RINGS * PATCH_SEEDS);
            }
            for (int times : held)
                SAME(times, 1);
        }
    }
}

TEST(seeds_are_laid_out_whole_or_not_at_all)
{
    // The user stops the layout at every place where it asks.
    static int asked, stopsAt;
    Scene scene;
    SoftObject& object = scene.ball(30, 0, 0, 0);
    const int before = object.seeds();
    stopSource = [] { return ++asked >= stopsAt; };
    bool done = false;
    for (stopsAt = 1; !done && stopsAt < 10000; ++stopsAt) {
        asked = 0;
        done = object.resample(real(1.5), makeEngine);
        SAME(done, asked < stopsAt);
        CHECK(done == (object.seeds() != before));
    }
    stopSource = nullptr;
    note("asked %d times", asked);
    CHECK(done && asked > 50);
}

TEST(patches_are_as_large_as_they_say)
{
    for (int kind = 0; kind < KIND_COUNT; ++kind) {
        Scene scene;
        const SoftObject& object = scene.add(makeUsual(kind, 1), 0, 0, 0);
        for (const Patch& patch : patchesIn(object)) {
            const Vec middle{patch.middle[0] / 16.0, patch.middle[1] / 16.0, patch.middle[2] / 16.0};
            const Vec axis{patch.axis[0] / 16384.0, patch.axis[1] / 16384.0, patch.axis[2] / 16384.0};
            NEAR(size(axis), 1, 0.001);
            forSeeds(object, patch, [&](const Seed& s) {
                CHECK(size(restOf(object, s) - middle) <= patch.radius / 16.0 + 0.05);
                const Vec normal{s.normal.x / 16384.0, s.normal.y / 16384.0, s.normal.z / 16384.0};
                CHECK(size(normal - axis) <= patch.spread / 16384.0 + 0.01);
            });
        }
    }
}

TEST(patches_at_rest_are_out_of_reach)
{
    Random random;
    long rest = 0, reached = 0, idle = 0;
    for (int round = 0; round < 30; ++round) {
        Scene scene;
        std::vector<const Kind*> kinds;
        scatter(scene, kinds, random, 3, 30);
        const Body body(scene, kinds);
        const FrameContext frame = scene.frame();
        for (size_t o = 0; o < scene.objects.size(); ++o) {
            const SoftObject& object = *scene.objects[o];
            Neighbourhood all;
            gather(object, frame, all);
            Nearby nearby(object, all, *frame.bodies);
            for (const Patch& patch : patchesIn(object)) {
                const bool touched = nearby.setPatch(patch, false);
                const auto isIn = [&](const NeighbourList& list, const SoftObject& other) {
                    return std::any_of(list.near, list.near + list.count, [&](const Neighbour* n) { return n->object == &other; });
                };
                bool any = false;
                forSeeds(object, patch, [&](const Seed& s) {
                    const Vec p = restOf(object, s);
                    for (size_t other = 0; other < scene.objects.size(); ++other) {
                        if (other == o || body.cores[other].param(p) >= 0.999)
                            continue;
                        any = true;
                        CHECK(isIn(nearby.reaching(), *scene.objects[other]));
                        CHECK(isIn(nearby.listed(), *scene.objects[other]));
                    }
                });
                // No seed of a patch at rest is reached by a neighbour. Only few other patches are reached by no neighbour.
                CHECK(touched || !any);
                rest += !touched;
                reached += any;
                idle += touched && !any;
            }
        }
    }
    note("%ld patches rest, %ld are reached, %ld seem to be", rest, reached, idle);
    CHECK(rest > 500 && reached > 500);
    CHECK(idle < reached / 2);
}

TEST(a_far_eye_is_told_from_what_has_shrunk)
{
    // The user stops the layout of new seeds, so that the object goes on with those of its size before.
    Scene scene;
    SoftObject& object = scene.ball(40, 0, 0, 0);
    scene.eye = point(-5000, 4000, -6000);
    stopSource = [] { return true; };
    object.setSize(real(4));
    stopSource = nullptr;
    NEAR(number(object.growth()), 0.1, 0.001);
    scene.findBodies();
    OwnFrame own;
    findOwnFrame(object, scene.frame(), own);
    // What bounds a product in restsAway() and facing(): the components and the length of the vector to the eye.
    for (int32_t part : own.eye32)
        CHECK(part >= -32 * 1001 && part <= 32 * 1001);
    CHECK(own.distance32 < 32 * 1800);
    for (const Patch& patch : patchesIn(object)) {
        const Vec axis{patch.axis[0] / 16384.0, patch.axis[1] / 16384.0, patch.axis[2] / 16384.0};
        const double facing = dot(axis, vec(scene.eye)) / size(vec(scene.eye));
        if (facing > 0.5)
            CHECK(!restsAway(patch, own));
        if (facing < -0.5)
            CHECK(restsAway(patch, own));
    }
}

TEST(patches_that_face_away_are_out_of_sight)
{
    Random random;
    long away = 0, hidden = 0, count = 0;
    for (int round = 0; round < 40; ++round) {
        Scene scene;
        std::vector<const Kind*> kinds;
        scene.eye = point(random.between(-20, 20), random.between(-20, 20), -120);
        scatter(scene, kinds, random, 1, 40);
        const Body body(scene, kinds);
        const SoftObject& object = *scene.objects[0];
        OwnFrame own;
        findOwnFrame(object, scene.frame(), own);
        // Seeds seen more edge-on than this are not drawn.
        const double limb = own.limb / 16384.0 * own.distance32 / 32;
        for (const Patch& patch : patchesIn(object)) {
            bool seen = false;
            forSeeds(object, patch, [&](const Seed& s) {
                const Vec p = restOf(object, s), fall = body.fall({0}, p);
                seen = seen || dot(fall, vec(scene.eye) - p) > limb * std::sqrt(dot(fall, fall));
            });
            const bool said = restsAway(patch, own);
            CHECK(!said || !seen);
            away += said;
            hidden += !seen;
            ++count;
        }
    }
    note("%ld of %ld patches face away, %ld of them are known to", hidden, count, away);
    CHECK(away > hidden / 2);
}
