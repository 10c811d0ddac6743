// Overlay: draws text, boxes and marks on top of a finished picture, between View::show() and View::end(). It changes pixels
// but not the Z-buffer, whose depths remain those of the model. Everything is clipped at the edges of the screen.
#ifndef FB_OVERLAY_H
#define FB_OVERLAY_H

#include "picture/palette.h"
#include "picture/view.h"

class Overlay {
public:
    // Pixels from one letter to the next, with one blank column, and the height of a line of text, with one row of its rim. From
    // one line of a paragraph to the next it is LINE_HIGH + 1.
    static constexpr int LETTER_WIDE = 6;
    static constexpr int LINE_HIGH = 8;

    explicit Overlay(View& view) : view_(view) {}

    // Draws a line of text with a dark rim that keeps it readable on any picture; the top left pixel of the first letter is
    // at `left`, `top`. Small letters are drawn as capitals, characters missing from the font as '?'.
    void text(int left, int top, const char* text);

    // Draws text in lines of at most `wide` pixels, broken between words where possible. Returns the number of lines; when
    // `draw` is false it only counts them.
    int paragraph(int left, int top, int wide, const char* text, bool draw = true);

    // Draws a panel as a background for text: a frame line, and inside every second pixel darkened, so that the picture
    // shows through.
    void panel(int left, int top, int wide, int high);

    // Draw a mark at a pixel: a small cross around it (the selected object), a small diamond around it (the object selected
    // before), and the mouse pointer, whose tip is at the pixel.
    void cross(int x, int y);
    void diamond(int x, int y);
    void pointer(int x, int y);

    static int width(const char* text);

private:
    void dot(uint8_t* frame, int x, int y, uint8_t colour);
    void stamp(uint8_t* frame, int left, int top, const uint8_t* rows, int width, int height, bool rim);
    void letters(int left, int top, const char* text, int length);

    View& view_;
};

#endif
