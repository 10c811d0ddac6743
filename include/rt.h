// The functions that the program and its tests on DOS need from a C library. The host compiler and DJGPP have them in their
// libc. The stock compiler has no libc for DOS; for it src/rt supplies these functions and no others (the Makefile defines FB_RT).
#ifndef FB_RT_H
#define FB_RT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#ifdef FB_RT

extern "C" {
void* memcpy(void* to, const void* from, size_t bytes);
void* memmove(void* to, const void* from, size_t bytes);
void* memset(void* to, int byte, size_t bytes);
int memcmp(const void* a, const void* b, size_t bytes);
size_t strlen(const char* text);
int strcmp(const char* a, const char* b);
int strncmp(const char* a, const char* b, size_t most);
char* strchr(const char* text, int c);
char* strcpy(char* to, const char* from);

// Allocate from a heap that grows by blocks of DPMI memory; malloc() returns null when there is no more. free(null) is
// harmless.
void* malloc(size_t bytes);
void free(void* block);

// Support only %d %u %x %c %s %%, with l, width, zero padding, '-', and the precisions %.*s and %.Ns for strings. They never
// write more than `size` bytes and return the length that the whole text would have.
int snprintf(char* to, size_t size, const char* format, ...) __attribute__((format(printf, 3, 4)));
int vsnprintf(char* to, size_t size, const char* format, va_list args);

// Ends the program with a status 0..255. It restores nothing; machine::stop() does that.
[[noreturn]] void exit(int status);
}

#else

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#endif
#endif
