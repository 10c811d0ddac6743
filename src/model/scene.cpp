// Scene files: the reader goes word by word and knows at each what it expects, so that it can say so; the writer writes
// what the reader reads.
#include "model/scene.h"

#include "machine.h"
#include "rt.h"
#include "math/text.h"

namespace {

constexpr char END_OF_TEXT = 26;  // Ctrl-Z
constexpr int WORD_ROOM = 32;

// "blend all" goes through every pair; no scene needs it often. What lines with rows link or dent is limited in the same way.
constexpr int ALL_MOST = 8;
constexpr int ROW_PAIRS_MOST = 65024;

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

// Items that one line made: `count` items of the model from `first` on. A row has a name of its own; a single item, as
// the reader finds it, is a row of one.
struct Row {
    char name[NAME_ROOM];
    int first = 0;
    int count = 0;
};
constexpr int ROW_LEAST = 2;
constexpr int ROWS_MOST = (Model::OBJECTS_MOST + Model::GROUPS_MOST) / ROW_LEAST;  // no more can be made

// Warps by name, and what their amounts are.
struct WarpWord {
    const char* word;
    const char* amount;
};
const WarpWord WARPS[WARP_PARTS] = {{"taper", "a share of the width"}, {"twist", "degrees"}, {"bend", "degrees"}};

char problem[640];

// Names in messages: whole, as long as no path is longer than this.
constexpr int PLAIN_ROOM = 260;

const char* troubleWith(const char* name, const char* what)
{
    char plain[PLAIN_ROOM];
    snprintf(problem, sizeof problem, "%s: %s", plainText(plain, sizeof plain, name), what);
    return problem;
}

bool isLetter(char c)
{
    return c >= 'a' && c <= 'z';
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

// Where the characters come from: a file, or a text in memory.
class Source {
public:
    explicit Source(int file) : file_(file) {}
    Source(const char* text, uint32_t length) : at_(text), end_(text + length) {}

    // The next character; -1 at the end, -2 when the file cannot be read.
    int next()
    {
        if (at_ == end_) {
            if (file_ < 0)
                return -1;
            const int32_t got = machine::readFile(file_, buffer_, sizeof buffer_);
            if (got <= 0)
                return got == 0 ? -1 : -2;
            at_ = buffer_;
            end_ = buffer_ + got;
        }
        return static_cast<unsigned char>(*at_++);
    }

private:
    int file_ = -1;
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    char buffer_[1024];
};

// Every function that returns a bool says by false that it has complained.
class Reader {
public:
    Reader(const char* name, Source& source, Model& model) : name_(name), source_(source), model_(model) {}

    bool read();
    SceneEnd end() const { return end_; }

private:
    bool nextLine(bool* there);
    bool nextWord(bool hash = false);
    bool expected(const char* what);
    bool trouble(const char* what);
    bool is(const char* word) const { return strcmp(word_, word) == 0; }

    bool readReal(const char* what, Real least, Real most, Real* value);
    bool realIs(const char* what, Real least, Real most, Real* value);
    bool readColour(Colour* colour);
    bool readVector(const char* what, int most, Vector* value);
    bool readDirection(const char* what, Vector* value);
    bool readName(const char* what);
    bool readKnown(const char* what, Actor** item);
    bool readMoving(Row* row);
    Actor* eyeCarrier();
    Actor& in(const Row& row, int i) { return model_.item(row.first + i); }
    const Row* rowNamed(const char* name) const;
    bool find(const char* name, Row* row) const;
    bool readPeriod(Real* seconds);
    bool readPhase(Real* phase);
    bool readLag(const Row& row, Real* lag);
    bool readEnd();
    Move* further(Actor& item, MotionPart part);

    bool statement();
    bool object(const Kind* kind);
    bool addRow(Actor& actor, int count, const Vector& step, bool coloured);
    bool title();
    bool camera();
    bool eye();
    bool look();
    bool circle();
    bool path();
    bool turning(bool swings);
    bool pulse();
    bool warp(WarpPart part);
    bool keys();
    bool key();
    bool blend();
    bool colours();
    bool readPainted(Row* row);
    bool finish();
    bool pattern();
    bool dent();
    bool strength();
    bool readPair(const char* what, Row* a, Row* b);
    bool readWeight(Real* weight);

    const char* name_;
    Source& source_;
    Model& model_;
    SceneEnd end_ = SCENE_GOOD;
    int line_ = 0;
    bool over_ = false;
    int allBlended_ = 0;
    int rowPairs_ = 0;
    Row row_[ROWS_MOST];
    int rows_ = 0;
    char text_[LINE_MOST + 1];
    const char* at_ = nullptr;
    const char* word_ = "";
    char room_[WORD_ROOM];
};

// --- Lines and words

// The next line, as it stands but for blanks, into text_.
bool Reader::nextLine(bool* there)
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
    if (line_ > SCENE_LINES_MOST) {
        word_ = "one more line";
        char most[60];
        snprintf(most, sizeof most, "at most %d lines", SCENE_LINES_MOST);
        return expected(most);
    }
    for (int characters = 0;; ++characters) {
        const int c = source_.next();
        if (c == -2) {
            troubleWith(name_, machine::fileTrouble());
            end_ = SCENE_BAD;
            return false;
        }
        if (c == -1 || c == END_OF_TEXT) {
            over_ = true;
            if (!some)
                return true;
            break;
        }
        some = true;
        if (c == '\n')
            break;
        if (c == '\r')
            continue;
        if (characters >= LINE_MOST) {
            text_[length < 20 ? length : 20] = 0;
            char* comment = strchr(text_, '#');
            if (comment != nullptr)
                *comment = 0;
            snprintf(room_, sizeof room_, "%.20s...", text_);
            word_ = room_;
            char most[60];
            snprintf(most, sizeof most, "a line of at most %d characters", LINE_MOST);
            return expected(most);
        }
        text_[length++] = static_cast<char>(c == '\t' ? ' ' : c == 0 ? '?' : c);
    }
    text_[length] = 0;
    *there = true;
    return true;
}

// The next word of the line into word_, in lower case; false, and word_ is empty, at its end or a comment. With `hash` a
// word may begin with '#'.
bool Reader::nextWord(bool hash)
{
    while (*at_ == ' ')
        ++at_;
    int length = 0;
    while (*at_ != ' ' && *at_ != 0 && (*at_ != '#' || (hash && length == 0))) {
        if (length < WORD_ROOM - 1)
            room_[length++] = *at_ >= 'A' && *at_ <= 'Z' ? static_cast<char>(*at_ + 32) : *at_;
        ++at_;
    }
    room_[length] = 0;
    word_ = room_;
    return length > 0;
}

bool Reader::expected(const char* what)
{
    char read[WORD_ROOM];
    int length = 0;
    // Only what any screen can show.
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

bool Reader::trouble(const char* what)
{
    char name[PLAIN_ROOM];
    snprintf(problem, sizeof problem, "%s:%d: %s", plainText(name, sizeof name, name_), line_, what);
    end_ = SCENE_TROUBLE;
    return false;
}

// --- Values

bool Reader::readReal(const char* what, Real low, Real high, Real* value)
{
    nextWord();
    return realIs(what, low, high, value);
}

// The word read last as a number.
bool Reader::realIs(const char* what, Real low, Real high, Real* value)
{
    if (parseReal(word_, value) && *value >= low && *value <= high)
        return true;
    char from[24], to[24], text[300];
    formatReal(from, sizeof from, low);
    formatReal(to, sizeof to, high);
    snprintf(text, sizeof text, "%s from %s to %s", what, from, to);
    return expected(text);
}

// A colour: a name, #rrggbb, or three numbers.
bool Reader::readColour(Colour* colour)
{
    nextWord(true);
    for (const ColourName& known : COLOUR_NAMES) {
        if (is(known.name)) {
            *colour = known.colour;
            return true;
        }
    }
    if (word_[0] == '#') {
        uint32_t value = 0;
        int digits = 1;
        for (; (word_[digits] >= '0' && word_[digits] <= '9') || (word_[digits] >= 'a' && word_[digits] <= 'f'); ++digits)
            value = value << 4 | static_cast<uint32_t>(isDigit(word_[digits]) ? word_[digits] - '0' : word_[digits] - 'a' + 10);
        if (digits != 7 || word_[digits] != 0)
            return expected("a colour as #rrggbb, two digits from 00 to ff each for red, green and blue");
        *colour = {static_cast<uint8_t>(value >> 16), static_cast<uint8_t>(value >> 8), static_cast<uint8_t>(value)};
        return true;
    }
    if (word_[0] == 0 || isLetter(word_[0])) {
        char text[200];
        int length = 0;
        for (const ColourName& known : COLOUR_NAMES)
            length += snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s, ", known.name);
        snprintf(text + length, sizeof text - static_cast<size_t>(length), "#rrggbb, or red, green and blue from 0 to 255");
        return expected(text);
    }
    const Real most(255);
    Real part[3];
    if (!realIs("red, green and blue", Real(0), most, &part[0]) || !readReal("red, green and blue", Real(0), most, &part[1]) ||
        !readReal("red, green and blue", Real(0), most, &part[2]))
        return false;
    *colour = {static_cast<uint8_t>(floorToInt(part[0])), static_cast<uint8_t>(floorToInt(part[1])),
               static_cast<uint8_t>(floorToInt(part[2]))};
    return true;
}

bool Reader::readVector(const char* what, int limit, Vector* value)
{
    const auto part = [&](const char* axis, Real* to) {
        nextWord();
        if (parseReal(word_, to) && absolute(*to) <= Real(limit))
            return true;
        char text[60];
        snprintf(text, sizeof text, "%.40s, %s", what, axis);
        return realIs(text, Real(-limit), Real(limit), to);
    };
    return part("x", &value->x) && part("y", &value->y) && part("z", &value->z);
}

bool Reader::readDirection(const char* what, Vector* value)
{
    if (!readVector(what, SPACE, value))
        return false;
    if (*value == Vector{Real(0), Real(0), Real(0)})
        return expected("a direction, not 0 0 0");
    return true;
}

// A name into word_: a letter, then letters, digits, '-' or '_'.
bool Reader::readName(const char* what)
{
    nextWord();
    bool good = isLetter(word_[0]);
    int length = 0;
    for (; word_[length] != 0; ++length)
        good = good && (isLetter(word_[length]) || isDigit(word_[length]) || word_[length] == '-' || word_[length] == '_');
    return good && length < NAME_ROOM ? true : expected(what);
}

bool Reader::readKnown(const char* what, Actor** item)
{
    nextWord();
    *item = word_[0] == 0 ? nullptr : model_.itemNamed(word_);
    if (*item == nullptr && is(EYE_NAME)) {
        *item = eyeCarrier();
        return *item != nullptr;
    }
    return *item != nullptr ? true : expected(what);
}

const Row* Reader::rowNamed(const char* name) const
{
    for (int i = 0; i < rows_; ++i)
        if (strcmp(row_[i].name, name) == 0)
            return &row_[i];
    return nullptr;
}

// The items that a name stands for. False, without a complaint: none.
bool Reader::find(const char* name, Row* row) const
{
    const Row* known = rowNamed(name);
    if (known != nullptr) {
        *row = *known;
        return true;
    }
    for (int i = 0; i < model_.items(); ++i) {
        if (strcmp(model_.item(i).name, name) != 0)
            continue;
        row->first = i;
        row->count = 1;
        return true;
    }
    return false;
}

// What a line of motion moves.
bool Reader::readMoving(Row* row)
{
    nextWord();
    if (word_[0] != 0 && find(word_, row))
        return true;
    if (!is(EYE_NAME))
        return expected("the name of an object or a group");
    const Actor* carrier = eyeCarrier();
    return carrier != nullptr && find(carrier->name, row);
}

// The group that the eye moves with. Null, and a complaint: there cannot be one.
Actor* Reader::eyeCarrier()
{
    if (model_.camera.carrier == 0) {
        word_ = EYE_NAME;
        if (model_.itemNamed(EYE_NAME) != nullptr || rowNamed(EYE_NAME) != nullptr) {
            expected("another name for the object or group of that name, for the eye moves");
            return nullptr;
        }
        if (model_.items() - model_.count() == Model::GROUPS_MOST) {
            expected("at most 64 groups, the eye that moves among them");
            return nullptr;
        }
    }
    Actor* carrier = model_.eyeCarrier();
    if (carrier == nullptr)
        trouble("not enough memory for the model");
    return carrier;
}

// A place for one more motion of a part that the item has already; null, and a complaint, when there is none.
Move* Reader::further(Actor& item, MotionPart part)
{
    Motion& motion = item.motion;
    if (motion.moreCount == Motion::MORE_MOST) {
        word_ = item.name;
        expected("at most 4 motions of one name beside the first of each kind");
        return nullptr;
    }
    Move& move = motion.more[motion.moreCount++];
    move.part = part;
    return &move;
}

bool Reader::readEnd()
{
    return nextWord() ? expected("the end of the line") : true;
}

// --- Statements

bool Reader::read()
{
    bool there;
    for (;;) {
        if (!nextLine(&there))
            return false;
        if (!there)
            break;
        if (nextWord() && !statement())
            return false;
    }
    word_ = "end of file";
    return model_.count() > 0 ? true : expected("at least one object");
}

bool Reader::statement()
{
    const Kind* kind = kindNamed(word_);
    if (kind != nullptr || is("group"))
        return object(kind);
    if (is("eye"))
        return eye();
    if (is("look"))
        return look();
    if (is("focal") || is("light") || is("roll"))
        return camera();
    if (is("title"))
        return title();
    if (is("circle"))
        return circle();
    if (is("path"))
        return path();
    if (is("spin") || is("swing"))
        return turning(is("swing"));
    if (is("pulse"))
        return pulse();
    for (int part = 0; part < WARP_PARTS; ++part)
        if (is(WARPS[part].word))
            return warp(static_cast<WarpPart>(part));
    if (is("keys"))
        return keys();
    if (is("key"))
        return key();
    if (is("blend"))
        return blend();
    if (is("colours") || is("colors"))
        return colours();
    if (is("finish"))
        return finish();
    if (is("pattern"))
        return pattern();
    if (is("dent"))
        return dent();
    if (is("strength"))
        return strength();
    char text[270];
    int length = 0;
    for (int i = 0; i < KIND_COUNT; ++i)
        length += snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s, ", KINDS[i].word);
    snprintf(text + length, sizeof text - static_cast<size_t>(length),
             "group, blend, dent, strength, circle, path, spin, swing, pulse, taper, twist, bend, keys, key, colours, finish, pattern, eye, look, roll, focal, light or title");
    return expected(text);
}

// The colour of an object that is given none, by how many there are before it.
Colour usualColour(int before)
{
    static const Colour COLOURS[] = {{255, 64, 48},  {64, 208, 72},  {72, 112, 255}, {255, 200, 48},
                                     {224, 80, 224}, {64, 208, 216}, {255, 136, 40}, {208, 208, 208}};
    return COLOURS[before % 8];
}

bool Reader::object(const Kind* kind)
{
    Actor actor;
    actor.kind = kind;
    actor.colour = usualColour(model_.count());
    if (!readName("a name of 1 to 15 letters, digits, - or _, a letter first"))
        return false;
    if (is("all"))
        return expected("another name; all stands for every object");
    if (model_.itemNamed(word_) != nullptr || rowNamed(word_) != nullptr)
        return expected("a name that is not taken yet");
    strcpy(actor.name, word_);

    const int measures = kind == nullptr ? 0 : kind->measures;
    int given = 0;  // one bit a measure
    Real count(1);
    Vector step{Real(0), Real(0), Real(0)};
    bool stepped = false, coloured = false;
    while (nextWord()) {
        bool measured = false;
        for (int i = 0; i < measures && !measured; ++i) {
            const Measure& m = kind->measure[i];
            if (!is(m.word))
                continue;
            if (!readReal(m.word, m.least, m.most, &actor.measure[i]))
                return false;
            given |= 1 << i;
            measured = true;
        }
        if (measured)
            continue;
        if (is("at")) {
            Vector v;
            if (!readVector("a place", SPACE, &v))
                return false;
            actor.motion.centre = toPoint(v);
        } else if (is("turn")) {
            const Real most = DEGREES_MOST;
            Vector& v = actor.motion.turn;
            if (!readReal("degrees about x", -most, most, &v.x) || !readReal("degrees about y", -most, most, &v.y) ||
                !readReal("degrees about z", -most, most, &v.z))
                return false;
            actor.motion.parts |= MOTION_TURN;
        } else if (is("in")) {
            Actor* parent;
            if (!readKnown("a group or an object of a line above", &parent))
                return false;
            actor.motion.parent = parent->number;
        } else if (is("repeat")) {
            const Real most(kind != nullptr ? Model::OBJECTS_MOST : Model::GROUPS_MOST);
            if (!readReal("a whole number", Real(ROW_LEAST), most, &count))
                return false;
            if (count != Real(floorToInt(count)))
                return expected("a whole number");
        } else if (is("step")) {
            if (!readVector("a step", SPACE, &step))
                return false;
            stepped = true;
        } else if (kind != nullptr && (is("colour") || is("color"))) {
            if (!readColour(&actor.colour))
                return false;
            coloured = true;
        } else if (kind != nullptr && is("stretch")) {
            Vector& v = actor.stretch;
            if (!readReal("a factor along x", STRETCH_LEAST, STRETCH_MOST, &v.x) ||
                !readReal("a factor along y", STRETCH_LEAST, STRETCH_MOST, &v.y) ||
                !readReal("a factor along z", STRETCH_LEAST, STRETCH_MOST, &v.z))
                return false;
        } else if (kind == nullptr && is("scale")) {
            if (!readReal("a scale", SCALE_LEAST, SCALE_MOST, &actor.motion.scale))
                return false;
        } else {
            char text[120];
            int length = 0;
            for (int i = 0; i < measures; ++i)
                length += snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s, ", kind->measure[i].word);
            snprintf(text + length, sizeof text - static_cast<size_t>(length), "at, turn, %s, repeat, step or in",
                     kind != nullptr ? "colour, stretch" : "scale");
            return expected(text);
        }
    }
    for (int i = 0; i < measures; ++i)
        if ((given & 1 << i) == 0)
            return expected(kind->measure[i].word);
    const char* fits = Model::expects(actor);
    if (fits != nullptr) {
        word_ = actor.name;
        return expected(fits);
    }
    if (count > Real(1))
        return addRow(actor, floorToInt(count), step, coloured);
    if (stepped) {
        word_ = "step";
        return expected("repeat as well, for step to count");
    }
    // With `in eye` on this line the eye may have become the last group.
    word_ = actor.name;
    if (kind != nullptr ? model_.count() == Model::OBJECTS_MOST : model_.items() - model_.count() == Model::GROUPS_MOST)
        return expected(kind != nullptr ? "at most 128 objects" : "at most 64 groups");
    return model_.addItem(actor) != nullptr ? true : trouble("not enough memory for the model");
}

// Adds `count` items like one, each a step from the one before: NAME1, NAME2 and so on.
bool Reader::addRow(Actor& actor, int count, const Vector& step, bool coloured)
{
    const bool group = actor.kind == nullptr;
    Row row;
    strcpy(row.name, actor.name);
    row.first = model_.items();
    row.count = count;
    word_ = row.name;
    const int taken = group ? model_.items() - model_.count() : model_.count();
    if (taken + count > (group ? Model::GROUPS_MOST : Model::OBJECTS_MOST))
        return expected(group ? "at most 64 groups" : "at most 128 objects");
    const size_t digits = count > 99 ? 3 : count > 9 ? 2 : 1;
    if (strlen(row.name) + digits >= NAME_ROOM) {
        char text[60];
        snprintf(text, sizeof text, "at most %d characters in the name of such a row", NAME_ROOM - 1 - static_cast<int>(digits));
        return expected(text);
    }
    const Real edge(SPACE);
    for (int i = 0; i < count; ++i) {
        char name[NAME_ROOM + 12];
        snprintf(name, sizeof name, "%s%d", row.name, i + 1);
        memcpy(actor.name, name, NAME_ROOM);  // it fits, as was found above
        if (model_.itemNamed(actor.name) != nullptr || rowNamed(actor.name) != nullptr) {
            word_ = actor.name;
            return expected("a name that is not taken yet");
        }
        if (i > 0) {
            Point& centre = actor.motion.centre;
            centre = centre + step;
            if (absolute(centre.x) > edge || absolute(centre.y) > edge || absolute(centre.z) > edge) {
                word_ = actor.name;
                return expected("steps that stay between -250 and 250");
            }
        }
        if (!group && !coloured)
            actor.colour = usualColour(model_.count());
        if (model_.addItem(actor) == nullptr)
            return trouble("not enough memory for the model");
    }
    row_[rows_++] = row;
    return true;
}

// All that is left of the line, in its own letters.
bool Reader::title()
{
    word_ = "title";
    if (model_.title[0] != 0)
        return expected("one title only");
    while (*at_ == ' ')
        ++at_;
    int length = 0;
    bool plain = true;
    for (; at_[length] != 0 && at_[length] != '#'; ++length)
        plain = plain && at_[length] >= ' ' && at_[length] <= '~';
    while (length > 0 && at_[length - 1] == ' ')
        --length;
    if (length == 0 || length >= TITLE_ROOM || !plain) {
        snprintf(room_, sizeof room_, "%.*s%s", length > 20 ? 20 : length, at_, length > 20 ? "..." : "");
        word_ = room_;
        return expected("a title of 1 to 47 plain letters, digits and signs");
    }
    memcpy(model_.title, at_, static_cast<size_t>(length));
    model_.title[length] = 0;
    return true;
}

// Where the eye stands; with `turn` or `in` it is a group.
bool Reader::eye()
{
    Vector v, turn{Real(0), Real(0), Real(0)};
    if (!readVector("the eye's place", SPACE, &v))
        return false;
    const Real most = DEGREES_MOST;
    const Actor* parent = nullptr;
    bool turned = false;
    while (nextWord()) {
        if (is("turn")) {
            if (!readReal("degrees about x", -most, most, &turn.x) || !readReal("degrees about y", -most, most, &turn.y) ||
                !readReal("degrees about z", -most, most, &turn.z))
                return false;
            turned = true;
        } else if (is("in")) {
            Actor* known;
            if (!readKnown("a group or an object of a line above", &known))
                return false;
            // Parents stand before their children.
            for (int i = 0; &model_.item(i) != known; ++i)
                if (model_.item(i).number == model_.camera.carrier)
                    return expected("a group or an object above the first line that moves the eye");
            parent = known;
        } else {
            return expected("turn, in or the end of the line");
        }
    }
    if (parent != nullptr && parent->number == model_.camera.carrier) {
        word_ = parent->name;
        return expected("another group than the eye's own");
    }
    model_.camera.eye = toPoint(v);
    if (!turned && parent == nullptr && model_.camera.carrier == 0)
        return true;
    Actor* carrier = eyeCarrier();
    if (carrier == nullptr)
        return false;
    carrier->motion.centre = toPoint(v);
    carrier->motion.turn = turn;
    carrier->motion.parent = parent == nullptr ? 0 : parent->number;
    return true;
}

// What the eye looks at: a place, or an object or a group.
bool Reader::look()
{
    Camera& camera = model_.camera;
    nextWord();
    if (isLetter(word_[0]) || word_[0] == 0) {
        const Actor* item = word_[0] == 0 ? nullptr : model_.itemNamed(word_);
        if (item == nullptr || item->number == camera.carrier)
            return expected(word_[0] == 0 ? "a place, or the name of an object or a group"
                                          : "the name of an object or a group of a line above");
        camera.looks = Camera::AT_ITEM;
        camera.item = item->number;
        return readEnd();
    }
    const Real edge(SPACE);
    Point& p = camera.target;
    if (!realIs("the place looked at, x", -edge, edge, &p.x) || !readReal("the place looked at, y", -edge, edge, &p.y) ||
        !readReal("the place looked at, z", -edge, edge, &p.z))
        return false;
    camera.looks = Camera::AT_POINT;
    return readEnd();
}

bool Reader::camera()
{
    if (is("roll")) {
        if (!readReal("degrees", -DEGREES_MOST, DEGREES_MOST, &model_.camera.roll))
            return false;
    } else if (is("light")) {
        if (!readDirection("the direction to the light", &model_.light))
            return false;
    } else {
        const Real low(FOCAL_LEAST), high(FOCAL_MOST);
        Camera& camera = model_.camera;
        if (!readReal("pixels across", low, high, &camera.focalX))
            return false;
        // A pixel is 5 wide to 6 high.
        camera.focalY = most(realFromRaw(mulDiv(rawFromReal(camera.focalX), 5, 6)), low);
        const char* behind = at_;
        if (nextWord()) {
            at_ = behind;
            if (!readReal("pixels down", low, high, &camera.focalY))
                return false;
        }
    }
    return readEnd();
}

// What follows the word `period`: a time whose sign says which way round.
bool Reader::readPeriod(Real* seconds)
{
    if (!readReal("seconds", -PERIOD_MOST, PERIOD_MOST, seconds))
        return false;
    return absolute(*seconds) >= PERIOD_LEAST ? true : expected("0.1 seconds or more, or -0.1 or less to go backwards");
}

bool Reader::readPhase(Real* phase)
{
    return readReal("a phase in turns", Real(-1), Real(1), phase);
}

// What follows the word `lag`: how many turns each of a row is behind the one before.
bool Reader::readLag(const Row& row, Real* lag)
{
    if (row.count == 1)
        return expected("no lag, for this name is no row's");
    return readReal("a lag in turns", Real(-1), Real(1), lag);
}

// The wave of item `i` of a row.
Wave waveOf(int i, Real period, Real phase, Real lag)
{
    return makeWave(period, phase - lag * Real(i));
}

bool Reader::circle()
{
    Row row;
    if (!readMoving(&row))
        return false;
    Vector u{Real(0), Real(0), Real(0)}, v = u;
    Real radius(0), period(0), phase(0), lag(0);
    char first = 'x', second = 'y';
    bool round = false, across = false, down = false, timed = false;
    while (nextWord()) {
        if (is("radius")) {
            if (!readReal("a radius", Real(0), Real(SPACE), &radius))
                return false;
            round = true;
        } else if (is("plane")) {
            nextWord();
            if (!is("xy") && !is("yz") && !is("zx") && !is("yx") && !is("zy") && !is("xz"))
                return expected("xy, yz, zx, yx, zy or xz");
            first = word_[0];
            second = word_[1];
        } else if (is("u")) {
            if (!readVector("an arm", SPACE, &u))
                return false;
            across = true;
        } else if (is("v")) {
            if (!readVector("an arm", SPACE, &v))
                return false;
            down = true;
        } else if (is("period")) {
            if (!readPeriod(&period))
                return false;
            timed = true;
        } else if (is("phase")) {
            if (!readPhase(&phase))
                return false;
        } else if (is("lag")) {
            if (!readLag(row, &lag))
                return false;
        } else {
            return expected(row.count > 1 ? "radius, plane, u, v, period, phase or lag" : "radius, plane, u, v, period or phase");
        }
    }
    if (round == (across && down) || across != down)
        return expected("a radius, or both u and v");
    if (round) {
        (first == 'x' ? u.x : first == 'y' ? u.y : u.z) = radius;
        (second == 'x' ? v.x : second == 'y' ? v.y : v.z) = radius;
    }
    if (!timed)
        return expected("period");
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        const Wave wave = waveOf(i, period, phase, lag);
        if (motion.circle.period == Real(0)) {
            motion.u = u;
            motion.v = v;
            motion.circle = wave;
            continue;
        }
        Move* move = further(in(row, i), MOTION_CIRCLE);
        if (move == nullptr)
            return false;
        move->a = u;
        move->b = v;
        move->wave = wave;
    }
    return true;
}

bool Reader::path()
{
    Row row;
    if (!readMoving(&row))
        return false;
    // `lag` may stand behind what it holds for: the line is read twice.
    const char* const start = at_;
    Real lag(0);
    bool some = false;
    for (int pass = 0; pass < 2; ++pass) {
        at_ = start;
        while (nextWord()) {
            if (row.count > 1 && is("lag")) {
                if (!readLag(row, &lag))
                    return false;
                continue;
            }
            const int axis = is("x") ? 0 : is("y") ? 1 : is("z") ? 2 : -1;
            if (axis < 0)
                return expected(row.count > 1 ? "x, y or z, each with amplitude, period and phase, or lag"
                                              : "x, y or z, each with amplitude, period and phase");
            Real amplitude, period, phase;
            if (!readReal("an amplitude", Real(-SPACE), Real(SPACE), &amplitude) || !readPeriod(&period) || !readPhase(&phase))
                return false;
            some = true;
            for (int i = 0; pass == 1 && i < row.count; ++i) {
                Motion& motion = in(row, i).motion;
                Vector* to = &motion.path;
                Wave* wave = &motion.along[axis];
                if (wave->period != Real(0)) {
                    Move* move = further(in(row, i), MOTION_PATH);
                    if (move == nullptr)
                        return false;
                    to = &move->a;
                    wave = &move->wave;
                }
                (axis == 0 ? to->x : axis == 1 ? to->y : to->z) = amplitude;
                *wave = waveOf(i, period, phase, lag);
                motion.parts |= MOTION_PATH;
            }
        }
    }
    return some ? true : expected("x, y or z, each with amplitude, period and phase");
}

bool Reader::turning(bool swings)
{
    Row row;
    if (!readMoving(&row))
        return false;
    Vector axis{Real(0), Real(1), Real(0)};
    Real angle(0), period(0), phase(0), lag(0);
    bool pointed = false, wide = !swings, timed = false;
    while (nextWord()) {
        if (is("axis")) {
            if (!readDirection("an axis", &axis))
                return false;
            pointed = true;
        } else if (swings && is("angle")) {
            if (!readReal("degrees", -DEGREES_MOST, DEGREES_MOST, &angle))
                return false;
            wide = true;
        } else if (is("period")) {
            if (!readPeriod(&period))
                return false;
            timed = true;
        } else if (is("phase")) {
            if (!readPhase(&phase))
                return false;
        } else if (is("lag")) {
            if (!readLag(row, &lag))
                return false;
        } else {
            char text[60];
            snprintf(text, sizeof text, "axis, %speriod%s", swings ? "angle, " : "", row.count > 1 ? ", phase or lag" : " or phase");
            return expected(text);
        }
    }
    if (!pointed)
        return expected("axis");
    if (!wide)
        return expected("angle");
    if (!timed)
        return expected("period");
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        const MotionPart part = swings ? MOTION_SWING : MOTION_SPIN;
        const Wave wave = waveOf(i, period, phase, lag);
        if ((motion.parts & part) != 0) {
            Move* move = further(in(row, i), part);
            if (move == nullptr)
                return false;
            move->a = axis;
            move->amount = angle;
            move->wave = wave;
            continue;
        }
        motion.parts |= part;
        (swings ? motion.swingAxis : motion.spinAxis) = axis;
        (swings ? motion.swing : motion.spin) = wave;
        if (swings)
            motion.swingAngle = angle;
    }
    return true;
}

