// Slopes: how the brightness changes across scales where patches bend unevenly. It is measured from the seeds beside each seed,
// whichever patch they belong to.
#ifndef FB_SLOPES_H
#define FB_SLOPES_H

#include "model/seed.h"
#include "surface/voxel.h"

// The voxels of one object that show the regular seeds of blending patches, or all regular seeds if the object shines.
class Slopes {
public:
    // The ray of sight in one word: how far it leads aside over a unit of depth, x and y with 10 fraction bits. STAYS in its place
    // means that the voxel keeps its slopes.
    static constexpr int32_t STAYS = INT32_MAX;
    static int32_t sight(int32_t shearX, int32_t shearY) { return shearX * 65536 + (shearY & 0xffff); }

    // Forgets all voxels.
    void begin() { count_ = 0; }

    // Adds a voxel, which shows `*seed`, seed `number` of its object. The seeds of earlier rings must have been added before.
    void add(const Seed* seed, int number, Voxel* voxel, int32_t sight)
    {
        Shown& shown = shown_[count_];
        shown = {number, sight, voxel, voxel, voxel, nullptr};
        // In the ring before, a seed lies beside the seed N of its predecessor in its own ring (model/seed.h).
        const int n = number > 0 ? seed[-1].neighbour : -1;
        if (Shown* const before = n >= 0 ? find(n >> 1) : nullptr) {
            shown.before = before->voxel;
            before->behind = voxel;
        }
        table_[number & (TABLE - 1)] = static_cast<int16_t>(count_++);
    }
    // Adds another voxel of the seed added last; it gets the slopes of the original.
    void addCopy(Voxel* voxel, Voxel* original) { shown_[count_++] = {COPY, 0, voxel, original, original, nullptr}; }

    // The number of voxels that have been added; and of the one that was added as number `i`: which one it is, and the number of
    // its seed.
    int count() const { return count_; }
    const Voxel* voxel(int i) const { return shown_[i].voxel; }
    int32_t number(int i) const { return shown_[i].number; }
    // Lets set() write the slopes and the brightness of that voxel to another one, too.
    void keepIn(int i, Voxel* kept) { shown_[i].kept = kept; }

    // Sets the slopes of all voxels but those that keep them, from the seeds beside each seed: along its ring, and in the rings
    // before and behind. In a direction where no seed beside it is lit, a slope stays. Seeds are `spacing` apart, 1/256 unit.
    void set(int32_t spacing);

private:
    struct Shown {
        int32_t number;  // number of the seed, or COPY
        int32_t sight;
        // The seed's voxel, and those of the seeds beside it in the rings before and behind: its own where there is none. The
        // `before` of a copy is the original.
        Voxel *voxel, *before, *behind;
        Voxel* kept;     // the other voxel of keepIn(), or null
    };
    Shown* find(int number)
    {
        const int i = table_[number & (TABLE - 1)];
        return i < count_ && shown_[i].number == number ? shown_ + i : nullptr;
    }

    // Seeds are looked up by the low bits of their numbers, which differ within a few neighbouring rings.
    static constexpr int TABLE = 1024, COPY = -2;
    int count_;
    Shown shown_[VOXELS_AT_ONCE];
    int16_t table_[TABLE];
};

#endif
