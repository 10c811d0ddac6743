// The handlers of processor exceptions, which the DPMI host calls (DPMI function 0203h). There is one entry for each
// exception, which pushes the exception's number. The common part stores the registers in trapState (src/dos/crash.cpp)
// and makes the host resume the program in crashed() instead of at the fault, with the program's own segments and a stack
// reserved for this. After this return to the host everything is allowed again: files, video, the end of the program.
//
// The stack at an entry, 32-bit words from ss:esp up:
//      0 return eip   4 return cs   8 error code   12 eip   16 cs   20 eflags   24 esp   28 ss

#include "asm.h"

// Offsets in trapState.
#define NUMBER 0
#define ERROR 4
#define EIP 8
#define CS 12
#define EFLAGS 16
#define ESP 20
#define SS 24
#define EAX 28
#define EBX 32
#define ECX 36
#define EDX 40
#define ESI 44
#define EDI 48
#define EBP 52
#define DS 56
#define ES 60

#define TRAPS 15                // exceptions 0 to 14
#define TRAP_STACK 8176         // initial stack pointer in trapStack: its size minus 16

        .text

// trapEntries: TRAPS entries of 8 bytes each, so that C++ can compute their addresses.
        .balign 8
        .globl  SYM(trapEntries)
SYM(trapEntries):
        .set    number, 0
        .rept   TRAPS
        .balign 8
        pushl   $number
        jmp     common
        .set    number, number + 1
        .endr

        .balign 8
common:
        // ds may have any value here, but cs has the same base as the program's ds and can be read.
        pushl   %ds
        pushl   %eax
        movw    %cs:SYM(trapData), %ax
        movw    %ax, %ds
        popl    SYM(trapState)+EAX
        popl    SYM(trapState)+DS
        popl    SYM(trapState)+NUMBER
        movl    %ebx, SYM(trapState)+EBX
        movl    %ecx, SYM(trapState)+ECX
        movl    %edx, SYM(trapState)+EDX
        movl    %esi, SYM(trapState)+ESI
        movl    %edi, SYM(trapState)+EDI
        movl    %ebp, SYM(trapState)+EBP
        movl    %es, %eax
        movl    %eax, SYM(trapState)+ES
        movl    8(%esp), %eax
        movl    %eax, SYM(trapState)+ERROR
        movl    12(%esp), %eax
        movl    %eax, SYM(trapState)+EIP
        movl    16(%esp), %eax
        movl    %eax, SYM(trapState)+CS
        movl    20(%esp), %eax
        movl    %eax, SYM(trapState)+EFLAGS
        movl    24(%esp), %eax
        movl    %eax, SYM(trapState)+ESP
        movl    28(%esp), %eax
        movl    %eax, SYM(trapState)+SS

        // Resume the program at `trapped`, on trapStack, with the trap flag cleared.
        movl    $trapped, 12(%esp)
        movl    %cs, %eax
        movl    %eax, 16(%esp)
        andl    $~0x100, 20(%esp)
        movl    $SYM(trapStack)+TRAP_STACK, 24(%esp)
        movl    %ds, %eax
        movl    %eax, 28(%esp)
        lret

trapped:
        movw    %ss, %ax
        movw    %ax, %ds
        movw    %ax, %es
        cld
        xorl    %ebp, %ebp
        call    SYM(crashed)

ASM_END
