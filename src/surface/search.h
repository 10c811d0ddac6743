// Search: where a path leaves the surface, by Newton's method from where the seed was, or along the whole path.
#ifndef FB_SEARCH_H
#define FB_SEARCH_H

#include "path.h"

// Of the field: a seed that is this near the isovalue is on the surface.
constexpr Real TOLERANCE(0.004);
// Of the field: a valley this shallow above the isovalue is looked into.
constexpr Real VALLEY(0.12);

// Newton's method from a sample already taken. True: `*position` is on the surface, and `*sample` was taken there or a short step
// before.
bool follow(Path& path, Real* position, Sample* sample);

// Whether the seed is sure to lie inside a neighbour: from COVERED_AT or a place farther out on that is the stronger one, and the
// path has not left the surface before. `*margin` becomes by how much of the field both hold. Position and sample are those of the
// last of the two that was looked at.
bool isInside(Path& path, Real* position, Sample* sample, Real* margin);

// Looks for the first place where the path leaves the surface. `*position` becomes that place and `*sample` what is there; where
// the path leaves the surface nowhere, `*position` is the lowest place that was seen and the excess of `*sample` is above 0.
// Returns how far from the isovalue the field stayed before: the least excess of the valleys that were looked into.
Real search(Path& path, Real* position, Sample* sample);

// The same for the paths of a weak object, or of one that something digs into: the last place where the path leaves the surface,
// because it hides those before. Places where a neighbour is the stronger one count only if there are no others. On a path that
// samples a hollow it is the first place. Where there is none, `*off` becomes by how much of the field the path misses the surface.
// `*push` becomes by how much that may change when the neighbours come by a unit.
SELDOM Real searchDeep(Path& path, Real* position, Sample* sample, Real* off, Real* push);

// Where the path of a seed comes back to the surface that it left at the seed, before the field falls far below the isovalue.
// False: nowhere, or so near that the two places cannot be told apart.
bool comesBack(Path& path, const Seed& s, Real* position, Sample* sample);

// The same from a position on of the path at hand, however far the field falls before, as long as the own object is the strongest
// and its field no weaker than `weakest`. The path comes back between the two positions.
bool comesBackFar(Path& path, Real from, Real weakest, Real* outside, Real* inside);

// Where it then leaves the surface for the second time: from `*inside` on, which moves there. False: another object is the stronger
// before it does.
bool leavesAgain(Path& path, Real* inside, Real* outside);

// Finds where the path crosses the surface between a position inside and one outside.
void bisect(Path& path, Real inside, Real outside, Real* position, Sample* sample);

#endif
