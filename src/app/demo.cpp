// The program: a frame is move, update, draw, show, present; once through the house, no back and forth.
#include "app/demo.h"

#include "math/alloc.h"
#include "app/csv.h"
#include "app/dump.h"
#include "app/edit.h"
#include "machine.h"
#include "app/options.h"
#include "app/overlay.h"
#include "picture/palette.h"
#include "surface/engine.h"
#include "model/scene.h"
#include "math/normal.h"
#include "app/stats.h"
#include "math/text.h"

namespace {

// Interactive mode: mickeys to units, and where objects may be moved to.
constexpr Real UNITS_A_MICKEY(0.25);
constexpr Real UNITS_A_KEY(2);
constexpr Real DEPTH_LEAST(-60);
constexpr Real DEPTH_MOST(120);

// Hands on: what a key does at once, how long a message stays, and where scenes are kept.
constexpr Real DEGREES_A_KEY(15);
constexpr Real SIZE_A_KEY(1);
constexpr Time MESSAGE = 65536 * 3;
constexpr const char* SCENE_FILE = "SAVED.FB";

constexpr int KEY_BACKSPACE = 8;

// The selected object pulses this long.
constexpr Time PULSE = 65536 * 3 / 4;
constexpr int PULSE_STEPS = 20;

class Demo {
public:
    explicit Demo(const Options& options) : options_(options), overlay_(view_), editor_(model_) {}
    ~Demo() { free(voxels_); }

    int run();

private:
    SurfaceMaker surfaceMaker() const { return options_.printed ? makeReport98 : makeEngine; }
    const char* prepare(int* status);
    void key(int code);
    void mouse();
    void push(Real x, Real y, Real z);
    void select();
    void resample(Real spacing);
    bool editKey(int code);
    void changed();
    void frame();
    void drawOverlay();
    void countFrames();
    bool finished() const;
    void findTime();

    const Options& options_;
    Model model_;
    View view_;
    Palette palette_;
    Csv csv_;
    Dump dump_;
    Stats stats_;
    VoxelList* voxels_ = nullptr;
    Counts counts_;
    Real spacing_{2};
    uint64_t started_ = 0;
    Time time_ = 0;
    int frames_ = 0;
    bool ended_ = false;
    bool mousePresent_ = false;
    bool leftHeld_ = false;
    Time selectedAt_ = 0;

