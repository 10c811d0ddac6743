// Borders of colours: where two colours meet on the surface, gives each pixel the colour of the object that it belongs to; at an
// edge of an object's pattern the one that the pattern has there.
#ifndef FB_BORDERS_H
#define FB_BORDERS_H

#include "rays.h"

class Borders {
public:
    // There is a model, and the palette has made the ramps of its objects, in colour; colours do not mix.
    Borders(View& view, FieldProbe& probe, const Palette& palette, Rays& rays);

    // Finds pixels at borders of colours that have a wrong colour, and gives them the right one. Depths stay. To be called when
    // gaps are closed.
    void mend();

private:
    // A pixel, and one beside it whose object it may belong to.
    struct Place {
        uint16_t pixel, from;
    };
    // The two objects that a pixel may belong to: the strongest one there of those that have another pixel's ramp, and of those
    // that have the ramp it is shown in; null where none reaches. The first one's field is stronger by `ahead` than the second's.
    struct Rivals {
        const SoftObject *other, *shown;
        Real ahead;
    };

    void list(int entry, int ramp);
    void mendBeside(int right);
    void noteScraps(int middle);
    void note(int at, int from);
    bool mendPixel(const Place& place);
    bool showExactly(int at, int depth);
    bool passOn(int at, int ramp, int own, const Rivals& rivals);
    int meanBrightness(int at, int ramp) const;
    Rivals rivalsAt(int ramp, int own, const Point& p) const;
    const SoftObject* strongestOf(int ramp, const Point& p, Real* field) const;
    bool correctDepth(const SoftObject& object, int at, int* depth) const;
    int rampAt(int pixel) const { return palette_.rampOf(frame_[pixel]); }

    static constexpr int NOTED_MOST = 256;

    View& view_;
    const uint8_t* frame_;
    const uint16_t* zbuffer_;
    FieldProbe& probe_;
    const Model& model_;
    const Palette& palette_;
    Rays& rays_;
    Place noted_[NOTED_MOST];  // pixels that wait to be looked at
    int count_ = 0;            // their number
    int looks_ = 0;            // pixels looked at so far
    // Lists of the objects that are shown in one ramp: the first entry of each ramp, and after each entry the next; -1: none.
    // Object i has entry 2 i for its own colour, and the next one for the other colour of its pattern.
    int16_t first_[Palette::RAMPS_MOST + 1], next_[2 * Model::OBJECTS_MOST];
};

#endif
