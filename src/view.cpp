// Perspective, and the way from voxels to pixels.
#include "view.h"

#include "alloc.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr int SCALES_AT_ONCE = 1024;
constexpr int FRACTION = 12;
constexpr int32_t HALF = 1 << (FRACTION - 1);
constexpr int32_t NEAREST = 1 << 16;           // 1 unit
constexpr int32_t FARTHEST = 511 << 16;        // z in 1/128 unit ends at 512

}  // namespace

View::~View()
{
    free(frame_);
    free(zbuffer_);
    free(factors_);
    free(scales_);
}

bool View::open()
{
    frame_ = allocate<uint8_t>(WIDTH * HEIGHT);
    zbuffer_ = allocate<uint16_t>(WIDTH * HEIGHT);
    factors_ = allocate<Factors>(FAR_STEPS - NEAR_STEPS);
    scales_ = allocate<Scale>(SCALES_AT_ONCE);
    if (frame_ == nullptr || zbuffer_ == nullptr || factors_ == nullptr || scales_ == nullptr)
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
    for (int i = NEAR_STEPS; i < FAR_STEPS; ++i) {
        // The middle of the step: z = (i + 1/2) / 8 units = (2i + 1) 2^12 in 16.16. focal 2^44 / z = focal12 2^32 / z
        // = focal12 2^20 / (2i + 1); 2^20 in two steps keeps 32 bits for focal lengths up to 500.
        Factors& f = factors_[i - NEAR_STEPS];
        f.x = mulDiv(focalX_, 1 << 18, 2 * i + 1) * 4;
        f.y = mulDiv(focalY_, 1 << 18, 2 * i + 1) * 4;
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

void View::touch(const Point& centre, Real reach)
{
    const Vector v = centre - camera_.eye;
    const Real nearest = v.z - reach;
    if (v.z + reach < Real(1))
        return;
    if (nearest < Real(4)) {
        mark(0, 0, WIDTH, HEIGHT);
        return;
    }
    // |x| / z grows towards the viewer: for the far side of a bound on the other side of the axis the nearest z is safe
    // too when the bound itself is on that side, else the farthest.
    const Real farthest = v.z + reach;
    const auto bound = [&](Real edge, bool upper) {
        return edge / ((edge > Real(0)) == upper ? nearest : farthest);
    };
    const Real limit(4);
    const auto column = [&](Real ratio) {
        return floorToInt(camera_.centreX + camera_.focalX * clamp(ratio, -limit, limit));
    };
    const auto row = [&](Real ratio) {
        return floorToInt(camera_.centreY - camera_.focalY * clamp(ratio, -limit, limit));
    };
    mark(column(bound(v.x - reach, false)) - 1, row(bound(v.y + reach, true)) - 1, column(bound(v.x + reach, true)) + 2,
         row(bound(v.y - reach, false)) + 2);
}

// False: not on the screen.
inline bool View::project(const Voxel& voxel, Scale* scale) const
{
    const int32_t x = rawFromReal(voxel.place.x), y = rawFromReal(voxel.place.y), z = rawFromReal(voxel.place.z);
    const int32_t wide = voxel.wide * 256, high = voxel.high * 256;
    int32_t column, row, halfWide, halfHigh;
    const uint32_t step = static_cast<uint32_t>(z >> 13) - NEAR_STEPS;
    if (step < static_cast<uint32_t>(FAR_STEPS - NEAR_STEPS)) {
        const Factors& f = factors_[step];
        column = mulHigh(x, f.x);
        row = mulHigh(y, f.y);
        halfWide = mulHigh(wide, f.x);
        halfHigh = mulHigh(high, f.y);
    } else {
        if (z < NEAREST || z > FARTHEST)
            return false;
        // Off the screen by far? Then the quotients below might not fit.
        const int32_t side = z >= (1 << 27) ? INT32_MAX : z * 16;
        if (x > side || x < -side || y > side || y < -side)
            return false;
        column = mulDiv(x, focalX_, z);
        row = mulDiv(y, focalY_, z);
        halfWide = mulDiv(wide, focalX_, z);
        halfHigh = mulDiv(high, focalY_, z);
    }
    if (pixels_)
        halfWide = halfHigh = HALF - 1;
    column += centreX_;
    row = centreY_ - row;
    // The pixels whose centres lie in the rectangle.
    int left = (column - halfWide + HALF) >> FRACTION;
    int right = (column + halfWide + HALF) >> FRACTION;
    int top = (row - halfHigh + HALF) >> FRACTION;
    int bottom = (row + halfHigh + HALF) >> FRACTION;
    if (left < 0)
        left = 0;
    if (right > WIDTH)
        right = WIDTH;
    if (top < 0)
        top = 0;
    if (bottom > HEIGHT)
        bottom = HEIGHT;
    if (left >= right || top >= bottom)
        return false;
    scale->left = static_cast<int16_t>(left);
    scale->top = static_cast<int16_t>(top);
    scale->wide = static_cast<int16_t>(right - left);
    scale->high = static_cast<int16_t>(bottom - top);
    scale->z = static_cast<uint16_t>(z >> 9);
    scale->colour = voxel.colour;
    return true;
}

int View::show(const Voxel* voxels, int count)
{
    int drawn = 0;
    while (count > 0) {
        const int some = count < SCALES_AT_ONCE ? count : SCALES_AT_ONCE;
        Scale* end = scales_;
        for (int i = 0; i < some; ++i)
            end += project(voxels[i], end);
        const int scales = static_cast<int>(end - scales_);
        blitScales(frame_, zbuffer_, scales_, scales);
        drawn += scales;
        voxels += some;
        count -= some;
    }
    return drawn;
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
