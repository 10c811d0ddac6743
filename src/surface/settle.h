// Settle: where the path of a seed leaves the surface of its body, and which way the surface faces there.
#ifndef FB_SETTLE_H
#define FB_SETTLE_H

#include "odometer.h"

// A neighbour as the seeds of one root see it: what is the same for all of them. Lengths in its sizes, if not said otherwise.
struct FromRoot {
    int root;        // index of the root; -1: none yet
    Real a, c;       // squared distance of the root from the centre, squared length of the paths
    Vector twice16;  // 32 (root - centre) / size^2, units
    Vector apart;    // from the centre to the root, units; neither point nor segment: the root in core space
    Real y;          // a segment: where the root lies along it
};

// A neighbour's field along the path at hand. Its t (model/field.h) is a + p (b + p c), less k (2 y - k) for a segment.
struct Along {
    const Neighbour* near;
    const FromRoot* from;
    Real b;
    Real stepY;         // a segment: what the path leads along it
    Vector step;        // neither point nor segment: the path in its core space
    // At the last position looked at.
    Real value, slope;  // F and dF/dt
    Real t, change;     // and dt/dp
    Real k;             // where the nearest point of the segment lies along it
    Vector out;         // neither point nor segment: half the gradient of t in its core space, times CORE_SIZE^2

    // t at a position; sets what else there is to know there but F.
    Real param(Real p);
};

// The body's field at a position: its excess over the isovalue, its slope along the path, how much stronger than the own
// field the strongest neighbour's is.
struct Sample {
    Real excess, slope, dominance;
};

// When a neighbour alone keeps an object's seeds off the surface: its t (model/field.h) is less than these at two positions of their
// paths. And the roots of the two.
struct Cover {
    Real there, atRest, rootThere, rootAtRest;
};

// Settles the seeds of one object, one settler for every scene. Made once for an object and a frame; `updates` counts those
// of the object.
class Settler {
public:
    Settler(SoftObject& object, const OwnFrame& own, const Neighbourhood& all, const FrameContext& frame,
            const Odometer& odometer, uint32_t updates);

    // To be called before anything else about the seeds of a patch. False: no neighbour reaches them where they are.
    bool setPatch(const Patch& patch, bool oversampled = false);

    // Whether all paths of a patch are sure to lie inside the one neighbour that was the strongest there the last time.
    bool isCovered(const Patch& patch);

    // Settles the seed in the middle of a patch that neighbours reach, says from it what becomes of the patch, and sets when
    // the patch is due again.
    PatchState probe(Patch& patch);

    // Settles the other regular seeds of a patch.
    void settleRest(Patch& patch);

    // Settles those oversampled seeds of a patch that are needed, when all regular ones have been; the others end. It calls
    // setPatch() by itself.
    void oversample(Patch& patch);

private:
    // The neighbours to look at, by their numbers, and whether they and the object are all linked with each other at weight 1,
    // and what digs does it with one weight into all of them: then the sum of the fields, less what digs, is F.
    struct Few {
        int count;
        bool complete;
        uint8_t number[NEIGHBOURS_MAX];
    };
    template <bool COMMON> struct Sum;

