// Settle: where the path of a seed leaves the surface of its body, and which way the surface faces there.
#ifndef FB_SETTLE_H
#define FB_SETTLE_H

#include "patch.h"

// Settles the regular seeds of a patch that neighbours reach: position, normal and flags. A seed that finds no surface of its
// own object is left without SEED_VALID.
void settle(SoftObject& object, Patch& patch, const Neighbour* neighbours, const FrameContext& frame);

// Settles those oversampled seeds of such a patch that are needed, when all regular ones have been; the others end.
void oversample(SoftObject& object, const Patch& patch, const Neighbour* neighbours, const FrameContext& frame);

// Puts the seeds of a patch where no neighbour reaches them.
void rest(SoftObject& object, const Patch& patch);

// Marks the seeds of a patch as not on the surface.
void lose(SoftObject& object, const Patch& patch);

#endif
