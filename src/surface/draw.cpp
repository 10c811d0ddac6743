// How settled seeds become a list of voxels by default (report, Section III, draw()): those of the patches that may be seen,
// each laid in the view when it was not before.
#include "surface/shade.h"
#include "model/softobj.h"

namespace {

// Depth, 1/32 unit, before which the whole cell of a seed at rest is covered: near the viewer a ring is no straight band in
// the picture.
constexpr int32_t WHOLE_BEFORE = 37 * 32;

// Steps of brightness from a seed at rest to the next, up to which each scale of a ball has one alone.
constexpr int COARSE = 16;
// -z of a normal scaled by 2^14: no way across the picture is taken for more than about twice that on the surface.
constexpr int32_t TILTED_MOST = 7000;

constexpr int LISTED_MOST = 12;  // regular seeds of a patch

// Lists those of a patch that are seen, unless it meets one that does not lie in the view yet: then false, and `to` as it
// was. Without a loop, for it is done for most seeds of a frame. `end` is behind the patch's seeds, `count` of which
// (1..LISTED_MOST) are regular ones; `extras`: the oversampled ones between are meant too.
inline bool listKept(const Seed* end, int count, bool extras, const Voxel**& to)
{
    const Voxel** at = to;
#define LIST(i) \
    if (end[-(i)].flags & SEED_FRONT) { \
        if (!(end[-(i)].flags & SEED_KEPT)) \
            return false; \
        *at++ = &end[-(i)].voxel; \
    } \
    [[fallthrough]]
    if (!extras) {
        switch (count) {
        default: LIST(24);
        case 11: LIST(22);
        case 10: LIST(20);
        case 9: LIST(18);
        case 8: LIST(16);
        case 7: LIST(14);
        case 6: LIST(12);
        case 5: LIST(10);
        case 4: LIST(8);
        case 3: LIST(6);
        case 2: LIST(4);
        case 1: LIST(2);
        case 0: break;
        }
    } else {
        switch (count) {
        default: LIST(24); case -1: LIST(23);
        case 11: LIST(22); case -2: LIST(21);
        case 10: LIST(20); case -3: LIST(19);
        case 9: LIST(18); case -4: LIST(17);
        case 8: LIST(16); case -5: LIST(15);
        case 7: LIST(14); case -6: LIST(13);
        case 6: LIST(12); case -7: LIST(11);
        case 5: LIST(10); case -8: LIST(9);
        case 4: LIST(8); case -9: LIST(7);
        case 3: LIST(6); case -10: LIST(5);
        case 2: LIST(4); case -11: LIST(3);
        case 1: LIST(2); case -12: LIST(1);
        case 0: break;
        }
    }
#undef LIST
    to = at;
    return true;
}

}  // namespace

// Lays the seeds at rest of one object in the view, and lists what is seen of it.
class Lister {
public:
    // SoftObject::draw()
    static void list(SoftObject& object, const Look& look, VoxelList& list, int room, int* next);

private:
    static void setUp();
    static void drift();
    REGISTERS SELDOM static void lookFrom(int root);
    REGISTERS SELDOM static void lay(Seed& s, int32_t along);
    REGISTERS SELDOM static void shadeAcross(Seed& s);
    template <bool AGAIN, int STEP>
    REGISTERS SELDOM static void layRun(Seed* s, const Seed* end);

    // One object is listed at a time. At fixed addresses all this needs no register to find it.
    static inline SoftObject* o_;
    static inline const Look* look_;
    static inline EyeSide eye_;
    static inline Skew skew_;
    static inline ShadeSetup light_;
    static inline Real horizon_;        // of the object in general
    static inline int32_t change_;      // of the brightness, 1/8 step a unit for a unit of light, 8 bits of fraction; 0: none
    static inline int root_;            // what eye_ and skew_ are set for
    static inline Vector rootPlace_;    // from the centre
};

void Lister::setUp()
{
    eye_.set(look_->eye - o_->centre_, o_->radius_, o_->coreReach());
    horizon_ = o_->horizonRadius(look_->eye);
    eye_.horizon(horizon_);
    light_.set(look_->light, o_->spacing_);
    change_ = 0;
    if (o_->isBall() && o_->spacing_ * Real(BRIGHTEST) > o_->radius_ * Real(COARSE))
        change_ = mulDiv(8 * BRIGHTEST << 8, 65536, rawFromReal(o_->radius_));
    root_ = -1;
}

// Adds up how far the viewer has moved.
void Lister::drift()
{
    const Vector moved = (look_->eye - o_->centre_) - o_->eyeDrawn_;
    const Real most(100);
    const Vector limited{clamp(moved.x, -most, most), clamp(moved.y, -most, most), clamp(moved.z, -most, most)};
    const int32_t steps = rawFromReal(nearLength(limited)) >> 10;
    // Less is left to add up, or slow moves would count for nothing.
    if (steps >= SoftObject::DRIFT_LEAST) {
        o_->drift_ = static_cast<uint16_t>(o_->drift_ + steps);
        o_->eyeDrawn_ = look_->eye - o_->centre_;
    }
}

