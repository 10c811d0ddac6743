// Feeds mutated scene files to the reader, in process, and asks of each:
//
//   - it is read, or refused with one line that fits a screen and names the file;
//   - what was read is moved about in time, written, and read again: the same objects at the same places, and the same
//     text the second time.
//
//   fuzz COUNT SEED FILE...     COUNT files made from the FILEs; the same ones for the same seed
//   fuzz --draw COUNT SEED FILE...   the same, and every one in sixteen that is read is settled and drawn as well
//
// Crashes, undefined behaviour and leaks are for the sanitizers to find, with which this is built; an input that takes
// longer than ten seconds counts as a hang. What fails is left in build/fuzzfail.fb.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>
#include <vector>

#include "model/field.h"
#include "model/scene.h"
#include "math/normal.h"
#include "surface/engine.h"
#include "surface/voxel.h"

namespace {

uint64_t state;

uint64_t next()
{
    uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

size_t below(size_t n) { return n == 0 ? 0 : static_cast<size_t>(next() % n); }

// Words of the language, and things that are almost so.
const char* const WORDS[] = {
    "sphere", "cylinder", "torus", "disc", "cone", "group", "blend", "circle", "path", "spin", "swing", "pulse", "keys",
    "key", "eye", "focal", "light", "all", "size", "length", "ring", "tip", "at", "turn", "in", "colour", "scale",
    "radius", "plane", "xy", "zx", "u", "v", "period", "phase", "x", "y", "z", "axis", "angle", "by", "linear", "smooth",
    "repeat", "a", "b", "c", "0", "1", "-1", "0.1", "-0.1", "250", "-250", "250.000016", "100", "100.00001", "0.000001",
    "32767.999999", "32768", "-32768", "99999999999999999999", "3600", "0.5", ".", "-", "1e5", "0x10", "360", "4", "0.0625",
    "#", "\r", "\n", "\r\n", "\x1a", "\t", " ", "\xff", "aaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa",
    "sphere a size 10\n", "group g\n", "key a 1 2 3 4\n", "blend all\n", "spin a axis 0 1 0 period 1\n",
};
constexpr size_t WORD_COUNT = sizeof WORDS / sizeof WORDS[0];

// A random piece of `from` that begins and ends at blanks or line ends if `words`.
std::string piece(const std::string& from, bool line)
{
    if (from.empty())
        return from;
    size_t start = below(from.size());
    if (line) {
        while (start > 0 && from[start - 1] != '\n')
            --start;
        size_t end = start;
        for (size_t lines = 1 + below(4); lines > 0 && end < from.size(); --lines) {
            while (end < from.size() && from[end] != '\n')
                ++end;
            end += end < from.size();
        }
        return from.substr(start, end - start);
    }
    return from.substr(start, 1 + below(40));
}

// A word of the text: where it begins, and its length.
bool findWord(const std::string& text, size_t* at, size_t* length)
{
    if (text.empty())
        return false;
    size_t i = below(text.size());
    const auto blank = [&](size_t k) { return strchr(" \t\r\n", text[k]) != nullptr && text[k] != 0; };
    while (i < text.size() && blank(i))
        ++i;
    if (i == text.size())
        return false;
    size_t start = i, end = i;
    while (start > 0 && !blank(start - 1))
        --start;
    while (end < text.size() && !blank(end))
        ++end;
    *at = start;
    *length = end - start;
    return true;
}

std::string number()
{
    char text[40];
    switch (below(4)) {
    case 0: snprintf(text, sizeof text, "%d", static_cast<int>(below(300)) - 100); break;
    case 1: snprintf(text, sizeof text, "%.3f", static_cast<double>(below(600000)) / 1000 - 300); break;
    case 2: snprintf(text, sizeof text, "%.6f", static_cast<double>(below(10000000)) / 1000000); break;
    default: snprintf(text, sizeof text, "%llu", static_cast<unsigned long long>(next() >> below(64))); break;
    }
    return text;
}

void mutate(std::string& text, const std::vector<std::string>& pool)
{
    const std::string& other = pool[below(pool.size())];
    const size_t at = below(text.size() + 1);
    size_t word, length;
    switch (below(14)) {
    case 0:
        if (!text.empty())
            text[below(text.size())] = static_cast<char>(next());
        break;
    case 1:
        if (!text.empty())
            text[below(text.size())] ^= static_cast<char>(1 << below(8));
        break;
    case 2: text.insert(at, 1, static_cast<char>(next())); break;
    case 3: text.erase(at, 1 + below(30)); break;
    case 4: text.insert(at, piece(text, false)); break;
    case 5: text.insert(at, piece(other, false)); break;
    case 6:
    case 7: {
        size_t line = at;
        while (line > 0 && text[line - 1] != '\n')
            --line;
        text.insert(line, piece(below(2) ? other : text, true));
        break;
    }
    case 8:
        if (findWord(text, &word, &length))
            text.replace(word, length, WORDS[below(WORD_COUNT)]);
        break;
    case 9:
        if (findWord(text, &word, &length))
            text.replace(word, length, number());
        break;
    case 10:
        if (findWord(text, &word, &length))
            text.erase(word, length);
        break;
    case 11: text.insert(at, std::string(" ") + WORDS[below(WORD_COUNT)] + " "); break;
    case 12:
        if (below(8) == 0)
            text.resize(at);
        else if (below(16) == 0)
            text.insert(at, std::string(below(600), below(2) ? '7' : ' '));
        break;
    default: {
        // A line to another place.
        std::string moved = piece(text, true);
        const size_t from = text.find(moved);
        if (!moved.empty() && from != std::string::npos) {
            text.erase(from, moved.size());
            size_t line = below(text.size() + 1);
            while (line > 0 && text[line - 1] != '\n')
                --line;
            text.insert(line, moved);
        }
        break;
    }
    }
    if (text.size() > 20000)
        text.resize(20000);
}

std::string current;
volatile unsigned long round_ = 0, roundSeen = 0;

[[noreturn]] void failed(const char* what)
{
    FILE* file = fopen("build/fuzzfail.fb", "wb");
    if (file != nullptr) {
        fwrite(current.data(), 1, current.size(), file);
        fclose(file);
    }
    printf("FAILED: input %lu: %s (kept in build/fuzzfail.fb)\n", round_, what);
    fflush(stdout);
    _exit(1);
}

void onAlarm(int)
{
    if (round_ == roundSeen)
        failed("a hang");
    roundSeen = round_;
    alarm(10);
}

// The sanitizers stop the program by way of this: the input is kept.
extern "C" void __sanitizer_set_death_callback(void (*callback)(void));
void onDeath()
{
    FILE* file = fopen("build/fuzzfail.fb", "wb");
    if (file != nullptr) {
        fwrite(current.data(), 1, current.size(), file);
        fclose(file);
    }
}

bool putLine(void* to, const char* line)
{
    if (strlen(line) > static_cast<size_t>(LINE_MOST) + 1)
        failed("a written line is too long");
    static_cast<std::string*>(to)->append(line);
    return true;
}

const Time TIMES[] = {0, 65536 / 10, 65536 * 3 + 777, 12345678, 65536ull * 3599, 65536ull * 86400 * 30, 0xffffffffffffull};

void draw(Model& model)
{
    static VoxelList list;
    static uint8_t ramp[64 + 2 * SHADING_MOST];
    for (int i = 0; i < model.count(); ++i)
        model.actor(i).object->setRamp(ramp + SHADING_MOST);
    if (!model.resample(Real(6), below(4) == 0 ? makeReport98 : makeEngine))
        failed("no memory for seeds");
    Counts counts{};
    for (Time time : TIMES) {
        Anim::move(model, time);
        const FrameContext frame{model.camera.eye, unit(model.light), model.bodies(), &counts};
        if (frame.bodies == nullptr)
            failed("no memory for bodies");
        for (int i = 0; i < model.count(); ++i)
            model.actor(i).object->update(frame);
        for (int i = 0; i < model.count(); ++i) {
            int next = 0;
            do
                model.actor(i).object->draw(frame, list, VOXELS_AT_ONCE, &next);
            while (next != 0);
        }
    }
}

}  // namespace

int main(int count, char** arguments)
{
    const bool draws = count > 1 && strcmp(arguments[1], "--draw") == 0;
    if (draws) {
        --count;
        ++arguments;
    }
    if (count < 4) {
        fputs("usage: fuzz [--draw] COUNT SEED FILE...\n", stderr);
        return 2;
    }
    const unsigned long rounds = strtoul(arguments[1], nullptr, 10);
    state = strtoull(arguments[2], nullptr, 10);
    std::vector<std::string> pool;
    for (int i = 3; i < count; ++i) {
        FILE* file = fopen(arguments[i], "rb");
        if (file == nullptr) {
            fprintf(stderr, "fuzz: cannot read %s\n", arguments[i]);
            return 2;
        }
        std::string text;
        for (int c = getc(file); c != EOF; c = getc(file))
            text += static_cast<char>(c);
        fclose(file);
        pool.push_back(text);
    }
    const size_t given = pool.size();
    makeFieldSteps();
    makeNormalTable();
    signal(SIGALRM, onAlarm);
    alarm(10);
    __sanitizer_set_death_callback(onDeath);

    unsigned long taken = 0, refused = 0, drawn = 0;
    for (round_ = 0; round_ < rounds; ++round_) {
        // Half from the files as given, so that what lives on does not take over.
        current = pool[below(below(2) ? given : pool.size())];
        // The files themselves come first, unchanged.
        if (round_ < given)
            current = pool[round_];
        else
            for (size_t i = 1 + below(6); i > 0; --i)
                mutate(current, pool);
        Model model;
        SceneEnd end = SCENE_GOOD;
        const char* wrong = readSceneText("FUZZ.FB", current.data(), static_cast<uint32_t>(current.size()), model, &end);
        if (wrong != nullptr) {
            ++refused;
            if (end != SCENE_BAD)
                failed("refused for another reason than the text");
            if (strncmp(wrong, "FUZZ.FB:", 8) != 0 || strstr(wrong, ": expected ") == nullptr)
                failed("the complaint does not say where and what");
            for (const char* c = wrong; *c != 0; ++c)
                if (*c < ' ' || *c > '~' || c - wrong > 300)
                    failed("the complaint is not one line of plain text");
            continue;
        }
        ++taken;
        if (end != SCENE_GOOD)
            failed("read, but the end says otherwise");
        std::string first, second;
        writeSceneText(putLine, &first, model);
        Model again;
        wrong = readSceneText("AGAIN.FB", first.data(), static_cast<uint32_t>(first.size()), again, &end);
        if (wrong != nullptr) {
            puts(wrong);
            failed("what was written is refused");
        }
        writeSceneText(putLine, &second, again);
        if (first != second)
            failed("written twice, and not the same");
        if (model.count() != again.count() || model.items() != again.items() || model.keyCount() != again.keyCount())
            failed("not as many objects, groups or keys when read again");
        for (Time time : TIMES) {
            Anim::move(model, time);
            Anim::move(again, time);
            for (int i = 0; i < model.items(); ++i) {
                const Pose &a = model.item(i).pose, &b = again.item(i).pose;
                if (!(a.place == b.place) || a.scale != b.scale || memcmp(&a.turn, &b.turn, sizeof a.turn) != 0)
                    failed("moves in another way when read again");
                if (absolute(a.place.x) > Real(SPACE) || absolute(a.place.y) > Real(SPACE) || absolute(a.place.z) > Real(SPACE))
                    failed("left the space of the model");
            }
        }
        if (draws && below(16) == 0) {
            ++drawn;
            draw(model);
        }
        // Some of what is taken lives on, so that changes add up.
        if (below(8) == 0) {
            if (pool.size() < given + 400)
                pool.push_back(current);
            else
                pool[given + below(400)] = current;
        }
    }
    printf("%lu files: %lu read, written and read again, %lu refused, %lu drawn\n", rounds, taken, refused, drawn);
    return 0;
}
