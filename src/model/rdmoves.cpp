// Reader: the lines that say how items move and warp.
#include "reader.h"

namespace {

// The component of a vector along axis 0, 1 or 2.
Real& along(Vector& v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Stores a motion as the first of its kind. Returns false if the item has one already.
bool setFirst(Motion& motion, const Move& move)
{
    if (move.part == MOTION_CIRCLE) {
        if (motion.circle.period != Real(0))
            return false;
        motion.u = move.a;
        motion.v = move.b;
        motion.circle = move.wave;
        return true;
    }
    if ((motion.parts & move.part) != 0)
        return false;
    motion.parts |= move.part;
    if (move.part == MOTION_SPIN) {
        motion.spinAxis = move.a;
        motion.spin = move.wave;
    } else if (move.part == MOTION_SWING) {
        motion.swingAxis = move.a;
        motion.swingAngle = move.amount;
        motion.swing = move.wave;
    } else {
        motion.pulse = move.amount;
        motion.pulsing = move.wave;
    }
    return true;
}

}  // namespace

// --- When

// Reads the value of `period`, `phase` or `lag`, whichever is the latest word.
bool Reader::readTiming(const Row& row, Timing* timing)
{
    if (is("phase"))
        return readPhase(&timing->phase);
    if (is("lag"))
        return readLag(row, &timing->lag);
    timing->given = true;
    return readPeriod(&timing->period);
}

// Reads a period; its sign gives the direction of the motion.
bool Reader::readPeriod(Real* seconds)
{
    if (!readReal("seconds", -PERIOD_MOST, PERIOD_MOST, seconds))
        return false;
    return absolute(*seconds) >= PERIOD_LEAST ? true : expected("0.1 seconds or more, or -0.1 or less to go backwards");
}

bool Reader::readPhase(Real* phase)
{
    return readReal("a phase in turns", Real(-1), Real(1), phase);
}

bool Reader::readLag(const Row& row, Real* lag)
{
    if (row.count == 1)
        return expected("no lag, for this name is no row's");
    return readReal("a lag in turns", Real(-1), Real(1), lag);
}

// --- Periodic motions

// Adds a motion to each item of a row, besides its other motions.
bool Reader::addMoves(const Row& row, Move move, const Timing& timing)
{
    for (int i = 0; i < row.count; ++i) {
        move.wave = timing.waveOf(i);
        if (setFirst(in(row, i).motion, move))
            continue;
        Move* place = further(in(row, i), move.part);
        if (place == nullptr)
            return false;
        *place = move;
    }
    return true;
}

// Returns the place for one more motion of a part that the item has already. Complains and returns null if there is no room.
Move* Reader::further(Actor& item, MotionPart part)
{
    Motion& motion = item.motion;
    if (motion.moreCount == Motion::MORE_MOST) {
        word_ = item.name;
        expectedAtMost(Motion::MORE_MOST, "motions of one name beside the first of each kind");
        return nullptr;
    }
    Move& move = motion.more[motion.moreCount++];
    move.part = part;
    return &move;
}

bool Reader::circle()
{
    Row row;
    if (!readMoving(&row))
        return false;
    Move move;
    Timing timing;
    Real radius(0);
    int first = 0, second = 1;  // axes of the plane of the circle
    bool radiusGiven = false, planeGiven = false, uGiven = false, vGiven = false;
    while (nextWord()) {
        bool good;
        if (is("radius")) {
            radiusGiven = true;
            good = readReal("a radius", Real(0), Real(SPACE), &radius);
        } else if (is("plane")) {
            planeGiven = true;
            good = readPlane(&first, &second);
        } else if (is("u")) {
            uGiven = true;
            good = readPlace("an arm, ", &move.a);
        } else if (is("v")) {
            vGiven = true;
            good = readPlace("an arm, ", &move.b);
        } else if (isTiming()) {
            good = readTiming(row, &timing);
        } else {
            good = expected(row.count > 1 ? "radius, plane, u, v, period, phase or lag" : "radius, plane, u, v, period or phase");
        }
        if (!good)
            return false;
    }
    if (radiusGiven == uGiven || uGiven != vGiven)
        return expected("a radius, or both u and v");
    if (planeGiven && !radiusGiven)
        return expected("a plane only beside a radius");
    if (radiusGiven) {
        along(move.a, first) = radius;
        along(move.b, second) = radius;
    }
    return timing.given ? addMoves(row, move, timing) : expected("period");
}

// Reads the names of two different axes.
bool Reader::readPlane(int* first, int* second)
{
    nextWord();
    if (!is("xy") && !is("yz") && !is("zx") && !is("yx") && !is("zy") && !is("xz"))
        return expected("xy, yz, zx, yx, zy or xz");
    *first = word_[0] - 'x';
    *second = word_[1] - 'x';
    return true;
}

bool Reader::path()
{
    Row row;
    if (!readMoving(&row))
        return false;
    // `lag` may come after the paths that it is for, so the line is read twice.
    const char* const start = at_;
    Real lag(0);
    if (!pathClauses(row, &lag, false))
        return false;
    at_ = start;
    return pathClauses(row, &lag, true);
}

// Reads the axes of a path with their amplitudes and periods, and `lag`. With `move` it also adds the paths.
bool Reader::pathClauses(const Row& row, Real* lag, bool move)
{
    bool some = false;
    while (nextWord()) {
        if (row.count > 1 && is("lag")) {
            if (!readLag(row, lag))
                return false;
            continue;
        }
        const int axis = is("x") ? 0 : is("y") ? 1 : is("z") ? 2 : -1;
        if (axis < 0)
            return expected(row.count > 1 ? "x, y or z, each with amplitude, period and phase, or lag"
                                          : "x, y or z, each with amplitude, period and phase");
        Real amplitude;
        Timing timing;
        if (!readReal("an amplitude", Real(-SPACE), Real(SPACE), &amplitude) || !readPeriod(&timing.period) ||
            !readPhase(&timing.phase))
            return false;
        timing.lag = *lag;
        some = true;
        if (move && !moveAlong(row, axis, amplitude, timing))
            return false;
    }
    return some ? true : expected("x, y or z, each with amplitude, period and phase");
}

bool Reader::moveAlong(const Row& row, int axis, Real amplitude, const Timing& timing)
{
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        motion.parts |= MOTION_PATH;
        if (motion.along[axis].period == Real(0)) {
            along(motion.path, axis) = amplitude;
            motion.along[axis] = timing.waveOf(i);
            continue;
        }
        Move* move = further(in(row, i), MOTION_PATH);
        if (move == nullptr)
            return false;
        along(move->a, axis) = amplitude;
        move->wave = timing.waveOf(i);
    }
    return true;
}

