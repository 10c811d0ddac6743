// Makes random scenes and random changes of scene texts.
#include "scenes.h"

#include <cstdio>

namespace {

// Words that are used where something else is expected.
const char* const ODD[] = {"", "-", ".", "--1", "1e5", "0x10", "nan", "32768", "-32768", "99999999999999999999", "0.0000001",
                           "+5", "5-", "\x01\x02", "\xc3\xa4", "#", "#ff", "all", "repeat", "sphere", "1,5", "\t7\t"};
constexpr size_t ODD_COUNT = sizeof ODD / sizeof ODD[0];

const char* const COLOURS[] = {"white", "silver", "grey", "gray", "black", "red", "orange", "yellow",
                               "lime", "green", "cyan", "blue", "violet", "magenta", "pink", "brown"};

const char* const FINISHES[] = {"matt", "shiny", "mirror"};
const char* const PATTERNS[] = {"checks", "stripes", "marble"};

const char* const PLANES[] = {"xy", "yz", "zx", "yx", "zy", "xz"};

class Maker {
public:
    Maker(Random& random, size_t slips) : random_(random), slips_(slips) {}

    std::string make()
    {
        const size_t statements = 1 + random_.below(random_.once(6) ? 60 : 14);
        if (random_.once(3))
            title();
        object(false);
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
        double repeat = 0;
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
            word(random_.once(3) ? ODD[random_.below(ODD_COUNT)] : text);
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

    void vector(double most)
    {
        for (int i = 0; i < 3; ++i)
            number(-most, most);
    }

    void direction()
    {
        // The direction is never 0 0 0, because y is at least 1.
        number(-250, 250);
        number(1, 250);
        number(-250, 250);
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
        if (!random_.once(2))
            return;
        word("phase");
        number(-1, 1);
    }

    void lag(const Item& item)
    {
        if (item.count > 1 ? !random_.once(2) : !slip())
            return;
        word("lag");
        number(-1, 1);
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
            return items_.empty() ? "all" : items_[random_.below(items_.size())].name;
        char text[24];
        // Letters follow the number, so that a name made of a row's name and a number is never the name of another item.
        snprintf(text, sizeof text, "n%zu%s", items_.size(), count > 99 ? "-row" : random_.once(3) ? "_longer" : "x");
        return text;
    }

    // Returns the name of an existing item.
    std::string known(const Item& item)
    {
        if (slip())
            return ODD[random_.below(ODD_COUNT)];
        return item.name;
    }

    void colour()
    {
        word(random_.once(2) ? "colour" : "color");
        paint();
    }

    void paint()
    {
        switch (random_.below(3)) {
        case 0: word(slip() ? "reddish" : COLOURS[random_.below(sizeof COLOURS / sizeof COLOURS[0])]); break;
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

    void object(bool group)
    {
        const size_t count = random_.once(5) ? 2 + random_.below(random_.once(12) ? (group ? 62 : 110) : 8) : 1;
        const std::string name = freshName(count);
        size_t kind = 0;
        if (group) {
            word("group");
            word(name);
        } else {
            static const char* const KINDS[] = {"sphere", "cylinder", "torus", "disc", "cone", "box"};
            kind = random_.below(6);
            word(KINDS[kind]);
            word(name);
            word("size");
            number(1, kind == 2 ? 60 : 100);
            if (kind == 1 || kind == 4) {
                word("length");
                number(kind == 4 ? 50 : 0, 100);
            }
            if (kind == 2) {
                word("ring");
                number(38, 100);
            }
            if (kind == 3) {
                word("disc");
                number(0, 100);
            }
            for (const char* edge : {"x", "y", "z"})
                if (kind == 5) {
                    word(edge);
                    number(0, 100);
                }
            if (kind == 4) {
                word("tip");
                number(1, 100);
            }
        }
        bool placed = false;
        for (size_t i = random_.below(4); i > 0; --i) {
            switch (random_.below(6)) {
            case 5:
                // These factors keep the largest object of each kind within 100 units.
                if (!group) {
                    word("stretch");
                    for (int part = 0; part < 3; ++part)
                        number(0.25, kind == 0 ? 2 : 0.66);
                }
                break;
            case 0:
                word("at");
                vector(count > 1 ? 20 : 250);
                placed = true;
                break;
            case 1:
                word("turn");
                vector(360);
                break;
            case 2:
                if (group) {
                    word("scale");
                    number(0.0625, 4);
                } else {
                    colour();
                }
                break;
            case 3: {
                // A parent must not be a row.
                if (random_.once(20)) {
                    word("in");
                    word("eye");
                    eyeMoves();
                    break;
                }
                for (const Item& item : items_) {
                    if (item.count == 1 && random_.once(3)) {
                        word("in");
                        word(known(item));
                        break;
                    }
                }
                break;
            }
            default: break;
            }
        }
        if (count > 1 || slip()) {
            if (!slip()) {
                word("repeat");
                char text[24];
                snprintf(text, sizeof text, slip() ? "%zu.5" : "%zu", count);
                word(text);
            }
            if (random_.once(2)) {
                word("step");
                vector((placed ? 230.0 : 250.0) / double(count));
            }
        }
        end();
        items_.push_back({name, group, count});
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
        word("eye");
        vector(250);
        if (random_.once(3)) {
            word("turn");
            vector(360);
            eyeMoves();
        }
        const size_t known = eyeIsItem_ ? beforeEye_ : items_.size();
        const size_t parent = random_.below(known + 1);
        if (parent < known && items_[parent].count == 1) {
            word("in");
            word(this->known(items_[parent]));
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

    void statement()
    {
        Item& item = items_[random_.below(items_.size())];
        switch (random_.below(20)) {
        case 19: {
            if (item.group && !slip()) {
                object(false);
                return;
            }
            const size_t part = random_.below(3);
            static const char* const WARPS[] = {"taper", "twist", "bend"};
            const double most = part == 0 ? 0.75 : part == 1 ? 360 : 180;
            word(WARPS[part]);
            word(known(item));
            number(-most, most);
            if (random_.once(2)) {
                word("swing");
                number(-most, most);
                lag(item);
                period();
                phase();
            }
            break;
        }
        case 0:
        case 1:
        case 2: object(false); return;
        case 3: object(true); return;
        case 4:
            word("circle");
            word(known(item));
            if (random_.once(2)) {
                word("radius");
                number(0, 250);
                if (random_.once(2)) {
                    word("plane");
                    word(slip() ? "xx" : PLANES[random_.below(6)]);
                }
            } else {
                word("u");
                vector(250);
                word("v");
                vector(250);
            }
            lag(item);
            period();
            phase();
            break;
        case 5:
            word("path");
            word(known(item));
            for (size_t i = 1 + random_.below(3); i > 0; --i) {
                word(std::string(1, "xyz"[random_.below(3)]));
                number(-250, 250);
                seconds();
                number(-1, 1);
            }
            lag(item);
            break;
        case 6:
        case 7: {
            const bool swings = random_.once(2);
            word(swings ? "swing" : "spin");
            word(known(item));
            word("axis");
            direction();
            if (swings) {
                word("angle");
                number(-360, 360);
            }
            period();
            phase();
            lag(item);
            break;
        }
        case 8:
            word("pulse");
            word(known(item));
            word("by");
            number(0, 0.75);
            lag(item);
            period();
            phase();
            break;
        case 9:
            if (item.keyTime >= 0 && !slip())
                return;
            word("keys");
            word(known(item));
            if (random_.once(2))
                word(random_.once(2) ? "smooth" : "linear");
            if (random_.once(2)) {
                word("repeat");
                item.repeat = 3000;
                number(2999.5, 3600);
            }
            if (random_.once(2)) {
                word("axis");
                direction();
            }
            break;
        case 10:
        case 11:
            for (size_t i = 1 + random_.below(4); i > 0; --i) {
                word("key");
                word(known(item));
                char text[32];
                item.keyTime = item.keyTime < 0 ? double(random_.below(3)) : item.keyTime + 0.1 + double(random_.below(100)) / 10;
                if (item.keyTime > 2900)
                    item.keyTime = 2900;
                snprintf(text, sizeof text, "%.3f", item.keyTime);
                word(slip() ? "0" : text);
                vector(250);
                if (random_.once(3)) {
                    word("angle");
                    number(-3600, 3600);
                }
                if (random_.once(3)) {
                    word("scale");
                    number(0.0625, 4);
                }
                end();
            }
            return;
        case 15:
            if (random_.once(3)) {
                word(random_.once(4) ? "colors" : "colours");
                word(random_.once(3) ? "apart" : slip() ? "mixt" : "mixed");
                break;
            }
            if (item.group && !slip())
                return;
            word("finish");
            word(known(item));
            word(slip() ? "gloss" : FINISHES[random_.below(3)]);
            break;
        case 16:
            if (item.group && !slip())
                return;
            word("pattern");
            word(known(item));
            word(slip() ? "none" : PATTERNS[random_.below(3)]);
            number(1, 100);
            paint();
            break;
        case 17:
            if (item.group && !slip())
                return;
            word("strength");
            word(known(item));
            number(0.25, 4);
            break;
        case 12:
        case 18: {
            const bool dents = random_.once(2);
            word(dents ? "dent" : "blend");
            if (!dents && random_.once(4)) {
                word("all");
            } else {
                const Item& other = items_[random_.below(items_.size())];
                if ((item.group || other.group || (&item == &other && item.count == 1)) && !slip()) {
                    line_.clear();
                    return;
                }
                word(known(item));
                word(known(other));
            }
            if (random_.once(2))
                number(0, 4);
            break;
        }
        case 13:
            switch (random_.below(6)) {
            case 0:
                eye();
                break;
            case 1:
                word("look");
                if (random_.once(2) || (item.count > 1 && !slip()))
                    vector(250);
                else
                    word(known(item));
                break;
            case 2:
                word("roll");
                number(-360, 360);
                break;
            case 3:
                // The eye moves as objects do.
                eyeMoves();
                switch (random_.below(4)) {
                case 0:
                    word("circle");
                    word("eye");
                    word("radius");
                    number(0, 250);
                    period();
                    break;
                case 1:
                    word("path");
                    word("eye");
                    word("z");
                    number(-250, 250);
                    seconds();
                    number(-1, 1);
                    break;
                default:
                    word("spin");
                    word("eye");
                    word("axis");
                    direction();
                    period();
                    break;
                }
                break;
            case 4:
                word("focal");
                number(1, 500);
                if (random_.once(2))
                    number(1, 500);
                break;
            default:
                word("light");
                direction();
                break;
            }
            break;
        default:
            // An empty line.
            if (slip())
                word(ODD[random_.below(ODD_COUNT)]);
            break;
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
        const std::vector<Place> words = wordsOf(text), lines = linesOf(text);
        const std::vector<Place> theirs = linesOf(other);
        const Place word = words.empty() ? Place{0, 0} : words[random.below(words.size())];
        const Place line = lines.empty() ? Place{0, 0} : lines[random.below(lines.size())];
        switch (random.below(12)) {
        case 0: text.replace(word.at, word.length, WORDS[random.below(sizeof WORDS / sizeof WORDS[0])]); break;
        case 1: text.replace(word.at, word.length, ODD[random.below(ODD_COUNT)]); break;
        case 2: {
            // Two words are exchanged.
            const Place second = words.empty() ? Place{0, 0} : words[random.below(words.size())];
            if (word.at + word.length <= second.at) {
                const std::string a = text.substr(word.at, word.length), b = text.substr(second.at, second.length);
                text.replace(second.at, second.length, a);
                text.replace(word.at, word.length, b);
            }
            break;
        }
        case 3: text.insert(word.at, std::string(WORDS[random.below(sizeof WORDS / sizeof WORDS[0])]) + " "); break;
        case 4: text.erase(word.at, word.length + (random.once(2) ? 1 : 0)); break;
        case 5: text.insert(line.at, text.substr(line.at, line.length)); break;
        case 6:
            if (!theirs.empty()) {
                const Place from = theirs[random.below(theirs.size())];
                text.insert(line.at, other.substr(from.at, from.length));
            }
            break;
        case 7: {
            const std::string moved = text.substr(line.at, line.length);
            text.erase(line.at, line.length);
            const std::vector<Place> left = linesOf(text);
            text.insert(left.empty() ? 0 : left[random.below(left.size())].at, moved);
            break;
        }
        case 8:
            if (!text.empty())
                text[random.below(text.size())] = static_cast<char>(random.next());
            break;
        case 9: {
            // A digit is added, removed or replaced.
            const size_t digit = text.find_first_of("0123456789", random.below(text.size() + 1));
            if (digit != std::string::npos) {
                const char fresh = static_cast<char>('0' + random.below(10));
                if (random.once(3))
                    text.insert(digit, 1, fresh);
                else if (random.once(2))
                    text.erase(digit, 1);
                else
                    text[digit] = fresh;
            }
            break;
        }
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
