// Surface: what finds the surface of one object in every frame. There are two: the report's method as printed, and ours
// (both in surface/). The model knows neither; it hands its objects' seeds to whichever the program chose.
#ifndef FB_SURFACE_H
#define FB_SURFACE_H

#include "model/camera.h"

class Bodies;
class SoftObject;
struct VoxelList;

// What was done for a frame, as the statistics count it.
struct Counts {
    uint32_t updated;      // seeds whose position was looked for
    uint32_t drawn;        // scales drawn
    uint32_t iterations;   // evaluations of the whole field while seeds were updated
    uint32_t normals;      // surface normals taken from the field
    uint32_t samples;      // evaluations of the whole field for normals (three each with the report's method)
    uint32_t unsettled;    // seeds that reached the iteration limit
};

// What stands in front of an object: the picture of all that is nearer.
class Hider {
public:
    // Whether nothing of a ball would be seen in the picture. `place` is from the eye, axes of the view, 1/256 unit, as `radius`.
    virtual bool hides(const int32_t place[3], int32_t radius) const = 0;

protected:
    ~Hider() {}
};

// What a frame means for every object: the viewer, the light and the bodies that links make.
struct FrameContext {
    Point eye;             // where the viewer is
    Vector light;          // unit vector from the model towards the light
    const Bodies* bodies;  // of the model as it is now
    Counts* counts;
    ViewAxes axes{};       // which way he looks

    // A point of the world from the eye, in the axes of the view.
    Vector inView(const Point& p) const { return axes.fromWorld(p - eye); }
    // How far one sees to each side, and up and down, at a distance of 1; 0: without end.
    Real sideways = Real(0), upward = Real(0);
    // What hides parts of the objects, which are taken the nearest first; null: nothing.
    const Hider* hider = nullptr;
};

class Surface {
public:
    virtual ~Surface() {}

    // Settles the object's seeds on the surface (report, Section III, update()). Called when something changed, and when the last
    // call returned true: it was stopped, or left seeds that would have been hidden.
    virtual bool update(const FrameContext& frame) = 0;

    // Takes note that the seeds' roots and paths, and where they rest, have changed.
    virtual void reshape() {}

    // Lists the voxels of the settled seeds, as many as fit `room` (DRAW_ROOM..VOXELS_AT_ONCE). `*next` is 0 for the first
    // call of a frame; the call changes it, and as long as it is not 0 there are more. An object without a surface
    // (SoftObject::hasSurface) has none of its own.
    virtual void draw(const FrameContext& frame, VoxelList& list, int room, int* next) = 0;
};

// Makes the surface of an object whose seeds have just been laid out. Null: no memory.
typedef Surface* (*SurfaceMaker)(SoftObject& object);

// Least room for voxels that Surface::draw() can work with.
constexpr int DRAW_ROOM = 128;

#endif
