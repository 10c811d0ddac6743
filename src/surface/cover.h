// Cover: tests whether one neighbour alone keeps a seed, or all seeds of a patch, inside the body, so that no other neighbour need
// be looked at. It is wrong about a few paths in a thousand at most, near the border. Without it the program would be slower, and
// the picture hardly different.
#ifndef FB_COVER_H
#define FB_COVER_H

#include "path.h"

class Cover {
public:
    Cover(const SoftObject& object, Neighbourhood& all, const Nearby& nearby, Path& path)
        : object_(object), all_(all), nearby_(nearby), path_(path)
    {
    }

    // Whether a seed's blocker, the neighbour that was the strongest when the seed was found off the surface, almost certainly
    // keeps it off the surface again; and whether a patch's blocker does so for all seeds of the patch. If it does, coversAll()
    // returns how far the blocker would have to move, at least, before it does not, 1/16 unit; else 0 or less. No path is current
    // after covers().
    bool covers(const Seed& s)
    {
        take(s.blocker);
        return limits_ != nullptr && coversPath(s);
    }
    int32_t coversAll(const Patch& patch);

private:
    void take(int blocker)
    {
        if (blocker != blocker_)
            find(blocker);
    }
    void find(int blocker);
    bool coversPath(const Seed& s);
    // Whether the link with the blocker is so heavy that a path that leads away from it may leave the surface where the two fields
    // are about equal.
    bool isHeavy() const { return nearby_.weight(blocker_) > Real(1); }

    const SoftObject& object_;
    Neighbourhood& all_;
    const Nearby& nearby_;
    Path& path_;
    int blocker_ = -1;  // slot of the current blocker, -1 at first
    Neighbour* near_;   // that neighbour; null if the object is out of range now
    // A blocker that is linked with the object at `weight` or more covers a path if its t (model/field.h) is less than `there` at
    // position COVERED_AT and less than `atRest` at position 1. `rootThere` and `rootAtRest` are the square roots of the two.
    struct Limits {
        Real weight, there, atRest, rootThere, rootAtRest;
    };
    static const Limits LIMITS[];
    const Limits* limits_ = nullptr;  // those of the current blocker; null if it cannot be judged
};

#endif
