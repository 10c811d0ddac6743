// The table of reciprocal square roots, computed when the program starts.
#include "math/normal.h"

uint16_t inverseRoots[769];

void makeNormalTable()
{
    for (uint32_t i = 0; i < 769; ++i) {
        // 2^28 / sqrt((i + 1/2) 2^20) = 2^18.5 / sqrt(2i + 1). Entries below 64 are never used; the first do not fit 16 bits.
        const uint32_t root = squareRoot64(static_cast<uint64_t>(2 * i + 1) << 32);  // 2^16 sqrt(2i + 1)
        const uint32_t top = 0x5a827999u;                                             // 2^30.5, rounded down
        // 2^18.5 / (root / 2^16) = 2^34.5 / root = 2^30.5 * 16 / root
        const uint32_t value = top / (root / 16);
        inverseRoots[i] = static_cast<uint16_t>(value > UINT16_MAX ? UINT16_MAX : value);
    }
}
