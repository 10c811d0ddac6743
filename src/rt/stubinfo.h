// The block in which a go32 stub tells its program where it stands (field names as DJGPP's documentation has them).
#ifndef FB_STUBINFO_H
#define FB_STUBINFO_H

#include <stdint.h>

struct StubInfo {
    char magic[16];          // "go32stub, v 2.0x"
    uint32_t size;           // of this block, in bytes
    uint32_t minstack;       // stack the user wants for the program, in bytes; not heeded, ours is fixed
    uint32_t memoryHandle;   // DPMI handle of the program's memory
    uint32_t initialSize;    // bytes of that memory
    uint16_t minkeep;        // bytes of the transfer buffer
    uint16_t dsSelector;     // the transfer buffer in protected mode
    uint16_t dsSegment;      // and in real mode
    uint16_t pspSelector;    // the program segment prefix
    uint16_t csSelector;     // the stub's code
    uint16_t envSize;        // bytes of environment, up to the program's name
    char basename[8];        // name to load, if not the stub's own
    char argv0[16];
    char dpmiServer[16];
};
static_assert(sizeof(StubInfo) == 84, "the layout is the stub's");

// The stub's block, copied by start.S.
extern "C" StubInfo stubInfo;

#endif
