// Compares warped space with the same functions in double precision: places there and back, and slopes; and tests that the
// seeds of warped objects rest on the surface and move with it.
#include "prims.h"

#include <random>

namespace {

std::mt19937 chance(715);

double between(double a, double b)
{
    return std::uniform_real_distribution<double>(a, b)(chance);
}

Vector toReal(Vec p)
{
    return {real(p.x), real(p.y), real(p.z)};
}

// Warps a place as model/warp.h describes it; angles are in degrees, h is the height.
Vec warped(Vec p, double taper, double twist, double bend, double h)
{
    const double on = std::fmin(std::fmax(p.y, -h), h), wide = 1 + taper * on / h;
    const double angle = twist * M_PI / 180 * p.y / (2 * h), s = std::sin(angle), c = std::cos(angle);
    const Vec v{wide * (p.x * c + p.z * s), p.y, wide * (p.z * c - p.x * s)};
    if (bend == 0)
        return v;
    const double radius = 2 * h / (bend * M_PI / 180), turn = on / radius, beyond = p.y - on;
    return {radius + (v.x - radius) * std::cos(turn) + beyond * std::sin(turn),
            beyond * std::cos(turn) - (v.x - radius) * std::sin(turn), v.z};
}

const double AMOUNTS[][3] = {{0.5, 0, 0},  {-0.75, 0, 0}, {0, 90, 0},     {0, -360, 0},    {0, 0, 60},
                             {0, 0, -170}, {0.3, 120, 0}, {-0.4, 60, 45}, {0.5, -200, -90}, {0.2, 0, 1.5}};

WarpAmounts amountsOf(const double* from)
{
    return {{real(from[0]), real(from[1]), real(from[2])}};
}

void testSpace()
{
    for (const double* amounts : AMOUNTS) {
        const double h = 30, wide = 8;
        Warp warp;
        const auto reach = [&](double times) { return toReal({times * wide, h, times * wide}); };
        warp.set(amountsOf(amounts), reach(1), reach(2), reach(1.5));
        double out = 0, back = 0, slopes = 0, steps = 0, shortest = 1e9, farthest = 0, outside = -1e9;
        for (int i = 0; i < 3000; ++i) {
            const Vec p{between(-wide, wide), between(-1.3 * h, 1.3 * h), between(-wide, wide)};
            const Vec there = warped(p, amounts[0], amounts[1], amounts[2], h);
            Warp::Way way, forth;
            out = std::fmax(out, size(vec(warp.out(toReal(p), forth)) - there));
            warp.back(toReal(there), way);
            back = std::fmax(back, size(vec(way.plain) - p));
            farthest = std::fmax(farthest, size(there) / std::fmax(size(p), h / 2));
            const Vec far{between(-2 * wide, 2 * wide), between(-h, h), between(-2 * wide, 2 * wide)};
            outside = std::fmax(outside, number(warp.outside(toReal(warped(far, amounts[0], amounts[1], amounts[2], h)))));
            const Vec q = p + Vec{between(-1, 1), between(-1, 1), between(-1, 1)};
            shortest = std::fmin(shortest, size(warped(q, amounts[0], amounts[1], amounts[2], h) - there) / size(q - p));
            // slopeOut() must give the gradient of n . p in warped space: its product with a warped step is n times the plain step.
            if (std::fabs(p.y) > h - 1)
                continue;
            const Vec n{between(-1, 1), between(-1, 1), between(-1, 1)};
            const Vec g = vec(warp.slopeOut(way, toReal(n)));
            for (const Vec step : {Vec{1e-4, 0, 0}, Vec{0, 1e-4, 0}, Vec{0, 0, 1e-4}}) {
                const Vec way = warped(p + step, amounts[0], amounts[1], amounts[2], h) -
                                warped(p - step, amounts[0], amounts[1], amounts[2], h);
                slopes = std::fmax(slopes, std::fabs(dot(way, g) - 2 * dot(step, n)) / 2e-4);
                steps = std::fmax(steps, size(vec(warp.stepOut(forth, toReal(step * 1e4))) - way * (0.5 / 1e-4)));
                slopes = std::fmax(slopes, std::fabs(dot(way, vec(warp.slopeOut(forth, toReal(n)))) - 2 * dot(step, n)) / 2e-4);
            }
        }
        const auto say = [&](bool good, const char* what, double value) {
            check(good, "taper %g, twist %g, bend %g: %s %g", amounts[0], amounts[1], amounts[2], what, value);
        };
        say(out < 0.01, "a place is off by", out);
        say(back < 0.02, "and back by", back);
        say(slopes < 0.02, "slopes are off by", slopes);
        say(outside < 0.01 && outside > -0.75 * h, "a place of the field comes out of its box by", outside);
        say(steps < 0.02, "steps are off by", steps);
        say(shortest >= number(warp.least()), "a distance became so much of itself:", shortest);
        say(farthest <= number(warp.most()) + 0.01, "a place went so much farther from the centre:", farthest);
    }
    // The centre of a bend must not lie inside the object, so the bend is limited.
    Warp warp;
    warp.set({{Real(0), Real(0), Real(-180)}}, {Real(20), Real(10), Real(20)}, {Real(40), Real(30), Real(40)},
             {Real(30), Real(20), Real(30)});
    const double most = 2 * 10 / (20 * 1.2) * 180 / M_PI;
    check(std::fabs(number(warp.amounts().part[WARP_BEND]) + most) < 0.01 && warp.asked().part[WARP_BEND] == Real(-180),
          "a bend of %g, not %g", number(warp.amounts().part[WARP_BEND]), -most);
    // As long and thin as objects can be, it is not.
    warp.set({{Real(0), Real(0), Real(90)}}, {Real(4), Real(1600), Real(4)}, {Real(8), Real(1630), Real(8)},
             {Real(6), Real(1620), Real(6)});
    check(warp.amounts().part[WARP_BEND] == Real(90), "a bend of a thin object of %g", number(warp.amounts().part[WARP_BEND]));
}

void testSeeds(const Sample& sample)
{
    for (const double* amounts : AMOUNTS) {
        Object object = sample.make();
        object->resample(Real(2), makeEngine);
        // Some oversampled seeds are active before the object is warped; the others are laid out only when they are needed.
        for (int i = 1; i < object->seedSlots(); i += 64)
            object->seed(i).flags = SEED_ACTIVE;
        object->setWarp(amountsOf(amounts));
        object->rotate({Real(1), Real(2), Real(3)}, {Real(1), Real(1), Real(0)}, 0x20000000u);
        const std::string name = sample.name() + " warped by " + std::to_string(amounts[0]) + " " + std::to_string(amounts[1]) +
                                 " " + std::to_string(amounts[2]);
        double off = 0, beyond = 0;
        for (int i = 0; i < object->seedSlots(); ++i) {
            if ((i & 1) != 0 && object->seed(i - 1).neighbour < 0)
                continue;
            const Seed& s = object->seed(i);
            const Point at = object->toWorld(object->root(s.root) + s.path);
            off = std::fmax(off, std::fabs(number(object->fieldFunc(at)) - 0.5));
            const Vec away = vec(at) - vec(object->centre());
            const Vec far = vec(object->centre()) + away * (number(object->reach()) / size(away));
            beyond = std::fmax(beyond, number(object->fieldFunc({real(far.x), real(far.y), real(far.z)})));
        }
        check(off < 0.01, "%s: fields where seeds rest are off by %g", name.c_str(), off);
        check(beyond < 1e-4, "%s: a field of %g out of reach", name.c_str(), beyond);
    }
}

// While an amount swings, the seeds move along in small steps and keep their positions on their paths.
void testSway(const Sample& sample, int part)
{
    Object object = sample.make();
    object->resample(Real(2), makeEngine);
    object->setWarp(NO_WARP);
    std::vector<Vec> before;
    double farthest = 0;
    bool kept = true;
    for (int step = 0; step <= 128; ++step) {
        WarpAmounts amounts = NO_WARP;
        amounts.part[part] = WARP_MOST[part] * real(std::sin(step * M_PI / 64));
        // All oversampled seeds are active.
        for (int i = 0; i < object->seedSlots(); ++i) {
            object->seed(i).position = real(1 + 0.0001 * i);
            object->seed(i).flags |= SEED_ACTIVE;
        }
        object->setWarp(amounts);
        std::vector<Vec> now;
        for (int i = 0; i < object->seedSlots(); ++i) {
            const Seed& s = object->seed(i);
            kept = kept && s.position == real(1 + 0.0001 * i);
            now.push_back(vec(object->toWorld(object->root(s.root) + s.path)));
            if (step > 0)
                farthest = std::fmax(farthest, size(now.back() - before[static_cast<size_t>(i)]));
        }
        before = now;
    }
    // Bound: the object's extent times the change of the angle (or of the share) in one step.
    const double extent = number(object->reach()),
                 most = extent * (part == 0 ? 0.75 : number(WARP_MOST[part]) * M_PI / 180) * M_PI / 64;
    check(farthest <= most, "%s: a seed leaps %g units", sample.name().c_str(), farthest);
    check(kept, "%s: positions are lost", sample.name().c_str());
}

}  // namespace