bool Reader::pulse()
{
    Row row;
    if (!readMoving(&row))
        return false;
    Real by(0), period(0), phase(0), lag(0);
    bool given = false, timed = false;
    while (nextWord()) {
        if (is("by")) {
            if (!readReal("a share of the size", Real(0), PULSE_MOST, &by))
                return false;
            given = true;
        } else if (is("period")) {
            if (!readPeriod(&period))
                return false;
            timed = true;
        } else if (is("phase")) {
            if (!readPhase(&phase))
                return false;
        } else if (is("lag")) {
            if (!readLag(row, &lag))
                return false;
        } else {
            return expected(row.count > 1 ? "by, period, phase or lag" : "by, period or phase");
        }
    }
    if (!given)
        return expected("by");
    if (!timed)
        return expected("period");
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        const Wave wave = waveOf(i, period, phase, lag);
        if ((motion.parts & MOTION_PULSE) != 0) {
            Move* move = further(in(row, i), MOTION_PULSE);
            if (move == nullptr)
                return false;
            move->amount = by;
            move->wave = wave;
            continue;
        }
        motion.parts |= MOTION_PULSE;
        motion.pulse = by;
        motion.pulsing = wave;
    }
    return true;
}

bool Reader::warp(WarpPart part)
{
    Row row;
    if (!readMoving(&row))
        return false;
    if (in(row, 0).object == nullptr)
        return expected("the name of an object");
    const Real most = WARP_MOST[part];
    Real amount, swing(0), period(0), phase(0), lag(0);
    if (!readReal(WARPS[part].amount, -most, most, &amount))
        return false;
    bool swings = false, timed = false;
    while (nextWord()) {
        if (is("swing")) {
            if (!readReal(WARPS[part].amount, -most, most, &swing))
                return false;
            swings = true;
        } else if (is("period")) {
            if (!readPeriod(&period))
                return false;
            timed = true;
        } else if (is("phase")) {
            if (!readPhase(&phase))
                return false;
        } else if (is("lag")) {
            if (!readLag(row, &lag))
                return false;
        } else {
            return expected(row.count > 1 ? "swing, period, phase or lag" : "swing, period or phase");
        }
    }
    if (swings != timed)
        return expected(swings ? "period" : "swing");
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        motion.parts |= MOTION_WARP;
        motion.warp[part].amount = amount;
        motion.warp[part].swing = swing;
        motion.warp[part].wave = swings ? waveOf(i, period, phase, lag) : Wave();
    }
    return true;
}

