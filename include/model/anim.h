// Anim: how the parts of the model move. Motion is driven by time alone, so that "the animation sequence is exactly the same in
// all cases but more frames are rendered on a faster system" (report, Section V): a place is computed from the time, never from
// the place in the previous frame, so no errors add up and every build shows the same.
#ifndef FB_ANIM_H
#define FB_ANIM_H

#include "math/vec.h"
#include "model/warp.h"

struct Actor;
class Model;

// Animation time in 1/65536 s since the start; 48 bits are used.
typedef uint64_t Time;

// The space of the model: no coordinate of a centre or of the eye exceeds this (units, either sign), so that the distance between
// any two of them fits 16.16. What is too far from the eye for the Z-buffer is not drawn.
constexpr int SPACE = 250;

inline bool isInSpace(const Point& p)
{
    return absolute(p.x) <= Real(SPACE) && absolute(p.y) <= Real(SPACE) && absolute(p.z) <= Real(SPACE);
}

// The place itself, or if it is outside the space, a place at its edge.
inline Point clampedToSpace(const Point& p)
{
    const Real edge(SPACE);
    return {clamp(p.x, -edge, edge), clamp(p.y, -edge, edge), clamp(p.z, -edge, edge)};
}

// The range of the factor by which parents, pulses and keys together scale an object's size.
constexpr Real SCALE_LEAST(0.0625);
constexpr Real SCALE_MOST(4);

// A periodic motion: its angle is `phase` at time 0 and grows by `rate` / 2^32 turns a second.
struct Wave {
    Angle phase = 0;
    uint64_t rate = 0;  // modulo 2^64, so that a negative rate makes the motion run backwards
    Real period{0};     // seconds, as asked for; the rate follows from it. 0: the angle stays at `phase`
};

// A wave with a period of `seconds` (negative: backwards; |seconds| >= 0.01; 0: it stands) that starts at `phase` turns.
Wave makeWave(Real seconds, Real phase);

// The angle of a wave at a time; it wraps around.
inline Angle angleAt(const Wave& wave, Time time)
{
    return wave.phase + static_cast<Angle>((time * wave.rate) >> 16);
}

// A keyframe: at `time` (1/65536 s, 0 or more) the object is displaced from its centre by (x, y, z), turned by an angle about
// Motion::keyAxis, and scaled by a factor.
struct Key {
    static constexpr int VALUES = 5;

    int32_t time;
    Real value[VALUES];  // x, y, z (units), angle (degrees), scale
};

// The parts of a motion that are in use; the others cost no time.
enum MotionPart : uint8_t {
    MOTION_TURN = 1,
    MOTION_PATH = 2,
    MOTION_SPIN = 4,
    MOTION_SWING = 8,
    MOTION_PULSE = 16,
    MOTION_KEYS = 32,
    MOTION_CIRCLE = 64,  // of a Move only: a motion's own circle is in use if its period is not 0
    MOTION_WARP = 128,   // objects only
};

// An amount of a warp that may swing to and fro: amount + swing sin(a).
struct Swaying {
    Real amount{0}, swing{0};
    Wave wave;
};

// One more circle, path, spin, swing or pulse after the first of its kind.
struct Move {
    MotionPart part = MOTION_CIRCLE;
    Vector a{Real(0), Real(0), Real(0)};  // circle: u; path: the amplitude along its axis; spin, swing: the axis
    Vector b{Real(0), Real(0), Real(0)};  // circle: v
    Real amount{0};                       // swing: degrees to each side; pulse: factor of the sine
    Wave wave;
};

// The motion of an object or a group relative to its parent (or to the world, without one):
//
//     place = centre + circles + paths + key        turn = swings key spins turn        scale = own pulses key
//
// Every part is a function of time and may be left out. The first circle, spin, swing and pulse, and the first path along each
// axis, have members of their own; further ones are in `more` and are applied after the first of their kind.
struct Motion {
    static constexpr int MORE_MOST = 4;

    // The circular paths of the report's automatic mode: u cos(a) + v sin(a). Two perpendicular vectors of equal length give a
    // circle, any others an ellipse; if both are zero there is no such motion.
    Point centre{Real(0), Real(0), Real(0)};
    Vector u{Real(0), Real(0), Real(0)}, v{Real(0), Real(0), Real(0)};
    Wave circle;

    uint8_t parts = 0;  // MotionPart

    Vector turn{Real(0), Real(0), Real(0)};  // degrees about x, then y, then z, -360..360

    // Lissajous figure: along each axis an amplitude of its own (units) times a sine of its own.
    Vector path{Real(0), Real(0), Real(0)};
    Wave along[3];

    // A steady turn about an axis, and a swing to and fro about another by `swingAngle` degrees to each side.
    Vector spinAxis{Real(0), Real(1), Real(0)};
    Wave spin;
    Vector swingAxis{Real(1), Real(0), Real(0)};
    Real swingAngle{0};
    Wave swing;

    // The size is multiplied by 1 + pulse sin(a), 0 <= pulse <= 0.75.
    Real pulse{0};
    Wave pulsing;

    // Amounts of taper, twist and bend.
    Swaying warp[WARP_PARTS];

    // Keyframes firstKey .. firstKey + keyCount - 1 of the model, in rising order of time. Before the first key and after the
    // last the object rests. If `repeat` is not 0 (1/65536 s, later than the last key) the keys repeat with that period. If
    // `smooth`, the speed does not jump at a key.
    int16_t firstKey = 0;
    int16_t keyCount = 0;
    bool smooth = false;
    int32_t repeat = 0;
    Vector keyAxis{Real(0), Real(0), Real(1)};

    Move more[MORE_MOST];
    uint8_t moreCount = 0;

    Real scale{1};
    int parent = 0;  // number of the object or group that the item moves, turns and scales with; 0: none
};

// Place of the centre, orientation and scale.
struct Pose {
    Point place{Real(0), Real(0), Real(0)};
    Matrix turn = Matrix::identity();
    Real scale{1};
};

// The place on the motion's own circle at a time; all other parts are left out.
Point placeAt(const Motion& motion, Time time);

// The orientation after turns by `degrees` about x, then y, then z.
Matrix turnFrom(const Vector& degrees);

// Any number of degrees as an angle, good to 2^-16 degrees.
Angle fromDegrees(Real degrees);

class Anim {
public:
    // Gives every object and group of the model its place, turn and scale at `time`; then moves the eye.
    static void move(Model& model, Time time);

    // Chooses which balls ride (SoftObject::setRides()): those whose neighbours travel less beside them if they do. All poses stay
    // as they are; to be called before the first move(), which turns what rides. Without memory nothing rides.
    static void chooseRiders(Model& model);

private:
    // The pose of an item in the world. Its parent's Actor::pose must be that of the same time.
    static Pose poseOf(const Model& model, const Actor& actor, Time time);
};

#endif