// Reads a spin or a swing.
bool Reader::turning(MotionPart part)
{
    Row row;
    if (!readMoving(&row))
        return false;
    const bool swings = part == MOTION_SWING;
    Move move;
    move.part = part;
    Timing timing;
    bool axisGiven = false, angleGiven = !swings;
    while (nextWord()) {
        bool good;
        if (is("axis")) {
            axisGiven = true;
            good = readDirection("an axis, ", &move.a);
        } else if (swings && is("angle")) {
            angleGiven = true;
            good = readReal("degrees", -DEGREES_MOST, DEGREES_MOST, &move.amount);
        } else if (isTiming()) {
            good = readTiming(row, &timing);
        } else {
            char text[60];
            snprintf(text, sizeof text, "axis, %speriod%s", swings ? "angle, " : "",
                     row.count > 1 ? ", phase or lag" : " or phase");
            good = expected(text);
        }
        if (!good)
            return false;
    }
    if (!axisGiven || !angleGiven || !timing.given)
        return expected(!axisGiven ? "axis" : !angleGiven ? "angle" : "period");
    return addMoves(row, move, timing);
}

bool Reader::pulse()
{
    Row row;
    if (!readMoving(&row))
        return false;
    Move move;
    move.part = MOTION_PULSE;
    Timing timing;
    bool given = false;
    while (nextWord()) {
        bool good;
        if (is("by")) {
            given = true;
            good = readReal("a share of the size", Real(0), PULSE_MOST, &move.amount);
        } else if (isTiming()) {
            good = readTiming(row, &timing);
        } else {
            good = expected(row.count > 1 ? "by, period, phase or lag" : "by, period or phase");
        }
        if (!good)
            return false;
    }
    if (!given || !timing.given)
        return expected(!given ? "by" : "period");
    return addMoves(row, move, timing);
}

// --- Warps

