// Overlay: text, boxes and marks on top of a picture that is drawn already, between View::show() and View::end(). It
// changes pixels only; depths stay those of the model. Everything is cut off at the screen's edges.
#ifndef FB_OVERLAY_H
#define FB_OVERLAY_H

#include "picture/palette.h"
#include "picture/view.h"

class Overlay {
public:
    // A line of text takes so many pixels each way, a blank column and row included.
    static constexpr int LETTER_WIDE = 6;
    static constexpr int LINE_HIGH = 8;

    explicit Overlay(View& view) : view_(view) {}

    // Takes its colours from the palette: ink is the brightest there is, paper the background.
    void setPalette(const Palette& palette);

    // Draws a line of text with a dark rim that keeps it readable on any picture; its first letter's top left pixel is
    // at `left`, `top`. Small letters are drawn as capitals, what the font has not as '?'.
    void text(int left, int top, const char* text);

    // Darkens a rectangle of pixels for text to stand on.
    void box(int left, int top, int wide, int high);

    // A small cross round a pixel.
    void cross(int x, int y);

    static int width(const char* text);

private:
    void dot(uint8_t* frame, int x, int y, uint8_t colour);

    View& view_;
    uint8_t ink_ = 255;
    uint8_t paper_ = 0;
};

#endif
