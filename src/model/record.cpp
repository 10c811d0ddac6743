// Records of a model, which the editor's undo and redo need, and the exchange of two models.
#include "model/model.h"

#include "math/alloc.h"

namespace {

template <class T>
void exchange(T& a, T& b)
{
    const T t = a;
    a = b;
    b = t;
}

}  // namespace

// A record is one block of memory: this struct, then the items, the keys, and the links and dents.
struct alignas(Actor) Model::Record {
    struct Pair {
        int16_t a, b;  // numbers of the two objects
        Real weight;
        bool dent;     // true: b digs into a; false: the two are linked
    };
    int items, keys, pairs;
    Camera camera;
    Vector light;
    bool mixed;
    char title[TITLE_ROOM];

    Actor* item() { return reinterpret_cast<Actor*>(this + 1); }
    const Actor* item() const { return reinterpret_cast<const Actor*>(this + 1); }
    Key* key() { return reinterpret_cast<Key*>(item() + items); }
    const Key* key() const { return reinterpret_cast<const Key*>(item() + items); }
    Pair* pair() { return reinterpret_cast<Pair*>(key() + keys); }
    const Pair* pair() const { return reinterpret_cast<const Pair*>(key() + keys); }
};

void Model::swap(Model& other)
{
    for (int i = 0; i < OBJECTS_MOST; ++i)
        exchange(actors_[i], other.actors_[i]);
    for (int i = 0; i < OBJECTS_MOST + GROUPS_MOST; ++i)
        exchange(items_[i], other.items_[i]);
    exchange(count_, other.count_);
    exchange(itemCount_, other.itemCount_);
    exchange(keys_, other.keys_);
    exchange(keyCount_, other.keyCount_);
    exchange(spacing_, other.spacing_);
    exchange(makeSurface_, other.makeSurface_);
    bodiesKnown_ = other.bodiesKnown_ = false;
    exchange(camera, other.camera);
    exchange(light, other.light);
    exchange(mixed, other.mixed);
    for (int i = 0; i < TITLE_ROOM; ++i)
        exchange(title[i], other.title[i]);
}

Model::Record* Model::record() const
{
    int pairs = 0;
    for (int i = 0; i < count_; ++i) {
        for (const List<Link>::Node* node = actors_[i]->object->skel().first(); node != nullptr; node = node->next)
            pairs += node->item.object->number() > actors_[i]->number;
        for (const List<Link>::Node* node = actors_[i]->object->dents().first(); node != nullptr; node = node->next)
            ++pairs;
    }
    const size_t bytes = sizeof(Record) + static_cast<size_t>(itemCount_) * sizeof(Actor) +
                         static_cast<size_t>(keyCount_) * sizeof(Key) + static_cast<size_t>(pairs) * sizeof(Record::Pair);
    Record* record = static_cast<Record*>(malloc(bytes));
    if (record == nullptr)
        return nullptr;
    record->items = itemCount_;
    record->keys = keyCount_;
    record->pairs = pairs;
    record->camera = camera;
    record->light = light;
    record->mixed = mixed;
    memcpy(record->title, title, sizeof title);
    for (int i = 0; i < itemCount_; ++i)
        record->item()[i] = *items_[i];
    if (keyCount_ > 0)
        memcpy(record->key(), keys_, static_cast<size_t>(keyCount_) * sizeof(Key));
    Record::Pair* pair = record->pair();
    for (int i = 0; i < count_; ++i) {
        const int16_t number = static_cast<int16_t>(actors_[i]->number);
        for (const List<Link>::Node* node = actors_[i]->object->skel().first(); node != nullptr; node = node->next)
            if (node->item.object->number() > number)
                *pair++ = {number, static_cast<int16_t>(node->item.object->number()), node->item.weight, false};
        for (const List<Link>::Node* node = actors_[i]->object->dents().first(); node != nullptr; node = node->next)
            *pair++ = {number, static_cast<int16_t>(node->item.object->number()), node->item.weight, true};
    }
    return record;
}

bool Model::restore(const Record* record)
{
    // Everything that can fail is done first, in a second model, so that this one stays unchanged on failure.
    Model then;
    then.spacing_ = spacing_;
    then.makeSurface_ = makeSurface_;
    if (!makeItems(record, then) || !then.copyKeys(record))
        return false;

    unlinkAll();
    takeObjects(then);
    then.camera = record->camera;
    then.light = record->light;
    then.mixed = record->mixed;
    memcpy(then.title, record->title, sizeof title);
    const bool litAnew = !(light == record->light);
    swap(then);
    // The objects taken over still have the brightness of the previous light. (Who draws them sees whether the eye has moved.)
    if (litAnew)
        recalcAll();
    const Record::Pair* const end = record->pair() + record->pairs;
    for (const Record::Pair* pair = record->pair(); pair < end; ++pair) {
        SoftObject *a = itemNumbered(pair->a)->object, *b = itemNumbered(pair->b)->object;
        // If memory runs out, this pair is left out.
        if (pair->dent)
            dent(a, b, pair->weight);
        else
            link(a, b, pair->weight);
    }
    return true;
}

// Makes the items of a record in `then`. An object equal to the present one is not made, because takeObjects() will move the
// present one over. Returns false when there is no memory.
bool Model::makeItems(const Record* record, Model& then) const
{
    for (int i = 0; i < record->items; ++i) {
        Actor* item = make<Actor>(record->item()[i]);
        if (item == nullptr)
            return false;
        const bool group = item->object == nullptr;
        item->object = nullptr;
        then.items_[then.itemCount_++] = item;
        if (group)
            continue;
        then.actors_[then.count_++] = item;
        const Actor* now = itemNumbered(item->number);
        if (now != nullptr && isLike(*now, *item))
            continue;
        item->pose = Pose();
        item->object = makeObject(*item);
        if (item->object == nullptr)
            return false;
        item->made = item->object->size();
    }
    return true;
}

bool Model::copyKeys(const Record* record)
{
    if (record->keys == 0)
        return true;
    keys_ = allocate<Key>(KEYS_MOST);
    if (keys_ == nullptr)
        return false;
    memcpy(keys_, record->key(), static_cast<size_t>(record->keys) * sizeof(Key));
    keyCount_ = record->keys;
    return true;
}

void Model::unlinkAll()
{
    for (int i = 0; i < count_; ++i) {
        for (int j = 0; j < count_; ++j) {
            unlink(actors_[i]->object, actors_[j]->object);
            undent(actors_[i]->object, actors_[j]->object);
        }
    }
}

// Moves to `then` the objects that did not have to be made anew.
void Model::takeObjects(Model& then)
{
    for (int i = 0; i < then.count_; ++i) {
        Actor* item = then.actors_[i];
        if (item->object != nullptr)
            continue;
        Actor* now = itemNumbered(item->number);
        item->object = now->object;
        item->pose = now->pose;
        item->made = now->made;
        now->object = nullptr;
    }
}
