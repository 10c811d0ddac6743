// Makes random scenes and random changes of scene texts.
#include "scenes.h"

#include <cstdio>

namespace {

// Words that are used where something else is expected.
const char* const ODD[] = {"", "-", ".", "--1", "1e5", "0x10", "nan", "32768", "-32768", "99999999999999999999", "0.0000001",
                           "+5", "5-", "\x01\x02", "\xc3\xa4", "#", "#ff", "all", "repeat", "sphere", "1,5", "\t7\t"};

const char* const COLOURS[] = {"white", "silver", "grey", "gray", "black", "red", "orange", "yellow",
                               "lime", "green", "cyan", "blue", "violet", "magenta", "pink", "brown"};

const char* const FINISHES[] = {"matt", "shiny", "mirror"};
const char* const PATTERNS[] = {"checks", "stripes", "marble"};

const char* const PLANES[] = {"xy", "yz", "zx", "yx", "zy", "xz"};

// A kind of object with its measures. No part of a stretch exceeds `stretch`: this and the ranges keep the largest object
// within 100 units.
struct Kind {
    const char* word;
    double stretch;
    struct Measure {
        const char* word;
        double low, high;
    };
    std::vector<Measure> measures;
};
const Kind KINDS[] = {
    {"sphere", 2, {{"size", 1, 100}}},
    {"cylinder", 0.66, {{"size", 1, 100}, {"length", 0, 100}}},
    {"torus", 0.66, {{"size", 1, 60}, {"ring", 38, 100}}},
    {"disc", 0.66, {{"size", 1, 100}, {"disc", 0, 100}}},
    {"cone", 0.66, {{"size", 1, 100}, {"length", 50, 100}, {"tip", 1, 100}}},
    {"box", 0.66, {{"size", 1, 100}, {"x", 0, 100}, {"y", 0, 100}, {"z", 0, 100}}},
};

class Maker {
public:
    Maker(Random& random, size_t slips) : random_(random), slips_(slips) {}

    std::string make()
    {
        const size_t statements = 1 + random_.below(random_.once(6) ? 60 : 14);
        if (random_.once(3))
            title();
        newItem(false);
        for (size_t i = 0; i < statements; ++i)
            statement();
        return text_;
    }

private:
    struct Item {
        std::string name;
        bool group;
        size_t count;  // 1 if the item is not a row
        double keyTime = -1;
    };

    Random& random_;
    const size_t slips_;
    std::string text_, line_;
    std::vector<Item> items_;
    bool eyeIsItem_ = false;
    size_t beforeEye_ = 0;

    bool slip() { return slips_ > 0 && random_.once(slips_); }

    void word(const std::string& w)
    {
        if (!line_.empty())
            line_ += random_.once(12) ? "   " : " ";
        line_ += w;
    }

    void number(double low, double high)
    {
        char text[64];
        if (slip()) {
            const double beyond = random_.once(2) ? 0.00002 : 1 + double(random_.below(1000));
            snprintf(text, sizeof text, "%.6f", random_.once(2) ? low - beyond : high + beyond);
            word(random_.once(3) ? random_.pick(ODD) : text);
            return;
        }
        const double share = random_.once(8) ? double(random_.below(2)) : double(random_.below(1000001)) / 1000000;
        const double value = low + (high - low) * share;
        switch (random_.below(3)) {
        case 0: snprintf(text, sizeof text, "%.6f", value); break;
        case 1: snprintf(text, sizeof text, "%.1f", value); break;
        default: snprintf(text, sizeof text, "%d", static_cast<int>(value)); break;
        }
        // Rounding may have moved the value out of its range.
        double back = 0;
        sscanf(text, "%lf", &back);
        if (back < low || back > high)
            snprintf(text, sizeof text, "%.6f", share == 0 ? low : share == 1 ? high : value);
        word(text);
    }

    void number(const char* before, double low, double high)
    {
        word(before);
        number(low, high);
    }

    void vector(double most)
    {
        for (int i = 0; i < 3; ++i)
            number(-most, most);
    }

