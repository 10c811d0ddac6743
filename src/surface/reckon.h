// Dead reckoning: coherence over time. Over a few frames most patches blend evenly: their seeds go on along their paths, and their
// normals turn, as in the frames before. A patch whose seeds were found where such steps had led is moved on by the same steps for
// one to seven frames, and not settled meanwhile. Without this file the program is slower and the picture hardly different.
#ifndef FB_RECKON_H
#define FB_RECKON_H

#include "odometer.h"

// How the seeds of all patches of one object move.
class Reckoning {
public:
    explicit Reckoning(SoftObject& object) : object_(object) {}
    ~Reckoning();
    Reckoning(const Reckoning&) = delete;
    Reckoning& operator=(const Reckoning&) = delete;

    // Makes the tracks of `count` patches. Without that, or without memory, no patch is ever moved on.
    void open(int count);
    // Forgets where the seeds were, because they have been laid out elsewhere.
    void forget() { ++update_; }

    // Begins an update of the object. `travel` is how far its neighbours have travelled since the update before. Without
    // `mayMove` no patch is moved on in it.
    void begin(Travel travel, bool mayMove);

    // Whether a patch is moved on in this update. `number` counts the object's patches.
    bool moves(int number, const Patch& patch) const
    {
        return isEven_ && tracks_[number].left != 0 && tracks_[number].update == update_ - 1 && patch.state == PATCH_MIXED &&
               !patch.islands;
    }
    // Moves the seeds of such a patch on.
    void move(int number, const Patch& patch);
    // Follows the seeds of a patch that has been settled in this update, with its oversampled seeds. `smallest` is the size of the
    // smallest of the object and the neighbours that reach the patch, units.
    void follow(int number, const Patch& patch, Real smallest);

private:
    // Where a seed was in the last update, and its steps from one update to the next.
    struct Motion {
        Real position, step;
        Direction14 normal, turn;
        int16_t apart, stepApart;  // Seed::apart
        bool known, bordered;      // it is on the surface and does not rest; it has a border
    };
    struct Track {
        Motion* motions;       // of the patch's regular seeds and, after each, of its oversampled seed; null before they are needed
        uint32_t update;       // number of the update in which the patch was followed or moved on last
        uint8_t age;           // how often its seeds were followed: their steps are known from 2 on
        uint8_t period, left;  // the patch is settled once in `period` updates; updates left until then
    };
    template <class Each>
    void forMotions(const Track& track, const Patch& patch, Each each) const;
    bool prepare(Track& track) const;
    int32_t correct(const Seed& s, int shift, Motion& m) const;

    SoftObject& object_;
    Track* tracks_ = nullptr;
    int count_ = 0;
    Travel farthest_ = 0;    // the constants of reckon.cpp for this object: FAR_SPACINGS and FAR_UNITS as a travel,
    int32_t tolerated_ = 0;  // toleratedError(),
    int32_t near_ = 0;       // and NEAR, 1/256 unit
    uint32_t update_ = 0;    // number of this update
    Travel travel_ = 0;      // travel of the neighbours in it
    bool isEven_ = false;    // they go on as in the update before
};

#endif
