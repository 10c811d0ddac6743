// Feeds random scenes (scenes.h) to the reader, in process: scenes without a mistake, scenes with slips, and both of these and
// the FILEs after random changes. It checks for each scene:
//
//   - The scene is read, or it is refused with one line of plain text that names the file. A scene without a mistake is read,
//     unless it has more objects, keys or motions than are allowed.
//   - A scene that was read is shown at several times, written, and read again: this gives the same objects at the same
//     places, and writing it again gives the same text.
//
//   fuzz COUNT SEED FILE...          COUNT scenes, the FILEs first; the same SEED gives the same scenes
//   fuzz --draw COUNT SEED FILE...   also plays one in four of the scenes that are read, in whole pictures
//
// The program is built with the sanitizers, which find crashes, undefined behaviour and leaks. An input that takes longer
// than one to two minutes of processor time counts as a hang. The input that failed is left in build/fuzzfail.fb.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <sys/time.h>
#include <unistd.h>
#include <vector>

#include "../drawobj.h"
#include "scenes.h"

#include "model/field.h"
#include "model/scene.h"
#include "picture/palette.h"
#include "math/normal.h"
#include "surface/engine.h"

namespace {

std::string current;
volatile unsigned long round_ = 0, roundSeen = 0;

void keepInput()
{
    FILE* file = fopen("build/fuzzfail.fb", "wb");
    if (file != nullptr) {
        fwrite(current.data(), 1, current.size(), file);
        fclose(file);
    }
}

[[noreturn]] void failed(const char* what)
{
    keepInput();
    printf("FAILED: input %lu: %s (kept in build/fuzzfail.fb)\n", round_, what);
    fflush(stdout);
    _exit(1);
}

// Fails unless this holds, and prints the complaint of the reader that goes with it.
void must(bool holds, const char* what, const char* complaint = nullptr)
{
    if (holds)
        return;
    if (complaint != nullptr)
        puts(complaint);
    failed(what);
}

// Calls onAlarm() after a minute of the program's own time: a busy machine makes no hang, and under the sanitizers a large scene
// with dents takes a quarter of that.
void watch()
{
    const itimerval limit{{0, 0}, {60, 0}};
    setitimer(ITIMER_VIRTUAL, &limit, nullptr);
}

void onAlarm(int)
{
    if (round_ == roundSeen)
        failed("a hang");
    roundSeen = round_;
    watch();
}

// The sanitizers call this before they stop the program, so that the input is kept.
extern "C" void __sanitizer_set_death_callback(void (*callback)(void));

bool putLine(void* to, const char* line)
{
    must(strlen(line) <= static_cast<size_t>(LINE_MOST) + 1, "a written line is too long");
    static_cast<std::string*>(to)->append(line);
    return true;
}

// Returns whether objects i and j are linked, and j digs into i, with the same weights in both models.
bool sameLinks(const Model& model, const Model& again, int i, int j)
{
    const SoftObject *a = model.actor(i).object, *b = model.actor(j).object;
    const SoftObject *a2 = again.actor(i).object, *b2 = again.actor(j).object;
    Real weight(0), weight2(0);
    if (Model::linked(a, b, &weight) != Model::linked(a2, b2, &weight2) || weight != weight2)
        return false;
    weight = weight2 = Real(0);
    return Model::dented(a, b, &weight) == Model::dented(a2, b2, &weight2) && weight == weight2;
}

// Returns whether two items have the same measures, stretch, taper, twist and bend, and the same motions of these.
bool sameShape(const Actor& a, const Actor& b)
{
    for (int i = 0; i < MEASURES_MOST; ++i)
        if (a.measure[i] != b.measure[i])
            return false;
    for (int i = 0; i < WARP_PARTS; ++i) {
        const Swaying &x = a.motion.warp[i], &y = b.motion.warp[i];
        if (x.amount != y.amount || x.swing != y.swing || x.wave.period != y.wave.period || x.wave.phase != y.wave.phase)
            return false;
    }
    if (a.object != nullptr && (a.object->warped() != b.object->warped() ||
                                (a.object->warped() && !(a.object->warp().asked() == b.object->warp().asked()))))
        return false;
    return a.stretch == b.stretch;
}

const Time TIMES[] = {0, 65536 / 10, 65536 * 3 + 777, 12345678, 65536ull * 3599, 65536ull * 86400 * 30, 0xffffffffffffull};

// Draws a frame as the program does, but for the order of the objects.
void drawFrame(Model& model, View& view, const Palette& palette, bool report98)
{
    Counts counts{};
    const Camera& camera = view.camera();
    FrameContext frame{camera.eye, unit(model.light), model.prepareBodies(), &counts, camera.axes,
                       camera.centreX / camera.focalX, camera.centreY / camera.focalY};
    must(frame.bodies != nullptr, "no memory for bodies");
    view.begin();
    for (int i = 0; i < model.count(); ++i) {
        drawObject(*model.actor(i).object, frame, view);
        frame.hider = &view;
    }
    if (!report98)
        view.closeGaps(model.coarsest(), &model, &palette);
    view.end();
}

// Plays a scene: two frames a moment apart at each of some times, and a few more from the beginning on.
void draw(Model& model, bool report98, bool grey)
{
    static Palette palette;
    // The seeds of a very large object may need more roots than there are numbers for.
    if (!model.resample(Real(6), makeEngine)) {
        must(strstr(SoftObject::resampleTrouble(), "is the limit") != nullptr, "no seeds", SoftObject::resampleTrouble());
        return;
    }
    // Very many seeds among many objects take minutes under the sanitizers: there are fewer frames of them, or none, and none by
    // the report's method, which asks every object for each seed. Where all of many objects meet each pair of them is looked at.
    long seeds = 0, left = 2000000;
    for (int i = 0; i < model.count(); ++i)
        seeds += model.actor(i).object->seeds();
    const long asked = seeds * model.count(), work = asked * (model.count() + 16) / 16;
    report98 = report98 && asked < 200000;
    palette.make(model, grey, report98);
    must(!report98 || model.resample(Real(6), makeReport98), "no seeds for /P", SoftObject::resampleTrouble());
    View view;
    must(view.open(report98), "no memory for the picture");
    view.setCamera(model.camera);
    for (Time time : TIMES)
        for (int i = 0, frames = time == 0 ? 12 : 2; i < frames && left >= work; ++i, left -= work) {
            Anim::move(model, time + 65536 / 35 * static_cast<Time>(i));
            drawFrame(model, view, palette, report98);
        }
}

std::string contents(const char* name)
{
    FILE* file = fopen(name, "rb");
    if (file == nullptr) {
        fprintf(stderr, "fuzz: cannot read %s\n", name);
        exit(2);
    }
    std::string text;
    for (int c = getc(file); c != EOF; c = getc(file))
        text += static_cast<char>(c);
    fclose(file);
    return text;
}

// The files, and behind them some of the scenes that were read: further changes of these accumulate.
class Pool {
public:
    explicit Pool(char** files)
    {
        for (; files[given_] != nullptr; ++given_)
            texts_.push_back(contents(files[given_]));
    }

