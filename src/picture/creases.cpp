// Creases. Four pixels at once are compared with those to the right of them and those two rows below, by their palette entries,
// which are in the order of brightness (palette.h). Where one differs much, each of the pixels there is.
#include "creases.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// Rows. Of a band in which a crease was found in the frame before, or is found now, every second row is compared; of others one row
// in each frame, the next one in the next frame.
constexpr int BAND = View::CREASE_BAND;
static_assert(HEIGHT % BAND == 0 && HEIGHT / BAND <= 32, "each band has a bit");
// Steps of brightness. JUMP: where two pixels side by side differ by so many, both are looked at. CHANGE: where a pixel has changed
// by so many, those beside it are looked at, too.
constexpr int JUMP = 16, CHANGE = 5;
// Palette entries: a jump makes a greater difference (about four entries are one step). A power of two.
constexpr int ENTRIES_APART = 32;
static_assert((ENTRIES_APART & (ENTRIES_APART - 1)) == 0, "small differences, with a bias, have no bit beyond its own");
// No pixel is looked at after so many in a frame (looksAt()).
constexpr int LOOKS_AT_ONE = 2000;
// EXACT: a pixel whose field is off the isovalue by no more lies on the surface; nearly on it is not enough, for a little before or
// behind a crease the brightness may be that of its other side. Elsewhere one step of Newton's method leads to the surface, if it
// is no farther away than FARTHEST units: where a side is steep, a scale of the other side may go on a few units behind it.
constexpr Real EXACT(0.01), FARTHEST(6);

// Half the palette entries of four pixels.
inline uint32_t halves(const uint8_t* pixel)
{
    uint32_t four;
    __builtin_memcpy(&four, pixel, sizeof four);
    return four >> 1 & 0x7f7f7f7f;
}

}  // namespace

Creases::Creases(View& view, FieldProbe& probe, const Tint& tint, const Palette& palette, Real spacing, View::FoundCreases& found)
    : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), probe_(probe), tint_(tint), palette_(palette), found_(found),
      looksMost_(looksAt(spacing, LOOKS_AT_ONE))
{
}

void Creases::mend()
{
    const uint32_t before = found_.bands;
    found_.turn = (found_.turn + 2) % BAND;
    found_.bands = 0;
    for (int band = 0; band < HEIGHT / BAND; ++band) {
        mendRow(band * BAND + found_.turn);
        for (int i = 2; i < BAND && ((before | found_.bands) >> band & 1) != 0; i += 2)
            mendRow(band * BAND + (found_.turn + i) % BAND);
    }
}

// Mends the creases that cross a row or the next one.
void Creases::mendRow(int y)
{
    if (y >= HEIGHT - 2)
        return;
    const Span &here = view_.touched(y), &below = view_.touched(y + 2), &bordered = view_.bordered(y);
    const int from = (max32(max32(here.from, below.from), bordered.from) + 3) & ~3;
    const int to = min32(min32(here.to, below.to), bordered.to) - 4;
    const auto compare = [&](int at, int other) {
        if (magnitude(frame_[at] - frame_[other]) >= ENTRIES_APART)
            mendPair(at, other);
    };
    for (int x = from; x < to; x += 4) {
        const uint8_t* const at = frame_ + y * WIDTH + x;
        // A difference that is negative even with the bias borrows from the next one, and so sets its own high bits.
        constexpr uint32_t EACH = 0x01010101, BIAS = (ENTRIES_APART / 2 - 1) * EACH, LARGE = (0x100 - ENTRIES_APART) * EACH;
        const uint32_t biased = halves(at) + BIAS;
        const uint32_t aside = biased - halves(at + 1), down = biased - halves(at + 2 * WIDTH);
        if (((aside | down) & LARGE) == 0)
            continue;
        for (int i = y * WIDTH + x, end = i + 4; i < end; ++i) {
            compare(i, i + 1);
            compare(i, i + WIDTH);
            compare(i + WIDTH, i + WIDTH + 1);
            compare(i + WIDTH, i + 2 * WIDTH);
        }
    }
}

// Whether the brightness jumps from a pixel to the one beside it, and the surface goes on: no outline lies between them
// (outlines.h). Their colours may differ. (Of an entry that several ramps share the palette tells the brightness in one of them, so
// that the model may be asked in vain, or not asked.)
inline bool Creases::jumps(int at, int other) const
{
    return magnitude(stepAt(at) - stepAt(other)) >= JUMP && magnitude(zbuffer_[at] - zbuffer_[other]) <= Rays::BEHIND;
}

// Notes a pixel, unless it has been noted in this frame.
inline void Creases::note(int at)
{
    if (found_.bands == 0)
        wasNoted_.clear();
    found_.bands |= 1u << (at / (WIDTH * BAND));
    if (count_ < NOTED_MOST && wasNoted_.add(at))
        noted_[count_++] = static_cast<uint16_t>(at);
}

// Mends two pixels if there is a crease between them, and follows it. The second may be right once the first is.
void Creases::mendPair(int at, int other)
{
    if (!jumps(at, other))
        return;
    follow(at);
    if (jumps(at, other))
        follow(other);
}

// Mends a pixel, and those beside it to which the brightness then jumps.
void Creases::follow(int at)
{
    note(at);
    while (count_ > 0) {
        const int pixel = noted_[--count_], before = stepAt(pixel);
        if (!mendPixel(pixel) || magnitude(stepAt(pixel) - before) < CHANGE)
            continue;
        forBeside(pixel, [&](int beside) {
            if (jumps(pixel, beside))
                note(beside);
        });
    }
}

// Gives a pixel the colour and the brightness of the model's surface. Returns false if there is none near.
bool Creases::mendPixel(int at)
{
    if (++looks_ > looksMost_)
        return false;
    const int depth = zbuffer_[at];
    Point p = view_.pointAt(at, depth);
    int strongest;
    const Real off = probe_.implicitAt(p, &strongest) - ISOVALUE;
    if (strongest < 0)
        return false;
    if (absolute(off) > EXACT) {
        const Real rise = dot(probe_.gradient(), view_.rayAt(at)), left = off * Real(CORE_SIZE);
        if (rise * FARTHEST <= absolute(left))
            return false;
        p = view_.pointAt(at, depth - floorToInt(quotient(left, rise) * Real(128)));
        if (probe_.implicitAt(p, &strongest) < FieldProbe::FAINT)
            return false;
    }
    const uint8_t entry = tint_.entry(p, strongest);
    if (entry == 0)
        return false;
    view_.setPixel(at, depth, entry);
    return true;
}
