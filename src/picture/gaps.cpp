// Closing gaps: each row is scanned once. Only short runs of empty pixels between drawn ones (gaps) take more work. An opening is
// the region of empty pixels that a gap leads into, followed from row to row. A slit is a low vertical run of empty pixels.
#include "gaps.h"

#include "math/whole.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// Limits of what counts as a gap (View::closeGaps()), pixels. "A spacing" is the spacing of the seeds on the screen.
constexpr int GAP_WIDE = 10;  // plus a spacing: width and height of an opening that is closed on all sides
constexpr int GAP_NARROW = 8; // plus a spacing: width of the narrow end of an opening that is open above or below
constexpr int GAP_LOW = 6;    // height of a slit that is open to a side
constexpr int GAP_THIN = 2;   // width of a run that is filled whatever lies above and below
constexpr int GAP_MOST = 32;  // upper bound of all widths, however near the viewer the seeds are
constexpr Real STEEP(1.3);    // upper bound of the gradient of a field, times the size of its object
constexpr int SLIVER = 2;     // width of a run of drawn pixels beside which surface may be missing
// An outline may lie pixels beyond the last scale, and no corner tells it: nearer to the viewer than CLOSE_UP, 1/128 unit, where
// scales are large; and where lists have borders, if the outline is upright and the depth changes slowly up to the end of the row,
// by less than 1/FLAT of itself (about one and a half times the width of a pixel). There the surface is looked for at the ends of
// one row in ENDS_EVERY.
constexpr int CLOSE_UP = 50 * 128, FLAT = 170, ENDS_EVERY = 4;
// Pixels: by how much a step of an outline is too long (endsEarly()), and up to which length steps are measured.
constexpr int STEP_MORE = 2, STEP_MOST = 12;
// 1/128 unit: of two drawn pixels whose depths differ by more, one lies well in front of the other.
constexpr int IN_FRONT = 256;
// Units, half way across an opening: if the surface is at least DOUBTFUL away there, only those pixels of the opening are drawn
// that show the surface, and from OPEN on only if surface is found beside the farther end. From FAR on it is not looked for.
constexpr Real DOUBTFUL(0.25), OPEN(1), FAR(2);

// Whether a pixel is empty and lies right below a drawn one and at most GAP_LOW pixels above another.
inline bool inSlit(const uint8_t* pixel)
{
    static_assert(GAP_LOW == 6 && GAP_LOW <= View::ROWS_BELOW, "as many rows are looked at");
    return pixel[-WIDTH] != 0 && pixel[0] == 0 &&
           (pixel[WIDTH] | pixel[2 * WIDTH] | pixel[3 * WIDTH] | pixel[4 * WIDTH] | pixel[5 * WIDTH] | pixel[6 * WIDTH]) != 0;
}

// Whether the row of the empty pixel at an end of a drawn run ends early: the next row (`down`: WIDTH or -WIDTH) goes farther out
// by a step that is longer, by STEP_MORE or more, than the steps before and after it, as none is on a round outline. The caller
// has seen that it is at least three pixels long.
bool endsEarly(const uint8_t* pixel, int outwards, int down)
{
    int step = 3;
    while (step < STEP_MOST && pixel[down + step * outwards] != 0)
        ++step;
    const int most = step - STEP_MORE;
    return pixel[2 * down + (step + most) * outwards] == 0 && pixel[-down - (most + 1) * outwards] != 0;
}

// The columns of an opening, row after row. The first `narrow` rows of it are to be filled.
struct Opening {
    Span rows[GAP_MOST];
    int height = 0, narrow = 0;
};

// Finds how an opening of columns *from to *to goes on in the next row: from the leftmost to the rightmost empty pixel connected
// with it; drawn pixels between the two are ignored. Returns false when all pixels of the row next to the opening are drawn.
bool goesOn(const uint8_t* row, int maxWidth, int* from, int* to)
{
    const int left = *from, right = *to;
    while (*from < right && row[*from] != 0)
        ++*from;
    if (*from == right)
        return false;
    while (row[*to - 1] != 0)
        --*to;
    while (*from <= left && *from > 0 && *to - *from <= maxWidth && row[*from - 1] == 0)
        --*from;
    while (*to >= right && *to < WIDTH && *to - *from <= maxWidth && row[*to] == 0)
        ++*to;
    return true;
}

// Follows an opening down (`step` 1) or up (`step` -1) from the columns `from` to before `to` of row y.
void followOpening(const uint8_t* frame, int y, int from, int to, int step, int maxWidth, int maxNarrow, Opening& opening)
{
    for (;;) {
        // All that lies before a narrow place is filled together with it.
        if (to - from <= maxNarrow)
            opening.narrow = opening.height + 1;
        opening.rows[opening.height++] = {static_cast<int16_t>(from), static_cast<int16_t>(to)};
        const int next = y + opening.height * step;
        if (next < 0 || next >= HEIGHT)
            return;
        if (!goesOn(frame + next * WIDTH, maxWidth, &from, &to)) {
            opening.narrow = opening.height;
            return;
        }
        if (to - from > maxWidth || from == 0 || to == WIDTH || opening.height == maxWidth)
            return;
    }
}

}  // namespace

