// From voxels to pixels, for the 386 and up: the loop that a frame spends most of its time in but for settling.
// src/picture/scales.cpp has it in C++ and says what it does; the tests feed both the same input. Above each group of
// instructions stands the line of C++ that it implements.
//
// What a scale costs before its first pixel are its multiplications, eight of one brightness and twelve of a brightness
// that changes (one takes as long as its second factor has bits: 9 to 38 cycles on the 386, 13 to 42 on the 486; 10 on the
// Pentium, in the U pipe alone), so the factors are kept short: 15 bits for places and sizes, 10 for slopes. There is no
// division.
//
// Cycles of the rows are given as "486 / Pentium" with everything in the first-level cache. A 16-bit operand has a prefix
// byte: one cycle on the 486, and on the Pentium it keeps the instruction out of the V pipe. A word for the depth is still
// right: it halves what a clear and the cache have to hold.

#include "asm.h"

// struct Voxel (include/surface/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_HALF_WIDTH 12
#define VOXEL_HALF_HEIGHT 14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_BRIGHT 20                 /* and behind it, one double word with it, bytes all: */
#define VOXEL_REACH  21
#define VOXEL_CUTX   22
#define VOXEL_CUTY   23
#define VOXEL_SLOPEX 24                 /* one word with: */
#define VOXEL_SLOPEY 25
#define VOXEL_CUTAT  26
#define VOXEL_CURVEXX 28                /* one double word, bytes all: */
#define VOXEL_CURVEXY 29
#define VOXEL_CURVEYY 30
#define VOXEL_SIZE   32

// struct Factors, struct Lens and the constants (include/picture/scales.h)
#define FACTOR_X   0
#define FACTOR_Y   4
#define FACTOR_ZX  8
#define FACTOR_ZY  12
#define FACTOR_SIZE 16
#define LENS_NEAR  76
#define LENS_FAR   432
#define LENS_NEXT  1
#define FACTOR_MOST 0xffff
#define LENS_FINENESS 16
#define LENS_STEPS ((LENS_FAR - LENS_NEAR) * LENS_FINENESS)
#define STEEPEST   400
#define LARGEST    40
#define Z_EMPTY    0xffff
#define SCREEN_WIDTH 320
#define SCREEN_HEIGHT 200

// Rows and columns up to which a scale's pixels stand in the code one by one.
#define UNROLLED   8
// Of the table of ways to draw: columns, rows of a kind of scale, and how many bits a row of the table is wide. No scale
// of the table has a corner so far from its middle that a depth could leave 16 bits.
#define KIND_COLUMNS  16
#define KIND_ROWS  24
#define KIND_SHIFT 6
// Behind the kinds of the table: what is larger, nearer or clipped, LARGEST ways; and what is only cut.
#define LARGE_KIND (2*KIND_ROWS)
#define CUT_KIND   (2*KIND_ROWS+3)

// A copy of the lens on the stack, and what else has no register.
#define LENS_X     0
#define LENS_Y     4
#define LENS_Z     8                    /* from the nearest depth of the table */
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
#define TILT_ADD   56
#define TILT_BITS  60
#define FOCALX     64
#define FOCALY     68
#define LENS_WORDS 18
#define LIST       72                   /* the voxel, counted in bytes from the end: below 0 */
#define END        76
#define DEPTH      80                   /* 1/128 unit beyond the nearest of the table */
#define NOT_LEFT   84                   /* ~left: it is what shortens the arithmetic */
#define BOTTOM     88
#define KIND       92                   /* rows - 1, and the first row of the kind in the table */
#define ZMOST      96
#define FROM_COLUMN 100                 /* the way from the first pixel's middle to the scale's, to the left and down */
#define FROM_ROW   104
#define ROW        108
#define WIDTH      112                  /* of what is cut or large: columns - 1, rows - 1 (and then those to go), */
#define HEIGHT     116
#define ENTRY      120                  /* where in the code a row of them begins, */
#define CUT        124                  /* and the function that cuts: at the first pixel, from pixel to pixel and row to row */
#define CUT_STEP   128
#define CUT_ROW    132
#define CUT_XX     136                  /* where it curves: what its steps change by (FineScale), and the first of a row */
#define CUT_XY     140
#define CUT_YY     144
#define CUT_FIRST  148
#define NEAR       152                  /* struct Factors of what is nearer than the table */
#define LOCALS     168

        .text

