// Dead reckoning: how the seeds of a patch are moved on, and how their steps are corrected whenever the patch is settled.
#include "reckon.h"

#include "math/alloc.h"
#include "math/whole.h"
#include "period.h"

namespace {

// While a patch is moved on the neighbours travel no farther than so many spacings and so many units together, and than this part
// of the size of the smallest of them, for over a longer way steps are seldom even.
constexpr Real FAR_SPACINGS(1.375), FAR_UNITS(0.25), OF_SMALLEST(0.22);
// Spacings: the error of a border is seen only where the border is nearer to its seed than this.
constexpr Real NEAR(1.2);
// 1/1024 unit: the travels of two updates count as even if they differ by less than this and half of the travel.
constexpr int32_t EVEN_TRAVEL = 100;
// Greater than any error that is tolerated.
constexpr int32_t UNKNOWN = INT16_MAX;
// Where a component of a normal changes by this in an update, 1.0 = 2^14, normals that are moved on would get too long.
constexpr int32_t FAST = 2048;
static_assert((1 << 14) + FAST * (LONGEST_PERIOD - 1) <= INT16_MAX, "normals fit 16 bits");

}  // namespace

Reckoning::~Reckoning()
{
    for (int i = 0; i < count_; ++i)
        free(tracks_[i].motions);
    free(tracks_);
}

void Reckoning::open(int count)
{
    const Real spacing = min(object_.spacing(), COARSE);
    farthest_ = travelOf(spacing * FAR_SPACINGS + FAR_UNITS);
    tolerated_ = toleratedError(object_.spacing());
    near_ = rawFromReal(spacing * NEAR) >> 8;
    tracks_ = allocate<Track>(static_cast<uint32_t>(count));
    count_ = tracks_ == nullptr ? 0 : count;
    for (int i = 0; i < count_; ++i)
        tracks_[i] = Track{};
}

void Reckoning::begin(Travel travel, bool mayMove)
{
    const int32_t difference = magnitude(static_cast<int32_t>(travel - travel_));
    isEven_ = mayMove && count_ > 0 && travel <= farthest_ && difference < static_cast<int32_t>(travel / 2) + EVEN_TRAVEL;
    travel_ = travel;
    ++update_;
}

// Calls each(seed, motion) for the regular seeds of a patch and their active oversampled seeds.
template <class Each>
inline void Reckoning::forMotions(const Track& track, const Patch& patch, Each each) const
{
    Motion* m = track.motions;
    forSeeds(object_, patch, [&](Seed& s) {
        each(s, *m++);
        Seed* const extra = patch.extras ? object_.extra(object_.slotOf(s)) : nullptr;
        if (extra != nullptr && (extra->flags & SEED_ACTIVE))
            each(*extra, *m);
        else
            m->known = false;
        ++m;
    });
}

void Reckoning::move(int number, const Patch& patch)
{
    Track& track = tracks_[number];
    forMotions(track, patch, [](Seed& s, Motion& m) {
        if (!m.known)
            return;
        s.position = m.position = max(m.position + m.step, Real(0));
        m.normal.x = static_cast<int16_t>(m.normal.x + m.turn.x);
        m.normal.y = static_cast<int16_t>(m.normal.y + m.turn.y);
        m.normal.z = static_cast<int16_t>(m.normal.z + m.turn.z);
        s.normal = m.normal;
        if (m.bordered)
            s.apart = m.apart = static_cast<int16_t>(limited(m.apart + m.stepApart, INT16_MAX));
    });
    --track.left;
    track.update = update_;
}

// Corrects the motion of a seed, in which 2^shift steps were made. How a new one moves is not known: it stays for now. Returns
// about the error, as toleratedError(); several errors are or-ed, because that is quicker than to find the greatest.
inline int32_t Reckoning::correct(const Seed& s, int shift, Motion& m) const
{
    const bool known = m.known, bordered = (s.flags & SEED_BORDER) != 0;
    m.known = (s.flags & (SEED_VALID | SEED_RESTING)) == SEED_VALID;
    if (!m.known)
        return 0;
    int32_t error = 0;
    if (!known) {
        m.step = Real(0);
        m.turn = {0, 0, 0};
    } else {
        const Real off = s.position - m.position - m.step;
        m.step += shiftDown(off, shift);
        const int32_t turned = correctStep(s.normal.x, m.normal.x, shift, m.turn.x) |
                               correctStep(s.normal.y, m.normal.y, shift, m.turn.y) |
                               correctStep(s.normal.z, m.normal.z, shift, m.turn.z);
        error = rawFromReal(absolute(off * object_.radius())) >> 8 | turned >> 4;
    }
    if (known && bordered && m.bordered) {
        const int32_t off = correctStep(s.apart, m.apart, shift, m.stepApart);
        error |= magnitude(s.apart) < near_ ? off : 0;
    } else {
        m.stepApart = 0;
    }
    m.position = s.position;
    m.normal = s.normal;
    m.apart = s.apart;
    m.bordered = bordered;
    const bool fast = (magnitude(m.turn.x) | magnitude(m.turn.y) | magnitude(m.turn.z)) >= FAST;
    return fast || (s.flags & SEED_GUEST) ? UNKNOWN : error;
}

// Prepares a track for its patch to be followed. Returns false when there is no memory.
inline bool Reckoning::prepare(Track& track) const
{
    constexpr int MOTIONS = 2 * PATCH_RINGS * PATCH_SEEDS;
    if (track.motions != nullptr && track.update == update_ - 1)
        return true;
    if (track.motions == nullptr)
        track.motions = allocate<Motion>(MOTIONS);
    for (int i = 0; i < MOTIONS && track.motions != nullptr; ++i)
        track.motions[i].known = false;
    track.age = 0;
    track.period = 1;
    return track.motions != nullptr;
}

void Reckoning::follow(int number, const Patch& patch, Real smallest)
{
    const Travel ofSmallest = travelOf(smallest * OF_SMALLEST), farthest = ofSmallest < farthest_ ? ofSmallest : farthest_;
    // The travel of the next update may be much shorter.
    if (count_ == 0 || travel_ > 2 * farthest || !prepare(tracks_[number]))
        return;
    Track& track = tracks_[number];
    const int shift = __builtin_ctz(track.period);
    int32_t error = 0;
    forMotions(track, patch, [&](const Seed& s, Motion& m) { error |= correct(s, shift, m); });
    int period = track.age >= 2 && !patch.fine && !patch.islands ? periodAfter(track.period, error, tolerated_) : 1;
    while (period > 1 && travel_ * static_cast<Travel>(period - 1) > farthest)
        period /= 2;
    // Half of the patches begin in an update, half in the next, so that all updates take about the same time.
    if (track.period == 1 && period == 2 && ((static_cast<uint32_t>(number) + update_) & 1) != 0)
        period = 1;
    track.period = static_cast<uint8_t>(period);
    track.age = static_cast<uint8_t>(min32(track.age + 1, 2));
    track.left = static_cast<uint8_t>(period - 1);
    track.update = update_;
}
