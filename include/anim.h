// Anim: how the parts of the model move. Driven by time alone, so that "the animation sequence is exactly the same in
// all cases but more frames are rendered on a faster system" (report, Section V).
#ifndef FB_ANIM_H
#define FB_ANIM_H

#include "vec.h"

class Model;

// Animation time in 1/65536 s since the start; 48 bits are used.
typedef uint64_t Time;

// The predefined circular paths of the report's automatic mode: place = centre + u cos(a) + v sin(a), where the angle a
// is `phase` at time 0 and grows by `rate` / 2^32 turns a second. Two perpendicular vectors of equal length give a
// circle, others an ellipse; both zero: it stays.
struct Motion {
    Point centre;
    Vector u, v;
    Angle phase;
    uint32_t rate;
};

// Where a motion is at a time.
Point placeAt(const Motion& motion, Time time);

class Anim {
public:
    // Moves every object of the model to its place at `time`.
    static void move(Model& model, Time time);
};

#endif
