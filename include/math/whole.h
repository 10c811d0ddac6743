// Whole numbers: magnitude, the smaller and the larger of two, and limits.
#ifndef FB_WHOLE_H
#define FB_WHOLE_H

#include <stdint.h>

inline int32_t magnitude(int32_t a)
{
    return a < 0 ? -a : a;
}

inline int32_t min32(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

inline int32_t max32(int32_t a, int32_t b)
{
    return a < b ? b : a;
}

// `a` clamped to -most..most.
inline int32_t limited(int32_t a, int32_t most)
{
    return a > most ? most : a < -most ? -most : a;
}

#endif
