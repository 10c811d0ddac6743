// Draws text and marks on top of the picture: the selected object, messages, help, questions.
#include "loop.h"
#include "math/text.h"

namespace {

constexpr int EDGE = 3;
constexpr int LINE = Overlay::LINE_HIGH + 1;
constexpr int LETTER = Overlay::LETTER_WIDE;

// How long a message is shown, how much longer for each of its letters, and how long the greeting is shown (65536 = 1 s).
constexpr Time MESSAGE = 65536 * 2;
constexpr Time MESSAGE_A_LETTER = 65536 / 16;
constexpr Time GREETING = 65536 * 3;

// Letters reserved for the frame rate at the bottom right.
constexpr int RATE_LETTERS = 11;

const char* const PAGE[] = {
    "F1      this page       ESC     ends",
    "*       scales, pixels  - +     coarser, finer",
    "space   stop and go     .       a step on",
    "Home    from the start  < >     slower, faster",
    "n       the next scene  f       frames a second",
    "p       picture (PCX)   F4      holds the rate",
    "",
    "arrows  round the scene End     its own view",
    "PgUp    nearer          PgDn    farther",
};

const char* const HANDS_PAGE[] = {
    "F1      this page       ESC     ends",
    "*       scales, pixels  - +     coarser, finer",
    "space   stop and go     < >     slower, faster",
    "Home    from the start  p f F4  picture, rate, held",
    "5 6     round the scene 7 8     over, under it",
    "9 0     nearer, farther End     its own view",
    "Tab     the next object, as the left button",
    "m       pointer: a click picks, held moves",
    "arrows  move it; PgUp PgDn or right button",
    "x y z   turn it         1 2     size",
    "Del     delete it       3 4     length, ring",
    "a c t d n: new sphere, cylinder, torus, disc, cone",
    "l k     link, part it and the one before",
    "w       link's weight   h       colour",
    "o       motion          v       its period",
    "q e     the light       g s     group, whole",
    "i       strength        b       dig in, fill",
    "; '     finish, pattern j       stretch",
    "u r     undo, redo      F2 F3   save, load",
    "Shift with x y z w i h j v q e g: the other way",
};

// Draws lines of text in a panel in the middle of the screen.
void drawPage(Overlay& overlay, const char* const* page, int lines)
{
    int letters = 0;
    for (int i = 0; i < lines; ++i) {
        const int length = static_cast<int>(strlen(page[i]));
        letters = length > letters ? length : letters;
    }
    const int wide = letters * LETTER + 4 * EDGE, high = lines * LINE + 4 * EDGE;
    const int left = (machine::WIDTH - wide) / 2, top = (machine::HEIGHT - high) / 2;
    overlay.panel(left, top, wide, high);
    for (int i = 0; i < lines; ++i)
        overlay.text(left + 2 * EDGE, top + 2 * EDGE + i * LINE, page[i]);
}

}  // namespace

// Shows a message at the bottom of the screen for a while.
void Demo::say(const char* text)
{
    snprintf(message_, sizeof message_, "%s", text);
    messageEnd_ = time_ + MESSAGE + MESSAGE_A_LETTER * strlen(message_);
    greets_ = false;
}

// Shows a message at once, on top of the last frame, before a long computation. It does nothing with /N, because such a run
// must not depend on how long its computations take.
void Demo::busy(const char* text)
{
    if (options_.frames > 0 || options_.noPresent || frames_ == 0)
        return;
    const int wide = machine::WIDTH - 2 * EDGE;
    const int lines = overlay_.paragraph(0, 0, wide, text, false);
    overlay_.panel(0, machine::HEIGHT - lines * LINE - 2 * EDGE, machine::WIDTH, lines * LINE + 2 * EDGE);
    overlay_.paragraph(EDGE, machine::HEIGHT - lines * LINE - EDGE, wide, text);
    view_.end();
    machine::present(view_.frame(), view_.rows());
}

