// Compares translation, rotation and scaling of every primitive (report, Section III) with double precision, also after many
// repetitions.
#include "prims.h"

namespace {

Point toReal(Vec p)
{
    return {real(p.x), real(p.y), real(p.z)};
}

std::vector<Vec> places(const SoftObject& object)
{
    std::vector<Vec> all;
    for (int i = 0; i < object.seedSlots(); ++i)
        if ((i & 1) == 0 || object.seed(i - 1).neighbour >= 0)
            all.push_back(vec(object.seedPoint(object.seed(i))));
    return all;
}

// Returns the greatest distance between corresponding places of two lists; 1e9 if their lengths differ.
double apart(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    if (a.size() != b.size())
        return 1e9;
    double most = 0;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::fmax(most, size(a[i] - b[i]));
    return most;
}

Vec turned(Vec p, Vec about, Vec axis, double angle)
{
    const Vec u = axis * (1 / size(axis)), v = p - about;
    const Vec across{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    return about + v * std::cos(angle) + across * std::sin(angle) + u * (dot(u, v) * (1 - std::cos(angle)));
}

// Returns the greatest error of the path lengths, by the field at the paths' ends, in units at the object's current size.
double offPaths(const SoftObject& object)
{
    double most = 0;
    for (int i = 0; i < object.seedSlots(); ++i) {
        if ((i & 1) != 0 && object.seed(i - 1).neighbour < 0)
            continue;
        const Seed& s = object.seed(i);
        Vector slope;
        const double t = number(object.param((object.root(s.root) + s.path) * (Real(CORE_SIZE) / object.laidSize()), &slope));
        most = std::fmax(most, std::fabs(2 * std::sqrt(t) - 1) * size(vec(s.path)) * number(object.growth()));
    }
    return most;
}

void testMoves(const Sample& sample)
{
    const char* name = sample.kind;
    Object object = sample.make();
    object->resample(Real(2), makeEngine);
    const std::vector<Vec> start = places(*object);
    const Vec by{12.5, -3.25, 40};
    object->translate({real(by.x), real(by.y), real(by.z)});
    std::vector<Vec> expected = start;
    for (Vec& p : expected)
        p = p + by;
    check(apart(places(*object), expected) < 1e-4, "%s: translation is off", name);
    check(object->recalc(), "%s: a moved object wants no update", name);
    check(apart({vec(object->centre())}, {by}) < 1e-4, "%s: the centre did not move", name);

    const Vec about{3, 5, -8}, axis{1, -2, 0.5};
    object->rotate(toReal(about), {real(axis.x), real(axis.y), real(axis.z)}, 0x25000000u);
    for (Vec& p : expected)
        p = turned(p, about, axis, 2 * M_PI * 0x25 / 256.0);
    const bool ball = std::string(name) == "sphere";
    if (ball) {
        const Vec centre = turned(by, about, axis, 2 * M_PI * 0x25 / 256.0);
        check(size(vec(object->centre()) - centre) < 0.003, "%s: rotation is off", name);
        expected = start;
        for (Vec& p : expected)
            p = p + vec(object->centre());
    }
    check(apart(places(*object), expected) < 0.005, "%s: rotation is off by %g", name, apart(places(*object), expected));

    // A zero axis and a turn to the present orientation change nothing.
    const std::vector<Vec> before = places(*object);
    object->rotate(toReal(about), {Real(0), Real(0), Real(0)}, 0x40000000u);
    object->setTurn(object->turn());
    check(apart(places(*object), before) < 0.001, "%s: turning by nothing moves it", name);

    // A turn is relative to the orientation in which the seeds were laid out, so the identity turns the object back.
    object->setTurn(Matrix::identity());
    object->moveTo(toReal({0, 0, 0}));
    check(apart(places(*object), start) < 1e-3, "%s: not back in place", name);
}

void testScaling(const Sample& sample)
{
    const char* name = sample.kind;
    Object object = sample.make();
    object->resample(Real(2), makeEngine);
    object->moveTo(toReal({5, 6, 7}));
    const std::vector<Vec> start = places(*object);
    const int seeds = object->seeds();
    const double whole = std::fmax(sample.size, sample.size2);

    // If the size changes by less than a quarter, the seeds stay and move away from the centre.
    for (const double factor : {1.2, 1.0, 0.8}) {
        object->scale(real(factor * whole / number(object->size())));
        std::vector<Vec> expected = start;
        for (Vec& p : expected)
            p = (p - Vec{5, 6, 7}) * factor + Vec{5, 6, 7};
        check(object->seeds() == seeds, "%s scaled by %g: laid out anew", name, factor);
        check(apart(places(*object), expected) < 0.01, "%s scaled by %g: off by %g", name, factor,
              apart(places(*object), expected));
        check(offPaths(*object) < 0.002 + 0.0001 * number(object->size()), "%s scaled by %g: paths off by %g", name, factor,
              offPaths(*object));
        check(object->spacing() == Real(2), "%s scaled by %g: spacing", name, factor);
        check(object->recalc(), "%s: a scaled object wants no update", name);
    }

    // If the size changes more, the object is resampled with as many seeds as the new surface needs.
    for (const double factor : {1.3, 2.5, 0.7}) {
        object->scale(real(factor * whole / number(object->size())));
        const double ratio = static_cast<double>(object->seeds()) / seeds / (factor * factor);
        check(ratio > 0.85 && ratio < 1.15, "%s scaled by %g: %d seeds of %d", name, factor, object->seeds(), seeds);
        check(offPaths(*object) < 0.002 + 0.0001 * number(object->size()), "%s scaled by %g: paths off by %g", name, factor,
              offPaths(*object));
        check(object->spacing() == Real(2), "%s scaled by %g: spacing", name, factor);
    }

    // The measures of the core are scaled with the size, and rounding errors do not accumulate.
    for (int i = 0; i < 20000; ++i)
        object->scale(real(i % 2 ? 1.2 : 1 / 1.2));
    object->scale(real(whole / number(object->size())));
    check(std::fabs(number(object->coreReach()) - sample.reach() * number(object->size()) / whole) < 0.005,
          "%s: the core is %g long", name, number(object->coreReach()));
    check(offPaths(*object) < 0.002, "%s, scaled often: paths off by %g", name, offPaths(*object));

    // Sizes beyond the limits are limited.
    object->scale(Real(1000));
    check(object->size() == Real(MAX_SIZE), "%s: size %g", name, number(object->size()));
    for (int i = 0; i < 8; ++i)
        object->scale(Real(0.1));
    check(object->size() == Real(MIN_SIZE), "%s: size %g", name, number(object->size()));
    object->scale(Real(0));
    check(object->size() == Real(MIN_SIZE), "%s: size %g", name, number(object->size()));

    // An object that is turned and moved is resampled to the same places.
    Object other = sample.make();
    other->resample(Real(2), makeEngine);
    other->rotate(toReal({3, 1, 2}), {Real(1), Real(2), Real(3)}, 0x33333333u);
    const std::vector<Vec> before = places(*other);
    check(other->resample(Real(2), makeEngine) && apart(places(*other), before) < 0.002, "%s: laid out elsewhere when turned",
          name);
}

// A million turns must change neither the path lengths nor the distance from the point turned about.
void testMillion(const Sample& sample)
{
    const char* name = sample.kind;
    Object object = sample.make();
    object->resample(Real(8), makeEngine);
    object->moveTo(toReal({30, -10, 5}));
    const double distance = size({30, -10, 5});
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
        object->rotate(toReal({0, 0, 0}), {real(1), real(i % 3 - 1), real(0.5)}, 0x01234567u + static_cast<uint32_t>(i) * 977u);
        if (i % 50000 == 49999)
            worst = std::fmax(worst, offPaths(*object));
    }
    check(worst < 0.002, "%s: paths off by %g in a million turns", name, worst);
    const double off = std::fabs(size(vec(object->centre())) - distance);
    check(off < 0.05, "%s: %g nearer or farther after a million turns", name, off);
}

}  // namespace

void testOperations()
{
    for (const Sample& sample : FEW) {
        testMoves(sample);
        testScaling(sample);
        testMillion(sample);
    }
}
