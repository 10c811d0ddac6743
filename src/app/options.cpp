// The command line.
#include "app/options.h"

#include "rt.h"
#include "math/text.h"

const char* const HELP =
    "Fast Blobs: soft objects, animated in real time.\n"
    "\n"
    "  /I        interactive: the mouse moves the objects\n"
    "  /G        monochrome: one 64-step ramp\n"
    "  /P        the 1998 report's own methods, as printed\n"
    "  /S:n      seed spacing in units, 0.25 to 8 (2)\n"
    "  /N:n      stop after n frames, each 0.1 s of animation\n"
    "  /R:n      with /N: n frames for a second of animation, 1 to 1000 (10)\n"
    "  /T:n      stop after n seconds, 1 to 86400\n"
    "  /D:dir    write every frame into dir\n"
    "  /M:file   model and animation from a file\n"
    "  /F:file   film: what is played, as one FLI file\n"
    "  /B        benchmark: one minute, and one line about it\n"
    "  /O:file   append the statistics to file, as one CSV record\n"
    "  /V        wait for the vertical retrace\n"
    "  /X        draw, but do not copy to the card\n"
    "  /?        this page\n"
    "\n"
    "Keys:  *  scales or pixels   -  coarser   +  finer   F  frames a second\n"
    "       Space  stop and go   .  a step   Home  from the start   <  >  speed\n"
    "       N  next scene   P  picture to a file\n"
    "       F1  all keys; with /I there are more, to change the model   ESC  ends\n"
    "Mouse (with /I):  left button selects the next object; moving it moves the\n"
    "object in X and Y, in X and Z while the right button is held. Without a mouse:\n"
    "Tab, arrows, PgUp and PgDn.\n";

namespace {

char problem[160];

const char* complain(const char* argument, const char* what)
{
    snprintf(problem, sizeof problem, "%.60s: %s", argument, what);
    return problem;
}

bool wholeWithin(const char* text, int32_t most, int32_t* value)
{
    int32_t number;
    if (!parseWhole(text, &number) || number < 1 || number > most)
        return false;
    *value = number;
    return true;
}

}  // namespace

const char* parseOptions(int count, char** arguments, Options* options)
{
    static const char KNOWN[] = "unknown switch; known are /I /G /P /S:n /N:n /R:n /T:n /D:dir /M:file /F:file /B /O:file /V /X /?";
    for (int i = 1; i < count; ++i) {
        const char* argument = arguments[i];
        if ((argument[0] != '/' && argument[0] != '-') || argument[1] == 0)
            return complain(argument, KNOWN);
        const char letter = argument[1] >= 'a' && argument[1] <= 'z' ? static_cast<char>(argument[1] - 32) : argument[1];
        const char* value = argument[2] == ':' ? argument + 3 : nullptr;
        if (argument[2] != 0 && value == nullptr)
            return complain(argument, KNOWN);
        bool* flag = nullptr;
        const char** name = nullptr;
        switch (letter) {
        case 'I': flag = &options->interactive; break;
        case 'G': flag = &options->grey; break;
        case 'P': flag = &options->printed; break;
        case 'V': flag = &options->retrace; break;
        case 'X': flag = &options->noPresent; break;
        case 'B': flag = &options->benchmark; break;
        case '?': flag = &options->help; break;
        case 'D': name = &options->dumpDirectory; break;
        case 'M': name = &options->modelFile; break;
        case 'O': name = &options->recordFile; break;
        case 'F': name = &options->filmFile; break;
        case 'S': {
            Real spacing;
            if (value == nullptr || !parseReal(value, &spacing) || spacing < SPACING_LEAST || spacing > SPACING_MOST)
                return complain(argument, "a seed spacing from 0.25 to 8 is expected, as in /S:2");
            options->spacing = spacing;
            continue;
        }
        case 'N':
            if (value == nullptr || !wholeWithin(value, FRAMES_MOST, &options->frames))
                return complain(argument, "a number of frames from 1 to 9999999 is expected, as in /N:600");
            continue;
        case 'R':
            if (value == nullptr || !wholeWithin(value, RATE_MOST, &options->rate))
                return complain(argument, "frames a second from 1 to 1000 are expected, as in /R:10");
            continue;
        case 'T':
            if (value == nullptr || !wholeWithin(value, SECONDS_MOST, &options->seconds))
                return complain(argument, "seconds from 1 to 86400 are expected, as in /T:60");
            continue;
        default: return complain(argument, KNOWN);
        }
        if (flag != nullptr) {
            if (value != nullptr)
                return complain(argument, "this switch takes no value");
            *flag = true;
        } else {
            if (value == nullptr || *value == 0)
                return complain(argument, "a name is expected after the colon");
            *name = value;
        }
    }
    if (options->benchmark && options->seconds == 0 && options->frames == 0)
        options->seconds = BENCHMARK_SECONDS;
    return nullptr;
}
