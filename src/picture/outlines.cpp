// Outlines are found in the depths of the picture. Each pixel beside one is looked at once.
#include "outlines.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// Where the depth changes by more than this from a pixel to the next one the two show different surfaces, 1/128 unit.
constexpr int DEEP = Rays::BEHIND;
// The greatest width of a gap through which nothing at all is seen, pixels. In wider ones there may be nothing.
constexpr int CRACK_WIDE = 3;
// The first point of a ray that is looked at lies so far behind what the pixel shows, 1/128 unit: next to its outline a surface is
// hardly thicker, and scales lie in front of it by a little.
constexpr int WITHIN = 112;
// Because rays begin so near the surface, no step need be more than this times as long as the one before.
constexpr int MAX_GROWTH = 3;
// If the excess of the field beside a pixel, foretold by the gradient, is more than this, the ray there may meet the surface, too.
// It is a little less than 0, since the gradient changes on the way. In units of the field, times CORE_SIZE.
constexpr Real NEARLY(-0.1);

// A pixel is compared with one so many columns to the right, and with one so many rows below: if one of the two lies in a crack,
// the other one does not. Where their depths differ each pixel is looked at.
constexpr int AWAY = 4;
static_assert(AWAY >= CRACK_WIDE, "the other pixel lies beyond the crack");

// So many columns are tested at once. Half of them are compared with the other half.
constexpr int AT_ONCE = 2 * AWAY;

// Compares the depths of two pixels side by side with those of the pixels `away` from them. The result has some of the bits LARGE
// if one of the two differences is DEEP or more. Both are computed in one subtraction.
static_assert((DEEP & (DEEP - 1)) == 0, "small differences, plus DEEP, have no bit beyond those of 2 DEEP - 1");
constexpr uint32_t BOTH = 0x10001, LARGE = ~((2 * DEEP - 1) * BOTH);
// (The builtin is a move on any compiler; without a C library memcpy() is a call.)
inline uint32_t compared(const uint16_t* depths, int away)
{
    uint32_t here, there;
    __builtin_memcpy(&here, depths, sizeof here);
    __builtin_memcpy(&there, depths + away, sizeof there);
    return there - here + DEEP * BOTH;
}

// Whether one of the next CRACK_WIDE pixels in a direction is not much deeper than `depth`.
inline bool comesBack(const uint16_t* depths, int step, int depth)
{
    static_assert(CRACK_WIDE == 3, "as many pixels are tested");
    const int deepest = depth + DEEP;
    return depths[step] <= deepest || depths[2 * step] <= deepest || depths[3 * step] <= deepest;
}

}  // namespace

Outlines::Outlines(View& view, Rays& rays, FieldProbe& probe, Missed& missed)
    : view_(view), zbuffer_(view.zbuffer()), rays_(rays), probe_(probe), missed_(missed),
      pixelWide_(Real(1) / view.camera().focalX), pixelHigh_(Real(1) / view.camera().focalY)
{
    wasNoted_.clear();
}

void Outlines::mend()
{
    // At the ends of a row, pixels of the rows above and below stand in for those beside: what a ray finds is right all the same.
    for (int y = 1; y < HEIGHT - 1; ++y) {
        const Span& covered = view_.covered(y);
        if (covered.from >= covered.to)
            continue;
        const uint16_t* const row = zbuffer_ + y * WIDTH;
        const uint16_t* const from = row + (covered.from & -AT_ONCE);
        const uint16_t* const to = row + covered.to;
        mendUpright(from, to);
        if (y % (2 * AWAY) < AWAY && y + AWAY + CRACK_WIDE < HEIGHT)
            mendLying(from, to);
    }
}

// Mends the outlines that a part of a row crosses.
void Outlines::mendUpright(const uint16_t* from, const uint16_t* to)
{
    for (const uint16_t* at = from; at < to; at += AT_ONCE)
        if ((compared(at, AWAY) | compared(at + 2, AWAY)) & LARGE)
            for (int x = 0; x < AT_ONCE; ++x)
                mendAt(at + x, 1);
}

