// Loops over the rows of a frame, for the 386 and up. Each routine implements its C++ twin in src/picture/blit.cpp, and the tests
// feed both the same input. Above each group of instructions stands the line of C++ that it implements.
//
// Cycles are given with everything in the first-level cache.

#include "asm.h"

#define SCREEN_WIDTH 320

        .text

// ---------------------------------------------------------------------------------------------------------------------
// int drawnRunsA(const uint8_t* row, const uint16_t* depths, const Span* within, Span* runs)
//
//   esi  row            edi  row + x            edx  row + within->to        ebx  runs + count
//
// Empty pixels are skipped with string instructions, four in 5 cycles on the 486. Drawn pixels are skipped by their depths,
// sixteen in 22 cycles: an empty pixel has depth 0xffff, so while bit 15 of sixteen depths is clear (they are nearer than 256
// units) all of them are drawn. The rest of a run costs 5 cycles per pixel.

        .balign 16
        FUNC(drawnRunsA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    20(%esp), %esi
        movl    28(%esp), %ecx
        movl    32(%esp), %ebx
        movswl  (%ecx), %edi
        movswl  2(%ecx), %edx
        xorl    %eax, %eax
        addl    %esi, %edi
        addl    %esi, %edx
        cld
        // while (x < to && row[x] == 0) ++x;   singly until to - x is a multiple of 4, then by fours, then singly in the last four
runs_empty:
        movl    %edx, %ecx
        subl    %edi, %ecx
        andl    $3, %ecx
        jz      runs_fours
        repe scasb
        jne     runs_first
runs_fours:
        movl    %edx, %ecx
        subl    %edi, %ecx
        shrl    $2, %ecx
        jz      runs_done
        repe scasl
        je      runs_done
        subl    $4, %edi
        movl    $4, %ecx
        repe scasb
runs_first:
        // runs[count].from = x
        leal    -1(%edi), %ecx
        subl    %esi, %ecx
        movw    %cx, (%ebx)
        // while (x + 16 <= to && none of depths[x..x + 15] has bit 15) x += 16;   starts at an even x, at most one pixel later
        movl    %edx, %eax
        leal    1(%ecx), %ecx
        subl    %esi, %eax
        andl    $-2, %ecx
        movl    24(%esp), %ebp
        subl    $16, %eax
        leal    (%ebp,%ecx,2), %ecx
        leal    (%ebp,%eax,2), %eax     // the last address at which sixteen depths are still within
runs_sixteen:
        cmpl    %eax, %ecx
        ja      runs_passed
        movl    (%ecx), %ebp
        orl     4(%ecx), %ebp
        orl     8(%ecx), %ebp
        orl     12(%ecx), %ebp
        orl     16(%ecx), %ebp
        orl     20(%ecx), %ebp
        orl     24(%ecx), %ebp
        orl     28(%ecx), %ebp
        addl    $32, %ecx
        testl   $0x80008000, %ebp
        jz      runs_sixteen
        subl    $32, %ecx
runs_passed:
        subl    24(%esp), %ecx
        shrl    $1, %ecx
        leal    (%esi,%ecx), %edi
        xorl    %eax, %eax
        // while (x < to && row[x] != 0) ++x
        movl    %edx, %ecx
        subl    %edi, %ecx
        jz      runs_last
        repne scasb
        jne     runs_last
        // runs[count].to = x;  ++count;   pixel x is empty, and edi points one past it
        leal    -1(%edi), %ecx
        subl    %esi, %ecx
        movw    %cx, 2(%ebx)
        addl    $4, %ebx
        jmp     runs_empty
runs_last:
        subl    %esi, %edx
        movw    %dx, 2(%ebx)
        addl    $4, %ebx
runs_done:
        movl    %ebx, %eax
        subl    32(%esp), %eax
        shrl    $2, %eax
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret
        ENDFUNC(drawnRunsA)

// ---------------------------------------------------------------------------------------------------------------------
// void presentRows(uint32_t selector, uint32_t offset, const uint8_t* frame, const Span* rows, int count)
//
//   es   the screen     edx  frame              ebx  row                eax  offset in the screen    ebp  rows to go
//
// The bus to the video card limits the speed here, not the processor; 32-bit words make the best use of the bus.

        .balign 16
        FUNC(presentRows)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        pushl   %es
        movl    24(%esp), %eax
        movl    %eax, %es
        movl    28(%esp), %eax
        movl    32(%esp), %edx
        movl    36(%esp), %ebx
        movl    40(%esp), %ebp
        cld
        testl   %ebp, %ebp
        jle     present_done
present_row:
        // if (to > from) memcpy(screen + from, frame + from, to - from)
        movswl  (%ebx), %esi
        movswl  2(%ebx), %ecx
        subl    %esi, %ecx
        jle     present_next
        leal    (%eax,%esi), %edi
        addl    %edx, %esi
        shrl    $2, %ecx
        rep movsl
present_next:
        addl    $4, %ebx
        addl    $SCREEN_WIDTH, %eax
        addl    $SCREEN_WIDTH, %edx
        decl    %ebp
        jnz     present_row
present_done:
        popl    %es
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret
        ENDFUNC(presentRows)

ASM_END
