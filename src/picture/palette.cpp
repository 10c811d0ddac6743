// Ramps of brightness.
#include "picture/palette.h"

#include "rt.h"

namespace {

// Brightness that the grey ramp never undercuts, of 64 steps: what no light reaches still stands out from the background.
constexpr int DARKEST = 2;

// Above this step a colour turns towards white: a highlight, at no cost when drawing.
constexpr int HIGHLIGHT = 52;

// Of Palette::INK, as the DAC takes it.
constexpr uint8_t INK_COLOUR[3] = {63, 63, 56};

int distance(const Colour& a, const Colour& b)
{
    const int red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
    return red * red + green * green + blue * blue;
}

uint8_t shade(int full, int step)
{
    const int value = full * 63 / 255 * (Palette::AMBIENT + step * (63 - Palette::AMBIENT) / 63) / 63;
    if (step <= HIGHLIGHT)
        return static_cast<uint8_t>(value);
    return static_cast<uint8_t>(value + (63 - value) * (step - HIGHLIGHT) / (2 * (63 - HIGHLIGHT)));
}

// Repeats the ends of a ramp; returns it.
const uint8_t* lengthen(uint8_t* ramp)
{
    for (int i = 1; i <= SHADING_MOST; ++i) {
        ramp[-i] = ramp[0];
        ramp[Palette::STEPS - 1 + i] = ramp[Palette::STEPS - 1];
    }
    return ramp;
}

}  // namespace

void Palette::make(Model& model, bool grey)
{
    memset(dac_, 0, sizeof dac_);
    memcpy(dac_ + 3 * INK, INK_COLOUR, sizeof INK_COLOUR);
    if (grey) {
        for (int i = 0; i < STEPS; ++i) {
            const uint8_t value = static_cast<uint8_t>(i < DARKEST ? DARKEST : i);
            memset(dac_ + 3 * (1 + i), value, 3);
            ramps_[0][SHADING_MOST + i] = static_cast<uint8_t>(1 + i);
        }
        const uint8_t* ramp = lengthen(ramps_[0] + SHADING_MOST);
        for (int i = 0; i < model.count(); ++i)
            model.actor(i).object->setRamp(ramp);
        return;
    }
    dac_[0] = 1;
    dac_[1] = 1;
    dac_[2] = 6;
    Colour colours[RAMPS_MOST];
    int count = 0;
    for (int i = 0; i < model.count(); ++i) {
        bool there = false;
        for (int c = 0; c < count; ++c)
            there = there || distance(colours[c], model.actor(i).colour) == 0;
        if (!there && count < RAMPS_MOST)
            colours[count++] = model.actor(i).colour;
    }
    if (count == 0)
        return;
    const int steps = ENTRIES / count < STEPS ? ENTRIES / count : STEPS;
    for (int c = 0; c < count; ++c) {
        for (int i = 0; i < STEPS; ++i)
            ramps_[c][SHADING_MOST + i] = static_cast<uint8_t>(1 + c * steps + i * steps / STEPS);
        lengthen(ramps_[c] + SHADING_MOST);
        for (int i = 0; i < steps; ++i) {
            const int step = i * 63 / (steps - 1);
            uint8_t* entry = dac_ + 3 * (1 + c * steps + i);
            entry[0] = shade(colours[c].red, step);
            entry[1] = shade(colours[c].green, step);
            entry[2] = shade(colours[c].blue, step);
        }
    }
    for (int i = 0; i < model.count(); ++i) {
        int best = 0;
        for (int c = 1; c < count; ++c)
            if (distance(colours[c], model.actor(i).colour) < distance(colours[best], model.actor(i).colour))
                best = c;
        model.actor(i).object->setRamp(ramps_[best] + SHADING_MOST);
    }
}

const uint8_t* Palette::raised(const uint8_t* ramp, int steps)
{
    for (int i = 0; i < STEPS; ++i) {
        const int step = i + steps;
        raised_[SHADING_MOST + i] = ramp[step < 0 ? 0 : step > STEPS - 1 ? STEPS - 1 : step];
    }
    return lengthen(raised_ + SHADING_MOST);
}
