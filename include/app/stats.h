// Stats: what a run reports at its end (report, Section V; the names are fixed from outside).
#ifndef FB_STATS_H
#define FB_STATS_H

#include "model/softobj.h"

class Stats {
public:
    // Adds a frame's counts.
    void addFrame(const Counts& counts);
    uint32_t frames() const { return frames_; }

    // How long the frames took, in ticks of machine::clock().
    void setTime(uint64_t ticks) { ticks_ = ticks; }
    void setSeeds(int regular, int oversampled)
    {
        seeds_ = regular;
        oversampled_ = oversampled;
    }

    // One "name: value" a line, averages over the frames shown, into `to` (at least 1024 bytes).
    void format(char* to, int size) const;

    // The same as a CSV record, and the line of names that goes before the first, both with an end of line. The other
    // fields are what was played with which switches, when and on what; they hold no comma that is not quoted.
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
    void lines(Line* to) const;

    uint32_t frames_ = 0;
    uint64_t ticks_ = 0;
    int seeds_ = 0, oversampled_ = 0;
    uint64_t updated_ = 0, drawn_ = 0, iterations_ = 0, normals_ = 0, samples_ = 0, unsettled_ = 0;
};

#endif
