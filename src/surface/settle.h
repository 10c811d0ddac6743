// Settle, the pass that finds where the path of each seed leaves the surface of its body, and the normal there.
#ifndef FB_SETTLE_H
#define FB_SETTLE_H

#include "cover.h"
#include "nearby.h"
#include "odometer.h"
#include "path.h"

// Units: after this much travel of the neighbours at the latest, what is off the surface is looked at again.
constexpr Real LONGEST_WAIT(6);

// Objects that are linked with more than this weight leave islands of the surface between them when they part, for the field rises
// again half way between them.
constexpr Real HEAVY(1);

// Cosine of a seed's path and its normal, 1.0 = 2^14.
inline int32_t cosineOfPath(const Seed& s)
{
    return (s.way[0] * s.normal.x + s.way[1] * s.normal.y + s.way[2] * s.normal.z) >> 7;
}

// Whether a seed is on the surface, in a place that belongs to its own object.
inline bool isOnOwn(const Seed& s)
{
    return (s.flags & (SEED_VALID | SEED_GUEST)) == SEED_VALID;
}

// Settles the seeds of one object; there is one settler for every kind of scene. It is made once for an object and a frame.
class Settler {
public:
    Settler(SoftObject& object, const OwnFrame& own, Neighbourhood& all, const FrameContext& frame,
            const Odometer& odometer);

    // Chooses the patch; to be called before any of its seeds is settled. Returns false if no neighbour reaches the seeds where
    // they are.
    bool setPatch(const Patch& patch, bool oversampled = false);

    // Whether the blocker of a patch is sure to cover all its paths (cover.h). Not worth asking, and false, if the middle seed was
    // on the surface.
    bool isCovered(const Patch& patch)
    {
        const bool settled = (object_.regular(patch.middleSeed).flags & (SEED_VALID | SEED_RESTING)) == SEED_VALID;
        return !settled && cover_.coversAll(patch) > 0;
    }

    // The same for a patch that was PATCH_OFF, before setPatch(). It sets when a covered patch is due again.
    bool isStillCovered(Patch& patch)
    {
        const int32_t depth = cover_.coversAll(patch);
        // Some travels are measured a tenth too short.
        if (depth > ROUNDED16)
            patch.due = now_ + travelOf(realFromRaw((depth - ROUNDED16) << 12) * Real(0.9));
        return depth > 0;
    }

    // Whether a patch that was off the surface, near something that digs, is sure to be so still; before setPatch().
    bool isStillOff(const Patch& patch) const
    {
        return patch.state == PATCH_OFF && isOff(patch, object_.regular(patch.middleSeed));
    }

    // Settles the middle seed of a patch that neighbours reach, returns the state that the patch gets from that, and sets when the
    // patch is due again.
    PatchState probe(Patch& patch);

    // Whether some patch was left unsettled because it is hidden.
    bool hidden() const { return hidden_; }

    // Settles the other regular seeds of a patch.
    void settleOthers(Patch& patch);

    // Activates and settles those oversampled and fine seeds of a patch that are needed, and ends the others. All regular seeds
    // must be settled before. It calls setPatch() itself.
    void oversample(Patch& patch);

    // Whether the object has a heavy link, so that its paths may lead through islands of the surface; and settles the seeds on the
    // islands of a patch, whatever its state. Where it is off the surface, and where no link is heavy any more, the islands end.
    bool isHeavy() const { return heavy_; }
    SELDOM void settleIslands(Patch& patch);

private:
    // The result of following a seed from where it was.
    enum Followed {
        LOST,   // the surface is not near
        FOUND,  // the seed is on the surface
        ALONE,  // no neighbour reaches the seed: it is at rest
    };

    Real settle(Seed& s);
    Followed followOn(Seed& s, Real* position, Sample* sample);
    void leaveToStrongest(Seed& s);
    SELDOM uint8_t nextBlocker() const;
    Real search(const Seed& s, Real* position, Sample* sample);
    void place(Seed& s, Real dominance);
    SELDOM bool placeAt(Seed& s, Real position, Real dominance);
    bool settleBorder(Seed& s, Real dominance);
    SELDOM void showHost(Seed& s) const;
    SELDOM bool makeGuest(Seed& s, const Neighbour& host);
    // Finds how the light changes around a seed (ltchange.cpp), unless the seed is dark or faces away.
    SELDOM void findLightChange(Seed& s);
    void keepLightChange(Seed& s, const Direction14& before);
    // The flags that a covered seed keeps.
    int stillOff() const { return nearby_.dented() ? SEED_OFF | SEED_FOLLOW : 0; }
    bool isCovered(const Seed& s) { return nearby_.dented() ? isOff(*patch_, s) : cover_.covers(s); }
    void settleBeside(const Seed& centre, Seed& s, uint8_t* blocker);
    int32_t spreadOf(const Patch& patch, const Seed& middle) const;
    bool staysHidden(const Patch& patch, Real position);
    bool mixes() const;

    // For seeds beside regular ones (extras.cpp). setGaps() sets alike_, open_, openNext_ and openFine_.
    void setGaps();
    bool mayGape(const Seed& s, const Seed& n, Real open) const;
    const Seed* parted(const Seed& s) const;
    bool isAway(const Seed& s) const;
    SELDOM bool layOutExtra(const Seed& s, const Seed& other);
    void layOutExtras(Patch& patch);
    bool settleExtra(int i);
    SELDOM bool settleFine(int i);
    void settleFineSeed(int i, int which, Real position, Seed& s);
    void settleOnWall(const Seed& a, const Seed& b, Real height, Seed& s);
    bool mayHaveIslands();
    SELDOM bool settleIsland(int i);
    bool placeOnIsland(int i, int which, Real inside, Real outside);

    // For dents and hollows only (hollow.cpp):
    SELDOM bool findDented(Seed& s, Vector* g);
    SELDOM bool hasClosed(const Seed& s);
    void putOff(Seed& s, Real hold, Real gradientBound) const;
    static bool isOff(const Patch& patch, const Seed& s);
    SELDOM PatchState probeOff(const Patch& patch, Seed& s) const;

    Path path_;
    Nearby nearby_;
    Cover cover_;
    SoftObject& object_;
    const OwnFrame& own_;
    const Neighbourhood& all_;
    Counts& counts_;
    const Travel now_;      // the odometer's reading
    const bool heavy_;      // the object has a link heavier than HEAVY
    const Real weakest_;    // the own field is at least this on an island between two objects: elsewhere none is searched
    const Seed* const last_;  // the last regular seed
    const Patch* patch_ = nullptr;  // the current patch
    Real border_;           // a neighbour whose field is weaker than the own one by less than this has its border near
    Real alike_;            // seeds whose positions differ by more have parted
    Real open_, openNext_, openFine_;  // LEFT_OPEN, LEFT_OPEN_NEXT and LEFT_OPEN_FINE, units
    Real gradientBound_{0}; // an upper bound of how the field on the current path changes over a unit of the neighbours' travel
    Real off_;              // by how much of the field the current path misses the surface, if it does
    bool hidden_ = false;   // hidden()
};

// Ends the oversampled and fine seeds of a patch, but for those on islands: Settler::settleIslands() does that.
void putAway(SoftObject& object, Patch& patch);

// Puts the seeds of a patch at rest, for no neighbour reaches them.
void rest(SoftObject& object, Patch& patch);

// Puts all seeds of a patch but the middle one to sleep: they are neither settled nor drawn.
void sleep(SoftObject& object, Patch& patch);

// Puts a patch to sleep that lies inside the body as a whole: it becomes PATCH_OFF.
void cover(SoftObject& object, Patch& patch);

#endif
