// A frame of one object, from neighbours to voxels: the passes in their order. Start reading here.
#include "surface/engine.h"

#include "math/alloc.h"
#include "model/stop.h"
#include "paint.h"
#include "rt.h"
#include "settle.h"
#include "shade.h"

namespace {

// So many patches are updated before the user is asked whether to go on.
constexpr int ASKED_EVERY = 32;

// Spacing from which on patches keep their voxels, units.
constexpr Real KEPT_FROM(1);

// After so many updates every seed has been looked at (Settler::turns()).
constexpr int CALM = 8;

class Engine : public Surface {
public:
    explicit Engine(SoftObject& object) : object_(object) {}
    ~Engine() override
    {
        free(patches_);
        free(voxels_);
    }

    // False: no memory.
    bool open()
    {
        count_ = patchesOf(object_);
        patches_ = allocate<Patch>(static_cast<uint32_t>(count_));
        if (patches_ == nullptr)
            return false;
        makePatches(object_, patches_);
        // Of the finest seeds there are too many for their voxels to be kept.
        if (object_.spacing() < KEPT_FROM)
            return true;
        voxels_ = allocate<Voxel>(static_cast<uint32_t>(count_ * PATCH_VOXELS));
        if (voxels_ == nullptr)
            return false;
        for (int i = 0; i < count_; ++i)
            patches_[i].voxels = voxels_ + i * PATCH_VOXELS;
        return true;
    }

    void update(const FrameContext& frame) override;
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next) override;

private:
    SoftObject& object_;
    static bool turned(const int32_t* now, int32_t* before);

    Odometer odometer_;
    uint32_t updates_ = 0;
    int calm_ = 0;  // updates in a row before which nothing had come
    uint32_t changes_ = 0;  // updates in which seeds may have been settled
    int32_t light_[3] = {}, ahead_[3] = {}, right_[3] = {};  // at the last update, own axes
    ViewBefore before_;
    Polished polished_ = {};
    Patch* patches_ = nullptr;
    Voxel* voxels_ = nullptr;  // of the patches
    int count_ = 0;
};

// Whether a direction is another than at the last update, `before`, which becomes this one.
bool Engine::turned(const int32_t* now, int32_t* before)
{
    const bool same = memcmp(now, before, 3 * sizeof *now) == 0;
    for (int i = 0; i < 3; ++i)
        before[i] = now[i];
    return !same;
}

// Gather what reaches the object, classify its patches, settle those that are due.
void Engine::update(const FrameContext& frame)
{
    Neighbourhood all;
    const OwnFrame own = ownFrame(object_, frame);
    if (own.outOfSight || (!object_.hasSurface() && object_.hollowed() == nullptr))
        return;
    gather(object_, frame, all);
    const Way reading = odometer_.reading(), bound = odometer_.bound();
    const bool known = odometer_.advance(object_, own, all, frame.bodies->version());
    Settler settler(object_, own, all, frame, odometer_, ++updates_);
    const bool lightTurned = turned(own.light, light_), viewTurned = turned(own.ahead, ahead_) || turned(own.right, right_);
    // Where nothing has come, nothing changes, once what waits for a few updates has been looked at as well.
    const bool calm = known && !lightTurned && !viewTurned && reading == odometer_.reading() && bound == odometer_.bound();
    calm_ = calm ? calm_ + 1 : 0;
    if (calm_ > CALM)
        return;
    ++changes_;
    bool displaced = false;
    Patch* const end = patches_ + count_;
    for (Patch* patch = patches_; patch < end; ++patch) {
        patch->settled = false;
        if ((patch - patches_) % ASKED_EVERY == ASKED_EVERY - 1 && stopAsked())
            return;
        if (!known || patch->stale || isDue(odometer_.bound(), patch->listDue)) {
            classify(*patch, all);
            patch->listDue = odometer_.bound() + wayOf(LIST_SLACK);
            patch->stale = false;
        }
        if (!settler.setPatch(*patch) && all.rests) {
            if (patch->state != PATCH_REST) {
                // Where its seeds are now, others may reach them.
                rest(object_, *patch, own);
                classify(*patch, all);
            } else if (lightTurned) {
                light(object_, *patch, own);
            }
            patch->state = PATCH_REST;
            if (!settler.setPatch(*patch))
                continue;
        }
        displaced = true;
        if (outOfSight(*patch, own)) {
            sleep(object_, *patch);
            patch->state = PATCH_AWAY;
            patch->due = odometer_.reading();
            continue;
        }
        if (known && patch->state != PATCH_REST && !isDue(odometer_.reading(), patch->due)) {
            if (lightTurned && patch->state == PATCH_MIXED)
                light(object_, *patch, own);
            continue;
        }
        if (settler.isCovered(*patch)) {
            cover(object_, *patch);
            continue;
        }
        patch->state = settler.probe(*patch);
        patch->settled = patch->state == PATCH_MIXED;
        if (patch->settled)
            settler.settleRest(*patch);
        else
            sleep(object_, *patch);
    }
    for (Patch* patch = patches_; patch < end; ++patch)
        if (patch->settled)
            settler.oversample(*patch);
    object_.setDisplaced(displaced);
}

// Shade and list what the viewer sees of the object.
void Engine::draw(const FrameContext& frame, VoxelList& list, int room, int* next)
{
    const OwnFrame own = ownFrame(object_, frame);
    const SoftObject* const shown = object_.shown();
    list.begin(frame.inView(object_.centre()), object_.coreReach() + object_.size(),
               shown == nullptr ? object_.ramp() : shown->ramp());
    if (own.outOfSight || shown == nullptr) {
        *next = 0;
        return;
    }
    const Paint* const paint = shown->paint();
    if (paint != nullptr && *next == 0)
        polish(object_, own, changes_, &polished_);
    const int at = shadePatches(object_, own, frame, patches_, count_, *next, before_, list, room);
    *next = at < count_ ? at : 0;
    // With another ramp than its own, the whole object is to be seen in that one.
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