bool Reader::keys()
{
    Row row;
    if (!readMoving(&row))
        return false;
    for (int i = 0; i < row.count; ++i) {
        if (in(row, i).motion.keyCount > 0) {
            word_ = in(row, i).name;
            return expected("keys before the first key");
        }
    }
    // All of a row have the same; what the line does not say stays as it was.
    const char* const start = at_;
    for (int i = 0; i < row.count; ++i) {
        Motion& motion = in(row, i).motion;
        at_ = start;
        while (nextWord()) {
            if (is("linear") || is("smooth")) {
                motion.smooth = is("smooth");
            } else if (is("repeat")) {
                Real repeat;
                if (!readReal("seconds", PERIOD_LEAST, KEY_TIME_MOST, &repeat))
                    return false;
                motion.repeat = rawFromReal(repeat);
            } else if (is("axis")) {
                if (!readDirection("an axis", &motion.keyAxis))
                    return false;
            } else {
                return expected("linear, smooth, repeat or axis");
            }
        }
    }
    return true;
}

bool Reader::key()
{
    Row row;
    if (!readMoving(&row))
        return false;
    Real time;
    if (!readReal("seconds", Real(0), KEY_TIME_MOST, &time))
        return false;
    Key key{rawFromReal(time), {Real(0), Real(0), Real(0), Real(0), Real(1)}};
    for (int i = 0; i < row.count; ++i) {
        const Motion& motion = in(row, i).motion;
        if (motion.keyCount > 0 && key.time <= model_.keys()[motion.firstKey + motion.keyCount - 1].time)
            return expected("a time after that of the key before");
        if (motion.repeat > 0 && key.time >= motion.repeat)
            return expected("a time before that of repeat");
    }
    Vector v;
    if (!readVector("a place", SPACE, &v))
        return false;
    key.value[0] = v.x;
    key.value[1] = v.y;
    key.value[2] = v.z;
    while (nextWord()) {
        if (is("angle")) {
            if (!readReal("degrees", -KEY_DEGREES_MOST, KEY_DEGREES_MOST, &key.value[3]))
                return false;
        } else if (is("scale")) {
            if (!readReal("a scale", SCALE_LEAST, SCALE_MOST, &key.value[4]))
                return false;
        } else {
            return expected("angle or scale");
        }
    }
    if (model_.keyCount() + row.count > Model::KEYS_MOST) {
        word_ = "key";
        return expected("at most 1024 keys");
    }
    for (int i = 0; i < row.count; ++i)
        if (!model_.addKey(&in(row, i), key))
            return trouble("not enough memory for the keys");
    return true;
}

