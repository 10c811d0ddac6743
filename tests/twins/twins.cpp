// Assembly against C++: each routine of asm/blit.S, asm/scales.S, asm/voxels.S and asm/fields.S and its twin in
// src/picture/blit.cpp and scales.cpp, src/surface/voxels.cpp and fields.cpp get the same input. All memory that they may write
// must be equal afterwards, with guard bytes around every buffer. A new assembly routine must be tested here before it is used.
//
//   twins [SEED [ROUNDS]]     ROUNDS rounds of random scales, voxels and spans, after the fixed cases
//
// Prints each difference, the number of tests, and "N passed, N failed".
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <initializer_list>

#include "../../src/surface/fields.h"
#include "../../src/surface/voxels.h"
#include "picture/scales.h"

namespace inasm {
#include "../../build/scalesdef.h"
}
namespace inasm2 {
#include "../../build/voxelsdef.h"
}
namespace inasm3 {
#include "../../build/fieldsdef.h"
}
namespace {

constexpr int WIDE = machine::WIDTH;
constexpr int HIGH = machine::HEIGHT;
constexpr int PIXELS = WIDE * HIGH;
constexpr int GUARD = 2048;

// A step of the xorshift generator; its numbers are the same on every machine for the same seed.
uint32_t state;
uint32_t any()
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}
int below(int n) { return static_cast<int>(any() % static_cast<uint32_t>(n)); }
// A number from -most to most.
int around(int most) { return below(2 * most + 1) - most; }
Real realAround(double most) { return realFromRaw(around(static_cast<int>(most * 65536))); }
Vector vectorAround(double most) { return {realAround(most), realAround(most), realAround(most)}; }

// A buffer between two guard areas.
template <class T, int COUNT>
struct Guarded {
    T before[GUARD];
    T data[COUNT];
    T after[GUARD];
};

struct Screen {
    Guarded<uint8_t, PIXELS> frame;
    Guarded<uint16_t, PIXELS> depth;
};

// `misplaced` shifts the whole buffer in memory, so that every alignment is tested.
constexpr int SHIFTS = 16;
struct Room {
    alignas(64) uint8_t bytes[sizeof(Screen) + SHIFTS];
    Screen& at(int shift) { return *reinterpret_cast<Screen*>(bytes + shift); }
};
Room roomC, roomA;

// Each kind of check counts once, however often it is made.
struct Kind {
    const char* name;
    long good, bad;
};
Kind kinds[64];
int kindCount = 0;
long spansTried = 0;

void verdict(bool good, const char* name, long detail)
{
    int k = 0;
    while (k < kindCount && strcmp(kinds[k].name, name) != 0)
        ++k;
    if (k == kindCount)
        kinds[kindCount++] = {name, 0, 0};
    ++(good ? kinds[k].good : kinds[k].bad);
    if (!good && kinds[k].bad <= 3)
        printf("FAIL %s (%ld)\n", name, detail);
}

void fill(void* to, size_t bytes)
{
    uint8_t* byte = static_cast<uint8_t*>(to);
    for (size_t i = 0; i < bytes; ++i)
        byte[i] = static_cast<uint8_t>(any());
}

// Gives both sets of buffers the same contents.
void prepare(int shift, bool empty)
{
    Screen& c = roomC.at(shift);
    fill(&c, sizeof c);
    if (empty)
        memset(c.depth.data, 0xff, sizeof c.depth.data);
    memcpy(&roomA.at(shift), &c, sizeof c);
}

bool same(int shift) { return memcmp(&roomC.at(shift), &roomA.at(shift), sizeof(Screen)) == 0; }

// Tests the runs of a row (none, one, many, at the ends) in all kinds of spans, at every alignment, with drawn pixels around them.
void runs()
{
    static uint8_t row[WIDE + 8 + SHIFTS];
    static uint16_t deep[WIDE + 8 + SHIFTS];
    Span c[WIDE / 2], a[WIDE / 2];
    for (int i = 0; i < 20000; ++i) {
        const int shift = 4 + below(SHIFTS);
        uint8_t* const pixels = row + shift;
        uint16_t* const depths = deep + shift;
        const int farthest = below(3) ? 0x8000 : Z_EMPTY;
        const bool fine = below(4) == 0;
        const int share = below(8);
        for (int x = -4; x < WIDE + 4;) {
            const uint8_t colour = below(8) < share ? static_cast<uint8_t>(1 + below(255)) : 0;
            for (int n = 1 + below(fine ? 3 : below(2) ? 60 : 300); n > 0 && x < WIDE + 4; --n) {
                depths[x] = static_cast<uint16_t>(colour == 0 ? Z_EMPTY : below(farthest));
                pixels[x++] = colour;
            }
        }
        int from = 4 * below(WIDE / 4 + 1), to = 4 * below(WIDE / 4 + 1);
        if (from > to || i % 8 == 0)
            from = 0, to = WIDE;
        const Span within = {static_cast<int16_t>(from), static_cast<int16_t>(to)};
        memset(c, 0x55, sizeof c);
        memset(a, 0x55, sizeof a);
        const int count = drawnRunsC(pixels, depths, &within, c);
        verdict(drawnRunsA(pixels, depths, &within, a) == count && memcmp(c, a, sizeof c) == 0, "runs of drawn pixels", i);
        // The runs must also be right.
        long wrong = 0;
        int x = from;
        for (int k = 0; k < count; ++k) {
            wrong += c[k].from >= c[k].to || (k > 0 && c[k].from == x);
            for (; x < c[k].from; ++x)
                wrong += pixels[x] != 0;
            for (; x < c[k].to; ++x)
                wrong += pixels[x] == 0;
        }
        for (; x < to; ++x)
            wrong += pixels[x] != 0;
        verdict(wrong == 0 && x == to, "runs are all that is drawn", i);
    }
}

// --- Scales of voxels

// Constants that asm/scales.S relies on (build/scalesdef.h holds its own #defines, by tools/tests.mk).
static_assert(inasm::VOXEL_X == offsetof(Voxel, x) && inasm::VOXEL_Y == offsetof(Voxel, y) &&
              inasm::VOXEL_Z == offsetof(Voxel, z) && inasm::VOXEL_HALF_WIDTH == offsetof(Voxel, halfWidth) &&
              inasm::VOXEL_HALF_HEIGHT == offsetof(Voxel, halfHeight) && inasm::VOXEL_TILTX == offsetof(Voxel, tiltX) &&
              inasm::VOXEL_TILTY == offsetof(Voxel, tiltY) && inasm::VOXEL_BRIGHT == offsetof(Voxel, brightness) &&
              inasm::VOXEL_BACK == offsetof(Voxel, back) && inasm::VOXEL_BACK == inasm::VOXEL_BRIGHT + 1 &&
              inasm::VOXEL_CUTX == offsetof(Voxel, cutX) && inasm::VOXEL_CUTX == inasm::VOXEL_BRIGHT + 2 &&
              inasm::VOXEL_CUTY == offsetof(Voxel, cutY) && inasm::VOXEL_CUTY == inasm::VOXEL_BRIGHT + 3 &&
              inasm::VOXEL_SLOPEX == offsetof(Voxel, slopeX) && inasm::VOXEL_SLOPEY == inasm::VOXEL_SLOPEX + 1 &&
              inasm::VOXEL_SLOPEY == offsetof(Voxel, slopeY) && inasm::VOXEL_CUTAT == offsetof(Voxel, cutAt) &&
              inasm::VOXEL_CURVEXX == offsetof(Voxel, curveXX) && inasm::VOXEL_CURVEXY == offsetof(Voxel, curveXY) &&
              inasm::VOXEL_CURVEYY == offsetof(Voxel, curveYY) && inasm::VOXEL_FRONT == offsetof(Voxel, front) &&
              inasm::VOXEL_FRONT == inasm::VOXEL_CURVEXX + 3 && inasm::VOXEL_SIZE == sizeof(Voxel), "Voxel");
static_assert(inasm::FACTOR_X == offsetof(Factors, x) && inasm::FACTOR_Y == offsetof(Factors, y) &&
              inasm::FACTOR_ZX == offsetof(Factors, zx) && inasm::FACTOR_ZY == offsetof(Factors, zy) &&
              inasm::FACTOR_SIZE == sizeof(Factors), "Factors");
