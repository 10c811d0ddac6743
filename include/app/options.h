// Options: what the command line asks for. The switches are fixed from outside; the README lists them.
#ifndef FB_OPTIONS_H
#define FB_OPTIONS_H

#include "math/real.h"

struct Options {
    bool interactive = false;       // /I
    bool grey = false;              // /G
    bool printed = false;           // /P
    bool help = false;              // /?
    bool retrace = false;           // /V: wait for the vertical retrace
    bool noPresent = false;         // /X: draw, but do not copy to the card
    bool benchmark = false;         // /B: BENCHMARK_SECONDS, unless /T or /N say otherwise, and one line at the end
    Real spacing{2};                // /S:n, SPACING_LEAST..SPACING_MOST units
    bool spacingGiven = false;      // /S was there
    int32_t hold = 0;               // /F:n, frames a second to be held; 0: off, as with /N and /S
    int32_t frames = 0;             // /N:n; 0: off
    int32_t seconds = 0;            // /T:n; 0: off
    int32_t rate = 10;              // /R:n, frames for a second of animation with /N
    bool rateGiven = false;         // /R was there, and says nothing without /N
    const char* dumpDirectory = nullptr;  // /D:dir
    const char* modelFile = nullptr;      // /M:file, or a word that is no switch
    const char* recordFile = nullptr;     // /O:file, one CSV record is appended
    const char* filmFile = nullptr;       // /A:file, what is played as an FLI file

    // What is counted or given stays as it is.
    bool holds() const { return hold > 0 && frames == 0 && !spacingGiven; }
};

constexpr Real SPACING_LEAST(0.25);
constexpr Real SPACING_MOST(8);
constexpr int32_t FRAMES_MOST = 9999999;  // dumped frames have seven digits
constexpr int32_t SECONDS_MOST = 86400;
constexpr int32_t RATE_MOST = 1000;
constexpr int32_t HOLD_MOST = 100;
constexpr int32_t BENCHMARK_SECONDS = 60;

// Reads the command line; null, or one line of plain text that names the switch and the range it accepts. Switches may
// stand together (/G/I), a value may follow '=' for ':' and a number its letter (/S2); a word that is no switch is the
// scene's name. The strings of `options` point into `arguments`.
const char* parseOptions(int count, char** arguments, Options* options);

// The switches and keys, for /?.
extern const char* const HELP;

#endif
