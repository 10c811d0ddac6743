// Tests of finding the surface: whatever objects, links and weights a scene has, every voxel lies on the surface of its body, has
// the surface's orientation, and no voxel is missing where the viewer sees the surface. Reference values are in double precision.
#include "model/torus.h"

#include "help.h"
#include "test.h"
#include "truth.h"

namespace {

// The errors of the voxels of scenes.
struct Errors {
    long count = 0;
    double worst = 0, sum = 0;              // distance from the surface, units
    long astray = 0;                        // voxels whose distance is out of tolerance
    double worstLight = 0, sumLight = 0;    // brightness, steps of 64
    long dim = 0;                           // voxels whose brightness is out of tolerance
    double strongest = -1;                  // by how much a neighbour's field is stronger than the voxel's own
    long foreign = 0;                       // voxels where that is out of tolerance
    long away = 0;                          // voxels that face away from the viewer

    void report(const char* what) const
    {
        note("%s: %ld voxels, %.3f units off the surface at most, %.4f on average, %ld astray; brightness %.1f, %.2f, %ld; "
             "neighbours stronger by %.3f at most, %ld; %ld face away",
             what, count, worst, count > 0 ? sum / count : 0, astray, worstLight, count > 0 ? sumLight / count : 0, dim, strongest,
             foreign, away);
    }
};

// Tolerances: the distance from the surface (units; on small objects a part of the spacing) and the error of brightness (steps of
// 64).
constexpr double ASTRAY = 0.35;
constexpr double DIM = 8;

Vec placeOf(const Scene& scene, const Voxel& voxel)
{
    const Vec at{voxel.x / 256.0, voxel.y / 256.0, voxel.z / 256.0};
    const ViewAxes& axes = scene.axes;
    return vec(scene.eye) + vec(axes.right) * at.x + vec(axes.up) * at.y + vec(axes.ahead) * at.z;
}

// The places of an object's voxels, in the world.
std::vector<Vec> placesOf(Scene& scene, size_t object)
{
    std::vector<Vec> places;
    for (const Voxel& voxel : scene.draw(object))
        places.push_back(placeOf(scene, voxel));
    return places;
}

// The distance from a point to the nearest of these places.
double distanceTo(const std::vector<Vec>& places, const Vec& p)
{
    double nearest = 1e9;
    for (const Vec& place : places)
        nearest = std::fmin(nearest, size(place - p));
    return nearest;
}

// Where a straight line from a point inside leaves a body, in steps of 1/50 of the length of `way`.
Vec surfaceFrom(const Body& body, const std::vector<size_t>& joined, Vec p, const Vec& way)
{
    while (body.field(joined, p) > 0.5)
        p = p + way * 0.02;
    return p;
}

// The brightness of the surface where the field falls in this direction; negative on the side away from the light.
double lit(const Scene& scene, const Vec& fall)
{
    return dot(fall, vec(scene.light)) / size(fall) * 63;
}

// Compares all voxels of a frame with the surface of the body.
void measure(Scene& scene, const Body& body, Errors& errors)
{
    for (size_t o = 0; o < scene.objects.size(); ++o) {
        const std::vector<size_t> joined = body.joined(o);
        std::vector<size_t> owners;
        const std::vector<Voxel> voxels = scene.draw(o, 256, &owners);
        for (size_t k = 0; k < voxels.size(); ++k) {
            const Voxel& voxel = voxels[k];
            const Vec p = placeOf(scene, voxel);
            const Vec fall = body.fall(joined, p);
            const double steep = size(fall), off = body.field(joined, p) - 0.5;
            // Where the field is flat, neighbouring points are just as good.
            const double distance = std::fabs(off) / std::fmax(steep, 0.3 / body.cores[o].size);
            ++errors.count;
            errors.worst = std::fmax(errors.worst, distance);
            errors.sum += distance;
            errors.astray += distance > ASTRAY;
            const double truly = lit(scene, fall);
            const double light = std::fabs(voxel.brightness - (voxel.brightness < 0 ? truly : std::fmax(0, truly)));
            errors.worstLight = std::fmax(errors.worstLight, light);
            errors.sumLight += light;
            errors.dim += light > DIM;
            const double stronger = body.dominance(owners[k], joined, p);
            errors.strongest = std::fmax(errors.strongest, stronger);
            errors.foreign += stronger > 0.08;
            errors.away += dot(fall, vec(scene.eye) - p) < -0.2 * steep * size(vec(scene.eye) - p);
        }
    }
}

// Counts the points where paths of regular seeds leave the surface in plain sight without a voxel of the object near.
struct Missing {
    long count = 0, missing = 0;
    double farthest = 0;
};

void seek(Scene& scene, const Body& body, Missing& result)
{
    for (size_t o = 0; o < scene.objects.size(); ++o) {
        const std::vector<size_t> joined = body.joined(o);
        const SoftObject& object = *scene.objects[o];
        std::vector<Vec> places;
        for (const size_t other : joined) {
            std::vector<size_t> owners;
            const std::vector<Voxel> voxels = scene.draw(other, 256, &owners);
            for (size_t k = 0; k < voxels.size(); ++k)
                if (owners[k] == o)
                    places.push_back(placeOf(scene, voxels[k]));
        }
        for (int i = 0; i < object.seedSlots(); i += 2) {
            const Seed& s = object.seed(i);
            const Vec root = vec(object.toWorld(object.root(s.root)));
            const Vec path = vec(object.toWorld(object.root(s.root) + s.path)) - root;
            const double position = body.leaves(joined, root, path);
            if (position >= 1.9)
                continue;
            const Vec p = root + path * position;
            const Vec fall = body.fall(joined, p);
            const Vec toEye = vec(scene.eye) - p;
            if (body.dominance(o, joined, p) > -0.05 || dot(fall, toEye) < 0.3 * size(fall) * size(toEye))
                continue;
            // Where paths have spread, the nearest voxel may be as far away as the voxels of a patch that is drawn as one.
            double nearest = 1e9;
            for (const Vec& place : places)
                nearest = std::fmin(nearest, size(place - p));
            const double spread = nearest / (number(object.spacing()) * position);
            ++result.count;
            result.farthest = std::fmax(result.farthest, spread);
            result.missing += spread > 2.5;
        }
    }
}

// Checks that no voxel is where it should not be, and that almost none is missing.
void judge(const char* what, const Errors& errors, const Missing& missing)
{
    errors.report(what);
    note("%s: %ld seeds in sight, %ld without a voxel near, the farthest %.2f spacings from one", what, missing.count,
         missing.missing, missing.farthest);
    CHECK(errors.count > 0);
    CHECK(missing.count > 0);
    // Single voxels may be off where two parts of the surface meet in a fold, or where a patch lies half behind the edge.
    CHECK(errors.astray <= errors.count / 5000);
    // Or they may be a frame late, because a seed that had not moved waits.
    CHECK(errors.worst < 2 * ASTRAY);
    CHECK(errors.foreign <= 1 + errors.count / 5000);
    CHECK(errors.away <= 1 + errors.count / 10000);
    CHECK(missing.missing <= missing.count / 500);
    CHECK(errors.sumLight <= 0.5 * errors.count);
    CHECK(errors.dim <= errors.count / 200);
}

// Makes a frame of a scene and tests it.
void look(Scene& scene, Errors& errors, Missing& missing, const std::vector<const Kind*>& kinds = {})
{
    scene.settle();
    const Body body(scene, kinds);
    measure(scene, body, errors);
    seek(scene, body, missing);
}

// Two equal balls on the x axis, linked.
Scene pair(double size, double apart, bool report98)
{
    Scene scene;
    scene.report98 = report98;
    scene.ball(size, -apart / 2, 0, 0);
    scene.ball(size, apart / 2, 0, 0);
    scene.link(0, 1);
    return scene;
}

// Compares two lists of voxels except for their slopes of brightness.
bool alike(const std::vector<Voxel>& a, const std::vector<Voxel>& b)
{
    if (a.size() != b.size())
        return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i].x != b[i].x || a[i].y != b[i].y || a[i].z != b[i].z ||
            a[i].halfWidth != b[i].halfWidth || a[i].halfHeight != b[i].halfHeight || a[i].tiltX != b[i].tiltX ||
            a[i].tiltY != b[i].tiltY || a[i].brightness != b[i].brightness || a[i].back != b[i].back)
            return false;
    return true;
}

