// Lays out the seeds between regular ones when they are asked for: oversampled seeds (report, Appendix C), which are kept in
// blocks, and fine seeds between those and regular ones.
#include "cells.h"
#include "math/alloc.h"

namespace {

// The size of an oversampled seed's cell, in eighths of a regular seed's cell: it lies between seeds that have cells of their
// own.
constexpr int EXTRA_CELL = 5;

}  // namespace

// The length of the path of a seed between two others, as if the object were not stretched.
Real SoftObject::restLength(const Layout& layout, const Seed& a, const Seed& b) const
{
    return tapers_ ? shiftDown(length(unstretched(a.path)) + length(unstretched(b.path)), 1) : layout.size * restRoot_;
}

// Computes the point of the core nearest to the middle of two seeds (`*root`) and the vector from it to the middle (`*out`), as
// if the object were not stretched. Returns false if the middle lies too close to the core to give a direction.
bool SoftObject::rootBetween(const Layout& layout, const Seed& one, const Seed& other, Vector* root, Vector* out) const
{
    const Vector middle = unstretched(layout.rest(one) + layout.rest(other)) * Real(0.5);
    *out = fromCore(middle * (Real(CORE_SIZE) / layout.size)) * shiftDown(layout.size, 4);
    *root = middle - *out;
    return length(*out) >= shiftDown(layout.size, 4);
}

// Lays out the oversampled seed of regular seed `number` of a ring, half way to its neighbour N. If it has no neighbour, no
// root or no direction, the oversampled seed is a copy of the regular one.
void SoftObject::layOutExtra(Layout& layout, int number, int ring, Seed& extra) const
{
    const Seed& one = layout.seeds[number];
    extra = one;
    extra.flags = 0;
    if (one.neighbour < 0)
        return;
    const Seed& other = layout.seeds[one.neighbour >> 1];
    if (one.root == other.root) {
        extra.path = withLength(unstretched(one.path + other.path), restLength(layout, one, other));
    } else {
        // Each seed has a root of its own, or the whole ring shares one: that of its first seed with a neighbour.
        const bool shared = layout.rootsBetween[ring + 1] - layout.rootsBetween[ring] == 1;
        const int first = layout.ringStarts[ring], index = layout.rootsBetween[ring] + (shared ? 0 : number - first);
        Vector root, out;
        if (index >= ROOTS_MAX || !rootBetween(layout, one, other, &root, &out))
            return;
        const Seed* start = layout.seeds + first;
        while (start->neighbour < 0)
            ++start;
        Vector unused;
        if (shared && !rootBetween(layout, *start, layout.seeds[start->neighbour >> 1], &root, &unused))
            return;
        layout.roots[index] = stretchedOut(root);
        extra.root = static_cast<uint16_t>(index);
        extra.path = withLength(out, restLength(layout, one, other));
    }
    if (tapers_) {
        // The mean of the two lengths is only close: correct it to end where the field has the surface's value.
        Vector unused;
        const Vector rest = unstretched(layout.roots[extra.root]) + extra.path;
        const Real t = plainParam(rest * (Real(CORE_SIZE) / layout.size), &unused);
        extra.path = extra.path * (restRoot_ / squareRoot(t));
    }
    extra.path = stretchedOut(extra.path);
    for (int part = 0; part < 3; ++part) {
        extra.along[part] = static_cast<int8_t>(one.along[part] * EXTRA_CELL / 8);
        extra.across[part] = static_cast<int8_t>(one.across[part] * EXTRA_CELL / 8);
    }
}

// Returns true if a block holds oversampled seeds that are in use.
bool SoftObject::isUsed(const Seed* block)
{
    bool used = false;
    for (int i = 0; !used && i < EXTRA_BLOCK; ++i)
        used = block[i].flags != 0;
    return used;
}

// Takes the memory of a block of oversampled seeds that are no longer in use. Returns null if all blocks are in use.
Seed* SoftObject::blockFromOthers()
{
    for (int i = 0; i < laid_.blocks(); ++i) {
        Seed* const block = laid_.extras[i];
        if (block != nullptr && !isUsed(block)) {
            laid_.extras[i] = nullptr;
            return block;
        }
    }
    return nullptr;
}

