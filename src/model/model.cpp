// The model, its items and links, and the predefined model. Records of a model are in record.cpp.
#include "model/model.h"

#include "math/alloc.h"

namespace {

// Radius of the circular paths, units.
constexpr int PATH = 22;

// A sphere on a circle of radius PATH round the origin; `u` and `v` are perpendicular unit vectors in the plane of the circle.
Actor circlingSphere(const char* name, int size, const Colour& colour, const Vector& u, const Vector& v, Real phase,
                     int seconds)
{
    Actor actor;
    strcpy(actor.name, name);
    actor.kind = kindNamed("sphere");
    actor.measure[0] = Real(size);
    actor.colour = colour;
    actor.motion.u = u * Real(PATH);
    actor.motion.v = v * Real(PATH);
    actor.motion.circle = makeWave(Real(seconds), phase);
    return actor;
}

}  // namespace

const char EYE_NAME[] = "eye";

void Model::clear()
{
    for (int i = 0; i < itemCount_; ++i) {
        destroy(items_[i]->object);
        destroy(items_[i]);
    }
    itemCount_ = count_ = 0;
    free(keys_);
    keys_ = nullptr;
    keyCount_ = 0;
}

// Makes the object of an item; if the other objects have seeds, it gets seeds of the same spacing. Returns null when there is
// no memory.
SoftObject* Model::makeObject(const Actor& item) const
{
    SoftObject* object = item.kind == nullptr ? nullptr : item.kind->make(item.number, item.measure);
    if (object == nullptr)
        return nullptr;
    object->setStrength(item.strength);
    object->setStretch(item.stretch);
    if (spacing_ != Real(0) && !object->resample(object->ownSpacing(spacing_), makeSurface_)) {
        destroy(object);
        return nullptr;
    }
    return object;
}

bool Model::add(SoftObject* object, const Colour& colour, const Motion& motion)
{
    Actor described;
    described.colour = colour;
    described.motion = motion;
    Actor* actor = object == nullptr || count_ == OBJECTS_MOST ? nullptr : make<Actor>(described);
    if (actor == nullptr) {
        destroy(object);
        return false;
    }
    actor->object = object;
    actor->number = object->number();
    snprintf(actor->name, sizeof actor->name, "object%d", actor->number);
    actor->measure[0] = actor->made = object->size();
    actor->strength = object->strength();
    bodiesKnown_ = false;
    actors_[count_++] = actor;
    items_[itemCount_++] = actor;
    return true;
}

Actor* Model::addItem(const Actor& described)
{
    const bool group = described.kind == nullptr;
    int number = group ? -1 : 1, groups = 0;
    for (int i = 0; i < itemCount_; ++i) {
        const int taken = items_[i]->number;
        groups += taken < 0;
        if (group ? taken <= number : taken >= number)
            number = taken + (group ? -1 : 1);
    }
    if (group ? groups == GROUPS_MOST : count_ == OBJECTS_MOST)
        return nullptr;
    Actor* item = make<Actor>(described);
    if (item == nullptr)
        return nullptr;
    item->number = number;
    item->motion.firstKey = item->motion.keyCount = 0;
    item->pose = Pose();
    item->object = nullptr;
    if (!group) {
        item->object = makeObject(*item);
        if (item->object == nullptr) {
            destroy(item);
            return nullptr;
        }
        item->made = item->object->size();
        bodiesKnown_ = false;
        actors_[count_++] = item;
    }
    items_[itemCount_++] = item;
    return item;
}

const char* Model::expects(const Actor& item)
{
    if (item.kind == nullptr)
        return nullptr;
    const char* const measures = item.kind->expects == nullptr ? nullptr : item.kind->expects(item.measure);
    const Vector& v = item.stretch;
    if (measures != nullptr || v == Vector{Real(1), Real(1), Real(1)})
        return measures;
    const bool near = item.kind->reach(item.measure) * max(v.x, max(v.y, v.z)) <= Real(STRETCHED_REACH);
    return near ? nullptr : "a stretch that leaves all of it within 100 units of its centre";
}

// Lets the parent of an item carry the item's children. The pose of the item becomes part of their centres.
void Model::handOnChildren(const Actor& item)
{
    const Actor* const parent = itemNumbered(item.motion.parent);
    for (int i = 0; i < itemCount_; ++i) {
        Motion& motion = items_[i]->motion;
        if (motion.parent != item.number)
            continue;
        motion.parent = item.motion.parent;
        const Vector arm = item.pose.turn * (toVector(motion.centre) * item.pose.scale);
        motion.centre = item.pose.place + arm;
        if (parent != nullptr)
            motion.centre = toPoint(inverse(parent->pose, motion.centre - parent->pose.place));
        motion.centre = clampedToSpace(motion.centre);
    }
}

