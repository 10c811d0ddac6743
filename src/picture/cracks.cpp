// Closing cracks: pixels that show something far behind the surface on both sides of them, because no seed met the surface there.
// They are found in the depths of the picture; a ray then tells a crack from a place that is truly open.
#include "gaps.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// In a crack, pixels are deeper by more than this, 1/128 unit. The greatest width of a crack, pixels.
constexpr int DEEP = Rays::BEHIND;
constexpr int CRACK_WIDE = 3;

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

void Gaps::closeCracks()
{
    if (model_ == nullptr)
        return;
    // At the ends of a row, pixels of the rows above and below stand in for those beside: what a ray finds is right all the same.
    for (int y = 1; y < HEIGHT - 1; ++y) {
        const Span& covered = view_.covered(y);
        if (covered.from >= covered.to)
            continue;
        const uint16_t* const row = zbuffer_ + y * WIDTH;
        const uint16_t* const from = row + (covered.from & -AT_ONCE);
        const uint16_t* const to = row + covered.to;
        closeUpright(from, to);
        if (y % (2 * AWAY) < AWAY && y <= HEIGHT - 2 * AWAY)
            closeLying(from, to);
    }
}

// Closes the cracks that a part of a row crosses.
void Gaps::closeUpright(const uint16_t* from, const uint16_t* to)
{
    for (const uint16_t* at = from; at < to; at += AT_ONCE)
        if ((compared(at, AWAY) | compared(at + 2, AWAY)) & LARGE)
            for (int x = 0; x < AT_ONCE; ++x)
                closeAt(at + x, 1);
}

// Closes the cracks that begin in a part of a row or AWAY rows below it, and lead down.
void Gaps::closeLying(const uint16_t* from, const uint16_t* to)
{
    constexpr int below = AWAY * WIDTH;
    for (const uint16_t* at = from; at < to; at += AT_ONCE)
        if ((compared(at, below) | compared(at + 2, below) | compared(at + 4, below) | compared(at + 6, below)) & LARGE)
            for (int x = 0; x < AT_ONCE; ++x) {
                closeAt(at + x, WIDTH);
                closeAt(at + x + below, WIDTH);
            }
}

// Closes the crack that begins with a pixel, in steps of `step`, if one does.
inline void Gaps::closeAt(const uint16_t* at, int step)
{
    const int before = at[-step];
    if (*at > before + DEEP && comesBack(at, step, before))
        closeCrack(static_cast<int>(at - zbuffer_) - step, step);
}

// Draws the surface that is missing in a crack, if it is one: it begins after pixel `first`, and comesBack() from there.
void Gaps::closeCrack(int first, int step)
{
    const int near = zbuffer_[first];
    int last = first + step, least = Z_EMPTY;
    for (; zbuffer_[last] > near + DEEP; last += step)
        least = min32(least, zbuffer_[last]);
    if (zbuffer_[last] >= near - DEEP && zbuffer_[last] < least - DEEP)
        missed_.follow(first + step, near, first);
}
