// Draws letters, panels and marks into the frame buffer.
#include "app/overlay.h"

#include "app/font.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr uint8_t INK = Palette::INK;
constexpr uint8_t PAPER = 0;  // the background

// The rows of the mouse pointer from its tip down; the highest bit is the leftmost pixel.
constexpr int POINTER_WIDE = 7;
constexpr int POINTER_HIGH = 10;
constexpr uint8_t POINTER[POINTER_HIGH] = {0b1000000, 0b1100000, 0b1110000, 0b1111000, 0b1111100,
                                           0b1111110, 0b1111000, 0b1101100, 0b1000110, 0b0000110};

}  // namespace

int Overlay::width(const char* text)
{
    return static_cast<int>(strlen(text)) * LETTER_WIDE;
}

inline void Overlay::dot(uint8_t* frame, int x, int y, uint8_t colour)
{
    if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT)
        frame[y * WIDTH + x] = colour;
}

// Draws a picture whose rows are bits, the leftmost of `width` the highest; or only the dark rim around its pixels.
void Overlay::stamp(uint8_t* frame, int left, int top, const uint8_t* rows, int width, int height, bool rim)
{
    for (int row = 0, y = top; row < height; ++row, ++y) {
        for (int column = 0, x = left; column < width; ++column, ++x) {
            if ((rows[row] >> (width - 1 - column) & 1) == 0)
                continue;
            if (!rim) {
                dot(frame, x, y, INK);
                continue;
            }
            dot(frame, x - 1, y, PAPER);
            dot(frame, x + 1, y, PAPER);
            dot(frame, x, y - 1, PAPER);
            dot(frame, x, y + 1, PAPER);
        }
    }
}

void Overlay::letters(int left, int top, const char* text, int length)
{
    uint8_t* frame = view_.overlay(left - 1, top - 1, length * LETTER_WIDE + 1, FONT_HIGH + 2);
    // The first pass draws the rims of all letters, so that no rim covers a neighbouring letter.
    for (int pass = 0; pass < 2; ++pass) {
        int x = left;
        for (int i = 0; i < length && x < WIDTH; ++i, x += LETTER_WIDE) {
            const char c = text[i];
            const int capital = c >= 'a' && c <= 'z' ? c - 32 : c;
            const int known = capital >= FONT_FIRST && capital < FONT_FIRST + FONT_LETTERS ? capital : '?';
            stamp(frame, x, top, FONT[known - FONT_FIRST], FONT_WIDE, FONT_HIGH, pass == 0);
        }
    }
}

void Overlay::text(int left, int top, const char* text)
{
    letters(left, top, text, static_cast<int>(strlen(text)));
}

int Overlay::paragraph(int left, int top, int wide, const char* text, bool draw)
{
    const int lettersPerLine = wide / LETTER_WIDE;
    int lines = 0;
    while (*text != 0) {
        // A line takes as many words as fit; a word longer than the line is broken at the end of the line.
        int length = 0, end = 0;
        while (text[length] != 0 && length < lettersPerLine) {
            if (text[length] == ' ')
                end = length;
            ++length;
        }
        if (text[length] == 0 || text[length] == ' ' || end == 0)
            end = length;
        if (draw)
            letters(left, top + lines * (LINE_HIGH + 1), text, end);
        ++lines;
        text += end;
        while (*text == ' ')
            ++text;
    }
    return lines;
}

void Overlay::panel(int left, int top, int wide, int high)
{
    uint8_t* frame = view_.overlay(left - 1, top - 1, wide + 2, high + 2);
    for (int y = top - 1; y < top + high + 1; ++y) {
        for (int x = left - 1; x < left + wide + 1; ++x) {
            const bool edge = x < left || x >= left + wide || y < top || y >= top + high;
            const bool line = x == left || x == left + wide - 1 || y == top || y == top + high - 1;
            if (edge || line)
                dot(frame, x, y, edge ? PAPER : INK);
            else if (((x + y) & 1) == 0)
                dot(frame, x, y, PAPER);
        }
    }
}

void Overlay::cross(int x, int y)
{
    constexpr int ARM = 3;
    uint8_t* frame = view_.overlay(x - ARM, y - ARM, 2 * ARM + 1, 2 * ARM + 1);
    for (int i = 2; i <= ARM; ++i) {
        dot(frame, x - i, y, INK);
        dot(frame, x + i, y, INK);
        dot(frame, x, y - i, INK);
        dot(frame, x, y + i, INK);
    }
}

void Overlay::diamond(int x, int y)
{
    constexpr int ARM = 4;
    uint8_t* frame = view_.overlay(x - ARM, y - ARM, 2 * ARM + 1, 2 * ARM + 1);
    for (int i = 0; i <= ARM; i += 2) {
        dot(frame, x - i, y - (ARM - i), INK);
        dot(frame, x + i, y - (ARM - i), INK);
        dot(frame, x - i, y + (ARM - i), INK);
        dot(frame, x + i, y + (ARM - i), INK);
    }
}

void Overlay::pointer(int x, int y)
{
    uint8_t* frame = view_.overlay(x - 1, y - 1, POINTER_WIDE + 2, POINTER_HIGH + 2);
    stamp(frame, x, y, POINTER, POINTER_WIDE, POINTER_HIGH, true);
    stamp(frame, x, y, POINTER, POINTER_WIDE, POINTER_HIGH, false);
}