// An eye that loses its group stands still, and one that looked at the item goes on looking at its last place.
void Model::forgetInCamera(const Actor& item)
{
    if (item.number == camera.carrier)
        camera.carrier = 0;
    if (camera.looks == Camera::AT_ITEM && item.number == camera.item) {
        camera.looks = Camera::AT_POINT;
        camera.target = item.pose.place;
    }
}

void Model::remove(Actor* item)
{
    handOnChildren(*item);
    forgetInCamera(*item);
    removeKeys(item);
    int left = 0;
    for (int i = 0; i < itemCount_; ++i)
        if (items_[i] != item)
            items_[left++] = items_[i];
    itemCount_ = left;

    if (item->object != nullptr) {
        int after = 0;
        for (int i = 0; i < count_; ++i) {
            if (actors_[i] == item)
                continue;
            unlink(actors_[i]->object, item->object);
            undent(actors_[i]->object, item->object);
            undent(item->object, actors_[i]->object);
            actors_[after++] = actors_[i];
        }
        count_ = after;
        bodiesKnown_ = false;
    }
    destroy(item->object);
    destroy(item);
}

void Model::removeKeys(Actor* item)
{
    const int first = item->motion.firstKey, keys = item->motion.keyCount;
    item->motion.keyCount = 0;
    item->motion.parts &= static_cast<uint8_t>(~MOTION_KEYS);
    if (keys == 0)
        return;
    memmove(keys_ + first, keys_ + first + keys, static_cast<size_t>(keyCount_ - first - keys) * sizeof(Key));
    keyCount_ -= keys;
    for (int i = 0; i < itemCount_; ++i)
        if (items_[i]->motion.firstKey > first)
            items_[i]->motion.firstKey = static_cast<int16_t>(items_[i]->motion.firstKey - keys);
}

bool Model::setParent(Actor* item, int parent)
{
    for (const Actor* above = itemNumbered(parent); above != nullptr; above = itemNumbered(above->motion.parent))
        if (above == item)
            return false;
    Motion& motion = item->motion;
    // `added` is what the item's own motion adds to its centre, as seen from its old parent. Choose the centre so that, with
    // the same addition, the new parent brings the item to the same place.
    const Actor* before = itemNumbered(motion.parent);
    const Actor* carrier = itemNumbered(parent);
    const Point origin{Real(0), Real(0), Real(0)};
    const auto within = [&](const Actor* in) {
        const Vector v = item->pose.place - (in == nullptr ? origin : in->pose.place);
        return in == nullptr ? v : inverse(in->pose, v);
    };
    const Vector added = within(before) - toVector(motion.centre);
    const Vector centre = within(carrier) - added;
    motion.centre = clampedToSpace(toPoint(centre));
    motion.parent = carrier == nullptr ? 0 : parent;
    sortItems();
    return true;
}

// Sorts the items so that parents come before their children: for each item in turn, first whatever carries it.
void Model::sortItems()
{
    Actor* ordered[OBJECTS_MOST + GROUPS_MOST];
    int count = 0;
    const auto placed = [&](const Actor* what) {
        for (int i = 0; i < count; ++i)
            if (ordered[i] == what)
                return true;
        return false;
    };
    for (int i = 0; i < itemCount_; ++i) {
        while (!placed(items_[i])) {
            Actor* next = items_[i];
            for (Actor* above = next; above != nullptr && !placed(above); above = itemNumbered(above->motion.parent))
                next = above;
            ordered[count++] = next;
        }
    }
    memcpy(items_, ordered, static_cast<size_t>(itemCount_) * sizeof *items_);
    count_ = 0;
    for (int i = 0; i < itemCount_; ++i)
        if (items_[i]->object != nullptr)
            actors_[count_++] = items_[i];
    bodiesKnown_ = false;
}

