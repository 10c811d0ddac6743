// Kinds: the primitives by name, with their measures. Scene files and the editor make objects from words with this table. A new
// primitive is one more row in src/model/kind.cpp.
#ifndef FB_KIND_H
#define FB_KIND_H

#include "model/softobj.h"

constexpr int MEASURES_MOST = 4;

// A measure of a primitive: its word in a scene file, its range, and its value in a new object, units.
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

    // Makes an object, which the caller owns. Returns null when there is no memory. The caller has checked the measures.
    SoftObject* (*make)(int number, const Real* measures);

    // Returns null if the measures, each already in range, fit each other; else the words for what is expected. The pointer may
    // be null: then any measures fit.
    const char* (*expects)(const Real* measures);

    // Upper bound of the distance of the surface from the centre, units, for a strength of 1.
    Real (*reach)(const Real* measures);
};

extern const Kind KINDS[];
extern const int KIND_COUNT;

// Returns the kind with this name, which must be in lower case, or null.
const Kind* kindNamed(const char* word);

#endif
