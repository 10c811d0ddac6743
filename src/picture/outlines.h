// Outlines: where the depth jumps from a pixel to the next one, the nearer surface ends. Scales end there only about right, and
// where no scale is, a crack lets what is behind show through. So the model is asked.
#ifndef FB_OUTLINES_H
#define FB_OUTLINES_H

#include "missed.h"

class Outlines {
public:
    // There is a model.
    Outlines(View& view, Rays& rays, FieldProbe& probe, Missed& missed);

    // Corrects the pixels on both sides of each jump: where its ray passes by the nearer surface a pixel gets what is behind, and
    // where the ray meets that surface it gets that. To be called when gaps are closed.
    void mend();

private:
    void mendUpright(const uint16_t* from, const uint16_t* to);
    void mendLying(const uint16_t* from, const uint16_t* to);
    void mendAt(const uint16_t* at, int step);
    void mendJump(const uint16_t* at, int step);
    void follow(int at, int behind);
    bool meets(int at, Real* excess);
    void showBehind(int at, int behind);
    void widen(int at, Real excess);
    void note(int at, int behind);

    static constexpr int NOTED_MOST = 256;

    // A pixel that may show a nearer surface wrongly, and one beside it that shows what is behind.
    struct Place {
        uint16_t pixel, behind;
    };

    View& view_;
    const uint16_t* zbuffer_;
    Rays& rays_;
    FieldProbe& probe_;
    Missed& missed_;
    const Real pixelWide_, pixelHigh_;  // width and height of a pixel at a depth of one unit, units
    Place noted_[NOTED_MOST];           // pixels that wait to be looked at
    int count_ = 0;                     // their number
    PixelSet wasNoted_;
};

#endif
