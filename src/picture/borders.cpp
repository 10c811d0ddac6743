// Borders of colours. Every second pixel of every second row is looked at. Where two that follow each other differ in colour, the
// fields of the objects that have these colours tell which of the pixels between them belongs to which object.
#include "borders.h"

#include "math/whole.h"
#include "model/paint.h"
#include "rt.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// Pixels from one that is looked at to the next, in both directions.
constexpr int GRID = 2;
// So many columns to both sides of a border found, pixels are looked for that stand alone, in its row and in the one below, which
// is not looked at otherwise. Others that stand alone may be missed.
constexpr int NEAR = 4;
static_assert(GRID == 2, "one row is left out");
// No pixel is looked at after so many in a frame.
constexpr int LOOKS_MOST = 2000;
// In units of the field. EXACT: where a body's field is off the isovalue by no more its surface is there. NEARLY: an object that is
// weaker by less than this at the depth that a pixel shows may be the stronger one at the surface.
constexpr Real EXACT(0.004), NEARLY(0.01);
// The surface is looked for along the ray with one step of this length, 1/128 unit, and is no farther away than FARTHEST steps.
constexpr int STEP = 128;
constexpr Real FARTHEST(2);

}  // namespace

Borders::Borders(View& view, FieldProbe& probe, const Palette& palette, Rays& rays)
    : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), probe_(probe), model_(*probe.model()), palette_(palette),
      rays_(rays)
{
    memset(first_, -1, sizeof first_);
    for (int i = 0; i < model_.count(); ++i) {
        const SoftObject& object = *model_.actor(i).object;
        const Paint* const paint = object.paint();
        if (!object.hasSurface() || object.ramp() == nullptr)
            continue;
        list(2 * i, palette.numberOf(object.ramp()));
        if (paint != nullptr && paint->pattern != PATTERN_NONE)
            list(2 * i + 1, palette.numberOf(paint->ramps + paint->other * paint->rampRoom));
    }
}

// Takes an entry of next_ into the list of a ramp.
inline void Borders::list(int entry, int ramp)
{
    next_[entry] = first_[ramp];
    first_[ramp] = static_cast<int16_t>(entry);
}

void Borders::mend()
{
    // The loop is quicker where it need not fetch the palette's address for each pixel.
    const Palette& palette = palette_;
    for (int y = 0; y < HEIGHT; y += GRID) {
        const Span& touched = view_.touched(y);
        const uint8_t* const row = frame_ + y * WIDTH;
        const uint8_t* const end = row + touched.to;
        uint8_t last = 0;
        for (const uint8_t* at = row + touched.from; at < end; at += GRID) {
            const uint8_t ramp = palette.rampOf(*at);
            if (ramp == last)
                continue;
            if (ramp != 0 && last != 0)
                mendBeside(static_cast<int>(at - frame_));
            // The pixel may have been mended.
            const uint8_t now = palette.rampOf(*at);
            last = now != 0 ? now : last;
        }
    }
}

// Looks at the two pixels beside a border, which lies to the left of a pixel or farther to the left. Wherever a pixel has been
// mended it looks at those beside that one, too.
void Borders::mendBeside(int right)
{
    const int ramp = rampAt(right);
    while (rampAt(right - 1) == ramp)
        --right;
    if (magnitude(zbuffer_[right - 1] - zbuffer_[right]) > Rays::BEHIND)
        return;
    note(right, right - 1);
    note(right - 1, right);
    noteScraps(right);
    noteScraps(right + WIDTH);
    while (count_ > 0) {
        const Place place = noted_[--count_];
        if (mendPixel(place))
            forBeside(place.pixel, [&](int pixel) { note(pixel, place.pixel); });
    }
}

// Notes the pixels near a place in a row that stand alone between two of one other ramp.
inline void Borders::noteScraps(int middle)
{
    if (middle <= NEAR || middle + NEAR >= WIDTH * HEIGHT)
        return;
    int before = rampAt(middle - NEAR - 1), here = rampAt(middle - NEAR);
    for (int at = middle - NEAR; at < middle + NEAR; ++at) {
        const int behind = rampAt(at + 1);
        if (here != before && behind == before)
            note(at, at - 1);
        before = here;
        here = behind;
    }
}

// Notes a pixel that is not shown in the ramp of another one. Palette entries that are in several ramps tell nothing.
inline void Borders::note(int at, int from)
{
    const int ramp = rampAt(at), other = rampAt(from);
    if (ramp != 0 && other != 0 && ramp != other && count_ < NOTED_MOST)
        noted_[count_++] = {static_cast<uint16_t>(at), static_cast<uint16_t>(from)};
}

// Gives a pixel the palette entry of the surface at a depth. Its own depth stays: it is the same whether colours are shown or not.
// Returns false if its ramp stays, too.
SELDOM bool Borders::showExactly(int at, int depth)
{
    const int before = zbuffer_[at], own = rampAt(at);
    if (!rays_.show(at, depth))
        return false;
    view_.setPixel(at, before, frame_[at]);
    return rampAt(at) != own;
}

