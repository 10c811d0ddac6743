// Anim: computes poses from motions and the time, item by item.
#include "model/anim.h"

#include "model/model.h"
#include "model/round.h"

namespace {

constexpr Vector X_AXIS{Real(1), Real(0), Real(0)}, Y_AXIS{Real(0), Real(1), Real(0)}, Z_AXIS{Real(0), Real(0), Real(1)};

// The values of a motion's keys at one time.
struct Keyed {
    Real value[Key::VALUES];
};

// Converts a time of the animation to one of the keys: modulo `repeat`, or clamped to the last key.
int32_t keyTime(const Key* keys, const Motion& motion, Time time)
{
    if (motion.repeat > 0) {
        uint32_t rest;
        divide64(time, static_cast<uint32_t>(motion.repeat), &rest);
        return static_cast<int32_t>(rest);
    }
    const int32_t last = keys[motion.keyCount - 1].time;
    return time > static_cast<Time>(last) ? last : static_cast<int32_t>(time);
}

// The keys of a motion by index. If they repeat, the row continues at both ends: key -1 is the last key of the previous round.
class KeyRow {
public:
    KeyRow(const Key* keys, const Motion& motion) : keys_(keys), count_(motion.keyCount), repeat_(motion.repeat) {}

    const Key& key(int i) const { return keys_[index(i)]; }
    // The time of key i, counted from the start of the present round.
    int64_t timeOf(int i) const
    {
        return static_cast<int64_t>(key(i).time) + (i < 0 ? -repeat_ : i >= count_ ? repeat_ : 0);
    }
    bool has(int i) const { return repeat_ > 0 || (i >= 0 && i < count_); }
    // The index of the last key that is not later than a time; -1 if all are later.
    int before(int32_t time) const
    {
        int i = -1;
        while (i + 1 < count_ && keys_[i + 1].time <= time)
            ++i;
        return i;
    }

private:
    int index(int i) const { return (i + 2 * count_) % count_; }

