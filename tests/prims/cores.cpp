// Compares the fields of the cores with the formula in double precision, for objects in any position; and tests that the seeds
// rest on the surface and that the object's own field changes along their paths as it should.
#include "prims.h"

#include <cstdio>
#include <random>
#include <set>

#include "model/field.h"

namespace {

std::mt19937 chance(502);

double between(double a, double b)
{
    return std::uniform_real_distribution<double>(a, b)(chance);
}

double geoffExact(double t)
{
    return t >= 1 ? 0 : 1 + t * (-22 / 9.0 + t * (17 / 9.0 - t * 4 / 9.0));
}

// Returns a world point in the object's own space, as the object was made.
Vec inOwn(const SoftObject& object, const Sample& sample, Vec p)
{
    const Vec v = p - vec(object.centre());
    const Matrix& m = object.turn();
    const double scale = number(object.size()) / std::fmax(sample.size, sample.size2);
    const auto part = [&](int j) {
        return (number(m.m[0][j]) * v.x + number(m.m[1][j]) * v.y + number(m.m[2][j]) * v.z) / scale;
    };
    return {part(0), part(1), part(2)};
}

Point toReal(Vec p)
{
    return {real(p.x), real(p.y), real(p.z)};
}

void pose(SoftObject& object)
{
    object.rotate(toReal({between(-9, 9), between(-9, 9), between(-9, 9)}),
                  {real(between(-1, 1)), real(between(-1, 1)), real(between(-1, 1.5))}, static_cast<Angle>(chance()));
    object.moveTo(toReal({between(-60, 60), between(-60, 60), between(-60, 200)}));
    object.scale(real(between(0.6, 1.6)));
}

void testField(const Sample& sample)
{
    double worst = 0, far = 0, slopes = 0;
    long beyond = 0;
    for (int pass = 0; pass < 40; ++pass) {
        Object object = sample.make();
        if (pass > 0)
            pose(*object);
        const double reach = number(object->reach());
        for (int i = 0; i < 1000; ++i) {
            const Vec from = vec(object->centre());
            // Three of four points are near the object; the others are up to 500 units away in each direction.
            const double most = i % 4 == 0 ? 500 : 1.2 * reach;
            const Vec p = from + Vec{between(-most, most), between(-most, most), between(-most, most)};
            const double t = sample.param(inOwn(*object, sample, p));
            const double f = number(object->fieldFunc(toReal(p)));
            // The point in core space; fromCore() gives its vector from the core.
            const Real perUnit = Real(CORE_SIZE) / object->size();
            const Vector q = object->unstretched(object->toOwnAxes(toReal(p) - object->centre())) * perUnit;
            const bool inRange =
                i % 4 != 0 && std::fmax(std::fabs(number(q.x)), std::fmax(std::fabs(number(q.y)), std::fabs(number(q.z)))) < 200;
            worst = std::fmax(worst, std::fabs(f - geoffExact(t)));
            beyond += t > 1.001 && f != 0;
            if (inRange && std::string(sample.kind) != "cone" && !sample.stretched()) {
                const double d = size(vec(object->fromCore(q)));
                const double exact = std::sqrt(t) * CORE_SIZE;
                far = std::fmax(far, std::fabs(d - exact) / (1 + d));
            }
            // The slope is half the gradient, in lengths of core space, times CORE_SIZE squared.
            if (inRange && t > 0.02 && t < 0.9) {
                Vector s;
                object->param(q, &s);
                const double d = 1e-4, half = CORE_SIZE * number(object->size()) / 2;
                const auto at = [&](Vec v) { return sample.param(inOwn(*object, sample, p + v)); };
                const Vec exact =
                    Vec{at({d, 0, 0}) - at({-d, 0, 0}), at({0, d, 0}) - at({0, -d, 0}), at({0, 0, d}) - at({0, 0, -d})} *
                    (half / (2 * d));
                const Vec world = vec(object->isBall() ? s : object->turn() * object->unstretched(s));
                slopes = std::fmax(slopes, size(world - exact) / size(exact));
            }
        }
    }
    const std::string name = sample.name();
    check(worst < 0.003, "%s: field off by %g", name.c_str(), worst);
    check(beyond == 0, "%s: %ld fields beyond the size", name.c_str(), beyond);
    check(far < 0.002, "%s: distance off by %g of itself", name.c_str(), far);
    check(slopes < 0.02, "%s: slope off by %g of itself", name.c_str(), slopes);
}

void testSeeds(const Sample& sample, bool posed)
{
    const std::string name = sample.name() + (posed ? ", turned and scaled" : "");
    Object object = sample.make();
    check(object->resample(Real(2), makeEngine), "%s: no seeds", name.c_str());
    if (posed)
        pose(*object);
    const double radius = number(object->radius());
    double rest = 0, along = 0, longest = 0, apart = 0;
    bool valid = true;
    std::set<int> roots;
    for (int i = 0; i < object->seedSlots(); ++i) {
        const Seed& s = object->seed(i);
        if ((i & 1) != 0 && object->seed(i - 1).neighbour < 0)
            continue;
        if ((i & 1) == 0) {
            roots.insert(s.root);
            valid =
                valid && s.position == Real(1) && s.neighbour < object->seedSlots() && (s.neighbour == -1 || s.neighbour % 2 == 0);
        }
        const Vec root = vec(object->toWorld(object->root(s.root))), at = vec(object->toWorld(object->root(s.root) + s.path));
        const Vec path = at - root;
        rest = std::fmax(rest, std::fabs(sample.param(inOwn(*object, sample, at)) - 0.25));
        if (std::string(sample.kind) != "cone" && !sample.stretched())
            longest = std::fmax(longest, std::fabs(size(path) - radius));
        for (double position = 0.5; position < 1.9; position += 0.2) {
            // In the hole of a torus the other side of the ring is nearer to the end of a path.
            const double t = sample.param(inOwn(*object, sample, root + path * position)), own = position * position / 4;
            if (std::string(sample.kind) == "torus" && t < own)
                continue;
            along = std::fmax(along, std::fabs(t - own));
        }
        // An oversampled seed lies between its seed and that seed's neighbour.
        if ((i & 1) != 0) {
            const Seed& before = object->seed(i - 1);
            const Seed& n = object->seed(before.neighbour);
            apart = std::fmax(apart, size(vec(object->seedPoint(before)) - at));
            apart = std::fmax(apart, size(vec(object->seedPoint(n)) - at));
        }
    }
    check(valid, "%s: seeds do not rest", name.c_str());
    check(rest < 0.002, "%s: seeds off the surface by %g of the field's argument", name.c_str(), rest);
    check(along < (sample.stretched() ? 0.006 : 0.004), "%s: own field along the paths off by %g of its argument", name.c_str(),
          along);
    check(longest < 0.002, "%s: paths off the radius by %g", name.c_str(), longest);
    check(apart < (sample.stretched() ? 4 : 3.2), "%s: an oversampled seed lies %g from its neighbours", name.c_str(), apart);
    const std::string kind = sample.kind;
    // Rings of stretched objects that are away from the axis have roots of their own.
    if (sample.stretched())
        return;
    if (kind == "sphere")
        check(roots.size() == 1, "%s: %zu roots", name.c_str(), roots.size());
    // The seeds of a ring on the axis share a root, and so do those of a cap.
    if (kind == "cylinder" || kind == "cone")
        check(roots.size() <= static_cast<size_t>(sample.measure * (posed ? 1.7 : 1) * 0.8 + 4), "%s: %zu roots", name.c_str(),
              roots.size());
    if (kind == "box" && sample.reach() == 0)
        check(roots.size() == 1, "%s: %zu roots", name.c_str(), roots.size());
    // Seeds of halves that mirror each other share roots.
    if (kind == "torus" || (kind == "disc" && sample.measure > 0))
        check(roots.size() <= static_cast<size_t>(object->seeds() * 6 / 10 + 4), "%s: %zu roots, %d seeds", name.c_str(),
              roots.size(), object->seeds());
}

void describes(const SoftObject& object, const char* expected)
{
    char text[200];
    object.describe(text, sizeof text);
    // The ends of a turned core are not exact, so numbers are compared as numbers.
    bool same = true;
    const char *a = text, *b = expected;
    while (*a && *b) {
        char *endA, *endB;
        const double x = std::strtod(a, &endA), y = std::strtod(b, &endB);
        if (endA != a && endB != b) {
            same = same && std::fabs(x - y) < 0.001;
            a = endA;
            b = endB;
        } else {
            same = same && *a++ == *b++;
        }
    }
    check(same && *a == *b, "described as '%s', not '%s'", text, expected);
}

// The seeds of an object of any strength must rest on its surface or, if it is too weak to have a surface, at restParam().
void testStrength(const Sample& sample, double strength)
{
    Object object = sample.make();
    object->setStrength(real(strength));
    check(object->resample(Real(2), makeEngine), "%s, strength %g: no seeds", sample.kind, strength);
    double off = 0;
    for (int i = 0; i < object->seedSlots(); ++i) {
        if ((i & 1) != 0 && object->seed(i - 1).neighbour < 0)
            continue;
        const double t = sample.param(inOwn(*object, sample, vec(object->seedPoint(object->seed(i)))));
        const double field = strength * (1 - t * (22 - t * (17 - t * 4)) / 9);
        off = std::fmax(off, object->rests() ? std::fabs(field - 0.5) : std::fabs(t - number(object->restParam())));
    }
    check(off < 0.008, "%s, strength %g: seeds off by %g", sample.kind, strength, off);
    check(object->rests() == (strength > 0.7), "%s, strength %g: whether it rests", sample.kind, strength);
    const Point core = object->toWorld(object->root(0));
    check(std::fabs(number(object->fieldFunc(core)) - strength) < 0.001, "%s: strength %g at the core", sample.kind, strength);
}

}  // namespace

