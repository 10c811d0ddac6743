// Ridges: where a surface bends outwards sharply between two seeds at rest. Their scales end there, instead of reaching beyond.
#include "math/normal.h"
#include "model/softobj.h"

namespace {

// A ridge lies between two seeds at rest that are no farther apart than RIDGE_WIDEST, in spacings, if the surface bends outwards
// and the cosine of their normals (1.0 = 2^14) is at most RIDGE_BENDS; if the object tapers, also where the normals differ by
// CORNER more than those of a ball would whose radius is the length of the paths there.
constexpr Real RIDGE_WIDEST(1.25), CORNER(0.1);
constexpr int32_t RIDGE_BENDS = 13000;

}  // namespace

// How far a seed lies behind the tangent plane of another, units; both are at rest.
Real SoftObject::Layout::behind(const Seed& s, const Seed& other) const
{
    return dot(rest(other) - rest(s), unitVector(other.normal));
}

// Records that a ridge lies between a seed and another, unless there is one nearer to the seed.
void SoftObject::Layout::noteBeyond(Seed& s, int other) const
{
    if (s.beyond < 0 || behind(s, seeds[other]) < behind(s, seeds[s.beyond >> 1]))
        s.beyond = 2 * other;
}

// Whether the normals of two seeds differ as much as beside a ridge.
bool SoftObject::Layout::bendSharply(const Seed& a, const Seed& b, bool tapers) const
{
    const int32_t cosine = (a.normal.x * b.normal.x + a.normal.y * b.normal.y + a.normal.z * b.normal.z) >> 14;
    if (cosine <= RIDGE_BENDS || !tapers)
        return cosine <= RIDGE_BENDS;
    // On a ball normals differ by the seeds' distance divided by the radius. The radius may be next to 0: nothing is divided by it.
    const Real differ = length(unitVector(a.normal) - unitVector(b.normal)), radius = min(length(a.path), length(b.path));
    return (differ - CORNER) * radius > length(rest(a) - rest(b));
}

// Records for two seeds that a ridge lies between them, if one does.
void SoftObject::Layout::noteRidge(int one, int other, bool tapers) const
{
    if (other < 0 || other >= regular)
        return;
    Seed &a = seeds[one], &b = seeds[other];
    if (!bendSharply(a, b, tapers) || squareOf(rest(a) - rest(b)) > squareOf(spacing * RIDGE_WIDEST) || behind(a, b) <= Real(0) ||
        behind(b, a) <= Real(0))
        return;
    noteBeyond(a, other);
    noteBeyond(b, one);
}

// Finds the ridges between each seed and those beside it: the next of its ring, and three of the ring before. (At the ends of a
// ring some of these numbers are those of seeds that lie far away.)
void SoftObject::Layout::findRidges(bool tapers) const
{
    for (int i = 0; i < regular; ++i) {
        noteRidge(i, i + 1, tapers);
        const int n = seeds[i].neighbour >> 1;
        for (int j = n - 1; n >= 0 && j <= n + 1; ++j)
            noteRidge(i, j, tapers);
    }
}
