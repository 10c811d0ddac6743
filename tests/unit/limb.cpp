// Tests of the limb: a scale next to it ends where rays of sight are tangent to the surface.
#include "help.h"

#include "../../src/surface/limb.h"
#include "test.h"

namespace {

Vec cross(const Vec& a, const Vec& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The cut function of a voxel as the drawing loop computes it: negative beyond the limb; x and y in units across the view.
double cutAt(const Voxel& v, double x, double y)
{
    return v.cutAt / 64.0 + (v.cutX * x + v.cutY * y) / 8.0 +
           (v.curveXX * x * x + 2 * v.curveXY * x * y + v.curveYY * y * y) / 32.0;
}

// Cuts the voxel of a seed at the limb; seed and normal in axes of the view, units.
Voxel ended(const Limb& limb, const Vec& seed, const Vec& normal)
{
    const double cosine = -dot(normal, seed) / seed.z;
    Voxel v = {};
    v.halfWidth = v.halfHeight = 300;
    v.back = 20;
    v.tiltX = static_cast<int16_t>(std::lround(normal.x / cosine * 256));
    v.tiltY = static_cast<int16_t>(std::lround(normal.y / cosine * 256));
    endAtLimb(limb, static_cast<int32_t>(cosine * 16384), &v);
    return v;
}

// A convex surface of revolution; a ball has the axis 0.
struct Round {
    Vec centre, axis;
    double radius;

    Vec across(const Vec& v) const { return v - axis * dot(axis, v); }
    // The distance by which a ray misses the surface, units; negative if it hits the surface.
    double missed(const Vec& ray) const
    {
        const Vec d = across(ray), c = across(centre);
        const double t = dot(d, c) / dot(d, d);
        return size(d * t - c) - radius;
    }
};

// How deep a scale of this seed goes at the limb, units.
double deepAt(const Round& round, const Vec& seed, double cosine)
{
    const Vec ray = round.across(seed * (1 / seed.z));
    return cosine * round.radius / (2 * dot(ray, ray));
}

// Compares scales of seeds that are seen nearly edge-on with the surface; `limbOf` finds the limb for a seed.
template <class LimbOf>
void holdAgainst(const Round& round, Random& random, LimbOf limbOf, long* held, double* worst)
{
    for (int i = 0; i < 200; ++i) {
        Vec out{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        out = round.across(out);
        if (size(out) < 0.1)
            continue;
        const Vec normal = out * (1 / size(out)), seed = round.centre + normal * round.radius;
        const double cosine = -dot(normal, seed) / seed.z;
        // A slope and a curve have only 7 bits; surfaces smaller than a unit have smaller scales.
        const double spacing = std::min(2.0, round.radius / 3);
        if (cosine < 0.05 || cosine > 0.5)
            continue;
        Limb limb;
        const bool found = limbOf(seed, &limb);
        CHECK(found);
        if (!found)
            continue;
        const Voxel voxel = ended(limb, seed, normal);
        CHECK(voxel.halfWidth == 300 && voxel.halfHeight == 300);
        const double deep = std::min(deepAt(round, seed, cosine) * 32, ENDS_MOST / 1.3);
        CHECK(voxel.back > deep && voxel.back < deep * 1.3 + 2);
        CHECK(cutAt(voxel, 0, 0) >= 0);
        for (int k = 0; k < 20; ++k) {
            const double x = random.between(-spacing, spacing), y = random.between(-spacing, spacing);
            const double missed = round.missed(seed + Vec{x, y, 0});
            // Only positions near the limb are compared; the approximation holds there.
            if (std::fabs(missed) > spacing / 4)
                continue;
            ++*held;
            if ((missed > 0) == (cutAt(voxel, x, y) < 0))
                continue;
            *worst = std::max(*worst, std::fabs(missed) / spacing);
        }
    }
}

}  // namespace

TEST(scales_of_a_ball_end_at_its_limb)
{
    Random random;
    long held = 0;
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        const double depth = random.between(60, 300);
        const Round ball{{random.between(-0.5, 0.5) * depth, random.between(-0.4, 0.4) * depth, depth}, {0, 0, 0},
                         random.between(1, std::min(40.0, depth / 5))};
        holdAgainst(ball, random, [&](const Vec& seed, Limb* limb) {
            return findLimb(static_cast<int32_t>(16384 / ball.radius), static_cast<int32_t>(seed.x / seed.z * 1024),
                            static_cast<int32_t>(seed.y / seed.z * 1024), static_cast<int32_t>(seed.z * 256), limb);
        }, &held, &worst);
    }
    note("%ld places held, in doubt up to %.3f spacings from the limb", held, worst);
    CHECK(held > 5000);
    CHECK(worst < 0.03);
}

TEST(scales_of_what_bends_end_at_its_limb)
{
    Random random;
    long held = 0;
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        const double depth = random.between(60, 300);
        Vec axis{random.between(-1, 1), random.between(-1, 1), random.between(-0.5, 0.5)};
        axis = axis * (1 / size(axis));
        const Round tube{{random.between(-0.4, 0.4) * depth, random.between(-0.3, 0.3) * depth, depth}, axis,
                         random.between(2.1, std::min(30.0, depth / 6))};
        // The object's own axes are turned relative to the view.
        Vec own[3] = {{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}, {0, 0, 0}, {0, 0, 0}};
        own[0] = own[0] * (1 / size(own[0]));
        own[1] = cross(own[0], axis);
        own[1] = own[1] * (1 / size(own[1]));
        own[2] = cross(own[0], own[1]);
        OwnFrame frame;
        const auto part = [&](int k, int which) { return which == 0 ? own[k].x : which == 1 ? own[k].y : own[k].z; };
        for (int k = 0; k < 3; ++k) {
            frame.right[k] = static_cast<int32_t>(std::lround(part(k, 0) * 16384));
            frame.up[k] = static_cast<int32_t>(std::lround(part(k, 1) * 16384));
            frame.ahead[k] = static_cast<int32_t>(std::lround(part(k, 2) * 16384));
        }
        ViewProducts axes;
        findViewProducts(frame, &axes);
        // A step of places is 1/32 unit: 256 of them are 8 units.
        constexpr int32_t PLACES = 8 << 16;
        Bend bend = {};
        const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
        for (int k = 0; k < 6; ++k) {
            const Vec &a = own[pairs[k][0]], &b = own[pairs[k][1]];
            const double turn = (dot(a, b) - dot(a, axis) * dot(b, axis)) / tube.radius;
            bend.turn[k] = static_cast<int16_t>(std::lround(turn * 8 * 8192));
        }
        holdAgainst(tube, random, [&](const Vec& seed, Limb* limb) {
            return findLimb(bend, axes, PLACES, static_cast<int32_t>(seed.x / seed.z * 1024),
                            static_cast<int32_t>(seed.y / seed.z * 1024), static_cast<int32_t>(seed.z * 256), limb);
        }, &held, &worst);
    }
    note("%ld places held, in doubt up to %.3f spacings from the limb", held, worst);
    CHECK(held > 5000);
    CHECK(worst < 0.03);
}

