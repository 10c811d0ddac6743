// Anim: how the parts of the model move. Driven by time alone, so that "the animation sequence is exactly the same in
// all cases but more frames are rendered on a faster system" (report, Section V): where something is follows from the
// time, never from where it was a frame ago, so nothing drifts and every build shows the same.
#ifndef FB_ANIM_H
#define FB_ANIM_H

#include "math/vec.h"
#include "model/warp.h"

class Model;

// Animation time in 1/65536 s since the start; 48 bits are used.
typedef uint64_t Time;

// The space of the model: no coordinate of a centre, and none of the eye, goes beyond this (units, either sign), so
// that every distance is safe in 16.16 and nothing lies behind the far end of the Z-buffer.
constexpr int SPACE = 250;

// What parents, pulses and keys may make of a size, together: factors from 1/16 to 4.
constexpr Real SCALE_LEAST(0.0625);
constexpr Real SCALE_MOST(4);

// Something that comes round: its angle is `phase` at time 0 and grows by `rate` / 2^32 turns a second.
struct Wave {
    Angle phase = 0;
    uint64_t rate = 0;  // modulo 2^64, so that a negative rate runs backwards
    Real period{0};     // seconds, as it was asked for; the rate follows from it. 0: it stands at its phase
};

// The wave with a period of `seconds` (negative: backwards; |seconds| >= 0.01) that starts `phase` turns on.
Wave makeWave(Real seconds, Real phase);

// The angle of a wave at a time.
inline Angle angleAt(const Wave& wave, Time time)
{
    return wave.phase + static_cast<Angle>((time * wave.rate) >> 16);
}

// A keyframe: at `time` (1/65536 s, 0 or more) the object is this far from its centre, turned by so many degrees about
// the axis of its keys, and scaled by this factor.
struct Key {
    static constexpr int VALUES = 5;

    int32_t time;
    Real value[VALUES];  // x, y, z (units), angle (degrees), scale
};

// Which parts of a motion are in use; those that are not cost nothing.
enum MotionPart : uint8_t {
    MOTION_TURN = 1,
    MOTION_PATH = 2,
    MOTION_SPIN = 4,
    MOTION_SWING = 8,
    MOTION_PULSE = 16,
    MOTION_KEYS = 32,
    MOTION_CIRCLE = 64,  // of a Move alone: a motion's own circle is there when its period is not 0
    MOTION_WARP = 128,   // objects only
};

// An amount that may go to and fro: amount + swing sin(a).
struct Swaying {
    Real amount{0}, swing{0};
    Wave wave;
};

// One more circle, path, spin, swing or pulse beside the first of its kind.
struct Move {
    MotionPart part = MOTION_CIRCLE;
    Vector a{Real(0), Real(0), Real(0)};  // circle: u; path: the amplitude along its axis; spin, swing: the axis
    Vector b{Real(0), Real(0), Real(0)};  // circle: v
    Real amount{0};                       // swing: degrees to each side; pulse: the share
    Wave wave;
};

// How an object or a group moves, seen from its parent (or from the world, without one):
//
//     place = centre + circles + paths + key        turn = swings key spins turn        scale = own pulses key
//
// Every part is a function of time and may be left out. The first circle, spin, swing and pulse, and the first path along
// each axis, have places of their own; further ones follow in `more` and come after the first of their kind.
struct Motion {
    static constexpr int MORE_MOST = 4;

    // The circular paths of the report's automatic mode: u cos(a) + v sin(a). Two perpendicular vectors of equal
    // length give a circle, others an ellipse; both zero: nothing.
    Point centre{Real(0), Real(0), Real(0)};
    Vector u{Real(0), Real(0), Real(0)}, v{Real(0), Real(0), Real(0)};
    Wave circle;

    uint8_t parts = 0;  // MotionPart

    Vector turn{Real(0), Real(0), Real(0)};  // degrees about x, then y, then z, -360..360

    // Lissajous: along each axis of its own amplitude (units), with a sine of its own.
    Vector path{Real(0), Real(0), Real(0)};
    Wave along[3];

    // A steady turn about an axis; and one to and fro, by `swingAngle` degrees to each side.
    Vector spinAxis{Real(0), Real(1), Real(0)};
    Wave spin;
    Vector swingAxis{Real(1), Real(0), Real(0)};
    Real swingAngle{0};
    Wave swing;

    // Size times 1 + pulse sin(a), 0 <= pulse <= 0.75.
    Real pulse{0};
    Wave pulsing;

    // Taper, twist and bend.
    Swaying warp[WARP_PARTS];

    // Keyframes firstKey .. firstKey + keyCount - 1 of the model, in rising order of time. Before the first and behind
    // the last it rests; with `repeat` (1/65536 s, above the last key's time) they go round and round. Smooth: the
    // speed does not jump at a key.
    int16_t firstKey = 0;
    int16_t keyCount = 0;
    bool smooth = false;
    int32_t repeat = 0;
    Vector keyAxis{Real(0), Real(0), Real(1)};

    Move more[MORE_MOST];
    uint8_t moreCount = 0;

    Real scale{1};
    int parent = 0;  // number of the object or group that it moves, turns and scales with; 0: none
};

// Where something is: the place of its centre, its orientation and how it is scaled.
struct Pose {
    Point place{Real(0), Real(0), Real(0)};
    Matrix turn = Matrix::identity();
    Real scale{1};
};

// Where the circle of a motion is at a time, as if there were no other parts.
Point placeAt(const Motion& motion, Time time);

// The orientation that `degrees` about x, then y, then z make.
Matrix turnFrom(const Vector& degrees);

// Degrees (any) as an angle, good to 2^-16 degrees.
Angle fromDegrees(Real degrees);

class Anim {
public:
    // Moves every object of the model to its place at `time`, and turns and scales it; and the eye.
    static void move(Model& model, Time time);
};

#endif
