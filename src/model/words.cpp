// Words: reads word by word, and knows at each word what is expected, so that it can say so in a complaint.
#include "words.h"

#include "machine.h"
#include "math/text.h"

namespace {

constexpr char END_OF_TEXT = 26;  // Ctrl-Z

// Values that Source::next() returns instead of a character.
constexpr int AT_END = -1, UNREADABLE = -2;

// Number of characters that a complaint shows of a line or a word that is too long.
constexpr int SHOWN = 20;

// Colours by name.
struct ColourName {
    const char* name;
    Colour colour;
};
const ColourName COLOUR_NAMES[] = {
    {"white", {255, 255, 255}},  {"silver", {208, 208, 208}}, {"grey", {136, 136, 136}},  {"gray", {136, 136, 136}},
    {"black", {8, 8, 8}},        {"red", {255, 64, 48}},      {"orange", {255, 136, 40}}, {"yellow", {255, 200, 48}},
    {"lime", {160, 224, 64}},    {"green", {64, 208, 72}},    {"cyan", {64, 208, 216}},   {"blue", {72, 112, 255}},
    {"violet", {144, 96, 255}},  {"magenta", {224, 80, 224}}, {"pink", {255, 144, 176}},  {"brown", {160, 96, 48}},
};

char problem[640];

// The value of a hexadecimal digit (lower case); -1 if it is not one.
int hexDigit(char c)
{
    return isDigit(c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

}  // namespace

bool isLetter(char c)
{
    return c >= 'a' && c <= 'z';
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

const char* troubleWith(const char* name, const char* what)
{
    char plain[PLAIN_ROOM];
    snprintf(problem, sizeof problem, "%s: %s", plainText(plain, sizeof plain, name), what);
    return problem;
}

int Source::next()
{
    if (at_ == end_) {
        if (file_ < 0)
            return AT_END;
        const int32_t got = machine::readFile(file_, buffer_, sizeof buffer_);
        if (got <= 0)
            return got == 0 ? AT_END : UNREADABLE;
        at_ = buffer_;
        end_ = buffer_ + got;
    }
    return static_cast<unsigned char>(*at_++);
}

// --- Complaints

const char* Words::complaint() const
{
    return problem;
}

bool Words::expected(const char* what)
{
    char read[WORD_ROOM];
    int length = 0;
    // Replaces what some screens cannot show.
    for (; word_[length] != 0 && length < WORD_ROOM - 1; ++length)
        read[length] = word_[length] >= ' ' && word_[length] <= '~' ? word_[length] : '?';
    read[length] = 0;
    char name[PLAIN_ROOM];
    plainText(name, sizeof name, name_);
    if (length == 0)
        snprintf(problem, sizeof problem, "%s:%d: end of line: expected %s", name, line_, what);
    else
        snprintf(problem, sizeof problem, "%s:%d: '%s': expected %s", name, line_, read, what);
    end_ = SCENE_BAD;
    return false;
}

bool Words::expectedAtMost(int most, const char* what)
{
    char text[100];
    snprintf(text, sizeof text, "at most %d %s", most, what);
    return expected(text);
}

bool Words::trouble(const char* what)
{
    char name[PLAIN_ROOM];
    snprintf(problem, sizeof problem, "%s:%d: %s", plainText(name, sizeof name, name_), line_, what);
    end_ = SCENE_TROUBLE;
    return false;
}

void Words::quote(const char* text, int length)
{
    const bool whole = length <= SHOWN;
    snprintf(room_, sizeof room_, "%.*s%s", whole ? length : SHOWN, text, whole ? "" : "...");
    word_ = room_;
}

// --- Lines and words

// Stores the line in text_, with tabs replaced by blanks, zero bytes by '?', and CR left out.
bool Words::nextLine(bool* there)
{
    int length = 0;
    bool some = false;
    *there = false;
    text_[0] = 0;
    at_ = text_;
    word_ = "";
    if (over_)
        return true;
    ++line_;
    for (int characters = 0;; ++characters) {
        const int c = source_.next();
        if (c == UNREADABLE) {
            troubleWith(name_, machine::fileTrouble());
            end_ = SCENE_BAD;
            return false;
        }
        over_ = c == AT_END || c == END_OF_TEXT;
        some = some || !over_;
        if (over_ || c == '\n')
            break;
        if (c == '\r')
            continue;
        if (characters >= LINE_MOST)
            return tooLong(length);
        text_[length++] = static_cast<char>(c == '\t' ? ' ' : c == 0 ? '?' : c);
    }
    text_[length] = 0;
    *there = some;
    if (!some || line_ <= SCENE_LINES_MOST)
        return true;
    word_ = "one more line";
    return expectedAtMost(SCENE_LINES_MOST, "lines");
}

bool Words::tooLong(int length)
{
    text_[length] = 0;
    char* comment = strchr(text_, '#');
    if (comment != nullptr)
        *comment = 0;
    snprintf(room_, sizeof room_, "%.*s...", SHOWN, text_);
    word_ = room_;
    char most[60];
    snprintf(most, sizeof most, "a line of at most %d characters", LINE_MOST);
    return expected(most);
}

bool Words::nextWord(bool hash)
{
    while (*at_ == ' ')
        ++at_;
    int length = 0;
    while (*at_ != ' ' && *at_ != 0 && (*at_ != '#' || (hash && length == 0))) {
        if (length < WORD_ROOM - 1)
            room_[length++] = *at_ >= 'A' && *at_ <= 'Z' ? static_cast<char>(*at_ + 32) : *at_;
        else
            room_[length - 1] = '?';  // nothing that is read is that long
        ++at_;
    }
    room_[length] = 0;
    word_ = room_;
    return length > 0;
}

const char* Words::restOfLine(int* length)
{
    while (*at_ == ' ')
        ++at_;
    int count = 0;
    while (at_[count] != 0 && at_[count] != '#')
        ++count;
    while (count > 0 && at_[count - 1] == ' ')
        --count;
    *length = count;
    return at_;
}

bool Words::readEnd()
{
    return nextWord() ? expected("the end of the line") : true;
}

bool Words::readName(const char* what)
{
    nextWord();
    bool good = isLetter(word_[0]);
    int length = 0;
    for (; word_[length] != 0; ++length)
        good = good && (isLetter(word_[length]) || isDigit(word_[length]) || word_[length] == '-' || word_[length] == '_');
    return good && length < NAME_ROOM ? true : expected(what);
}

// --- Numbers

bool Words::readReal(const char* what, Real low, Real high, Real* value)
{
    nextWord();
    return realIs(what, low, high, value);
}

bool Words::realIs(const char* what, Real low, Real high, Real* value)
{
    if (parseReal(word_, value) && *value >= low && *value <= high)
        return true;
    char from[24], to[24], text[300];
    formatReal(from, sizeof from, low);
    formatReal(to, sizeof to, high);
    snprintf(text, sizeof text, "%s from %s to %s", what, from, to);
    return expected(text);
}

bool Words::readVector(const char* what, Real low, Real high, Vector* value)
{
    const auto part = [&](const char* axis, Real* to) {
        char text[60];
        snprintf(text, sizeof text, "%s%s", what, axis);
        return readReal(text, low, high, to);
    };
    return part("x", &value->x) && part("y", &value->y) && part("z", &value->z);
}

bool Words::readPlace(const char* what, Vector* value)
{
    return readVector(what, Real(-SPACE), Real(SPACE), value);
}

bool Words::readDirection(const char* what, Vector* value)
{
    if (!readPlace(what, value))
        return false;
    if (*value == Vector{Real(0), Real(0), Real(0)})
        return expected("a direction, not 0 0 0");
    return true;
}

// --- Colours

// Reads a colour: a name, #rrggbb, or three numbers.
bool Words::readColour(Colour* colour)
{
    nextWord(true);
    for (const ColourName& known : COLOUR_NAMES) {
        if (is(known.name)) {
            *colour = known.colour;
            return true;
        }
    }
    if (word_[0] == '#')
        return hexColour(colour);
    if (isEmpty() || isLetter(word_[0]))
        return expectedColour();
    const char* const what = "red, green and blue";
    const Real most(255);
    Real part[3];
    if (!realIs(what, Real(0), most, &part[0]) || !readReal(what, Real(0), most, &part[1]) ||
        !readReal(what, Real(0), most, &part[2]))
        return false;
    *colour = {static_cast<uint8_t>(floorToInt(part[0])), static_cast<uint8_t>(floorToInt(part[1])),
               static_cast<uint8_t>(floorToInt(part[2]))};
    return true;
}

// Converts the latest word, #rrggbb, to a colour.
bool Words::hexColour(Colour* colour)
{
    uint32_t value = 0;
    int digits = 1;
    for (; hexDigit(word_[digits]) >= 0; ++digits)
        value = value << 4 | static_cast<uint32_t>(hexDigit(word_[digits]));
    if (digits != 7 || word_[digits] != 0)
        return expected("a colour as #rrggbb, two digits from 00 to ff each for red, green and blue");
    *colour = {static_cast<uint8_t>(value >> 16), static_cast<uint8_t>(value >> 8), static_cast<uint8_t>(value)};
    return true;
}

bool Words::expectedColour()
{
    char text[200];
    int length = 0;
    for (const ColourName& known : COLOUR_NAMES)
        length += snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s, ", known.name);
    snprintf(text + length, sizeof text - static_cast<size_t>(length), "#rrggbb, or red, green and blue from 0 to 255");
    return expected(text);
}
