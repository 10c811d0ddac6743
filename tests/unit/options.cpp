// Tests of the command line: every switch works in every spelling, and every bad value is refused with a line that names it.
#include "app/options.h"

#include <cstring>

#include "help.h"
#include "test.h"

namespace {

// Parses a command line that consists of these words.
const char* parse(std::vector<std::string> words, Options* options)
{
    words.insert(words.begin(), "demo");
    static std::vector<std::string> kept;
    kept = words;
    std::vector<char*> pointers;
    for (std::string& word : kept)
        pointers.push_back(&word[0]);
    *options = Options();
    return parseOptions(static_cast<int>(pointers.size()), pointers.data(), options);
}

Options good(const std::vector<std::string>& words)
{
    Options options;
    const char* problem = parse(words, &options);
    if (!CHECK(problem == nullptr))
        note("%s", problem);
    return options;
}

void bad(const std::string& word)
{
    Options options;
    const char* problem = parse({word}, &options);
    if (!CHECK(problem != nullptr)) {
        note("accepted: %s", word.c_str());
        return;
    }
    // The message is one line, which begins with the switch.
    CHECK(std::strchr(problem, '\n') == nullptr);
    if (!CHECK(std::strncmp(problem, word.c_str(), word.size() < 40 ? word.size() : 40) == 0))
        note("%s: %s", word.c_str(), problem);
}

// Tests a switch with / and -, in upper and lower case.
std::vector<std::string> spellings(char letter, const std::string& rest = "")
{
    std::vector<std::string> all;
    for (char lead : {'/', '-'})
        for (char c : {letter, static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + 32 : letter)})
            all.push_back(std::string(1, lead) + c + rest);
    return all;
}

}  // namespace

TEST(defaults)
{
    const Options o = good({});
    CHECK(!o.interactive && !o.grey && !o.report98 && !o.help);
    NEAR(number(o.spacing), 2, 0);
    SAME(o.frames, 0);
    SAME(o.seconds, 0);
    CHECK(o.dumpDirectory == nullptr);
    CHECK(o.modelFile == nullptr);
}

TEST(switches_in_every_spelling)
{
    for (const std::string& s : spellings('I'))
        CHECK(good({s}).interactive);
    for (const std::string& s : spellings('G'))
        CHECK(good({s}).grey);
    for (const std::string& s : spellings('P'))
        CHECK(good({s}).report98);
    for (const std::string& s : spellings('?'))
        CHECK(good({s}).help);
    for (const std::string& s : spellings('S', ":0.5"))
        NEAR(number(good({s}).spacing), 0.5, 0);
    for (const std::string& s : spellings('N', ":600"))
        SAME(good({s}).frames, 600);
    for (const std::string& s : spellings('T', ":60"))
        SAME(good({s}).seconds, 60);
    for (const std::string& s : spellings('D', ":Some/Dir"))
        TEXT(good({s}).dumpDirectory, "Some/Dir");
    for (const std::string& s : spellings('M', ":WALK.TXT"))
        TEXT(good({s}).modelFile, "WALK.TXT");
}

TEST(further_switches)
{
    for (const std::string& s : spellings('V'))
        CHECK(good({s}).retrace);
    for (const std::string& s : spellings('X'))
        CHECK(good({s}).noPresent);
    for (const std::string& s : spellings('O', ":RUNS.CSV"))
        TEXT(good({s}).recordFile, "RUNS.CSV");
    for (const std::string& s : spellings('R', ":70"))
        SAME(good({s}).rate, 70);
    SAME(good({}).rate, 10);
    SAME(good({"/R:1"}).rate, 1);
    SAME(good({"/R:1000"}).rate, 1000);
    for (const std::string& s : spellings('F', ":12"))
        SAME(good({s}).hold, 12);
    SAME(good({}).hold, 0);
    SAME(good({"/F1"}).hold, 1);
    SAME(good({"/F:100/G"}).hold, 100);
    CHECK(good({"/F:10"}).holds() && !good({"/F:10", "/N:5"}).holds() && !good({"/S:2", "/F:10"}).holds() && !good({"/G"}).holds());
    for (const char* word : {"/F", "/F:", "/F:0", "/F:101", "/F:x", "/F:2.5", "/F:-1"})
        bad(word);
    for (const char* word : {"/R", "/R:", "/R:0", "/R:1001", "/R:x", "/O", "/O:", "/V:1", "/X:", "/VX"})
        bad(word);
}

TEST(ranges_to_their_ends)
{
    NEAR(number(good({"/S:0.25"}).spacing), 0.25, 0);
    NEAR(number(good({"/S:8"}).spacing), 8, 0);
    NEAR(number(good({"/S:.25"}).spacing), 0.25, 0);
    SAME(good({"/N:1"}).frames, 1);
    SAME(good({"/N:9999999"}).frames, 9999999);
    SAME(good({"/T:1"}).seconds, 1);
    SAME(good({"/T:86400"}).seconds, 86400);
}

TEST(several_together)
{
    const Options o = good({"/g", "-P", "/s:4", "/N:10", "/D:out"});
    CHECK(o.grey && o.report98 && !o.interactive);
    NEAR(number(o.spacing), 4, 0);
    SAME(o.frames, 10);
    // The last of two values counts.
    NEAR(number(good({"/S:4", "/S:1"}).spacing), 1, 0);
}

