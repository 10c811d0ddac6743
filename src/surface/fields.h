// Fields along a path: the innermost loop of settling. It evaluates the field of each neighbour at one position on a seed's path,
// and adds them up.
#ifndef FB_FIELDS_H
#define FB_FIELDS_H

#include "math/vec.h"

struct Neighbour;

// The field F of one neighbour along the path of a seed. F is a function of t, the squared distance from the core over the squared
// size (model/field.h). At position p on the path, t = a + p (b + p c); a segment subtracts k (2 (y + p stepY) - k) from it.
// Lengths are multiples of the neighbour's size unless stated otherwise.
struct Along {
    // The core is the neighbour's centre, a segment that extends `half` to each side of it, or what the primitive defines.
    enum Kind : int32_t { POINT, SEGMENT, OTHER } kind;
    Real half;
    Vector along16;  // segment: its direction times 16
    // These hold for all seeds of a root:
    Real a, c;       // squared distance of the root from the centre; squared length of the paths
    Vector twice16;  // 32 (root - centre) / size^2; root, centre and size in units
    Real y;          // segment: coordinate of the root along it
    // These hold for one path:
    Real b;
    Real stepY;         // segment: component of the path along it
    // These hold for the position evaluated last:
    Real value, slope;  // F and dF/dt
    Real t, change;     // t, and dt/dp, which need not be known beyond the end of the field
    Real k;             // segment: coordinate of its nearest point

    // For points and segments only: set b and stepY for a path; set t and k for position p, or for position 1, and return t; set
    // `change` for the position evaluated last.
    void aimNear(const Vector& path);
    Real nearParam(Real p);
    Real nearRestParam();
    void findChange(Real p);

private:
    // Turns the t that a segment's centre alone would have into the segment's; `at` is the position's coordinate along it.
    void leaveAxis(Real at);
};

// The fields of all neighbours at one position.
struct Fields {
    Real sum, slope;    // sum of the fields, and its derivative by the position
    Real strongest;     // the greatest single field
    int32_t reaching;   // number of neighbours whose fields reach the position
};

extern "C" {

// Evaluates the field of each neighbour on a list at a position, and adds all of them, with strength 1, to `fields`. If `path` is
// not null, points and segments are first set to that path (aimNear()). Other neighbours have their t and change set already.
// The routine exists twice: in C++ (fields.cpp) and in assembly (asm/fields.S). Both write the same bits.
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
    const Real inner = b + p * c;
    t = a + p * inner;
    if (kind == SEGMENT)
        leaveAxis(y + p * stepY);
    return t;
}

inline Real Along::nearRestParam()
{
    t = a + (b + c);
    if (kind == SEGMENT)
        leaveAxis(y + stepY);
    return t;
}

inline void Along::leaveAxis(Real at)
{
    k = clamp(at, -half, half);
    t -= k * (at + at - k);
}

inline void Along::findChange(Real p)
{
    const Real outer = p * c, inner = b + outer;
    change = inner + outer;
    if (kind == SEGMENT)
        change -= k * (stepY + stepY);
}

#endif
