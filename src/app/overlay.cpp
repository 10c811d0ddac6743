// Letters into the frame buffer.
#include "app/overlay.h"

#include "app/font.h"

using machine::HEIGHT;
using machine::WIDTH;

void Overlay::setPalette(const Palette& palette)
{
    int best = -1;
    for (int i = 0; i < 256; ++i) {
        const uint8_t* colour = palette.dac() + 3 * i;
        // Green looks brighter than red, and red than blue.
        const int bright = 3 * colour[0] + 6 * colour[1] + colour[2];
        if (bright > best) {
            best = bright;
            ink_ = static_cast<uint8_t>(i);
        }
    }
    paper_ = 0;
}

int Overlay::width(const char* text)
{
    return static_cast<int>(strlen(text)) * LETTER_WIDE;
}

inline void Overlay::dot(uint8_t* frame, int x, int y, uint8_t colour)
{
    if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT)
        frame[y * WIDTH + x] = colour;
}

void Overlay::text(int left, int top, const char* text)
{
    uint8_t* frame = view_.overlay(left - 1, top - 1, width(text) + 1, FONT_HIGH + 2);
    // The rim first, for all letters, so that none is drawn over its neighbour.
    for (int pass = 0; pass < 2; ++pass) {
        int x = left;
        for (const char* c = text; *c != 0 && x < WIDTH; ++c, x += LETTER_WIDE) {
            const int capital = *c >= 'a' && *c <= 'z' ? *c - 32 : *c;
            const int known = capital >= FONT_FIRST && capital < FONT_FIRST + FONT_LETTERS ? capital : '?';
            const uint8_t* letter = FONT[known - FONT_FIRST];
            for (int row = 0; row < FONT_HIGH; ++row) {
                for (int column = 0; column < FONT_WIDE; ++column) {
                    if ((letter[row] >> (FONT_WIDE - 1 - column) & 1) == 0)
                        continue;
                    if (pass == 1) {
                        dot(frame, x + column, top + row, ink_);
                        continue;
                    }
                    dot(frame, x + column - 1, top + row, paper_);
                    dot(frame, x + column + 1, top + row, paper_);
                    dot(frame, x + column, top + row - 1, paper_);
                    dot(frame, x + column, top + row + 1, paper_);
                }
            }
        }
    }
}

void Overlay::box(int left, int top, int wide, int high)
{
    uint8_t* frame = view_.overlay(left, top, wide, high);
    for (int y = top; y < top + high; ++y)
        for (int x = left; x < left + wide; ++x)
            dot(frame, x, y, paper_);
}

void Overlay::cross(int x, int y)
{
    constexpr int ARM = 3;
    uint8_t* frame = view_.overlay(x - ARM, y - ARM, 2 * ARM + 1, 2 * ARM + 1);
    for (int i = 2; i <= ARM; ++i) {
        dot(frame, x - i, y, ink_);
        dot(frame, x + i, y, ink_);
        dot(frame, x, y - i, ink_);
        dot(frame, x, y + i, ink_);
    }
}
