// From voxels to pixels, for the 386 and up: the loop that a frame spends most of its time in but for settling.
// src/picture/scales.cpp has it in C++ and says what it does; the tests feed both the same input. Above each group of instructions
// stands the line of C++ that it implements.
//
// What a scale costs before its first pixel are the eight multiplications (one takes as long as its second factor has
// bits: 9 to 38 cycles on the 386, 13 to 42 on the 486; 10 on the Pentium, in the U pipe alone), so the factors are kept
// short: 15 bits for places and sizes, 10 for slopes. There is no division.
//
// Cycles of the rows are given as "486 / Pentium" with everything in the first-level cache. A 16-bit operand has a prefix
// byte: one cycle on the 486, and on the Pentium it keeps the instruction out of the V pipe. A word for the depth is still
// right: it halves what a clear and the cache have to hold.

#include "asm.h"

// struct Voxel (include/surface/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_WIDE   12
#define VOXEL_HIGH   14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_BRIGHT 20                 /* and behind it, bytes all: */
#define VOXEL_REACH  21
#define VOXEL_SLOPEX 22
#define VOXEL_SLOPEY 23

// struct Factors, struct Lens and the constants (include/picture/scales.h)
#define FACTOR_X   0
#define FACTOR_Y   4
#define FACTOR_ZX  8
#define FACTOR_ZY  12
#define FACTOR_SHIFT 4
#define LENS_NEAR  76
#define LENS_FAR   256
#define LENS_STEPS ((LENS_FAR - LENS_NEAR) * 8)
#define STEEPEST   400
#define SLOPED_MOST 24
#define WIDEST     16
#define SCREEN_WIDTH 320
#define SCREEN_HEIGHT 200

// A copy of the lens on the stack, and what else has no register.
#define LENS_X     0
#define LENS_Y     4
#define LENS_Z     8
#define RAMP       12
#define FACTORS    16
#define CENTREX    20
#define CENTREY    24
#define FRAME      28
#define ZBUFFER    32
#define BOX_LEFT   36
#define BOX_TOP    40
#define BOX_RIGHT  44
#define BOX_BOTTOM 48
#define EMPTY      52
#define LENS_WORDS 14
#define LIST       56                   /* the next voxel's place in the list */
#define END        60
#define DEPTH      64
#define LEFT       68
#define STEP       72
#define ZROW       76
#define FIRST      80                   /* of voxels that are fine: the depth of the first pixel, */
#define ROWS_LEFT  84                   /* rows to go, where to enter a row, where it ends, the change of brightness */
#define ENTRY      88
#define ZMOST      92
#define SHADE_STEP 96
#define SHADE_ROW  100
#define FINE_TOP   104                  /* and the first row */
#define LOCALS     108

        .text