bool Model::remake(Actor* item)
{
    SoftObject* fresh = makeObject(*item);
    if (fresh == nullptr)
        return false;
    // Move links and dents to the new object, at both ends. Where memory runs out a link or dent is lost as a whole, never one
    // end only.
    for (int i = 0; i < count_; ++i) {
        SoftObject* other = actors_[i]->object;
        Real weight;
        if (other == item->object)
            continue;
        if (dented(other, item->object, &weight))
            dent(other, fresh, weight);
        if (dented(item->object, other, &weight))
            dent(fresh, other, weight);
        if (!linked(other, item->object, &weight))
            continue;
        other->unlink(item->object);
        link(fresh, other, weight);
    }
    bodiesKnown_ = false;
    fresh->setRamp(item->object->ramp());
    destroy(item->object);
    item->object = fresh;
    item->pose = Pose();
    item->made = fresh->size();
    return true;
}

bool Model::addKey(Actor* item, const Key& key)
{
    if (keyCount_ == KEYS_MOST)
        return false;
    if (keys_ == nullptr) {
        keys_ = allocate<Key>(KEYS_MOST);
        if (keys_ == nullptr)
            return false;
    }
    Motion& motion = item->motion;
    if (motion.keyCount == 0)
        motion.firstKey = static_cast<int16_t>(keyCount_);
    const int index = motion.firstKey + motion.keyCount;
    memmove(keys_ + index + 1, keys_ + index, static_cast<size_t>(keyCount_ - index) * sizeof(Key));
    keys_[index] = key;
    ++keyCount_;
    for (int i = 0; i < itemCount_; ++i)
        if (items_[i] != item && items_[i]->motion.keyCount > 0 && items_[i]->motion.firstKey >= index)
            ++items_[i]->motion.firstKey;
    ++motion.keyCount;
    motion.parts |= MOTION_KEYS;
    return true;
}

bool Model::link(SoftObject* a, SoftObject* b, Real weight)
{
    bodiesKnown_ = false;
    if (a->link(b, weight) && b->link(a, weight))
        return true;
    unlink(a, b);
    return false;
}

void Model::unlink(SoftObject* a, SoftObject* b)
{
    bodiesKnown_ = false;
    a->unlink(b);
    b->unlink(a);
}

bool Model::dent(SoftObject* a, SoftObject* b, Real weight)
{
    bodiesKnown_ = false;
    return a->dent(b, weight);
}

void Model::undent(SoftObject* a, SoftObject* b)
{
    bodiesKnown_ = false;
    a->undent(b);
}

namespace {

bool weightIn(const List<Link>& list, const SoftObject* object, Real* weight)
{
    for (const List<Link>::Node* node = list.first(); node != nullptr; node = node->next) {
        if (node->item.object == object) {
            *weight = node->item.weight;
            return true;
        }
    }
    return false;
}

}  // namespace

bool Model::linked(const SoftObject* a, const SoftObject* b, Real* weight)
{
    return weightIn(a->skel(), b, weight);
}

bool Model::dented(const SoftObject* a, const SoftObject* b, Real* weight)
{
    return weightIn(a->dents(), b, weight);
}

Vector Model::inverse(const Pose& pose, const Vector& v)
{
    const Vector turned = turnedBack(pose.turn, v);
    return {turned.x / pose.scale, turned.y / pose.scale, turned.z / pose.scale};
}

bool Model::makeFourSpheres()
{
    const Real h(0.70710678);
    const Vector x{Real(1), Real(0), Real(0)}, y{Real(0), Real(1), Real(0)}, z{Real(0), Real(0), Real(1)};
    const Vector slant{Real(0), h, h};
    const bool done =
        addItem(circlingSphere("red", 20, usualColour(0), x, y, Real(0), 5)) != nullptr &&
        addItem(circlingSphere("green", 25, usualColour(1), y, z, Real(0.25), 7)) != nullptr &&
        addItem(circlingSphere("blue", 30, usualColour(2), z, x, Real(0.5), 9)) != nullptr &&
        addItem(circlingSphere("yellow", 35, usualColour(3), x, slant, Real(0.75), 11)) != nullptr;
    return done && linkAll(Real(1));
}

bool Model::linkAll(Real weight)
{
    for (int i = 0; i < count_; ++i)
        for (int j = 0; j < i; ++j)
            if (!link(actors_[i]->object, actors_[j]->object, weight))
                return false;
    return true;
}

void Model::setLight(const Vector& to)
{
    light = to;
    recalcAll();
}

void Model::settleAnew()
{
    bodiesKnown_ = false;
    recalcAll();
}

void Model::recalcAll()
{
    for (int i = 0; i < count_; ++i)
        actors_[i]->object->setRecalc();
}

