// The machine as a PC under DOS: its start and end, text output, and access to DOS memory.
#include "machine.h"
#include "pc.h"
#include "rt.h"

#ifdef FB_RT
#include "../rt/stubinfo.h"
#else
#include <crt0.h>
#include <go32.h>

// DJGPP's start-up code would expand `/?` as a pattern of file names, read arguments from a file for `@name`, and read
// DJGPP.ENV. All of this is switched off: the arguments are those of the command line.
int _crt0_startup_flags = _CRT0_DISABLE_SBRK_ADDRESS_WRAP | _CRT0_FLAG_DISALLOW_RESPONSE_FILES;
char** __crt0_glob_function(char*)
{
    return nullptr;
}
void __crt0_load_environment_file(char*) {}
#endif

namespace {

constexpr int STDOUT = 1;
constexpr int STDERR = 2;

bool started = false;

// Writes text through DOS, with the line ends of DOS. Text that cannot be written is lost: an error could not be reported.
void put(int handle, const char* text)
{
    const pc::Transfer buffer = pc::transfer();
    char piece[256];
    while (*text != '\0') {
        uint32_t length = 0;
        while (*text != '\0' && length + 2 <= sizeof piece) {
            if (*text == '\n')
                piece[length++] = '\r';
            piece[length++] = *text++;
        }
        pc::copyToLow(uint32_t(buffer.segment) << 4, piece, length);
        dpmi::RealRegs r = pc::regs(0x4000);
        r.ebx = uint32_t(handle);
        r.ecx = length;
        r.ds = buffer.segment;
        if (!dpmi::realInterrupt(0x21, &r) || pc::carry(r))
            return;
    }
}

}  // namespace

namespace pc {

uint16_t lowMemory()
{
    static uint16_t selector = 0;
    if (selector == 0) {
        selector = dpmi::allocateDescriptor();
        // Without this selector no message can be printed, either.
        if (selector == 0 || !dpmi::setSegmentBase(selector, 0) || !dpmi::setSegmentLimit(selector, 0x10ffff))
            exit(1);
    }
    return selector;
}

void copyToLow(uint32_t to, const void* from, uint32_t bytes)
{
    __asm__ volatile(
        "pushl %%es\n\t"
        "movw %w3, %%es\n\t"
        "rep movsb\n\t"
        "popl %%es"
        : "+D"(to), "+S"(from), "+c"(bytes)
        : "r"(uint32_t(lowMemory()))
        : "memory");
}

void copyFromLow(void* to, uint32_t from, uint32_t bytes)
{
    __asm__ volatile(
        "movw %w3, %%fs\n\t"
        "rep movsb %%fs:(%%esi), %%es:(%%edi)"
        : "+D"(to), "+S"(from), "+c"(bytes)
        : "r"(uint32_t(lowMemory()))
        : "memory");
}

Transfer transfer()
{
#ifdef FB_RT
    const uint32_t bytes = stubInfo.minkeep;
    const uint16_t segment = stubInfo.dsSegment;
#else
    const uint32_t bytes = _go32_info_block.size_of_transfer_buffer;
    const uint16_t segment = uint16_t(_go32_info_block.linear_address_of_transfer_buffer >> 4);
#endif
    return {segment, bytes < 0xf000 ? bytes : 0xf000};
}

}  // namespace pc

namespace machine {

const char* start()
{
    if (started)
        return nullptr;
    started = true;
    pc::openTraps();
    const char* trouble = pc::openBreak();
    if (trouble != nullptr) {
        stop();
        return trouble;
    }
    pc::openClock();
    return nullptr;
}

void stop()
{
    if (!started)
        return;
    started = false;
    closeVideo();
    pc::closeMouse();
    pc::closeClock();
    pc::closeBreak();
    pc::closeTraps();
}

void fail(int status, const char* line)
{
    stop();
    err(line);
    err("\n");
    exit(status);
}

bool broken()
{
    return pc::breakSeen();
}

void out(const char* text)
{
    put(STDOUT, text);
}

void err(const char* text)
{
    put(STDERR, text);
}

}  // namespace machine
