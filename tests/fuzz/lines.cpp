// Random command lines: parsed in process, and some of them given to the program.
//
//   fuzzline COUNT SEED                  gives COUNT command lines to parseOptions(); the same SEED gives the same lines
//   fuzzline --run DEMO DIR COUNT SEED   runs the program DEMO with COUNT command lines in the folder DIR, where ONE.FB is a scene
//
// Half of the lines consist of valid switches; for these every value that the program reads is known and is compared. The
// other lines have slips or consist of random bytes. A complaint must be one line of plain text that begins with an
// argument. The program must end by itself, with status 0, 1 or 2; with status 2 it must not have played anything.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "app/options.h"
#include "math/text.h"
#include "scenes.h"

namespace {

// A command line, and the options it asks for if it is valid.
struct Line {
    std::vector<std::string> words;
    Options wanted;
    std::string dump, model, record, film;
    bool good = true;
};

class Maker {
public:
    explicit Maker(Random& random) : random_(random) {}

    Line make()
    {
        line_ = Line();
        slips_ = random_.once(2);
        for (size_t words = random_.below(7); words > 0; --words)
            word();
        if (slips_ && random_.once(2) && !line_.words.empty())
            spoil(random_.pick(line_.words));
        return line_;
    }

private:
    Random& random_;
    Line line_;
    bool slips_ = false;

    bool slip() { return slips_ && random_.once(12); }

    // Adds one word to the line: several switches, or the name of the scene.
    void word()
    {
        std::string word;
        if (random_.once(12) && line_.model.empty()) {
            word = name(false);
            line_.model = word;
            scene_ = true;
        } else {
            for (size_t switches = random_.once(3) ? 1 + random_.below(4) : 1; switches > 0; --switches)
                if (!one(word))
                    break;
        }
        line_.words.push_back(word);
    }

    bool scene_ = false;

    // Appends one switch to the word. Returns false when nothing can follow the switch.
    bool one(std::string& word)
    {
        word += word.empty() && random_.once(3) ? '-' : '/';
        const char* const flags = "IGPVXB?";
        const char* const numbers = "SNRTF";
        const char* const names = "DMOA";
        const size_t kind = random_.below(10);
        if (slip()) {
            // No switch has one of these letters; a letter that becomes a switch must be removed here.
            word += "QWZ!0~\x80"[random_.below(7)];
            line_.good = false;
            return true;
        }
        if (kind < 4) {
            const size_t which = random_.below(7);
            put(word, flags[which]);
            Options& o = line_.wanted;
            (which == 0 ? o.interactive : which == 1 ? o.grey : which == 2 ? o.report98 : which == 3 ? o.retrace
                                                                       : which == 4 ? o.noPresent
                                                                       : which == 5 ? o.benchmark : o.help) = true;
            if (slip()) {
                word += random_.once(2) ? ":1" : "x";
                line_.good = false;
            }
            return true;
        }
        if (kind < 9) {
            number(word, numbers[kind - 4]);
            return true;
        }
        // Only one scene is allowed.
        char which = names[random_.below(4)];
        which = scene_ && which == 'M' ? 'D' : which;
        put(word, which);
        word += random_.once(3) ? '=' : ':';
        if (slip()) {
            line_.good = false;
            return false;
        }
        // Only a film may replace an existing file; the other names here must be new.
        const std::string value = (which == 'A' ? "f" : "") + name(true);
        word += value;
        (which == 'D' ? line_.dump : which == 'M' ? line_.model : which == 'A' ? line_.film : line_.record) = value;
        scene_ = scene_ || which == 'M';
        return false;
    }

    void put(std::string& word, char letter) { word += random_.once(2) && letter >= 'A' ? static_cast<char>(letter | 32) : letter; }