// Counts the voxels whose slopes of brightness differ.
long otherSlopes(const std::vector<Voxel>& a, const std::vector<Voxel>& b)
{
    long count = 0;
    for (size_t i = 0; i < a.size(); ++i)
        count += a[i].slopeX != b[i].slopeX || a[i].slopeY != b[i].slopeY;
    return count;
}

bool identical(const std::vector<Voxel>& a, const std::vector<Voxel>& b)
{
    return alike(a, b) && otherSlopes(a, b) == 0;
}

}  // namespace

TEST(islands_between_heavily_linked_objects_are_found)
{
    // Two balls have parted. Half way there is an island, and each ball owns half of it.
    Scene scene;
    scene.ball(24, -14, 4, 0);
    scene.ball(18, 17, 4, 0);
    scene.link(0, 1, 4);
    scene.update();
    const Body body(scene);
    int there = 0, off = 0;
    for (const Voxel& voxel : scene.draw(0)) {
        const Vec p = placeOf(scene, voxel);
        if (p.x < 0)
            continue;
        ++there;
        off += std::fabs(body.field(body.joined(0), p) - 0.5) > 0.03;
    }
    note("%d scales of the first ball on the island, %d of them not on its surface", there, off);
    CHECK(there >= 2);
    SAME(off, 0);
    // With a lighter link there is none, and nothing is left of it.
    scene.link(0, 1, 1);
    scene.update();
    for (const Voxel& voxel : scene.draw(0))
        CHECK(placeOf(scene, voxel).x < 0);
}

TEST(bulges_stay_where_patches_fall_asleep)
{
    // The bulge rises from the far side of the large ball, where a third ball reaches, too: patches there face away and are judged
    // anew whenever something moves.
    Scene scene;
    scene.ball(32, 0, 0, 0);
    scene.ball(14, 31.4, 0, 10.2);
    scene.ball(18, 16, 4, 22);
    scene.link(0, 1, 3.1);
    scene.link(0, 2);
    int least = 1000, most = 0;
    for (int frame = 0; frame < 12; ++frame) {
        scene.update();
        int there = 0;
        for (const Voxel& voxel : scene.draw(0))
            there += size(placeOf(scene, voxel)) >= 21;
        least = std::min(least, there);
        most = std::max(most, there);
        scene.objects[1]->translate(vector(0, 0.06, 0));
        scene.objects[2]->translate(vector(0, frame % 2 == 0 ? 1 : -1, 0));
    }
    note("%d to %d scales of the large ball far out", least, most);
    CHECK(least >= 8);
    CHECK(most - least <= most / 4);
}

TEST(borders_of_cones_are_found)
{
    // Two cones that blend. Their borders are known to first order: where one is near, the two fields are nearly the same there.
    const Real measures[] = {Real(30), Real(8), Real(40)};
    Scene scene;
    scene.add(kindNamed("cone")->make(1, measures), -7, 0, 0);
    scene.add(kindNamed("cone")->make(2, measures), 7, 3, 0);
    scene.linkAll();
    scene.update();
    const std::vector<const Kind*> kinds{kindNamed("cone"), kindNamed("cone")};
    const Body body(scene, kinds);
    const SoftObject& object = *scene.objects[0];
    long borders = 0;
    double sum = 0;
    for (int i = 0; i < object.seedSlots(); i += 2) {
        const Seed& s = object.seed(i);
        if ((s.flags & (SEED_VALID | SEED_BORDER)) != (SEED_VALID | SEED_BORDER) || std::abs(s.apart) > 512)
            continue;
        const Vec place = vec(object.toWorld(object.root(s.root) + s.path * s.position));
        const Vec way{s.border.x / 16384.0, s.border.y / 16384.0, s.border.z / 16384.0};
        const Vec end = place - way * (s.apart / 256.0);
        ++borders;
        sum += std::fabs(body.dominance(0, body.joined(0), end));
    }
    note("%ld seeds have a border within two units, where the fields differ by %.4f on average", borders, sum / borders);
    CHECK(borders > 20);
    CHECK(sum / borders < 0.002);
}

TEST(bulges_are_found_where_patches_rest_or_face_away)
{
    // Paths of the large ball leave its surface where no neighbour reaches it, or on the side away from the viewer. The link to the
    // small ball raises the field again near the ends of these paths.
    Scene scene;
    scene.ball(32, 0, 0, 0);
    scene.ball(14, 31.4, 0, 10.2);
    scene.link(0, 1, 3.1);
    for (int frame = 0; frame < 3; ++frame) {
        scene.update();
        const Body body(scene);
        int there = 0, off = 0;
        for (const Voxel& voxel : scene.draw(0)) {
            const Vec p = placeOf(scene, voxel);
            if (size(p) < 20)
                continue;
            ++there;
            off += std::fabs(body.field(body.joined(0), p) - 0.5) > 0.03;
        }
        note("%d scales of the large ball far out, %d of them not on its surface", there, off);
        CHECK(there >= 8);
        SAME(off, 0);
        scene.objects[1]->translate(vector(0, 0.25, 0));
    }
    // The bulges disappear with the small ball.
    scene.objects[1]->translate(vector(0, 60, 0));
    scene.update();
    for (const Voxel& voxel : scene.draw(0))
        CHECK(size(placeOf(scene, voxel)) < 17);
}

