// Draws single scales, clears both buffers, copies the frame to video memory, finds runs of drawn pixels. Most scales are drawn by
// the loop of scales.h as soon as they are projected; what it leaves (too near, too far, too large) is drawn here.
//
// A routine whose name ends in C is in C++ (src/picture/blit.cpp), as the readable reference; it has a twin in assembly
// (asm/blit.S) for the DOS program and the 32-bit host build. Both write the same bytes.
#ifndef FB_BLIT_H
#define FB_BLIT_H

#include <stdint.h>

#include "machine.h"

// A scale projected onto the screen: a rectangle, "very simple to draw" (report, The Rendering Technique). The report's scales have
// one colour and all face the viewer. Ours may lie in the tangent plane of the surface, so that their depth changes by a constant
// from pixel to pixel and from row to row; so may their brightness; and they may end at a least and a greatest depth, or be cut
// along a line or a curve. The caller guarantees that the scale lies wholly on the screen (0 <= left, 1 <= width, left + width <=
// 320; 0 <= top, 1 <= height, top + height <= 200) and that its depth stays within 0..0xfffe at every pixel; nothing checks it.
struct Scale {
    int16_t left, top, width, height;
    int32_t z;             // depth of the top left pixel: distance along the viewing axis, 1/128 unit; smaller is nearer
    int32_t zStep;         // change of depth from a pixel to its right neighbour
    int32_t zRow;          // change of depth from one pixel past the end of a row to the first pixel of the next row
    int32_t zLeast, zMost;               // pixels with a depth below zLeast or beyond zMost are not drawn
    const uint8_t* ramp;                 // VoxelList::ramp
    int32_t shade, shadeStep, shadeRow;  // brightness, 8 fraction bits; used like z, zStep and zRow
    int32_t cut, cutStep, cutRow;  // cut function, 8 fraction bits: a pixel is drawn where it is >= 0; cutRow leads from the first
                                   // pixel of a row to the first pixel of the next
    int32_t cutXX, cutXY, cutYY;   // added before each step to cutStep; before each row to its first cutStep; and to cutRow
    bool averages; // where a pixel already shows the same ramp, and is less than AVERAGED nearer or farther, its brightness becomes
                   // the mean of both; its depth is the lesser one as always
    int32_t dome;  // of a scale with a cut: added to zStep after each step in a row, and to the change of z from row to row after
                   // each row; 0: the depth changes by constant steps
};

// 1/128 unit, see Scale::averages.
constexpr int32_t AVERAGED = 96;

// The depth of a pixel where nothing was drawn.
constexpr uint16_t Z_EMPTY = 0xffff;

extern "C" {

// Draws a scale. A pixel is written where the scale's z is less than the Z-buffer's, so of two scales at equal depth the first one
// stays visible. `frame` has 320x200 bytes, `zbuffer` 320x200 16-bit words, top row first. Few scales get here (drawScales() draws
// most), so this routine has no assembly twin.
void blitScale(uint8_t* frame, uint16_t* zbuffer, const Scale& scale);

// Clears one span in each of the first `count` rows: the frame to 0, the Z-buffer to Z_EMPTY.
void clearRows(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count);

// Copies one span in each of the first `count` rows from `frame` to `screen`, which has the same layout.
void copyRowsC(uint8_t* screen, const uint8_t* frame, const Span* rows, int count);

// Finds the runs of drawn (nonzero) pixels in a row. Writes the half-open range of each run to `runs`, at most WIDTH / 2 ranges,
// and returns their number. Only the pixels of `within` are searched; both its ends must be multiples of 4. `depths` is the same
// row of the Z-buffer, with Z_EMPTY where a pixel is empty.
int drawnRunsC(const uint8_t* row, const uint16_t* depths, const Span* within, Span* runs);

#if FB_ASM
int drawnRunsA(const uint8_t* row, const uint16_t* depths, const Span* within, Span* runs);
// copyRowsC() to a screen at `offset` in the segment of `selector` (video memory has a selector of its own under DPMI).
void presentRows(uint32_t selector, uint32_t offset, const uint8_t* frame, const Span* rows, int count);
#endif

}

#if FB_ASM
#define drawnRuns drawnRunsA
#else
#define drawnRuns drawnRunsC
#endif

#endif
