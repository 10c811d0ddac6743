// From seeds to voxels, for the 386 and up. src/surface/voxels.cpp has it in C++ and
// says what it does; the tests feed both the same input. Above each group of instructions stands the line of C++ that it
// implements.

#include "asm.h"

// struct Seed (include/model/seed.h)
#define SEED_NORMAL  20
#define SEED_LIGHT 34
#define SEED_ALONG   47
#define SEED_ACROSS  50
#define SEED_AREA    54
#define SEED_PLACE   56

// struct Voxel (include/surface/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_WIDE   12
#define VOXEL_HIGH   14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_BRIGHT 20                 /* and behind it, one double word with it: reach and what cuts */
#define VOXEL_REACH  21
#define VOXEL_SLOPEX 24                 /* and behind it, one double word with it: the other slope and cutAt */
#define VOXEL_SLOPEY 25

// struct Seen and struct Shading (src/surface/voxels.h)
#define SEEN_SEED    0
#define SEEN_FACING  4
#define SEEN_VOXEL   8
#define SEEN_SIZE    12
#define TURNED       20
#define RIGHT        24
#define UP           36
#define TO_RIGHT     48
#define TO_UP        60
#define TO_AHEAD     72
#define DEPTH        84
#define CELL         88
#define CELL_SHIFT   100
#define AREA_SHARE   104
#define WHOLE_MOST   108
#define HORIZON      112
#define GRADIENT     116
#define AHEAD        124
#define STEEPEST_TILT 20000
#define MARGIN_SHIFT 5
#define MARGIN_UNITS 14
#define FLAT_SHADING 8
#define SHADING_MOST 64

        .text

// to = the sum of a vector of three 16-bit parts at `vector` of the seed (esi) times the axis at `axis` of the shading (ebp)
.macro product vector, axis, to, spare
        movswl        \vector(%esi), \to
        imull        \axis(%ebp), \to
        movswl        \vector+2(%esi), \spare
        imull        \axis+4(%ebp), \spare
        addl        \spare, \to
        movswl        \vector+4(%esi), \spare
        imull        \axis+8(%ebp), \spare
        addl        \spare, \to
.endm

// A half axis of the cell on the picture plane: edx its width, eax its height, with their signs; ecx is spare.
.macro on_picture axis
        movsbl        \axis(%esi), %eax
        imull        CELL(%ebp), %eax
        movsbl        \axis+1(%esi), %ecx
        imull        CELL+4(%ebp), %ecx
        addl        %ecx, %eax
        movsbl        \axis+2(%esi), %ecx
        imull        CELL+8(%ebp), %ecx
        addl        %ecx, %eax
        leal        0x8000(%eax), %edx
        sarl        $16, %edx
        jns        1f
        negl        %edx
1:        cwtl
        testl        %eax, %eax
        jns        1f
        negl        %eax
1:
.endm

// void shadeSeedsA(const Shading* shading, const Seen* seen, int count). ebx is the seen seed, edi its voxel.
#define SHADE_AREA     0
#define SHADE_END 4
#define SHADE_FRAME    8
#define SHADE_SHADING  (SHADE_FRAME+20)
#define SHADE_SEEN     (SHADE_FRAME+24)
#define SHADE_COUNT    (SHADE_FRAME+28)
FUNC(shadeSeedsA)
        pushl        %ebp
        pushl        %ebx
        pushl        %esi
        pushl        %edi
        subl        $SHADE_FRAME, %esp
        movl        SHADE_SHADING(%esp), %ebp
        movl        SHADE_SEEN(%esp), %ebx
        movl        SHADE_COUNT(%esp), %eax
        leal        (%eax,%eax,2), %eax
        leal        (%ebx,%eax,4), %eax
        movl        %eax, SHADE_END(%esp)
        jmp        shade_next

shade_one:
        movl        SEEN_SEED(%ebx), %esi
        movl        SEEN_VOXEL(%ebx), %edi
        // placeVoxel(v, s, voxel); eax = voxel.z
        cmpl        $0, TURNED(%ebp)
        jne        shade_place_turned
        movswl        SEED_PLACE(%esi), %eax
        movl        %eax, VOXEL_X(%edi)
        movswl        SEED_PLACE+2(%esi), %eax
        movl        %eax, VOXEL_Y(%edi)
        movswl        SEED_PLACE+4(%esi), %eax
