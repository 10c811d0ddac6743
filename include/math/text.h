// Numbers as text and text as numbers, for the command line, scene files, dumps and statistics. Integers only: no
// floating point is used to print or to read. And names as messages may show them.
#ifndef FB_TEXT_H
#define FB_TEXT_H

#include "math/real.h"

// The decimal form of `value` ("3.25", "-4") with as few decimals as read back as the same 16.16 value; never more than
// six are needed. At most `size` bytes with the final 0; 24 suffice. Returns the length.
int formatReal(char* to, int size, Real value);

// top/bottom with `decimals` (0..6) places, rounded ("13.083"); bottom 0 counts as a quotient of 0. Returns the length.
int formatQuotient(char* to, int size, uint64_t top, uint32_t bottom, int decimals);

// Reads a decimal number ("-1.5", ".25", "3") from the whole of `text`. False when it is none, or lies outside
// -32768 < value < 32768; digits beyond the sixth decimal are dropped.
bool parseReal(const char* text, Real* value);

// Reads a whole number 0..2^31-1 from the whole of `text`.
bool parseWhole(const char* text, int32_t* value);

// Copies `text` as any screen and terminal can show it: printable ASCII as it is, every other byte as \x and two digits.
// What does not fit in `size` bytes (at least 16) with the final 0 loses its middle, in place of which "..." stands.
// Returns `to`.
char* plainText(char* to, int size, const char* text);

#endif
