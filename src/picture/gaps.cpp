// Closing gaps: each row is looked at once, and more only where a run of empty pixels between drawn ones is short.
#include "gaps.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// What is taken for a gap (View::closeGaps()), pixels: what is closed all round and up to GAP_WIDE and a spacing of the
// seeds wide and high; the end of what is open above or below, where it is up to GAP_NARROW and a spacing wide, or to a side,
// where it is up to GAP_LOW high; and what is up to GAP_THIN wide.
constexpr int GAP_WIDE = 10;
constexpr int GAP_NARROW = 8;
constexpr int GAP_LOW = 6;
constexpr int GAP_THIN = 2;
constexpr Real STEEP(1.3);  // of the field: by what it changes in a unit at most, times the size of its object
constexpr int GAP_MOST = 32;  // however near the viewer
constexpr int DIVIDED = 2;    // as near as this its ends stand when the place is found where a gap changes its colour

// Whether a pixel is empty and lies right below a drawn one and a little way above another.
inline bool inSlit(const uint8_t* pixel)
{
    static_assert(GAP_LOW == 6 && GAP_LOW <= View::ROWS_BELOW, "as many rows are looked at");
    return pixel[-WIDTH] != 0 && pixel[0] == 0 &&
           (pixel[WIDTH] | pixel[2 * WIDTH] | pixel[3 * WIDTH] | pixel[4 * WIDTH] | pixel[5 * WIDTH] | pixel[6 * WIDTH]) != 0;
}

// The columns of an opening, row after row. Those of the first `narrow` rows are closed.
struct Opening {
    Span rows[GAP_MOST];
    int height = 0, narrow = 0;
};

// What is empty beside an opening in the next row, all that lies between taken for empty. False: nothing is.
bool goesOn(const uint8_t* row, int widest, int* from, int* to)
{
    const int left = *from, right = *to;
    while (*from < right && row[*from] != 0)
        ++*from;
    if (*from == right)
        return false;
    while (row[*to - 1] != 0)
        --*to;
    while (*from <= left && *from > 0 && *to - *from <= widest && row[*from - 1] == 0)
        --*from;
    while (*to >= right && *to < WIDTH && *to - *from <= widest && row[*to] == 0)
        ++*to;
    return true;
}

// Follows an opening down (or up: `step`) from columns of a row.
void follow(const uint8_t* frame, int y, int from, int to, int step, int widest, int narrowest, Opening& opening)
{
    for (;;) {
        // All below a neck goes with it.
        if (to - from <= narrowest)
            opening.narrow = opening.height + 1;
        opening.rows[opening.height++] = {static_cast<int16_t>(from), static_cast<int16_t>(to)};
        const int next = y + opening.height * step;
        if (next < 0 || next >= HEIGHT)
            return;
        if (!goesOn(frame + next * WIDTH, widest, &from, &to)) {
            opening.narrow = opening.height;
            return;
        }
        if (to - from > widest || from == 0 || to == WIDTH || opening.height == widest)
            return;
    }
}

}  // namespace

// Notes the empty pixels at both ends of a run that are in corners.
inline void Gaps::noteCorners(int y, const Span& run)
{
    const uint8_t* const row = frame_ + y * WIDTH;
    if (Missed::mayBeInCorner(row + run.from - 1, -1))
        missed_.note(run.from - 1, y);
    if (Missed::mayBeInCorner(row + run.to, 1))
        missed_.note(run.to, y);
}

// The same of what lies beyond an opening that was closed: to both sides of some of its columns.
void Gaps::noteBeyond(int y, const Span& columns)
{
    int from = columns.from, to = columns.to;
    const uint8_t* row = frame_ + y * WIDTH;
    if (y < 0 || y >= HEIGHT)
        return;
    while (from > 0 && columns.from - from < GAP_MOST && row[from - 1] == 0)
        --from;
    while (to < WIDTH && to - columns.to < GAP_MOST && row[to] == 0)
        ++to;
    missed_.note(from, y);
    missed_.note(to - 1, y);
}

