// How a settled seed lies, in C++: what asm/shade.S does, said plainly.
#include "surface/lie.h"

int32_t shadeSeedC(const ShadeFrame* frame, Seed* seed, Real position, int32_t over)
{
    Real along = frame->ownSlope;
    Vector g{Real(0), Real(0), Real(0)};
    for (int n = 0; n < frame->count; ++n)
        addPull(*frame->pulls[n], frame->slopes[n], along, g);
    g = g - seed->path * shiftDown(along * position, 4);
    return lieOn(*frame, *seed, g, position, over, {Real(0), Real(0), Real(0)});
}