Actor* Model::eyeCarrier()
{
    if (camera.carrier != 0)
        return itemNumbered(camera.carrier);
    Actor described;
    strcpy(described.name, EYE_NAME);
    described.motion.centre = camera.eye;
    // The writer saves the eye with a turn then, so that it is read as a group again.
    described.motion.parts = MOTION_TURN;
    Actor* carrier = addItem(described);
    if (carrier != nullptr)
        camera.carrier = carrier->number;
    return carrier;
}

bool Model::isLike(const Actor& a, const Actor& b)
{
    bool same = a.kind == b.kind && a.strength == b.strength && a.stretch == b.stretch;
    for (int m = 0; same && m < MEASURES_MOST; ++m)
        same = a.measure[m] == b.measure[m];
    return same;
}

// Returns an object before the i-th that would have the same seeds, or null.
const SoftObject* Model::alike(int i) const
{
    const Actor& one = *actors_[i];
    for (int j = 0; one.kind != nullptr && one.object->hollowed() == nullptr && j < i; ++j) {
        const Actor& other = *actors_[j];
        // An object that only digs has seeds laid out for the object it digs into.
        if (isLike(one, other) && other.object->size() == one.object->size() && other.object->hollowed() == nullptr)
            return other.object;
    }
    return nullptr;
}

bool Model::resample(Real spacing, SurfaceMaker makeSurface)
{
    Real before[OBJECTS_MOST];
    for (int i = 0; i < count_; ++i) {
        SoftObject& object = *actors_[i]->object;
        before[i] = object.spacing();
        if (!object.resample(object.ownSpacing(spacing), makeSurface, alike(i))) {
            while (--i >= 0)
                actors_[i]->object->resample(before[i], makeSurface);
            return false;
        }
    }
    spacing_ = spacing;
    makeSurface_ = makeSurface;
    return true;
}

Real Model::finest() const
{
    Real spacing = count_ > 0 ? actors_[0]->object->spacing() : spacing_;
    for (int i = 1; i < count_; ++i)
        spacing = min(spacing, actors_[i]->object->spacing());
    return spacing;
}

Real Model::coarsest() const
{
    Real spacing = count_ > 0 ? actors_[0]->object->spacing() : spacing_;
    for (int i = 1; i < count_; ++i)
        spacing = max(spacing, actors_[i]->object->spacing());
    return spacing;
}

Real Model::coarsestAsked() const
{
    Real spacing(0);
    for (int i = 0; i < count_; ++i) {
        const SoftObject& object = *actors_[i]->object;
        spacing = max(spacing, object.spacing() / object.ownSpacing(Real(1)));
    }
    return spacing;
}

int Model::seedsAt(Real spacing) const
{
    int seeds = 0;
    for (int i = 0; i < count_; ++i)
        seeds += actors_[i]->object->seedsAt(actors_[i]->object->ownSpacing(spacing));
    return seeds;
}

// Lays out the seeds anew of those objects that have got or lost a surface of their own. Returns false if one of them failed.
bool Model::layOutHollows()
{
    bool good = true;
    for (int i = 0; i < count_; ++i) {
        SoftObject& object = *actors_[i]->object;
        if (object.laidInVain())
            good = object.resample(object.ownSpacing(spacing_), makeSurface_) && good;
    }
    return good;
}

const Bodies* Model::prepareBodies()
{
    if (!bodiesKnown_) {
        SoftObject* objects[OBJECTS_MOST];
        for (int i = 0; i < count_; ++i)
            objects[i] = actors_[i]->object;
        const bool found = bodies_.find(objects, count_);
        bodiesKnown_ = layOutHollows() && found;
    }
    if (!bodiesKnown_)
        return nullptr;
    bodies_.spreadRecalc();
    return &bodies_;
}

int Model::seeds() const
{
    int sum = 0;
    for (int i = 0; i < count_; ++i)
        sum += actors_[i]->object->seeds();
    return sum;
}

int Model::oversampledSeeds() const
{
    int sum = 0;
    for (int i = 0; i < count_; ++i)
        sum += actors_[i]->object->oversampledSeeds();
    return sum;
}

Actor* Model::itemNumbered(int number) const
{
    for (int i = 0; i < itemCount_; ++i)
        if (items_[i]->number == number)
            return items_[i];
    return nullptr;
}

Actor* Model::itemNamed(const char* name) const
{
    for (int i = 0; i < itemCount_; ++i)
        if (strcmp(items_[i]->name, name) == 0)
            return items_[i];
    return nullptr;
}
