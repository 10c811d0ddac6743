// View: the perspective projection of voxels to scales, and the bookkeeping of which pixels a frame touches.
#include "picture/view.h"

#include "borders.h"
#include "creases.h"
#include "gaps.h"
#include "math/alloc.h"
#include "math/whole.h"
#include "outlines.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr int32_t FARTHEST = 511 << 8;  // 1/256 unit; 16-bit depths of 1/128 unit end at 512 units
// hides() looks at every third pixel of every third row: an object that shows only between them is narrower than a scale.
constexpr int HIDING_STEP = 3;
// Of views with a shorter focal length the model is not asked, pixels.
constexpr Real FOCAL_ASKED(3);

// Extends a span by the columns `from` to before `to`.
inline void extend(int from, int to, Span* span)
{
    if (span->from > from)
        span->from = static_cast<int16_t>(from);
    if (span->to < to)
        span->to = static_cast<int16_t>(to);
}

}  // namespace

View::~View()
{
    free(frame_);
    free(zbuffer_);
    free(factors_);
}

bool View::open(bool report98)
{
    report98_ = report98;
    frame_ = allocate<uint8_t>(WIDTH * (HEIGHT + ROWS_BELOW));
    zbuffer_ = allocate<uint16_t>(WIDTH * HEIGHT);
    factors_ = allocate<Factors>(LENS_STEPS);
    if (frame_ == nullptr || zbuffer_ == nullptr || factors_ == nullptr)
        return false;
    memset(frame_, 0, WIDTH * (HEIGHT + ROWS_BELOW));
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
        // The middle of the step of 1/16 unit or, for the report's method, of 1/8 unit.
        constexpr int HALVES = 2 * LENS_FINENESS;
        const int32_t z = HALVES * LENS_NEAR + (report98_ ? 2 * (i | 1) : 2 * i + 1);
        Factors& f = factors_[i];
        f.x = (focalX_ * HALVES + z / 2) / z;
        f.y = (focalY_ * HALVES + z / 2) / z;
        f.zx = mulDiv(z, (1 << 27) / HALVES, focalX_);
        f.zy = mulDiv(z, (1 << 27) / HALVES, focalY_);
    }
    const Real half(0.5);
    for (int column = 0; column < WIDTH; ++column)
        toRight_[column] = (Real(column) + half - camera.centreX) / camera.focalX;
    for (int row = 0; row < HEIGHT; ++row)
        toTop_[row] = (camera.centreY - Real(row) - half) / camera.focalY;
}

void View::begin()
{
    clearRows(frame_, zbuffer_, touched_, HEIGHT);
    crossingCount_ = 0;
    anyBordered_ = false;
    for (int y = 0; y < HEIGHT; ++y)
        touched_[y] = bordered_[y] = covered_[y] = {WIDTH, 0};
}

void View::mark(int left, int top, int right, int bottom)
{
    left = left < 0 ? 0 : left & ~3;
    right = right > WIDTH ? WIDTH : (right + 3) & ~3;
    top = top < 0 ? 0 : top;
    bottom = bottom > HEIGHT ? HEIGHT : bottom;
    if (left >= right)
        return;
    for (int y = top; y < bottom; ++y)
        extend(left, right, &touched_[y]);
}

// Notes where the outlines of earlier lists may lie before the list drawn last. Those of lists without borders are about right, and
// are not looked at.
void View::noteCovered(bool bordered)
{
    for (int y = lens_.top; y < lens_.bottom; ++y) {
        const int from = max32(lens_.left, bordered_[y].from), to = min32(lens_.right, bordered_[y].to);
        if (from < to)
            extend(from, to, &covered_[y]);
        if (bordered)
            extend(lens_.left, lens_.right, &bordered_[y]);
    }
}

void View::touchPixel(int pixel)
{
    const int row = pixel / WIDTH, column = pixel - row * WIDTH;
    if (column < touched_[row].from || column >= touched_[row].to)
        mark(column, row, column + 1, row + 1);
}

