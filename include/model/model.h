// Model: which objects there are, what they blend with, how they are lit, seen, coloured and moved; and the groups that
// move, turn and scale objects as one.
#ifndef FB_MODEL_H
#define FB_MODEL_H

#include "model/anim.h"
#include "model/body.h"
#include "model/kind.h"
#include "model/paint.h"
#include "model/softobj.h"
#include "model/camera.h"

// Room for a name: 15 characters and the final 0.
constexpr int NAME_ROOM = 16;

// What the group is called that the eye moves with.
extern const char EYE_NAME[];

// Room for the title of a scene: 47 characters and the final 0.
constexpr int TITLE_ROOM = 48;

// An item of the model: an object with its part in the scene, or a group (which has no object).
struct Actor {
    SoftObject* object = nullptr;
    Colour colour{255, 255, 255};
    Coat coat;
    Motion motion;
    int number = 0;                // objects count from 1, groups from -1 downwards
    char name[NAME_ROOM] = "";
    const Kind* kind = nullptr;    // null: a group, or an object that was made elsewhere
    Real measure[MEASURES_MOST] = {Real(0), Real(0), Real(0), Real(0)};  // as the kind has them, before any scaling
    Vector stretch{Real(1), Real(1), Real(1)};  // along its own axes; objects only
    Pose pose;                     // as Anim::move() left it
    Real made{0};                  // size() of the object before any scaling
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

    // The report's predefined model: four spheres of sizes 20, 25, 30 and 35, each blending with the other three, on
    // circular paths round the origin. False: no memory.
    bool makeFourSpheres();

    // Takes over an object made with make<>(), for a model that is built in code: the program itself names kinds (addItem()).
    // False (and the object destroyed): no room.
    bool add(SoftObject* object, const Colour& colour, const Motion& motion);

    // Adds an item as described, making its object; name, kind, measures, strength, colour and motion are taken, the number
    // is given here. A parent must be there already. Null: no room or no memory.
    Actor* addItem(const Actor& described);

    // Takes an item out of the model, and its keys. What it carried is carried by its own parent from then on: the
    // centre stays where it is now, but what the item added to its motion and its turn is gone.
    void remove(Actor* item);

    // Null, or what is expected where the measures and the stretch of an item do not fit each other.
    static const char* expects(const Actor& item);

    // Makes the object of an item anew, after its measures or its strength were changed. False: no memory, and the object
    // that was there stays.
    bool remake(Actor* item);

    // Takes an item's keys away.
    void removeKeys(Actor* item);

    // Gives an item another parent, by number (0: none). It stays where it is now; it turns and grows with the new parent
    // from then on. False: the parent is carried by the item itself.
    bool setParent(Actor* item, int parent);

    // Adds a key to an item, whose times must rise. False: no room or no memory.
    bool addKey(Actor* item, const Key& key);

    // Links two objects both ways with one weight. False: no memory; then they are not linked.
    bool link(SoftObject* a, SoftObject* b, Real weight);
    void unlink(SoftObject* a, SoftObject* b);
    // Links every object with every other. False: no memory.
    bool linkAll(Real weight);
    // Whether `a` blends with `b`, and with which weight.
    static bool linked(const SoftObject* a, const SoftObject* b, Real* weight);
    // Lets `b` dig into `a` with a weight. False: no memory; then it does not.
    bool dent(SoftObject* a, SoftObject* b, Real weight);
    void undent(SoftObject* a, SoftObject* b);
    // Whether `b` digs into `a`, and with which weight.
    static bool dented(const SoftObject* a, const SoftObject* b, Real* weight);

    // Lays out the seeds of all objects, `spacing` units apart, closer on thin ones. False: as SoftObject::resample(); objects
    // already done are put back to the spacing they had where that is possible.
    bool resample(Real spacing, SurfaceMaker makeSurface);

    SurfaceMaker surfaceMaker() const { return makeSurface_; }

    // The bodies that the links make, found anew when they have changed. Null: no memory.
    const Bodies* bodies();

    // How many regular seeds a spacing would give.
    int seedsAt(Real spacing) const;

    // The finest and the coarsest spacing of an object.
    Real finest() const;
    Real coarsest() const;

    // Number of seeds of all objects: regular, oversampled.
    int seeds() const;
    int oversampledSeeds() const;

    // The objects, in the order they were added.
    int count() const { return count_; }
    Actor& actor(int i) { return *actors_[i]; }
    const Actor& actor(int i) const { return *actors_[i]; }

    // Objects and groups, parents before their children.
    int items() const { return itemCount_; }
    Actor& item(int i) { return *items_[i]; }
    const Actor& item(int i) const { return *items_[i]; }
    Actor* itemNumbered(int number) const;
    Actor* itemNamed(const char* name) const;

    // The inverse of turn and scale of a pose (not of its place), for `v` in the world.
    static Vector inverse(const Pose& pose, const Vector& v);

    const Key* keys() const { return keys_; }
    int keyCount() const { return keyCount_; }

    // Takes everything that `other` has, and gives it what this one had.
    void swap(Model& other);

    // A copy of everything but the seeds, small enough to be kept many times over. Null: no memory. Freed by free().
    struct Record;
    Record* record() const;

    // Goes back to a record of this model. Objects that have not changed since keep their seeds. False: no memory, and
    // nothing was changed.
    bool restore(const Record* record);

    // Has all seeds looked for anew, as if nothing were known of a frame before.
    void settleAnew();

    // Number of the object whose own field is the strongest at a point, of those that have a surface: it gives the point its
    // colour. -1: no field reaches it.
    int strongestAt(const Point& p) const;

    // The field of the body there that has the greatest, as model/body.h has it; 0 where none reaches. By the links that bodies()
    // was last asked for with. `*strongest` becomes strongestAt().
    Real implicitAt(const Point& p, int* strongest) const;

    // Changes the light under which seeds were laid out already.
    void setLight(const Vector& to);

    // The viewer has moved or turned: every object is looked at anew.
    void recalcAll();

    // The group that the eye moves with, made when it stood so far. Its name is `eye`. Null: no room or no memory.
    Actor* eyeCarrier();

    Camera camera;
    Vector light{Real(0.5), Real(0.7), Real(-0.5)};  // from the model to the light, any length but 0
    char title[TITLE_ROOM] = "";                     // what the scene calls itself; may be empty
    bool mixed = false;  // a place has the mean of the objects' colours by their fields there

private:
    void clear();
    SoftObject* makeObject(const Actor& item) const;
    // Whether two items have the same object, before any scaling.
    static bool isLike(const Actor& a, const Actor& b);
    const SoftObject* alike(int i) const;
    bool makeItems(const Record* record, Model& then) const;
    bool copyKeys(const Record* record);
    void unlinkAll();
    void takeObjects(Model& then);

    Actor* actors_[OBJECTS_MOST];
    Actor* items_[OBJECTS_MOST + GROUPS_MOST];  // owned
    int count_ = 0;
    int itemCount_ = 0;
    Key* keys_ = nullptr;  // room for KEYS_MOST as soon as there is one
    int keyCount_ = 0;
    Real spacing_{0};      // as last laid out; 0: not yet
    SurfaceMaker makeSurface_ = nullptr;
    Bodies bodies_;
    bool bodiesKnown_ = false;
};

#endif
