// What joins objects: links and their weights, dents, groups.
#include "app/edit.h"

#include "math/text.h"
#include "model/scene.h"

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
