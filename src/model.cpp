// The model, and the one that comes with the program.
#include "model.h"

#include "alloc.h"
#include "sphere.h"

namespace {

// Radius of the circular paths, units.
constexpr int PATH = 22;

// A circle of PATH units round the origin, its plane given by two perpendicular unit vectors.
Motion circle(const Vector& u, const Vector& v, Real phase, uint32_t rate)
{
    return {{Real(0), Real(0), Real(0)}, u * Real(PATH), v * Real(PATH), turns(phase), rate};
}

// Turns a second as Motion takes them, for a circle that closes every `seconds`.
constexpr uint32_t every(uint32_t seconds)
{
    return 0xffffffffu / seconds;
}

}  // namespace

Model::~Model()
{
    for (int i = 0; i < count_; ++i)
        destroy(actors_[i].object);
}

bool Model::add(SoftObject* object, const Colour& colour, const Motion& motion)
{
    if (object == nullptr || count_ == OBJECTS_MOST) {
        destroy(object);
        return false;
    }
    actors_[count_++] = {object, colour, motion};
    return true;
}

bool Model::link(SoftObject* a, SoftObject* b, Real weight)
{
    return a->link(b, weight) && b->link(a, weight);
}

bool Model::makeFourSpheres()
{
    const Real h(0.70710678);
    const Vector x{Real(1), Real(0), Real(0)}, y{Real(0), Real(1), Real(0)}, z{Real(0), Real(0), Real(1)};
    const Vector slant{Real(0), h, h};
    const bool done = add(make<Sphere>(1, Real(20)), {255, 64, 48}, circle(x, y, Real(0), every(5))) &&
                      add(make<Sphere>(2, Real(25)), {64, 208, 72}, circle(y, z, Real(0.25), every(7))) &&
                      add(make<Sphere>(3, Real(30)), {72, 112, 255}, circle(z, x, Real(0.5), every(9))) &&
                      add(make<Sphere>(4, Real(35)), {255, 200, 48}, circle(x, slant, Real(0.75), every(11)));
    if (!done)
        return false;
    for (int i = 0; i < count_; ++i)
        for (int j = 0; j < i; ++j)
            if (!link(actors_[i].object, actors_[j].object, Real(1)))
                return false;
    return true;
}

bool Model::resample(Real spacing)
{
    for (int i = 0; i < count_; ++i) {
        const Real before = actors_[i].object->spacing();
        if (!actors_[i].object->resample(spacing)) {
            while (--i >= 0)
                actors_[i].object->resample(before);
            return false;
        }
        actors_[i].object->shadeRest(unit(light));
    }
    return true;
}

int Model::seeds() const
{
    int sum = 0;
    for (int i = 0; i < count_; ++i)
        sum += actors_[i].object->seeds();
    return sum;
}

int Model::oversampledSeeds() const
{
    int sum = 0;
    for (int i = 0; i < count_; ++i)
        sum += actors_[i].object->oversampledSeeds();
    return sum;
}
