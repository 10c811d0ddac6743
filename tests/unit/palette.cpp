// Palettes: ramps that rise, colours shared out among many objects.
#include "picture/palette.h"

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
    // "One 64-step ramp", but for the darkest, which stand out from the background.
    CHECK(steps >= 60);
    for (int i = 0; i < 64; ++i) {
        const uint8_t* c = palette.dac() + 3 * ramp[i];
        CHECK(c[0] == c[1] && c[1] == c[2]);
        CHECK(ramp[i] != 0);
    }
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
        // The colour is the object's: its strongest part is the ramp's strongest.
        const Colour& c = model.actor(o).colour;
        const uint8_t* middle = palette.dac() + 3 * ramp[45];
        CHECK((c.red >= c.green) == (middle[0] >= middle[1]));
        CHECK((c.green >= c.blue) == (middle[1] >= middle[2]));
    }
}

TEST(more_colours_than_fit)
{
    Model model;
    for (int i = 0; i < 40; ++i) {
        Motion still{};
        CHECK(model.add(make<Sphere>(i + 1, Real(10)), {static_cast<uint8_t>(i * 6), static_cast<uint8_t>(255 - i * 5), 128}, still));
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
