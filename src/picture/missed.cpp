// Drawing parts of the surface that were missed: one ray for each pixel, searched from the depth of a drawn pixel beside it.
#include "missed.h"

#include "math/normal.h"
#include "math/whole.h"
#include "surface/voxel.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// No pixel is begun after this many evaluations of the field in a frame.
constexpr int LOOKS_MOST = 3500;
// Depths, 1/128 unit: the first step along the ray; and the difference of two drawn pixels from which on both depths are tried.
constexpr int STEP = 128, APART = 128;
// Upper bounds: of the steps along the ray towards a stronger field; of the ratio of each step to the one before; and of the
// steps back through the object towards the eye.
constexpr int STEPS = 3, FARTHEST = 4, THICKEST = 12;
// No surface is near a point where the field is this much below the isovalue.
constexpr Real NEAR(0.2);
// A ray grazes the surface where the field, times the size of its object, exceeds the isovalue by less than this.
constexpr Real RIM(0.25);

}  // namespace

void Missed::draw()
{
    const int corners = count_;
    for (int i = 0; i < corners; ++i) {
        const Place& at = noted_[i];
        if (!takeCorner(at.column, at.row) || model_ == nullptr || looks_ >= LOOKS_MOST)
            continue;
        drawPixel(at.column, at.row);
        while (count_ > corners && looks_ < LOOKS_MOST) {
            const Place next = noted_[--count_];
            drawPixel(next.column, next.row);
        }
    }
}

// Returns how many pixels from `at` on, in steps of `step`, are drawn with an empty pixel beside them (`at + aside`); LONG at most.
int Missed::sideFrom(int at, int step, int aside) const
{
    const auto onScreen = [](int pixel) { return pixel >= 0 && pixel < WIDTH * HEIGHT; };
    int count = 0;
    while (count < LONG && onScreen(at) && onScreen(at + aside) && frame_[at] != 0 && frame_[at + aside] == 0) {
        ++count;
        at += step;
    }
    return count;
}

// Looks at a noted pixel. In a short corner it gets the colour and the depth of the pixel beside it. Returns true when the corner
// is so long that the surface has to be searched for.
bool Missed::takeCorner(int column, int row)
{
    const int at = row * WIDTH + column;
    if (column < 1 || column >= WIDTH - 1 || row < 1 || row >= HEIGHT - 1 || frame_[at] != 0)
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

// Returns by how much the field exceeds the isovalue at the point that a pixel shows at this depth.
Real Missed::excess(int at, int depth)
{
    ++looks_;
    return model_->implicitAt(view_.pointAt(at, depth), &strongest_) - ISOVALUE;
}

// Finds where the ray through a pixel enters the surface. *depth is a first guess and becomes the result. Returns false when the
// ray misses the surface.
bool Missed::findDepth(int at, int* depth)
{
    int inside = *depth;
    Real here = excess(at, inside);
    onEdge_ = here < Real(0);
    // Looks for a point inside, in the direction in which the field rises, with steps of the secant method.
    for (int i = 0, step = STEP; here <= Real(0); ++i) {
        if (i == STEPS || here < -NEAR || inside + step <= 0 || inside + step >= Z_EMPTY)
            return false;
        const Real there = excess(at, inside + step), rise = there - here;
        const bool rises = rise > Real(0);
        const Real left = rises ? -there : -here, slope = absolute(rise);
        if (left > slope * Real(FARTHEST))
            return false;
        const int on = left > Real(0) ? floorToInt(quotient(left, slope) * Real(magnitude(step))) + STEP / 4 : 0;
        inside += rises ? step : 0;
        here = rises ? there : here;
        step = (step > 0) == rises ? on : -on;
    }
    // From there looks for a point outside, towards the eye, and interpolates between the last two points.
    int outside = inside;
    Real within = here;
    for (int i = 0; here > Real(0); ++i) {
        if (i == THICKEST || outside <= STEP)
            return false;
        within = here;
        outside -= STEP;
        here = excess(at, outside);
    }
    onEdge_ = onEdge_ && strongest_ >= 0 && within * model_->actor(strongest_).object->size() < RIM;
    *depth = outside + floorToInt(quotient(-here, within - here) * Real(STEP));
    return true;
}

// Finds the depth of the surface at a pixel, with the depth of a drawn pixel beside it, in its row or its column, as a first
// guess. *beside becomes the number of that pixel. Returns false when there is no surface.
bool Missed::findSurface(int at, int* depth, int* beside)
{
    const int inRow = frame_[at - 1] != 0 ? at - 1 : at + 1, inColumn = frame_[at - WIDTH] != 0 ? at - WIDTH : at + WIDTH;
    const int first = frame_[inRow] != 0 ? inRow : inColumn, second = frame_[inColumn] != 0 ? inColumn : first;
    *depth = zbuffer_[*beside = first];
    if (findDepth(at, depth))
        return true;
    if (magnitude(zbuffer_[second] - zbuffer_[first]) < APART)
        return false;
    *depth = zbuffer_[*beside = second];
    return findDepth(at, depth);
}

// Draws an empty pixel beside a drawn one if there is surface, and notes the empty pixels beside it.
void Missed::drawPixel(int column, int row)
{
    const int at = row * WIDTH + column;
    if (column < 1 || column >= WIDTH - 1 || row < 1 || row >= HEIGHT - 1 || frame_[at] != 0)
        return;
    int depth, beside;
    if (!findSurface(at, &depth, &beside))
        return;
    setColour(at, depth, beside);
    // Where the ray only grazes the surface this is its outline: there is nothing beyond.
    for (int away = -1; away <= 1 && !onEdge_; away += 2) {
        if (frame_[at + away] == 0)
            note(column + away, row);
        if (frame_[at + away * WIDTH] == 0)
            note(column, row + away);
    }
}

// Gives a pixel the ramp of its object, with the brightness from the surface normal there. If the object is painted, the pixel
// gets the colour of the pixel `beside` instead.
void Missed::setColour(int at, int depth, int beside)
{
    const Point p = view_.pointAt(at, depth);
    const auto fieldAt = [&](const Vector& away) {
        ++looks_;
        return model_->implicitAt(p + away, &strongest_);
    };
    const Real half(0.5), none(0);
    const Vector there{fieldAt({half, none, none}), fieldAt({none, half, none}), fieldAt({none, none, half})};
    const Real here = fieldAt({none, none, none});
    const SoftObject* const own = strongest_ < 0 ? nullptr : model_->actor(strongest_).object;
    uint8_t colour = frame_[beside];
    if (own != nullptr && own->ramp() != nullptr && own->paint() == nullptr) {
        const Normal out = normalise({here - there.x, here - there.y, here - there.z}), light = normalise(model_->light);
        const int32_t cosine = (out.x * light.x + out.y * light.y + out.z * light.z) >> 14;
        colour = own->ramp()[max32(lambert(cosine), 0)];
    }
    view_.setPixel(at, depth, colour);
}
