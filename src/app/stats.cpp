// Formats the statistics of a run as text.
#include "app/stats.h"

#include "machine.h"
#include "rt.h"
#include "math/text.h"

void Stats::addFrame(const Counts& counts)
{
    ++frames_;
    updated_ += counts.updated;
    drawn_ += counts.drawn;
    iterations_ += counts.iterations;
    normals_ += counts.normals;
    samples_ += counts.samples;
    unsettled_ += counts.unsettled;
}

// The divisor of a quotient must fit 32 bits: for long runs numerator and divisor are halved until it does.
Stats::Line Stats::fps() const
{
    uint64_t ticks = ticks_;
    uint64_t hertz = machine::CLOCK_HZ;
    while (ticks >> 32 != 0) {
        ticks >>= 1;
        hertz >>= 1;
    }
    return {"fps", frames_ * hertz, static_cast<uint32_t>(ticks), 3};
}

int Stats::formatFps(char* to, int size, int decimals) const
{
    const Line line = fps();
    return formatQuotient(to, size, line.top, line.bottom, decimals);
}

void Stats::lines(Line* to) const
{
    // Here likewise.
    uint64_t updates = updated_, iterations = iterations_;
    while (updates >> 32 != 0) {
        updates >>= 1;
        iterations >>= 1;
    }
    const Line all[LINES] = {
        {"frames", frames_, 1, 0},
        {"seconds", ticks_, machine::CLOCK_HZ, 3},
        fps(),
        {"seeds", static_cast<uint64_t>(seeds_), 1, 0},
        {"oversampled seeds", static_cast<uint64_t>(oversampled_), 1, 0},
        {"updated per frame", updated_, frames_, 1},
        {"drawn per frame", drawn_, frames_, 1},
        {"iterations per update", iterations, static_cast<uint32_t>(updates), 3},
        {"normals per frame", normals_, frames_, 1},
        {"field evaluations per frame", iterations_, frames_, 1},
        {"normal samples per frame", samples_, frames_, 1},
        {"unsettled per frame", unsettled_, frames_, 3},
    };
    for (int i = 0; i < LINES; ++i)
        to[i] = all[i];
}

void Stats::format(char* to, int size) const
{
    Line all[LINES];
    lines(all);
    int length = 0;
    for (const Line& line : all) {
        char value[32];
        formatQuotient(value, sizeof value, line.top, line.bottom, line.decimals);
        length += snprintf(to + length, static_cast<size_t>(size - length), "%s: %s\n", line.name, value);
    }
}

void Stats::formatRecord(char* to, int size, const char* settings, const char* scene, const char* date,
                         const char* machine) const
{
    Line all[LINES];
    lines(all);
    int length = snprintf(to, static_cast<size_t>(size), "%s", settings);
    for (const Line& line : all) {
        char value[32];
        formatQuotient(value, sizeof value, line.top, line.bottom, line.decimals);
        length += snprintf(to + length, static_cast<size_t>(size - length), ",%s", value);
    }
    snprintf(to + length, static_cast<size_t>(size - length), ",%s,%s,%s\r\n", scene, date, machine);
}

void Stats::formatHeader(char* to, int size)
{
    Line all[LINES];
    Stats().lines(all);
    int length = snprintf(to, static_cast<size_t>(size), "settings");
    for (const Line& line : all)
        length += snprintf(to + length, static_cast<size_t>(size - length), ",%s", line.name);
    snprintf(to + length, static_cast<size_t>(size - length), ",scene,date,machine\r\n");
}