// Two objects or rows, the first by the word read last.
bool Reader::readPair(const char* what, Row* a, Row* b)
{
    if (word_[0] == 0 || !find(word_, a) || in(*a, 0).object == nullptr)
        return expected(what);
    nextWord();
    if (word_[0] == 0 || !find(word_, b) || in(*b, 0).object == nullptr ||
        (a->first == b->first && a->count == 1 && b->count == 1))
        return expected("the name of a second object");
    if (a->count > 1 || b->count > 1)
        rowPairs_ += a->count * b->count;
    return rowPairs_ <= ROW_PAIRS_MOST ? true : expected("at most 65024 pairs in all lines that blend or dent rows");
}

// A weight and the end of the line; the weight may be missing.
bool Reader::readWeight(Real* weight)
{
    *weight = Real(1);
    const char* behind = at_;
    if (!nextWord())
        return true;
    at_ = behind;
    return readReal("a weight", Real(0), WEIGHT_MOST, weight) && readEnd();
}

bool Reader::dent()
{
    nextWord();
    Row a, b;
    Real weight;
    if (!readPair("the name of an object", &a, &b) || !readWeight(&weight))
        return false;
    bool good = true;
    for (int i = 0; i < a.count; ++i)
        for (int j = 0; j < b.count; ++j)
            if (a.first + i != b.first + j)
                good = good && model_.dent(in(a, i).object, in(b, j).object, weight);
    return good ? true : trouble("not enough memory for the dents");
}

