// The 256 colours of mode 13h: a ramp of brightness for each colour of the model, or one grey ramp of 64 steps (/G,
// "a monochrome mode that gives a nicer display").
#ifndef FB_PALETTE_H
#define FB_PALETTE_H

#include "model/model.h"
#include "surface/voxel.h"

class Palette {
public:
    static constexpr int STEPS = 64;
    static constexpr int RAMP = STEPS + 2 * SHADING_MOST;  // with the ends again, see VoxelList

    // Of 63: the light that reaches every place, in colour. The grey ramp starts in the dark, so that all its steps are
    // there for the form.
    static constexpr int AMBIENT = 9;

    // Of 63: above this light a colour turns towards white, and is half way there at full light. A highlight, at no cost
    // when drawing.
    static constexpr int HIGHLIGHT = 52;

    // Of 63: the same for what shines (model/paint.h), which is white at full light.
    static constexpr int GLOSS = 47;

    // The entry of text and marks: the same near-white in every scene, no part of a ramp.
    static constexpr uint8_t INK = 255;

    // Makes ramps for the model's colours and hands each object its own. The ramps of up to four colours have 63 entries
    // or more each. More colours share the 254 entries by need: those that are nearest to each other in colour and
    // brightness are one, so that each ramp is as true as its neighbours leave it. Finishes, patterns and colours that mix
    // take ramps like colours do, and the objects are handed their paint, unless `plain`; of these, grey has finishes only.
    void make(Model& model, bool grey, bool plain = false);

    // Red, green and blue of the 256 colours, 0..63, as the DAC takes them.
    const uint8_t* dac() const { return dac_; }

    // The brightness of an entry, 0..63, in a ramp that has it.
    int step(uint8_t entry) const { return steps_[entry]; }

    // A ramp like the object's own with its brightness raised by `steps`, for the selected one; valid until the next
    // call.
    const uint8_t* raised(const uint8_t* ramp, int steps);

private:
    static constexpr int ENTRIES = INK - 1;  // for ramps, from 1 on
    static constexpr int RAMPS_MOST = 240;
    static constexpr int EVEN_MOST = 4;      // colours whose ramps have entries of their own

    static_assert(Paints::MOST <= RAMPS_MOST, "each colour has a ramp");

    void makeGrey(Model& model, bool painted);
    void makeColours(Model& model, bool painted);
    void shareEvenly(const Colour* colours, const bool* shines, int count);
    void share(const Colour* colours, const bool* shines, int count, const Paints* weights);
    void neverDarken(uint8_t* ramp) const;
    void handRamps(Paint& paint) const;

    Paints paints_;
    Paint paint_[Model::OBJECTS_MOST];
    uint8_t dac_[768];
    uint8_t steps_[256] = {};
    uint8_t ramps_[RAMPS_MOST][RAMP];
    uint8_t raised_[RAMP];
};

#endif
