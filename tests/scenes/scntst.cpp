// Tests of scene files in process: the effect of each statement on place, turn and size at known times; the full text of every
// complaint; every limit, reached and exceeded by one.
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "machine.h"
#include "math/normal.h"
#include "surface/engine.h"
#include "model/scene.h"

namespace {

int passed = 0, failed = 0;

void check(bool good, const std::string& name)
{
    if (good) {
        ++passed;
    } else {
        ++failed;
        printf("FAIL %s\n", name.c_str());
    }
}

double number(Real a) { return rawFromReal(a) / 65536.0; }
Time at(double seconds) { return static_cast<Time>(seconds * 65536 + 0.5); }

const char* read(const std::string& text, Model& model)
{
    SceneEnd end;
    const char* wrong = readSceneText("T.FB", text.data(), static_cast<uint32_t>(text.size()), model, &end);
    check((wrong == nullptr) == (end == SCENE_GOOD), "the end goes with the complaint: " + text.substr(0, 60));
    return wrong;
}

// The text must be read, and item NAME must be at x y z with this scale at the given time.
void place(const std::string& text, const char* name, double seconds, double x, double y, double z, double scale = 1)
{
    Model model;
    const char* wrong = read(text, model);
    if (wrong != nullptr) {
        check(false, std::string(wrong) + " in: " + text);
        return;
    }
    Anim::move(model, at(seconds));
    const Pose& pose = model.itemNamed(name)->pose;
    const auto near = [](Real a, double b) { return std::fabs(number(a) - b) < 0.01; };
    const bool good = near(pose.place.x, x) && near(pose.place.y, y) && near(pose.place.z, z) && near(pose.scale, scale);
    if (!good)
        printf("  %s is at %.3f %.3f %.3f scale %.3f\n", name, number(pose.place.x), number(pose.place.y),
               number(pose.place.z), number(pose.scale));
    check(good, std::to_string(seconds) + " s of: " + text);
}

// The text must be refused with exactly these words.
void refused(const std::string& text, const std::string& words)
{
    Model model;
    const char* wrong = read(text, model);
    if (wrong == nullptr || words != wrong)
        printf("  said: %s\n  not:  %s\n", wrong == nullptr ? "nothing" : wrong, words.c_str());
    check(wrong != nullptr && words == wrong, "refused: " + text.substr(0, 80));
}

void taken(const std::string& text, const std::string& name)
{
    Model model;
    const char* wrong = read(text, model);
    if (wrong != nullptr)
        puts(wrong);
    check(wrong == nullptr, name);
}

const std::string S = "sphere s size 20\n";

void motion()
{
    place("sphere s size 20 at 1 -2 3.5", "s", 7, 1, -2, 3.5);
    place(S + "circle s radius 10 period 4", "s", 0, 10, 0, 0);
    place(S + "circle s radius 10 period 4", "s", 1, 0, 10, 0);
    place(S + "circle s radius 10 period -4", "s", 1, 0, -10, 0);
    place(S + "circle s radius 10 plane yz period 4 phase 0.25", "s", 0, 0, 0, 10);
    place(S + "circle s radius 10 plane zx period 4", "s", 1, 10, 0, 0);
    place(S + "circle s u 3 0 0 v 0 0 5 period 8", "s", 2, 0, 0, 5);
    place(S + "circle s radius 10 period 4", "s", 4 * 900 + 1, 0, 10, 0);
    place(S + "path s x 10 4 0 y 6 8 0.25", "s", 1, 10, 6 * std::cos(M_PI / 4), 0);
    place(S + "path s z 10 4 0", "s", 3, 0, 0, -10);

    const std::string keys = "key s 1 10 0 0\nkey s 3 20 8 -4\nkey s 4 0 0 0\n";
    place(S + keys, "s", 0, 10, 0, 0);
    place(S + keys, "s", 1.5, 12.5, 2, -1);
    place(S + keys, "s", 3, 20, 8, -4);
    place(S + keys, "s", 9, 0, 0, 0);
    place(S + "keys s smooth\n" + keys, "s", 1, 10, 0, 0);
    place(S + "keys s smooth\n" + keys, "s", 3, 20, 8, -4);
    place(S + "keys s smooth\nkey s 0 0 0 0\nkey s 2 10 0 0", "s", 1, 5, 0, 0);
    place(S + "keys s smooth\nkey s 0 0 0 0\nkey s 2 10 0 0", "s", 0.5, 10 * (3 * 0.0625 - 2 * 0.015625), 0, 0);
    // The slope at the middle key is the slope between its neighbours: 5 a second.
    place(S + "keys s smooth\nkey s 0 0 0 0\nkey s 2 10 0 0\nkey s 4 20 0 0", "s", 1, 10 * 0.5 - 0.125 * 10, 0, 0);
    place(S + "keys s repeat 4\nkey s 0 0 0 0\nkey s 2 8 0 0", "s", 4 * 300 + 3, 4, 0, 0);
    place(S + "keys s repeat 4\nkey s 1 0 0 0\nkey s 3 8 0 0", "s", 4, 4, 0, 0);
    place(S + "keys s repeat 4\nkey s 1 5 0 0", "s", 2, 5, 0, 0);
    place(S + "key s 0 0 0 0 scale 1\nkey s 2 0 0 0 scale 3", "s", 1, 0, 0, 0, 2);

    place(S + "pulse s by 0.5 period 4", "s", 1, 0, 0, 0, 1.5);
    place(S + "pulse s by 0.5 period 4", "s", 3, 0, 0, 0, 0.5);

    place("group g at 5 0 0\nsphere s size 20 at 10 0 0 in g", "s", 0, 15, 0, 0);
    place("group g at 5 0 0 turn 0 0 90\nsphere s size 20 at 10 0 0 in g", "s", 0, 5, 10, 0);
    place("group g turn 90 0 90\nsphere s size 20 at 0 10 0 in g", "s", 0, 0, 0, 10);
    place("group g scale 2\nsphere s size 20 at 10 0 0 in g", "s", 0, 20, 0, 0, 2);
    place("group g\nspin g axis 0 1 0 period 4\nsphere s size 20 at 10 0 0 in g", "s", 1, 0, 0, -10);
    place("group g\nswing g axis 0 0 2 angle 90 period 4\nsphere s size 20 at 10 0 0 in g", "s", 1, 0, 10, 0);
    place("group g\nswing g axis 0 0 2 angle 90 period 4\nsphere s size 20 at 10 0 0 in g", "s", 3, 0, -10, 0);
    place("group g\nkeys g axis 0 0 1\nkey g 0 0 0 0\nkey g 1 0 0 0 angle 90\nsphere s size 20 at 10 0 0 in g", "s", 1, 0, 10, 0);
    place("sphere p size 9 at 0 7 0\nsphere s size 20 at 10 0 0 in p", "s", 0, 10, 7, 0);
    place("group a at 10 0 0\nspin a axis 0 0 1 period 4\ngroup b at 10 0 0 in a\nspin b axis 0 0 1 period 4\n"
          "sphere s size 20 at 10 0 0 in b", "s", 1, 0, 10, 0);
    // No item leaves the space of the model.
    place("group g at 250 0 0 scale 4\nsphere s size 20 at 250 0 0 in g", "s", 0, 250, 0, 0, 4);

    // A size depends on the time only, not on what was shown before.
    Model once, often;
    const std::string text = S + "cylinder c size 12 length 30 at 40 0 0\npulse s by 0.3 period 3\npulse c by 0.7 period 2";
    read(text, once);
    read(text, often);
    once.resample(Real(2), makeEngine);
    often.resample(Real(2), makeEngine);
    for (int i = 0; i <= 500; ++i)
        Anim::move(often, at(i * 0.0373));
    Anim::move(once, at(500 * 0.0373));
    char a[200], b[200];
    for (int i = 0; i < 2; ++i) {
        once.actor(i).object->describe(a, sizeof a);
        often.actor(i).object->describe(b, sizeof b);
        check(strcmp(a, b) == 0, std::string("no drift: ") + a + " / " + b);
    }
    check(once.actor(0).object->size() == once.actor(0).measure[0] * once.actor(0).pose.scale, "the size is made * scale");
    const Real size = once.actor(1).object->size();
    Anim::move(once, at(0));
    check(once.actor(1).object->size() == Real(12) && size != Real(12), "size back at time 0");

    // Line ends, case and comments.
    place("SPHERE S SIZE 20 AT 1 2 3 # here\r\n\r\n#\r\n\tCIRCLE\ts RADIUS 0 PERIOD 1\r\n", "s", 0, 1, 2, 3);
    place("sphere s size 20 at 1 2 3\n\x1a" "anything", "s", 0, 1, 2, 3);
    place("sphere s size 20 at 1 2 3", "s", 0, 1, 2, 3);
}

std::string repeated(int count, const char* form)
{
    std::string all;
    for (int i = 1; i <= count; ++i) {
        char line[200];
        snprintf(line, sizeof line, form, i, i);
        all += line;
    }
    return all;
}

// A second motion of one kind is added to the first.
void sums()
{
    place(S + "circle s radius 10 period 4\ncircle s radius 3 period 2", "s", 1, -3, 10, 0);
    place(S + "circle s radius 10 period 4\ncircle s radius 3 period 2\ncircle s u 0 0 5 v 0 0 0 period 4", "s", 0, 13, 0, 5);
    place(S + "path s x 10 4 0\npath s x 3 8 0.25 z 1 4 0\npath s x 2 4 0", "s", 1, 12 + 3 * std::cos(M_PI / 4), 0, 1);
    place(S + "path s x 10 4 0 x 3 4 0.5", "s", 1, 7, 0, 0);
    place(S + "path s x -1 2 0 y -250 4 0", "s", 1, 0, -250, 0);
    place(S + "path s x -1 2 0", "s", 0.5, -1, 0, 0);
    place(S + "pulse s by 0.5 period 4\npulse s by 0.25 period 4 phase 0.5", "s", 1, 0, 0, 0, 1.5 * 0.75);
    const std::string in = "sphere s size 20 at 10 0 0 in g";
    place("group g\nspin g axis 0 1 0 period 4\nspin g axis 0 0 1 period 2\n" + in, "s", 1, 0, 0, -10);
    place("group g\nspin g axis 0 0 1 period 8\nspin g axis 0 0 1 period 8\n" + in, "s", 1, 0, 10, 0);
    // A later motion turns the result of the earlier one: in the first line x goes to y and then to z.
    place("group g\nspin g axis 0 0 1 period 4\nspin g axis 1 0 0 period 4\n" + in, "s", 1, 0, 0, 10);
    place("group g\nspin g axis 1 0 0 period 4\nspin g axis 0 0 1 period 4\n" + in, "s", 1, 0, 10, 0);
    place("group g\nswing g axis 0 0 1 angle 60 period 4\nswing g axis 0 0 1 angle 30 period 4\n" + in, "s", 1, 0, 10, 0);
    place("group g\nswing g axis 0 0 1 angle 90 period 4\nswing g axis 1 0 0 angle 90 period 4\n" + in, "s", 1, 0, 0, 10);
    taken(S + "spin s axis 0 0 1 period 4\n" + repeated(4, "swing s axis 1 0 0 angle %d period 1\n") + "pulse s by 0.1 period 1\n"
          "path s x 1 1 0\nspin s axis 1 0 0 period 1", "one of each and four more");
    refused(S + repeated(6, "swing s axis 1 0 0 angle %d period 1\n"),
            "T.FB:7: 's': expected at most 4 motions of one name beside the first of each kind");
}

void titles()
{
    Model model;
    check(read("# first\ntitle   A Ball, 20 UNITS\twide!   # it is\n" + S, model) == nullptr &&
              std::string(model.title) == "A Ball, 20 UNITS wide!", "a title keeps its letters");
    Model none;
    check(read(S, none) == nullptr && none.title[0] == 0, "no title");
    taken("title " + std::string(47, 'm') + "\n" + S, "a title of 47");
    const std::string most = "expected a title of 1 to 47 plain letters, digits and signs";
    refused("title " + std::string(48, 'm') + "\n" + S, "T.FB:1: 'mmmmmmmmmmmmmmmmmmmm...': " + most);
    refused("title\n" + S, "T.FB:1: end of line: " + most);
    refused("title # none\n" + S, "T.FB:1: end of line: " + most);
    refused("title K\xc3\xa4se\n" + S, "T.FB:1: 'K?" "?se': " + most);
    refused("title a\nTITLE a\n" + S, "T.FB:2: 'title': expected one title only");
    Model::Record* record = model.record();
    Model other;
    read("title other\n" + S, other);
    model.swap(other);
    check(std::string(model.title) == "other" && std::string(other.title) == "A Ball, 20 UNITS wide!", "titles change places");
    check(model.restore(record) && std::string(model.title) == "A Ball, 20 UNITS wide!", "and come back with a record");
    free(record);
}

void colour(const std::string& words, int red, int green, int blue)
{
    Model model;
    const char* wrong = read("sphere a size 9 " + words + " at 1 2 3", model);
    check(wrong == nullptr && model.actor(0).colour.red == red && model.actor(0).colour.green == green &&
              model.actor(0).colour.blue == blue && model.actor(0).motion.centre.z == Real(3), "colour: " + words);
}

void colours()
{
    colour("colour 1 2 3", 1, 2, 3);
    colour("color 1 2.9 255", 1, 2, 255);
    colour("colour #12aBfF", 0x12, 0xab, 0xff);
    colour("COLOR #000001", 0, 0, 1);
    colour("colour red", 255, 64, 48);
    colour("color Gray", 136, 136, 136);
    colour("colour brown", 160, 96, 48);
    const std::string names = "white, silver, grey, gray, black, red, orange, yellow, lime, green, cyan, blue, violet, magenta, "
                              "pink, brown, #rrggbb, or red, green and blue from 0 to 255";
    refused("sphere a size 9 colour", "T.FB:1: end of line: expected " + names);
    refused("sphere a size 9 colour reddish", "T.FB:1: 'reddish': expected " + names);
    for (const char* bad : {"#", "#12345", "#1234567", "#12345g", "#-12345"})
        refused(std::string("sphere a size 9 colour ") + bad, std::string("T.FB:1: '") + bad +
                "': expected a colour as #rrggbb, two digits from 00 to ff each for red, green and blue");
    refused("sphere a size 9 colour 1 red 3", "T.FB:1: 'red': expected red, green and blue from 0 to 255");
    refused("sphere a size 9 colour -1 2 3", "T.FB:1: '-1': expected red, green and blue from 0 to 255");
    refused("group g color red", "T.FB:1: 'color': expected at, turn, scale, repeat, step or in");
    // Elsewhere '#' begins a comment, even directly behind a word.
    place("sphere s size 20#ff0000\ncircle s radius 10 period 4 #rrggbb", "s", 1, 0, 10, 0);
}

void paints()
{
    Model model;
    check(read(S + "sphere b size 9 repeat 3\nfinish b shiny\npattern b2 marble 12.5 #010203\nfinish b2 mirror\n"
                   "pattern s checks 8 lime # big\nfinish s matt\ncolours mixed\n", model) == nullptr, "paints");
    const Coat &s = model.itemNamed("s")->coat, &b1 = model.itemNamed("b1")->coat, &b2 = model.itemNamed("b2")->coat;
    check(model.mixed, "colours mixed");
    check(s.finish == FINISH_MATT && s.pattern == PATTERN_CHECKS && s.grain == Real(8) && s.colour == Colour{160, 224, 64},
          "a pattern");
    check(b1.finish == FINISH_SHINY && b1.pattern == PATTERN_NONE, "a row's finish");
    check(b2.finish == FINISH_MIRROR && b2.pattern == PATTERN_MARBLE && b2.grain == Real(12.5) && b2.colour == Colour{1, 2, 3},
          "both, of one of it");
    Model::Record* record = model.record();
    Model other;
    check(read(S + "colors mixed\ncolours apart", other) == nullptr && !other.mixed, "colours apart again");
    model.swap(other);
    check(!model.mixed && other.mixed, "mixtures change places");
    check(model.restore(record) && model.mixed && model.itemNamed("b2")->coat.finish == FINISH_MIRROR,
          "and come back with a record");
    free(record);
    taken(S + "finish s shiny\nfinish s mirror\npattern s stripes 1 red\npattern s checks 100 1 2 3", "the last one counts");

    refused(S + "colours", "T.FB:2: end of line: expected mixed or apart");
    refused(S + "colours red", "T.FB:2: 'red': expected mixed or apart");
    refused(S + "colours mixed 2", "T.FB:2: '2': expected the end of the line");
    for (const char* word : {"finish", "pattern"}) {
        refused(S + word, "T.FB:2: end of line: expected the name of an object");
        refused(S + word + " t", "T.FB:2: 't': expected the name of an object");
        refused(S + "group g\n" + word + " g", "T.FB:3: 'g': expected the name of an object");
    }
    refused(S + "finish s", "T.FB:2: end of line: expected matt, shiny or mirror");
    refused(S + "finish s dull", "T.FB:2: 'dull': expected matt, shiny or mirror");
    refused(S + "finish s matt 3", "T.FB:2: '3': expected the end of the line");
    refused(S + "pattern s", "T.FB:2: end of line: expected checks, stripes or marble");
    refused(S + "pattern s none", "T.FB:2: 'none': expected checks, stripes or marble");
    refused(S + "pattern s checks", "T.FB:2: end of line: expected the size of a pattern from 1 to 100");
    refused(S + "pattern s checks 0.9 red", "T.FB:2: '0.9': expected the size of a pattern from 1 to 100");
    refused(S + "pattern s stripes 101 red", "T.FB:2: '101': expected the size of a pattern from 1 to 100");
    refused(S + "pattern s marble 5 1 2 300", "T.FB:2: '300': expected red, green and blue from 0 to 255");
    refused(S + "pattern s marble 5 red red", "T.FB:2: 'red': expected the end of the line");
}

void rows()
{
    const std::string five = "sphere b size 9 at 1 2 3 repeat 5 step 10 -1 0.5\n";
    place(five, "b1", 0, 1, 2, 3);
    place(five, "b5", 0, 41, -2, 5);
    Model model;
    check(read("group g repeat 2 step 0 5 0\n" + five + "cylinder c size 9 length 4 repeat 12 colour lime in g2\n", model) ==
              nullptr && model.count() == 17 && model.items() == 19, "rows of objects and of groups");
    check(model.itemNamed("c12") != nullptr && model.itemNamed("c12")->colour.red == 160 &&
              model.itemNamed("c12")->motion.parent == model.itemNamed("g2")->number && model.itemNamed("c") == nullptr,
          "each like one written by itself");
    check(model.itemNamed("b1")->colour.red == 255 && model.itemNamed("b2")->colour.red == 64, "with the colours of single ones");
    place("group g repeat 2 step 0 5 0\nsphere s size 9 in g2", "s", 0, 0, 5, 0);
    // The name of a row stands for each of its items.
    place(five + "path b y 10 4 0.25", "b3", 0, 21, 10, 4);
    place(five + "path b4 y 10 4 0.25", "b3", 0, 21, 0, 4);
    place(five + "circle b radius 10 period 8 lag 0.25\n", "b1", 0, 11, 2, 3);
    place(five + "circle b radius 10 period 8 lag 0.25\n", "b2", 0, 11, -9, 3.5);
    place(five + "circle b lag -0.25 radius 10 period 8\n", "b2", 0, 11, 11, 3.5);
    place(five + "circle b radius 10 period 8 lag 0.25\n", "b2", 2, 21, 1, 3.5);
    place(five + "path b lag 0.25 x 10 4 0 z 6 4 0.5", "b2", 2, 21, 1, -2.5);
    place(five + "path b x 10 4 0 z 6 4 0.5 lag 0.25", "b2", 2, 21, 1, -2.5);
    place(five + "pulse b by 0.5 period 4 lag 0.5", "b2", 1, 11, 1, 3.5, 0.5);
    place(five + "keys b smooth\nkey b 0 0 0 0\nkey b 2 10 0 0", "b2", 1, 16, 1, 3.5);
    place(five + "group g at 100 0 0\nspin g axis 0 0 1 period 4\nsphere s size 9 at 1 0 0 repeat 3 step 1 0 0 in g", "s3", 1, 100,
          3, 0);
    place("group g repeat 3\nswing g axis 0 0 1 angle 90 period 4 lag -0.25\nsphere s size 9 at 7 0 0 in g2", "s", 0, 0, 7, 0);
    place("group g repeat 3\nspin g axis 0 0 1 period 4 lag 0.25\nsphere s size 9 at 7 0 0 in g3", "s", 0, -7, 0, 0);
    Real weight;
    Model linked;
    check(read(five + "sphere p size 9\nsphere q size 9 repeat 2\nblend b p 0.5\nblend q b 2\nblend q q\nblend b b2 3", linked) ==
              nullptr,
          "rows that blend");
    const auto with = [&](const char* a, const char* b) {
        return Model::linked(linked.itemNamed(a)->object, linked.itemNamed(b)->object, &weight) ? number(weight) : -1;
    };
    check(with("b1", "p") == 0.5 && with("p", "b5") == 0.5, "each with the other");
    check(with("q1", "b3") == 2 && with("q2", "b5") == 2 && with("q1", "q2") == 1, "two rows, and a row with itself");
    check(with("b2", "b3") == 3 && with("b1", "b3") == -1 && with("p", "q1") == -1 && with("q1", "q1") == -1, "and nothing else");

    taken("sphere s size 9 repeat 128\nblend s s", "a row of 128");
    taken("sphere s size 9 repeat 128\ndent s s 4", "a row of 128, each digs into each");
    refused("sphere s size 9 repeat 129", "T.FB:1: '129': expected a whole number from 2 to 128");
    refused("group s repeat 65", "T.FB:1: '65': expected a whole number from 2 to 64");
    refused("sphere s size 9 repeat 1", "T.FB:1: '1': expected a whole number from 2 to 128");
    refused("sphere s size 9 repeat 2.5", "T.FB:1: '2.5': expected a whole number");
    refused("sphere s size 9 repeat many", "T.FB:1: 'many': expected a whole number from 2 to 128");
    refused("sphere s size 9 repeat", "T.FB:1: end of line: expected a whole number from 2 to 128");
    refused(S + "sphere t size 9 repeat 128", "T.FB:2: 't': expected at most 128 objects");
    refused("group h\ngroup g repeat 64", "T.FB:2: 'g': expected at most 64 groups");
    refused("group g repeat 63\ngroup h in eye", "T.FB:2: 'h': expected at most 64 groups");
    refused("group g repeat 64\ngroup h", "T.FB:2: 'h': expected at most 64 groups");
    refused("sphere s size 9 repeat 128\nsphere t size 9", "T.FB:2: 't': expected at most 128 objects");
    refused("sphere s size 9 step 1 2 3", "T.FB:1: 'step': expected repeat as well, for step to count");
    refused("sphere s size 9 repeat 3 step 1 2", "T.FB:1: end of line: expected a step, z from -250 to 250");
    refused("sphere s size 9 repeat 3 step 1 2 251", "T.FB:1: '251': expected a step, z from -250 to 250");
    taken("sphere s size 9 at -250 0 0 repeat 3 step 250 0 0", "a row from edge to edge");
    refused("sphere s size 9 at -249 0 0 repeat 3 step 250 0 0", "T.FB:1: 's3': expected steps that stay between -250 and 250");
    taken("sphere abcdefghijklmn size 9 repeat 9", "a row's name of 14 characters");
    refused("sphere abcdefghijklmn size 9 repeat 10",
            "T.FB:1: 'abcdefghijklmn': expected at most 13 characters in the name of such a row");
    refused("sphere abcdefghijklmno size 9 repeat 2",
            "T.FB:1: 'abcdefghijklmno': expected at most 14 characters in the name of such a row");
    refused("sphere s size 9 repeat 2\nsphere s size 9", "T.FB:2: 's': expected a name that is not taken yet");
    refused("sphere s size 9 repeat 2\ngroup s2", "T.FB:2: 's2': expected a name that is not taken yet");
    refused("sphere s2 size 9\nsphere s size 9 repeat 3", "T.FB:2: 's2': expected a name that is not taken yet");
    refused("sphere s1 size 9 repeat 2\nsphere s size 9 repeat 2", "T.FB:2: 's1': expected a name that is not taken yet");
    refused("sphere s size 9 repeat 2\nsphere t size 9 in s", "T.FB:2: 's': expected a group or an object of a line above");
    refused(S + "circle s radius 1 period 1 lag 1", "T.FB:2: 'lag': expected no lag, for this name is no row's");
    refused(S + "path s x 1 1 0 lag 1", "T.FB:2: 'lag': expected x, y or z, each with amplitude, period and phase");
    refused("sphere s size 9 repeat 2\ncircle s radius 1 period 1 lag 2", "T.FB:2: '2': expected a lag in turns from -1 to 1");
    refused("sphere s size 9 repeat 2\ncircle s radius 1 period 1 log 2",
            "T.FB:2: 'log': expected radius, plane, u, v, period, phase or lag");
    refused("sphere s size 9 repeat 2\nspin s axis 0 0 1 log 2", "T.FB:2: 'log': expected axis, period, phase or lag");
    refused("sphere s size 9 repeat 2\nkey s2 1 0 0 0\nkeys s smooth", "T.FB:3: 's2': expected keys before the first key");
    refused("sphere s size 9 repeat 2\nkey s2 1 0 0 0\nkey s 1 0 0 0", "T.FB:3: '1': expected a time after that of the key before");
    refused("sphere s size 9 repeat 100\n" + repeated(11, "key s %d 0 0 0\n"), "T.FB:12: 'key': expected at most 1024 keys");
    refused("group g repeat 2\nsphere s size 9\nblend g s", "T.FB:3: 'g': expected all, or the name of an object");
    refused("group g repeat 2\nsphere s size 9\nblend s g", "T.FB:3: 'g': expected the name of a second object");
    refused("sphere s size 9 repeat 128\n" + repeated(4, "blend s s # %d\n"),
            "T.FB:5: 's': expected at most 65024 pairs in all lines that blend or dent rows");
}

bool append(void* to, const char* line)
{
    static_cast<std::string*>(to)->append(line);
    return true;
}

// A ball has a turn only where that shows, and then at once.
void turnedBalls()
{
    const std::string ball = "sphere b size 60 turn 0 0 90\n";
    for (const char* more : {"taper b 0 swing 0.7 period 4", "taper b 0.1", "pattern b stripes 6 red"}) {
        Model model;
        check(read(ball + more, model) == nullptr, more);
        Anim::move(model, 0);
        Anim::move(model, at(1));
        const Vector x = model.itemNamed("b")->object->turn() * Vector{Real(1), Real(0), Real(0)};
        check(std::fabs(number(x.y) - 1) < 0.01, std::string("turned: ") + more);
    }
}

// Strengths, and objects that dig into others.
void dents()
{
    Model model;
    const char* wrong = read("sphere a size 20\nsphere b size 9\nsphere r size 9 repeat 3\ndent a b\ndent a r 0.5\ndent r a 2\n"
                             "dent r r 3\ndent a r2 4\nstrength a 0.25\nstrength r 4\nstrength r3 1.5\nblend a r1 0.25\ndent b a 0",
                             model);
    check(wrong == nullptr, "dents and strengths");
    Real weight;
    const auto digs = [&](const char* into, const char* what) {
        return Model::dented(model.itemNamed(into)->object, model.itemNamed(what)->object, &weight) ? number(weight) : -1;
    };
    check(digs("a", "b") == 1 && digs("b", "a") == 0, "one way");
    check(digs("a", "r1") == 0.5 && digs("a", "r2") == 4 && digs("r3", "a") == 2, "rows, and the last counts");
    check(digs("r1", "r3") == 3 && digs("r3", "r1") == 3 && digs("r1", "r1") == -1 && digs("r1", "b") == -1, "and nothing else");
    check(Model::linked(model.itemNamed("a")->object, model.itemNamed("r1")->object, &weight) && weight == Real(0.25) &&
              !Model::linked(model.itemNamed("a")->object, model.itemNamed("b")->object, &weight), "links beside them");
    const auto strength = [&](const char* name) { return number(model.itemNamed(name)->object->strength()); };
    check(strength("a") == 0.25 && strength("b") == 1 && strength("r1") == 4 && strength("r3") == 1.5, "strengths");
    const auto seen = [&](const char* name) { return model.itemNamed(name)->object->hasSurface(); };
    check(seen("a") && seen("r1") && !seen("b") && !seen("r2"), "what only digs has no surface");
    const Bodies* bodies = model.prepareBodies();
    const SoftObject &a = *model.itemNamed("a")->object, &r2 = *model.itemNamed("r2")->object;
    check(bodies->memberCount(a) == 2 && bodies->diggerCount(a) == 3 && bodies->memberCount(r2) == 1 &&
              bodies->diggerCount(r2) == 0,
          "a body and what digs into it");
    check(bodies->weight(a.slot(), r2.slot()) == Real(-4) && bodies->weight(r2.slot(), a.slot()) == Real(-2), "one way each");

    std::string first, second;
    check(writeSceneText(append, &first, model), "saved with dents");
    check(first.find("\ndent a b\n") != std::string::npos && first.find("\ndent b a 0\n") != std::string::npos &&
              first.find("\nstrength a 0.25\n") != std::string::npos && first.find("strength b") == std::string::npos,
          "in their words");
    Model again;
    wrong = read(first, again);
    if (wrong != nullptr)
        puts(wrong);
    writeSceneText(append, &second, again);
    check(wrong == nullptr && first == second, "and read back as the same");

    // The order of the lines does not matter.
    for (const char* lines : {"dent one dig\ndent two dig", "dent two dig\ndent one dig"}) {
        Model two;
        read(std::string("sphere one size 30\nsphere two size 30 at 20 0 0\nsphere dig size 20\n") + lines, two);
        check(two.itemNamed("dig")->object->hollowed() == two.itemNamed("one")->object,
              std::string("the hollow of the one in which it lies: ") + lines);
    }

    refused(S + "dent s", "T.FB:2: end of line: expected the name of a second object");
    refused(S + "dent", "T.FB:2: end of line: expected the name of an object");
    refused(S + "dent all s", "T.FB:2: 'all': expected the name of an object");
    refused(S + "dent s s", "T.FB:2: 's': expected the name of a second object");
    refused(S + "group g\ndent g s", "T.FB:3: 'g': expected the name of an object");
    refused(S + "sphere t size 9\ndent s t 4.1", "T.FB:3: '4.1': expected a weight from 0 to 4");
    refused(S + "sphere t size 9\ndent s t -1", "T.FB:3: '-1': expected a weight from 0 to 4");
    refused(S + "sphere t size 9\ndent s t 1 2", "T.FB:3: '2': expected the end of the line");
    refused("sphere s size 9 repeat 128\n" + repeated(4, "dent s s # %d\n"),
            "T.FB:5: 's': expected at most 65024 pairs in all lines that blend or dent rows");
    refused(S + "strength", "T.FB:2: end of line: expected the name of an object");
    refused(S + "group g\nstrength g 2", "T.FB:3: 'g': expected the name of an object");
    refused(S + "strength s", "T.FB:2: end of line: expected a strength from 0.25 to 4");
    refused(S + "strength s 0.2", "T.FB:2: '0.2': expected a strength from 0.25 to 4");
    refused(S + "strength s 4.1", "T.FB:2: '4.1': expected a strength from 0.25 to 4");
    refused(S + "strength s 1 1", "T.FB:2: '1': expected the end of the line");
}

// Tests what the editor saves: the items of rows, all motions, the title. The saved text must read back as the same scene.
void saved()
{
    const std::string text =
        "title A row, saved\ngroup g repeat 2 step 0 9 0\nsphere b size 9 repeat 3 step 10 0 0 color pink in g2\n"
        "circle b radius 10 period 4 lag 0.125\ncircle b1 u 1 2 3 v 4 5 6 period 3 phase 0.5\n"
        "path b x -3 2 0 x 4 3 0\npath b z 1 2 0 z -2 2 0.25\nspin g axis 0 1 0 period 3\nspin g axis 1 0 0 period -5\n"
        "swing b2 axis 0 0 1 angle 20 period 2\nswing b2 axis 0 0 1 angle -20 period 5\n"
        "pulse b3 by 0.5 period 2\npulse b3 by 0.25 period 3\nblend b b 0.5\ncolours mixed\n"
        "finish b1 mirror\npattern b2 stripes 6.5 cyan\npattern b3 checks 3 1 2 3\nfinish b3 shiny\n"
        "box x size 9 x 4 y 20 z 2 stretch 1.5 1 0.25\ntaper x -0.5\ntwist b2 0 swing 90 period 3\n"
        "bend b 10 swing 30 period -4 phase 0.5 lag 0.25\n";
    Model model, again;
    check(read(text, model) == nullptr, "to be saved");
    std::string first, second;
    check(writeSceneText(append, &first, model), "saved");
    check(first.find("title A row, saved\n") == 0 && first.find("sphere b3 ") != std::string::npos &&
              first.find("repeat") == std::string::npos, "as the objects that it made");
    for (const char* line : {"\ncolours mixed\n", "\nfinish b1 mirror\n", "\npattern b2 stripes 6.5 64 208 216\n",
                             "\nfinish b3 shiny\npattern b3 checks 3 1 2 3\n"})
        check(first.find(line) != std::string::npos, std::string("saved:") + line);
    const char* wrong = read(first, again);
    if (wrong != nullptr)
        puts(wrong);
    writeSceneText(append, &second, again);
    check(wrong == nullptr && first == second, "saved twice the same");
    bool same = wrong == nullptr && model.items() == again.items();
    for (int t = 0; same && t < 200; ++t) {
        Anim::move(model, at(t * 0.317));
        Anim::move(again, at(t * 0.317));
        for (int i = 0; i < model.items(); ++i)
            same = same && model.item(i).pose.place == again.item(i).pose.place &&
                   model.item(i).pose.scale == again.item(i).pose.scale &&
                   memcmp(&model.item(i).pose.turn, &again.item(i).pose.turn, sizeof(Matrix)) == 0 &&
                   model.item(i).stretch == again.item(i).stretch;
        for (int i = 0; i < model.count(); ++i)
            same = same && model.actor(i).object->warped() &&
                   model.actor(i).object->warp().amounts() == again.actor(i).object->warp().amounts();
    }
    check(same, "moves the same");
}

std::string contents(const std::string& name)
{
    std::string text;
    FILE* file = fopen(name.c_str(), "rb");
    if (file == nullptr)
        return "none";
    for (int c = getc(file); c != EOF; c = getc(file))
        text += static_cast<char>(c);
    fclose(file);
    return text;
}

size_t filesIn(const std::string& directory)
{
    size_t count = 0;
    DIR* d = opendir(directory.c_str());
    while (d != nullptr && readdir(d) != nullptr)
        ++count;
    if (d != nullptr)
        closedir(d);
    return count - 2;
}

// A scene that cannot be saved completely must leave the existing file unchanged.
void safety()
{
    char scratch[] = "/tmp/fbsave.XXXXXX";
    if (mkdtemp(scratch) == nullptr) {
        check(false, "a folder to save in");
        return;
    }
    const std::string directory = scratch, name = directory + "/a.fb", link = directory + "/link.fb";
    Model small, large;
    read(S, small);
    read("sphere s size 9 repeat 100\n", large);
    check(writeScene(name.c_str(), small) == nullptr, "a new file");
    const std::string before = contents(name);
    check(before.find("sphere s size 20") != std::string::npos && filesIn(directory) == 1, "the scene, and no other file");

    // The file size is limited, so that only half of the scene fits.
    const auto old = signal(SIGXFSZ, SIG_IGN);
    rlimit limit, was;
    getrlimit(RLIMIT_FSIZE, &was);
    limit = was;
    limit.rlim_cur = 1000;
    setrlimit(RLIMIT_FSIZE, &limit);
    const char* wrong = writeScene(name.c_str(), large);
    setrlimit(RLIMIT_FSIZE, &was);
    signal(SIGXFSZ, old);
    check(wrong != nullptr && name + ": disk full" == wrong, "a full disk is told");
    check(contents(name) == before && filesIn(directory) == 1, "and what was there is there still, alone");

    check(writeScene(name.c_str(), large) == nullptr && contents(name).size() > 2000 && filesIn(directory) == 1, "written over it");
    // A file that is saved through a symbolic link keeps its permissions, and the link stays a link.
    chmod(name.c_str(), 0640);
    check(symlink("a.fb", link.c_str()) == 0 && writeScene(link.c_str(), small) == nullptr, "saved through a link");
    struct stat facts;
    check(contents(name) == before && lstat(link.c_str(), &facts) == 0 && S_ISLNK(facts.st_mode), "the link stays one");
    check(stat(name.c_str(), &facts) == 0 && (facts.st_mode & 0777) == 0640, "the file keeps its rights");
    check(writeScene("/dev/null", small) == nullptr && stat("/dev/null", &facts) == 0 && S_ISCHR(facts.st_mode),
          "a device stays a device");
    wrong = writeScene((directory + "/none/a.fb").c_str(), small);
    check(wrong != nullptr && directory + "/none/a.fb: no such file or directory" == wrong, "no such folder");

    // Scenes can be named without the ending of the file name.
    Model again;
    SceneEnd end;
    check(readScene((directory + "/a").c_str(), again, &end) == nullptr && again.count() == 1, "a.fb by the name a");
    Model none;
    wrong = readScene((directory + "/b").c_str(), none, &end);
    check(wrong != nullptr && end == SCENE_BAD && directory + "/b: no such file or directory" == wrong, "there is no b");
    unlink(link.c_str());
    unlink(name.c_str());
    rmdir(scratch);
}

void links()
{
    Model model;
    Real weight;
    check(read("sphere a size 9\nsphere b size 9\nsphere c size 9\nblend a b 0.5\nblend b c\nblend a b 0.25", model) == nullptr,
          "links are read");
    SoftObject *a = model.actor(0).object, *b = model.actor(1).object, *c = model.actor(2).object;
    check(Model::linked(a, b, &weight) && weight == Real(0.25), "a link given twice has the later weight");
    check(Model::linked(b, a, &weight) && weight == Real(0.25), "both ways");
    check(Model::linked(c, b, &weight) && weight == Real(1), "a link without a weight has 1");
    check(!Model::linked(a, c, &weight), "what was not linked is not");
    Model all;
    read("sphere a size 9\nsphere b size 9\nsphere c size 9\nblend all 2\nsphere d size 9", all);
    check(Model::linked(all.actor(0).object, all.actor(2).object, &weight) && weight == Real(2), "blend all");
    check(!Model::linked(all.actor(0).object, all.actor(3).object, &weight), "all are those above");
    check(model.actor(2).object->number() == 3, "numbers count from 1");
    Model look;
    read("eye 1 2 -100\nfocal 300\nlight 0 2 0\n" + S, look);
    check(look.camera.eye == Point{Real(1), Real(2), Real(-100)}, "eye");
    check(look.camera.focalX == Real(300) && look.camera.focalY == Real(250), "focal: pixels are 5 to 6");
    check(look.light == Vector{Real(0), Real(2), Real(0)}, "light");
    Model two;
    read("focal 300 100\n" + S, two);
    check(two.camera.focalY == Real(100), "focal, both");
}

// The text must be read, and at the given time the eye must be at `eye` with these axes.
void stands(const std::string& text, double seconds, const Vector& eye, const Vector& right, const Vector& up, const Vector& ahead)
{
    Model model;
    const char* wrong = read(text, model);
    if (wrong != nullptr) {
        check(false, std::string(wrong) + " in: " + text);
        return;
    }
    Anim::move(model, at(seconds));
    const Camera& camera = model.camera;
    const auto near = [](const Vector& a, const Vector& b) { return number(length(a - b)) < 0.01; };
    const bool good = near(toVector(camera.eye), eye) && near(camera.axes.right, right) && near(camera.axes.up, up) &&
                      near(camera.axes.ahead, ahead);
    if (!good) {
        for (const Vector& v : {toVector(camera.eye), camera.axes.right, camera.axes.up, camera.axes.ahead})
            printf("  %.3f %.3f %.3f\n", number(v.x), number(v.y), number(v.z));
    }
    check(good, std::to_string(seconds) + " s of: " + text);
}

Vector v(double x, double y, double z) { return {Real(x), Real(y), Real(z)}; }

bool putText(void* to, const char* line)
{
    *static_cast<std::string*>(to) += line;
    return true;
}

std::string textOf(const Model& model)
{
    std::string text;
    check(writeSceneText(putText, &text, model), "written");
    return text;
}

// Tests an eye that moves, turns and looks at something.
void eyes()
{
    const Vector x = v(1, 0, 0), y = v(0, 1, 0), z = v(0, 0, 1);
    const double h = std::sqrt(0.5);
    stands(S, 0, v(0, 0, -120), x, y, z);
    stands(S + "eye 1 2 3", 5, v(1, 2, 3), x, y, z);
    stands(S + "path eye x 10 4 0", 1, v(10, 0, -120), x, y, z);
    stands("eye 0 5 -100\n" + S + "path eye x 10 4 0\nkey eye 1 0 0 7\ncircle eye radius 3 plane yz period 4", 1,
           v(10, 5, -90), x, y, z);
    stands(S + "path eye x 10 4 0\neye 1 2 3", 1, v(11, 2, 3), x, y, z);
    stands(S + "eye 0 0 0 turn 0 90 0", 0, v(0, 0, 0), v(0, 0, -1), y, x);
    stands(S + "eye 0 0 0 turn 90 0 0", 0, v(0, 0, 0), x, z, v(0, -1, 0));
    stands(S + "spin eye axis 0 1 0 period 4", 1, v(0, 0, -120), v(0, 0, -1), y, x);
    stands("group g at 5 0 0\nspin g axis 0 1 0 period 4\neye 0 0 -100 in g\n" + S, 1, v(-95, 0, 0), v(0, 0, -1), y, x);
    // A later `eye` line replaces the earlier one: the eye has left the group.
    stands("group g at 5 0 0\neye 0 0 -100 in g\n" + S + "eye 0 0 -90 turn 0 0 0", 1, v(0, 0, -90), x, y, z);
    // The eye looks at a place or an item.
    stands(S + "eye 0 0 -100\nlook 100 0 0", 0, v(0, 0, -100), v(h, 0, -h), y, v(h, 0, h));
    stands(S + "look 0 0 -250", 0, v(0, 0, -120), -x, y, -z);
    stands(S + "look 0 100 -120\neye 0 0 -120", 0, v(0, 0, -120), x, -z, y);
    stands(S + "look 0 0 -120", 0, v(0, 0, -120), x, y, z);
    stands("sphere s size 20\npath s x 100 4 0\neye 0 0 -100\nlook s", 0, v(0, 0, -100), x, y, z);
    stands("sphere s size 20\npath s x 100 4 0\neye 0 0 -100\nlook s", 1, v(0, 0, -100), v(h, 0, -h), y, v(h, 0, h));
    stands(S + "eye 0 0 0\ncircle eye radius 100 plane zx period 4\nlook s", 1, v(100, 0, 0), z, y, -x);
    stands(S + "look 5 5 5\nlook s", 0, v(0, 0, -120), x, y, z);
    stands("group g at 0 0 9\n" + S + "look g\nlook 0 0 -250", 0, v(0, 0, -120), -x, y, -z);
    // The eye's own turn and roll tilt the view, whether or not the eye looks at something.
    stands(S + "eye 0 0 -120 turn 0 0 90\nlook s", 0, v(0, 0, -120), y, -x, z);
    stands(S + "roll 90", 0, v(0, 0, -120), -y, x, z);
    stands(S + "look 0 0 -250\nroll -90", 0, v(0, 0, -120), y, x, -z);
    // An object in the eye's group moves with the eye.
    place(S + "sphere lamp size 9 at 0 5 0 in eye\npath eye x 10 4 0", "lamp", 1, 10, 5, -120);
    // An object or group named `eye` takes precedence over the eye.
    place("sphere eye size 20\npath eye x 10 4 0", "eye", 1, 10, 0, 0);
    stands("sphere eye size 20\npath eye x 10 4 0", 1, v(0, 0, -120), x, y, z);
    stands("sphere eye size 20\npath eye x 120 4 0\nlook eye", 1, v(0, 0, -120), v(h, 0, -h), y, v(h, 0, h));

    refused(S + "eye 0 0 -120 turn 0 0", "T.FB:2: end of line: expected degrees about z from -360 to 360");
    refused(S + "eye 0 0 -120 in h", "T.FB:2: 'h': expected a group or an object of a line above");
    refused(S + "path eye x 1 4 0\ngroup g\neye 0 0 0 in g",
            "T.FB:4: 'g': expected a group or an object above the first line that moves the eye");
    refused(S + "sphere t size 9 in eye\neye 0 0 0 in t",
            "T.FB:3: 't': expected a group or an object above the first line that moves the eye");
    refused(S + "eye 0 0 0 in eye", "T.FB:2: 'eye': expected another group than the eye's own");
    refused("sphere eye size 20\neye 0 0 0 turn 0 9 0",
            "T.FB:2: 'eye': expected another name for the object or group of that name, for the eye moves");
    refused(S + "path eye x 1 4 0\nsphere eye size 9", "T.FB:3: 'eye': expected a name that is not taken yet");
    refused(repeated(64, "group g%d\n") + S + "spin eye axis 0 1 0 period 4",
            "T.FB:66: 'eye': expected at most 64 groups, the eye that moves among them");
    refused(S + "blend s eye", "T.FB:2: 'eye': expected the name of a second object");
    refused(S + "look", "T.FB:2: end of line: expected a place, or the name of an object or a group");
    refused(S + "look t", "T.FB:2: 't': expected the name of an object or a group of a line above");
    refused(S + "path eye x 1 4 0\nlook eye", "T.FB:3: 'eye': expected the name of an object or a group of a line above");
    refused(S + "look 0 300 0", "T.FB:2: '300': expected the place looked at, y from -250 to 250");
    refused(S + "look 0 0", "T.FB:2: end of line: expected the place looked at, z from -250 to 250");
    refused(S + "look s s", "T.FB:2: 's': expected the end of the line");
    refused(S + "roll 361", "T.FB:2: '361': expected degrees from -360 to 360");
    refused(S + "roll", "T.FB:2: end of line: expected degrees from -360 to 360");

    // A saved scene must read back as the same scene, and saving it again must give the same text.
    const std::string texts[] = {
        S + "eye 1 2 -100\nlook 3 4 5\nroll 10",
        "group g at 5 0 0\nspin g axis 0 1 0 period 4\neye 0 0 -100 turn 1 2 3 in g\n" + S +
            "path eye x 1 4 0 y 2 3 0.5\nkeys eye smooth\nkey eye 1 2 3 4 angle 30\nsphere t size 9 at 0 5 0 in eye\nlook s",
        S + "sphere t size 9\nsphere u size 8 in eye\nlook u",
        "sphere eye size 9\nlook eye",
    };
    for (const std::string& text : texts) {
        Model model, again;
        check(read(text, model) == nullptr, "read: " + text);
        const std::string saved = textOf(model);
        check(read(saved, again) == nullptr, "read again: " + saved);
        check(textOf(again) == saved, "and the same: " + saved);
        Anim::move(model, at(1.25));
        Anim::move(again, at(1.25));
        check(model.camera.eye == again.camera.eye && model.camera.axes == again.camera.axes, "its eye stands alike: " + saved);
    }

    // When the item looked at is removed, the eye keeps its direction. When the eye's own item is removed, the eye stays in place.
    Model model;
    read("sphere s size 20 at 120 0 0\nsphere t size 9\npath eye x 10 4 0.25\nlook s", model);
    model.resample(Real(4), makeEngine);
    Anim::move(model, 0);
    Model::Record* record = model.record();
    const ViewAxes axes = model.camera.axes;
    model.remove(model.itemNamed("s"));
    Anim::move(model, 0);
    check(model.camera.axes == axes && axes.turned, "it looks where something was");
    model.remove(model.itemNamed("eye"));
    Anim::move(model, at(1));
    check(model.camera.eye == Point{Real(10), Real(0), Real(-120)}, "an eye that has lost its group stands where it was");
    check(model.restore(record), "gone back");
    Anim::move(model, at(1));
    check(number(absolute(model.camera.eye.x)) < 0.01 && model.camera.looks == Camera::AT_ITEM, "it moves and looks as before");
    free(record);
}

void complaints()
{
    const char* const statements =
        "sphere, cylinder, torus, disc, cone, box, group, blend, dent, strength, circle, path, spin, swing, pulse, taper, twist, "
        "bend, keys, key, colours, finish, pattern, eye, look, roll, focal, light or title";
    refused("spere a size 3", std::string("T.FB:1: 'spere': expected ") + statements);
    refused(S + "\n# x\n7\n", std::string("T.FB:4: '7': expected ") + statements);
    refused("", "T.FB:1: 'end of file': expected at least one object");
    refused("group g\n", "T.FB:2: 'end of file': expected at least one object");
    refused("sphere\n", "T.FB:1: end of line: expected a name of 1 to 15 letters, digits, - or _, a letter first");
    refused("sphere 3 size 3", "T.FB:1: '3': expected a name of 1 to 15 letters, digits, - or _, a letter first");
    refused("sphere all size 3", "T.FB:1: 'all': expected another name; all stands for every object");
    refused(S + "group S", "T.FB:2: 's': expected a name that is not taken yet");
    refused("sphere a", "T.FB:1: end of line: expected size");
    refused("sphere a size", "T.FB:1: end of line: expected size from 1 to 100");
    refused("sphere a size 0.9", "T.FB:1: '0.9': expected size from 1 to 100");
    refused("sphere a size ten", "T.FB:1: 'ten': expected size from 1 to 100");
    refused("sphere a size 9 length 4", "T.FB:1: 'length': expected size, at, turn, colour, stretch, repeat, step or in");
    refused("cylinder a size 9", "T.FB:1: end of line: expected length");
    refused("cylinder a size 9 length 101", "T.FB:1: '101': expected length from 0 to 100");
    refused("torus a size 20 ring 12", "T.FB:1: 'a': expected a ring of at least five eighths of the size");
    refused("cone a size 50 tip 10 length 19",
            "T.FB:1: 'a': expected a length of at least half the difference of size and tip");
    refused("box a size 9 x 4 y 5", "T.FB:1: end of line: expected z");
    refused("box a size 9 x 4 y 101 z 3", "T.FB:1: '101': expected y from 0 to 100");
    refused("box a size 9 x 4 length 5", "T.FB:1: 'length': expected size, x, y, z, at, turn, colour, stretch, repeat, step or in");
    refused("sphere a size 9 stretch 1 2", "T.FB:1: end of line: expected a factor along z from 0.25 to 4");
    refused("sphere a size 9 stretch 5 1 1", "T.FB:1: '5': expected a factor along x from 0.25 to 4");
    refused("sphere a size 9 stretch 1 0.2 1", "T.FB:1: '0.2': expected a factor along y from 0.25 to 4");
    refused("sphere a size 60 stretch 4 1 1",
            "T.FB:1: 'a': expected a stretch that leaves all of it within 100 units of its centre");
    refused(S + "taper t 0.5", "T.FB:2: 't': expected the name of an object or a group");
    refused(S + "group g\ntaper g 0.5", "T.FB:3: 'g': expected the name of an object");
    refused(S + "taper s", "T.FB:2: end of line: expected a share of the width from -0.75 to 0.75");
    refused(S + "taper s 0.8", "T.FB:2: '0.8': expected a share of the width from -0.75 to 0.75");
    refused(S + "twist s 361", "T.FB:2: '361': expected degrees from -360 to 360");
    refused(S + "bend s -181", "T.FB:2: '-181': expected degrees from -180 to 180");
    refused(S + "bend s 20 swing 200 period 4", "T.FB:2: '200': expected degrees from -180 to 180");
    refused(S + "bend s 20 swing 30", "T.FB:2: end of line: expected period");
    refused(S + "bend s 20 period 4", "T.FB:2: end of line: expected swing");
    refused(S + "bend s 20 angle 4", "T.FB:2: 'angle': expected swing, period or phase");
    refused(S + "bend s 20 swing 3 period 4 lag 0.1", "T.FB:2: 'lag': expected no lag, for this name is no row's");
    refused("group g stretch 1 1 2", "T.FB:1: 'stretch': expected at, turn, scale, repeat, step or in");
    refused("group g colour 1 2 3", "T.FB:1: 'colour': expected at, turn, scale, repeat, step or in");
    refused("sphere a size 9 at 1 2", "T.FB:1: end of line: expected a place, z from -250 to 250");
    refused("sphere a size 9 at 1 251 2", "T.FB:1: '251': expected a place, y from -250 to 250");
    refused("sphere a size 9 turn 1 2 361", "T.FB:1: '361': expected degrees about z from -360 to 360");
    refused("sphere a size 9 colour 1 2 256", "T.FB:1: '256': expected red, green and blue from 0 to 255");
    refused("sphere a size 9 in b", "T.FB:1: 'b': expected a group or an object of a line above");
    refused("sphere a size 9 in a", "T.FB:1: 'a': expected a group or an object of a line above");
    refused(S + "circle t radius 1 period 1", "T.FB:2: 't': expected the name of an object or a group");
    refused(S + "circle s radius 1", "T.FB:2: end of line: expected period");
    refused(S + "circle s period 1", "T.FB:2: end of line: expected a radius, or both u and v");
    refused(S + "circle s u 1 0 0 period 1", "T.FB:2: end of line: expected a radius, or both u and v");
    refused(S + "circle s plane yz u 1 0 0 v 0 1 0 period 1", "T.FB:2: end of line: expected a plane only beside a radius");
    refused(S + "circle s radius 2 plane xx period 1", "T.FB:2: 'xx': expected xy, yz, zx, yx, zy or xz");
    refused(S + "circle s radius 2 period 0.05",
            "T.FB:2: '0.05': expected 0.1 seconds or more, or -0.1 or less to go backwards");
    refused(S + "circle s radius 2 period 3601", "T.FB:2: '3601': expected seconds from -3600 to 3600");
    refused(S + "circle s radius 2 period 1 phase 2", "T.FB:2: '2': expected a phase in turns from -1 to 1");
    refused(S + "circle s size 2", "T.FB:2: 'size': expected radius, plane, u, v, period or phase");
    refused(S + "path s", "T.FB:2: end of line: expected x, y or z, each with amplitude, period and phase");
    refused(S + "path s x 4 3", "T.FB:2: end of line: expected a phase in turns from -1 to 1");
    refused(S + "spin s period 3", "T.FB:2: end of line: expected axis");
    refused(S + "spin s axis 0 0 0 period 3", "T.FB:2: '0': expected a direction, not 0 0 0");
    refused(S + "spin s axis 0 0 1 angle 3", "T.FB:2: 'angle': expected axis, period or phase");
    refused(S + "swing s axis 0 0 1 period 3", "T.FB:2: end of line: expected angle");
    refused(S + "pulse s by 1 period 3", "T.FB:2: '1': expected a share of the size from 0 to 0.75");
    refused(S + "keys s cubic", "T.FB:2: 'cubic': expected linear, smooth, repeat or axis");
    refused(S + "key s 1 0 0 0\nkeys s smooth", "T.FB:3: 's': expected keys before the first key");
    refused(S + "key s 1 0 0 0\nkey s 1 0 0 0", "T.FB:3: '1': expected a time after that of the key before");
    refused(S + "keys s repeat 2\nkey s 2 0 0 0", "T.FB:3: '2': expected a time before that of repeat");
    refused(S + "key s 1 0 0 0 spin 2", "T.FB:2: 'spin': expected angle or scale");
    refused(S + "blend s", "T.FB:2: end of line: expected the name of a second object");
    refused(S + "blend s s", "T.FB:2: 's': expected the name of a second object");
    refused(S + "group g\nblend s g", "T.FB:3: 'g': expected the name of a second object");
    refused(S + "blend", "T.FB:2: end of line: expected all, or the name of an object");
    refused(S + "sphere t size 9\nblend s t 5", "T.FB:3: '5': expected a weight from 0 to 4");
    refused(S + "sphere t size 9\nblend s t 1 2", "T.FB:3: '2': expected the end of the line");
    refused(S + "light 0 0 0", "T.FB:2: '0': expected a direction, not 0 0 0");
    refused(S + "focal 501", "T.FB:2: '501': expected pixels across from 1 to 500");
    refused(S + "eye 0 0 -120 9", "T.FB:2: '9': expected turn, in or the end of the line");
    refused(S + "\xff\x01\n", std::string("T.FB:2: '?\?': expected ") + statements);
    refused(std::string("sphere s\0 size 20", 17),
            "T.FB:1: 's?': expected a name of 1 to 15 letters, digits, - or _, a letter first");
}

void limits()
{
    taken(repeated(128, "sphere s%d size 9\n") + "blend all", "128 objects, every pair linked");
    refused(repeated(129, "sphere s%d size 9\n"), "T.FB:129: 's129': expected at most 128 objects");
    taken(repeated(64, "group g%d\n") + S, "64 groups");
    refused(repeated(65, "group g%d\n"), "T.FB:65: 'g65': expected at most 64 groups");
    taken(S + repeated(1024, "key s %d 0 0 0\n"), "1024 keys");
    refused(S + repeated(1025, "key s %d 0 0 0\n"), "T.FB:1026: 'key': expected at most 1024 keys");
    taken("sphere abcdefghijklmno size 9", "a name of 15 letters");
    refused("sphere abcdefghijklmnop size 9",
            "T.FB:1: 'abcdefghijklmnop': expected a name of 1 to 15 letters, digits, - or _, a letter first");
    taken(S + "#" + std::string(249, 'x') + "\r\n", "a line of 250 characters");
    refused(S + "#" + std::string(250, 'x') + "\n", "T.FB:2: '...': expected a line of at most 250 characters");
    refused(S + "circle" + std::string(250, ' ') + "s\n",
            "T.FB:2: 'circle              ...': expected a line of at most 250 characters");
    taken(S + std::string(31998, '\n') + "#", "32000 lines");
    taken(S + std::string(31998, '\n') + "#\n", "32000 lines, the last one ended");
    refused("sphere s size 20." + std::string(40, '0') + "abc",
            "T.FB:1: '20.000000000000000000000000000?': expected size from 1 to 100");
    refused(S + std::string(31999, '\n') + "#\n", "T.FB:32001: 'one more line': expected at most 32000 lines");
    taken(S + repeated(8, "blend all # %d\n"), "8 times blend all");
    refused(S + repeated(9, "blend all # %d\n"), "T.FB:10: 'all': expected blend all in at most 8 lines");
    std::string deep = "group g0 at 1 0 0\n";
    for (int i = 1; i < 64; ++i) {
        char line[60];
        snprintf(line, sizeof line, "group g%d at 1 0 0 in g%d\n", i, i - 1);
        deep += line;
    }
    place(deep + "sphere s size 9 at 1 0 0 in g63", "s", 0, 65, 0, 0);
}

// Changes a model while it runs, and restores the model from a record.
void changes()
{
    Model model;
    read("group g at 10 0 0 turn 0 0 90\nsphere a size 9\nsphere b size 9 at 5 0 0 in g\ncylinder c size 9 length 8 in b\n"
         "key a 0 0 0 0\nkey a 2 1 1 1\nkey c 0 0 1 0\nkey c 1 0 2 0\nblend all 0.5", model);
    model.resample(Real(2), makeEngine);
    Anim::move(model, 0);
    Model::Record* record = model.record();
    check(record != nullptr, "a record");
    SoftObject* a = model.actor(0).object;
    const Point was = model.itemNamed("c")->pose.place;

    model.remove(model.itemNamed("b"));
    check(model.count() == 2 && model.items() == 3, "an object taken out");
    Anim::move(model, 0);
    check(length(model.itemNamed("c")->pose.place - was) < Real(0.01), "what it carried stays where it is");
    Real weight;
    check(Model::linked(a, model.actor(1).object, &weight) && weight == Real(0.5), "other links stay");
    model.remove(model.itemNamed("a"));
    check(model.keyCount() == 2, "its keys go with it");
    Anim::move(model, at(1));
    check(length(model.itemNamed("c")->pose.place - was) > Real(0.9), "other keys still hold");
    model.remove(model.itemNamed("g"));
    check(model.count() == 1 && model.items() == 1 && model.item(0).motion.parent == 0, "a group taken out");

    check(model.restore(record), "gone back");
    check(model.count() == 3 && model.items() == 4 && model.keyCount() == 4, "everything is there again");
    Anim::move(model, 0);
    check(model.itemNamed("c")->pose.place == was, "in its place");
    check(Model::linked(model.actor(0).object, model.actor(2).object, &weight) && weight == Real(0.5), "and linked");
    check(model.actor(0).object->seeds() > 0 && model.actor(1).object->seeds() > 0, "with seeds");

    a = model.actor(0).object;
    model.actor(0).measure[0] = Real(30);
    check(model.remake(&model.actor(0)), "made anew");
    check(model.actor(0).object->size() == Real(30), "with its new size");
    check(Model::linked(model.actor(1).object, model.actor(0).object, &weight) && weight == Real(0.5), "and its links");
    check(model.restore(record) && model.actor(0).object->size() == Real(9), "and back");
    a = model.actor(0).object;
    check(model.restore(record) && model.actor(0).object == a, "what did not change keeps its object");
    free(record);
}

}  // namespace

int main()
{
    makeFieldSteps();
    makeNormalTable();
    motion();
    sums();
    titles();
    colours();
    paints();
    rows();
    saved();
    turnedBalls();
    dents();
    safety();
    links();
    eyes();
    complaints();
    limits();
    changes();
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
