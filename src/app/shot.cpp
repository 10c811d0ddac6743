// Writes a PCX file: a header, the rows as runs of equal pixels, and the palette at the end.
#include "app/shot.h"

#include "machine.h"
#include "rt.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr int RUN_MOST = 63;
constexpr int RUN_MARK = 0xc0;  // bytes from this value on are counts; a pixel of such a value needs a count before it

uint8_t header[128];
uint8_t row[WIDTH * 2];
char problem[160];

void put16(uint8_t* to, int value)
{
    to[0] = static_cast<uint8_t>(value);
    to[1] = static_cast<uint8_t>(value >> 8);
}

// Packs the pixels of a row into `row`; returns the number of bytes.
uint32_t packRow(const uint8_t* pixels)
{
    uint8_t* to = row;
    for (int x = 0; x < WIDTH;) {
        int run = 1;
        while (x + run < WIDTH && run < RUN_MOST && pixels[x + run] == pixels[x])
            ++run;
        if (run > 1 || pixels[x] >= RUN_MARK)
            *to++ = static_cast<uint8_t>(RUN_MARK + run);
        *to++ = pixels[x];
        x += run;
    }
    return static_cast<uint32_t>(to - row);
}

}  // namespace

const char* writePcx(const char* name, const uint8_t* picture, const uint8_t* dac)
{
    const int file = machine::createFile(name);
    bool good = file >= 0;
    memset(header, 0, sizeof header);
    header[0] = 10;  // the mark of a PCX file
    header[1] = 5;   // version 5: may have a palette of 256 colours
    header[2] = 1;   // run-length encoded
    header[3] = 8;   // bits per pixel
    put16(header + 8, WIDTH - 1);
    put16(header + 10, HEIGHT - 1);
    put16(header + 12, WIDTH);
    put16(header + 14, HEIGHT);
    header[65] = 1;  // planes
    put16(header + 66, WIDTH);
    put16(header + 68, 1);  // the palette has colours
    good = good && machine::writeFile(file, header, sizeof header) >= 0;
    for (int y = 0; good && y < HEIGHT; ++y) {
        const uint32_t bytes = packRow(picture + y * WIDTH);
        good = machine::writeFile(file, row, bytes) >= 0;
    }
    // The palette follows a mark byte; its values are scaled from 0..63 to 0..255.
    constexpr uint8_t MARK = 12;
    good = good && machine::writeFile(file, &MARK, 1) >= 0;
    for (int i = 0; good && i < 768; i += 96) {
        for (int part = 0; part < 96; ++part)
            row[part] = static_cast<uint8_t>((dac[i + part] * 255 + 31) / 63);
        good = machine::writeFile(file, row, 96) >= 0;
    }
    if (file >= 0)
        good = machine::closeFile(file) && good;
    if (good)
        return nullptr;
    snprintf(problem, sizeof problem, "%.100s: %s", name, machine::fileTrouble());
    return problem;
}
