// Rings of seeds, and quick lengths, for all primitives with round parts.
#include "model/round.h"

#include "math/normal.h"
#include "model/sphere.h"
#include "model/stop.h"

namespace {

// Seeds of a ring so small that it bends noticeably across one seed's part of it.
constexpr int POLAR_SEEDS = 12;

// A seed's part of the surface is given a little larger than it is, for it is turned in 64ths of the spacing.
constexpr Real CELL_SPARE(1.04);

// top / bottom, rounded down; the quotient must fit 32 bits.
inline uint32_t quotient(uint64_t top, uint32_t bottom)
{
#if FB_I386
    uint32_t low = static_cast<uint32_t>(top), high = static_cast<uint32_t>(top >> 32);
    asm("divl %2" : "+a"(low), "+d"(high) : "rm"(bottom) : "cc");
    return low;
#else
    return static_cast<uint32_t>(top / bottom);
#endif
}

}  // namespace

int seedsOf(const Ring& ring, Real spacing)
{
    return seedsInRing(ring.core + ring.radius * ring.pathCosine, spacing, 1 << 30);
}

int stepsIn(Real length, Real spacing)
{
    const int32_t steps = (rawFromReal(length) + rawFromReal(spacing) - 1) / rawFromReal(spacing);
    return steps < 1 ? 1 : steps;
}

int addRoots(SeedMaker& maker, const Ring& ring, Real spacing)
{
    if (ring.core == Real(0))
        return maker.addRoot({Real(0), ring.height, Real(0)});
    const int count = seedsOf(ring, spacing);
    const uint32_t step = 0xffffffffu / static_cast<uint32_t>(count);
    int first = 0;
    for (int i = 0; i < count; ++i) {
        const Angle longitude = static_cast<uint32_t>(i) * step;
        const int root = maker.addRoot({ring.core * sine(longitude), ring.height, ring.core * cosine(longitude)});
        if (i == 0)
            first = root;
    }
    return first;
}

void addSeeds(SeedMaker& maker, const Ring& ring, Real spacing, int root)
{
    const int count = seedsOf(ring, spacing);
    maker.beginRing();
    if (maker.countRing(count, ring.core != Real(0)) || stopAsked())
        return;
    const uint32_t step = 0xffffffffu / static_cast<uint32_t>(count);
    // A seed's part of the surface is widest at its outer edge: in the small rings about a pole that makes a difference.
    Real around = ring.core + ring.radius * ring.pathCosine;
    if (count <= POLAR_SEEDS)
        around += ring.across * absolute(ring.normalSine);
    const Real along = around * sine(step / 2) * CELL_SPARE, across = ring.across * CELL_SPARE;
    const int nextRoot = ring.core == Real(0) ? 0 : 1;
    for (int i = 0; i < count; ++i, root += nextRoot) {
        const Angle longitude = static_cast<uint32_t>(i) * step;
        const Real s = sine(longitude), c = cosine(longitude);
        const Real inward = -(across * ring.normalSine);
        maker.addSeed(root, {ring.pathCosine * s, ring.pathSine, ring.pathCosine * c}, {along * c, Real(0), -(along * s)},
                      {inward * s, across * ring.normalCosine, inward * c});
    }
}

Real lengthQuick(const Vector& v)
{
#if FB_REAL == FB_FIXED
    uint32_t x = static_cast<uint32_t>(v.x.raw < 0 ? -v.x.raw : v.x.raw);
    uint32_t y = static_cast<uint32_t>(v.y.raw < 0 ? -v.y.raw : v.y.raw);
    uint32_t z = static_cast<uint32_t>(v.z.raw < 0 ? -v.z.raw : v.z.raw);
    const uint32_t bits = x | y | z;
    if (bits == 0)
        return Real(0);
    // The square, with a root of 15 bits from the table; one step of Newton's method doubles the bits that hold.
    const int excess = 18 - __builtin_clz(bits);
    uint64_t square;
    uint32_t root;
    if (excess > 0) {
        square = static_cast<uint64_t>(x) * x + static_cast<uint64_t>(y) * y + static_cast<uint64_t>(z) * z;
        const uint32_t few = static_cast<uint32_t>(square >> (2 * excess));
        root = static_cast<uint32_t>(static_cast<uint64_t>(few) * inverseRoots[few >> 20] >> 28) << excess;
    } else {
        x <<= -excess;
        y <<= -excess;
        z <<= -excess;
        square = x * x + y * y + z * z;
        root = static_cast<uint32_t>(square * inverseRoots[square >> 20] >> 28);
    }
    root = (root + quotient(square, root)) >> 1;
    return Real::fromRaw(static_cast<int32_t>(excess > 0 ? root : root >> -excess));
#else
    return squareRoot(dot(v, v));
#endif
}
