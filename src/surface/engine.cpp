// A frame of one object, from neighbours to voxels: the passes in their order. Start reading here.
#include "surface/engine.h"

#include "math/alloc.h"
#include "settle.h"
#include "shade.h"

namespace {

class Engine : public Surface {
public:
    explicit Engine(SoftObject& object) : object_(object) {}
    ~Engine() override { free(strips_); }

    // False: no memory.
    bool open()
    {
        count_ = stripsOf(object_);
        strips_ = allocate<Strip>(static_cast<uint32_t>(count_));
        if (strips_ == nullptr)
            return false;
        makeStrips(object_, strips_);
        return true;
    }

    void update(const FrameContext& frame) override;
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next) override;

private:
    SoftObject& object_;
    Strip* strips_ = nullptr;
    int count_ = 0;
};

// Gather what reaches the object, classify its strips, settle those that need it.
void Engine::update(const FrameContext& frame)
{
    Neighbour neighbours[NEIGHBOURS_MAX];
    const OwnFrame own = ownFrame(object_, frame);
    const int count = gather(object_, frame, neighbours);
    bool displaced = false;
    Reached reached;
    for (Strip* strip = strips_; strip < strips_ + count_; ++strip) {
        const StripState before = strip->state;
        strip->state = count == 0 ? STRIP_REST : classify(*strip, own, neighbours, count, reached);
        if (strip->state == STRIP_MIXED)
            settleStrip(object_, *strip, reached, frame);
        else if (strip->state == STRIP_REST && before != STRIP_REST)
            restStrip(object_, *strip);
        else if (strip->state != STRIP_REST && strip->state != before)
            loseStrip(object_, *strip);
        displaced = displaced || strip->state != STRIP_REST;
    }
    object_.setDisplaced(displaced);
}

// Shade and list what the viewer sees of the object.
void Engine::draw(const FrameContext& frame, VoxelList& list, int room, int* next)
{
    const OwnFrame own = ownFrame(object_, frame);
    Shader shader(object_, own, frame);
    list.begin(object_.centre() - frame.eye, object_.ramp());
    int at = *next;
    for (; at < count_ && list.count + 2 * STRIP_SEEDS <= room; ++at) {
        const Strip& strip = strips_[at];
        if (strip.state == STRIP_INSIDE || strip.state == STRIP_AWAY || (strip.state == STRIP_REST && restsAway(strip, own)))
            continue;
        shader.setStrip(strip);
        const Seed* s = &object_.seed(2 * strip.first);
        for (const Seed* const end = s + 2 * strip.count; s < end; s += 2) {
            if ((s->flags & SEED_VALID) && shader.shade(*s, false, list.room()))
                list.take();
            const uint8_t flags = s[1].flags;
            if ((flags & SEED_ACTIVE) && (flags & SEED_VALID) && shader.shade(s[1], true, list.room()))
                list.take();
        }
    }
    *next = at < count_ ? at : 0;
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
