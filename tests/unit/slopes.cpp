// Tests of how the brightness changes across scales: the slopes that Slopes computes from neighbouring voxels, and their accuracy
// where objects blend.
#include "../../src/surface/slopes.h"

#include "help.h"
#include "test.h"
#include "truth.h"

namespace {

constexpr int32_t SPACING = 512;
constexpr int RINGS = 5, ROUND = 7;

// A plane of seeds in rings, tilted relative to the viewer, and the voxels of these seeds.
struct Plane {
    std::vector<Seed> seeds{static_cast<size_t>(RINGS * ROUND)};
    std::vector<Voxel> voxels{static_cast<size_t>(RINGS * ROUND)};
    std::unique_ptr<Slopes> slopes = std::make_unique<Slopes>();
    double shearX = 0.4, shearY = -0.3;

    static int at(int ring, int i) { return ring * ROUND + i; }

    // The brightness is 30 in the middle and changes by these amounts per unit of the picture plane.
    Plane(double changeX, double changeY)
    {
        for (int ring = 0; ring < RINGS; ++ring)
            for (int i = 0; i < ROUND; ++i) {
                seeds[at(ring, i)].beyond = -1;
                // The seed N of the ring before is beside the next seed of the ring (model/seed.h).
                seeds[at(ring, i)].neighbour = ring == 0 ? -1 : 2 * at(ring - 1, std::min(i + 1, ROUND - 1));
                Voxel& v = voxels[at(ring, i)];
                v = {};
                const double x = (i - ROUND / 2) * 2.0 + 0.3 * ring, y = (ring - RINGS / 2) * 2.0, z = 0.5 * x + 0.8 * y;
                v.x = static_cast<int32_t>(std::lround(x * 256));
                v.y = static_cast<int32_t>(std::lround(y * 256));
                v.z = static_cast<int32_t>(std::lround(z * 256));
                v.halfWidth = v.halfHeight = 256;
                const double brightness = 30 + changeX * (x - shearX * z) + changeY * (y - shearY * z);
                v.brightness = static_cast<uint8_t>(std::clamp(std::lround(brightness), 0L, 63L));
            }
    }
    void set(bool wanted = true)
    {
        const auto bits10 = [](double shear) { return static_cast<int32_t>(std::lround(shear * 1024)); };
        slopes->begin();
        for (int i = 0; i < RINGS * ROUND; ++i)
            slopes->add(&seeds[i], i, &voxels[i], wanted ? Slopes::sight(bits10(shearX), bits10(shearY)) : Slopes::STAYS);
        slopes->set(SPACING);
    }
    // Whether the slopes of a lit voxel are right, except for the rounding of brightness to whole steps.
    bool isRight(int i, double changeX, double changeY, double off) const
    {
        return std::fabs(voxels[i].slopeX - 8 * changeX) <= off && std::fabs(voxels[i].slopeY - 8 * changeY) <= off;
    }
};

// The squared errors of brightness a unit beside the centres of scales.
struct Beside {
    double sum = 0;
    long count = 0;
};

// The point of the surface on the ray of sight through a point near the surface.
Vec onSurface(const Body& body, const std::vector<size_t>& joined, const Vec& eye, Vec p)
{
    const Vec ray = (p - eye) * (1 / size(p - eye));
    for (int step = 0; step < 8; ++step)
        p = p + ray * ((body.field(joined, p) - 0.5) / dot(body.fall(joined, p), ray));
    return p;
}

// Leaves out scales that are cut and scales near the limb or the terminator.
void lookBeside(Scene& scene, const Body& body, Beside& all)
{
    const Vec eye = vec(scene.eye);
    for (size_t o = 0; o < scene.objects.size(); ++o) {
        const std::vector<size_t> joined = body.joined(o);
        for (const Voxel& voxel : scene.draw(o)) {
            const Vec p = eye + Vec{voxel.x / 256.0, voxel.y / 256.0, voxel.z / 256.0};
            const Vec fall = body.fall(joined, p), toEye = eye - p;
            if ((isCut(voxel) && !isCutNowhere(voxel)) || voxel.brightness < 12 ||
                dot(fall, toEye) < 0.5 * size(fall) * size(toEye))
                continue;
            for (const auto& way : {Vec{1, 0, 0}, Vec{-1, 0, 0}, Vec{0, 1, 0}, Vec{0, -1, 0}}) {
                const Vec q = onSurface(body, joined, eye, p + way);
                const Vec there = body.fall(joined, q);
                const double light = dot(there, vec(scene.light)) / size(there) * 63;
                if (std::fabs(body.field(joined, q) - 0.5) > 0.001 || !(size(q - p) < 3) || body.dominance(o, joined, q) > 0 ||
                    light <= 0)
                    continue;
                const double off = voxel.brightness + (voxel.slopeX * way.x + voxel.slopeY * way.y) / 8 - light;
                all.sum += off * off;
                ++all.count;
            }
        }
    }
}

// Seeds that know how the light changes around them: how much it does, steps a unit, and how many are right.
struct LightChanges {
    long seeds = 0, extras = 0, right = 0;
    double change = 0;
};

Vec crossed(const Vec& a, const Vec& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void lookAtSeeds(const Scene& scene, const Body& body, size_t o, LightChanges& all)
{
    const SoftObject& object = *scene.objects[o];
    const std::vector<size_t> joined = body.joined(o);
    const Vec light = vec(scene.light);
    const auto inWorld = [&](const Vec& v) {
        const auto row = [&](int i) {
            const Real* const m = object.turn().m[i];
            return number(m[0]) * v.x + number(m[1]) * v.y + number(m[2]) * v.z;
        };
        return Vec{row(0), row(1), row(2)};
    };
    const auto look = [&](const Seed& s, bool regular) {
        const bool knows = !regular || ((s.flags & SEED_BORDER) && s.apart < 256);
        if ((s.flags & (SEED_VALID | SEED_RESTING)) != SEED_VALID || !knows)
            return;
        const Vec p = vec(object.centre()) + inWorld(vec(object.root(s.root) + s.path * s.position)) * number(object.growth());
        const Vec fall = body.fall(joined, p), n = fall * (1 / size(fall));
        // A patch that is hidden or faces away is not settled.
        if (std::fabs(body.field(joined, p) - 0.5) > 0.01 || dot(n, vec(scene.eye) - p) < 2 || dot(n, light) < 0.05)
            return;
        const Vec found = inWorld(Vec{s.lightChange[0] / 128.0, s.lightChange[1] / 128.0, s.lightChange[2] / 128.0});
        const Vec side = crossed(n, light), across = side * (1 / size(side)), along = crossed(n, across);
        const auto truly = [&](const Vec& way) {
            const Vec after = body.fall(joined, p + way * 0.5), before = body.fall(joined, p - way * 0.5);
            return 63 * dot(after * (1 / size(after)) - before * (1 / size(before)), light);
        };
        const double x = truly(across), y = truly(along), much = std::hypot(x, y);
        all.right += std::hypot(dot(found, across) - x, dot(found, along) - y) < 0.5 + 0.25 * much;
        all.change += much;
        ++all.seeds;
        all.extras += !regular;
    };
    for (int i = 0; i < object.seedSlots(); i += 2) {
        look(object.regular(i), true);
        if (object.extra(i) != nullptr)
            look(*object.extra(i), false);
    }
}

}  // namespace

TEST(slopes_are_those_of_the_brightness)
{
    Random random;
    for (int round = 0; round < 200; ++round) {
        const double x = random.between(-2, 2), y = random.between(-2, 2);
        Plane plane(x, y);
        plane.set();
        for (int ring = 0; ring < RINGS; ++ring)
            for (int i = 0; i < ROUND; ++i) {
                // A dark or fully lit neighbour does not show the full change of brightness.
                bool clear = true;
                for (int k = std::max(ring - 1, 0); k <= std::min(ring + 1, RINGS - 1); ++k)
                    for (int j = std::max(i - 1, 0); j <= std::min(i + 1, ROUND - 1); ++j)
                        clear = clear && plane.voxels[Plane::at(k, j)].brightness % 63 != 0;
                const bool inside = ring > 0 && ring < RINGS - 1;
                // Rings are closed, so the neighbours at their ends are seeds of other rings.
                if (clear && i > 0 && i < ROUND - 1 && std::fabs(x) + std::fabs(y) > 1.5)
                    CHECK(plane.isRight(Plane::at(ring, i), x, y, inside ? 4 : 8));
            }
    }
}

TEST(slopes_stay_where_nothing_is_known)
{
    Plane still(1, 1);
    for (Voxel& v : still.voxels)
        v.slopeX = 3, v.slopeY = -2;
    still.set(false);
    for (const Voxel& v : still.voxels)
        CHECK(v.slopeX == 3 && v.slopeY == -2);

    // All other voxels are dark, or far away.
    const int middle = Plane::at(2, 3);
    for (int dark = 0; dark < 2; ++dark) {
        Plane lone(1, 1);
        for (int i = 0; i < RINGS * ROUND; ++i) {
            lone.voxels[i].slopeX = 12;
            lone.voxels[i].slopeY = -9;
            if (i == middle)
                continue;
            if (dark)
                lone.voxels[i].brightness = 0;
            else
                lone.voxels[i].x += i < middle ? -100000 : 100000;
        }
        lone.set();
        CHECK(lone.voxels[middle].slopeX == 12 && lone.voxels[middle].slopeY == -9);
    }

    // Only the seeds of the voxel's ring are lit: the slope along the ring is computed from them, and the slope perpendicular to it
    // is kept.
    Plane ring(1.5, 0);
    ring.shearX = ring.shearY = 0;
    for (int i = 0; i < RINGS * ROUND; ++i) {
        Voxel& v = ring.voxels[i];
        v.slopeX = -20;
        v.slopeY = 7;
        v.brightness = i / ROUND == 2 ? static_cast<uint8_t>(30 + 3 * (i % ROUND - 3)) : 0;
    }
    ring.set();
    CHECK(std::abs(ring.voxels[middle].slopeX - 12) <= 1);
    CHECK(std::abs(ring.voxels[middle].slopeY - 7) <= 1);
}

TEST(slopes_of_a_voxel_in_two_parts_are_alike)
{
    Plane plane(1, -1);
    Voxel copy{};
    copy.brightness = 30;
    plane.slopes->begin();
    for (int i = 0; i < RINGS * ROUND; ++i) {
        plane.slopes->add(&plane.seeds[i], i, &plane.voxels[i], Slopes::sight(410, -307));
        if (i == 17)
            plane.slopes->addCopy(&copy, &plane.voxels[i]);
    }
    plane.slopes->set(SPACING);
    CHECK(copy.slopeX == plane.voxels[17].slopeX && copy.slopeY == plane.voxels[17].slopeY);
    CHECK(plane.isRight(17, 1, -1, 4));
}

// A voxel of an earlier frame gives its brightness to the voxels beside it, and keeps its own slopes. What an object or a frame has
// added is not known in any later one, however many there were.
TEST(slopes_take_kept_voxels_but_none_of_before)
{
    Plane plane(1, -1);
    plane.set();
    const int middle = Plane::at(2, 3);
    const auto set = [&](bool kept) {
        for (Voxel& v : plane.voxels)
            v.slopeX = v.slopeY = 0;
        for (int i = 0; i < RINGS * ROUND; ++i)
            if (i == middle)
                plane.slopes->add(&plane.seeds[i], i, &plane.voxels[i], Slopes::sight(410, -307));
            else if (kept)
                plane.slopes->addKept(&plane.seeds[i], i, &plane.voxels[i]);
        plane.slopes->set(SPACING);
        for (int i = 0; i < RINGS * ROUND; ++i)
            CHECK(i == middle || (plane.voxels[i].slopeX | plane.voxels[i].slopeY) == 0);
    };
    plane.slopes->begin();
    set(true);
    CHECK(plane.isRight(middle, 1, -1, 4));
    for (int before : {1, 32765, 32766, 32767, 32768}) {
        for (int i = 0; i < before; ++i)
            plane.slopes->begin();
        set(false);
        CHECK(plane.voxels[middle].slopeX == 0 && plane.voxels[middle].slopeY == 0);
        plane.set();
    }
}

// A unit beside the seeds of balls that blend, the brightness of their scales is close to that of the surface.
TEST(slopes_are_true_where_balls_blend)
{
    Beside all;
    Random random;
    for (int round = 0; round < 6; ++round) {
        Scene scene;
        scene.ball(32, random.between(-17, -14), random.between(-8, 8), random.between(-6, 6));
        scene.ball(28, random.between(14, 17), random.between(-8, 8), random.between(-6, 6));
        scene.ball(20, random.between(-6, 6), random.between(12, 18), random.between(-18, -10));
        scene.linkAll();
        for (int frame = 0; frame < 3; ++frame)
            scene.update();
        lookBeside(scene, Body(scene), all);
    }
    note("brightness a unit beside %ld seeds: %.2f steps off", all.count / 4, std::sqrt(all.sum / all.count));
    CHECK(all.count > 4000);
    CHECK(std::sqrt(all.sum / all.count) < 1.5);
}

// How the light changes around seeds beside a border and around oversampled seeds: half a unit to each side of those that are lit
// and face the viewer. Objects are of every kind, linked all or in a chain, and some have grown since their seeds were laid out.
TEST(seeds_beside_borders_know_how_the_light_changes)
{
    Random random;
    for (const bool chain : {false, true}) {
        LightChanges all;
        for (int round = 0; round < 30; ++round) {
            Scene scene;
            std::vector<const Kind*> kinds;
            for (int i = 0; i < 3; ++i) {
                kinds.push_back(&KINDS[(round + i * (1 + round / KIND_COUNT)) % KIND_COUNT]);
                SoftObject& object = scene.add(makeOf(*kinds.back(), i + 1), 11 * (i - 1) + random.between(-2, 2),
                                               random.between(-5, 5), random.between(-5, 5));
                object.rotate(object.centre(), vector(1, 0.4, 0.2), static_cast<uint32_t>(random.between(0, 4e9)));
                if (i == 1 && round % 2)
                    object.setSize(object.size() * Real(1.3));
            }
            scene.link(0, 1);
            scene.link(1, 2);
            if (!chain)
                scene.link(0, 2);
            for (int frame = 0; frame < 3; ++frame)
                scene.update();
            const Body body(scene, kinds);
            for (size_t o = 0; o < 3; ++o)
                lookAtSeeds(scene, body, o, all);
        }
        note("around %ld seeds, %ld of them oversampled, the light changes by %.1f steps a unit; %.1f %% know how", all.seeds,
             all.extras, all.change / all.seeds, 100.0 * all.right / all.seeds);
        CHECK(all.extras > 100 && all.seeds - all.extras > 100);
        CHECK(all.right > 0.85 * all.seeds);
    }
}

// Next to the limb, scales of seeds that have moved apart are tilted and wide. None extends far, and none is drawn by more than two
// spacings before its middle.
TEST(no_scale_comes_far_before_the_surface)
{
    Random random;
    long limb = 0;
    double corners = 0, drawn = 0;
    for (int round = 0; round < 20; ++round) {
        Scene scene;
        for (int i = 0; i < 6; ++i)
            scene.ball(random.between(10, 30), random.between(-14, 14), random.between(-14, 14), random.between(-14, 14));
        scene.linkAll();
        for (int frame = 0; frame < 2; ++frame)
            scene.update();
        for (size_t o = 0; o < scene.objects.size(); ++o)
            for (const Voxel& v : scene.draw(o)) {
                if (v.back == 0)
                    continue;
                ++limb;
                const double corner = (std::abs(v.tiltX) * v.halfWidth + std::abs(v.tiltY) * v.halfHeight) / 65536.0;
                corners = std::max(corners, corner);
                drawn = std::max(drawn, std::min(corner, v.front / 32.0));
            }
    }
    note("%ld scales next to the limb, their corners %.2f units before or behind their middle at most; drawn before it up to %.2f",
         limb, corners, drawn);
    CHECK(limb > 1000);
    CHECK(corners > 10 && corners <= 16.1);
    NEAR(drawn, 2, 0.01);
}

// In the neck between two balls the surface bends to and fro within a patch, and on the rim of a flat object it does so at rest. A
// ball by itself has no such place.
TEST(scales_that_bend_unevenly_are_domed)
{
    const char* const shapes[] = {"balls apart", "balls with a neck", "flat balls"};
    for (const char* const& shape : shapes) {
        const bool necked = &shape == &shapes[1], flat = &shape == &shapes[2];
        Scene scene;
        for (double x : {-9, 9}) {
            SoftObject* const ball = new Sphere(1, real(14));
            if (flat)
                ball->setStretch({real(1.2), real(0.5), real(1)});
            scene.add(ball, x, 0, 0);
        }
        if (necked)
            scene.linkAll();
        for (int frame = 0; frame < 2; ++frame)
            scene.update();
        int domed = 0, all = 0;
        for (size_t o = 0; o < 2; ++o)
            for (const Voxel& v : scene.draw(o)) {
                domed += isCutNowhere(v);
                ++all;
            }
        note("%d of %d scales of %s are domed", domed, all, shape);
        CHECK(necked || flat ? domed > 10 && (flat || domed < all / 2) : domed == 0);
    }
}
