// Tests of the small parts behind keys and screen: the animation's pace, questions to the user, lines of text.
#include "app/ask.h"
#include "app/options.h"
#include "app/overlay.h"
#include "app/pace.h"

#include <cstring>

#include "test.h"

TEST(untouched_the_animation_shows_the_time_of_the_run)
{
    Pace pace(true);
    Time now = 0;
    for (int i = 0; i < 1000; ++i) {
        now += static_cast<Time>(i * 37 % 101);
        CHECK(pace.at(now) == now);
    }
}

TEST(pace_held_stepped_and_changed)
{
    Pace pace(false);
    CHECK(pace.at(500) == 0);
    pace.step(40);
    CHECK(pace.at(600) == 40);
    pace.setRunning(true);
    CHECK(pace.at(700) == 140);
    CHECK(pace.change(1) && pace.change(1));
    CHECK(pace.at(710) == 180);
    CHECK(pace.change(-1) && pace.change(-1) && pace.change(-1));
    CHECK(pace.speed() == -1);
    CHECK(pace.at(730) == 190);
    pace.restart();
    CHECK(pace.at(730) == 0);
    while (pace.change(1)) {
    }
    CHECK(pace.speed() == Pace::FASTEST);
    while (pace.change(-1)) {
    }
    CHECK(pace.speed() == Pace::SLOWEST);
    CHECK(pace.at(738) == 1);
}

TEST(a_line_is_typed)
{
    static Ask ask;
    ask.askLine("what?", "AB.FB");
    CHECK(ask.state() == Ask::LINE);
    CHECK(ask.key(machine::KEY_BACKSPACE) == Ask::OPEN);
    CHECK(std::strcmp(ask.line(), "AB.F") == 0);
    for (int i = 0; i < 200; ++i)
        CHECK(ask.key('x') == Ask::OPEN);
    CHECK(std::strlen(ask.line()) == Ask::LINE_ROOM - 1);
    for (int i = 0; i < 200; ++i)
        CHECK(ask.key(machine::KEY_BACKSPACE) == Ask::OPEN);
    CHECK(ask.line()[0] == 0);
    CHECK(ask.key(machine::KEY_ENTER) == Ask::OPEN);  // no answer
    for (const int code : {42, 63, 34, 60, 62, 124, 32, 7, 200, 0x152})  // not allowed in names, or no characters
        CHECK(ask.key(code) == Ask::OPEN);
    CHECK(ask.line()[0] == 0);
    CHECK(ask.key('q') == Ask::OPEN);
    CHECK(ask.key(machine::KEY_ENTER) == Ask::GIVEN);
    CHECK(std::strcmp(ask.line(), "q") == 0);
    CHECK(ask.key(machine::KEY_ESC) == Ask::CANCELLED);
    CHECK(ask.state() == Ask::CLOSED);
    ask.askLine("what?", "a preset that is far longer than the room there is for one line");
    CHECK(std::strlen(ask.line()) == Ask::LINE_ROOM - 1);
    CHECK(ask.key(machine::KEY_BACKSPACE) == Ask::OPEN);
    CHECK(std::strlen(ask.line()) == Ask::LINE_ROOM - 2);
}

TEST(one_of_a_list)
{
    static Ask ask;
    ask.askList("which?", 40, 30);
    CHECK(ask.chosen() == 30);
    const auto shown = [&] {
        return ask.chosen() >= ask.firstShown() && ask.chosen() < ask.firstShown() + Ask::LINES_SHOWN;
    };
    CHECK(shown());
    for (int i = 0; i < 20; ++i) {
        ask.key(machine::KEY_DOWN);
        CHECK(shown());
    }
    CHECK(ask.chosen() == 39);
    ask.key(machine::KEY_HOME);
    CHECK(ask.chosen() == 0 && ask.firstShown() == 0);
    ask.key(machine::KEY_UP);
    CHECK(ask.chosen() == 0);
    ask.key(machine::KEY_PGDN);
    CHECK(ask.chosen() == Ask::LINES_SHOWN && shown());
    ask.key(machine::KEY_PGUP);
    CHECK(ask.chosen() == 0 && shown());
    CHECK(ask.key(machine::KEY_ENTER) == Ask::GIVEN);
}

