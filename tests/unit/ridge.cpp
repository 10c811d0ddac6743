// Tests of ridges, where a surface bends outwards sharply: the seeds on both sides are told, and scales neither stand out over the
// other side nor take its brightness.
#include <algorithm>
#include <cmath>

#include "model/cone.h"
#include "model/cylinder.h"
#include "help.h"
#include "test.h"

namespace {

// A soft cone. Its side meets the round of its large end, which is the lower one, in a ridge.
struct Steep {
    double size, tip, length;

    SoftObject* make() const { return new Cone(1, real(size), real(tip), real(length)); }
    // Which way the surface faces there: along the axis, and away from it.
    void normalAt(double y, double across, double* along, double* away) const
    {
        const double end = -length / 2;
        *along = y > end ? (size - tip) / 2 / length : y - end;
        *away = y > end ? 1 : across;
    }
    // How far a point lies outside the unblended surface, units, at most; y along the axis, `across` from the axis.
    double outside(double y, double across) const
    {
        const double along = std::clamp(y, -length / 2, length / 2);
        const double sizeThere = (size + tip) / 2 + (tip - size) * along / length;
        return std::hypot(y - along, across) - sizeThere / 2;
    }
};
const Steep steep[] = {{40, 10, 15}, {30, 12, 9}, {36, 16, 10}, {32, 18, 20}};

double cosineOf(const Seed& a, const Seed& b)
{
    return (a.normal.x * b.normal.x + a.normal.y * b.normal.y + a.normal.z * b.normal.z) / 16384.0 / 16384;
}

}  // namespace

TEST(seeds_beside_a_ridge_know_the_other_side)
{
    for (const Steep& cone : steep) {
        Scene scene;
        const SoftObject& object = scene.add(cone.make(), 0, 0, 0);
        const auto heightOf = [&](const Seed& s) { return number(object.root(s.root).y) + number(s.path.y); };
        int below = 0, above = 0;
        for (int i = 0; i < object.seedSlots(); i += 2) {
            const Seed& s = object.regular(i);
            const double height = heightOf(s) + cone.length / 2;
            // A seed as near to the ridge as this has to know it.
            if (s.beyond < 0) {
                CHECK(std::fabs(height) > 0.3);
                continue;
            }
            const Seed& beyond = object.regular(s.beyond);
            CHECK(cosineOf(s, beyond) < 0.96);
            CHECK(height * (heightOf(beyond) + cone.length / 2) < 0);
            CHECK(std::fabs(height) < 2);
            ++(height < 0 ? below : above);
        }
        note("size %g tip %g length %g: %d seeds below the ridge, %d above", cone.size, cone.tip, cone.length, below, above);
        CHECK(below > 15 && above > 15);
    }
}

TEST(what_is_round_or_hardly_tapers_has_no_ridge)
{
    Scene scene;
    scene.ball(30, 0, 0, 0);
    scene.add(new Cylinder(2, real(20), real(30)), 0, 0, 0);
    scene.add(new Cone(3, real(30), real(20), real(40)), 0, 0, 0);
    for (const auto& object : scene.objects)
        for (int i = 0; i < object->seedSlots(); i += 2)
            SAME(object->regular(i).beyond, -1);
}

TEST(scales_beside_a_ridge_show_their_own_side)
{
    Random random;
    long held = 0, standing = 0, lit = 0;
    double off = 0;
    for (const Steep& cone : steep)
        for (int view = 0; view < 20; ++view) {
            Scene scene;
            SoftObject& object = scene.add(cone.make(), 0, 0, 0);
            object.rotate(object.centre(), vector(random.between(-1, 1), random.between(-1, 1), 1), random.bits());
            scene.settle();
            const Matrix& turn = object.turn();
            const Vec axis{number(turn.m[0][1]), number(turn.m[1][1]), number(turn.m[2][1])};
            for (const Voxel& v : scene.draw(0))
                for (int k = 0; k < 10; ++k) {
                    const double x = random.between(-1, 1) * v.halfWidth / 256, y = random.between(-1, 1) * v.halfHeight / 256;
                    const double deeper = (v.tiltX * x + v.tiltY * y) / 256;
                    const double cut = v.cutAt / 64.0 + (v.cutX * x + v.cutY * y) / 8.0 +
                                       (v.curveXX * x * x + 2 * v.curveXY * x * y + v.curveYY * y * y) / 32.0;
                    if (cut < 0 || (v.back != 0 && (deeper > v.back / 32.0 || -deeper > v.front / 32.0)))
                        continue;
                    const double depth = v.z / 256.0;
                    const Vec p = Vec{v.x / 256.0 + x, v.y / 256.0 + y, depth} * ((depth + deeper) / depth) + vec(scene.eye);
                    const double along = dot(p, axis);
                    if (std::fabs(along + cone.length / 2) > 1.5)
                        continue;
                    double ahead, away;
                    const Vec side = p - axis * along;
                    standing += cone.outside(along, size(side)) > 0.45;
                    ++held;
                    cone.normalAt(along, size(side), &ahead, &away);
                    const Vec normal = axis * ahead + side * (away / size(side));
                    const double light = 63 * dot(normal, vec(scene.light)) / size(normal);
                    if (light <= 5 || v.brightness <= 0)
                        continue;
                    off += std::fabs(v.brightness + (v.slopeX * x + v.slopeY * y) / 8.0 - light);
                    ++lit;
                }
        }
    note("%ld places held, %.2f %% of them stand out", held, 100.0 * standing / held);
    note("brightness there is off by %.2f steps on average (%ld)", off / lit, lit);
    CHECK(held > 5000);
    CHECK(standing * 200 < held);
    CHECK(off < 1.5 * static_cast<double>(lit));
}