// A ball is hidden if all pixels tested in the square around its projection are nearer than its nearest point.
bool View::hides(const int32_t place[3], int32_t radius) const
{
    const int32_t z = place[2], nearest = (z - radius) >> 1;
    // The ball is too near for the table of factors, or far beside the view.
    if (nearest < LENS_NEAR * 128 || magnitude(place[0]) > 2 * z || magnitude(place[1]) > 2 * z)
        return false;
    const int32_t step = lensStep(z);
    if (step >= LENS_STEPS)
        return false;
    const Factors& f = factors_[step];
    const int32_t column = lens_.centreX + (place[0] * f.x >> 8), row = lens_.centreY - (place[1] * f.y >> 8);
    const int32_t halfWidth = radius * f.x >> 8, halfHeight = radius * f.y >> 8;
    int left = (column - halfWidth) >> FRACTION, right = (column + halfWidth) >> FRACTION;
    int top = (row - halfHeight) >> FRACTION, bottom = (row + halfHeight) >> FRACTION;
    if (right < 0 || left >= WIDTH || bottom < 0 || top >= HEIGHT)
        return true;
    left = max32(left, 0);
    right = min32(right, WIDTH - 1);
    top = max32(top, 0);
    bottom = min32(bottom, HEIGHT - 1);
    // The middle is tested first because most balls that are visible at all are visible there.
    const auto before = static_cast<uint16_t>(nearest);
    const auto seen = [&](int x, int y) { return zbuffer_[y * WIDTH + x] > before; };
    if (seen((left + right) >> 1, (top + bottom) >> 1))
        return false;
    for (int y = top; y <= bottom; y += HIDING_STEP)
        for (int x = left; x <= right; x += HIDING_STEP)
            if (seen(x, y))
                return false;
    return true;
}

// Projects the rectangle of a voxel. Returns false when it is too near, too far or far off the screen.
bool View::place(const Voxel& voxel, Placed* placed) const
{
    const int32_t x = wrappedSum(lens_.x, voxel.x), y = wrappedSum(lens_.y, voxel.y), z = wrappedSum(lens_.z, voxel.z);
    if (z < LENS_NEAREST * 256 || z > FARTHEST)
        return false;
    // The quotients of a voxel far off the screen might overflow below.
    const int32_t side = z * 16;
    if (x > side || x < -side || y > side || y < -side)
        return false;
    *placed = {z, mulDiv(x, focalX_, z) + centreX_, centreY_ - mulDiv(y, focalY_, z), HALF - 1, HALF - 1};
    if (!pixels_) {
        placed->halfWidth = mulDiv(voxel.halfWidth, focalX_, z);
        placed->halfHeight = mulDiv(voxel.halfHeight, focalY_, z);
    }
    return true;
}

// Sets the rectangle of the pixels on the screen whose centres lie in a projected scale. Returns false when there are none.
bool View::clip(const Placed& placed, Scale* scale)
{
    int left = (placed.column - placed.halfWidth + HALF) >> FRACTION;
    int right = (placed.column + placed.halfWidth + HALF) >> FRACTION;
    int top = (placed.row - placed.halfHeight + HALF) >> FRACTION;
    int bottom = (placed.row + placed.halfHeight + HALF) >> FRACTION;
    left = left < 0 ? 0 : left;
    right = right > WIDTH ? WIDTH : right;
    top = top < 0 ? 0 : top;
    bottom = bottom > HEIGHT ? HEIGHT : bottom;
    scale->left = static_cast<int16_t>(left);
    scale->top = static_cast<int16_t>(top);
    scale->width = static_cast<int16_t>(right - left);
    scale->height = static_cast<int16_t>(bottom - top);
    return left < right && top < bottom;
}

// Finds by how much the depth of the tangent plane changes from column to column and from row to row: tilt (z / focal).
void View::tilt(const Voxel& voxel, const Placed& placed, int32_t* across, int32_t* down) const
{
    const auto swing = [](int32_t step, int32_t half, int32_t screen) {
        return magnitude(step) * min32((half >> FRACTION) + 2, screen);
    };
    *across = limited(mulDiv(voxel.tiltX, placed.z << 3, focalX_), STEEPEST);
    *down = limited(-mulDiv(voxel.tiltY, placed.z << 3, focalY_), STEEPEST);
    // If the depth might overflow 16 bits at a corner, the scale faces the viewer instead.
    const int32_t depth = placed.z >> 1, most = swing(*across, placed.halfWidth, WIDTH) + swing(*down, placed.halfHeight, HEIGHT);
    if (depth - most < 0 || depth + most >= Z_EMPTY)
        *across = *down = 0;
}

