// The assembly part of DTEST.EXE (dtest.cpp uses it): int 31h with all registers, interrupt and exception handlers, call-back
// procedures, and the raw mode switch.

#include "asm.h"

// Offsets in struct Int31
#define EAX 0
#define EBX 4
#define ECX 8
#define EDX 12
#define ESI 16
#define EDI 20
#define ES 24
#define DS 26
#define FLAGS 28

        .text

// void int31(Int31*): calls int 31h with these registers, and stores the registers and flags that it returns
        .globl  SYM(int31)
SYM(int31):
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        pushl   %es
        pushl   %ds
        movl    28(%esp), %ebp
        pushl   %ebp
        movl    EAX(%ebp), %eax
        movl    EBX(%ebp), %ebx
        movl    ECX(%ebp), %ecx
        movl    EDX(%ebp), %edx
        movl    ESI(%ebp), %esi
        movl    EDI(%ebp), %edi
        movw    %ss:ES(%ebp), %es
        movw    %ss:DS(%ebp), %ds
        int     $0x31
        pushfl
        movl    4(%esp), %ebp
        movl    %eax, %ss:EAX(%ebp)
        movl    %ebx, %ss:EBX(%ebp)
        movl    %ecx, %ss:ECX(%ebp)
        movl    %edx, %ss:EDX(%ebp)
        movl    %esi, %ss:ESI(%ebp)
        movl    %edi, %ss:EDI(%ebp)
        popl    %ss:FLAGS(%ebp)
        addl    $4, %esp
        popl    %ds
        popl    %es
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

// Handler of int 60h: adds 1234h to EAX and sets the carry flag in the caller's flags
        .globl  SYM(handler60)
SYM(handler60):
        addl    $0x1234, %eax
        orl     $1, 8(%esp)
        iretl

// Timer handlers that count, and then jump to the previous handler (tickChain) or end the interrupt (tickOwn)
        .globl  SYM(tickChain), SYM(tickOwn)
SYM(tickChain):
        pushl   %ds
        movw    %cs:SYM(dataSelector), %ds
        incl    SYM(ticks)
        popl    %ds
        ljmp    *%cs:SYM(oldHandler)
SYM(tickOwn):
        pushl   %ds
        pushl   %eax
        movw    %cs:SYM(dataSelector), %ds
        incl    SYM(ticks)
        movb    $0x20, %al
        outb    %al, $0x20
        popl    %eax
        popl    %ds
        iretl

// A handler that only counts, for Ctrl-C and critical errors; AL = 3 means "fail" in the latter case
        .globl  SYM(countOnly)
SYM(countOnly):
        pushl   %ds
        movw    %cs:SYM(dataSelector), %ds
        incl    SYM(counted)
        popl    %ds
        movb    $3, %al
        iretl

// Exception handler: notes error code, EIP and SS, and continues at `recover` on the stack of the exception
        .globl  SYM(exceptionSeen)
SYM(exceptionSeen):
        pushl   %ds
        pushl   %eax
        movw    %cs:SYM(dataSelector), %ds
        incl    SYM(counted)
        movl    16(%esp), %eax
        movl    %eax, SYM(seenError)
        movl    20(%esp), %eax
        movl    %eax, SYM(seenEip)
        movw    %ss, SYM(seenStack)
        movl    $recover, 20(%esp)
        popl    %eax
        popl    %ds
        lretl

// void raise(int kind): 0 divide error, 6 invalid instruction, 13 bad selector, 14 wild pointer
        .globl  SYM(raise), SYM(raiseEip)
SYM(raise):
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        pushl   %es
        movl    24(%esp), %eax
        cmpl    $6, %eax
        je      2f
        cmpl    $13, %eax
        je      3f
        cmpl    $14, %eax
        je      4f
        xorl    %ecx, %ecx
        movl    $1f, SYM(raiseEip)
1:      divl    %ecx
        jmp     recover
2:      movl    $5f, SYM(raiseEip)
5:      ud2
3:      movl    $6f, SYM(raiseEip)
        movl    $0x1230, %eax           // a selector beyond any descriptor table
6:      movw    %ax, %es
        jmp     recover
4:      movl    $7f, SYM(raiseEip)
        movl    $0x70000000, %edx
7:      movl    %eax, (%edx)
8:      incl    SYM(wildSteps)          // in DOSBox the fault comes a little later
        jmp     8b
recover:
        popl    %es
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

// Call-back for a far call from real mode: inverts EAX and returns to the caller
        .globl  SYM(callBack)
SYM(callBack):
        cld
        incl    %es:SYM(counted)
        notl    %es:28(%edi)
        lodsl                           // IP, CS of the far call
        movl    %eax, %es:42(%edi)
        addw    $4, %es:46(%edi)
        iretl

// Call-back for an interrupt from real mode: inverts EAX and returns as IRET does
        .globl  SYM(callBackInt)
SYM(callBackInt):
        cld
        notl    %es:28(%edi)
        lodsl                           // IP, CS, then the flags
        movl    %eax, %es:42(%edi)
        lodsw
        movw    %ax, %es:32(%edi)
        addw    $6, %es:46(%edi)
        iretl

