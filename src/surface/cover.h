// Cover: the one neighbour that alone keeps the seeds of a patch off the surface, so that none other need be asked. Without it only
// the speed would change.
#ifndef FB_COVER_H
#define FB_COVER_H

#include "path.h"

class Cover {
public:
    Cover(const SoftObject& object, const Neighbourhood& all, const Nearby& nearby, Path& path)
        : object_(object), all_(all), nearby_(nearby), path_(path)
    {
    }

    // Takes up the neighbour that was the strongest where a seed of the patch was not on the surface the last time.
    void setPatch(const Patch& patch);

    // Whether it is sure to keep a seed off the surface, wherever that was before; and all seeds of the patch.
    bool hides(const Seed& s) { return limits_ != nullptr && hidesPath(s); }
    bool hidesAll(const Patch& patch) const;

    // The slot of the neighbour whose field is the strongest where the path at hand was looked at last.
    int strongest() const;

private:
    bool hidesPath(const Seed& s);

    const SoftObject& object_;
    const Neighbourhood& all_;
    const Nearby& nearby_;
    Path& path_;
    int number_ = -1;  // of the neighbour; -1: none
    // What it takes: its t (model/field.h) is less than these at two positions of a path. And the roots of the two. Null: that is
    // not known.
    struct Limits {
        Real there, atRest, rootThere, rootAtRest;
    };
    static const Limits LINKED, UNLINKED;
    const Limits* limits_ = nullptr;
};

#endif