static_assert(inasm::LENS_X == offsetof(Lens, x) && inasm::LENS_Y == offsetof(Lens, y) && inasm::LENS_Z == offsetof(Lens, z) &&
              inasm::RAMP == offsetof(Lens, ramp) && inasm::FACTORS == offsetof(Lens, factors) &&
              inasm::CENTREX == offsetof(Lens, centreX) && inasm::CENTREY == offsetof(Lens, centreY) &&
              inasm::FRAME == offsetof(Lens, frame) && inasm::ZBUFFER == offsetof(Lens, zbuffer) &&
              inasm::BOX_LEFT == offsetof(Lens, left) && inasm::BOX_TOP == offsetof(Lens, top) &&
              inasm::BOX_RIGHT == offsetof(Lens, right) && inasm::BOX_BOTTOM == offsetof(Lens, bottom) &&
              inasm::EMPTY == offsetof(Lens, empty) && inasm::TILT_ADD == offsetof(Lens, tiltAdd) &&
              inasm::TILT_BITS == offsetof(Lens, tiltBits) && inasm::FOCALX == offsetof(Lens, focalX) &&
              inasm::FOCALY == offsetof(Lens, focalY) && inasm::LENS_WORDS * 4 == sizeof(Lens), "Lens");
static_assert(inasm::LENS_NEAR == LENS_NEAR && inasm::LENS_FINENESS == LENS_FINENESS &&
                  inasm::FACTOR_SIZE * LENS_FINENESS == 256 && inasm::LENS_FAR == LENS_FAR && inasm::LENS_STEPS == LENS_STEPS &&
                  inasm::STEEPEST == STEEPEST && inasm::LARGEST == LARGEST && inasm::LENS_NEAREST == LENS_NEAREST &&
                  inasm::FACTOR_MOST == FACTOR_MOST && inasm::AVERAGED == AVERAGED && inasm::DOMED == DOMED &&
                  inasm::DOME_MOST == DOME_MOST && inasm::WIDEST_PIXEL == WIDEST_PIXEL && inasm::STEP_OF == STEP_OF &&
                  inasm::STEP_BIAS == STEP_BIAS &&
                  inasm::CUT_MOST == CUT_MOST && inasm::Z_EMPTY == Z_EMPTY && inasm::SCREEN_WIDTH == WIDE &&
                  inasm::SCREEN_HEIGHT == HIGH,
              "constants");

// No depth of a scale in the loop's tables overflows 16 bits. A pixel's centre lies in the rectangle, so it is at most half the
// scale's pixels and half a pixel away from the scale's middle; one more step covers rounding.
constexpr int STEPS_MOST = (inasm::KIND_COLUMNS + 1 + inasm::KIND_ROWS + 1) / 2 * STEEPEST + 1;
static_assert(LENS_NEAR * 128 >= STEPS_MOST && LENS_FAR * 128 + STEPS_MOST + DOME_MOST < Z_EMPTY, "depths");

long voxelsTried = 0, voxelsDrawn = 0;

// A camera, and the lens that the view makes of it, with a table computed here.
struct Optics {
    double focalX, focalY, centreX, centreY;  // pixels
    Factors factors[LENS_STEPS];
    uint8_t ramps[128 + STEP_OF + 256];  // any bytes, with the top bit set or not
    const uint8_t* ramp() const { return ramps + 128; }

    void set(double fx, double fy, double cx, double cy)
    {
        focalX = fx;
        focalY = fy;
        centreX = cx;
        centreY = cy;
        for (int i = 0; i < LENS_STEPS; ++i) {
            const double z = LENS_NEAR + (i + 0.5) / LENS_FINENESS;
            factors[i].x = static_cast<int32_t>(fx * 4096 / z + 0.5);
            factors[i].y = static_cast<int32_t>(fy * 4096 / z + 0.5);
            factors[i].zx = static_cast<int32_t>(z * 32768 / fx);
            factors[i].zy = static_cast<int32_t>(z * 32768 / fy);
        }
        fill(ramps, sizeof ramps);
    }
    void setDemo() { set(250, 625 / 3.0, 160, 100); }
};
Optics optics;

// The demo's camera, or any that the view allows, or factors that no camera makes (none is negative, and products with extents fit
// 32 bits).
void anyOptics()
{
    const double focal = 64 + below(437);
    if (below(2))
        optics.setDemo();
    else
        optics.set(focal, below(2) ? focal / 1.2 < 64 ? 64 : focal / 1.2 : 64 + below(437), below(500) - 90.5, below(400) - 100.25);
    if (below(4))
        return;
    for (Factors& f : optics.factors) {
        f.x = below(65536) >> below(16);
        f.y = below(65536) >> below(16);
        f.zx = static_cast<int32_t>(any() >> (1 + below(31)));
        f.zy = static_cast<int32_t>(any() >> (1 + below(31)));
    }
    // The table's factors must not be smaller than those of nearer depths.
    optics.factors[0].zx = static_cast<int32_t>(LENS_NEAR * 32768 / optics.focalX) + 1;
    optics.factors[0].zy = static_cast<int32_t>(LENS_NEAR * 32768 / optics.focalY) + 1;
}

// Any number; every number of bits is equally likely.
int32_t anything() { return static_cast<int32_t>(any()) >> below(32); }

int32_t minus(int32_t a, int32_t b) { return static_cast<int32_t>(static_cast<uint32_t>(a) - static_cast<uint32_t>(b)); }

// Where a voxel is to appear.
struct Spot {
    int32_t z;                       // 1/256 unit
    double column, row, wide, high;  // middle and size on the screen, pixels
    bool steep;
};

// Anywhere, but often at an edge of the screen, at an end of the table, or of the greatest width or height. A few lie far off the
// screen.
Spot anySpot()
{
    const auto upTo = [](int most) { return below(most * 16) / 16.0; };
    const auto nearly = [](double pixels) { return pixels + around(16) / 8.0; };
    Spot s;
    s.z = LENS_NEAR * 256 + below((LENS_FAR - LENS_NEAR) * 256);
    if (below(16) == 0) {
        s.z = (below(2) ? LENS_NEAR : LENS_FAR) * 256;
        s.z += around(40);
    }
    if (below(8) == 0)
        s.z = below(8) ? 10 * 256 + below((LENS_NEAR - 10) * 256) : below(LENS_NEAR * 256);
    s.column = upTo(WIDE), s.row = upTo(HIGH);
    s.wide = upTo(18), s.high = upTo(18);
    switch (below(8)) {
    case 0: s.wide = upTo(2); break;
    case 1: s.high = upTo(2); break;
    case 2: s.wide = nearly(inasm::KIND_COLUMNS), s.high = below(12); break;
    case 3: s.high = nearly(inasm::KIND_ROWS); break;
    case 4: s.wide = below(8), s.high = below(3) ? below(8) : below(30); break;
    case 5: s.wide = upTo(LARGEST + 2), s.high = upTo(LARGEST + 2); break;
    case 6: (below(2) ? s.wide : s.high) = nearly(LARGEST); break;
    default: break;
    }
    // Some are so large and steep, at an end of the table, that the depth at a corner may overflow 16 bits.
    s.steep = below(10) == 0;
    if (s.steep) {
        s.z = below(2) ? LENS_NEAR * 256 + below(24 * 256) : LENS_FAR * 256 - 1 - below(24 * 256);
        s.wide = 20 + upTo(20), s.high = 20 + upTo(20);
        s.column = LARGEST + below(WIDE - 2 * LARGEST), s.row = LARGEST + below(HIGH - 2 * LARGEST);
    }
    if (below(8) == 0)
        s.column = nearly(below(2) ? s.wide / 2 : WIDE - s.wide / 2);
    if (below(8) == 0)
        s.row = nearly(below(2) ? s.high / 2 : HIGH - s.high / 2);
    return s;
}

// A value of Voxel::back or front.
uint8_t anyEnd() { return static_cast<uint8_t>(any() >> (24 + below(6))); }