TEST(unlinked_neighbours_pull_the_surface_inwards)
{
    // A small ball links four others into one body. Three of them are not linked with the first, and together they pull its
    // surface well inside the place where its seeds rest. At first one of them covers it, so that each of its paths is searched.
    Scene scene;
    scene.ball(16, 0, 0, 0);
    scene.ball(40, 0, 3, 0);
    scene.ball(40, 18, -10, -20);
    scene.ball(40, -18, -10, -20);
    scene.ball(5, 10, 0, 2);
    for (size_t i = 0; i < 4; ++i)
        scene.link(i, 4);
    scene.update();
    scene.objects[1]->moveTo(point(0, 21, -20));
    scene.update();
    const Body body(scene);
    const std::vector<size_t> joined = body.joined(0);
    const SoftObject& ball = *scene.objects[0];
    int deep = 0, lost = 0;
    for (int i = 0; i < ball.seedSlots(); i += 2) {
        const Seed& s = ball.seed(i);
        const Vec path = vec(s.path);
        const double position = body.leaves(joined, {0, 0, 0}, path);
        if (position > 0.87 || body.dominance(0, joined, path * position) > -0.1 || path.z > -2)
            continue;
        ++deep;
        lost += !(s.flags & SEED_VALID) || std::fabs(number(s.position) - position) > 0.03;
    }
    note("%d seeds deeper than 0.87, %d of them lost", deep, lost);
    CHECK(deep >= 5);
    SAME(lost, 0);
}

TEST(a_small_object_shows_what_surrounds_it)
{
    // In the field of a large ball almost all of the surface around a small one belongs to the large one, whose paths only graze
    // it. On all sides of the small ball that the viewer sees there is a scale near, in the large ball's colour.
    for (double away : {23.5, 25.0, 26.5}) {
        Scene scene;
        scene.ball(40, 0, 0, 0);
        scene.ball(6, -0.6 * away, 0, -0.8 * away, 1);
        scene.link(0, 1);
        scene.update();
        const Body body(scene);
        const std::vector<size_t> joined = body.joined(0);
        std::vector<size_t> owners;
        std::vector<Vec> places[2];
        const std::vector<Voxel> voxels = scene.draw(1, 256, &owners);
        for (size_t k = 0; k < voxels.size(); ++k)
            places[owners[k]].push_back(placeOf(scene, voxels[k]));
        int points = 0, bare = 0;
        const Vec centre = vec(scene.objects[1]->centre());
        for (int i = 0; i < 60; ++i)
            for (int j = 0; j < 30; ++j) {
                const double longitude = i * 6.2832 / 60, height = (j + 0.5) / 15 - 1, round = std::sqrt(1 - height * height);
                const Vec way{round * std::cos(longitude), height, round * std::sin(longitude)};
                double from = 0.1;
                while (from < 4.8 && body.field(joined, centre + way * from) > 0.5)
                    from += 0.02;
                const Vec p = centre + way * from, fall = body.fall(joined, p), toEye = vec(scene.eye) - p;
                if (from >= 4.8 || body.dominance(0, joined, p) > -0.03 || dot(fall, toEye) < 0.2 * size(fall) * size(toEye) ||
                    dot(fall, way) < 0.6 * size(fall))
                    continue;
                ++points;
                bare += distanceTo(places[0], p) > 2;
            }
        // The scales of both colours end where the two fields are equal.
        const SoftObject& small = *scene.objects[1];
        double off = 0;
        int borders = 0;
        for (int i = 0; i < small.seedSlots(); i += 2) {
            const Seed& s = small.seed(i);
            const double apart = s.apart / 256.0;
            if (!(s.flags & SEED_VALID) || !(s.flags & SEED_BORDER) || apart > 0.5)
                continue;
            const Vec p = centre + vec(s.path) * number(s.position);
            const Vec border = Vec{static_cast<double>(s.border.x), static_cast<double>(s.border.y),
                                   static_cast<double>(s.border.z)} * (1 / 16384.0);
            const double is = s.flags & SEED_GUEST ? 1 : -1;
            CHECK(is * body.dominance(1, joined, p) > -0.06);
            off = std::fmax(off, std::fabs(body.dominance(1, joined, p - border * apart)));
            ++borders;
        }
        CHECK(borders > 0);
        CHECK(off < 0.03);
        note("%.1f units away: %zu scales in the small ball's colour, %zu in the large one's; %d of %d points bare", away,
             places[1].size(), places[0].size(), bare, points);
        note("%d borders, where the fields differ by %.4f at most", borders, off);
        CHECK(places[0].size() >= 10);
        CHECK(points > 50);
        CHECK(bare <= points / 100);
    }
}

TEST(bulges_have_an_outer_side)
{
    // Two small balls raise the field beside the large ball: its paths enter the surface again there and then leave it for good.
    for (double away : {33.0, 33.5, 34.0}) {
        Scene scene;
        scene.ball(45, 0, 0, 0);
        scene.ball(15, away, 4, -4);
        scene.ball(15, away, -4, -4);
        scene.link(0, 1, 3.9);
        scene.link(0, 2, 3.9);
        scene.link(1, 2, 3.9);
        scene.update();
        const SoftObject& large = *scene.objects[0];
        const Body body(scene);
        int enters = 0, leaves = 0;
        double worst = 0;
        for (int i = 0; i < large.seedSlots(); i += 2) {
            const Seed* const fine = large.fine(i);
            if (fine == nullptr)
                continue;
            enters += (fine[SoftObject::FINE_ISLAND].flags & SEED_VALID) != 0;
            const Seed& end = fine[SoftObject::FINE_ISLAND_END];
            if (!(end.flags & SEED_VALID))
                continue;
            ++leaves;
            const Vec p = vec(large.root(end.root)) + vec(end.path) * number(end.position);
            worst = std::max(worst, std::fabs(body.field(body.joined(0), p) - 0.5));
            CHECK(dot(body.fall(body.joined(0), p), vec(end.path)) > 0);
        }
        note("%.1f away: %d paths come back, %d leave again, off by %.3f at most", away, enters, leaves, worst);
        CHECK(enters > 0 && leaves > 0);
        CHECK(worst < 0.03);
    }
}

