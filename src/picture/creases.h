// Creases: where two sides of the surface meet in a valley, a pixel shows the side whose scale is the nearer one there by a little,
// which may be the wrong side. So pixels beside which the brightness jumps get that of the model's surface itself, and its colour.
#ifndef FB_CREASES_H
#define FB_CREASES_H

#include "rays.h"

class Creases {
public:
    // There is a model, and the palette has made the ramps of its objects. The seeds lie `spacing` units apart. `found` is what the
    // frame before has found, and receives what this one finds.
    Creases(View& view, FieldProbe& probe, const Tint& tint, const Palette& palette, Real spacing, View::FoundCreases& found);

    // Corrects brightness and colour of pixels beside creases, where lists of voxels have borders to other objects. Depths stay, so
    // that they do not depend on the colours that are shown. To be called when gaps are closed.
    void mend();

private:
    void mendRow(int y);
    void mendPair(int at, int other);
    void follow(int at);
    bool mendPixel(int at);
    bool jumps(int at, int other) const;
    void note(int at);
    int stepAt(int pixel) const { return palette_.step(frame_[pixel]); }

    static constexpr int NOTED_MOST = 256;

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    FieldProbe& probe_;
    const Tint& tint_;
    const Palette& palette_;
    View::FoundCreases& found_;
    uint16_t noted_[NOTED_MOST];  // pixels that wait to be looked at
    int count_ = 0;               // their number
    int looks_ = 0;               // pixels looked at so far
    const int looksMost_;         // upper bound of their number
    PixelSet wasNoted_;           // cleared when the first crease of a frame is found
};

#endif
