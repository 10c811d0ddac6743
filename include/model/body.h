// Bodies: objects that links join, directly or through others, make one body, and the body has one field:
//
//     g_i = f_i + sum over the links of i of w_ij f_j        F = sum of f_i^2 g_i / sum of f_i^2
//
// f_i is the field as the object's strength has it. What digs into i counts in g_i with minus its weight. A link of weight 0
// counts as none: it joins nothing; so does a dent of weight 0. An object that digs and is linked with nothing has no surface,
// and no term in the sums over i. Where all objects that reach a point are linked with each other at
// weight 1, F is the plain sum of their fields, the report's implicit function; elsewhere it passes smoothly from one
// object's sum to another's.
#ifndef FB_BODY_H
#define FB_BODY_H

#include "math/vec.h"

class SoftObject;

class Bodies {
public:
    Bodies() = default;
    ~Bodies();
    Bodies(const Bodies&) = delete;
    Bodies& operator=(const Bodies&) = delete;

    // Finds the bodies of `count` objects from their links, and numbers the objects (SoftObject::slot()) in the order
    // given. False: no memory; there are no bodies then.
    bool find(SoftObject* const* objects, int count);

    // The objects of the body that an object belongs to, itself among them.
    SoftObject* const* members(const SoftObject& object) const;
    int memberCount(const SoftObject& object) const;

    // What digs into objects of that body and is none of it.
    SoftObject* const* diggers(const SoftObject& object) const;
    int diggerCount(const SoftObject& object) const;

    // By what the field of B counts in the sum of A, by their slots: the weight of their link, less that by which B digs into
    // A; 0 where there is neither.
    Real weight(int slotA, int slotB) const { return weights_[slotA * count_ + slotB]; }
    // Those of one object, by the other's slot.
    const Real* weights(int slot) const { return weights_ + slot * count_; }

    // An object whose recalc flag is set tells those that it is linked to or digs into; this tells the rest of their body that
    // it can reach.
    void spreadRecalc() const;

    // Those that an object is linked with at weight 1, a bit for each slot; LINK_WORDS words.
    const uint32_t* plainLinks(int slot) const { return bySlot_[slot].plain; }
    static constexpr int LINK_WORDS = 4;
    // Whether all of its body are linked with all at weight 1, and nothing else digs into it.
    bool plainBody(int slot) const { return bySlot_[slot].plainBody; }
    // The greatest weight of its links; 0: it has none.
    Real heaviest(int slot) const { return bySlot_[slot].heaviest; }

    // Grows by one whenever the bodies have been found anew.
    uint32_t version() const { return version_; }

private:
    // What is known of an object.
    struct Entry {
        int16_t first, size;               // where its body begins in members_, and how many it has
        int16_t firstDigger, diggerCount;  // the same of what digs into the body, in diggers_
        bool complete;                     // all of its body are linked with all, and nothing else digs into it
        bool plainBody;                    // and all of that at weight 1
        Real heaviest;
        uint32_t plain[LINK_WORDS];        // as plainLinks() has them
    };

    void release();
    bool reserve(SoftObject* const* objects, uint32_t count);
    void setWeights(SoftObject* const* objects);
    void findMembers(SoftObject* object, int* filled);
    void findDiggers(int begin, int end, int* filled);
    bool allLinked(int begin, int end, bool plain) const;
    void spreadByDiggers(SoftObject& member) const;

    int count_ = 0;
    Real* weights_ = nullptr;         // count_ rows of count_
    Entry* bySlot_ = nullptr;
    SoftObject** members_ = nullptr;  // body after body
    SoftObject** diggers_ = nullptr;  // body after body
    uint32_t version_ = 0;
};

#endif