void testWarps()
{
    testSpace();
    for (const Sample& sample : FEW) {
        testSeeds(sample);
        for (int part = 0; part < WARP_PARTS; ++part)
            testSway(sample, part);
    }
    testSeeds({"sphere", 24, 0, 0, 0, 0, {1.6, 1.2, 0.5}});
    testSeeds({"cylinder", 12, 0, 30, 0, 0, {2, 1, 0.7}});

    // Tests the words of a dump for an object that is stretched and warped, and their order.
    Object object = Sample{"cylinder", 16, 0, 30, 0, 0, {2, 1, 0.5}}.make(3);
    object->setWarp({{real(0.25), real(-90), Real(0)}});
    object->moveTo({Real(5), Real(0), Real(0)});
    const char* const lines[] = {"stretch 3 5 0 0 1 0 0 0 1 0 2 1 0.5", "taper 3 5 0 0 1 0 0 0 1 0 0.25 23",
                                 "twist 3 5 0 0 1 0 0 0 1 0 -90 23", ""};
    for (int i = 0; i < SoftObject::SHAPES; ++i) {
        char text[200];
        object->describeShape(i, text, sizeof text);
        check(std::string(text) == lines[i], "described as '%s', not '%s'", text, lines[i]);
    }

    // A strength set after the warp must count like one set before it.
    Object other = Sample{"cylinder", 16, 0, 30, 0, 0, {2, 1, 0.5}}.make(4);
    other->setStrength(real(3));
    other->setWarp(object->warp().asked());
    object->setStrength(real(3));
    check(object->warp().height() == other->warp().height() && number(other->warp().height()) > 25,
          "a strong object is warped over %g units", number(object->warp().height()));
}
