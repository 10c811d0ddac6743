// Settle: where the path of a seed leaves the surface of its body, and which way the surface faces there.
#ifndef FB_SETTLE_H
#define FB_SETTLE_H

#include "strip.h"

// Settles a strip that neighbours reach: regular seeds, then the oversampled ones that are needed. Position, normal and flags
// of its seeds are set; a seed that finds no surface of its own object is left without SEED_VALID.
void settleStrip(SoftObject& object, const Strip& strip, const Reached& reached, const FrameContext& frame);

// Puts the seeds of a strip where no neighbour reaches them.
void restStrip(SoftObject& object, const Strip& strip);

// Marks the seeds of a strip as not on the surface.
void loseStrip(SoftObject& object, const Strip& strip);

#endif
