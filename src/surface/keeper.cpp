// Keeps voxels from frame to frame, and corrects how they go on whenever they are made anew.
#include "keeper.h"

#include "math/alloc.h"
#include "math/whole.h"
#include "model/paint.h"
#include "rt.h"

namespace {

// Voxels are made anew once in a period of 1, 2, 4 or 8 frames.
constexpr int LONGEST_PERIOD = 8;
// Units: a greater spacing than COARSE counts as this one; up to FINE errors of tilt count more.
constexpr Real COARSE(2), FINE(1);
// The error of a single step that is tolerated where patches blend, 1/256 unit at a spacing of 1. It grows with the square of the
// spacing, because who wants finer seeds wants to see more: at COARSE it is 1/4 unit. Where patches rest half of it is tolerated,
// for their voxels are made anew more quickly than seeds are settled.
constexpr Real TOLERATED(16);
// Units: the neighbours travel no farther than FARTHEST in a period. If they travel farther than SWIFT in one frame nothing goes on
// where patches blend: within that frame a neighbour may come into reach of a patch and change it, which no earlier step foretells.
constexpr Real FARTHEST(4), SWIFT(3.6);
// 1/1024 unit: where neighbours travel no farther than this in a frame it makes no difference whether they stop after it.
constexpr Travel SLIGHT = 100;
// VIEW: what tells how an object is seen and lit, the axes of the view and the light (1.0 = 2^14), and the eye (1/32 unit). A
// change of one of these numbers counts as even if it differs from the change before by no more than JOLT and a quarter of itself.
// If an axis or the light changes by more than FASTEST the object turns fast.
constexpr int32_t (OwnFrame::*VIEW[])[3] = {&OwnFrame::right, &OwnFrame::up, &OwnFrame::ahead, &OwnFrame::light, &OwnFrame::eye32};
constexpr int32_t JOLT = 24, FASTEST = 500;
// If an object grows or shrinks by more than 2^-GROWS of its size in a frame nothing of it goes on: scales keep their extents while
// they do, and would part.
constexpr int GROWS = 6;
// Voxel::brightness with 8 more fraction bits: an error up to this may come from rounding alone, and corrects nothing.
constexpr int32_t ROUNDED_LIGHT = 512;
// Steps of tilt as long as this count as errors, so that nothing overflows in a period; and steps of brightness half as long, for
// what brightens so fast does so unevenly.
constexpr int32_t LONG_STEP = 2048;
static_assert((LONG_STEP & (LONG_STEP - 1)) == 0, "a power of two");
static_assert(STEEPEST_TILT + LONG_STEP * (LONGEST_PERIOD - 1) <= INT16_MAX, "tilts fit 16 bits");
static_assert((BRIGHTEST + 1) * 256 + LONG_STEP * (LONGEST_PERIOD - 1) <= INT16_MAX, "brightness fits 16 bits");
// Cosines, 1.0 = 2^14: a patch without voxels is made anew when a seed comes so near to facing the viewer. HIDDEN is smaller than
// any cosine: no seed of the patch is on the surface.
constexpr int32_t NEARLY_SEEN = 250, HIDDEN = -20000;

// Whether an object is as large in two frames, and in the same place before the viewer.
bool isInPlace(const OwnFrame& a, const OwnFrame& b)
{
    return a.centre[0] == b.centre[0] && a.centre[1] == b.centre[1] && a.centre[2] == b.centre[2] && a.growth == b.growth &&
           a.distance32 == b.distance32;
}

// Corrects a step that would have led from the value `at` to elsewhere than to `now`; 2^shift such steps have been wrong. The value
// becomes `now`. Returns about the error.
template <class Place, class Step>
inline int32_t correct(int32_t now, Place& at, Step& step, int shift)
{
    const int32_t error = now - at - step;
    at = static_cast<Place>(now);
    step = static_cast<Step>(step + (error >> shift));
    return error ^ error >> 31;
}

// The next period, from the last one and from the error at the end of that. Errors grow about with the square of the period: in one
// that is four times as long a small error will still be tolerated.
int periodAfter(int period, int32_t error, int32_t tolerated)
{
    if (error < (period == 1 ? tolerated : tolerated / 2))
        return min32(error < tolerated / 8 ? period * 4 : period * 2, LONGEST_PERIOD);
    if (period == 1 || error >= tolerated * 8)
        return 1;
    return error < (period == 2 ? tolerated * 4 : tolerated * 2) ? period : period / 2;
}

}  // namespace

