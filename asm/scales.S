// From voxels to pixels, for the 386 and up: apart from settling, a frame spends most of its time in this loop. The routine
// implements its C++ twin in src/picture/scales.cpp, and the tests feed both the same input. Above each group of instructions
// stands the line of C++ that it implements.
//
// The cost of a scale before its first pixel is that of its multiplications: nine for a scale of one brightness, thirteen if the
// brightness changes. A multiplication takes 9 to 38 cycles on the 386 and 13 to 42 on the 486, depending on the bits of its
// second factor, and 10 on the Pentium, in the U pipe only. Therefore the factors are kept short: 15 bits for positions and
// sizes, 10 for slopes. There is no division.
//
// Cycles of the rows are given as "486 / Pentium" with everything in the first-level cache. A 16-bit operand has a prefix byte,
// which takes one cycle on the 486 and keeps the instruction out of the V pipe of the Pentium. Depths of 16 bits still pay,
// because they halve the memory that has to be cleared and that the cache has to hold.

#include "asm.h"

// struct Voxel (include/surface/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_HALF_WIDTH 12
#define VOXEL_HALF_HEIGHT 14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_BRIGHT 20                 /* this and the next three are bytes and are read together as one 32-bit word */
#define VOXEL_BACK  21
#define VOXEL_CUTX   22
#define VOXEL_CUTY   23
#define VOXEL_SLOPEX 24                 /* this and the next are bytes and are read together as one 16-bit word */
#define VOXEL_SLOPEY 25
#define VOXEL_CUTAT  26
#define VOXEL_CURVEXX 28                /* these are bytes; the lower three of a 32-bit word */
#define VOXEL_CURVEXY 29
#define VOXEL_CURVEYY 30
#define VOXEL_FRONT  31                 /* the word's highest byte */
#define VOXEL_SIZE   32

// struct Factors, struct Lens and the constants (include/picture/scales.h)
#define FACTOR_X   0
#define FACTOR_Y   4
#define FACTOR_ZX  8
#define FACTOR_ZY  12
#define FACTOR_SIZE 16
#define LENS_NEAR  76
#define LENS_FAR   423
#define LENS_NEAREST 1
#define FACTOR_MOST 0xffff
#define LENS_FINENESS 16
#define LENS_STEPS ((LENS_FAR - LENS_NEAR) * LENS_FINENESS)
#define STEEPEST   400
#define DOMED      6
#define DOME_MOST  2880
#define WIDEST_PIXEL 10000
#define AVERAGED   96
#define STEP_OF    128
#define STEP_BIAS  64
#define LARGEST    40
#define CUT_MOST   32000                /* include/surface/voxel.h */
#define Z_EMPTY    0xffff
#define SCREEN_WIDTH 320
#define SCREEN_HEIGHT 200

// For scales up to this width and height the code is unrolled: each of their pixels has its own instructions.
#define UNROLLED   8
// The jump tables have an entry for each width up to KIND_COLUMNS and each height up to KIND_ROWS, for each kind of scale (even,
// shaded, ending); a row of a table takes 2^KIND_SHIFT bytes. Scales within these limits are so small that no depth at a corner
// can overflow 16 bits.
#define KIND_COLUMNS  16
#define KIND_ROWS  24
#define KIND_SHIFT 6
// Numbers of the table rows behind these kinds: for scales that are larger, nearer or clipped (any width up to LARGEST), and for
// scales that are only cut.
#define LARGE_KIND (2*KIND_ROWS)
#define CUT_KIND   (2*KIND_ROWS+3)

// The stack frame: a copy of the lens, and all values that have no register.
#define LENS_X     0
#define LENS_Y     4
#define LENS_Z     8                    /* minus the nearest depth of the table */
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
#define LIST       72                   /* address of the voxel - end, bytes: negative, 0 at the end of the list */
#define END        76
#define DEPTH      80                   /* depth of the scale - LENS_NEAR, 1/128 unit */
#define NOT_LEFT   84                   /* ~left = -left - 1, which saves instructions */
#define BOTTOM     88
#define KIND       92                   /* row of the jump table: height - 1 + the first row of the scale's kind */
#define ZRANGE     96                   /* zMost - zLeast */
#define FROM_COLUMN 100                 /* -toColumn, -toRow: from the first pixel's centre to the scale's middle */
#define FROM_ROW   104
#define ROW        108                  /* -zRow, -shadeRow packed in one word, from the last pixel of a row to the next row */
#define WIDTH      112                  /* of a cut or large scale: width - 1; height - 1, and then the rows still to draw - 1; */
#define HEIGHT     116
#define ENTRY      120                  /* the address at which the code of a row is entered; */
#define CUT        124                  /* and cut, cutStep, cutRow of its cut function */
#define CUT_STEP   128
#define CUT_ROW    132
#define CUT_XX     136                  /* cutXX, cutXY, cutYY of a curved cut, and cutStep at the beginning of the row */
#define CUT_XY     140
#define CUT_YY     144
#define CUT_FIRST  148
#define NEAR       152                  /* struct Factors for a scale nearer than the table */
#define ZLEAST     168
#define DOME       172                  /* dome of a scale with a straight cut; negative for other scales */
#define FIRST      176                  /* of a domed scale: z and shade at the beginning of the row, their steps there, and */
#define STEP       180                  /* their change to the next row, in the halves of one word each */
#define DOWN       184
#define LOCALS     188

        .text

