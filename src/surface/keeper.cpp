// Keeps voxels from frame to frame, and corrects how they go on whenever they are made anew.
#include "keeper.h"

#include "math/alloc.h"
#include "math/whole.h"
#include "period.h"
#include "rt.h"
#include "voxels.h"

namespace {

// In the units of Keeper::View: a change of the view counts as even if it differs from the change before by no more than JOLT and a
// quarter of itself, and if neither an axis nor the light changes by more than FASTEST: what turns fast does not go on straight.
constexpr int32_t JOLT = 24, FASTEST = 500;
// Frames in which nothing is kept after a change with an error of UNEVEN_ERRORS times the tolerated one.
constexpr uint8_t PAUSE = 32;
constexpr int32_t UNEVEN_ERRORS = 8;
// Greater than any error that is tolerated: a limb has come or gone.
constexpr int32_t OTHERWISE = 1 << 14;
// Steps as long as this count as errors, so that nothing overflows in a period.
constexpr int32_t LONG_STEP = 1024;
static_assert(STEEPEST_TILT + LONG_STEP * LONGEST_PERIOD <= INT16_MAX, "tilts fit 16 bits");
static_assert((BRIGHTEST + 1) * 256 + LONG_STEP * LONGEST_PERIOD <= INT16_MAX, "brightness fits 16 bits");

bool isSame(const int32_t a[3], const int32_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// Whether an object is seen and lit in two frames from the same places.
bool isSame(const OwnFrame& a, const OwnFrame& b)
{
    return isSame(a.eye32, b.eye32) && isSame(a.centre, b.centre) && isSame(a.light, b.light) && isSame(a.right, b.right) &&
           isSame(a.up, b.up) && isSame(a.ahead, b.ahead) && a.growth == b.growth && a.distance32 == b.distance32;
}

}  // namespace

Keeper::~Keeper()
{
    for (int i = 0; i < count_; ++i)
        free(kept_[i].voxels);
    free(kept_);
}

void Keeper::open(int count, Real spacing)
{
    // Voxels of what rests are made anew more quickly than seeds are settled, so that less has to be tolerated.
    tolerated_ = toleratedError(spacing) / 2;
    kept_ = allocate<Kept>(static_cast<uint32_t>(count));
    count_ = kept_ == nullptr ? 0 : count;
    for (int i = 0; i < count_; ++i)
        kept_[i] = Kept{};
}

void Keeper::begin(const OwnFrame& own, const Paint* paint)
{
    if (count_ == 0)
        return;
    const int32_t paintedAs = paint == nullptr ? -1 : paint->finish << 8 | paint->number;
    if (paintedAs != paintedAs_)
        draws_ = 0;
    paintedAs_ = paintedAs;
    stands_ = draws_ > 0 && isSame(own, own_);
    draws_ = min32(draws_ + 1, 3);
    ++frame_;
    motion_ = UNKNOWN;
    int32_t* to = views_[frame_ % 3];
    const int32_t* const parts[] = {own.right, own.up, own.ahead, own.light, own.eye32};
    for (const int32_t* part : parts)
        for (int i = 0; i < 3; ++i)
            *to++ = part[i];
    if (stands_)
        return;
    ++since_;
    own_ = own;
}

// Whether the view changes as it did in the frame before.
bool Keeper::movesEvenly()
{
    if (motion_ == UNKNOWN) {
        const View &now = views_[frame_ % 3], &before = views_[(frame_ + 2) % 3], &earlier = views_[(frame_ + 1) % 3];
        motion_ = draws_ == 3 ? EVEN : UNEVEN;
        for (int i = 0; i < PARTS && motion_ == EVEN; ++i) {
            const int32_t change = now[i] - before[i], changeBefore = before[i] - earlier[i];
            const bool fast = i < AXES && magnitude(change) > FASTEST;
            if (fast || magnitude(change - changeBefore) > JOLT + (magnitude(change) >> 2))
                motion_ = UNEVEN;
        }
    }
    return motion_ == EVEN;
}

void Keeper::list(int number, const Seed* seeds, VoxelList& list, Slopes& slopes)
{
    Kept& kept = kept_[number];
    for (One *one = kept.voxels, *const end = one + kept.count; one < end; ++one) {
        if (!stands_)
            one->goOn();
        Voxel* const voxel = list.room();
        *voxel = one->voxel;
        list.number[list.count] = static_cast<uint8_t>(paintedAs_);
        list.take();
        const int32_t seed = one->added.number;
        if (seed != Slopes::NONE)
            slopes.add(seeds + seed, seed, voxel, one->added.sight);
    }
    list.bordered |= kept.bordered;
    if (!stands_)
        --kept.left;
    kept.drawn = stands_ ? 0 : frame_;
}

void Keeper::store(Kept& kept, const Patch& patch, int first, const VoxelList& list, int sloped, const Slopes& slopes) const
{
    const int count = list.count - first;
    const bool follows = kept.drawn == frame_ - 1 && kept.left == 0 && kept.count == count && kept.state == patch.state;
    kept.since = 0;
    if (kept.pause > 0 && !stands_) {
        --kept.pause;
        return;
    }
    if (count > kept.room) {
        free(kept.voxels);
        kept.voxels = allocate<One>(static_cast<uint32_t>(count));
        kept.room = static_cast<uint8_t>(kept.voxels == nullptr ? 0 : count);
        kept.drawn = 0;
        if (kept.room == 0)
            return;
    }
    // What stands has no steps that would be known when it moves.
    kept.drawn = stands_ ? 0 : frame_;
    if (stands_) {
        for (int i = 0; i < count; ++i)
            kept.voxels[i].set(list.voxels[first + i]);
    } else if (follows) {
        follow(kept, list.voxels + first);
    } else {
        for (int i = 0; i < count; ++i)
            kept.voxels[i] = One(list.voxels[first + i]);
        kept.stepsKnown = false;
        kept.period = 1;
        kept.left = 0;
    }
    for (int i = sloped; i < slopes.count(); ++i)
        kept.voxels[slopes.voxel(i) - list.voxels - first].added = slopes.added(i);
    kept.count = static_cast<uint8_t>(count);
    kept.state = patch.state;
    kept.bordered = list.bordered;
    kept.since = since_;
}

// Corrects the steps of voxels that have been made anew at the end of a period, and sets the next period.
void Keeper::follow(Kept& kept, const Voxel* voxels) const
{
    const int shift = __builtin_ctz(kept.period);
    int32_t error = 0;
    for (int i = 0; i < kept.count; ++i)
        error |= kept.voxels[i].follow(voxels[i], shift);
    int period = kept.stepsKnown ? periodAfter(kept.period, error, tolerated_) : 1;
    // A patch that shows nothing may turn into sight.
    if (kept.count == 0)
        period = min32(period, 2);
    if (kept.stepsKnown && error >= tolerated_ * UNEVEN_ERRORS)
        kept.pause = PAUSE;
    kept.stepsKnown = true;
    kept.period = static_cast<uint8_t>(period);
    kept.left = static_cast<uint8_t>(period - 1);
}

// ---- One voxel

Keeper::One::One(const Voxel& v)
    : voxel(v), added{Slopes::NONE, 0}, place{v.x * 16, v.y * 16, v.z * 16}, step{0, 0, 0},
      light(static_cast<int16_t>(v.brightness * 256 + 128)), stepLight(0), reach(static_cast<int16_t>(v.reach * 128)), stepReach(0),
      stepTiltX(0), stepTiltY(0), stepCutAt(0)
{
}

// Takes a step.
inline void Keeper::One::goOn()
{
    voxel.x = (place[0] += step[0]) >> 4;
    voxel.y = (place[1] += step[1]) >> 4;
    voxel.z = (place[2] += step[2]) >> 4;
    voxel.tiltX = static_cast<int16_t>(voxel.tiltX + stepTiltX);
    voxel.tiltY = static_cast<int16_t>(voxel.tiltY + stepTiltY);
    if (stepLight != 0) {
        light = static_cast<int16_t>(light + stepLight);
        const int32_t darkest = voxel.brightness < 0 ? DARK_MIDDLE + 1 : 0;
        voxel.brightness = static_cast<int8_t>(max32(min32(light >> 8, BRIGHTEST), darkest));
    }
    if (voxel.reach == 0)
        return;
    reach = static_cast<int16_t>(max32(min32(reach + stepReach, REACH_MOST * 128), 128));
    voxel.reach = static_cast<uint8_t>(reach >> 7);
    voxel.cutAt = static_cast<int16_t>(limited(voxel.cutAt + stepCutAt, CUT_MOST));
}

// Takes the voxel as it has been made anew, and corrects the steps, of which 2^shift were made. Returns about the error in units of
// 1/256; a step of brightness counts as 1/32 unit, and the reach half. Several errors are or-ed, because that is quicker than to
// find the greatest.
inline int32_t Keeper::One::follow(const Voxel& v, int shift)
{
    const int32_t to[] = {v.x * 16, v.y * 16, v.z * 16}, lightTo = v.brightness * 256 + 128;
    int32_t error = 0;
    for (int i = 0; i < 3; ++i) {
        error |= correctStep(to[i], place[i], shift, step[i]) >> 4;
        place[i] = to[i];
    }
    error |= correctStep(v.tiltX, voxel.tiltX, shift, stepTiltX) | correctStep(v.tiltY, voxel.tiltY, shift, stepTiltY);
    error |= correctStep(lightTo, light, shift, stepLight) >> 5;
    light = static_cast<int16_t>(lightTo);
    const int32_t reachTo = v.reach * 128;
    if (v.reach != 0 && voxel.reach != 0) {
        error |= correctStep(reachTo, reach, shift, stepReach) >> 5 | correctStep(v.cutAt, voxel.cutAt, shift, stepCutAt) >> 1;
    } else if (v.reach != voxel.reach) {
        stepReach = stepCutAt = 0;
        error = OTHERWISE;
    }
    reach = static_cast<int16_t>(reachTo);
    error |= (magnitude(stepTiltX) | magnitude(stepTiltY) | magnitude(stepLight)) & ~(LONG_STEP - 1);
    set(v);
    return error;
}
