// Settle: where the path of a seed leaves the surface of its body, and which way the surface faces there.
#ifndef FB_SETTLE_H
#define FB_SETTLE_H

#include "cover.h"
#include "nearby.h"
#include "odometer.h"
#include "path.h"

// Units: how far neighbours may come at most before what is off the surface is looked at again.
constexpr Real LONGEST_WAIT(6);

// Settles the seeds of one object, one settler for every scene. Made once for an object and a frame; `updates` counts those
// of the object.
class Settler {
public:
    Settler(SoftObject& object, const OwnFrame& own, Neighbourhood& all, const FrameContext& frame,
            const Odometer& odometer, uint32_t updates);

    // To be called before anything else about the seeds of a patch. False: no neighbour reaches them where they are.
    bool setPatch(const Patch& patch, bool oversampled = false);

    // Those that do, after that.
    const NeighbourList& reaching() const { return nearby_.reaching(); }

    // Whether all paths of a patch are sure to lie inside the one neighbour that was the strongest there the last time. It is not
    // asked where the middle was on the surface.
    bool isCovered(const Patch& patch)
    {
        const bool settled = (object_.regular(patch.centre).flags & (SEED_VALID | SEED_RESTING)) == SEED_VALID;
        return !settled && !nearby_.dented() && cover_.coversAll(patch);
    }

    // The same of one that lay inside, before setPatch().
    bool isStillCovered(const Patch& patch) { return all_.ordinary && cover_.coversAll(patch); }

    // Whether all of one that lay off the surface, where something digs, still does; before setPatch().
    bool isStillOff(const Patch& patch) const { return patch.state == PATCH_INSIDE && isOff(patch, object_.regular(patch.centre)); }

    // Settles the seed in the middle of a patch that neighbours reach, says from it what becomes of the patch, and sets when
    // the patch is due again.
    PatchState probe(Patch& patch);

    // Whether some patch was left because it is hidden.
    bool hidden() const { return hidden_; }

    // Settles the other regular seeds of a patch.
    void settleOthers(Patch& patch);

    // Settles those oversampled seeds of a patch that are needed, when all regular ones have been; the others end. It calls
    // setPatch() by itself.
    void oversample(Patch& patch);

    // Whether there may be islands, and the seeds on those of a patch, whatever its state but PATCH_INSIDE.
    bool hasIslands() const { return heavy_; }
    SELDOM void settleIslands(Patch& patch);

private:
    // What comes of following a seed from where it was.
    enum Followed {
        LOST,   // the surface is not near
        FOUND,  // it is on it
        STILL,  // and has not moved
        ALONE,  // no neighbour reaches it: it is at rest
    };

    Real settle(Seed& s);
    Followed followOn(Seed& s, Real* position, Sample* sample);
    void restThere(Seed& s);
    void keep(Seed& s, Real dominance);
    Real search(const Seed& s, Real* position, Sample* sample);
    void place(Seed& s, Real dominance);
    // What remains of the flags of a seed that is covered.
    int stillOff() const { return nearby_.dented() ? SEED_OFF | SEED_FOLLOW : 0; }
    bool isCovered(const Seed& s) { return nearby_.dented() ? isOff(*patch_, s) : cover_.covers(s); }
    void settleBeside(const Seed& centre, Seed& s, bool someAway, uint8_t* blocker);
    void setRange(Patch& patch, Real nearest, Real farthest) const;
    bool isAway(const Seed& s) const;
    bool mayGape(const Seed& s, const Seed& n, Real open) const;
    const Seed* parted(const Seed& s) const;
    SELDOM bool layOutExtra(const Seed& s, const Seed& other);
    SELDOM bool settleFine(int i);
    void settleBehind(const Seed& valid, Seed& s);
    bool mayHaveIslands(const Patch& patch) const;
    SELDOM bool settleIsland(int i);
    bool placeOnIsland(int i, int which, Real inside, Real outside);
    bool waits(const Seed& s, bool someAway) const;
    bool mixes() const;

    // What only dents and hollows need (hollow.cpp).
    SELDOM bool findDented(Seed& s, Vector* g);
    SELDOM bool hasClosed(const Seed& s);
    void putOff(Seed& s, Real hold, Real push) const;
    static bool isOff(const Patch& patch, const Seed& s);
    SELDOM PatchState probeOff(const Patch& patch, Seed& s) const;

    Path path_;
    Nearby nearby_;
    Cover cover_;
    SoftObject& object_;
    const OwnFrame& own_;
    const Neighbourhood& all_;
    Counts& counts_;
    const Travel now_;     // reading of the odometer
    const Real travelled_;   // how far neighbours came in this frame, units
    const uint32_t updates_;
    const bool heavy_;  // the object has a link of more than HEAVY
    const Real weakest_;  // own field below which no islands are looked for: those with two neighbours at most have more
    const Seed* const last_;  // of the regular ones
    const Patch* patch_ = nullptr;  // that is at hand
    uint32_t turn_ = 0; // of it, 0..3: what waits takes turns. 0: nothing waits
    Real border_;       // of the field: a neighbour that is weaker than the own by less is near
    Real alike_;        // no more than this is between the positions of seeds that have not parted
    Real open_, openNext_, openFine_;  // LEFT_OPEN..., units
    Real gradientBound_{0};      // by how much fields may change along the path at hand when neighbours come by a unit
    Real off_;          // of the field: by how much the path at hand misses the surface, where it does
    bool hidden_ = false;
};

// Puts the seeds of a patch where no neighbour reaches them.
void rest(SoftObject& object, Patch& patch);

// Puts all seeds of a patch but the one in the middle to sleep: they are neither settled nor drawn.
void sleep(SoftObject& object, Patch& patch);

// The same to a patch that lies inside as a whole.
void cover(SoftObject& object, Patch& patch);

#endif
