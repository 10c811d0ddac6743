// DTEST.EXE tests a DPMI host, the stub's own or another, service by service: what each service promises and what it must
// refuse. It prints `ok NAME` or `FAIL NAME` for each check. The first argument says what to do:
//
//   DTEST ALL             tests every service with arguments that it must accept and that it must refuse (default)
//   DTEST GOOD [NOWILD]   only with arguments to accept, as every host should; some hosts crash on the others.
//                         NOWILD: without wild pointers
//   DTEST TICKS N DIV     N timer interrupts at 1193182/DIV Hz, reflected to real mode under load; none may be lost
//   DTEST CRASH KIND      ends by an exception: 0, 6, 13, 14 (wild pointer), S (stack overflow), L (stack overflow with frames
//                         of 4 and 8 KB, and handlers like those of DJGPP's libc), R (a handler returns without any remedy),
//                         H (in the host: the selector of a call-back's registers was freed)
//   DTEST BREAK           ends by Ctrl-C
//   DTEST CATCH           takes the keyboard interrupt, as DJGPP's libc does: the host must then leave Ctrl-C to the program
//   DTEST MOUSE SECONDS   counts calls of the mouse driver's call-back
//   DTEST FREE            prints free DOS and extended memory, for comparison before and after other programs
//   DTEST SCREEN          prints the video mode and the text on the screen
//   DTEST TIME N          prints the cost of a timer interrupt in instructions, on a machine with a fixed number of cycles
//
#include "../../src/dos/dpmi.h"
#include "../../src/rt/stubinfo.h"
#include "rt.h"

struct Int31 {
    uint32_t eax, ebx, ecx, edx, esi, edi;
    uint16_t es, ds;
    uint32_t flags;
};

extern "C" {
void int31(Int31*);
void handler60();
void tickChain();
void tickOwn();
void countOnly();
void exceptionSeen();
void raise(int kind);
void callBack();
void callBackInt();
void callBackNested();
void callBackMouse();
void rawSwitch(const uint16_t* where);
void rawBack();
uint32_t int10(uint32_t eax);
uint32_t int16(uint32_t eax);
uint32_t int21(uint32_t eax);
uint32_t int33(uint32_t eax);
uint32_t int60(uint32_t eax);
void overflow();
void largeFrames();
void exceptionAgain();
void exceptionOnStack();
extern volatile uint32_t ticks, counted, seenError, seenEip, seenStack, raiseEip, wildSteps, nestedStack, rawEsp, rawEbp;
extern volatile uint32_t intFlags, intEbx;
extern struct Far {
    uint32_t offset;
    uint16_t selector;
} oldHandler, rawToReal;
extern uint16_t dataSelector;
void nested(dpmi::RealRegs*);
}