// Makes a scale of a voxel that drawScales() has not drawn; the voxel may have any size and position. Returns false when it covers
// no pixel of the screen.
bool View::project(const Voxel& voxel, Scale* scale) const
{
    Placed placed;
    if (!place(voxel, &placed) || !clip(placed, scale))
        return false;
    // Extrapolates a quantity that changes evenly from the middle of the scale to the centre of the first pixel.
    const int64_t toColumn = (scale->left << FRACTION) + HALF - placed.column, toRow = (scale->top << FRACTION) + HALF - placed.row;
    const auto first = [&](int32_t centre, int32_t across, int32_t down) {
        return centre + static_cast<int32_t>((across * toColumn + down * toRow) >> FRACTION);
    };
    const int32_t depth = placed.z >> 1, width = scale->width;
    int32_t across, down;
    tilt(voxel, placed, &across, &down);
    scale->z = first(depth, across, down);
    scale->zStep = across;
    scale->zRow = down - across * width;
    setEnds(voxel, depth, scale);

    const int32_t pixelX = mulDiv(placed.z, 1 << 19, focalX_), pixelY = mulDiv(placed.z, 1 << 19, focalY_);
    const int32_t shadeAcross = shadeStep(voxel.slopeX, pixelX), shadeDown = -shadeStep(voxel.slopeY, pixelY);
    scale->ramp = lens_.ramp;
    scale->shade = first(voxel.brightness * 256 + 128, shadeAcross, shadeDown);
    scale->shadeStep = shadeAcross;
    scale->shadeRow = shadeDown - shadeAcross * width;
    setUncut(scale);
    if (isCut(voxel))
        setCut(voxel, pixelX, pixelY, [&](int32_t x, int32_t y) { return first(0, x, y); }, scale);
    return true;
}

// Whether a voxel is small, at a medium distance, and wholly on the screen. With the report's method only such voxels are projected
// with the loop's table.
bool View::ordinary(const Voxel& voxel) const
{
    constexpr int FAR = 256, WIDEST = 16, LARGEST_SUM = 24;
    const int32_t depth = wrappedSum(lens_.z, voxel.z);
    if (depth < LENS_NEAR * 256 || depth >= FAR * 256)
        return false;
    const Factors& f = factors_[lensStep(depth)];
    int32_t column, row;
    if (__builtin_mul_overflow(wrappedSum(lens_.x, voxel.x), f.x, &column) ||
        __builtin_mul_overflow(wrappedSum(lens_.y, voxel.y), f.y, &row))
        return false;
    column = lens_.centreX + (column >> 8);
    row = lens_.centreY - (row >> 8);
    const int32_t halfWidth = voxel.halfWidth * f.x >> 8, halfHeight = voxel.halfHeight * f.y >> 8;
    const int left = (column - halfWidth) >> FRACTION, right = (column + halfWidth) >> FRACTION;
    const int top = (row - halfHeight) >> FRACTION, bottom = (row + halfHeight) >> FRACTION;
    return right - left <= WIDEST && right - left + bottom - top <= LARGEST_SUM && left >= 0 && right <= WIDTH && top >= 0 &&
           bottom <= HEIGHT;
}

// Makes the tests that hold for a whole list, so that the loop of scales need not make them for each voxel. Returns false when the
// loop cannot draw the list because products of positions and factors might overflow 32 bits.
bool View::prepareLoop(const VoxelList& list)
{
    const int32_t nearest = wrappedSum(list.z, -list.extent), farthest = wrappedSum(list.z, list.extent);
    const int last = lensStep(farthest);
    const Factors& far = factors_[last < 0 ? 0 : last < LENS_STEPS ? last : LENS_STEPS - 1];
    limitTilts(&lens_, static_cast<uint32_t>(far.zx > far.zy ? far.zx : far.zy));
    const int32_t table = factors_[0].x > factors_[0].y ? factors_[0].x : factors_[0].y;
    const int32_t most = INT32_MAX / (nearest < LENS_NEAR * 256 ? FACTOR_MOST : table) - list.extent;
    return list.x < most && list.x > -most && list.y < most && list.y > -most;
}

