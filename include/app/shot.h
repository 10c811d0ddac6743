// Screenshots: a picture of 256 colours as a PCX file, which the painting programs of the time read.
#ifndef FB_SHOT_H
#define FB_SHOT_H

#include <stdint.h>

// Writes a picture of 320x200 palette indices with its colours (768 bytes, 0..63 as the DAC takes them). Null, or one line
// that says why not.
const char* writePcx(const char* name, const uint8_t* picture, const uint8_t* dac);

#endif
