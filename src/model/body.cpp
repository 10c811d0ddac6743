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
    const uint32_t n = static_cast<uint32_t>(count);
    uint32_t dents = 0;
    for (int i = 0; i < count; ++i)
        for (const List<Link>::Node* node = objects[i]->dents().first(); node != nullptr; node = node->next)
            ++dents;
    weights_ = allocate<Real>(n * n);
    plain_ = allocate<uint32_t>(n * LINK_WORDS);
    members_ = allocate<SoftObject*>(n);
    first_ = allocate<int16_t>(n);
    size_ = allocate<int16_t>(n);
    diggers_ = allocate<SoftObject*>(dents + 1);
    firstDigger_ = allocate<int16_t>(n);
    diggerCount_ = allocate<int16_t>(n);
    complete_ = allocate<bool>(n);
    if (weights_ == nullptr || plain_ == nullptr || members_ == nullptr || first_ == nullptr || size_ == nullptr ||
        diggers_ == nullptr || firstDigger_ == nullptr || diggerCount_ == nullptr || complete_ == nullptr) {
        release();
        return false;
    }
    count_ = count;
    ++version_;
    for (int i = 0; i < count; ++i) {
        objects[i]->setSlot(i);
        first_[i] = -1;
        for (int j = 0; j < count; ++j)
            weights_[i * count + j] = Real(0);
    }
    for (int i = 0; i < count; ++i) {
        for (const List<Link>::Node* node = objects[i]->skel().first(); node != nullptr; node = node->next)
            weights_[i * count + node->item.object->slot()] = node->item.weight;
        for (const List<Link>::Node* node = objects[i]->dents().first(); node != nullptr; node = node->next)
            weights_[i * count + node->item.object->slot()] -= node->item.weight;
    }
    for (int i = 0; i < count * LINK_WORDS; ++i)
        plain_[i] = 0;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
            if (weights_[i * count + j] == Real(1))
                plain_[i * LINK_WORDS + j / 32] |= 1u << j % 32;
    // Each body is filled from its first object on, breadth first.
    int filled = 0, diggers = 0;
    for (int i = 0; i < count; ++i) {
        if (first_[i] >= 0)
            continue;
        const int begin = filled;
        members_[filled++] = objects[i];
        first_[i] = static_cast<int16_t>(begin);
        for (int at = begin; at < filled; ++at) {
            for (const List<Link>::Node* node = members_[at]->skel().first(); node != nullptr; node = node->next) {
                SoftObject* other = node->item.object;
                if (first_[other->slot()] >= 0 || node->item.weight == Real(0))
                    continue;
                first_[other->slot()] = static_cast<int16_t>(begin);
                members_[filled++] = other;
            }
        }
        const int firstDigger = diggers;
        findDiggers(begin, filled, &diggers);
        bool complete = diggers == firstDigger;
        for (int a = begin; a < filled; ++a)
            for (int b = begin; b < filled; ++b)
                complete = complete && (a == b || weight(members_[a]->slot(), members_[b]->slot()) != Real(0));
        for (int at = begin; at < filled; ++at) {
            size_[members_[at]->slot()] = static_cast<int16_t>(filled - begin);
            complete_[members_[at]->slot()] = complete;
        }
    }
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
        for (int i = 0; i < diggerCount_[slot] && !moved.recalc(); ++i) {
            const SoftObject& digger = *diggers_[firstDigger_[slot] + i];
            if (digger.recalc() && digger.inRange(moved))
                members_[at]->setRecalc();
        }
        for (int i = 0; i < diggerCount_[slot] && moved.recalc(); ++i) {
            SoftObject& digger = *diggers_[firstDigger_[slot] + i];
            if (moved.inRange(digger))
                digger.setRecalc();
        }
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

