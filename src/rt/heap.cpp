// The heap: blocks in one list of free ones, sorted by address, first fit; neighbours that are free are one block. It
// grows by memory from the DPMI host, which lies anywhere; the data segment's limit is raised to reach it. What was taken
// is given back by the host when the program ends.
#include "rt.h"

#include "../dos/dpmi.h"

namespace {

// Stands before each block, used or free. Sizes and addresses are multiples of 8.
struct Block {
    uint32_t bytes;  // with this header
    Block* next;     // the next free block at a higher address; null in the last and in a used block
};
constexpr uint32_t HEADER = sizeof(Block);
constexpr uint32_t SMALLEST = HEADER + 8;

// How much the host is asked for: what is needed in whole pages, but this much at a time while the host has it.
constexpr uint32_t CHUNK = 256 * 1024;
constexpr uint32_t STEP = 4096;

Block* firstFree = nullptr;

// Puts a block back into the list and joins it with its neighbours.
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

// The processor keeps a limit until the segment register is loaded again.
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

// Gets a block of `bytes` from the host and within reach of ds; false when there is none.
bool grow(uint32_t bytes)
{
    uint32_t linear;
    uint32_t handle;
    if (!dpmi::allocateMemory(bytes, &linear, &handle))
        return false;
    const uint16_t ds = dpmi::dataSelector();
    // Memory below the segment's base is reached too: the offset wraps, with a limit of 4 GB.
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
    // Hosts give whole pages or at least paragraphs; nothing says that they must.
    const uint32_t skip = -offset & 7;
    offset += skip;
    Block* block = reinterpret_cast<Block*>(uintptr_t(offset));
    block->bytes = (bytes - skip) & ~uint32_t(7);
    insert(block);
    return true;
}

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
    // Room for what grow() may have to skip at the start.
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
