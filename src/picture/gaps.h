// Gaps: finds the gaps between scales through which the background shows, when all objects of a frame are drawn, and fills them
// (View::closeGaps()).
#ifndef FB_GAPS_H
#define FB_GAPS_H

#include "missed.h"

class Gaps {
public:
    // The seeds lie `spacing` units apart. The model and the palette may be null. What is missing is noted in `missed`, and
    // drawn.
    Gaps(View& view, FieldProbe& probe, const Palette* palette, Missed& missed, Real spacing)
        : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), probe_(probe), model_(probe.model()), palette_(palette),
          missed_(missed), spacingTimesDepth_(mulShift16(rawFromReal(view.camera().focalX) >> 4, rawFromReal(spacing)) >> 5)
    {
    }

    void close();

private:
    void noteCorners(int y, const Span& run);
    bool isBordered(int y, int x) const;
    void noteCorner(int y, int x, int outwards);
    void noteSliver(int y, const Span& run);
    void noteEnds(int y, const Span& run);
    void noteBeyond(int y, const Span& columns);
    void noteOutline(int y, const Span& run);
    void closeRow(int y);
    void closeBefore(int y, int last, int from);
    void closeRun(int y, int from, int to);
    void closeAbove(int y, int x);
    void closeFrom(int y, int from, int to, int step, int spacing);
    int spacingAt(int first, int last) const;
    static int widest(int spacing);
    void closeSlit(int y, int x, int end, int step);
    bool searchBehind(int first, int last);
    bool closeExactly(int first, int last);
    Real distanceOff(int first, int last, int step) const;
    Real distanceOff(const Point& p) const;
    const uint8_t* commonRamp(int first, int last) const;
    bool differ(int first, int last) const;
    void fill(int first, int last, int step);

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    FieldProbe& probe_;
    const Model* const model_;
    const Palette* palette_;
    Missed& missed_;
    const int32_t spacingTimesDepth_;  // divided by a depth of the Z-buffer it is the spacing of the seeds in pixels
};

#endif
