// Start and end of the program: start.S calls rtStart(), which calls main() with its arguments; exit() returns to DOS.
#include "rt.h"

#include "../dos/dpmi.h"
#include "stubinfo.h"

StubInfo stubInfo;

int main(int argc, char** argv);

namespace {

// The command line has at most 126 characters and therefore at most 63 arguments; the program's name precedes them.
constexpr int MOST_ARGUMENTS = 64;
constexpr int MOST_TAIL = 126;
constexpr int MOST_NAME = 80;

char* arguments[MOST_ARGUMENTS + 1];
char tail[MOST_TAIL + 1];
char name[MOST_NAME];

// Offsets in the program segment prefix.
constexpr uint32_t PSP_ENVIRONMENT = 0x2c;  // selector of the environment, stored there by the DPMI host
constexpr uint32_t PSP_TAIL = 0x80;         // length of the command line, followed by the line

uint8_t peek(uint16_t selector, uint32_t offset)
{
    uint8_t byte;
    __asm__ volatile("movw %w1, %%fs\n\tmovb %%fs:(%2), %0" : "=q"(byte) : "r"(uint32_t(selector)), "r"(offset));
    return byte;
}

// Finds the path of the program: it follows the environment, after two zero bytes and a word. Empty when it is not there.
void findName()
{
    const uint16_t environment =
        uint16_t(peek(stubInfo.pspSelector, PSP_ENVIRONMENT) | peek(stubInfo.pspSelector, PSP_ENVIRONMENT + 1) << 8);
    const uint32_t limit = environment == 0 ? 0 : dpmi::segmentLimit(environment);
    uint32_t at = 0;
    while (at + 3 < limit && (peek(environment, at) != 0 || peek(environment, at + 1) != 0))
        ++at;
    at += 4;
    int length = 0;
    while (at <= limit && length < MOST_NAME - 1) {
        const char c = char(peek(environment, at++));
        if (c == '\0')
            break;
        name[length++] = c;
    }
    name[length] = '\0';
}

// Reads the command line without the program's name.
void readTail()
{
    const int length = peek(stubInfo.pspSelector, PSP_TAIL);
    int used = 0;
    while (used < length && used < MOST_TAIL) {
        const char c = char(peek(stubInfo.pspSelector, PSP_TAIL + 1 + uint32_t(used)));
        if (c == '\r' || c == '\0')
            break;
        tail[used++] = c;
    }
    tail[used] = '\0';
}

// Splits the command line into arguments, in place, and returns their number including the name. Blanks and tabs separate
// arguments, except between double quotes.
int splitTail()
{
    int count = 1;
    const char* from = tail;
    char* to = tail;
    for (;;) {
        while (*from == ' ' || *from == '\t')
            ++from;
        if (*from == '\0' || count == MOST_ARGUMENTS)
            return count;
        arguments[count++] = to;
        bool quoted = false;
        while (*from != '\0' && (quoted || (*from != ' ' && *from != '\t'))) {
            if (*from == '"')
                quoted = !quoted;
            else
                *to++ = *from;
            ++from;
        }
        // The separator must be read before the final 0 may overwrite it; `to` never passes `from`.
        const bool more = *from != '\0';
        if (more)
            ++from;
        *to++ = '\0';
        if (!more)
            return count;
    }
}

}  // namespace

extern "C" {

// The constructors of static objects, collected by the linker script. The program should have none.
typedef void (*Constructor)();
extern Constructor __init_array_start[];
extern Constructor __init_array_end[];

[[noreturn]] void rtStart()
{
    for (Constructor* constructor = __init_array_start; constructor != __init_array_end; ++constructor)
        (*constructor)();
    findName();
    readTail();
    const int count = splitTail();
    arguments[0] = name;
    exit(main(count, arguments));
}

void exit(int status)
{
    // int 21h, AH=4Ch: the DPMI host frees all memory and descriptors of the program.
    for (;;)
        __asm__ volatile("int $0x21" : : "a"(0x4c00 | (status & 0xff)) : "memory");
}

}  // extern "C"
