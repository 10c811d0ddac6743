// Perspective, and the way from voxels to pixels.
#include "picture/view.h"

#include "math/alloc.h"

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
constexpr Real OUTSIDE(0.42);  // of the field: with less half way across, what is open stays so
constexpr int GAP_MOST = 32;  // however near the viewer
constexpr int DIVIDED = 2;    // as near as this its ends stand when the place is found where a gap changes its colour
constexpr int FRACTION = 12;
constexpr int32_t HALF = 1 << (FRACTION - 1);
constexpr int32_t NEAREST = 1 << 8;            // 1 unit
constexpr int32_t FARTHEST = 511 << 8;         // z in 1/128 unit ends at 512

}  // namespace

View::~View()
{
    free(frame_);
    free(zbuffer_);
    free(factors_);
}

bool View::open()
{
    frame_ = allocate<uint8_t>(WIDTH * HEIGHT);
    zbuffer_ = allocate<uint16_t>(WIDTH * HEIGHT);
    factors_ = allocate<Factors>(LENS_STEPS);
    if (frame_ == nullptr || zbuffer_ == nullptr || factors_ == nullptr)
        return false;
    memset(frame_, 0, WIDTH * HEIGHT);
    memset(zbuffer_, 0xff, WIDTH * HEIGHT * sizeof *zbuffer_);
    for (int y = 0; y < HEIGHT; ++y) {
        touched_[y] = {0, 0};
        last_[y] = {0, WIDTH};  // the screen may hold anything before the first frame
    }
    makeLens();
    return true;
}

void View::setCamera(const Camera& camera)
{
    const bool same = camera.focalX == camera_.focalX && camera.focalY == camera_.focalY &&
                      camera.centreX == camera_.centreX && camera.centreY == camera_.centreY;
    camera_ = camera;
    if (!same)
        makeLens();
}

void View::makeLens()
{
    const Camera& camera = camera_;
    focalX_ = rawFromReal(camera.focalX) >> (16 - FRACTION);
    focalY_ = rawFromReal(camera.focalY) >> (16 - FRACTION);
    centreX_ = rawFromReal(camera.centreX) >> (16 - FRACTION);
    centreY_ = rawFromReal(camera.centreY) >> (16 - FRACTION);
    lens_.factors = factors_;
    lens_.frame = frame_;
    lens_.zbuffer = zbuffer_;
    lens_.focalX = focalX_;
    lens_.focalY = focalY_;
    lens_.centreX = centreX_ + HALF;
    lens_.centreY = centreY_ + HALF;
    for (int i = 0; i < LENS_STEPS; ++i) {
        // The middle of the step: (2i + 1) / 16 units beyond the nearest.
        const int32_t z16 = 16 * 8 * LENS_NEAR / 8 + 2 * i + 1;
        Factors& f = factors_[i];
        f.x = (focalX_ * 16 + z16 / 2) / z16;
        f.y = (focalY_ * 16 + z16 / 2) / z16;
        f.zx = mulDiv(z16, 1 << 23, focalX_);
        f.zy = mulDiv(z16, 1 << 23, focalY_);
    }
}

void View::begin()
{
    clearRows(frame_, zbuffer_, touched_, HEIGHT);
    shown_ = {WIDTH, HEIGHT, 0, 0};
    for (int y = 0; y < HEIGHT; ++y)
        touched_[y] = {WIDTH, 0};
}

void View::mark(int left, int top, int right, int bottom)
{
    left = left < 0 ? 0 : left & ~3;
    right = right > WIDTH ? WIDTH : (right + 3) & ~3;
    top = top < 0 ? 0 : top;
    bottom = bottom > HEIGHT ? HEIGHT : bottom;
    if (left >= right)
        return;
    shown_.left = left < shown_.left ? left : shown_.left;
    shown_.right = right > shown_.right ? right : shown_.right;
    shown_.top = top < shown_.top ? top : shown_.top;
    shown_.bottom = bottom > shown_.bottom ? bottom : shown_.bottom;
    for (int y = top; y < bottom; ++y) {
        if (touched_[y].from > left)
            touched_[y].from = static_cast<int16_t>(left);
        if (touched_[y].to < right)
            touched_[y].to = static_cast<int16_t>(right);
    }
}