void Lister::lookFrom(int root)
{
    root_ = root;
    skew_.root(o_->roots_[root] - look_->eye, o_->radius_);
    rootPlace_ = o_->roots_[root] - o_->centre_;
    eye_.root(rootPlace_);
    if (o_->rootCount_ > 1)
        eye_.horizon(o_->horizonAt(o_->roots_[root], horizon_));
    if (o_->tapers_)
        eye_.rootRadius(o_->tangentAt(o_->roots_[root]));
}

// How a seed at rest that is seen lies in the view, for as long as the object stays about where it is.
void Lister::lay(Seed& s, int32_t along)
{
    s.flags |= SEED_FRONT | SEED_KEPT;
    const int32_t depth = skew_.depth(s.path);
    light_.restExtents(s, skew_.x(s.path), skew_.y(s.path), depth < WHOLE_BEFORE);
    layDown(s.dirX, s.dirY, eye_.restFacing(along), depth, eye_.horizon(), s);
    s.voxel.x = rawFromReal(rootPlace_.x + s.path.x) >> 8;
    s.voxel.y = rawFromReal(rootPlace_.y + s.path.y) >> 8;
    s.voxel.z = rawFromReal(rootPlace_.z + s.path.z) >> 8;
    if (change_ != 0)
        shadeAcross(s);
}

// How the brightness changes across a seed at rest: on a ball the normal changes by 1 / radius along the surface.
void Lister::shadeAcross(Seed& s)
{
    const Normal light = light_.light();
    const int32_t z = s.dirZ > -TILTED_MOST ? -TILTED_MOST : s.dirZ;
    const auto change = [&](int32_t across, int32_t lit) {
        return static_cast<int32_t>(static_cast<int64_t>(change_) * (lit - mulDiv(across, light.z, z)) >> 22);
    };
    setSlopes(s.voxel, change(s.dirX, light.x), change(s.dirY, light.y), EVEN_SMALL);
}

// Lays every STEPth seed of a run that is at rest; without AGAIN only those that have come to rest just now.
template <bool AGAIN, int STEP>
void Lister::layRun(Seed* s, const Seed* end)
{
    // A seed that may be seen at rest is VALID and not PLACED; one that has come to rest is FRONT and not KEPT besides.
    constexpr int MASK = AGAIN ? SEED_VALID | SEED_PLACED : SEED_FRONT | SEED_KEPT, WANTED = AGAIN ? SEED_VALID : SEED_FRONT;
    for (; s < end; s += STEP) {
        if ((s->flags & MASK) != WANTED)
            continue;
        if (s->root != root_)
            lookFrom(s->root);
        const int32_t along = eye_.along(*s);
        if (eye_.seen(along))
            lay(*s, along);
        else
            s->flags = static_cast<uint8_t>((s->flags & ~SEED_FRONT) | SEED_KEPT);
    }
}

void Lister::list(SoftObject& object, const Look& look, VoxelList& list, int room, int* next)
{
    static_assert(SoftObject::PATCH_SEEDS <= LISTED_MOST, "a patch is listed as a whole");
    o_ = &object;
    look_ = &look;
    setUp();
    const int p = *next;
    if (p == 0)
        drift();
    const Voxel** to = list.voxels;
    const Voxel** const full = to + room - 4 * SoftObject::PATCH_SEEDS;
    const uint16_t drift = o_->drift_;
    // The nearer he is the more a move turns what he sees.
    const int32_t away = eye_.distance32() - (rawFromReal(shiftUp(o_->coreReach(), 1) + o_->radius_) >> 11);
    const int32_t share = away / SoftObject::DRIFT_SHARE;
    const int32_t kept = share < 1 ? 1 : share > SoftObject::DRIFT_KEPT ? SoftObject::DRIFT_KEPT : share;
    Seed* const seeds = o_->seeds_;
    SoftObject::Patch* patch = o_->patches_ + p;
    SoftObject::Patch* const last = o_->patches_ + o_->patchCount_;
    while (patch < last) {
        SoftObject::Patch& each = *patch++;
        const bool again = static_cast<int16_t>(drift - each.laid) >= 0;
        if (again) {
            each.laid = static_cast<uint16_t>(drift + kept);
            each.turned = each.state == SoftObject::PATCH_MIXED;
            each.back = each.state == SoftObject::PATCH_AT_REST
                            ? eye_.side(each.axis, each.across, each.radius32, each.spread) == EyeSide::BACK
                            : each.state != SoftObject::PATCH_MIXED;
            if (each.stale == SoftObject::STALE_ALL) {
                // What is to be turned first is judged every time until it is.
                if (each.back)
                    each.laid = drift;
                else
                    o_->posePatch(each, false);
            }
        }
        if (each.back)
            continue;
        Seed* const first = seeds + 2 * each.first;
        const Seed* const end = first + 2 * each.count;
        if (again)
            each.extras ? layRun<true, 1>(first, end) : layRun<true, 2>(first, end);
        if (!listKept(end, each.count, each.extras, to)) {
            layRun<false, 1>(first, end);
            listKept(end, each.count, each.extras, to);
        }
        if (to > full)
            break;
    }
    list.count = static_cast<int>(to - list.voxels);
    *next = patch < last ? static_cast<int>(patch - o_->patches_) : 0;
}

void SoftObject::drawQuick(const Look& look, VoxelList& list, int room, int* next)
{
    Lister::list(*this, look, list, room, next);
}
