// The passes that bring one object from its neighbours to its voxels in a frame, in their order. Start reading here.
#include "surface/engine.h"

#include "math/alloc.h"
#include "model/stop.h"
#include "paint.h"
#include "rt.h"
#include "settle.h"
#include "shade.h"

namespace {

// After this many patches the program looks whether the user wants to stop.
constexpr int ASKED_EVERY = 32;

// Nothing is kept (keeper.h) of an object with more patches than this, because its many seeds need the memory.
constexpr int KEPT_MOST = 2500;

class Engine : public Surface {
public:
    explicit Engine(SoftObject& object) : object_(object), keeper_(object) {}
    ~Engine() override { free(patches_); }

    // Makes the patches. Returns false when there is no memory, or the user wants to stop.
    bool open()
    {
        count_ = patchesOf(object_);
        patches_ = allocate<Patch>(static_cast<uint32_t>(count_));
        if (patches_ == nullptr)
            return false;
        makePatches(object_, patches_);
        if (stopAsked())
            return false;
        if (count_ <= KEPT_MOST)
            keeper_.open(count_);
        return true;
    }

    bool update(const FrameContext& frame) override;
    void reshape() override;
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next) override;

private:
    bool updatePatch(Settler& settler, Patch& patch, const Neighbourhood& all);
    bool goOn(int number, Patch& patch, const Neighbourhood& all);
    bool waits(Settler& settler, Patch& patch, const Neighbourhood& all);
    bool isUntouched(const Settler& settler, Patch& patch, const Neighbourhood& all) const;
    bool comesToRest(Settler& settler, Patch& patch, const Neighbourhood& all);
    void sleepOutOfSight(Patch& patch);
    void settle(Settler& settler, Patch& patch);
    void settleBetween(Settler& settler);
    SELDOM void settleIslands(Settler& settler);

    SoftObject& object_;

    Odometer odometer_;
    Keeper keeper_;
    uint32_t islandSearches_ = 0;  // how often islands were searched
    OwnFrame own_;           // how the object is seen: set by update(), or in a frame without one by the first draw()
    bool begun_ = false;     // update() has begun this frame, and draw() has not been called yet
    bool islands_ = false;   // some patches have seeds on islands
    bool allRests_ = false;  // all seeds were at rest after the last update
    Patch* patches_ = nullptr;
    int count_ = 0;
};

// The object has a new shape, and the paths of its seeds lead elsewhere. Patches keep their states but are all due; seeds start the
// next search from their present positions, and nothing else that was known of them holds.
void Engine::reshape()
{
    const auto forget = [](Seed& s) {
        if ((s.flags & (SEED_VALID | SEED_RESTING)) == SEED_VALID)
            s.flags = static_cast<uint8_t>((s.flags & SEED_ACTIVE) | SEED_FOLLOW);
        s.flags &= static_cast<uint8_t>(~SEED_OFF);
    };
    for (int i = 0; i < object_.seedSlots(); i += 2) {
        forget(object_.regular(i));
        if (object_.extra(i) != nullptr)
            forget(*object_.extra(i));
    }
    reshapePatches(object_, patches_, count_, odometer_.reading());
    keeper_.forget();
}

// Gathers what reaches the object, classifies its patches, and settles those that are due.
bool Engine::update(const FrameContext& frame)
{
    Neighbourhood all;
    findOwnFrame(object_, frame, own_);
    if (own_.outOfSight || (!object_.hasSurface() && object_.hollowed() == nullptr))
        return false;
    gather(object_, frame, all);
    odometer_.advance(object_, own_, all, frame.bodies->version());
    keeper_.begin(own_, odometer_.lastTravel());
    begun_ = true;
    // No neighbour is near, and all seeds are at rest already.
    if (allRests_ && !odometer_.leapt() && all.ordinary && all.restsAtOne && all.count == 0)
        return false;
    Settler settler(object_, own_, all, frame, odometer_);
    bool displaced = false, wentOn = false;
    Patch* patch = patches_;
    for (int i = 0; i < count_; ++i, ++patch) {
        patch->settled = false;
        if (i % ASKED_EVERY == ASKED_EVERY - 1 && stopAsked()) {
            // Patches that this update has left out do not know what has moved.
            odometer_.forget();
            keeper_.forget();
            return true;
        }
        if (goOn(i, *patch, all))
            displaced = wentOn = true;
        else
            displaced |= updatePatch(settler, *patch, all);
    }
    settleBetween(settler);
    object_.setDisplaced(displaced);
    allRests_ = !displaced;
    // What went on has to be settled yet, even if nothing changes any more.
    return settler.hidden() || wentOn;
}

// Settles what lies between the regular seeds of the patches that have been settled, and on islands. The voxels that these patches
// have kept are not right any more.
inline void Engine::settleBetween(Settler& settler)
{
    Patch* patch = patches_;
    for (int i = 0; i < count_; ++i, ++patch)
        if (patch->settled) {
            settler.oversample(*patch);
            keeper_.forgetPatch(i);
        }
    if (settler.isHeavy() || islands_)
        settleIslands(settler);
}

// Settles the islands of all patches. In patches without any they are searched in every other frame, unless something has leapt.
// They end when no link of the object is heavy any more.
void Engine::settleIslands(Settler& settler)
{
    islands_ = false;
    ++islandSearches_;
    for (Patch* patch = patches_; patch < patches_ + count_; ++patch) {
        const bool hasTurn = odometer_.leapt() || ((static_cast<uint32_t>(patch - patches_) + islandSearches_) & 1) == 0;
        if (!patch->islands && (patch->state == PATCH_OFF || !hasTurn))
            continue;
        settler.settleIslands(*patch);
        islands_ |= patch->islands;
    }
}

