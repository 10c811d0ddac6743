// Surface that nothing was drawn of, when gaps are closed (gaps.h): in an inner corner of what is drawn the model is asked whether
// there is any, and from there on it is followed pixel by pixel.
#ifndef FB_MISSED_H
#define FB_MISSED_H

#include "picture/view.h"

class Missed {
public:
    // So long are both sides of a corner that is none of a round outline. Where they are longer, both or one of them, there may be
    // more than a pixel of it.
    static constexpr int SIDE = 2, LONG_BOTH = 4, LONG = 8;

    // The model may be null: only short corners are closed.
    Missed(View& view, const Model* model) : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), model_(model)
    {
    }

    // Whether an empty pixel may be in a corner of drawn ones: of the one beside it, against the way `outwards`, and those above
    // that or below, and of as many in the row below or above.
    static bool mayBeInCorner(const uint8_t* pixel, int outwards)
    {
        constexpr int DOWN = machine::WIDTH, UP = -DOWN, END = SIDE - 1;
        return (pixel[DOWN + END * outwards] != 0 && pixel[UP * END - outwards] != 0) ||
               (pixel[UP + END * outwards] != 0 && pixel[DOWN * END - outwards] != 0);
    }

    // Notes a pixel that may be so when all gaps are closed; it may lie beside the screen. Of too many the last are left out.
    void note(int column, int row)
    {
        if (count_ < NOTED_MOST)
            noted_[count_++] = {static_cast<int16_t>(column), static_cast<int16_t>(row)};
    }

    // Draws what there is at those noted, and beside them.
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
    int looks_ = 0;  // at fields, so far
    int strongest_ = -1;  // object at the last of them
    bool onEdge_ = false;  // the ray that was followed last only just meets the surface
};

#endif