// ---------------------------------------------------------------------------------------------------------------------
// int drawScalesA(Lens* lens, const Voxel* const* voxels, int count)
//
//   esi  voxel     ebp  factors of its depth     edi  width
//   first the columns, then the rows; ecx keeps what the columns add to the depth of the first pixel
//
// and then, from row to row:
//
//   eax  z (ax)    ebx  change of z from pixel to pixel    ecx  colour (cl)    edx  rows to go
//   esi  depths + row    edi  pixels + row
//
// A pixel behind what is there costs 3 instructions (486: 2 + 3 + 1, Pentium: 3 when the branch is foreseen, the
// addition pairs), one that is taken 5 (486: 2 + 1 + 2 + 1 + 1). A row adds 5. About a third of the scales end at the
// horizon: two instructions more a pixel, ebp where they end. In one of ten the brightness changes: ecx brightness with 8
// bits of fraction (ch what is looked up), ebp the ramp, edx for the looking up; nine instructions a pixel that is taken.

        .balign 16
        FUNC(drawScalesA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    20(%esp), %esi          // lens
        movl    24(%esp), %eax          // voxels
        movl    28(%esp), %edx          // count
        subl    $LOCALS, %esp
        movl    %esp, %edi
        movl    $LENS_WORDS, %ecx
        cld
        rep movsl
        leal    (%eax,%edx,4), %edx
        movl    %edx, END(%esp)
        cmpl    %edx, %eax
        jae     leave_at

        .balign 16
voxel_loop:
        movl    (%eax), %esi
        movl    %eax, LIST(%esp)
        // depth = lens->z + v.z;  step = (depth >> 5) - LENS_NEAR * 8;  if (step >= LENS_STEPS) break
        movl    VOXEL_Z(%esi), %ebp
        movl    VOXEL_X(%esi), %ebx
        addl    LENS_Z(%esp), %ebp
        addl    LENS_X(%esp), %ebx
        movl    %ebp, DEPTH(%esp)
        shrl    $5, %ebp
        subl    $LENS_NEAR*8, %ebp
        cmpl    $LENS_STEPS, %ebp
        jae     leave
        shll    $FACTOR_SHIFT, %ebp
        addl    FACTORS(%esp), %ebp
        // column = centreX + ((lens->x + v.x) * f.x >> 8);  halfWide = wide * f.x >> 8
        imull   FACTOR_X(%ebp), %ebx
        jo      leave
        movswl  VOXEL_WIDE(%esi), %edi
        sarl    $8, %ebx
        imull   FACTOR_X(%ebp), %edi
        addl    CENTREX(%esp), %ebx
        sarl    $8, %edi
        movl    %ebx, %ecx
        // left = (column - halfWide) >> 12;  right = (column + halfWide) >> 12;  wide = right - left
        subl    %edi, %ecx
        addl    %ebx, %edi
        sarl    $12, %ecx
        js      leave
        sarl    $12, %edi
        movswl  VOXEL_TILTX(%esi), %edx
        cmpl    $SCREEN_WIDTH, %edi
        jg      leave
        cmpl    BOX_LEFT(%esp), %ecx
        jl      grow_left
left_grown:
        cmpl    BOX_RIGHT(%esp), %edi
        jg      grow_right
right_grown:
        subl    %ecx, %edi
        movl    %ecx, LEFT(%esp)
        cmpl    $WIDEST, %edi
        ja      leave
        // across = limited(tiltX * f.zx >> 16);  across * (((left + 1) << 12) - column)
        imull   FACTOR_ZX(%ebp), %edx
        incl    %ecx
        sarl    $16, %edx
        shll    $12, %ecx
        leal    STEEPEST(%edx), %eax
        subl    %ebx, %ecx
        cmpl    $2*STEEPEST, %eax
        ja      limit_across
across_limited:
        movl    VOXEL_Y(%esi), %ebx
        movl    %edx, STEP(%esp)
        imull   %edx, %ecx
        addl    LENS_Y(%esp), %ebx
        // row = centreY - ((lens->y + v.y) * f.y >> 8);  halfHigh = high * f.y >> 8
        imull   FACTOR_Y(%ebp), %ebx
        jo      leave
        movswl  VOXEL_HIGH(%esi), %edx
        sarl    $8, %ebx
        imull   FACTOR_Y(%ebp), %edx
        subl    CENTREY(%esp), %ebx
        sarl    $8, %edx
        negl    %ebx
        // top = (row - halfHigh) >> 12;  bottom = (row + halfHigh) >> 12;  high = bottom - top
        leal    (%ebx,%edx), %eax
        negl    %edx
        addl    %ebx, %edx
        sarl    $12, %eax
        sarl    $12, %edx
        js      leave
        cmpl    $SCREEN_HEIGHT, %eax
        jg      leave
        cmpl    BOX_BOTTOM(%esp), %eax
        jg      grow_bottom
bottom_grown:
        cmpl    BOX_TOP(%esp), %edx
        jl      grow_top
top_grown:
        subl    %edx, %eax
        jle     empty
        // if (wide + high > SLOPED_MOST) break
        addl    %eax, %edi
        cmpl    $SLOPED_MOST, %edi
        ja      leave
        subl    %eax, %edi
        jz      empty
        movl    %eax, ZROW(%esp)        // the rows, for a moment
        // down = -limited(tiltY * f.zy >> 16);  down * (((top + 1) << 12) - row)
        movswl  VOXEL_TILTY(%esi), %eax
        imull   FACTOR_ZY(%ebp), %eax
        leal    1(%edx), %ebp
        sarl    $16, %eax
        shll    $12, %ebp
        subl    %ebx, %ebp
        leal    STEEPEST(%eax), %ebx
        cmpl    $2*STEEPEST, %ebx
        ja      limit_down
down_limited:
        imull   %eax, %ebp
        // z = (depth >> 1) + (... >> 12);  zRow = down - across * wide
        subl    %ebp, %ecx
        movl    STEP(%esp), %ebx
        movl    %ebx, %ebp
        sarl    $12, %ecx
        imull   %edi, %ebp
        addl    %eax, %ebp
        movl    DEPTH(%esp), %eax
        negl    %ebp
        sarl    $1, %eax
        addl    %ecx, %eax
        // if (isFine(v)) ..;  colour = ramp[brightness]
        movl    VOXEL_BRIGHT(%esi), %ecx
        cmpl    $255, %ecx
        ja      fine
        addl    RAMP(%esp), %ecx
        movb    (%ecx), %cl
        // start = top * WIDTH + left;  pixels = frame + start;  depths = zbuffer + start;   320 = 5 * 64
        leal    (%edx,%edx,4), %esi
        movl    ZROW(%esp), %edx
        shll    $6, %esi
        movl    %ebp, ZROW(%esp)
        addl    LEFT(%esp), %esi
        movl    rows_of(,%edi,4), %ebp
        movl    FRAME(%esp), %edi
        addl    %esi, %edi
        addl    %esi, %esi
        addl    ZBUFFER(%esp), %esi
        jmp     *%ebp

        // for (y = high; y > 0; --y, z += zRow)
        //     for (x = 0; x < wide; ++x, z += zStep)
        //         (z < depths[x]): depths[x] = z, pixels[x] = colour
        .macro  ROWS wide
        .balign 16
rows_\wide:
        .set    x, 0
        .rept   \wide
        cmpw    2*x(%esi), %ax
        jae     1f
        movw    %ax, 2*x(%esi)
        movb    %cl, x(%edi)
1:
        addl    %ebx, %eax
        .set    x, x + 1
        .endr
        addl    ZROW(%esp), %eax
        addl    $2*SCREEN_WIDTH, %esi
        addl    $SCREEN_WIDTH, %edi
        decl    %edx
        jnz     rows_\wide
        movl    LIST(%esp), %eax
        addl    $4, %eax
        cmpl    END(%esp), %eax
        jb      voxel_loop
        jmp     leave_at
        .endm

        ROWS    1
        ROWS    2
        ROWS    3
        ROWS    4
        ROWS    5
        ROWS    6
        ROWS    7
        ROWS    8
        ROWS    9
        ROWS    10
        ROWS    11
        ROWS    12
        ROWS    13
        ROWS    14
        ROWS    15
        ROWS    16

        // A voxel that ends where it gets too far away, or whose brightness changes. Here still: eax z, ebx its step, ebp the
        // step from row to row, esi the voxel, edi the width, edx the first row.
        .balign 16
fine:
        movl    %eax, FIRST(%esp)
        cmpl    $0xffff, %ecx
        jbe     ending
        movl    ZROW(%esp), %eax        // the rows
        movl    %ebp, ZROW(%esp)
        movl    %eax, ROWS_LEFT(%esp)
        movl    %edx, FINE_TOP(%esp)
        // zMost = reach != 0 ? (depth >> 1) + reach * 4 : NO_END
        movl    DEPTH(%esp), %ebp
        movzbl  %ch, %eax
        testl   %eax, %eax
        jz      no_end
        sarl    $1, %ebp
        leal    (%ebp,%eax,4), %eax
ends:
        movl    %eax, ZMOST(%esp)
        movl    DEPTH(%esp), %ebp
        shrl    $5, %ebp
        subl    $LENS_NEAR*8, %ebp
        shll    $FACTOR_SHIFT, %ebp
        addl    FACTORS(%esp), %ebp
        // shadeAcross = slopeX * f.zx >> 10;  across = shadeAcross * (((left + 1) << 12) - column)
        movl    VOXEL_X(%esi), %eax
        addl    LENS_X(%esp), %eax
        imull   FACTOR_X(%ebp), %eax
        sarl    $8, %eax
        movl    LEFT(%esp), %ecx
        addl    CENTREX(%esp), %eax
        incl    %ecx
        movsbl  VOXEL_SLOPEX(%esi), %edx
        shll    $12, %ecx
        imull   FACTOR_ZX(%ebp), %edx
        sarl    $10, %edx
        subl    %eax, %ecx
        movl    %edx, SHADE_STEP(%esp)
        imull   %edx, %ecx
        // shadeDown = -(slopeY * f.zy >> 10);  shadeRow = shadeDown - shadeAcross * wide
        imull   %edi, %edx
        movsbl  VOXEL_SLOPEY(%esi), %eax
        imull   FACTOR_ZY(%ebp), %eax
        sarl    $10, %eax
        addl    %eax, %edx
        negl    %edx
        movl    %edx, SHADE_ROW(%esp)
        // shade = brightness * 256 + 128 + ((across + shadeDown * (((top + 1) << 12) - row)) >> 12), row = centreY - ..
        movl    VOXEL_Y(%esi), %edx
        addl    LENS_Y(%esp), %edx
        imull   FACTOR_Y(%ebp), %edx
        sarl    $8, %edx
        movl    FINE_TOP(%esp), %ebp
        subl    CENTREY(%esp), %edx
        incl    %ebp
        shll    $12, %ebp
        addl    %ebp, %edx
        imull   %eax, %edx
        subl    %edx, %ecx
        movzbl  VOXEL_BRIGHT(%esi), %eax
        sarl    $12, %ecx
        shll    $8, %eax
        leal    128(%ecx,%eax), %ecx
        // The rows are drawn by the end of one loop of 16 pixels, from the pixel that is that far from its end.
        movl    fine_of(,%edi,4), %eax
        movl    FINE_TOP(%esp), %edx
        movl    %eax, ENTRY(%esp)
        leal    (%edx,%edx,4), %esi
        shll    $6, %esi
        movl    LEFT(%esp), %edx
        addl    %edi, %edx
        movl    FRAME(%esp), %edi
        leal    -WIDEST-1(%esi,%edx), %esi
        addl    %esi, %edi
        addl    %esi, %esi
        addl    ZBUFFER(%esp), %esi
        movl    FIRST(%esp), %eax
        movl    RAMP(%esp), %ebp
        jmp     *ENTRY(%esp)
no_end:
        movl    $0x7fffffff, %eax
        jmp     ends

        // One brightness, but it ends.
        .balign 4
ending:
        leal    (%edx,%edx,4), %esi
        movzbl  %ch, %eax
        movl    DEPTH(%esp), %edx
        shll    $6, %esi
        sarl    $1, %edx
        addl    LEFT(%esp), %esi
        leal    (%edx,%eax,4), %eax
        movl    ZROW(%esp), %edx
        movzbl  %cl, %ecx
        movl    %ebp, ZROW(%esp)
        addl    RAMP(%esp), %ecx
        movl    ending_of(,%edi,4), %ebp
        movb    (%ecx), %cl
        movl    %ebp, ENTRY(%esp)
        movl    FRAME(%esp), %edi
        movl    %eax, %ebp
        addl    %esi, %edi
        addl    %esi, %esi
        movl    FIRST(%esp), %eax
        addl    ZBUFFER(%esp), %esi
        jmp     *ENTRY(%esp)

        // (z <= zMost && z < depths[x]): depths[x] = z, pixels[x] = colour.  Taken 7 instructions, else 3 or 5.
        .macro  ENDING wide
        .balign 16
ending_\wide:
        .set    x, 0
        .rept   \wide
        cmpl    %ebp, %eax
        jg      1f
        cmpw    2*x(%esi), %ax
        jae     1f
        movw    %ax, 2*x(%esi)
        movb    %cl, x(%edi)
1:
        addl    %ebx, %eax
        .set    x, x + 1
        .endr
        addl    ZROW(%esp), %eax
        addl    $2*SCREEN_WIDTH, %esi
        addl    $SCREEN_WIDTH, %edi
        decl    %edx
        jnz     ending_\wide
        jmp     fine_done
        .endm

        ENDING  1
        ENDING  2
        ENDING  3
        ENDING  4
        ENDING  5
        ENDING  6
        ENDING  7
        ENDING  8
        ENDING  9
        ENDING  10
        ENDING  11
        ENDING  12
        ENDING  13
        ENDING  14
        ENDING  15
        ENDING  16

        // (z <= zMost && z < depths[x]): depths[x] = z, pixels[x] = ramp[shade >> 8].  Taken 9 instructions, else 4 or 6.
        .macro  FINE_PIXEL wide
fine_\wide:
        cmpl    ZMOST(%esp), %eax
        jg      1f
        cmpw    2*(WIDEST+1-\wide)(%esi), %ax
        jae     1f
        movsbl  %ch, %edx
        movb    (%ebp,%edx), %dl
        movw    %ax, 2*(WIDEST+1-\wide)(%esi)
        movb    %dl, WIDEST+1-\wide(%edi)
1:
        addl    %ebx, %eax
        addl    SHADE_STEP(%esp), %ecx
        .endm

        .balign 16
        FINE_PIXEL 16
        FINE_PIXEL 15
        FINE_PIXEL 14
        FINE_PIXEL 13
        FINE_PIXEL 12
        FINE_PIXEL 11
        FINE_PIXEL 10
        FINE_PIXEL 9
        FINE_PIXEL 8
        FINE_PIXEL 7
        FINE_PIXEL 6
        FINE_PIXEL 5
        FINE_PIXEL 4
        FINE_PIXEL 3
        FINE_PIXEL 2
        FINE_PIXEL 1
        addl    ZROW(%esp), %eax
        addl    SHADE_ROW(%esp), %ecx
        addl    $2*SCREEN_WIDTH, %esi
        addl    $SCREEN_WIDTH, %edi
        decl    ROWS_LEFT(%esp)
        jz      fine_done
        jmp     *ENTRY(%esp)
fine_done:
        movl    LIST(%esp), %eax
        addl    $4, %eax
        cmpl    END(%esp), %eax
        jb      voxel_loop
        jmp     leave_at

leave:
        movl    LIST(%esp), %eax
leave_at:
        // What changed of the lens goes back; the number of voxels done
        movl    LOCALS+20(%esp), %edx   // lens
        leal    BOX_LEFT(%esp), %esi
        leal    BOX_LEFT(%edx), %edi
        movl    $LENS_WORDS-BOX_LEFT/4, %ecx
        rep movsl
        subl    LOCALS+24(%esp), %eax   // voxels
        sarl    $2, %eax
        addl    $LOCALS, %esp
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

        // Seldom
empty:
        incl    EMPTY(%esp)
        movl    LIST(%esp), %eax
        addl    $4, %eax
        cmpl    END(%esp), %eax
        jb      voxel_loop
        jmp     leave_at
grow_left:
        movl    %ecx, BOX_LEFT(%esp)
        jmp     left_grown
grow_right:
        movl    %edi, BOX_RIGHT(%esp)
        jmp     right_grown
grow_bottom:
        movl    %eax, BOX_BOTTOM(%esp)
        jmp     bottom_grown
grow_top:
        movl    %edx, BOX_TOP(%esp)
        jmp     top_grown
limit_across:
        sarl    $31, %edx               // 0 or -1
        xorl    $STEEPEST, %edx         // STEEPEST or -STEEPEST - 1
        movl    %edx, %eax
        shrl    $31, %eax
        addl    %eax, %edx
        jmp     across_limited
limit_down:
        sarl    $31, %eax
        xorl    $STEEPEST, %eax
        movl    %eax, %ebx
        shrl    $31, %ebx
        addl    %ebx, %eax
        jmp     down_limited
        ENDFUNC(drawScalesA)

        .balign 4
rows_of:
        .long   leave                   // width 0 does not come so far
        .long   rows_1, rows_2, rows_3, rows_4, rows_5, rows_6, rows_7, rows_8
        .long   rows_9, rows_10, rows_11, rows_12, rows_13, rows_14, rows_15, rows_16
ending_of:
        .long   leave
        .long   ending_1, ending_2, ending_3, ending_4, ending_5, ending_6, ending_7, ending_8
        .long   ending_9, ending_10, ending_11, ending_12, ending_13, ending_14, ending_15, ending_16
fine_of:
        .long   leave
        .long   fine_1, fine_2, fine_3, fine_4, fine_5, fine_6, fine_7, fine_8
        .long   fine_9, fine_10, fine_11, fine_12, fine_13, fine_14, fine_15, fine_16

ASM_END
