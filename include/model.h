// Model: which objects there are, what they blend with, how they are lit, seen, coloured and moved.
#ifndef FB_MODEL_H
#define FB_MODEL_H

#include "anim.h"
#include "softobj.h"
#include "view.h"

struct Colour {
    uint8_t red, green, blue;  // 0..255
};

// An object with its part in the scene.
struct Actor {
    SoftObject* object;
    Colour colour;
    Motion motion;
};

class Model {
public:
    static constexpr int OBJECTS_MOST = 128;

    Model() = default;
    ~Model();
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    // The report's predefined model: four spheres of sizes 20, 25, 30 and 35, each blending with the other three, on
    // circular paths round the origin. False: no memory.
    bool makeFourSpheres();

    // Takes over an object made with make<>(). False (and the object destroyed): no room.
    bool add(SoftObject* object, const Colour& colour, const Motion& motion);

    // Links two objects both ways with one weight. False: no memory.
    bool link(SoftObject* a, SoftObject* b, Real weight);

    // Lays out the seeds of all objects, `spacing` units apart. False: no memory; objects already done are put back to
    // the spacing they had where that is possible.
    bool resample(Real spacing);

    // Number of seeds of all objects: regular, oversampled.
    int seeds() const;
    int oversampledSeeds() const;

    int count() const { return count_; }
    Actor& actor(int i) { return actors_[i]; }
    const Actor& actor(int i) const { return actors_[i]; }

    Camera camera;
    Vector light{Real(0.5), Real(0.7), Real(-0.5)};  // from the model to the light, any length

private:
    Actor actors_[OBJECTS_MOST];
    int count_ = 0;
};

#endif