Keeper::~Keeper()
{
    for (int i = 0; i < count_; ++i)
        free(kept_[i].voxels);
    free(kept_);
}

void Keeper::open(int count)
{
    const Real spacing = min(object_.spacing(), COARSE);
    tolerated_ = rawFromReal(spacing * spacing * TOLERATED) >> 16;
    kept_ = allocate<Kept>(static_cast<uint32_t>(count));
    count_ = kept_ == nullptr ? 0 : count;
    for (int i = 0; i < count_; ++i)
        kept_[i] = Kept{};
}

void Keeper::begin(const OwnFrame& own, Travel travel)
{
    if (count_ == 0)
        return;
    const SoftObject* const shown = object_.shown();
    const Paint* const paint = shown == nullptr ? nullptr : shown->paint();
    const int32_t paintedAs = paint == nullptr ? -1 : paint->finish << 8 | paint->number;
    if (paintedAs != paintedAs_)
        draws_ = 0;
    paintedAs_ = paintedAs;
    ++frame_;
    motion_ = motionOf(own);
    if (motion_ != STANDS) {
        ++viewNumber_;
        own_ = own;
    }
    // When the neighbours stop, or nearly do, nothing may go on as if they still moved.
    const bool stop = travel_ > travel * 4 + SLIGHT;
    travel_ = travel;
    longest_ = stop || travel > travelOf(SWIFT) ? 1 : LONGEST_PERIOD;
    while (longest_ > 1 && travel * static_cast<Travel>(longest_ - 1) > travelOf(FARTHEST))
        longest_ /= 2;
}

// How the object, the viewer and the light move.
Keeper::Motion Keeper::motionOf(const OwnFrame& own)
{
    int32_t* lastChange = viewChange_;
    bool jolts = absolute(own.growth - own_.growth) > shiftDown(own.growth, GROWS);
    bool fast = false;
    int32_t changes = 0;
    for (const auto part : VIEW) {
        for (int i = 0; i < 3; ++i, ++lastChange) {
            const int32_t change = (own.*part)[i] - (own_.*part)[i];
            changes |= change;
            jolts |= magnitude(change - *lastChange) > JOLT + (magnitude(change) >> 2);
            fast |= magnitude(change) > FASTEST && part != &OwnFrame::eye32;
            *lastChange = change;
        }
    }
    const bool stands = draws_ > 0 && changes == 0 && isInPlace(own, own_);
    draws_ = min32(draws_ + 1, 3);
    return stands ? STANDS : jolts || draws_ < 3 ? JOLTS : fast ? FAST : EVEN;
}

void Keeper::list(int number, bool goes, VoxelList& list, Slopes& slopes)
{
    Kept& kept = kept_[number];
    if (paintedAs_ >= 0)
        memset(list.number + list.count, paintedAs_ & 255, kept.count);
    Voxel* voxel = list.room();
    for (One *one = kept.voxels, *const end = one + kept.count; one < end; ++one, ++voxel) {
        if (goes)
            one->goOn();
        *voxel = one->voxel;
        if (one->number != NONE)
            slopes.addKept(one->seed, one->number, voxel);
    }
    list.count += kept.count;
    list.bordered |= kept.bordered;
    if (goes)
        --kept.left;
    kept.drawn = goes ? frame_ : 0;
}

// Makes room for the voxels of a patch. Returns false when there is no memory.
bool Keeper::makeRoom(Kept& kept, int count)
{
    if (count <= kept.room)
        return true;
    free(kept.voxels);
    kept.voxels = allocate<One>(static_cast<uint32_t>(count));
    kept.room = static_cast<uint8_t>(kept.voxels == nullptr ? 0 : count);
    return kept.room > 0;
}

void Keeper::store(Kept& kept, const Patch& patch, const PatchVoxels& made, bool goes, Slopes& slopes) const
{
    const bool follows = goes && kept.drawn == frame_ - 1 && kept.left == 0 && kept.state == patch.state;
    kept.viewNumber = kept.drawn = 0;
    const bool same = follows && hasSameSeeds(kept, made);
    if (!same && !(follows ? rearrange(kept, made) : clear(kept, made.count)))
        return;
    follow(kept, patch, made, follows, same);
    for (int i = made.sloped; i < slopes.count(); ++i) {
        One& one = kept.voxels[slopes.voxel(i) - made.voxels];
        one.number = slopes.number(i);
        slopes.keepIn(i, &one.voxel);
    }
    kept.count = static_cast<uint8_t>(made.count);
    kept.state = patch.state;
    kept.bordered = made.bordered;
    kept.viewNumber = viewNumber_;
    // What stands has no steps that would be known when it moves.
    kept.drawn = goes ? frame_ : 0;
}

