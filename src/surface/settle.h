// Settle: where the path of a seed leaves the surface of its body, and which way the surface faces there.
#ifndef FB_SETTLE_H
#define FB_SETTLE_H

#include "patch.h"

// A neighbour as the seeds of one root see it: what is the same for all of them.
struct FromRoot {
    int root;        // index of the root; -1: none yet
    Real a, c;       // a point: squared distance of the root and squared length of the paths, over squared size
    Vector twice16;  // and 32 (root - centre) / size^2
    Vector apart;    // a point: from its centre to the root; else the root in its core space
};

// A neighbour's field along the path at hand.
struct Along {
    const Neighbour* near;
    const FromRoot* from;
    Real b;             // a point: t = a + p (b + p c)
    Vector step;        // else: the path in its core space
    // At the last position looked at.
    Real value, slope;  // F and dF/dt
    Real change;        // dt/dp
    Vector out;         // half the gradient of t in its core space, times CORE_SIZE^2; no point

    // t at a position; the second two also set what else there is to know there.
    Real pointParam(Real p) const { return from->a + p * (b + p * from->c); }
    Real pointChange(Real p)
    {
        const Real outer = p * from->c, inner = b + outer;
        change = inner + outer;
        return from->a + p * inner;
    }
    Real coreParam(Real p) { return near->param(from->apart + step * p, &out); }
    Real coreChange(Real p)
    {
        const Real t = coreParam(p);
        change = shiftDown(dot(out, step), 7);
        return t;
    }
};

// The body's field at a position: its excess over the isovalue, its slope along the path, how much stronger than the own
// field the strongest neighbour's is.
struct Sample {
    Real excess, slope, dominance;
};

// Settles the seeds of one object, one settler for every scene. Made once for an object and a frame; `updates` counts those
// of the object.
class Settler {
public:
    Settler(SoftObject& object, const OwnFrame& own, const Neighbour* neighbours, int count, const FrameContext& frame,
            uint32_t updates);

    // To be called before anything else about the seeds of a patch.
    void setPatch(const Patch& patch);

    // Settles the seed in the middle of a patch that neighbours reach, and says from it what becomes of the patch.
    PatchState probe(Patch& patch);

    // Whether a patch that lay inside still does, by the field of the neighbour alone that was the strongest then.
    bool stillInside(const Patch& patch);

    // Settles the other regular seeds of a patch.
    void settleRest(Patch& patch);

    // Settles those oversampled seeds of a patch that are needed, when all regular ones have been; the others end. It calls
    // setPatch() by itself.
    void oversample(const Patch& patch);

private:
    // Sets position, normal and flags of a seed. One that finds no surface of its own object is left without SEED_VALID;
    // returned is then by how much of the field it lies inside.
    Real settle(Seed& s);
    void setRoot(const Neighbour& near, const Seed& s, FromRoot& to) const;
    struct Sum;
    bool begin(const Seed& s, Sample* sample);
    Sample look(Real position);
    void blend(Real position, Sample& sample);
    bool follow(Real* position, Sample* sample);
    bool search(Real* position, Sample* sample);
    bool bisect(Real inside, Real outside, Real* position, Sample* sample);
    Vector outward(Real position) const;
    void findBorder(Seed& s, Real dominance) const;
    void mix(Seed& s) const;

    int strongest() const;
    bool blocked(const Patch& patch, const Seed& s, Real margin);
    bool waits(const Seed& s, bool someAway) const;

    SoftObject& object_;
    const OwnFrame& own_;
    const Neighbour* neighbours_;
    const Bodies& bodies_;
    Counts& counts_;
    uint32_t frame_;      // number of the update
    bool complete_;       // all neighbours are linked with each other, and with the object, at weight 1: the sum is F
    FromRoot from_[NEIGHBOURS_MAX];
    int8_t numberOf_[NEIGHBOURS_MAX + 1];  // by slot: number of the neighbour; -1: out of range

    // Of the patch: those that reach it, and the size of the smallest, or of the object.
    int reached_ = 0;
    uint8_t reachedBy_[NEIGHBOURS_MAX];
    Real smallest_;

    // Of the path at hand.
    Vector root_, path_;
    int touched_;
    Along along_[NEIGHBOURS_MAX];
    Real ownField_, ownSlope_;             // F and dF/dt of the own field at the last position
    Real share_[NEIGHBOURS_MAX + 1];  // dF/df of the own and each touched neighbour's field, unless complete_
};

// Puts the seeds of a patch where no neighbour reaches them.
void rest(SoftObject& object, const Patch& patch, const OwnFrame& own);

// Works out the brightness of its seeds anew, when the light comes from another side of the object.
void light(SoftObject& object, const Patch& patch, const OwnFrame& own);

// Puts all seeds of a patch but the one in the middle to sleep: they are neither settled nor drawn.
void sleep(SoftObject& object, const Patch& patch);

#endif
