// The innermost loops: scales into the frame buffer under the Z-buffer, clears, and the copy to video memory. (Most
// scales are drawn as soon as they are projected, by the loop of scales.h; what that leaves, very large or far aside, is
// drawn here.)
//
// Each routine stands twice: in C++ (src/picture/blit.cpp, the ...C names), which says what it does, and in assembly
// (asm/blit.S), which the DOS program and the 32-bit host build use. Both do the same, byte for byte.
#ifndef FB_BLIT_H
#define FB_BLIT_H

#include <stdint.h>

#include "machine.h"

// A scale as it falls on the screen: a rectangle of one colour, "very simple to draw" (report, The Rendering Technique).
// The report's scales all face the viewer; ours may lie in the plane of the surface, so that their depth changes by a
// constant from pixel to pixel and from row to row. Lies wholly on the screen: 0 <= left, 1 <= wide, left + wide <= 320,
// and the same for top, high and 200. Depths stay within 0..0xfffe at every pixel. No caller may pass another.
struct Scale {
    int16_t left;
    int16_t top;
    int16_t width;
    int16_t height;
    int32_t z;        // of the top left pixel: distance along the viewing axis in 1/128 units; smaller is nearer
    int32_t zStep;    // from a pixel to the next one
    int32_t zRow;     // from the pixel behind the last of a row to the first of the next
    int32_t colour;   // palette index
};

// One that ends where it gets too far away, that is cut along a line or a curve, or whose brightness changes across it. `ramp` has
// the palette index of each brightness that occurs. The brightnesses, and what cuts, have 8 bits of fraction: what they are at the
// top left pixel, and how they change like the depth. What cuts need not change evenly.
struct FineScale : Scale {
    int32_t zMost;  // of what is drawn
    const uint8_t* ramp;
    int32_t shade, shadeStep, shadeRow;
    int32_t cut, cutStep, cutRow;  // what is drawn is where this is not negative; the row: from a first pixel to the one below
    int32_t cutXX, cutXY, cutYY;   // by how much the step changes before each step and from row to row, the row before each row
};

// The depth of a pixel where nothing was drawn.
constexpr uint16_t Z_EMPTY = 0xffff;

extern "C" {

// Draws `count` scales: a pixel is taken where the scale's z is less than the Z-buffer's, so the first of two at equal
// depth stays. `frame` has 320x200 bytes, `zbuffer` 320x200 words, top row first.
void blitScalesC(uint8_t* frame, uint16_t* zbuffer, const Scale* scales, int count);

// Draws one of the other kind. These are few and there is only this routine; most are drawn by drawScales().
void blitFine(uint8_t* frame, uint16_t* zbuffer, const FineScale& scale);

// Clears the spans of `count` rows from the top: frame to 0, Z-buffer to Z_EMPTY.
void clearRowsC(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count);

// Copies the spans of `count` rows from `frame` to a screen of the same layout at `screen`.
void copyRowsC(uint8_t* screen, const uint8_t* frame, const Span* rows, int count);

// Finds the runs of drawn pixels (not 0) in a row of WIDTH: writes where each begins and where it ends, at most WIDTH / 2
// of them, and returns how many. Looks at the pixels of `within` only; its ends are multiples of 4. `depths` are those of the
// row: Z_EMPTY where a pixel is empty.
int drawnRunsC(const uint8_t* row, const uint16_t* depths, const Span* within, Span* runs);

#if FB_ASM
int drawnRunsA(const uint8_t* row, const uint16_t* depths, const Span* within, Span* runs);
void blitScalesA(uint8_t* frame, uint16_t* zbuffer, const Scale* scales, int count);
void clearRowsA(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count);
// The screen is at `offset` in the segment of `selector` (video memory has a selector of its own under DPMI).
void presentRows(uint32_t selector, uint32_t offset, const uint8_t* frame, const Span* rows, int count);
#endif

}

#if FB_ASM
#define blitScales blitScalesA
#define drawnRuns drawnRunsA
#define clearRows clearRowsA
#else
#define blitScales blitScalesC
#define drawnRuns drawnRunsC
#define clearRows clearRowsC
#endif

#endif