// ---------------------------------------------------------------------------------------------------------------------
// const Voxel* drawScalesA(Lens* lens, const Voxel* voxels, const Voxel* end)
//
// Registers while a voxel is projected:
//
//   esi  voxel     ebp  factors of its depth (f)     edi  width - 1     ecx  -toColumn     edx  -toRow
//
// Registers while the pixels are drawn:
//
//   eax  lower half: z; upper half: shade (the brightness, 8 fraction bits)     ebx  zStep and shadeStep in the same halves
//   edx  what is subtracted from eax between two rows (ebp instead for a scale of one brightness)
//   ebp  ramp     ecx  index into the ramp, then the colour in cl     esi  depths + row     edi  pixels + row
//
// z never overflows its 16 bits on a scale, so one addition changes z and shade. An occluded pixel costs 3 instructions (486:
// 2 + 3 + 1; Pentium: 3 when the branch is predicted, and the addition pairs); a drawn pixel costs 8 (486: 2 + 1 + 1 + 2 + 2 +
// 1 + 1 + 1; Pentium: 7, as the copy pairs with the branch before it and the addition with the store), or 5 in a scale of one
// brightness. A scale with ends needs four more instructions for each pixel that passes the Z-buffer. Up to UNROLLED rows
// and columns a row costs only one more addition and there is no counter: for each width the code draws UNROLLED rows, and the
// jump table leads to the entry from which the scale's number of rows is left. Higher scales have a loop over the rows.
//
// Scales that are cut, clipped, large or nearer than the table use code that draws a row of LARGEST columns; it is entered at the
// scale's width before its end. With a cut, edx has the cut function, which takes 2 more instructions per pixel (a pixel cut off
// takes 3 altogether). Along a straight line the step of the depth changes with the dome, with 1 instruction more (486 and
// Pentium: 2), and pixels are averaged (Scale::averages): one that is, takes 8 instructions more if it is nearer and 12 if it
// is occluded, and any other one 3. What is cut nowhere has its dome in edx, which saves a cycle. Along a curve the step of the
// cut function changes, with 2 instructions more (486: 1 + 3, Pentium: 4).

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

        // The rectangle of the lens lies on the screen, so only a scale that enlarges it can cross the screen's edge. A clipped
        // scale continues like a large one, because its middle may be far from its pixels.
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
        // A unit is 256 in depth and takes 256 bytes in the table: a depth with its low bits cleared is the offset of its factors.
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
        // setEnds(v, depth >> 1, &scale);  if (isCut(v)) ..
        cmpl    $255, VOXEL_BRIGHT(%esi)
        ja      special
not_special:
        // across = limited(tiltX * f.zx >> 16);  down = -limited(tiltY * f.zy >> 16);   eax has -down
        movl    VOXEL_TILTX(%esi), %eax // tiltX and tiltY in one word, see Lens::tiltAdd
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
        // if (slopeX == 0 && slopeY == 0) the scale has one brightness
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
        // ebx: across and shadeAcross packed into one word;  ebp: -down and -shadeDown
        movl    %ecx, %ebp
        shll    $16, %ebp
        addl    %ebp, %ebx
        movl    %edx, %ebp
        shll    $16, %ebp
        addl    %eax, %ebp
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
        movl    DEPTH(%esp), %eax
        shll    $6, %esi
        leal    LENS_NEAR*128+(128<<16)(%eax,%edx), %eax
        // start = bottom * WIDTH + left;  pixels = frame + start;  depths = zbuffer + start;   320 = 5 * 64
        subl    NOT_LEFT(%esp), %esi
        leal    (%edi,%ebp), %edx
        movl    FRAME(%esp), %edi
        addl    %esi, %edi
        addl    %esi, %esi
        movl    RAMP(%esp), %ebp
        addl    ZBUFFER(%esp), %esi
        jmp     *%ecx

        // Scales of one brightness
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

        // if (z < depths[x] && z - zLeast <= zMost - zLeast): depths[x] = z, pixels[x] = ramp[shade >> 8]
        .macro  PIXEL_ending at
        cmpw    2*(\at)(%esi), %ax
        jae     1f
        movl    %eax, %ecx
        subl    ZLEAST(%esp), %ecx
        cmpw    ZRANGE(%esp), %cx
        ja      1f
        movl    %eax, %ecx
        movw    %ax, 2*(\at)(%esi)
        sarl    $24, %ecx
        movb    (%ebp,%ecx), %cl
        movb    %cl, \at(%edi)
