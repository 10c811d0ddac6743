// Screenshots: a picture of 256 colours as a PCX file, a format that the paint programs of the time could read.
#ifndef FB_SHOT_H
#define FB_SHOT_H

#include <stdint.h>

// Writes a picture of 320x200 palette indices with its palette `dac` (768 bytes in 0..63, as the DAC of the VGA takes them).
// Returns null, or one line that says what is wrong.
const char* writePcx(const char* name, const uint8_t* picture, const uint8_t* dac);

#endif