TEST(walls_of_necks_have_scales)
{
    // Along the sides of a thin neck paths run on the surface: hardly any of them leaves it there.
    for (double away : {37.5, 38.0, 38.5}) {
        Scene scene;
        scene.ball(36, -away / 2, 0, 0);
        scene.ball(24, away / 2, 0, 0);
        scene.linkAll();
        scene.update();
        const Body body(scene);
        const std::vector<size_t> joined = body.joined(0);
        const std::vector<Vec> places[] = {placesOf(scene, 0), placesOf(scene, 1)};
        int points = 0, bare = 0;
        double farthest = 0;
        for (double x = -away / 2 + 18; x < away / 2 - 12; x += 0.25)
            for (int k = 0; k < 48; ++k) {
                const Vec across{0, std::cos(k * 6.2832 / 48), std::sin(k * 6.2832 / 48)};
                const Vec p = surfaceFrom(body, joined, {x, 0, 0}, across), toEye = vec(scene.eye) - p;
                if (dot(body.fall(joined, p), toEye) < 0.4 * size(body.fall(joined, p)) * size(toEye))
                    continue;
                const double nearest = std::fmin(distanceTo(places[0], p), distanceTo(places[1], p));
                ++points;
                bare += nearest > 2;
                farthest = std::fmax(farthest, nearest);
            }
        note("%.1f away: %d of %d points bare, %.2f units from a scale at most", away, bare, points, farthest);
        CHECK(points > 30);
        CHECK(bare <= points / 50);
    }
}

TEST(bulges_of_heavy_links_are_seen_from_everywhere)
{
    // A heavy link makes a bulge like a collar between two balls. What faces the viewer is drawn, though most of its patch faces
    // away.
    int points = 0, bare = 0;
    for (int view = 0; view < 24; ++view) {
        Scene scene;
        const double turn = view * 6.2832 / 24, away = 34;
        scene.ball(40, -away / 2 * std::cos(turn), 4, -away / 2 * std::sin(turn));
        scene.ball(26, away / 2 * std::cos(turn), -4, away / 2 * std::sin(turn));
        scene.link(0, 1, 3.5);
        scene.settle();
        const Body body(scene);
        const std::vector<size_t> joined = body.joined(0);
        const std::vector<Vec> places[] = {placesOf(scene, 0), placesOf(scene, 1)};
        const Vec axis = vec(scene.objects[1]->centre()) - vec(scene.objects[0]->centre());
        const Vec side{axis.z, 0, -axis.x}, other{axis.x * axis.y, -(axis.x * axis.x + axis.z * axis.z), axis.y * axis.z};
        for (double along = 0.3; along < 0.8; along += 0.01)
            for (int k = 0; k < 48; ++k) {
                const double round = k * 6.2832 / 48;
                const Vec across = side * (std::cos(round) / size(side)) + other * (std::sin(round) / size(other));
                const Vec from = vec(scene.objects[0]->centre()) + axis * along;
                if (body.field(joined, from) <= 0.5)
                    continue;
                const Vec p = surfaceFrom(body, joined, from, across), toEye = vec(scene.eye) - p, fall = body.fall(joined, p);
                if (dot(fall, toEye) < 0.3 * size(fall) * size(toEye))
                    continue;
                const double nearest = std::fmin(distanceTo(places[0], p), distanceTo(places[1], p));
                ++points;
                bare += nearest > 2.5;
            }
    }
    note("%d of %d points bare", bare, points);
    CHECK(points > 1000);
    CHECK(bare <= points / 100);
}

TEST(diagonal_bands_are_covered)
{
    // Rings of seeds on a torus that is seen from everywhere: each place that faces the viewer lies behind some scale. The scale
    // need not be one beside the place, but it must be no farther behind it than a tangent plane may be.
    Random random;
    int points = 0, bare = 0;
    for (int round = 0; round < 40; ++round) {
        Scene scene;
        SoftObject& torus = scene.add(new Torus(1, Real(16), Real(20)), 0, 0, 0);
        torus.rotate(torus.centre(), vector(random.between(-1, 1), random.between(-1, 1), 1), random.bits());
        scene.update();
        const std::vector<Voxel> voxels = scene.draw(0);
        for (int k = 0; k < 3000; ++k) {
            const double longitude = random.between(0, 6.2832), latitude = random.between(0, 6.2832);
            const Vec out{std::cos(latitude) * std::cos(longitude), std::sin(latitude), std::cos(latitude) * std::sin(longitude)};
            const Vec core{20 * std::cos(longitude), 0, 20 * std::sin(longitude)};
            const auto inWorld = [&](const Vec& v) { return vec(torus.toWorld(vector(v.x, v.y, v.z))); };
            const Vec p = inWorld(core + out * 8) - vec(scene.eye), normal = inWorld(out) - inWorld({0, 0, 0});
            if (-dot(normal, p) < 0.7 * size(p))
                continue;
            ++points;
            bool covered = false;
            for (const Voxel& v : voxels) {
                const double z = v.z / 256.0, x = p.x * z / p.z - v.x / 256.0, y = p.y * z / p.z - v.y / 256.0;
                covered = covered || (std::fabs(x) <= v.halfWidth / 256.0 && std::fabs(y) <= v.halfHeight / 256.0 &&
                                      std::fabs(z + (x * v.tiltX + y * v.tiltY) / 256.0 - p.z) < 1);
            }
            bare += !covered;
        }
    }
    note("%d of %d points are not covered", bare, points);
    CHECK(points > 10000);
    CHECK(bare <= points / 4000);
}

TEST(an_object_alone)
{
    for (int k = 0; k < KIND_COUNT; ++k) {
        Errors errors;
        Missing missing;
        Random random;
        for (int round = 0; round < 6; ++round) {
            Scene scene;
            scene.add(makeOf(KINDS[k], 1), random.between(-30, 30), random.between(-20, 20), random.between(-20, 40));
            scene.objects[0]->rotate(scene.objects[0]->centre(), vector(random.between(-1, 1), random.between(-1, 1), 1),
                                     random.bits());
            look(scene, errors, missing, {&KINDS[k]});
            SAME(scene.counts.updated, 0);
            SAME(scene.counts.normals, 0);
        }
        judge(KINDS[k].word, errors, missing);
        SAME(missing.missing, 0);
        CHECK(errors.worst < 0.05);
    }
}

TEST(balls_of_any_size_anywhere)
{
    Random random;
    Errors errors;
    Missing missing;
    for (int round = 0; round < 30; ++round) {
        Scene scene;
        const int count = 2 + random.below(4);
        std::vector<Vector> speed;
        for (int i = 0; i < count; ++i) {
            scene.ball(random.between(6, 45), random.between(-25, 25), random.between(-20, 20), random.between(-25, 25),
                       random.between(1.5, 4));
            speed.push_back(vector(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)));
        }
        scene.linkAll();
        for (int frame = 0; frame < 6; ++frame) {
            look(scene, errors, missing);
            for (size_t i = 0; i < speed.size(); ++i)
                scene.objects[i]->translate(speed[i]);
        }
    }
    judge("balls", errors, missing);
}

