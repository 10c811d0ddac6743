// Surface: finds the surface of one object in every frame. There are two implementations: the report's method as printed, and
// ours (both in surface/). The model knows neither; it hands its objects' seeds to the one that the program chose.
#ifndef FB_SURFACE_H
#define FB_SURFACE_H

#include "model/camera.h"

class Bodies;
class SoftObject;
struct VoxelList;

// The work done for a frame, as the statistics count it.
struct Counts {
    uint32_t updated;      // seeds whose position was searched
    uint32_t drawn;        // scales drawn
    uint32_t iterations;   // evaluations of the whole field while seeds were updated
    uint32_t normals;      // surface normals taken from the field
    uint32_t samples;      // evaluations of the whole field for normals (three each with the report's method)
    uint32_t unsettled;    // seeds that reached the iteration limit
};

// A picture of everything nearer than an object, which may hide the object.
class Hider {
public:
    // Returns true if nothing of a ball would be seen in the picture. `place` is the centre relative to the eye, in the axes of
    // the view; `place` and `radius` are in 1/256 unit.
    virtual bool hides(const int32_t place[3], int32_t radius) const = 0;

protected:
    ~Hider() {}
};

// The values that are the same for all objects of a frame: the viewer, the light and the bodies.
struct FrameContext {
    Point eye;             // where the viewer is
    Vector light;          // unit vector from the model towards the light
    const Bodies* bodies;  // the model's bodies, found from its present links
    Counts* counts;
    ViewAxes axes{};       // axes of the view

    // The vector from the eye to a point of the world, in the axes of the view.
    Vector inView(const Point& p) const { return axes.fromWorld(p - eye); }
    // Half the width and half the height of the view at a distance of 1; 0: unlimited.
    Real sideways = Real(0), upward = Real(0);
    // Picture of the objects nearer than the present one (objects are handled from the nearest on); null: nothing hides.
    const Hider* hider = nullptr;
};

class Surface {
public:
    virtual ~Surface() {}

    // Settles the object's seeds on the surface (report, Section III, update()). It is called when something has changed, and
    // when the previous call returned true: that call was stopped, or it left out seeds that would have been hidden or whose voxels
    // could be predicted.
    virtual bool update(const FrameContext& frame) = 0;

    // Tells the surface that the seeds' roots, paths and resting places have changed.
    virtual void reshape() {}

    // Lists the voxels of the settled seeds, at most `room` at a time (DRAW_ROOM..VOXELS_AT_ONCE). If update() was called for
    // this frame, `frame` is the one that it had. `*next` is 0 in the first call of a frame; each call changes it, and as long as
    // it is not 0 there are more voxels. An object without a surface (SoftObject::hasSurface) has no voxels of its own.
    virtual void draw(const FrameContext& frame, VoxelList& list, int room, int* next) = 0;
};

// Makes the surface of an object whose seeds have just been laid out. Returns null when there is no memory.
typedef Surface* (*SurfaceMaker)(SoftObject& object);

// The least `room` for voxels that Surface::draw() can work with.
constexpr int DRAW_ROOM = 150;

#endif
