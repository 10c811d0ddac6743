// Model: the objects, what they blend with, how they are lit, seen, coloured and moved, and the groups, which move, turn and
// scale several objects as one.
#ifndef FB_MODEL_H
#define FB_MODEL_H

#include "model/anim.h"
#include "model/body.h"
#include "model/kind.h"
#include "model/paint.h"
#include "model/softobj.h"
#include "model/camera.h"

// Room for a name: up to 15 characters and the final 0.
constexpr int NAME_ROOM = 16;

// The name of the group that the eye moves with.
extern const char EYE_NAME[];

// Room for the title of a scene: up to 47 characters and the final 0.
constexpr int TITLE_ROOM = 48;

// An item of the model: an object with its colour and motion, or a group (which has no object).
struct Actor {
    SoftObject* object = nullptr;
    Colour colour{255, 255, 255};
    Coat coat;
    Motion motion;
    int number = 0;                // objects have numbers from 1 upwards, groups from -1 downwards
    char name[NAME_ROOM] = "";
    const Kind* kind = nullptr;    // null: a group, or an object that was not made from words
    Real measure[MEASURES_MOST] = {Real(0), Real(0), Real(0), Real(0)};  // in the order of Kind::measure, before any scaling
    Vector stretch{Real(1), Real(1), Real(1)};  // factors along its own axes; objects only
    Pose pose;                     // the pose set by the latest Anim::move()
    Real made{0};                  // the object's size() before any scaling
    Real strength{1};              // of the object
};

class Model {
public:
    static constexpr int OBJECTS_MOST = 128;
    static constexpr int GROUPS_MOST = 64;
    static constexpr int KEYS_MOST = 1024;

    Model() = default;
    ~Model() { clear(); }
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    // Makes the report's predefined model: four spheres of sizes 20, 25, 30 and 35, each blending with the other three, on
    // circular paths round the origin. Returns false when there is no memory.
    bool makeFourSpheres();

    // Takes over an object made with make<>(), for models built in code; the program itself uses addItem(). Returns false when
    // there is no room, and destroys the object.
    bool add(SoftObject* object, const Colour& colour, const Motion& motion);

    // Adds the described item and makes its object from kind, measures, strength and stretch. The item gets a new number and no
    // keys. Its parent must be in the model already. Returns null when there is no room or no memory.
    Actor* addItem(const Actor& described);

    // Removes an item and its keys from the model. The item's parent carries the item's children from then on: their centres
    // stay where they are now, but the removed item's motion and turn no longer act on them.
    void remove(Actor* item);

    // Returns null if the measures and the stretch of an item fit each other, else the words for what is expected.
    static const char* expects(const Actor& item);

    // Makes the object of an item anew, after its measures or its strength were changed. Returns false when there is no memory;
    // the old object stays then.
    bool remake(Actor* item);

    // Removes an item's keys.
    void removeKeys(Actor* item);

    // Gives an item another parent, by number (0: no parent). The item stays where it is now, and turns and grows with the new
    // parent from then on. Returns false if the item itself carries that parent, directly or through others.
    bool setParent(Actor* item, int parent);

    // Adds a key to an item; each key must be later than the item's other keys. Returns false when there is no room or no
    // memory.
    bool addKey(Actor* item, const Key& key);

    // Links two objects in both directions with one weight. Returns false when there is no memory; they are not linked then.
    bool link(SoftObject* a, SoftObject* b, Real weight);
    void unlink(SoftObject* a, SoftObject* b);
    // Links every object with every other. Returns false when there is no memory.
    bool linkAll(Real weight);
    // Returns whether `a` blends with `b`; if so, `*weight` receives the weight.
    static bool linked(const SoftObject* a, const SoftObject* b, Real* weight);
    // Lets `b` dig into `a` with a weight. Returns false when there is no memory; `b` does not dig then.
    bool dent(SoftObject* a, SoftObject* b, Real weight);
    void undent(SoftObject* a, SoftObject* b);
    // Returns whether `b` digs into `a`; if so, `*weight` receives the weight.
    static bool dented(const SoftObject* a, const SoftObject* b, Real* weight);

    // Lays out the seeds of all objects, `spacing` units apart, closer on thin ones. Returns false on failure, as
    // SoftObject::resample() does; objects already done get their old spacing again where that is possible.
    bool resample(Real spacing, SurfaceMaker makeSurface);

