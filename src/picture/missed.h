// Missed: finds parts of the surface that no scale has drawn, when gaps are closed (gaps.h). At each inner corner of the drawn
// pixels, beside runs of one or two of them, and across each border between objects where nothing is drawn at the surface's depth,
// a ray is intersected with the model's surface. Where it hits, the surface is followed from pixel to pixel.
#ifndef FB_MISSED_H
#define FB_MISSED_H

#include "model/probe.h"
#include "picture/view.h"

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

// How often the model may be asked in a frame whose seeds lie `spacing` units apart: `atOne` times, divided by the cube of a
// spacing greater than 1. Slow machines choose coarse pictures, which must not cost more than they save.
int looksAt(Real spacing, int atOne);

// The brightness, 0..63, of a surface where the field has this gradient. Both vectors may have any length.
int brightnessOf(const Vector& gradient, const Vector& toLight);

class Missed {
public:
    // Lengths of the two sides of a corner, pixels. A corner with both sides of at least SIDE is not part of a round outline and
    // is filled. With both sides of LONG_BOTH or one side of LONG, more than a pixel of surface may be missing there.
    static constexpr int SIDE = 2, LONG_BOTH = 4, LONG = 8;

    // A pixel that is drawn shows the surface unless it is deeper by more than this, 1/128 unit.
    static constexpr int BEHIND = 512;

    // The seeds lie `spacing` units apart. The model may be null; then only short corners are closed.
    Missed(View& view, FieldProbe& probe, Real spacing);

    // A quick test for whether an empty pixel may be in a corner of drawn ones. The pixel beside it, against the direction
    // `outwards` (-1 or 1), is drawn. One side of the corner goes up (or down) from there, the other goes outwards in the row
    // below (or above); the test looks at the last pixel, number SIDE, of both.
    static bool mayBeInCorner(const uint8_t* pixel, int outwards)
    {
        constexpr int DOWN = machine::WIDTH, UP = -DOWN, END = SIDE - 1;
        return (pixel[DOWN + END * outwards] != 0 && pixel[UP * END - outwards] != 0) ||
               (pixel[UP + END * outwards] != 0 && pixel[DOWN * END - outwards] != 0);
    }

    // Notes a pixel, possibly off the screen, that may be in a corner, for draw(); or, if `inwards` is 1 or -1, one where the
    // surface that is drawn so many columns away may go on. Does nothing when NOTED_MOST are noted already.
    void note(int column, int row, int inwards = 0)
    {
        const int at = row * machine::WIDTH + column;
        if (column >= 1 && column < machine::WIDTH - 1 && row >= 1 && row < machine::HEIGHT - 1)
            put(at, inwards != 0 ? zbuffer_[at + inwards] : 0, at + inwards);
    }

    // Draws the surface where it is missing at the noted pixels and at the view's crossings, and follows it to the pixels beside
    // them.
    void draw();

    // Draws the surface from a pixel on wherever it is missing. It is looked for from `depth` on (1/128 unit), and is that of the
    // pixel `from`, if that is another pixel. Returns false when none is missing there.
    bool follow(int at, int depth, int from);

    // Gives a pixel this depth (1/128 unit) and the ramp of its object, with the brightness from the surface normal there. If the
    // object is painted, and the pixel `from` beside it shows that object too, it gets the colour of that one instead. Returns
    // false when there is no colour.
    bool setColour(int at, int depth, int from);

private:
    static constexpr int NOTED_MOST = 1024;

    // A pixel that the surface may go on to, the depth where it is looked for (1/128 unit), and the pixel that it comes from. A
    // corner has the depth 0, and only its pixel counts.
    struct Place {
        uint16_t pixel, depth, from;
    };

    void put(int pixel, int depth, int from)
    {
        if (count_ < NOTED_MOST)
            noted_[count_++] = {static_cast<uint16_t>(pixel), static_cast<uint16_t>(depth), static_cast<uint16_t>(from)};
    }
    int sideFrom(int at, int step, int aside) const;
    bool takeCorner(int at);
    bool isMissing(int at, int depth) const;
    int drawnBeside(int at, int depth) const;
    bool findSurface(Place* place);
    bool drawPixel(Place place);
    Real excess(int at, int depth);
    bool findInside(int at, int* depth, Real* here);
    bool findDepth(int at, int* depth);

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    FieldProbe& probe_;
    const Model* const model_;
    Place noted_[NOTED_MOST];
    int count_ = 0;
    const int looksMost_;  // no pixel is begun after this many evaluations of the field
    int looks_ = 0;        // evaluations of the field so far
    int strongest_ = -1;   // the object with the strongest field at the last evaluation; -1: none
    bool onEdge_ = false;  // the last ray only grazes the surface
};

#endif