// Mends the outlines right above a part of a row, or right above the row that is AWAY rows below it.
void Outlines::mendLying(const uint16_t* from, const uint16_t* to)
{
    constexpr int below = AWAY * WIDTH;
    for (const uint16_t* at = from; at < to; at += AT_ONCE)
        if ((compared(at, below) | compared(at + 2, below) | compared(at + 4, below) | compared(at + 6, below)) & LARGE)
            for (int x = 0; x < AT_ONCE; ++x) {
                mendAt(at + x, WIDTH);
                mendAt(at + x + below, WIDTH);
            }
}

// Mends the outline between a pixel and the one before it, in steps of `step`, if there is one.
inline void Outlines::mendAt(const uint16_t* at, int step)
{
    const int deeper = *at - at[-step];
    if (magnitude(deeper) > DEEP)
        mendJump(at, step);
}

// Mends a jump of the depth between a pixel and the one before it. Beside the background only cracks are looked for: along whole
// outlines it would take too long, and one pixel more or less of an object is hardly seen there.
void Outlines::mendJump(const uint16_t* at, int step)
{
    const int here = static_cast<int>(at - zbuffer_), before = here - step;
    const bool deeper = zbuffer_[here] > zbuffer_[before];
    const int nearer = deeper ? before : here, behind = deeper ? here : before;
    if (zbuffer_[behind] != Z_EMPTY)
        follow(nearer, behind);
    else if (deeper && comesBack(at, step, zbuffer_[before]))
        missed_.follow(behind, zbuffer_[nearer]);
}

// Looks at a pixel, and wherever one has been mended at those beside it.
void Outlines::follow(int at, int behind)
{
    note(at, behind);
    while (count_ > 0) {
        const Place place = noted_[--count_];
        Real excess;
        if (rays_.tired())
            continue;
        if (meets(place.pixel, &excess))
            widen(place.pixel, excess);
        else
            showBehind(place.pixel, place.behind);
    }
}

// Notes a pixel, unless it has been noted in this frame.
inline void Outlines::note(int at, int behind)
{
    if (count_ < NOTED_MOST && wasNoted_.add(at))
        noted_[count_++] = {static_cast<uint16_t>(at), static_cast<uint16_t>(behind)};
}

// Whether the ray meets the surface that a pixel shows. If so, `*excess` receives that of the field at the last point looked at.
bool Outlines::meets(int at, Real* excess)
{
    int depth = zbuffer_[at] + WITHIN;
    *excess = rays_.excess(at, depth);
    return rays_.findInside(at, &depth, excess, MAX_GROWTH);
}

// Lets a pixel show what is behind the nearer surface, as the pixel `behind` does. Those beside it may have to do the same.
void Outlines::showBehind(int at, int behind)
{
    int depth = zbuffer_[behind];
    if (!rays_.findDepth(at, &depth) || !rays_.show(at, depth))
        return;
    forBeside(at, [&](int beside) {
        if (depth - zbuffer_[beside] > DEEP)
            note(beside, at);
    });
}

// Draws the nearer surface beside a pixel that shows it, where the field there must be about as strong as the isovalue or stronger.
void Outlines::widen(int at, Real excess)
{
    const int depth = zbuffer_[at];
    const Real away = realFromRaw(static_cast<int32_t>(depth) << 9);
    const Vector slope = view_.camera().axes.fromWorld(probe_.gradient());
    const Real right = slope.x * (pixelWide_ * away), up = slope.y * (pixelHigh_ * away), most = excess * Real(CORE_SIZE) - NEARLY;
    forBeside(at, [&](int beside) {
        const Real rise = beside == at - 1 ? -right : beside == at + 1 ? right : beside < at ? up : -up;
        if (zbuffer_[beside] - depth > DEEP && zbuffer_[beside] != Z_EMPTY && rise > -most)
            missed_.follow(beside, depth);
    });
}