void testCores()
{
    for (const Sample& sample : FEW)
        for (const double strength : {0.25, 0.5, 0.6, 0.8, 1.0, 1.5, 4.0})
            testStrength(sample, strength);

    for (const std::vector<Sample>* samples : {&MANY, &STRETCHED})
        for (const Sample& sample : *samples) {
            testField(sample);
            testSeeds(sample, false);
            testSeeds(sample, true);
        }

    // Tests the words of a dump, in world coordinates: a quarter turn about z takes y to -x.
    const Vector z{Real(0), Real(0), Real(1)};
    for (const Sample& sample : FEW) {
        Object object = sample.make(3);
        object->rotate(toReal({0, 0, 0}), z, 0x40000000u);
        object->moveTo(toReal({1.5, -2, 30}));
        const std::string kind = sample.kind;
        describes(*object, kind == "sphere"     ? "sphere 3 1.5 -2 30 20"
                           : kind == "cylinder" ? "cylinder 3 16.5 -2 30 -13.5 -2 30 16"
                           : kind == "torus"    ? "torus 3 1.5 -2 30 -1 0 0 18 16"
                           : kind == "disc"     ? "disc 3 1.5 -2 30 -1 0 0 15 14"
                           : kind == "cone"     ? "cone 3 13.5 -2 30 22 -10.5 -2 30 10"
                                                : "box 3 1.5 -2 30 0 1 0 -1 0 0 24 16 12 14");
    }

    // Measures out of range are limited.
    describes(*Object(make<Cylinder>(1, Real(10), Real(-5))), "cylinder 1 0 0 0 0 0 0 10");
    describes(*Object(make<Torus>(1, Real(16), Real(3))), "torus 1 0 0 0 0 1 0 10 16");
    describes(*Object(make<Disc>(1, Real(10), Real(-1))), "disc 1 0 0 0 0 1 0 0 10");
    describes(*Object(make<Cone>(1, Real(30), Real(10), Real(2))), "cone 1 0 -5 0 30 0 5 0 10");
    describes(*Object(make<Cone>(1, Real(10), Real(10), Real(0))), "cone 1 0 0 0 10 0 0 0 10");
    describes(*Object(make<Box>(1, Real(10), Real(-1), Real(5), Real(-3))), "box 1 0 0 0 1 0 0 0 1 0 0 5 0 10");
    for (const Real size : {Real(MIN_SIZE), Real(MAX_SIZE)})
        for (const char* kind : {"sphere", "cylinder", "torus", "disc", "cone", "box"}) {
            Object object = Sample{kind, number(size), number(size), 0}.make();
            check(object->resample(Real(4), makeEngine) && object->seeds() >= 4, "%s of size %d: no seeds", kind, floorToInt(size));
        }
}