    // Hands on.
    Overlay overlay_;
    Editor editor_;
    Time shown_ = 0;        // the time the model is shown at; in interactive mode it stands unless the user lets it run
    Time lastTime_ = 0;
    bool running_ = false;
    Time messageAt_ = 0;
    bool message_ = false;
    bool help_ = false;
    bool fps_ = false;
    uint64_t fpsSince_ = 0;  // ticks
    int fpsFrames_ = 0;
    uint32_t fpsTicks_ = 0;  // of the frames counted last
    int fpsCounted_ = 0;
};

// Everything that can fail, before the video mode is touched. Null, or one line; `*status` is then the exit status.
const char* Demo::prepare(int* status)
{
    makeFieldSteps();
    makeNormalTable();
    spacing_ = options_.spacing;
    *status = 1;
    if (options_.modelFile != nullptr) {
        SceneEnd end;
        const char* problem = readScene(options_.modelFile, model_, &end);
        *status = end;
        if (problem != nullptr)
            return problem;
        *status = 1;
    } else if (!model_.makeFourSpheres()) {
        return "not enough memory for the model";
    }
    Anim::move(model_, 0);
    if (!model_.resample(spacing_, surfaceMaker()))
        return "not enough memory for seeds that close; try a larger spacing with /S";
    voxels_ = allocate<VoxelList>(1);
    if (voxels_ == nullptr || !view_.open())
        return "not enough memory for the picture";
    view_.setCamera(model_.camera);
    palette_.make(model_, options_.grey);
    overlay_.setPalette(palette_);
    if (options_.recordFile != nullptr) {
        const char* problem = csv_.check(options_.recordFile, status);
        if (problem != nullptr)
            return problem;
        *status = 1;
    }
    if (options_.dumpDirectory != nullptr)
        return dump_.open(options_.dumpDirectory);
    return nullptr;
}

void Demo::findTime()
{
    if (options_.frames > 0) {
        // Each frame advances the animation by the same step, whatever the clock says.
        uint32_t rest;
        time_ = divide64(static_cast<uint64_t>(frames_) << 16, static_cast<uint32_t>(options_.rate), &rest);
        return;
    }
    uint64_t ticks = machine::clock() - started_;
    uint32_t rest;
    const uint64_t seconds = divide64(ticks, machine::CLOCK_HZ, &rest);
    uint32_t unused;
    time_ = (seconds << 16) + divide64(static_cast<uint64_t>(rest) << 16, machine::CLOCK_HZ, &unused);
}

void Demo::select()
{
    editor_.selectNext();
    selectedAt_ = time_;
}

void Demo::push(Real x, Real y, Real z)
{
    // Kept where the viewer sees it: the centre stays on the screen. What is beyond already may come back by itself.
    const Point from = model_.actor(editor_.selected()).object->centre();
    const Camera& camera = model_.camera;
    Point p = from + Vector{x, y, z};
    p.z = clamp(p.z, least(DEPTH_LEAST, from.z), most(DEPTH_MOST, from.z));
    const Real away = most(p.z - camera.eye.z, Real(1));
    const Real right = away * (camera.centreX / camera.focalX), up = away * (camera.centreY / camera.focalY);
    p.x = clamp(p.x, least(camera.eye.x - right, from.x), most(camera.eye.x + right, from.x));
    p.y = clamp(p.y, least(camera.eye.y - up, from.y), most(camera.eye.y + up, from.y));
    if (editor_.move(p - from, time_))
        Anim::move(model_, shown_);
}

void Demo::mouse()
{
    const machine::Mouse m = machine::mouse();
    if (m.left && !leftHeld_)
        select();
    leftHeld_ = m.left;
    if (m.dx == 0 && m.dy == 0)
        return;
    const Real dx = Real(m.dx) * UNITS_A_MICKEY, dy = Real(m.dy) * UNITS_A_MICKEY;
    if (m.right)
        push(dx, Real(0), -dy);
    else
        push(dx, -dy, Real(0));
}

void Demo::resample(Real spacing)
{
    if (spacing < SPACING_LEAST || spacing > SPACING_MOST || !model_.resample(spacing, surfaceMaker()))
        return;  // at the end of the range, or of memory: it stays as it is
    spacing_ = spacing;
    stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());
}

void Demo::key(int code)
{
    switch (code) {
    case machine::KEY_ESC: ended_ = true; return;
    case '*': view_.setPixels(!view_.pixels()); return;
    case '-':
    case '_': resample(least(spacing_ * Real(1.25), SPACING_MOST)); return;
    case '+':
    case '=': resample(most(spacing_ * Real(0.8), SPACING_LEAST)); return;
    default: break;
    }
    if (code == machine::KEY_F1) {
        help_ = !help_;
        return;
    }
    if (code == 'f' || code == 'F') {
        fps_ = !fps_;
        fpsSince_ = machine::clock();
        fpsFrames_ = 0;
        return;
    }
    if (!options_.interactive)
        return;
    if (editKey(code)) {
        message_ = true;
        messageAt_ = time_;
        return;
    }
    const Real step = UNITS_A_KEY, none(0);
    switch (code) {
    case '\t': select(); break;
    case machine::KEY_LEFT: push(-step, none, none); break;
    case machine::KEY_RIGHT: push(step, none, none); break;
    case machine::KEY_UP: push(none, step, none); break;
    case machine::KEY_DOWN: push(none, -step, none); break;
    case machine::KEY_PGUP: push(none, none, step); break;
    case machine::KEY_PGDN: push(none, none, -step); break;
    case ' ': running_ = !running_; break;
    default: break;
    }
}

