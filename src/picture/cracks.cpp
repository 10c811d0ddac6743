// Closing cracks: pixels that show something far behind the surface on both sides of them, because no seed met the surface there.
// They are found in the depths of the picture; a ray then tells a crack from a place that is truly open.
#include "gaps.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// In a crack, pixels are deeper by more than this, 1/128 unit. The greatest width of a crack, pixels.
constexpr int DEEP = Missed::BEHIND;
constexpr int CRACK_WIDE = 3;

// A pixel is compared with one so many columns to the right, and with one so many rows below: if one of the two lies in a crack,
// the other one does not.
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
    for (int y = 2 * AWAY; y < HEIGHT - 2 * AWAY; ++y) {
        const Span& covered = view_.covered(y);
        if (covered.from >= covered.to)
            continue;
        const uint16_t* const row = zbuffer_ + y * WIDTH;
        const uint16_t* const from = row + max32(covered.from & -AT_ONCE, AT_ONCE);
        const uint16_t* const to = row + min32(covered.to, WIDTH - AT_ONCE);
        closeUpright(from, to);
        if (y % (2 * AWAY) < AWAY)
            closeLying(from, to);
    }
}

// Closes the cracks that a part of a row crosses.
void Gaps::closeUpright(const uint16_t* from, const uint16_t* to)
{
    for (const uint16_t* at = from; at < to; at += AT_ONCE)
        if ((compared(at, AWAY) | compared(at + 2, AWAY)) & LARGE)
            for (int x = 0; x < AWAY; ++x)
                closeBetween(static_cast<int>(at + x - zbuffer_), 1);
}

// Closes the cracks that lie in a part of a row or AWAY rows below it.
void Gaps::closeLying(const uint16_t* from, const uint16_t* to)
{
    constexpr int below = AWAY * WIDTH;
    for (const uint16_t* at = from; at < to; at += AT_ONCE)
        if ((compared(at, below) | compared(at + 2, below) | compared(at + 4, below) | compared(at + 6, below)) & LARGE)
            for (int x = 0; x < AT_ONCE; ++x)
                closeBetween(static_cast<int>(at + x - zbuffer_), WIDTH);
}

// Closes the crack that a pixel, or the one AWAY steps on, lies in, if there is one.
inline void Gaps::closeBetween(int at, int step)
{
    const int there = at + AWAY * step, deeper = zbuffer_[there] - zbuffer_[at];
    if (deeper > DEEP && comesBack(zbuffer_ + there, step, zbuffer_[at]))
        closeCrack(at, step);
    else if (deeper < -DEEP && comesBack(zbuffer_ + at, -step, zbuffer_[there]))
        closeCrack(there, -step);
}

// Draws the surface that is missing in a crack, if it is one: it begins at most AWAY steps from a pixel that does not lie in it.
void Gaps::closeCrack(int first, int step)
{
    const int end = first + AWAY * step;
    while (zbuffer_[first + step] <= zbuffer_[first] + DEEP) {
        first += step;
        // A surface that is steep is no crack.
        if (first == end)
            return;
    }
    const int near = zbuffer_[first];
    int last = first + step, least = Z_EMPTY;
    for (; zbuffer_[last] > near + DEEP; last += step) {
        if (last == first + (CRACK_WIDE + 1) * step)
            return;
        least = min32(least, zbuffer_[last]);
    }
    if (zbuffer_[last] >= near - DEEP && zbuffer_[last] < least - DEEP)
        missed_.follow(first + step, near, first);
}
