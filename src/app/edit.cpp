// Operations by hand. Before each the model is recorded; undoing goes back to the record.
#include "app/edit.h"

#include "math/alloc.h"
#include "model/scene.h"
#include "math/text.h"

namespace {

const Colour NEW_COLOURS[] = {{224, 80, 224}, {64, 208, 216}, {255, 136, 40}, {208, 208, 208}, {160, 224, 64}};

}  // namespace

Editor::~Editor()
{
    for (int i = 0; i < stepCount_; ++i)
        free(step_[i]);
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

// Records the model, unless this goes on with the gesture that began last. False: no memory even for one record.
bool Editor::begin(Action action, Time now)
{
    const int number = current().number;
    const bool on = action == action_ && action != OTHER && number == acted_ && now - actedAt_ < GESTURE && stepCount_ > 0;
    action_ = action;
    acted_ = number;
    actedAt_ = now;
    if (on)
        return true;
    Model::Record* record = model_.record();
    while (record == nullptr || stepCount_ == STEPS_MOST) {
        if (stepCount_ == 0) {
            say("no memory left");
            return false;
        }
        free(step_[0]);
        memmove(step_, step_ + 1, static_cast<size_t>(--stepCount_) * sizeof *step_);
        if (record == nullptr)
            record = model_.record();
    }
    step_[stepCount_++] = record;
    return true;
}

// Forgets the step that begin() recorded: nothing came of it.
void Editor::drop()
{
    free(step_[--stepCount_]);
    action_ = NONE;
}

void Editor::selectNext()
{
    const int was = selected();
    before_ = model_.actor(was).number;
    selected_ = model_.actor((was + 1) % model_.count()).number;
    action_ = NONE;
}

bool Editor::move(const Vector& by, Time now)
{
    if (by == Vector{Real(0), Real(0), Real(0)} || !begin(MOVE, now))
        return false;
    Motion& motion = current().motion;
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
    Motion& motion = current().motion;
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
    snprintf(message_, sizeof message_, "turn %s %s %s", x, y, z);
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
    const char* expects = actor.kind->expects == nullptr ? nullptr : actor.kind->expects(actor.measure);
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
        say("no memory for so many seeds");
        return false;
    }
    char text[24];
    formatReal(text, sizeof text, to);
    say(measure.word, " ", text);
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
    described.colour = NEW_COLOURS[model_.count() % static_cast<int>(sizeof NEW_COLOURS / sizeof NEW_COLOURS[0])];
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
    const int at = selected();
    Actor& gone = model_.actor(at);
    say("deleted ", gone.name);
    model_.remove(&gone);
    selected_ = model_.actor(at % model_.count()).number;
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

bool Editor::undo()
{
    if (stepCount_ == 0) {
        say("nothing to undo");
        return false;
    }
    if (!model_.restore(step_[stepCount_ - 1])) {
        say("no memory to undo");
        return false;
    }
    drop();
    snprintf(message_, sizeof message_, "undone, %d more", stepCount_);
    return true;
}

void Editor::save(const char* name)
{
    const char* problem = writeScene(name, model_);
    if (problem != nullptr)
        say(problem);
    else
        say("saved as ", name);
}

bool Editor::load(const char* name, Real spacing)
{
    Model* fresh = make<Model>();
    if (fresh == nullptr) {
        say("no memory for another scene");
        return false;
    }
    SceneEnd end;
    const char* problem = readScene(name, *fresh, &end);
    if (problem == nullptr)
        Anim::move(*fresh, 0);
    if (problem == nullptr && !fresh->resample(spacing, model_.surfaceMaker()))
        problem = "no memory for so many seeds";
    const bool good = problem == nullptr && begin(OTHER, 0);
    if (good) {
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
    const Actor& actor = model_.actor(selected());
    int links = 0;
    for (const List<Link>::Node* node = actor.object->skel().first(); node != nullptr; node = node->next)
        ++links;
    int length = snprintf(to, static_cast<size_t>(size), "%s:", actor.name);
    const int measures = actor.kind == nullptr ? 1 : actor.kind->measures;
    for (int i = 0; i < measures && length < size; ++i) {
        char text[24];
        formatReal(text, sizeof text, actor.measure[i]);
        length += snprintf(to + length, static_cast<size_t>(size - length), " %s %s",
                           actor.kind == nullptr ? "size" : actor.kind->measure[i].word, text);
    }
    if (length < size)
        snprintf(to + length, static_cast<size_t>(size - length), ", blends with %d", links);
}