int Gaps::close(Real spacing)
{
    int drawn = 0;
    // A spacing in pixels is this over a depth of the Z-buffer.
    const int32_t near = mulShift16(rawFromReal(view_.camera().focalX) >> 4, rawFromReal(spacing)) >> 5;
    Span runs[WIDTH / 2];
    const uint8_t* row = frame_;
    for (int y = 0; y < HEIGHT; ++y, row += WIDTH) {
        const Span& touched = view_.touched(y);
        if (touched.from >= touched.to)
            continue;
        const bool slits = y > 0;
        const Span* const end = runs + drawnRuns(row, zbuffer_ + y * WIDTH, &touched, runs);
        int last = 0;  // behind the run before
        for (const Span* run = runs; run < end; ++run) {
            const int from = run->from;
            drawn += run->to - from;
            if (last > 0 && from - last <= GAP_MOST) {
                const int before = zbuffer_[y * WIDTH + last - 1], behind = zbuffer_[y * WIDTH + from];
                closeRun(y, last, from, near / ((before > behind ? before : behind) | 1));
            }
            if (slits && last > 0 && inSlit(row + last))
                closeSlit(y, last, from, 1);
            if (slits && from > 0 && inSlit(row + from - 1))
                closeSlit(y, from - 1, last - 1, -1);
            last = run->to;
            if (y >= Missed::SIDE && y < HEIGHT - Missed::SIDE)
                noteCorners(y, *run);
        }
        if (slits && last > 0 && last < WIDTH && inSlit(row + last))
            closeSlit(y, last, WIDTH, 1);
    }
    missed_.draw();
    return drawn;
}

// Pixels from column `from` to before `to` are empty, those on both sides are not; seeds lie `spacing` pixels apart there.
void Gaps::closeRun(int y, int from, int to, int spacing)
{
    const uint8_t* row = frame_ + y * WIDTH;
    int widest = GAP_WIDE + spacing;
    widest = widest > GAP_MOST ? GAP_MOST : widest;
    if (to - from > widest)
        return;
    if (to - from <= GAP_THIN) {
        fill(NO_ENDS, y * WIDTH + from - 1, y * WIDTH + to, 1);
        // What lies above may have been open to it.
        closeAbove(y, from, widest, GAP_NARROW + spacing);
        closeAbove(y, to - 1, widest, GAP_NARROW + spacing);
    }
    // Where it begins, and where it ends if it was not closed from there.
    for (int step = 1; step >= -1 && row[from] == 0; step -= 2) {
        if (y - step < 0 || y - step >= HEIGHT)
            continue;
        int x = from;
        while (x < to && row[x - step * WIDTH] != 0)
            ++x;
        if (x == to)
            closeFrom(y, from, to, step, widest, GAP_NARROW + spacing);
    }
}

// What is empty above a pixel that has just been filled is followed up, if that has closed it below.
void Gaps::closeAbove(int y, int x, int widest, int narrowest)
{
    const uint8_t* row = frame_ + (y - 1) * WIDTH;
    if (y < 2 || row[x] != 0)
        return;
    int from = x, to = x + 1;
    while (from > 0 && to - from <= widest && row[from - 1] == 0)
        --from;
    while (to < WIDTH && to - from <= widest && row[to] == 0)
        ++to;
    if (to - from > widest || from == 0 || to == WIDTH)
        return;
    for (int i = from; i < to; ++i)
        if (row[i + WIDTH] == 0)
            return;
    closeFrom(y - 1, from, to, -1, widest, narrowest);
}

// Closes what of the opening before which a row is closed is narrow, and what lies below that.
void Gaps::closeFrom(int y, int from, int to, int step, int widest, int narrowest)
{
    Opening opening;
    follow(frame_, y, from, to, step, widest, narrowest, opening);
    const int narrow = opening.narrow;
    const Span* const rows = opening.rows;
    if (narrow > 0) {
        const int middle = narrow / 2, row = (y + middle * step) * WIDTH;
        if (isOpen(row + rows[middle].from - 1, row + rows[middle].to, 1))
            return;
        const Ends ends = endsOf(row + rows[middle].from - 1, row + rows[middle].to);
        for (int i = 0; i < narrow; ++i)
            fill(ends, (y + i * step) * WIDTH + rows[i].from - 1, (y + i * step) * WIDTH + rows[i].to, 1);
    }
    noteBeyond(y + narrow * step, rows[narrow < opening.height ? narrow : narrow - 1]);
}

