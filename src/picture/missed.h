// Missed: finds parts of the surface that no scale has drawn, when gaps are closed (gaps.h). At each inner corner of the drawn
// pixels, beside runs of one or two of them, at ends of rows that may end early, and across each border between objects where
// nothing is drawn at the surface's depth, a ray is intersected with the model's surface. Where it hits, the surface is followed
// from pixel to pixel.
#ifndef FB_MISSED_H
#define FB_MISSED_H

#include "rays.h"

class Missed {
public:
    // Lengths of the two sides of a corner, pixels. A corner with both sides of at least SIDE is not part of a round outline and
    // is filled. With both sides of LONG_BOTH or one side of LONG, more than a pixel of surface may be missing there.
    static constexpr int SIDE = 2, LONG_BOTH = 4, LONG = 8;

    // Without a model only short corners are closed.
    Missed(View& view, Rays& rays) : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), rays_(rays) {}

    // Note a pixel, possibly beside the screen, for draw(): one that may be in a corner; and one beside an end of a run of drawn
    // pixels, where the surface may go on (`inwards`, 1 or -1, leads to the run). Nothing is noted beyond NOTED_MOST; the rest of
    // the room is for what is followed.
    void noteCorner(int column, int row)
    {
        if (column >= 1 && column < machine::WIDTH - 1 && row >= 1 && row < machine::HEIGHT - 1 && count_ < NOTED_MOST)
            put(row * machine::WIDTH + column, 0);
    }
    void noteEnd(int column, int row, int inwards)
    {
        const int at = row * machine::WIDTH + column, depth = zbuffer_[at + inwards];
        // (With the depth 0 it would be taken for a corner.)
        if (column >= 0 && column < machine::WIDTH && depth != 0 && count_ < NOTED_MOST)
            put(at, depth);
    }

    // Draws the surface where it is missing at the noted pixels and at the view's crossings, and follows it to the pixels beside
    // them.
    void draw();

    // Draws the surface from a pixel on wherever it is missing. It is looked for from `depth` on (1/128 unit). Returns false when
    // none is missing there.
    bool follow(int at, int depth);

private:
    static constexpr int NOTED_MOST = 896, ROOM = 1024;

    // A pixel that the surface may go on to, and the depth where it is looked for (1/128 unit); 0: a corner.
    struct Place {
        uint16_t pixel, depth;
    };

    void put(int pixel, int depth)
    {
        if (count_ < ROOM)
            noted_[count_++] = {static_cast<uint16_t>(pixel), static_cast<uint16_t>(depth)};
    }
    int sideFrom(int at, int step, int aside) const;
    bool takeCorner(int at);
    bool isMissing(int at, int depth) const;
    int drawnBeside(int at, int depth) const;
    bool findSurface(int at, int* depth);
    bool drawPixel(Place place);

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    Rays& rays_;
    Place noted_[ROOM];
    int count_ = 0;
};

#endif
