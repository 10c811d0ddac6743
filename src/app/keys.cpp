// The actions of keys and mouse. No function here waits for input: a key changes what the next frame shows.
#include "loop.h"
#include "model/probe.h"

namespace {

// Interactive mode: units per mickey and per key, and the range of depths that objects may be moved to, units.
constexpr Real UNITS_A_MICKEY(0.25);
constexpr Real UNITS_A_KEY(2);
constexpr Real DEPTH_LEAST(-60);
constexpr Real DEPTH_MOST(120);

// Editing: by how much one key press changes a value.
constexpr Real DEGREES_A_KEY(15);
constexpr Real SIZE_A_KEY(1);
constexpr Real WEIGHT_A_KEY(0.25);  // also the step of strength and stretch
constexpr Real FASTER_A_KEY(0.8);  // factor of a period
constexpr Real SLOWER_A_KEY(1.25);

// The eye: degrees around the scene per key press, and factors of the distance.
constexpr Real DEGREES_A_VIEW(5);
constexpr Real NEARER_A_KEY(0.9);
constexpr Real FARTHER_A_KEY(1.111111);

// The greatest slope, in units of width or height per unit of depth, that objects are moved along: places that the screen shows
// farther aside with a very short focal length would overflow 16.16.
constexpr Real SLOPE_MOST(32);

constexpr int STEPS_A_SECOND = 10;

// The frame rate that F4 holds when /F is not given.
constexpr int HOLD_FRAMES = 10;

// How far from the pointer a click may still select an object, pixels.
constexpr int PICK_REACH = 4;

// Turns a capital letter into a small one.
int small(int code)
{
    return code >= 'A' && code <= 'Z' ? code + ('a' - 'A') : code;
}

}  // namespace

// Handles the keys that came while the last frame was drawn, then those that came since.
void Demo::takeKeys()
{
    takingKeys_ = true;
    nextKey_ = 0;
    while (!ended_) {
        // key() may start a long computation, during which interrupted() appends new keys to keys_.
        if (nextKey_ < waiting_) {
            key(keys_[nextKey_++]);
            continue;
        }
        nextKey_ = waiting_ = 0;
        escapeWaits_ = false;
        const int code = machine::key();
        if (code == 0)
            break;
        key(code);
    }
    takingKeys_ = false;
}

void Demo::key(int code)
{
    if (ask_.state() != Ask::CLOSED) {
        answer(code);
        return;
    }
    switch (code) {
    case machine::KEY_ESC: ended_ = true; return;
    case '*': view_.setPixels(!view_.pixels()); return;
    case '-':
    case '_':
        letGo();
        resample(min(spacing_ * Real(1.25), SPACING_MOST));
        return;
    case '+':
    case '=':
        letGo();
        resample(max(spacing_ * Real(0.8), SPACING_LEAST));
        return;
    case machine::KEY_F4: hold(); return;
    case machine::KEY_F1:
        help_ = !help_;
        greets_ = false;
        return;
    default: break;
    }
    if (small(code) == 'f') {
        fps_ = !fps_;
        fpsSince_ = machine::clock();
        fpsFrames_ = 0;
        fpsTicks_ = 0;
        fpsCounted_ = 0;
        return;
    }
    if (small(code) == 'p') {
        shotWanted_ = true;
        messageEnd_ = 0;
        return;
    }
    if (eyeKey(code))
        return;
    playKey(code);
    if (options_.interactive)
        handKey(code);
}

// Handles the keys that move the eye around the scene. Returns false when `code` is another key.
bool Demo::eyeKey(int code)
{
    const Real turn = DEGREES_A_VIEW, none(0);
    if (!options_.interactive) {
        // Without /I the arrow keys do not move objects and may move the eye.
        switch (code) {
        case machine::KEY_LEFT: code = '5'; break;
        case machine::KEY_RIGHT: code = '6'; break;
        case machine::KEY_UP: code = '7'; break;
        case machine::KEY_DOWN: code = '8'; break;
        case machine::KEY_PGUP: code = '9'; break;
        case machine::KEY_PGDN: code = '0'; break;
        default: break;
        }
    }
    switch (code) {
    case '5': orbit_.turn(-turn, none); return true;
    case '6': orbit_.turn(turn, none); return true;
    case '7': orbit_.turn(none, turn); return true;
    case '8': orbit_.turn(none, -turn); return true;
    case '9': orbit_.approach(NEARER_A_KEY); return true;
    case '0': orbit_.approach(FARTHER_A_KEY); return true;
    case machine::KEY_END:
        orbit_.reset();
        say("the scene's own view");
        return true;
    default: return false;
    }
}

// Switches the holding of a frame rate on or off.
void Demo::hold()
{
    char text[40];
    if (options_.frames > 0) {
        snprintf(text, sizeof text, "no rate is held with /N");
    } else if (rate_.frames() > 0) {
        letGo();
        snprintf(text, sizeof text, "no rate is held");
    } else {
        rate_.hold(options_.hold > 0 ? options_.hold : HOLD_FRAMES);
        snprintf(text, sizeof text, "holding %d frames a second", rate_.frames());
    }
    say(text);
}