TEST(bad_switches)
{
    for (const char* word : {"/", "-", "/Q", "--help", "/GG", "/G:", "/G:1", "/I:yes", "/P1", "/IG", "", "//G", "/ G", "/G/",
                             "/G/Q", "/G-I", "/G=1", "-G-I", "/S:2/", "/S2/Q", "/N5x/G", "/GWALK"})
        bad(word);
    for (const char* word : {"/S", "/S:", "/S=", "/S-2", "/S9", "/Sx", "/S=2=", "/S:0", "/S:0.2", "/S:0.2499", "/S:8.01", "/S:9",
                             "/S:-2", "/S:x", "/S:2x", "/S:1e1", "/S:99999999999", "/S:2,5", "/S: 2"})
        bad(word);
    for (const char* word :
         {"/N", "/N:", "/N:0", "/N:-1", "/N:10000000", "/N:99999999999999", "/N:1.5", "/N:x", "/N:1x", "/Nx", "/N=", "/N/5", "/N0"})
        bad(word);
    for (const char* word : {"/T", "/T:", "/T:0", "/T:-1", "/T:86401", "/T:0.5", "/T:x", "/Tx"})
        bad(word);
    for (const char* word : {"/D", "/D:", "/M", "/M:", "/M=", "/Dout", "/MWALK", "/O1"})
        bad(word);
    // A very long switch is cut off in the message and does not overrun it.
    Options options;
    const char* problem = parse({"/" + std::string(500, 'Z')}, &options);
    CHECK(problem != nullptr && std::strlen(problem) < 300);
    // A valid switch before or after a bad one does not help.
    CHECK(parse({"/G", "/Q"}, &options) != nullptr);
    CHECK(parse({"/Q", "/G"}, &options) != nullptr);
}

TEST(habits)
{
    // Several switches in one word, '=' for ':', and a number directly after its letter are accepted.
    Options o = good({"/G/I/s2/N=5/r35"});
    CHECK(o.grey && o.interactive && !o.report98 && o.rateGiven);
    NEAR(number(o.spacing), 2, 0);
    SAME(o.frames, 5);
    SAME(o.rate, 35);
    o = good({"-S.5/x", "/T=60"});
    NEAR(number(o.spacing), 0.5, 0);
    CHECK(o.noPresent && !o.rateGiven);
    SAME(o.seconds, 60);
    // A name extends to the end of its word, including slashes.
    o = good({"/G/M:scenes/walk.fb", "/D=out/G"});
    TEXT(o.modelFile, "scenes/walk.fb");
    TEXT(o.dumpDirectory, "out/G");
    CHECK(o.grey);
    // A word that is not a switch is the name of the scene.
    TEXT(good({"WALK.FB"}).modelFile, "WALK.FB");
    TEXT(good({"/G", "walk", "/N5"}).modelFile, "walk");
    for (const char* twice : {"other", "/M:other"}) {
        const char* problem = parse({"walk", twice}, &o);
        CHECK(problem != nullptr && std::strstr(problem, "there is a scene already") != nullptr);
    }
}

TEST(complaints_are_plain_text)
{
    Options options;
    const char* problem = parse({"/Q\n\x1b[2J\xff"}, &options);
    CHECK(problem != nullptr && std::strncmp(problem, "/Q\\x0A\\x1B[2J\\xFF: ", 19) == 0);
    // A switch that is too long for the message keeps its beginning and its end.
    problem = parse({"/N:1" + std::string(300, '0') + "end"}, &options);
    CHECK(problem != nullptr && std::strncmp(problem, "/N:1000", 7) == 0 && std::strstr(problem, "...") != nullptr);
    CHECK(problem != nullptr && std::strstr(problem, "000end: ") != nullptr);
}

TEST(accepted_ranges_are_told)
{
    Options options;
    CHECK(std::strstr(parse({"/S:9"}, &options), "0.25 to 8") != nullptr);
    CHECK(std::strstr(parse({"/F:0"}, &options), "1 to 100") != nullptr);
    CHECK(std::strstr(parse({"/N:0"}, &options), "1 to 9999999") != nullptr);
    CHECK(std::strstr(parse({"/T:0"}, &options), "1 to 86400") != nullptr);
}

TEST(help_names_every_switch_and_key)
{
    for (const char* word :
         {"/I", "/G", "/P", "/S:", "/F:", "/N:", "/T:", "/D:", "/M:", "/?", "*", "-", "+", "ESC", "left button", "right button"})
        if (!CHECK(std::strstr(HELP, word) != nullptr))
            note("not in the help: %s", word);
    // The list fits a text screen.
    int line = 0, lines = 0, longest = 0;
    for (const char* c = HELP; *c != 0; ++c) {
        if (*c == '\n') {
            longest = line > longest ? line : longest;
            line = 0;
            ++lines;
        } else {
            ++line;
        }
    }
    CHECK(longest < 80);
    CHECK(lines < 25);
    note("%d lines, the longest %d characters", lines, longest);
}