    void setComplete(Few& few) const
    {
        few.complete = allComplete_;
        if (!few.complete)
            findComplete(few);
    }
    void findComplete(Few& few) const;
    const Few& listed();
    const Few& those(Real position);
    Real settle(Seed& s);
    void restThere(Seed& s);
    void setRoot(const Neighbour& near, const Seed& s, FromRoot& to) const;
    bool begin(const Few& few, const Seed& s, Real position, Sample* sample);
    Sample look(Real position);
    // The same; whether all is common (Neighbourhood::common) is known at compile time.
    template <bool COMMON> bool beginAs(const Few& few, const Seed& s, Real position, Sample* sample);
    template <bool COMMON> Sample lookAs(Real position);
    SELDOM bool beginOdd(const Few& few, const Seed& s, Real position, Sample* sample);
    SELDOM Sample lookOdd(Real position);
    SELDOM void blend(Real position, Sample& sample);
    SELDOM void blendOdd(Real position, Sample& sample);
    bool follow(Real* position, Sample* sample);
    SELDOM Real warpedParam(Real position);
    // The own t at a position of the path at hand; and dF/dp, when that has been looked at.
    Real ownParam(Real position) { return warped_ ? warpedParam(position) : position * position * restParam_; }
    Real ownRate(Real position) const
    {
        return warped_ ? ownSlope_ * ownChange_ : ownSlope_ * position * shiftUp(restParam_, 1);
    }
    Real search(Real* position, Sample* sample);
    SELDOM Real searchDeep(Real* position, Sample* sample);
    SELDOM bool hasClosed(const Seed& s);
    Real pushMost() const;
    void putOff(Seed& s, Real hold, Real push) const;
    bool isOff(const Seed& s) const;
    Real longestOff() const;
    SELDOM Way offFor(const Patch& patch) const;
    SELDOM PatchState probeOff(Patch& patch, const Seed& s) const;
    void bisect(Real inside, Real outside, Real* position, Sample* sample);
    Vector outward(Real position) const;
    SELDOM void addSlanting(Vector& to, Real share, Real position) const;
    Vector fromCore(const Along& along, Real position) const;
    SELDOM Real leadOf(const Vector& g, const Vector& out, Real own, const Vector& from, Real steepest) const;
    Real findShare(Seed& s, Real shared, Vector* g);
    SELDOM void setOdd(const Patch& patch);
    SELDOM const Along* strongestOther(const Seed& s, Vector* g, Real* change) const;
    SELDOM void findNearer(Seed& s, Real dominance) const;
    SELDOM bool findDented(Seed& s, Vector* g);
    void findBorder(Seed& s, Real dominance) const;
    void mix(Seed& s) const;
    Real pushes() const;
    static Way until(Real hold, Real push, Real longest);
    void setBlocker(const Patch& patch);
    bool isCovered(const Seed& s);
    bool isLinked(int slot) const;
    int strongest() const;
    void aim(const Neighbour& near, FromRoot& from, const Seed& s, Along& along) const;
    void beginSearch(const Seed& s);
    bool waits(const Seed& s, bool someAway) const;
    void setRange(Patch& patch) const;

    SoftObject& object_;
    const OwnFrame& own_;
    const Neighbourhood& all_;
    const Bodies& bodies_;
    Counts& counts_;
    const Way now_;   // reading of the odometer
    const Real came_; // how far neighbours came in this frame, units
    const uint32_t updates_;
    uint32_t turn_ = 0;  // of the patch at hand: what waits takes turns
    const Real* ownWeights_;  // of its links, by slots
    const bool hollow_;              // the seeds sample a hollow: inside and outside change places
    const bool common_;              // nothing digs, all strengths are 1, and the object is not shaped
    const bool ownPlain_;            // the object's strength is 1, and it is neither a hollow nor warped
    const Real restParam_;           // t of the own field at position 1, unless it is warped
    const bool warped_;              // the object is
    const Real first_, last_;        // positions: where paths are searched
    Real border_;                    // of the field: a neighbour that is weaker than the own by less is near
    bool allComplete_;
    FromRoot from_[NEIGHBOURS_MAX];
    Real reachT_[NEIGHBOURS_MAX];  // t in the middle of a path, beyond which no place on it is reached

    // Of the patch: the neighbours that reach its seeds where they are, and all that might; the size of the smallest of those,
    // or of the object.
    const Patch* patch_;
    Few near_, listed_;
    Real smallest_;
    bool dented_;              // something digs where its paths are, or it is a hollow
    int blocker_;              // number of the neighbour that was the strongest where a seed was not on the surface; -1: none
    const Cover* cover_;       // and when it alone keeps them off it; null: that is not known
    Real nearest_, farthest_;  // between which positions its seeds are, and a little more

    // Of the path at hand.
    Vector root_, path_;
    bool complete_;
    bool shared_;             // share_ holds at the position looked at last; else all are 1
    int touched_;
    Along along_[NEIGHBOURS_MAX];
    Real off_;                        // of the field: by how much the path misses the surface, where it does
    Real headField_;                  // of a hollow: the field of what is hollowed out
    Real lookedAt_;                   // the last position looked at
    Real ownField_, ownSlope_;        // F and dF/dt of the own field there
    Real ownChange_;                  // and dt/dp, of a warped object
    Real share_[NEIGHBOURS_MAX + 1];  // dF/df of the own and each touched neighbour's field, if shared_
};

// Puts the seeds of a patch where no neighbour reaches them.
void rest(SoftObject& object, Patch& patch);

// Puts all seeds of a patch but the one in the middle to sleep: they are neither settled nor drawn.
void sleep(SoftObject& object, Patch& patch);

// The same to a patch that lies inside as a whole.
void cover(SoftObject& object, Patch& patch);

#endif
