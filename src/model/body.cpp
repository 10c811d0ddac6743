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
    free(complete_);
    weights_ = nullptr;
    plain_ = nullptr;
    members_ = nullptr;
    first_ = nullptr;
    size_ = nullptr;
    complete_ = nullptr;
    count_ = 0;
}

bool Bodies::find(SoftObject* const* objects, int count)
{
    release();
    const uint32_t n = static_cast<uint32_t>(count);
    weights_ = allocate<Real>(n * n);
    plain_ = allocate<uint32_t>(n * LINK_WORDS);
    members_ = allocate<SoftObject*>(n);
    first_ = allocate<int16_t>(n);
    size_ = allocate<int16_t>(n);
    complete_ = allocate<bool>(n);
    if (weights_ == nullptr || plain_ == nullptr || members_ == nullptr || first_ == nullptr || size_ == nullptr ||
        complete_ == nullptr) {
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
    for (int i = 0; i < count; ++i)
        for (const List<Link>::Node* node = objects[i]->skel().first(); node != nullptr; node = node->next)
            weights_[i * count + node->item.object->slot()] = node->item.weight;
    for (int i = 0; i < count * LINK_WORDS; ++i)
        plain_[i] = 0;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
            if (weights_[i * count + j] == Real(1))
                plain_[i * LINK_WORDS + j / 32] |= 1u << j % 32;
    // Each body is filled from its first object on, breadth first.
    int filled = 0;
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
        bool complete = true;
        for (int a = begin; a < filled; ++a)
            for (int b = begin; b < a; ++b)
                complete = complete && weight(members_[a]->slot(), members_[b]->slot()) != Real(0);
        for (int at = begin; at < filled; ++at) {
            size_[members_[at]->slot()] = static_cast<int16_t>(filled - begin);
            complete_[members_[at]->slot()] = complete;
        }
    }
    return true;
}

void Bodies::spreadRecalc() const
{
    for (int at = 0; at < count_; ++at) {
        const SoftObject& moved = *members_[at];
        const int slot = moved.slot();
        if (complete_[slot] || !moved.recalc())
            continue;
        for (int i = first_[slot]; i < first_[slot] + size_[slot]; ++i) {
            SoftObject& other = *members_[i];
            if (!other.recalc() && weight(slot, other.slot()) == Real(0) && moved.inRange(other))
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
