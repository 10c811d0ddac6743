// The innermost loops in C++: what asm/blit.S does, said plainly. Host builds draw with these; the tests hold the
// assembly against them.
#include "picture/blit.h"

#include "rt.h"

using machine::WIDTH;

void blitScalesC(uint8_t* frame, uint16_t* zbuffer, const Scale* scales, int count)
{
    for (; count > 0; --count, ++scales) {
        const int start = scales->top * WIDTH + scales->left;
        uint8_t* pixels = frame + start;
        uint16_t* depths = zbuffer + start;
        uint32_t z = static_cast<uint32_t>(scales->z);
        for (int y = scales->high; y > 0; --y) {
            for (int x = 0; x < scales->wide; ++x) {
                if (static_cast<uint16_t>(z) < depths[x]) {
                    depths[x] = static_cast<uint16_t>(z);
                    pixels[x] = static_cast<uint8_t>(scales->colour);
                }
                z += static_cast<uint32_t>(scales->zStep);
            }
            z += static_cast<uint32_t>(scales->zRow);
            pixels += WIDTH;
            depths += WIDTH;
        }
    }
}

void blitFine(uint8_t* frame, uint16_t* zbuffer, const FineScale& scale)
{
    const int start = scale.top * WIDTH + scale.left;
    uint8_t* pixels = frame + start;
    uint16_t* depths = zbuffer + start;
    uint32_t z = static_cast<uint32_t>(scale.z), shade = static_cast<uint32_t>(scale.shade);
    uint32_t cut = static_cast<uint32_t>(scale.cut);
    for (int y = scale.high; y > 0; --y) {
        for (int x = 0; x < scale.wide; ++x) {
            if (static_cast<uint16_t>(z) < depths[x] && static_cast<int32_t>(z) <= scale.zMost && static_cast<int32_t>(cut) >= 0) {
                depths[x] = static_cast<uint16_t>(z);
                pixels[x] = scale.ramp[static_cast<int8_t>(shade >> 8)];
            }
            z += static_cast<uint32_t>(scale.zStep);
            shade += static_cast<uint32_t>(scale.shadeStep);
            cut += static_cast<uint32_t>(scale.cutStep);
        }
        z += static_cast<uint32_t>(scale.zRow);
        shade += static_cast<uint32_t>(scale.shadeRow);
        cut += static_cast<uint32_t>(scale.cutRow);
        pixels += WIDTH;
        depths += WIDTH;
    }
}

void clearRowsC(uint8_t* frame, uint16_t* zbuffer, const Span* rows, int count)
{
    for (; count > 0; --count, ++rows, frame += WIDTH, zbuffer += WIDTH) {
        const int touched = rows->to - rows->from;
        if (touched <= 0)
            continue;
        memset(frame + rows->from, 0, static_cast<size_t>(touched));
        memset(zbuffer + rows->from, 0xff, static_cast<size_t>(touched) * sizeof *zbuffer);
    }
}

int drawnRunsC(const uint8_t* row, const Span* within, Span* runs)
{
    int count = 0;
    for (int x = within->from;; ++count) {
        while (x < within->to && row[x] == 0)
            ++x;
        if (x == within->to)
            return count;
        runs[count].from = static_cast<int16_t>(x);
        while (x < within->to && row[x] != 0)
            ++x;
        runs[count].to = static_cast<int16_t>(x);
    }
}

void copyRowsC(uint8_t* screen, const uint8_t* frame, const Span* rows, int count)
{
    for (; count > 0; --count, ++rows, screen += WIDTH, frame += WIDTH) {
        if (rows->to > rows->from)
            memcpy(screen + rows->from, frame + rows->from, static_cast<size_t>(rows->to - rows->from));
    }
}