// Whether lists with borders have drawn around a pixel of row y.
inline bool Gaps::isBordered(int y, int x) const
{
    const Span& bordered = view_.bordered(y);
    return x >= bordered.from && x < bordered.to;
}

// Notes the empty pixel at an end of a run of drawn pixels, if it may be in an inner corner, or if the run ends early. One side of
// a corner goes outwards in the row below (or above) the pixel, the other one up (or down) from the last pixel of the run.
inline void Gaps::noteCorner(int y, int x, int outwards)
{
    const uint8_t* const pixel = frame_ + y * WIDTH + x;
    for (int down = -WIDTH; down <= WIDTH; down += 2 * WIDTH) {
        if (pixel[down + outwards] == 0)
            continue;
        static_assert(Missed::SIDE == 2, "the second pixels of both sides of a corner are tested");
        if (pixel[-down - outwards] != 0)
            missed_.noteCorner(x, y);
        else if (pixel[down + 2 * outwards] != 0 && model_ != nullptr && isBordered(y, x) && endsEarly(pixel, outwards, down))
            missed_.noteEnd(x, y, -outwards);
    }
}

// Notes the empty pixels at both ends of a run of drawn pixels, and beside a narrow run, where surface may be missing.
inline void Gaps::noteCorners(int y, const Span& run)
{
    noteCorner(y, run.from - 1, -1);
    noteCorner(y, run.to, 1);
    if (run.to - run.from <= SLIVER && model_ != nullptr)
        noteSliver(y, run);
}

// An island that seeds have missed may go on beside a narrow run. At the upper and the lower end of an outline runs are narrow,
// too, but the row above or below is drawn there, and nothing is noted.
inline void Gaps::noteSliver(int y, const Span& run)
{
    const uint8_t* const row = frame_ + y * WIDTH;
    for (int end = run.from - 1, inwards = 1; inwards >= -1; end = run.to, inwards -= 2)
        if ((row[end - WIDTH] | row[end + WIDTH]) == 0)
            missed_.noteEnd(end, y, inwards);
}

// Notes the empty pixels beside both ends of a run of drawn pixels, if the surface may go on there.
inline void Gaps::noteEnds(int y, const Span& run)
{
    const uint16_t* const depths = zbuffer_ + y * WIDTH;
    const uint8_t* const row = frame_ + y * WIDTH;
    const auto note = [&](int last, int inwards) {
        const int depth = depths[last], deeper = depth - depths[last + inwards], end = last - inwards;
        const auto isUpright = [&] { return (row[end - WIDTH] | row[end + WIDTH]) == 0; };
        if (depth < CLOSE_UP || (deeper * FLAT < depth && isBordered(y, last) && isUpright()))
            missed_.noteEnd(end, y, inwards);
    };
    note(run.from, 1);
    note(run.to - 1, -1);
}

// Notes the outermost empty pixels to both sides of `columns`, in the row where the filled part of an opening ends.
void Gaps::noteBeyond(int y, const Span& columns)
{
    if (y < 0 || y >= HEIGHT)
        return;
    int from = columns.from, to = columns.to;
    const uint8_t* row = frame_ + y * WIDTH;
    while (from > 0 && columns.from - from < GAP_MOST && row[from - 1] == 0)
        --from;
    while (to < WIDTH && to - columns.to < GAP_MOST && row[to] == 0)
        ++to;
    missed_.noteCorner(from, y);
    missed_.noteCorner(to - 1, y);
}

void Gaps::close()
{
    for (int y = 0; y < HEIGHT; ++y)
        if (view_.touched(y).from < view_.touched(y).to)
            closeRow(y);
    missed_.draw();
}

// Closes the gaps of a row that has drawn pixels, and the slits that begin beside these; notes where surface may have been missed.
void Gaps::closeRow(int y)
{
    Span runs[WIDTH / 2];
    const uint8_t* row = frame_ + y * WIDTH;
    const Span* const end = runs + drawnRuns(row, zbuffer_ + y * WIDTH, &view_.touched(y), runs);
    view_.setTouched(y, runs, end);
    int last = 0;  // one past the end of the previous run; 0 before the first
    for (const Span* run = runs; run < end; ++run) {
        closeBefore(y, last, run->from);
        last = run->to;
        noteOutline(y, *run);
    }
    if (y > 0 && last > 0 && last < WIDTH && inSlit(row + last))
        closeSlit(y, last, WIDTH, 1);
}