    void vector(const char* before, double most)
    {
        word(before);
        vector(most);
    }

    void direction()
    {
        // The direction is never 0 0 0, because y is at least 1.
        number(-250, 250);
        number(1, 250);
        number(-250, 250);
    }

    void axis()
    {
        word("axis");
        direction();
    }

    void period()
    {
        word("period");
        seconds();
    }

    void seconds()
    {
        const double most = random_.once(3) ? 3600 : 12;
        if (random_.once(3))
            number(-most, -0.1001);
        else
            number(0.1001, most);
    }

    void phase()
    {
        if (random_.once(2))
            number("phase", -1, 1);
    }

    void lag(const Item& item)
    {
        if (item.count > 1 ? random_.once(2) : slip())
            number("lag", -1, 1);
    }

    void wave(const Item& item)
    {
        lag(item);
        period();
        phase();
    }

    void end()
    {
        for (char& c : line_)
            if (c >= 'a' && c <= 'z' && random_.once(200))
                c = static_cast<char>(c - 32);
        if (random_.once(20))
            line_ += " # a comment, #ff0000 and all";
        text_ += line_;
        text_ += random_.once(10) ? "\r\n" : "\n";
        line_.clear();
    }

    std::string freshName(size_t count)
    {
        if (slip())
            return items_.empty() ? "all" : random_.pick(items_).name;
        char text[24];
        // Letters follow the number, so that a name made of a row's name and a number is never the name of another item.
        snprintf(text, sizeof text, "n%zu%s", items_.size(), count > 99 ? "-row" : random_.once(3) ? "_longer" : "x");
        return text;
    }

    // Returns the name of an existing item.
    std::string known(const Item& item) { return slip() ? random_.pick(ODD) : item.name; }

    // Begins a statement about an item.
    void about(const char* statement, const Item& item)
    {
        word(statement);
        word(known(item));
    }

    // Returns whether to make a statement that is for objects only: with a group it would be a slip.
    bool asObject(const Item& item) { return !item.group || slip(); }

    void colour()
    {
        word(random_.once(2) ? "colour" : "color");
        paint();
    }

    void paint()
    {
        switch (random_.below(3)) {
        case 0: word(slip() ? "reddish" : random_.pick(COLOURS)); break;
        case 1: {
            char text[16];
            snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(random_.below(1 << 24)));
            word(slip() ? std::string(text).substr(0, random_.below(7)) : text);
            break;
        }
        default:
            for (int i = 0; i < 3; ++i)
                number(0, 255);
            break;
        }
    }

    // Makes a new item, a group or an object.
    void newItem(bool group)
    {
        const size_t count = random_.once(5) ? 2 + random_.below(random_.once(12) ? (group ? 62 : 110) : 8) : 1;
        const std::string name = freshName(count);
        const Kind* kind = group ? nullptr : &random_.pick(KINDS);
        word(group ? "group" : kind->word);
        word(name);
        if (!group)
            for (const Kind::Measure& measure : kind->measures)
                number(measure.word, measure.low, measure.high);
        bool placed = false;
        for (size_t i = random_.below(4); i > 0; --i)
            placed = property(kind, count) || placed;
        if (count > 1 || slip())
            row(count, placed ? 230 : 250);
        end();
        items_.push_back({name, group, count});
    }

    // Adds a property, or none, to a new item; a group has no kind. Returns whether the property is its place.
    bool property(const Kind* kind, size_t count)
    {
        switch (random_.below(6)) {
        case 0: vector("at", count > 1 ? 20 : 250); return true;
        case 1: vector("turn", 360); break;
        case 2:
            if (kind == nullptr)
                number("scale", 0.0625, 4);
            else
                colour();
            break;
        case 3: parent(); break;
        case 5:
            if (kind != nullptr) {
                word("stretch");
                for (int part = 0; part < 3; ++part)
                    number(0.25, kind->stretch);
            }
            break;
        default: break;
        }
        return false;
    }

