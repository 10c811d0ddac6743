// The main loop. Each frame passes once through the stages move, update, draw, show, present, without going back.
#include "app/demo.h"

#include "loop.h"
#include "math/alloc.h"
#include "math/normal.h"
#include "math/text.h"
#include "model/scene.h"
#include "model/stop.h"

namespace {

// The user is told about the wait from this number of seeds on: laying them out takes a 386 about three seconds.
constexpr int SEEDS_TOLD = 16000;
constexpr int COARSE = 4;  // a first estimate counts seeds at this multiple of the spacing

// The run that stopSource asks whether a long computation shall stop.
Demo* running;

// How long an object pulses after it was selected.
constexpr Time PULSE = 65536 * 3 / 4;
constexpr int PULSE_STEPS = 20;

}  // namespace

Demo::Demo(const Options& options, const char* directory)
    : options_(options), pace_(!options.interactive), editor_(model_), pointerX_(machine::WIDTH),
      pointerY_(machine::HEIGHT), overlay_(view_),
      greets_(options.frames == 0 && options.seconds == 0 && options.dumpDirectory == nullptr)
{
    running = this;
    stopSource = [] { return running->stopped(); };
    snprintf(directory_, sizeof directory_, "%s", directory);
    snprintf(scene_, sizeof scene_, "%s", options.modelFile == nullptr ? "" : options.modelFile);
}

Demo::~Demo()
{
    stopSource = nullptr;
    free(voxels_);
}

// Does everything that can fail before the video mode is switched. Returns null, or one line that says what is wrong;
// `*status` is then the exit status.
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
    if (!options_.report98)
        Anim::chooseRiders(model_);
    Anim::move(model_, 0);
    if (options_.holds())
        rate_.hold(options_.hold);
    const uint64_t before = machine::clock();
    tellSeeds();
    // When ESC stopped the layout, the model has no seeds; the loop then ends before its first frame.
    if (!model_.resample(spacing_, surfaceMaker()) && !interrupted()) {
        static char text[160];
        snprintf(text, sizeof text, "%s; try a larger spacing with /S", SoftObject::resampleTrouble());
        return text;
    }
    layTicks_ = machine::clock() - before;
    voxels_ = allocate<VoxelList>(1);
    if (voxels_ == nullptr || !view_.open(options_.report98))
        return "not enough memory for the picture";
    placeEye();
    palette_.make(model_, options_.grey, options_.report98);
    return openFiles(status);
}

// Opens the files that the run writes. Returns null, or one line that says what is wrong; `*status` is then the exit status.
const char* Demo::openFiles(int* status)
{
    if (options_.recordFile != nullptr) {
        const char* problem = csv_.check(options_.recordFile, status);
        if (problem != nullptr)
            return problem;
    }
    *status = 1;
    if (options_.dumpDirectory != nullptr) {
        const char* problem = dump_.open(options_.dumpDirectory);
        if (problem != nullptr)
            return problem;
    }
    // Last, because it replaces an older film.
    return options_.filmFile == nullptr ? nullptr : film_.open(options_.filmFile, options_.frames > 0 ? options_.rate : 0, status);
}

// Tells the user, still in text mode, that seeds are being laid out when there are so many that a slow processor takes a while.
void Demo::tellSeeds()
{
    // A coarse count first, because it is quick: the number of seeds grows with the inverse square of the spacing.
    if (model_.seedsAt(spacing_ * Real(COARSE)) * COARSE * COARSE < SEEDS_TOLD / 2)
        return;
    const int seeds = model_.seedsAt(spacing_);
    if (seeds < SEEDS_TOLD || stopAsked())
        return;
    char text[96];
    const int length = seeds < 1000000 ? 0 : snprintf(text, sizeof text, "%d,", seeds / 1000000);
    snprintf(text + length, sizeof text - static_cast<size_t>(length), length > 0 ? "%03d,%03d" : "%d,%03d",
             seeds / 1000 % 1000, seeds % 1000);
    machine::err("Laying out ");
    machine::err(text);
    snprintf(text, sizeof text, " seeds of %d object%s ...\n", model_.count(), model_.count() == 1 ? "" : "s");
    machine::err(text);
}