// Reads a taper, a twist or a bend.
bool Reader::warp(WarpPart part)
{
    // The units of the amounts, for complaints.
    static const char* const AMOUNTS[WARP_PARTS] = {"a share of the width", "degrees", "degrees"};
    Row row;
    if (!readMoving(&row))
        return false;
    if (in(row, 0).object == nullptr)
        return expected("the name of an object");
    const Real most = WARP_MOST[part];
    Swaying warp;
    Timing timing;
    if (!readReal(AMOUNTS[part], -most, most, &warp.amount))
        return false;
    bool swings = false;
    while (nextWord()) {
        bool good;
        if (is("swing")) {
            swings = true;
            good = readReal(AMOUNTS[part], -most, most, &warp.swing);
        } else if (isTiming()) {
            good = readTiming(row, &timing);
        } else {
            good = expected(row.count > 1 ? "swing, period, phase or lag" : "swing, period or phase");
        }
        if (!good)
            return false;
    }
    if (swings != timing.given)
        return expected(swings ? "period" : "swing");
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        motion.parts |= MOTION_WARP;
        if (swings)
            warp.wave = timing.waveOf(i);
        motion.warp[part] = warp;
    }
    return true;
}

// --- Keys

bool Reader::keys()
{
    Row row;
    if (!readMoving(&row))
        return false;
    for (int i = 0; i < row.count; ++i) {
        if (in(row, i).motion.keyCount > 0) {
            word_ = in(row, i).name;
            return expected("keys before the first key");
        }
    }
    // All items of a row get the same values; what the line does not say stays as it was.
    const char* const start = at_;
    for (int i = 0; i < row.count; ++i) {
        at_ = start;
        if (!keysClauses(in(row, i).motion))
            return false;
    }
    return true;
}

bool Reader::keysClauses(Motion& motion)
{
    while (nextWord()) {
        bool good = true;
        if (is("linear") || is("smooth")) {
            motion.smooth = is("smooth");
        } else if (is("repeat")) {
            Real repeat;
            good = readReal("seconds", PERIOD_LEAST, KEY_TIME_MOST, &repeat);
            motion.repeat = good ? rawFromReal(repeat) : 0;
        } else if (is("axis")) {
            good = readDirection("an axis, ", &motion.keyAxis);
        } else {
            good = expected("linear, smooth, repeat or axis");
        }
        if (!good)
            return false;
    }
    return true;
}

bool Reader::key()
{
    Row row;
    if (!readMoving(&row))
        return false;
    Real time;
    if (!readReal("seconds", Real(0), KEY_TIME_MOST, &time))
        return false;
    Key key{rawFromReal(time), {Real(0), Real(0), Real(0), Real(0), Real(1)}};
    if (!fitsKeys(row, key.time) || !keyValues(&key))
        return false;
    if (model_.keyCount() + row.count > Model::KEYS_MOST) {
        word_ = "key";
        return expectedAtMost(Model::KEYS_MOST, "keys");
    }
    for (int i = 0; i < row.count; ++i)
        if (!model_.addKey(&in(row, i), key))
            return trouble("not enough memory for the keys");
    return true;
}

// Returns true if the time read last is later than the keys of each item of a row and before they repeat; complains if not.
bool Reader::fitsKeys(const Row& row, int32_t time)
{
    for (int i = 0; i < row.count; ++i) {
        const Motion& motion = in(row, i).motion;
        if (motion.keyCount > 0 && time <= model_.keys()[motion.firstKey + motion.keyCount - 1].time)
            return expected("a time after that of the key before");
        if (motion.repeat > 0 && time >= motion.repeat)
            return expected("a time before that of repeat");
    }
    return true;
}

bool Reader::keyValues(Key* key)
{
    Vector v;
    if (!readPlace("a place, ", &v))
        return false;
    key->value[0] = v.x;
    key->value[1] = v.y;
    key->value[2] = v.z;
    while (nextWord()) {
        bool good;
        if (is("angle"))
            good = readReal("degrees", -KEY_DEGREES_MOST, KEY_DEGREES_MOST, &key->value[3]);
        else if (is("scale"))
            good = readReal("a scale", SCALE_LEAST, SCALE_MOST, &key->value[4]);
        else
            good = expected("angle or scale");
        if (!good)
            return false;
    }
    return true;
}
