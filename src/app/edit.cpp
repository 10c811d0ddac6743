// The operations of the editor. Before each operation the whole model is recorded; undo restores that record.
#include "app/edit.h"

#include "math/alloc.h"
#include "model/scene.h"
#include "math/text.h"
#include "surface/engine.h"

namespace {

// The colours that an object can be given; the first NEW_COLOURS are also the colours of new objects.
const Colour COLOURS[] = {{224, 80, 224}, {64, 208, 216}, {255, 136, 40}, {208, 208, 208}, {160, 224, 64},
                          {255, 64, 48},  {64, 208, 72},  {72, 112, 255}, {255, 200, 48},  {176, 112, 72},
                          {255, 144, 176}, {136, 96, 224}};
constexpr int COLOUR_COUNT = static_cast<int>(sizeof COLOURS / sizeof COLOURS[0]);
constexpr int NEW_COLOURS = 5;

// The grain of a pattern that the user gives to an object, units.
constexpr Real GRAIN(6);

// The motions that the user can give to an object.
enum Preset { STANDS, CIRCLE, PATH, SPIN, SWING, PULSE, PRESETS };
const char* const PRESET_NAMES[PRESETS] = {"stands still", "goes round", "goes to and fro", "spins", "swings", "pulses"};

// Returns the squared distance of two colours.
int distance(const Colour& a, const Colour& b)
{
    const int red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
    return red * red + green * green + blue * blue;
}

// Returns the colour of the list that differs most from `colour`.
Colour unlike(const Colour& colour)
{
    int farthest = 0;
    for (int i = 1; i < COLOUR_COUNT; ++i)
        if (distance(COLOURS[i], colour) > distance(COLOURS[farthest], colour))
            farthest = i;
    return COLOURS[farthest];
}

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

// --- Steps

void Editor::Steps::forgetOldest()
{
    free(step[0].record);
    memmove(step, step + 1, static_cast<size_t>(--count) * sizeof *step);
}

void Editor::Steps::clear()
{
    while (count > 0)
        free(step[--count].record);
}

Editor::~Editor()
{
    undo_.clear();
    redo_.clear();
}

int Editor::find(int number) const
{
    for (int i = 0; i < model_.count(); ++i)
        if (model_.actor(i).number == number)
            return i;
    return -1;
}

void Editor::say(const char* what, const char* name, const char* and_, const char* other)
{
    snprintf(message_, sizeof message_, "%s%s%s%s", what, name, and_, other);
}

void Editor::sayReal(const char* what, Real value, const char* unit)
{
    char text[24];
    formatReal(text, sizeof text, value);
    say(what, " ", text, unit);
}

// Records the model before a change, unless the change continues the last gesture. Returns false when there is no memory
// even for one record.
bool Editor::begin(Action action, Time now)
{
    const int number = current().number;
    const bool goesOn =
        action == action_ && action != OTHER && number == acted_ && now - actedAt_ < GESTURE && undo_.count > 0;
    action_ = action;
    acted_ = number;
    actedAt_ = now;
    forgetUndone();
    begun_ = !goesOn;
    if (goesOn)
        return true;
    Model::Record* record = model_.record();
    if (record == nullptr) {
        redo_.clear();
        record = model_.record();
    }
    while (record == nullptr || undo_.count == STEPS_MOST) {
        if (undo_.count == 0) {
            say("no memory left");
            return false;
        }
        undo_.forgetOldest();
        if (record == nullptr)
            record = model_.record();
    }
    undo_.step[undo_.count++] = {record, selected_, before_};
    changed_ = true;
    return true;
}

// Ends an operation that failed and changed nothing: forgets the step that begin() recorded, if it did. What was undone before can
// still be done again.
void Editor::drop()
{
    if (begun_)
        free(undo_.step[--undo_.count].record);
    changed_ = false;
    action_ = NONE;
}

// Forgets what was undone before, if the model has changed since.
void Editor::forgetUndone()
{
    if (changed_)
        redo_.clear();
    changed_ = false;
}

void Editor::select(int index)
{
    const int was = model_.actor(selected()).number, now = model_.actor(index).number;
    if (now == was)
        return;
    before_ = was;
    selected_ = now;
    action_ = NONE;
}

void Editor::selectNext()
{
    select((selected() + 1) % model_.count());
}

// Returns the group that directly carries the selected object, or null. A group is an item without an object.
Actor* Editor::group()
{
    Actor* parent = current().motion.parent == 0 ? nullptr : model_.itemNumbered(current().motion.parent);
    return parent != nullptr && parent->object == nullptr ? parent : nullptr;
}

// Returns the item that moves and turns act on: the selected object or its group.
Actor& Editor::moved()
{
    Actor* whole = whole_ ? group() : nullptr;
    return whole != nullptr ? *whole : current();
}

void Editor::setWholeGroup(bool whole)
{
    whole_ = whole;
    action_ = NONE;
    say(whole ? "moves and turns whole groups" : "moves and turns single objects");
}

bool Editor::move(const Vector& by, Time now)
{
    if (by == Vector{Real(0), Real(0), Real(0)} || !begin(MOVE, now))
        return false;
    Motion& motion = moved().motion;
    const Actor* parent = motion.parent == 0 ? nullptr : model_.itemNumbered(motion.parent);
    const Point to = motion.centre + (parent == nullptr ? by : Model::inverse(parent->pose, by));
    const Real edge(SPACE);
    motion.centre = {clamp(to.x, -edge, edge), clamp(to.y, -edge, edge), clamp(to.z, -edge, edge)};
    return true;
}

bool Editor::turn(int axis, Real degrees, Time now)
{
    if (!begin(TURN, now))
        return false;
    Motion& motion = moved().motion;
    Real& part = axis == 0 ? motion.turn.x : axis == 1 ? motion.turn.y : motion.turn.z;
    part += degrees;
    if (part > Real(180))
        part -= Real(360);
    if (part <= Real(-180))
        part += Real(360);
    motion.parts |= MOTION_TURN;
    char x[24], y[24], z[24];
    formatReal(x, sizeof x, motion.turn.x);
    formatReal(y, sizeof y, motion.turn.y);
    formatReal(z, sizeof z, motion.turn.z);
    snprintf(message_, sizeof message_, "%s: turn %s %s %s", moved().name, x, y, z);
    return true;
}

bool Editor::changeMeasure(int which, Real by, Action action, Time now)
{
    Actor& actor = current();
    if (actor.kind == nullptr || which >= actor.kind->measures) {
        say(actor.name, " has only a size");
        return false;
    }
    const Measure& measure = actor.kind->measure[which];
    const Real was = actor.measure[which];
    const Real to = clamp(was + by, measure.least, measure.most);
    if (to == was) {
        say("no further");
        return false;
    }
    actor.measure[which] = to;
    const char* expects = Model::expects(actor);
    actor.measure[which] = was;
    if (expects != nullptr) {
        say("expected ", expects);
        return false;
    }
    if (!begin(action, now))
        return false;
    actor.measure[which] = to;
    if (!model_.remake(&actor)) {
        actor.measure[which] = was;
        drop();
        say(SoftObject::resampleTrouble());
        return false;
    }
    sayReal(measure.word, to);
    return true;
}

bool Editor::size(Real by, Time now)
{
    return changeMeasure(0, by, SIZE, now);
}

bool Editor::measure(Real by, Time now)
{
    const Kind* kind = current().kind;
    return changeMeasure(kind == nullptr || kind->measures == 1 ? 1 : kind->measures - 1, by, MEASURE, now);
}

bool Editor::add(const char* word)
{
    const Actor& there = current();
    Actor described;
    described.kind = kindNamed(word);
    for (int i = 0; i < described.kind->measures; ++i)
        described.measure[i] = described.kind->measure[i].usual;
    described.colour = COLOURS[model_.count() % NEW_COLOURS];
    described.motion.centre = there.pose.place;
    int n = model_.count();
    do
        snprintf(described.name, sizeof described.name, "%s%d", word, ++n);
    while (model_.itemNamed(described.name) != nullptr);
    if (model_.count() == Model::OBJECTS_MOST) {
        say("128 objects are the most");
        return false;
    }
    if (!begin(OTHER, 0))
        return false;
    const int with = there.number;
    Actor* made = model_.addItem(described);
    if (made == nullptr) {
        drop();
        say("no memory for another object");
        return false;
    }
    model_.link(model_.itemNumbered(with)->object, made->object, Real(1));
    before_ = with;
    selected_ = made->number;
    say("added ", made->name);
    return true;
}

bool Editor::remove()
{
    if (model_.count() == 1) {
        say("the last object stays");
        return false;
    }
    if (!begin(OTHER, 0))
        return false;
    const int index = selected();
    Actor& gone = model_.actor(index);
    say("deleted ", gone.name);
    model_.remove(&gone);
    selected_ = model_.actor(index % model_.count()).number;
    before_ = 0;
    return true;
}

bool Editor::pairOf(SoftObject** a, SoftObject** b)
{
    const int other = before();
    if (other < 0) {
        say("select two, one after the other");
        return false;
    }
    *a = current().object;
    *b = model_.actor(other).object;
    return true;
}

bool Editor::link()
{
    SoftObject *a, *b;
    if (!pairOf(&a, &b))
        return false;
    const char *name = current().name, *other = model_.actor(before()).name;
    Real weight;
    if (Model::linked(a, b, &weight)) {
        say(name, " blends with ", other, " already");
        return false;
    }
    if (!begin(OTHER, 0))
        return false;
    if (!model_.link(a, b, Real(1))) {
        drop();
        say("no memory for a link");
        return false;
    }
    say(name, " blends with ", other);
    return true;
}

bool Editor::unlink()
{
    SoftObject *a, *b;
    if (!pairOf(&a, &b))
        return false;
    const char *name = current().name, *other = model_.actor(before()).name;
    Real weight;
    if (!Model::linked(a, b, &weight)) {
        say(name, " does not blend with ", other);
        return false;
    }
    if (!begin(OTHER, 0))
        return false;
    model_.unlink(a, b);
    say(name, " parted from ", other);
    return true;
}

bool Editor::weigh(Real by, Time now)
{
    SoftObject *a, *b;
    if (!pairOf(&a, &b))
        return false;
    const char *name = current().name, *other = model_.actor(before()).name;
    Real weight;
    const bool dents = !Model::linked(a, b, &weight) && Model::dented(b, a, &weight);
    if (!dents && !Model::linked(a, b, &weight)) {
        say(name, " does not blend with ", other);
        return false;
    }
    const Real to = clamp(weight + by, Real(0), WEIGHT_MOST);
    if (to == weight) {
        sayReal("the weight stays at", weight);
        return false;
    }
    if (!begin(WEIGHT, now))
        return false;
    // This cannot fail: the link or dent exists already, so that nothing is allocated.
    if (dents)
        model_.dent(b, a, to);
    else
        model_.link(a, b, to);
    char text[24];
    formatReal(text, sizeof text, to);
    snprintf(message_, sizeof message_, "%s and %s: weight %s", name, other, text);
    return true;
}

bool Editor::dent()
{
    SoftObject *a, *b;
    if (!pairOf(&a, &b))
        return false;
    const char *name = current().name, *other = model_.actor(before()).name;
    Real weight;
    if (!begin(OTHER, 0))
        return false;
    if (Model::dented(b, a, &weight)) {
        model_.undent(b, a);
        say(name, " digs no more into ", other);
        return true;
    }
    if (!model_.dent(b, a, Real(1))) {
        drop();
        say("no memory for a dent");
        return false;
    }
    model_.unlink(a, b);
    say(name, " digs into ", other);
    return true;
}

bool Editor::strengthen(Real by, Time now)
{
    Actor& actor = current();
    const Real was = actor.strength, to = clamp(was + by, STRENGTH_LEAST, STRENGTH_MOST);
    if (to == was) {
        sayReal("the strength stays at", was);
        return false;
    }
    if (!begin(STRENGTH, now))
        return false;
    actor.strength = to;
    if (!model_.remake(&actor)) {
        actor.strength = was;
        drop();
        say(SoftObject::resampleTrouble());
        return false;
    }
    sayReal("strength", to);
    return true;
}

bool Editor::colour(int step, Time now)
{
    Actor& actor = current();
    int nearest = 0;
    for (int i = 1; i < COLOUR_COUNT; ++i)
        if (distance(COLOURS[i], actor.colour) < distance(COLOURS[nearest], actor.colour))
            nearest = i;
    if (!begin(COLOUR, now))
        return false;
    actor.colour = COLOURS[(nearest + step + COLOUR_COUNT) % COLOUR_COUNT];
    snprintf(message_, sizeof message_, "colour %d %d %d", actor.colour.red, actor.colour.green, actor.colour.blue);
    return true;
}

bool Editor::finish()
{
    if (!begin(OTHER, 0))
        return false;
    Coat& coat = current().coat;
    coat.finish = static_cast<Finish>((coat.finish + 1) % FINISHES);
    say("finish ", FINISH_WORDS[coat.finish]);
    return true;
}

bool Editor::pattern()
{
    if (!begin(OTHER, 0))
        return false;
    Coat& coat = current().coat;
    if (coat.grain == Real(0)) {
        coat.grain = GRAIN;
        coat.colour = unlike(current().colour);
    }
    coat.pattern = static_cast<Pattern>((coat.pattern + 1) % PATTERNS);
    say("pattern ", PATTERN_WORDS[coat.pattern]);
    return true;
}

bool Editor::stretch(Real by, Time now)
{
    Actor& actor = current();
    const Real was = actor.stretch.y, to = clamp(was + by, STRETCH_LEAST, STRETCH_MOST);
    actor.stretch.y = to;
    const char* const expects = Model::expects(actor);
    actor.stretch.y = was;
    if (to == was || expects != nullptr) {
        sayReal("the stretch stays at", was);
        return false;
    }
    if (!begin(STRETCH, now))
        return false;
    actor.stretch.y = to;
    if (!model_.remake(&actor)) {
        actor.stretch.y = was;
        say(SoftObject::resampleTrouble());
        return false;
    }
    sayReal("stretch", to);
    return true;
}

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
    still.parts = actor.motion.parts & MOTION_TURN;
    model_.removeKeys(&actor);
    actor.motion = still;
    giveMotion(actor.motion, next);
    say(actor.name, " ", PRESET_NAMES[next]);
    return true;
}