shade_placed:
        movl        %eax, VOXEL_Z(%edi)
        // steep = smaller(((v.depth + voxel.z) << 8) / facing, STEEPEST_TILT)
        addl        DEPTH(%ebp), %eax
        shll        $8, %eax
        xorl        %edx, %edx
        divl        SEEN_FACING(%ebx)
        cmpl        $STEEPEST_TILT, %eax
        jg        shade_steepest
shade_steep:
        // voxel.tiltX = normalX * steep >> 14, and the other
        cmpl        $0, TURNED(%ebp)
        jne        shade_turned
        movswl        SEED_NORMAL(%esi), %ecx
        movswl        SEED_NORMAL+2(%esi), %edx
        imull        %eax, %ecx
        imull        %eax, %edx
shade_tilts:
        sarl        $14, %ecx
        sarl        $14, %edx
        movw        %cx, VOXEL_TILTX(%edi)
        movw        %dx, VOXEL_TILTY(%edi)

        // along = onPicture(s.cellAlong); if (s.cellArea <= v.wholeMost)
        movzwl        SEED_AREA(%esi), %ecx
        cmpl        WHOLE_MOST(%ebp), %ecx
        jbe        shade_whole
        // area = mulHigh(s.cellArea * (facing >> 3), v.areaShare)
        movl        SEEN_FACING(%ebx), %eax
        sarl        $3, %eax
        imull        %ecx, %eax
        imull        AREA_SHARE(%ebp)
        movl        %edx, SHADE_AREA(%esp)
        on_picture SEED_ALONG
        // wide >>= v.cellShift; high >>= v.cellShift
        movl        CELL_SHIFT(%ebp), %ecx
        sarl        %cl, %edx
        sarl        %cl, %eax
        // if (wide > high) high += area / wide
        cmpl        %eax, %edx
        jle        shade_high
        movl        %edx, %ecx
        movl        %eax, %esi
        movl        SHADE_AREA(%esp), %eax
        xorl        %edx, %edx
        divl        %ecx
        addl        %esi, %eax
        jmp        shade_extents
        // else if (high > 0) wide += area / high
shade_high:
        movl        %edx, %esi
        movl        %eax, %ecx
        testl        %eax, %eax
        jz        shade_swap
        movl        SHADE_AREA(%esp), %eax
        xorl        %edx, %edx
        divl        %ecx
        addl        %eax, %esi
shade_swap:
        movl        %ecx, %eax
        movl        %esi, %ecx

        // ecx: wide, eax: high. Both += (itself >> MARGIN_SHIFT) + MARGIN_UNITS, 0x7fff at most
shade_extents:
        movl        %ecx, %edx
        sarl        $MARGIN_SHIFT, %edx
        leal        MARGIN_UNITS(%ecx,%edx), %ecx
        movl        %eax, %edx
        sarl        $MARGIN_SHIFT, %edx
        leal        MARGIN_UNITS(%eax,%edx), %eax
        cmpl        $0x7fff, %ecx
        jg        shade_too_wide
shade_wide:
        cmpl        $0x7fff, %eax
        jg        shade_too_high
shade_extended:
        movw        %cx, VOXEL_WIDE(%edi)
        movw        %ax, VOXEL_HIGH(%edi)

        // voxel.brightness = (s.brightness8 + 128) >> 8, all behind it 0
        movl        SEEN_SEED(%ebx), %esi
        movswl        SEED_LIGHT(%esi), %edx
        addl        $128, %edx
        shrl        $8, %edx
        movl        %edx, VOXEL_BRIGHT(%edi)
        movl        $0, VOXEL_SLOPEX(%edi)

        // reach = (v.horizonShare * facing >> 16) + 1
        movl        HORIZON(%ebp), %edx
        imull        SEEN_FACING(%ebx), %edx
        sarl        $16, %edx
        incl        %edx
        // if (reach < 256 && (|tiltX| * wide + |tiltY| * high) >> 11 >= reach) voxel.reach = reach
        cmpl        $256, %edx
        jge        shade_no_end
        movl        %edx, SHADE_AREA(%esp)
        movswl        VOXEL_TILTX(%edi), %esi
        testl        %esi, %esi
        jns        1f
        negl        %esi
1:        imull        %ecx, %esi
        movswl        VOXEL_TILTY(%edi), %edx
        testl        %edx, %edx
        jns        1f
        negl        %edx
1:        imull        %eax, %edx
        addl        %edx, %esi
        sarl        $11, %esi
        movl        SHADE_AREA(%esp), %edx
        cmpl        %edx, %esi
        jl        shade_no_end
        movb        %dl, VOXEL_REACH(%edi)
