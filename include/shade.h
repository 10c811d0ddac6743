// What a seed looks like: which way its surface faces, how bright it is, how large its scale falls. Small integers and
// tables, because it is done for every seed that moved.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "seed.h"
#include "vec.h"

// A unit normal, each component scaled by 2^14; good to about 1/250.
struct Normal {
    int32_t x, y, z;
};

// Steps of brightness: 0..63, the 64-step ramp.
constexpr int BRIGHTEST = 63;

// The tables behind normalise() and ShadeSetup. Call once before any object is updated.
void makeShadeTables();

extern uint16_t inverseRoots[768];  // 2^28 / sqrt(s) for s = (i + 1/2) 2^20
extern uint16_t rootSteps[256];     // 256 sqrt(q) for q = (i + 1/2) / 64, so 0 <= q < 4

// The direction of a vector of any length in range; the zero vector gives the direction to the viewer.
inline Normal normalise(const Vector& v)
{
#if FB_REAL == FB_FIXED
    int32_t x = v.x.raw, y = v.y.raw, z = v.z.raw;
    const uint32_t bits = static_cast<uint32_t>(x < 0 ? ~x : x) | static_cast<uint32_t>(y < 0 ? ~y : y) |
                          static_cast<uint32_t>(z < 0 ? ~z : z);
    if (bits == 0)
        return {0, 0, -16384};
    // To 14 bits and a sign, so that the sum of squares has 26 to 30 bits.
    const int excess = 18 - __builtin_clz(bits);
    if (excess >= 0) {
        x >>= excess;
        y >>= excess;
        z >>= excess;
    } else {
        x *= 1 << -excess;
        y *= 1 << -excess;
        z *= 1 << -excess;
    }
    const int32_t inverse = inverseRoots[static_cast<uint32_t>(x * x + y * y + z * z) >> 20];
    return {(x * inverse) >> 14, (y * inverse) >> 14, (z * inverse) >> 14};
#else
    const Real size = length(v);
    if (!(size > Real(0)))
        return {0, 0, -16384};
    return {static_cast<int32_t>(v.x / size * 16384), static_cast<int32_t>(v.y / size * 16384),
            static_cast<int32_t>(v.z / size * 16384)};
#endif
}

// Where the viewer is, as the seeds of one root see him. Distances in 1/32 unit, limited to +-1000 units.
class EyeSide {
public:
    enum Side { BACK, EITHER, FRONT };

    // `toEye`: from the object's centre to the eye.
    void set(const Vector& toEye, Real radius, Real spacing)
    {
        centre_ = toEye;
        distance_ = length(toEye);
        // A seed past the horizon shows as long as its scale reaches back over it: half a spacing of arc.
        slack_ = distance_ * shiftDown(spacing / radius, 1);
        edge_ = (rawFromReal(radius - slack_) >> 11) * 16384;
        away_ = (rawFromReal(distance_ * Real(-0.8)) >> 11) * 16384;
        radius_ = rawFromReal(radius) >> 11;
        slackSteps_ = (rawFromReal(slack_) >> 11) * 16384;
        root({Real(0), Real(0), Real(0)});
    }

    // Seeds looked at from now on have their root here, counted from the centre.
    void root(const Vector& fromCentre)
    {
        x_ = steps(centre_.x - fromCentre.x);
        y_ = steps(centre_.y - fromCentre.y);
        z_ = steps(centre_.z - fromCentre.z);
    }

    // Whether the seed, at rest, may be seen.
    bool pathFaces(const Seed& s) const { return s.dirX * x_ + s.dirY * y_ + s.dirZ * z_ > edge_; }

    // Whether the seed's path points so far away that it cannot be seen even when it is pulled out by blending.
    bool pathAway(const Seed& s) const { return s.dirX * x_ + s.dirY * y_ + s.dirZ * z_ < away_; }

    // Whether a seed with this normal may be seen: normal . (eye - seed) > -slack.
    bool faces(const Normal& n, const Seed& s, Real position) const
    {
        const int32_t along = (n.x * s.dirX + n.y * s.dirY + n.z * s.dirZ) >> 14;
        const int32_t out = radius_ * (rawFromReal(position) >> 8) >> 8;
        return n.x * x_ + n.y * y_ + n.z * z_ - along * out > -slackSteps_;
    }

    // The same for all seeds at rest in a ball of `radius` round `middle`, with directions within `spread` of `axis`.
    Side side(const Vector& middle, const Vector& axis, Real radius, Real spread) const
    {
        const Real middling = dot(centre_ - middle, axis) + slack_;
        const Real doubt = (distance_ + radius) * spread + radius;
        return middling > doubt ? FRONT : middling < -doubt ? BACK : EITHER;
    }

private:
    static int32_t steps(Real units)
    {
        const int32_t s = rawFromReal(units) >> 11;
        return s > 32000 ? 32000 : s < -32000 ? -32000 : s;
    }

    Vector centre_;
    Real distance_, slack_;
    int32_t x_, y_, z_;
    int32_t edge_, away_, radius_, slackSteps_;
};

// Brightness and extents, for one light and one spacing.
class ShadeSetup {
public:
    void set(const Vector& light, Real spacing)
    {
        x_ = rawFromReal(light.x) >> 2;
        y_ = rawFromReal(light.y) >> 2;
        z_ = rawFromReal(light.z) >> 2;
        half_ = rawFromReal(spacing * Real(0.56)) >> 8;
    }

    // "Brightness proportional to the angle" of normal and light: Lambert's cosine, 0..63.
    uint8_t brightness(const Normal& n) const
    {
        const int32_t cosine = (n.x * x_ + n.y * y_ + n.z * z_) >> 14;
        const int32_t step = (cosine * BRIGHTEST + 8192) >> 14;
        return static_cast<uint8_t>(step < 0 ? 0 : step > BRIGHTEST ? BRIGHTEST : step);
    }

    // Half extents of the scale of a deformed seed: the disc of half a spacing round its path, stretched with the
    // position, as it falls along the path onto the tangent plane with normal n, as the viewer sees it. With u the
    // path's direction and c = u.n that is position half sqrt(1 + ux/c (ux/c - 2 nx)) along X.
    void extents(Seed& s, const Normal& n, Real position) const
    {
        int32_t c = (n.x * s.dirX + n.y * s.dirY + n.z * s.dirZ) >> 14;
        if (c < 4096)
            c = 4096;  // nearly along the surface: no scale is stretched more than fourfold
        const int32_t inverse = (1 << 28) / c;
        const int32_t half = half_ * (rawFromReal(position) >> 8) >> 8;
        s.wide = extent(s.dirX * inverse >> 18, n.x >> 4, half);
        s.high = extent(s.dirY * inverse >> 18, n.y >> 4, half);
    }

private:
    // a = ux/c and n = nx scaled by 2^10.
    static int16_t extent(int32_t a, int32_t n, int32_t half)
    {
        int32_t q = ((1 << 20) + a * (a - 2 * n)) >> 14;
        q = q < 0 ? 0 : q > 255 ? 255 : q;
        return static_cast<int16_t>(half * rootSteps[q] >> 8);
    }

    int32_t x_, y_, z_, half_;
};

#endif
