// Tries each promise of machine.h and rt.h about the PC and the run-time on the machine itself: in DOSBox, started by run.sh,
// or on a real PC by hand. The first argument says what to do:
//
//   MTEST ALL [BLOCKS]  runs everything that needs no user; prints `ok NAME` or `FAIL NAME` for each check, status 0 or 1.
//                       BLOCKS: greatest number of 60,000-byte blocks to take from the heap
//   MTEST ARGS ...      prints its arguments in brackets
//   MTEST FULL FILE     fills the disk with FILE, which must end in "disk full"
//   MTEST NOVGA         expects to find no VGA
//   MTEST CRASH N       raises exception N (0, 6, 12, 13; 113: by a wild pointer) in mode 13h while it uses the timer.
//                       12 and 113 need a processor that checks segment limits, which DOSBox's does not
//   MTEST PLAY SECONDS  shows colours and prints the keys, mouse movements and breaks received, until ESC or a break
//   MTEST SCREEN        prints the video mode, the timer's mode and the text on the screen
//   MTEST STATE         prints break vectors, timer mode and free DOS memory, for comparison before and after a program
#include "../../src/dos/pc.h"
#include "machine.h"
#include "rt.h"
#include "math/real.h"

namespace {

int failures = 0;

void print(const char* format, ...) __attribute__((format(printf, 1, 2)));
void print(const char* format, ...) {
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    machine::out(text);
}

void check(const char* name, bool good) {
    print("%s %s\n", good ? "ok" : "FAIL", name);
    failures += good ? 0 : 1;
}

uint32_t biosTicks() {
    return pc::peek32(0x46c);
}

uint8_t videoMode() {
    dpmi::RealRegs r = pc::regs(0x0f00);
    dpmi::realInterrupt(0x10, &r);
    return uint8_t(r.eax & 0x7f);
}

// Returns the timer's mode, 0 to 7, by the 8254's read-back command; mode 2 reads as 2 or 6, mode 3 as 3 or 7.
int timerMode() {
    pc::outPort(0x43, 0xe2);
    return pc::inPort(0x40) >> 1 & 7;
}

void stuffKey(uint16_t scanAndCharacter) {
    dpmi::RealRegs r = pc::regs(0x0500);
    r.ecx = scanAndCharacter;
    dpmi::realInterrupt(0x16, &r);
}

bool same(dpmi::RealAddress a, dpmi::RealAddress b) {
    return a.segment == b.segment && a.offset == b.offset;
}

// ---- rt

volatile int fortyTwo = 42;
struct Constructed {
    Constructed() : value(fortyTwo) {}
    int value;
};
Constructed constructed;

void testStrings() {
    check("static objects are constructed", constructed.value == 42);
    char a[64];
    char b[64];
    memset(a, 'x', sizeof a);
    check("memset and memcmp", a[0] == 'x' && a[63] == 'x' && memcmp(a, a + 1, 63) == 0);
    bool good = true;
    for (uint32_t from = 0; from < 8; ++from) {
        for (uint32_t to = 0; to < 8; ++to) {
            for (uint32_t n = 0; n < 20; ++n) {
                for (uint32_t i = 0; i < sizeof a; ++i) {
                    a[i] = b[i] = char(i);
                }
                memmove(a + 20 + to, a + 20 + from, n);
                for (uint32_t i = 0; i < sizeof a; ++i) {
                    const uint32_t source = i >= 20 + to && i < 20 + to + n ? i - to + from : i;
                    good = good && a[i] == b[source];
                }
            }
        }
    }
    check("memmove, overlapping both ways", good);
    check("strings", strlen("") == 0 && strlen("abc") == 3 && strcmp("a", "a") == 0 && strcmp("a", "b") < 0 &&
                         strcmp("b", "a") > 0 && strcmp("ab", "a") > 0 && strncmp("abx", "aby", 2) == 0 &&
                         strcmp("\xff", "a") > 0 && strcmp(strchr("abc", 'c'), "c") == 0 && strchr("abc", 'd') == nullptr &&
                         *strchr("abc", 0) == 0 && strcmp(strcpy(a, "copied"), "copied") == 0);
}

bool prints(const char* expected, const char* format, ...) __attribute__((format(printf, 2, 3)));
bool prints(const char* expected, const char* format, ...) {
    char text[100];
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return strcmp(text, expected) == 0 && length == int(strlen(expected));
}

void testPrinting() {
    check("numbers", prints("-5|0|4294967295|ff|-2147483648", "%d|%d|%u|%x|%d", -5, 0, 4294967295u, 255u,
                            int(-2147483647 - 1)));
    check("widths", prints("   -5|-5   |-0005|F0000012|  ab|ab  |007", "%5d|%-5d|%05d|F%07d|%4s|%-4s|%03lu", -5, -5, -5,
                           12, "ab", "ab", 7lu));
    check("precision", prints("abc|ab|x%", "%.3s|%.*s|%c%%", "abcdef", 2, "abc", 'x'));
    char small[4] = "zzz";
    const char* volatile six = "abcdef";
    const int length = snprintf(small, 3, "%s", six);
    check("truncation", length == 6 && strcmp(small, "ab") == 0 && snprintf(nullptr, 0, "%d", 123) == 3);
}

void testWide() {
    uint32_t rest = 0;
    check("mulDiv", mulDiv(1000000, 1000000, 3000000) == 333333 && mulDiv(-1000000, 1000000, 3000000) == -333333);
    check("divide", divide64(0x123456789abcdefull, 1000, &rest) == 81985529216486ull && rest == 895);
}

// `most` limits the number of blocks, for a DPMI host that swaps to a slow disk instead of running out of memory.
void testHeap(uint32_t most) {
    // Takes blocks until memory runs out; all of it is written, and the blocks must not overlap.
    constexpr uint32_t BLOCK = 60000;
    uint32_t* chain = nullptr;
    uint32_t count = 0;
    bool aligned = true;
    while (count < most) {
        uint32_t* block = static_cast<uint32_t*>(malloc(BLOCK));
        if (block == nullptr) {
            break;
        }
        aligned = aligned && (uintptr_t(block) & 7) == 0;
        memset(block, int(count & 0xff), BLOCK);
        block[0] = uint32_t(uintptr_t(chain));
        chain = block;
        ++count;
    }
    print("# heap: %u blocks of %u bytes\n", unsigned(count), unsigned(BLOCK));
    check("malloc until memory is out", count > 10 && aligned);
    bool intact = true;
    uint32_t left = count;
    while (chain != nullptr) {
        --left;
        const uint8_t* bytes = reinterpret_cast<uint8_t*>(chain);
        for (uint32_t i = 4; i < BLOCK; ++i) {
            intact = intact && bytes[i] == (left & 0xff);
        }
        uint32_t* next = reinterpret_cast<uint32_t*>(uintptr_t(chain[0]));
        free(chain);
        chain = next;
    }
    check("blocks do not overlap", intact && left == 0);
    uint32_t again = 0;
    while (again < most) {
        uint32_t* block = static_cast<uint32_t*>(malloc(BLOCK));
        if (block == nullptr) {
            break;
        }
        block[0] = uint32_t(uintptr_t(chain));
        chain = block;
        ++again;
    }
    while (chain != nullptr) {
        uint32_t* next = reinterpret_cast<uint32_t*>(uintptr_t(chain[0]));
        free(chain);
        chain = next;
    }
    check("all of it again after free", again == count);
    // Free blocks that came in one piece from the DPMI host are joined again: a block of four times the size fits.
    void* big = malloc(4 * BLOCK);
    check("free blocks join", big != nullptr);
    memset(big, 1, 4 * BLOCK);
    free(big);
    free(nullptr);
    volatile size_t tooMuch = 0x7fffffffu;
    check("too much is refused", malloc(tooMuch) == nullptr);
#ifdef FB_RT
    tooMuch = 0xffffffffu;
    check("far too much is refused", malloc(tooMuch) == nullptr);
#endif
    void* none = malloc(0);
    check("malloc(0)", none != nullptr);
    free(none);

#ifdef FB_RT
    // Blocks larger than the pieces that the heap asks for. (DJGPP's heap does not join the pieces that it needs for them.)
    bool large = true;
    for (uint32_t bytes = 100000; bytes < 1500000; bytes = bytes * 3 / 2) {
        uint8_t* block = static_cast<uint8_t*>(malloc(bytes));
        large = large && block != nullptr;
        if (block != nullptr) {
            memset(block, 1, bytes);
            large = large && block[bytes - 1] == 1;
            free(block);
        }
    }
    check("large blocks", large);
#endif

    // Blocks of random sizes are taken and freed in random order; their contents are checked.
    static uint8_t* blocks[200];
    static uint32_t sizes[200];
    uint32_t seed = 1;
    bool kept = true;
    for (int turn = 0; turn < 5000; ++turn) {
        seed = seed * 1103515245u + 12345u;
        const uint32_t i = (seed >> 16) % 200;
        if (blocks[i] != nullptr) {
            for (uint32_t k = 0; k < sizes[i]; ++k) {
                kept = kept && blocks[i][k] == uint8_t(i);
            }
            free(blocks[i]);
            blocks[i] = nullptr;
        } else {
            sizes[i] = (seed >> 8) % 3000;
            blocks[i] = static_cast<uint8_t*>(malloc(sizes[i]));
            kept = kept && blocks[i] != nullptr;
            memset(blocks[i], int(i), sizes[i]);
        }
    }
    for (uint8_t* block : blocks) {
        free(block);
    }
    check("random sizes in random order", kept);
}

// ---- files

void testDescription() {
    char text[64];
    machine::date(text, sizeof text);
    print("# %s\n", text);
    const char* form = "2000-00-00 00:00:00";
    bool good = strlen(text) == strlen(form);
    for (int i = 0; good && form[i] != '\0'; ++i) {
        good = form[i] == '0' ? text[i] >= '0' && text[i] <= '9' : text[i] == form[i];
    }
    check("date and time of day", good);
    machine::describe(text, sizeof text);
    print("# %s\n", text);
    check("what machine it is", strncmp(text, "DOS ", 4) == 0 && strchr(text, ',') == nullptr &&
                                    strncmp(text + strlen(text) - 2, "86", 2) == 0);
}

void testFiles() {
    constexpr uint32_t BYTES = 150001;
    uint8_t* data = static_cast<uint8_t*>(malloc(BYTES));
    uint8_t* back = static_cast<uint8_t*>(malloc(BYTES + 10));
    for (uint32_t i = 0; i < BYTES; ++i) {
        data[i] = uint8_t(i * 7 + (i >> 8));
    }
    check("makeDirectory", machine::makeDirectory("MTDIR"));
    check("makeDirectory again", machine::makeDirectory("MTDIR") && machine::makeDirectory("MTDIR\\"));
    check("makeDirectory of a root", machine::makeDirectory("C:\\") && machine::makeDirectory("\\") &&
                                         machine::makeDirectory("C:") && machine::makeDirectory("."));
    check("makeDirectory on no drive", !machine::makeDirectory("Y:\\") && !machine::makeDirectory("Y:\\X"));
    check("makeDirectory without parent",
          !machine::makeDirectory("NODIR\\SUB") && strcmp(machine::fileTrouble(), "no such file or directory") == 0);
    int file = machine::createFile("MTDIR\\BIG.DAT");
    check("createFile", file >= 0);
    check("write 150001 bytes", machine::writeFile(file, data, BYTES) == int32_t(BYTES));
    check("write nothing", machine::writeFile(file, data, 0) == 0);
    check("closeFile", machine::closeFile(file));
    check("closeFile of a closed file fails", !machine::closeFile(file));
    file = machine::openFile("mtdir\\/big.dat");
    check("openFile, lower case and slashes", file >= 0);
    check("read it back, and no more", machine::readFile(file, back, BYTES + 10) == int32_t(BYTES) &&
                                           memcmp(data, back, BYTES) == 0 && machine::readFile(file, back, 5) == 0);
    machine::closeFile(file);
    bool fresh = true;
    file = machine::appendFile("MTDIR\\BIG.DAT", &fresh);
    check("appendFile to a file that is there", file >= 0 && !fresh);
    check("append", machine::writeFile(file, "end", 3) == 3 && machine::closeFile(file));
    file = machine::openFile("MTDIR\\BIG.DAT");
    check("appended at the end", machine::readFile(file, back, BYTES + 10) == int32_t(BYTES + 3) &&
                                     memcmp(back + BYTES, "end", 3) == 0);
    machine::closeFile(file);
    file = machine::appendFile("MTDIR\\NEW.DAT", &fresh);
    check("appendFile makes a file", file >= 0 && fresh && machine::writeFile(file, "x", 1) == 1);
    machine::closeFile(file);
    file = machine::appendFile("MTDIR\\BIG.DAT", &fresh);
    check("fileBytes", machine::fileBytes(file) == int32_t(BYTES + 3));
    check("cutFile, and on from there", machine::writeFile(file, "what does not fit", 17) == 17 &&
                                            machine::cutFile(file, 100000) && machine::writeFile(file, "END", 3) == 3 &&
                                            machine::fileBytes(file) == 100003 && machine::closeFile(file));
    file = machine::openFile("MTDIR\\BIG.DAT");
    check("what is left of it", machine::readFile(file, back, BYTES) == 100003 && memcmp(data, back, 100000) == 0 &&
                                    memcmp(back + 100000, "END", 3) == 0);
    machine::closeFile(file);
    check("removeFile", machine::removeFile("MTDIR\\NEW.DAT") && machine::openFile("MTDIR\\NEW.DAT") == -1);
    check("removeFile of no file", !machine::removeFile("MTDIR\\NEW.DAT") &&
                                       strcmp(machine::fileTrouble(), "no such file or directory") == 0);
    check("removeFile of a directory", !machine::removeFile("MTDIR"));
    // When a file is saved, the old one remains until the new one is complete.
    const auto holds = [&](const char* name, const char* text) {
        const int opened = machine::openFile(name);
        const int32_t got = machine::readFile(opened, back, 100);
        machine::closeFile(opened);
        return got == int32_t(strlen(text)) && memcmp(back, text, strlen(text)) == 0;
    };
    static const char* const NAMES[] = {"MTDIR\\SAVED.FB", "mtdir/saved.fb", "SAVED.FB", "C:SAVED.FB",
                                        "C:\\MTDIR\\OTHER.FB"};
    for (const char* name : NAMES) {
        file = machine::beginSave(name);
        check(name, file >= 0 && machine::writeFile(file, "first", 5) == 5 && machine::endSave(file, true) &&
                        holds(name, "first"));
        file = machine::beginSave(name);
        machine::writeFile(file, "half of the sec", 15);
        check("while it is saved", holds(name, "first"));
        check("given up", !machine::endSave(file, false) && holds(name, "first"));
        file = machine::beginSave(name);
        machine::writeFile(file, "second", 6);
        check("saved over it", machine::endSave(file, true) && holds(name, "second"));
    }
    check("beginSave in no directory", machine::beginSave("NODIR\\SAVED.FB") == -1);
    check("beginSave over a directory", machine::beginSave("MTDIR") == -1);
    check("openFile of no file", machine::openFile("NONE.DAT") == -1 &&
                                     strcmp(machine::fileTrouble(), "no such file or directory") == 0);
    static machine::FileName names[8];
    check("no names in a directory that is not there", machine::listFiles("NODIR", ".FB", names, 8) == 0);
    check("names, sorted", machine::listFiles("MTDIR", ".fb", names, 8) == 2 && strcmp(names[0].text, "OTHER.FB") == 0 &&
                               strcmp(names[1].text, "SAVED.FB") == 0);
    check("no more than there is room for", machine::listFiles("C:\\MTDIR\\", ".FB", names, 1) == 1);
    file = machine::createFile("MTDIR\\TWICE.X");
    check("rewindFile", machine::writeFile(file, "abc", 3) == 3 && machine::rewindFile(file) &&
                            machine::writeFile(file, "x", 1) == 1 && machine::closeFile(file));
    file = machine::openFile("MTDIR\\TWICE.X");
    check("the first byte is another, the rest is there", machine::readFile(file, back, 9) == 3 && memcmp(back, "xbc", 3) == 0);
    machine::closeFile(file);
    machine::removeFile("MTDIR\\TWICE.X");
    // (DOS says "access denied"; DOSBox says that there is no such file.)
    check("createFile over a directory", machine::createFile("MTDIR") == -1);
    char longName[200];
    memset(longName, 'A', sizeof longName);
    longName[199] = '\0';
    check("a name too long", machine::createFile(longName) == -1);
    check("a handle that is none", machine::writeFile(77, "x", 1) == -1 && machine::readFile(77, back, 1) == -1);
    free(data);
    free(back);
}

// ---- machine

void testClock() {
    const int found = timerMode();
    print("# timer found in mode %d\n", found & 3);
    check("start", machine::start() == nullptr);
    check("start again is harmless", machine::start() == nullptr);
    check("timer in mode 2", (timerMode() & 3) == 2);

    // For three seconds the clock must not run backwards or jump by a whole tick, and must count 65,536 per BIOS tick.
    uint32_t tick = biosTicks();
    while (biosTicks() == tick) {
    }
    tick = biosTicks();
    const uint64_t begin = machine::clock();
    uint64_t before = begin;
    uint32_t longest = 0;
    bool back = false;
    uint32_t looks = 0;
    while (biosTicks() - tick < 55) {
        const uint64_t now = machine::clock();
        back = back || now < before;
        if (now - before > longest) {
            longest = uint32_t(now - before);
        }
        before = now;
        ++looks;
    }
    const uint64_t end = machine::clock();
    const uint32_t expected = 55u << 16;
    const int32_t off = int32_t(uint32_t(end - begin) - expected);
    print("# clock: %u looks, off by %d in %u, longest step %u\n", unsigned(looks), int(off), unsigned(expected),
          unsigned(longest));
    check("clock never goes back", !back);
    check("clock agrees with the BIOS", off > -6000 && off < 6000);
    check("clock has no gaps", longest < 60000 && looks > 200);
    machine::stop();
    machine::stop();
    check("timer back in the mode found", timerMode() == found);
}

uint8_t clockSeconds() {
    for (;;) {
        pc::outPort(0x70, 0x0a);
        if ((pc::inPort(0x71) & 0x80) != 0) {
            continue;
        }
        pc::outPort(0x70, 0x00);
        const uint8_t bcd = pc::inPort(0x71);
        return uint8_t((bcd >> 4) * 10 + (bcd & 15));
    }
}

// Many starts and stops must not make the time of day late.
void testTimeOfDay() {
    uint8_t second = clockSeconds();
    while (clockSeconds() == second) {
    }
    second = clockSeconds();
    const uint32_t begin = biosTicks();
    for (int i = 0; i < 25; ++i) {
        machine::start();
        // Waits for nearly half a tick, which would be lost if the timer were set anew at once.
        while (machine::clock() < 30000) {
        }
        machine::stop();
    }
    const uint8_t after = clockSeconds();
    while (clockSeconds() == after) {
    }
    const uint32_t seconds = uint32_t(clockSeconds() + 60 - second) % 60;
    const uint32_t ticks = biosTicks() - begin;
    const int32_t off = int32_t(ticks * 10) - int32_t(seconds * 182);
    print("# time of day: %u ticks in %u s of the real-time clock\n", unsigned(ticks), unsigned(seconds));
    check("25 starts and stops cost the time of day nothing", off > -50 && off < 50);
}

const int breakVectors[] = {0x1b, 0x23, 0x24};
dpmi::RealAddress breakVectorsFound[3];

void noteVectors() {
    for (int i = 0; i < 3; ++i) {
        breakVectorsFound[i] = dpmi::realVector(breakVectors[i]);
    }
}

void testBreak() {
    check("not broken before", !machine::broken());
    machine::start();
    check("not broken", !machine::broken());
    dpmi::RealRegs r = pc::regs(0);
    dpmi::realInterrupt(0x24, &r);
    check("a critical error fails the call", (r.eax & 0xff) == 3);
    check("which is no break", !machine::broken());
    r = pc::regs(0);
    dpmi::realInterrupt(0x1b, &r);
    check("Ctrl-Break is seen", machine::broken());
    machine::stop();
    check("and still after stop", machine::broken());
    machine::start();
    check("a new start forgets it", !machine::broken());
    r = pc::regs(0);
    dpmi::realInterrupt(0x23, &r);
    check("Ctrl-C in DOS is seen", machine::broken());
    machine::stop();
    machine::start();
    stuffKey(0x2e03);
    check("Ctrl-C as a key is no key", machine::key() == 0);
    check("but a break", machine::broken());
    machine::stop();
    bool restored = true;
    for (int i = 0; i < 3; ++i) {
        restored = restored && same(breakVectorsFound[i], dpmi::realVector(breakVectors[i]));
    }
    check("vectors are put back", restored);
}

void testKeys() {
    machine::start();
    while (machine::key() != 0) {
    }
    stuffKey(0x1e61);
    stuffKey(0x3b00);
    stuffKey(0x48e0);
    stuffKey(0x0000);  // the entry that Ctrl-Break leaves
    stuffKey(0x011b);
    stuffKey(0x372a);
    check("a character", machine::key() == 'a');
    check("F1", machine::key() == machine::KEY_F1);
    check("grey up", machine::key() == machine::KEY_UP);
    check("ESC, after an empty entry", machine::key() == machine::KEY_ESC);
    check("*", machine::key() == '*');
    check("no key", machine::key() == 0);
    const uint8_t flags = pc::peek8(0x417);
    pc::poke8(0x417, uint8_t(flags | 0x40));
    stuffKey(0x2d58);  // with Caps Lock, X comes without Shift and x with Shift
    stuffKey(0x2d78);
    stuffKey(0x0231);
    check("Caps Lock: x", machine::key() == 'x');
    check("Caps Lock: X", machine::key() == 'X');
    check("Caps Lock: 1", machine::key() == '1');
    pc::poke8(0x417, flags);
    const bool mouse = machine::openMouse();
    const machine::Mouse m = machine::mouse();
    print("# mouse: %s, %d %d\n", mouse ? "yes" : "no", m.dx, m.dy);
    check("nothing moved", m.dx == 0 && m.dy == 0 && !m.left && !m.right);
    machine::stop();
}

void testVideo() {
    const uint8_t before = videoMode();
    static uint8_t palette[768];
    static uint8_t frame[machine::WIDTH * machine::HEIGHT];
    static uint8_t back[machine::WIDTH * machine::HEIGHT];
    static Span rows[machine::HEIGHT];
    for (int i = 0; i < 768; ++i) {
        palette[i] = uint8_t((i * 5 + 3) & 63);
    }
    for (uint32_t i = 0; i < sizeof frame; ++i) {
        frame[i] = uint8_t(i * 3 + i / 320);
    }
    machine::start();
    const char* trouble = machine::openVideo();
    const uint8_t during = videoMode();
    machine::setPalette(palette);
    pc::outPort(0x3c7, 0);
    bool colours = true;
    for (int i = 0; i < 768; ++i) {
        colours = colours && pc::inPort(0x3c9) == palette[i];
    }
    for (int y = 0; y < machine::HEIGHT; ++y) {
        // Spans of every width; some rows are empty.
        rows[y].from = int16_t(y % 40 * 4);
        rows[y].to = int16_t(320 - y % 41 * 4);
        if (y % 10 == 0) {
            rows[y].to = rows[y].from;
        }
        if (y % 10 == 1) {
            rows[y].from = 320;
            rows[y].to = 0;
        }
    }
    machine::present(frame, rows);
    pc::copyFromLow(back, 0xa0000, sizeof back);
    bool shown = true;
    for (int y = 0; y < machine::HEIGHT; ++y) {
        for (int x = 0; x < machine::WIDTH; ++x) {
            const bool touched = x >= rows[y].from && x < rows[y].to;
            shown = shown && back[y * 320 + x] == (touched ? frame[y * 320 + x] : 0);
        }
    }
    const uint64_t begin = machine::clock();
    for (int i = 0; i < 14; ++i) {
        machine::waitRetrace();
    }
    const uint32_t ms = uint32_t(divide64((machine::clock() - begin) * 1000, machine::CLOCK_HZ));
    machine::closeVideo();
    const uint8_t after = videoMode();
    machine::closeVideo();
    machine::stop();
    check("openVideo", trouble == nullptr);
    check("mode 13h", during == 0x13);
    check("palette reads back", colours);
    check("present shows the spans and nothing else", shown);
    print("# 14 retraces: %u ms\n", unsigned(ms));
    check("14 retraces are about 0.2 s", ms > 150 && ms < 260);
    check("old mode back", after == before);
}

int all(uint32_t mostBlocks) {
    noteVectors();
    testStrings();
    testPrinting();
    testWide();
    testHeap(mostBlocks);
    testFiles();
    testDescription();
    testClock();
    testTimeOfDay();
    testBreak();
    testKeys();
    testVideo();
    print("# all of it\n");
    return failures == 0 ? 0 : 1;
}

int full(const char* name) {
    machine::start();
    const int file = machine::createFile(name);
    check("createFile", file >= 0);
    static uint8_t data[10000];
    uint32_t bytes = 0;
    while (bytes < 4000000 && machine::writeFile(file, data, sizeof data) == int32_t(sizeof data)) {
        bytes += sizeof data;
    }
    print("# %u bytes fitted: %s\n", unsigned(bytes), machine::fileTrouble());
    check("the disk is full", bytes < 4000000 && strcmp(machine::fileTrouble(), "disk full") == 0);
    machine::closeFile(file);
    machine::stop();
    return failures;
}

int crash(int number) {
    machine::start();
    machine::openVideo();
    volatile int zero = 0;
    switch (number) {
        case 0:
            // (The compiler can divide 1 by a variable without a division instruction.)
            __asm__ volatile("xorl %%edx, %%edx\n\tdivl %0" : : "m"(zero) : "eax", "edx");
            break;
        case 6:
            __asm__ volatile("ud2");
            break;
        case 12:
            __asm__ volatile("movl $0x7ffffff0, %esp\n\tpushl %eax");
            break;
        case 13:
            // An invalid selector. (DOSBox checks selectors, but not the limits of segments.)
            __asm__ volatile("movw %w0, %%gs" : : "r"(0xfff8));
            break;
        case 113:
            // The access exceeds the limit of ds, wherever the limit is.
            *reinterpret_cast<volatile int*>(uintptr_t(dpmi::segmentLimit(dpmi::dataSelector()) - 1)) = 1;
            break;
        default:
            break;
    }
    machine::stop();
    machine::out("no exception came\n");
    return 3;
}

int play(uint32_t seconds) {
    const char* trouble = machine::start();
    if (trouble == nullptr) {
        trouble = machine::openVideo();
    }
    if (trouble != nullptr) {
        machine::fail(1, trouble);
    }
    static uint8_t frame[machine::WIDTH * machine::HEIGHT];
    static Span rows[machine::HEIGHT];
    static char log[4000];
    uint32_t used = 0;
    for (uint32_t i = 0; i < sizeof frame; ++i) {
        frame[i] = uint8_t(i % 320 * 4 / 5);
    }
    for (Span& row : rows) {
        row = {0, 320};
    }
    const bool haveMouse = machine::openMouse();
    int dx = 0;
    int dy = 0;
    int lefts = 0;
    int rights = 0;
    bool right = false;
    bool done = false;
    machine::present(frame, rows);
    while (!done && !machine::broken() && machine::clock() < uint64_t(seconds) * machine::CLOCK_HZ) {
        for (int key = machine::key(); key != 0; key = machine::key()) {
            if (used + 20 < sizeof log) {
                used += uint32_t(snprintf(log + used, sizeof log - used, "key %x\n", unsigned(key)));
            }
            done = done || key == machine::KEY_ESC;
        }
        const machine::Mouse m = machine::mouse();
        dx += m.dx;
        dy += m.dy;
        lefts += m.presses;
        rights += m.right && !right ? 1 : 0;
        right = m.right;
        machine::waitRetrace();
    }
    const bool broken = machine::broken();
    machine::stop();
    machine::out(log);
    print("mouse %s dx %d dy %d lefts %d rights %d\n", haveMouse ? "yes" : "no", dx, dy, lefts, rights);
    print("broken %s\n", broken ? "yes" : "no");
    return 0;
}

int screen() {
    char line[82];
    print("mode %x\n", unsigned(videoMode()));
    print("timer mode %d\n", timerMode() & 3);
    for (uint32_t y = 0; y < 25; ++y) {
        int length = 0;
        for (uint32_t x = 0; x < 80; ++x) {
            const char c = char(pc::peek8(0xb8000 + (y * 80 + x) * 2));
            line[x] = c == '\0' ? ' ' : c;
            if (line[x] != ' ') {
                length = int(x) + 1;
            }
        }
        line[length] = '\0';
        print("%s\n", line);
    }
    return 0;
}

int state() {
    const int vectors[] = {0x08, 0x09, 0x10, 0x16, 0x1b, 0x1c, 0x21, 0x23, 0x24, 0x33};
    for (int vector : vectors) {
        const dpmi::RealAddress at = dpmi::realVector(vector);
        // 23h and 24h belong to the running program, so they differ and are not printed.
        if (vector != 0x23 && vector != 0x24) {
            print("int %xh %04x:%04x\n", unsigned(vector), unsigned(at.segment), unsigned(at.offset));
        }
    }
    print("timer mode %d, video mode %x\n", timerMode() & 3, unsigned(videoMode()));
    dpmi::RealRegs r = pc::regs(0x3300);
    dpmi::realInterrupt(0x21, &r);
    print("break %u\n", unsigned(r.edx & 0xff));
    r = pc::regs(0x4800);
    r.ebx = 0xffff;
    dpmi::realInterrupt(0x21, &r);
    print("free paragraphs %u\n", unsigned(r.ebx & 0xffff));
    return 0;
}

int number(const char* text) {
    int value = 0;
    for (; *text >= '0' && *text <= '9'; ++text) {
        value = value * 10 + (*text - '0');
    }
    return value;
}

}  // namespace

