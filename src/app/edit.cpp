// The editor: what is selected, and the operations that add, remove, move and change single objects. The others are in edlinks.cpp
// (links, dents, groups), edlooks.cpp (colours, light) and edmoves.cpp (motion); undo is in edundo.cpp.
#include "app/edit.h"

#include "math/text.h"

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
    motion.centre = clampedToSpace(motion.centre + (parent == nullptr ? by : Model::inverse(parent->pose, by)));
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

// Gives a value of the selected object, called `word`, the value `to`, and makes its object anew. Without the memory for that
// nothing is changed.
bool Editor::remakeWith(Real& value, Real to, Action action, Time now, const char* word)
{
    if (!begin(action, now))
        return false;
    const Real was = value;
    value = to;
    if (!model_.remake(&current())) {
        value = was;
        drop();
        say(SoftObject::resampleTrouble());
        return false;
    }
    sayReal(word, to);
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
    return remakeWith(actor.measure[which], to, action, now, measure.word);
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
    described.colour = newColour(model_.count());
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

bool Editor::strengthen(Real by, Time now)
{
    Actor& actor = current();
    const Real was = actor.strength, to = clamp(was + by, STRENGTH_LEAST, STRENGTH_MOST);
    if (to == was) {
        sayReal("the strength stays at", was);
        return false;
    }
    return remakeWith(actor.strength, to, STRENGTH, now, "strength");
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
    return remakeWith(actor.stretch.y, to, STRETCH, now, "stretch");
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
