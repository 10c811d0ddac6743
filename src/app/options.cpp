// Reads the command line, with one table for each kind of switch.
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

constexpr const char* KNOWN = "unknown switch; known are /I /G /P /S:n /F:n /N:n /R:n /T:n /A:file /B /D:dir /M:file /O:file "
                              "/V /X /?";

char problem[240];

const char* complain(const char* argument, const char* what)
{
    char plain[90];
    snprintf(problem, sizeof problem, "%s: %s", plainText(plain, sizeof plain, argument), what);
    return problem;
}

constexpr int NUMBER_ROOM = 24;

// Copies the text of a number up to the end of the argument or the next switch. Returns the end of the text, or null when
// the text is empty or longer than any valid number.
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

// The switches, in three tables: those followed by nothing, by a name, and by a number.
struct Flag {
    char letter;
    bool Options::*value;
};
const Flag FLAGS[] = {
    {'I', &Options::interactive}, {'G', &Options::grey},      {'P', &Options::report98}, {'V', &Options::retrace},
    {'X', &Options::noPresent},   {'B', &Options::benchmark}, {'?', &Options::help},
};
struct Name {
    char letter;
    const char* Options::*value;
};
const Name NAMES[] = {
    {'D', &Options::dumpDirectory}, {'M', &Options::modelFile}, {'O', &Options::recordFile}, {'A', &Options::filmFile},
};
struct Number {
    char letter;
    const char* expected;
    int32_t most;              // upper bound, inclusive; the lower bound is 1
    int32_t Options::*value;   // null: the spacing, which need not be a whole number
    bool Options::*given;      // set when the switch is given; may be null
};
const Number NUMBERS[] = {
    {'S', "a seed spacing from 0.25 to 8 is expected, as in /S:2", 0, nullptr, &Options::spacingGiven},
    {'F', "frames a second from 1 to 100 are expected, as in /F:10", HOLD_MOST, &Options::hold, nullptr},
    {'N', "a number of frames from 1 to 9999999 is expected, as in /N:600", FRAMES_MOST, &Options::frames, nullptr},
    {'R', "frames a second from 1 to 1000 are expected, as in /R:10", RATE_MOST, &Options::rate, &Options::rateGiven},
    {'T', "seconds from 1 to 86400 are expected, as in /T:60", SECONDS_MOST, &Options::seconds, nullptr},
};

// Returns the entry of a letter in one of these tables, or null.
template <class Switch, int COUNT>
const Switch* find(const Switch (&table)[COUNT], char letter)
{
    for (const Switch& each : table)
        if (each.letter == letter)
            return &each;
    return nullptr;
}

bool spacingWithin(const char* text, Real* value)
{
    Real spacing;
    if (!parseReal(text, &spacing) || !(spacing >= SPACING_LEAST && spacing <= SPACING_MOST))
        return false;
    *value = spacing;
    return true;
}

// Reads the number that follows a switch; /S2 means /S:2. Returns null and sets `*at` to the end of the number, or returns
// a complaint.
const char* parseNumber(const char* argument, const Number& number, const char** at, Options* options)
{
    const char* value = *at;
    const bool marked = *value == ':' || *value == '=';
    const bool bare = (*value >= '0' && *value <= '9') || *value == '.';
    if (*value != 0 && *value != '/' && !marked && !bare)
        return complain(argument, KNOWN);
    char text[NUMBER_ROOM];
    *at = takeNumber(marked ? value + 1 : value, text);
    if (*at == nullptr)
        return complain(argument, number.expected);
    if (number.given != nullptr)
        options->*number.given = true;
    const bool good = number.value == nullptr ? spacingWithin(text, &options->spacing)
                                              : wholeWithin(text, number.most, &(options->*number.value));
    return good ? nullptr : complain(argument, number.expected);
}

// Reads the name that follows a switch. A name may contain slashes and therefore extends to the end of the argument.
// Returns null, or a complaint.
const char* parseName(const char* argument, const char* at, const char** name)
{
    if (*at != 0 && *at != ':' && *at != '=')
        return complain(argument, KNOWN);
    if (*at == 0 || at[1] == 0)
        return complain(argument, "a name is expected after the colon");
    *name = at + 1;
    return nullptr;
}

// Reads the switches of one argument that begins with a switch; /G/I are two switches. Returns null, or a complaint.
const char* parseSwitches(const char* argument, Options* options)
{
    const char* at = argument;
    while (*at != 0) {
        // After the first switch only '/' begins another one, because '-' may be part of a name or a number.
        if (at != argument && *at != '/')
            return complain(argument, KNOWN);
        const char letter = at[1] >= 'a' && at[1] <= 'z' ? static_cast<char>(at[1] - 32) : at[1];
        if (letter == 0)
            return complain(argument, KNOWN);
        at += 2;
        if (const Name* name = find(NAMES, letter))
            return parseName(argument, at, &(options->*name->value));
        if (const Number* number = find(NUMBERS, letter)) {
            const char* trouble = parseNumber(argument, *number, &at, options);
            if (trouble != nullptr)
                return trouble;
            continue;
        }
        const Flag* flag = find(FLAGS, letter);
        if (flag == nullptr)
            return complain(argument, KNOWN);
        if (*at == ':' || *at == '=')
            return complain(argument, "this switch takes no value");
        options->*flag->value = true;
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
