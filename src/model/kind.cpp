// The table of the primitives that scene files and the editor know.
#include "model/kind.h"

#include "math/alloc.h"
#include "model/box.h"
#include "model/cone.h"
#include "model/cylinder.h"
#include "model/disc.h"
#include "model/sphere.h"
#include "model/torus.h"

namespace {

constexpr Measure SIZE{"size", Real(MIN_SIZE), Real(MAX_SIZE), Real(20)};

SoftObject* makeSphere(int number, const Real* m)
{
    return make<Sphere>(number, m[0]);
}

SoftObject* makeCylinder(int number, const Real* m)
{
    return make<Cylinder>(number, m[0], m[1]);
}

SoftObject* makeTorus(int number, const Real* m)
{
    return make<Torus>(number, m[0], m[1]);
}

SoftObject* makeDisc(int number, const Real* m)
{
    return make<Disc>(number, m[0], m[1]);
}

SoftObject* makeCone(int number, const Real* m)
{
    return make<Cone>(number, m[0], m[1], m[2]);
}

SoftObject* makeBox(int number, const Real* m)
{
    return make<Box>(number, m[0], m[1], m[2], m[3]);
}

// The tube must not touch itself across the hole.
const char* torusExpects(const Real* m)
{
    return m[1] >= Torus::leastRing(m[0]) ? nullptr : "a ring of at least five eighths of the size";
}

const char* coneExpects(const Real* m)
{
    return m[2] >= Cone::leastLength(m[0], m[1]) ? nullptr : "a length of at least half the difference of size and tip";
}

Real sphereReach(const Real* m)
{
    return shiftDown(m[0], 1);
}

Real segmentReach(const Real* m)
{
    return shiftDown(m[0] + m[1], 1);
}

Real circleReach(const Real* m)
{
    return m[1] + shiftDown(m[0], 1);
}

Real coneReach(const Real* m)
{
    return shiftDown(max(m[0], m[1]) + m[2], 1);
}

Real boxReach(const Real* m)
{
    return shiftDown(m[0] + length({m[1], m[2], m[3]}), 1);
}

}  // namespace

const Kind KINDS[] = {
    {"sphere", 1, {SIZE}, makeSphere, nullptr, sphereReach},
    {"cylinder", 2, {SIZE, {"length", Real(0), Real(100), Real(24)}}, makeCylinder, nullptr, segmentReach},
    {"torus", 2, {SIZE, {"ring", Real(1), Real(100), Real(24)}}, makeTorus, torusExpects, circleReach},
    {"disc", 2, {SIZE, {"disc", Real(0), Real(100), Real(16)}}, makeDisc, nullptr, circleReach},
    {"cone",
     3,
     {SIZE, {"tip", Real(MIN_SIZE), Real(MAX_SIZE), Real(8)}, {"length", Real(0), Real(100), Real(24)}},
     makeCone,
     coneExpects,
     coneReach},
    {"box",
     4,
     {SIZE, {"x", Real(0), Real(100), Real(24)}, {"y", Real(0), Real(100), Real(16)}, {"z", Real(0), Real(100), Real(12)}},
     makeBox,
     nullptr,
     boxReach},
};

const int KIND_COUNT = static_cast<int>(sizeof KINDS / sizeof KINDS[0]);

const Kind* kindNamed(const char* word)
{
    for (int i = 0; i < KIND_COUNT; ++i)
        if (strcmp(KINDS[i].word, word) == 0)
            return &KINDS[i];
    return nullptr;
}