// The keys that edit the model. False: `code` is none of them.
bool Demo::editKey(int code)
{
    const Real turn = DEGREES_A_KEY, size = SIZE_A_KEY;
    bool done = false;
    switch (code) {
    case 'x': done = editor_.turn(0, turn, time_); break;
    case 'X': done = editor_.turn(0, -turn, time_); break;
    case 'y': done = editor_.turn(1, turn, time_); break;
    case 'Y': done = editor_.turn(1, -turn, time_); break;
    case 'z': done = editor_.turn(2, turn, time_); break;
    case 'Z': done = editor_.turn(2, -turn, time_); break;
    case '1':
    case '[': done = editor_.size(-size, time_); break;
    case '2':
    case ']': done = editor_.size(size, time_); break;
    case '3':
    case ',': done = editor_.measure(-size, time_); break;
    case '4':
    case '.': done = editor_.measure(size, time_); break;
    case machine::KEY_INS:
    case 'a': done = editor_.add("sphere"); break;
    case 'c': done = editor_.add("cylinder"); break;
    case 't': done = editor_.add("torus"); break;
    case 'd': done = editor_.add("disc"); break;
    case 'n': done = editor_.add("cone"); break;
    case machine::KEY_DEL: done = editor_.remove(); break;
    case 'l': done = editor_.link(); break;
    case 'k': done = editor_.unlink(); break;
    case 'u':
    case KEY_BACKSPACE: done = editor_.undo(); break;
    case machine::KEY_F2: editor_.save(SCENE_FILE); break;
    case machine::KEY_F3: done = editor_.load(SCENE_FILE, spacing_); break;
    default: return false;
    }
    if (done)
        changed();
    return true;
}

// Brings everything along that depends on which objects there are.
void Demo::changed()
{
    Anim::move(model_, shown_);
    palette_.make(model_, options_.grey);
    machine::setPalette(palette_.dac());
    overlay_.setPalette(palette_);
    view_.setCamera(model_.camera);
    stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());
}

// Frames a second, from the frames of the last half second or more.
void Demo::countFrames()
{
    ++fpsFrames_;
    const uint64_t ticks = machine::clock() - fpsSince_;
    if (ticks < machine::CLOCK_HZ / 2)
        return;
    fpsCounted_ = fpsFrames_;
    fpsTicks_ = static_cast<uint32_t>(ticks);
    fpsSince_ += ticks;
    fpsFrames_ = 0;
}

void Demo::drawOverlay()
{
    constexpr int EDGE = 3;
    char text[128];
    if (options_.interactive) {
        editor_.describe(text, sizeof text);
        overlay_.text(EDGE, EDGE, text);
        // The pointer: where the selected object is, and where a new one would come.
        const Camera& camera = model_.camera;
        const Vector v = model_.actor(editor_.selected()).object->centre() - camera.eye;
        if (v.z > Real(1)) {
            const Real limit(2);
            overlay_.cross(floorToInt(camera.centreX + camera.focalX * clamp(v.x / v.z, -limit, limit)),
                           floorToInt(camera.centreY - camera.focalY * clamp(v.y / v.z, -limit, limit)));
        }
        if (message_ && time_ - messageAt_ < MESSAGE)
            overlay_.text(EDGE, machine::HEIGHT - EDGE - Overlay::LINE_HIGH, editor_.message());
    }
    if (fps_) {
        const int length = formatQuotient(text, sizeof text, static_cast<uint64_t>(fpsCounted_) * machine::CLOCK_HZ,
                                          fpsTicks_, 1);
        snprintf(text + length, sizeof text - static_cast<size_t>(length), " fps");
        overlay_.text(machine::WIDTH - EDGE - Overlay::width(text), machine::HEIGHT - EDGE - Overlay::LINE_HIGH, text);
    }
    if (help_) {
        static const char* const PAGE[] = {
            "F1     this page       f  frames a second",
            "*      scales, pixels  - +  coarser, finer",
            "ESC    ends",
            "",
            "with /I:",
            "Tab or left button     selects the next",
            "mouse, arrows, PgUp Dn move it",
            "x y z  turn it (and with Shift)",
            "1 2    size            3 4  length, ring",
            "Ins a  adds a sphere   c  a cylinder",
            "t d n  a torus, a disc, a cone",
            "Del    deletes it",
            "l k    links, parts it and the one before",
            "u      undoes          space  lets it move",
            "F2 F3  save and load SAVED.FB",
        };
        constexpr int LINES = static_cast<int>(sizeof PAGE / sizeof PAGE[0]);
        constexpr int WIDE = 44 * Overlay::LETTER_WIDE, HIGH = LINES * (Overlay::LINE_HIGH + 2);
        const int left = (machine::WIDTH - WIDE) / 2, top = (machine::HEIGHT - HIGH) / 2;
        overlay_.box(left - EDGE, top - EDGE, WIDE + 2 * EDGE, HIGH + 2 * EDGE);
        for (int i = 0; i < LINES; ++i)
            overlay_.text(left, top + i * (Overlay::LINE_HIGH + 2), PAGE[i]);
    }
}

