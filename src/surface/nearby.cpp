// Finds the neighbours that the paths of a patch may meet, and those that reach its seeds where they are.
#include "nearby.h"

#include "model/body.h"

Nearby::Nearby(const SoftObject& object, Neighbourhood& all, const Bodies& bodies)
    : object_(object), all_(all), bodies_(bodies), ownWeights_(bodies.weights(object.slot())),
      allComplete_(all.ordinary && bodies.plainBody(object.slot()))
{
}

bool Nearby::setPatch(const Patch& patch, bool oversampled)
{
    nearest_ = realFromRaw(patch.nearest << 10);
    farthest_ = realFromRaw(patch.farthest << 10);
    patch_ = &patch;
    near_.count = 0;
    listed_.count = -1;
    smallest_ = object_.laidSize();
    dented_ = false;
    if (!all_.ordinary)
        setOdd();
    // Oversampled seeds also lie between the seeds of this patch and those of adjacent patches.
    const Bound ball = boundOf(patch, oversampled ? patch.radius : patch.tight);
    for (Neighbour *near = all_.neighbours, *const end = near + all_.count; near < end; ++near) {
        if (!reaches(*near, ball))
            continue;
        near_.add(*near);
        if (near->grain < smallest_)
            smallest_ = near->grain;
    }
    setComplete(near_);
    return near_.count > 0;
}

// Sets what is different about a patch where the neighbourhood is not ordinary.
void Nearby::setOdd()
{
    if (object_.shaped())
        smallest_ = smallest_ * object_.narrowing();
    if (object_.strength() > Real(1))
        smallest_ = smallest_ / object_.strength();
    dented_ = all_.inner || all_.hollow;
    if (!all_.dented && !all_.hollow)
        return;
    const Bound paths = boundOfPaths(*patch_, all_);
    for (const Neighbour *near = all_.neighbours, *const end = near + all_.count; near < end; ++near)
        if (reaches(*near, paths)) {
            dented_ = dented_ || near->digs;
            smallest_ = min(smallest_, near->grain);
        }
}

// Makes the list when it is needed for the first time.
const NeighbourList& Nearby::findListed()
{
    listed_.count = 0;
    const Bound paths = boundOfPaths(*patch_, all_);
    for (Neighbour *near = all_.neighbours, *const end = near + all_.count; near < end; ++near)
        if (reaches(*near, paths))
            listed_.add(*near);
    setComplete(listed_);
    return listed_;
}

void Nearby::findComplete(NeighbourList& list) const
{
    list.complete = all_.ordinary ? areAllOne(list) : isComplete(list);
}

// Whether a list is complete, in any scene.
bool Nearby::isComplete(const NeighbourList& list) const
{
    if (!areLinked(list))
        return false;
    for (int i = 0; i < list.count; ++i) {
        const Neighbour& near = *list.near[i];
        if (near.digs ? !digAlike(list, near) : all_.hollow && bodies_.weight(near.slot, object_.slot()) != -all_.weight)
            return false;
    }
    return true;
}

// Whether a list is complete, in an ordinary scene: tests every pair, which is quick for short lists.
bool Nearby::areAllOne(const NeighbourList& list) const
{
    for (int i = 0; i < list.count; ++i) {
        const int slot = list.near[i]->slot;
        if (ownWeights_[slot] != Real(1))
            return false;
        for (int j = 0; j < i; ++j)
            if (list.near[j]->weights[slot] != Real(1))
                return false;
    }
    return true;
}

// Whether the object and all members of the body on a list are linked with each other at weight 1.
bool Nearby::areLinked(const NeighbourList& list) const
{
    if (all_.inner)
        return false;
    uint32_t members[Bodies::LINK_WORDS] = {};
    const auto add = [&](int slot) { members[slot / 32] |= 1u << slot % 32; };
    const auto isLinkedWithAll = [&](int slot) {
        const uint32_t* const plain = bodies_.plainLinks(slot);
        uint32_t missing = 0;
        for (int word = 0; word < Bodies::LINK_WORDS; ++word)
            missing |= members[word] & ~(plain[word] | (word == slot / 32 ? 1u << slot % 32 : 0));
        return missing == 0;
    };
    const auto ofBody = [&](int i) { return !list.near[i]->digs; };
    const auto slotOf = [&](int i) { return list.near[i]->slot; };
    if (!all_.hollow)
        add(object_.slot());
    for (int i = 0; i < list.count; ++i)
        if (ofBody(i))
            add(slotOf(i));
    for (int i = 0; i < list.count; ++i)
        if (ofBody(i) && !isLinkedWithAll(slotOf(i)))
            return false;
    return all_.hollow || isLinkedWithAll(object_.slot());
}

// Whether a digging neighbour digs with one weight into all members of the body on a list.
bool Nearby::digAlike(const NeighbourList& list, const Neighbour& digging) const
{
    for (int j = 0; j < list.count; ++j) {
        const Neighbour& member = *list.near[j];
        if (!member.digs && bodies_.weight(member.object->slot(), digging.object->slot()) != -digging.weight)
            return false;
    }
    return true;
}