// Sets brightness, ends and cut function of a voxel with known half extents.
void addShading(Voxel* v)
{
    const auto slope = [] { return static_cast<int8_t>(anything()); };
    v->brightness = static_cast<int8_t>(below(64));
    v->back = below(2) ? 0 : anyEnd();
    v->slopeX = v->slopeY = 0;
    if (below(2) == 0) {
        v->slopeX = static_cast<int8_t>(any());
        v->slopeY = static_cast<int8_t>(any());
        // A voxel with slopes of brightness may be dark in the middle.
        if (below(3) == 0 && (v->slopeX | v->slopeY) != 0)
            v->brightness = static_cast<int8_t>(DARK_MIDDLE + below(-DARK_MIDDLE));
    }
    v->cutX = v->cutY = 0;
    v->cutAt = static_cast<int16_t>(anything());
    v->curveXX = v->curveXY = v->curveYY = 0;
    v->front = anyEnd();
    if (below(4) != 0)
        return;
    if (below(4) == 0) {
        cutNowhere(v);
        return;
    }
    v->cutX = slope();
    v->cutY = slope();
    // The line of the cut often lies within the scale.
    const int corner = magnitude(v->cutX) * v->halfWidth / 256 + magnitude(v->cutY) * v->halfHeight / 256;
    if (below(8) && corner < 4000)
        v->cutAt = static_cast<int16_t>(around(corner) * 8);
    if (below(2)) {
        v->curveXX = slope();
        v->curveXY = slope();
        v->curveYY = slope();
    }
}

// Gives a field of a few voxels an unusual value.
void addOddity(Voxel* v)
{
    switch (below(50)) {
    case 0: v->x = anything(); break;
    case 1: v->y = anything(); break;
    case 2: v->z = anything(); break;
    case 3: v->halfWidth = static_cast<int16_t>(anything()); break;
    case 4: v->halfHeight = static_cast<int16_t>(anything()); break;
    case 5: v->halfWidth = 0; break;
    case 6: v->halfHeight = 0; break;
    case 7: v->brightness = static_cast<int8_t>(any() & 127); break;
    case 8: v->tiltX = static_cast<int16_t>(32767 * (below(2) ? 1 : -1)); break;
    case 9: v->tiltY = static_cast<int16_t>(32767 * (below(2) ? 1 : -1)); break;
    default: break;
    }
}

// Makes a voxel in the coordinates of the lens.
Voxel anyVoxel(const Lens& lens)
{
    const Spot s = anySpot();
    const auto extent = [](double e) { return static_cast<int16_t>(e < 0 ? 0 : e > 32767 ? 32767 : e); };
    const auto tilt = [] { return static_cast<int16_t>(below(3) == 0 ? anything() : around(600)); };
    const auto steepTilt = [] { return static_cast<int16_t>((below(2) ? 1 : -1) * below(4000)); };
    Voxel v;
    fill(&v, sizeof v);  // also the bytes that belong to no field
    v.x = static_cast<int32_t>((s.column - optics.centreX) * s.z / optics.focalX);
    v.y = static_cast<int32_t>((optics.centreY - s.row) * s.z / optics.focalY);
    v.z = s.z;
    v.halfWidth = extent(s.wide / 2 * s.z / optics.focalX);
    v.halfHeight = extent(s.high / 2 * s.z / optics.focalY);
    v.tiltX = tilt();
    v.tiltY = tilt();
    if (s.steep) {
        v.tiltX = steepTilt();
        v.tiltY = steepTilt();
    }
    addShading(&v);
    addOddity(&v);
    v.x = minus(v.x, lens.x);
    v.y = minus(v.y, lens.y);
    v.z = minus(v.z, lens.z);
    return v;
}

// A lens between guard areas.
struct Fenced {
    uint8_t before[64];
    Lens lens;
    uint8_t after[64];
};

void makeLens(Fenced& c, Fenced& a, int shift)
{
    fill(&c, sizeof c);
    Lens& lens = c.lens;
    // Most objects lie in front of the viewer, the rest anywhere.
    lens.x = below(20) ? below(40000) - 20000 : anything();
    lens.y = below(20) ? below(40000) - 20000 : anything();
    lens.z = below(20) ? below(65536) : anything();
    lens.ramp = optics.ramp();
    lens.factors = optics.factors;
    lens.focalX = static_cast<int32_t>(optics.focalX * 4096);
    lens.focalY = static_cast<int32_t>(optics.focalY * 4096);
    lens.centreX = static_cast<int32_t>(optics.centreX * 4096) + 2048;
    lens.centreY = static_cast<int32_t>(optics.centreY * 4096) + 2048;
    lens.left = below(2) ? WIDE : below(WIDE);
    lens.top = below(2) ? HIGH : below(HIGH);
    lens.right = below(2) ? 0 : below(WIDE);
    lens.bottom = below(2) ? 0 : below(HIGH);
    lens.empty = below(1000);
    uint32_t most = 0;
    for (const Factors& f : optics.factors) {
        most = static_cast<uint32_t>(f.zx) > most ? static_cast<uint32_t>(f.zx) : most;
        most = static_cast<uint32_t>(f.zy) > most ? static_cast<uint32_t>(f.zy) : most;
    }
    limitTilts(&lens, most);
    memcpy(&a, &c, sizeof c);
    c.lens.frame = roomC.at(shift).frame.data;
    c.lens.zbuffer = roomC.at(shift).depth.data;
    a.lens.frame = roomA.at(shift).frame.data;
    a.lens.zbuffer = roomA.at(shift).depth.data;
}

bool sameLens(const Fenced& c, const Fenced& a, int shift)
{
    Fenced like = a;
    like.lens.frame = roomC.at(shift).frame.data;
    like.lens.zbuffer = roomC.at(shift).depth.data;
    return a.lens.frame == roomA.at(shift).frame.data && a.lens.zbuffer == roomA.at(shift).depth.data &&
           memcmp(&like, &c, sizeof c) == 0;
}

void voxelLists(int rounds)
{
    constexpr int MOST = 600;
    static Guarded<Voxel, MOST> list, before;
    static Optics opticsBefore;
    static Fenced c, a;
    for (int round = 0; round < rounds; ++round) {
        const int shift = below(SHIFTS);
        prepare(shift, below(2) == 0);
        anyOptics();
        makeLens(c, a, shift);
        const int count = below(8) == 0 ? below(3) : below(below(4) == 0 ? MOST : 60);
        fill(&list, sizeof list);
        for (int i = 0; i < count; ++i) {
            list.data[i] = anyVoxel(c.lens);
            if (i > 0 && below(4) == 0) {  // the same depths in another colour
                list.data[i] = list.data[below(i)];
                list.data[i].brightness ^= 1;
            }
        }
        memcpy(&before, &list, sizeof list);
        memcpy(&opticsBefore, &optics, sizeof optics);
        // A voxel that the loop has left is skipped, as in the view.
        bool agree = true;
        const Voxel* const end = list.data + count;
        for (const Voxel* at = list.data; at <= end; ++at) {
            const Voxel* const nextC = drawScalesC(&c.lens, at, end);
            const Voxel* const nextA = drawScalesA(&a.lens, at, end);
            agree = agree && nextC == nextA && nextA >= at && nextA <= end;
            if (!agree)
                break;
            voxelsDrawn += nextC - at;
            at = nextC;
        }
        verdict(agree, "voxels: both stop at the same one, round", round);
        verdict(same(shift), "voxels: frame and Z-buffer, round", round);
        verdict(sameLens(c, a, shift), "voxels: the lens, round", round);
        verdict(memcmp(&before, &list, sizeof list) == 0 &&
                    memcmp(&opticsBefore, &optics, sizeof optics) == 0,
                "voxels: list and table are left alone, round", round);
        voxelsTried += count;
    }
}

// --- Voxels one by one, compared with the projection in double precision. Within the rounding error (the loop's numbers have 12
// fraction bits, and its factors change by steps of 1/16 unit) either result is right; what is right in any case is "sure".

double larger(double a, double b) { return fabs(a) > fabs(b) ? fabs(a) : fabs(b); }