void Demo::frame()
{
    if (options_.interactive) {
        if (running_) {
            shown_ += time_ - lastTime_;
            Anim::move(model_, shown_);
        }
        lastTime_ = time_;
        mouse();
    } else {
        Anim::move(model_, time_);
    }

    counts_ = Counts{};
    const FrameContext frame{model_.camera.eye, unit(model_.light), model_.bodies(), &counts_};
    int order[Model::OBJECTS_MOST];
    const int count = model_.count();
    for (int i = 0; i < count; ++i) {
        model_.actor(i).object->update(frame);
        // Near objects first: what they hide is then only compared, not drawn.
        int at = i;
        for (; at > 0 && model_.actor(order[at - 1]).object->centre().z > model_.actor(i).object->centre().z; --at)
            order[at] = order[at - 1];
        order[at] = i;
    }

    view_.begin();
    const int selected = editor_.selected();
    for (int i = 0; i < count; ++i) {
        SoftObject& object = *model_.actor(order[i]).object;
        const uint8_t* ramp = object.ramp();
        if (options_.interactive && order[i] == selected && time_ - selectedAt_ < PULSE) {
            // A short pulse of brightness shows which object is selected.
            const Time phase = (time_ - selectedAt_) * 2;
            const Time height = phase < PULSE ? phase : 2 * PULSE - phase;
            object.setRamp(palette_.raised(ramp, static_cast<int>(static_cast<uint32_t>(height) * PULSE_STEPS / PULSE)));
        }
        int next = 0;
        do {
            object.draw(frame, *voxels_, VOXELS_AT_ONCE, &next);
            counts_.drawn += static_cast<uint32_t>(view_.show(*voxels_));
        } while (next != 0);
        object.setRamp(ramp);
    }
    if (!options_.printed)
        view_.closeGaps(spacing_);
    drawOverlay();
    view_.end();
}

bool Demo::finished() const
{
    return ended_ || (options_.frames > 0 && frames_ >= options_.frames) ||
           (options_.seconds > 0 &&
            machine::clock() - started_ >= static_cast<uint64_t>(options_.seconds) * machine::CLOCK_HZ);
}

int Demo::run()
{
    const char* problem = machine::start();
    if (problem != nullptr)
        machine::fail(1, problem);
    int status;
    problem = prepare(&status);
    if (problem != nullptr)
        machine::fail(status, problem);
    machine::standStill(options_.frames > 0);
    if (options_.interactive) {
        mousePresent_ = machine::openMouse();
        if (!mousePresent_)
            machine::out("No mouse driver found: use Tab, arrows, PgUp and PgDn.\n");
    }
    problem = machine::openVideo();
    if (problem != nullptr)
        machine::fail(1, problem);
    machine::setPalette(palette_.dac());
    stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());

    started_ = machine::clock();
    while (!finished()) {
        for (int code = machine::key(); code != 0; code = machine::key())
            key(code);
        if (machine::broken())
            machine::fail(1, "interrupted");
        if (ended_)
            break;
        findTime();
        frame();
        if (options_.retrace)
            machine::waitRetrace();
        if (!options_.noPresent)
            machine::present(view_.frame(), view_.rows());
        if (options_.dumpDirectory != nullptr) {
            problem = dump_.frame(frames_, time_, options_.frames > 0 ? options_.rate : 0, model_, view_, palette_,
                                  options_.grey);
            if (problem != nullptr)
                machine::fail(1, problem);
        }
        stats_.addFrame(counts_);
        ++frames_;
        if (fps_)
            countFrames();
    }
    stats_.setTime(machine::clock() - started_);
    machine::stop();
    if (options_.rateGiven && options_.frames == 0)
        machine::err("/R has no effect without /N.\n");
    char text[1024];
    stats_.format(text, sizeof text);
    machine::out(text);
    if (options_.recordFile != nullptr) {
        problem = csv_.append(options_, spacing_, stats_);
        if (problem != nullptr)
            machine::fail(1, problem);
    }
    return 0;
}

}  // namespace

int demo(int count, char** arguments)
{
    static Options options;
    options = Options();
    const char* problem = parseOptions(count, arguments, &options);
    if (problem != nullptr)
        machine::fail(2, problem);
    if (options.help) {
        machine::out(HELP);
        return 0;
    }
    Demo* program = make<Demo>(options);
    if (program == nullptr)
        machine::fail(1, "not enough memory");
    const int status = program->run();
    destroy(program);
    return status;
}
