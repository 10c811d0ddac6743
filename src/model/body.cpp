// Which objects make up one body, and with which weights.
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
    free(plain_);
    free(members_);
    free(first_);
    free(size_);
    free(diggers_);
    free(firstDigger_);
    free(diggerCount_);
    free(complete_);
    weights_ = nullptr;
    plain_ = nullptr;
    members_ = nullptr;
    first_ = nullptr;
    size_ = nullptr;
    diggers_ = nullptr;
    firstDigger_ = nullptr;
    diggerCount_ = nullptr;
    complete_ = nullptr;
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
        first_[i] = -1;
    }
    setWeights(objects);
    int filled = 0, diggers = 0;
    for (int i = 0; i < count; ++i) {
        if (first_[i] >= 0)
            continue;
        const int begin = filled, firstDigger = diggers;
        findMembers(objects[i], &filled);
        findDiggers(begin, filled, &diggers);
        const bool complete = diggers == firstDigger && allLinked(begin, filled);
        for (int at = begin; at < filled; ++at) {
            size_[members_[at]->slot()] = static_cast<int16_t>(filled - begin);
            complete_[members_[at]->slot()] = complete;
        }
    }
    return true;
}

// Room for all that is known of so many objects. False: no memory.
bool Bodies::reserve(SoftObject* const* objects, uint32_t count)
{
    uint32_t dents = 0;
    for (uint32_t i = 0; i < count; ++i)
        for (const List<Link>::Node* node = objects[i]->dents().first(); node != nullptr; node = node->next)
            ++dents;
    weights_ = allocate<Real>(count * count);
    plain_ = allocate<uint32_t>(count * LINK_WORDS);
    members_ = allocate<SoftObject*>(count);
    first_ = allocate<int16_t>(count);
    size_ = allocate<int16_t>(count);
    diggers_ = allocate<SoftObject*>(dents + 1);
    firstDigger_ = allocate<int16_t>(count);
    diggerCount_ = allocate<int16_t>(count);
    complete_ = allocate<bool>(count);
    return weights_ != nullptr && plain_ != nullptr && members_ != nullptr && first_ != nullptr && size_ != nullptr &&
           diggers_ != nullptr && firstDigger_ != nullptr && diggerCount_ != nullptr && complete_ != nullptr;
}

// Objects have their slots.
void Bodies::setWeights(SoftObject* const* objects)
{
    for (int i = 0; i < count_ * count_; ++i)
        weights_[i] = Real(0);
    for (int i = 0; i < count_; ++i) {
        Real* const row = weights_ + i * count_;
        for (const List<Link>::Node* node = objects[i]->skel().first(); node != nullptr; node = node->next)
            row[node->item.object->slot()] = node->item.weight;
        for (const List<Link>::Node* node = objects[i]->dents().first(); node != nullptr; node = node->next)
            row[node->item.object->slot()] -= node->item.weight;
    }
    for (int i = 0; i < count_ * LINK_WORDS; ++i)
        plain_[i] = 0;
    for (int i = 0; i < count_; ++i)
        for (int j = 0; j < count_; ++j)
            if (weight(i, j) == Real(1))
                plain_[i * LINK_WORDS + j / 32] |= 1u << j % 32;
}

// Adds an object and all that links join with it, breadth first.
void Bodies::findMembers(SoftObject* object, int* filled)
{
    const int begin = *filled;
    members_[(*filled)++] = object;
    first_[object->slot()] = static_cast<int16_t>(begin);
    for (int at = begin; at < *filled; ++at) {
        for (const List<Link>::Node* node = members_[at]->skel().first(); node != nullptr; node = node->next) {
            SoftObject* other = node->item.object;
            if (first_[other->slot()] >= 0 || node->item.weight == Real(0))
                continue;
            first_[other->slot()] = static_cast<int16_t>(begin);
            members_[(*filled)++] = other;
        }
    }
}

bool Bodies::allLinked(int begin, int end) const
{
    for (int a = begin; a < end; ++a)
        for (int b = begin; b < end; ++b)
            if (a != b && weight(members_[a]->slot(), members_[b]->slot()) == Real(0))
                return false;
    return true;
}

// Adds what digs into the members from `begin` to before `end`, the body filled last.
void Bodies::findDiggers(int begin, int end, int* filled)
{
    const int first = *filled;
    const auto known = [&](const SoftObject* object) {
        for (int i = first; i < *filled; ++i)
            if (diggers_[i] == object)
                return true;
        return first_[object->slot()] == begin;
    };
    for (int at = begin; at < end && members_[begin]->hasSurface(); ++at)
        for (const List<Link>::Node* node = members_[at]->dents().first(); node != nullptr; node = node->next)
            if (node->item.weight != Real(0) && !known(node->item.object))
                diggers_[(*filled)++] = node->item.object;
    for (int at = begin; at < end; ++at) {
        firstDigger_[members_[at]->slot()] = static_cast<int16_t>(first);
        diggerCount_[members_[at]->slot()] = static_cast<int16_t>(*filled - first);
    }
}

void Bodies::spreadRecalc() const
{
    for (int at = 0; at < count_; ++at) {
        const SoftObject& moved = *members_[at];
        const int slot = moved.slot();
        spreadByDiggers(*members_[at]);
        if (complete_[slot] || !moved.recalc())
            continue;
        for (int i = first_[slot]; i < first_[slot] + size_[slot]; ++i) {
            SoftObject& other = *members_[i];
            const bool known = weight(slot, other.slot()) != Real(0) && weight(other.slot(), slot) != Real(0);
            if (!other.recalc() && !known && moved.inRange(other))
                other.setRecalc();
        }
    }
}

// A member of a body hears from those that dig into the body, or they from it.
void Bodies::spreadByDiggers(SoftObject& member) const
{
    SoftObject* const* const from = diggers_ + firstDigger_[member.slot()];
    SoftObject* const* const end = from + diggerCount_[member.slot()];
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
    return members_ + first_[object.slot()];
}

int Bodies::memberCount(const SoftObject& object) const
{
    return size_[object.slot()];
}

SoftObject* const* Bodies::diggers(const SoftObject& object) const
{
    return diggers_ + firstDigger_[object.slot()];
}

int Bodies::diggerCount(const SoftObject& object) const
{
    return diggerCount_[object.slot()];
}

