// Decides which object gets new seeds, and when. The time of a frame is about proportional to the number of seeds, so the
// effect of a step in the spacing of one object can be predicted; a step is not made when it would have to be reverted.
#include "app/rate.h"

#include "app/options.h"
#include "machine.h"

namespace {

// Loads, 1.0 = 256: a frame exactly on time; the load above which objects become coarser; the load up to which they may
// become finer; the largest load that is measured.
constexpr int32_t ON_TIME = 256;
constexpr int32_t COARSER = 264;
constexpr int32_t FINER = 248;
constexpr int32_t LOAD_MOST = 64 * ON_TIME;

// Far off, below half or above one and a half of the wanted time, decisions come after FEW_FRAMES frames and change more
// objects at once: one of OBJECTS_A_CHANGE when too fast; when too slow more with the excess over FAR_ABOVE, and all when that
// excess is ALL_EXCESS.
constexpr int32_t FAR_BELOW = ON_TIME / 2;
constexpr int32_t FAR_ABOVE = ON_TIME * 3 / 2;
constexpr int FEW_FRAMES = 2;
constexpr int OBJECTS_A_CHANGE = 16;
constexpr int32_t ALL_EXCESS = 8 * ON_TIME;

// Four steps of the spacing make a factor of two. A finer step adds 41 % of the seeds, a coarser one removes 29 %.
constexpr int STEPS_IN_TWO = 4;
constexpr Real STEP[STEPS_IN_TWO] = {Real(1), Real(1.189207), Real(1.414214), Real(1.681793)};
constexpr int STEPS = 5 * STEPS_IN_TWO;  // from SPACING_LEAST to SPACING_MOST
constexpr int32_t SEEDS_FINER = 41, SEEDS_COARSER = 29;

// When the coarsest and the finest object differ by more than this factor, objects change although the rate is right.
constexpr Real UNFAIR(2.2);

Real spacingOf(int step)
{
    return SPACING_LEAST * STEP[step % STEPS_IN_TWO] * Real(1 << step / STEPS_IN_TWO);
}

// Return the next step that is coarser, or finer, than a spacing by at least half a step (a factor of 1.09).
int coarserStep(Real spacing)
{
    int step = 0;
    while (step < STEPS && spacingOf(step) < spacing * Real(1.09))
        ++step;
    return step;
}

int finerStep(Real spacing)
{
    int step = STEPS;
    while (step > 0 && spacingOf(step) * Real(1.09) > spacing)
        --step;
    return step;
}

// Returns the depth of the nearest part of an object, which is its distance from the eye along the viewing axis, units; at
// least 10. An object behind the eye counts as far away.
Real depthOf(const SoftObject& object, const Camera& camera)
{
    const Real away = dot(object.centre() - camera.eye, camera.axes.ahead), reach = object.radius() + object.coreReach();
    return away < -reach ? Real(512) : max(away - reach, Real(10));
}

// Returns the spacing relative to the spacing that the object should have: near and thin objects should have finer seeds.
Real coarseness(const SoftObject& object, const Camera& camera)
{
    const Real thin = clamp(object.radius() * Real(0.1), Real(0.5), Real(1));
    return shiftUp(object.spacing(), 6) / (depthOf(object, camera) * thin);
}

// Seeds are not made finer than one per pixel, nor coarser than the radius of the object (or one unit).
bool canBeFiner(const SoftObject& object, const Camera& camera)
{
    return spacingOf(finerStep(object.spacing())) >= depthOf(object, camera) / camera.focalX &&
           object.spacing() > SPACING_LEAST;
}

bool canBeCoarser(const SoftObject& object)
{
    return object.spacing() < SPACING_MOST && spacingOf(coarserStep(object.spacing())) <= max(object.radius(), Real(1));
}

}  // namespace

void Rate::hold(int frames)
{
    *this = Rate();
    frames_ = frames;
}

void Rate::add(uint64_t ticks, const Model& model)
{
    ticks_ += ticks;
    ++counted_;
    const uint64_t wanted = static_cast<uint64_t>(machine::CLOCK_HZ) * counted_;
    // load_ = 256 * time taken / time allowed, limited to LOAD_MOST; both sides are shifted to fit a 32-bit divisor.
    const uint64_t limit = wanted * (LOAD_MOST / ON_TIME);
    const uint64_t took = ticks_ * static_cast<uint32_t>(frames_);
    uint64_t top = (took > limit ? limit : took) * ON_TIME, bottom = wanted;
    while (bottom >> 32 != 0) {
        top >>= 1;
        bottom >>= 1;
    }
    load_ = static_cast<int32_t>(divide64(top, static_cast<uint32_t>(bottom)));
    const bool far = load_ > FAR_ABOVE || load_ < FAR_BELOW;
    if (ticks_ < machine::CLOCK_HZ / 4 && !(far && counted_ >= FEW_FRAMES))
        return;
    ticks_ = 0;
    counted_ = 0;
    // The farther off the rate is, the more objects change. All change when a frame takes nine and a half times as long as it
    // should: the picture jumps at such a rate anyway.
    left_ = 1;
    if (load_ > FAR_ABOVE)
        left_ += model.count() * (load_ - FAR_ABOVE) / ALL_EXCESS;
    else if (far)
        left_ += model.count() / OBJECTS_A_CHANGE;
}

int Rate::next(const Model& model, const Camera& camera, Real* spacing)
{
    if (left_ == 0)
        return -1;
    --left_;
    const Extremes found = findExtremes(model, camera);
    const int fine = found.fine, coarse = found.coarse;
    const auto share = [&](int i, int32_t percent) {
        return mulDiv(load_ * percent, model.actor(i).object->seeds(), 100 * (model.seeds() + 1));
    };
    if (load_ > COARSER) {
        if (fine < 0)
            return -1;
        load_ -= share(fine, SEEDS_COARSER);
        *spacing = spacingOf(coarserStep(model.actor(fine).object->spacing()));
        return fine;
    }
    if (coarse < 0)
        return -1;
    const int32_t expected = load_ + share(coarse, SEEDS_FINER);
    const bool unfair = fine >= 0 && fine != coarse && found.most > found.least * UNFAIR;
    if (expected > FINER && !unfair)
        return -1;
    load_ = expected;
    *spacing = spacingOf(finerStep(model.actor(coarse).object->spacing()));
    return coarse;
}

// Finds the finest object of those that can become coarser, and the coarsest of those that can become finer. Fine and
// coarse are measured by coarseness().
Rate::Extremes Rate::findExtremes(const Model& model, const Camera& camera) const
{
    Extremes found{-1, -1, Real(0), Real(0)};
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject& object = *model.actor(i).object;
        const Real here = coarseness(object, camera);
        if (canBeCoarser(object) && (found.fine < 0 || here < found.least)) {
            found.fine = i;
            found.least = here;
        }
        if (!finest_ && canBeFiner(object, camera) && (found.coarse < 0 || here > found.most)) {
            found.coarse = i;
            found.most = here;
        }
    }
    return found;
}
