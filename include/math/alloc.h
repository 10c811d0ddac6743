// Objects on the heap without the C++ library: when memory runs out the result is null, and there is never an exception.
#ifndef FB_ALLOC_H
#define FB_ALLOC_H

#include "rt.h"

struct InPlace {};
inline void* operator new(size_t, void* at, InPlace) noexcept { return at; }
inline void operator delete(void*, void*, InPlace) noexcept {}

// Returns a new T, or null when there is no memory. The owner ends it with destroy().
template <class T, class... Args>
T* make(Args&&... args)
{
    void* at = malloc(sizeof(T));
    return at == nullptr ? nullptr : new (at, InPlace{}) T(args...);
}

template <class T>
void destroy(T* object)
{
    if (object != nullptr) {
        object->~T();
        free(object);
    }
}

// Room for `count` items that need no constructor. Returns null when there is no memory or the size does not fit 31 bits.
template <class T>
T* allocate(uint32_t count)
{
    if (count > 0x7fffffffu / sizeof(T))
        return nullptr;
    return static_cast<T*>(malloc(count == 0 ? 1 : count * sizeof(T)));
}

#endif
