// Tint: the palette entry of a point of the model's surface: its colour, also that of a pattern or a mixture, and its brightness,
// also that of a finish.
#ifndef FB_TINT_H
#define FB_TINT_H

#include "model/probe.h"
#include "surface/finish.h"

class Tint {
public:
    // The axes are those of the view. The model of the probe may be null; then entry() must not be called.
    Tint(const FieldProbe& probe, const ViewAxes& axes);

    // The entry of the point that the probe was asked for last; `strongest` is what FieldProbe::implicitAt() found there, not -1.
    // Returns 0 if that object has no ramp.
    uint8_t entry(const Point& p, int strongest) const;

private:
    SELDOM const uint8_t* rampAt(const Point& p, const SoftObject& object) const;

    const FieldProbe& probe_;
    const Polish polish_;  // axes of the world
};

#endif
