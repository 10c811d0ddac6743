// Fields along a path: where a seed's path leads in the field of each neighbour, and the fields of all of them at one position. The
// innermost loops of settling.
#ifndef FB_FIELDS_H
#define FB_FIELDS_H

#include "gather.h"

// A neighbour as the seeds of one root see it: what is the same for all of them. Lengths in its sizes, if not said otherwise.
struct FromRoot {
    Real a, c;       // squared distance of the root from the centre, squared length of the paths
    Vector twice16;  // 32 (root - centre) / size^2, units
    Real y;          // a segment: where the root lies along it
    Vector along16;  // and its direction, 16 times
    int root;        // index of the root; -1: none yet
    Vector apart;    // from the centre to the root, units; neither point nor segment: the root in core space
    Real reachT;     // t at Path::middle() from which on no place of a path is reached
};

// A neighbour's field along the path at hand. Its t (model/field.h) is a + p (b + p c), less k (2 y - k) for a segment.
struct Along {
    FromRoot* from;
    int32_t kind;       // Neighbour::Kind
    Real half;          // of a segment, as Neighbour::half
    Real b;
    Real stepY;         // a segment: what the path leads along it
    // At the last position looked at.
    Real value, slope;  // F and dF/dt
    Real t, change;     // and dt/dp
    Real k;             // where the nearest point of the segment lies along it
    const Neighbour* near;
    Vector step;        // neither point nor segment: the path in its core space
    Vector out;         // and half the gradient of t in its core space, times CORE_SIZE^2

    // Takes up a path.
    void aim(const Vector& path);

    // t at a position; sets what else there is to know there but F.
    Real param(Real p);
    // The same of a point or a segment, and of anything else.
    Real nearParam(Real p);
    Real otherParam(Real p);
};

// What fields add up to at a position: their sum and what that changes by over a position, the strongest of them, and whether any
// reaches it (1; else 0).
struct Fields {
    Real sum, slope, strongest;
    int32_t touched;
};

extern "C" {

// It stands twice, in C++ (fields.cpp) and in assembly (asm/fields.S); both do the same, bit for bit.

// Sets what each field from `first` to before `end` is at a position, and adds all of them, as strong as most are, to `fields`.
// Points and segments take up a path first, if one is given; of the others t and change are set already.
void addFieldsC(Along* first, Along* end, Real position, const Vector* path, Fields* fields);
#if FB_ASM
void addFieldsA(Along* first, Along* end, Real position, const Vector* path, Fields* fields);
#endif

}

#if FB_ASM
#define addFields addFieldsA
#else
#define addFields addFieldsC
#endif

inline void Along::aim(const Vector& path)
{
    if (kind == Neighbour::OTHER) {
        step = near->inCore(path);
        return;
    }
    b = shiftDown(dot(path, from->twice16), 4);
    if (kind == Neighbour::SEGMENT)
        stepY = shiftDown(dot(path, from->along16), 4);
}

inline Real Along::param(Real p)
{
    return kind == Neighbour::OTHER ? otherParam(p) : nearParam(p);
}

inline Real Along::nearParam(Real p)
{
    const Real outer = p * from->c, inner = b + outer;
    change = inner + outer;
    t = from->a + p * inner;
    if (kind == Neighbour::SEGMENT) {
        const Real y = from->y + p * stepY;
        k = clamp(y, -half, half);
        change -= k * (stepY + stepY);
        t -= k * (y + y - k);
    }
    return t;
}

#endif
