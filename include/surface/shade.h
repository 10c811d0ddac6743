// What a seed looks like: which way its surface faces, how bright it is, how large its scale falls. Small integers and
// tables, because it is done for every seed that moved.
#ifndef FB_SHADE_H
#define FB_SHADE_H

#include "model/seed.h"
#include "math/vec.h"

// A unit normal, each component scaled by 2^14; good to about 1/250.
struct Normal {
    int32_t x, y, z;
};

// Steps of brightness: 0..63, the 64-step ramp.
constexpr int BRIGHTEST = 63;

// The tables behind normalise() and ShadeSetup. Call once before any object is updated.
void makeShadeTables();

extern uint16_t inverseRoots[769];  // 2^28 / sqrt(s) for s = (i + 1/2) 2^20

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

// The length of a vector (each component up to 10000 units), or up to a hundredth more.
inline Real nearLength(const Vector& v)
{
#if FB_REAL == FB_FIXED
    const Normal n = normalise(v);
    const Vector along{Real::fromRaw(n.x * 4), Real::fromRaw(n.y * 4), Real::fromRaw(n.z * 4)};
    const Real l = dot(v, along);
    return l + shiftDown(l, 7);
#else
    return length(v);
#endif
}

// Where the viewer is, as the seeds of one root see him. Distances in 1/32 unit, limited to +-1000 units; scalar products
// of them with directions have 2^14 times that scale.
class EyeSide {
public:
    enum Side { BACK, EITHER, FRONT };

    // `toEye`: from the object's centre to the eye; `reach`: the greatest distance of a root from the centre.
    void set(const Vector& toEye, Real radius, Real reach)
    {
        centre_ = toEye;
        const Real most(1000);
        distance_ = steps(nearLength({clamp(toEye.x, -most, most), clamp(toEye.y, -most, most), clamp(toEye.z, -most, most)}) + reach);
        toEye_[0] = steps(toEye.x);
        toEye_[1] = steps(toEye.y);
        toEye_[2] = steps(toEye.z);
        radius_ = steps(radius);
        horizon_ = radius_;
        limb_ = reach > Real(0) ? 0 : distance_ * 5 >> 7;
        edge_ = (radius_ + limb_) << 14;
        away_ = -(distance_ * 13107);  // cosine -0.8
        root({Real(0), Real(0), Real(0)});
    }

    // Seeds looked at from now on have their root here, counted from the centre.
    void root(const Vector& fromCentre)
    {
        x_ = steps(centre_.x - fromCentre.x);
        y_ = steps(centre_.y - fromCentre.y);
        z_ = steps(centre_.z - fromCentre.z);
    }

    // For objects that taper: the radius there.
    void rootRadius(Real radius)
    {
        radius_ = steps(radius);
        edge_ = (radius_ + limb_) << 14;
    }

    // Radius of curvature of the surface where the viewer sees its horizon, 1/32 unit: the object's own, unless told.
    void horizon(Real radius) { horizon_ = steps(radius); }
    int32_t horizon() const { return horizon_; }

    // direction . (eye - root) of the seed's path.
    int32_t along(const Seed& s) const { return s.dirX * x_ + s.dirY * y_ + s.dirZ * z_; }

    // Of along(): whether the seed, at rest, may be seen; by how much (1/32 unit) its path points too far away to be seen
    // even when it is pulled out by blending.
    bool seen(int32_t along) const { return along > edge_; }
    int32_t away(int32_t along) const { return (away_ - along) >> 14; }

    // direction . (eye - seed) of a seed at rest, 1/32 unit.
    int32_t restFacing(int32_t along) const { return (along >> 14) - radius_; }
    int32_t distance32() const { return distance_ < 1 ? 1 : distance_; }

    // normal . (eye - seed), 1/32 unit; `cosine` is normal . direction scaled by 2^14.
    int32_t facing(const Normal& n, int32_t cosine, Real position) const
    {
        return (n.x * x_ + n.y * y_ + n.z * z_ - cosine * (radius_ * (rawFromReal(position) >> 8) >> 8)) >> 14;
    }

    // Of facing(): by how much more than at the limb it may be seen; 0 or less, not at all. On a ball a scale that is seen
    // nearly edge-on adds next to nothing to those before it; on flat parts it may be all there is.
    int32_t beforeLimb(int32_t facing) const { return facing - limb_; }

    // The same for all seeds at rest of a patch: `axis` their mean direction, `across` = middle . axis and `radius` of the
    // ball round their middle in 1/32 unit, `spread` the greatest distance of a direction from the axis; directions scaled
    // by 2^14.
    Side side(const int16_t axis[3], int32_t across, int32_t radius, int32_t spread) const
    {
        const int32_t middling = ((axis[0] * toEye_[0] + axis[1] * toEye_[1] + axis[2] * toEye_[2]) >> 14) - across;
        const int32_t doubt = (distance_ * spread >> 14) + radius;
        return middling > doubt ? FRONT : middling < -doubt ? BACK : EITHER;
    }

private:
    friend struct ShadeLayout;
    static int32_t steps(Real units)
    {
        const int32_t s = rawFromReal(units) >> 11;
        return s > 32000 ? 32000 : s < -32000 ? -32000 : s;
    }