// Draws a mark at the centre of an object on the screen.
void Demo::mark(int index, void (Overlay::*shape)(int, int))
{
    const Camera& camera = view_.camera();
    const Vector v = camera.axes.fromWorld(model_.actor(index).object->centre() - camera.eye);
    if (v.z <= Real(1))
        return;
    const Real limit(2);
    (overlay_.*shape)(floorToInt(camera.centreX + camera.focalX * clamp(v.x / v.z, -limit, limit)),
                      floorToInt(camera.centreY - camera.focalY * clamp(v.y / v.z, -limit, limit)));
}

void Demo::drawHands()
{
    char text[256];
    editor_.describe(text, sizeof text);
    overlay_.paragraph(EDGE, EDGE, machine::WIDTH - 2 * EDGE, text);
    // The cross marks the selected object, where add() would put a new one; the diamond marks the object that link() uses.
    mark(editor_.selected(), &Overlay::cross);
    if (editor_.before() >= 0)
        mark(editor_.before(), &Overlay::diamond);
    if (pointing_)
        overlay_.pointer(pointerX_ / 2, pointerY_ / 2);
}

void Demo::drawOverlay()
{
    if (options_.interactive && !help_)
        drawHands();
    char text[64];
    int wide = machine::WIDTH - 2 * EDGE;
    if (fps_) {
        const int length = formatQuotient(text, sizeof text, static_cast<uint64_t>(fpsCounted_) * machine::CLOCK_HZ,
                                          fpsTicks_, 1);
        snprintf(text + length, sizeof text - static_cast<size_t>(length), " fps");
        int letters = RATE_LETTERS;
        if (rate_.frames() > 0) {
            // Append the finest and the coarsest spacing in use.
            char held[32];
            const int used = formatQuotient(held, sizeof held, static_cast<uint32_t>(rawFromReal(model_.finest())), 65536, 1);
            held[used] = '-';
            formatQuotient(held + used + 1, static_cast<int>(sizeof held) - used - 1,
                           static_cast<uint32_t>(rawFromReal(model_.coarsest())), 65536, 1);
            letters += snprintf(text + strlen(text), sizeof text - strlen(text), " at %s", held);
        }
        overlay_.text(machine::WIDTH - EDGE - Overlay::width(text), machine::HEIGHT - EDGE - Overlay::LINE_HIGH, text);
        wide -= (letters + 1) * LETTER;
    }
    const char* words = time_ < messageEnd_ ? message_ : greets_ && time_ < GREETING ? "F1 help  ESC ends" : nullptr;
    if (words != nullptr) {
        const int lines = overlay_.paragraph(0, 0, wide, words, false);
        overlay_.paragraph(EDGE, machine::HEIGHT - EDGE - lines * LINE + 1, wide, words);
    }
    if (help_)
        drawHelp();
    if (ask_.state() != Ask::CLOSED)
        drawAsk();
}

void Demo::drawHelp()
{
    if (options_.interactive)
        drawPage(overlay_, HANDS_PAGE, static_cast<int>(sizeof HANDS_PAGE / sizeof HANDS_PAGE[0]));
    else
        drawPage(overlay_, PAGE, static_cast<int>(sizeof PAGE / sizeof PAGE[0]));
}

void Demo::drawAsk()
{
    const char* page[Ask::LINES_SHOWN + 4];
    char line[Ask::LINE_ROOM + 4], marked[sizeof(machine::FileName) + 4];
    int lines = 0;
    page[lines++] = ask_.question();
    page[lines++] = "";
    if (ask_.state() == Ask::LINE) {
        snprintf(line, sizeof line, "> %s_", ask_.line());
        page[lines++] = line;
    } else {
        for (int i = 0; i < Ask::LINES_SHOWN && ask_.firstShown() + i < ask_.count(); ++i) {
            const int index = ask_.firstShown() + i;
            page[lines++] = ask_.names()[index].text;
            if (index == ask_.chosen()) {
                snprintf(marked, sizeof marked, "> %s", page[lines - 1]);
                page[lines - 1] = marked;
            }
        }
    }
    page[lines++] = "";
    page[lines++] = "Enter takes it   ESC goes back";
    drawPage(overlay_, page, lines);
}