bool Reader::strength()
{
    nextWord();
    Row row;
    if (word_[0] == 0 || !find(word_, &row) || in(row, 0).object == nullptr)
        return expected("the name of an object");
    Real strength;
    if (!readReal("a strength", STRENGTH_LEAST, STRENGTH_MOST, &strength) || !readEnd())
        return false;
    for (int i = 0; i < row.count; ++i) {
        in(row, i).strength = strength;
        in(row, i).object->setStrength(strength);
    }
    return true;
}

bool Reader::blend()
{
    nextWord();
    const bool all = is("all");
    Row a, b;
    if (!all && !readPair("all, or the name of an object", &a, &b))
        return false;
    if (all && ++allBlended_ > ALL_MOST)
        return expected("blend all in at most 8 lines");
    Real weight;
    if (!readWeight(&weight))
        return false;
    bool good = all ? model_.linkAll(weight) : true;
    for (int i = 0; !all && i < a.count; ++i)
        for (int j = 0; j < b.count; ++j)
            if (a.first + i != b.first + j)
                good = good && model_.link(in(a, i).object, in(b, j).object, weight);
    return good ? true : trouble("not enough memory for the links");
}

bool Reader::colours()
{
    nextWord();
    if (!is("mixed") && !is("apart"))
        return expected("mixed or apart");
    model_.mixed = is("mixed");
    return readEnd();
}