int View::show(const VoxelList& list)
{
    if (list.count == 0)
        return 0;
    lens_.x = list.x;
    lens_.y = list.y;
    lens_.z = list.z;
    lens_.left = WIDTH;
    lens_.top = HEIGHT;
    lens_.right = lens_.bottom = 0;
    lens_.empty = 0;
    const bool loop = prepareLoop(list) && !pixels_;
    const Voxel* from = list.voxels;
    int undrawn = 0;
    if (list.runs == 0)
        undrawn = showRun(list.ramp, from, from + list.count, loop);
    for (const RampRun* run = list.run; run < list.run + list.runs; ++run) {
        const Voxel* const to = list.voxels + run->end;
        undrawn += showRun(run->ramp, from, to, loop);
        from = to;
    }
    mark(lens_.left, lens_.top, lens_.right, lens_.bottom);
    anyBordered_ |= list.bordered;
    if (anyBordered_)
        noteCovered(list.bordered);
    if (list.bordered && !pixels_)
        noteCrossings(list);
    return list.count - undrawn - lens_.empty;
}

// Draws voxels that have one ramp. `loop` says that the loop of scales may be used. Returns how many voxels project() has rejected.
int View::showRun(const uint8_t* ramp, const Voxel* from, const Voxel* to, bool loop)
{
    int undrawn = 0;
    lens_.ramp = ramp;
    for (const Voxel* at = from; at < to; ++at) {
        if (report98_) {
            if (loop && ordinary(*at) && drawScales(&lens_, at, at + 1) > at)
                continue;
        } else if (loop) {
            at = drawScales(&lens_, at, to);
        }
        if (at == to)
            break;
        const Voxel& voxel = *at;
        Scale scale;
        if (!project(voxel, &scale)) {
            ++undrawn;
        } else {
            blitScale(frame_, zbuffer_, scale);
            lens_.left = min32(lens_.left, scale.left);
            lens_.top = min32(lens_.top, scale.top);
            lens_.right = max32(lens_.right, scale.left + scale.width);
            lens_.bottom = max32(lens_.bottom, scale.top + scale.height);
        }
    }
    return undrawn;
}

void View::closeGaps(Real spacing, const Model* model, const Palette* palette)
{
    if (pixels_)
        return;
    // In so wide a view what a far pixel shows lies beyond the range of numbers.
    if (camera_.focalX < FOCAL_ASKED || camera_.focalY < FOCAL_ASKED)
        model = nullptr;
    FieldProbe probe(model);
    const Tint tint(probe, camera_.axes);
    Rays rays(*this, probe, tint, spacing);
    Missed missed(*this, rays);
    Gaps(*this, probe, palette, missed, spacing).close();
    if (model != nullptr && anyBordered_)
        Outlines(*this, rays, probe, missed).mend();
    if (model == nullptr || palette == nullptr)
        return;
    if (anyBordered_)
        Creases(*this, probe, tint, *palette, spacing, foundCreases_).mend();
    // Where colours mix there are no borders between them.
    if (!palette->isGrey() && !model->mixed)
        Borders(*this, probe, *palette, rays).mend();
}

Point View::pointAt(int pixel, int depth) const
{
    const int row = pixel / WIDTH, column = pixel - row * WIDTH;
    const Real z = realFromRaw(static_cast<int32_t>(depth) << 9);
    return camera_.eye + camera_.axes.toWorld({toRight_[column] * z, toTop_[row] * z, z});
}

Vector View::rayAt(int pixel) const
{
    const int row = pixel / WIDTH, column = pixel - row * WIDTH;
    return camera_.axes.toWorld({toRight_[column], toTop_[row], Real(1)});
}

uint8_t* View::overlay(int left, int top, int width, int height)
{
    mark(left, top, left + width, top + height);
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
