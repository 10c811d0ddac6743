// Whole numbers: magnitude, the smaller and the larger of two, limits, and the dot product.
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

// The dot product of two vectors of whole numbers.
template <class A, class B>
inline int32_t dot(const A a[3], const B b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

#endif
