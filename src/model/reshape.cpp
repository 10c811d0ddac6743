// Warps the layout of an object: its roots, resting places and cells. The layout without the warp is kept beside it.
#include "cells.h"
#include "math/alloc.h"

// Keeps copies of a layout's seeds and roots as they are without the warp. Returns false when there is no memory.
bool SoftObject::keepPlain(Layout& layout) const
{
    layout.plainSeeds = allocate<Seed>(static_cast<uint32_t>(layout.regular));
    layout.plainRoots = allocate<Vector>(static_cast<uint32_t>(layout.rootRoom));
    if (layout.plainSeeds == nullptr || layout.plainRoots == nullptr) {
        free(layout.plainSeeds);
        free(layout.plainRoots);
        layout.plainSeeds = nullptr;
        layout.plainRoots = nullptr;
        return false;
    }
    memcpy(layout.plainSeeds, layout.seeds, sizeof(Seed) * static_cast<size_t>(layout.regular));
    memcpy(layout.plainRoots, layout.roots, sizeof(Vector) * static_cast<size_t>(layout.rootRoom));
    for (int i = 0; i < layout.regular; ++i)
        layout.plainSeeds[i].normal = plainNormal(layout.rest(layout.seeds[i]), layout.seeds[i].path);
    return true;
}

// Warps a seed whose root has been warped already: its resting place, its cell, and its normal if it is at rest. Returns the
// normal at the resting place.
Direction14 SoftObject::warpSeed(const Seed& plain, const Vector& plainRoot, Seed& to, Warp::Way& way) const
{
    to.path = warp_.out((plainRoot + plain.path) * (Real(CORE_SIZE) / laid_.size), way) * shiftDown(laid_.size, 4) - root(to.root);
    const auto cell = [&](const int8_t from[3], int8_t into[3]) {
        setAxis(into, warp_.stepOut(way, vectorOf(from)), Real(1));
    };
    cell(plain.along, to.along);
    cell(plain.across, to.across);
    setWay(to);
    const Direction14 normal = direction(warp_.slopeOut(way, unitVector(plain.normal)));
    setArea(to, normal);
    if (to.flags & SEED_RESTING)
        layAtRest(to, normal);
    return normal;
}

// Warps an oversampled seed, as layOutExtra() left it, and its root.
void SoftObject::warpExtra(const Layout& plain, Seed& s) const
{
    const Seed before = s;
    Warp::Way way;
    const Vector& plainRoot = plain.roots[s.root];
    laid_.roots[s.root] = warp_.out(plainRoot * (Real(CORE_SIZE) / laid_.size), way) * shiftDown(laid_.size, 4);
    warpSeed(before, plainRoot, s, way);
}

// Warps roots and resting places; paths lead straight from one to the other. Seeds keep their positions along the paths.
void SoftObject::reshape()
{
    const Real inward = Real(CORE_SIZE) / laid_.size, outward = shiftDown(laid_.size, 4);
    Warp::Way way;
    findSteps();
    laid_.longest = Real(0);
    for (int i = 0; i < laid_.rootsBetween[0]; ++i)
        laid_.roots[i] = warp_.out(laid_.plainRoots[i] * inward, way) * outward;
    for (int i = 0; i < laid_.regular; ++i) {
        Seed& plain = laid_.plainSeeds[i];
        plain.border = warpSeed(plain, laid_.plainRoots[plain.root], laid_.seeds[i], way);
        // No vector is longer than the sum of its components. (A twist turns the end of a path far away from its root.)
        const Vector& path = laid_.seeds[i].path;
        laid_.longest = max(laid_.longest, absolute(path.x) + absolute(path.y) + absolute(path.z));
    }
    // Fine seeds are made again when they are needed.
    for (int at = 0; at < laid_.blocks(); ++at) {
        free(laid_.fine[at]);
        laid_.fine[at] = nullptr;
    }
    // Only oversampled seeds in use are warped; the others are laid out again when they are needed.
    Layout plain = laid_.plain();
    for (int at = 0; at < laid_.blocks(); ++at) {
        Seed* const block = laid_.extras[at];
        if (block != nullptr && !isUsed(block)) {
            free(block);
            laid_.extras[at] = nullptr;
            continue;
        }
        for (int i = 0; block != nullptr && i < EXTRA_BLOCK; ++i) {
            const int number = (at << EXTRA_BITS) + i;
            Seed& s = block[i];
            if (number >= laid_.regular || s.neighbour == NOT_LAID)
                continue;
            Seed fresh;
            layOutExtra(plain, number, ringOf(number), fresh);
            warpExtra(plain, fresh);
            s.path = fresh.path;
            memcpy(s.along, fresh.along, sizeof s.along);
            memcpy(s.across, fresh.across, sizeof s.across);
            setWay(s);
            if (s.flags & SEED_RESTING)
                layAtRest(s, restNormal(s));
        }
    }
}