TEST(every_kind_with_every_kind)
{
    for (int a = 0; a < KIND_COUNT; ++a) {
        for (int b = 0; b <= a; ++b) {
            Errors errors;
            Missing missing;
            Random random;
            Scene scene;
            const std::vector<const Kind*> kinds{&KINDS[a], &KINDS[b]};
            scene.add(makeOf(KINDS[a], 1), -9, 0, 0);
            scene.add(makeOf(KINDS[b], 2), 9, 2, 3);
            scene.linkAll();
            for (int frame = 0; frame < 6; ++frame) {
                look(scene, errors, missing, kinds);
                scene.objects[0]->translate(vector(0.7, -0.3, 0.2));
                scene.objects[0]->rotate(scene.objects[0]->centre(), vector(1, 2, -1), 0x04000000u);
                scene.objects[1]->rotate(scene.objects[1]->centre(), vector(1, 0.5, 3), 0x05000000u);
            }
            judge((std::string(KINDS[a].word) + " and " + KINDS[b].word).c_str(), errors, missing);
            CHECK(scene.counts.updated > 0);
        }
    }
}

TEST(an_eye_that_goes_round)
{
    // An object of every kind together with a ball is seen from all sides by an eye that leans, and looks at it or past it.
    for (int k = 0; k < KIND_COUNT; ++k) {
        Errors errors;
        Missing missing;
        Random random;
        Scene scene;
        const std::vector<const Kind*> kinds{&KINDS[k], kindNamed("sphere")};
        scene.add(makeOf(KINDS[k], 1), -9, 0, 0);
        scene.add(makeOf(*kinds[1], 2), 9, 2, 3);
        scene.linkAll();
        for (int frame = 0; frame < 12; ++frame) {
            const Vector away = withLength(vector(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)), Real(110));
            scene.eye = toPoint(away);
            scene.axes = viewAlong(vector(random.between(-20, 20), 0, 0) - away, vector(0, 1, 0), vector(1, 0, 0));
            if (frame & 1)
                scene.axes = leaned(scene.axes, random.bits());
            CHECK(scene.axes.turned);
            for (auto& object : scene.objects)
                object->setRecalc();
            look(scene, errors, missing, kinds);
        }
        judge((std::string("round a ") + KINDS[k].word).c_str(), errors, missing);
    }
}

TEST(a_turned_eye_sees_what_a_turned_scene_shows)
{
    // A ring and two balls in front of an unturned eye must give the same scales as the scene turned as a whole together with the
    // eye. The report's own methods do not depend on the turn either.
    for (bool report98 : {false, true}) {
        Random random;
        const Matrix by = Matrix::rotation(vector(1, 2, -1), 0x15000000u);
        Scene straight, turned;
        for (Scene* scene : {&straight, &turned}) {
            const bool other = scene == &turned;
            scene->report98 = report98;
            const Vector places[] = {vector(0, 0, 0), vector(20, 5, -10), vector(-15, -12, 6)};
            for (int i = 0; i < 3; ++i) {
                const Vector at = other ? by * places[i] : places[i];
                scene->add(makeOf(*kindNamed(i == 0 ? "torus" : "sphere"), i + 1), number(at.x), number(at.y), number(at.z));
            }
            if (other) {
                scene->eye = toPoint(by * toVector(scene->eye));
                scene->axes = turnedBy(by, scene->axes);
                scene->light = by * scene->light;
                scene->objects[0]->setTurn(by);
            }
            scene->linkAll();
            scene->update();
        }
        View a, b;
        CHECK(a.open() && b.open());
        a.begin();
        b.begin();
        for (size_t i = 0; i < 3; ++i) {
            straight.show(i, {&a});
            turned.show(i, {&b});
        }
        // Balls do not turn with the scene, so their seeds are elsewhere: the surface is the same, but its scales are not.
        long drawn = 0, off = 0, alone = 0;
        for (int i = 0; i < machine::WIDTH * machine::HEIGHT; ++i) {
            const int za = a.zbuffer()[i], zb = b.zbuffer()[i];
            drawn += za != Z_EMPTY;
            alone += (za == Z_EMPTY) != (zb == Z_EMPTY);
            off += za != Z_EMPTY && zb != Z_EMPTY && std::abs(za - zb) > 2 * 128;
        }
        note("%ld pixels, %ld of one alone, %ld with other depths", drawn, alone, off);
        CHECK(drawn > 5000);
        CHECK(alone < drawn / 100);
        CHECK(off < drawn / 200);
    }
}

TEST(a_ball_along_a_long_one_close_to_the_viewer)
{
    for (double spacing : {2.0, 1.0}) {
        Errors errors;
        Missing missing;
        Scene scene;
        const std::vector<const Kind*> kinds{kindNamed("cylinder"), kindNamed("sphere")};
        const Real measures[] = {Real(14), Real(90)};
        scene.add(kinds[0]->make(1, measures), 0, 4, -60, spacing);
        scene.add(makeOf(*kinds[1], 2), -44, 12, -55, spacing);
        scene.linkAll();
        scene.objects[0]->rotate(scene.objects[0]->centre(), vector(0, 0, 1), 0x40000000u);
        for (int frame = 0; frame < 12; ++frame) {
            if (frame > 0)
                scene.objects[0]->rotate(scene.objects[0]->centre(), vector(0, 1, 0.2), 0x0a000000u);
            scene.objects[1]->moveTo(point(-44 + 8 * frame, 12, -55));
            look(scene, errors, missing, kinds);
        }
        judge(spacing == 2 ? "two units" : "one unit", errors, missing);
    }
}

TEST(of_two_fields_that_are_the_same_the_first_has_the_surface)
{
    // A ball stands at the end of a tube of its size: round that end the two fields are the same, and elsewhere the tube's is the
    // stronger.
    const Real measures[] = {Real(20), Real(40)};
    for (const bool ballFirst : {false, true}) {
        Scene scene;
        const auto addTube = [&] { scene.add(kindNamed("cylinder")->make(1, measures), 3, -2, 10); };
        if (!ballFirst)
            addTube();
        SoftObject& ball = scene.ball(20, 3, 18, 10);
        if (ballFirst)
            addTube();
        SoftObject& tube = *scene.objects[ballFirst ? 1 : 0];
        scene.linkAll();
        long ofBall = 0, ofTube = 0;
        for (int frame = 0; frame < 20; ++frame) {
            scene.update();
            const Vec end = vec(ball.centre()), way = (end - vec(tube.centre())) * (1 / 20.0);
            const auto isOnCap = [&](const Voxel& v) { return dot(placeOf(scene, v) - end, way) > 1.5; };
            for (const Voxel& v : scene.draw(ballFirst ? 0 : 1))
                ofBall += isOnCap(v);
            for (const Voxel& v : scene.draw(ballFirst ? 1 : 0))
                ofTube += isOnCap(v);
            for (SoftObject* const object : {&ball, &tube})
                object->rotate(point(3, -2, 10), vector(1, 0.3, 0.2), 0x0b000000u);
        }
        note("%ld voxels of the ball and %ld of the tube round the end", ofBall, ofTube);
        CHECK((ballFirst ? ofBall : ofTube) > 300);
        SAME(ballFirst ? ofTube : ofBall, 0);
    }
}

