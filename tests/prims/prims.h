// What the tests of the primitives share: the objects they are made on, Real as double, and a count of checks.
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

// A primitive under test: what it is made of, and its field by the book: the square of distance / size at `p` in the
// object's own space, for an object as made.
struct Sample {
    const char* kind;
    double size, size2, measure;  // size2: cones only; measure: length, ring, radius of the disc, or the first edge of a box
    double y = 0, z = 0;          // a box's other edges
    Vec stretch{1, 1, 1};

    Object make(int number = 1) const;
    double param(Vec p) const;
    bool stretched() const { return stretch.x != 1 || stretch.y != 1 || stretch.z != 1; }
    // How far the core reaches, unstretched.
    double reach() const;
    std::string name() const;
};

// One of each kind, and the table of all that are tried.
extern const std::vector<Sample> FEW, MANY, STRETCHED;

// The yardsticks of a test: counts and complains.
bool check(bool good, const char* format, ...) __attribute__((format(printf, 2, 3)));
extern int passed, failed;

// The tests, by file.
void testEvenness(bool table);
void testCores();
void testWarps();
void testOperations();
void testGraph();
int drawScenes(const char* directory);

#endif