// ---------------------------------------------------------------------------------------------------------------------
// const Voxel* drawScalesA(Lens* lens, const Voxel* voxels, const Voxel* end)
//
//   esi  voxel     ebp  factors of its depth     edi  width - 1
//   ecx  from the first pixel's middle to the scale's, columns     edx  the same, rows
//
// and then, from row to row:
//
//   eax  z (ax), and above it the brightness with 8 bits of fraction     ebx  change of both from pixel to pixel
//   edx  what is subtracted from both from row to row (of one brightness: ebp)
//   ebp  the ramp     ecx  to look it up (the colour: cl)     esi  depths + row     edi  pixels + row
//
// z never leaves its 16 bits on a scale, so one addition changes both and the brightness takes no harm. A pixel behind what
// is there costs 3 instructions (486: 2 + 3 + 1, Pentium: 3 when the branch is foreseen, the addition pairs), one that is
// taken 8 (486: 2 + 1 + 1 + 2 + 2 + 1 + 1 + 1; Pentium 7, the copy pairs with the branch before it, the addition with the
// store), of one brightness 5. A scale that ends compares once more where it would be taken. Up to UNROLLED rows and
// columns a row costs one addition more and nothing is counted: the table has an entry into the code for each width and
// height, from which on as many rows follow as are to be drawn. Larger scales go row by row.
//
// Those that are cut, clipped, larger or nearer than the tables enter each row at as many columns before its end as they are
// wide. Of what is cut edx has the function that cuts, which costs 2 instructions a pixel more; 3 are all for a pixel cut off.
// Along a curve the step changes as well: 2 more (486: 1 + 3, Pentium: 4).

        .balign 16
        FUNC(drawScalesA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    20(%esp), %esi          // lens
        movl    24(%esp), %eax          // voxels
        movl    28(%esp), %edx          // end
        subl    $LOCALS, %esp
        movl    %esp, %edi
        movl    $LENS_WORDS, %ecx
        cld
        rep movsl
        subl    $LENS_NEAR*256, LENS_Z(%esp)
        movl    %edx, END(%esp)
        movl    %eax, %ecx
        subl    %edx, %ecx
        jns     leave_at
        movl    %ecx, LIST(%esp)

        .macro  COVER_COLUMNS near
        // column = centreX + ((lens->x + v.x) * f.x >> 8);  half = v.halfWidth * f.x >> 8
        imull   FACTOR_X(%ebp), %ebx
        sarl    $8, %ebx
        imull   FACTOR_X(%ebp), %edi
        addl    CENTREX(%esp), %ebx
        sarl    $8, %edi
        movl    %ebx, %ecx
        // left = (column - half) >> 12;  right = (column + half) >> 12
        subl    %edi, %ecx
        addl    %ebx, %edi
        sarl    $12, %ecx
        sarl    $12, %edi
        // if (left < lens->left) ..;  if (right > lens->right) ..
        cmpl    BOX_LEFT(%esp), %ecx
        jl      grow_left\near
left_grown\near:
        cmpl    BOX_RIGHT(%esp), %edi
        jg      grow_right\near
right_grown\near:
        notl    %ecx
        addl    %ecx, %edi              // width - 1 = right + ~left
        movl    %ecx, NOT_LEFT(%esp)
        .endm

        // The rectangle lies on the screen, so what is not on it is found here. What is clipped goes on as what is large, for its
        // middle may be far.
        .macro  GROW_COLUMNS near
grow_left\near:
        testl   %ecx, %ecx
        js      clip_left
        movl    %ecx, BOX_LEFT(%esp)
        jmp     left_grown\near
grow_right\near:
        cmpl    $SCREEN_WIDTH, %edi
        jg      clip_right
        movl    %edi, BOX_RIGHT(%esp)
        jmp     right_grown\near
        .endm

        .macro  COVER_ROWS large
        // row = centreY - ((lens->y + v.y) * f.y >> 8);  half = v.halfHeight * f.y >> 8
        movl    VOXEL_Y(%esi), %edx
        shll    $12, %ecx
        addl    LENS_Y(%esp), %edx
        addl    %ebx, %ecx              // -toColumn = column - ((left + 1) << 12)
        imull   FACTOR_Y(%ebp), %edx
        movswl  VOXEL_HALF_HEIGHT(%esi), %eax
        sarl    $8, %edx
        movl    CENTREY(%esp), %ebx
        imull   FACTOR_Y(%ebp), %eax
        subl    %edx, %ebx
        sarl    $8, %eax
        movl    %ebx, %edx
        // top = (row - half) >> 12;  bottom = (row + half) >> 12
        subl    %eax, %edx
        addl    %ebx, %eax
        sarl    $12, %edx
        sarl    $12, %eax
        // if (top < lens->top) ..;  if (bottom > lens->bottom) ..
        cmpl    BOX_TOP(%esp), %edx
        jl      grow_top\large
top_grown\large:
        cmpl    BOX_BOTTOM(%esp), %eax
        jg      grow_bottom\large
bottom_grown\large:
        notl    %edx
        movl    %eax, BOTTOM(%esp)
        addl    %edx, %eax              // height - 1
        shll    $12, %edx
        .endm

        .macro  GROW_ROWS large
grow_top\large:
        testl   %edx, %edx
        js      clip_top
        movl    %edx, BOX_TOP(%esp)
        jmp     top_grown\large
grow_bottom\large:
        cmpl    $SCREEN_HEIGHT, %eax
        jg      clip_bottom
        movl    %eax, BOX_BOTTOM(%esp)
        jmp     bottom_grown\large
        .endm

        .balign 16
voxel_loop:
        movl    END(%esp), %esi
        addl    LIST(%esp), %esi
        // depth = lens->z + v.z;  f = factorsOf(lens, depth):  step = lensStep(depth);  if (step < LENS_STEPS) ..
        // A unit has 256 steps of depth and takes 256 bytes of the table, so that a depth leads to its own factors.
        movl    VOXEL_Z(%esi), %ebp
        movl    VOXEL_X(%esi), %ebx
        addl    LENS_Z(%esp), %ebp
        addl    LENS_X(%esp), %ebx
        movswl  VOXEL_HALF_WIDTH(%esi), %edi
        movl    %ebp, %eax
        cmpl    $LENS_STEPS*FACTOR_SIZE, %ebp
        jae     near
        shrl    $1, %eax
        andl    $-FACTOR_SIZE, %ebp
        movl    %eax, DEPTH(%esp)
        addl    FACTORS(%esp), %ebp
        COVER_COLUMNS
        // if (width <= 0) ..;  if (width > LARGEST) break
        cmpl    $KIND_COLUMNS, %edi
        jae     odd_width
        COVER_ROWS
        // if (height <= 0) ..;  if (height > LARGEST) break
        cmpl    $KIND_ROWS, %eax
        jae     odd_height
        addl    %ebx, %edx              // -toRow = row - ((top + 1) << 12)
        movl    %eax, KIND(%esp)
        // zMost = endOf(v, depth >> 1);  if (isCut(v)) ..
        cmpl    $255, VOXEL_BRIGHT(%esi)
        ja      special
not_special:
        // across = limited(tiltX * f.zx >> 16);  down = -limited(tiltY * f.zy >> 16);   eax has -down
        movl    VOXEL_TILTX(%esi), %eax // both: Lens::tiltAdd
        movswl  VOXEL_TILTX(%esi), %ebx
        addl    TILT_ADD(%esp), %eax
        imull   FACTOR_ZX(%ebp), %ebx
        testl   TILT_BITS(%esp), %eax
        movswl  VOXEL_TILTY(%esi), %eax
        jnz     steep
        imull   FACTOR_ZY(%ebp), %eax
        sarl    $16, %ebx
        sarl    $16, %eax
steps_limited:
        // if (!isFine(v)) ..
        cmpw    $0, VOXEL_SLOPEX(%esi)
        je      even
shaded:
        // z = (depth >> 1) + ((across * toColumn + down * toRow) >> 12)
        movl    %ecx, FROM_COLUMN(%esp)
        imull   %ebx, %ecx
        movl    %edx, FROM_ROW(%esp)
        imull   %eax, %edx
        subl    %ecx, %edx
        sarl    $12, %edx
        addl    %edx, DEPTH(%esp)
        // shadeAcross = slopeX * f.zx >> 10;  shadeDown = -(slopeY * f.zy >> 10);   edx has -shadeDown
        movsbl  VOXEL_SLOPEX(%esi), %ecx
        movsbl  VOXEL_SLOPEY(%esi), %edx
        imull   FACTOR_ZX(%ebp), %ecx
        imull   FACTOR_ZY(%ebp), %edx
        sarl    $10, %ecx
        sarl    $10, %edx
        // both changes in one register, from pixel to pixel and, the sign turned, from row to row
        movl    %ecx, %ebp
        shll    $16, %ebp
        addl    %ebp, %ebx
        movl    %edx, %ebp
        shll    $16, %ebp
        addl    %ebp, %eax
        // shade = brightness * 256 + 128 + ((shadeAcross * toColumn + shadeDown * toRow) >> 12)
        imull   FROM_COLUMN(%esp), %ecx
        imull   FROM_ROW(%esp), %edx
        subl    %ecx, %edx
        movl    KIND(%esp), %ecx
        sarl    $12, %edx
        addb    VOXEL_BRIGHT(%esi), %dh
        shll    $KIND_SHIFT, %ecx
        shll    $16, %edx
        movl    BOTTOM(%esp), %esi
        movl    shaded_ways(%ecx,%edi,4), %ecx
        // -zRow = across * (width - 1) - down, and -shadeRow
        imull   %ebx, %edi
        leal    (%esi,%esi,4), %esi
        addl    %eax, %edi
        movl    DEPTH(%esp), %eax
        shll    $6, %esi
        leal    LENS_NEAR*128+(128<<16)(%eax,%edx), %eax
        // start = bottom * WIDTH + left;  pixels = frame + start;  depths = zbuffer + start;   320 = 5 * 64
        subl    NOT_LEFT(%esp), %esi
        movl    %edi, %edx
        movl    FRAME(%esp), %edi
        addl    %esi, %edi
        addl    %esi, %esi
        movl    RAMP(%esp), %ebp
        addl    ZBUFFER(%esp), %esi
        jmp     *%ecx

        // One brightness
        .balign 4
even:
        cmpl    $KIND_ROWS, KIND(%esp)
        jae     shaded
        // z = (depth >> 1) + ((across * toColumn + down * toRow) >> 12);  -zRow = across * (width - 1) - down
        imull   %ebx, %ecx
        imull   %eax, %edx
        movl    %ebx, %ebp
        subl    %ecx, %edx
        imull   %edi, %ebp
        sarl    $12, %edx
        addl    %eax, %ebp
        movl    DEPTH(%esp), %eax
        leal    LENS_NEAR*128(%eax,%edx), %eax
        // colour = ramp[brightness]
        movl    VOXEL_BRIGHT(%esi), %ecx
        addl    RAMP(%esp), %ecx
        movl    KIND(%esp), %edx
        movb    (%ecx), %cl
        shll    $KIND_SHIFT, %edx
        // start = bottom * WIDTH + left;  pixels = frame + start;  depths = zbuffer + start
        movl    BOTTOM(%esp), %esi
        movl    even_ways(%edx,%edi,4), %edx
        leal    (%esi,%esi,4), %esi
        movl    FRAME(%esp), %edi
        shll    $6, %esi
        subl    NOT_LEFT(%esp), %esi
        addl    %esi, %edi
        addl    %esi, %esi
        addl    ZBUFFER(%esp), %esi
        jmp     *%edx

        // if (z < depths[x]): depths[x] = z, pixels[x] = colour
        .macro  PIXEL_even at
        cmpw    2*(\at)(%esi), %ax
        jae     1f
        movw    %ax, 2*(\at)(%esi)
        movb    %cl, \at(%edi)
1:
        .endm

        // if (z < depths[x]): depths[x] = z, pixels[x] = ramp[shade >> 8]
        .macro  PIXEL_shaded at
        cmpw    2*(\at)(%esi), %ax
        jae     1f
        movl    %eax, %ecx
        movw    %ax, 2*(\at)(%esi)
        sarl    $24, %ecx
        movb    (%ebp,%ecx), %cl
        movb    %cl, \at(%edi)
1:
        .endm

        // if (z < depths[x] && z <= zMost): depths[x] = z, pixels[x] = ramp[shade >> 8]
        .macro  PIXEL_ending at
        cmpw    2*(\at)(%esi), %ax
        jae     1f
        cmpw    ZMOST(%esp), %ax
        ja      1f
        movl    %eax, %ecx
        movw    %ax, 2*(\at)(%esi)
        sarl    $24, %ecx
        movb    (%ebp,%ecx), %cl
        movb    %cl, \at(%edi)
1:
        .endm

        // if (z < depths[x] && cut >= 0) ..;   the flags are those of `cut`
        .macro  PIXEL_cut at
        js      2f
        PIXEL_shaded \at
2:
        .endm

        // if (z < depths[x] && z <= zMost && cut >= 0) ..
        .macro  PIXEL_cutending at
        js      2f
        PIXEL_ending \at
2:
        .endm

        // for (x = 0; x < width; ++x, z += zStep) ..;   `at`: the pixel from edi. Behind the last one nothing is added.
        .macro  PIXELS kind width at
        .set    at, \at
        .rept   \width-1
        PIXEL_\kind at
        addl    %ebx, %eax
        .set    at, at + 1
        .endr
        PIXEL_\kind at
        .endm

        .macro  NEXT_VOXEL
        addl    $VOXEL_SIZE, LIST(%esp)
        jnz     voxel_loop
        jmp     leave
        .endm

        // for (y = height; y > 0; --y, z += zRow), up to UNROLLED rows. edi is the pixel behind the first one of the row below
        // the scale: its left is what ~left makes of it.
        .macro  SOME_ROWS kind row width
        .irp    height, 8, 7, 6, 5, 4, 3, 2, 1
\kind\()_\width\()_\height:
        PIXELS  \kind, \width, (-\height*SCREEN_WIDTH-1)
        .if     \height > 1
        subl    \row, %eax
        .endif
        .endr
        NEXT_VOXEL
        .endm

        // The same, any number of them. Of a scale of one brightness edx is free, of others it is made so. The rows that KIND
        // counts lie above the last one.
        .macro  ALL_ROWS kind row width
        .balign 4
\kind\()_\width:
        .ifnc   \kind, even
        movl    %edx, ROW(%esp)
        .endif
        movl    KIND(%esp), %edx
        .ifc    \kind, ending
        subl    $KIND_ROWS, %edx
        movl    %edx, KIND(%esp)
        .endif
        imull   $-SCREEN_WIDTH, %edx, %edx
        addl    %edx, %edi
        leal    (%esi,%edx,2), %esi
        movl    KIND(%esp), %edx
\kind\()_\width\()_row:
        PIXELS  \kind, \width, (-SCREEN_WIDTH-1)
        subl    \row, %eax
        addl    $2*SCREEN_WIDTH, %esi
        addl    $SCREEN_WIDTH, %edi
        decl    %edx
        jns     \kind\()_\width\()_row
        NEXT_VOXEL
        .endm

        .balign 16
        .irp    width, 1, 2, 3, 4, 5, 6, 7, 8
        SOME_ROWS even, %ebp, \width
        SOME_ROWS shaded, %edx, \width
        SOME_ROWS ending, %edx, \width
        .endr
        .irp    width, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16
        ALL_ROWS even, %ebp, \width
        ALL_ROWS shaded, ROW(%esp), \width
        ALL_ROWS ending, ROW(%esp), \width
        .endr

        // for (y = height; y > 0; --y, z += zRow, cut += cutRow)
        //     for (x = 0; x < width; ++x, z += zStep, cut += cutStep) ..;   edi is the pixel behind the last one of the row
        // `cuts`: 0: nothing does; 1: along a line, and cutRow is from the last pixel of a row to the next one; 2: along a curve
        .macro  ENTERED kind pixel cuts
        .balign 4
        .set    at, -LARGEST
        .irp    width, 40, 39, 38, 37, 36, 35, 34, 33, 32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, \
                      19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1
entered_\kind\()_\width:
        PIXEL_\pixel at
        .if     \width > 1
        addl    %ebx, %eax
        .if     \cuts == 2
        movl    CUT_XX(%esp), %ecx
        addl    %ecx, CUT_STEP(%esp)
        .endif
        .if     \cuts
        addl    CUT_STEP(%esp), %edx
        .endif
        .endif
        .set    at, at + 1
        .endr
        subl    ROW(%esp), %eax
        addl    $2*SCREEN_WIDTH, %esi
        addl    $SCREEN_WIDTH, %edi
        decl    HEIGHT(%esp)
        js      entered_\kind\()_done
        .if     \cuts == 1
        addl    CUT_ROW(%esp), %edx
        .endif
        .if     \cuts == 2
        // cutStep += cutXY, cutRow += cutYY
        movl    CUT_XY(%esp), %ecx
        movl    CUT_ROW(%esp), %edx
        addl    CUT_FIRST(%esp), %ecx
        addl    CUT_YY(%esp), %edx
        movl    %ecx, CUT_FIRST(%esp)
        movl    %edx, CUT_ROW(%esp)
        movl    %ecx, CUT_STEP(%esp)
        addl    CUT(%esp), %edx
        movl    %edx, CUT(%esp)
        .endif
        jmp     *ENTRY(%esp)
entered_\kind\()_done:
        NEXT_VOXEL
        .endm

        // if (!depthsFit(z, across * (width - 1), down * (height - 1))) break
        .balign 4
large:
        movl    %edx, ROW(%esp)
        movswl  %bx, %ecx               // across
        negl    %edx
        movswl  %dx, %edx               // down - across * (width - 1)
        imull   WIDTH(%esp), %ecx
        addl    $LENS_NEAR*128, DEPTH(%esp)
        addl    %ecx, %edx
        imull   HEIGHT(%esp), %edx
        cmpl    $Z_EMPTY, DEPTH(%esp)
        jae     leave
        addl    %ecx, DEPTH(%esp)
        cmpl    $Z_EMPTY, DEPTH(%esp)
        jae     leave
        addl    %edx, DEPTH(%esp)
        cmpl    $Z_EMPTY, DEPTH(%esp)
        jae     leave
        subl    %ecx, DEPTH(%esp)
        cmpl    $Z_EMPTY, DEPTH(%esp)
        jae     leave
        movl    ROW(%esp), %edx
        // pixels -= height * SCREEN_WIDTH;  depths -= height * SCREEN_WIDTH;   and to the end of the row
small:
        movl    HEIGHT(%esp), %ecx
        movl    %edx, ROW(%esp)
        notl    %ecx
        movl    CUT(%esp), %edx
        imull   $SCREEN_WIDTH, %ecx, %ecx
        addl    WIDTH(%esp), %ecx
        addl    %ecx, %edi
        leal    (%esi,%ecx,2), %esi
        testl   %edx, %edx
        jmp     *ENTRY(%esp)
        ENTERED shaded, shaded, 0
        ENTERED ending, ending, 0
        ENTERED cut, cut, 1
        ENTERED cutending, cutending, 1
        ENTERED curved, cut, 2
        ENTERED curvedending, cutending, 2

leave:
        movl    END(%esp), %eax
        addl    LIST(%esp), %eax
leave_at:
        // What changed of the lens goes back; the voxel at hand is returned
        movl    LOCALS+20(%esp), %edx   // lens
        leal    BOX_LEFT(%esp), %esi
        leal    BOX_LEFT(%edx), %edi
        movl    $LENS_WORDS-BOX_LEFT/4, %ecx
        rep movsl
        addl    $LOCALS, %esp
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

        // A voxel that ends where it gets too far away, or that is cut. (A depth and an end fit 16 bits.)
        .balign 4
special:
        cmpl    $0xffff, VOXEL_BRIGHT(%esi)
        ja      cut
        movzbl  VOXEL_REACH(%esi), %eax
        movl    DEPTH(%esp), %ebx
        leal    LENS_NEAR*128(%ebx,%eax,4), %eax
        addl    $KIND_ROWS, KIND(%esp)
        movl    %eax, ZMOST(%esp)
        jmp     not_special

        // if (depth < LENS_NEXT * 256 || depth >= LENS_NEAR * 256) break
        .balign 4
near:
        movl    VOXEL_Z(%esi), %ecx
        addl    LENS_Z(%esp), %ecx
        movl    %ecx, %eax
        addl    $LENS_NEAR*256, %ecx
        sarl    $1, %eax
        cmpl    $LENS_NEXT*256, %ecx
        jl      leave
        cmpl    $LENS_NEAR*256, %ecx
        jge     leave
        movl    %eax, DEPTH(%esp)
        // near.x = focalX * 256 / depth;  near.y = focalY * 256 / depth;  if (near.x > FACTOR_MOST || ..) break
        movl    FOCALX(%esp), %eax
        xorl    %edx, %edx
        shll    $8, %eax
        divl    %ecx
        cmpl    $FACTOR_MOST, %eax
        ja      leave
        movl    %eax, NEAR+FACTOR_X(%esp)
        movl    FOCALY(%esp), %eax
        xorl    %edx, %edx
        shll    $8, %eax
        divl    %ecx
        cmpl    $FACTOR_MOST, %eax
        ja      leave
        movl    %eax, NEAR+FACTOR_Y(%esp)
        // near.zx = (depth << 19) / focalX;  near.zy = (depth << 19) / focalY
        movl    $1<<19, %eax
        mull    %ecx
        divl    FOCALX(%esp)
        movl    %eax, NEAR+FACTOR_ZX(%esp)
        movl    $1<<19, %eax
        mull    %ecx
        divl    FOCALY(%esp)
        movl    %eax, NEAR+FACTOR_ZY(%esp)
        leal    NEAR(%esp), %ebp
        COVER_COLUMNS _near
        // if (width <= 0) ..;  if (width > LARGEST) break
odd_width:
        cmpl    $LARGEST, %edi
        jae     no_width
        COVER_ROWS _large
        // if (height <= 0) ..;  if (height > LARGEST) break
odd_height:
        cmpl    $LARGEST, %eax
        jae     no_height
        addl    %ebx, %edx              // -toRow = row - ((top + 1) << 12)
        movl    $LARGE_KIND, %ebx
        jmp     entered
cut:
        movl    KIND(%esp), %eax
        movl    $CUT_KIND, %ebx
entered:
        movl    %edi, WIDTH(%esp)
        movl    %eax, HEIGHT(%esp)
        movl    %ebx, KIND(%esp)
        // zMost = endOf(v, depth >> 1)
        leal    entered_ways(,%edi,4), %eax
        movzbl  VOXEL_REACH(%esi), %ebx
        testl   %ebx, %ebx
        jz      1f
        shll    $2, %ebx
        addl    $4*LARGEST, %eax        // to those that end
        addl    DEPTH(%esp), %ebx
        addl    $LENS_NEAR*128, %ebx
        movl    %ebx, ZMOST(%esp)
1:
        // if (isCut(v)) ..;   otherwise the code that the row is entered at has nothing to do with what cuts
        cmpw    $0, VOXEL_CUTX(%esi)    // both
        je      2f
        cmpl    $0, VOXEL_CURVEXX(%esi) // all
        jne     curved
        addl    $2*4*LARGEST, %eax      // to those that are cut
        movl    (%eax), %eax
        movl    %eax, ENTRY(%esp)
        // cutAcross = cutX * f.zx >> 10;  cutDown = -(cutY * f.zy >> 10);   ebx has -cutDown
        movsbl  VOXEL_CUTX(%esi), %eax
        movsbl  VOXEL_CUTY(%esi), %ebx
        imull   FACTOR_ZX(%ebp), %eax
        imull   FACTOR_ZY(%ebp), %ebx
        sarl    $10, %eax
        sarl    $10, %ebx
        movl    %eax, CUT_STEP(%esp)
        movl    %ebx, CUT_ROW(%esp)
        // cut = cutAt * 4 + ((cutAcross * toColumn + cutDown * toRow) >> 12)
        imull   %ecx, %eax
        imull   %edx, %ebx
        subl    %eax, %ebx
        movswl  VOXEL_CUTAT(%esi), %eax
        sarl    $12, %ebx
        shll    $2, %eax
        addl    %eax, %ebx
        movl    %ebx, CUT(%esp)
        // cutRow = cutDown - cutAcross * (width - 1)
        movl    CUT_STEP(%esp), %eax
        imull   %edi, %eax
        addl    CUT_ROW(%esp), %eax
        negl    %eax
        movl    %eax, CUT_ROW(%esp)
        jmp     not_special
2:
        movl    (%eax), %eax
        movl    %eax, ENTRY(%esp)
        jmp     not_special

        // setCut() of what ends at a curve
        .balign 4
curved:
        addl    $4*4*LARGEST, %eax
        movl    (%eax), %eax
        movl    %eax, ENTRY(%esp)
        // xx = (curveXX * f.zx >> 10) * f.zx >> 16;  xy, yy
        .macro  CURVE_STEP curve factor other
        movsbl  \curve(%esi), %eax
        imull   \factor(%ebp), %eax
        sarl    $10, %eax
        imull   \other(%ebp), %eax
        sarl    $16, %eax
        .endm
        CURVE_STEP VOXEL_CURVEXX, FACTOR_ZX, FACTOR_ZX
        movl    %eax, CUT_XX(%esp)
        CURVE_STEP VOXEL_CURVEXY, FACTOR_ZX, FACTOR_ZY
        negl    %eax
        movl    %eax, CUT_XY(%esp)
        CURVE_STEP VOXEL_CURVEYY, FACTOR_ZY, FACTOR_ZY
        movl    %eax, CUT_YY(%esp)
        // acrossFirst = across + ((xx * toColumn + xy * toRow) >> 12);   eax: across + acrossFirst
        .macro  CURVE_FIRST curve other
        movl    \curve(%esp), %eax
        movl    \other(%esp), %ebx
        imull   %ecx, %eax
        imull   %edx, %ebx
        addl    %ebx, %eax
        negl    %eax
        sarl    $12, %eax
        .endm
        CURVE_FIRST CUT_XX, CUT_XY
        movsbl  VOXEL_CUTX(%esi), %ebx
        imull   FACTOR_ZX(%ebp), %ebx
        sarl    $10, %ebx
        addl    %ebx, %eax
        movl    %eax, CUT_STEP(%esp)
        addl    %ebx, %eax
        sarl    $1, %eax
        movl    %eax, CUT(%esp)
        // downFirst = down + ((xy * toColumn + yy * toRow) >> 12)
        CURVE_FIRST CUT_XY, CUT_YY
        movsbl  VOXEL_CUTY(%esi), %ebx
        imull   FACTOR_ZY(%ebp), %ebx
        sarl    $10, %ebx
        subl    %ebx, %eax
        movl    %eax, CUT_ROW(%esp)
        subl    %ebx, %eax
        sarl    $1, %eax
        // cut = cutAt * 4 + (((across + acrossFirst >> 1) * toColumn + (down + downFirst >> 1) * toRow) >> 12)
        movl    CUT(%esp), %ebx
        imull   %edx, %eax
        imull   %ecx, %ebx
        addl    %ebx, %eax
        movswl  VOXEL_CUTAT(%esi), %ebx
        negl    %eax
        shll    $2, %ebx
        sarl    $12, %eax
        addl    %ebx, %eax
        movl    %eax, CUT(%esp)
        // cutStep -= xx >> 1;  cutRow -= yy >> 1
        movl    CUT_XX(%esp), %eax
        movl    CUT_YY(%esp), %ebx
        sarl    $1, %eax
        sarl    $1, %ebx
        negl    %eax
        subl    %ebx, CUT_ROW(%esp)
        addl    CUT_STEP(%esp), %eax
        movl    %eax, CUT_STEP(%esp)
        movl    %eax, CUT_FIRST(%esp)
        jmp     not_special

        // Seldom
no_width:
        testl   %edi, %edi
        jns     leave
empty:
        incl    EMPTY(%esp)
        NEXT_VOXEL
no_height:
        testl   %eax, %eax
        js      empty
        jmp     leave

        // if (last - first > LARGEST) break;  first or last = the screen's edge
        .macro  CLIP name first last clipped edge box on
\name:
        subl    \first, \last
        cmpl    $LARGEST, \last
        jg      leave
        addl    \first, \last
        movl    $\edge, \clipped
        movl    \clipped, \box(%esp)
        jmp     \on
        .endm
        CLIP    clip_left, %ecx, %edi, %ecx, 0, BOX_LEFT, left_grown_near
        CLIP    clip_right, %ecx, %edi, %edi, SCREEN_WIDTH, BOX_RIGHT, right_grown_near
        CLIP    clip_top, %edx, %eax, %edx, 0, BOX_TOP, top_grown_large
        CLIP    clip_bottom, %edx, %eax, %eax, SCREEN_HEIGHT, BOX_BOTTOM, bottom_grown_large
        GROW_COLUMNS
        GROW_COLUMNS _near
        GROW_ROWS
        GROW_ROWS _large
steep:
        imull   FACTOR_ZY(%ebp), %eax
        .irp    step, %ebx, %eax
        sarl    $16, \step
        cmpl    $STEEPEST, \step
        jle     1f
        movl    $STEEPEST, \step
1:
        cmpl    $-STEEPEST, \step
        jge     1f
        movl    $-STEEPEST, \step
1:
        .endr
        jmp     steps_limited
        ENDFUNC(drawScalesA)

        // Where the code for each kind, height and width begins. The kind that ends comes behind the shaded one, what
        // is cut or large behind that (KIND).
        .macro  WAY kind height width
        .if     \width > UNROLLED || \height > UNROLLED
        .long   \kind\()_\width
        .else
        .long   \kind\()_\width\()_\height
        .endif
        .endm

        .macro  WAYS kind
        .irp    height, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24
        .irp    width, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16
        WAY     \kind, \height, \width
        .endr
        .endr
        .endm

        .data
        .balign 4
even_ways:
        WAYS    even
shaded_ways:
        WAYS    shaded
        WAYS    ending
        .rept   (CUT_KIND-LARGE_KIND)*KIND_COLUMNS
        .long   large
        .endr
        .rept   KIND_COLUMNS
        .long   small
        .endr

        // Where in the code a row of each width begins.
        .macro  ENTRIES kind
        .irp    width, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, \
                      21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40
        .long   entered_\kind\()_\width
        .endr
        .endm

entered_ways:
        ENTRIES shaded
        ENTRIES ending
        ENTRIES cut
        ENTRIES cutending
        ENTRIES curved
        ENTRIES curvedending

ASM_END
