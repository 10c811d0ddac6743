// Keeper: coherence over time. Voxels of patches that have not been settled are kept from frame to frame. While neither the object
// nor the viewer nor the light moves they stay as they are. Those of a patch at rest that is seen to turn or to come nearer evenly
// go on as in the frames before, for up to seven frames. Without this file the program is slower, and the picture hardly different.
#ifndef FB_KEEPER_H
#define FB_KEEPER_H

#include "model/paint.h"
#include "patch.h"
#include "slopes.h"

// The voxels that the patches of one object have kept. Patches are counted from 0.
class Keeper {
public:
    Keeper() = default;
    ~Keeper();
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;

    // Makes room for `count` patches of seeds that are `spacing` apart. Without that, or without memory, nothing is kept.
    void open(int count, Real spacing);
    // Forgets all voxels, because the seeds have been laid out elsewhere; or those of a patch, because its seeds have moved.
    void forget() { draws_ = 0; }
    void forget(int number)
    {
        if (count_ > 0)
            kept_[number].since = kept_[number].drawn = 0;
    }

    // Begins the drawing of a frame. `paint` is the object's, or null.
    void begin(const OwnFrame& own, const Paint* paint);

    // Whether the voxels that a patch has kept are those of this frame, or may go on; and adds them to the list and to the slopes.
    // `seeds` are the object's regular seeds.
    bool has(int number, const Patch& patch)
    {
        if (count_ == 0 || kept_[number].state != patch.state || patch.islands)
            return false;
        return stands_ ? kept_[number].since == since_ : goesOn(kept_[number]);
    }
    void list(int number, const Seed* seeds, VoxelList& list, Slopes& slopes);
    // Keeps the voxels of a patch: those of the list from `first` on, of which the slopes have got those from `sloped` on. All of
    // them are in the object's own colour, and the list has no guests among them.
    void keep(int number, const Patch& patch, int first, const VoxelList& list, int sloped, const Slopes& slopes)
    {
        if (count_ == 0 || patch.islands)
            return;
        if (stands_ || (patch.state == PATCH_REST && movesEvenly()))
            store(kept_[number], patch, first, list, sloped, slopes);
    }

private:
    // A voxel, and how it changes from one frame to the next.
    struct One {
        Voxel voxel;
        Slopes::Added added;        // how the slopes have got it
        int32_t place[3], step[3];  // Voxel::x, y, z with 4 more fraction bits, and their change
        int16_t light, stepLight;   // Voxel::brightness with 8 more fraction bits
        int16_t reach, stepReach;   // Voxel::reach with 7 more fraction bits
        int16_t stepTiltX, stepTiltY, stepCutAt;

        explicit One(const Voxel& v);
        // Takes another voxel, and leaves the steps as they are.
        void set(const Voxel& v)
        {
            voxel = v;
            added = {Slopes::NONE, 0};
        }
        void goOn();
        int32_t follow(const Voxel& v, int shift);
    };
    struct Kept {
        One* voxels;
        uint32_t since;       // since_ when they were kept; 0: they are not valid
        uint32_t drawn;       // number of the frame in which they were drawn last
        uint8_t count, room;  // voxels, and how many there is room for
        uint8_t period, left; // they are made once in `period` frames; frames left until then
        uint8_t pause;        // for so many frames none are kept while something moves, because they changed unevenly
        bool stepsKnown;      // they were made at least twice, in consecutive frames
        PatchState state;
        bool bordered;        // VoxelList::bordered
    };
    bool goesOn(const Kept& kept) { return kept.left != 0 && kept.drawn == frame_ - 1 && movesEvenly(); }
    bool movesEvenly();
    void store(Kept& kept, const Patch& patch, int first, const VoxelList& list, int sloped, const Slopes& slopes) const;
    void follow(Kept& kept, const Voxel* voxels) const;

    // How the object is seen and lit: the first AXES parts are the axes of the view and the light (1.0 = 2^14), the others the eye
    // (1/32 unit).
    static constexpr int PARTS = 15, AXES = 12;
    typedef int32_t View[PARTS];

    Kept* kept_ = nullptr;
    int count_ = 0;
    int32_t tolerated_ = 0;   // toleratedError()
    int draws_ = 0;           // how often the object has been drawn; 3: more than twice
    uint32_t frame_ = 1;      // number of this frame
    uint32_t since_ = 0;      // how often it has been drawn otherwise than the time before
    bool stands_ = false;     // it is drawn as the time before
    enum { UNKNOWN, EVEN, UNEVEN } motion_ = UNKNOWN;  // how it moves, once movesEvenly() has been asked
    View views_[3];           // of this frame and the two before, by the remainder of their numbers
    OwnFrame own_;            // how it was drawn last: the frame,
    int32_t paintedAs_ = -1;  // and its finish (256 times that) and the number of its colour, or -1 if it has no paint
};

#endif
