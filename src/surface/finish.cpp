// Finishes and patterns.
#include "surface/finish.h"

namespace {

// A product of cosines, 1.0 = 2^14.
inline int32_t times(int32_t a, int32_t b)
{
    return a * b >> 14;
}

constexpr int32_t ONE = 1 << 14;

// Share of the light that a shiny surface scatters, 1.0 = 2^14.
constexpr int32_t SCATTERED = ONE * 3 / 4;

// The surroundings that a mirror shows: light by the height of the reflected direction, -1 straight down, 1 straight up. The ground
// is dark towards the horizon, the sky bright above it; between these corners the light changes linearly. All have 1.0 = 2^14.
struct Corner {
    int32_t height, light;
};
constexpr Corner SURROUNDINGS[] = {{-ONE, ONE / 2}, {-ONE * 3 / 10, ONE / 12}, {ONE * 3 / 10, ONE}, {ONE, ONE / 2}};

int32_t surroundings(int32_t height)
{
    const Corner* c = SURROUNDINGS;
    while (c < SURROUNDINGS + 2 && height > c[1].height)
        ++c;
    return c->light + (height - c->height) * (c[1].light - c->light) / (c[1].height - c->height);
}

// The highlight of a finish that shines: the 16th power of the cosine of the normal and the direction half way between light and
// viewer.
int32_t highlight(int32_t cosine)
{
    if (cosine <= 0)
        return 0;
    for (int i = 0; i < 4; ++i)
        cosine = times(cosine, cosine);
    return cosine;
}

// The sine of an angle in turns.
Real wave(Real turns)
{
    return sine(static_cast<Angle>(rawFromReal(turns)) << 16);
}

}  // namespace

Polish::Polish(const int32_t light[3], const int32_t ahead[3], const int32_t up[3])
{
    const Normal half = normalise({realFromRaw((light[0] - ahead[0]) * 4), realFromRaw((light[1] - ahead[1]) * 4),
                                   realFromRaw((light[2] - ahead[2]) * 4)});
    for (int i = 0; i < 3; ++i) {
        light_[i] = light[i];
        ahead_[i] = ahead[i];
        up_[i] = up[i];
    }
    half_[0] = half.x;
    half_[1] = half.y;
    half_[2] = half.z;
    upAhead_ = componentAlong(Normal{ahead[0], ahead[1], ahead[2]}, up);
}

int32_t Polish::brightness8(Finish finish, const Normal& normal) const
{
    int32_t light;
    if (finish == FINISH_MIRROR) {
        light = surroundings(upAhead_ - 2 * times(componentAlong(normal, ahead_), componentAlong(normal, up_)));
    } else {
        const int32_t cosine = componentAlong(normal, light_);
        light = cosine <= 0 ? 0 : times(cosine, SCATTERED);
    }
    light += times(ONE - light, highlight(componentAlong(normal, half_)));
    return (light > ONE ? ONE : light < 0 ? 0 : light) * BRIGHTEST >> 6;
}

PatternMap::PatternMap(const SoftObject& object) : paint_(*object.paint())
{
    const Matrix& turn = object.turn();
    for (int i = 0; i < 3; ++i)
        axis_[i] = {turn.m[0][i], turn.m[1][i], turn.m[2][i]};
    grain_ = paint_.grain * (object.size() / paint_.made);
    inverse_ = Real(1) / grain_;
}

PatternMap::PatternMap(const SoftObject& object, const SoftObject& seenBy) : PatternMap(object)
{
    for (Vector& axis : axis_)
        axis = seenBy.toOwnAxes(axis);
    inverse_ = seenBy.growth() / grain_;
}

void PatternMap::toGrains(const Vector& place, Real grains[3]) const
{
    for (int i = 0; i < 3; ++i)
        grains[i] = dot(place, axis_[i]) * inverse_;
}

// Checks are cubes; stripes are slices along the x axis.
int PatternMap::edgedAxes() const
{
    return paint_.pattern == PATTERN_CHECKS ? 3 : paint_.pattern == PATTERN_STRIPES ? 1 : 0;
}

uint8_t PatternMap::numberAt(const Real grains[3], uint8_t mix) const
{
    if (paint_.pattern == PATTERN_NONE)
        return mix;
    if (paint_.pattern == PATTERN_MARBLE) {
        // There are one light and one dark vein every two grains.
        const Real bent = grains[0] * Real(0.5) + Real(0.3) * wave(grains[1] * Real(0.35) + Real(0.2)) +
                          Real(0.2) * wave(grains[2] * Real(0.55) + grains[1] * Real(0.2));
        const Real share = Real(0.5) + Real(0.5) * wave(bent);
        const Vector& from = paint_.paints->placeOf(mix);
        return paint_.paints->numberAt(from + (paint_.otherAt - from) * share, paint_.shines());
    }
    int sum = 0;
    for (int i = 0, axes = edgedAxes(); i < axes; ++i)
        sum += floorToInt(grains[i]);
    return (sum & 1) != 0 ? paint_.other : mix;
}
