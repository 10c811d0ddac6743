// Chooses the balls that ride: whose seeds turn with the group that carries them. Where a group turns as one, its balls are then at
// rest beside each other, and their surfaces need not be found anew.
#include "math/alloc.h"
#include "math/vec.h"
#include "model/anim.h"
#include "model/model.h"

namespace {

// The motion is looked at in several steps of a quarter of a second, each of which begins 3.25 s after the one before.
constexpr int STEPS = 4;
constexpr Time STEP = 65536 / 4, APART = 65536 * 13 / 4;

// So many of a ball's links are looked at; in a crowd they are enough to judge by.
constexpr int LINKS = 16;

// A ball rides if the squares of its neighbours' travels then add up to less than this part; to turn seeds costs something, too.
constexpr Real WORTH_TURNING(0.33);

// The squared length of a travel, units, over 64. It counts as 16 units along each axis at most, so that no sum overflows.
Real squareOfTravel(const Vector& from, const Vector& to)
{
    const Vector by = to - from;
    const auto part = [](Real a) { return shiftDown(clamp(a, Real(-16), Real(16)), 3); };
    const Vector eighth{part(by.x), part(by.y), part(by.z)};
    return dot(eighth, eighth);
}

// How far the neighbours of a ball travel beside it: in the axes of the world, and in axes that turn with it.
struct Travels {
    Real inWorld{0}, riding{0};

    // Adds a step of a ball and a neighbour, unless they are `range` apart or more. The poses at its end are `next` further on.
    void add(const Pose* ball, const Pose* other, int next, Real range)
    {
        if (!isNearer(ball[0].place, other[0].place, range))
            return;
        const Vector from = other[0].place - ball[0].place, to = other[next].place - ball[next].place;
        inWorld += squareOfTravel(from, to);
        riding += squareOfTravel(turnedBack(ball[0].turn, from), turnedBack(ball[next].turn, to));
    }
};

// The index of the item that an object belongs to.
int itemOf(const Model& model, const SoftObject& object)
{
    int i = 0;
    while (model.item(i).object != &object)
        ++i;
    return i;
}

// Whether the ball of the item with this index is to ride. `poses` holds those of all items at the beginning and at the end of
// each step.
bool isRider(const Model& model, int index, const Pose* poses)
{
    const int items = model.items();
    Travels travels;
    int left = LINKS;
    for (const auto* node = model.item(index).object->skel().first(); node != nullptr && left > 0; node = node->next, --left) {
        const int other = itemOf(model, *node->item.object);
        const Real range = model.item(index).object->reach() + node->item.object->reach();
        for (int step = 0; step < STEPS; ++step) {
            const Pose* const begin = poses + 2 * step * items;
            travels.add(begin + index, begin + other, items, range);
        }
    }
    return travels.riding < travels.inWorld * WORTH_TURNING;
}

}  // namespace

void Anim::chooseRiders(Model& model)
{
    const int items = model.items();
    Pose* const poses = allocate<Pose>(static_cast<uint32_t>((2 * STEPS + 1) * items));
    if (poses == nullptr)
        return;
    Pose* const present = poses + 2 * STEPS * items;
    for (int j = 0; j < items; ++j)
        present[j] = model.item(j).pose;
    for (int i = 0; i < 2 * STEPS; ++i)
        for (int j = 0; j < items; ++j) {
            const Time time = static_cast<Time>(i / 2) * APART + static_cast<Time>(i % 2) * STEP;
            poses[i * items + j] = model.item(j).pose = poseOf(model, model.item(j), time);
        }
    for (int j = 0; j < items; ++j) {
        Actor& actor = model.item(j);
        if (actor.object != nullptr && actor.object->isBall() && actor.motion.parent != 0)
            actor.object->setRides(isRider(model, j, poses));
        actor.pose = present[j];
    }
    free(poses);
}
