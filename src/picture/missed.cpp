// Drawing parts of the surface that were missed: one ray for each pixel, searched from the depth that the surface has beside it.
#include "missed.h"

#include "math/normal.h"
#include "math/whole.h"
#include "surface/voxel.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// No pixel is begun after LOOKS_MOST evaluations of the field in a frame, nor after as many as looksAt() allows.
constexpr int LOOKS_MOST = 3500, LOOKS_AT_ONE = 28000;
// Depths, 1/128 unit: the first step along the ray; and how far a pixel lies behind another from which on both depths
// are tried.
constexpr int STEP = 128, APART = 128;
// Upper bounds: of the steps along the ray towards a stronger field; of the ratio of each step to the one before; and of the
// steps back through the object towards the eye.
constexpr int STEPS = 3, FARTHEST = 3, THICKEST = 12;
// No surface is near a point where the field is this much below the isovalue.
constexpr Real NEAR(0.2);
// A ray only grazes the surface if the field, times the size of its object, rises by less than this over the last STEP.
constexpr Real RIM(0.25);
// All pixels lie behind this depth by APART or more.
constexpr int NOWHERE = -APART;

}  // namespace

int looksAt(Real spacing, int atOne)
{
    const Real cube = max(spacing * spacing * spacing, Real(1));
    return floorToInt(quotient(Real(atOne), cube));
}

int brightnessOf(const Vector& gradient, const Vector& toLight)
{
    // The field rises inwards.
    const Normal in = normalise(gradient), light = normalise(toLight);
    return max32(lambert(-(in.x * light.x + in.y * light.y + in.z * light.z) >> 14), 0);
}

Missed::Missed(View& view, FieldProbe& probe, Real spacing)
    : view_(view), frame_(view.frame()), zbuffer_(view.zbuffer()), probe_(probe), model_(probe.model()),
      looksMost_(min32(looksAt(spacing, LOOKS_AT_ONE), LOOKS_MOST))
{
}

// Whether a pixel shows nothing, or something well behind this depth.
inline bool Missed::isMissing(int at, int depth) const
{
    return frame_[at] == 0 || zbuffer_[at] > depth + BEHIND;
}

void Missed::draw()
{
    const int corners = count_;
    for (int i = 0; i < corners; ++i)
        if (noted_[i].depth != 0) {
            follow(noted_[i].pixel, noted_[i].depth, noted_[i].from);
        } else if (takeCorner(noted_[i].pixel) && model_ != nullptr) {
            const int at = noted_[i].pixel, beside = drawnBeside(at, NOWHERE);
            follow(at, zbuffer_[beside], beside);
        }
    const Crossing* const end = view_.crossings() + view_.crossingCount();
    for (const Crossing* at = view_.crossings(); at < end && model_ != nullptr; ++at) {
        const int first = isMissing(at->pixel, at->depth) ? at->pixel : at->pixel + at->outwards;
        if (isMissing(first, at->depth))
            follow(first, at->depth, first);
    }
}

