// Files: DOS calls with handles; names and data pass through the transfer buffer.
#include "machine.h"
#include "pc.h"
#include "rt.h"

namespace {

// Error codes of DOS.
constexpr uint32_t NO_FILE = 2;
constexpr uint32_t NO_PATH = 3;
constexpr uint32_t TOO_MANY = 4;
constexpr uint32_t DENIED = 5;
constexpr uint32_t WRITE_PROTECTED = 19;
constexpr uint32_t NOT_READY = 21;
constexpr uint32_t DISK_FULL = 39;
constexpr uint32_t FAILED_CRITICALLY = 83;

constexpr uint32_t LONGEST_NAME = 127;
constexpr uint16_t READ_ONLY = 0x01;  // bits of a file's attributes
constexpr uint16_t DIRECTORY = 0x10;

const char* trouble = "";
char otherTrouble[24];

// The temporary file of beginSave(), and the file that it will replace.
char saving[LONGEST_NAME + 1 + 13];
char savedAs[LONGEST_NAME + 1];

// Stores the text of an error for fileTrouble(). Returns -1, which the caller returns in turn.
int failed(uint32_t error)
{
    switch (error) {
        case NO_FILE:
        case NO_PATH:
            trouble = "no such file or directory";
            break;
        case TOO_MANY:
            trouble = "too many open files";
            break;
        case DENIED:
            trouble = "access denied";
            break;
        case WRITE_PROTECTED:
            trouble = "disk write-protected";
            break;
        case NOT_READY:
        case FAILED_CRITICALLY:
            trouble = "drive not ready";
            break;
        case DISK_FULL:
            trouble = "disk full";
            break;
        default:
            snprintf(otherTrouble, sizeof otherTrouble, "DOS error %u", unsigned(error));
            trouble = otherTrouble;
            break;
    }
    return -1;
}

// Makes a DOS call that reports errors by carry. Returns its result, or -1 after storing the error text. The results of all
// DOS calls used here fit 16 bits.
int call(dpmi::RealRegs* r)
{
    if (!dpmi::realInterrupt(0x21, r))
        return failed(0xffff);
    const uint32_t ax = r->eax & 0xffff;
    return pc::carry(*r) ? failed(ax) : int(ax);
}

// Converts a name to a form that every DOS accepts: backslashes for slashes, no double ones (a directory "A:\" and a name
// give "A:\/NAME"), and none at the end except that of a root. Returns false when the name is too long.
bool tidy(const char* name, char to[LONGEST_NAME + 1])
{
    uint32_t length = 0;
    for (; *name != '\0'; ++name) {
        const char c = *name == '/' ? '\\' : *name;
        if (c == '\\' && length > 0 && to[length - 1] == '\\')
            continue;
        if (length == LONGEST_NAME)
            return false;
        to[length++] = c;
    }
    if (length > 1 && to[length - 1] == '\\' && to[length - 2] != ':')
        --length;
    to[length] = '\0';
    return true;
}

// Makes a DOS call with a file name at ds:dx.
int callOnName(uint32_t eax, uint32_t ecx, const char* name, uint16_t* cx = nullptr)
{
    const pc::Transfer buffer = pc::transfer();
    char copy[LONGEST_NAME + 1];
    if (!tidy(name, copy))
        return failed(NO_PATH);
    pc::copyToLow(uint32_t(buffer.segment) << 4, copy, uint32_t(strlen(copy)) + 1);
    dpmi::RealRegs r = pc::regs(eax);
    r.ecx = ecx;
    r.ds = buffer.segment;
    const int result = call(&r);
    if (cx != nullptr)
        *cx = uint16_t(r.ecx);
    return result;
}

bool renameFile(const char* from, const char* to)
{
    const pc::Transfer buffer = pc::transfer();
    const uint32_t low = uint32_t(buffer.segment) << 4, length = uint32_t(strlen(from)) + 1;
    pc::copyToLow(low, from, length);
    pc::copyToLow(low + length, to, uint32_t(strlen(to)) + 1);
    dpmi::RealRegs r = pc::regs(0x5600);
    r.ds = buffer.segment;
    r.es = buffer.segment;
    r.edi = length;
    return call(&r) >= 0;
}

// Tells whether a name is the current directory or a root directory. DOS has no attributes for these directories. The root
// of a drive exists only if the drive does.
bool isRoot(const char* name)
{
    char copy[LONGEST_NAME + 1];
    if (!tidy(name, copy))
        return false;
    if (strcmp(copy, ".") == 0 || strcmp(copy, "\\") == 0)
        return true;
    if (copy[0] == '\0' || copy[1] != ':' || (copy[2] != '\0' && strcmp(copy + 2, "\\") != 0))
        return false;
    dpmi::RealRegs r = pc::regs(0x3600);  // free space of a drive: dl = 1 for A:; fails when there is no drive
    r.edx = uint32_t(copy[0] & 0x1f);
    return dpmi::realInterrupt(0x21, &r) && uint16_t(r.eax) != 0xffff;
}

}  // namespace

