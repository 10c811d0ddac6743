// Missed: finds parts of the surface that no scale has drawn, when gaps are closed (gaps.h). At each inner corner of the drawn
// pixels a ray is intersected with the model's surface; where it hits, the surface is followed from pixel to pixel.
#ifndef FB_MISSED_H
#define FB_MISSED_H

#include "picture/view.h"

class Missed {
public:
    // Lengths of the two sides of a corner, pixels. A corner with both sides of at least SIDE is not part of a round outline and
    // is filled. With both sides of LONG_BOTH or one side of LONG, more than a pixel of surface may be missing there.
    static constexpr int SIDE = 2, LONG_BOTH = 4, LONG = 8;

    // The model may be null; then only short corners are closed.
    Missed(View& view, const Model* model) : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), model_(model)
    {
    }

    // A quick test for whether an empty pixel may be in a corner of drawn ones. The pixel beside it, against the direction
    // `outwards` (-1 or 1), is drawn. One side of the corner goes up (or down) from there, the other goes outwards in the row
    // below (or above); the test looks at the last pixel, number SIDE, of both.
    static bool mayBeInCorner(const uint8_t* pixel, int outwards)
    {
        constexpr int DOWN = machine::WIDTH, UP = -DOWN, END = SIDE - 1;
        return (pixel[DOWN + END * outwards] != 0 && pixel[UP * END - outwards] != 0) ||
               (pixel[UP + END * outwards] != 0 && pixel[DOWN * END - outwards] != 0);
    }

    // Notes a pixel, possibly off the screen, that draw() is to look at. Does nothing when NOTED_MOST are noted already.
    void note(int column, int row)
    {
        if (count_ < NOTED_MOST)
            noted_[count_++] = {static_cast<int16_t>(column), static_cast<int16_t>(row)};
    }

    // Draws the surface at the noted pixels, and follows it to the pixels beside them.
    void draw();

private:
    static constexpr int NOTED_MOST = 1024;

    int sideFrom(int at, int step, int aside) const;
    bool takeCorner(int column, int row);
    void drawPixel(int column, int row);
    Real excess(int at, int depth);
    bool findDepth(int at, int* depth);
    bool findSurface(int at, int* depth, int* beside);
    void setColour(int at, int depth, int beside);

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    const Model* model_;
    struct Place {
        int16_t column, row;
    } noted_[NOTED_MOST];
    int count_ = 0;
    int looks_ = 0;        // evaluations of the field so far
    int strongest_ = -1;   // the object with the strongest field at the last evaluation; -1: none
    bool onEdge_ = false;  // the last ray only grazes the surface
};

#endif
