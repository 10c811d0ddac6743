// Dead reckoning: how the voxels of a patch are moved on, and how their steps are corrected whenever the patch is shaded.
#include "reckon.h"

#include "math/alloc.h"
#include "math/whole.h"

namespace {

// Steps count as even if they differ by less than this: those of the viewer, as a share of the distance; of the object's growth; of
// an axis of the view, 1.0 = 2^14; the neighbours' travel, 1/1024 unit and a quarter of the travel.
constexpr Real EVEN_EYE(0.012), EVEN_GROWTH(0.005);
constexpr int32_t EVEN_AXIS = 200, EVEN_TRAVEL = 100;
// When following an object's voxels has not paid for VAIN_MOST frames, none is followed for PAUSE frames; for twice as many if it
// does not pay after these either, and so on, up to PAUSE_MOST. A voxel that is moved on saves so many times what it takes to
// follow one: it need not be shaded, or neither settled nor shaded.
constexpr int VAIN_MOST = 5, PAUSE = 32, PAUSE_MOST = 256, SHADING_PAYS = 1, SETTLING_PAYS = 4;
// An object with more patches has so many seeds that the memory is wanted for these; and a patch with more voxels is not tracked.
constexpr int PATCHES_MOST = 2500, VOXELS_MOST = 16;
// The error of a single step, in the units of Errors::greatest(), with which a patch is moved on for a frame. It grows with the
// spacing, because who wants finer seeds wants to see more: for each unit, and at most. Errors grow with the square of the steps.
constexpr int32_t TOLERATED = 32, TOLERATED_MOST = 64;
// 1/256 unit: nearer to the viewer errors are seen more.
constexpr int32_t NEAR = 64 << 8;
constexpr int LONGEST_PERIOD = 4;
// With these brightnesses, steps, the corners of a scale still find entries in its ramp (VoxelList::ramp).
constexpr int32_t PALEST = 93, DARKEST = -34;

// The errors of the predictions of a patch's voxels, or-ed because that is quicker than to find the greatest of each kind.
struct Errors {
    int32_t place = 0, depth = 0, brightness16 = 0, tilt = 0, cut = 0;

    // 64 stands for 1/8 unit across the view, 1/4 unit of depth, 4 steps of brightness, or a quarter of a tilt of one.
    int32_t greatest() const { return place << 1 | depth | brightness16 | tilt | cut; }
};

// Corrects a step that has led from `before` elsewhere than to `now`; 2^shift such steps were made. Returns about the error.
inline int32_t correct(int32_t now, int32_t before, int16_t* step, int shift)
{
    const int32_t error = now - before - *step;
    *step = static_cast<int16_t>(*step + (error >> shift));
    return error ^ error >> 31;
}

// The period of a patch, from its last one and from the error at the end of that.
inline int periodAfter(int period, int32_t error, int32_t tolerated)
{
    if (error < (period == 1 ? tolerated : tolerated / 2))
        return period < LONGEST_PERIOD ? period * 2 : period;
    if (period == 1 || error >= tolerated * 8)
        return 1;
    return error < (period == 2 ? tolerated * 4 : tolerated * 2) ? period : period / 2;
}

// Where a scale is tilted its edges may be off by as much more.
inline int32_t beyond(int32_t error, int32_t tilt)
{
    const int32_t more = error - (magnitude(tilt) >> 2);
    return more & ~(more >> 31);
}

}  // namespace

Reckoning::~Reckoning()
{
    for (int i = 0; i < count_; ++i)
        free(tracks_[i].voxels);
    free(tracks_);
}

void Reckoning::open(int count, Real spacing)
{
    tolerated_ = min32(rawFromReal(spacing * Real(TOLERATED)) >> 16, TOLERATED_MOST);
    room_ = rawFromReal(min(spacing, Real(2))) >> 9;
    if (count <= PATCHES_MOST)
        tracks_ = allocate<Track>(static_cast<uint32_t>(count));
    count_ = tracks_ == nullptr ? 0 : count;
    for (int i = 0; i < count_; ++i) {
        tracks_[i] = Track{};
        tracks_[i].first = -1;
    }
}

void Reckoning::forget()
{
    for (int i = 0; i < count_; ++i)
        tracks_[i].count = tracks_[i].age = tracks_[i].left = 0;
}

