// Options: the settings that the command line asks for. The switches are a fixed interface; the README lists them.
#ifndef FB_OPTIONS_H
#define FB_OPTIONS_H

#include "math/real.h"

struct Options {
    bool interactive = false;       // /I
    bool grey = false;              // /G
    bool report98 = false;          // /P
    bool help = false;              // /?
    bool retrace = false;           // /V: wait for the vertical retrace
    bool noPresent = false;         // /X: draw, but do not copy to the card
    bool benchmark = false;         // /B: run for BENCHMARK_SECONDS, unless /T or /N is given, and print one line at the end
    Real spacing{2};                // /S:n, SPACING_LEAST..SPACING_MOST units
    bool spacingGiven = false;      // /S was given
    int32_t hold = 0;               // /F:n, frames per second to be held; 0: off. Without effect with /N or /S: see holds()
    int32_t frames = 0;             // /N:n; 0: off
    int32_t seconds = 0;            // /T:n; 0: off
    int32_t rate = 10;              // /R:n, frames per second of animation with /N
    bool rateGiven = false;         // /R was given; it has no effect without /N
    const char* dumpDirectory = nullptr;  // /D:dir
    const char* modelFile = nullptr;      // /M:file, or an argument that is not a switch
    const char* recordFile = nullptr;     // /O:file, to which one CSV record is appended
    const char* filmFile = nullptr;       // /A:file, the animation as an FLI file

    // Whether the program adjusts the spacing to hold a frame rate: not when frames are counted or the user gave a spacing.
    bool holds() const { return hold > 0 && frames == 0 && !spacingGiven; }
};

constexpr Real SPACING_LEAST(0.25);
constexpr Real SPACING_MOST(8);
constexpr int32_t FRAMES_MOST = 9999999;  // the file names of dumped frames have seven digits
constexpr int32_t SECONDS_MOST = 86400;
constexpr int32_t RATE_MOST = 1000;
constexpr int32_t HOLD_MOST = 100;
constexpr int32_t BENCHMARK_SECONDS = 60;

// Reads the command line. Returns null, or one line of plain text that names the wrong switch and the range it accepts.
// Switches may be joined (/G/I); '=' may replace ':' before a value, and a number may follow its letter directly (/S2). An
// argument that is not a switch is the name of the scene. The strings of `options` point into `arguments`.
const char* parseOptions(int count, char** arguments, Options* options);

// The list of switches and keys that /? prints.
extern const char* const HELP;

#endif