    void number(std::string& word, char letter)
    {
        put(word, letter);
        // A number may follow its switch directly (/S2) or after a mark (/S:2 and /S=2).
        const size_t mark = random_.below(3);
        word += mark == 0 ? "" : mark == 1 ? ":" : "=";
        char text[40];
        if (slip()) {
            line_.good = false;
            static const char* const BAD[] = {"",     "0",        "-1",       "x",       "1x",    "9999999999",
                                              "0.2",  "8.01",     "10000000", "1e1",     "86401", "1001",
                                              "0x10", "\xb2\x07", "+",        "1.2.3.4", ":",     "="};
            // A number that is out of range for one switch may be valid for another.
            std::string bad = random_.pick(BAD);
            if ((letter == 'S' && bad == "1001") || (letter == 'N' && (bad == "86401" || bad == "1001")) ||
                (letter == 'T' && bad == "1001"))
                bad = "none";
            word += bad;
            return;
        }
        Options& o = line_.wanted;
        switch (letter) {
        case 'S': {
            // Sixteenths are exact in binary and in six decimals.
            const int sixteenths = 4 + static_cast<int>(random_.below(125));
            snprintf(text, sizeof text, "%.*f", random_.once(2) && sixteenths % 16 == 0 ? 0 : 4, sixteenths / 16.0);
            o.spacing = Real(sixteenths) / Real(16);
            word += sixteenths < 16 && random_.once(2) ? text + 1 : text;
            return;
        }
        case 'N': o.frames = limited(FRAMES_MOST); break;
        case 'R':
            o.rate = limited(RATE_MOST);
            o.rateGiven = true;
            break;
        case 'F': o.hold = limited(HOLD_MOST); break;
        default: o.seconds = limited(SECONDS_MOST); break;
        }
        snprintf(text, sizeof text, random_.once(6) ? "%03d" : "%d",
                 letter == 'N'   ? o.frames
                 : letter == 'R' ? o.rate
                 : letter == 'F' ? o.hold
                                 : o.seconds);
        word += text;
    }

    int32_t limited(int32_t most)
    {
        return random_.once(4) ? (random_.once(2) ? 1 : most) : 1 + static_cast<int32_t>(random_.below(static_cast<size_t>(most)));
    }

    // Returns a file name: any non-empty text behind a switch; a name that stands alone must not look like a switch.
    std::string name(bool behindSwitch)
    {
        static const char* const NAMES[] = {"ONE.FB", "one", "ONE", "none", "out", "a/b", "R.CSV", "a b", "\xc3\xa4\n", "x:y", "."};
        std::string name = random_.pick(NAMES);
        if (random_.once(10))
            name = std::string(1 + random_.below(300), 'n') + name;
        if (behindSwitch && random_.once(8))
            name = "/G" + name;
        return name;
    }

