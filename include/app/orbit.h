// Orbit: how far the user has moved the eye around the scene, over it and nearer to it, relative to the scene's own camera.
#ifndef FB_ORBIT_H
#define FB_ORBIT_H

#include "model/model.h"

class Orbit {
public:
    // Moves the eye by two angles in degrees: `round` to the right around the scene, `over` upwards. It stops short of both
    // poles.
    void turn(Real round, Real over);
    // Multiplies the distance by a factor; the result is limited to 0.125..4 times the scene's own distance.
    void approach(Real factor);
    // Returns to the scene's own view.
    void reset() { *this = Orbit(); }

    // Returns the scene's camera `camera` as moved by the user. The eye turns about the camera's target; when the camera has
    // no target, the eye turns about the middle that the objects had when it left its own place.
    Camera from(const Camera& camera, const Model& model);

private:
    Real round_{0}, over_{0};  // degrees
    Real distance_{1};         // factor of the scene's own distance
    Point middle_{Real(0), Real(0), Real(0)};
    bool away_ = false;        // the eye has left its own place, and `middle_` is valid
};

#endif