// Stops holding a frame rate: from now on the user chooses the spacing, beginning with the coarsest one in use. Until then each
// object keeps the spacing that it has got.
void Demo::letGo()
{
    if (rate_.frames() == 0)
        return;
    rate_.hold(0);
    spacing_ = min(model_.coarsestAsked(), SPACING_MOST);
    wasHeld_ = true;
}

// Handles the keys that pause, resume, step and restart the animation and change its speed; and `n`, the next scene.
void Demo::playKey(int code)
{
    switch (code) {
    case ' ':
        pace_.setRunning(!pace_.running());
        say(pace_.running() ? "it runs" : "it stands");
        return;
    case machine::KEY_HOME:
        pace_.restart();
        say("from the start");
        return;
    case '<':
    case '>': {
        if (!pace_.change(code == '>' ? 1 : -1)) {
            say(code == '>' ? "no faster" : "no slower");
            return;
        }
        char text[40];
        const int speed = pace_.speed();
        snprintf(text, sizeof text, speed < 0 ? "speed 1/%d" : "speed %d", 1 << (speed < 0 ? -speed : speed));
        say(text);
        return;
    }
    default: break;
    }
    if (options_.interactive)
        return;
    if (code == '.') {
        // A step is a tenth of a second; with /N it is the time from one frame to the next.
        pace_.setRunning(false);
        pace_.step(static_cast<Time>(65536 / (options_.frames > 0 ? options_.rate : STEPS_A_SECOND)));
        say("a step on; space lets it run");
    } else if (small(code) == 'n') {
        nextScene();
    }
}

void Demo::handKey(int code)
{
    if (editKey(code)) {
        say(editor_.message());
        return;
    }
    const Real step = UNITS_A_KEY, none(0);
    switch (code) {
    case machine::KEY_TAB:
        editor_.selectNext();
        selected();
        return;
    case machine::KEY_LEFT: push(-step, none, none); return;
    case machine::KEY_RIGHT: push(step, none, none); return;
    case machine::KEY_UP: push(none, step, none); return;
    case machine::KEY_DOWN: push(none, -step, none); return;
    case machine::KEY_PGUP: push(none, none, step); return;
    case machine::KEY_PGDN: push(none, none, -step); return;
    case machine::KEY_F2: askSave(); return;
    case machine::KEY_F3: askLoad(); return;
    default: break;
    }
    if (small(code) == 'm') {
        pointing_ = !pointing_;
        dragging_ = false;
        say(pointing_ ? "the mouse points: a click picks, holding it moves" : "the mouse moves the object");
    }
}

// Handles the keys that edit the model. Returns false when `code` is another key.
bool Demo::editKey(int code)
{
    const Real turn = DEGREES_A_KEY, size = SIZE_A_KEY, weight = WEIGHT_A_KEY;
    bool done = false;
    // With Shift these letters do the opposite; for other letters Shift makes no difference.
    switch (code) {
    case 'X': done = editor_.turn(0, -turn, time_); break;
    case 'Y': done = editor_.turn(1, -turn, time_); break;
    case 'Z': done = editor_.turn(2, -turn, time_); break;
    case 'W': done = editor_.weigh(-weight, time_); break;
    case 'I': done = editor_.strengthen(-weight, time_); break;
    case 'H': done = editor_.colour(-1, time_); break;
    case 'J': done = editor_.stretch(-weight, time_); break;
    case 'V': done = editor_.pace(SLOWER_A_KEY, time_); break;
    case 'Q': done = editor_.light(1, -turn, time_); break;
    case 'E': done = editor_.light(0, -turn, time_); break;
    case 'G': done = editor_.leave(); break;
    default:
        switch (small(code)) {
        case 'x': done = editor_.turn(0, turn, time_); break;
        case 'y': done = editor_.turn(1, turn, time_); break;
        case 'z': done = editor_.turn(2, turn, time_); break;
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
        case 'w': done = editor_.weigh(weight, time_); break;
        case 'b': done = editor_.dent(); break;
        case 'i': done = editor_.strengthen(weight, time_); break;
        case 'h': done = editor_.colour(1, time_); break;
        case ';': done = editor_.finish(); break;
        case '\'': done = editor_.pattern(); break;
        case 'j': done = editor_.stretch(weight, time_); break;
        case 'o': done = editor_.motion(); break;
        case 'v': done = editor_.pace(FASTER_A_KEY, time_); break;
        case 'q': done = editor_.light(1, turn, time_); break;
        case 'e': done = editor_.light(0, turn, time_); break;
        case 'g': done = editor_.join(); break;
        case 's': editor_.setWholeGroup(!editor_.wholeGroup()); break;
        case 'u':
        case machine::KEY_BACKSPACE: done = editor_.undo(); break;
        case 'r': done = editor_.redo(); break;
        default: return false;
        }
    }
    if (done)
        changed();
    return true;
}

