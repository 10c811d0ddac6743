// Kinds: the primitives by name, with their measures, for everything that makes objects from words: scene files and
// hands-on editing. A new primitive is one more row in src/model/kind.cpp.
#ifndef FB_KIND_H
#define FB_KIND_H

#include "model/softobj.h"

constexpr int MEASURES_MOST = 4;

// A measure of a primitive: its word in a scene file, the range it may have, and what a new object has, units.
struct Measure {
    const char* word;
    Real least;
    Real most;
    Real usual;
};

struct Kind {
    const char* word;
    int measures;  // 1..MEASURES_MOST; the first is the size
    Measure measure[MEASURES_MOST];

    // A new object, which the caller owns. Null: no memory. The measures have been checked.
    SoftObject* (*make)(int number, const Real* measures);

    // Null, or what is expected where measures that are in range each do not fit each other. May be null itself.
    const char* (*expects)(const Real* measures);

    // How far its surface reaches from its centre at most, units.
    Real (*reach)(const Real* measures);
};

extern const Kind KINDS[];
extern const int KIND_COUNT;

// The kind with this name, in lower case; null: none.
const Kind* kindNamed(const char* word);

#endif