void Reckoning::beginUpdate(const OwnFrame& own, Travel travel, bool known)
{
    // After an update whose result was never drawn nothing is known.
    known = known && !(isUpdated_ && before_ == frame_);
    const Vector step = own.eye - eye_, change = step - eyeStep_;
    const Real most = Real(own.distance32 >> 5) * EVEN_EYE;
    const int32_t difference = magnitude(static_cast<int32_t>(travel - travel_));
    isEven_ = known && count_ > 0 && travel < travelOf(FARTHEST) / 2 &&
              difference < static_cast<int32_t>(travel >> 2) + EVEN_TRAVEL &&
              absolute(own.growth - growth_ - growthStep_) < EVEN_GROWTH &&
              absolute(change.x) < most && absolute(change.y) < most && absolute(change.z) < most;
    growthStep_ = own.growth - growth_;
    growth_ = own.growth;
    eye_ = own.eye;
    eyeStep_ = step;
    travel_ = travel;
    for (int i = 0; i < 6; ++i) {
        const int32_t axis = (i < 3 ? own.right : own.up)[i % 3], by = axis - axes_[i];
        isEven_ = isEven_ && magnitude(by - axesStep_[i]) < EVEN_AXIS;
        axesStep_[i] = by;
        axes_[i] = axis;
    }
    isUpdated_ = true;
    before_ = frame_;
}

void Reckoning::beginDraw()
{
    isUpdated_ = isUpdated_ && before_ == frame_;
    // What is not updated stands still, and does so evenly from the second frame on.
    if (!isUpdated_) {
        isEven_ = isIdle_;
        travel_ = 0;
    }
    isIdle_ = count_ > 0 && !isUpdated_;
    before_ = frame_++;
    if (pause_ > 0)
        --pause_;
    else if (followed_ <= saved_)
        vain_ = lastPause_ = 0;
    else if (++vain_ == VAIN_MOST) {
        vain_ = 0;
        pause_ = lastPause_ = lastPause_ == 0 ? PAUSE : min32(lastPause_ * 2, PAUSE_MOST);
    }
    followed_ = saved_ = 0;
}

void Reckoning::move(int number, const Seed* seeds, VoxelList& list, Slopes& slopes)
{
    Track& track = tracks_[number];
    int sloped = track.sloped, at = list.count;
    const Seed* last = nullptr;
    for (Tracked *t = track.voxels, *const end = t + track.count; t < end; ++t, ++at) {
        Voxel& v = t->voxel;
        v.x += t->stepX;
        v.y += t->stepY;
        v.z += t->stepZ;
        v.tiltX = static_cast<int16_t>(v.tiltX + t->stepTiltX);
        v.tiltY = static_cast<int16_t>(v.tiltY + t->stepTiltY);
        t->brightness16 = static_cast<int16_t>(t->brightness16 + t->stepBrightness16);
        // Only a voxel with slopes may be darker than dark (voxel.h).
        const int32_t darkest = (v.slopeX | v.slopeY) == 0 ? 0 : DARKEST;
        v.brightness = static_cast<int8_t>(min32(max32(t->brightness16 >> 4, darkest), PALEST));
        if (isCut(v)) {
            v.cutX = static_cast<int8_t>(limited(v.cutX + t->stepCutX, INT8_MAX));
            v.cutY = static_cast<int8_t>(limited(v.cutY + t->stepCutY, INT8_MAX));
            v.cutAt = static_cast<int16_t>(limited(v.cutAt + t->stepCutAt, INT16_MAX));
        }
        list.voxels[at] = v;
        list.number[at] = t->number;
        // Of the two voxels of a seed at the edge of a pattern the first stands for both.
        if (--sloped >= 0 && t->seed != last)
            slopes.add(t->seed, static_cast<int>(t->seed - seeds), list.voxels + at, Slopes::STAYS);
        last = t->seed;
    }
    list.count = at;
    list.bordered |= track.bordered;
    saved_ += track.count * (track.state == PATCH_MIXED ? SETTLING_PAYS : SHADING_PAYS);
    --track.left;
    track.frame = frame_;
}

void Reckoning::note(int number, const Patch& patch, int first, int sloped, const VoxelList& list)
{
    if (!follows())
        return;
    Track& track = tracks_[number];
    track.first = static_cast<int16_t>(first);
    track.listed = static_cast<int16_t>(list.count - first);
    track.sloped = static_cast<uint8_t>(sloped);
    if (track.state != patch.state || track.frame != before_)
        track.count = track.age = 0;
    track.state = patch.state;
}

void Reckoning::follow(int from, int to, const VoxelList& list, bool painted)
{
    if (!follows())
        return;
    for (int i = from; i < to; ++i)
        if (tracks_[i].first >= 0) {
            follow(i, tracks_[i], list, painted);
            tracks_[i].first = -1;
        }
}

// Makes `tracked`, a voxel that moves like a new one beside it, that new voxel: it is taken to have moved by the same steps.
void Reckoning::setBeside(const Voxel& voxel, Tracked& tracked)
{
    tracked.voxel = voxel;
    tracked.voxel.x -= tracked.stepX;
    tracked.voxel.y -= tracked.stepY;
    tracked.voxel.z -= tracked.stepZ;
    tracked.voxel.tiltX = static_cast<int16_t>(voxel.tiltX - tracked.stepTiltX);
    tracked.voxel.tiltY = static_cast<int16_t>(voxel.tiltY - tracked.stepTiltY);
    tracked.brightness16 = static_cast<int16_t>(voxel.brightness * 16 + 8 - tracked.stepBrightness16);
    tracked.stepCutX = tracked.stepCutY = tracked.stepCutAt = 0;
}