// Ends the program because of a failure. The frames filmed so far are kept.
void Demo::fail(int status, const char* line)
{
    film_.close();
    machine::fail(status, line);
}

void Demo::findTime()
{
    if (options_.frames > 0) {
        // Each frame advances the animation by the same step, whatever the clock says.
        time_ = divide64(static_cast<uint64_t>(frames_) << 16, static_cast<uint32_t>(options_.rate));
        return;
    }
    uint64_t ticks = machine::clock() - started_;
    uint32_t rest;
    const uint64_t seconds = divide64(ticks, machine::CLOCK_HZ, &rest);
    time_ = (seconds << 16) + divide64(static_cast<uint64_t>(rest) << 16, machine::CLOCK_HZ);
}

// Called now and then while a frame is drawn. Returns true when ESC or Ctrl-C was pressed, which abandons the frame. Stores
// the other keys for takeKeys().
bool Demo::interrupted()
{
    while (waiting_ < KEYS_MOST) {
        const int code = machine::key();
        if (code == 0)
            break;
        keys_[waiting_++] = code;
        escapeWaits_ = escapeWaits_ || code == machine::KEY_ESC;
    }
    return escapeWaits_ || machine::broken();
}

// Tells whether a long computation shall stop. A computation that a key has started is stopped by ESC only when ESC is the
// very next key: a key before it may open a question, and ESC would then close that question.
bool Demo::stopped()
{
    const bool some = interrupted();
    if (!takingKeys_ || machine::broken())
        return some;
    return nextKey_ < waiting_ && keys_[nextKey_] == machine::KEY_ESC && ask_.state() == Ask::CLOSED;
}

void Demo::resample(Real spacing)
{
    char number[24], text[192];
    if (spacing != spacing_ || wasHeld_) {
        // The time grows with the number of seeds, the inverse square of the spacing; this estimate is good enough.
        const Real ratio = spacing_ / spacing;
        const uint64_t ticks = layTicks_ * static_cast<uint32_t>(rawFromReal(ratio * ratio)) >> 16;
        if (ticks > machine::CLOCK_HZ / 2)
            busy("one moment: laying out the seeds");
        const uint64_t before = machine::clock();
        if (!model_.resample(spacing, surfaceMaker())) {
            formatQuotient(number, sizeof number, static_cast<uint32_t>(rawFromReal(spacing_)), 65536, 2);
            snprintf(text, sizeof text, "spacing stays at %s: %s", number, SoftObject::resampleTrouble());
            say(text);
            return;
        }
        layTicks_ = machine::clock() - before;
        spacing_ = spacing;
        wasHeld_ = false;
        stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());
    }
    formatQuotient(number, sizeof number, static_cast<uint32_t>(rawFromReal(spacing_)), 65536, 2);
    snprintf(text, sizeof text, "spacing %s, %d seeds%s", number, model_.seeds(),
             spacing_ == SPACING_LEAST  ? ": the finest there is"
             : spacing_ == SPACING_MOST ? ": the coarsest there is"
                                        : "");
    say(text);
}

// Updates everything that depends on the set of objects, after the model was edited or replaced.
void Demo::changed()
{
    Anim::move(model_, shown_);
    palette_.make(model_, options_.grey, options_.report98);
    paletteStale_ = true;
    stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());
}

// Measures the frame rate over intervals of at least half a second.
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

// After a frame that began at tick `began`: lays out the seeds of those objects anew whose spacing rate_ wants to change.
void Demo::holdRate(uint64_t began)
{
    rate_.add(machine::clock() - began, model_);
    Real spacing;
    for (int i; (i = rate_.next(model_, view_.camera(), &spacing)) >= 0;)
        if (!model_.actor(i).object->resample(spacing, surfaceMaker()) && !interrupted())
            rate_.refused();
    stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());
}

// Draws a frame. Returns false when it was interrupted and there is nothing to show.
bool Demo::frame()
{
    if (options_.interactive)
        mouse();
    const Time before = shown_;
    shown_ = pace_.at(time_);
    if (!options_.interactive || shown_ != before)
        Anim::move(model_, shown_);
    placeEye();
    if (!drawModel())
        return false;
    drawOverlay();
    view_.end();
    return true;
}