    const Key* keys_;
    int count_;
    int32_t repeat_;
};

// A cubic (Hermite) interpolation from key `index` to the next, at fraction `s` of the way. Its slope at a key is that of the line
// between the keys before and after; at the ends of a run that does not repeat the slope is 0.
Keyed smoothly(const KeyRow& row, int index, Real s)
{
    const Key &from = row.key(index), &to = row.key(index + 1);
    const int64_t start = row.timeOf(index), end = row.timeOf(index + 1);
    const int32_t span = static_cast<int32_t>(end - start);
    const Real s2 = s * s, s3 = s2 * s;
    const Real onto = s2 * Real(3) - s3 * Real(2);
    const Real outSlope = s3 - s2 * Real(2) + s, inSlope = s3 - s2;
    const bool before = row.has(index - 1), after = row.has(index + 2);
    const Key& previous = before ? row.key(index - 1) : from;
    const Key& next = after ? row.key(index + 2) : to;
    const int32_t aroundFrom = before ? static_cast<int32_t>(end - row.timeOf(index - 1)) : 1;
    const int32_t aroundTo = after ? static_cast<int32_t>(row.timeOf(index + 2) - start) : 1;
    Keyed now;
    for (int i = 0; i < Key::VALUES; ++i) {
        const Real a = from.value[i], b = to.value[i];
        const Real slopeFrom = before ? portion(b - previous.value[i], span, aroundFrom) : Real(0);
        const Real slopeTo = after ? portion(next.value[i] - a, span, aroundTo) : Real(0);
        now.value[i] = a + (b - a) * onto + slopeFrom * outSlope + slopeTo * inSlope;
    }
    return now;
}

// Linear interpolation from one key to the next.
Keyed linearly(const Key& from, const Key& to, Real s)
{
    Keyed now;
    for (int i = 0; i < Key::VALUES; ++i)
        now.value[i] = from.value[i] + (to.value[i] - from.value[i]) * s;
    return now;
}

Keyed keyed(const Key* keys, const Motion& motion, Time time)
{
    const KeyRow row(keys, motion);
    const int32_t t = keyTime(keys, motion, time);
    const int index = row.before(t);
    if (!row.has(index) || !row.has(index + 1)) {
        const Key& only = row.has(index) ? row.key(index) : row.key(0);
        return linearly(only, only, Real(0));
    }
    const int64_t start = row.timeOf(index);
    const int32_t span = static_cast<int32_t>(row.timeOf(index + 1) - start);
    const Real s = realFromRaw(mulDiv(static_cast<int32_t>(t - start), 65536, span));
    return motion.smooth ? smoothly(row, index, s) : linearly(row.key(index), row.key(index + 1), s);
}

// The pose of an item relative to its parent.
Pose poseAt(const Model& model, const Motion& motion, Time time)
{
    Pose pose;
    pose.place = placeAt(motion, time);
    pose.scale = motion.scale;
    if (motion.parts == 0 && motion.moreCount == 0)
        return pose;
    // Calls `with` for each further move of a part, with the move and its angle.
    const auto further = [&](MotionPart part, auto with) {
        for (int i = 0; i < motion.moreCount; ++i)
            if (motion.more[i].part == part)
                with(motion.more[i], angleAt(motion.more[i].wave, time));
    };
    further(MOTION_CIRCLE, [&](const Move& m, Angle angle) { pose.place = pose.place + m.a * cosine(angle) + m.b * sine(angle); });
    if (motion.parts & MOTION_TURN)
        pose.turn = turnFrom(motion.turn);
    if (motion.parts & MOTION_PATH) {
        const auto part = [&](Real amplitude, int i) { return amplitude * sine(angleAt(motion.along[i], time)); };
        pose.place = pose.place + Vector{part(motion.path.x, 0), part(motion.path.y, 1), part(motion.path.z, 2)};
    }
    further(MOTION_PATH, [&](const Move& m, Angle angle) { pose.place = pose.place + m.a * sine(angle); });
    if (motion.parts & MOTION_SPIN)
        pose.turn = Matrix::rotation(motion.spinAxis, angleAt(motion.spin, time)) * pose.turn;
    further(MOTION_SPIN, [&](const Move& m, Angle angle) { pose.turn = Matrix::rotation(m.a, angle) * pose.turn; });
    if (motion.parts & MOTION_PULSE)
        pose.scale = pose.scale * (Real(1) + motion.pulse * sine(angleAt(motion.pulsing, time)));
    further(MOTION_PULSE, [&](const Move& m, Angle angle) { pose.scale = pose.scale * (Real(1) + m.amount * sine(angle)); });
    if ((motion.parts & MOTION_KEYS) && motion.keyCount > 0) {
        const Keyed now = keyed(model.keys() + motion.firstKey, motion, time);
        pose.place = pose.place + Vector{now.value[0], now.value[1], now.value[2]};
        if (now.value[3] != Real(0))
            pose.turn = Matrix::rotation(motion.keyAxis, fromDegrees(now.value[3])) * pose.turn;
        pose.scale = pose.scale * clamp(now.value[4], SCALE_LEAST, SCALE_MOST);
    }
    if (motion.parts & MOTION_SWING) {
        const Real angle = motion.swingAngle * sine(angleAt(motion.swing, time));
        pose.turn = Matrix::rotation(motion.swingAxis, fromDegrees(angle)) * pose.turn;
    }
    further(MOTION_SWING, [&](const Move& m, Angle angle) {
        pose.turn = Matrix::rotation(m.a, fromDegrees(m.amount * sine(angle))) * pose.turn;
    });
    pose.scale = clamp(pose.scale, SCALE_LEAST, SCALE_MOST);
    return pose;
}

WarpAmounts warpAt(const Motion& motion, Time time)
{
    WarpAmounts amounts;
    for (int i = 0; i < WARP_PARTS; ++i) {
        const Swaying& part = motion.warp[i];
        const Real swung = part.swing == Real(0) ? part.amount : part.amount + part.swing * sine(angleAt(part.wave, time));
        amounts.part[i] = clamp(swung, -WARP_MOST[i], WARP_MOST[i]);
    }
    return amounts;
}

bool sameTurn(const Matrix& a, const Matrix& b)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a.m[i][j] != b.m[i][j])
                return false;
    return true;
}

Vector column(const Matrix& m, int i)
{
    return {m.m[0][i], m.m[1][i], m.m[2][i]};
}

