// The command line.
#include "app/options.h"

#include "rt.h"
#include "math/text.h"

const char* const HELP =
    "Fast Blobs: soft objects, animated in real time.\n"
    "  DEMO [switches] [scene]     DEMO WALK.FB plays a scene, DEMO the spheres\n"
    "  /I        interactive: the mouse moves the objects\n"
    "  /G        monochrome: one 64-step ramp\n"
    "  /P        the 1998 report's own methods, as printed\n"
    "  /S:n      seed spacing in units, 0.25 to 8 (2)\n"
    "  /F:n      hold n frames a second, 1 to 100, by the spacing of each object\n"
    "  /N:n      stop after n frames, each a step of 0.1 s (see /R)\n"
    "  /R:n      with /N: n frames for a second of animation, 1 to 1000 (10)\n"
    "  /T:n      stop after n seconds, 1 to 86400\n"
    "  /D:dir    write every frame into dir\n"
    "  /M:file   model and animation from a file\n"
    "  /A:file   animation: what is played, as one FLI file\n"
    "  /B        benchmark: one minute, and one line about it\n"
    "  /O:file   append the statistics to file, as one CSV record\n"
    "  /V, /X    wait for the vertical retrace; draw, but do not copy to the card\n"
    "  /?        this page\n"
    "\n"
    "Keys:  F1  all of them   *  scales, pixels   - +  coarser, finer   ESC  ends\n"
    "       F  frames a second   F4  hold them   P  picture file   N  next scene\n"
    "       5 6 7 8  round the scene, over it   9 0  nearer, farther   End  back\n"
    "       Space  stop and go   .  a step   Home  from the start   <  >  speed\n"
    "Mouse (with /I):  left button selects the next object; moving it moves the\n"
    "object in X and Y, with the right button X and Z. Or Tab, arrows, PgUp, PgDn.\n";

namespace {

constexpr const char* KNOWN = "unknown switch; known are /I /G /P /S:n /F:n /N:n /R:n /T:n /A:file /B /D:dir /M:file /O:file /V /X /?";

char problem[240];

const char* complain(const char* argument, const char* what)
{
    char plain[90];
    snprintf(problem, sizeof problem, "%s: %s", plainText(plain, sizeof plain, argument), what);
    return problem;
}

constexpr int NUMBER_ROOM = 24;

// Copies a number's text up to the end of the argument or the next switch. Returns where it ends; null: there is none,
// or it is longer than any number that is in range.
const char* takeNumber(const char* value, char* number)
{
    int length = 0;
    for (; *value != 0 && *value != '/'; ++value) {
        if (length == NUMBER_ROOM - 1)
            return nullptr;
        number[length++] = *value;
    }
    number[length] = 0;
    return length > 0 ? value : nullptr;
}

bool wholeWithin(const char* text, int32_t most, int32_t* value)
{
    int32_t number;
    if (!parseWhole(text, &number) || number < 1 || number > most)
        return false;
    *value = number;
    return true;
}

// Reads the switches of one argument, which begins with one; /G/I are two. Null, or a complaint.
const char* parseSwitches(const char* argument, Options* options)
{
    const char* at = argument;
    while (*at != 0) {
        // After the first, only '/' begins a switch: '-' is part of many a name and number.
        if (at != argument && *at != '/')
            return complain(argument, KNOWN);
        const char letter = at[1] >= 'a' && at[1] <= 'z' ? static_cast<char>(at[1] - 32) : at[1];
        if (letter == 0)
            return complain(argument, KNOWN);
        at += 2;
        const bool marked = *at == ':' || *at == '=';
        bool* flag = nullptr;
        const char** name = nullptr;
        const char* expected = nullptr;
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
        case 'A': name = &options->filmFile; break;
        case 'S': expected = "a seed spacing from 0.25 to 8 is expected, as in /S:2"; break;
        case 'F': expected = "frames a second from 1 to 100 are expected, as in /F:10"; break;
        case 'N': expected = "a number of frames from 1 to 9999999 is expected, as in /N:600"; break;
        case 'R': expected = "frames a second from 1 to 1000 are expected, as in /R:10"; break;
        case 'T': expected = "seconds from 1 to 86400 are expected, as in /T:60"; break;
        default: return complain(argument, KNOWN);
        }
        if (flag != nullptr) {
            if (marked)
                return complain(argument, "this switch takes no value");
            *flag = true;
        } else if (name != nullptr) {
            // A name may have slashes: it goes to the end of the argument.
            if (*at != 0 && !marked)
                return complain(argument, KNOWN);
            if (*at == 0 || at[1] == 0)
                return complain(argument, "a name is expected after the colon");
            *name = at + 1;
            return nullptr;
        } else {
            // /S2 is as good as /S:2.
            const bool bare = (*at >= '0' && *at <= '9') || *at == '.';
            if (*at != 0 && *at != '/' && !marked && !bare)
                return complain(argument, KNOWN);
            char number[NUMBER_ROOM];
            const char* end = takeNumber(marked ? at + 1 : at, number);
            Real spacing;
            bool good = end != nullptr;
            switch (letter) {
            case 'S':
                good = good && parseReal(number, &spacing) && spacing >= SPACING_LEAST && spacing <= SPACING_MOST;
                if (good)
                    options->spacing = spacing;
                options->spacingGiven = true;
                break;
            case 'F': good = good && wholeWithin(number, HOLD_MOST, &options->hold); break;
            case 'N': good = good && wholeWithin(number, FRAMES_MOST, &options->frames); break;
            case 'R':
                good = good && wholeWithin(number, RATE_MOST, &options->rate);
                options->rateGiven = true;
                break;
            default: good = good && wholeWithin(number, SECONDS_MOST, &options->seconds); break;
            }
            if (!good)
                return complain(argument, expected);
            at = end;
        }
    }
    return nullptr;
}

}  // namespace

const char* parseOptions(int count, char** arguments, Options* options)
{
    const char* scene = nullptr;
    for (int i = 1; i < count; ++i) {
        const char* argument = arguments[i];
        if (argument[0] == 0)
            return complain(argument, KNOWN);
        if (argument[0] == '/' || argument[0] == '-') {
            const char* trouble = parseSwitches(argument, options);
            if (trouble != nullptr)
                return trouble;
            continue;
        }
        if (scene != nullptr)
            return complain(argument, "there is a scene already; one is expected");
        scene = argument;
    }
    if (scene != nullptr && options->modelFile != nullptr)
        return complain(scene, "there is a scene already, by /M; one is expected");
    if (scene != nullptr)
        options->modelFile = scene;
    if (options->benchmark && options->seconds == 0 && options->frames == 0)
        options->seconds = BENCHMARK_SECONDS;
    return nullptr;
}