// Sets the view's camera: the scene's own, moved by orbit_. When the eye has moved or turned, all seeds must be recomputed,
// because what is visible has changed.
void Demo::placeEye()
{
    const Camera camera = orbit_.from(model_.camera, model_);
    const Camera& before = view_.camera();
    if (!(camera.eye == before.eye) || !(camera.axes == before.axes))
        model_.recalcAll();
    view_.setCamera(camera);
}

// Draws all objects. Returns false when it was interrupted.
bool Demo::drawModel()
{
    counts_ = Counts{};
    const Camera& camera = view_.camera();
    FrameContext frame{camera.eye, unit(model_.light), model_.prepareBodies(), &counts_, camera.axes,
                       camera.centreX / camera.focalX, camera.centreY / camera.focalY};
    if (frame.bodies == nullptr) {
        if (interrupted())
            return false;
        fail(1, "not enough memory");
    }
    sortObjects(frame);
    const bool pulses = options_.interactive && time_ - selectedAt_ < PULSE;
    SoftObject* const marked = pulses ? model_.actor(editor_.selected()).object : nullptr;
    const uint8_t* const ramp = marked == nullptr ? nullptr : marked->ramp();
    if (ramp != nullptr)
        marked->setRamp(pulseRamp(ramp));
    const bool drawn = drawObjects(frame);
    if (ramp != nullptr)
        marked->setRamp(ramp);
    return drawn;
}

// Sorts the objects by depth, those of one depth by their indices. Near objects come first: seeds of others that they hide need not
// be settled or drawn. An insertion sort takes few steps, because the order hardly changes from frame to frame.
void Demo::sortObjects(const FrameContext& frame)
{
    const int count = model_.count();
    if (ordered_ != count)
        for (int i = 0; i < count; ++i)
            order_[i] = i;
    ordered_ = count;
    Real depth[Model::OBJECTS_MOST];
    for (int i = 0; i < count; ++i)
        depth[i] = frame.inView(model_.actor(i).object->centre()).z;
    for (int i = 1; i < count; ++i) {
        const int object = order_[i];
        const Real here = depth[object];
        int at = i;
        for (; at > 0; --at) {
            const int before = order_[at - 1];
            if (depth[before] < here || (depth[before] == here && before < object))
                break;
            order_[at] = before;
        }
        order_[at] = object;
    }
}

// Draws all objects in their order, and closes the gaps that are left. Returns false when it was interrupted.
bool Demo::drawObjects(FrameContext& frame)
{
    view_.begin();
    for (int i = 0; i < model_.count(); ++i) {
        SoftObject& object = *model_.actor(order_[i]).object;
        object.update(frame);
        int next = 0;
        do {
            if (interrupted())
                return false;
            object.draw(frame, *voxels_, VOXELS_AT_ONCE, &next);
            counts_.drawn += static_cast<uint32_t>(view_.show(*voxels_));
        } while (next != 0);
        frame.hider = &view_;
    }
    if (!options_.report98)
        view_.closeGaps(model_.coarsest(), &model_, &palette_);
    return true;
}

// Returns a brighter copy of a ramp: a short pulse of brightness shows which object was selected.
const uint8_t* Demo::pulseRamp(const uint8_t* ramp)
{
    const Time phase = (time_ - selectedAt_) * 2;
    const Time height = phase < PULSE ? phase : 2 * PULSE - phase;
    return palette_.raised(ramp, static_cast<int>(static_cast<uint32_t>(height) * PULSE_STEPS / PULSE));
}

bool Demo::finished() const
{
    return ended_ || (options_.frames > 0 && frames_ >= options_.frames) ||
           (options_.seconds > 0 &&
            machine::clock() - started_ >= static_cast<uint64_t>(options_.seconds) * machine::CLOCK_HZ);
}

// Writes the frame to the dump and to the film, if these are wanted. Returns null, or one line that says what is wrong.
const char* Demo::keepFrame()
{
    const char* problem = nullptr;
    if (options_.dumpDirectory != nullptr)
        problem = dump_.frame(frames_, time_, options_.frames > 0 ? options_.rate : 0, model_, view_, palette_,
                              options_.grey);
    if (problem == nullptr && film_.isOpen())
        problem = film_.add(view_.frame(), palette_.dac(), time_);
    return problem;
}

