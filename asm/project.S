// The perspective transformation of scales for the 386 and up. src/project.cpp has it in C++ and says what it does; the
// tests feed both the same input. Above each group of instructions stands the line of C++ that it implements.
//
// About a hundred instructions a scale. What they cost are the eight multiplications (a multiplication takes as long as
// its second factor has bits: 9 to 38 cycles on the 386, 13 to 42 on the 486; 10 on the Pentium, in the U pipe alone),
// so the factors are kept short: 15 bits for places and sizes, 10 for slopes. There is no division.

#include "asm.h"

// struct Voxel (include/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_WIDE   12
#define VOXEL_HIGH   14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_COLOUR 20
#define VOXEL_BYTES  24

// struct Scale (include/blit.h)
#define LEFT    0
#define TOP     2
#define WIDE    4
#define HIGH    6
#define DEPTH   8
#define STEP    12
#define ROW     16
#define COLOUR  20
#define SCALE_BYTES 24

// struct Factors, struct Lens and the constants (include/project.h)
#define FACTOR_X   0
#define FACTOR_Y   4
#define FACTOR_ZX  8
#define FACTOR_ZY  12
#define FACTOR_SHIFT 4
#define LENS_WORDS 7
#define LENS_NEAR  76
#define LENS_FAR   256
#define LENS_STEPS ((LENS_FAR - LENS_NEAR) * 8)
#define STEEPEST   400
#define SLOPED_MOST 24
#define SCREEN_WIDTH 320
#define SCREEN_HEIGHT 200

// A copy of the lens on the stack, and what else has no register.
#define FACTORS 0
#define CENTREX 4
#define CENTREY 8
#define BOX_LEFT 12
#define BOX_TOP 16
#define BOX_RIGHT 20
#define BOX_BOTTOM 24
#define END     28
#define LOCALS  32

        .text

