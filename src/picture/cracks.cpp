// Closing cracks: pixels that show something far behind the surface above and below them, because no seed met the surface there.
// They are found in the depths of the picture; a ray then tells a crack from a place that is truly open.
#include "gaps.h"

#include "math/whole.h"
#include "rt.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// The least change of depth into a crack, 1/128 unit; and the greatest height of a crack, pixels.
constexpr int DEEP = 512;
constexpr int CRACK_HIGH = 3;
constexpr int BELOW = CRACK_HIGH * WIDTH;

// So many columns are tested at once.
constexpr int AT_ONCE = 8;

// Compares the depths of two pixels side by side with those of the pixels CRACK_HIGH rows below. The result has some of the bits
// LARGE if one of the two differences is DEEP or more. Both are computed in one subtraction.
constexpr uint32_t BOTH = 0x10001, LARGE = ~((2 * DEEP - 1) * BOTH);
inline uint32_t jumpBelow(const uint16_t* depths)
{
    uint32_t here, below;
    memcpy(&here, depths, sizeof here);
    memcpy(&below, depths + BELOW, sizeof below);
    return below - here + DEEP * BOTH;
}

// Whether one of the next CRACK_HIGH pixels of a column is not much deeper than `depth`.
inline bool comesBack(const uint16_t* depths, int step, int depth)
{
    static_assert(CRACK_HIGH == 3, "as many pixels are tested");
    const int deepest = depth + DEEP;
    return depths[step] <= deepest || depths[2 * step] <= deepest || depths[3 * step] <= deepest;
}

}  // namespace

// Each pixel is compared with one CRACK_HIGH rows above or below it: if it lies in a crack, the other one does not.
void Gaps::closeCracks()
{
    if (model_ == nullptr)
        return;
    for (int top = 2 * CRACK_HIGH; top + 3 * CRACK_HIGH <= HEIGHT; top += 2 * CRACK_HIGH)
        for (int y = top; y < top + CRACK_HIGH; ++y)
            closeCracks(y);
}

// Closes the cracks that pass through a row or through the one CRACK_HIGH rows below it.
void Gaps::closeCracks(int y)
{
    const Span covered = view_.covered(y);
    const uint16_t* const row = zbuffer_ + y * WIDTH;
    const uint16_t* const end = row + covered.to;
    for (const uint16_t* at = row + (covered.from & -AT_ONCE); at < end; at += AT_ONCE) {
        if (((jumpBelow(at) | jumpBelow(at + 2) | jumpBelow(at + 4) | jumpBelow(at + 6)) & LARGE) == 0)
            continue;
        for (int x = 0; x < AT_ONCE; x += 2)
            if (jumpBelow(at + x) & LARGE) {
                closeColumn(static_cast<int>(at + x - zbuffer_));
                closeColumn(static_cast<int>(at + x + 1 - zbuffer_));
            }
    }
}

inline void Gaps::closeColumn(int at)
{
    const int here = zbuffer_[at], below = zbuffer_[at + BELOW];
    if (below > here + DEEP && comesBack(zbuffer_ + at + BELOW, WIDTH, here))
        closeCrack(at, WIDTH);
    else if (here > below + DEEP && comesBack(zbuffer_ + at, -WIDTH, below))
        closeCrack(at + BELOW, -WIDTH);
}

// Draws the surface that is missing in a crack, if it is one: it begins at most CRACK_HIGH rows below (`step` WIDTH) or above
// (-WIDTH) a pixel.
void Gaps::closeCrack(int first, int step)
{
    while (zbuffer_[first + step] <= zbuffer_[first] + DEEP)
        first += step;
    const int near = zbuffer_[first];
    int last = first + step, least = Z_EMPTY;
    for (; zbuffer_[last] > near + DEEP; last += step) {
        if (last == first + (CRACK_HIGH + 1) * step)
            return;
        least = min32(least, zbuffer_[last]);
    }
    if (zbuffer_[last] >= near - DEEP && zbuffer_[last] < least - DEEP)
        missed_.follow(first + step, near, first);
}