// Starts the pulse of the object that was just selected.
void Demo::selected()
{
    selectedAt_ = time_;
}

void Demo::push(Real x, Real y, Real z)
{
    // In view coordinates, the new centre is limited to the screen and to the range of depths. An object that is already
    // outside is not pulled in: its own place extends the range.
    const Point from = model_.actor(editor_.selected()).object->centre();
    const Camera& camera = view_.camera();
    const ViewAxes& axes = camera.axes;
    const Vector was = axes.fromWorld(toVector(from)), eye = axes.fromWorld(toVector(camera.eye));
    Vector p = was + Vector{x, y, z};
    p.z = clamp(p.z, min(DEPTH_LEAST, was.z), max(DEPTH_MOST, was.z));
    const Real away = max(p.z - eye.z, Real(1));
    const Real right = away * min(camera.centreX / camera.focalX, SLOPE_MOST);
    const Real up = away * min(camera.centreY / camera.focalY, SLOPE_MOST);
    p.x = clamp(p.x, min(eye.x - right, was.x), max(eye.x + right, was.x));
    p.y = clamp(p.y, min(eye.y - up, was.y), max(eye.y + up, was.y));
    if (editor_.move(axes.toWorld(p - was), time_))
        Anim::move(model_, shown_);
}

void Demo::mouse()
{
    const machine::Mouse m = machine::mouse();
    if (ask_.state() != Ask::CLOSED)
        return;
    if (pointing_) {
        pointAt(m);
        return;
    }
    for (int i = 0; i < m.presses; ++i) {
        editor_.selectNext();
        selected();
    }
    if (m.dx == 0 && m.dy == 0)
        return;
    const Real dx = Real(m.dx) * UNITS_A_MICKEY, dy = Real(m.dy) * UNITS_A_MICKEY;
    if (m.right)
        push(dx, Real(0), -dy);
    else
        push(dx, -dy, Real(0));
}

// Handles the mouse while it moves a pointer: two mickeys are one pixel.
void Demo::pointAt(const machine::Mouse& m)
{
    const auto within = [](int at, int end) { return at < 0 ? 0 : at > end - 1 ? end - 1 : at; };
    const int fromX = pointerX_, fromY = pointerY_;
    pointerX_ = within(pointerX_ + m.dx, 2 * machine::WIDTH);
    pointerY_ = within(pointerY_ + m.dy, 2 * machine::HEIGHT);
    if (m.presses > 0) {
        const int index = objectAt(pointerX_ / 2, pointerY_ / 2);
        dragging_ = index >= 0;
        if (index >= 0) {
            editor_.select(index);
            selected();
        } else {
            say("nothing there");
        }
        return;
    }
    dragging_ = dragging_ && m.left;
    const int dx = pointerX_ - fromX, dy = pointerY_ - fromY;
    if ((!dragging_ && !m.right) || (dx == 0 && dy == 0))
        return;
    // The object follows the pointer: pixels are converted to units at the distance of the object.
    const Camera& camera = view_.camera();
    const Point& centre = model_.actor(editor_.selected()).object->centre();
    const Real away = max(camera.axes.fromWorld(centre - camera.eye).z, Real(1));
    const auto units = [&](int pixels, Real focal) {
        return clamp(Real(pixels) / focal, -SLOPE_MOST, SLOPE_MOST) * away * Real(0.5);
    };
    const Real x = units(dx, camera.focalX);
    if (m.right)
        push(x, Real(0), Real(-dy) * UNITS_A_MICKEY);
    else
        push(x, units(-dy, camera.focalY), Real(0));
}

// Returns the index of the object that the last frame shows at a pixel or within PICK_REACH of it, or -1: the object whose
// own field is strongest at the surface point there.
int Demo::objectAt(int x, int y) const
{
    const uint16_t* zbuffer = view_.zbuffer();
    int atX = 0, atY = 0, nearest = PICK_REACH * PICK_REACH + 1;
    for (int row = y - PICK_REACH; row <= y + PICK_REACH; ++row) {
        for (int column = x - PICK_REACH; column <= x + PICK_REACH; ++column) {
            const int distance = (row - y) * (row - y) + (column - x) * (column - x);
            if (row < 0 || row >= machine::HEIGHT || column < 0 || column >= machine::WIDTH || distance >= nearest ||
                zbuffer[row * machine::WIDTH + column] == Z_EMPTY)
                continue;
            nearest = distance;
            atX = column;
            atY = row;
        }
    }
    if (nearest > PICK_REACH * PICK_REACH)
        return -1;
    return FieldProbe(&model_).strongestAt(view_.pointAt(atY * machine::WIDTH + atX));
}
