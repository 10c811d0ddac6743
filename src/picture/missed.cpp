// Drawing parts of the surface that were missed: one ray for each pixel, from the depth that the surface has beside it.
#include "missed.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// 1/128 unit: how far a pixel lies behind another from which on both depths are tried.
constexpr int APART = 128;
// All pixels lie behind this depth by APART or more.
constexpr int NOWHERE = -APART;

}  // namespace

// Whether a pixel shows nothing, or something well behind this depth.
inline bool Missed::isMissing(int at, int depth) const
{
    return frame_[at] == 0 || zbuffer_[at] > depth + Rays::BEHIND;
}

void Missed::draw()
{
    const int noted = count_;
    for (int i = 0; i < noted; ++i)
        if (noted_[i].depth != 0) {
            follow(noted_[i].pixel, noted_[i].depth);
        } else if (takeCorner(noted_[i].pixel)) {
            const int at = noted_[i].pixel;
            follow(at, zbuffer_[drawnBeside(at, NOWHERE)]);
        }
    const Crossing* const end = view_.crossings() + view_.crossingCount();
    for (const Crossing* at = view_.crossings(); at < end; ++at) {
        const int first = isMissing(at->pixel, at->depth) ? at->pixel : at->pixel + at->outwards;
        if (isMissing(first, at->depth))
            follow(first, at->depth);
    }
}

bool Missed::follow(int at, int depth)
{
    const int before = count_;
    bool any = false;
    for (put(at, depth); count_ > before;) {
        const Place place = noted_[--count_];
        any |= !rays_.tired() && drawPixel(place);
    }
    return any;
}

// Returns how many pixels from `at` on, in steps of `step`, are drawn with an empty pixel beside them (`at + aside`); LONG at most.
int Missed::sideFrom(int at, int step, int aside) const
{
    const auto onScreen = [](int pixel) { return pixel >= 0 && pixel < WIDTH * HEIGHT; };
    // A side along a row does not go on in another row.
    const int column = at % WIDTH, most = step == 1 ? WIDTH - column : step == -1 ? column + 1 : LONG;
    int count = 0;
    while (count < LONG && count < most && onScreen(at) && onScreen(at + aside) && frame_[at] != 0 && frame_[at + aside] == 0) {
        ++count;
        at += step;
    }
    return count;
}

// Looks at a noted pixel. In a short corner it gets the colour and the depth of the pixel beside it. Returns true when the corner
// is so long that the surface has to be searched for.
bool Missed::takeCorner(int at)
{
    if (frame_[at] != 0)
        return false;
    for (int aside = -1; aside <= 1; aside += 2)
        for (int down = -WIDTH; down <= WIDTH && frame_[at - aside] != 0; down += 2 * WIDTH) {
            if (frame_[at + down] == 0)
                continue;
            const int upright = sideFrom(at - aside, -down, aside), flat = sideFrom(at + down, aside, -down);
            const int shorter = min32(upright, flat), longer = max32(upright, flat);
            if (shorter >= LONG_BOTH || longer == LONG)
                return true;
            if (shorter >= SIDE)
                view_.setPixel(at, zbuffer_[at - aside], frame_[at - aside]);
        }
    return false;
}

// Returns a drawn pixel beside a pixel that lies behind `depth` by at least APART, or `at` itself if there is none.
int Missed::drawnBeside(int at, int depth) const
{
    int found = at;
    forBeside(at, [&](int pixel) {
        if (found == at && frame_[pixel] != 0 && zbuffer_[pixel] - depth >= APART)
            found = pixel;
    });
    return found;
}

// Finds the depth of the surface at a pixel, near a depth. A drawn pixel in the same row is the best guide, because near the upper
// and the lower end of an outline depths change most from row to row. If the ray through an empty pixel misses the surface from
// that depth, it may hit what lies behind, from the depth of another drawn pixel beside it. Returns false when there is no surface.
bool Missed::findSurface(int at, int* depth)
{
    forBeside(at, [&](int beside) {
        if (magnitude(beside - at) == 1 && frame_[beside] != 0 && magnitude(zbuffer_[beside] - *depth) <= Rays::BEHIND)
            *depth = zbuffer_[beside];
    });
    if (rays_.findDepth(at, depth))
        return true;
    if (frame_[at] != 0)
        return false;
    const int behind = drawnBeside(at, *depth);
    *depth = zbuffer_[behind];
    return behind != at && rays_.findDepth(at, depth);
}

// Draws a pixel where surface is missing, and notes the pixels beside it where it may be missing too. Returns false when nothing is
// missing.
bool Missed::drawPixel(Place place)
{
    const int at = place.pixel;
    int depth = place.depth;
    if (!isMissing(at, depth) || !findSurface(at, &depth) || !isMissing(at, depth) || !rays_.show(at, depth))
        return false;
    forBeside(at, [&](int beside) {
        if (isMissing(beside, depth))
            put(beside, depth);
    });
    return true;
}