// Shows a pixel of the ramp `own` in the ramp of another pixel, if it belongs to that one's object. Returns false if it does not,
// or if its ramp stays.
inline __attribute__((always_inline)) bool Borders::passOn(int at, int ramp, int own, const Rivals& rivals)
{
    const bool crossing = rivals.shown != nullptr && model_.areApart(*rivals.shown, *rivals.other);
    const int before = zbuffer_[at];
    int depth = before, shownDepth = before;
    if ((!crossing && rivals.ahead <= -NEARLY) || !correctDepth(*rivals.other, at, &depth))
        return false;
    // Of two bodies whose surfaces cross the nearer one is seen, within one body the stronger object.
    if (crossing) {
        if (correctDepth(*rivals.shown, at, &shownDepth) && shownDepth < depth)
            return false;
        return showExactly(at, depth);
    }
    const Rivals there = depth == before ? rivals : rivalsAt(ramp, own, view_.pointAt(at, depth));
    if (there.ahead <= Real(0))
        return false;
    // The brightness goes on across a border, but not from one body to another. What a painted object looks like the model tells.
    if (there.other->paint() != nullptr)
        return showExactly(at, depth);
    view_.setPixel(at, before, palette_.ramp(ramp)[meanBrightness(at, ramp)]);
    return true;
}

// Shows a pixel in the ramp of the one beside it, if it belongs to an object that has that ramp; at an edge of a pattern in the
// colour that it has there. Returns false if its ramp stays.
bool Borders::mendPixel(const Place& place)
{
    const int at = place.pixel, row = at / WIDTH, column = at - row * WIDTH;
    if (++looks_ > LOOKS_MOST || row < 1 || row >= HEIGHT - 1 || column < 1 || column >= WIDTH - 1)
        return false;
    const int own = rampAt(at), ramp = rampAt(place.from);
    // Marble is shown in more ramps than are listed. The other pixel may have been mended meanwhile.
    if (first_[own] < 0 || ramp == own)
        return false;
    const Rivals rivals = rivalsAt(ramp, own, view_.pointAt(at));
    if (rivals.other == nullptr)
        return false;
    if (rivals.other != rivals.shown)
        return passOn(at, ramp, own, rivals);
    int depth = zbuffer_[at];
    return correctDepth(*rivals.other, at, &depth) && showExactly(at, depth);
}

// The mean brightness of a pixel and of those beside it that are shown in a ramp. (At a crease the pixel, which the wrong object's
// scale has drawn, has the brightness of the other side.)
int Borders::meanBrightness(int at, int ramp) const
{
    int sum = palette_.step(frame_[at]), count = 1;
    forBeside(at, [&](int pixel) {
        if (rampAt(pixel) == ramp) {
            sum += palette_.step(frame_[pixel]);
            ++count;
        }
    });
    return (sum + count / 2) / count;
}

// The strongest object at a point of those that are shown in a ramp, and that of those shown in a pixel's own ramp.
Borders::Rivals Borders::rivalsAt(int ramp, int own, const Point& p) const
{
    Real field, ownField;
    const SoftObject* const other = strongestOf(ramp, p, &field);
    const SoftObject* const shown = strongestOf(own, p, &ownField);
    return {other, shown, field - ownField};
}

// The object with the strongest field at a point, of those that are shown in a ramp; null if none of them reaches it.
inline const SoftObject* Borders::strongestOf(int ramp, const Point& p, Real* field) const
{
    const SoftObject* strongest = nullptr;
    *field = Real(0);
    for (int i = first_[ramp]; i >= 0; i = next_[i]) {
        const SoftObject* const object = model_.actor(i / 2).object;
        const Real there = object->fieldFunc(p);
        if (there > *field) {
            *field = there;
            strongest = object;
        }
    }
    return strongest;
}

// Moves a depth behind a pixel to the surface of an object's body, by one step of the secant method, if the field there is off the
// isovalue by more than EXACT. (Rays::findDepth() searches in many steps, and for whichever body comes first.) Returns false if
// the surface is not near.
bool Borders::correctDepth(const SoftObject& object, int at, int* depth) const
{
    int strongest;
    const Real off = probe_.implicitAt(view_.pointAt(at, *depth), &strongest, &object) - ISOVALUE;
    if (absolute(off) <= EXACT)
        return true;
    const int step = off > Real(0) ? -STEP : STEP;
    const Real change = probe_.implicitAt(view_.pointAt(at, *depth + step), &strongest, &object) - ISOVALUE - off;
    if (absolute(change) * FARTHEST < absolute(off) || (change > Real(0)) == (off > Real(0)))
        return false;
    *depth += floorToInt(quotient(-off, change) * Real(step));
    return true;
}
