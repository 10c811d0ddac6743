// The first instructions of DEMO.EXE as the stock compiler builds it: what DJGPP's crt0 is for its programs, and no
// more. The stub has loaded .text and .data and jumps here with
//
//     cs:eip  start, ds the program's 32-bit data segment (same base as cs, limit at least the end of .bss)
//     fs      a segment that begins with the go32 stub's information block (src/rt/stubinfo.h)
//     ss:esp  the stub's small stack
//
// Order: es = ds, .bss cleared, the stack moved into .bss, the information block copied (it lies where the transfer
// buffer will be), then rtStart(), which does not come back.

#include "asm.h"

#define STACK_BYTES 131072
#define STUBINFO_SIZE 16                // offset of the block's size in the block
#define STUBINFO_BYTES 84

        .text
        .globl  start
start:
        cld
        movw    %ds, %ax
        movw    %ax, %es

        // for (p = bss; p < end; ++p) *p = 0; 32 bits at a time, for both ends are aligned to 4 at least
        movl    $__bss_start, %edi
        movl    $_end, %ecx
        subl    %edi, %ecx
        addl    $3, %ecx
        shrl    $2, %ecx
        xorl    %eax, %eax
        rep stosl

        movw    %ds, %ax
        movw    %ax, %ss
        movl    $rtStackTop, %esp

        // stubInfo = *fs:0, as much of it as both sides know
        movl    $STUBINFO_BYTES, %ecx
        movl    %fs:STUBINFO_SIZE, %eax
        cmpl    %ecx, %eax
        jae     1f
        movl    %eax, %ecx
1:      xorl    %esi, %esi
        movl    $stubInfo, %edi
        pushl   %ds
        pushl   %fs
        popl    %ds
        rep movsb
        popl    %ds

        // The stub's segment is no longer ours to read; fs and gs are free for all.
        xorl    %eax, %eax
        movw    %ax, %fs
        movw    %ax, %gs
        xorl    %ebp, %ebp
        call    rtStart

        .section .bss
        .balign 16
        .globl  rtStackBottom
rtStackBottom:
        .skip   STACK_BYTES
        .globl  rtStackTop
rtStackTop:

ASM_END