// ---------------------------------------------------------------------------------------------------------------------
// int projectA(Lens* lens, const Voxel* voxels, int count, Scale* scales, int* made)
//
//   esi  voxel     edi  scale     ebp  factors of its depth
//   first the columns, then the rows; ecx keeps what the columns add to the depth of the first pixel

        .balign 16
        FUNC(projectA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    20(%esp), %esi          // lens
        movl    24(%esp), %eax          // voxels
        movl    28(%esp), %ecx          // count
        movl    32(%esp), %edx          // scales
        subl    $LOCALS, %esp
        movl    %esp, %edi
        leal    (%ecx,%ecx,2), %ebx
        movl    $LENS_WORDS, %ecx
        cld
        rep movsl
        leal    (%eax,%ebx,8), %ebx
        movl    %eax, %esi
        movl    %edx, %edi
        movl    %ebx, END(%esp)
        cmpl    %ebx, %esi
        jae     leave

        .balign 16
voxel_loop:
        // step = (z >> 5) - LENS_NEAR * 8;  if (step >= LENS_STEPS || colour == GAP) break
        movl    VOXEL_Z(%esi), %ebp
        movl    VOXEL_X(%esi), %ebx
        shrl    $5, %ebp
        subl    $LENS_NEAR*8, %ebp
        cmpl    $LENS_STEPS, %ebp
        jae     leave
        shll    $FACTOR_SHIFT, %ebp
        cmpb    $0, VOXEL_COLOUR(%esi)
        je      leave
        addl    FACTORS(%esp), %ebp
        // column = centreX + (x * f.x >> 8);  halfWide = wide * f.x >> 8
        imull   FACTOR_X(%ebp), %ebx
        jo      leave
        movswl  VOXEL_WIDE(%esi), %eax
        sarl    $8, %ebx
        imull   FACTOR_X(%ebp), %eax
        addl    CENTREX(%esp), %ebx
        sarl    $8, %eax
        movl    %ebx, %ecx
        // left = (column - halfWide) >> 12;  right = (column + halfWide) >> 12;  if (left < 0 || right > WIDTH) break
        subl    %eax, %ecx
        addl    %ebx, %eax
        sarl    $12, %ecx
        js      leave
        sarl    $12, %eax
        cmpl    $SCREEN_WIDTH, %eax
        jg      leave
        // if (left >= right) continue
        cmpl    %ecx, %eax
        jle     voxel_next
        // The box grows
        cmpl    BOX_LEFT(%esp), %ecx
        jl      grow_left
left_grown:
        cmpl    BOX_RIGHT(%esp), %eax
        jg      grow_right
right_grown:
        subl    %ecx, %eax
        movw    %cx, LEFT(%edi)
        movw    %ax, WIDE(%edi)
        // across = limited(tiltX * f.zx >> 16);  across * (((left + 1) << 12) - column)
        movswl  VOXEL_TILTX(%esi), %edx
        incl    %ecx
        imull   FACTOR_ZX(%ebp), %edx
        shll    $12, %ecx
        sarl    $16, %edx
        subl    %ebx, %ecx
        leal    STEEPEST(%edx), %ebx
        cmpl    $2*STEEPEST, %ebx
        ja      limit_across
across_limited:
        imull   %edx, %ecx
        movl    %edx, STEP(%edi)
        imull   %eax, %edx
        movl    VOXEL_Y(%esi), %ebx
        movl    %edx, ROW(%edi)
        // row = centreY - (y * f.y >> 8);  halfHigh = high * f.y >> 8
        imull   FACTOR_Y(%ebp), %ebx
        jo      leave
        movswl  VOXEL_HIGH(%esi), %edx
        sarl    $8, %ebx
        imull   FACTOR_Y(%ebp), %edx
        subl    CENTREY(%esp), %ebx
        sarl    $8, %edx
        negl    %ebx
        // top = (row - halfHigh) >> 12;  bottom = (row + halfHigh) >> 12;  if (top < 0 || bottom > HEIGHT) break
        leal    (%ebx,%edx), %eax
        negl    %edx
        addl    %ebx, %edx
        sarl    $12, %eax
        sarl    $12, %edx
        js      leave
        cmpl    $SCREEN_HEIGHT, %eax
        jg      leave
        // if (top >= bottom) continue
        cmpl    %edx, %eax
        jle     voxel_next
        cmpl    BOX_BOTTOM(%esp), %eax
        jg      grow_bottom
bottom_grown:
        cmpl    BOX_TOP(%esp), %edx
        jl      grow_top
top_grown:
        subl    %edx, %eax
        movw    %dx, TOP(%edi)
        movw    %ax, HIGH(%edi)
        // if (wide + high > SLOPED_MOST) break
        addw    WIDE(%edi), %ax
        cmpw    $SLOPED_MOST, %ax
        ja      leave
        // down = -limited(tiltY * f.zy >> 16);  down * (((top + 1) << 12) - row)
        movswl  VOXEL_TILTY(%esi), %eax
        incl    %edx
        imull   FACTOR_ZY(%ebp), %eax
        shll    $12, %edx
        sarl    $16, %eax
        subl    %ebx, %edx
        leal    STEEPEST(%eax), %ebx
        cmpl    $2*STEEPEST, %ebx
        ja      limit_down
down_limited:
        imull   %eax, %edx
        // z = (depth >> 1) + (... >> 12)
        movl    VOXEL_Z(%esi), %ebx
        subl    %edx, %ecx
        sarl    $1, %ebx
        sarl    $12, %ecx
        addl    %ecx, %ebx
        // zRow = down - across * wide
        addl    ROW(%edi), %eax
        movl    %ebx, DEPTH(%edi)
        negl    %eax
        movzbl  VOXEL_COLOUR(%esi), %edx
        movl    %eax, ROW(%edi)
        movl    %edx, COLOUR(%edi)
        addl    $SCALE_BYTES, %edi
voxel_next:
        addl    $VOXEL_BYTES, %esi
        cmpl    END(%esp), %esi
        jb      voxel_loop

leave:
        // The box back to the lens; the number of scales made, and of voxels done (both have 24 bytes)
        movl    LOCALS+20(%esp), %edx   // lens
        movl    BOX_LEFT(%esp), %eax
        movl    BOX_TOP(%esp), %ecx
        movl    %eax, BOX_LEFT(%edx)
        movl    %ecx, BOX_TOP(%edx)
        movl    BOX_RIGHT(%esp), %eax
        movl    BOX_BOTTOM(%esp), %ecx
        movl    %eax, BOX_RIGHT(%edx)
        movl    %ecx, BOX_BOTTOM(%edx)
        addl    $LOCALS, %esp
        movl    $SCALE_BYTES, %ecx
        movl    %edi, %eax
        subl    32(%esp), %eax          // scales
        xorl    %edx, %edx
        divl    %ecx
        movl    36(%esp), %edx          // made
        movl    %eax, (%edx)
        movl    %esi, %eax
        subl    24(%esp), %eax          // voxels
        xorl    %edx, %edx
        divl    %ecx
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

        // Seldom: the box grows, a slope is limited.
grow_left:
        movl    %ecx, BOX_LEFT(%esp)
        jmp     left_grown
grow_right:
        movl    %eax, BOX_RIGHT(%esp)
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
        movl    %edx, %ebx
        shrl    $31, %ebx
        addl    %ebx, %edx
        jmp     across_limited
limit_down:
        sarl    $31, %eax
        xorl    $STEEPEST, %eax
        movl    %eax, %ebx
        shrl    $31, %ebx
        addl    %ebx, %eax
        jmp     down_limited
        ENDFUNC(projectA)

ASM_END