void View::touchPixel(int at)
{
    const int row = at / WIDTH, column = at - row * WIDTH;
    if (column < touched_[row].from || column >= touched_[row].to)
        mark(column, row, column + 1, row + 1);
}

Rectangle View::takeShown()
{
    const Rectangle box = shown_;
    shown_ = {WIDTH, HEIGHT, 0, 0};
    return box;
}

// A voxel that drawScales() left: any size and place. False: not on the screen.
bool View::project(const Voxel& voxel, FineScale* scale) const
{
    const int32_t x = wrappedSum(lens_.x, voxel.x), y = wrappedSum(lens_.y, voxel.y), z = wrappedSum(lens_.z, voxel.z);
    if (z < NEAREST || z > FARTHEST)
        return false;
    // Off the screen by far? Then the quotients below might not fit.
    const int32_t side = z * 16;
    if (x > side || x < -side || y > side || y < -side)
        return false;
    int32_t halfWide = HALF - 1, halfHigh = HALF - 1;
    if (!pixels_) {
        halfWide = mulDiv(voxel.wide, focalX_, z);
        halfHigh = mulDiv(voxel.high, focalY_, z);
    }
    const int32_t column = mulDiv(x, focalX_, z) + centreX_;
    const int32_t row = centreY_ - mulDiv(y, focalY_, z);
    // The pixels whose centres lie in the rectangle.
    int left = (column - halfWide + HALF) >> FRACTION;
    int right = (column + halfWide + HALF) >> FRACTION;
    int top = (row - halfHigh + HALF) >> FRACTION;
    int bottom = (row + halfHigh + HALF) >> FRACTION;
    left = left < 0 ? 0 : left;
    right = right > WIDTH ? WIDTH : right;
    top = top < 0 ? 0 : top;
    bottom = bottom > HEIGHT ? HEIGHT : bottom;
    if (left >= right || top >= bottom)
        return false;
    const int wide = right - left;
    scale->left = static_cast<int16_t>(left);
    scale->top = static_cast<int16_t>(top);
    scale->wide = static_cast<int16_t>(wide);
    scale->high = static_cast<int16_t>(bottom - top);
    scale->colour = lens_.ramp[voxel.brightness];

    // The plane of the surface: the depth changes by tilt (z / focal) from pixel to pixel.
    const int32_t depth = z >> 1;
    int32_t across = mulDiv(voxel.tiltX, z << 3, focalX_), down = -mulDiv(voxel.tiltY, z << 3, focalY_);
    across = across > STEEPEST ? STEEPEST : across < -STEEPEST ? -STEEPEST : across;
    down = down > STEEPEST ? STEEPEST : down < -STEEPEST ? -STEEPEST : down;
    // From the scale's centre to the centre of its first pixel.
    const int64_t toColumn = (left << FRACTION) + HALF - column, toRow = (top << FRACTION) + HALF - row;
    int32_t first = depth + static_cast<int32_t>((across * toColumn + down * toRow) >> FRACTION);
    // Might it leave 16 bits at a corner? Then it faces the viewer.
    const int32_t columns = (halfWide >> FRACTION) + 2, rows = (halfHigh >> FRACTION) + 2;
    const int32_t swing = (across < 0 ? -across : across) * (columns < WIDTH ? columns : WIDTH) +
                          (down < 0 ? -down : down) * (rows < HEIGHT ? rows : HEIGHT);
    if (depth - swing < 0 || depth + swing >= Z_EMPTY) {
        across = down = 0;
        first = depth;
    }
    scale->z = first;
    scale->zStep = across;
    scale->zRow = down - across * wide;

    scale->zMost = endOf(voxel, depth);
    const int32_t pixelX = mulDiv(z, 1 << 19, focalX_), pixelY = mulDiv(z, 1 << 19, focalY_);
    const int32_t shadeAcross = shadeStep(voxel.slopeX, pixelX), shadeDown = -shadeStep(voxel.slopeY, pixelY);
    scale->ramp = lens_.ramp;
    scale->shade = voxel.brightness * 256 + 128 + static_cast<int32_t>((shadeAcross * toColumn + shadeDown * toRow) >> FRACTION);
    scale->shadeStep = shadeAcross;
    scale->shadeRow = shadeDown - shadeAcross * wide;
    const int32_t cutAcross = shadeStep(voxel.cutX, pixelX), cutDown = -shadeStep(voxel.cutY, pixelY);
    scale->cut = isCut(voxel) ? voxel.cutAt * 32 + static_cast<int32_t>((cutAcross * toColumn + cutDown * toRow) >> FRACTION) : 0;
    scale->cutStep = cutAcross;
    scale->cutRow = cutDown - cutAcross * wide;
    return true;
}

