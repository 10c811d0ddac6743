// Border: where another object of the body takes over from a seed's own. A seed near that border knows its direction and distance,
// so that its scale ends there, and the colour to which the objects' colours mix.
#ifndef FB_BORDER_H
#define FB_BORDER_H

#include "math/normal.h"
#include "path.h"

// Units: a border farther away counts as being at this distance.
constexpr Real BORDER_FAR(30);

// Two fields count as the same if they differ by less than TIE times the neighbour's.
constexpr Real TIE(0.004);

// 1/256 unit: a seed no farther than this from a border knows how the light changes around it (Seed::lightChange), and so do all
// oversampled and fine seeds. The seeds about these would tell it badly, because some are missing.
constexpr int32_t BESIDE = 256;
inline bool isBesideBorder(const Seed& s)
{
    return (s.flags & SEED_BORDER) && s.apart <= BESIDE;
}

inline Direction14 directionOf(const Normal& n)
{
    return {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

// Sets the border of a seed, to first order: direction and distance of the place where the strongest neighbour's field equals the
// own one. `fieldLead` is the neighbour's field less the own one at the position evaluated last. Returns false if the two fields
// are the same around the seed, as around the end that two tubes share, and the neighbour stands before the own object in the
// model: the surface is the neighbour's then, so that only one of the two draws it.
bool findBorder(const Path& path, Seed& s, Real fieldLead);

// Sets the border of a seed in a place that belongs to a neighbour, its host: direction and distance of the place where the host's
// field equals the second strongest one, be that the own field or another's.
SELDOM void findGuestBorder(const Path& path, Seed& s, const Neighbour& host);

// As findBorder(), for a seed that has a border already: the seed keeps the nearer one of the two.
SELDOM bool findNearer(const Path& path, Seed& s, Real fieldLead);

// Sets the colour of a seed to the mean of the objects' colours, weighted by their fields at the position evaluated last.
void mix(const Path& path, Seed& s);

#endif
