// Search: where a path leaves the surface, by Newton's method from where the seed was, or along the whole path.
#ifndef FB_SEARCH_H
#define FB_SEARCH_H

#include "path.h"

// Of the field: a seed that is this near the isovalue is on the surface.
constexpr Real TOLERANCE(0.004);

// Newton's method from a sample already taken. True: `*position` is on the surface, and `*sample` was taken there or a short step
// before.
bool follow(Path& path, Real* position, Sample* sample);

// Looks for the first place where the path leaves the surface, and returns by how much the field exceeds the isovalue at least
// where it had a valley before. When the path leaves it nowhere, `*sample` exceeds it as well. `*sample` was taken at `*position`.
Real search(Path& path, Real* position, Sample* sample);

// The same for a path that is hollowed out, or a weak object's: the last place where the path leaves the surface, for what lies
// before it is hidden; of those where no neighbour is stronger, if there are any. In a hollow it is the first. Where nothing is
// found `*off` says by how much of the field. `*push` becomes what that may change by when the neighbours come by a unit.
SELDOM Real searchDeep(Path& path, Real* position, Sample* sample, Real* off, Real* push);

// Where a path that has left the surface at `from` is inside again; `far` says that it may go far and deep between. False: nowhere,
// or too near to tell.
bool comesBack(Path& path, Real from, bool far, Real* position, Sample* sample);

#endif