// A number in double precision, and how far the loop's number may be from it.
struct Estimate {
    double value, doubt;
    double least() const { return value - doubt; }
    double most() const { return value + doubt; }
};
Estimate operator+(Estimate a, Estimate b) { return {a.value + b.value, a.doubt + b.doubt}; }

// A voxel's scale along one axis of the screen.
struct Axis {
    double unit;          // units in a pixel at the voxel's depth; negative if the view's axis has the other direction
    double middle, half;  // middle and half extent, pixels
    double doubt;         // of both ends, pixels
    long leastFrom, mostFrom, leastTo, mostTo;  // bounds of the pixels whose centres lie between the ends
    double slope;         // change of depth from pixel to pixel, 1/128 unit, STEEPEST at most

    Axis(double centre, double units, double place, int halfExtent, int tilt)
        : unit(units), middle(centre + place / unit), half(halfExtent / 256.0 / fabs(unit)),
          doubt(0.01 + 0.0006 * larger(middle - half - centre, middle + half - centre)),
          leastFrom(first(middle - half - doubt)), mostFrom(first(middle - half + doubt)),
          leastTo(first(middle + half - doubt)), mostTo(first(middle + half + doubt)),
          slope(fmax(-STEEPEST, fmin(tilt / 2.0 * unit, STEEPEST))) {}
    static long first(double end) { return static_cast<long>(ceil(end - 0.5)); }

    bool mayHold(int pixel) const { return pixel >= leastFrom && pixel < mostTo; }
    bool surelyHolds(int pixel) const { return pixel >= mostFrom && pixel < leastTo; }
    long leastLength() const { return leastTo - mostFrom; }
    long mostLength() const { return mostTo - leastFrom; }
    bool surelyWhole(int screen) const { return leastFrom >= 0 && mostTo <= screen; }
    bool surelySeen(int screen) const { return mostFrom < leastTo && mostFrom < screen && leastTo > 0; }
    // Bounds of the change of depth from the middle to the last pixel. The loop's slopes are whole 1/128 units.
    double leastSwing() const { return fabs(slope) * 0.998 * (half - 1 - doubt) - leastLength(); }
    double mostSwing(bool tame) const { return (tame ? fabs(slope) * 1.001 + 1 : STEEPEST) * (half + doubt); }
    double depthDoubt(double d) const { return fabs(d) * (1 + 0.001 * fabs(slope)) + mostLength() + doubt * fabs(slope); }
};

// What double precision makes of a voxel for which the loop has factors. (dx, dy) leads from the middle of the scale to a pixel's
// centre.
struct Ideal {
    const Voxel& v;
    double depth;  // of the middle, 1/128 unit
    Axis x, y;
    bool tame;     // the tilts are within 16; the products of greater ones may overflow, so that depths are unknown

    Ideal(const Lens& lens, const Voxel& voxel)
        : v(voxel), depth(wrappedSum(lens.z, v.z) / 2.0),
          x(optics.centreX, depth / 128 / optics.focalX, wrappedSum(lens.x, v.x) / 256.0, v.halfWidth, v.tiltX),
          y(optics.centreY, -depth / 128 / optics.focalY, wrappedSum(lens.y, v.y) / 256.0, v.halfHeight, v.tiltY),
          tame(larger(v.tiltX, v.tiltY) <= 16 * 256) {}

    bool surelyWhole() const { return x.surelyWhole(WIDE) && y.surelyWhole(HIGH); }
    bool surelySeen() const { return x.surelySeen(WIDE) && y.surelySeen(HIGH); }
    bool surelyFits() const
    {
        const double swing = x.mostSwing(tame) + y.mostSwing(tame) + 2;
        return depth - swing >= 0 && depth + swing < Z_EMPTY - DOME_MOST;
    }
    bool surelyOverflows() const
    {
        const double swing = x.leastSwing() + y.leastSwing() - 2;
        return tame && x.leastLength() > 0 && y.leastLength() > 0 && (depth - swing < 0 || depth + swing > Z_EMPTY);
    }
    bool surelySmall() const { return x.mostLength() <= LARGEST && y.mostLength() <= LARGEST; }
    bool surelyLarge() const { return x.leastLength() > LARGEST || (x.surelySeen(WIDE) && y.leastLength() > LARGEST); }

    // A scale with a straight cut is domed: half of its dome is added at a distance of a pixel. The dome and its half are rounded
    // down, and they change the slopes by whole numbers. A dome lies aside by as much as the middle of its scale is in doubt.
    Estimate domeAt(double dx, double dy) const
    {
        if (!isCut(v) || isCurved() || v.halfWidth > DOMED * 256 || v.halfHeight > DOMED * 256)
            return {0, 0};
        const double square = dx * dx + dy * dy, dome = 40 * x.unit * x.unit;
        const double aside = 2 * dome * (fabs(dx) * x.doubt + fabs(dy) * y.doubt);
        return {dome * square, 0.6 * square + 1.5 * (fabs(dx) + fabs(dy)) + aside};
    }
    Estimate depthAt(double dx, double dy) const
    {
        const Estimate flat{depth + x.slope * dx + y.slope * dy, 2 + x.depthDoubt(dx) + y.depthDoubt(dy)};
        return flat + domeAt(dx, dy);
    }
    // Whether a depth lies between where the voxel begins and where it ends.
    bool surelyWithin(Estimate at) const
    {
        return v.back == 0 || (tame && at.least() > depth - v.front * 4 && at.most() < depth + v.back * 4);
    }
    bool surelyBeyond(Estimate at) const
    {
        return v.back != 0 && tame && (at.most() < depth - v.front * 4 || at.least() > depth + v.back * 4);
    }

    // A function with these slopes, 1/8 per unit. It changes from pixel to pixel by whole multiples of 1/256, and lengths are
    // accurate to a thousandth.
    Estimate linearAt(double middle, int slopeX, int slopeY, double dx, double dy) const
    {
        const double slopes = (fabs(slopeX) + fabs(slopeY)) / 8;
        return {middle + (slopeX * dx * x.unit + slopeY * dy * y.unit) / 8,
                0.01 + (fabs(dx) + fabs(dy)) / 256 + 0.0021 * slopes * (larger(dx, dy) + 800 * (x.doubt + y.doubt)) * x.unit};
    }
    bool isCurved() const { return (v.curveXX | v.curveXY | v.curveYY) != 0; }
    // The change of the cut function from the middle to a corner.
    double cutSwing() const
    {
        const double cornerX = v.halfWidth / 256.0 + fabs(x.unit), cornerY = v.halfHeight / 256.0 + fabs(y.unit);
        return (fabs(v.cutX) * cornerX + fabs(v.cutY) * cornerY) / 8 +
               (fabs(v.curveXX) * cornerX * cornerX + 2 * fabs(v.curveXY) * cornerX * cornerY +
                fabs(v.curveYY) * cornerY * cornerY) / 16;
    }
    // The quadratic part of the cut function; its steps themselves change by rounded steps. The products of a function that changes
    // too much may overflow.
    Estimate curveAt(double dx, double dy) const
    {
        if (!isCurved())
            return {0, 0};
        const double ux = dx * x.unit, uy = dy * y.unit, far = larger(ux, uy), doubt = (x.doubt + y.doubt) * x.unit;
        const double curves = (larger(v.curveXX, v.curveYY) + fabs(v.curveXY)) / 16;
        return {(v.curveXX * ux * ux + 2 * v.curveXY * ux * uy + v.curveYY * uy * uy) / 32,
                (cutSwing() > 1000 ? 1e9 : 0) + (dx * dx + dy * dy + 3 * larger(dx, dy)) / 128 +
                    curves * (0.006 * (far + 2 * doubt) * (far + 2 * doubt) + doubt * far)};
    }
    Estimate cutAt(double dx, double dy) const
    {
        return isCut(v) ? linearAt(v.cutAt / 64.0, v.cutX, v.cutY, dx, dy) + curveAt(dx, dy) : Estimate{0, 0};
    }
    bool mayHaveColour(int colour, double dx, double dy) const
    {
        const bool plain = (v.slopeX | v.slopeY) == 0;
        const Estimate shade = plain ? Estimate{1.0 * v.brightness, 0} : linearAt(v.brightness, v.slopeX, v.slopeY, dx, dy);
        for (double b = floor(shade.least() + 0.5); b <= floor(shade.most() + 0.5); ++b)
            if (colour == optics.ramp()[static_cast<int8_t>(static_cast<int>(b))])
                return true;
        return false;
    }
};