// Whether between two drawn pixels, `step` the way from each to the next, there is none of the surface.
bool Gaps::isOpen(int first, int last, int step) const
{
    const int count = (last - first) / step;
    if (model_ == nullptr || count <= GAP_THIN + 1)
        return false;
    const Point here = view_.pointAt(first);
    const Vector way = view_.pointAt(last) - here;
    // The nearer of the two may hide what the gap is in, which is then as far away as the other.
    const int farther = zbuffer_[first] < zbuffer_[last] ? last : first;
    return isOff(here + Vector{shiftDown(way.x, 1), shiftDown(way.y, 1), shiftDown(way.z, 1)}) &&
           isOff(view_.pointAt(first + count / 2 * step, zbuffer_[farther]));
}

// Whether a point lies well outside of every body.
bool Gaps::isOff(const Point& p) const
{
    int strongest;
    const Real field = model_->implicitAt(p, &strongest);
    return strongest < 0 || field < ISOVALUE - STEEP / model_->actor(strongest).object->size();
}

// Whose the drawn pixels on both sides of a gap are. None are named where their colour is the same, where their fields do not
// meet, or without a model.
Gaps::Ends Gaps::endsOf(int first, int last) const
{
    if (model_ == nullptr || palette_ == nullptr || frame_[first] == frame_[last])
        return NO_ENDS;
    const Ends ends{model_->strongestAt(view_.pointAt(first)), model_->strongestAt(view_.pointAt(last))};
    if (ends.first < 0 || ends.last < 0 || !model_->actor(ends.first).object->inRange(*model_->actor(ends.last).object))
        return NO_ENDS;
    return ends;
}

// Between two drawn pixels, `step` the way from each to the next: the first that is the last one's.
int Gaps::divide(const Ends& ends, int first, int last, int step) const
{
    const SoftObject &one = *model_->actor(ends.first).object, &other = *model_->actor(ends.last).object;
    Point here = view_.pointAt(first), there = view_.pointAt(last);
    // The surface between them is taken for flat.
    while (last - first > DIVIDED * step) {
        const int at = first + (last - first) / step / 2 * step;
        const Vector way = there - here;
        const Point p = here + Vector{shiftDown(way.x, 1), shiftDown(way.y, 1), shiftDown(way.z, 1)};
        if (one.fieldFunc(p) < other.fieldFunc(p)) {
            last = at;
            there = p;
        } else {
            first = at;
            here = p;
        }
    }
    return last;
}

// Empty pixels between two drawn ones, `step` the way from each to the next, take over what the nearer one has. Where the two
// are of two objects, each gets the colour of the one that is the stronger there, and is as bright as lies between them.
void Gaps::fill(const Ends& ends, int first, int last, int step)
{
    const int count = (last - first) / step;
    const bool named = ends.first >= 0 && count > GAP_THIN + 1;
    int second = last, light = 0, lighter = 0;
    const uint8_t *one = nullptr, *other = nullptr;
    if (named) {
        second = ends.first == ends.last ? last : divide(ends, first, last, step);
        one = model_->actor(ends.first).object->ramp();
        other = model_->actor(ends.last).object->ramp();
        light = palette_->step(frame_[first]) << 8;
        lighter = ((palette_->step(frame_[last]) << 8) - light) / count;
    }
    for (int i = 1; i < count; ++i) {
        const int at = first + i * step;
        if (frame_[at] != 0)
            continue;
        view_.copyPixel(at, 2 * i <= count ? first : last);
        if (!named)
            continue;
        const uint8_t* const ramp = at < second ? one : other;
        const int brightness = (light + i * lighter + 128) >> 8;
        view_.setPixel(at, zbuffer_[at], ramp[brightness]);
    }
}

// From column x in steps until `end`: closes a slit column by column, with what lies below in it.
void Gaps::closeSlit(int y, int x, int end, int step)
{
    for (; x != end && inSlit(frame_ + y * WIDTH + x); x += step) {
        const int at = y * WIDTH + x;
        int height = 1;
        while (frame_[at + height * WIDTH] == 0)
            ++height;
        const int above = at - WIDTH, below = at + height * WIDTH;
        if (isOpen(above, below, WIDTH))
            continue;
        fill(height > GAP_THIN ? endsOf(above, below) : NO_ENDS, above, below, WIDTH);
        view_.overlay(x, y, 1, height);
    }
    missed_.note(x, y);
}
