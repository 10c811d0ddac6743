// Shared by the tests of the primitives: the objects under test, conversions of Real to double, and a count of checks.
#ifndef FB_TEST_PRIMS_H
#define FB_TEST_PRIMS_H

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "math/alloc.h"
#include "model/box.h"
#include "model/cone.h"
#include "model/cylinder.h"
#include "model/disc.h"
#include "model/model.h"
#include "surface/engine.h"
#include "surface/voxel.h"
#include "model/sphere.h"
#include "model/torus.h"

inline double number(Real a)
{
    return rawFromReal(a) / 65536.0;
}

inline Real real(double a)
{
    return realFromRaw(static_cast<int32_t>(std::lround(a * 65536)));
}

struct Vec {
    double x, y, z;
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(Vec a, double b) { return {a.x * b, a.y * b, a.z * b}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double size(Vec a) { return std::sqrt(dot(a, a)); }
inline Vec vec(const Vector& v) { return {number(v.x), number(v.y), number(v.z)}; }
inline Vec vec(const Point& v) { return {number(v.x), number(v.y), number(v.z)}; }

struct Destroy {
    void operator()(SoftObject* object) const { destroy(object); }
};
typedef std::unique_ptr<SoftObject, Destroy> Object;

// A primitive under test: its kind and measures. param() computes the argument of its field from the definition: the squared
// ratio of distance and size at `p`, which is given in the space of the object as it was made.
struct Sample {
    const char* kind;
    double size, size2, measure;  // size2: cone only; measure: length, ring, radius of the disc, or first edge of the box
    double y = 0, z = 0;          // other edges of the box
    Vec stretch{1, 1, 1};

    Object make(int number = 1) const;
    double param(Vec p) const;
    bool stretched() const { return stretch.x != 1 || stretch.y != 1 || stretch.z != 1; }
    // Returns how far the unstretched core reaches from the centre.
    double reach() const;
    std::string name() const;
};

// One sample of each kind, and tables of more samples.
extern const std::vector<Sample> FEW, MANY, STRETCHED;

// Counts a check and, if it failed, prints the message. Returns `good`.
bool check(bool good, const char* format, ...) __attribute__((format(printf, 2, 3)));
extern int passed, failed;

// The tests, one function for each file.
void testEvenness(bool table);
void testCores();
void testWarps();
void testOperations();
void testGraph();
int drawScenes(const char* directory);

#endif
