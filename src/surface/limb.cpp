// The limb, where a surface bends out of sight, computed from how the surface bends (limb.h explains the mathematics).
#include "limb.h"

#include "math/whole.h"

namespace {

// The least k for which a limb is found, per unit, 1.0 = 2^14: a radius of about 250 units.
constexpr int32_t LEAST_CURVATURE = 66;
// No limb is found where a component of s / k is this or more, and 1 / kz is limited to this.
constexpr int32_t SLANT = 4;
// Cosines are limited to this, 1.0 = 2^14: seeds that are near and far aside have greater ones, but these make no difference.
constexpr int32_t COSINE_MOST = (1 << 15) - 1;

inline int32_t times14(int32_t a, int32_t b)
{
    return a * b >> 14;
}

// The same with a 64-bit product: in a wide view a saddle may bend so much aside that 32 bits do not hold it.
inline int32_t wideTimes14(int32_t a, int32_t b)
{
    return static_cast<int32_t>(static_cast<int64_t>(a) * b >> 14);
}

// The function that cuts a voxel has the slope 64 (as Voxel::cutX) where the normal lies across the view. inward() converts a
// slope counted outwards, 1.0 = 2^14, to one counted inwards.
constexpr int SHIFT = 8;
constexpr int32_t HALF = 1 << (SHIFT - 1);
inline int8_t inward(int32_t outward)
{
    return static_cast<int8_t>(limited((HALF - outward) >> SHIFT, 127));
}

// Sets the limb from k, s and S across the view, per unit, 1.0 = 2^14. Returns false when there is no limb.
bool setLimb(int32_t k, int32_t alongX, int32_t alongY, int32_t xx, int32_t xy, int32_t yy, int32_t depth, Limb* limb)
{
    if (k < LEAST_CURVATURE || max32(magnitude(alongX), magnitude(alongY)) >= k * SLANT)
        return false;
    limb->radius = (1 << 22) / k;
    limb->nearness = min32((limb->radius << 14) / depth, SLANT << 14);
    limb->along[0] = mulDiv(alongX, 1 << 14, k);
    limb->along[1] = mulDiv(alongY, 1 << 14, k);
    limb->curve[0] = inward((xx - wideTimes14(alongX, limb->along[0])) * 2);
    limb->curve[1] = inward((xy - wideTimes14(alongX, limb->along[1])) * 2);
    limb->curve[2] = inward((yy - wideTimes14(alongY, limb->along[1])) * 2);
    return true;
}

}  // namespace

void findViewProducts(const OwnFrame& own, ViewProducts* axes)
{
    findProducts(own.right, own.right, axes->xx);
    findProducts(own.right, own.up, axes->xy);
    findProducts(own.up, own.up, axes->yy);
    findProducts(own.right, own.ahead, axes->xz);
    findProducts(own.up, own.ahead, axes->yz);
    findProducts(own.ahead, own.ahead, axes->zz);
}

bool findLimb(int32_t bend, int32_t shearX, int32_t shearY, int32_t depth, Limb* limb)
{
    const int32_t x = times14(shearX << 4, bend), y = times14(shearY << 4, bend);
    return setLimb(bend + times14(shearX << 4, x) + times14(shearY << 4, y), x, y, bend, 0, bend, depth, limb);
}

bool findLimb(const Bend& bend, const ViewProducts& axes, int32_t step, int32_t shearX, int32_t shearY, int32_t depth,
              Limb* limb)
{
    // Turns have 1.0 = 2^13 over 256 steps (Bend::turn), and the products 15 fraction bits.
    const auto perUnit = [&](const int32_t products[6]) { return limited(mulDiv(turnOf(bend, products), 4, step), 1 << 15); };
    const int32_t xx = perUnit(axes.xx), xy = perUnit(axes.xy), yy = perUnit(axes.yy), xz = perUnit(axes.xz), yz = perUnit(axes.yz);
    // S w and w S w, where w leads (shearX, shearY) aside.
    const int32_t alongX = xz + ((shearX * xx + shearY * xy) >> 10), alongY = yz + ((shearX * xy + shearY * yy) >> 10);
    const int32_t k = perUnit(axes.zz) + ((shearX * (xz + alongX) + shearY * (yz + alongY)) >> 10);
    return setLimb(k, alongX, alongY, xx, xy, yy, depth, limb);
}

void endAtLimb(const Limb& limb, int32_t cosine, Voxel* voxel)
{
    cosine = min32(cosine, COSINE_MOST);
    // A tilt is a component of the normal divided by the cosine.
    const int32_t near = min32(times14(cosine, limb.nearness), (SLANT - 1) << 14) + (1 << 14);
    const int32_t x = times14(voxel->tiltX * cosine >> 8, near) + times14(cosine, limb.along[0]);
    const int32_t y = times14(voxel->tiltY * cosine >> 8, near) + times14(cosine, limb.along[1]);
    // `back` was a guess. At the limb the tangent plane is c / 2k deeper; a quarter more leaves room for what is approximate.
    voxel->back = static_cast<uint8_t>(min32(((cosine * limb.radius >> 18) * 5 >> 2) + 1, ENDS_MOST));
    voxel->cutX = inward(x);
    voxel->cutY = inward(y);
    // c^2 / 2k: how far away the limb is across the view.
    const int32_t square = min32(times14(cosine, cosine), 1 << 14);
    voxel->cutAt = static_cast<int16_t>(min32(((square * limb.radius >> 10) * 16 + HALF) >> SHIFT, CUT_MOST));
    voxel->curveXX = limb.curve[0];
    voxel->curveXY = limb.curve[1];
    voxel->curveYY = limb.curve[2];
}
