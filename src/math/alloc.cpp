// Functions that the compiler calls for classes with virtual functions, and that a program without the C++ library must define.
#include "math/alloc.h"

void operator delete(void* at) noexcept { free(at); }
void operator delete(void* at, size_t) noexcept { free(at); }

#if defined(FB_RT) || defined(__DJGPP__)
extern "C" void __cxa_pure_virtual()
{
    exit(1);
}
#endif