// The ring of a regular seed.
int SoftObject::ringOf(int number) const
{
    int ring = 0;
    for (int after = laid_.rings; after - ring > 1;) {
        const int middle = (ring + after) >> 1;
        (laid_.ringStarts[middle] <= number ? ring : after) = middle;
    }
    return ring;
}

// Allocates a block of oversampled seeds; each is laid out when it is asked for. Returns null when there is no memory.
Seed* SoftObject::layOutBlock(int index)
{
    Seed* block = allocate<Seed>(EXTRA_BLOCK);
    if (block == nullptr)
        block = blockFromOthers();
    if (block == nullptr)
        return nullptr;
    for (int i = 0; i < EXTRA_BLOCK; ++i) {
        block[i] = Seed();
        block[i].neighbour = NOT_LAID;
    }
    laid_.extras[index] = block;
    return block;
}

Seed& SoftObject::laidExtra(int slot)
{
    // Returned when there is no memory: a copy of the regular seed, which is not drawn.
    static Seed unseen;
    const int block = slot >> (EXTRA_BITS + 1), number = slot >> 1;
    if (laid_.extras[block] == nullptr && layOutBlock(block) == nullptr) {
        unseen = seed(slot - 1);
        unseen.flags = 0;
        return unseen;
    }
    Seed& s = *extra(slot);
    if (s.neighbour != NOT_LAID)
        return s;
    Layout plain = laid_.plain();
    layOutExtra(plain, number, ringOf(number), s);
    if (warped_)
        warpExtra(plain, s);
    s.normal = restNormal(s);
    s.area = 0;
    setWay(s);
    return s;
}

bool SoftObject::layOutBetween(int i, int other)
{
    const Seed& one = regular(i);
    Seed& extra = seed(i + 1);
    if (extra.neighbour == other)
        return false;
    Layout plain = laid_.plain();
    layOutExtra(plain, i >> 1, ringOf(i >> 1), extra);
    if (warped_)
        warpExtra(plain, extra);
    if (other != one.neighbour) {
        extra.neighbour = other;
        extra.root = one.root;
        extra.path = withLength(one.path + regular(other).path, length(one.path));
    }
    extra.normal = restNormal(extra);
    extra.area = 0;
    setWay(extra);
    return true;
}

Seed* SoftObject::madeFine(int i)
{
    Seed*& block = laid_.fine[i >> (EXTRA_BITS + 1)];
    if (block == nullptr) {
        block = allocate<Seed>(FINE_SEEDS * EXTRA_BLOCK);
        for (int j = 0; block != nullptr && j < FINE_SEEDS * EXTRA_BLOCK; ++j)
            block[j].flags = 0;
    }
    return fine(i);
}

void SoftObject::layOutFine(int i, int which)
{
    const Seed &middle = seed(i + 1), &end = which == FINE_NEAR ? regular(i) : regular(middle.neighbour);
    Seed& s = fine(i)[which];
    s = middle;
    s.path = withLength(middle.path + end.path, length(middle.path));
    layAtRest(s, restNormal(s));
    setWay(s);
}

void SoftObject::layBetween(Seed& s, const Seed& a, const Seed& b, Real position, Real share) const
{
    const bool nearA = share < Real(0.5);
    const Seed &near = nearA ? a : b, &far = nearA ? b : a;
    Vector way = far.path - near.path;
    if (far.root != near.root)
        way = way + (root(far.root) - root(near.root)) * (Real(1) / position);
    s.root = near.root;
    s.path = withLength(near.path + way * (nearA ? share : Real(1) - share), length(near.path));
    setWay(s);
}

bool SoftObject::layOutExtras()
{
    for (int i = 0; i < laid_.blocks(); ++i)
        if (laid_.extras[i] == nullptr && layOutBlock(i) == nullptr)
            return false;
    // Where memory ran out, a block may have been taken from seeds that were laid out just now.
    for (int i = 0; i < laid_.blocks(); ++i)
        if (laid_.extras[i] == nullptr)
            return false;
    for (int i = 0; i < laid_.regular; ++i)
        laidExtra(2 * i + 1);
    return true;
}
