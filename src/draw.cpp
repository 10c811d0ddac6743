// How settled seeds become a list of voxels by default (report, Section III, draw()): those of the patches that may be seen,
// each laid in the view when it was not before.
#include "shade.h"
#include "softobj.h"

namespace {

// Depth, 1/32 unit, before which the whole cell of a seed at rest is covered: near the viewer a ring is no straight band in
// the picture.
constexpr int32_t WHOLE_BEFORE = 37 * 32;

}  // namespace

// How a seed at rest lies in the view, for as long as the object stays about where it is. False: it cannot be seen.
inline bool SoftObject::layAtRest(Seed& s, const Vector& root, const EyeSide& eye, const Skew& skew, const ShadeSetup& shadeSetup)
{
    s.flags |= SEED_KEPT;
    const int32_t along = eye.along(s);
    if (!eye.seen(along)) {
        s.flags = static_cast<uint8_t>(s.flags & ~SEED_FRONT);
        return false;
    }
    const int32_t depth = skew.depth(s.path);
    shadeSetup.restExtents(s, skew.x(s.path), skew.y(s.path), depth < WHOLE_BEFORE);
    int32_t shiftX, shiftY;
    layDown(s.dirX, s.dirY, eye.restFacing(along), depth, eye.horizon(), s, shiftX, shiftY);
    s.voxel.x = (rawFromReal(root.x + s.path.x) >> 8) + shiftX;
    s.voxel.y = (rawFromReal(root.y + s.path.y) >> 8) + shiftY;
    s.voxel.z = rawFromReal(root.z + s.path.z) >> 8;
    return true;
}

void SoftObject::drawQuick(const Look& look, VoxelList& list, int room, int* next)
{
    EyeSide eye;
    eye.set(look.eye - centre_, radius_, coreReach());
    const Real horizon = horizonRadius(look.eye);
    const bool manyRoots = rootCount_ > 1;
    eye.horizon(horizon);
    ShadeSetup shadeSetup;
    shadeSetup.set(look.light, spacing_);
    const int p = *next;
    if (p == 0) {
        const Vector moved = (look.eye - centre_) - eyeDrawn_;
        const Real most(100);
        const Vector limited{clamp(moved.x, -most, most), clamp(moved.y, -most, most), clamp(moved.z, -most, most)};
        const int32_t steps = rawFromReal(nearLength(limited)) >> 10;
        // Less is left to add up, or slow moves would count for nothing.
        if (steps >= DRIFT_LEAST) {
            drift_ = static_cast<uint16_t>(drift_ + steps);
            eyeDrawn_ = look.eye - centre_;
        }
    }
    int root = -1;
    Skew skew;
    Vector rootPlace{Real(0), Real(0), Real(0)};  // from the centre
    const auto lookFrom = [&](int r) {
        if (r == root)
            return;
        root = r;
        skew.root(roots_[root] - look.eye, radius_);
        rootPlace = roots_[root] - centre_;
        eye.root(rootPlace);
        if (manyRoots)
            eye.horizon(horizonAt(roots_[root], horizon));
        if (tapers_)
            eye.rootRadius(tangentAt(roots_[root]));
    };
    const Voxel** to = list.voxels;
    const Voxel** const full = to + room - 4 * PATCH_SEEDS;
    const uint16_t drift = drift_;
    // The nearer he is the more a move turns what he sees.
    const int32_t away = eye.distance32() - (rawFromReal(shiftUp(coreReach(), 1) + radius_) >> 11);
    const int32_t kept = away / DRIFT_SHARE < 1 ? 1 : away / DRIFT_SHARE > DRIFT_KEPT ? DRIFT_KEPT : away / DRIFT_SHARE;
    Seed* const seeds = seeds_;
    Patch* patch = patches_ + p;
    Patch* const last = patches_ + patchCount_;
    for (; patch < last && to <= full; ++patch) {
        bool again = false;
        if (static_cast<int16_t>(drift - patch->laid) >= 0 || patch->stale == STALE_ALL) {
            again = true;
            patch->laid = static_cast<uint16_t>(drift + kept);
            patch->turned = patch->state == PATCH_MIXED;
            patch->back = patch->state == PATCH_AT_REST
                              ? eye.side(patch->axis, patch->across, patch->radius32, patch->spread) == EyeSide::BACK
                              : patch->state != PATCH_MIXED;
        }
        if (patch->back)
            continue;
        if (patch->stale == STALE_ALL)
            posePatch(*patch, false);
        Seed* s = seeds + 2 * patch->first;
        const Seed* const end = s + 2 * patch->count;
        const int step = patch->extras ? 1 : 2;
        if (again) {
            for (Seed* each = s; each < end; each += step)
                if ((each->flags & (SEED_VALID | SEED_PLACED)) == SEED_VALID)
                    each->flags = static_cast<uint8_t>((each->flags & ~SEED_KEPT) | SEED_FRONT);
        }
        for (; s < end; s += step) {
            if (!(s->flags & SEED_FRONT))
                continue;
            if (!(s->flags & SEED_KEPT)) {
                lookFrom(s->root);
                if (!layAtRest(*s, rootPlace, eye, skew, shadeSetup))
                    continue;
            }
            *to++ = &s->voxel;
        }
    }
    list.count = static_cast<int>(to - list.voxels);
    *next = patch < last ? static_cast<int>(patch - patches_) : 0;
}
