// How objects look: their colours, finishes and patterns, and the light.
#include "app/edit.h"

#include "math/text.h"

namespace {

// The colours that an object can be given; the first NEW_COLOURS are also the colours of new objects.
const Colour COLOURS[] = {{224, 80, 224}, {64, 208, 216}, {255, 136, 40}, {208, 208, 208}, {160, 224, 64},
                          {255, 64, 48},  {64, 208, 72},  {72, 112, 255}, {255, 200, 48},  {176, 112, 72},
                          {255, 144, 176}, {136, 96, 224}};
constexpr int COLOUR_COUNT = static_cast<int>(sizeof COLOURS / sizeof COLOURS[0]);
constexpr int NEW_COLOURS = 5;

// The grain of a pattern that the user gives to an object, units.
constexpr Real GRAIN(6);

// Returns the squared distance of two colours.
int distance(const Colour& a, const Colour& b)
{
    const int red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
    return red * red + green * green + blue * blue;
}

// Returns the colour of the list that differs most from `colour`.
Colour unlike(const Colour& colour)
{
    int farthest = 0;
    for (int i = 1; i < COLOUR_COUNT; ++i)
        if (distance(COLOURS[i], colour) > distance(COLOURS[farthest], colour))
            farthest = i;
    return COLOURS[farthest];
}

}  // namespace

// The colour of a new object when there are `objects` already.
Colour Editor::newColour(int objects)
{
    return COLOURS[objects % NEW_COLOURS];
}

bool Editor::colour(int step, Time now)
{
    Actor& actor = current();
    int nearest = 0;
    for (int i = 1; i < COLOUR_COUNT; ++i)
        if (distance(COLOURS[i], actor.colour) < distance(COLOURS[nearest], actor.colour))
            nearest = i;
    if (!begin(COLOUR, now))
        return false;
    actor.colour = COLOURS[(nearest + step + COLOUR_COUNT) % COLOUR_COUNT];
    snprintf(message_, sizeof message_, "colour %d %d %d", actor.colour.red, actor.colour.green, actor.colour.blue);
    return true;
}

bool Editor::finish()
{
    if (!begin(OTHER, 0))
        return false;
    Coat& coat = current().coat;
    coat.finish = static_cast<Finish>((coat.finish + 1) % FINISHES);
    say("finish ", FINISH_WORDS[coat.finish]);
    return true;
}

bool Editor::pattern()
{
    if (!begin(OTHER, 0))
        return false;
    Coat& coat = current().coat;
    if (coat.grain == Real(0)) {
        coat.grain = GRAIN;
        coat.colour = unlike(current().colour);
    }
    coat.pattern = static_cast<Pattern>((coat.pattern + 1) % PATTERNS);
    say("pattern ", PATTERN_WORDS[coat.pattern]);
    return true;
}

bool Editor::light(int axis, Real degrees, Time now)
{
    if (!begin(LIGHT, now))
        return false;
    const Real none(0), one(1);
    const Vector about{axis == 0 ? one : none, axis == 1 ? one : none, none};
    model_.setLight(Matrix::rotation(about, fromDegrees(degrees)) * unit(model_.light));
    char x[24], y[24], z[24];
    const auto text = [](char* to, Real value) {
        const int32_t raw = rawFromReal(value);
        to[0] = '-';
        formatQuotient(raw < 0 ? to + 1 : to, 20, static_cast<uint32_t>(raw < 0 ? -raw : raw), 65536, 2);
    };
    text(x, model_.light.x);
    text(y, model_.light.y);
    text(z, model_.light.z);
    snprintf(message_, sizeof message_, "light %s %s %s", x, y, z);
    return true;
}
