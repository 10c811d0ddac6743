// Fields along a path: where a seed's path leads in the field of each neighbour, and the fields of all of them at one position. The
// innermost loops of settling.
#ifndef FB_FIELDS_H
#define FB_FIELDS_H

#include "math/vec.h"

struct Neighbour;

// A neighbour's field along the paths of seeds, one path after the other. Its t (model/field.h) is a + p (b + p c), less
// k (2 y - k) for a segment. Lengths are in its sizes, if not said otherwise.
struct Along {
    // What kind of core it has: its centre, a segment of `half` sizes to each side, or what the primitive says.
    enum Kind : int32_t { POINT, SEGMENT, OTHER } kind;
    Real half;
    Vector along16;  // a segment: its direction, 16 times
    // The same for all seeds of a root:
    Real a, c;       // squared distance of the root from the centre, squared length of the paths
    Vector twice16;  // 32 (root - centre) / size^2, units
    Real y;          // a segment: where the root lies along it
    // Of the path at hand:
    Real b;
    Real stepY;         // a segment: what the path leads along it
    // At the last position looked at:
    Real value, slope;  // F and dF/dt
    Real t, change;     // and dt/dp
    Real k;             // where the nearest point of the segment lies along it

    // A point or a segment takes up a path, and is looked at: t there; sets what else there is to know there but F.
    void aimNear(const Vector& path);
    Real nearParam(Real p);
};

// What fields add up to at a position: their sum and what that changes by over a position, the strongest of them, and whether any
// reaches it (1; else 0).
struct Fields {
    Real sum, slope, strongest;
    int32_t touched;
};

extern "C" {

// It stands twice, in C++ (fields.cpp) and in assembly (asm/fields.S); both do the same, bit for bit.

// Sets what the field of each neighbour on a list is at a position, and adds all of them, as strong as most are, to `fields`.
// Points and segments take up a path first, if one is given; of the others t and change are set already.
void addFieldsC(Neighbour* const* first, Neighbour* const* end, Real position, const Vector* path, Fields* fields);
#if FB_ASM
void addFieldsA(Neighbour* const* first, Neighbour* const* end, Real position, const Vector* path, Fields* fields);
#endif

}

#if FB_ASM
#define addFields addFieldsA
#else
#define addFields addFieldsC
#endif

inline void Along::aimNear(const Vector& path)
{
    b = shiftDown(dot(path, twice16), 4);
    if (kind == SEGMENT)
        stepY = shiftDown(dot(path, along16), 4);
}

inline Real Along::nearParam(Real p)
{
    const Real outer = p * c, inner = b + outer;
    change = inner + outer;
    t = a + p * inner;
    if (kind == SEGMENT) {
        const Real at = y + p * stepY;
        k = clamp(at, -half, half);
        change -= k * (stepY + stepY);
        t -= k * (at + at - k);
    }
    return t;
}

#endif
