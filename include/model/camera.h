// Camera: where the viewer is, which way he looks and how he projects. A point at the vector p from the eye, in the axes of the
// view, is shown at column centreX + focalX p.x / p.z and row centreY - focalY p.y / p.z. Mode 13h shows 320x200 pixels on a
// 4:3 screen, so a pixel is 5 wide to 6 high and focalX = 1.2 focalY.
#ifndef FB_CAMERA_H
#define FB_CAMERA_H

#include "machine.h"
#include "math/vec.h"

// The axes of a view in the world: to its right, upwards and ahead. They are unit vectors, perpendicular to each other.
struct ViewAxes {
    Vector right{Real(1), Real(0), Real(0)};
    Vector up{Real(0), Real(1), Real(0)};
    Vector ahead{Real(0), Real(0), Real(1)};
    bool turned = false;  // false: the axes are those of the world, and fromWorld() and toWorld() change nothing

    // fromWorld() expresses a vector of the world in these axes; toWorld() is the inverse.
    Vector fromWorld(const Vector& v) const
    {
        return turned ? Vector{dot(right, v), dot(up, v), dot(ahead, v)} : v;
    }
    Vector toWorld(const Vector& v) const { return turned ? right * v.x + up * v.y + ahead * v.z : v; }

    bool operator==(const ViewAxes& other) const
    {
        return right == other.right && up == other.up && ahead == other.ahead;
    }
};

// The axes of a view that looks along `ahead` with its upper edge towards `up`; neither needs unit length. Where the two are
// parallel or nearly so, `right` says what lies to the right. A zero `ahead` gives the axes of the world.
ViewAxes viewAlong(const Vector& ahead, const Vector& up, const Vector& right);

// Turns the axes about `ahead`, so that the viewer leans to the right.
ViewAxes leaned(const ViewAxes& axes, Angle angle);

// Turns the axes in the world. `by` is a pure rotation.
ViewAxes turnedBy(const Matrix& by, const ViewAxes& axes);

// Focal lengths (FOCAL_LEAST..FOCAL_MOST of model/scene.h) and the centre of the picture are in pixels.
struct Camera {
    // Place and axes of the eye, as Anim::move() left them.
    Point eye{Real(0), Real(0), Real(-120)};
    ViewAxes axes;
    Point target{Real(0), Real(0), Real(0)};  // the point looked at, unless `looks` is AHEAD

    Real focalX{250};
    Real focalY{208.333333};
    Real centreX{machine::WIDTH / 2};
    Real centreY{machine::HEIGHT / 2};

    // What the scene says. An eye that moves is carried by a group and has the group's motion.
    int carrier = 0;             // number of that group; 0: the eye stands
    enum Looks : uint8_t { AHEAD, AT_POINT, AT_ITEM } looks = AHEAD;
    int item = 0;                // number of the object or group looked at (AT_ITEM)
    Real roll{0};                // degrees by which the viewer leans to the right
};

#endif