// Counts of faults, and of the cases in which there could have been one.
struct VoxelTally {
    long wrongStops, wrongPixels, wrongEnds, wrongCuts, wrongShades, wrongDepths, wrongBoxes, wrongEmpties;
    long drawn, stopped, empty, nearOnes, clipped, deep, shaded, cutOff, cutKept;
};

// Compares a pixel that is drawn with what it should be.
void checkDrawn(const Ideal& ideal, int column, int row, int colour, int z, VoxelTally* t)
{
    const double dx = column + 0.5 - ideal.x.middle, dy = row + 0.5 - ideal.y.middle;
    const Estimate depth = ideal.depthAt(dx, dy);
    t->wrongPixels += !ideal.x.mayHold(column) || !ideal.y.mayHold(row);
    t->wrongCuts += ideal.cutAt(dx, dy).most() < 0;
    t->wrongEnds += ideal.surelyBeyond(depth);
    t->wrongDepths += ideal.tame && fabs(z - depth.value) > depth.doubt;
    t->wrongShades += !ideal.mayHaveColour(colour, dx, dy);
    t->shaded += (ideal.v.slopeX | ideal.v.slopeY) != 0;
    t->cutKept += isCut(ideal.v);
}

// Looks for a reason why a pixel that surely lies in the rectangle of a drawn voxel is not drawn.
void checkMissing(const Ideal& ideal, int column, int row, VoxelTally* t)
{
    const double dx = column + 0.5 - ideal.x.middle, dy = row + 0.5 - ideal.y.middle;
    const Estimate cut = ideal.cutAt(dx, dy);
    t->cutOff += cut.most() < 0;
    t->wrongPixels += cut.least() >= 0 && ideal.surelyWithin(ideal.depthAt(dx, dy));
}

// Compares all pixels, and clears the screen for the next voxel. Returns how many were drawn.
long checkPixels(const Ideal& ideal, const Lens& lens, bool done, VoxelTally* t)
{
    Screen& screen = roomA.at(0);
    long pixels = 0;
    for (int row = 0; row < HIGH; ++row)
        for (int column = 0; column < WIDE; ++column) {
            uint8_t& colour = screen.frame.data[row * WIDE + column];
            uint16_t& z = screen.depth.data[row * WIDE + column];
            if (z == Z_EMPTY) {
                t->wrongPixels += colour != 0;
                if (done && ideal.x.surelyHolds(column) && ideal.y.surelyHolds(row))
                    checkMissing(ideal, column, row, t);
                continue;
            }
            ++pixels;
            t->wrongPixels += !done;
            t->wrongBoxes += column < lens.left || column >= lens.right || row < lens.top || row >= lens.bottom;
            checkDrawn(ideal, column, row, colour, z, t);
            z = Z_EMPTY;
            colour = 0;
        }
    return pixels;
}

// Compares what became of a voxel: whether the loop left it to its caller (`done` is false then), counted it as empty, or drew it.
void checkVoxel(const Ideal& ideal, const Lens& lens, bool done, VoxelTally* t)
{
    const bool sound = ideal.v.halfWidth >= 0 && ideal.v.halfHeight >= 0;
    const bool whole = ideal.surelyWhole(), seen = ideal.surelySeen(), overflows = whole && ideal.surelyOverflows();
    t->wrongStops += sound && (done ? ideal.surelyLarge() || overflows : ideal.surelySmall() && ideal.surelyFits());
    t->wrongEmpties += sound && lens.empty != 0 && (!done || lens.empty != 1 || seen);
    const long pixels = checkPixels(ideal, lens, done, t);
    t->wrongEmpties += sound && done && ideal.v.back == 0 && !isCut(ideal.v) && (pixels == 0) != (lens.empty == 1);
    t->drawn += pixels > 0;
    t->empty += lens.empty;
    t->clipped += !whole && seen && done;
    t->deep += overflows && ideal.surelySmall();
}

// Whether the products of a voxel's position fit, which the loop's callers guarantee.
bool isAllowed(const Lens& lens, const Voxel& v)
{
    Factors computed;
    const Factors* const f = factorsOf(lens, wrappedSum(lens.z, v.z), &computed);
    const auto fits = [](int32_t place, int32_t factor) {
        return static_cast<int32_t>(1LL * place * factor) == 1LL * place * factor;
    };
    return f == nullptr || (fits(wrappedSum(lens.x, v.x), f->x) && fits(wrappedSum(lens.y, v.y), f->y));
}

// Whether the loop has factors for a depth, 1/256 unit.
bool hasFactors(int32_t depth)
{
    return depth >= LENS_NEAREST * 256 && depth < LENS_FAR * 256 &&
           (depth >= LENS_NEAR * 256 || larger(optics.focalX, optics.focalY) * 4096 * 256 / depth < FACTOR_MOST + 1);
}

// Draws each voxel on an empty screen, and compares whether the loop draws it at all, which pixels it draws, and their depth and
// colour.
void voxelByVoxel(int rounds)
{
    static Fenced c, a;
    prepare(0, true);
    memset(roomA.at(0).frame.data, 0, sizeof roomA.at(0).frame.data);
    VoxelTally t{};
    for (int round = 0; round < rounds; ++round) {
        if (round % 16 == 0) {
            const double focal = 100 + below(300);
            if (round % 32 == 0)
                optics.setDemo();
            else
                optics.set(focal, focal / 1.2, below(320), below(200));
            for (int i = 0; i < 128 + STEP_OF; ++i)
                optics.ramps[i] = static_cast<uint8_t>(5 * i + 7);
            memset(optics.ramps + 128 + STEP_OF, 0, 256);
        }
        makeLens(c, a, 0);
        a.lens.left = WIDE;
        a.lens.top = HIGH;
        a.lens.right = a.lens.bottom = a.lens.empty = 0;
        const Voxel v = anyVoxel(a.lens);
        if (!isAllowed(a.lens, v))
            continue;
        const bool done = drawScalesA(&a.lens, &v, &v + 1) != &v;
        const int32_t depth = wrappedSum(a.lens.z, v.z);
        if (hasFactors(depth))
            checkVoxel(Ideal(a.lens, v), a.lens, done, &t);
        else
            t.wrongStops += done;
        t.stopped += !done;
        t.nearOnes += done && depth < LENS_NEAR * 256;
        ++voxelsTried;
    }
    verdict(t.wrongStops == 0, "voxels: ordinary ones are drawn, others are left", t.wrongStops);
    verdict(t.wrongPixels == 0, "voxels: pixels as in double precision", t.wrongPixels);
    verdict(t.wrongEnds == 0, "voxels: nothing before or behind where they end", t.wrongEnds);
    verdict(t.wrongCuts == 0 && t.cutOff > rounds && t.cutKept > rounds, "voxels: cut as in double precision", t.wrongCuts);
    verdict(t.wrongShades == 0 && t.shaded > rounds, "voxels: brightness as in double precision", t.wrongShades);
    verdict(t.wrongDepths == 0, "voxels: depths as in double precision", t.wrongDepths);
    verdict(t.wrongBoxes == 0, "voxels: the rectangle holds what is drawn", t.wrongBoxes);
    verdict(t.wrongEmpties == 0, "voxels: those without a pixel are counted", t.wrongEmpties);
    verdict(t.drawn > rounds / 3 && t.deep > rounds / 200 && t.nearOnes > rounds / 50 && t.clipped > rounds / 50 &&
                t.stopped > rounds / 20 && t.empty > rounds / 100,
            "voxels: there were some of each kind", t.drawn);
}

