// A small bitmap font for text on top of the picture: the characters from blank to '_' (capitals, digits, signs).
#ifndef FB_FONT_H
#define FB_FONT_H

#include <stdint.h>

constexpr int FONT_FIRST = ' ';
constexpr int FONT_LETTERS = 64;
constexpr int FONT_WIDE = 5;   // pixels; the lowest five bits of a row, leftmost highest
constexpr int FONT_HIGH = 7;

extern const uint8_t FONT[FONT_LETTERS][FONT_HIGH];

#endif