TEST(of_two_balls_at_one_place_the_first_has_the_surface)
{
    // However heavy their link is. A heavy one lets each of two balls show what belongs to the other.
    for (const double weight : {1.0, 2.0, 4.0}) {
        Scene scene;
        for (int i = 0; i < 2; ++i)
            scene.ball(20, -36, 12, 0);
        scene.link(0, 1, weight);
        for (int frame = 0; frame < 12; ++frame) {
            for (const auto& ball : scene.objects)
                ball->translate(vector(1.3, -0.4, 0.7));
            scene.update();
            std::vector<size_t> owners;
            CHECK(scene.draw(0, 256, &owners).size() > 100);
            CHECK(std::count(owners.begin(), owners.end(), 0u) == static_cast<long>(owners.size()));
            CHECK(scene.draw(1).empty());
        }
    }
}

TEST(chains)
{
    // Each object is linked only with the one before; objects two places apart are in range of each other too.
    Errors errors;
    Missing missing;
    for (double apart : {6.0, 9.0, 13.0}) {
        Scene scene;
        for (int i = 0; i < 5; ++i)
            scene.ball(20 + 3 * (i & 1), apart * (i - 2), 2 * (i & 1), 3 * (i % 3));
        for (size_t i = 1; i < 5; ++i)
            scene.link(i - 1, i);
        for (int frame = 0; frame < 4; ++frame) {
            look(scene, errors, missing);
            scene.objects[2]->translate(vector(0.5, 1, 0));
        }
    }
    judge("chains", errors, missing);
    // Two objects without a link are two bodies, wherever they are.
    Scene apart;
    apart.ball(20, -4, 0, 0);
    apart.ball(20, 4, 0, 0);
    apart.update();
    SAME(apart.counts.updated, 0);
    const Body body(apart);
    Errors alone;
    measure(apart, body, alone);
    CHECK(alone.count > 100);
    SAME(alone.astray, 0);
}

TEST(weights)
{
    for (double weight : {0.25, 0.5, 1.5, 2.0, 3.0, 4.0}) {
        Errors errors;
        Missing missing;
        for (double apart : {22.0, 16.0, 12.0}) {
            Scene scene;
            scene.ball(24, -apart / 2, 0, 0);
            scene.ball(20, apart / 2, 3, 2);
            scene.link(0, 1, weight);
            look(scene, errors, missing);
            // One body has links of several weights, and one link is missing.
            Scene three;
            three.ball(24, -apart / 2, 0, 0);
            three.ball(20, apart / 2, 3, 2);
            three.ball(22, 0, apart / 2, -2);
            three.link(0, 1, weight);
            three.link(1, 2, 1);
            look(three, errors, missing);
        }
        judge(("weight " + std::to_string(weight).substr(0, 4)).c_str(), errors, missing);
    }
}

TEST(crowds)
{
    const auto held = [](const char* what, Scene& scene) {
        Errors errors;
        Missing missing;
        for (int frame = 0; frame < 3; ++frame) {
            for (auto& object : scene.objects)
                object->setRecalc();
            look(scene, errors, missing);
        }
        judge(what, errors, missing);
    };
    {
        // Objects at one position are equally strong everywhere, and the first of them is visible.
        Scene scene;
        for (int i = 0; i < 40; ++i)
            scene.ball(20, 0, 0, 0, 4);
        scene.linkAll();
        scene.update();
        const Body body(scene);
        Errors errors;
        measure(scene, body, errors);
        errors.report("40 at one place");
        CHECK(errors.count > 25);
        SAME(static_cast<long>(scene.draw(0).size()), errors.count);
        SAME(errors.astray, 0);
        SAME(errors.foreign, 0);
    }
    {
        Scene scene;
        scene.ball(20, 0, 0, 0);
        scene.ball(20, 0, 0, 0);
        scene.link(0, 1, 2);
        scene.update();
        const Body body(scene);
        Errors errors;
        measure(scene, body, errors);
        errors.report("two at one place, weight 2");
        CHECK(errors.count > 100);
        SAME(errors.astray, 0);
        SAME(errors.foreign, 0);
    }
    {
        Scene scene;
        scene.ball(24, -4, 0, 0);
        scene.ball(20, 4, 0, 0);
        scene.link(0, 1, 2);
        held("24 and 20, 8 apart, weight 2", scene);
    }
    {
        Random random;
        Scene scene;
        for (int i = 0; i < 40; ++i)
            scene.ball(random.between(10, 24), random.between(-14, 14), random.between(-14, 14), random.between(-14, 14), 3);
        scene.linkAll();
        held("40 in a crowd", scene);
    }
}

TEST(what_moves_leaves_no_trace)
{
    // A small ball goes around two large ones, in small steps and in leaps. The objects that it has passed must look as if it had
    // never been there.
    for (int steps : {240, 12}) {
        Scene scene;
        scene.ball(60, -8, 0, 16);
        scene.ball(40, 24, 8, 10);
        scene.ball(10, 30, 0, 0);
        scene.linkAll();
        Errors errors;
        Missing missing;
        for (int step = 0; step <= steps; ++step) {
            const double angle = step * 2 * M_PI / steps;
            scene.objects[2]->moveTo(point(30 * std::cos(angle), 30 * std::sin(angle), 0));
            scene.update();
            if (step % (steps / 6) != 0)
                continue;
            const Body body(scene);
            measure(scene, body, errors);
            seek(scene, body, missing);
        }
        judge(steps > 100 ? "small steps" : "leaps", errors, missing);
    }
}

TEST(a_seed_that_stays_may_get_another_normal)
{
    // A ball goes round another. Seeds on the axis stay where they are, but the surface turns there. First it leaps to the mirror
    // image of its place, then it goes on by steps of two units.
    Scene moved;
    SoftObject& ball = moved.ball(24, 0, 0, 0);
    const auto placeAt = [](int step) {
        const double angle = step == 0 ? -0.37 : 0.37 + step * 0.14;
        return point(13.9 * std::cos(angle), 13.9 * std::sin(angle), -6);
    };
    SoftObject& other = moved.ball(20, number(placeAt(0).x), number(placeAt(0).y), -6);
    moved.linkAll();
    double leapt = 0, walked = 0;
    for (int step = 0; step < 40; ++step) {
        other.moveTo(placeAt(step));
        moved.update();
        Scene fresh;
        fresh.ball(24, 0, 0, 0);
        fresh.ball(20, number(placeAt(step).x), number(placeAt(step).y), -6);
        fresh.linkAll();
        fresh.update();
        for (int i = 0; i < ball.seedSlots(); i += 2) {
            const Seed &a = ball.regular(i), &b = fresh.objects[0]->regular(i);
            if (!(a.flags & b.flags & SEED_VALID))
                continue;
            const double off = std::hypot(a.normal.x - b.normal.x, a.normal.y - b.normal.y, a.normal.z - b.normal.z) / 16384;
            double& worst = step == 1 ? leapt : walked;
            worst = std::fmax(worst, off);
        }
    }
    note("normals are off by %.3f at most after the leap, by %.3f on the way", leapt, walked);
    CHECK(leapt < 0.05);
    CHECK(walked < 0.4);
}

