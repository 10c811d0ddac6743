// Stand-in for the assembly that copies a frame to the screen.
#include "machine.h"

extern "C" void presentRows(uint32_t selector, uint32_t offset, const uint8_t* frame, const Span* rows, int count) {
    for (int y = 0; y < count; ++y) {
        if (rows[y].from >= rows[y].to) {
            continue;
        }
        const uint32_t at = uint32_t(y * machine::WIDTH + rows[y].from);
        uint32_t to = offset + at;
        const uint8_t* from = frame + at;
        uint32_t words = uint32_t(rows[y].to - rows[y].from) >> 2;
        __asm__ volatile(
            "pushl %%es\n\t"
            "movw %w3, %%es\n\t"
            "rep movsl\n\t"
            "popl %%es"
            : "+D"(to), "+S"(from), "+c"(words)
            : "r"(selector)
            : "memory");
    }
}
