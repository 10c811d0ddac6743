// Tests of palettes: ramps never get darker towards the light, and many objects share the 256 colours fairly.
#include "picture/palette.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "help.h"
#include "test.h"

namespace {

int light(const Palette& palette, int index)
{
    const uint8_t* c = palette.dac() + 3 * index;
    return c[0] + c[1] + c[2];
}

void inRange(const Palette& palette)
{
    for (int i = 0; i < 768; ++i)
        CHECK(palette.dac()[i] <= 63);
}

}  // namespace

TEST(grey_ramp)
{
    Model model;
    CHECK(model.makeFourSpheres());
    Palette palette;
    palette.make(model, true);
    inRange(palette);
    const uint8_t* ramp = model.actor(0).object->ramp();
    int steps = 1;
    for (int i = 1; i < 64; ++i) {
        CHECK(light(palette, ramp[i]) >= light(palette, ramp[i - 1]));
        steps += light(palette, ramp[i]) != light(palette, ramp[i - 1]);
    }
    // "One 64-step ramp", except that the darkest steps are equal so that they differ from the background.
    CHECK(steps >= 60);
    for (int i = 0; i < 64; ++i) {
        const uint8_t* c = palette.dac() + 3 * ramp[i];
        CHECK(c[0] == c[1] && c[1] == c[2]);
        CHECK(ramp[i] != 0);
    }
    // Text has a palette entry of its own.
    CHECK(light(palette, Palette::INK) > 3 * 58);
    for (int i = 1; i < 4; ++i)
        for (int step = 0; step < 64; ++step)
            SAME(model.actor(i).object->ramp()[step], ramp[step]);
    SAME(light(palette, ramp[63]), 3 * 63);
}

TEST(a_ramp_for_each_colour)
{
    Model model;
    CHECK(model.makeFourSpheres());
    Palette palette;
    palette.make(model, false);
    inRange(palette);
    bool used[256] = {};
    for (int o = 0; o < 4; ++o) {
        const uint8_t* ramp = model.actor(o).object->ramp();
        bool own[256] = {};
        for (int i = 0; i < 64; ++i) {
            CHECK(ramp[i] != 0);
            CHECK(!used[ramp[i]]);
            own[ramp[i]] = true;
            if (i > 0)
                CHECK(light(palette, ramp[i]) >= light(palette, ramp[i - 1]));
        }
        for (int i = 0; i < 256; ++i)
            used[i] = used[i] || own[i];
        // The ramp has the hue of the object's colour: the components have the same order.
        const Colour& c = model.actor(o).colour;
        const uint8_t* middle = palette.dac() + 3 * ramp[45];
        CHECK((c.red >= c.green) == (middle[0] >= middle[1]));
        CHECK((c.green >= c.blue) == (middle[1] >= middle[2]));
    }
}

TEST(ramps_are_true_to_their_colours)
{
    // The dump's `ramp` and `ambient` lines promise at each step the colour times ambient + (1 - ambient) step / 63, up to where
    // highlights begin. Distances are in steps of the DAC.
    struct Bar {
        int colours;
        double rms, worst;
    };
    for (const Bar& bar : {Bar{1, 0.7, 1.8}, Bar{4, 0.7, 1.8}, Bar{5, 0.8, 2.5}, Bar{12, 1.6, 5}, Bar{17, 2.2, 7}, Bar{24, 2.8, 8},
                           Bar{64, 3.3, 11}, Bar{128, 3.3, 11}}) {
        Model model;
        std::vector<Colour> colours;
        for (int i = 0; i < bar.colours; ++i) {
            // Colours from all around the colour wheel, bright and dark.
            const auto part = [&](double turn) { return 0.5 + 0.5 * std::cos(2 * M_PI * (turn + double(i) / bar.colours)); };
            const double full = i % 3 == 0 ? 120 : 255;
            colours.push_back({static_cast<uint8_t>(full * part(0)), static_cast<uint8_t>(full * part(1 / 3.0)),
                               static_cast<uint8_t>(full * part(2 / 3.0))});
            CHECK(model.add(make<Sphere>(i + 1, Real(10)), colours.back(), Motion{}));
        }
        Palette palette;
        palette.make(model, false);
        inRange(palette);
        double sum = 0, worst = 0;
        for (int o = 0; o < bar.colours; ++o) {
            const uint8_t* ramp = model.actor(o).object->ramp();
            for (int step = 0; step <= 52; ++step) {
                CHECK(ramp[step] != 0 && ramp[step] != Palette::INK);
                const double share = (9 + 54 * step / 63.0) / 63 * 63 / 255;
                const uint8_t* c = palette.dac() + 3 * ramp[step];
                const double red = c[0] - colours[o].red * share, green = c[1] - colours[o].green * share,
                             blue = c[2] - colours[o].blue * share;
                const double square = red * red + green * green + blue * blue;
                sum += square;
                worst = square > worst ? square : worst;
            }
        }
        // The component of a highlight along the colour keeps that promise too, where each colour has entries of its own.
        for (int o = 0; bar.colours <= 4 && o < bar.colours; ++o) {
            const Colour& full = colours[o];
            const uint8_t* ramp = model.actor(o).object->ramp();
            const double square = full.red * full.red + full.green * full.green + full.blue * full.blue;
            for (int step = 53; step < 64; ++step) {
                const uint8_t* c = palette.dac() + 3 * ramp[step];
                const double share = (c[0] * full.red + c[1] * full.green + c[2] * full.blue) / square * 255 / 63;
                CHECK(std::fabs(share - (9 + 54 * step / 63.0) / 63) < 0.025);
            }
        }
        const double rms = std::sqrt(sum / (53 * bar.colours));
        worst = std::sqrt(worst);
        note("%d colours: off by %.2f of 63, at most %.2f", bar.colours, rms, worst);
        CHECK(rms < bar.rms && worst < bar.worst);
    }
}

