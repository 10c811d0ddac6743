// Dead reckoning: coherence over time. Over a few frames most patches move evenly, and so do their voxels. A patch whose voxels
// were found where the steps of the frames before had led is moved on by the same steps for one frame, or for three, and meanwhile
// neither settled nor shaded. Without this file the program is slower and the picture hardly different.
#ifndef FB_RECKON_H
#define FB_RECKON_H

#include "odometer.h"
#include "slopes.h"

// The tracks of all patches of one object.
class Reckoning {
public:
    Reckoning() = default;
    ~Reckoning();
    Reckoning(const Reckoning&) = delete;
    Reckoning& operator=(const Reckoning&) = delete;

    // Makes `count` tracks of an object whose seeds are `spacing` apart, units. If they are too many, or there is no memory, no
    // patch is ever moved on.
    void open(int count, Real spacing);
    // Forgets where all voxels were, because the seeds have been laid out elsewhere.
    void forget();

    // Begins a frame in which the object is updated. `travel` is how far its neighbours have travelled since the update before;
    // `known`: none of them has leapt (Odometer::advance()).
    void beginUpdate(const OwnFrame& own, Travel travel, bool known);
    // Begins the drawing of a frame, whether or not the object was updated in it.
    void beginDraw();

    // Whether a patch is moved on in this frame. `number` counts the object's patches.
    bool moves(int number, const Patch& patch) const
    {
        return isEven_ && tracks_[number].left != 0 && tracks_[number].frame == before_ && tracks_[number].state == patch.state &&
               !(patch.settled && isUpdated_) && !patch.islands;
    }
    // Adds the voxels of such a patch to the list, moved on by a frame. `seeds` are the object's regular seeds.
    void move(int number, const Seed* seeds, VoxelList& list, Slopes& slopes);

    // Whether voxels are followed in this frame, so that note() and follow() do anything.
    bool follows() const { return count_ > 0 && pause_ == 0 && travel_ < travelOf(FARTHEST); }
    // Notes that a patch has been shaded: its voxels are those of the list from `first` on, the first `sloped` of which were added
    // to the slopes.
    void note(int number, const Patch& patch, int first, int sloped, const VoxelList& list);
    // Follows the voxels of the patches noted, from number `from` to before `to`. To be called when their slopes are set. If the
    // object is `painted`, its voxels have colours of their own (VoxelList::number).
    void follow(int from, int to, const VoxelList& list, bool painted);

private:
    // Units: nothing is moved on for so long that the neighbours travel farther meanwhile: then their steps are seldom even.
    static constexpr Real FARTHEST{6};

    // A voxel as it was shown last, and its steps from frame to frame in the units of Voxel; the brightness in 1/16 step.
    struct Tracked {
        Voxel voxel;
        const Seed* seed;
        int16_t brightness16;
        int16_t stepX, stepY, stepZ, stepTiltX, stepTiltY, stepBrightness16, stepCutX, stepCutY, stepCutAt;
        uint8_t number;  // VoxelList::number
    };
    struct Track {
        Tracked* voxels;
        int16_t first, listed;  // where its voxels begin in the list, and how many there are; `first` is -1 unless it was noted
        uint16_t frame;         // number of the frame in which the patch was shown last
        uint8_t count, room;    // voxels in the track, and how many there is room for
        uint8_t sloped;         // the first voxels, which take part in slopes (slopes.h)
        uint8_t age;            // how often its voxels were followed: their steps are known from 2 on
        uint8_t period, left;   // the patch is shaded once in `period` frames; frames left until then
        PatchState state;
        bool bordered;          // VoxelList::bordered
    };
    void follow(int number, Track& track, const VoxelList& list, bool painted);
    bool arrange(Track& track, const VoxelList& list);
    void setPeriod(int number, Track& track, int period, bool shaky) const;
    static void setBeside(const Voxel& voxel, Tracked& tracked);

    Track* tracks_ = nullptr;
    int count_ = 0;
    int32_t tolerated_ = 0;                    // error of a single step that is tolerated
    int32_t room_ = 0;                         // how far a border may travel unseen, 1/256 unit: half a spacing
    uint16_t frame_ = 0, before_ = 0;          // numbers of this frame and of the frame before
    bool isEven_ = false;                      // viewer and neighbours go on as in the frame before
    bool isUpdated_ = false, isIdle_ = false;  // the object is updated in this frame; it was not in the frame before
    // Of the update before: the viewer (own axes), the object's growth, two axes of the view and the travel, and
    // the changes of the first three.
    Vector eye_{Real(0), Real(0), Real(0)}, eyeStep_{Real(0), Real(0), Real(0)};
    Real growth_{1}, growthStep_{0};
    int32_t axes_[6] = {}, axesStep_[6] = {};
    Travel travel_ = 0;
    int followed_ = 0;               // how many voxels were followed in this frame
    int saved_ = 0;                  // how many could be followed in the time that moving voxels on saved in this frame
    int vain_ = 0;                   // frames in a row in which following did not pay
    int pause_ = 0, lastPause_ = 0;  // frames for which nothing is followed yet; how many there were the last time
};

#endif