1:
        .endm

        // if (z < depths[x] && cut >= 0) ..;   the sign flag is that of cut
        .macro  PIXEL_cut at
        js      2f
        PIXEL_shaded \at
2:
        .endm

        // if (z < depths[x] && z - zLeast <= zMost - zLeast && cut >= 0) ..
        .macro  PIXEL_cutending at
        js      2f
        PIXEL_ending \at
2:
        .endm

        // average() in src/picture/blit.cpp;   cx: nearer = depths[x] - z
        .macro  PIXEL_averaged at
        movw    2*(\at)(%esi), %cx
        subw    %ax, %cx
        jbe     3f
        movw    %ax, 2*(\at)(%esi)
        cmpw    $AVERAGED, %cx
        jb      4f
5:      movl    %eax, %ecx
        sarl    $24, %ecx
        movb    (%ebp,%ecx), %cl
        movb    %cl, \at(%edi)
2:
        // What follows is needed for fewer pixels, and stands apart so that the others need no jump past it.
        .text   1
        // farther: if (nearer < 0 && nearer >= -AVERAGED && there < 0) ..
3:      cmpw    $-AVERAGED, %cx
        jb      2b
        movzbl  \at(%edi), %ecx
        movb    STEP_OF(%ebp,%ecx), %cl
        shll    $24, %ecx
        js      6f
        jmp     2b
        // nearer: if (there >= 0): pixels[x] = ramp[shade >> 8]
4:      movzbl  \at(%edi), %ecx
        movb    STEP_OF(%ebp,%ecx), %cl
        shll    $24, %ecx
        jns     5b
        // pixels[x] = ramp[((there + (shade >> 8)) >> 1) + STEP_BIAS / 2];   the byte of the sum is that of ecx + eax
6:      addl    %eax, %ecx
        sarl    $25, %ecx
        movb    STEP_BIAS/2(%ebp,%ecx), %cl
        movb    %cl, \at(%edi)
        jmp     2b
        .text   0
        .endm

        // if (z - zLeast <= zMost - zLeast) average(..)
        .macro  PIXEL_averagedending at
        movl    %eax, %ecx
        subl    ZLEAST(%esp), %ecx
        cmpw    ZRANGE(%esp), %cx
        ja      2f
        PIXEL_averaged \at
        .endm

        // if (cut >= 0) average(..)
        .macro  PIXEL_averagedcut at
        js      2f
        PIXEL_averaged \at
        .endm

        // if (z - zLeast <= zMost - zLeast && cut >= 0) average(..)
        .macro  PIXEL_averagedcutending at
        js      2f
        PIXEL_averagedending \at
        .endm

        // for (x = 0; x < width; ++x, z += zStep) ..;   `at` is the first pixel's offset from edi; the step after the last pixel is
        // left out
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

        // for (y = height; y > 0; --y, z += zRow), up to UNROLLED rows. edi points one past the first pixel of the row below the
        // scale, because subtracting ~left has added left + 1.
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

        // The same for any number of rows, with edx as the counter; it is free in a scale of one brightness and saved to ROW in
        // others. KIND is height - 1 here, the number of rows above the last one.
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
        //     for (x = 0; x < width; ++x, z += zStep, cut += cutStep) ..;   edi points one past the last pixel of the row
        // `cuts` is 0 without a cut function, 1 along a line (CUT_ROW leads from the last pixel of a row to the first of the next),
        // 2 along a curve (CUT_ROW leads from the first pixel of a row to the first of the next). `dome` is what the depth's step
        // changes by from pixel to pixel; empty for a plane.
        .macro  ENTERED kind pixel cuts dome
        .balign 4
        .set    at, -LARGEST
        .irp    width, 40, 39, 38, 37, 36, 35, 34, 33, 32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, \
                      19, 18, 17, 16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1
