// Editor: what a user may do to the model by hand, each with one call, and each undone with another. It knows nothing of
// keys, mice and screens: src/app/keys.cpp maps those to these calls.
#ifndef FB_EDIT_H
#define FB_EDIT_H

#include "model/model.h"

class Editor {
public:
    // Steps that can be undone. Where memory does not hold so many, the oldest are forgotten.
    static constexpr int STEPS_MOST = 64;

    // Changes of one kind to one object are one step as long as they follow each other within this time.
    static constexpr Time GESTURE = 65536;

    explicit Editor(Model& model) : model_(model) {}
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    // The selected object, an index for Model::actor(); and the one that was selected before it (-1: none).
    int selected() const { return find(selected_) < 0 ? 0 : find(selected_); }
    int before() const { return find(before_) == selected() ? -1 : find(before_); }
    void selectNext();
    // Selects an object by its index; the one selected so far is then the one before.
    void select(int index);

    // Every operation below returns true when it changed the model: it must then be moved (Anim::move), and its ramps
    // made anew. message() then says in a few words what was done, or why nothing was. `now` only tells gestures apart.

    // Moves the selected object by a vector of the world; with it goes all that it carries. Moves and turns act on its
    // group instead while wholeGroup() is set.
    bool move(const Vector& by, Time now);
    // Turns it about axis 0, 1 or 2 (x, y, z) by so many degrees.
    bool turn(int axis, Real degrees, Time now);
    // Changes its size; and its last measure but the size (length, ring, disc), by so many units.
    bool size(Real by, Time now);
    bool measure(Real by, Time now);
    // A new object of a kind where the selected one is, blending with it; it is then the selected one.
    bool add(const char* kind);
    // Takes the selected object out. The last object stays.
    bool remove();
    // Links the selected object with the one selected before, or parts them.
    bool link();
    bool unlink();
    // Changes the weight of that link, or of the dent where there is no link.
    bool weigh(Real by, Time now);
    // Lets the selected object dig into the one selected before, and parts them; or fills the hollow.
    bool dent();
    // Changes what its field is multiplied by.
    bool strengthen(Real by, Time now);
    // The next colour of a list for the selected object, or the one before (`step` 1 or -1).
    bool colour(int step, Time now);
    // Another finish for it in place of its own: matt, shiny, mirror, and round again; and another pattern: none, checks, stripes,
    // marble.
    bool finish();
    bool pattern();
    // Stretches it along its own y axis, by so much more of its length.
    bool stretch(Real by, Time now);
    // Another motion in place of the one it has: none, circle, path, spin, swing, pulse, and round again. And the periods
    // of what moves it, times a factor.
    bool motion();
    bool pace(Real factor, Time now);
    // Turns the light about axis 0 or 1 (x, y) of the world.
    bool light(int axis, Real degrees, Time now);
    // Puts the selected object into the group of the one before, or both into a new one; takes it out of its group.
    bool join();
    bool leave();
    bool wholeGroup() const { return whole_; }
    void setWholeGroup(bool whole);

    // Back to before the last step, and forward again as long as nothing else was done. What was selected then is
    // selected again.
    bool undo();
    bool redo();
    int steps() const { return undo_.count; }

    // Writes the scene; false when that failed. Reads one, which takes the place of the model with seeds `spacing` apart;
    // where `undoable` is false there is no way back, and what could be undone is forgotten.
    bool save(const char* name);
    bool load(const char* name, Real spacing, bool undoable = true);

    // Words for the screen, capital letters; never null.
    const char* message() const { return message_; }
    // The selected object in words: its name, measures, how many it blends with, its group; and which is the one before.
    void describe(char* to, int size) const;

private:
    enum Action { NONE, MOVE, TURN, SIZE, MEASURE, WEIGHT, STRENGTH, COLOUR, STRETCH, PACE, LIGHT, OTHER };

    // A model as it was, and what was selected in it.
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
    bool goBack(Steps& from, Steps& to);
    bool changeMeasure(int which, Real by, Action action, Time now);
    bool pairOf(SoftObject** a, SoftObject** b);
    void say(const char* what, const char* name = "", const char* and_ = "", const char* other = "");
    void sayReal(const char* what, Real value, const char* unit = "");

    Model& model_;
    int selected_ = 1;  // numbers: they stay what they are when other objects come and go
    int before_ = 0;
    Steps undo_, redo_;
    bool whole_ = false;
    Action action_ = NONE;
    int acted_ = 0;
    Time actedAt_ = 0;
    char message_[320] = "";
};

#endif