// Makes room for the voxels of a patch, of which nothing is known. Returns false when there is no memory.
inline bool Keeper::clear(Kept& kept, int count)
{
    if (!makeRoom(kept, count))
        return false;
    for (int i = 0; i < count; ++i)
        kept.voxels[i] = One{};
    kept.period = 1;
    kept.facing = 0;
    kept.stepsKnown = false;
    return true;
}

// Whether a patch shows the same seeds as when its voxels were kept.
inline bool Keeper::hasSameSeeds(const Kept& kept, const PatchVoxels& made)
{
    bool same = kept.count == made.count;
    for (int i = 0; i < made.count && same; ++i)
        same = kept.voxels[i].seed == made.seen[i].seed;
    return same;
}

// Puts the kept voxels of a patch in the order of those that have been made: those of seeds that are not seen any more go, and for
// a seed that has come into sight there is a voxel without a seed. Returns false when there is no memory.
bool Keeper::rearrange(Kept& kept, const PatchVoxels& made)
{
    One now[PATCH_SEEDS_MOST];
    const One *before = kept.voxels, *const end = before + kept.count;
    for (int i = 0; i < made.count; ++i) {
        const One* at = before;
        while (at < end && at->seed != made.seen[i].seed)
            ++at;
        if (at < end) {
            now[i] = *at;
            before = at + 1;
        } else {
            now[i] = One{};
        }
    }
    if (!makeRoom(kept, made.count))
        return false;
    memcpy(static_cast<void*>(kept.voxels), now, static_cast<size_t>(made.count) * sizeof now[0]);
    return true;
}

// Takes the voxels of a patch as they have been made anew, corrects the steps that have led to them, and sets the next period. Of
// steps nothing is known unless it `follows` another period.
inline void Keeper::follow(Kept& kept, const Patch& patch, const PatchVoxels& made, bool follows, bool sameSeeds) const
{
    int32_t error = 0;
    const One* const like = correctSteps(kept, patch, made, &error);
    for (int i = 0; i < made.count && !sameSeeds; ++i)
        if (kept.voxels[i].seed == nullptr)
            kept.voxels[i].begin(made.voxels[i], made.seen[i].seed, like);
    // Where no seed was seen before nothing is known of the steps.
    follows = follows && (like != nullptr || made.count == 0);
    int period = follows && kept.stepsKnown ? periodAfter(kept.period, error, toleratedOf(patch)) : 1;
    // Others may come into sight, or go, as soon.
    if (!sameSeeds)
        period = patch.state == PATCH_MIXED ? min32(period, 2) : 1;
    // A patch that shows nothing may turn into sight.
    if (made.count == 0 && follows)
        period = min32(period, longestUnseen(kept, patch));
    if (patch.state == PATCH_MIXED)
        period = inTurn(kept, min32(period, longest_));
    kept.stepsKnown = follows;
    kept.period = static_cast<uint8_t>(period);
    kept.left = static_cast<uint8_t>(period - 1);
}

// Corrects the steps of those voxels of a patch that have been made of the same seeds as before. `*error` becomes the error of the
// steps. Returns one of these voxels, or null if there is none.
inline const Keeper::One* Keeper::correctSteps(Kept& kept, const Patch& patch, const PatchVoxels& made, int32_t* error) const
{
    const bool blends = patch.state == PATCH_MIXED;
    const int shift = __builtin_ctz(kept.period), tiltShift = object_.spacing() <= FINE ? 6 : 10 - blends;
    // Where patches rest a limb that comes or goes ends the period, because their scales alone make the outline.
    const int32_t otherwise = blends ? 0 : toleratedOf(patch) * 4;
    const One* like = nullptr;
    for (int i = 0; i < made.count; ++i) {
        One& one = kept.voxels[i];
        if (one.seed == nullptr)
            continue;
        *error |= one.follow(made.voxels[i], shift, tiltShift, otherwise);
        like = &one;
    }
    return like;
}