entered_\kind\()_\width:
        PIXEL_\pixel at
        .if     \width > 1
        addl    %ebx, %eax
        .ifnb   \dome
        addl    \dome, %ebx
        .endif
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
        .ifnb   \dome
        // z and shade start from the row before; its change to the next row grows by the dome
        movl    DOWN(%esp), %eax
        .ifc    \dome, %edx
        addl    %edx, DOWN(%esp)
        .else
        movl    \dome, %ebx
        addl    %ebx, DOWN(%esp)
        .endif
        addl    FIRST(%esp), %eax
        movl    STEP(%esp), %ebx
        movl    %eax, FIRST(%esp)
        .else
        subl    ROW(%esp), %eax
        .endif
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
        cmpl    $Z_EMPTY-DOME_MOST, DEPTH(%esp)
        jae     leave
        addl    %ecx, DEPTH(%esp)
        cmpl    $Z_EMPTY-DOME_MOST, DEPTH(%esp)
        jae     leave
        addl    %edx, DEPTH(%esp)
        cmpl    $Z_EMPTY-DOME_MOST, DEPTH(%esp)
        jae     leave
        subl    %ecx, DEPTH(%esp)
        cmpl    $Z_EMPTY-DOME_MOST, DEPTH(%esp)
        jae     leave
        movl    ROW(%esp), %edx
        // pixels -= height * SCREEN_WIDTH;  depths -= height * SCREEN_WIDTH;   and on to the end of the row: += width - 1
small:
        movl    HEIGHT(%esp), %ecx
        movl    %edx, ROW(%esp)
        notl    %ecx
        imull   $SCREEN_WIDTH, %ecx, %ecx
        addl    WIDTH(%esp), %ecx
        addl    %ecx, %edi
        leal    (%esi,%ecx,2), %esi
        movl    DOME(%esp), %ecx
        testl   %ecx, %ecx
        js      on_row

        // setDome(dome, toColumn, toRow, &scale), with the factors -dome and -toColumn, -dome and -toRow.   DOWN: zStep * (width -
        // 1) + zRow before it, with shade
        movl    %ebx, %edx
        movl    %ecx, %ebp
        imull   WIDTH(%esp), %edx
        shrl    $1, %ecx
        subl    ROW(%esp), %edx
        addl    %ecx, %ebx
        addl    %ecx, %edx
        // across = dome * toColumn >> 12;  zStep += across + dome / 2;  down = dome * toRow >> 12
        negl    %ebp
        movl    %ebp, %ecx
        imull   FROM_COLUMN(%esp), %ebp
        imull   FROM_ROW(%esp), %ecx
        sarl    $12, %ebp
        sarl    $12, %ecx
        addl    %ebp, %ebx
        addl    %ecx, %edx
        movl    %ebx, STEP(%esp)
        movl    %edx, DOWN(%esp)
        // z += (across * toColumn + down * toRow) >> 13
        imull   FROM_COLUMN(%esp), %ebp
        imull   FROM_ROW(%esp), %ecx
        addl    %ecx, %ebp
        negl    %ebp
        sarl    $13, %ebp
        addl    %ebp, %eax
        movl    RAMP(%esp), %ebp
        movl    %eax, FIRST(%esp)
on_row:
        movl    CUT(%esp), %edx
        testl   %edx, %edx
        jmp     *ENTRY(%esp)
        ENTERED shaded, shaded, 0
        ENTERED ending, ending, 0
        ENTERED cut, averagedcut, 1, DOME(%esp)
        ENTERED cutending, averagedcutending, 1, DOME(%esp)
        ENTERED curved, cut, 2
        ENTERED curvedending, cutending, 2
        ENTERED domed, averaged, 0, %edx
        ENTERED domedending, averagedending, 0, %edx

leave:
        movl    END(%esp), %eax
        addl    LIST(%esp), %eax
leave_at:
        // Copy the results, BOX_LEFT to EMPTY, back to the lens; return the current voxel
        movl    LOCALS+20(%esp), %edx   // lens
        leal    BOX_LEFT(%esp), %esi
        leal    BOX_LEFT(%edx), %edi
        movl    $(TILT_ADD-BOX_LEFT)/4, %ecx
        rep movsl
        addl    $LOCALS, %esp
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

        // setEnds(v, depth >> 1, &scale) for a voxel with this `back`; zMost fits 16 bits within the table's depths.
        .macro  SET_ENDS back free
        movl    DEPTH(%esp), \free
        leal    LENS_NEAR*128(\free,\back,4), \back
        addl    $LENS_NEAR*128, \free
        movl    \back, ZRANGE(%esp)
        movzbl  VOXEL_FRONT(%esi), \back
        shll    $2, \back
        subl    \back, \free
        jns     1f
        xorl    \free, \free