// Call-back that calls real mode itself: it switches to a stack of its own and calls nested(registers)
        .globl  SYM(callBackNested)
SYM(callBackNested):
        cld
        lodsl
        movl    %eax, %es:42(%edi)
        addw    $4, %es:46(%edi)
        movl    %es, %eax
        movw    %ax, %ds
        movw    %ss, %bx
        movl    %esp, %edx
        movw    %ax, %ss
        movl    SYM(nestedStack), %esp
        subl    $4096, SYM(nestedStack)
        pushl   %ebx
        pushl   %edx
        pushl   %edi
        call    SYM(nested)
        popl    %edi
        popl    %edx
        popl    %ebx
        addl    $4096, SYM(nestedStack)
        movl    %ds, %eax
        movw    %ax, %es
        movw    %bx, %ss
        movl    %edx, %esp
        iretl

// Call-back of the mouse driver (a far call with event bits in AX)
        .globl  SYM(callBackMouse)
SYM(callBackMouse):
        cld
        incl    %es:SYM(counted)
        lodsl
        movl    %eax, %es:42(%edi)
        addw    $4, %es:46(%edi)
        iretl

// void rawSwitch(const uint16_t rm[2]): switches to real mode at rm[1]:rm[0], with the stack at the end of the first 256 bytes
// of that segment; the code there jumps back to rawBack
        .globl  SYM(rawSwitch), SYM(rawBack)
SYM(rawSwitch):
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    20(%esp), %esi
        movl    %esp, SYM(rawEsp)
        movzwl  (%esi), %edi
        movw    2(%esi), %si
        movw    %si, %ax
        movw    %si, %cx
        movw    %si, %dx
        movl    $0x100, %ebx
        movl    $0x12345678, %ebp
        ljmp    *SYM(rawToReal)
SYM(rawBack):
        movl    %ebp, SYM(rawEbp)
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

// uint32_t intN(uint32_t eax) for N = 10, 16, 21, 33, 60: calls interrupt Nh; stores the returned EBX and flags
        .macro  INTN n
        .globl  SYM(int\n)
SYM(int\n):
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    20(%esp), %eax
        xorl    %ebx, %ebx
        xorl    %ecx, %ecx
        xorl    %edx, %edx
        int     $0x\n
        pushfl
        popl    SYM(intFlags)
        movl    %ebx, SYM(intEbx)
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret
        .endm
        INTN    10
        INTN    16
        INTN    21
        INTN    33
        INTN    60

// void overflow(): fills the stack and goes on below it
        .globl  SYM(overflow)
SYM(overflow):
        pushl   $0x12345678
        jmp     SYM(overflow)

// void largeFrames(): calls itself for ever with frames of 4 and 8 KB in turn, and writes only to the ends of each
        .globl  SYM(largeFrames)
SYM(largeFrames):
        subl    $4096-4, %esp
        movl    $0x12345678, (%esp)
        call    1f
1:      subl    $8192-4, %esp
        movl    $0x12345678, (%esp)
        call    SYM(largeFrames)

// Exception handler that returns without any remedy
        .globl  SYM(exceptionAgain)
SYM(exceptionAgain):
        lretl

// Exception handler as in DJGPP's libc: writes the state to the stack of the exception and continues there in a function that
// does not return. If the exception was on a stack of the host, it continues on a stack of its own.
        .globl  SYM(exceptionOnStack)
SYM(exceptionOnStack):
        pushl   %eax
        pushl   %ebx
        pushl   %ds
        movw    %cs:SYM(dataSelector), %ds
        movl    $goOn, 24(%esp)         // EIP
        movw    %ds, %ax
        cmpw    %ax, 40(%esp)           // SS
        je      1f
        movw    %ax, 40(%esp)
        movl    $ownStackTop, 36(%esp)  // ESP
1:      subl    $92, 36(%esp)
        movl    36(%esp), %ebx
        movl    $0x5a5a5a5a, (%ebx)
        popl    %ds
        popl    %ebx
        popl    %eax
        lretl
goOn:
        movw    %cs:SYM(dataSelector), %ds
        pushl   $0
        ud2

        .data
        .balign 4
        .skip   1024
ownStackTop:
        .globl  SYM(dataSelector), SYM(ticks), SYM(oldHandler), SYM(counted), SYM(seenError), SYM(seenEip)
        .globl  SYM(seenStack), SYM(wildSteps), SYM(nestedStack), SYM(rawEsp), SYM(rawEbp), SYM(rawToReal)
        .globl  SYM(intFlags), SYM(intEbx)
        .balign 4
SYM(ticks):             .long   0
SYM(counted):           .long   0
SYM(seenError):         .long   0
SYM(seenEip):           .long   0
SYM(seenStack):         .long   0
SYM(raiseEip):          .long   0
SYM(wildSteps):         .long   0
SYM(nestedStack):       .long   0
SYM(rawEsp):            .long   0
SYM(rawEbp):            .long   0
SYM(intFlags):          .long   0
SYM(intEbx):            .long   0
SYM(oldHandler):        .long   0, 0
SYM(rawToReal):         .long   0, 0
SYM(dataSelector):      .word   0

ASM_END
