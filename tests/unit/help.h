// What several unit tests need: Real and double, scenes, and the truth in double precision.
#ifndef FB_TEST_HELP_H
#define FB_TEST_HELP_H

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "math/alloc.h"
#include "model/model.h"
#include "model/softobj.h"
#include "model/sphere.h"
#include "surface/engine.h"
#include "surface/voxel.h"
#include "math/vec.h"
#include "picture/view.h"

// STEP: the distance of two neighbouring values of Real. EXACT: the relative error of one operation on it.
#if FB_REAL == FB_FIXED
constexpr double STEP = 1.0 / 65536;
constexpr double EXACT = 0;
inline double number(Real a) { return a.raw / 65536.0; }
inline Real real(double a) { return Real::fromRaw(static_cast<int32_t>(std::lround(a * 65536))); }
#else
constexpr double STEP = 0;
constexpr double EXACT = FB_REAL == FB_FLOAT ? 1.2e-7 : 2.3e-16;
inline double number(Real a) { return static_cast<double>(a); }
inline Real real(double a) { return static_cast<Real>(a); }
#endif

struct Vec {
    double x, y, z;
};
inline Vec vec(const Vector& v) { return {number(v.x), number(v.y), number(v.z)}; }
inline Vec vec(const Point& p) { return {number(p.x), number(p.y), number(p.z)}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator*(const Vec& a, double b) { return {a.x * b, a.y * b, a.z * b}; }
inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double size(const Vec& a) { return std::sqrt(dot(a, a)); }

inline Vector vector(double x, double y, double z) { return {real(x), real(y), real(z)}; }
inline Point point(double x, double y, double z) { return {real(x), real(y), real(z)}; }

// The Geoff function and its derivative, as the report's source gives it, in double precision.
inline double trueGeoff(double t)
{
    return t >= 1 ? 0 : 1 - 22.0 / 9 * t + 17.0 / 9 * t * t - 4.0 / 9 * t * t * t;
}
inline double trueSlope(double t)
{
    return t >= 1 ? 0 : -22.0 / 9 + 34.0 / 9 * t - 12.0 / 9 * t * t;
}

// Balls and their field, exact.
struct Ball {
    Vec centre;
    double size;
    double weight = 1;
};
struct Truth {
    std::vector<Ball> balls;

    double part(size_t i, const Vec& p) const
    {
        const Vec d = p - balls[i].centre;
        return trueGeoff(dot(d, d) / (balls[i].size * balls[i].size)) * balls[i].weight;
    }
    double field(const Vec& p) const
    {
        double sum = 0;
        for (size_t i = 0; i < balls.size(); ++i)
            sum += part(i, p);
        return sum;
    }
    // How the field falls, and which way: minus its gradient.
    Vec slope(const Vec& p) const
    {
        Vec g{0, 0, 0};
        for (const Ball& ball : balls) {
            const Vec d = p - ball.centre;
            const double square = ball.size * ball.size;
            g = g + d * (-2 * ball.weight * trueSlope(dot(d, d) / square) / square);
        }
        return g;
    }
    // Outward normal.
    Vec normal(const Vec& p) const
    {
        const Vec g = slope(p);
        const double s = ::size(g);
        return s > 0 ? g * (1 / s) : Vec{0, 0, -1};
    }
};

// How far a voxel is from the nearest one of a list, units, and by how much the brightness of the two and its slopes differ.
struct Apart {
    double distance = 1e9, light = 0, slopes = 0;
};
inline Apart fromNearest(const Voxel& v, const std::vector<Voxel>& list)
{
    Apart apart;
    for (const Voxel& other : list) {
        const double distance = std::hypot(v.x - other.x, v.y - other.y, v.z - other.z) / 256;
        if (distance < apart.distance)
            apart = {distance, std::fabs(v.brightness - other.brightness),
                     std::hypot(v.slopeX - other.slopeX, v.slopeY - other.slopeY)};
    }
    return apart;
}

// A ramp (VoxelList::ramp) in which the palette index of each brightness is that brightness. It tells no steps, so that no
// scale averages.
inline std::vector<uint8_t> plainRamp()
{
    std::vector<uint8_t> ramp(SHADING_MOST + STEP_OF + 256, 0);
    for (int i = 0; i < SHADING_MOST + STEP_OF; ++i)
        ramp[static_cast<size_t>(i)] = static_cast<uint8_t>(std::clamp(i - SHADING_MOST, 0, BRIGHTEST));
    return ramp;
}

// Draws voxels that are counted from the eye itself, or from (x, y, z), 1/256 unit; the colour of each is its brightness.
// Returns the number of scales drawn.
inline int show(View& view, const Voxel* voxels, size_t count, int32_t x = 0, int32_t y = 0, int32_t z = 0)
{
    static const std::vector<uint8_t> ramp = plainRamp();
    VoxelList list{};
    list.x = x;
    list.y = y;
    list.z = z;
    list.ramp = ramp.data() + SHADING_MOST;
    int drawn = 0;
    for (size_t from = 0; from < count; from += VOXELS_AT_ONCE) {
        list.count = static_cast<int>(std::min<size_t>(count - from, VOXELS_AT_ONCE));
        std::copy_n(voxels + from, list.count, list.voxels);
        int64_t extent = 0;
        for (int i = 0; i < list.count; ++i)
            for (const int64_t way : {list.voxels[i].x, list.voxels[i].y, list.voxels[i].z})
                extent = std::max(extent, way < 0 ? -way : way);
        list.extent = static_cast<int32_t>(std::min<int64_t>(extent, INT32_MAX));
        drawn += view.show(list);
    }
    return drawn;
}
inline int show(View& view, const Voxel& voxel) { return show(view, &voxel, 1); }
inline int show(View& view, const std::vector<Voxel>& voxels) { return show(view, voxels.data(), voxels.size()); }

// Objects with seeds, linked as the test says, and the frames of them.
struct Scene {
    std::vector<std::unique_ptr<SoftObject>> objects;
    std::unique_ptr<Bodies> bodies = std::make_unique<Bodies>();
    Counts counts{};
    bool found = false;  // the bodies are those of the links as they are
    bool report98 = false;
    Point eye{Real(0), Real(0), Real(-120)};
    ViewAxes axes;
    const Hider* hider = nullptr;
    Vector light = unit(vector(0.5, 0.7, -0.5));
    std::vector<uint8_t> ramp = plainRamp();
    std::vector<std::vector<uint8_t>> ramps;  // a copy for each object, so that its voxels can be told from others

    Scene() = default;
    Scene(Scene&&) = default;
    // Objects that are linked with each other go before the links do.
    ~Scene()
    {
        for (auto& object : objects)
            for (auto& other : objects)
                other->unlink(object.get());
    }

    SoftObject& add(SoftObject* object, double x, double y, double z, double spacing = 2)
    {
        objects.emplace_back(object);
        object->moveTo(point(x, y, z));
        if (!object->resample(real(spacing), report98 ? makeReport98 : makeEngine))
            std::abort();
        ramps.push_back(ramp);
        object->setRamp(ramps.back().data() + SHADING_MOST);
        found = false;
        return *object;
    }
    SoftObject& ball(double size, double x, double y, double z, double spacing = 2)
    {
        return add(new Sphere(static_cast<int>(objects.size()) + 1, real(size)), x, y, z, spacing);
    }
    void link(size_t a, size_t b, double weight = 1)
    {
        objects[a]->link(objects[b].get(), real(weight));
        objects[b]->link(objects[a].get(), real(weight));
        found = false;
    }
    void dent(size_t a, size_t b, double weight = 1)
    {
        objects[a]->dent(objects[b].get(), real(weight));
        found = false;
    }
    void linkAll()
    {
        for (size_t i = 0; i < objects.size(); ++i)
            for (size_t j = 0; j < i; ++j)
                link(i, j);
    }
    FrameContext frame() { return {eye, light, bodies.get(), &counts, axes, Real(0), Real(0), hider}; }
    void findBodies()
    {
        std::vector<SoftObject*> all;
        for (auto& object : objects)
            all.push_back(object.get());
        if (!bodies->find(all.data(), static_cast<int>(all.size())))
            std::abort();
        found = true;
    }
    void update()
    {
        if (!found)
            findBodies();
        bodies->spreadRecalc();
        for (auto& object : objects)
            object->update(frame());
    }
    // As update(), and nothing is left that only goes on (surface/keeper.h): in a second update, in which nothing
    // has moved, that is settled.
    void settle()
    {
        update();
        update();
    }
    // All voxels of an object, drawn in batches of `room`; their places from the eye, in the axes of the view.
    // `owners` receives for each the index of the object whose colour it has.
    std::vector<Voxel> draw(size_t i, int room = 256, std::vector<size_t>* owners = nullptr)
    {
        std::vector<Voxel> all;
        const auto ownerOf = [&](const VoxelList& list, int k) {
            const RampRun* run = list.run;
            while (list.runs > 0 && run->end <= k)
                ++run;
            size_t owner = 0;
            while (owner < objects.size() && objects[owner]->ramp() != (list.runs > 0 ? run->ramp : list.ramp))
                ++owner;
            return owner;
        };
        auto list = std::make_unique<VoxelList>();
        int next = 0;
        do {
            objects[i]->draw(frame(), *list, room, &next);
            if (list->count > room)
                std::abort();
            for (int k = 0; k < list->count; ++k) {
                all.push_back(list->voxels[k]);
                all.back().x += list->x;
                all.back().y += list->y;
                all.back().z += list->z;
                if (owners != nullptr)
                    owners->push_back(ownerOf(*list, k));
            }
        } while (next != 0);
        return all;
    }
    // The same into views, as the demo does.
    void show(size_t i, std::initializer_list<View*> views, int room = 256)
    {
        auto list = std::make_unique<VoxelList>();
        int next = 0;
        do {
            objects[i]->draw(frame(), *list, room, &next);
            for (View* view : views)
                view->show(*list);
        } while (next != 0);
    }
    // The field as object i sees it: its own and its neighbours'. Balls alone.
    Truth truth(size_t i) const
    {
        Truth t;
        t.balls.push_back({vec(objects[i]->centre()), number(objects[i]->size())});
        for (const List<Link>::Node* node = objects[i]->skel().first(); node != nullptr; node = node->next)
            t.balls.push_back({vec(node->item.object->centre()), number(node->item.object->size()), number(node->item.weight)});
        return t;
    }
};

// Whether a slot of a SoftObject holds a seed that takes part: a regular one, or an oversampled one that is active.
inline bool takesPart(const SoftObject& object, int i)
{
    return (i & 1) == 0 || (object.seed(i).flags & SEED_ACTIVE) != 0;
}

#endif