// Places and turns the eye, after everything else has been placed.
void moveEye(Model& model)
{
    Camera& camera = model.camera;
    camera.axes = ViewAxes();
    if (camera.carrier == 0 && camera.looks == Camera::AHEAD && camera.roll == Real(0))
        return;
    const Actor* carrier = camera.carrier == 0 ? nullptr : model.itemNumbered(camera.carrier);
    Vector right = X_AXIS, up = Y_AXIS, ahead = Z_AXIS;
    if (carrier != nullptr) {
        camera.eye = carrier->pose.place;
        right = column(carrier->pose.turn, 0);
        up = column(carrier->pose.turn, 1);
        ahead = column(carrier->pose.turn, 2);
    }
    const Actor* item = camera.looks == Camera::AT_ITEM ? model.itemNumbered(camera.item) : nullptr;
    if (item != nullptr)
        camera.target = item->pose.place;
    if (camera.looks != Camera::AHEAD && !(camera.target == camera.eye))
        ahead = camera.target - camera.eye;
    camera.axes = viewAlong(ahead, up, right);
    if (camera.roll != Real(0))
        camera.axes = leaned(camera.axes, fromDegrees(camera.roll));
}

}  // namespace

Wave makeWave(Real seconds, Real phase)
{
    Wave wave;
    wave.phase = turns(phase);
    wave.period = seconds;
    const int32_t raw = rawFromReal(seconds);
    if (raw == 0)
        return wave;
    // Turns a second, rounded down, so that the period is never shorter than the one asked for.
    const uint64_t rate = divide64(0xffffffffull << 16, static_cast<uint32_t>(raw < 0 ? -raw : raw));
    wave.rate = raw < 0 ? 0 - rate : rate;
    return wave;
}

Angle fromDegrees(Real degrees)
{
    constexpr int32_t TURN = 360 << 16;
    int32_t raw = rawFromReal(degrees) % TURN;
    if (raw >= TURN / 2)
        raw -= TURN;
    if (raw < -TURN / 2)
        raw += TURN;
    return static_cast<Angle>(mulDiv(raw, 65536, 360));
}

Matrix turnFrom(const Vector& degrees)
{
    Matrix turn = Matrix::rotation(X_AXIS, fromDegrees(degrees.x));
    if (degrees.y != Real(0))
        turn = Matrix::rotation(Y_AXIS, fromDegrees(degrees.y)) * turn;
    if (degrees.z != Real(0))
        turn = Matrix::rotation(Z_AXIS, fromDegrees(degrees.z)) * turn;
    return turn;
}

Point placeAt(const Motion& motion, Time time)
{
    const Angle angle = angleAt(motion.circle, time);
    return motion.centre + motion.u * cosine(angle) + motion.v * sine(angle);
}

Pose Anim::poseOf(const Model& model, const Actor& actor, Time time)
{
    Pose pose = poseAt(model, actor.motion, time);
    const Actor* const parent = actor.motion.parent == 0 ? nullptr : model.itemNumbered(actor.motion.parent);
    if (parent != nullptr) {
        // Limited before it is turned and scaled, so that no product overflows 16.16.
        const Vector arm = toVector(clampedToSpace(pose.place));
        pose.place = parent->pose.place + parent->pose.turn * (arm * parent->pose.scale);
        // Most items have no turn of their own, which saves a matrix product.
        const bool hasTurn = !sameTurn(pose.turn, Matrix::identity());
        pose.turn = hasTurn ? parent->pose.turn * pose.turn : parent->pose.turn;
        pose.scale = clamp(pose.scale * parent->pose.scale, SCALE_LEAST, SCALE_MOST);
    }
    pose.place = clampedToSpace(pose.place);
    return pose;
}

void Anim::move(Model& model, Time time)
{
    // items() lists parents before their children, so a parent's pose is computed first.
    for (int i = 0; i < model.items(); ++i) {
        Actor& actor = model.item(i);
        const Pose pose = poseOf(model, actor, time);
        const bool turned = !sameTurn(pose.turn, actor.pose.turn);
        actor.pose = pose;
        if (actor.object == nullptr)
            continue;
        SoftObject& object = *actor.object;
        object.place(pose.place, actor.made * pose.scale);
        if ((actor.motion.parts & MOTION_WARP) != 0 || object.warped())
            object.setWarp(warpAt(actor.motion, time));
        // A ball that does not ride is turned only for its pattern or warp. Both may begin while its turn stays the same.
        if ((turned && object.turnsSeeds()) || actor.coat.pattern != PATTERN_NONE || (actor.motion.parts & MOTION_WARP) != 0)
            object.setTurn(pose.turn);
    }
    moveEye(model);
}