// Returns the period of a patch that blends, or 1 if it has to wait for the next frame to begin one of 2: half of the patches begin
// in a frame, half in the next, so that all frames take about the same time.
inline int Keeper::inTurn(const Kept& kept, int period) const
{
    const bool waits = ((static_cast<uint32_t>(&kept - kept_) + frame_) & 1) != 0;
    return kept.period == 1 && period == 2 && waits ? 1 : period;
}

// The longest period in which no seed of a patch without voxels turns into sight, if it goes on turning as in the period before. A
// patch at rest, whose turning is not recorded, gets a short one.
int Keeper::longestUnseen(Kept& kept, const Patch& patch) const
{
    if (patch.state != PATCH_MIXED)
        return 2;
    int32_t nearest = HIDDEN;
    forSeeds(object_, patch, [&](const Seed& s) {
        if (s.flags & (SEED_VALID | SEED_RESTING))
            nearest = max32(nearest, facing(object_, s, own_));
    });
    const int32_t step = (nearest - kept.facing) >> __builtin_ctz(kept.period);
    kept.facing = nearest;
    int period = LONGEST_PERIOD;
    while (period > 1 && nearest + step * (period - 1) > own_.limb - NEARLY_SEEN)
        period /= 2;
    return period;
}

// ---- One voxel

// Takes a voxel of which nothing is known. It is taken to move like another voxel of the patch, if there is one.
void Keeper::One::begin(const Voxel& v, const Seed* of, const One* like)
{
    if (like != nullptr)
        *this = *like;
    place[0] = v.x * 16;
    place[1] = v.y * 16;
    place[2] = v.z * 16;
    light = static_cast<int16_t>(v.brightness * 256 + 128);
    back = static_cast<int16_t>(v.back * 128);
    seed = of;
    set(v);
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
    if ((stepBack | stepCutAt) == 0)
        return;
    if (voxel.back != 0) {
        back = static_cast<int16_t>(max32(min32(back + stepBack, ENDS_MOST * 128), 128));
        voxel.back = static_cast<uint8_t>(back >> 7);
    }
    voxel.cutAt = static_cast<int16_t>(limited(voxel.cutAt + stepCutAt, CUT_MOST));
}

// Takes the voxel as it has been made anew, and corrects the steps, of which 2^shift were made. Returns the error, 1/256 unit.
// That of the place counts as it is; that of a tilt 2^(8 - tiltShift) times what it moves the scale's edge, which is a half where
// patches blend, a quarter where they rest, and four times between fine seeds; that of a cut a quarter to a half of what it moves
// the line; that of `back` a half; a step of brightness 1/16 unit. `otherwise` is the error if a scale that ended ends no more,
// or the other way round. All of these are or-ed, which is quicker than to find the greatest.
inline int32_t Keeper::One::follow(const Voxel& v, int shift, int tiltShift, int32_t otherwise)
{
    int32_t error = (correct(v.x * 16, place[0], step[0], shift) | correct(v.y * 16, place[1], step[1], shift) |
                     correct(v.z * 16, place[2], step[2], shift)) >> 4;
    error |= (correct(v.tiltX, voxel.tiltX, stepTiltX, shift) * v.halfWidth |
              correct(v.tiltY, voxel.tiltY, stepTiltY, shift) * v.halfHeight) >> tiltShift;
    int16_t corrected = stepLight;
    const int32_t lightError = correct(v.brightness * 256 + 128, light, corrected, shift);
    if (lightError > ROUNDED_LIGHT) {
        error |= lightError >> 4;
        stepLight = corrected;
    }
    if (v.back != 0 && voxel.back != 0) {
        error |= correct(v.back * 128, back, stepBack, shift) >> 5;
    } else if (v.back != voxel.back) {
        back = static_cast<int16_t>(v.back * 128);
        stepBack = 0;
        error |= otherwise;
    }
    if ((v.cutAt | voxel.cutAt) != 0) {
        if (isCut(v) && isCut(voxel) && !isCutNowhere(v) && !isCutNowhere(voxel))
            error |= correct(v.cutAt, voxel.cutAt, stepCutAt, shift) >> 3;
        else
            stepCutAt = 0;
    }
    // A step that is not long, plus LONG_STEP, has no bit beyond those of 2 LONG_STEP - 1. The sign is no part of an error.
    error |= ((stepTiltX + LONG_STEP) | (stepTiltY + LONG_STEP) | (stepLight * 2 + LONG_STEP)) & INT32_MAX & ~(2 * LONG_STEP - 1);
    set(v);
    return error;
}
