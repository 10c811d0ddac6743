// Cover: a neighbour that alone keeps a seed, or all seeds of a patch, off the surface, so that none other need be asked. Without
// it only the speed would change.
#ifndef FB_COVER_H
#define FB_COVER_H

#include "path.h"

class Cover {
public:
    Cover(const SoftObject& object, Neighbourhood& all, const Nearby& nearby, Path& path)
        : object_(object), all_(all), nearby_(nearby), path_(path)
    {
    }

    // Whether the neighbour that was the strongest where a seed was not on the surface the last time is sure to keep it off the
    // surface (no path is at hand afterwards); and whether the one that was it in the middle of a patch does so to all its seeds.
    bool covers(const Seed& s)
    {
        take(s.blocker);
        return limits_ != nullptr && coversPath(s);
    }
    bool coversAll(const Patch& patch);

    // The slot of the neighbour whose field is the strongest where the path at hand was looked at last.
    int strongest() const;

private:
    void take(int blocker)
    {
        if (blocker != blocker_)
            find(blocker);
    }
    void find(int blocker);
    bool coversPath(const Seed& s);
    // Whether the link with it is so heavy that a path may leave the surface, leading away from it, where the two are alike.
    bool isHeavy() const { return nearby_.weight(blocker_) > Real(1); }

    const SoftObject& object_;
    Neighbourhood& all_;
    const Nearby& nearby_;
    Path& path_;
    int blocker_ = -1;  // slot of the neighbour at hand; -1: none yet
    Neighbour* near_;   // the same; null: it is none
    // What it takes, if it is linked with the object at some weight or more: its t (model/field.h) is less than these at two
    // positions of a path. And the roots of the two. Null: that is not known.
    struct Limits {
        Real weight, there, atRest, rootThere, rootAtRest;
    };
    static const Limits LIMITS[];
    const Limits* limits_ = nullptr;
};

#endif
