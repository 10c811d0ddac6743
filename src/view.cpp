// Perspective, and the way from voxels to pixels.
#include "view.h"

#include "alloc.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// Marked places in a frame (more are left alone), and how far away the sides of a gap may be, pixels.
constexpr int GAPS_MOST = 1024;
constexpr int GAP_WIDEST = 8;
// A mark closer than GAP_STEP pixels to one of the last GAPS_ALIKE is left out.
constexpr int GAPS_ALIKE = 16;
constexpr int GAP_STEP = 4;
constexpr int FRACTION = 12;
constexpr int32_t HALF = 1 << (FRACTION - 1);
constexpr int32_t NEAREST = 1 << 8;            // 1 unit
constexpr int32_t FARTHEST = 511 << 8;         // z in 1/128 unit ends at 512

// A sloped scale of the loop stays within 16 bits: its corners lie less than SLOPED_MOST steps from its middle.
static_assert(LENS_NEAR * 128 >= SLOPED_MOST * STEEPEST && LENS_FAR * 128 + SLOPED_MOST * STEEPEST < Z_OPEN, "depths");

}  // namespace

View::~View()
{
    free(frame_);
    free(zbuffer_);
    free(factors_);
    free(gaps_);
}

bool View::open()
{
    frame_ = allocate<uint8_t>(WIDTH * HEIGHT);
    zbuffer_ = allocate<uint16_t>(WIDTH * HEIGHT);
    factors_ = allocate<Factors>(LENS_STEPS);
    gaps_ = allocate<Scale>(GAPS_MOST);
    if (frame_ == nullptr || zbuffer_ == nullptr || factors_ == nullptr || gaps_ == nullptr)
        return false;
    memset(frame_, 0, WIDTH * HEIGHT);
    memset(zbuffer_, 0xff, WIDTH * HEIGHT * sizeof *zbuffer_);
    for (int y = 0; y < HEIGHT; ++y) {
        touched_[y] = {0, 0};
        last_[y] = {0, WIDTH};  // the screen may hold anything before the first frame
    }
    setCamera(camera_);
    return true;
}

void View::setCamera(const Camera& camera)
{
    camera_ = camera;
    focalX_ = rawFromReal(camera.focalX) >> (16 - FRACTION);
    focalY_ = rawFromReal(camera.focalY) >> (16 - FRACTION);
    centreX_ = rawFromReal(camera.centreX) >> (16 - FRACTION);
    centreY_ = rawFromReal(camera.centreY) >> (16 - FRACTION);
    lens_.factors = factors_;
    lens_.frame = frame_;
    lens_.zbuffer = zbuffer_;
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
    for (int y = top; y < bottom; ++y) {
        if (touched_[y].from > left)
            touched_[y].from = static_cast<int16_t>(left);
        if (touched_[y].to < right)
            touched_[y].to = static_cast<int16_t>(right);
    }
}

// A voxel that drawScales() left: any size and place. False: not on the screen.
bool View::project(const Voxel& voxel, Scale* scale) const
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
    scale->colour = voxel.brightness < GAP ? lens_.ramp[voxel.brightness] : 0;

    // The plane of the surface: the depth changes by tilt (z / focal) from pixel to pixel.
    const int32_t depth = z >> 1;
    int32_t across = mulDiv(voxel.tiltX, z << 3, focalX_), down = -mulDiv(voxel.tiltY, z << 3, focalY_);
    across = across > STEEPEST ? STEEPEST : across < -STEEPEST ? -STEEPEST : across;
    down = down > STEEPEST ? STEEPEST : down < -STEEPEST ? -STEEPEST : down;
    // From the scale's centre to the centre of its first pixel.
    const int64_t slope = static_cast<int64_t>(across) * ((left << FRACTION) + HALF - column) +
                          static_cast<int64_t>(down) * ((top << FRACTION) + HALF - row);
    int32_t first = depth + static_cast<int32_t>(slope >> FRACTION);
    // Might it leave 16 bits at a corner? Then it faces the viewer.
    const int32_t swing = (across < 0 ? -across : across) * WIDTH + (down < 0 ? -down : down) * HEIGHT;
    if (depth - swing < 0 || depth + swing >= Z_EMPTY) {
        across = down = 0;
        first = depth;
    }
    scale->z = first;
    scale->zStep = across;
    scale->zRow = down - across * wide;
    return true;
}

