// Drawing what was missed: one ray for each pixel, from where the surface beside it is.
#include "missed.h"

#include "math/normal.h"
#include "math/whole.h"
#include "surface/voxel.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// Looks at fields in a frame, at most.
constexpr int LOOKS_MOST = 3500;
// Depths, 1/128 unit: the first step along the ray; where two drawn pixels are farther apart, both are tried.
constexpr int STEP = 128, APART = 128;
// How often the ray is followed to where the field rises, each time no more than FARTHEST times as far; and how far it may lead
// through what is there, steps.
constexpr int STEPS = 3, FARTHEST = 4, THICKEST = 12;
// Of the field: where it is so far below the isovalue there is no surface near.
constexpr Real NEAR(0.2);
// Of the field, times the size of the object: by how much it exceeds the isovalue at the edge of what is seen.
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

// How many pixels from one on are drawn, `step` the way from each to the next, and those empty that lie `aside` of them.
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

// Takes up a pixel that has been noted: in a short corner of drawn ones it takes over what lies beside it. True: the corner is so
// long that the model is to be asked.
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

// By how much the field at a pixel exceeds the isovalue, were the surface so far away.
Real Missed::excess(int at, int depth)
{
    ++looks_;
    return model_->implicitAt(view_.pointAt(at, depth), &strongest_) - ISOVALUE;
}

// From a depth near which the surface may be: becomes where the ray meets it. False: it does not.
bool Missed::findDepth(int at, int* depth)
{
    int inside = *depth;
    Real here = excess(at, inside);
    onEdge_ = here < Real(0);
    // Along the ray to where the field rises, as far as it takes if it goes on rising as it does.
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
    // And from there to the side where the eye is.
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

// From the depths of the drawn pixels beside one, in its row and in its column: how far away the surface is, and from which of
// these it was found. False: there is none.
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

// A pixel beside a drawn one: it is drawn if there is surface, and those beside it are noted.
void Missed::drawPixel(int column, int row)
{
    const int at = row * WIDTH + column;
    if (column < 1 || column >= WIDTH - 1 || row < 1 || row >= HEIGHT - 1 || frame_[at] != 0)
        return;
    int depth, beside;
    if (!findSurface(at, &depth, &beside))
        return;
    setColour(at, depth, beside);
    // At the edge of what there is no more is looked for.
    for (int away = -1; away <= 1 && !onEdge_; away += 2) {
        if (frame_[at + away] == 0)
            note(column + away, row);
        if (frame_[at + away * WIDTH] == 0)
            note(column, row + away);
    }
}

// A pixel gets the colour of its own object and the brightness that the surface has there; the colour of one beside it where there
// is more to it than that.
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