    void parent()
    {
        if (random_.once(20)) {
            word("in");
            word("eye");
            eyeMoves();
            return;
        }
        // A parent must not be a row.
        for (const Item& item : items_) {
            if (item.count == 1 && random_.once(3)) {
                about("in", item);
                return;
            }
        }
    }

    void row(size_t count, double length)
    {
        if (!slip()) {
            word("repeat");
            char text[24];
            snprintf(text, sizeof text, slip() ? "%zu.5" : "%zu", count);
            word(text);
        }
        if (random_.once(2))
            vector("step", length / double(count));
    }

    // From the first line that moves the eye, the eye is an item; its parents must come before that line.
    void eyeMoves()
    {
        if (!eyeIsItem_)
            beforeEye_ = items_.size();
        eyeIsItem_ = true;
    }

    void eye()
    {
        vector("eye", 250);
        if (random_.once(3)) {
            vector("turn", 360);
            eyeMoves();
        }
        const size_t parents = eyeIsItem_ ? beforeEye_ : items_.size();
        const size_t parent = random_.below(parents + 1);
        if (parent < parents && items_[parent].count == 1) {
            about("in", items_[parent]);
            eyeMoves();
        } else if (slip()) {
            word("in");
            word("eye");
        }
    }

    void title()
    {
        word("title");
        const size_t length = slip() ? random_.below(80) : 1 + random_.below(40);
        std::string words;
        for (size_t i = 0; i < length; ++i)
            words += slip() ? static_cast<char>(random_.next()) : static_cast<char>(i == 0 ? 'A' : " aBc,.!-7"[random_.below(9)]);
        for (char& c : words)
            if (c == '\n' || c == '\r' || c == '\x1a')
                c = '?';
        line_ += " " + words;
        text_ += line_ + "\n";
        line_.clear();
    }

    // Makes a statement: the oftener it stands in the table, the more there are. Each ends its lines itself, as some have none.
    void statement()
    {
        static constexpr void (Maker::*STATEMENTS[])(Item&) = {
            &Maker::object, &Maker::object, &Maker::object, &Maker::group, &Maker::circle, &Maker::path, &Maker::turning,
            &Maker::turning, &Maker::pulse, &Maker::keys, &Maker::key, &Maker::key, &Maker::link, &Maker::view,
            &Maker::nothing, &Maker::finish, &Maker::pattern, &Maker::strength, &Maker::link, &Maker::warp};
        Item& item = random_.pick(items_);
        (this->*random_.pick(STATEMENTS))(item);
    }

    void object(Item&) { newItem(false); }
    void group(Item&) { newItem(true); }

    void circle(Item& item)
    {
        about("circle", item);
        if (random_.once(2)) {
            number("radius", 0, 250);
            if (random_.once(2)) {
                word("plane");
                word(slip() ? "xx" : random_.pick(PLANES));
            }
        } else {
            vector("u", 250);
            vector("v", 250);
        }
        wave(item);
        end();
    }

    void path(Item& item)
    {
        about("path", item);
        for (size_t i = 1 + random_.below(3); i > 0; --i) {
            word(std::string(1, "xyz"[random_.below(3)]));
            number(-250, 250);
            seconds();
            number(-1, 1);
        }
        lag(item);
        end();
    }

    void turning(Item& item)
    {
        const bool swings = random_.once(2);
        about(swings ? "swing" : "spin", item);
        axis();
        if (swings)
            number("angle", -360, 360);
        period();
        phase();
        lag(item);
        end();
    }

    void pulse(Item& item)
    {
        about("pulse", item);
        number("by", 0, 0.75);
        wave(item);
        end();
    }

    void keys(Item& item)
    {
        if (item.keyTime >= 0 && !slip())
            return;
        about("keys", item);
        if (random_.once(2))
            word(random_.once(2) ? "smooth" : "linear");
        if (random_.once(2))
            number("repeat", 2999.5, 3600);
        if (random_.once(2))
            axis();
        end();
    }

