// Surface that nothing was drawn of, when gaps are closed (gaps.h): in an inner corner of what is drawn the model is asked whether
// there is any, and from there on it is followed pixel by pixel.
#ifndef FB_MISSED_H
#define FB_MISSED_H

#include "picture/view.h"

class Missed {
public:
    // Model and palette may be null: nothing is drawn, and all is grey.
    Missed(View& view, const Model* model, const Palette* palette)
        : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), model_(model), palette_(palette)
    {
    }

    // Whether a pixel is empty and in a corner of drawn ones, the one beside it, against the way `outwards`, and some above or
    // below: of sides so long that it is none of a round outline.
    static bool inCorner(const uint8_t* frame, int column, int row, int outwards)
    {
        if (column < SIDE || column >= machine::WIDTH - SIDE || row < SIDE || row >= machine::HEIGHT - SIDE)
            return false;
        const uint8_t* const pixel = frame + row * machine::WIDTH + column;
        return pixel[0] == 0 && (hasSides(pixel, outwards, machine::WIDTH) || hasSides(pixel, outwards, -machine::WIDTH));
    }

    // Notes a pixel that may be so when all gaps are closed. Of too many the last are left out.
    void note(int column, int row)
    {
        if (count_ < NOTED_MOST)
            noted_[count_++] = {static_cast<int16_t>(column), static_cast<int16_t>(row)};
    }

    // Draws what there is at those noted, and beside them.
    void draw();

private:
    static constexpr int SIDE = 3;
    static constexpr int NOTED_MOST = 512;

    static bool hasSides(const uint8_t* pixel, int outwards, int down)
    {
        for (int i = 0; i < SIDE; ++i)
            if (pixel[-outwards - i * down] == 0 || pixel[down + i * outwards] == 0)
                return false;
        return true;
    }

    void drawPixel(int column, int row);
    Real excess(int at, int depth);
    bool findDepth(int at, int* depth);
    void setColour(int at, int depth, int beside);

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    const Model* model_;
    const Palette* palette_;
    struct Place {
        int16_t column, row;
    } noted_[NOTED_MOST];
    int count_ = 0;
    int looks_ = 0;  // at fields, so far
    int strongest_ = -1;  // object at the last of them
};

#endif
