// Rays: asks the model what the rays of sight through single pixels meet, and shows that.
#ifndef FB_RAYS_H
#define FB_RAYS_H

#include "model/probe.h"
#include "picture/view.h"
#include "rt.h"
#include "tint.h"

// Calls each(pixel) for those of the four pixels beside a pixel that are on the screen: left, right, above and below.
template <class Each>
inline void forBeside(int at, Each each)
{
    using machine::WIDTH;
    const int column = at % WIDTH;
    if (column > 0)
        each(at - 1);
    if (column < WIDTH - 1)
        each(at + 1);
    if (at >= WIDTH)
        each(at - WIDTH);
    if (at < WIDTH * (machine::HEIGHT - 1))
        each(at + WIDTH);
}

// A set of pixels of the screen. It must be emptied before it is used.
class PixelSet {
public:
    void clear() { memset(bits_, 0, sizeof bits_); }
    // Returns false if the pixel is in the set already.
    bool add(int at)
    {
        uint32_t& bits = bits_[at / 32];
        const uint32_t bit = 1u << at % 32;
        const bool isNew = (bits & bit) == 0;
        bits |= bit;
        return isNew;
    }

private:
    uint32_t bits_[machine::WIDTH * machine::HEIGHT / 32];
};

// How often the model may be asked in a frame whose seeds lie `spacing` units apart: `atOne` times, divided by the cube of a
// spacing greater than 1. Slow machines choose coarse pictures, which must not cost more than they save.
int looksAt(Real spacing, int atOne);

class Rays {
public:
    // A pixel that is drawn shows the surface unless it is deeper by more than this, 1/128 unit. Pixels side by side whose depths
    // differ by more show different pieces of the surface.
    static constexpr int BEHIND = 512;

    // The seeds lie `spacing` units apart. Without a model (null) all rays are tired from the first.
    Rays(View& view, FieldProbe& probe, const Tint& tint, Real spacing);

    // Whether the model has been asked too often in this frame already: no pixel is begun any more.
    bool tired() const { return looks_ >= looksMost_; }

    // All depths are in 1/128 unit.

    // Returns by how much the field exceeds the isovalue at the point that a pixel shows at a depth.
    Real excess(int at, int depth);
    // Looks for a point inside along the ray through a pixel, from a depth on, in the direction in which the field rises. `*depth`
    // and `*here`, the excess there, become those of the last point. No step is more than `maxGrowth` times as long as the one
    // before. Returns false when the ray misses the surface.
    bool findInside(int at, int* depth, Real* here, int maxGrowth);
    // Finds where the ray through a pixel enters the surface. `*depth` is a first guess and becomes the result. Returns false when
    // the ray misses the surface.
    bool findDepth(int at, int* depth);

    // Gives a pixel this depth, and the palette entry of the surface there. Returns false when it has none.
    bool show(int at, int depth);

private:
    View& view_;
    FieldProbe& probe_;
    const Tint& tint_;
    const int looksMost_;  // no pixel is begun after this many evaluations of the field
    int looks_ = 0;        // evaluations of the field so far
};

#endif
