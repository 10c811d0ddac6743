// Odometer: coherence over time. It adds up how far the neighbours of an object travel in its own space, at most, and how far the
// viewer travels round it. A result about a patch is valid until they have travelled so far that it might change: who finds
// the result says how far that is, and when the odometer's reading gets there the patch is due again. Where a scene is not ordinary
// (gather.h) a patch also counts the travel of those neighbours that may reach it. Were everything always due only the speed would
// change.
#ifndef FB_ODOMETER_H
#define FB_ODOMETER_H

#include "nearby.h"
#include "pose.h"

// A distance travelled, and a reading of the odometer: 1/1024 unit of own space. Readings wrap around, so that only isDue() may
// compare them.
typedef uint32_t Travel;

inline Travel travelOf(Real units)
{
    return static_cast<Travel>(rawFromReal(units) >> 6);
}

inline bool isDue(Travel reading, Travel due)
{
    return static_cast<int32_t>(reading - due) >= 0;
}

// How far neighbours may travel before the field has changed by `margin`, if it changes by no more than `gradientBound` over a
// unit. Never more than `longest` units.
Travel travelUntil(Real margin, Real gradientBound, Real longest);

class Odometer {
public:
    Odometer() = default;
    ~Odometer();
    Odometer(const Odometer&) = delete;
    Odometer& operator=(const Odometer&) = delete;

    // Measures how far the neighbours and the viewer have travelled since the last call.
    void advance(const SoftObject& object, const OwnFrame& own, const Neighbourhood& all, uint32_t linksVersion);

    // Forgets everything: after the next call no earlier result is valid.
    void forget() { fresh_ = true; }

    // Whether no earlier result is valid since the last call: an object has leapt into range or out of it, links have changed, the
    // neighbourhood has become ordinary or is not any more, or nothing was known before. Then everything is due.
    bool leapt() const { return leapt_; }
    // Each call adds the travel of that neighbour which has travelled farthest, and that of the viewer.
    Travel reading() const { return reading_; }
    // How far that neighbour travelled in the last call.
    Travel lastTravel() const { return lastTravel_; }
    // Whether the viewer did not travel round the object in the last call.
    bool eyeStayed() const { return eyeStayed_; }

    // Adds the greatest last travel of a neighbour that may reach a patch's paths to Patch::travelled; one that has just left them,
    // or may reach them when it has travelled GATHER_SLACK, counts as well. Returns false if none of them moved.
    SELDOM bool addTravel(Patch& patch, const Neighbourhood& all) const;

private:
    bool makeRoom(int count);
    Travel travelOfEye(const SoftObject& object, const OwnFrame& own);
    void forgetFar(const Neighbourhood& all);
    SELDOM void insert(const Neighbour& near, int number);

    Travel reading_ = 0, lastTravel_ = 0;
    uint32_t linksVersion_ = 0;
    bool ordinary_ = true;  // the neighbourhood was ordinary in the last call: else travel is counted in another way
    const SoftObject* head_ = nullptr;  // Neighbourhood::head and samplers in the last call
    uint32_t samplers_ = 0;
    bool fresh_ = true;  // there was no call yet, or no memory, or everything has been forgotten
    Vector eye_{Real(0), Real(0), Real(0)};  // where the viewer was in the last call, own axes
    bool eyeStayed_ = false;
    bool leapt_ = true;  // leapt()

    // What the last call found out about each neighbour, in the order of Neighbourhood::neighbours.
    struct Known {
        uint8_t slot;
        bool inRange;   // Neighbour::inRange
        Travel travelled;
        NeighbourPose pose;
    };
    int room_ = 0, count_ = 0;
    Known* known_ = nullptr;
};

#endif
