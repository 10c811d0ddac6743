// A small bitmap font for text on top of the picture: the characters from blank to '_' (capitals, digits, punctuation).
#ifndef FB_FONT_H
#define FB_FONT_H

#include <stdint.h>

constexpr int FONT_FIRST = ' ';
constexpr int FONT_LETTERS = 64;
constexpr int FONT_WIDE = 5;   // pixels: the five lowest bits of a row's byte; bit 4 is the leftmost pixel
constexpr int FONT_HIGH = 7;

extern const uint8_t FONT[FONT_LETTERS][FONT_HIGH];

#endif
