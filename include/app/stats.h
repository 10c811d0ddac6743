// Stats: the statistics that a run prints at its end (report, Section V; the names of the figures are a fixed interface).
#ifndef FB_STATS_H
#define FB_STATS_H

#include "model/softobj.h"

class Stats {
public:
    // Adds the counts of one frame.
    void addFrame(const Counts& counts);
    uint32_t frames() const { return frames_; }

    // Sets how long all frames took, in ticks of machine::clock().
    void setTime(uint64_t ticks) { ticks_ = ticks; }
    void setSeeds(int regular, int oversampled)
    {
        seeds_ = regular;
        oversampled_ = oversampled;
    }

    // Writes the number of frames a second, rounded to `decimals` places. Returns the length.
    int formatFps(char* to, int size, int decimals) const;

    // Writes lines of "name: value" to `to` (at least 1024 bytes); "per frame" values are averages over the frames shown.
    void format(char* to, int size) const;

    // Write the statistics as a CSV record, and the line of field names that precedes the first record, both with an end of
    // line. `settings`, `scene`, `date` and `machine` become further fields; a comma in them must be inside quotes.
    void formatRecord(char* to, int size, const char* settings, const char* scene, const char* date,
                      const char* machine) const;
    static void formatHeader(char* to, int size);

private:
    struct Line {
        const char* name;
        uint64_t top;
        uint32_t bottom;
        int decimals;
    };
    static constexpr int LINES = 12;
    Line fps() const;
    void lines(Line* to) const;

    uint32_t frames_ = 0;
    uint64_t ticks_ = 0;
    int seeds_ = 0, oversampled_ = 0;
    uint64_t updated_ = 0, drawn_ = 0, iterations_ = 0, normals_ = 0, samples_ = 0, unsettled_ = 0;
};

#endif
