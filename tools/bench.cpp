// What the benchmark adds to the host program to count instructions: the copy to the screen that the DOS program makes,
// and the C++ twin of the scale blitter beside the assembly, on the very scales that the demo draws.
//
// It is linked in with the linker's --wrap, so that nothing of it is in the program itself (tools/bench.mk). A profiler
// then tells the instructions of each routine by its name. What was drawn is told at the end of the run, on standard
// output behind the statistics:
//
//     blit scales: N        scales given to the blitter
//     blit pixels: N        pixels they cover
//     blit differing: N     calls in which the twins drew differently; has to be 0
//     frames not cleared: N frames that began with something left of the one before; has to be 0
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "blit.h"

namespace {

using machine::HEIGHT;
using machine::WIDTH;

uint8_t screen[WIDTH * HEIGHT];
uint8_t twinFrame[WIDTH * HEIGHT];
uint16_t twinDepths[WIDTH * HEIGHT];

unsigned long long scalesDrawn = 0, pixelsCovered = 0, differing = 0, leftOver = 0;
unsigned long frames = 0;

// Looked at in every sixteenth frame: to look costs as much as to draw.
constexpr unsigned long LOOK_EVERY = 16;

void tell()
{
    printf("blit scales: %llu\nblit pixels: %llu\nblit differing: %llu\nframes not cleared: %llu\n", scalesDrawn,
           pixelsCovered, differing, leftOver);
}

}  // namespace

extern "C" {

void __real_blitScalesA(uint8_t* frame, uint16_t* zbuffer, const Scale* scales, int count);
void __real_clearRowsA(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count);

// A frame begins, for the twin too: what the program leaves in its buffers is there for both. (Nothing should be.)
void __wrap_clearRowsA(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count)
{
    __real_clearRowsA(frame, zbuffer, rows, count);
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

void __wrap_blitScalesA(uint8_t* frame, uint16_t* zbuffer, const Scale* scales, int count)
{
    __real_blitScalesA(frame, zbuffer, scales, count);
    blitScalesC(twinFrame, twinDepths, scales, count);
    for (int i = 0; i < count; ++i)
        pixelsCovered += static_cast<unsigned>(scales[i].wide * scales[i].high);
    scalesDrawn += static_cast<unsigned>(count);
    if (frames % LOOK_EVERY != 0)
        return;
    // The frame as it is so far; what is drawn over it later (gaps closed, text) is no business of the blitter.
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        if (frame[i] != twinFrame[i] || zbuffer[i] != twinDepths[i]) {
            ++differing;
            break;
        }
    }
}

// machine::present(): the host's has no card to copy to.
void __wrap__ZN7machine7presentEPKhPK4Span(const uint8_t* frame, const Span* rows)
{
    if (frames++ == 0)
        atexit(tell);
    uint16_t selector;
    asm("movw %%ds, %0" : "=r"(selector));
    presentRows(selector, static_cast<uint32_t>(reinterpret_cast<uintptr_t>(screen)), frame, rows, HEIGHT);
}

}