// Closes the gap before a run, from the end of the run before it (0 if there is none), and the slits that begin at both ends of the
// gap.
inline void Gaps::closeBefore(int y, int last, int from)
{
    const uint8_t* row = frame_ + y * WIDTH;
    if (last > 0 && from - last <= GAP_MOST)
        closeRun(y, last, from);
    if (y == 0)
        return;
    if (last > 0 && inSlit(row + last))
        closeSlit(y, last, from, 1);
    if (from > 0 && inSlit(row + from - 1))
        closeSlit(y, from - 1, last - 1, -1);
}

// Notes where surface may be missing at the ends of a run of drawn pixels.
inline void Gaps::noteOutline(int y, const Span& run)
{
    if (y >= Missed::SIDE && y < HEIGHT - Missed::SIDE)
        noteCorners(y, run);
    if (y % ENDS_EVERY == ENDS_EVERY - 1 && model_ != nullptr)
        noteEnds(y, run);
}

// How many pixels the seeds lie apart at the farther one of two drawn pixels.
inline int Gaps::spacingAt(int first, int last) const
{
    return spacingTimesDepth_ / (max32(zbuffer_[first], zbuffer_[last]) | 1);
}

// The width and the height up to which openings are closed, pixels.
inline int Gaps::widest(int spacing)
{
    return min32(GAP_WIDE + spacing, GAP_MOST);
}

// Closes the gap of columns `from` to before `to` between drawn pixels.
void Gaps::closeRun(int y, int from, int to)
{
    const uint8_t* row = frame_ + y * WIDTH;
    const int first = y * WIDTH + from - 1, last = y * WIDTH + to, spacing = spacingAt(first, last);
    if (to - from > widest(spacing))
        return;
    if (to - from <= GAP_THIN) {
        fill(first, last, 1);
        // Openings above may have been open only because of this run.
        closeAbove(y, from);
        closeAbove(y, to - 1);
    }
    // Follows the opening downwards if the row above is closed, and upwards if it is still empty and the row below is closed.
    for (int step = 1; step >= -1 && row[from] == 0; step -= 2) {
        if (y - step < 0 || y - step >= HEIGHT)
            continue;
        int x = from;
        while (x < to && row[x - step * WIDTH] != 0)
            ++x;
        if (x == to)
            closeFrom(y, from, to, step, spacing);
    }
}

// Follows the empty run above a drawn pixel upwards, if the row below that run is closed now.
void Gaps::closeAbove(int y, int x)
{
    if (y < 2 || frame_[(y - 1) * WIDTH + x] != 0)
        return;
    const uint8_t* row = frame_ + (y - 1) * WIDTH;
    const int spacing = spacingAt(y * WIDTH + x, y * WIDTH + x), maxWidth = widest(spacing);
    int from = x, to = x + 1;
    while (from > 0 && to - from <= maxWidth && row[from - 1] == 0)
        --from;
    while (to < WIDTH && to - from <= maxWidth && row[to] == 0)
        ++to;
    if (to - from > maxWidth || from == 0 || to == WIDTH) {
        // What has been filled may have made a corner of an end.
        missed_.noteCorner(from, y - 1);
        missed_.noteCorner(to - 1, y - 1);
        return;
    }
    for (int i = from; i < to; ++i)
        if (row[i + WIDTH] == 0)
            return;
    closeFrom(y - 1, from, to, -1, spacing);
}

// Follows an opening from its closed end, and fills its rows as far as the last one that is narrow: from both sides where the
// surface is sure to be there; else, and where the sides cannot tell how it looks, with the model's surface.
void Gaps::closeFrom(int y, int from, int to, int step, int spacing)
{
    Opening opening;
    followOpening(frame_, y, from, to, step, widest(spacing), GAP_NARROW + spacing, opening);
    const int narrow = opening.narrow;
    const Span* const rows = opening.rows;
    if (narrow > 0) {
        const int middle = narrow / 2, row = (y + middle * step) * WIDTH;
        const Real off = distanceOff(row + rows[middle].from - 1, row + rows[middle].to, 1);
        if (off >= OPEN && (off >= FAR || !searchBehind(y * WIDTH + rows[0].from - 1, y * WIDTH + rows[0].to)))
            return;
        for (int i = 0; i < narrow; ++i) {
            const int start = (y + i * step) * WIDTH, first = start + rows[i].from - 1, last = start + rows[i].to;
            const bool thin = last - first <= GAP_THIN + 1;
            if (off < DOUBTFUL || (thin && off < OPEN)) {
                if (!thin && differ(first, last))
                    closeExactly(first, last);
                fill(first, last, 1);
            } else if (!closeExactly(first, last)) {
                break;
            }
        }
    }
    noteBeyond(y + narrow * step, rows[narrow < opening.height ? narrow : narrow - 1]);
}