TEST(what_turns_is_lit_anew)
{
    Scene scene;
    const std::vector<const Kind*> kinds{kindNamed("cone"), kindNamed("cylinder")};
    scene.add(makeOf(*kinds[0], 1), -10, 0, 0);
    scene.add(makeOf(*kinds[1], 2), 14, 0, 0);
    scene.link(0, 1);
    Errors errors;
    Missing missing;
    for (int frame = 0; frame < 16; ++frame) {
        look(scene, errors, missing, kinds);
        scene.objects[0]->rotate(scene.objects[0]->centre(), vector(1, 0.5, 0.2), 0x09000000u);
        scene.objects[1]->rotate(scene.objects[1]->centre(), vector(0, 1, 1), 0x15000000u);
        if (frame == 9)
            scene.objects[1]->moveTo(point(60, 0, 0));
    }
    judge("turning", errors, missing);
}

TEST(what_grows_takes_its_seeds_along)
{
    Scene scene;
    scene.ball(20, -8, 0, 0);
    scene.ball(20, 8, 0, 0);
    scene.link(0, 1);
    Errors errors;
    Missing missing;
    for (double to : {22.0, 24.0, 27.0, 31.0, 22.0, 12.0, 17.0}) {
        scene.objects[0]->setSize(real(to));
        look(scene, errors, missing);
    }
    judge("growing", errors, missing);
}

// Measures by how many steps the stored positions of an object's seeds at rest, and their distances along the normals (Seed::out),
// are off, and counts these seeds.
double restsOff(const SoftObject& object, long& count)
{
    double worst = 0;
    const auto look = [&](const Seed* s) {
        if (s == nullptr || (s->flags & (SEED_VALID | SEED_RESTING)) != (SEED_VALID | SEED_RESTING))
            return;
        const Vec rest = vec(object.root(s->root) + s->path) * std::pow(2, 16 - object.placeShift());
        const Vec place{s->place[0] + 0.5, s->place[1] + 0.5, s->place[2] + 0.5};
        const Vec normal = Vec{s->normal.x + 0.0, s->normal.y + 0.0, s->normal.z + 0.0} * (1.0 / 16384);
        worst = std::fmax(worst, std::fmax(size(place - rest), std::fabs(dot(normal, rest) - s->out)));
        ++count;
    };
    for (int i = 0; i < object.seedSlots(); i += 2) {
        look(&object.seed(i));
        look(object.extra(i));
    }
    return worst;
}

TEST(seeds_at_rest_know_their_places)
{
    Scene scene;
    scene.ball(20, -30, 0, 0);
    scene.ball(24, 30, 0, 0);
    scene.add(new Torus(3, real(16), real(130)), 0, 0, 200, 8);
    SoftObject& warped = scene.add(new Torus(4, real(14), real(24)), 0, 30, 0);
    scene.linkAll();
    long count = 0;
    double worst = 0;
    for (double x : {-30.0, -14.0, -8.0, 6.0, -20.0, -60.0}) {
        scene.objects[0]->moveTo(point(x, 4, 0));
        warped.setWarp({{Real(0), real(x * 2), Real(0)}});
        scene.update();
        for (const auto& object : scene.objects)
            worst = std::fmax(worst, restsOff(*object, count));
    }
    note("%ld seeds at rest, %.2f steps off at most", count, worst);
    CHECK(count > 5000);
    CHECK(worst < 2.5);
    CHECK(scene.objects[2]->placeShift() > 8);
}

TEST(what_has_not_changed_is_left_alone)
{
    for (bool report98 : {false, true}) {
        Scene scene = pair(20, 15, report98);
        scene.update();
        CHECK(scene.counts.updated > 0);
        CHECK(!scene.objects[0]->recalc());
        const std::vector<Voxel> before[2] = {scene.draw(0), scene.draw(1)};
        CHECK(before[0].size() > 30 && before[1].size() > 30);
        scene.counts = Counts{};
        scene.update();
        SAME(scene.counts.updated, 0);
        SAME(scene.counts.iterations, 0);
        for (size_t o = 0; o < 2; ++o)
            CHECK(identical(before[o], scene.draw(o)));
    }
}

// How many seeds of an object are on the surface.
static int validSeeds(const SoftObject& object)
{
    int valid = 0;
    for (int i = 0; i < object.seedSlots(); i += 2)
        valid += (object.regular(i).flags & SEED_VALID) != 0;
    return valid;
}

TEST(seeds_of_an_object_with_a_new_shape_settle)
{
    // Nothing changes but the object's own shape. Its seeds must settle as in a model that begins with that shape.
    const auto made = [](Scene& scene) {
        scene.add(new Torus(1, real(20), real(24)), 0, 0, 0);
        scene.ball(24, 24, 12, 0);
        scene.linkAll();
    };
    const auto settled = [](Scene& scene, double twist) {
        scene.objects[0]->setWarp({{Real(0), real(twist), real(twist / 2)}});
        scene.update();
        return validSeeds(*scene.objects[0]);
    };
    Scene scene;
    made(scene);
    for (double twist = 0; twist < 60; twist += 8) {
        const int before = settled(scene, twist);
        Scene fresh;
        made(fresh);
        const int anew = settled(fresh, twist);
        note("twisted by %g: %d seeds on the surface, %d in a new model", twist, before, anew);
        CHECK(before > 100 && before > anew * 0.98 && before < anew * 1.02);
    }
}

TEST(what_digs_into_several_objects_finds_the_hollow_where_it_is)
{
    // Two balls far from each other, and one that digs into both, in turn.
    const auto place = [](bool second) { return point(second ? 94 : 14, 0, -9); };
    const auto made = [](Scene& scene) {
        scene.ball(40, 0, 0, 0);
        scene.ball(40, 80, 0, 0);
        scene.ball(24, 14, 0, -9);
        scene.dent(0, 2);
        scene.dent(1, 2);
    };
    Scene moved;
    made(moved);
    for (const bool second : {false, true, false}) {
        moved.objects[2]->moveTo(place(second));
        moved.settle();
        Scene fresh;
        made(fresh);
        fresh.objects[2]->moveTo(place(second));
        fresh.update();
        CHECK(moved.objects[2]->hollowed() == moved.objects[second].get());
        for (size_t i = 0; i < 3; ++i)
            NEAR(validSeeds(*moved.objects[i]), validSeeds(*fresh.objects[i]), validSeeds(*fresh.objects[i]) / 50 + 2);
        note("in the %s ball: %d seeds on the wall", second ? "second" : "first", validSeeds(*moved.objects[2]));
        CHECK(validSeeds(*moved.objects[2]) > 100);
    }
}

