// Still: coherence over time. As long as neither an object nor the viewer nor the light moves, those of its patches that have not
// been settled keep their voxels. Without this file every frame is the same, and takes longer where something stands still.
#ifndef FB_STILL_H
#define FB_STILL_H

#include "model/paint.h"
#include "patch.h"
#include "slopes.h"

// The voxels that the patches of one object have kept. Patches are counted from 0.
class Still {
public:
    Still() = default;
    ~Still();
    Still(const Still&) = delete;
    Still& operator=(const Still&) = delete;

    // Makes room for `count` patches. Without that, or without memory, nothing is kept.
    void open(int count);
    // Forgets all voxels, because the seeds have been laid out elsewhere; or those of a patch, because its seeds have moved.
    void forget() { draws_ = 0; }
    void forget(int number)
    {
        if (count_ > 0)
            kept_[number].since = 0;
    }

    // Begins the drawing of a frame. `paint` is the object's, or null.
    void begin(const OwnFrame& own, const Paint* paint);

    // Whether a patch has kept its voxels; and adds them to the list and to the slopes, as in an earlier frame. `seeds` are the
    // object's regular seeds.
    bool has(int number, const Patch& patch) const
    {
        return draws_ > 1 && kept_[number].since == since_ && kept_[number].state == patch.state && !patch.islands;
    }
    void list(int number, const Seed* seeds, VoxelList& list, Slopes& slopes) const;
    // Keeps the voxels of a patch: those of the list from `first` on, of which the slopes have got those from `sloped` on. All of
    // them are in the object's own colour, and the list has no guests among them.
    void keep(int number, const Patch& patch, int first, const VoxelList& list, int sloped, const Slopes& slopes)
    {
        if (draws_ > 1 && !patch.islands && !patch.bend.stale)
            store(kept_[number], patch, first, list, sloped, slopes);
    }

private:
    struct One {
        Voxel voxel;
        Slopes::Added added;  // how the slopes have got it
    };
    struct Kept {
        One* voxels;
        uint32_t since;       // since_ when they were kept; 0: they are not valid
        uint8_t count, room;  // voxels, and how many there is room for
        PatchState state;
        bool bordered;        // VoxelList::bordered
    };
    void store(Kept& kept, const Patch& patch, int first, const VoxelList& list, int sloped, const Slopes& slopes) const;

    Kept* kept_ = nullptr;
    int count_ = 0;
    int draws_ = 0;       // how often the object has been drawn as it is seen now; 2: more than once
    uint32_t since_ = 0;  // how often it has been drawn otherwise than the time before
    OwnFrame frame_;      // how it was drawn last: the frame,
    int32_t paintedAs_ = -1;  // and its finish (256 times that) and the number of its colour, or -1 if it has no paint
};

#endif
