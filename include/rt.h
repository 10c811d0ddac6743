// What the program takes from a C library: a dozen functions. Hosts and DJGPP have them in their libc; for the stock
// compiler, which has none for DOS, src/rt supplies these and no more (FB_RT is defined by the Makefile).
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

// From a heap that grows by DPMI memory; null when there is no more. free(null) is harmless.
void* malloc(size_t bytes);
void free(void* block);

// Only %d %u %x %c %s %% with l, width, zero padding, '-' and %.*s/%.Ns precision for strings; the rest of C's
// conversions is not there. Never writes more than `size` bytes; returns the length the whole text would have.
int snprintf(char* to, size_t size, const char* format, ...) __attribute__((format(printf, 3, 4)));
int vsnprintf(char* to, size_t size, const char* format, va_list args);

// Ends the program with a status 0..255, without anything put back: machine::stop() does that.
[[noreturn]] void exit(int status);
}

#else

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#endif
#endif