int View::show(const VoxelList& list)
{
    lens_.x = list.x;
    lens_.y = list.y;
    lens_.z = list.z;
    lens_.ramp = list.ramp;
    lens_.left = WIDTH;
    lens_.top = HEIGHT;
    lens_.right = lens_.bottom = 0;
    lens_.empty = 0;
    int left = 0;  // voxels not drawn
    for (int i = 0; i < list.count; ++i) {
        if (!pixels_)
            i += drawScales(&lens_, list.voxels + i, list.count - i);
        if (i == list.count)
            break;
        const Voxel& voxel = *list.voxels[i];
        Scale scale;
        if (!project(voxel, &scale)) {
            ++left;
        } else if (voxel.brightness >= GAP) {
            ++left;
            addGap(scale);
        } else {
            blitScales(frame_, zbuffer_, &scale, 1);
            mark(scale.left, scale.top, scale.left + scale.wide, scale.top + scale.high);
        }
    }
    mark(lens_.left, lens_.top, lens_.right, lens_.bottom);
    return list.count - left - lens_.empty;
}

// Marks come in rows, many for one gap: one that lies nearly where a late one did is left out.
void View::addGap(const Scale& gap)
{
    for (int i = gapCount_ > GAPS_ALIKE ? gapCount_ - GAPS_ALIKE : 0; i < gapCount_; ++i) {
        const int x = gap.left - gaps_[i].left, y = gap.top - gaps_[i].top;
        if (x > -GAP_STEP && x < GAP_STEP && y > -GAP_STEP && y < GAP_STEP)
            return;
    }
    if (gapCount_ == GAPS_MOST)
        return;
    gaps_[gapCount_++] = gap;
    // What is found open there is noted in the Z-buffer, so it must be cleared with the rest.
    mark(gap.left, gap.top, gap.left + gap.wide, gap.top + gap.high);
}

void View::closeGaps()
{
    for (int i = 0; i < gapCount_; ++i) {
        const Scale& gap = gaps_[i];
        const uint16_t* row = zbuffer_ + gap.top * WIDTH + gap.left;
        for (int y = gap.high; y > 0; --y, row += WIDTH) {
            int x = findEmpty(row, gap.wide);
            while (x < gap.wide) {
                closeGap(static_cast<int>(row - zbuffer_) + x);
                ++x;
                x = x < gap.wide ? x + findEmpty(row + x, gap.wide - x) : x;
            }
        }
    }
    gapCount_ = 0;
}

void View::closeGap(int at)
{
    static const int SIDES[] = {-1, 1, -WIDTH, WIDTH};
    int nearest = GAP_WIDEST + 1, from = at, open = 0;
    // Not over the edge of the screen: up and down the buffer ends there, to the sides the next row begins.
    const int x = at % WIDTH;
    if (x < GAP_WIDEST || x >= WIDTH - GAP_WIDEST || at < GAP_WIDEST * WIDTH || at >= (HEIGHT - GAP_WIDEST) * WIDTH)
        return;
    for (const int side : SIDES) {
        int far = 1;
        while (far <= GAP_WIDEST && zbuffer_[at + far * side] >= Z_OPEN)
            ++far;
        if (far > GAP_WIDEST) {
            if (open++ > 0) {
                zbuffer_[at] = Z_OPEN;
                return;
            }
        } else if (far < nearest) {
            nearest = far;
            from = at + far * side;
        }
    }
    zbuffer_[at] = zbuffer_[from];
    frame_[at] = frame_[from];
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