namespace {

int failures = 0;
bool strict = true;  // false with GOOD: checks of refusals are left out
bool wild = true;    // false with NOWILD
uint32_t ourBase;  // linear address of the data segment's offset 0

// ---- Printing, through the transfer buffer, because the buffer is a promise of the stub too

uint8_t* linear(uint32_t address) {
    return reinterpret_cast<uint8_t*>(address - ourBase);
}

void print(const char* format, ...) __attribute__((format(printf, 1, 2)));
void print(const char* format, ...) {
    char text[200];
    va_list args;
    va_start(args, format);
    int length = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    uint8_t* buffer = linear(stubInfo.dsSegment * 16u);
    uint32_t used = 0;
    for (int i = 0; i < length; ++i) {
        if (text[i] == '\n') buffer[used++] = '\r';
        buffer[used++] = uint8_t(text[i]);
    }
    dpmi::RealRegs r = {};
    r.eax = 0x4000;
    r.ebx = 1;
    r.ecx = used;
    r.ds = stubInfo.dsSegment;
    dpmi::realInterrupt(0x21, &r);
}

void check(const char* name, bool good) {
    print("%s %s\n", good ? "ok" : "FAIL", name);
    failures += good ? 0 : 1;
}

// ---- int 31h

// A check made with ALL only: that a service refuses something, or does more than DPMI 0.9 requires. The expression, and with
// it the service, is evaluated with ALL only.
#define STRICT(name, made) \
    do {                    \
        if (strict) check(name, made); \
    } while (false)

bool carry(const Int31& r) { return (r.flags & 1) != 0; }

Int31 call(uint32_t eax, uint32_t ebx = 0, uint32_t ecx = 0, uint32_t edx = 0, uint32_t esi = 0, uint32_t edi = 0) {
    Int31 r = {eax, ebx, ecx, edx, esi, edi, dpmi::dataSelector(), dpmi::dataSelector(), 0};
    int31(&r);
    return r;
}

uint32_t low(uint32_t x) { return x & 0xffff; }
uint32_t pair(uint32_t high, uint32_t lowPart) { return high << 16 | low(lowPart); }
uint32_t offsetOf(void (*f)()) { return reinterpret_cast<uint32_t>(f); }
uint32_t offsetOf(const volatile void* p) { return reinterpret_cast<uint32_t>(p); }

bool sameBytes(const void* a, const void* b, uint32_t n) { return memcmp(a, b, n) == 0; }

// ---- 0000h to 000Ch

void testDescriptors() {
    Int31 r = call(0x0000, 0, 1);
    const uint32_t one = low(r.eax);
    check("0000 one descriptor", !carry(r) && (one & 7) == 7);
    r = call(0x0006, one);
    check("0006 its base is 0", !carry(r) && pair(r.ecx, r.edx) == 0);
    check("0008 its limit is 0", dpmi::segmentLimit(uint16_t(one)) == 0);
    r = call(0x0000, 0, 3);
    const uint32_t three = low(r.eax);
    const uint32_t step = low(call(0x0003).eax);
    check("0003 increment", step == 8);
    bool good = !carry(r);
    for (uint32_t i = 0; i < 3; ++i) good = good && !carry(call(0x0007, three + i * step, 0x0012, 0x3450 + i));
    for (uint32_t i = 0; i < 3; ++i) {
        r = call(0x0006, three + i * step);
        good = good && pair(r.ecx, r.edx) == 0x00123450 + i;
    }
    check("0000 three in a row, each its own base", good);
    STRICT("0000 none refused", carry(call(0x0000, 0, 0)));
    STRICT("0000 too many refused", carry(call(0x0000, 0, 0xffff)));
    for (uint32_t i = 0; i < 3; ++i) good = good && !carry(call(0x0001, three + i * step));
    check("0001 freed", good);
    STRICT("0001 twice refused", carry(call(0x0001, three)));
    STRICT("0001 null selector refused", carry(call(0x0001, 0)));
    STRICT("0006 freed selector refused", carry(call(0x0006, three)));
    STRICT("0007 freed selector refused", carry(call(0x0007, three, 0, 0)));
    STRICT("0008 freed selector refused", carry(call(0x0008, three, 0, 0)));
    STRICT("0009 freed selector refused", carry(call(0x0009, three, 0xf2)));
    STRICT("000A freed selector refused", carry(call(0x000a, three)));

    check("0008 limit of bytes", !carry(call(0x0008, one, 0x000f, 0xffff)) && dpmi::segmentLimit(uint16_t(one)) == 0xfffff);
    check("0008 limit of 4 GB", !carry(call(0x0008, one, 0xffff, 0xffff)) && dpmi::segmentLimit(uint16_t(one)) == 0xffffffff);
    check("0008 limit of pages", !carry(call(0x0008, one, 0x0123, 0x4fff)) && dpmi::segmentLimit(uint16_t(one)) == 0x1234fff);
    STRICT("0008 odd limit above 1 MB refused", carry(call(0x0008, one, 0x0123, 0x4567)));
    check("0008 small again", !carry(call(0x0008, one, 0, 0x00ff)) && dpmi::segmentLimit(uint16_t(one)) == 0xff);

    uint8_t descriptor[8] = {};
    r = call(0x000b, one, 0, 0, 0, offsetOf(descriptor));
    check("000B get", !carry(r) && descriptor[0] == 0xff && descriptor[1] == 0 && (descriptor[5] & 0xfe) == 0xf2);
    check("0009 32-bit code", !carry(call(0x0009, one, 0x40fa)));
    call(0x000b, one, 0, 0, 0, offsetOf(descriptor));
    check("0009 seen by 000B", (descriptor[5] & 0xfe) == 0xfa && (descriptor[6] & 0x40) != 0);
    STRICT("0009 ring 0 refused", carry(call(0x0009, one, 0x4092)));
    STRICT("0009 system segment refused", carry(call(0x0009, one, 0x00e2)));
    call(0x0009, one, 0x40f2);  // some hosts accept any access rights
    descriptor[2] = 0x34;
    descriptor[3] = 0x12;
    descriptor[5] = 0xf2;
    check("000C set", !carry(call(0x000c, one, 0, 0, 0, offsetOf(descriptor))));
    r = call(0x0006, one);
    check("000C seen by 0006", low(r.edx) == 0x1234);
    descriptor[5] = 0x92;
    STRICT("000C ring 0 refused", carry(call(0x000c, one, 0, 0, 0, offsetOf(descriptor))));
    descriptor[5] = 0xf2;
    call(0x000c, one, 0, 0, 0, offsetOf(descriptor));

    r = call(0x000a, dpmi::codeSelector());
    const uint32_t alias = low(r.eax);
    static volatile uint32_t word = 0;
    __asm__ volatile("movw %w0, %%fs\n\tmovl $0x5a5a5a5a, %%fs:(%1)" : : "r"(alias), "r"(&word) : "memory");
    check("000A alias of the code can be written", !carry(r) && word == 0x5a5a5a5a);
    __asm__ volatile("movw %w0, %%fs" : : "r"(0));
    call(0x0001, alias);

    r = call(0x0002, 0xb800);
    Int31 again = call(0x0002, 0xb800);
    Int31 base = call(0x0006, low(r.eax));
    check("0002 segment", !carry(r) && pair(base.ecx, base.edx) == 0xb8000 && dpmi::segmentLimit(uint16_t(r.eax)) == 0xffff);
    check("0002 the same again", low(again.eax) == low(r.eax));
    check("000D the first ones", !carry(call(0x000d, 0x17)) && carry(call(0x000d, 0x17)) && !carry(call(0x0001, 0x17)));

    __asm__ volatile("movw %w0, %%gs" : : "r"(one));
    call(0x0001, one);
    uint16_t gs;
    __asm__ volatile("movw %%gs, %0" : "=r"(gs));
    check("0001 clears a segment register", gs == 0);

    static uint16_t many[8192];
    uint32_t count = 0;
    while (count < 8192 && !carry(r = call(0x0000, 0, 1))) many[count++] = uint16_t(r.eax);
    check("0000 until there are none", count > 50 && count < 8192);
    print("# %u descriptors\n", unsigned(count));
    good = true;
    for (uint32_t i = 0; i < count; ++i) good = good && !carry(call(0x0001, many[i]));
    r = call(0x0000, 0, 1);
    check("0001 all of them", good && !carry(r));
    call(0x0001, low(r.eax));
}

// ---- 0100h to 0102h

void testDosMemory() {
    Int31 r = call(0x0100, 0xffff);
    const uint32_t largest = low(r.ebx);
    check("0100 too much: error 8 and the largest block", carry(r) && low(r.eax) == 8 && largest > 0x100 && largest < 0xa000);
    r = call(0x0100, 0x20);
    const uint32_t segment = low(r.eax), selector = low(r.edx);
    Int31 base = call(0x0006, selector);
    check("0100 512 bytes", !carry(r) && pair(base.ecx, base.edx) == segment * 16 &&
                                dpmi::segmentLimit(uint16_t(selector)) == 0x1ff);
    check("0102 larger", !carry(call(0x0102, 0x1100, 0, selector)) && dpmi::segmentLimit(uint16_t(selector)) == 0x10fff);
    r = call(0x0102, 0xffff, 0, selector);
    check("0102 too large: error 8 and the largest", carry(r) && low(r.eax) == 8 && low(r.ebx) > 0x100);
    check("0102 smaller", !carry(call(0x0102, 0x10, 0, selector)) && dpmi::segmentLimit(uint16_t(selector)) == 0xff);
    check("0101 free", !carry(call(0x0101, 0, 0, selector)));
    STRICT("0101 twice refused", carry(call(0x0101, 0, 0, selector)));
    STRICT("0102 freed refused", carry(call(0x0102, 1, 0, selector)));
    check("0100 all of it is back", low(call(0x0100, 0xffff).ebx) == largest);
}

// ---- Real-mode code in a DOS block: its segment, and a pointer to the block

uint16_t codeSegment;
uint8_t* code;

void putCode(uint32_t at, const uint8_t* bytes, uint32_t n) { memcpy(code + at, bytes, n); }

void testRealMode() {
    Int31 r = call(0x0100, 0x100);
    codeSegment = uint16_t(r.eax);
    code = linear(codeSegment * 16u);
    static const uint8_t addFar[] = {0x01, 0xd8, 0xcb};                          // add ax, bx; retf
    static const uint8_t addIret[] = {0x01, 0xd8, 0xcf};                         // add ax, bx; iret
    static const uint8_t stackWord[] = {0x89, 0xe5, 0x8b, 0x46, 0x04, 0xcb};     // mov bp, sp; mov ax, [bp+4]; retf
    static const uint8_t stackInt[] = {0x89, 0xe5, 0x8b, 0x46, 0x08, 0xcf};      // mov bp, sp; mov ax, [bp+8]; iret
    static const uint8_t allRegs[] = {0x66, 0xf7, 0xd0, 0x66, 0xf7, 0xd3, 0x66, 0xf7, 0xd1, 0x66, 0xf7, 0xd2,
                                      0x66, 0xf7, 0xd6, 0x66, 0xf7, 0xd7, 0x66, 0xf7, 0xd5,  // not eax ... ebp
                                      0x06, 0x1e, 0x07, 0x1f, 0xf9, 0xcb};       // exchanges es and ds; stc; retf
    static const uint8_t ifState[] = {0x9c, 0x58, 0xcf};                         // pushf; pop ax; iret
    putCode(0x000, addFar, sizeof addFar);
    putCode(0x010, addIret, sizeof addIret);
    putCode(0x020, stackWord, sizeof stackWord);
    putCode(0x030, stackInt, sizeof stackInt);
    putCode(0x040, allRegs, sizeof allRegs);
    putCode(0x080, ifState, sizeof ifState);

    dpmi::RealRegs regs = {};
    regs.eax = 0x1111;
    regs.ebx = 0x2222;
    regs.cs = codeSegment;
    r = call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
    check("0301 far call", !carry(r) && low(regs.eax) == 0x3333);
    regs.ip = 0x10;
    r = call(0x0302, 0, 0, 0, 0, offsetOf(&regs));
    check("0302 call with IRET", !carry(r) && low(regs.eax) == 0x5555);
    regs.eax = 0x12345678;
    regs.ebx = 0x23456789;
    regs.ecx = 0x3456789a;
    regs.edx = 0x456789ab;
    regs.esi = 0x56789abc;
    regs.edi = 0x6789abcd;
    regs.ebp = 0x789abcde;
    regs.es = 0x1234;
    regs.ds = 0x5678;
    regs.flags = 0x0200;
    regs.ip = 0x40;
    r = call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
    check("0301 all registers both ways", !carry(r) && regs.eax == ~0x12345678u && regs.ebx == ~0x23456789u &&
                                              regs.ecx == ~0x3456789au && regs.edx == ~0x456789abu &&
                                              regs.esi == ~0x56789abcu && regs.edi == ~0x6789abcdu &&
                                              regs.ebp == ~0x789abcdeu && regs.es == 0x5678 && regs.ds == 0x1234 &&
                                              (regs.flags & 1) == 1);
    // The host copies two words from our stack, so this assembly pushes them just before the call.
    uint32_t result;
    regs = {};
    regs.cs = codeSegment;
    regs.ip = 0x20;
    __asm__ volatile("pushl $0x77778888\n\tint $0x31\n\tleal 4(%%esp), %%esp"
                     : "=a"(result)
                     : "a"(0x0301), "b"(0), "c"(2), "D"(&regs)
                     : "memory", "cc");
    check("0301 words from the stack", low(regs.eax) == 0x8888);

    // The structure names a real-mode stack of our own.
    regs = {};
    regs.eax = 1;
    regs.ebx = 2;
    regs.cs = codeSegment;
    regs.ss = codeSegment;
    regs.sp = 0x1000;
    r = call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
    check("0301 on our stack", !carry(r) && low(regs.eax) == 3 && regs.ss == codeSegment && regs.sp == 0x1000 &&
                                   (code[0xffe] | code[0xfff] << 8) != 0);

    // Services 0200, 0201 and 0300
    Int31 old = call(0x0200, 0x60);
    check("0201 set a real-mode vector", !carry(call(0x0201, 0x60, codeSegment, 0x10)));
    Int31 now = call(0x0200, 0x60);
    check("0200 read it", low(now.ecx) == codeSegment && low(now.edx) == 0x10);
    regs = {};
    regs.eax = 5;
    regs.ebx = 6;
    r = call(0x0300, 0x60, 0, 0, 0, offsetOf(&regs));
    check("0300 simulated interrupt", !carry(r) && low(regs.eax) == 11);
    call(0x0201, 0x60, codeSegment, 0x80);
    regs.flags = 0x0202;
    call(0x0300, 0x60, 0, 0, 0, offsetOf(&regs));
    check("0300 enters with interrupts off", (regs.eax & 0x200) == 0);
    call(0x0201, 0x60, codeSegment, 0x30);
    regs = {};
    __asm__ volatile("pushl $0x55556666\n\tint $0x31\n\tleal 4(%%esp), %%esp"
                     : "=a"(result)
                     : "a"(0x0300), "b"(0x60), "c"(2), "D"(&regs)
                     : "memory", "cc");
    check("0300 words from the stack", low(regs.eax) == 0x5555 || low(regs.eax) == 0x6666);
    call(0x0201, 0x60, codeSegment, 0x10);
    check("int 60h from here reaches real mode", low(int60(7)) == 7);
    regs = {};
    regs.eax = 0x3000;
    bool good = true;
    for (int i = 0; i < 1000; ++i) {
        regs.eax = 0x3000;
        good = good && dpmi::realInterrupt(0x21, &regs) && (regs.eax & 0xff) >= 3;
    }
    check("0300 a thousand DOS calls", good);
    call(0x0201, 0x60, low(old.ecx), low(old.edx));
}

// ---- Interrupts from protected mode

void testInterrupts() {
    check("int 21h", (int21(0x3000) & 0xff) >= 3);
    check("int 10h", (int10(0x0f00) & 0xff) <= 0x13);
    // The zero flag says that no key waits; else AX is the key.
    const uint32_t key = low(int16(0x0100));
    check("int 16h", (intFlags & 0x40) != 0 || key != 0);
    const uint32_t mouse = low(int33(0x0000));
    check("int 33h", mouse == 0xffff || mouse == 0);

    Int31 old = call(0x0204, 0x60);
    check("0205 set int 60h", !carry(call(0x0205, 0x60, dpmi::codeSelector(), offsetOf(handler60))));
    Int31 now = call(0x0204, 0x60);
    check("0204 read it", low(now.ecx) == dpmi::codeSelector() && now.edx == offsetOf(handler60));
    check("int 60h reaches it", int60(1) == 0x1235 && (intFlags & 1) == 1);
    STRICT("0205 bad selector refused", carry(call(0x0205, 0x60, 0x1234, 0)));
    STRICT("0205 data selector refused", carry(call(0x0205, 0x60, dpmi::dataSelector(), 0)));
    check("0205 as it was", !carry(call(0x0205, 0x60, low(old.ecx), old.edx)));

    // The timer interrupt is taken and counted while this program computes, while DOS is called, and while real mode computes.
    old = call(0x0204, 8);
    oldHandler = {old.edx, uint16_t(old.ecx)};
    check("0205 set int 8", !carry(call(0x0205, 8, dpmi::codeSelector(), offsetOf(tickChain))));
    uint8_t* const bios = linear(0x46c);
    uint32_t from = *reinterpret_cast<volatile uint32_t*>(bios);
    ticks = 0;
    while (ticks < 5) {
    }
    check("timer in protected mode, chained", *reinterpret_cast<volatile uint32_t*>(bios) - from >= 4);
    ticks = 0;
    for (uint32_t i = 0; ticks < 5 && i < 100000000; ++i) int21(0x0b00);
    check("timer under DOS calls", ticks >= 5);
    // mov cx, 0; sti; l: loop l; dec bx; jnz l; retf
    static const uint8_t busy[] = {0xb9, 0, 0, 0xfb, 0xe2, 0xfe, 0x4b, 0x75, 0xfb, 0xcb};
    putCode(0x0a0, busy, sizeof busy);
    ticks = 0;
    dpmi::RealRegs regs = {};
    for (int i = 0; i < 2000 && ticks < 5; ++i) {
        regs = {};
        regs.ebx = 20;
        regs.cs = codeSegment;
        regs.ip = 0x0a0;
        call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
    }
    check("timer in real mode comes up", ticks >= 5);
    check("0205 int 8 as it was", !carry(call(0x0205, 8, low(old.ecx), old.edx)));
    ticks = 0;
    from = *reinterpret_cast<volatile uint32_t*>(bios);
    while (*reinterpret_cast<volatile uint32_t*>(bios) - from < 3) {
    }
    check("timer no longer ours", ticks == 0);

    // Interrupt 1Ch, which the BIOS calls from interrupt 8
    old = call(0x0204, 0x1c);
    call(0x0205, 0x1c, dpmi::codeSelector(), offsetOf(countOnly));
    counted = 0;
    from = *reinterpret_cast<volatile uint32_t*>(bios);
    while (*reinterpret_cast<volatile uint32_t*>(bios) - from < 4) {
    }
    check("int 1Ch comes up", counted >= 3);
    call(0x0205, 0x1c, low(old.ecx), old.edx);

    // Ctrl-C as DOS reports it (which DOSBox's DOS never does): int 23h; retf
    static const uint8_t breakCode[] = {0xcd, 0x23, 0xcb};
    putCode(0x0c0, breakCode, sizeof breakCode);
    old = call(0x0204, 0x23);
    call(0x0205, 0x23, dpmi::codeSelector(), offsetOf(countOnly));
    counted = 0;
    regs = {};
    regs.cs = codeSegment;
    regs.ip = 0x0c0;
    call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
    check("int 23h comes up", counted == 1);
    regs = {};
    dpmi::realInterrupt(0x23, &regs);
    check("int 23h by 0300 comes up", counted == 2);
    call(0x0205, 0x23, low(old.ecx), old.edx);

    regs = {};
    dpmi::realInterrupt(0x24, &regs);
    check("int 24h of the host fails the call", (regs.eax & 0xff) == 3);

    // The interrupt flag
    call(0x0901);
    Int31 r = call(0x0900);
    check("0900 was on", (r.eax & 0xff) == 1 && (call(0x0902).eax & 0xff) == 0);
    r = call(0x0901);
    check("0901 was off", (r.eax & 0xff) == 0 && (call(0x0902).eax & 0xff) == 1);
    __asm__ volatile("cli");
    check("0902 sees CLI", (call(0x0902).eax & 0xff) == 0);
    __asm__ volatile("sti");
    check("0902 sees STI", (call(0x0902).eax & 0xff) == 1);
}

// ---- Exceptions

void testExceptions() {
    STRICT("0202 number 20h refused", carry(call(0x0202, 0x20)));
    STRICT("0203 number 20h refused", carry(call(0x0203, 0x20, dpmi::codeSelector(), 0)));
    static const int kinds[] = {0, 6, 13, 14};
    static const char* const names[] = {"divide error", "invalid instruction", "bad selector", "wild pointer"};
    for (int i = 0; i < (wild ? 4 : 3); ++i) {
        Int31 old = call(0x0202, uint32_t(kinds[i]));
        Int31 r = call(0x0203, uint32_t(kinds[i]), dpmi::codeSelector(), offsetOf(exceptionSeen));
        counted = 0;
        bool good = !carry(r);
        for (int n = 0; n < 50; ++n) raise(kinds[i]);
        good = good && counted == 50 && seenEip == raiseEip;
        char text[60];
        snprintf(text, sizeof text, "0203 %s, fifty times", names[i]);
        check(text, good);
        if (kinds[i] == 13) check("0203 its error code", seenError == 0x1230);
        call(0x0203, uint32_t(kinds[i]), low(old.ecx), old.edx);
        r = call(0x0202, uint32_t(kinds[i]));
        check("0203 as it was", low(r.ecx) == low(old.ecx) && r.edx == old.edx);
    }
    // (In DOSBox raise() depends on the clock to come back from the wild pointer.)
    check("interrupts are on afterwards", (call(0x0902).eax & 0xff) == 1);
}

// ---- Call-backs

dpmi::RealRegs backRegs;
uint16_t nestedAddress[2];
uint32_t deepest;
uint8_t nestedStacks[12 * 4096];

void testCallBacks() {
    Int31 in = {0x0303, 0, 0, 0, offsetOf(callBack), offsetOf(&backRegs), dpmi::dataSelector(), dpmi::codeSelector(), 0};
    int31(&in);
    check("0303 allocated", !carry(in));
    dpmi::RealRegs regs = {};
    counted = 0;
    bool good = true;
    for (uint32_t i = 0; i < 1000; ++i) {
        regs = {};
        regs.eax = 0x13570000 + i;
        regs.cs = uint16_t(in.ecx);
        regs.ip = uint16_t(in.edx);
        Int31 r = call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
        good = good && !carry(r) && regs.eax == ~(0x13570000 + i);
    }
    check("0303 called a thousand times", good && counted == 1000);
    check("0304 freed", !carry(call(0x0304, 0, low(in.ecx), low(in.edx))));
    STRICT("0304 twice refused", carry(call(0x0304, 0, low(in.ecx), low(in.edx))));
    STRICT("0304 nonsense refused", carry(call(0x0304, 0, 0x1234, 0x5678)));

    Int31 all[64];
    int count = 0;
    for (; count < 64; ++count) {
        all[count] = {0x0303, 0, 0, 0, offsetOf(callBack), offsetOf(&backRegs), dpmi::dataSelector(), dpmi::codeSelector(), 0};
        int31(&all[count]);
        if (carry(all[count])) break;
    }
    check("0303 at least 16", count >= 16);
    for (int i = 0; i < count; ++i) good = good && !carry(call(0x0304, 0, low(all[i].ecx), low(all[i].edx)));
    check("0304 all of them", good);

    // An interrupt from here, whose vector in real mode leads to a call-back
    in = {0x0303, 0, 0, 0, offsetOf(callBackInt), offsetOf(&backRegs), dpmi::dataSelector(), dpmi::codeSelector(), 0};
    int31(&in);
    Int31 old = call(0x0200, 0x60);
    call(0x0201, 0x60, low(in.ecx), low(in.edx));
    check("int 60h from here reaches a call-back", int60(0x12345678) == ~0x12345678u);
    call(0x0201, 0x60, low(old.ecx), low(old.edx));
    call(0x0304, 0, low(in.ecx), low(in.edx));

    // Real mode calls protected mode, which calls real mode, and so on.
    nestedStack = offsetOf(nestedStacks + sizeof nestedStacks);
    in = {0x0303, 0, 0, 0, offsetOf(callBackNested), offsetOf(&backRegs), dpmi::dataSelector(), dpmi::codeSelector(), 0};
    int31(&in);
    nestedAddress[0] = uint16_t(in.edx);
    nestedAddress[1] = uint16_t(in.ecx);
    regs = {};
    regs.ecx = 3;
    regs.cs = nestedAddress[1];
    regs.ip = nestedAddress[0];
    deepest = 0;
    Int31 r = call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
    check("four call-backs inside one another", !carry(r) && deepest == 4 && regs.eax == 0x40 && regs.ecx == 3);
    call(0x0304, 0, low(in.ecx), low(in.edx));
}

// ---- Raw mode switch

void testRaw() {
    Int31 state = call(0x0305);
    check("0305 state", !carry(state));
    Int31 r = call(0x0306);
    check("0306 addresses", !carry(r));
    if (low(state.eax) != 0) {
        print("# 0305 wants %u bytes; raw switch not tried\n", unsigned(low(state.eax)));
        return;
    }
    rawToReal = {r.edi, uint16_t(r.esi)};
    bool good = true;
    for (int n = 0; n < 100; ++n) {
        uint8_t bytes[40];
        uint32_t at = 0;
        auto put = [&](uint32_t value, int count) {
            for (int i = 0; i < count; ++i, value >>= 8) bytes[at++] = uint8_t(value);
        };
        put(0xb8, 1);
        put(dpmi::dataSelector(), 2);  // mov ax, DS
        put(0xb9, 1);
        put(dpmi::dataSelector(), 2);  // mov cx, ES
        put(0xba, 1);
        put(dpmi::dataSelector(), 2);  // mov dx, SS
        put(0xbb66, 2);
        const uint32_t espAt = at;
        put(0, 4);  // mov ebx, ESP
        put(0xbe, 1);
        put(dpmi::codeSelector(), 2);  // mov si, CS
        put(0xbf66, 2);
        put(offsetOf(rawBack), 4);  // mov edi, EIP
        put(0xea, 1);
        put(low(r.ecx), 2);
        put(low(r.ebx), 2);  // far jump
        putCode(0x200, bytes, at);
        // The value of ESP in rawSwitch: below this frame lie the argument, the return address and four registers.
        static uint32_t esp;
        __asm__ volatile("movl %%esp, %0" : "=m"(esp));
        uint16_t where[2] = {0x200, codeSegment};
        uint32_t guess = esp - 24;
        for (uint32_t i = 0; i < 4; ++i) code[0x200 + espAt + i] = uint8_t(guess >> 8 * i);
        __asm__ volatile(
            "pushl %1\n\tcall rawSwitch\n\taddl $4, %%esp" : "+m"(esp) : "r"(where) : "eax", "ecx", "edx", "memory", "cc");
        good = good && rawEsp == guess && rawEbp == 0x12345678;
    }
    check("0306 a hundred times there and back", good);
}

// ---- Memory

struct Block {
    uint32_t address, handle;
    bool good;
};

Block allocate(uint32_t bytes) {
    Int31 r = call(0x0501, bytes >> 16, low(bytes));
    return {pair(r.ebx, r.ecx), pair(r.esi, r.edi), !carry(r)};
}

Block resize(uint32_t handle, uint32_t bytes) {
    Int31 r = call(0x0503, bytes >> 16, low(bytes), 0, handle >> 16, low(handle));
    return {pair(r.ebx, r.ecx), pair(r.esi, r.edi), !carry(r)};
}

bool release(uint32_t handle) { return !carry(call(0x0502, 0, 0, 0, handle >> 16, low(handle))); }

struct Info {
    uint32_t word[12];
};

Info info() {
    Info i;
    call(0x0500, 0, 0, 0, 0, offsetOf(&i));
    return i;
}

void fill(uint32_t address, uint32_t bytes, uint32_t seed) {
    uint32_t* p = reinterpret_cast<uint32_t*>(linear(address));
    for (uint32_t i = 0; i < bytes / 4; ++i) p[i] = seed + i * 0x9e3779b9u;
}

bool filled(uint32_t address, uint32_t bytes, uint32_t seed) {
    const uint32_t* p = reinterpret_cast<uint32_t*>(linear(address));
    for (uint32_t i = 0; i < bytes / 4; ++i) {
        if (p[i] != seed + i * 0x9e3779b9u) return false;
    }
    return true;
}

void testMemory() {
    const Info before = info();
    check("0500 largest block is there", before.word[0] >= 0x10000 && before.word[0] != 0xffffffff);
    print("# largest block %u KB\n", unsigned(before.word[0] >> 10));
    STRICT("0501 nothing refused", !allocate(0).good);
    STRICT("0501 more than there is refused", !allocate(0xf0000000).good);
    Block a = allocate(0x10000), b = allocate(0x12345);
    check("0501 two blocks", a.good && b.good && a.handle != b.handle && a.handle != 0);
    fill(a.address, 0x10000, 1);
    fill(b.address, 0x12344, 2);
    check("0501 apart from one another", filled(a.address, 0x10000, 1) && filled(b.address, 0x12344, 2));
    Block a2 = resize(a.handle, 0x30000);
    check("0503 larger, contents kept", a2.good && filled(a2.address, 0x10000, 1));
    fill(a2.address, 0x30000, 3);
    check("0503 the other one untouched", filled(b.address, 0x12344, 2));
    Block a3 = resize(a2.handle, 0x8000);
    check("0503 smaller, contents kept", a3.good && filled(a3.address, 0x8000, 3));
    STRICT("0503 nothing refused", !resize(a3.handle, 0).good);
    STRICT("0503 too large refused, block kept", !resize(a3.handle, 0xe0000000).good && filled(a3.address, 0x8000, 3));
    check("0502 freed", release(a3.handle) && release(b.handle));
    STRICT("0502 twice refused", !release(a3.handle));
    STRICT("0503 freed refused", !resize(b.handle, 0x1000).good);
    STRICT("0502 nonsense refused", !release(0xdeadbeef));

    // All memory is taken in blocks of a quarter of it and then smaller ones; the ends of each are written and checked.
    Block blocks[300];
    int count = 0;
    uint32_t bytes = before.word[0] / 4 & ~0xfffu;
    uint32_t sum = 0;
    while (count < 300 && bytes >= 0x10000) {
        blocks[count] = allocate(bytes);
        if (!blocks[count].good) {
            bytes = bytes / 2 & ~0xfffu;
            continue;
        }
        fill(blocks[count].address, 0x1000, uint32_t(count));
        fill(blocks[count].address + bytes - 0x1000, 0x1000, uint32_t(count) + 77);
        sum += bytes;
        ++count;
    }
    check("0501 until there is none", count >= 4 && sum >= before.word[0] / 4 * 3);
    bool good = true;
    for (int i = 0; i < count; ++i) good = good && filled(blocks[i].address, 0x1000, uint32_t(i));
    check("0501 all different memory", good);
    for (int i = 0; i < count; i += 2) good = good && release(blocks[i].handle);
    for (int i = 1; i < count; i += 2) good = good && release(blocks[i].handle);
    check("0502 all of them", good);
    Info after = info();
    check("0500 as much as before", after.word[0] == before.word[0] && after.word[5] == before.word[5]);
    // Memory is taken step by step, as a growing heap does.
    count = 0;
    sum = 0;
    const uint32_t step = (before.word[0] / 200 & ~0xffffu) + 0x10000;
    uint32_t together = 0;
    while (count < 250 && (blocks[count] = allocate(step)).good) {
        if (count > 0 && blocks[count].address == blocks[count - 1].address + step) ++together;
        sum += step;
        ++count;
    }
    check("0501 in small steps nearly all of it", sum >= before.word[0] / 10 * 8);
    check("0501 and mostly in a row", together >= uint32_t(count) / 4 * 3);
    good = true;
    for (int i = 0; i < count; ++i) good = good && release(blocks[i].handle);
    check("0502 all of those, too", good && info().word[0] == before.word[0]);
    // A block that contains an absent page is moved.
    if (strict) {
        a = allocate(0x20000);
        b = allocate(0x10000);
        fill(a.address, 0x20000, 9);
        static const uint16_t absent = 0;
        Int31 r = {0x0507, 0, 0, offsetOf(&absent), a.handle, 0, dpmi::dataSelector(), dpmi::dataSelector(), 0};
        r.ecx = 1;
        int31(&r);
        check("0507 a page made absent", !carry(r));
        a2 = resize(a.handle, before.word[0] / 2);
        check("0503 with an absent page", a2.good && filled(a2.address + 0x1000, 0x10000, 9 + 0x400 * 0x9e3779b9u));
        static const uint16_t present = 9;
        r = {0x0507, 0, 1, offsetOf(&present), a2.handle, 0, dpmi::dataSelector(), dpmi::dataSelector(), 0};
        int31(&r);
        check("0507 present again, its contents too", !carry(r) && filled(a2.address, 0x20000, 9));
        check("0502 both", release(a2.handle) && release(b.handle) && info().word[0] == before.word[0]);
    }
    // Many small blocks
    count = 0;
    while (count < 250 && (blocks[count] = allocate(0x1000)).good) ++count;
    check("0501 250 small blocks", count == 250);
    good = true;
    for (int i = 0; i < count; ++i) good = good && release(blocks[i].handle);
    check("0502 all of those", good && info().word[0] == before.word[0]);
}

// ---- The rest

void testRest() {
    Int31 r = call(0x0400);
    check("0400 version 0.90, 32 bit", !carry(r) && low(r.eax) == 0x005a && (r.ebx & 1) == 1 && (r.ecx & 0xff) >= 3);
    check("0400 interrupt bases", low(r.edx) == 0x0870 || low(r.edx) == 0x7008);
    check("0600 lock", !carry(call(0x0600, ourBase >> 16, low(ourBase + 0x2000), 0, 0, 0x1000)));
    check("0601 unlock", !carry(call(0x0601, ourBase >> 16, low(ourBase + 0x2000), 0, 0, 0x1000)));
    check("0602 and 0603", !carry(call(0x0602, 0xb, 0x8000, 0, 0, 0x1000)) && !carry(call(0x0603, 0xb, 0x8000, 0, 0, 0x1000)));
    r = call(0x0604);
    check("0604 page size", !carry(r) && pair(r.ebx, r.ecx) == 4096);
    check("0702 and 0703", !carry(call(0x0702, ourBase >> 16, low(ourBase + 0x2000), 0, 0, 0x1000)) &&
                               !carry(call(0x0703, ourBase >> 16, low(ourBase + 0x2000), 0, 0, 0x1000)));
    r = call(0x0800, 0xe000, 0x0000, 0, 0x0001, 0x0000);
    check("0800 map physical memory", !carry(r));
    const uint32_t mapped = pair(r.ebx, r.ecx);
    volatile uint8_t* const screen = linear(mapped);
    (void)screen[0];
    (void)screen[0xffff];
    check("0800 it can be read", true);
    STRICT("0801 unmap (DPMI 1.0)", !carry(call(0x0801, mapped >> 16, low(mapped))));
    r = call(0x0e00);
    STRICT("0E00 coprocessor (DPMI 1.0)", !carry(r));
    STRICT("0E01 set (DPMI 1.0)", !carry(call(0x0e01, r.eax & 3)));
    static const uint16_t unknown[] = {0x0004, 0x000f, 0x0103, 0x0206, 0x0307, 0x0402, 0x050c, 0x0605, 0x0704, 0x0a01,
                                       0x0b04, 0x0c00, 0x0d04, 0x0e02, 0x0f00, 0x8000, 0xffff};
    bool good = true;
    for (uint16_t function : unknown) {
        if (!strict) break;
        r = call(function);
        if (!carry(r) || low(r.eax) != 0x8001) {
            print("# %04x: carry %d, ax %04x\n", unsigned(function), int(carry(r)), unsigned(low(r.eax)));
            good = false;
        }
    }
    STRICT("functions that do not exist: carry and 8001h", good);
    static const uint16_t absent = 0;
    STRICT("0507 the page of NULL pointers made absent (DPMI 1.0)",
           !carry(call(0x0507, 0, 1, offsetOf(&absent), stubInfo.memoryHandle)));
    __asm__ volatile("int $0x2f" : "=a"(r.eax) : "a"(0x1686) : "ebx", "ecx", "edx", "cc");
    check("int 2Fh 1686h: protected mode", low(r.eax) == 0);

    // The promises of the stub
    check("stub information", sameBytes(stubInfo.magic, "go32stub", 8) && stubInfo.size >= 84);
    Int31 base = call(0x0006, stubInfo.dsSelector);
    check("its data selector and segment", pair(base.ecx, base.edx) == stubInfo.dsSegment * 16u);
    Int31 codeBase = call(0x0006, stubInfo.csSelector);
    check("its code selector has the same base", pair(codeBase.ecx, codeBase.edx) == pair(base.ecx, base.edx));
    check("transfer buffer", stubInfo.minkeep >= 16384 && dpmi::segmentLimit(stubInfo.dsSelector) + 1u >= stubInfo.minkeep);
    base = call(0x0006, stubInfo.pspSelector);
    const uint8_t* psp = linear(pair(base.ecx, base.edx));
    check("PSP", psp[0] == 0xcd && psp[1] == 0x20);
    check("environment size", stubInfo.envSize > 4);
    uint32_t cpl;
    __asm__("movl %%cs, %0" : "=r"(cpl));
    check("ring 3", (cpl & 3) == 3);
}

// ---- Other commands

uint32_t number(const char* text) {
    uint32_t value = 0;
    while (*text >= '0' && *text <= '9') value = value * 10 + uint32_t(*text++ - '0');
    return value;
}

void out8(uint16_t port, uint8_t value) { __asm__ volatile("outb %0, %1" : : "a"(value), "Nd"(port)); }
uint8_t in8(uint16_t port) {
    uint8_t value;
    __asm__ volatile("inb %1, %0" : "=a"(value) : "Nd"(port));
    return value;
}

// Returns the value of counter 2, which runs down from 65536 all the time: a clock that does not need interrupts.
uint16_t counter2() {
    out8(0x43, 0x80);
    const uint16_t lowByte = in8(0x42);
    return uint16_t(lowByte | in8(0x42) << 8);
}

int timerTicks(uint32_t wanted, uint32_t divisor) {
    // The BIOS's own handler counts in 40:6Ch, so that count tells how many interrupts reached real mode.
    volatile uint32_t* const bios = reinterpret_cast<volatile uint32_t*>(linear(0x46c));
    const uint8_t speaker = in8(0x61);
    out8(0x61, uint8_t((speaker & ~2) | 1));
    out8(0x43, 0xb4);
    out8(0x42, 0);
    out8(0x42, 0);
    const uint32_t saved = *bios;
    __asm__ volatile("cli");
    out8(0x43, 0x34);
    out8(0x40, uint8_t(divisor));
    out8(0x40, uint8_t(divisor >> 8));
    __asm__ volatile("sti");
    uint32_t start = *bios;
    while (*bios == start) {
    }
    start = *bios;
    uint64_t clocks = 0;
    uint16_t last = counter2();
    uint32_t load = 1;
    uint32_t got;
    do {
        for (int i = 0; i < 20; ++i) load = load * 1664525 + 1013904223;
        if ((load >> 16 & 15) == 0) int21(0x0b00);
        if ((load >> 16 & 15) == 1) call(0x0400);
        const uint16_t now = counter2();
        clocks += uint16_t(last - now);
        last = now;
        got = *bios - start;
    } while (got < wanted);
    __asm__ volatile("cli");
    out8(0x43, 0x36);
    out8(0x40, 0);
    out8(0x40, 0);
    *bios = saved + uint32_t(uint32_t(clocks >> 16));
    __asm__ volatile("sti");
    out8(0x61, speaker);
    const uint32_t due = uint32_t(clocks >> 1) / divisor * 2;  // in 32 bits, because there is no 64-bit division here
    print("# %u timer interrupts, %u due\n", unsigned(got), unsigned(due));
    char text[80];
    snprintf(text, sizeof text, "%u timer interrupts under load, none lost", unsigned(wanted));
    check(text, got + 4 >= due && got <= due + 4);
    return failures == 0 ? 0 : 1;
}

// Prints how many instructions one timer interrupt costs. A loop of known length is timed by counter 2, once with the slowest
// timer and once with a fast one. With fixed cycles every instruction takes the same time.
int timeTicks(uint32_t divisor) {
    volatile uint32_t* const bios = reinterpret_cast<volatile uint32_t*>(linear(0x46c));
    const uint8_t speaker = in8(0x61);
    out8(0x61, uint8_t((speaker & ~2) | 1));
    out8(0x43, 0xb4);
    out8(0x42, 0);
    out8(0x42, 0);
    uint32_t clocks[2], happened[2];
    const uint32_t saved = *bios;
    for (int pass = 0; pass < 2; ++pass) {
        const uint32_t d = pass == 0 ? 0 : divisor;
        out8(0x43, 0x34);
        out8(0x40, uint8_t(d));
        out8(0x40, uint8_t(d >> 8));
        uint32_t total = 0;
        const uint32_t from = *bios;
        uint16_t last = counter2();
        for (int i = 0; i < 2000; ++i) {
            uint32_t n = 500;  // 1000 instructions
            __asm__ volatile("1: decl %0\n\tjnz 1b" : "+r"(n) : : "cc");
            const uint16_t now = counter2();
            total += uint16_t(last - now);
            last = now;
        }
        clocks[pass] = total;
        happened[pass] = *bios - from;
    }
    out8(0x43, 0x36);
    out8(0x40, 0);
    out8(0x40, 0);
    *bios = saved;
    out8(0x61, speaker);
    // 2000 * 1010 instructions took clocks[0] with hardly any interrupts.
    const uint32_t extra = clocks[1] - clocks[0];
    const uint32_t perInterrupt = extra / (happened[1] - happened[0]);
    print("# 2020000 instructions: %u clocks of 1193182 Hz; with %u interrupts: %u; one interrupt: %u clocks, %u instructions\n",
          unsigned(clocks[0]), unsigned(happened[1]), unsigned(clocks[1]), unsigned(perInterrupt),
          unsigned(extra / ((happened[1] - happened[0]) / 16) * (2020000 / 16) / clocks[0]));
    return 0;
}

int mouse(uint32_t seconds) {
    Int31 in = {0x0303, 0, 0, 0, offsetOf(callBackMouse), offsetOf(&backRegs), dpmi::dataSelector(), dpmi::codeSelector(), 0};
    int31(&in);
    dpmi::RealRegs regs = {};
    dpmi::realInterrupt(0x33, &regs);
    print("# mouse %s\n", low(regs.eax) == 0xffff ? "yes" : "no");
    regs = {};
    regs.eax = 0x0c;
    regs.ecx = 0x7f;
    regs.es = uint16_t(in.ecx);
    regs.edx = low(in.edx);
    dpmi::realInterrupt(0x33, &regs);
    volatile uint32_t* const bios = reinterpret_cast<volatile uint32_t*>(linear(0x46c));
    const uint32_t from = *bios;
    while (*bios - from < seconds * 18 && counted < 10) int21(0x0b00);
    print("# %u calls from the mouse driver\n", unsigned(counted));
    check("call-back from the mouse driver", counted > 0);
    return failures == 0 ? 0 : 1;  // the call-back stays registered with the driver: the host has to remove it
}

int freeMemory() {
    dpmi::RealRegs regs = {};
    regs.eax = 0x4800;
    regs.ebx = 0xffff;
    dpmi::realInterrupt(0x21, &regs);
    const Info i = info();
    print("dos %u extended %u\n", unsigned(low(regs.ebx)), unsigned(i.word[0]));
    return 0;
}

int screen() {
    const uint8_t* bios = linear(0x400);
    print("mode %u\n", unsigned(bios[0x49]));
    const uint8_t* text = linear(0xb8000);
    for (int y = 0; y < 25; ++y) {
        char line[81];
        int length = 0;
        for (int x = 0; x < 80; ++x) {
            line[x] = char(text[(y * 80 + x) * 2]);
            if (line[x] < ' ' || line[x] > '~') line[x] = ' ';
            if (line[x] != ' ') length = x + 1;
        }
        line[length] = '\0';
        print("%s\n", line);
    }
    return 0;
}

// Puts Ctrl-C into the BIOS's keyboard buffer, and calls DOS so that DOS finds it.
void typeBreak() {
    dpmi::RealRegs regs = {};
    regs.eax = 0x0500;
    regs.ecx = 0x2e03;
    dpmi::realInterrupt(0x16, &regs);
    for (int i = 0; i < 1000; ++i) int21(0x0b00);
    regs = {};
    dpmi::realInterrupt(0x23, &regs);  // DOSBox's DOS does not look for Ctrl-C
}

}  // namespace

