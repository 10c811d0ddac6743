// A frame of one object, from neighbours to voxels: the passes in their order. Start reading here.
#include "surface/engine.h"

#include "math/alloc.h"
#include "paint.h"
#include "settle.h"
#include "shade.h"

namespace {

class Engine : public Surface {
public:
    explicit Engine(SoftObject& object) : object_(object) {}
    ~Engine() override { free(patches_); }

    // False: no memory.
    bool open()
    {
        count_ = patchesOf(object_);
        patches_ = allocate<Patch>(static_cast<uint32_t>(count_));
        if (patches_ == nullptr)
            return false;
        makePatches(object_, patches_);
        return true;
    }

    void update(const FrameContext& frame) override;
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next) override;

private:
    SoftObject& object_;
    bool turned(const int32_t* light);

    uint32_t updates_ = 0;
    int32_t light_[3] = {0, 0, 0};  // at the last update, own axes
    Patch* patches_ = nullptr;
    int count_ = 0;
};

// Whether the light comes from another side of the object than at the last update.
bool Engine::turned(const int32_t* light)
{
    const bool same = light[0] == light_[0] && light[1] == light_[1] && light[2] == light_[2];
    for (int i = 0; i < 3; ++i)
        light_[i] = light[i];
    return !same;
}

// Gather what reaches the object, classify its patches, settle those that need it.
void Engine::update(const FrameContext& frame)
{
    Neighbour neighbours[NEIGHBOURS_MAX];
    const OwnFrame own = ownFrame(object_, frame);
    const int count = gather(object_, frame, neighbours);
    Settler settler(object_, own, neighbours, count, frame, ++updates_);
    const bool lightTurned = turned(own.light);
    bool displaced = false;
    Patch* const end = patches_ + count_;
    for (Patch* patch = patches_; patch < end; ++patch) {
        if (patch->state == PATCH_INSIDE && settler.stillInside(*patch)) {
            displaced = true;
            continue;
        }
        if (!classify(*patch, neighbours, count)) {
            if (patch->state != PATCH_REST)
                rest(object_, *patch, own);
            else if (lightTurned)
                light(object_, *patch, own);
            patch->state = PATCH_REST;
            continue;
        }
        displaced = true;
        settler.setPatch(*patch);
        patch->state = settler.probe(*patch);
        if (patch->state == PATCH_MIXED)
            settler.settleRest(*patch);
        else
            sleep(object_, *patch);
    }
    for (Patch* patch = patches_; patch < end; ++patch)
        if (patch->state == PATCH_MIXED)
            settler.oversample(*patch);
    object_.setDisplaced(displaced);
}

// Shade and list what the viewer sees of the object.
void Engine::draw(const FrameContext& frame, VoxelList& list, int room, int* next)
{
    const OwnFrame own = ownFrame(object_, frame);
    list.begin(object_.centre() - frame.eye, object_.ramp());
    const Paint* const paint = object_.paint();
    if (paint != nullptr && *next == 0)
        polish(object_, own);
    const int at = shadePatches(object_, own, frame, patches_, count_, *next, list, room);
    *next = at < count_ ? at : 0;
    // With another ramp than its own, the whole object is to be seen in that one.
    if (paint != nullptr && object_.ramp() == paint->ramp)
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