    // Makes the next input. Returns whether it is a scene without a mistake.
    bool next(Random& random) const
    {
        // The files themselves come first, unchanged.
        if (round_ < given_) {
            current = texts_[round_];
            return false;
        }
        switch (random.below(5)) {
        case 0: current = makeScene(random, 0); return true;
        case 1: current = makeScene(random, 40 + random.below(400)); break;
        case 2:
            current = makeScene(random, random.below(200));
            change(random, current, random.pick(texts_));
            break;
        case 3:
            current = texts_[random.below(given_)];
            change(random, current, makeScene(random, 0));
            break;
        default:
            current = random.pick(texts_);
            change(random, current, random.pick(texts_));
            break;
        }
        return false;
    }

    void keep(Random& random)
    {
        if (texts_.size() < given_ + 400)
            texts_.push_back(current);
        else
            texts_[given_ + random.below(400)] = current;
    }

private:
    size_t given_ = 0;
    std::vector<std::string> texts_;
};

void checkComplaint(const char* complaint, SceneEnd end, bool faultless)
{
    must(end == SCENE_BAD, "refused for another reason than the text", complaint);
    must(strncmp(complaint, "FUZZ.FB:", 8) == 0 && strstr(complaint, ": expected ") != nullptr,
         "the complaint does not say where and what");
    for (const char* c = complaint; *c != 0; ++c)
        must(*c >= ' ' && *c <= '~' && c - complaint <= 400, "the complaint is not one line of plain text");
    must(!faultless || strstr(complaint, "expected at most") != nullptr || strstr(complaint, "blend all in at most") != nullptr ||
             strstr(complaint, "a time after") != nullptr,
         "refused without a mistake", complaint);
}

bool inSpace(const Point& p)
{
    return absolute(p.x) <= Real(SPACE) && absolute(p.y) <= Real(SPACE) && absolute(p.z) <= Real(SPACE);
}

void checkEye(const Camera& eye, const Camera& again)
{
    must(eye.eye == again.eye && eye.axes == again.axes, "seen from elsewhere when read again");
    must(inSpace(eye.eye), "the eye left the space of the model");
    const ViewAxes& axes = eye.axes;
    const Real slack(0.001);
    must(absolute(length(axes.right) - Real(1)) <= slack && absolute(length(axes.ahead) - Real(1)) <= slack &&
             length(cross(axes.ahead, axes.right) - axes.up) <= slack && absolute(dot(axes.ahead, axes.right)) <= slack,
         "the axes of the view are none");
}

void checkItem(const Actor& item, const Actor& again)
{
    const Coat &coat = item.coat, &other = again.coat;
    must(coat.finish == other.finish && coat.pattern == other.pattern && coat.grain == other.grain && coat.colour == other.colour,
         "another paint when read again");
    must(item.strength == again.strength, "another strength when read again");
    must(sameShape(item, again), "another shape when read again");
    const Pose &a = item.pose, &b = again.pose;
    must(a.place == b.place && a.scale == b.scale && memcmp(&a.turn, &b.turn, sizeof a.turn) == 0,
         "moves in another way when read again");
    must(inSpace(a.place), "left the space of the model");
}

void checkSame(Model& model, Model& again)
{
    must(strcmp(model.title, again.title) == 0, "another title when read again");
    must(model.count() == again.count() && model.items() == again.items() && model.keyCount() == again.keyCount(),
         "not as many objects, groups or keys when read again");
    must(model.mixed == again.mixed, "colours that mix, or not, when read again");
    for (int i = 0; i < model.count(); ++i)
        for (int j = 0; j < model.count(); ++j)
            must(sameLinks(model, again, i, j), "other links or dents when read again");
    for (Time time : TIMES) {
        Anim::move(model, time);
        Anim::move(again, time);
        checkEye(model.camera, again.camera);
        for (int i = 0; i < model.items(); ++i)
            checkItem(model.item(i), again.item(i));
    }
}

// Reads the input, writes what was read, and reads that again. Returns false if the input is refused.
bool checkReading(Model& model, bool faultless)
{
    SceneEnd end = SCENE_GOOD;
    const char* complaint = readSceneText("FUZZ.FB", current.data(), static_cast<uint32_t>(current.size()), model, &end);
    if (complaint != nullptr) {
        checkComplaint(complaint, end, faultless);
        return false;
    }
    must(end == SCENE_GOOD, "read, but the end says otherwise");
    std::string first, second;
    writeSceneText(putLine, &first, model);
    Model again;
    complaint = readSceneText("AGAIN.FB", first.data(), static_cast<uint32_t>(first.size()), again, &end);
    must(complaint == nullptr, "what was written is refused", complaint);
    writeSceneText(putLine, &second, again);
    must(first == second, "written twice, and not the same");
    checkSame(model, again);
    return true;
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
    Random random(strtoull(arguments[2], nullptr, 10) * 2654435761u + 1);
    Pool pool(arguments + 3);
    makeFieldSteps();
    makeNormalTable();
    signal(SIGVTALRM, onAlarm);
    watch();
    __sanitizer_set_death_callback(keepInput);

    unsigned long taken = 0, refused = 0, drawn = 0, whole = 0;
    for (round_ = 0; round_ < rounds; ++round_) {
        const bool faultless = pool.next(random);
        whole += faultless;
        Model model;
        if (!checkReading(model, faultless)) {
            ++refused;
            continue;
        }
        ++taken;
        if (draws && random.once(4)) {
            ++drawn;
            const bool report98 = random.once(4), grey = random.once(4);
            draw(model, report98, grey);
        }
        if (random.once(8))
            pool.keep(random);
    }
    printf("%lu scenes, %lu of them without a mistake: %lu read, written and read again, %lu refused, %lu drawn\n", rounds, whole,
           taken, refused, drawn);
    return 0;
}