// What a line of paint is for.
bool Reader::readPainted(Row* row)
{
    nextWord();
    return word_[0] != 0 && find(word_, row) && in(*row, 0).object != nullptr ? true : expected("the name of an object");
}

bool Reader::finish()
{
    Row row;
    if (!readPainted(&row))
        return false;
    nextWord();
    for (int f = 0; f < FINISHES; ++f) {
        if (!is(FINISH_WORDS[f]))
            continue;
        for (int i = 0; i < row.count; ++i)
            in(row, i).coat.finish = static_cast<Finish>(f);
        return readEnd();
    }
    return expected("matt, shiny or mirror");
}

bool Reader::pattern()
{
    Row row;
    if (!readPainted(&row))
        return false;
    nextWord();
    Coat coat;
    for (int p = PATTERN_NONE + 1; p < PATTERNS; ++p)
        if (is(PATTERN_WORDS[p]))
            coat.pattern = static_cast<Pattern>(p);
    if (coat.pattern == PATTERN_NONE)
        return expected("checks, stripes or marble");
    if (!readReal("the size of a pattern", GRAIN_LEAST, GRAIN_MOST, &coat.grain) || !readColour(&coat.colour))
        return false;
    for (int i = 0; i < row.count; ++i) {
        coat.finish = in(row, i).coat.finish;
        in(row, i).coat = coat;
    }
    return readEnd();
}