    void key(Item& item)
    {
        for (size_t i = 1 + random_.below(4); i > 0; --i) {
            about("key", item);
            char text[32];
            item.keyTime = item.keyTime < 0 ? double(random_.below(3)) : item.keyTime + 0.1 + double(random_.below(100)) / 10;
            if (item.keyTime > 2900)
                item.keyTime = 2900;
            snprintf(text, sizeof text, "%.3f", item.keyTime);
            word(slip() ? "0" : text);
            vector(250);
            if (random_.once(3))
                number("angle", -3600, 3600);
            if (random_.once(3))
                number("scale", 0.0625, 4);
            end();
        }
    }

    void link(Item& item)
    {
        const bool dents = random_.once(2);
        word(dents ? "dent" : "blend");
        if (!dents && random_.once(4)) {
            word("all");
        } else {
            const Item& other = random_.pick(items_);
            if ((item.group || other.group || (&item == &other && item.count == 1)) && !slip()) {
                line_.clear();
                return;
            }
            word(known(item));
            word(known(other));
        }
        if (random_.once(2))
            number(0, 4);
        end();
    }

    void view(Item& item)
    {
        switch (random_.below(6)) {
        case 0: eye(); break;
        case 1:
            word("look");
            if (random_.once(2) || (item.count > 1 && !slip()))
                vector(250);
            else
                word(known(item));
            break;
        case 2: number("roll", -360, 360); break;
        case 3: eyeMotion(); break;
        case 4:
            number("focal", 1, 500);
            if (random_.once(2))
                number(1, 500);
            break;
        default:
            word("light");
            direction();
            break;
        }
        end();
    }

    // The eye moves as objects do.
    void eyeMotion()
    {
        eyeMoves();
        const size_t motion = random_.below(4);
        word(motion == 0 ? "circle" : motion == 1 ? "path" : "spin");
        word("eye");
        if (motion == 1) {
            number("z", -250, 250);
            seconds();
            number(-1, 1);
            return;
        }
        if (motion == 0)
            number("radius", 0, 250);
        else
            axis();
        period();
    }

    void nothing(Item&)
    {
        if (slip())
            word(random_.pick(ODD));
        end();
    }

    void finish(Item& item)
    {
        if (random_.once(3)) {
            word(random_.once(4) ? "colors" : "colours");
            word(random_.once(3) ? "apart" : slip() ? "mixt" : "mixed");
        } else {
            if (!asObject(item))
                return;
            about("finish", item);
            word(slip() ? "gloss" : random_.pick(FINISHES));
        }
        end();
    }

    void pattern(Item& item)
    {
        if (!asObject(item))
            return;
        about("pattern", item);
        word(slip() ? "none" : random_.pick(PATTERNS));
        number(1, 100);
        paint();
        end();
    }

    void strength(Item& item)
    {
        if (!asObject(item))
            return;
        about("strength", item);
        number(0.25, 4);
        end();
    }

    void warp(Item& item)
    {
        if (!asObject(item)) {
            object(item);
            return;
        }
        const size_t part = random_.below(3);
        static const char* const WARPS[] = {"taper", "twist", "bend"};
        const double most = part == 0 ? 0.75 : part == 1 ? 360 : 180;
        about(WARPS[part], item);
        number(-most, most);
        if (random_.once(2)) {
            number("swing", -most, most);
            wave(item);
        }
        end();
    }
};

// Words of the language, for random changes.
const char* const WORDS[] = {
    "colours", "mixed", "finish", "shiny", "mirror", "pattern", "checks", "stripes", "marble",
    "sphere", "cylinder", "torus", "disc", "cone", "box", "group", "blend", "dent", "strength", "circle", "path", "spin",
    "swing", "pulse", "keys", "key", "eye", "look", "roll", "focal", "light", "title", "all", "size", "length", "ring", "tip",
    "at", "turn", "in", "colour", "color", "red",
    "#12abEF", "scale", "repeat", "step", "lag", "radius", "plane", "xy", "u", "v", "period", "phase", "x", "y", "z", "axis",
    "angle", "by", "linear", "smooth", "0", "1", "2", "-1", "0.1", "128", "250", "-250", "250.00002", "3600", "0.5",
    "32767.999999", "a", "n0x", "n0x1", "\n", "\r\n", "\x1a", "#", "\t",
};

