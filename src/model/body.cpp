// Finds which objects form a body, and the weights between them.
#include "model/body.h"

#include "math/alloc.h"
#include "model/softobj.h"

Bodies::~Bodies()
{
    release();
}

void Bodies::release()
{
    free(weights_);
    free(bySlot_);
    free(members_);
    free(diggers_);
    weights_ = nullptr;
    bySlot_ = nullptr;
    members_ = nullptr;
    diggers_ = nullptr;
    count_ = 0;
}

bool Bodies::find(SoftObject* const* objects, int count)
{
    release();
    if (!reserve(objects, static_cast<uint32_t>(count))) {
        release();
        return false;
    }
    count_ = count;
    ++version_;
    for (int i = 0; i < count; ++i) {
        objects[i]->setSlot(i);
        bySlot_[i].first = -1;
    }
    setWeights(objects);
    int filled = 0, diggers = 0;
    for (int i = 0; i < count; ++i) {
        if (bySlot_[i].first >= 0)
            continue;
        const int begin = filled, firstDigger = diggers;
        findMembers(objects[i], &filled);
        findDiggers(begin, filled, &diggers);
        const bool complete = diggers == firstDigger && allLinked(begin, filled, false);
        const bool plainBody = complete && allLinked(begin, filled, true);
        for (int at = begin; at < filled; ++at) {
            bySlot_[members_[at]->slot()].size = static_cast<int16_t>(filled - begin);
            bySlot_[members_[at]->slot()].complete = complete;
            bySlot_[members_[at]->slot()].plainBody = plainBody;
        }
    }
    return true;
}

// Allocates the arrays for `count` objects. Returns false when there is no memory.
bool Bodies::reserve(SoftObject* const* objects, uint32_t count)
{
    uint32_t dents = 0;
    for (uint32_t i = 0; i < count; ++i)
        for (const List<Link>::Node* node = objects[i]->dents().first(); node != nullptr; node = node->next)
            ++dents;
    weights_ = allocate<Real>(count * count);
    bySlot_ = allocate<Entry>(count);
    members_ = allocate<SoftObject*>(count);
    diggers_ = allocate<SoftObject*>(dents + 1);
    return weights_ != nullptr && bySlot_ != nullptr && members_ != nullptr && diggers_ != nullptr;
}

// Fills in the weights. The objects must have their slots.
void Bodies::setWeights(SoftObject* const* objects)
{
    for (int i = 0; i < count_ * count_; ++i)
        weights_[i] = Real(0);
    for (int i = 0; i < count_; ++i) {
        Real* const row = weights_ + i * count_;
        Entry& entry = bySlot_[i];
        entry.heaviest = Real(0);
        memset(entry.plain, 0, sizeof entry.plain);
        for (const List<Link>::Node* node = objects[i]->skel().first(); node != nullptr; node = node->next) {
            row[node->item.object->slot()] = node->item.weight;
            entry.heaviest = max(entry.heaviest, node->item.weight);
        }
        for (const List<Link>::Node* node = objects[i]->dents().first(); node != nullptr; node = node->next)
            row[node->item.object->slot()] -= node->item.weight;
    }
    for (int i = 0; i < count_; ++i)
        for (int j = 0; j < count_; ++j)
            if (weight(i, j) == Real(1))
                bySlot_[i].plain[j / 32] |= 1u << j % 32;
}

// Adds an object and all objects that links join with it, breadth first.
void Bodies::findMembers(SoftObject* object, int* filled)
{
    const int begin = *filled;
    members_[(*filled)++] = object;
    bySlot_[object->slot()].first = static_cast<int16_t>(begin);
    for (int i = begin; i < *filled; ++i) {
        bySlot_[members_[i]->slot()].member = static_cast<int16_t>(i);
        for (const List<Link>::Node* node = members_[i]->skel().first(); node != nullptr; node = node->next) {
            SoftObject* other = node->item.object;
            if (bySlot_[other->slot()].first >= 0 || node->item.weight == Real(0))
                continue;
            bySlot_[other->slot()].first = static_cast<int16_t>(begin);
            members_[(*filled)++] = other;
        }
    }
}

// Returns true if all members from `begin` to before `end` are linked with each other: at weight 1 if `plain`, else at any
// weight but 0.
bool Bodies::allLinked(int begin, int end, bool plain) const
{
    for (int a = begin; a < end; ++a)
        for (int b = begin; b < end; ++b) {
            const Real by = a == b ? Real(1) : weight(members_[a]->slot(), members_[b]->slot());
            if (plain ? by != Real(1) : by == Real(0))
                return false;
        }
    return true;
}

// Adds the objects that dig into the members from `begin` to before `end`, which are those of the body filled last.
void Bodies::findDiggers(int begin, int end, int* filled)
{
    const int first = *filled;
    const auto known = [&](const SoftObject* object) {
        for (int i = first; i < *filled; ++i)
            if (diggers_[i] == object)
                return true;
        return bySlot_[object->slot()].first == begin;
    };
    for (int at = begin; at < end && members_[begin]->hasSurface(); ++at)
        for (const List<Link>::Node* node = members_[at]->dents().first(); node != nullptr; node = node->next)
            if (node->item.weight != Real(0) && !known(node->item.object))
                diggers_[(*filled)++] = node->item.object;
    for (int at = begin; at < end; ++at) {
        bySlot_[members_[at]->slot()].firstDigger = static_cast<int16_t>(first);
        bySlot_[members_[at]->slot()].diggerCount = static_cast<int16_t>(*filled - first);
    }
}

void Bodies::spreadRecalc() const
{
    for (int at = 0; at < count_; ++at) {
        const SoftObject& moved = *members_[at];
        const int slot = moved.slot();
        const Entry& entry = bySlot_[slot];
        spreadByDiggers(*members_[at]);
        if (entry.complete || !moved.recalc())
            continue;
        for (int i = entry.first; i < entry.first + entry.size; ++i) {
            SoftObject& other = *members_[i];
            const bool told = weight(slot, other.slot()) != Real(0) && weight(other.slot(), slot) != Real(0);
            if (!other.recalc() && !told && moved.inRange(other))
                other.setRecalc();
        }
    }
}

// Passes the recalc flag between a member of a body and the objects that dig into the body, in both directions.
void Bodies::spreadByDiggers(SoftObject& member) const
{
    SoftObject* const* const from = diggers(member);
    SoftObject* const* const end = from + diggerCount(member);
    for (SoftObject* const* digger = from; digger < end && !member.recalc(); ++digger)
        if ((*digger)->recalc() && (*digger)->inRange(member))
            member.setRecalc();
    if (!member.recalc())
        return;
    for (SoftObject* const* digger = from; digger < end; ++digger)
        if (member.inRange(**digger))
            (*digger)->setRecalc();
}

SoftObject* const* Bodies::members(const SoftObject& object) const
{
    return members_ + bySlot_[object.slot()].first;
}

int Bodies::memberCount(const SoftObject& object) const
{
    return bySlot_[object.slot()].size;
}

SoftObject* const* Bodies::diggers(const SoftObject& object) const
{
    return diggers_ + bySlot_[object.slot()].firstDigger;
}

int Bodies::diggerCount(const SoftObject& object) const
{
    return bySlot_[object.slot()].diggerCount;
}