TEST(more_colours_than_fit)
{
    Model model;
    for (int i = 0; i < 40; ++i) {
        Motion still{};
        CHECK(
            model.add(make<Sphere>(i + 1, Real(10)), {static_cast<uint8_t>(i * 6), static_cast<uint8_t>(255 - i * 5), 128}, still));
    }
    Palette palette;
    palette.make(model, false);
    inRange(palette);
    for (int o = 0; o < 40; ++o) {
        const uint8_t* ramp = model.actor(o).object->ramp();
        CHECK(ramp != nullptr);
        int steps = 1;
        for (int i = 1; i < 64; ++i) {
            CHECK(light(palette, ramp[i]) >= light(palette, ramp[i - 1]));
            steps += ramp[i] != ramp[i - 1];
        }
        CHECK(steps >= 14);
    }
    // If the colours are so dark that all their shades fit, each shade has an entry.
    Model dark;
    for (int i = 0; i < 20; ++i)
        CHECK(dark.add(make<Sphere>(i + 1, Real(10)), {static_cast<uint8_t>(30 + i), 0, 40}, Motion{}));
    palette.make(dark, false);
    for (int o = 0; o < 20; ++o) {
        const uint8_t* c = palette.dac() + 3 * dark.actor(o).object->ramp()[52];
        SAME(c[0], static_cast<int>((30 + o) * (9 + 54 * 52 / 63.0) / 255 + 0.5));
    }
    // Equal colours share one ramp.
    Model same;
    for (int i = 0; i < 30; ++i)
        CHECK(same.add(make<Sphere>(i + 1, Real(10)), {10, 200, 30}, Motion{}));
    palette.make(same, false);
    for (int o = 1; o < 30; ++o)
        for (int i = 0; i < 64; ++i)
            SAME(same.actor(o).object->ramp()[i], same.actor(0).object->ramp()[i]);
    Model empty;
    palette.make(empty, false);
    palette.make(empty, true);
}

// The entries are in the order of brightness: from a step of a ramp to the 16th after it they differ by more than 32, with few
// exceptions where colours share them.
TEST(entries_are_in_order)
{
    Random random;
    constexpr int STEPS = Palette::STEPS;
    int near = 0, all = 0;
    for (int count = 0; count <= 24; ++count) {
        Model model;
        for (int i = 0; i < std::max(count, 1); ++i) {
            const Colour colour{static_cast<uint8_t>(random.below(256)), static_cast<uint8_t>(random.below(256)), 255};
            CHECK(model.add(make<Sphere>(i + 1, Real(20)), colour, Motion{}));
        }
        Palette palette;
        palette.make(model, count == 0);
        for (int i = 0; i < model.count(); ++i) {
            const uint8_t* const ramp = model.actor(i).object->ramp();
            for (int step = 0; step + 16 < STEPS; ++step)
                near += ramp[step + 16] - ramp[step] <= 32;
            all += STEPS - 16;
        }
    }
    note("of %d pairs of steps, %d are too near to each other", all, near);
    CHECK(near * 200 < all);
}

TEST(ramps_tell_their_steps)
{
    Model model;
    CHECK(model.makeFourSpheres());
    Palette palette;
    for (const bool grey : {false, true}) {
        palette.make(model, grey);
        const uint8_t* const ramp = model.actor(1).object->ramp();
        for (int i = 0; i < 256; ++i) {
            const bool has = std::find(ramp, ramp + 64, i) != ramp + 64;
            const int step = static_cast<int8_t>(ramp[STEP_OF + i]);
            SAME(step < 0, has);
            if (has)
                SAME(ramp[step + STEP_BIAS], i);
        }
    }
}

TEST(raised_ramp)
{
    Model model;
    CHECK(model.makeFourSpheres());
    Palette palette;
    palette.make(model, false);
    const uint8_t* ramp = model.actor(2).object->ramp();
    const uint8_t* raised = palette.raised(ramp, 20);
    for (int i = 0; i < 64; ++i)
        SAME(raised[i], ramp[i + 20 > 63 ? 63 : i + 20]);
    raised = palette.raised(ramp, 0);
    for (int i = 0; i < 64; ++i)
        SAME(raised[i], ramp[i]);
    raised = palette.raised(ramp, -70);
    for (int i = 0; i < 64; ++i)
        SAME(raised[i], ramp[0]);
}