bool Editor::pace(Real factor, Time now)
{
    Motion& motion = current().motion;
    constexpr int OWN = 7;
    Wave* waves[OWN + Motion::MORE_MOST] = {&motion.circle, &motion.along[0], &motion.along[1], &motion.along[2],
                                            &motion.spin,   &motion.swing,    &motion.pulsing};
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

bool Editor::light(int axis, Real degrees, Time now)
{
    if (!begin(LIGHT, now))
        return false;
    const Real none(0), one(1);
    const Vector about{axis == 0 ? one : none, axis == 1 ? one : none, none};
    model_.setLight(Matrix::rotation(about, fromDegrees(degrees)) * unit(model_.light));
    char x[24], y[24], z[24];
    const auto text = [](char* to, Real value) {
        const int32_t raw = rawFromReal(value);
        to[0] = '-';
        formatQuotient(raw < 0 ? to + 1 : to, 20, static_cast<uint32_t>(raw < 0 ? -raw : raw), 65536, 2);
    };
    text(x, model_.light.x);
    text(y, model_.light.y);
    text(z, model_.light.z);
    snprintf(message_, sizeof message_, "light %s %s %s", x, y, z);
    return true;
}

bool Editor::join()
{
    SoftObject *a, *b;
    if (!pairOf(&a, &b))
        return false;
    Actor &actor = current(), &other = model_.actor(before());
    Actor* with = other.motion.parent == 0 ? nullptr : model_.itemNumbered(other.motion.parent);
    if (with != nullptr && with->object != nullptr) {
        say(other.name, " is carried by ", with->name);
        return false;
    }
    if (with != nullptr && actor.motion.parent == with->number) {
        say(actor.name, " is in ", with->name, " already");
        return false;
    }
    if (!begin(OTHER, 0))
        return false;
    if (with == nullptr) {
        Actor described;
        int n = 0;
        do
            snprintf(described.name, sizeof described.name, "group%d", ++n);
        while (model_.itemNamed(described.name) != nullptr);
        with = model_.addItem(described);
        if (with == nullptr) {
            drop();
            say("no room for another group");
            return false;
        }
        model_.setParent(&other, with->number);
    }
    if (!model_.setParent(&actor, with->number)) {
        drop();
        say(with->name, " is carried by ", actor.name);
        return false;
    }
    say(actor.name, " is in ", with->name);
    return true;
}

bool Editor::leave()
{
    Actor* from = group();
    if (from == nullptr) {
        say(current().name, " is in no group");
        return false;
    }
    if (!begin(OTHER, 0))
        return false;
    say(current().name, " has left ", from->name);
    model_.setParent(&current(), from->motion.parent);
    // An empty group is removed, unless it carries the eye.
    if (from->number == model_.camera.carrier)
        return true;
    for (int i = 0; i < model_.items(); ++i)
        if (model_.item(i).motion.parent == from->number)
            return true;
    model_.remove(from);
    return true;
}

// Restores the newest step of the list `from` and stores the present state in the list `to`, so that it can be restored.
bool Editor::goBack(Steps& from, Steps& to)
{
    // Without memory for the present state the step is still made, but it cannot be reverted.
    Model::Record* now = model_.record();
    const Step& step = from.step[from.count - 1];
    if (!model_.restore(step.record)) {
        free(now);
        say("no memory left");
        return false;
    }
    if (now != nullptr) {
        if (to.count == STEPS_MOST)
            to.forgetOldest();
        to.step[to.count++] = {now, selected_, before_};
    } else {
        to.clear();
    }
    selected_ = step.selected;
    before_ = step.before;
    free(step.record);
    --from.count;
    action_ = NONE;
    return true;
}

bool Editor::undo()
{
    forgetUndone();
    if (undo_.count == 0) {
        say("nothing to undo");
        return false;
    }
    if (!goBack(undo_, redo_))
        return false;
    snprintf(message_, sizeof message_, "undone, %d more", undo_.count);
    return true;
}

bool Editor::redo()
{
    forgetUndone();
    if (redo_.count == 0) {
        say("nothing to do again");
        return false;
    }
    if (!goBack(redo_, undo_))
        return false;
    snprintf(message_, sizeof message_, "done again, %d more", redo_.count);
    return true;
}

bool Editor::save(const char* name)
{
    const char* problem = writeScene(name, model_);
    if (problem != nullptr)
        say(problem);
    else
        say("saved as ", name);
    return problem == nullptr;
}

bool Editor::load(const char* name, Real spacing, bool undoable)
{
    Model* fresh = make<Model>();
    if (fresh == nullptr) {
        say("no memory for another scene");
        return false;
    }
    SceneEnd end;
    const char* problem = readScene(name, *fresh, &end);
    if (problem == nullptr) {
        if (model_.surfaceMaker() != makeReport98)
            Anim::chooseRiders(*fresh);
        Anim::move(*fresh, 0);
    }
    if (problem == nullptr && !fresh->resample(spacing, model_.surfaceMaker()))
        problem = SoftObject::resampleTrouble();
    const bool good = problem == nullptr && (!undoable || begin(OTHER, 0));
    if (good) {
        if (!undoable) {
            undo_.clear();
            redo_.clear();
        }
        model_.swap(*fresh);
        selected_ = model_.actor(0).number;
        before_ = 0;
        say("loaded ", name);
    } else if (problem != nullptr) {
        say(problem);
    }
    destroy(fresh);
    return good;
}

void Editor::describe(char* to, int size) const
{
    int length = 0;
    const auto add = [&](const char* format, auto... words) {
        if (length < size)
            length += snprintf(to + length, static_cast<size_t>(size - length), format, words...);
    };
    const auto addNumber = [&](const char* before, const char* word, Real number) {
        char text[24];
        formatReal(text, sizeof text, number);
        add("%s%s %s", before, word, text);
    };
    const Actor& actor = model_.actor(selected());
    add("%s:", actor.name);
    if (actor.kind == nullptr)
        addNumber(" ", "size", actor.measure[0]);
    for (int i = 0; actor.kind != nullptr && i < actor.kind->measures; ++i)
        addNumber(" ", actor.kind->measure[i].word, actor.measure[i]);
    if (actor.strength != Real(1))
        addNumber(", ", "strength", actor.strength);
    int links = 0;
    for (const List<Link>::Node* node = actor.object->skel().first(); node != nullptr; node = node->next)
        ++links;
    add(", blends with %d", links);
    const Actor* carrier = actor.motion.parent == 0 ? nullptr : model_.itemNumbered(actor.motion.parent);
    if (carrier != nullptr)
        add(", in %s", carrier->name);
    if (before() < 0)
        return;
    const Actor& other = model_.actor(before());
    add("; before it %s", other.name);
    Real weight;
    if (Model::linked(actor.object, other.object, &weight))
        addNumber(", ", "weight", weight);
    if (Model::dented(other.object, actor.object, &weight))
        addNumber(", ", "dents it by", weight);
}