    Vector centre_;
    int32_t toEye_[3];
    int32_t x_, y_, z_;
    int32_t distance_, radius_, horizon_, edge_, away_, limb_;
};

// How much of a cell's depth shows sideways: x / depth and y / depth of places about a root, 8 bits of fraction, within
// +-5. Unless the viewer is near, one depth serves for all the places: for the part that it is wrong about is small.
class Skew {
public:
    // `root`: from the eye; `reach`: how far from it places may lie.
    void root(const Vector& root, Real reach)
    {
        root_ = root;
        depth_ = rawFromReal(root.z) >> 11;
        near_ = depth_ < 2 * (rawFromReal(reach) >> 11) || depth_ < 128;
        share_ = near_ ? 0 : (1 << 20) / depth_;
        x_ = near_ ? 0 : limited((rawFromReal(root.x) >> 11) * share_ >> 12);
        y_ = near_ ? 0 : limited((rawFromReal(root.y) >> 11) * share_ >> 12);
    }

    // Of a place counted from the root.
    int32_t x(const Vector& out) const
    {
        return near_ ? exactly(root_.x + out.x, root_.z + out.z) : x_ + ((rawFromReal(out.x) >> 11) * share_ >> 12);
    }
    int32_t y(const Vector& out) const
    {
        return near_ ? exactly(root_.y + out.y, root_.z + out.z) : y_ + ((rawFromReal(out.y) >> 11) * share_ >> 12);
    }
    // Its depth along the viewing axis, 1/32 unit.
    int32_t depth(const Vector& out) const { return depth_ + (rawFromReal(out.z) >> 11); }

private:
    friend struct ShadeLayout;
    static int32_t limited(int32_t skew) { return skew > 1024 ? 1024 : skew < -1024 ? -1024 : skew; }
    static int32_t exactly(Real aside, Real away)
    {
        const int32_t depth = rawFromReal(away) >> 11;
        return limited((rawFromReal(aside) >> 11) * ((1 << 20) / (depth < 32 ? 32 : depth)) >> 12);
    }

    Vector root_{Real(0), Real(0), Real(0)};
    int32_t depth_ = 0, share_ = 0, x_ = 0, y_ = 0;
    bool near_ = true;
};

// How a scale lies, from nx and ny of its normal (scaled by 2^14), facing() and the depth along the viewing axis in 1/32
// unit: its tilt, and where it ends on a surface of curvature 1 / radius (1/32 unit).
//
// The tilt is n.x and n.y. That is less than the surface's own, which goes to infinity at the horizon: of two scales that
// overlap on a round body the nearer one is to win, and always the same one, lest their border be unsteady. Near the
// horizon, which is cosine^2 radius / 2 away, a scale would stand out over the edge of the object: it ends there. Along
// its plane it is as much deeper there, for then the tilt is about 1. What does not extend so far needs no end.
inline void layDown(int32_t nx, int32_t ny, int32_t facing, int32_t depth, int32_t radius, Seed& s)
{
    s.voxel.tiltX = static_cast<int16_t>(nx >> 6);
    s.voxel.tiltY = static_cast<int16_t>(ny >> 6);
    s.voxel.reach = 0;
    s.voxel.slopeX = s.voxel.slopeY = 0;
    if (2 * facing >= depth || depth < 32)
        return;
    const int32_t reach = facing > 0 ? mulDiv(mulDiv(facing, facing, depth), radius, 2 * depth) + 1 : 1;
    const int32_t x = s.voxel.tiltX * s.voxel.wide, y = s.voxel.tiltY * s.voxel.high;
    if (reach < 256 && ((x < 0 ? -x : x) + (y < 0 ? -y : y)) >> 11 >= reach)
        s.voxel.reach = static_cast<uint8_t>(reach);
}

// Steps of brightness from the middle of a scale to its corner: less is none; and on small objects.
constexpr int EVEN = 8, EVEN_SMALL = 1;

// How the brightness changes across a scale, 1/8 step a unit, at most 2^15: not at all where it is less than `even` to the
// corner, and no more than a voxel may have.
inline void setSlopes(Voxel& v, int32_t x, int32_t y, int even)
{
    int32_t corner = ((x < 0 ? -x : x) * v.wide + (y < 0 ? -y : y) * v.high) >> 11;
    if (corner < even)
        return;
    for (; corner > SHADING_MOST; corner >>= 1) {
        x /= 2;
        y /= 2;
    }
    v.slopeX = static_cast<int8_t>(x < -127 ? -127 : x > 127 ? 127 : x);
    v.slopeY = static_cast<int8_t>(y < -127 ? -127 : y > 127 ? 127 : y);
}

