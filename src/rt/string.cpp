// The string functions of the C library that the program uses, and those to which the compiler itself generates calls.
// Copying and filling use string instructions: the compiler would recognise a loop in C++ and turn it into a call of the
// very function that contains it.
#include "rt.h"

extern "C" {

void* memcpy(void* to, const void* from, size_t bytes)
{
    void* at = to;
    size_t words = bytes >> 2;
    __asm__ volatile("rep movsl" : "+D"(at), "+S"(from), "+c"(words) : : "memory");
    words = bytes & 3;
    __asm__ volatile("rep movsb" : "+D"(at), "+S"(from), "+c"(words) : : "memory");
    return to;
}

void* memmove(void* to, const void* from, size_t bytes)
{
    // Only when the target begins inside the source must the copy start at the end.
    if (uintptr_t(to) - uintptr_t(from) >= bytes)
        return memcpy(to, from, bytes);
    char* last = static_cast<char*>(to) + bytes - 1;
    const char* lastFrom = static_cast<const char*>(from) + bytes - 1;
    size_t left = bytes;
    __asm__ volatile("std\n\trep movsb\n\tcld" : "+D"(last), "+S"(lastFrom), "+c"(left) : : "memory", "cc");
    return to;
}

void* memset(void* to, int byte, size_t bytes)
{
    void* at = to;
    const uint32_t four = (uint32_t(byte) & 0xff) * 0x01010101u;
    size_t words = bytes >> 2;
    __asm__ volatile("rep stosl" : "+D"(at), "+c"(words) : "a"(four) : "memory");
    words = bytes & 3;
    __asm__ volatile("rep stosb" : "+D"(at), "+c"(words) : "a"(four) : "memory");
    return to;
}

int memcmp(const void* a, const void* b, size_t bytes)
{
    const unsigned char* left = static_cast<const unsigned char*>(a);
    const unsigned char* right = static_cast<const unsigned char*>(b);
    for (; bytes > 0; --bytes, ++left, ++right)
        if (*left != *right)
            return *left < *right ? -1 : 1;
    return 0;
}

size_t strlen(const char* text)
{
    const char* end = text;
    while (*end != '\0') {
        ++end;
        // Without this the compiler turns the loop into a call of strlen().
        __asm__("" : "+r"(end));
    }
    return size_t(end - text);
}

int strcmp(const char* a, const char* b)
{
    return strncmp(a, b, ~size_t(0));
}

int strncmp(const char* a, const char* b, size_t most)
{
    for (; most > 0; --most, ++a, ++b) {
        const unsigned char left = static_cast<unsigned char>(*a);
        const unsigned char right = static_cast<unsigned char>(*b);
        if (left != right)
            return left < right ? -1 : 1;
        if (left == '\0')
            break;
    }
    return 0;
}

char* strchr(const char* text, int c)
{
    for (;; ++text) {
        if (*text == char(c))
            return const_cast<char*>(text);
        if (*text == '\0')
            return nullptr;
    }
}

char* strcpy(char* to, const char* from)
{
    memcpy(to, from, strlen(from) + 1);
    return to;
}

}  // extern "C"