// Draws surface that is missing beside the farther one of two drawn pixels of a row. Returns false when there is none.
bool Gaps::searchBehind(int first, int last)
{
    return zbuffer_[first] < zbuffer_[last] ? missed_.follow(last - 1, zbuffer_[last])
                                            : missed_.follow(first + 1, zbuffer_[first]);
}

// Draws the surface of the model from both ends of a row's gap on, as far as it goes, and fills the rest if that is thin. Returns
// false when there is no surface.
bool Gaps::closeExactly(int first, int last)
{
    bool drawn = missed_.follow(first + 1, zbuffer_[first]);
    drawn |= missed_.follow(last - 1, zbuffer_[last]);
    while (first + 1 < last && frame_[first + 1] != 0)
        ++first;
    while (first + 1 < last && frame_[last - 1] != 0)
        --last;
    if (last - first <= GAP_THIN + 1)
        fill(first, last, 1);
    return drawn;
}

// A lower bound of the distance from the place half way between two drawn pixels of a row (`step` 1) or of a column (`step` WIDTH)
// to the surface of the model, units. It is 0 or less if the place lies inside, if the gap is thin, and without a model.
Real Gaps::distanceOff(int first, int last, int step) const
{
    const int count = (last - first) / step;
    if (model_ == nullptr || count <= GAP_THIN + 1)
        return Real(0);
    const Point here = view_.pointAt(first);
    const Vector way = view_.pointAt(last) - here;
    const Real off = distanceOff(here + Vector{shiftDown(way.x, 1), shiftDown(way.y, 1), shiftDown(way.z, 1)});
    if (off < DOUBTFUL)
        return off;
    // The nearer pixel may belong to something in front of the surface, which is then as far away as the farther pixel.
    const int farther = zbuffer_[first] < zbuffer_[last] ? last : first;
    return min(off, distanceOff(view_.pointAt(first + count / 2 * step, zbuffer_[farther])));
}

// A lower bound of the distance from a point to the surface of any body, units: it follows from the steepest gradient that a field
// can have. It is FAR where no field reaches the point.
Real Gaps::distanceOff(const Point& p) const
{
    int strongest;
    const Real field = probe_.implicitAt(p, &strongest);
    return strongest < 0 ? FAR : (ISOVALUE - min(field, Real(1))) * (model_->actor(strongest).object->size() / STEEP);
}

// The ramp that two drawn pixels share; null if they have the same colour, if they share none, or without a palette.
inline const uint8_t* Gaps::commonRamp(int first, int last) const
{
    if (palette_ == nullptr || frame_[first] == frame_[last])
        return nullptr;
    const uint8_t number = palette_->rampOf(frame_[first]);
    return number != 0 && number == palette_->rampOf(frame_[last]) ? palette_->ramp(number) : nullptr;
}

// Whether of two drawn pixels one lies well in front of the other, so that what lies between the two cannot be told from them.
// (Their colours do not count: depths are the same whether colours are shown or not.)
inline bool Gaps::differ(int first, int last) const
{
    return model_ != nullptr && magnitude(zbuffer_[first] - zbuffer_[last]) > IN_FRONT;
}

// Fills the empty pixels between two drawn ones with the depth and the colour of whichever is closer on the screen. If both have
// one ramp the brightness is interpolated.
void Gaps::fill(int first, int last, int step)
{
    const int count = (last - first) / step;
    const uint8_t* const ramp = commonRamp(first, last);
    int light = 0, lighter = 0;
    if (ramp != nullptr) {
        light = palette_->step(frame_[first]) << 8;
        lighter = ((palette_->step(frame_[last]) << 8) - light) / count;
    }
    for (int i = 1; i < count; ++i) {
        const int at = first + i * step;
        if (frame_[at] != 0)
            continue;
        view_.copyPixel(at, 2 * i <= count ? first : last);
        if (ramp != nullptr)
            view_.setPixel(at, zbuffer_[at], ramp[(light + i * lighter + 128) >> 8]);
    }
}

// Closes a slit column by column, from column x in steps of +-1 to before `end`, between the drawn pixels above and below.
void Gaps::closeSlit(int y, int x, int end, int step)
{
    for (; x != end && inSlit(frame_ + y * WIDTH + x); x += step) {
        const int at = y * WIDTH + x;
        int height = 1;
        while (frame_[at + height * WIDTH] == 0)
            ++height;
        const int above = at - WIDTH, below = at + height * WIDTH;
        if (distanceOff(above, below, WIDTH) >= OPEN)
            continue;
        fill(above, below, WIDTH);
        view_.overlay(x, y, 1, height);
    }
    missed_.noteCorner(x, y);
    // What is left of the row may be an opening that is closed below.
    if (x != end && y + 1 < HEIGHT && frame_[(y + 1) * WIDTH + x] != 0)
        closeAbove(y + 1, x);
}