int main(int argc, char** argv) {
    const char* what = argc > 1 ? argv[1] : "";
    const char* with = argc > 2 ? argv[2] : "";
    if (strcmp(what, "ALL") == 0) {
        return all(argc > 2 ? uint32_t(number(with)) : 0xffffffffu);
    }
    if (strcmp(what, "ARGS") == 0) {
        for (int i = 2; i < argc; ++i) {
            print("[%s]\n", argv[i]);
        }
        print("name %s\n", argv[0]);
        print("end %s\n", argv[argc] == nullptr ? "null" : "not null");
        return argc;
    }
    if (strcmp(what, "FULL") == 0) {
        return full(with);
    }
    if (strcmp(what, "NOVGA") == 0) {
        machine::start();
        const char* trouble = machine::openVideo();
        machine::fail(trouble != nullptr ? 1 : 0, trouble != nullptr ? trouble : "a VGA");
    }
    if (strcmp(what, "CRASH") == 0) {
        return crash(number(with));
    }
    if (strcmp(what, "PLAY") == 0) {
        return play(uint32_t(number(with)));
    }
    if (strcmp(what, "SCREEN") == 0) {
        return screen();
    }
    if (strcmp(what, "STATE") == 0) {
        return state();
    }
    machine::fail(2, "MTEST ALL | ARGS ... | FULL FILE | NOVGA | CRASH N | PLAY SECONDS | SCREEN | STATE");
}