const char* readFrom(const char* name, Source& source, Model& model, SceneEnd* end)
{
    Reader reader(name, source, model);
    const bool good = reader.read();
    *end = reader.end();
    return good ? nullptr : problem;
}

// --- Writing

class Writer {
public:
    Writer(bool (*put)(void*, const char*), void* to) : put_(put), to_(to) {}

    bool write(const Model& model);

private:
    // Words and numbers are gathered in line_ until end(). No line the writer makes is longer than LINE_MOST.
    Writer& word(const char* text);
    Writer& number(Real value);
    Writer& vector(const Vector& v) { return number(v.x).number(v.y).number(v.z); }
    Writer& period(const Wave& wave);
    void end();
    void item(const Model& model, const Actor& actor);
    void further(const Actor& actor, MotionPart part);

    bool (*put_)(void*, const char*);
    void* to_;
    bool good_ = true;
    int length_ = 0;
    char line_[LINE_MOST + 2];
};

Writer& Writer::word(const char* text)
{
    if (length_ > 0 && length_ < LINE_MOST)
        line_[length_++] = ' ';
    while (*text != 0 && length_ < LINE_MOST)
        line_[length_++] = *text++;
    return *this;
}

// The shortest text that reads back as the value.
Writer& Writer::number(Real value)
{
    const int32_t raw = rawFromReal(value);
    char text[24];
    text[0] = '-';
    char* digits = raw < 0 ? text + 1 : text;
    for (int decimals = 0; decimals <= 6; ++decimals) {
        formatQuotient(digits, 20, static_cast<uint32_t>(raw < 0 ? -raw : raw), 65536, decimals);
        Real back;
        if (parseReal(text, &back) && back == value)
            break;
    }
    return word(text);
}

Writer& Writer::period(const Wave& wave)
{
    word("period").number(wave.period);
    if (wave.phase != 0)
        word("phase").number(realFromRaw(static_cast<int32_t>(wave.phase >> 16)));
    return *this;
}

void Writer::end()
{
    line_[length_] = '\n';
    line_[length_ + 1] = 0;
    good_ = good_ && put_(to_, line_);
    length_ = 0;
}

// The motions of a part beyond the first, a line each.
void Writer::further(const Actor& actor, MotionPart part)
{
    for (int i = 0; i < actor.motion.moreCount; ++i) {
        const Move& move = actor.motion.more[i];
        if (move.part != part)
            continue;
        const Real none(0);
        switch (part) {
        case MOTION_CIRCLE:
            word("circle").word(actor.name).word("u").vector(move.a).word("v").vector(move.b).period(move.wave);
            break;
        case MOTION_PATH: {
            // Without an amplitude it may be along any axis that has a path already.
            const Motion& m = actor.motion;
            const Real amplitude = move.a.x + move.a.y + move.a.z;
            const bool still = amplitude == none, notX = still ? m.along[0].period == none : move.a.x == none;
            const bool y = notX && (still ? m.along[1].period != none : move.a.y != none);
            word("path").word(actor.name).word(y ? "y" : notX ? "z" : "x").number(amplitude);
            number(move.wave.period).number(realFromRaw(static_cast<int32_t>(move.wave.phase >> 16)));
            break;
        }
        case MOTION_SPIN: word("spin").word(actor.name).word("axis").vector(move.a).period(move.wave); break;
        case MOTION_SWING:
            word("swing").word(actor.name).word("axis").vector(move.a).word("angle").number(move.amount).period(move.wave);
            break;
        default: word("pulse").word(actor.name).word("by").number(move.amount).period(move.wave); break;
        }
        end();
    }
}

