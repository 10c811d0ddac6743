// A primitive for the tests alone: the core is a line segment. Unlike the sphere it has several roots, it changes when
// it is turned, and its field is no polynomial along a path, so that it takes every way the sphere does not.
#ifndef FB_TEST_STICK_H
#define FB_TEST_STICK_H

#include "help.h"

class Stick : public SoftObject {
public:
    // Half the length of the core, units.
    Stick(int number, double size, double half) : SoftObject(number, real(size), real(half)) {}

    Vector fromCore(const Vector& q) const override
    {
        return {q.x - clamp(q.x, -coreReach16(), coreReach16()), q.y, q.z};
    }
    Vector coreExtent16() const override { return {coreReach16(), Real(0), Real(0)}; }
    void describe(char* to, int size) const override { snprintf(to, static_cast<size_t>(size), "stick %d", number()); }

    void layOutSeeds(SeedMaker& maker, Real spacing) const override
    {
        // Rings round the axis: a cap, the body, a cap. Each ring has its root on the core; a cap shares one.
        const double g = number_(spacing), r = number_(radius()), h = number_(coreReach());
        const int cap = std::max(1, static_cast<int>(std::ceil(M_PI / 2 * r / g)));
        const int body = std::max(1, static_cast<int>(std::ceil(2 * h / g)));
        const int left = maker.addRoot({real(-h), Real(0), Real(0)});
        for (int k = 0; k < cap; ++k)
            ring(maker, left, -M_PI / 2 + M_PI / 2 * (k + 0.5) / cap, r, g, true);
        for (int k = 0; k < body; ++k)
            ring(maker, maker.addRoot({real(-h + 2 * h * (k + 0.5) / body), Real(0), Real(0)}), 0, r, g, false);
        const int right = maker.addRoot({real(h), Real(0), Real(0)});
        for (int k = 0; k < cap; ++k)
            ring(maker, right, M_PI / 2 * (k + 0.5) / cap, r, g, true);
    }

    // The ends of the core in the world.
    Vec a() const { return end(-1); }
    Vec b() const { return end(1); }

private:
    static double number_(Real v) { return ::number(v); }
    Vec end(double side) const
    {
        const Matrix& m = turn();
        return vec(centre()) + vec(Vector{m.m[0][0], m.m[1][0], m.m[2][0]}) * (side * ::number(coreReach()));
    }
    static void ring(SeedMaker& maker, int root, double latitude, double r, double g, bool)
    {
        const double around = 2 * M_PI * r * std::cos(latitude);
        const int count = std::max(4, static_cast<int>(around / g));
        maker.beginRing();
        for (int i = 0; i < count; ++i) {
            const double a = 2 * M_PI * i / count, c = std::cos(latitude), s = std::sin(latitude);
            const double w = around / count / 2;
            maker.addSeed(root, vector(s, c * std::cos(a), c * std::sin(a)), vector(0, -w * std::sin(a), w * std::cos(a)),
                          vector(g / 2 * c, -g / 2 * s * std::cos(a), -g / 2 * s * std::sin(a)));
        }
    }
};

#endif