// Whether a voxel is small, neither near nor far, and wholly on the screen: for these alone an exact view leaves the depth to the
// loop's table.
bool View::ordinary(const Voxel& voxel) const
{
    constexpr int FAR = 256, WIDEST = 16, LARGEST_SUM = 24;
    const int32_t depth = wrappedSum(lens_.z, voxel.z);
    if (depth < LENS_NEAR * 256 || depth >= FAR * 256)
        return false;
    const Factors& f = factors_[(depth >> 5) - LENS_NEAR * 8];
    int32_t column, row;
    if (__builtin_mul_overflow(wrappedSum(lens_.x, voxel.x), f.x, &column) ||
        __builtin_mul_overflow(wrappedSum(lens_.y, voxel.y), f.y, &row))
        return false;
    column = lens_.centreX + (column >> 8);
    row = lens_.centreY - (row >> 8);
    const int32_t halfWide = voxel.wide * f.x >> 8, halfHigh = voxel.high * f.y >> 8;
    const int left = (column - halfWide) >> FRACTION, right = (column + halfWide) >> FRACTION;
    const int top = (row - halfHigh) >> FRACTION, bottom = (row + halfHigh) >> FRACTION;
    return right - left <= WIDEST && right - left + bottom - top <= LARGEST_SUM && left >= 0 && right <= WIDTH && top >= 0 &&
           bottom <= HEIGHT;
}

// Finds out what the loop of scales need not ask for each voxel of a list. False: the list is not for it, because products of
// places and factors might leave 32 bits.
bool View::prepareLoop(const VoxelList& list)
{
    const int32_t nearest = wrappedSum(list.z, -list.reach), farthest = wrappedSum(list.z, list.reach);
    const int last = (farthest >> 5) - LENS_NEAR * 8;
    const Factors& far = factors_[last < 0 ? 0 : last < LENS_STEPS ? last : LENS_STEPS - 1];
    limitTilts(&lens_, static_cast<uint32_t>(far.zx > far.zy ? far.zx : far.zy));
    const int32_t table = factors_[0].x > factors_[0].y ? factors_[0].x : factors_[0].y;
    const int32_t most = INT32_MAX / (nearest < LENS_NEAR * 256 ? FACTOR_MOST : table) - list.reach;
    return list.x < most && list.x > -most && list.y < most && list.y > -most;
}

int View::show(const VoxelList& list)
{
    lens_.x = list.x;
    lens_.y = list.y;
    lens_.z = list.z;
    lens_.left = WIDTH;
    lens_.top = HEIGHT;
    lens_.right = lens_.bottom = 0;
    lens_.empty = 0;
    const bool loop = prepareLoop(list) && !pixels_;
    const Voxel* from = list.voxels;
    int left = 0;
    if (list.runs == 0)
        left = showRun(list.ramp, from, from + list.count, loop);
    for (const RampRun* run = list.run; run < list.run + list.runs; ++run) {
        const Voxel* const to = list.voxels + run->end;
        left += showRun(run->ramp, from, to, loop);
        from = to;
    }
    mark(lens_.left, lens_.top, lens_.right, lens_.bottom);
    return list.count - left - lens_.empty;
}

// Draws voxels of one ramp; `loop`: the loop of scales may be used. Returns how many lie off the screen.
int View::showRun(const uint8_t* ramp, const Voxel* from, const Voxel* to, bool loop)
{
    int left = 0;
    lens_.ramp = ramp;
    for (const Voxel* at = from; at < to; ++at) {
        if (exact_) {
            if (loop && ordinary(*at) && drawScales(&lens_, at, at + 1) > at)
                continue;
        } else if (loop) {
            at = drawScales(&lens_, at, to);
        }
        if (at == to)
            break;
        const Voxel& voxel = *at;
        FineScale scale;
        if (!project(voxel, &scale)) {
            ++left;
        } else {
            if (isFine(voxel))
                blitFine(frame_, zbuffer_, scale);
            else
                blitScales(frame_, zbuffer_, &scale, 1);
            mark(scale.left, scale.top, scale.left + scale.wide, scale.top + scale.high);
        }
    }
    return left;
}