    SurfaceMaker surfaceMaker() const { return makeSurface_; }

    // Makes the bodies that the links form ready for a frame. When links have changed, the bodies are found anew, and objects that
    // sample a hollow now, or do so no more, get other seeds. Then the recalc flags are spread within the bodies. Returns null when
    // there is no memory or the user stopped a layout (model/stop.h); the next call tries again.
    const Bodies* prepareBodies();
    // Whether two objects belong to different bodies, as found by the latest prepareBodies().
    bool areApart(const SoftObject& a, const SoftObject& b) const { return bodies_.members(a) != bodies_.members(b); }

    // The number of regular seeds that a spacing would give.
    int seedsAt(Real spacing) const;

    // The smallest and the largest spacing of an object.
    Real finest() const;
    Real coarsest() const;
    // The largest spacing that the whole model would have to be given for some object to have the spacing that it has now.
    Real coarsestAsked() const;

    // The number of seeds of all objects: regular ones, and oversampled ones.
    int seeds() const;
    int oversampledSeeds() const;

    // The objects, in the order of items().
    int count() const { return count_; }
    Actor& actor(int i) { return *actors_[i]; }
    const Actor& actor(int i) const { return *actors_[i]; }

    // Objects and groups, parents before their children.
    int items() const { return itemCount_; }
    Actor& item(int i) { return *items_[i]; }
    const Actor& item(int i) const { return *items_[i]; }
    Actor* itemNumbered(int number) const;
    Actor* itemNamed(const char* name) const;

    // Applies the inverse of a pose's turn and scale (not of its place) to a vector of the world.
    static Vector inverse(const Pose& pose, const Vector& v);

    const Key* keys() const { return keys_; }
    int keyCount() const { return keyCount_; }

    // Exchanges the contents of the two models.
    void swap(Model& other);

    // A copy of everything but the seeds, small enough to be kept many times. record() returns null when there is no memory;
    // the caller releases a record with free().
    struct Record;
    Record* record() const;

    // Goes back to a record of this model. Objects that have not changed since then keep their seeds. Returns false when there
    // is no memory; nothing is changed then.
    bool restore(const Record* record);

    // Has all bodies found and all seeds settled anew in the next frame.
    void settleAnew();

    // The bodies as the latest prepareBodies() found them; null if something has changed since then.
    const Bodies* knownBodies() const { return bodiesKnown_ ? &bodies_ : nullptr; }

    // Sets the light, and has all objects looked at again.
    void setLight(const Vector& to);

    // Has all objects looked at again, because the viewer has moved or turned.
    void recalcAll();

    // The group that the eye moves with, named `eye`; it is made if the eye has been standing so far. Null when there is no
    // room or no memory.
    Actor* eyeCarrier();

    Camera camera;
    Vector light{Real(0.5), Real(0.7), Real(-0.5)};  // from the model to the light, any length but 0
    char title[TITLE_ROOM] = "";                     // title of the scene; may be empty
    bool mixed = false;  // colours mix: a place shows the mean of the objects' colours, weighted by their fields

private:
    void clear();
    SoftObject* makeObject(const Actor& item) const;
    // Returns true if the objects of two items are equal before any scaling: kind, measures, strength and stretch.
    static bool isLike(const Actor& a, const Actor& b);
    const SoftObject* alike(int i) const;
    bool layOutHollows();
    void handOnChildren(const Actor& item);
    void forgetInCamera(const Actor& item);
    void sortItems();
    bool makeItems(const Record* record, Model& then) const;
    bool copyKeys(const Record* record);
    void unlinkAll();
    void takeObjects(Model& then);

    Actor* actors_[OBJECTS_MOST] = {};
    Actor* items_[OBJECTS_MOST + GROUPS_MOST] = {};  // owned
    int count_ = 0;
    int itemCount_ = 0;
    Key* keys_ = nullptr;  // room for KEYS_MOST, allocated with the first key
    int keyCount_ = 0;
    Real spacing_{0};      // spacing of the latest resample(); 0: none yet
    SurfaceMaker makeSurface_ = nullptr;
    Bodies bodies_;
    bool bodiesKnown_ = false;
};

#endif