TEST(limbs_of_saddles_that_bend_fast_are_as_computed)
{
    // Two curvatures of up to 2 a unit, of either sign, seen at any slant of the widest view; held against the formulas of limb.h.
    Random random;
    OwnFrame frame = {};
    frame.right[0] = frame.up[1] = frame.ahead[2] = 16384;
    ViewProducts axes;
    findViewProducts(frame, &axes);
    long found = 0, beyond = 0;
    for (int i = 0; i < 200000; ++i) {
        Bend bend = {};
        for (int k = 0; k < 6; ++k)
            bend.turn[k] = static_cast<int16_t>(random.between(-16000, 16000));
        const auto shear = [&] { return static_cast<int32_t>(random.between(-1536, 1536)); };
        const int32_t shearX = shear(), shearY = shear();
        Limb limb;
        // A turn of 16000 over 256 steps of 1/256 unit: 1.95 a unit.
        if (!findLimb(bend, axes, 1 << 16, shearX, shearY, 100 << 8, &limb))
            continue;
        ++found;
        const auto turn = [&](int k) { return bend.turn[k] / 8192.0; };
        const double w[] = {shearX / 1024.0, shearY / 1024.0, 1};
        const double s[3][3] = {{turn(0), turn(3), turn(4)}, {turn(3), turn(1), turn(5)}, {turn(4), turn(5), turn(2)}};
        double sw[3] = {}, k = 0;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                sw[row] += s[row][column] * w[column];
            k += sw[row] * w[row];
        }
        if (k < 0.1)
            continue;
        const double curves[] = {sw[0] * sw[0] / k - s[0][0], sw[0] * sw[1] / k - s[0][1], sw[1] * sw[1] / k - s[1][1]};
        for (int part = 0; part < 3; ++part) {
            const double curve = std::clamp(curves[part] * 128, -127.0, 127.0);
            NEAR(limb.curve[part], curve, 0.05 * std::fabs(curve) + 3);
        }
        beyond += std::fabs(sw[0] * sw[0] / k) > 8 || std::fabs(sw[1] * sw[1] / k) > 8;
    }
    note("%ld limbs, %ld of them with products beyond 32 bits", found, beyond);
    CHECK(found > 20000 && beyond > 10);
}