struct Place {
    size_t at, length;
};

// Returns the places of all words of a text.
std::vector<Place> wordsOf(const std::string& text)
{
    std::vector<Place> all;
    for (size_t i = 0; i < text.size();) {
        const size_t start = text.find_first_not_of(" \t\r\n", i);
        if (start == std::string::npos)
            break;
        const size_t end = text.find_first_of(" \t\r\n", start);
        all.push_back({start, (end == std::string::npos ? text.size() : end) - start});
        i = start + all.back().length;
    }
    return all;
}

// Returns the places of all lines, each including its line end.
std::vector<Place> linesOf(const std::string& text)
{
    std::vector<Place> all;
    for (size_t i = 0; i < text.size();) {
        const size_t end = text.find('\n', i);
        const size_t next = end == std::string::npos ? text.size() : end + 1;
        all.push_back({i, next - i});
        i = next;
    }
    return all;
}

// Returns one of the places, or the beginning of the text if there is none.
Place any(Random& random, const std::vector<Place>& places)
{
    return places.empty() ? Place{0, 0} : random.pick(places);
}

// Exchanges two words, if the second one comes later.
void exchange(std::string& text, Place first, Place second)
{
    if (first.at + first.length > second.at)
        return;
    const std::string a = text.substr(first.at, first.length), b = text.substr(second.at, second.length);
    text.replace(second.at, second.length, a);
    text.replace(first.at, first.length, b);
}

void moveLine(Random& random, std::string& text, Place line)
{
    const std::string moved = text.substr(line.at, line.length);
    text.erase(line.at, line.length);
    text.insert(any(random, linesOf(text)).at, moved);
}

// Adds, removes or replaces a digit.
void changeDigit(Random& random, std::string& text)
{
    const size_t digit = text.find_first_of("0123456789", random.below(text.size() + 1));
    if (digit == std::string::npos)
        return;
    const char fresh = static_cast<char>('0' + random.below(10));
    if (random.once(3))
        text.insert(digit, 1, fresh);
    else if (random.once(2))
        text.erase(digit, 1);
    else
        text[digit] = fresh;
}

}  // namespace

uint64_t Random::next()
{
    // The generator is xorshift64*, whose state must never be 0.
    uint64_t x = state_ == 0 ? 0x9e3779b97f4a7c15u : state_;
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    state_ = x;
    return (x * 0x2545f4914f6cdd1du) >> 11;
}

std::string makeScene(Random& random, size_t slips)
{
    return Maker(random, slips).make();
}

void change(Random& random, std::string& text, const std::string& other)
{
    for (size_t times = 1 + random.below(5); times > 0; --times) {
        const std::vector<Place> words = wordsOf(text);
        const Place word = any(random, words), line = any(random, linesOf(text));
        switch (random.below(12)) {
        case 0: text.replace(word.at, word.length, random.pick(WORDS)); break;
        case 1: text.replace(word.at, word.length, random.pick(ODD)); break;
        case 2: exchange(text, word, any(random, words)); break;
        case 3: text.insert(word.at, std::string(random.pick(WORDS)) + " "); break;
        case 4: text.erase(word.at, word.length + (random.once(2) ? 1 : 0)); break;
        case 5: text.insert(line.at, text.substr(line.at, line.length)); break;
        case 6: {
            const Place from = any(random, linesOf(other));
            text.insert(line.at, other.substr(from.at, from.length));
            break;
        }
        case 7: moveLine(random, text, line); break;
        case 8:
            if (!text.empty())
                random.pick(text) = static_cast<char>(random.next());
            break;
        case 9: changeDigit(random, text); break;
        case 10:
            if (random.once(10))
                text.resize(random.below(text.size() + 1));
            else
                text.erase(line.at, line.length);
            break;
        default:
            if (random.once(10))
                text.insert(line.at + random.below(line.length + 1), std::string(1 + random.below(600), "7 x#"[random.below(4)]));
            break;
        }
        if (text.size() > 20000)
            text.resize(20000);
    }
}