1:      movl    \free, ZLEAST(%esp)
        subl    \free, ZRANGE(%esp)
        .endm

        // domeOf(v, f), in eax as well
        .macro  DOME_OF
        xorl    %eax, %eax
        cmpw    $DOMED*256, VOXEL_HALF_WIDTH(%esi)
        jg      1f
        cmpw    $DOMED*256, VOXEL_HALF_HEIGHT(%esi)
        jg      1f
        movl    FACTOR_ZX(%ebp), %eax
        cmpl    FACTOR_ZY(%ebp), %eax
        jle     5f
        movl    FACTOR_ZY(%ebp), %eax
5:      sarl    $6, %eax
        cmpl    $WIDEST_PIXEL, %eax
        jle     4f
        movl    $WIDEST_PIXEL, %eax
4:      imull   %eax, %eax
        leal    (%eax,%eax,4), %eax
        shrl    $14, %eax
1:      movl    %eax, DOME(%esp)
        .endm

        // A voxel that ends or is cut
        .balign 4
special:
        cmpl    $0xffff, VOXEL_BRIGHT(%esi)
        ja      cut
        movzbl  VOXEL_BACK(%esi), %eax
        SET_ENDS %eax, %ebx
        addl    $KIND_ROWS, KIND(%esp)
        jmp     not_special

        // if (depth < LENS_NEAREST * 256 || depth >= LENS_NEAR * 256) break
        .balign 4
near:
        leal    LENS_NEAR*256(%ebp), %ecx
        sarl    $1, %eax
        cmpl    $LENS_NEAREST*256, %ecx
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
        movl    $-1, DOME(%esp)
        movl    %edi, WIDTH(%esp)
        movl    %eax, HEIGHT(%esp)
        movl    %ebx, KIND(%esp)
        // setEnds(v, depth >> 1, &scale)
        movzbl  VOXEL_BACK(%esi), %ebx
        xorl    %eax, %eax
        testl   %ebx, %ebx
        jz      3f
        SET_ENDS %ebx, %eax
        movl    $4*LARGEST, %eax        // from the table of `shaded` to that of `ending`
3:      leal    entered_ways(%eax,%edi,4), %eax
        // if (isCut(v)) ..;   otherwise the row is drawn by code without a cut function
        cmpw    $0, VOXEL_CUTX(%esi)    // cutX | cutY
        je      2f
        testl   $0xffffff, VOXEL_CURVEXX(%esi) // curveXX | curveXY | curveYY
        jnz     curved
        cmpw    $CUT_MOST, VOXEL_CUTAT(%esi)
        je      nowhere
        movl    2*4*LARGEST(%eax), %eax // from the table of `cut` or `cutending`
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
        DOME_OF
        jmp     not_special
2:
        movl    (%eax), %eax
        movl    %eax, ENTRY(%esp)
        jmp     not_special

        // isCutNowhere(v): the cut function is positive on the whole scale, and is left out. In its place edx has the dome.
        .balign 4
nowhere:
        movl    6*4*LARGEST(%eax), %eax // from the table of `domed` or `domedending`
        movl    %eax, ENTRY(%esp)
        DOME_OF
        movl    %eax, CUT(%esp)
        jmp     not_special

        // setCut() for a cut along a curve; the table is that of `curved` or `curvedending`
        .balign 4
curved:
        movl    4*4*LARGEST(%eax), %eax
        movl    %eax, ENTRY(%esp)
        // xx = (curveXX * f.zx >> 10) * f.zx >> 16;  xy and yy likewise
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
        // acrossFirst = across + ((xx * toColumn + xy * toRow) >> 12);   CUT: (across + acrossFirst) >> 1
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
        // downFirst = down + ((xy * toColumn + yy * toRow) >> 12);   eax: (down + downFirst) >> 1
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

        // Rare cases
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

        // The jump tables: the address of the code for each kind, height and width. `ending` follows `shaded`, and the rows for
        // large and for cut scales follow `ending` (see KIND).
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

        // The addresses at which the code of a row is entered for each width.
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
        ENTRIES domed
        ENTRIES domedending

ASM_END
