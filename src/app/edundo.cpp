// Undo: before each operation of the editor the whole model is recorded, and undo restores that record. Scenes are saved and
// loaded here as well, because a scene that is loaded takes the place of the model.
#include "app/edit.h"

#include "math/alloc.h"
#include "model/scene.h"
#include "surface/engine.h"

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