// Makes spans of all kinds: empty, the whole row, short ones at the ends.
void spans(Span* rows)
{
    for (int y = 0; y < HIGH; ++y) {
        int from = 4 * below(WIDE / 4 + 1), to = 4 * below(WIDE / 4 + 1);
        switch (below(8)) {
        case 0: from = WIDE, to = 0; break;
        case 1: from = 0, to = WIDE; break;
        case 2: to = from; break;
        case 3: from = 0, to = 4; break;
        case 4: from = WIDE - 4, to = WIDE; break;
        default: break;
        }
        rows[y].from = static_cast<int16_t>(from);
        rows[y].to = static_cast<int16_t>(to);
    }
}

// The selector of the program's data, which stands in for that of video memory.
uint32_t dataSelector()
{
    uint32_t selector;
    asm("movl %%ds, %0" : "=r"(selector));
    return selector & 0xffff;
}

// Calls a routine with up to five words of arguments. Returns 0 if it preserves the registers that its caller relies on and leaves
// the direction flag clear.
uint32_t damage(const void* routine, const uint32_t arguments[5])
{
    uint32_t bad;
    const void* a = routine;
    const uint32_t* c = arguments;
    asm volatile(
        "pushl %%ebp\n\tpushl %%ebx\n\tpushl %%esi\n\tpushl %%edi\n\t"
        "pushl 16(%%ecx)\n\tpushl 12(%%ecx)\n\tpushl 8(%%ecx)\n\tpushl 4(%%ecx)\n\tpushl (%%ecx)\n\t"
        "movl $0x11223344, %%ebx\n\tmovl $0x55667788, %%esi\n\tmovl $0x99aabbcc, %%edi\n\tmovl $0xddeeff01, %%ebp\n\t"
        "call *%%eax\n\t"
        "addl $20, %%esp\n\t"
        "xorl $0x11223344, %%ebx\n\txorl $0x55667788, %%esi\n\txorl $0x99aabbcc, %%edi\n\txorl $0xddeeff01, %%ebp\n\t"
        "orl %%esi, %%ebx\n\torl %%edi, %%ebx\n\torl %%ebp, %%ebx\n\t"
        "pushfl\n\tpopl %%eax\n\tandl $0x400, %%eax\n\torl %%ebx, %%eax\n\tcld\n\t"
        "popl %%edi\n\tpopl %%esi\n\tpopl %%ebx\n\tpopl %%ebp"
        : "=a"(bad), "+c"(c)
        : "0"(a)
        : "edx", "memory", "cc");
    return bad;
}

uint32_t word(const void* pointer) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(pointer)); }

// The message is "registers are kept: " and the routine's name.
template <class Routine>
void checkRegisters(const char* message, Routine* routine, const uint32_t (&arguments)[5], uint32_t count)
{
    verdict(damage(reinterpret_cast<const void*>(routine), arguments) == 0, message, count);
}

// Makes 40 seeds, and a viewer who sees them all.
Shading allSeen(Seen* seen, const Vector* root)
{
    static Seed seeds[40];
    for (int i = 0; i < 40; ++i) {
        fill(seeds + i, sizeof seeds[i]);
        seeds[i].root = 0;
        seen[i] = {seeds + i, 1000 + below(30000)};
    }
    Shading shading{};
    shading.seeds = seeds;
    shading.roots = root;
    shading.depth = 30000 << 8;
    shading.turned = 1;
    shading.limb = -0x7fffffff;
    return shading;
}

void registers()
{
    prepare(0, true);
    Screen& a = roomA.at(0);
    static Fenced c, f;
    anyOptics();
    makeLens(c, f, 0);
    static Voxel voxels[40];
    for (Voxel& v : voxels)
        v = anyVoxel(f.lens);
    static Span rows[HIGH];
    spans(rows);
    static Span runs[WIDE / 2];
    static Seen seen[40];
    static Vector root;
    const Shading shading = allSeen(seen, &root);
    for (uint32_t count : {0u, 1u, 40u}) {
        for (uint32_t i = 0; i < 40; ++i) {
            // Start at each voxel: some calls stop at once, others go on.
            checkRegisters("registers are kept: drawScalesA", drawScalesA,
                           {word(&f.lens), word(voxels + i), word(voxels + (i + count < 40 ? i + count : 40))}, count);
        }
        checkRegisters("registers are kept: presentRows", presentRows,
                       {dataSelector(), word(roomC.at(0).frame.data), word(a.frame.data), word(rows), count * 5}, count);
        static Patch patch;
        patch.count[0] = patch.count[2] = static_cast<uint8_t>(count / 2);
        checkRegisters("registers are kept: findSeedsA", findSeedsA,
                       {word(&shading), word(&patch), word(seen), word(voxels)}, count);
        checkRegisters("registers are kept: shadeSeedsA", shadeSeedsA, {word(&shading), word(seen), word(voxels), count}, count);
        static Neighbour near;
        near.kind = count % 2 == 0 ? Along::POINT : Along::SEGMENT;
        static Neighbour* list[40];
        for (Neighbour*& item : list)
            item = &near;
        static Fields sums;
        checkRegisters("registers are kept: addFieldsA", addFieldsA,
                       {word(list), word(list + count), 65536, word(&root), word(&sums)}, count);
        const Span within = {0, static_cast<int16_t>(8 * count)};
        checkRegisters("registers are kept: drawnRunsA", drawnRunsA,
                       {word(a.frame.data), word(a.depth.data), word(&within), word(runs)}, count);
    }
}

void clearsAndCopies(int rounds)
{
    static Span rows[HIGH];
    for (int round = 0; round < rounds; ++round) {
        // In the program frames are aligned to 32-bit words at least; here they have any alignment.
        const int shift = below(SHIFTS);
        const int count = round % 5 == 0 ? below(HIGH + 1) : HIGH;
        spans(rows);
        Span kept[HIGH];
        memcpy(kept, rows, sizeof rows);
        prepare(shift, false);
        Screen& c = roomC.at(shift);
        Screen& a = roomA.at(shift);
        clearRows(a.frame.data, a.depth.data, rows, count);
        long wrong = 0;
        for (int y = 0; y < count; ++y)
            for (int x = rows[y].from; x < rows[y].to; ++x)
                wrong += a.frame.data[y * WIDE + x] != 0 || a.depth.data[y * WIDE + x] != Z_EMPTY;
        verdict(wrong == 0, "what a clear leaves", wrong);

        // One screen is the source for both copies; the other buffers are the two destinations.
        static Guarded<uint8_t, PIXELS> screenC, screenA, before;
        fill(&screenC, sizeof screenC);
        memcpy(&screenA, &screenC, sizeof screenC);
        memcpy(&before, &screenC, sizeof screenC);
        fill(&c.frame, sizeof c.frame);
        memcpy(&a.frame, &c.frame, sizeof c.frame);
        copyRowsC(screenC.data, c.frame.data, rows, count);
        presentRows(dataSelector(), static_cast<uint32_t>(reinterpret_cast<uintptr_t>(screenA.data)), c.frame.data, rows,
                    count);
        verdict(memcmp(&screenC, &screenA, sizeof screenC) == 0, "presents, round", round);
        verdict(memcmp(&c.frame, &a.frame, sizeof c.frame) == 0, "a present leaves its source alone", round);
        wrong = 0;
        for (int y = 0; y < HIGH; ++y)
            for (int x = 0; x < WIDE; ++x) {
                const bool in = y < count && x >= rows[y].from && x < rows[y].to;
                wrong += screenA.data[y * WIDE + x] != (in ? c.frame.data : before.data)[y * WIDE + x];
            }
        verdict(wrong == 0, "what a present leaves", wrong);
        verdict(memcmp(kept, rows, sizeof rows) == 0, "the spans are left alone", round);
        spansTried += count;
    }
}

// --- Seeds

// Constants that asm/voxels.S relies on.
static_assert(inasm2::SEED_PATH == offsetof(Seed, path) && inasm2::SEED_POSITION == offsetof(Seed, position) &&
              inasm2::SEED_NORMAL == offsetof(Seed, normal) && inasm2::SEED_PLACE == offsetof(Seed, place) &&
              inasm2::SEED_OUT == offsetof(Seed, out) &&
              inasm2::SEED_ROOT == offsetof(Seed, root) && inasm2::SEED_FLAGS == offsetof(Seed, flags) &&
              inasm2::SEED_ALONG == offsetof(Seed, along) && inasm2::SEED_ACROSS == offsetof(Seed, across) &&
              inasm2::SEED_WAY == offsetof(Seed, way) && inasm2::SEED_AREA == offsetof(Seed, area) &&
              inasm2::SEED_SIZE == sizeof(Seed) && 1 << inasm2::SEED_SHIFT == sizeof(Seed), "Seed");
