// The block in which a go32 stub describes the program's memory and selectors. Field names are those of DJGPP's documentation.
#ifndef FB_STUBINFO_H
#define FB_STUBINFO_H

#include <stdint.h>

struct StubInfo {
    char magic[16];          // "go32stub, v 2.0x"
    uint32_t size;           // size of this block, bytes
    uint32_t minstack;       // size of the stack that the user wants, bytes; ignored, because our stack has a fixed size
    uint32_t memoryHandle;   // DPMI handle of the program's memory
    uint32_t initialSize;    // size of that memory, bytes
    uint16_t minkeep;        // size of the transfer buffer, bytes
    uint16_t dsSelector;     // selector of the transfer buffer
    uint16_t dsSegment;      // real-mode segment of the transfer buffer
    uint16_t pspSelector;    // selector of the program segment prefix
    uint16_t csSelector;     // selector of the stub's code
    uint16_t envSize;        // size of the environment, including the program's name after it, bytes
    char basename[8];        // name of the file to load, if not the stub's own
    char argv0[16];
    char dpmiServer[16];
};
static_assert(sizeof(StubInfo) == 84, "the layout is the stub's");

// A copy of the stub's block, made by start.S.
extern "C" StubInfo stubInfo;

#endif
