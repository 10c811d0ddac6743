// Which object is laid out anew, and when. A frame costs about as much as there are seeds, so a step in the spacing of one
// object tells beforehand what it will change; nothing is made finer that would have to be made coarser again.
#include "app/rate.h"

#include "app/options.h"
#include "machine.h"

namespace {

// A frame on time, and the load at which objects become coarser; they become finer up to FINER.
constexpr int32_t ON_TIME = 256;
constexpr int32_t COARSER = 264;
constexpr int32_t FINER = 248;
constexpr int32_t LOAD_MOST = 64 * ON_TIME;

// Beyond half and one and a half of the wanted time there are more changes before a frame, and less to wait for each.
constexpr int32_t FAR_BELOW = ON_TIME / 2;
constexpr int32_t FAR_ABOVE = ON_TIME * 3 / 2;
constexpr int FEW_FRAMES = 2;
constexpr int OBJECTS_A_CHANGE = 16;
constexpr int32_t ALL_ABOVE = 8 * ON_TIME;

// Four steps of the spacing are a factor of two; a step changes the number of seeds by 41%, or 29% the other way.
constexpr int STEPS_IN_TWO = 4;
constexpr Real STEP[STEPS_IN_TWO] = {Real(1), Real(1.189207), Real(1.414214), Real(1.681793)};
constexpr int STEPS = 5 * STEPS_IN_TWO;  // from SPACING_LEAST to SPACING_MOST
constexpr int32_t SEEDS_FINER = 41, SEEDS_COARSER = 29;

// Objects whose spacings are this much apart from what they deserve change although the rate is right.
constexpr Real UNFAIR(2.2);

Real spacingOf(int step)
{
    return SPACING_LEAST * STEP[step % STEPS_IN_TWO] * Real(1 << step / STEPS_IN_TWO);
}

// The step next to a spacing that is coarser, or finer, by half a step at least.
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

// How far the nearest part of an object is from the viewer, units; what is behind him is as good as far.
Real distance(const SoftObject& object, const Camera& camera)
{
    const Real away = object.centre().z - camera.eye.z, reach = object.radius() + object.coreReach();
    return away < -reach ? Real(512) : max(away - reach, Real(10));
}

// The spacing over what the object deserves: finer where it is near, and where it is thin.
Real coarseness(const SoftObject& object, const Camera& camera)
{
    const Real thin = clamp(object.radius() * Real(0.1), Real(0.5), Real(1));
    return shiftUp(object.spacing(), 6) / (distance(object, camera) * thin);
}

// No more than a seed for each pixel, no less than a few across the object.
bool canBeFiner(const SoftObject& object, const Camera& camera)
{
    return spacingOf(finerStep(object.spacing())) >= distance(object, camera) / camera.focalX &&
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
    // 256 times what the frames took over what they may take.
    const uint64_t most = wanted * (LOAD_MOST / ON_TIME);
    const uint64_t took = ticks_ * static_cast<uint32_t>(frames_);
    uint64_t top = (took > most ? most : took) * ON_TIME, bottom = wanted;
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
    // The farther off, the more objects; all of them where a frame takes nine times too long, and is a leap by itself.
    left_ = 1;
    if (load_ > FAR_ABOVE)
        left_ += model.count() * (load_ - FAR_ABOVE) / ALL_ABOVE;
    else if (far)
        left_ += model.count() / OBJECTS_A_CHANGE;
}

int Rate::next(const Model& model, Real* spacing)
{
    if (left_ == 0)
        return -1;
    --left_;
    const Extremes found = findExtremes(model);
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
    const int32_t then = load_ + share(coarse, SEEDS_FINER);
    const bool unfair = fine >= 0 && fine != coarse && found.most > found.least * UNFAIR;
    if (then > FINER && !unfair)
        return -1;
    load_ = then;
    *spacing = spacingOf(finerStep(model.actor(coarse).object->spacing()));
    return coarse;
}

// The object that is the finest for what it is, of those that can be coarser, and the other way round.
Rate::Extremes Rate::findExtremes(const Model& model) const
{
    Extremes found{-1, -1, Real(0), Real(0)};
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject& object = *model.actor(i).object;
        const Real here = coarseness(object, model.camera);
        if (canBeCoarser(object) && (found.fine < 0 || here < found.least)) {
            found.fine = i;
            found.least = here;
        }
        if (!finest_ && canBeFiner(object, model.camera) && (found.coarse < 0 || here > found.most)) {
            found.coarse = i;
            found.most = here;
        }
    }
    return found;
}