static_assert(inasm2::SEED_VALID == ::SEED_VALID && inasm2::SEED_RESTING == ::SEED_RESTING, "states of seeds");
static_assert(inasm2::PATCH_FIRST == offsetof(Patch, first) && inasm2::PATCH_COUNT == offsetof(Patch, count) &&
              inasm2::PATCH_RINGS == ::PATCH_RINGS, "Patch");
static_assert(inasm2::VOXEL_X == offsetof(Voxel, x) && inasm2::VOXEL_Y == offsetof(Voxel, y) &&
              inasm2::VOXEL_Z == offsetof(Voxel, z) && inasm2::VOXEL_HALF_WIDTH == offsetof(Voxel, halfWidth) &&
              inasm2::VOXEL_HALF_HEIGHT == offsetof(Voxel, halfHeight) && inasm2::VOXEL_TILTX == offsetof(Voxel, tiltX) &&
              inasm2::VOXEL_TILTY == offsetof(Voxel, tiltY) && inasm2::VOXEL_BRIGHT == offsetof(Voxel, brightness) &&
              inasm2::VOXEL_BACK == offsetof(Voxel, back) && inasm2::VOXEL_SLOPEX == offsetof(Voxel, slopeX) &&
              inasm2::VOXEL_SLOPEY == offsetof(Voxel, slopeY) && inasm2::VOXEL_CURVE == offsetof(Voxel, curveXX) &&
              inasm2::VOXEL_FRONT == offsetof(Voxel, front) && inasm2::VOXEL_SIZE == sizeof(Voxel), "Voxel");
static_assert(inasm2::SEEN_SEED == offsetof(Seen, seed) && inasm2::SEEN_FACING == offsetof(Seen, facing) &&
              inasm2::SEEN_SIZE == sizeof(Seen), "Seen");
static_assert(inasm2::SEEDS == offsetof(Shading, seeds) && inasm2::ROOTS == offsetof(Shading, roots) &&
              inasm2::PLACE_SHIFT == offsetof(Shading, placeShift) && inasm2::EYE == offsetof(Shading, eye) &&
              inasm2::LIGHT == offsetof(Shading, light) &&
              inasm2::LIMB == offsetof(Shading, limb) && inasm2::TURNED == offsetof(Shading, turned) &&
              inasm2::RIGHT == offsetof(Shading, right) && inasm2::UP == offsetof(Shading, up) &&
              inasm2::TO_RIGHT == offsetof(Shading, toRight) && inasm2::TO_UP == offsetof(Shading, toUp) &&
              inasm2::TO_AHEAD == offsetof(Shading, toAhead) && inasm2::DEPTH == offsetof(Shading, depth) &&
              inasm2::LEAST_POSITION == offsetof(Shading, leastPosition) && inasm2::CELL == offsetof(Shading, cell) &&
              inasm2::CELL_SHIFT == offsetof(Shading, cellShift) && inasm2::AREA_SHARE == offsetof(Shading, areaShare) &&
              inasm2::WHOLE_BEFORE == offsetof(Shading, wholeBefore) &&
              inasm2::DEEPEST == offsetof(Shading, deepest) && inasm2::FRONT == offsetof(Shading, front) &&
              inasm2::HORIZON == offsetof(Shading, horizonShare) &&
              inasm2::GRADIENT == offsetof(Shading, gradient) && inasm2::AHEAD == offsetof(Shading, gradientAhead), "Shading");
static_assert(inasm2::STEEPEST_TILT == STEEPEST_TILT && inasm2::MARGIN_SHIFT == MARGIN_SHIFT &&
              inasm2::MARGIN_UNITS == MARGIN_UNITS && inasm2::FLAT_SHADING == FLAT_SHADING &&
              inasm2::STEEPEST_SHADING == STEEPEST_SHADING && inasm2::LEAST_COSINE == LEAST_COSINE && inasm2::ASLANT == ASLANT &&
              inasm2::AREA_MOST == AREA_MOST && inasm2::BRIGHTEST == BRIGHTEST, "constants of shading");

constexpr int SEEDS = 18, ROOTS = 5;

Direction14 anyDirection()
{
    const double x = around(1000), y = around(1000), z = around(1000) + 0.5, one = 16384 / sqrt(x * x + y * y + z * z);
    return {static_cast<int16_t>(x * one), static_cast<int16_t>(y * one), static_cast<int16_t>(z * one)};
}

Shading anyShading(const Seed* seeds, const Vector* roots)
{
    Shading v;
    fill(&v, sizeof v);
    v.seeds = seeds;
    v.roots = roots;
    v.placeShift = 8 + below(2);
    v.limb = around(3000);
    v.turned = below(2);
    for (int i = 0; i < 3; ++i) {
        v.eye[i] = around(120 * 32);
        v.light[i] = around(9459);
        for (int32_t* axis : {v.right, v.up, v.toRight, v.toUp, v.toAhead})
            axis[i] = around(16384);
        v.cell[i] = (static_cast<uint32_t>(around(100)) << 16) + static_cast<uint32_t>(around(100));
    }
    v.depth = 65536 + below(1 << 18);
    v.leastPosition = below(2) << 8;
    v.cellShift = below(8);
    v.areaShare = below(0x40000000);
    v.wholeBefore = below(4) == 0 ? INT32_MAX : below(1 << below(12));
    v.deepest = below(3) == 0 ? below(1 << (8 + below(7))) : 22400;
    v.front = below(ENDS_MOST + 1);
    v.horizonShare = below(1 << (4 + below(8)));
    v.gradient[0] = around(1 << (8 + below(8)));
    v.gradient[1] = around(1 << (8 + below(8)));
    v.gradientAhead = around(1 << below(12));
    return v;
}

// Sets the fields of a seed that may not have just any value.
void limitSeed(Seed* s)
{
    const Direction14 way = anyDirection();
    s->way[0] = static_cast<int8_t>(way.x / 130);
    s->way[1] = static_cast<int8_t>(way.y / 130);
    s->way[2] = static_cast<int8_t>(way.z / 130);
    s->path = vectorAround(20);
    s->position = realFromRaw(below(3 << 16));
    s->normal = below(3) == 0 ? anyDirection() : way;
    s->root = static_cast<uint16_t>(below(ROOTS));
    s->flags = static_cast<uint8_t>((below(8) == 0 ? 0 : ::SEED_VALID) | (below(2) == 0 ? 0 : ::SEED_RESTING));
    s->area = static_cast<uint16_t>(below(4) == 0 ? 0 : below(AREA_MOST + 1));
}

Patch anyPatch()
{
    Patch patch;
    fill(&patch, sizeof patch);
    for (int ring = 0; ring < ::PATCH_RINGS; ++ring) {
        patch.count[ring] = static_cast<uint8_t>(below(SEEDS / ::PATCH_RINGS + 1));
        patch.first[ring] = below(SEEDS - patch.count[ring] + 1);
    }
    return patch;
}

struct SeedTally {
    int found, hidden, ended, sloped, steep, whole, torn, plain;
};

void countSeed(const Shading& v, const Seen& seen, const Voxel& voxel, SeedTally* t)
{
    const Seed& s = *seen.seed;
    const bool whole = s.area == 0 || seen.facing < v.wholeBefore;
    t->ended += voxel.back != 0;
    t->sloped += voxel.slopeX != 0;
    t->steep += voxel.tiltX > 5000;
    t->whole += whole;
    t->torn += !(s.flags & ::SEED_RESTING) && !whole && s.normal.x / 130 != s.way[0];
    t->plain += voxel.back == 0 && voxel.slopeX == 0;
}