// A surface that is flat along the ray has no limb.
TEST(flat_surfaces_have_no_limb)
{
    Limb limb;
    CHECK(!findLimb(16384 / 4096, 0, 0, 100 << 8, &limb));
    Bend flat = {};
    OwnFrame frame = {};
    frame.right[0] = frame.up[1] = frame.ahead[2] = 16384;
    ViewProducts axes;
    findViewProducts(frame, &axes);
    CHECK(!findLimb(flat, axes, 8 << 16, 100, 100, 100 << 8, &limb));
    flat.turn[0] = 8192;
    CHECK(!findLimb(flat, axes, 8 << 16, 0, 0, 100 << 8, &limb));
    flat.turn[2] = -8192;
    CHECK(!findLimb(flat, axes, 8 << 16, 0, 0, 100 << 8, &limb));
}

namespace {

// The number of scales without an end that a ball has which blends with nothing, and the number of their corners that lie more than
// BEYOND units outside its outline.
constexpr double BEYOND = 0.08;
struct Corners {
    long scales = 0, beyond = 0;

    void add(double size, const Vec& at)
    {
        Scene scene;
        scene.eye = point(0, 0, 0);
        scene.ball(size, at.x, at.y, at.z);
        scene.update();
        for (const Voxel& v : scene.draw(0)) {
            if (v.back != 0)
                continue;
            ++scales;
            for (int corner = 0; corner < 4; ++corner) {
                const Vec out{v.x + (corner & 1 ? 1.0 : -1.0) * v.halfWidth, v.y + (corner & 2 ? 1.0 : -1.0) * v.halfHeight,
                              static_cast<double>(v.z)};
                const Vec ray = out * (1 / ::size(out));
                beyond += ::size(at - ray * dot(at, ray)) - size / 2 > BEYOND;
            }
        }
    }
};

}  // namespace

TEST(scales_whose_corners_are_beyond_the_limb_end_there)
{
    Random random;
    Corners corners;
    for (int i = 0; i < 40; ++i) {
        const double depth = random.between(80, 250), size = random.between(8, 50);
        corners.add(size, {random.between(-0.3, 0.3) * depth, random.between(-0.2, 0.2) * depth, depth});
    }
    note("%ld scales without an end, %ld corners beyond the limb", corners.scales, corners.beyond);
    CHECK(corners.scales > 9000);
    CHECK(corners.beyond < 40);
}