bool Missed::follow(int at, int depth, int from)
{
    const int before = count_;
    bool any = false;
    for (put(at, depth, from); count_ > before;) {
        const Place place = noted_[--count_];
        any |= looks_ < looksMost_ && drawPixel(place);
    }
    return any;
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

// Returns by how much the field exceeds the isovalue at the point that a pixel shows at this depth.
Real Missed::excess(int at, int depth)
{
    ++looks_;
    return probe_.implicitAt(view_.pointAt(at, depth), &strongest_) - ISOVALUE;
}

// Looks for a point inside along the ray through a pixel, in the direction in which the field rises, with steps of the secant
// method. `*depth` and `*here`, the field's excess there, are the first guess and become the result. Returns false when the ray
// misses the surface.
bool Missed::findInside(int at, int* depth, Real* here)
{
    for (int i = 0, step = STEP; *here <= Real(0); ++i) {
        if (i == STEPS || *here < -NEAR || *depth + step <= 0 || *depth + step >= Z_EMPTY)
            return false;
        const Real there = excess(at, *depth + step), rise = there - *here;
        const bool rises = rise > Real(0);
        const Real left = rises ? -there : -*here, slope = absolute(rise);
        if (left > slope * Real(FARTHEST))
            return false;
        const int on = left > Real(0) ? floorToInt(quotient(left, slope) * Real(magnitude(step))) + STEP / 4 : 0;
        *depth += rises ? step : 0;
        *here = rises ? there : *here;
        step = (step > 0) == rises ? on : -on;
    }
    return true;
}

// Finds where the ray through a pixel enters the surface. *depth is a first guess and becomes the result. Returns false when the
// ray misses the surface.
bool Missed::findDepth(int at, int* depth)
{
    int outside = *depth;
    Real here = excess(at, outside);
    onEdge_ = here < Real(0);
    if (!findInside(at, &outside, &here))
        return false;
    // From there looks for a point outside, towards the eye, and interpolates between the last two points.
    Real within = here;
    for (int i = 0; here > Real(0); ++i) {
        if (i == THICKEST || outside <= STEP)
            return false;
        within = here;
        outside -= STEP;
        here = excess(at, outside);
    }
    onEdge_ = onEdge_ && strongest_ >= 0 && (within - here) * model_->actor(strongest_).object->size() < RIM;
    *depth = outside + floorToInt(quotient(-here, within - here) * Real(STEP));
    return true;
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

// Finds the depth of the surface at a place. A drawn pixel in the same row is the best guide, because near the upper and the lower
// end of an outline depths change most from row to row. If the ray through an empty pixel misses the surface from that depth, it
// may hit what lies behind, from the depth of another drawn pixel beside it. Returns false when there is no surface.
bool Missed::findSurface(Place* place)
{
    const int at = place->pixel;
    forBeside(at, [&](int beside) {
        if (magnitude(beside - at) == 1 && frame_[beside] != 0 && magnitude(zbuffer_[beside] - place->depth) <= BEHIND)
            *place = {place->pixel, zbuffer_[beside], static_cast<uint16_t>(beside)};
    });
    int depth = place->depth;
    if (!findDepth(at, &depth)) {
        if (frame_[at] != 0)
            return false;
        place->from = static_cast<uint16_t>(drawnBeside(at, place->depth));
        depth = zbuffer_[place->from];
        if (place->from == at || !findDepth(at, &depth))
            return false;
    }
    place->depth = static_cast<uint16_t>(depth);
    return true;
}

// Draws a pixel where surface is missing, and notes the pixels beside it where it may be missing too. Returns false when nothing is
// missing.
bool Missed::drawPixel(Place place)
{
    const int at = place.pixel;
    if (!isMissing(at, place.depth) || !findSurface(&place) || !isMissing(at, place.depth) ||
        !setColour(at, place.depth, place.from))
        return false;
    // Where the ray only grazes the surface this is its outline: there is nothing beyond.
    if (!onEdge_)
        forBeside(at, [&](int beside) {
            if (isMissing(beside, place.depth))
                put(beside, place.depth, at);
        });
    return true;
}

bool Missed::setColour(int at, int depth, int from)
{
    const Point p = view_.pointAt(at, depth);
    ++looks_;
    probe_.implicitAt(p, &strongest_);
    const SoftObject* const own = strongest_ < 0 ? nullptr : model_->actor(strongest_).object;
    uint8_t colour = frame_[from];
    if (own != nullptr && own->ramp() != nullptr &&
        (own->paint() == nullptr || from == at || probe_.strongestAt(view_.pointAt(from)) != strongest_)) {
        colour = own->ramp()[brightnessOf(probe_.gradient(), model_->light)];
    }
    if (colour == 0)
        return false;
    view_.setPixel(at, depth, colour);
    return true;
}