// Tests random seeds in front of random viewers, and that seeds of each kind occurred.
void shadedSeeds(int rounds)
{
    static Seed seeds[SEEDS], kept[SEEDS];
    static Vector roots[ROOTS];
    static Voxel c[SEEDS + 2], a[SEEDS + 2];
    static Seen seenC[SEEDS + 2], seenA[SEEDS + 2];
    SeedTally t{};
    for (int round = 0; round < rounds; ++round) {
        const Shading v = anyShading(seeds, roots);
        for (Vector& root : roots)
            root = vectorAround(20);
        fill(seeds, sizeof seeds);
        for (Seed& s : seeds)
            limitSeed(&s);
        const Patch patch = anyPatch();
        memcpy(kept, seeds, sizeof seeds);
        fill(c, sizeof c);
        fill(seenC, sizeof seenC);
        memcpy(a, c, sizeof c);
        memcpy(seenA, seenC, sizeof seenC);
        const int count = findSeedsC(&v, &patch, seenC + 1, c + 1);
        verdict(findSeedsA(&v, &patch, seenA + 1, a + 1) == count, "seeds: as many are seen", round);
        // The twins may have begun to write the entry after the last visible seed.
        verdict(memcmp(a, c, sizeof(Voxel) * static_cast<size_t>(count + 1)) == 0, "seeds: at the same places", round);
        verdict(memcmp(seenA, seenC, sizeof seenC) == 0, "seeds: the same ones", round);
        for (int i = 1; i <= count; ++i) {
            seenC[i].facing = 1 + below(1 << (4 + below(13)));
            c[i].z = around(20000);
        }
        memcpy(a, c, sizeof c);
        shadeSeedsC(&v, seenC + 1, c + 1, count);
        shadeSeedsA(&v, seenC + 1, a + 1, count);
        verdict(memcmp(a, c, sizeof c) == 0, "seeds: the same voxels", round);
        verdict(memcmp(kept, seeds, sizeof seeds) == 0, "seeds: are left alone", round);
        t.found += count;
        t.hidden += patch.count[0] + patch.count[1] + patch.count[2] - count;
        for (int i = 1; i <= count; ++i)
            countSeed(v, seenC[i], c[i], &t);
    }
    verdict(t.ended > rounds / 4 && t.sloped > rounds / 2 && t.steep > rounds / 4 && t.whole > rounds && t.plain > rounds / 40 &&
                t.torn > rounds / 4 && t.hidden > rounds && t.found > rounds,
            "seeds: there were some of each kind", t.plain);
}

// --- Fields

// Constants that asm/fields.S relies on.
static_assert(inasm3::ALONG_KIND == offsetof(Along, kind) && inasm3::ALONG_HALF == offsetof(Along, half) &&
              inasm3::ALONG_A == offsetof(Along, a) && inasm3::ALONG_C == offsetof(Along, c) &&
              inasm3::ALONG_TWICE == offsetof(Along, twice16) && inasm3::ALONG_Y == offsetof(Along, y) &&
              inasm3::ALONG_WAY == offsetof(Along, along16) && inasm3::ALONG_B == offsetof(Along, b) &&
              inasm3::ALONG_STEPY == offsetof(Along, stepY) && inasm3::ALONG_VALUE == offsetof(Along, value) &&
              inasm3::ALONG_SLOPE == offsetof(Along, slope) && inasm3::ALONG_T == offsetof(Along, t) &&
              inasm3::ALONG_CHANGE == offsetof(Along, change) && inasm3::ALONG_K == offsetof(Along, k), "Along");
static_assert(inasm3::KIND_SEGMENT == Along::SEGMENT && Along::POINT < Along::SEGMENT && Along::SEGMENT < Along::OTHER,
              "Along::Kind");
static_assert(inasm3::FIELDS_SUM == offsetof(Fields, sum) && inasm3::FIELDS_SLOPE == offsetof(Fields, slope) &&
              inasm3::FIELDS_STRONGEST == offsetof(Fields, strongest) && inasm3::FIELDS_REACHING == offsetof(Fields, reaching),
              "Fields");
static_assert(inasm3::STEP_VALUE == offsetof(FieldStep, value) && inasm3::STEP_SLOPE == offsetof(FieldStep, slope) &&
              sizeof(FieldStep) == 8, "FieldStep");

// Sets the fields of a neighbour that may not have just any value.
void limitNeighbour(Neighbour* near)
{
    near->a = absolute(realAround(below(4) == 0 ? 4 : 1));
    near->c = absolute(realAround(below(4) == 0 ? 4 : 0.5));
    near->twice16 = vectorAround(1);
    near->y = realAround(1.5);
    near->along16 = vectorAround(1);
    near->kind = static_cast<Along::Kind>(below(3));
    near->half = absolute(realAround(1));
    near->t = absolute(realAround(2));
    near->change = realAround(2);
    // These depend on a path set before.
    near->b = realAround(1);
    near->stepY = realAround(1);
}

// Tests random paths in the fields of random neighbours: each is evaluated when the path is set and twice more afterwards. Also
// tests that neighbours of each kind occurred.
void fieldsAlong(int rounds)
{
    constexpr int MOST = 8;
    static Neighbour c[MOST + 2], a[MOST + 2];
    Neighbour *listC[MOST], *listA[MOST];
    int inside = 0, outside = 0, below0 = 0, beyond = 0, beside = 0, others = 0, none = 0;
    for (int round = 0; round < rounds; ++round) {
        const int count = below(MOST + 1);
        fill(c, sizeof c);
        // The list has another order than the array.
        const int shift = below(MOST);
        for (int i = 0; i < MOST; ++i) {
            limitNeighbour(c + 1 + i);
            listC[i] = c + 1 + (i + shift) % MOST;
            listA[i] = a + 1 + (i + shift) % MOST;
        }
        memcpy(a, c, sizeof c);
        const Vector path = vectorAround(12);
        for (int look = 0; look < 3; ++look) {
            const Real position = absolute(realAround(2));
            Fields sumC{absolute(realAround(1)), realAround(2), Real(0), 0}, sumA = sumC;
            const Vector* const taken = look == 0 && below(4) != 0 ? &path : nullptr;
            addFieldsC(listC, listC + count, position, taken, &sumC);
            addFieldsA(listA, listA + count, position, taken, &sumA);
            verdict(memcmp(&sumC, &sumA, sizeof sumC) == 0, "fields: the same sums", round);
            verdict(memcmp(c, a, sizeof c) == 0, "fields: each the same", round);
            none += sumC.reaching == 0;
            for (int i = 0; i < count; ++i) {
                const Along& along = *listC[i];
                (along.t >= Real(1) ? outside : along.t < Real(0) ? below0 : inside) += 1;
                if (along.kind == Along::SEGMENT)
                    (absolute(along.k) == along.half ? beyond : beside) += 1;
                others += along.kind == Along::OTHER;
            }
        }
    }
    verdict(inside > rounds && outside > rounds && below0 > rounds / 20 && beyond > rounds && beside > rounds / 4 &&
                others > rounds && none > rounds / 20,
            "fields: there were some of each kind", below0);
}

}  // namespace

int main(int count, char** arguments)
{
    const uint32_t seed = count > 1 ? static_cast<uint32_t>(strtoul(arguments[1], nullptr, 10)) : 1;
    const int rounds = count > 2 ? atoi(arguments[2]) : 300;
    state = seed * 2654435761u + 1;
    if (state == 0)
        state = 1;
    runs();
    voxelLists(rounds);
    voxelByVoxel(10 * rounds);
    shadedSeeds(10 * rounds);
    makeFieldSteps();
    fieldsAlong(20 * rounds);
    clearsAndCopies(rounds);
    registers();
    printf("# seed %u: %ld voxels (%ld drawn in lists), %ld spans tried\n", static_cast<unsigned>(seed),
           voxelsTried, voxelsDrawn, spansTried);
    int passed = 0;
    for (int k = 0; k < kindCount; ++k) {
        if (kinds[k].bad == 0) {
            ++passed;
            printf("ok %s (%ld times)\n", kinds[k].name, kinds[k].good);
        } else {
            printf("FAIL %s (%ld of %ld times)\n", kinds[k].name, kinds[k].bad, kinds[k].good + kinds[k].bad);
        }
    }
    printf("%d passed, %d failed\n", passed, kindCount - passed);
    return passed != kindCount;
}
