// The heap: one list of free blocks, sorted by address and searched first fit; adjacent free blocks are merged. The heap
// grows by memory from the DPMI host, at any address; the limit of the data segment is raised to reach it. The host frees
// this memory when the program ends.
#include "rt.h"

#include "../dos/dpmi.h"

namespace {

// The header before each block, used or free. Sizes and addresses are multiples of 8.
struct Block {
    uint32_t bytes;  // size, including this header
    Block* next;     // the next free block at a higher address; null in the last and in a used block
};
constexpr uint32_t HEADER = sizeof(Block);
constexpr uint32_t SMALLEST = HEADER + 8;

// The host is asked for CHUNK bytes; when more is needed or CHUNK is not to be had, for whole pages of STEP bytes.
constexpr uint32_t CHUNK = 256 * 1024;
constexpr uint32_t STEP = 4096;

Block* firstFree = nullptr;

// Puts a block into the list of free blocks and merges it with its free neighbours.
void insert(Block* block)
{
    Block* before = nullptr;
    Block* after = firstFree;
    while (after != nullptr && uintptr_t(after) < uintptr_t(block)) {
        before = after;
        after = after->next;
    }
    block->next = after;
    if (after != nullptr && uintptr_t(block) + block->bytes == uintptr_t(after)) {
        block->bytes += after->bytes;
        block->next = after->next;
    }
    if (before == nullptr) {
        firstFree = block;
    } else if (uintptr_t(before) + before->bytes == uintptr_t(block)) {
        before->bytes += block->bytes;
        before->next = block->next;
    } else {
        before->next = block;
    }
}

// Loads the segment registers again, because the processor keeps the old limit until then.
void reloadSegments()
{
    __asm__ volatile(
        "movw %%ds, %%ax\n\t"
        "movw %%ax, %%ds\n\t"
        "movw %%ax, %%es\n\t"
        "movw %%ax, %%ss"
        :
        :
        : "eax", "memory");
}

// Gets a block of `bytes` from the host, makes it accessible through ds, and adds it to the free blocks. Returns false when
// there is no memory.
bool grow(uint32_t bytes)
{
    uint32_t linear;
    uint32_t handle;
    if (!dpmi::allocateMemory(bytes, &linear, &handle))
        return false;
    const uint16_t ds = dpmi::dataSelector();
    // Memory below the base of the segment can be used, too: with a limit of 4 GB the offset wraps around.
    uint32_t offset = linear - dpmi::segmentBase(ds);
    const uint32_t last = offset + (bytes - 1);
    if (last > dpmi::segmentLimit(ds)) {
        const bool done = dpmi::setSegmentLimit(ds, last | 0xfff);
        reloadSegments();
        if (!done || dpmi::segmentLimit(ds) < last) {
            dpmi::freeMemory(handle);
            return false;
        }
    }
    // Hosts return whole pages or at least paragraphs, but DPMI does not guarantee it.
    const uint32_t skip = -offset & 7;
    offset += skip;
    Block* block = reinterpret_cast<Block*>(uintptr_t(offset));
    block->bytes = (bytes - skip) & ~uint32_t(7);
    insert(block);
    return true;
}

// Takes the first free block that is large enough, and splits off the rest. Returns null when there is none.
void* take(uint32_t bytes)
{
    Block* before = nullptr;
    for (Block* block = firstFree; block != nullptr; before = block, block = block->next) {
        if (block->bytes < bytes)
            continue;
        Block* rest = block->next;
        if (block->bytes - bytes >= SMALLEST) {
            rest = reinterpret_cast<Block*>(uintptr_t(block) + bytes);
            rest->bytes = block->bytes - bytes;
            rest->next = block->next;
            block->bytes = bytes;
        }
        if (before == nullptr)
            firstFree = rest;
        else
            before->next = rest;
        block->next = nullptr;
        return block + 1;
    }
    return nullptr;
}

}  // namespace

extern "C" {

void* malloc(size_t wanted)
{
    if (wanted > 0x7fff0000u)
        return nullptr;
    uint32_t bytes = (uint32_t(wanted) + HEADER + 7) & ~uint32_t(7);
    if (bytes < SMALLEST)
        bytes = SMALLEST;
    void* block = take(bytes);
    if (block != nullptr)
        return block;
    // grow() may have to skip up to 7 bytes at the start.
    const uint32_t need = (bytes + 8 + STEP - 1) & ~(STEP - 1);
    if ((need < CHUNK && grow(CHUNK)) || grow(need))
        return take(bytes);
    return nullptr;
}

void free(void* what)
{
    if (what != nullptr)
        insert(static_cast<Block*>(what) - 1);
}

}  // extern "C"
