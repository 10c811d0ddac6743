// Which neighbours the paths of a patch may meet, from the patch's lists (classify.cpp) and from where its seeds are.
#include "nearby.h"

#include "model/body.h"

Nearby::Nearby(const SoftObject& object, Neighbourhood& all, const Bodies& bodies)
    : object_(object), all_(all), bodies_(bodies), ownWeights_(bodies.weights(object.slot()))
{
    allComplete_ = all.ordinary && bodies.plainBody(object.slot());
    if (allComplete_)
        return;
    listed_.count = 0;
    for (int i = 0; i < all.count; ++i)
        listed_.add(all.neighbours[i]);
    allComplete_ = isComplete(listed_);
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
        setOdd(patch);
    if (!isListed(patch.near)) {
        near_.complete = true;
        return false;
    }
    // Oversampled seeds lie between those of the patch and those beside it.
    const Bound ball = boundOf(patch, oversampled ? patch.radius : patch.tight);
    forNeighbours(patch.near, [&](int slot) {
        Neighbour* const near = all_.bySlot[slot];
        if (near == nullptr || !reaches(*near, ball))
            return;
        near_.add(*near);
        smallest_ = min(smallest_, near->grain);
    });
    setComplete(near_);
    return near_.count > 0;
}

// What a patch has besides where not all is common.
void Nearby::setOdd(const Patch& patch)
{
    if (object_.shaped())
        smallest_ = smallest_ * object_.narrowing();
    if (object_.strength() > Real(1))
        smallest_ = smallest_ / object_.strength();
    dented_ = all_.inner || all_.hollow;
    if (all_.dented || all_.hollow)
        forNeighbours(patch.listed, [&](int slot) {
            const Neighbour* const near = all_.bySlot[slot];
            if (near == nullptr)
                return;
            dented_ = dented_ || near->digs;
            smallest_ = min(smallest_, near->grain);
        });
}

// Made when it is needed for the first time.
const NeighbourList& Nearby::findListed()
{
    listed_.count = 0;
    forNeighbours(patch_->listed, [&](int slot) {
        if (all_.bySlot[slot] != nullptr)
            listed_.add(*all_.bySlot[slot]);
    });
    setComplete(listed_);
    return listed_;
}

void Nearby::findComplete(NeighbourList& list) const
{
    list.complete = all_.ordinary ? areAllOne(list) : isComplete(list);
}

bool Nearby::isComplete(const NeighbourList& list) const
{
    if (!areLinked(list))
        return false;
    for (int i = 0; i < list.count; ++i) {
        const Neighbour& near = *list.near[i];
        if (near.digs ? !digAlike(list, near) : all_.hollow && bodies_.weight(near.object->slot(), object_.slot()) != -all_.weight)
            return false;
    }
    return true;
}

// The same where all is common and they are few.
bool Nearby::areAllOne(const NeighbourList& list) const
{
    for (int i = 0; i < list.count; ++i) {
        const int slot = list.near[i]->object->slot();
        if (ownWeights_[slot] != Real(1))
            return false;
        for (int j = 0; j < i; ++j)
            if (bodies_.weight(list.near[j]->object->slot(), slot) != Real(1))
                return false;
    }
    return true;
}

// Whether all of those that do not dig, and the object, are linked at weight 1.
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
    const auto slotOf = [&](int i) { return list.near[i]->object->slot(); };
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

// Whether one of them that digs does it with one weight into all the others that do not.
bool Nearby::digAlike(const NeighbourList& list, const Neighbour& digging) const
{
    for (int j = 0; j < list.count; ++j) {
        const Neighbour& member = *list.near[j];
        if (!member.digs && bodies_.weight(member.object->slot(), digging.object->slot()) != -digging.weight)
            return false;
    }
    return true;
}