// Brings the voxels of a track into the order of those in the list: some of these are new, some others are not there any more.
// Returns false if they are too many, or there is no memory.
bool Reckoning::arrange(Track& track, const VoxelList& list)
{
    const Seed* const* const seeds = list.seed + track.first;
    int same = 0;
    while (same < track.count && same < track.listed && track.voxels[same].seed == seeds[same])
        ++same;
    if (same == track.listed) {
        track.count = static_cast<uint8_t>(same);
        return true;
    }
    if (track.listed > VOXELS_MOST)
        return false;
    Tracked old[VOXELS_MOST], beside{};
    const int count = track.count;
    for (int i = 0; i < count; ++i)
        old[i] = track.voxels[i];
    if (count > 0)
        beside = old[0];
    if (track.listed > track.room) {
        // Most patches have a voxel more or less before long.
        const int room = (track.listed + 3) & ~3;
        free(track.voxels);
        track.voxels = allocate<Tracked>(static_cast<uint32_t>(room));
        track.room = static_cast<uint8_t>(track.voxels == nullptr ? 0 : room);
        if (track.voxels == nullptr)
            return false;
    }
    track.count = static_cast<uint8_t>(track.listed);
    for (int i = 0, at = 0; i < track.count; ++i) {
        int found = at;
        while (found < count && old[found].seed != seeds[i])
            ++found;
        if (found < count) {
            at = found + 1;
            beside = old[found];
        } else {
            setBeside(list.voxels[track.first + i], beside);
            beside.seed = seeds[i];
        }
        track.voxels[i] = beside;
    }
    return true;
}

// Sets the period of a track to the one that its errors allow, or to a shorter one. `shaky`: small errors are seen.
inline void Reckoning::setPeriod(int number, Track& track, int period, bool shaky) const
{
    if (period > 2 && (shaky || travel_ * period > travelOf(FARTHEST)))
        period = 2;
    // A border travels about half as far as the neighbours.
    while (track.state == PATCH_MIXED && period > 1 && static_cast<int32_t>(travel_ >> 3) * (period - 1) > room_)
        period /= 2;
    // Half of the patches begin in a frame, half in the next, so that all frames take about the same time.
    if (track.period == 1 && period == 2 && ((number + frame_) & 1) != 0)
        period = 1;
    track.period = static_cast<uint8_t>(period);
}

void Reckoning::follow(int number, Track& track, const VoxelList& list, bool painted)
{
    track.frame = frame_;
    track.bordered = list.bordered;
    track.left = 0;
    if (!arrange(track, list)) {
        track.count = track.age = 0;
        return;
    }
    const int shift = track.age < 2 ? 0 : __builtin_ctz(track.period);
    followed_ += track.count;
    Errors errors;
    const Voxel* v = list.voxels + track.first;
    const uint8_t* colour = list.number + track.first;
    const bool rests = track.state == PATCH_REST;
    bool shaky = list.z + v->z < NEAR, changed = false;
    for (Tracked *t = track.voxels, *const end = t + track.count; t < end; ++t, ++v, ++colour) {
        const Voxel& before = t->voxel;
        errors.place |= correct(v->x, before.x, &t->stepX, shift) | correct(v->y, before.y, &t->stepY, shift);
        errors.depth |= correct(v->z, before.z, &t->stepZ, shift);
        errors.tilt |= beyond(correct(v->tiltX, before.tiltX, &t->stepTiltX, shift), v->tiltX) |
                       beyond(correct(v->tiltY, before.tiltY, &t->stepTiltY, shift), v->tiltY);
        const int32_t now = v->brightness * 16 + 8;
        errors.brightness16 |= correct(now, t->brightness16, &t->stepBrightness16, shift);
        t->brightness16 = static_cast<int16_t>(now);
        if (!isCut(*v) || !isCut(before)) {
            // How a border moves that has just come is not known.
            t->stepCutX = t->stepCutY = t->stepCutAt = 0;
            changed |= isCut(*v);
        } else {
            errors.cut |= correct(v->cutX, before.cutX, &t->stepCutX, shift) << 3 |
                          correct(v->cutY, before.cutY, &t->stepCutY, shift) << 3 |
                          correct(v->cutAt, before.cutAt, &t->stepCutAt, shift) >> 1;
        }
        // Next to the limb the outline would come late.
        shaky |= rests && isCut(*v);
        t->voxel = *v;
        if (painted) {
            changed |= t->number != *colour;
            t->number = *colour;
        }
    }
    const bool known = track.age >= 2 && !changed;
    setPeriod(number, track, known ? periodAfter(track.period, errors.greatest(), tolerated_) : 1, shaky);
    track.age = static_cast<uint8_t>(min32(track.age + 1, 2));
    track.left = static_cast<uint8_t>(track.period - 1);
}