// Prints the statistics of the run, or with /B its one line, on standard output.
void Demo::sayResults(uint64_t ticks)
{
    char text[1024];
    if (options_.benchmark) {
        char scene[100], spacing[24], rate[32], seconds[32];
        plainText(scene, sizeof scene, options_.modelFile == nullptr ? "four spheres" : options_.modelFile);
        formatReal(spacing, sizeof spacing, spacing_);
        stats_.formatFps(rate, sizeof rate, 2);
        formatQuotient(seconds, sizeof seconds, ticks, machine::CLOCK_HZ, 2);
        snprintf(text, sizeof text, "%s, spacing %s%s: %s frames a second (%d frames in %s seconds)\n", scene, spacing,
                 options_.report98 ? ", as printed" : "", rate, frames_, seconds);
    } else {
        stats_.format(text, sizeof text);
    }
    machine::out(text);
}

// Starts the machine, prepares the run and switches the video mode. On failure it ends the program.
void Demo::begin()
{
    const char* problem = machine::start();
    if (problem != nullptr)
        machine::fail(1, problem);
    int status;
    problem = prepare(&status);
    if (machine::broken())
        fail(1, "interrupted");
    if (problem != nullptr)
        fail(status, problem);
    machine::standStill(options_.frames > 0 && options_.seconds == 0 && !options_.benchmark);
    if (options_.interactive && !machine::openMouse()) {
        machine::err("No mouse driver found: use Tab, arrows, PgUp and PgDn.\n");
        // Most users do not see that any more when the picture is there.
        if (options_.frames == 0)
            say("no mouse: use Tab, arrows, PgUp and PgDn");
    }
    // When ESC was pressed already, the loop ends before its first frame and needs no video mode, whatever other keys wait: there
    // may be no seeds that their actions could use.
    const bool stop = interrupted();
    ended_ = escapeWaits_;
    if (!stop) {
        problem = machine::openVideo();
        if (problem != nullptr)
            fail(1, problem);
        machine::setPalette(palette_.dac());
    }
    stats_.setSeeds(model_.seeds(), model_.oversampledSeeds());
}

// Puts a finished frame on the screen and writes it to the files that are wanted.
void Demo::showFrame()
{
    if (options_.retrace)
        machine::waitRetrace();
    if (paletteStale_)
        machine::setPalette(palette_.dac());
    paletteStale_ = false;
    if (!options_.noPresent)
        machine::present(view_.frame(), view_.rows());
    const char* problem = keepFrame();
    if (problem != nullptr)
        fail(1, problem);
    if (shotWanted_)
        shoot();
}

int Demo::run()
{
    begin();
    started_ = machine::clock();
    while (!finished()) {
        takeKeys();
        if (machine::broken())
            fail(1, "interrupted");
        if (ended_)
            break;
        const uint64_t began = machine::clock();
        findTime();
        if (!frame())
            continue;
        showFrame();
        stats_.addFrame(counts_);
        ++frames_;
        if (fps_)
            countFrames();
        if (rate_.frames() > 0)
            holdRate(began);
    }
    const uint64_t ticks = machine::clock() - started_;
    stats_.setTime(ticks);
    const char* problem = film_.close();
    machine::stop();
    if (options_.rateGiven && options_.frames == 0)
        machine::err("/R has no effect without /N.\n");
    if (options_.hold > 0 && !options_.holds())
        machine::err("/F has no effect with /N or /S.\n");
    sayResults(ticks);
    if (problem == nullptr && options_.recordFile != nullptr)
        problem = csv_.append(options_, spacing_, stats_);
    if (problem != nullptr)
        machine::fail(1, problem);
    return 0;
}

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
    // The path of the program up to the last separator; empty when the path is too long.
    char directory[128] = "";
    if (count > 0) {
        const int length = snprintf(directory, sizeof directory, "%s", arguments[0]);
        int end = length < static_cast<int>(sizeof directory) ? length : 0;
        while (end > 0 && directory[end - 1] != '/' && directory[end - 1] != '\\' && directory[end - 1] != ':')
            --end;
        directory[end] = 0;
    }
    Demo* program = make<Demo>(options, directory);
    if (program == nullptr)
        machine::fail(1, "not enough memory");
    const int status = program->run();
    destroy(program);
    return status;
}