    // Changes bytes at random places, to any value except the terminating 0.
    void spoil(std::string& word)
    {
        line_.good = false;
        spoiled_ = true;
        for (size_t times = 1 + random_.below(4); times > 0; --times) {
            const size_t at = random_.below(word.size() + 1);
            const char byte = static_cast<char>(1 + random_.below(255));
            if (at == word.size() || random_.once(2))
                word.insert(at, random_.once(20) ? 200 : 1, byte);
            else if (random_.once(2))
                word.erase(at, 1);
            else
                word[at] = byte;
        }
    }

public:
    // Tells whether the last line was spoiled; a spoiled line may still be valid.
    bool spoiled_ = false;
    void begin()
    {
        spoiled_ = false;
        scene_ = false;
    }
};

Line line;
unsigned long round_ = 0;

[[noreturn]] void failed(const char* what, const char* said)
{
    printf("FAILED: line %lu: %s\n  said: %s\n", round_, what, said == nullptr ? "nothing" : said);
    for (const std::string& word : line.words) {
        char plain[400];
        printf("  %s\n", plainText(plain, sizeof plain, word.c_str()));
    }
    fflush(stdout);
    _exit(1);
}

bool plain(const char* text, size_t length)
{
    for (size_t i = 0; i < length; ++i)
        if (text[i] < ' ' || text[i] > '~')
            return false;
    return true;
}

bool sameName(const char* a, const std::string& b)
{
    return a == nullptr ? b.empty() : b == a;
}

std::vector<char*> pointers(const char* program)
{
    static std::vector<std::string> kept;
    kept = line.words;
    std::vector<char*> all{const_cast<char*>(program)};
    for (std::string& word : kept)
        all.push_back(&word[0]);
    all.push_back(nullptr);
    return all;
}

void parse(bool spoiled, unsigned long* good, unsigned long* refused)
{
    std::vector<char*> arguments = pointers("demo");
    Options options;
    const char* said = parseOptions(static_cast<int>(arguments.size()) - 1, arguments.data(), &options);
    if (said == nullptr) {
        ++*good;
        if (!line.good && !spoiled)
            failed("a bad line was taken", said);
        if (options.spacing < SPACING_LEAST || options.spacing > SPACING_MOST || options.frames < 0 ||
            options.frames > FRAMES_MOST || options.seconds < 0 || options.seconds > SECONDS_MOST || options.rate < 1 ||
            options.rate > RATE_MOST || options.hold < 0 || options.hold > HOLD_MOST)
            failed("out of range", said);
        const Options& w = line.wanted;
        const int32_t seconds = w.benchmark && w.seconds == 0 && w.frames == 0 ? BENCHMARK_SECONDS : w.seconds;
        if (line.good && (options.interactive != w.interactive || options.grey != w.grey || options.report98 != w.report98 ||
                          options.help != w.help || options.retrace != w.retrace || options.noPresent != w.noPresent ||
                          options.spacing != w.spacing || options.frames != w.frames || options.seconds != seconds ||
                          options.benchmark != w.benchmark || options.rate != w.rate || options.hold != w.hold ||
                          options.rateGiven != w.rateGiven || !sameName(options.dumpDirectory, line.dump) ||
                          !sameName(options.modelFile, line.model) || !sameName(options.recordFile, line.record) ||
                          !sameName(options.filmFile, line.film)))
            failed("read as something else", said);
        return;
    }
    ++*refused;
    if (line.good)
        failed("a good line was refused", said);
    if (!plain(said, strlen(said)) || strlen(said) > 240)
        failed("what it says is not one line of plain text", said);
    bool named = false;
    for (const std::string& word : line.words) {
        char text[90];
        plainText(text, sizeof text, word.c_str());
        named = named || (strncmp(said, text, strlen(text)) == 0 && strncmp(said + strlen(text), ": ", 2) == 0);
    }
    if (!named)
        failed("what it says names no argument", said);
}

std::string read(const char* name)
{
    std::string text;
    FILE* file = fopen(name, "rb");
    if (file == nullptr)
        return text;
    for (int c = getc(file); c != EOF; c = getc(file))
        text += static_cast<char>(c);
    fclose(file);
    return text;
}

// Runs the program; its output is left in files.
void run(const char* program, unsigned long* status)
{
    // The run is kept short whatever the line asks for; an invalid line stays invalid.
    line.words.push_back("/N:1");
    line.words.push_back("/S:8");
    std::vector<char*> arguments = pointers(program);
    const pid_t child = fork();
    if (child == 0) {
        const int out = open(".out", O_WRONLY | O_CREAT | O_TRUNC, 0666), err = open(".err", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        dup2(out, 1);
        dup2(err, 2);
        alarm(30);
        execv(program, arguments.data());
        _exit(99);
    }
    int ended = 0;
    if (child < 0 || waitpid(child, &ended, 0) != child)
        failed("could not be started", nullptr);
    const std::string out = read(".out"), err = read(".err");
    if (!WIFEXITED(ended) || WEXITSTATUS(ended) > 2)
        failed("ended badly", err.c_str());
    const int code = WEXITSTATUS(ended);
    ++status[code];
    // The run has /N and /S, so a frame rate asked for is ignored, and the program says so; and there is no mouse for /I.
    std::string notices = err;
    for (const std::string known : {"No mouse driver found: use Tab, arrows, PgUp and PgDn.\n",
                                    "/F has no effect with /N or /S.\n"})
        if (notices.rfind(known, 0) == 0)
            notices.erase(0, known.size());
    if (code == 0 && !notices.empty())
        failed("a good end, with complaints", err.c_str());
    const char* figures = line.wanted.benchmark ? "(1 frames in " : "frames: 1\n";
    if (code == 0 && out.find(figures) == std::string::npos && !line.wanted.help && line.good)
        failed("no figures", out.c_str());
    if (code != 0 && (err.empty() || err.find('\n') != err.size() - 1 || !plain(err.data(), err.size() - 1)))
        failed("not one line of plain text on standard error", err.c_str());
    if (code == 2 && !out.empty())
        failed("refused, and something on standard output", out.c_str());
}

}  // namespace

int main(int count, char** arguments)
{
    const bool runs = count == 6 && strcmp(arguments[1], "--run") == 0;
    if (!runs && count != 3) {
        fputs("usage: fuzzline COUNT SEED | fuzzline --run DEMO DIR COUNT SEED\n", stderr);
        return 2;
    }
    const unsigned long rounds = strtoul(arguments[runs ? 4 : 1], nullptr, 10);
    Random random(strtoull(arguments[runs ? 5 : 2], nullptr, 10) * 2654435761u + 1);
    char* program = runs ? realpath(arguments[2], nullptr) : nullptr;
    if (runs && (program == nullptr || chdir(arguments[3]) != 0)) {
        fputs("fuzzline: no such program or folder\n", stderr);
        return 2;
    }
    Maker maker(random);
    unsigned long good = 0, refused = 0, status[3] = {0, 0, 0};
    for (round_ = 0; round_ < rounds; ++round_) {
        maker.begin();
        line = maker.make();
        if (runs)
            run(program, status);
        else
            parse(maker.spoiled_, &good, &refused);
    }
    free(program);
    if (runs)
        printf("%lu runs: %lu ended with status 0, %lu with 1, %lu with 2\n", rounds, status[0], status[1], status[2]);
    else
        printf("%lu command lines: %lu taken, %lu refused\n", rounds, good, refused);
    return 0;
}