TEST(text_is_broken_between_words)
{
    View view;
    CHECK(view.open());
    view.begin();
    Overlay overlay(view);
    const int wide = 10 * Overlay::LETTER_WIDE;
    CHECK(overlay.paragraph(0, 0, wide, "", false) == 0);
    CHECK(overlay.paragraph(0, 0, wide, "0123456789", false) == 1);
    CHECK(overlay.paragraph(0, 0, wide, "01234 6789 ab", false) == 2);
    CHECK(overlay.paragraph(0, 0, wide, "01234 678901", false) == 2);
    CHECK(overlay.paragraph(0, 0, wide, "0123456789abcdefghijk", false) == 3);  // a word too long for a line
    CHECK(overlay.paragraph(0, 0, wide, "a b c d e f g h i j k", false) == 3);
    // Nothing is drawn beyond the width, wherever the text breaks, and nothing at all off the screen.
    for (const char* text : {"01234 678901", "0123456789abcdefghijk", "######### #########"}) {
        view.begin();
        const int lines = overlay.paragraph(20, 30, wide, text);
        for (int y = 0; y < machine::HEIGHT; ++y)
            for (int x = 0; x < machine::WIDTH; ++x)
                if (view.frame()[y * machine::WIDTH + x] == Palette::INK)
                    CHECK(x >= 20 && x < 20 + wide && y >= 30 && y < 30 + lines * (Overlay::LINE_HIGH + 1));
        overlay.paragraph(300, 190, wide, text);
        overlay.paragraph(-30, -4, wide, text);
        overlay.panel(-5, 190, 400, 30);
        overlay.pointer(318, 198);
        overlay.diamond(0, 199);
        overlay.cross(400, -100);
    }
}

TEST(ink_is_the_same_in_every_scene)
{
    for (int count = 1; count <= 20; ++count) {
        Model model;
        for (int i = 0; i < count; ++i) {
            Actor actor;
            actor.kind = kindNamed("sphere");
            actor.measure[0] = Real(10);
            snprintf(actor.name, sizeof actor.name, "s%d", i);
            actor.colour = {static_cast<uint8_t>(255 - i), static_cast<uint8_t>(i * 12), 40};
            CHECK(model.addItem(actor) != nullptr);
        }
        for (const bool grey : {false, true}) {
            Palette palette;
            palette.make(model, grey);
            const uint8_t* ink = palette.dac() + 3 * Palette::INK;
            CHECK(ink[0] == 63 && ink[1] == 63 && ink[2] == 56);
            for (int i = 0; i < count; ++i)
                for (int step = -SHADING_MOST; step < Palette::STEPS + SHADING_MOST; ++step)
                    CHECK(model.actor(i).object->ramp()[step] != Palette::INK);
        }
    }
}

TEST(switches_of_the_benchmark_and_of_films)
{
    const auto parse = [](const char* first, const char* second, Options* options) {
        char name[] = "demo", a[40], b[40];
        std::strcpy(a, first);
        std::strcpy(b, second);
        char* arguments[] = {name, a, b};
        *options = Options();
        return parseOptions(3, arguments, options);
    };
    Options options;
    CHECK(parse("/B", "/G", &options) == nullptr && options.benchmark && options.seconds == BENCHMARK_SECONDS);
    CHECK(parse("/B", "/T:7", &options) == nullptr && options.seconds == 7);
    CHECK(parse("/b", "/N:7", &options) == nullptr && options.seconds == 0 && options.frames == 7);
    CHECK(parse("/G", "/V", &options) == nullptr && !options.benchmark && options.seconds == 0);
    CHECK(parse("/B:1", "/G", &options) != nullptr);
    CHECK(parse("/A", "/G", &options) != nullptr);
    CHECK(parse("/A:", "/G", &options) != nullptr);
    const char* film = "/A:SHOW.FLI";
    CHECK(parse(film, "/G", &options) == nullptr && options.filmFile != nullptr);
}