void Writer::item(const Model& model, const Actor& actor)
{
    const Motion& m = actor.motion;
    const bool eye = actor.number == model.camera.carrier;
    if (eye)
        word("eye").vector(toVector(m.centre));
    else
        word(actor.object == nullptr ? "group" : actor.kind == nullptr ? "sphere" : actor.kind->word).word(actor.name);
    if (actor.object != nullptr) {
        const int measures = actor.kind == nullptr ? 1 : actor.kind->measures;
        for (int i = 0; i < measures; ++i)
            word(actor.kind == nullptr ? "size" : actor.kind->measure[i].word).number(actor.measure[i]);
    }
    if (!eye && !(m.centre == Point{Real(0), Real(0), Real(0)}))
        word("at").vector(toVector(m.centre));
    if (m.parts & MOTION_TURN)
        word("turn").vector(m.turn);
    if (!(actor.stretch == Vector{Real(1), Real(1), Real(1)}))
        word("stretch").vector(actor.stretch);
    if (m.scale != Real(1))
        word("scale").number(m.scale);
    if (actor.object != nullptr)
        word("colour").vector({Real(actor.colour.red), Real(actor.colour.green), Real(actor.colour.blue)});
    const Actor* parent = m.parent == 0 ? nullptr : model.itemNumbered(m.parent);
    if (parent != nullptr)
        word("in").word(parent->name);
    end();
    const Coat& coat = actor.coat;
    if (coat.finish != FINISH_MATT) {
        word("finish").word(actor.name).word(FINISH_WORDS[coat.finish]);
        end();
    }
    if (coat.pattern != PATTERN_NONE) {
        word("pattern").word(actor.name).word(PATTERN_WORDS[coat.pattern]).number(coat.grain);
        vector({Real(coat.colour.red), Real(coat.colour.green), Real(coat.colour.blue)});
        end();
    }
    if (actor.strength != Real(1)) {
        word("strength").word(actor.name).number(actor.strength);
        end();
    }
    if (m.circle.period != Real(0)) {
        word("circle").word(actor.name).word("u").vector(m.u).word("v").vector(m.v).period(m.circle);
        end();
    }
    further(actor, MOTION_CIRCLE);
    if (m.parts & MOTION_PATH) {
        word("path").word(actor.name);
        const Real amplitude[3] = {m.path.x, m.path.y, m.path.z};
        for (int i = 0; i < 3; ++i) {
            if (m.along[i].period == Real(0))
                continue;
            word(i == 0 ? "x" : i == 1 ? "y" : "z").number(amplitude[i]).number(m.along[i].period);
            number(realFromRaw(static_cast<int32_t>(m.along[i].phase >> 16)));
        }
        end();
    }
    further(actor, MOTION_PATH);
    if (m.parts & MOTION_SPIN) {
        word("spin").word(actor.name).word("axis").vector(m.spinAxis).period(m.spin);
        end();
    }
    further(actor, MOTION_SPIN);
    if (m.parts & MOTION_SWING) {
        word("swing").word(actor.name).word("axis").vector(m.swingAxis).word("angle").number(m.swingAngle);
        period(m.swing);
        end();
    }
    further(actor, MOTION_SWING);
    if (m.parts & MOTION_PULSE) {
        word("pulse").word(actor.name).word("by").number(m.pulse).period(m.pulsing);
        end();
    }
    further(actor, MOTION_PULSE);
    for (int i = 0; i < WARP_PARTS; ++i) {
        const Swaying& part = m.warp[i];
        const bool swings = part.wave.period != Real(0);
        if (part.amount == Real(0) && !swings)
            continue;
        word(WARPS[i].word).word(actor.name).number(part.amount);
        if (swings)
            word("swing").number(part.swing).period(part.wave);
        end();
    }
    if (m.keyCount > 0 || m.smooth || m.repeat > 0) {
        word("keys").word(actor.name).word(m.smooth ? "smooth" : "linear");
        if (m.repeat > 0)
            word("repeat").number(realFromRaw(m.repeat));
        word("axis").vector(m.keyAxis);
        end();
    }
    for (int i = 0; i < m.keyCount; ++i) {
        const Key& key = model.keys()[m.firstKey + i];
        word("key").word(actor.name).number(realFromRaw(key.time));
        vector({key.value[0], key.value[1], key.value[2]});
        if (key.value[3] != Real(0))
            word("angle").number(key.value[3]);
        if (key.value[4] != Real(1))
            word("scale").number(key.value[4]);
        end();
    }
}

bool Writer::write(const Model& model)
{
    if (model.title[0] != 0) {
        word("title").word(model.title);
        end();
    }
    const Camera& camera = model.camera;
    if (camera.carrier == 0) {
        word("eye").vector(toVector(camera.eye));
        end();
    }
    if (camera.looks == Camera::AT_POINT) {
        word("look").vector(toVector(camera.target));
        end();
    }
    if (camera.roll != Real(0)) {
        word("roll").number(camera.roll);
        end();
    }
    word("focal").number(camera.focalX).number(camera.focalY);
    end();
    word("light").vector(model.light);
    end();
    if (model.mixed) {
        word("colours").word("mixed");
        end();
    }
    for (int i = 0; i < model.items(); ++i)
        item(model, model.item(i));
    const Actor* seen = camera.looks == Camera::AT_ITEM ? model.itemNumbered(camera.item) : nullptr;
    if (seen != nullptr) {
        word("look").word(seen->name);
        end();
    }

    for (int i = 0; i < model.count(); ++i) {
        const Actor& dug = model.actor(i);
        for (const List<Link>::Node* node = dug.object->dents().first(); node != nullptr; node = node->next) {
            word("dent").word(dug.name).word(model.itemNumbered(node->item.object->number())->name);
            if (node->item.weight != Real(1))
                number(node->item.weight);
            end();
        }
    }

    // Links: one line where all are alike, else one for each.
    Real common(1), weight;
    bool alike = model.count() > 1;
    for (int i = 0; i < model.count(); ++i) {
        for (int j = 0; j < i && alike; ++j) {
            alike = Model::linked(model.actor(i).object, model.actor(j).object, &weight);
            if (i == 1)
                common = weight;
            alike = alike && weight == common;
        }
    }
    if (alike) {
        word("blend").word("all");
        if (common != Real(1))
            number(common);
        end();
        return good_;
    }
    for (int i = 0; i < model.count(); ++i) {
        for (int j = 0; j < i; ++j) {
            if (!Model::linked(model.actor(i).object, model.actor(j).object, &weight))
                continue;
            word("blend").word(model.actor(i).name).word(model.actor(j).name);
            if (weight != Real(1))
                number(weight);
            end();
        }
    }
    return good_;
}

bool putToFile(void* to, const char* line)
{
    return machine::writeFile(*static_cast<int*>(to), line, static_cast<uint32_t>(strlen(line))) >= 0;
}

}  // namespace

const char* readScene(const char* name, Model& model, SceneEnd* end)
{
    // WALK is as good as WALK.FB; what is there under the name as it was given comes first.
    static const char* const ENDINGS[] = {".FB", ".fb"};
    int file = machine::openFile(name);
    const char* trouble = machine::fileTrouble();
    char longer[PLAIN_ROOM];
    const size_t length = strlen(name);
    if (file < 0 && length > 0 && length + 4 <= sizeof longer) {
        bool dot = false;
        for (const char* c = name; *c != 0; ++c)
            dot = *c == '.' || (dot && *c != '/' && *c != '\\');
        for (const char* ending : ENDINGS) {
            if (dot || file >= 0)
                break;
            strcpy(longer, name);
            strcpy(longer + length, ending);
            file = machine::openFile(longer);
            if (file >= 0)
                name = longer;
        }
    }
    if (file < 0) {
        *end = SCENE_BAD;
        return troubleWith(name, trouble);
    }
    Source source(file);
    const char* wrong = readFrom(name, source, model, end);
    machine::closeFile(file);
    return wrong;
}

const char* readSceneText(const char* name, const char* text, uint32_t length, Model& model, SceneEnd* end)
{
    Source source(text, length);
    return readFrom(name, source, model, end);
}

bool writeSceneText(bool (*put)(void* to, const char* line), void* to, const Model& model)
{
    return Writer(put, to).write(model);
}

const char* writeScene(const char* name, const Model& model)
{
    int file = machine::beginSave(name);
    bool good = file >= 0;
    if (good) {
        good = writeSceneText(putToFile, &file, model);
        good = machine::endSave(file, good);
    }
    return good ? nullptr : troubleWith(name, machine::fileTrouble());
}
