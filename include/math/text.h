// Numbers as text and text as numbers, for the command line, scene files, dumps and statistics; and names in the form in which
// messages may show them. Only integers are used: no floating point is needed to print or to read.
#ifndef FB_TEXT_H
#define FB_TEXT_H

#include "math/real.h"

// Writes the decimal form of `value` ("3.25", "-4") with the fewest decimals, at most six, that read back as the same 16.16
// value. Writes at most `size` bytes with the final 0; 24 are always enough. Returns the length.
int formatReal(char* to, int size, Real value);

// Writes top / bottom, rounded to `decimals` (0..6) places ("13.083"); bottom 0 gives 0. Returns the length.
int formatQuotient(char* to, int size, uint64_t top, uint32_t bottom, int decimals);

// Reads a decimal number ("-1.5", ".25", "3") from the whole of `text`. Returns false if it is not a number, or is not within
// -32768 < value < 32768. Digits after the sixth decimal are ignored.
bool parseReal(const char* text, Real* value);

// Reads a whole number 0..2^31-1 from the whole of `text`. Returns false if there is none.
bool parseWhole(const char* text, int32_t* value);

// Copies `text` in a form that any screen and terminal can show: printable ASCII is kept, every other byte becomes \x and two
// digits. A result that does not fit in `size` bytes (at least 16) with the final 0 has "..." in place of its middle. Returns
// `to`.
char* plainText(char* to, int size, const char* text);

#endif