TEST(a_hollow_in_two_objects_has_both_colours)
{
    // A ball digs into two that blend. Its seeds on the wall belong to whichever of the two has the stronger field there.
    Scene scene;
    scene.ball(40, 0, 0, 0);
    scene.ball(40, 20, 0, 0);
    scene.ball(24, 9, 0, -16);
    scene.link(0, 1);
    scene.dent(0, 2);
    scene.dent(1, 2);
    scene.update();
    const SoftObject &digger = *scene.objects[2], &head = *digger.hollowed();
    CHECK(&head == scene.objects[0].get());
    int count[2] = {}, wrong = 0;
    for (int i = 0; i < digger.seedSlots(); i += 2) {
        const Seed& s = digger.regular(i);
        if (!(s.flags & SEED_VALID))
            continue;
        const Point p = digger.toWorld(digger.root(s.root) + s.path * s.position);
        const double ahead = number(scene.objects[0]->fieldFunc(p)) - number(scene.objects[1]->fieldFunc(p));
        const bool guest = (s.flags & SEED_GUEST) != 0;
        ++count[guest];
        wrong += std::fabs(ahead) > 0.02 && guest != (ahead < 0);
        CHECK(!guest || s.host == scene.objects[1]->slot());
    }
    note("%d seeds of the first ball's colour, %d of the second's", count[0], count[1]);
    CHECK(count[0] > 30 && count[1] > 30 && count[0] + count[1] > 90);
    SAME(wrong, 0);
}

TEST(the_wall_of_a_hollow_that_moves_is_found)
{
    // A ball digs its way around another. Seeds that wait because they are off the wall must be there when the wall arrives: all
    // valid seeds lie on the surface, and there are almost as many as when all seeds are searched for afresh.
    const auto place = [](int frame) { return point(14 * std::cos(frame * 0.03), 14 * std::sin(frame * 0.03), -9); };
    const auto valid = [](const Scene& scene, double* worst) {
        int count = 0;
        for (const auto& object : scene.objects) {
            for (int i = 0; i < object->seedSlots(); i += 2) {
                const Seed& s = object->seed(i);
                if (!(s.flags & SEED_VALID))
                    continue;
                ++count;
                const Vec at = vec(object->centre()) + vec(object->root(s.root)) + vec(s.path) * number(s.position);
                const auto field = [&](size_t o, double size) {
                    const Vec d = at - vec(scene.objects[o]->centre());
                    const double t = (d.x * d.x + d.y * d.y + d.z * d.z) / (size * size);
                    return t >= 1 ? 0 : 1 - t * (22.0 / 9 - t * (17.0 / 9 - t * 4 / 9));
                };
                *worst = std::max(*worst, std::abs(field(0, 40) - field(1, 24) - 0.5));
            }
        }
        return count;
    };
    Scene moved;
    moved.ball(40, 0, 0, 0);
    moved.ball(24, 14, 0, -9);
    moved.dent(0, 1);
    long found = 0, all = 0;
    for (int frame = 0; frame < 60; ++frame) {
        moved.objects[1]->moveTo(place(frame));
        moved.update();
        if (frame % 6 != 5)
            continue;
        moved.settle();
        Scene fresh;
        fresh.ball(40, 0, 0, 0);
        fresh.ball(24, 14, 0, -9);
        fresh.objects[1]->moveTo(place(frame));
        fresh.dent(0, 1);
        fresh.update();
        double worst = 0, worstFresh = 0;
        found += valid(moved, &worst);
        all += valid(fresh, &worstFresh);
        CHECK(worst < 0.03);
        CHECK(worstFresh < 0.03);
    }
    CHECK(all > 1000);
    note("%ld seeds on the wall and beside it, %ld when looked for anew", found, all);
    CHECK(found > all - all / 50 && found < all + all / 50);
    // Not all seeds are updated in each frame, because most of them are off the wall.
    moved.counts = Counts{};
    moved.objects[1]->moveTo(place(60));
    moved.update();
    CHECK(moved.counts.updated < static_cast<uint32_t>(moved.objects[0]->seedSlots() / 2));
}

TEST(what_is_odd_leaves_no_trace)
{
    // A strong ball passes another one; after it is gone, a ball of ordinary strength comes to that one.
    Scene scene;
    scene.ball(40, 0, 0, 0);
    scene.ball(30, 60, 0, 0);
    scene.ball(16, -60, 0, 0);
    scene.objects[2]->setStrength(real(1.6));
    scene.linkAll();
    for (int frame = 0; frame < 30; ++frame) {
        scene.objects[2]->moveTo(point(-60 + 2 * (frame < 15 ? frame : 29 - frame), 0, 0));
        scene.update();
    }
    Errors errors;
    Missing missing;
    for (int frame = 0; frame < 60; ++frame) {
        scene.objects[1]->moveTo(point(60 - frame, 0, 0));
        scene.update();
        if (frame % 6 != 5)
            continue;
        scene.settle();
        const Body body(scene);
        measure(scene, body, errors);
        seek(scene, body, missing);
    }
    judge("something strong has gone past", errors, missing);
}

TEST(only_what_is_near_is_told)
{
    for (bool report98 : {false, true}) {
        Scene scene = pair(20, 80, report98);
        scene.update();
        CHECK(!scene.objects[0]->recalc() && !scene.objects[1]->recalc());
        // An object that moves out of range does not tell the other one.
        scene.objects[0]->translate(vector(1, 0, 0));
        CHECK(scene.objects[0]->recalc());
        CHECK(!scene.objects[1]->recalc());
        scene.update();
        // "This works as long as there are no huge jumps": here jumps into and out of range are safe.
        scene.objects[0]->moveTo(point(30, 0, 0));
        CHECK(scene.objects[1]->recalc());
        scene.update();
        scene.objects[0]->moveTo(point(-60, 0, 0));
        CHECK(scene.objects[1]->recalc());
        scene.update();
        scene.objects[0]->translate(vector(-1, 0, 0));
        CHECK(!scene.objects[1]->recalc());
        // Objects that blend tell each other of every change.
        Scene near = pair(20, 19, report98);
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

TEST(drawing_in_parts)
{
    // The voxels are the same however little room there is for them at a time. Only slopes of brightness differ, where one part of
    // the list ends and the next begins, because fewer neighbours are known there.
    for (bool report98 : {false, true}) {
        Scene scene = pair(60, 30, report98);
        scene.update();
        const std::vector<Voxel> whole = scene.draw(0, VOXELS_AT_ONCE);
        CHECK(whole.size() > 200);
        for (int room : {DRAW_ROOM, DRAW_ROOM + 1, 200, 333}) {
            const std::vector<Voxel> parts = scene.draw(0, room);
            CHECK(alike(whole, parts));
            CHECK(otherSlopes(whole, parts) <= (report98 ? 0 : static_cast<long>(whole.size()) / 4));
        }
    }
}