// The work of a call-back: calls DOS, and calls the call-back again through real mode, CX times in all.
void nested(dpmi::RealRegs* r) {
    dpmi::RealRegs mine = *r;
    ++deepest;
    dpmi::RealRegs dos = {};
    dos.eax = 0x3000;
    dpmi::realInterrupt(0x21, &dos);
    if (low(mine.ecx) > 0) {
        dpmi::RealRegs next = {};
        next.ecx = mine.ecx - 1;
        next.cs = nestedAddress[1];
        next.ip = nestedAddress[0];
        call(0x0301, 0, 0, 0, 0, offsetOf(&next));
        mine.eax = next.eax + 0x10;
    } else {
        mine.eax = 0x10;
    }
    *r = mine;
}

int main(int argc, char** argv) {
    Int31 base = call(0x0006, dpmi::dataSelector());
    ourBase = pair(base.ecx, base.edx);
    // Pointers are near: the data segment is made to reach all linear addresses, as DJGPP programs can do.
    const uint32_t limit = dpmi::segmentLimit(dpmi::dataSelector());
    dataSelector = dpmi::dataSelector();
    const char* what = argc > 1 ? argv[1] : "ALL";
    strict = strcmp(what, "GOOD") != 0;
    wild = argc < 3 || strcmp(argv[2], "NOWILD") != 0;
    const bool all = strcmp(what, "ALL") == 0 || !strict;
    (void)limit;
    if (all) {
        // The limit is compared before it is changed.
        const bool size = limit == stubInfo.initialSize - 1;
        call(0x0008, dataSelector, 0xffff, 0xffff);
        __asm__ volatile("pushl %%ds\n\tpopl %%ds\n\tpushl %%ds\n\tpopl %%es\n\tpushl %%ss\n\tpopl %%ss" : : : "memory");
        check("data limit is the initial size", size);
        testDescriptors();
        testDosMemory();
        testRealMode();
        testInterrupts();
        testExceptions();
        testCallBacks();
        testRaw();
        testMemory();
        testRest();
        print("%s\n", failures == 0 ? "# all well" : "# failures");
        return failures == 0 ? 0 : 1;
    }
    call(0x0008, dataSelector, 0xffff, 0xffff);
    __asm__ volatile("pushl %%ds\n\tpopl %%ds\n\tpushl %%ds\n\tpopl %%es\n\tpushl %%ss\n\tpopl %%ss" : : : "memory");
    if (strcmp(what, "TICKS") == 0 && argc > 3) return timerTicks(number(argv[2]), number(argv[3]));
    if (strcmp(what, "TIME") == 0) return timeTicks(argc > 2 ? number(argv[2]) : 1193);
    if (strcmp(what, "MOUSE") == 0 && argc > 2) return mouse(number(argv[2]));
    if (strcmp(what, "FREE") == 0) return freeMemory();
    if (strcmp(what, "SCREEN") == 0) return screen();
    if (strcmp(what, "CATCH") == 0) {
        const Int31 before = call(0x0204, 9);
        oldHandler.offset = before.edx;
        oldHandler.selector = uint16_t(before.ecx);
        check("0205 the keyboard's interrupt", !carry(call(0x0205, 9, dpmi::codeSelector(), offsetOf(tickChain))));
        typeBreak();
        check("Ctrl-C is left to a program that has the keyboard", true);
        check("0205 given back", !carry(call(0x0205, 9, before.ecx, before.edx)));
        return failures == 0 ? 0 : 1;
    }
    if (strcmp(what, "BREAK") == 0) {
        int10(0x0013);
        typeBreak();
        print("FAIL still here\n");
        return 1;
    }
    if (strcmp(what, "CRASH") == 0 && argc > 2) {
        int10(0x0013);
        call(0x0008, dataSelector, (stubInfo.initialSize - 1) >> 16, low(stubInfo.initialSize - 1));
        if (argv[2][0] == 'S') {
            overflow();
        } else if (argv[2][0] == 'L' || argv[2][0] == 'R') {
            for (uint32_t exception = 12; exception <= 14; ++exception)
                call(0x0203, exception, dpmi::codeSelector(), offsetOf(argv[2][0] == 'L' ? exceptionOnStack : exceptionAgain));
            if (argv[2][0] == 'L') largeFrames(); else raise(14);
        } else if (argv[2][0] == 'H') {
            const uint16_t freed = uint16_t(call(0x0000, 0, 1).eax);
            call(0x0009, freed, 0x40f2);
            call(0x0008, freed, 0xffff, 0xffff);
            Int31 in = {0x0303, 0, 0, 0, offsetOf(callBack), 0, freed, dpmi::codeSelector(), 0};
            int31(&in);
            call(0x0001, freed);
            dpmi::RealRegs regs = {};
            regs.cs = uint16_t(in.ecx);
            regs.ip = uint16_t(in.edx);
            call(0x0301, 0, 0, 0, 0, offsetOf(&regs));
        } else {
            raise(int(number(argv[2])));
        }
        for (volatile uint32_t i = 0; i < 1000000000; ++i) {
        }
        print("FAIL still here\n");
        return 1;
    }
    print("DTEST: what?\n");
    return 2;
}
