// Keeps the voxels of what stands still.
#include "still.h"

#include "math/alloc.h"
#include "rt.h"

namespace {

bool isSame(const int32_t a[3], const int32_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// Whether an object is seen and lit in two frames from the same places.
bool isSame(const OwnFrame& a, const OwnFrame& b)
{
    return isSame(a.eye32, b.eye32) && isSame(a.centre, b.centre) && isSame(a.light, b.light) && isSame(a.right, b.right) &&
           isSame(a.up, b.up) && isSame(a.ahead, b.ahead) && a.growth == b.growth && a.distance32 == b.distance32;
}

}  // namespace

Still::~Still()
{
    for (int i = 0; i < count_; ++i)
        free(kept_[i].voxels);
    free(kept_);
}

void Still::open(int count)
{
    kept_ = allocate<Kept>(static_cast<uint32_t>(count));
    count_ = kept_ == nullptr ? 0 : count;
    for (int i = 0; i < count_; ++i)
        kept_[i] = Kept{};
}

void Still::begin(const OwnFrame& own, const Paint* paint)
{
    if (count_ == 0)
        return;
    const int32_t paintedAs = paint == nullptr ? -1 : paint->finish << 8 | paint->number;
    if (draws_ > 0 && isSame(own, frame_) && paintedAs == paintedAs_) {
        draws_ = 2;
        return;
    }
    draws_ = 1;
    ++since_;
    frame_ = own;
    paintedAs_ = paintedAs;
}

void Still::list(int number, const Seed* seeds, VoxelList& list, Slopes& slopes) const
{
    const Kept& kept = kept_[number];
    for (const One *one = kept.voxels, *const end = one + kept.count; one < end; ++one) {
        Voxel* const voxel = list.room();
        *voxel = one->voxel;
        list.number[list.count] = static_cast<uint8_t>(paintedAs_);
        list.take();
        const int32_t seed = one->added.number;
        if (seed != Slopes::NONE)
            slopes.add(seeds + seed, seed, voxel, one->added.sight);
    }
    list.bordered |= kept.bordered;
}

void Still::store(Kept& kept, const Patch& patch, int first, const VoxelList& list, int sloped, const Slopes& slopes) const
{
    const int count = list.count - first;
    kept.since = 0;
    if (count > kept.room) {
        free(kept.voxels);
        kept.voxels = allocate<One>(static_cast<uint32_t>(count));
        kept.room = static_cast<uint8_t>(kept.voxels == nullptr ? 0 : count);
        if (kept.room == 0)
            return;
    }
    for (int i = 0; i < count; ++i)
        kept.voxels[i] = {list.voxels[first + i], {Slopes::NONE, 0}};
    for (int i = sloped; i < slopes.count(); ++i)
        kept.voxels[slopes.voxel(i) - list.voxels - first].added = slopes.added(i);
    kept.count = static_cast<uint8_t>(count);
    kept.state = patch.state;
    kept.bordered = list.bordered;
    kept.since = since_;
}
