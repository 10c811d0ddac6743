// Bodies: objects that are joined by links, directly or through other objects, form one body, and a body has one field F:
//
//     g_i = f_i + sum over the links of i of w_ij f_j        F = sum of f_i^2 g_i / sum of f_i^2
//
// f_i is the field of object i times its strength. An object that digs into i counts in g_i with minus its weight. A link or a
// dent of weight 0 counts as no link or dent. An object that digs and is linked with nothing has no surface, and no term in the
// sums over i. Where all objects that reach a point are linked with each other at weight 1, F is the plain sum of their fields,
// the report's implicit function; elsewhere F passes smoothly from one object's sum to another's.
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

    // Finds the bodies of `count` objects from their links, and numbers the objects (SoftObject::slot()) in the order given.
    // Returns false when there is no memory; there are no bodies then.
    bool find(SoftObject* const* objects, int count);

    // The object with a slot.
    const SoftObject& object(int slot) const { return *members_[bySlot_[slot].member]; }

    // The objects of the body that an object belongs to, including the object itself.
    SoftObject* const* members(const SoftObject& object) const;
    int memberCount(const SoftObject& object) const;

    // The objects that dig into members of that body without being members.
    SoftObject* const* diggers(const SoftObject& object) const;
    int diggerCount(const SoftObject& object) const;

    // The factor by which the field of B counts in the sum of A, both given by slot: the weight of their link minus the weight
    // by which B digs into A; 0 where there is neither link nor dent.
    Real weight(int slotA, int slotB) const { return weights_[slotA * count_ + slotB]; }
    // The weights of all objects in the sum of one object, indexed by the other's slot.
    const Real* weights(int slot) const { return weights_ + slot * count_; }

    // An object whose recalc flag is set has told the objects that it is linked to or digs into. This function tells the rest
    // of their body, as far as the object can reach it, and the objects that dig into the body.
    void spreadRecalc() const;

    // The objects whose factor in the sum of an object is 1 (weight()): one bit for each slot, in LINK_WORDS words.
    const uint32_t* plainLinks(int slot) const { return bySlot_[slot].plain; }
    static constexpr int LINK_WORDS = 4;
    // Returns true if every member of the body counts in the sum of every other with a factor of 1, and no other object digs into
    // the body.
    bool plainBody(int slot) const { return bySlot_[slot].plainBody; }
    // The greatest weight of the object's links; 0 if it has no links.
    Real heaviest(int slot) const { return bySlot_[slot].heaviest; }

    // Increases by one whenever the bodies have been found anew.
    uint32_t version() const { return version_; }

private:
    // What is stored for each object.
    struct Entry {
        int16_t member;                    // its index in members_
        int16_t first, size;               // its body's first index there, and the number of members
        int16_t firstDigger, diggerCount;  // the same of the objects that dig into the body, in diggers_
        bool complete;                     // all members are linked with each other, and nothing else digs into the body
        bool plainBody;                    // complete, and all weights are 1
        Real heaviest;
        uint32_t plain[LINK_WORDS];        // see plainLinks()
    };

    void release();
    bool reserve(SoftObject* const* objects, uint32_t count);
    void setWeights(SoftObject* const* objects);
    void findMembers(SoftObject* object, int* filled);
    void findDiggers(int begin, int end, int* filled);
    bool allLinked(int begin, int end, bool plain) const;
    void spreadByDiggers(SoftObject& member) const;

    int count_ = 0;
    Real* weights_ = nullptr;         // count_ rows of count_ weights
    Entry* bySlot_ = nullptr;
    SoftObject** members_ = nullptr;  // body after body
    SoftObject** diggers_ = nullptr;  // body after body
    uint32_t version_ = 0;
};

#endif
