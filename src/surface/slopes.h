// Slopes: how the brightness changes across scales where patches bend unevenly. It is measured from the seeds beside each seed,
// whichever patch they belong to.
#ifndef FB_SLOPES_H
#define FB_SLOPES_H

#include "model/seed.h"
#include "rt.h"
#include "surface/voxel.h"

// The voxels of one object that show the regular seeds of patches that blend, have ridges or bend unevenly, or all regular seeds if
// the object is shaped or shines.
class Slopes {
public:
    // The ray of sight in one word: how far it leads aside over a unit of depth, x and y with 10 fraction bits. STAYS in its place
    // means that the voxel keeps its slopes.
    static constexpr int32_t STAYS = INT32_MAX;
    static int32_t sight(int32_t shearX, int32_t shearY) { return shearX * 65536 + (shearY & 0xffff); }

    // Forgets all voxels.
    void begin()
    {
        count_ = 0;
        round_ += NUMBERS;
        if (round_ != 0)
            return;
        memset(keys_, 0, sizeof keys_);
        round_ = NUMBERS;
    }

    // Adds a voxel, which shows `*seed`, seed `number` of its object. The seeds of earlier rings must have been added before.
    void add(const Seed* seed, int number, Voxel* voxel, int32_t sight)
    {
        Shown& shown = shown_[count_++];
        shown = {keyOf(number), sight, voxel, voxel, voxel, nullptr};
        enter(seed, number, voxel, &shown);
    }
    // Adds a voxel of an earlier frame, which keeps its slopes.
    void addKept(const Seed* seed, int number, Voxel* voxel) { enter(seed, number, voxel, nullptr); }
    // Adds another voxel of the seed added last; it gets the slopes of the original.
    void addCopy(Voxel* voxel, Voxel* original) { shown_[count_++] = {COPY, 0, voxel, original, original, nullptr}; }

    // How many voxels have been added, without those of earlier frames; which one was added as number `i`, and the number of its
    // seed.
    int count() const { return count_; }
    const Voxel* voxel(int i) const { return shown_[i].voxel; }
    int32_t number(int i) const { return static_cast<int32_t>(shown_[i].key - round_); }
    // Lets set() write the slopes and the brightness of that voxel to another one, too.
    void keepIn(int i, Voxel* kept) { shown_[i].kept = kept; }

    // Sets the slopes of all voxels but those that keep them, from the seeds beside each seed: along its ring, and in the rings
    // before and behind. In a direction where no seed beside it is lit, a slope stays. Seeds are `spacing` apart, 1/256 unit.
    void set(int32_t spacing);

private:
    struct Shown {
        uint32_t key;    // number of the seed plus round_, or COPY
        int32_t sight;
        // The seed's voxel, and those of the seeds beside it in the rings before and behind: its own where there is none. The
        // `before` of a copy is the original.
        Voxel *voxel, *before, *behind;
        Voxel* kept;     // the other voxel of keepIn(), or null
    };

    uint32_t keyOf(int number) const { return round_ + static_cast<uint32_t>(number); }
    // The voxel in the table with a key; `other` if there is none.
    Voxel* voxelOf(uint32_t key, Voxel* other) const { return keys_[key % TABLE] == key ? voxels_[key % TABLE] : other; }
    // Enters a voxel in the table. It and the one beside it in the ring before become each other's neighbours. `shown` is its entry
    // of shown_; null if it is of an earlier frame.
    void enter(const Seed* seed, int number, Voxel* voxel, Shown* shown)
    {
        const uint32_t key = keyOf(number), at = key % TABLE;
        keys_[at] = key;
        voxels_[at] = voxel;
        shownAs_[at] = shown;
        // In the ring before, a seed lies beside the seed N of its predecessor in its own ring (model/seed.h). Across a ridge the
        // brightness jumps.
        const int n = number > 0 ? seed[-1].neighbour : -1;
        if (n < 0)
            return;
        const uint32_t beside = keyOf(n >> 1), before = beside % TABLE;
        if (keys_[before] != beside || (seed->beyond >= 0 && seed[(n >> 1) - number].beyond >= 0))
            return;
        if (shownAs_[before] != nullptr)
            shownAs_[before]->behind = voxel;
        if (shown != nullptr)
            shown->before = voxels_[before];
    }

    // Every member has a value from the start, so that a static object takes no code at the start of the program.
    int count_ = 0;
    Shown shown_[VOXELS_AT_ONCE] = {};
    // A table of all voxels: the key, the voxel, and its entry of shown_ or null. It is searched by the low bits of the key, which
    // differ within a few neighbouring rings. The numbers of seeds are less than NUMBERS, which round_ grows by, so that no entry
    // of another object or of an earlier frame has the key of one of this.
    static constexpr uint32_t TABLE = 1024, NUMBERS = 1 << 17, COPY = 0;
    static_assert(NUMBERS % TABLE == 0, "a key has the low bits of its number");
    uint32_t round_ = 0;
    uint32_t keys_[TABLE] = {};
    Voxel* voxels_[TABLE] = {};
    Shown* shownAs_[TABLE] = {};
};

#endif
