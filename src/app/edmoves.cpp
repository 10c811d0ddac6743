// The motions that the user can give to objects, and their pace.
#include "app/edit.h"

#include "math/text.h"
#include "model/scene.h"

namespace {

// The motions that the user can give to an object.
enum Preset { STANDS, CIRCLE, PATH, SPIN, SWING, PULSE, PRESETS };
const char* const PRESET_NAMES[PRESETS] = {"stands still", "goes round", "goes to and fro", "spins", "swings", "pulses"};

// Returns the preset that a motion resembles. A motion of several parts counts as the part that comes last in Preset.
Preset presetOf(const Motion& motion)
{
    if (motion.parts & (MOTION_KEYS | MOTION_PULSE))
        return PULSE;
    if (motion.parts & MOTION_SWING)
        return SWING;
    if (motion.parts & MOTION_SPIN)
        return SPIN;
    if (motion.parts & MOTION_PATH)
        return PATH;
    return motion.circle.period != Real(0) ? CIRCLE : STANDS;
}

// Adds the parts of a preset to a motion that stands still.
void giveMotion(Motion& motion, Preset preset)
{
    const Real none(0);
    switch (preset) {
    case CIRCLE:
        motion.u = {Real(15), none, none};
        motion.v = {none, none, Real(15)};
        motion.circle = makeWave(Real(6), none);
        break;
    case PATH:
        motion.path = {Real(20), Real(8), none};
        motion.along[0] = makeWave(Real(6), none);
        motion.along[1] = makeWave(Real(4), none);
        motion.parts |= MOTION_PATH;
        break;
    case SPIN:
        motion.spinAxis = {none, Real(1), none};
        motion.spin = makeWave(Real(6), none);
        motion.parts |= MOTION_SPIN;
        break;
    case SWING:
        motion.swingAxis = {none, none, Real(1)};
        motion.swingAngle = Real(40);
        motion.swing = makeWave(Real(4), none);
        motion.parts |= MOTION_SWING;
        break;
    case PULSE:
        motion.pulse = Real(0.25);
        motion.pulsing = makeWave(Real(3), none);
        motion.parts |= MOTION_PULSE;
        break;
    default: break;
    }
}

}  // namespace

bool Editor::motion()
{
    if (!begin(OTHER, 0))
        return false;
    Actor& actor = current();
    const Preset next = static_cast<Preset>((presetOf(actor.motion) + 1) % PRESETS);
    Motion still;
    still.centre = actor.motion.centre;
    still.turn = actor.motion.turn;
    still.scale = actor.motion.scale;
    still.parent = actor.motion.parent;
    // Taper, twist and bend belong to the shape, even where they swing.
    still.parts = actor.motion.parts & (MOTION_TURN | MOTION_WARP);
    memcpy(still.warp, actor.motion.warp, sizeof still.warp);
    model_.removeKeys(&actor);
    actor.motion = still;
    giveMotion(actor.motion, next);
    say(actor.name, " ", PRESET_NAMES[next]);
    return true;
}

bool Editor::pace(Real factor, Time now)
{
    Motion& motion = current().motion;
    constexpr int OWN = 7 + WARP_PARTS;
    Wave* waves[OWN + Motion::MORE_MOST] = {&motion.circle,       &motion.along[0],     &motion.along[1], &motion.along[2],
                                            &motion.spin,         &motion.swing,        &motion.pulsing,  &motion.warp[0].wave,
                                            &motion.warp[1].wave, &motion.warp[2].wave};
    const int count = OWN + motion.moreCount;
    for (int i = OWN; i < count; ++i)
        waves[i] = &motion.more[i - OWN].wave;
    const Wave* slowest = nullptr;
    bool fits = true;
    for (int i = 0; i < count; ++i) {
        const Wave* wave = waves[i];
        if (wave->period == Real(0))
            continue;
        const Real to = absolute(wave->period) * factor;
        fits = fits && to >= PERIOD_LEAST && to <= PERIOD_MOST;
        if (slowest == nullptr || absolute(wave->period) > absolute(slowest->period))
            slowest = wave;
    }
    if (slowest == nullptr) {
        say(current().name, " stands still: o gives it a motion");
        return false;
    }
    if (!fits) {
        say("no further");
        return false;
    }
    if (!begin(PACE, now))
        return false;
    for (int i = 0; i < count; ++i) {
        Wave* wave = waves[i];
        if (wave->period == Real(0))
            continue;
        const Angle phase = wave->phase;
        *wave = makeWave(wave->period * factor, Real(0));
        wave->phase = phase;
    }
    char text[24];
    formatQuotient(text, sizeof text, static_cast<uint32_t>(rawFromReal(absolute(slowest->period))), 65536, 2);
    say("period ", text, " seconds");
    return true;
}
