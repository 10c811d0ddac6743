// Keeper: coherence over time. The voxels of patches are kept from frame to frame. While neither the object nor the viewer nor the
// light moves, those of patches that have not been settled stay as they are. Over a few frames most patches change evenly: each of
// their voxels moves, tilts and brightens as in the frames before. Such voxels go on by the same steps for up to seven frames, with
// the slopes of brightness that they have, and the seeds are not settled meanwhile. Without this file the program is slower, and
// the picture hardly different.
#ifndef FB_KEEPER_H
#define FB_KEEPER_H

#include "odometer.h"
#include "slopes.h"
#include "voxels.h"

// The voxels of a patch as they have just been made: of which seed each is, and from which entry on the slopes have got them.
struct PatchVoxels {
    const Voxel* voxels;
    const Seen* seen;
    int count, sloped;
    bool bordered;  // VoxelList::bordered
};

// The voxels that the patches of one object have kept. Patches are counted from 0.
class Keeper {
public:
    explicit Keeper(const SoftObject& object) : object_(object) {}
    ~Keeper();
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;

    // Makes room for `count` patches. Without that, or without memory, nothing is kept.
    void open(int count);
    // Forgets all voxels, because the seeds have been laid out elsewhere or an update was stopped.
    void forget() { draws_ = 0; }
    // Forgets those of a patch, because its seeds have been settled.
    void forgetPatch(int number)
    {
        if (count_ > 0)
            kept_[number].viewNumber = 0;
    }

    // Begins a frame. `travel` is how far the object's neighbours have travelled since the frame before.
    void begin(const OwnFrame& own, Travel travel);

    // Whether the voxels of a patch go on in this frame. If it blends its seeds need not be settled.
    bool goesOn(int number, const Patch& patch) const
    {
        return count_ > 0 && kept_[number].left != 0 && kept_[number].drawn == frame_ - 1 && kept_[number].state == patch.state &&
               !patch.islands && mayGoOn(patch, kept_[number].count);
    }
    // Whether they are those of this frame, because nothing has changed.
    bool stands(int number, const Patch& patch) const
    {
        return motion_ == STANDS && kept_[number].viewNumber == viewNumber_ && kept_[number].state == patch.state &&
               !patch.islands;
    }
    // Adds the voxels of such a patch to the list and to the slopes, after a step if they go on (`goes`: goesOn() in this frame).
    void list(int number, bool goes, VoxelList& list, Slopes& slopes);
    // Keeps voxels that have been made in this frame. All of them are in the object's own colour.
    void keep(int number, const Patch& patch, const PatchVoxels& made, Slopes& slopes)
    {
        const bool goes = mayGoOn(patch, made.count);
        if ((goes || motion_ == STANDS) && !patch.islands)
            store(kept_[number], patch, made, goes, slopes);
    }

private:
    static constexpr int32_t NONE = -1;
    // A voxel, and how it changes from one frame to the next.
    struct One {
        Voxel voxel;
        const Seed* seed;
        int32_t number;             // number of its seed if the slopes have got the voxel; otherwise NONE
        int32_t place[3], step[3];  // Voxel::x, y, z with 4 more fraction bits, and their change
        int16_t light, stepLight;   // Voxel::brightness with 8 more fraction bits
        int16_t back, stepBack;     // Voxel::back with 7 more fraction bits
        int16_t stepTiltX, stepTiltY, stepCutAt;

        void begin(const Voxel& v, const Seed* of, const One* like);
        // Takes another voxel, and leaves the rest as it is.
        void set(const Voxel& v)
        {
            voxel = v;
            number = NONE;
        }
        void goOn();
        int32_t follow(const Voxel& v, int shift, int tiltShift, int32_t otherwise);
    };
    struct Kept {
        One* voxels;
        uint32_t viewNumber;  // viewNumber_ when they were kept; 0: they are not right any more
        uint32_t drawn;       // number of the frame in which they were drawn last
        int32_t facing;       // of a blending patch without voxels: facing() of the seed that is the nearest to be seen, or HIDDEN
        uint8_t count, room;  // voxels, and how many there is room for
        uint8_t period, left; // they are made once in `period` frames; frames left until then
        bool stepsKnown;      // they were made at least twice, in consecutive frames
        PatchState state;
        bool bordered;        // VoxelList::bordered
    };
    // How the object, the viewer and the light move: not at all, as in the frame before, the same but turning fast, or otherwise.
    // What rests does not go on straight while it turns fast; where patches blend the error of the steps tells.
    enum Motion { STANDS, EVEN, FAST, JOLTS };

    // Whether a patch may go on. One without voxels has nothing that would have to move evenly.
    bool mayGoOn(const Patch& patch, int voxels) const
    {
        if (patch.state == PATCH_MIXED)
            return longest_ > 1 && (motion_ != JOLTS || voxels == 0);
        return patch.state == PATCH_REST && motion_ == EVEN;
    }
    Motion motionOf(const OwnFrame& own);
    void store(Kept& kept, const Patch& patch, const PatchVoxels& made, bool goes, Slopes& slopes) const;
    static bool makeRoom(Kept& kept, int count);
    static bool clear(Kept& kept, int count);
    static bool hasSameSeeds(const Kept& kept, const PatchVoxels& made);
    static bool rearrange(Kept& kept, const PatchVoxels& made);
    void follow(Kept& kept, const Patch& patch, const PatchVoxels& made, bool follows, bool sameSeeds) const;
    const One* correctSteps(Kept& kept, const Patch& patch, const PatchVoxels& made, int32_t* error) const;
    int inTurn(const Kept& kept, int period) const;
    int longestUnseen(Kept& kept, const Patch& patch) const;
    int32_t toleratedOf(const Patch& patch) const { return patch.state == PATCH_MIXED ? tolerated_ : tolerated_ / 2; }

    const SoftObject& object_;
    Kept* kept_ = nullptr;
    int count_ = 0;
    int32_t tolerated_ = 0;   // the error of a step that is tolerated where patches blend, 1/256 unit
    int draws_ = 0;           // how often the object has been drawn; 3: more than twice
    uint32_t frame_ = 1;      // number of this frame
    uint32_t viewNumber_ = 0; // number of the present view: it grows whenever the object, the viewer or the light has moved
    Motion motion_ = JOLTS;
    Travel travel_ = 0;       // travel of the neighbours
    int longest_ = 1;         // the longest period that they allow where patches blend
    int32_t viewChange_[15] = {};  // the last change of how the object is seen and lit
    OwnFrame own_{};          // how it was drawn last: the frame,
    int32_t paintedAs_ = -1;  // and its finish (256 times that) and the number of its colour, or -1 if it has no paint
};

#endif
