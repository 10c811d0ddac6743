// Editor: the operations by which a user edits the model, one function each, and undo. The editor knows nothing of keys,
// mouse and screen: src/app/keys.cpp maps keys and mouse to these functions.
#ifndef FB_EDIT_H
#define FB_EDIT_H

#include "model/model.h"

class Editor {
public:
    // The most steps that can be undone. When memory is too small for so many, the oldest steps are forgotten.
    static constexpr int STEPS_MOST = 64;

    // Changes of one kind to one object that follow each other within this time (1.0 s = 65536) are a single step of undo.
    static constexpr Time GESTURE = 65536;

    explicit Editor(Model& model) : model_(model) {}
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    // The index, for Model::actor(), of the selected object, and of the object selected before it (-1: none).
    int selected() const { return find(selected_) < 0 ? 0 : find(selected_); }
    int before() const { return find(before_) == selected() ? -1 : find(before_); }
    void selectNext();
    // Selects the object with this index; the object selected until now becomes before().
    void select(int index);

    // Every operation below returns true when it changed the model; the caller must then move the model (Anim::move) and
    // compute its colour ramps anew. message() tells in a few words what was done, or why nothing was done. `now` only
    // serves to tell gestures apart.

    // Moves the selected object, with all that it carries, by a vector in world coordinates. While wholeGroup() is set,
    // moves and turns act on the group of the object instead.
    bool move(const Vector& by, Time now);
    // Turns the selected object about axis 0, 1 or 2 (x, y, z).
    bool turn(int axis, Real degrees, Time now);
    // Change the size of the selected object, or its last other measure (length, ring, disc), by `by` units.
    bool size(Real by, Time now);
    bool measure(Real by, Time now);
    // Adds an object of a kind at the place of the selected object, links the two, and selects the new one.
    bool add(const char* kind);
    // Removes the selected object. The last object of a model cannot be removed.
    bool remove();
    // Link the selected object with the object selected before, or remove that link.
    bool link();
    bool unlink();
    // Changes the weight of that link; without a link, the weight of the dent.
    bool weigh(Real by, Time now);
    // Makes the selected object dent the object selected before, and removes their link. If it dents already: ends the dent.
    bool dent();
    // Changes the factor by which the field of the selected object is multiplied.
    bool strengthen(Real by, Time now);
    // Gives the selected object the next colour of a list (`step` 1) or the previous one (`step` -1).
    bool colour(int step, Time now);
    // Give the selected object the next finish (matt, shiny, mirror, and matt again), or the next pattern (none, checks,
    // stripes, marble, and none again).
    bool finish();
    bool pattern();
    // Adds `by` to the factor by which the selected object is stretched along its own y axis.
    bool stretch(Real by, Time now);
    // Gives the selected object the next motion: none, circle, path, spin, swing, pulse, and none again. pace() multiplies
    // the periods of all its motions by a factor.
    bool motion();
    bool pace(Real factor, Time now);
    // Turns the light about axis 0 or 1 (x, y) of the world.
    bool light(int axis, Real degrees, Time now);
    // join() puts the selected object into the group of the object selected before, or both into a new group; leave() takes
    // it out of its group.
    bool join();
    bool leave();
    bool wholeGroup() const { return whole_; }
    void setWholeGroup(bool whole);

    // Return to the model before the last step, and go forward again as long as no other change was made. The selection is
    // restored, too.
    bool undo();
    bool redo();
    int steps() const { return undo_.count; }

    // save() writes the scene and returns false on failure. load() replaces the model by a scene, with seeds `spacing`
    // apart. When `undoable` is false, loading cannot be undone, and all earlier steps are forgotten.
    bool save(const char* name);
    bool load(const char* name, Real spacing, bool undoable = true);

    // The message for the screen; never null.
    const char* message() const { return message_; }
    // Describes the selected object in words: its name, its measures, the number of its links, its group, and the name of
    // the object selected before.
    void describe(char* to, int size) const;

private:
    enum Action { NONE, MOVE, TURN, SIZE, MEASURE, WEIGHT, STRENGTH, COLOUR, STRETCH, PACE, LIGHT, OTHER };

    // An earlier state of the model, and the selection at that time.
    struct Step {
        Model::Record* record;
        int selected, before;
    };
    struct Steps {
        Step step[STEPS_MOST];
        int count = 0;

        void forgetOldest();
        void clear();
    };

    int find(int number) const;
    Actor& current() { return model_.actor(selected()); }
    Actor* group();
    Actor& moved();
    bool begin(Action action, Time now);
    void drop();
    void forgetUndone();
    bool goBack(Steps& from, Steps& to);
    bool remakeWith(Real& value, Real to, Action action, Time now, const char* word);
    bool changeMeasure(int which, Real by, Action action, Time now);
    bool pairOf(SoftObject** a, SoftObject** b);
    static Colour newColour(int objects);
    void say(const char* what, const char* name = "", const char* and_ = "", const char* other = "");
    void sayReal(const char* what, Real value, const char* unit = "");

    Model& model_;
    int selected_ = 1;  // numbers of objects, not indices: they do not change when other objects are added or removed
    int before_ = 0;
    Steps undo_, redo_;
    bool begun_ = false;    // the last begin() recorded a step; otherwise its change went on with a gesture
    bool changed_ = false;  // the model has changed since redo_ was filled, which is then to be forgotten
    bool whole_ = false;
    Action action_ = NONE;  // the last change, the number of its object, and its time: they tell whether a gesture goes on
    int acted_ = 0;
    Time actedAt_ = 0;
    char message_[320] = "";
};

#endif