shade_no_end:
        // if (voxel.brightness == 0) return
        cmpb        $0, VOXEL_BRIGHT(%edi)
        je        shade_done
        // slopeX = (v.gradient[0] + (tiltX * v.gradientAhead >> 4)) >> 8, and the other
        movswl        VOXEL_TILTX(%edi), %edx
        imull        AHEAD(%ebp), %edx
        sarl        $4, %edx
        addl        GRADIENT(%ebp), %edx
        sarl        $8, %edx
        movswl        VOXEL_TILTY(%edi), %esi
        imull        AHEAD(%ebp), %esi
        sarl        $4, %esi
        addl        GRADIENT+4(%ebp), %esi
        sarl        $8, %esi
        // corner = (|slopeX| * wide + |slopeY| * high) >> 8
        imull        %edx, %ecx
        testl        %ecx, %ecx
        jns        1f
        negl        %ecx
1:        imull        %esi, %eax
        testl        %eax, %eax
        jns        1f
        negl        %eax
1:        addl        %ecx, %eax
        sarl        $8, %eax
        // if (corner < FLAT_SHADING) return
        cmpl        $FLAT_SHADING, %eax
        jl        shade_done
        // for (; corner > SHADING_MOST * 8; corner >>= 1) slopeX >>= 1, slopeY >>= 1
        jmp        2f
1:        sarl        $1, %edx
        sarl        $1, %esi
        sarl        $1, %eax
2:        cmpl        $SHADING_MOST*8, %eax
        jg        1b
        // voxel.slopeX = limited(slopeX, 127), and the other
        leal        127(%edx), %eax
        cmpl        $254, %eax
        ja        shade_limit_x
shade_slope_x:
        movb        %dl, VOXEL_SLOPEX(%edi)
        leal        127(%esi), %eax
        cmpl        $254, %eax
        ja        shade_limit_y
shade_slope_y:
        movl        %esi, %eax
        movb        %al, VOXEL_SLOPEY(%edi)

shade_done:
        addl        $SEEN_SIZE, %ebx
shade_next:
        cmpl        SHADE_END(%esp), %ebx
        jb        shade_one
        addl        $SHADE_FRAME, %esp
        popl        %edi
        popl        %esi
        popl        %ebx
        popl        %ebp
        ret

shade_place_turned:
        product        SEED_PLACE, TO_RIGHT, %eax, %ecx
        sarl        $14, %eax
        movl        %eax, VOXEL_X(%edi)
        product        SEED_PLACE, TO_UP, %eax, %ecx
        sarl        $14, %eax
        movl        %eax, VOXEL_Y(%edi)
        product        SEED_PLACE, TO_AHEAD, %eax, %ecx
        sarl        $14, %eax
        jmp        shade_placed

        // normalX = product(s.normal, v.right), and the other
shade_turned:
        product        SEED_NORMAL, RIGHT, %ecx, %edx
        sarl        $14, %ecx
        imull        %eax, %ecx
        movl        %ecx, SHADE_AREA(%esp)
        product        SEED_NORMAL, UP, %edx, %ecx
        movl        SHADE_AREA(%esp), %ecx
        sarl        $14, %edx
        imull        %eax, %edx
        jmp        shade_tilts

        // wide = (wide + width(across)) >> v.cellShift, and high likewise
shade_whole:
        on_picture SEED_ACROSS
        movl        %edx, SHADE_AREA(%esp)
        movl        %eax, VOXEL_SLOPEX(%edi)
        on_picture SEED_ALONG
        addl        SHADE_AREA(%esp), %edx
        addl        VOXEL_SLOPEX(%edi), %eax
        movl        CELL_SHIFT(%ebp), %ecx
        sarl        %cl, %edx
        sarl        %cl, %eax
        movl        %edx, %ecx
        jmp        shade_extents

shade_steepest:
        movl        $STEEPEST_TILT, %eax
        jmp        shade_steep
shade_too_wide:
        movl        $0x7fff, %ecx
        jmp        shade_wide
shade_too_high:
        movl        $0x7fff, %eax
        jmp        shade_extended
        // 127 with the sign it has.
shade_limit_x:
        sarl        $31, %edx
        addl        %edx, %edx
        addl        $1, %edx
        imull        $127, %edx, %edx
        jmp        shade_slope_x
shade_limit_y:
        sarl        $31, %esi
        addl        %esi, %esi
        addl        $1, %esi
        imull        $127, %esi, %esi
        jmp        shade_slope_y
ENDFUNC(shadeSeedsA)
ASM_END
