// Tests of the block of statistics that is printed at the end of a run.
#include "app/stats.h"

#include <cstring>
#include <sstream>

#include "help.h"
#include "machine.h"
#include "test.h"

namespace {

std::string block(const Stats& stats)
{
    char text[1024];
    std::memset(text, 'x', sizeof text);
    stats.format(text, sizeof text);
    return text;
}

}  // namespace

TEST(statistics_as_fixed)
{
    // The block begins with these lines in this order; the numbers are those of a run of 785 frames in a minute.
    Stats stats;
    stats.setSeeds(2496, 2480);
    Counts counts{};
    counts.updated = 2314;
    counts.drawn = 1568;
    counts.iterations = 11570;
    counts.normals = 894;
    for (int i = 0; i < 785; ++i)
        stats.addFrame(counts);
    stats.setTime(60ull * machine::CLOCK_HZ);
    SAME(stats.frames(), 785);
    const std::string expected =
        "frames: 785\n"
        "seconds: 60.000\n"
        "fps: 13.083\n"
        "seeds: 2496\n"
        "oversampled seeds: 2480\n"
        "updated per frame: 2314.0\n"
        "drawn per frame: 1568.0\n"
        "iterations per update: 5.000\n"
        "normals per frame: 894.0\n"
        "field evaluations per frame: 11570.0\n";
    TEXT(block(stats).substr(0, expected.size()), expected);
    // All further lines have the same form.
    std::istringstream lines(block(stats).substr(expected.size()));
    std::string line;
    while (std::getline(lines, line))
        CHECK(line.find(": ") != std::string::npos && line.find(": ") + 2 < line.size());
    CHECK(block(stats).back() == '\n');
}

TEST(statistics_of_nothing)
{
    Stats stats;
    const std::string text = block(stats);
    CHECK(text.find("frames: 0\n") == 0);
    CHECK(text.find("fps: 0.000\n") != std::string::npos);
    CHECK(text.find("iterations per update: 0.000\n") != std::string::npos);
}

TEST(statistics_of_a_long_run)
{
    // A day at 500 frames per second, with every count at its largest.
    Stats stats;
    Counts counts{};
    counts.updated = 2000000;
    counts.iterations = 6000000;
    for (int i = 0; i < 10000; ++i)
        stats.addFrame(counts);
    stats.setTime(86400ull * machine::CLOCK_HZ);
    const std::string text = block(stats);
    CHECK(text.find("seconds: 86400.000\n") != std::string::npos);
    CHECK(text.find("fps: 0.116\n") != std::string::npos);
    CHECK(text.find("updated per frame: 2000000.0\n") != std::string::npos);
    CHECK(text.find("field evaluations per frame: 6000000.0\n") != std::string::npos);
    CHECK(text.find("iterations per update: 3.000\n") != std::string::npos);
}
