// Tests of the primitives: seeds, cores, operations, graph.
//
//   primtst          runs all checks; the last line is "N passed, N failed"
//   primtst even     prints a table of seeds and their evenness
//   primtst draw DIR writes frames of small scenes with every primitive, for the yardstick
#include "prims.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "model/field.h"
#include "math/normal.h"

int passed = 0, failed = 0;

bool check(bool good, const char* format, ...)
{
    if (good) {
        ++passed;
        return true;
    }
    ++failed;
    va_list args;
    va_start(args, format);
    std::printf("FAIL ");
    std::vprintf(format, args);
    std::printf("\n");
    va_end(args);
    return false;
}

static Object makeKind(const Sample& of, int number)
{
    const std::string k = of.kind;
    if (k == "sphere")
        return Object(::make<Sphere>(number, real(of.size)));
    if (k == "cylinder")
        return Object(::make<Cylinder>(number, real(of.size), real(of.measure)));
    if (k == "torus")
        return Object(::make<Torus>(number, real(of.size), real(of.measure)));
    if (k == "disc")
        return Object(::make<Disc>(number, real(of.size), real(of.measure)));
    if (k == "box")
        return Object(::make<Box>(number, real(of.size), real(of.measure), real(of.y), real(of.z)));
    return Object(::make<Cone>(number, real(of.size), real(of.size2), real(of.measure)));
}

Object Sample::make(int number) const
{
    Object object = makeKind(*this, number);
    if (stretched())
        object->setStretch({real(stretch.x), real(stretch.y), real(stretch.z)});
    return object;
}

double Sample::param(Vec p) const
{
    p = {p.x / stretch.x, p.y / stretch.y, p.z / stretch.z};
    const std::string k = kind;
    const double across = std::sqrt(p.x * p.x + p.z * p.z);
    const double on = std::fmin(std::fmax(p.y, -measure / 2), measure / 2);
    double square = dot(p, p), local = size;
    if (k == "cylinder" || k == "cone") {
        square = across * across + (p.y - on) * (p.y - on);
        if (k == "cone")
            local = size + (size2 - size) * (on / measure + 0.5);
    } else if (k == "torus") {
        square = p.y * p.y + (across - measure) * (across - measure);
    } else if (k == "disc") {
        const double beyond = std::fmax(across - measure, 0);
        square = p.y * p.y + beyond * beyond;
    } else if (k == "box") {
        const Vec beyond{std::fmax(std::fabs(p.x) - measure / 2, 0), std::fmax(std::fabs(p.y) - y / 2, 0),
                         std::fmax(std::fabs(p.z) - z / 2, 0)};
        square = dot(beyond, beyond);
    }
    return square / (local * local);
}

double Sample::reach() const
{
    const std::string k = kind;
    if (k == "box")
        return ::size(Vec{measure, y, z}) / 2;
    return k == "sphere" ? 0 : k == "cylinder" || k == "cone" ? measure / 2 : measure;
}

std::string Sample::name() const
{
    char text[80];
    if (std::string(kind) == "sphere")
        std::snprintf(text, sizeof text, "sphere %g", size);
    else if (std::string(kind) == "cone")
        std::snprintf(text, sizeof text, "cone %g %g %g", size, size2, measure);
    else if (std::string(kind) == "box")
        std::snprintf(text, sizeof text, "box %g %g %g %g", size, measure, y, z);
    else
        std::snprintf(text, sizeof text, "%s %g %g", kind, size, measure);
    std::string all = text;
    if (stretched()) {
        std::snprintf(text, sizeof text, " stretched %g %g %g", stretch.x, stretch.y, stretch.z);
        all += text;
    }
    return all;
}

const std::vector<Sample> FEW = {
    {"sphere", 20, 0, 0}, {"cylinder", 16, 0, 30}, {"torus", 16, 0, 18}, {"disc", 14, 0, 15}, {"cone", 22, 10, 24},
    {"box", 14, 0, 24, 16, 12},
};

const std::vector<Sample> MANY = {
    {"sphere", 20, 0, 0},   {"sphere", 35, 0, 0},
    {"cylinder", 16, 0, 30}, {"cylinder", 20, 0, 0},  {"cylinder", 12, 0, 100}, {"cylinder", 40, 0, 7},
    {"torus", 16, 0, 18},    {"torus", 20, 0, 12.5},  {"torus", 12, 0, 40},
    {"disc", 14, 0, 15},     {"disc", 20, 0, 0},      {"disc", 10, 0, 30},      {"disc", 30, 0, 4},
    {"cone", 22, 10, 24},    {"cone", 12, 30, 20},    {"cone", 20, 20, 20},     {"cone", 30, 12, 9},
    {"box", 14, 0, 24, 16, 12},  {"box", 8, 0, 30, 30, 30}, {"box", 24, 0, 40, 5, 9},   {"box", 20, 0, 0, 0, 0},
    {"box", 16, 0, 0, 30, 20},   {"box", 16, 0, 30, 0, 20}, {"box", 16, 0, 0, 0, 40},   {"box", 12, 0, 100, 3, 1},
    {"box", 10, 0, 7, 60, 11},
};

const std::vector<Sample> STRETCHED = [] {
    std::vector<Sample> all;
    for (const Sample& sample : std::vector<Sample>{{"sphere", 20, 0, 0},
                                                    {"cylinder", 12, 0, 20},
                                                    {"torus", 10, 0, 14},
                                                    {"disc", 12, 0, 10},
                                                    {"cone", 16, 8, 16},
                                                    {"box", 10, 0, 14, 10, 12}})
        for (const Vec by : {Vec{2, 1, 1}, Vec{1, 3, 1}, Vec{1, 0.5, 1}, Vec{1.4, 1, 0.7}, Vec{0.25, 1, 1}, Vec{2, 0.25, 1},
                             Vec{0.5, 1, 2}, Vec{3, 3, 3}}) {
            all.push_back(sample);
            all.back().stretch = by;
        }
    all.push_back({"sphere", 30, 0, 0, 0, 0, {4, 1, 0.25}});
    all.push_back({"sphere", 30, 0, 0, 0, 0, {0.25, 4, 4}});
    return all;
}();

int main(int count, char** arguments)
{
    makeFieldSteps();
    makeNormalTable();
    if (count == 2 && std::strcmp(arguments[1], "even") == 0) {
        testEvenness(true);
        return 0;
    }
    if (count == 3 && std::strcmp(arguments[1], "draw") == 0)
        return drawScenes(arguments[2]);
    testEvenness(false);
    testCores();
    testWarps();
    testOperations();
    testGraph();
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed == 0 ? 0 : 1;
}
