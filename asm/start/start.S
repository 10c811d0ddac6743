// The first instructions of DEMO.EXE in the stock build; DJGPP's programs have crt0 for this. The stub has loaded .text
// and .data, has cleared .bss, and jumps here with
//
//     cs:eip  start, ds the program's 32-bit data segment (same base as cs, limit at least the end of .bss)
//     fs      a segment that begins with the go32 stub's information block (src/rt/stubinfo.h)
//     ss:esp  the stub's small stack
//
// The steps: set es = ds, move the stack into .bss, copy the information block (the transfer buffer will overwrite it), and
// call rtStart(), which does not return.

#include "asm.h"

#define STACK_BYTES 131072
#define STUBINFO_SIZE 16                // offset in the block of the block's size
#define STUBINFO_BYTES 84

        .text
        .globl  start
start:
        cld
        movw    %ds, %ax
        movw    %ax, %es
        movw    %ax, %ss
        movl    $rtStackTop, %esp

        // Copy the block at fs:0 to stubInfo, as many bytes as both sides know.
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

        // The stub's segment is not needed any more; fs and gs may be used freely from here on.
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
