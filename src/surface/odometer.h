// Odometer: how far the neighbours of an object have come, in its own space, and how far the viewer has come round it. What was
// found out about a patch holds until they have come so far that it might be different: whoever finds it out says how far that
// is, and when the odometer has got there the patch is due. A patch also hears how far those on its own
// lists have come. Were everything always due, nothing but the speed would change.
#ifndef FB_ODOMETER_H
#define FB_ODOMETER_H

#include "nearby.h"
#include "pose.h"

// A way, and the reading of an odometer: 1/1024 unit of own space. Readings go round, so isDue() compares them.
typedef uint32_t Travel;

inline Travel travelOf(Real units)
{
    return static_cast<Travel>(rawFromReal(units) >> 6);
}

inline bool isDue(Travel reading, Travel due)
{
    return static_cast<int32_t>(reading - due) >= 0;
}

// How far neighbours may come that change a field by `push` in a unit, until it has changed by `hold`; at most `longest` units.
Travel travelUntil(Real hold, Real push, Real longest);

class Odometer {
public:
    Odometer() = default;
    ~Odometer();
    Odometer(const Odometer&) = delete;
    Odometer& operator=(const Odometer&) = delete;

    // Finds out how far any neighbour, or the viewer, has come since the last call. False: nothing that was found out before
    // holds, because it is the first call, links have changed, an object has leapt into range or out of it, the first odd one has
    // come or the last gone, or there is no memory.
    bool advance(const SoftObject& object, const OwnFrame& own, const Neighbourhood& all, uint32_t linksVersion);

    Travel reading() const { return reading_; }
    // The same for the farthest places of neighbours that the object could meet.
    Travel bound() const { return bound_; }
    // How far they came since the call before: what is neither stretched nor warped, as far as the farthest place of its core;
    // what is, as far as it came where the object has its centre, and half as far as its farthest place at least.
    Travel lastTravel() const { return lastTravel_; }
    // Whether the viewer has come round the object since then.
    bool eyeStayed() const { return eyeStayed_; }

    // Counts on for a patch, whose lists hold, how far those on them came since the call before. False: none of them came at all.
    SELDOM bool count(Patch& patch) const;
    // Whether any of a few neighbours came since then.
    SELDOM bool hasMoved(const Neighbourhood& all, const NeighbourList& list) const;

private:
    bool makeRoom(int count);
    Travel travelOfEye(const SoftObject& object, const OwnFrame& own);
    SELDOM bool isKnown(const Neighbourhood& all, int number);
    void forgetFar(const Neighbourhood& all);

    Travel reading_ = 0, bound_ = 0, lastTravel_ = 0;
    uint32_t linksVersion_ = 0;
    bool ordinary_ = true;  // nothing was odd about the neighbours in the call before: what is odd is counted otherwise
    bool fresh_ = true;  // nothing is known of a frame before
    Vector eye_{Real(0), Real(0), Real(0)};  // where the viewer was, own axes
    bool eyeStayed_ = false;
    bool leapt_ = true;  // nothing is known of a frame before, or all may have changed

    // What the last call has found out of each neighbour, in the order in which they are gathered.
    struct Known {
        uint8_t slot;
        bool inRange;   // of the object
        uint16_t travelled;  // how far it came in that call, as a Way; at most ALL_DUE
        Pose pose;
    };
    int room_ = 0, count_ = 0;
    Known* known_ = nullptr;
};

#endif
