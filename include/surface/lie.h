// How a settled seed lies: from what the last look at the field found to its scale. For seeds of one ball among others it is
// a routine that stands twice: in C++ (src/surface/lie.cpp) and in assembly (asm/shade.S); both do the same, bit for bit, wherever the
// numbers of C++ do not overflow.
#ifndef FB_LIE_H
#define FB_LIE_H

#include "surface/shade.h"

// What a neighbour has to do with the gradient.
struct Pull {
    Vector fromIt16;  // from its centre to this object's centre, / 16
    Real ratio;       // weight (own size / its size)^2: its share of the gradient
};

constexpr int PULLS_MOST = 63;

// What is constant over the seeds of one root, and what the last look found.
struct ShadeFrame {
    EyeSide eye;
    Skew skew;
    ShadeSetup light;
    int32_t setBack;  // 2^31 / radius of the object, the radius in 1/65536 unit
    Real ownSlope;    // of the own field
    int32_t count;    // neighbours that matter
    Real slopes[PULLS_MOST];  // dF/dt of each, weight not included
    const Pull* pulls[PULLS_MOST];
    mutable Normal normal;    // out: of the seed that was shaded last and faces the viewer
};

// -grad F, but for a factor, is -(path position along + sum share fromIt), where share = slope ratio and along = ownSlope + sum
// share. Adds a neighbour's part of it.
inline void addPull(const Pull& pull, Real slope, Real& along, Vector& g)
{
    const Real share = slope * pull.ratio;
    along += share;
    g = g - pull.fromIt16 * share;
}

// Brightness, extents, tilt and place of a seed that has settled at a position of its path, from the field's gradient there
// (any length, away from the surface) and its root's place from the centre. `over`: 1/256 unit that it is set back besides.
// Returns EyeSide::facing(), more than 0, or if it cannot be seen EyeSide::beforeLimb(); then nothing is changed.
inline int32_t lieOn(const ShadeFrame& f, Seed& s, const Vector& gradient, Real position, int32_t over, const Vector& root)
{
    const Normal normal = normalise(gradient);
    const int32_t cosine = (normal.x * s.dirX + normal.y * s.dirY + normal.z * s.dirZ) >> 14;
    const int32_t facing = f.eye.facing(normal, cosine, position);
    if (f.eye.beforeLimb(facing) <= 0)
        return f.eye.beforeLimb(facing);
    f.normal = normal;
    s.voxel.brightness = f.light.brightness(normal);
    const Vector out = s.path * position;
    const int32_t depth = f.skew.depth(out);
    f.light.extents(s, normal, cosine, position, f.skew.x(out), f.skew.y(out));
    // Blending flattens: the horizon may be farther.
    layDown(normal.x, normal.y, facing, depth, 2 * f.eye.horizon(), s);
    // A scale lies before a round surface, the more the larger it is: set back, so that of two scales the smaller
    // one, which is nearer to its seed, wins. And beyond the border the neighbour's own seeds come first.
    const int32_t back = (mulHigh(s.voxel.wide * s.voxel.wide + s.voxel.high * s.voxel.high, f.setBack) >> 7) + over;
    const Vector place = root + out;
    s.voxel.x = rawFromReal(place.x) >> 8;
    s.voxel.y = rawFromReal(place.y) >> 8;
    s.voxel.z = (rawFromReal(place.z) >> 8) + back;
    return facing;
}

extern "C" {

// The same of a seed whose root is the centre, and whose neighbours' cores are points like its own; the gradient is put
// together from what the last look found.
int32_t shadeSeedC(const ShadeFrame* frame, Seed* seed, Real position, int32_t over);
#if FB_ASM && FB_REAL == FB_FIXED
int32_t shadeSeedA(const ShadeFrame* frame, Seed* seed, Real position, int32_t over);
#endif

}

#if FB_ASM && FB_REAL == FB_FIXED
#define shadeSeed shadeSeedA
#else
#define shadeSeed shadeSeedC
#endif

#endif
