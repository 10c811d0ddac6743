// Camera: where the viewer is and how he projects. He looks along +z, y up: a point p from the eye falls on column
// centreX + focalX p.x / p.z and row centreY - focalY p.y / p.z. Mode 13h shows 320x200 pixels on a 4:3 screen, so a pixel
// is 5 wide to 6 high and focalX = 1.2 focalY.
#ifndef FB_CAMERA_H
#define FB_CAMERA_H

#include "math/vec.h"

// Focal lengths and the centre in pixels; 64 <= focal <= 500.
struct Camera {
    Point eye{Real(0), Real(0), Real(-120)};
    Real focalX{250};
    Real focalY{208.333333};
    Real centreX{160};
    Real centreY{100};
};

#endif