// Lets the voxels of patch `number` go on if it blends, so that its seeds need not be settled. Returns false if they do not. The
// travel of the neighbours is counted all the same, for the frame in which the patch is settled again.
inline bool Engine::goOn(int number, Patch& patch, const Neighbourhood& all)
{
    if (patch.state != PATCH_MIXED || !keeper_.goesOn(number, patch))
        return false;
    patch.moved = true;
    if (!all.ordinary)
        odometer_.addTravel(patch, all);
    return true;
}

// Brings a patch up to date. Returns false if all its seeds are at rest.
inline bool Engine::updatePatch(Settler& settler, Patch& patch, const Neighbourhood& all)
{
    if (waits(settler, patch, all))
        return true;
    // What is out of sight need not be looked at, unless it may come to rest or the odometer has to count the neighbours' travel.
    const bool judgedFirst = all.ordinary && all.count > 0 && patch.state != PATCH_REST;
    if (judgedFirst && outOfSight(patch, own_)) {
        sleepOutOfSight(patch);
        return true;
    }
    if (!all.ordinary && isUntouched(settler, patch, all))
        return patch.state != PATCH_REST;
    if (comesToRest(settler, patch, all))
        return false;
    if (!judgedFirst && outOfSight(patch, own_))
        sleepOutOfSight(patch);
    else if (patch.state == PATCH_REST || isDue(odometer_.reading(), patch.due))
        settle(settler, patch);
    return true;
}

// Whether a neighbour reaches the seeds of a patch that rests.
bool isReached(const Patch& patch, const Neighbourhood& all)
{
    const Bound ball{patch.middle[0], patch.middle[1], patch.middle[2], patch.tight};
    for (const Neighbour *near = all.neighbours, *const end = near + all.count; near < end; ++near)
        if (reaches(*near, ball))
            return true;
    return false;
}

// Finds out which neighbours reach a patch, and puts its seeds at rest if none does. Returns true if they are at rest then.
inline bool Engine::comesToRest(Settler& settler, Patch& patch, const Neighbourhood& all)
{
    // Most patches at rest stay so, and need no Settler::setPatch().
    const bool stays = patch.state == PATCH_REST && all.restsAtOne && !isReached(patch, all);
    if (!stays && (settler.setPatch(patch) || !all.restsAtOne))
        return false;
    if (patch.state != PATCH_REST) {
        rest(object_, patch);
        patch.state = PATCH_REST;
        // Other neighbours may be near the places where the seeds are now.
        if (settler.setPatch(patch))
            return false;
    }
    patch.moved = false;
    return true;
}

// Puts a patch that is out of sight to sleep until it comes into sight.
inline void Engine::sleepOutOfSight(Patch& patch)
{
    sleep(object_, patch);
    patch.state = PATCH_AWAY;
    patch.due = odometer_.reading();
}

// Whether a patch keeps its state and its neighbours need not be looked at: it is not due yet, or it still lies inside the
// neighbour that covered it.
inline bool Engine::waits(Settler& settler, Patch& patch, const Neighbourhood& all)
{
    if (patch.state == PATCH_REST)
        return false;
    if (all.ordinary && !isDue(odometer_.reading(), patch.due))
        return true;
    return patch.state == PATCH_OFF && settler.isStillCovered(patch);
}

// Whether a patch of a scene that is not ordinary (gather.h) keeps its state: its voxels have not gone on and no neighbour that may
// reach its paths has moved, or all of the patch is still off the surface. At rest it does not depend on the viewer.
inline bool Engine::isUntouched(const Settler& settler, Patch& patch, const Neighbourhood& all) const
{
    const bool moved = odometer_.addTravel(patch, all);
    if (settler.isStillOff(patch))
        return true;
    if (moved || patch.moved)
        return false;
    return patch.state == PATCH_REST || (odometer_.eyeStayed() && patch.state != PATCH_AWAY);
}

// Judges a patch as a whole by the seed in its middle, and settles each of its seeds only where that does not decide.
inline void Engine::settle(Settler& settler, Patch& patch)
{
    patch.moved = false;
    if (settler.isCovered(patch)) {
        cover(object_, patch);
        return;
    }
    patch.state = settler.probe(patch);
    patch.settled = patch.state == PATCH_MIXED;
    if (patch.settled) {
        settler.settleOthers(patch);
        patch.bend.known = false;
    } else {
        sleep(object_, patch);
    }
}

// Lists the voxels of what the viewer sees of the object.
void Engine::draw(const FrameContext& frame, VoxelList& list, int room, int* next)
{
    // Without an update nothing has moved.
    const bool begins = *next == 0 && !begun_;
    if (begins)
        findOwnFrame(object_, frame, own_);
    begun_ = false;
    const SoftObject* const shown = object_.shown();
    list.begin(frame.inView(object_.centre()), object_.reach(),
               shown == nullptr ? object_.ramp() : shown->ramp());
    if (own_.outOfSight || shown == nullptr) {
        *next = 0;
        return;
    }
    if (begins)
        keeper_.begin(own_, 0);
    const Paint* const paint = shown->paint();
    const int at = shadePatches(object_, own_, frame, patches_, count_, *next, list, room, keeper_);
    *next = at < count_ ? at : 0;
    // An object that is shown in another ramp than its own, as when it is selected, shows no colours of its paint.
    if (paint != nullptr && shown->ramp() == paint->ramp)
        sortByColour(list, *paint);
}

}  // namespace

Surface* makeEngine(SoftObject& object)
{
    Engine* const engine = make<Engine>(object);
    if (engine != nullptr && !engine->open()) {
        destroy(engine);
        return nullptr;
    }
    return engine;
}
