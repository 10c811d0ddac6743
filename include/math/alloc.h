// Objects on the heap without the C++ library: memory that runs out gives null, never an exception.
#ifndef FB_ALLOC_H
#define FB_ALLOC_H

#include "rt.h"

struct InPlace {};
inline void* operator new(size_t, void* at, InPlace) noexcept { return at; }
inline void operator delete(void*, void*, InPlace) noexcept {}

// A new T, or null when there is no memory. Ended by destroy().
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

// Room for `count` things that need no constructor, or null (also when the size does not fit 32 bits).
template <class T>
T* allocate(uint32_t count)
{
    if (count > 0x7fffffffu / sizeof(T))
        return nullptr;
    return static_cast<T*>(malloc(count == 0 ? 1 : count * sizeof(T)));
}

#endif
