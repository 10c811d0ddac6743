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

    // Draws a line of text with a dark rim that keeps it readable on any picture; its first letter's top left pixel is
    // at `left`, `top`. Small letters are drawn as capitals, what the font has not as '?'.
    void text(int left, int top, const char* text);

    // The same in lines of at most `wide` pixels, broken between words where it can be. Returns how many lines it takes;
    // with `draw` false it only counts them.
    int paragraph(int left, int top, int wide, const char* text, bool draw = true);

    // A panel for text to stand on: a line round it, and inside every second pixel darkened, so that the picture is seen
    // through it.
    void panel(int left, int top, int wide, int high);

    // Round a pixel: a small cross for the selected object, a small diamond for the one before. And the mouse's pointer,
    // whose tip is at the pixel.
    void cross(int x, int y);
    void diamond(int x, int y);
    void pointer(int x, int y);

    static int width(const char* text);

private:
    void dot(uint8_t* frame, int x, int y, uint8_t colour);

    void letters(int left, int top, const char* text, int length);

    View& view_;
};

#endif
