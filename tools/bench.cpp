// Additions to the host program for the benchmark that counts instructions: the copy to the screen that the DOS program makes,
// and calls of the C++ twins of the loops that draw scales, with the same lists that the assembly draws in the demo.
//
// The linker's --wrap links them in (tools/bench.mk), so the program itself contains nothing of this file. A profiler reports the
// instructions of each routine by its name. At the end of the run these figures are printed on standard output after the
// statistics:
//
//     scales: N             all scales drawn
//     scales by the view: N those that the loop left to View::project() and that were drawn one by one
//     scale pixels: N       pixels covered by all scales
//     scales differing: N   calls in which the twins drew, counted or stopped differently; must be 0
//     frames not cleared: N frames that began with remains of the previous one; must be 0
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "picture/scales.h"

namespace {

using machine::HEIGHT;
using machine::WIDTH;

uint8_t screen[WIDTH * HEIGHT];
uint8_t twinFrame[WIDTH * HEIGHT];
uint16_t twinDepths[WIDTH * HEIGHT];

unsigned long long scalesDrawn = 0, byTheView = 0, pixelsCovered = 0, differing = 0, leftOver = 0;
unsigned long frames = 0;

// The buffers are compared in every sixteenth frame only, because comparing costs as much as drawing.
constexpr unsigned long LOOK_EVERY = 16;

void tell()
{
    printf("scales: %llu\nscales by the view: %llu\nscale pixels: %llu\nscales differing: %llu\nframes not cleared: %llu\n",
           scalesDrawn, byTheView, pixelsCovered, differing, leftOver);
}

// Returns the number of pixels of a voxel that the loop has drawn. (Instructions of this file are not counted: tools/bench.sh
// recognises its functions by their names.)
int benchPixels(const Lens& lens, const Voxel& v)
{
    const int32_t depth = lens.z + v.z;
    Factors near;
    const Factors& f = *factorsOf(lens, depth, &near);
    const int32_t column = lens.centreX + ((lens.x + v.x) * f.x >> 8), row = lens.centreY - ((lens.y + v.y) * f.y >> 8);
    const int32_t halfWide = v.halfWidth * f.x >> 8, halfHigh = v.halfHeight * f.y >> 8;
    const int wide = ((column + halfWide) >> 12) - ((column - halfWide) >> 12);
    const int high = ((row + halfHigh) >> 12) - ((row - halfHigh) >> 12);
    return wide * high;
}

// Compares the frame as drawn so far. Whatever is drawn over it later (filled gaps, text) does not concern the twins.
bool benchDiffers(const uint8_t* frame, const uint16_t* zbuffer)
{
    if (frames % LOOK_EVERY != 0)
        return false;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        if (frame[i] != twinFrame[i] || zbuffer[i] != twinDepths[i])
            return true;
    }
    return false;
}

}  // namespace

extern "C" {

const Voxel* __real_drawScalesA(Lens* lens, const Voxel* voxels, const Voxel* end);
void __real_clearRows(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count);

// A frame begins, for the twin too: it gets whatever the program has left in its buffers (which should be nothing).
void __wrap_clearRows(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count)
{
    __real_clearRows(frame, zbuffer, rows, count);
    const bool look = frames % LOOK_EVERY == 0;
    bool left = false;
    for (int i = 0; i < WIDTH * HEIGHT && look; ++i) {
        left = left || frame[i] != 0 || zbuffer[i] != Z_EMPTY;
        twinFrame[i] = frame[i];
        twinDepths[i] = zbuffer[i];
    }
    leftOver += left;
    for (int y = 0; y < count && !look; ++y) {
        for (int x = rows[y].from; x < rows[y].to; ++x) {
            twinFrame[y * WIDTH + x] = 0;
            twinDepths[y * WIDTH + x] = Z_EMPTY;
        }
    }
}

// The twin's loop calls it, too. The view draws few enough with it to count them as drawn otherwise.
void __real_blitScale(uint8_t* frame, uint16_t* zbuffer, const Scale& scale);
void __wrap_blitScale(uint8_t* frame, uint16_t* zbuffer, const Scale& scale)
{
    __real_blitScale(frame, zbuffer, scale);
    if (frame == twinFrame)
        return;
    __real_blitScale(twinFrame, twinDepths, scale);
    pixelsCovered += static_cast<unsigned>(scale.width * scale.height);
    ++scalesDrawn;
    ++byTheView;
    differing += benchDiffers(frame, zbuffer);
}

const Voxel* __wrap_drawScalesA(Lens* lens, const Voxel* voxels, const Voxel* end)
{
    static Lens twin;
    twin = *lens;
    twin.frame = twinFrame;
    twin.zbuffer = twinDepths;
    const int32_t emptyBefore = lens->empty;
    const Voxel* const done = __real_drawScalesA(lens, voxels, end);
    const Voxel* const twinDone = drawScalesC(&twin, voxels, end);
    int drawn = 0;
    for (const Voxel* voxel = voxels; voxel < done; ++voxel) {
        const int pixels = benchPixels(*lens, *voxel);
        drawn += pixels > 0;
        pixelsCovered += static_cast<unsigned>(pixels);
    }
    scalesDrawn += static_cast<unsigned>(drawn);
    differing += done != twinDone || drawn != done - voxels - (lens->empty - emptyBefore) || twin.empty != lens->empty ||
                 twin.left != lens->left || twin.top != lens->top || twin.right != lens->right ||
                 twin.bottom != lens->bottom || benchDiffers(lens->frame, lens->zbuffer);
    return done;
}

// Replaces machine::present(): the host has no video card to copy to.
void __wrap__ZN7machine7presentEPKhPK4Span(const uint8_t* frame, const Span* rows)
{
    if (frames++ == 0)
        atexit(tell);
    uint16_t selector;
    asm("movw %%ds, %0" : "=r"(selector));
    presentRows(selector, static_cast<uint32_t>(reinterpret_cast<uintptr_t>(screen)), frame, rows, HEIGHT);
}

}
