// Measures how the surface of a patch bends, from the places and normals of its seeds.
#include "bend.h"

#include "math/normal.h"
#include "math/whole.h"
#include "voxels.h"

namespace {

// Finds the ends of two steps between valid seeds of a patch: along its middle ring (another ring if that has fewer than two), and
// from its first ring to its last. Returns false when there are no two such steps.
bool findSteps(const Seed* seeds, const Patch& patch, const Seed* from[2], const Seed* to[2])
{
    from[0] = to[0] = from[1] = to[1] = nullptr;
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        const Seed *first = seeds + patch.first[ring], *last = first + patch.count[ring] - 1;
        while (first <= last && !(first->flags & SEED_VALID))
            ++first;
        while (first <= last && !(last->flags & SEED_VALID))
            --last;
        if (first > last)
            continue;
        if (from[0] == to[0] || (ring == PATCH_RINGS / 2 && first != last)) {
            from[0] = first;
            to[0] = last;
        }
        if (from[1] == nullptr)
            from[1] = first;
        to[1] = first;
    }
    return from[0] != to[0] && from[1] != to[1];
}

// The cross product of two vectors, without its last `shift` bits.
inline void cross(const int32_t a[3], const int32_t b[3], int shift, int32_t to[3])
{
    to[0] = (a[1] * b[2] - a[2] * b[1]) >> shift;
    to[1] = (a[2] * b[0] - a[0] * b[2]) >> shift;
    to[2] = (a[0] * b[1] - a[1] * b[0]) >> shift;
}

// The direction at right angles to two steps that have no component beyond `longest`.
inline Normal normalTo(const int32_t a[3], const int32_t b[3], int32_t longest)
{
    // Long steps lose bits, so that their products fit 32 bits.
    const int down = max32(18 - __builtin_clz(static_cast<uint32_t>(longest | 1)), 0);
    const int32_t one[] = {a[0] >> down, a[1] >> down, a[2] >> down}, other[] = {b[0] >> down, b[1] >> down, b[2] >> down};
    int32_t n[3];
    cross(one, other, 0, n);
    return normalise({realFromRaw(n[0]), realFromRaw(n[1]), realFromRaw(n[2])});
}

}  // namespace

void measureBend(const SoftObject& object, const Shading& shading, Patch& patch)
{
    Bend& bend = patch.bend;
    bend.known = bend.ball = true;
    if (object.isBall() && patch.state == PATCH_REST)
        return;
    const Seed *from[2], *to[2];
    if (!findSteps(shading.seeds, patch, from, to))
        return;
    // The two steps, and the turn of the normal over each.
    int32_t step[2][3], turn[2][3], dual[2][3], size[2];
    for (int k = 0; k < 2; ++k) {
        const Seed &a = *from[k], &b = *to[k];
        int32_t start[3], *const d = step[k];
        findPlace(shading, a, start);
        findPlace(shading, b, d);
        for (int i = 0; i < 3; ++i)
            d[i] -= start[i];
        turn[k][0] = b.normal.x - a.normal.x;
        turn[k][1] = b.normal.y - a.normal.y;
        turn[k][2] = b.normal.z - a.normal.z;
        size[k] = max32(max32(magnitude(d[0]), magnitude(d[1])), magnitude(d[2]));
        // A normal that turns more than on a ball of half a unit is no measurement of a bend.
        if (max32(max32(magnitude(turn[k][0]), magnitude(turn[k][1])), magnitude(turn[k][2])) > size[k] << 7)
            return;
    }
    // The normal of the plane of both steps (that of a seed leans away from it where the patch bends much), and the dual vector of
    // each step: the dot product of dual[k] and a vector, divided by the area between the steps, is the vector's component in units
    // of step k. So on a ball and on a cylinder the result is exact, however far the patch goes round.
    const Normal normal = normalTo(step[0], step[1], max32(size[0], size[1]));
    const int32_t n[] = {normal.x, normal.y, normal.z};
    cross(n, step[0], 14, dual[1]);
    cross(step[1], n, 14, dual[0]);
    const int32_t area = dot(dual[0], step[0]);
    if (min32(size[0], size[1]) < 64 || magnitude(area) <= size[0] * size[1] >> 2)
        return;
    bend.ball = false;
    const auto overArea = [&](int32_t sum) { return limited(mulDiv(sum, 128, area), 16000); };
    // The greater curvature of the two also counts along this normal: the normals of the patch's other seeds lean away from it, so
    // that steps along their tangent planes have a component along it.
    const int32_t one = dot(turn[0], dual[0]), other = dot(turn[1], dual[1]);
    const int32_t most = overArea(magnitude(one) > magnitude(other) ? one : other);
    const auto turned = [&](int i, int j) {
        return static_cast<int16_t>(limited(overArea(turn[0][i] * dual[0][j] + turn[1][i] * dual[1][j]) +
                                            ((most * n[i] >> 14) * n[j] >> 14), 16000));
    };
    bend.turn[0] = turned(0, 0);
    bend.turn[1] = turned(1, 1);
    bend.turn[2] = turned(2, 2);
    bend.turn[3] = turned(0, 1);
    bend.turn[4] = turned(0, 2);
    bend.turn[5] = turned(1, 2);
}