namespace machine {

int createFile(const char* name)
{
    return callOnName(0x3c00, 0, name);
}

int openFile(const char* name)
{
    return callOnName(0x3d00, 0, name);
}

int appendFile(const char* name, bool* fresh)
{
    *fresh = false;
    uint16_t attributes;
    if (callOnName(0x4300, 0, name, &attributes) < 0) {
        *fresh = true;
        return createFile(name);
    }
    const int file = callOnName(0x3d02, 0, name);
    if (file < 0)
        return file;
    dpmi::RealRegs r = pc::regs(0x4202);
    r.ebx = uint32_t(file);
    if (call(&r) < 0) {
        const char* why = trouble;
        closeFile(file);
        trouble = why;
        return -1;
    }
    return file;
}

int32_t readFile(int file, void* to, uint32_t bytes)
{
    const pc::Transfer buffer = pc::transfer();
    uint32_t done = 0;
    while (done < bytes) {
        dpmi::RealRegs r = pc::regs(0x3f00);
        r.ebx = uint32_t(file);
        r.ecx = bytes - done < buffer.bytes ? bytes - done : buffer.bytes;
        r.ds = buffer.segment;
        const int got = call(&r);
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        pc::copyFromLow(static_cast<uint8_t*>(to) + done, uint32_t(buffer.segment) << 4, uint32_t(got));
        done += uint32_t(got);
    }
    return int32_t(done);
}

int32_t writeFile(int file, const void* from, uint32_t bytes)
{
    const pc::Transfer buffer = pc::transfer();
    uint32_t done = 0;
    while (done < bytes) {
        // `piece` is never 0: DOS would truncate the file.
        const uint32_t piece = bytes - done < buffer.bytes ? bytes - done : buffer.bytes;
        pc::copyToLow(uint32_t(buffer.segment) << 4, static_cast<const uint8_t*>(from) + done, piece);
        dpmi::RealRegs r = pc::regs(0x4000);
        r.ebx = uint32_t(file);
        r.ecx = piece;
        r.ds = buffer.segment;
        const int put = call(&r);
        if (put < 0)
            return -1;
        if (uint32_t(put) < piece)
            return failed(DISK_FULL);
        done += piece;
    }
    return int32_t(done);
}

bool closeFile(int file)
{
    dpmi::RealRegs r = pc::regs(0x3e00);
    r.ebx = uint32_t(file);
    return call(&r) >= 0;
}

bool rewindFile(int file)
{
    dpmi::RealRegs r = pc::regs(0x4200);
    r.ebx = uint32_t(file);
    return call(&r) >= 0;
}

int listFiles(const char* directory, const char* ending, FileName* to, int room)
{
    // DOS describes each file in its disk transfer area, which is moved into the transfer buffer during this call; the
    // pattern follows it in the buffer.
    constexpr uint32_t PATTERN = 64;
    constexpr uint32_t NAME = 30;  // offset of the name in the description: 13 bytes, including the final 0
    const pc::Transfer buffer = pc::transfer();
    const uint32_t base = uint32_t(buffer.segment) << 4;
    char joined[LONGEST_NAME + 1];
    char pattern[LONGEST_NAME + 1];
    const int length = snprintf(joined, sizeof joined, "%s%s*%s", directory, directory[0] == '\0' ? "" : "/", ending);
    if (length >= int(sizeof joined) || !tidy(joined, pattern))
        return 0;
    dpmi::RealRegs r = pc::regs(0x2f00);
    dpmi::realInterrupt(0x21, &r);
    const uint16_t oldSegment = r.es;
    const uint32_t oldOffset = r.ebx & 0xffff;
    r = pc::regs(0x1a00);
    r.ds = buffer.segment;
    dpmi::realInterrupt(0x21, &r);
    pc::copyToLow(base + PATTERN, pattern, uint32_t(strlen(pattern)) + 1);

    int count = 0;
    for (uint32_t function = 0x4e00; count < room; function = 0x4f00) {
        r = pc::regs(function);
        r.ds = buffer.segment;
        r.edx = PATTERN;
        if (call(&r) < 0)
            break;
        FileName found = {};
        pc::copyFromLow(found.text, base + NAME, 13);
        int at = count++;
        for (; at > 0 && strcmp(to[at - 1].text, found.text) > 0; --at)
            to[at] = to[at - 1];
        to[at] = found;
    }
    r = pc::regs(0x1a00);
    r.ds = oldSegment;
    r.edx = oldOffset;
    dpmi::realInterrupt(0x21, &r);
    return count;
}

int32_t fileBytes(int file)
{
    dpmi::RealRegs r = pc::regs(0x4202);
    r.ebx = uint32_t(file);
    if (call(&r) < 0)
        return -1;
    return int32_t((r.edx & 0xffff) << 16 | (r.eax & 0xffff));
}

bool cutFile(int file, uint32_t bytes)
{
    dpmi::RealRegs r = pc::regs(0x4200);
    r.ebx = uint32_t(file);
    r.ecx = bytes >> 16;
    r.edx = bytes & 0xffff;
    if (call(&r) < 0)
        return false;
    // Writing 0 bytes truncates the file at this place.
    r = pc::regs(0x4000);
    r.ebx = uint32_t(file);
    r.ds = pc::transfer().segment;
    return call(&r) >= 0;
}

bool removeFile(const char* name)
{
    return callOnName(0x4100, 0, name) >= 0;
}

int beginSave(const char* name)
{
    if (!tidy(name, savedAs))
        return failed(NO_PATH);
    uint16_t attributes = 0;
    const bool there = callOnName(0x4300, 0, savedAs, &attributes) >= 0;
    if (there && (attributes & (READ_ONLY | DIRECTORY)) != 0)
        return failed(DENIED);
    // DOS invents the name of the temporary file. It needs the directory of `name`, ending in a backslash; ".\" stands for a
    // current directory.
    uint32_t folder = 0;
    for (uint32_t i = 0; savedAs[i] != '\0'; ++i)
        if (savedAs[i] == '\\' || savedAs[i] == ':')
            folder = i + 1;
    memcpy(saving, savedAs, folder);
    if (folder == 0 || saving[folder - 1] == ':') {
        saving[folder++] = '.';
        saving[folder++] = '\\';
    }
    saving[folder] = '\0';
    const pc::Transfer buffer = pc::transfer();
    const uint32_t low = uint32_t(buffer.segment) << 4;
    pc::copyToLow(low, saving, folder + 1);
    dpmi::RealRegs r = pc::regs(0x5a00);
    r.ds = buffer.segment;
    const int file = call(&r);
    if (file >= 0) {
        pc::copyFromLow(saving, low, folder + 13);
        saving[folder + 13] = '\0';
    }
    return file;
}

bool endSave(int file, bool good)
{
    const char* why = trouble;
    const bool closed = closeFile(file);
    if (good && !closed)
        why = trouble;
    good = good && closed;
    // DOS cannot rename a file to an existing name, so the old file is removed first.
    uint16_t attributes;
    const bool replaces = good && callOnName(0x4300, 0, savedAs, &attributes) >= 0;
    const bool removed = replaces && removeFile(savedAs);
    if (good && replaces == removed && renameFile(saving, savedAs))
        return true;
    if (good)
        why = trouble;
    // When the old file is gone already, the temporary file holds the only copy and stays.
    if (!removed)
        removeFile(saving);
    trouble = why;
    return false;
}

bool makeDirectory(const char* name)
{
    if (isRoot(name) || callOnName(0x3900, 0, name) >= 0)
        return true;
    const char* why = trouble;
    uint16_t attributes = 0;
    if (callOnName(0x4300, 0, name, &attributes) >= 0 && (attributes & DIRECTORY) != 0)
        return true;
    trouble = why;
    return false;
}

const char* fileTrouble()
{
    return trouble;
}

}  // namespace machine
