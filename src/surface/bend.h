// Bend: how the surface of a patch is curved, and what follows from it along vectors of own space.
#ifndef FB_BEND_H
#define FB_BEND_H

#include "math/whole.h"
#include "model/seed.h"

class SoftObject;
struct Patch;
struct Shading;

// The curvature of the surface over a patch, measured from the normals of its seeds.
struct Bend {
    int16_t turn[6];    // a symmetric matrix, xx yy zz xy xz yz: how much the normal turns over a step; 1.0 = 2^13 over 256 steps
                        // of places (voxels.h). Along the normal it has the greatest curvature of the patch
    bool ball;          // the patch is curved like the unblended ball, or nothing better is known; `turn` is not set
    bool known;         // no seed has settled since it was measured
};

// The product of the matrix Bend::turn and a vector of any length: how much the normal turns over that step.
inline void turnAlong(const Bend& bend, const int32_t v[3], int32_t to[3])
{
    const int16_t(&t)[6] = bend.turn;
    to[0] = (t[0] * v[0] + t[3] * v[1] + t[4] * v[2]) >> 14;
    to[1] = (t[3] * v[0] + t[1] * v[1] + t[5] * v[2]) >> 14;
    to[2] = (t[4] * v[0] + t[5] * v[1] + t[2] * v[2]) >> 14;
}

// The products of the components of two vectors in the order of Bend::turn, the mixed ones xy, xz and yz summed for both orders.
// They lose 13 bits.
inline void findProducts(const int32_t a[3], const int32_t b[3], int32_t to[6])
{
    for (int i = 0; i < 3; ++i)
        to[i] = a[i] * b[i] >> 13;
    to[3] = (a[0] * b[1] + a[1] * b[0]) >> 13;
    to[4] = (a[0] * b[2] + a[2] * b[0]) >> 13;
    to[5] = (a[1] * b[2] + a[2] * b[1]) >> 13;
}

// The component along one vector of the normal's turn over a step along another, from the products of the two vectors.
inline int32_t turnOf(const Bend& bend, const int32_t both[6])
{
    return bend.turn[0] * both[0] + bend.turn[1] * both[1] + bend.turn[2] * both[2] + bend.turn[3] * both[3] +
           bend.turn[4] * both[4] + bend.turn[5] * both[5];
}

// The dot product of a direction and a vector, with 14 more fraction bits than the vector has.
inline int32_t dot(const Direction14& a, const int32_t b[3])
{
    return a.x * b[0] + a.y * b[1] + a.z * b[2];
}

// The component along a vector of the normal's turn over a step along the same vector, times 2^-17.
inline int32_t curvatureAlong(const Bend& bend, const int32_t v[3])
{
    int32_t turned[3];
    turnAlong(bend, v, turned);
    return dot(turned, v) >> 3;
}

// Measures the bend of a patch from two steps between its valid seeds, and from how far the normal turns over each.
SELDOM void measureBend(const SoftObject& object, const Shading& shading, Patch& patch);

#endif