// Brightness and extents, for one light and one spacing.
class ShadeSetup {
public:
    void set(const Vector& light, Real spacing)
    {
        x_ = rawFromReal(light.x) >> 2;
        y_ = rawFromReal(light.y) >> 2;
        z_ = rawFromReal(light.z) >> 2;
        spacing_ = rawFromReal(spacing) >> 8;
    }

    // Towards the light, 1.0 = 2^14.
    Normal light() const { return {x_, y_, z_}; }

    // "Brightness proportional to the angle" of normal and light: Lambert's cosine, 0..63.
    uint8_t brightness(const Normal& n) const
    {
        const int32_t cosine = (n.x * x_ + n.y * y_ + n.z * z_) >> 14;
        const int32_t step = (cosine * BRIGHTEST + 8192) >> 14;
        return static_cast<uint8_t>(step < 0 ? 0 : step > BRIGHTEST ? BRIGHTEST : step);
    }

    // Half extents of the scale of a seed at rest: its cell as the viewer sees it. `skewX` and `skewY` are x / depth and
    // y / depth of the place from the eye, 8 bits of fraction: off the viewing axis that much of the cell's depth shows
    // sideways.
    // `whole`: all of it, and not what the seeds of a ring cover together.
    void restExtents(Seed& s, int32_t skewX, int32_t skewY, bool whole) const
    {
        setExtents(s, s.along[0] * 256 - s.along[2] * skewX, s.along[1] * 256 - s.along[2] * skewY,
                   s.across[0] * 256 - s.across[2] * skewX, s.across[1] * 256 - s.across[2] * skewY, spacing_, whole);
    }

    // The same of a deformed seed: the cell of the unblended surface that is its own, grown with the position, as it falls
    // along the path onto the tangent plane with normal n. A half axis e becomes e - u (e.n) / (u.n) with u the path's
    // direction; `cosine` is u.n scaled by 2^14.
    void extents(Seed& s, const Normal& n, int32_t cosine, Real position, int32_t skewX, int32_t skewY) const
    {
        if (cosine < 6500)
            cosine = 6500;  // nearly along the surface: no scale is stretched more than two and a half times
        const int32_t inverse = (1 << 26) / cosine;  // 12 bits of fraction
        const int32_t size = spacing_ * (rawFromReal(position) >> 8) >> 8;
        const bool whole = inverse > WHOLE;
        // (e.n) / (u.n), 8 bits of fraction, 1/64 spacing.
        const int32_t along = ((s.along[0] * n.x + s.along[1] * n.y + s.along[2] * n.z) >> 8) * inverse >> 10;
        const int32_t across = ((s.across[0] * n.x + s.across[1] * n.y + s.across[2] * n.z) >> 8) * inverse >> 10;
        const int32_t alongZ = s.along[2] - (s.dirZ * along >> 22), acrossZ = s.across[2] - (s.dirZ * across >> 22);
        setExtents(s, s.along[0] * 256 - (s.dirX * along >> 14) - alongZ * skewX,
                   s.along[1] * 256 - (s.dirY * along >> 14) - alongZ * skewY,
                   s.across[0] * 256 - (s.dirX * across >> 14) - acrossZ * skewX,
                   s.across[1] * 256 - (s.dirY * across >> 14) - acrossZ * skewY, size, whole);
    }

private:
    // The half axes of a cell as they fall on the picture. Beside each other, cells of a ring make a band along `along`:
    // rectangles as wide as the way from one to the next need not cover the whole of their cells, only, together, the band.
    // Where the surface is much deformed, `whole`, the ring is no even band, and the cell is covered.
    static void setExtents(Seed& s, int32_t alongX, int32_t alongY, int32_t acrossX, int32_t acrossY, int32_t size, bool whole)
    {
        const int32_t ax = alongX < 0 ? -alongX : alongX, ay = alongY < 0 ? -alongY : alongY;
        int32_t wide = ax, high = ay;
        if (whole) {
            wide += acrossX < 0 ? -acrossX : acrossX;
            high += acrossY < 0 ? -acrossY : acrossY;
        } else if (ax > ay) {
            const int32_t c = acrossY - acrossX * (alongY * 64 / alongX) / 64;
            high += c < 0 ? -c : c;
        } else if (ay > 0) {
            const int32_t c = acrossX - acrossY * (alongX * 64 / alongY) / 64;
            wide += c < 0 ? -c : c;
        }
        s.voxel.wide = static_cast<int16_t>(((wide + MARGIN) * size >> 14) + MARGIN_UNITS);
        s.voxel.high = static_cast<int16_t>(((high + MARGIN) * size >> 14) + MARGIN_UNITS);
    }

    friend struct ShadeLayout;
    static constexpr int32_t WHOLE = 4329;  // 12 bits of fraction: a cosine of path and normal below 0.946
    static constexpr int32_t MARGIN = 256 * 64 * 3 / 64;    // a part of the spacing, as of `sum`
    static constexpr int32_t MARGIN_UNITS = 6;           // and what places of seeds are uncertain by, 1/256 unit

    int32_t x_, y_, z_, spacing_;
};

#endif
