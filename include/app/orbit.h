// Orbit: how far the user has gone about the scene, round it, over it, nearer to it; seen from the scene's own eye.
#ifndef FB_ORBIT_H
#define FB_ORBIT_H

#include "model/model.h"

class Orbit {
public:
    // Turns by degrees: round the scene to the right, over it. Neither pole is passed.
    void turn(Real round, Real over);
    // Changes the distance by a factor, within limits.
    void approach(Real factor);
    // Back to the scene's own view.
    void reset() { *this = Orbit(); }

    // The camera that the scene's own one becomes. The eye goes round what it looks at, or else round the middle that the
    // objects have when it first leaves its place.
    Camera from(const Camera& camera, const Model& model);

private:
    Real round_{0}, over_{0};  // degrees
    Real distance_{1};         // of the scene's own
    Point middle_{Real(0), Real(0), Real(0)};
    bool away_ = false;        // it has left its place
};

#endif