// Whether a pixel is empty and lies right below a drawn one and a little way above another.
static inline bool inSlit(const uint8_t* pixel)
{
    static_assert(GAP_LOW == 6, "as many rows are looked at");
    return pixel[-WIDTH] != 0 && pixel[0] == 0 &&
           (pixel[WIDTH] | pixel[2 * WIDTH] | pixel[3 * WIDTH] | pixel[4 * WIDTH] | pixel[5 * WIDTH] | pixel[6 * WIDTH]) != 0;
}

// Looks at each row once, and at more only where a run of empty pixels between drawn ones is short.
int View::closeGaps(Real spacing, const Model* model, const Palette* palette)
{
    model_ = model;
    palette_ = palette;
    if (pixels_)
        return 0;
    int drawn = 0;
    // A spacing in pixels is this over a depth of the Z-buffer.
    const int32_t near = mulShift16(focalX_, rawFromReal(spacing)) >> (FRACTION - 7);
    Span runs[WIDTH / 2];
    const uint8_t* row = frame_ + WIDTH;
    for (int y = 1; y < HEIGHT - GAP_LOW; ++y, row += WIDTH) {
        const Span& touched = touched_[y];
        if (touched.from >= touched.to)
            continue;
        const Span* const end = runs + drawnRuns(row, zbuffer_ + y * WIDTH, &touched, runs);
        int last = 0;  // behind the run before
        for (const Span* run = runs; run < end; ++run) {
            const int from = run->from;
            drawn += run->to - from;
            if (last > 0 && from - last <= GAP_MOST) {
                const int before = zbuffer_[y * WIDTH + last - 1], behind = zbuffer_[y * WIDTH + from];
                closeRun(y, last, from, near / ((before > behind ? before : behind) | 1));
            }
            if (last > 0 && inSlit(row + last))
                closeSlit(y, last, from, 1);
            if (from > 0 && inSlit(row + from - 1))
                closeSlit(y, from - 1, last - 1, -1);
            last = run->to;
        }
        if (last > 0 && last < WIDTH && inSlit(row + last))
            closeSlit(y, last, WIDTH, 1);
    }
    return drawn;
}

// Pixels from column `from` to before `to` are empty, those on both sides are not; seeds lie `spacing` pixels apart there.
void View::closeRun(int y, int from, int to, int spacing)
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
        int x = from;
        while (x < to && row[x - step * WIDTH] != 0)
            ++x;
        if (x == to)
            closeFrom(y, from, to, step, widest, GAP_NARROW + spacing);
    }
}

// What is empty above a pixel that has just been filled is followed up, if that has closed it below.
void View::closeAbove(int y, int x, int widest, int narrowest)
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

// Follows the opening down from a row (or up: `step`) before which it is closed.
void View::closeFrom(int y, int from, int to, int step, int widest, int narrowest)
{
    Span rows[GAP_MOST];
    int high = 0, narrow = 0;
    bool closed = false;
    for (;;) {
        // All below a neck goes with it.
        if (to - from <= narrowest)
            narrow = high + 1;
        rows[high++] = {static_cast<int16_t>(from), static_cast<int16_t>(to)};
        const int next = y + high * step;
        if (next <= 0 || next >= HEIGHT - 1)
            break;
        const uint8_t* row = frame_ + next * WIDTH;
        // What is empty beside it in the next row, all that lies between taken for empty.
        const int left = from, right = to;
        while (from < right && row[from] != 0)
            ++from;
        if (from == right) {
            narrow = high;
            closed = true;
            break;
        }
        while (row[to - 1] != 0)
            --to;
        while (from <= left && from > 0 && to - from <= widest && row[from - 1] == 0)
            --from;
        while (to >= right && to < WIDTH && to - from <= widest && row[to] == 0)
            ++to;
        if (to - from > widest || from == 0 || to == WIDTH || high == widest)
            break;
    }
    if (narrow > 0) {
        const int middle = narrow / 2, row = (y + middle * step) * WIDTH;
        if (!closed && isOpen(row + rows[middle].from - 1, row + rows[middle].to))
            return;
        const Ends ends = endsOf(row + rows[middle].from - 1, row + rows[middle].to);
        for (int i = 0; i < narrow; ++i)
            fill(ends, (y + i * step) * WIDTH + rows[i].from - 1, (y + i * step) * WIDTH + rows[i].to, 1);
    }
    if (narrow < high) {
        closeCorner(y + narrow * step, rows[narrow].from, 1);
        closeCorner(y + narrow * step, rows[narrow].to - 1, -1);
    }
}

