// From voxels to pixels, for the 386 and up: the loop that a frame spends most of its time in but for settling.
// src/scales.cpp has it in C++ and says what it does; the tests feed both the same input. Above each group of instructions
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

// struct Voxel (include/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_WIDE   12
#define VOXEL_HIGH   14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_BRIGHT 20

// struct Factors, struct Lens and the constants (include/scales.h)
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
#define LOCALS     80

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
// addition pairs), one that is taken 5 (486: 2 + 1 + 2 + 1 + 1). A row adds 5.

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
        // colour = ramp[brightness]
        movzbl  VOXEL_BRIGHT(%esi), %ecx
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

ASM_END
