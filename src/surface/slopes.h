// How the brightness changes across scales where no patch bends evenly: from each seed to those beside it, in whichever patch they
// are.
#ifndef FB_SLOPES_H
#define FB_SLOPES_H

#include "model/seed.h"
#include "surface/voxel.h"

// The voxels of one object that show regular seeds which blend, or shine.
class Slopes {
public:
    // How far the ray of sight leads aside over a unit of depth, 10 bits of fraction, in one word; and where slopes stay.
    static constexpr int32_t STAYS = INT32_MAX;
    static int32_t sight(int32_t shearX, int32_t shearY) { return shearX * 65536 + (shearY & 0xffff); }

    // Forgets all voxels.
    void begin() { count_ = 0; }

    // A voxel shows seed `number` of its object, `*seed`. It comes behind those of the rings before.
    void add(const Seed* seed, int number, Voxel* voxel, int32_t sight)
    {
        Shown& shown = shown_[count_];
        shown = {number, sight, voxel, voxel, voxel};
        // A seed is beside N of the one before it in its ring (model/seed.h).
        const int n = number > 0 ? seed[-1].neighbour : -1;
        if (Shown* const before = n >= 0 ? find(n >> 1) : nullptr) {
            shown.before = before->voxel;
            before->behind = voxel;
        }
        table_[number & (TABLE - 1)] = static_cast<int16_t>(count_++);
    }
    // And so does another, the slopes of which are to be the same.
    void addCopy(Voxel* voxel, Voxel* original) { shown_[count_++] = {COPY, 0, voxel, original, original}; }

    // Sets the slopes of the voxels that have a sight: along the ring, and from the ring before to the one behind. In a direction
    // in which no seed beside one is lit they stay. Seeds are `spacing` apart, 1/256 unit.
    void set(int32_t spacing);

private:
    struct Shown {
        int32_t number;  // of the seed, or COPY
        int32_t sight;
        Voxel *voxel, *before, *behind;  // its own, and those of seeds beside it in the rings before and behind, or its own
    };
    Shown* find(int number)
    {
        const int i = table_[number & (TABLE - 1)];
        return i < count_ && shown_[i].number == number ? shown_ + i : nullptr;
    }

    // Seeds are looked up by the last bits of their numbers, which tell those of some rings apart.
    static constexpr int TABLE = 1024, COPY = -2;
    int count_;
    Shown shown_[VOXELS_AT_ONCE];
    int16_t table_[TABLE];
};

#endif
