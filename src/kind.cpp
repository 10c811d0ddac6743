// The primitives that scene files and the editor know.
#include "kind.h"

#include "alloc.h"
#include "sphere.h"
#if __has_include("cylinder.h")
#include "cylinder.h"
#endif
#if __has_include("torus.h")
#include "torus.h"
#endif
#if __has_include("disc.h")
#include "disc.h"
#endif
#if __has_include("cone.h")
#include "cone.h"
#endif

namespace {

constexpr Measure SIZE{"size", Real(SIZE_LEAST), Real(SIZE_MOST)};

SoftObject* makeSphere(int number, const Real* m)
{
    return make<Sphere>(number, m[0]);
}

#if __has_include("cylinder.h")
SoftObject* makeCylinder(int number, const Real* m)
{
    return make<Cylinder>(number, m[0], m[1]);
}
#endif

#if __has_include("torus.h")
SoftObject* makeTorus(int number, const Real* m)
{
    return make<Torus>(number, m[0], m[1]);
}

// The tube must not reach its own other side.
const char* torusExpects(const Real* m)
{
    return m[1] * Real(2) > m[0] ? nullptr : "a ring above half the size";
}
#endif

#if __has_include("disc.h")
SoftObject* makeDisc(int number, const Real* m)
{
    return make<Disc>(number, m[0], m[1]);
}
#endif

#if __has_include("cone.h")
SoftObject* makeCone(int number, const Real* m)
{
    return make<Cone>(number, m[0], m[1], m[2]);
}
#endif

}  // namespace

const Kind KINDS[] = {
    {"sphere", 1, {SIZE}, makeSphere, nullptr},
#if __has_include("cylinder.h")
    {"cylinder", 2, {SIZE, {"length", Real(1), Real(100)}}, makeCylinder, nullptr},
#endif
#if __has_include("torus.h")
    {"torus", 2, {SIZE, {"ring", Real(1), Real(100)}}, makeTorus, torusExpects},
#endif
#if __has_include("disc.h")
    {"disc", 2, {SIZE, {"disc", Real(1), Real(100)}}, makeDisc, nullptr},
#endif
#if __has_include("cone.h")
    {"cone", 3, {SIZE, {"tip", Real(SIZE_LEAST), Real(SIZE_MOST)}, {"length", Real(1), Real(100)}}, makeCone, nullptr},
#endif
};

const int KIND_COUNT = static_cast<int>(sizeof KINDS / sizeof KINDS[0]);

const Kind* kindNamed(const char* word)
{
    for (int i = 0; i < KIND_COUNT; ++i)
        if (strcmp(KINDS[i].word, word) == 0)
            return &KINDS[i];
    return nullptr;
}
