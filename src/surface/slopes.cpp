// Slopes of the brightness, from the voxels of the seeds beside each seed.
#include "slopes.h"

#include "voxels.h"

namespace {

// Spacings on the picture plane: two seeds on both sides of another count only if they are no farther apart along x and along y.
constexpr int FARTHEST = 6;

// Limit of the slopes, 1/8 step a unit, so that nothing overflows; setSlopes() limits them further.
constexpr int32_t STEEPEST = 8191;

// A step on the picture plane, 1/64 unit, and the change of the brightness over it, 1/16 step.
struct Step {
    int32_t x, y, change;

    // The step from voxel `a` to voxel `b`. A dark one of the two is replaced by `between`, the voxel between them.
    Step(const Voxel* a, const Voxel* b, const Voxel* between, int32_t sight)
    {
        if (a->brightness == 0)
            a = between;
        if (b->brightness == 0)
            b = between;
        const int32_t z = b->z - a->z;
        x = (b->x - a->x - (z * (sight >> 16) >> 10)) >> 2;
        y = (b->y - a->y - (z * static_cast<int16_t>(sight) >> 10)) >> 2;
        change = (b->brightness - a->brightness) * 16;
    }
    Step(int32_t toX, int32_t toY, int32_t by) : x(toX), y(toY), change(by) {}
    bool isLonger(int32_t most) const
    {
        return static_cast<uint32_t>(x + most) > static_cast<uint32_t>(2 * most) ||
               static_cast<uint32_t>(y + most) > static_cast<uint32_t>(2 * most);
    }
};

}  // namespace

void Slopes::set(int32_t spacing)
{
    const int32_t most = spacing * FARTHEST >> 2, least = (spacing >> 2) * (spacing >> 2) >> 3;
    for (Shown *shown = shown_, *const end = shown_ + count_; shown < end; ++shown) {
        Voxel& v = *shown->voxel;
        if (shown->sight == STAYS)
            continue;
        if (shown->key == COPY) {
            v.brightness = shown->before->brightness;
            v.slopeX = shown->before->slopeX;
            v.slopeY = shown->before->slopeY;
            continue;
        }
        Step along(voxelOf(shown->key - 1, &v), voxelOf(shown->key + 1, &v), &v, shown->sight);
        Step across(shown->before, shown->behind, &v, shown->sight);
        if (along.isLonger(most))
            along = {0, 0, 0};
        if (across.isLonger(most))
            across = {0, 0, 0};
        int32_t area = along.x * across.y - along.y * across.x;
        if (magnitude(area) < least) {
            // The steps are nearly parallel, or one is missing: the slope at right angles to the longer one stays as it is.
            if (magnitude(along.x) + magnitude(along.y) < magnitude(across.x) + magnitude(across.y))
                along = across;
            across = {-along.y, along.x, (v.slopeY * along.x - v.slopeX * along.y) >> 5};
            area = along.x * along.x + along.y * along.y;
            if (area < least)
                continue;
        }
        setSlopes(limited((along.change * across.y - across.change * along.y) * 32 / area, STEEPEST),
                  limited((across.change * along.x - along.change * across.x) * 32 / area, STEEPEST), &v);
        if (shown->kept != nullptr) {
            shown->kept->brightness = v.brightness;
            shown->kept->slopeX = v.slopeX;
            shown->kept->slopeY = v.slopeY;
        }
    }
}
