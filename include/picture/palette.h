// Palette: the 256 colours of mode 13h. They hold a ramp of brightness for each colour of the model, or one grey ramp of 64 steps
// (/G, "a monochrome mode that gives a nicer display").
#ifndef FB_PALETTE_H
#define FB_PALETTE_H

#include "model/model.h"
#include "surface/voxel.h"

class Palette {
public:
    static constexpr int STEPS = 64;
    static constexpr int RAMP = STEPS + 2 * SHADING_MOST + 256;  // bytes of a ramp (see VoxelList::ramp)

    // Ambient light of coloured ramps, of 63. The grey ramp has no ambient light, so that all of its steps show the form.
    static constexpr int AMBIENT = 9;

    // Above this light, of 63, a colour turns towards white; at full light it is half way there. This gives a highlight at no
    // cost when drawing.
    static constexpr int HIGHLIGHT = 52;

    // The limit that a shining finish (model/paint.h) has instead of HIGHLIGHT; such a finish is white at full light.
    static constexpr int GLOSS = 47;

    // Upper bound of the number of ramps.
    static constexpr int RAMPS_MOST = 240;

    // The palette entry of text and marks: the same near-white in every scene, never part of a ramp.
    static constexpr uint8_t INK = 255;

    // Makes ramps for the model's colours and sets the ramp of each object. Up to four colours have ramps of at least 63 entries
    // each. More colours share the 254 entries: ramp steps that are close to each other in colour and brightness become one
    // entry, with the smallest total error. The entries of all ramps are in the order of brightness, and spread over the palette:
    // about four of them are one step. Finishes, patterns and mixed colours need ramps as colours do, and the objects get their
    // paint too, unless `plain` is set. With `grey`, finishes are the only paint that shows.
    void make(Model& model, bool grey, bool plain = false);

    // Red, green and blue of the 256 colours, 0..63, in the DAC's format.
    const uint8_t* dac() const { return dac_; }

    // The brightness, 0..63, that a palette entry has in a ramp that contains it.
    int step(uint8_t entry) const { return steps_[entry]; }

    // The number, 1..RAMPS_MOST, of the ramp that contains a palette entry, 0 if none or several do; the number of an object's
    // ramp, a raised one having that of the ramp it is a copy of; and the ramp with a number.
    uint8_t rampOf(uint8_t entry) const { return rampOf_[entry]; }
    int numberOf(const uint8_t* ramp) const
    {
        return ramp == raised_ + SHADING_MOST ? raisedNumber_ : static_cast<int>(ramp - ramps_[0]) / RAMP + 1;
    }
    const uint8_t* ramp(int number) const { return ramps_[number - 1] + SHADING_MOST; }

    // Whether all objects have one grey ramp.
    bool isGrey() const { return grey_; }

    // Returns a copy of a ramp with its brightness raised by `steps`, to mark the selected object. It is valid until the next
    // call.
    const uint8_t* raised(const uint8_t* ramp, int steps);

private:
    static constexpr int ENTRIES = INK - 1;  // palette entries for ramps; the first one is number 1
    static constexpr int EVEN_MOST = 4;      // up to this number of colours each ramp has entries of its own

    static_assert(Paints::MOST <= RAMPS_MOST, "each colour has a ramp");

    void makeGrey(Model& model, bool painted);
    void makeColours(Model& model, bool painted);
    void shareEvenly(const Colour* colours, const bool* shines, int count);
    void share(const Colour* colours, const bool* shines, int count, const Paints* weights);
    void neverDarken(uint8_t* ramp) const;
    void describeEntries(int count);
    void handRamps(Paint& paint) const;

    bool grey_ = false;
    Paints paints_;
    Paint paint_[Model::OBJECTS_MOST];
    uint8_t dac_[768];
    uint8_t steps_[256] = {}, rampOf_[256] = {};
    uint8_t ramps_[RAMPS_MOST][RAMP];
    uint8_t raised_[RAMP];
    int raisedNumber_ = 0;
};

#endif
