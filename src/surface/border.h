// Border: what a seed near the border of two objects knows of it, so that their scales end there, and the colour that the two make.
#ifndef FB_BORDER_H
#define FB_BORDER_H

#include "math/normal.h"
#include "path.h"

// Units: no border is farther away.
constexpr Real BORDER_FAR(30);

inline Direction14 directionOf(const Normal& n)
{
    return {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

// Sets the border of a seed: which way and how far it is to where the strongest neighbour's field equals the own one, to first
// order. `dominance`: by how much the neighbour's was stronger at the position looked at last.
void findBorder(const Path& path, Seed& s, Real dominance);

// The same where the seed has a border already: the nearer one of the two.
SELDOM void findNearer(const Path& path, Seed& s, Real dominance);

// The mean of the objects' colours, by their fields at the position looked at last.
void mix(const Path& path, Seed& s);

#endif