// An empty pixel beside which, against `step`, a drawn one lies: in a corner with two pixels or more on each side, which is
// none of a round outline, it is closed.
void View::closeCorner(int y, int x, int step)
{
    const uint8_t* pixel = frame_ + y * WIDTH + x;
    const int along = pixel[-WIDTH] != 0 ? -WIDTH : WIDTH;
    if (pixel[0] == 0 && pixel[-step] != 0 && pixel[along] != 0 && pixel[along + step] != 0 && pixel[-step - along] != 0)
        takeOver(y * WIDTH + x, y * WIDTH + x - step);
}

Point View::pointAt(int at) const
{
    const int row = at / WIDTH, column = at - row * WIDTH;
    const Real half(0.5), z = realFromRaw(static_cast<int32_t>(zbuffer_[at]) << 9);
    return camera_.eye + camera_.axes.toWorld({(Real(column) + half - camera_.centreX) / camera_.focalX * z,
                                               (camera_.centreY - Real(row) - half) / camera_.focalY * z, z});
}

// Whether between two drawn pixels there is none of the surface: the way from one to the other leads well outside.
bool View::isOpen(int first, int last) const
{
    if (model_ == nullptr || last - first <= GAP_THIN + 1)
        return false;
    const Point here = pointAt(first);
    const Vector way = pointAt(last) - here;
    return model_->implicitAt(here + Vector{shiftDown(way.x, 1), shiftDown(way.y, 1), shiftDown(way.z, 1)}) < OUTSIDE;
}

// Whose the drawn pixels on both sides of a gap are. None are named where their colour is the same, where their fields do not
// meet, or without a model.
View::Ends View::endsOf(int first, int last) const
{
    if (model_ == nullptr || palette_ == nullptr || frame_[first] == frame_[last])
        return NO_ENDS;
    const Ends ends{model_->strongestAt(pointAt(first)), model_->strongestAt(pointAt(last))};
    if (ends.first < 0 || ends.last < 0 || !model_->actor(ends.first).object->inRange(*model_->actor(ends.last).object))
        return NO_ENDS;
    return ends;
}

// Between two drawn pixels, `step` the way from each to the next: the first that is the last one's.
int View::divide(const Ends& ends, int first, int last, int step) const
{
    const SoftObject &one = *model_->actor(ends.first).object, &other = *model_->actor(ends.last).object;
    Point here = pointAt(first), there = pointAt(last);
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
void View::fill(const Ends& ends, int first, int last, int step)
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
        takeOver(at, 2 * i <= count ? first : last);
        if (!named)
            continue;
        const uint8_t* const ramp = at < second ? one : other;
        const int brightness = (light + i * lighter + 128) >> 8;
        frame_[at] = ramp[brightness];
    }
}

// From column x in steps until `end`: closes a slit column by column, with what lies below in it.
void View::closeSlit(int y, int x, int end, int step)
{
    for (; x != end && inSlit(frame_ + y * WIDTH + x); x += step) {
        const int at = y * WIDTH + x;
        int high = 1;
        while (frame_[at + high * WIDTH] == 0)
            ++high;
        const int above = at - WIDTH, below = at + high * WIDTH;
        fill(high > GAP_THIN ? endsOf(above, below) : NO_ENDS, above, below, WIDTH);
        mark(x, y, x + 1, y + high);
    }
}

uint8_t* View::overlay(int left, int top, int wide, int high)
{
    mark(left, top, left + wide, top + high);
    return frame_;
}

void View::end()
{
    for (int y = 0; y < HEIGHT; ++y) {
        const Span& now = touched_[y];
        Span& before = last_[y];
        present_[y].from = before.from < now.from ? before.from : now.from;
        present_[y].to = before.to > now.to ? before.to : now.to;
        before = now;
    }
}
