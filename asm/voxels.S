// From seeds to voxels, for the 386 and up. The routines implement their C++ twins in src/surface/voxels.cpp, and the tests feed
// both the same input. Above each group of instructions stands the line of C++ that it implements.

#include "asm.h"

// struct Seed (include/model/seed.h)
#define SEED_PATH    0
#define SEED_POSITION 12
#define SEED_NORMAL  20
#define SEED_PLACE   26
#define SEED_OUT     32
#define SEED_ROOT    34
#define SEED_FLAGS   36
#define SEED_ALONG   39
#define SEED_ACROSS  42
#define SEED_WAY     45
#define SEED_AREA    48
#define SEED_SIZE    64
#define SEED_SHIFT   6
#define SEED_VALID   1
#define SEED_RESTING 4

// struct Patch (src/surface/patch.h)
#define PATCH_FIRST  0
#define PATCH_COUNT  12
#define PATCH_RINGS  3

// struct Voxel (include/surface/voxel.h)
#define VOXEL_X      0
#define VOXEL_Y      4
#define VOXEL_Z      8
#define VOXEL_HALF_WIDTH 12
#define VOXEL_HALF_HEIGHT 14
#define VOXEL_TILTX  16
#define VOXEL_TILTY  18
#define VOXEL_BRIGHT 20                 /* one 32-bit word with the bytes back, cutX and cutY */
#define VOXEL_BACK  21
#define VOXEL_SLOPEX 24                 /* one 32-bit word with the byte slopeY and the 16-bit cutAt */
#define VOXEL_SLOPEY 25
#define VOXEL_CURVE  28                 /* one 32-bit word: the bytes curveXX, curveXY, curveYY and front */
#define VOXEL_FRONT  31
#define VOXEL_SIZE   32

// struct Seen and struct Shading (src/surface/voxels.h)
#define SEEN_SEED    0
#define SEEN_FACING  4
#define SEEN_SIZE    8
#define SEEDS        0
#define ROOTS        4
#define PLACE_SHIFT  8
#define EYE          12
#define LIGHT        24
#define LIMB         36
#define TURNED       40
#define RIGHT        44
#define UP           56
#define TO_RIGHT     68
#define TO_UP        80
#define TO_AHEAD     92
#define DEPTH        104
#define LEAST_POSITION 108
#define CELL         112
#define CELL_SHIFT   124
#define AREA_SHARE   128
#define WHOLE_BEFORE 132
#define DEEPEST      136
#define FRONT        140
#define HORIZON      144
#define GRADIENT     148
#define AHEAD        156
#define STEEPEST_TILT 18000
#define MARGIN_SHIFT 5
#define MARGIN_UNITS 14
#define FLAT_SHADING 8
#define STEEPEST_SHADING 240
#define BRIGHTEST    63
#define DARK_MIDDLE      -30
#define LEAST_COSINE 6500
#define ASLANT       15500
#define AREA_MOST    16383

        .text

// to = dot product of the 16-bit vector at offset `vector` of the seed (esi) and the 32-bit vector at offset `axis` of the shading
// (ebp)
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

// to = dot product of the position in own space, which is kept in the voxel (edi), and the axis at offset `axis`, >> 14
.macro along axis, to, spare
        movl        VOXEL_X(%edi), \to
        imull        \axis(%ebp), \to
        movl        VOXEL_Y(%edi), \spare
        imull        \axis+4(%ebp), \spare
        addl        \spare, \to
        movl        VOXEL_Z(%edi), \spare
        imull        \axis+8(%ebp), \spare
        addl        \spare, \to
        sarl        $14, \to
.endm

// Sets a component, at offset `part`, of the voxel's (edi) position to that of a seed (esi) with its root at ebx, shifted by cl to
// steps of places. to = the same component, at offset `normal`, of the normal times that of the vector from the eye to the seed;
// changes eax and edx.
.macro place part, normal, to
        movl        SEED_PATH+\part(%esi), %eax
        imull        SEED_POSITION(%esi)
        shrdl        $16, %edx, %eax
        addl        \part(%ebx), %eax
        sarl        %cl, %eax
        movswl        SEED_NORMAL+\normal(%esi), \to
        movl        %eax, VOXEL_X+\part(%edi)
        sarl        $3, %eax
        subl        EYE+\part(%ebp), %eax
        imull        %eax, \to
.endm

// int findSeedsA(const Shading* shading, const Patch* patch, Seen* seen, Voxel* voxels)
//
//   esi  s              edi  voxels + count     ecx  seen + count       ebp  shading (v)
//
// A visible seed at rest takes 30 instructions, and 24 more if own space is turned relative to the view; an invisible one takes 18.
#define FIND_END     0                  /* end of the ring's seeds */
#define FIND_RING    4                  /* ring - PATCH_RINGS */
#define FIND_AWAY    8                  /* normal * ((place >> 3) - eye), as far as it is added up */
#define FIND_TURNED  8                  /* two 32-bit words: x and y of the voxel */
#define FIND_NEXT    16                 /* ecx (seen + count), while cl holds placeShift */
#define FIND_FRAME   20
#define FIND_SHADING (FIND_FRAME+20)
#define FIND_PATCH   (FIND_FRAME+24)
#define FIND_SEEN    (FIND_FRAME+28)
#define FIND_VOXELS  (FIND_FRAME+32)

// *seen++ = {&s, facing};  ++voxels;   and continue with the next seed of the ring
.macro found
        movl        %esi, SEEN_SEED(%ecx)
        movl        %ebx, SEEN_FACING(%ecx)
        addl        $VOXEL_SIZE, %edi
        addl        $SEEN_SIZE, %ecx
        next_seed
.endm

.macro next_seed
        addl        $SEED_SIZE, %esi
        cmpl        FIND_END(%esp), %esi
        jb        find_one
.endm

FUNC(findSeedsA)
        pushl        %ebp
        pushl        %ebx
        pushl        %esi
        pushl        %edi
        subl        $FIND_FRAME, %esp
        movl        FIND_SHADING(%esp), %ebp
        movl        FIND_VOXELS(%esp), %edi
        movl        FIND_SEEN(%esp), %ecx
        movl        $-PATCH_RINGS, FIND_RING(%esp)
        // for (ring = 0; ring < PATCH_RINGS; ++ring) for (s = seeds + first[ring], end = s + count[ring]; s < end; ++s)
find_ring:
        movl        FIND_PATCH(%esp), %ebx
        movl        FIND_RING(%esp), %edx
        movzbl        PATCH_COUNT+PATCH_RINGS(%ebx,%edx), %eax
        movl        PATCH_FIRST+4*PATCH_RINGS(%ebx,%edx,4), %esi
        shll        $SEED_SHIFT, %eax
        jz        find_ring_next
        shll        $SEED_SHIFT, %esi
        addl        SEEDS(%ebp), %esi
        addl        %esi, %eax
        movl        %eax, FIND_END(%esp)

find_one:
        testb        $SEED_RESTING, SEED_FLAGS(%esi)
        jz        find_moved
        // facing = (normal * eye >> 11) - s.out; if (facing <= v.limb) continue
        product        SEED_NORMAL, EYE, %ebx, %eax
        movswl        SEED_OUT(%esi), %eax
        sarl        $11, %ebx
        subl        %eax, %ebx
        cmpl        LIMB(%ebp), %ebx
        jle        find_not
        cmpl        $0, TURNED(%ebp)
        je        find_resting_straight
        // voxel->x, y, z = along(v.toRight), along(v.toUp), along(v.toAhead)
        product        SEED_PLACE, TO_RIGHT, %eax, %edx
        sarl        $14, %eax
        movl        %eax, VOXEL_X(%edi)
        product        SEED_PLACE, TO_UP, %eax, %edx
        sarl        $14, %eax
        movl        %eax, VOXEL_Y(%edi)
        product        SEED_PLACE, TO_AHEAD, %eax, %edx
        sarl        $14, %eax
        movl        %eax, VOXEL_Z(%edi)
find_found:
        found
find_ring_next:
        incl        FIND_RING(%esp)
        jnz        find_ring
        // return count, from the bytes written to `seen` (SEEN_SIZE is 8)
        movl        %ecx, %eax
        subl        FIND_SEEN(%esp), %eax
        sarl        $3, %eax
        addl        $FIND_FRAME, %esp
        popl        %edi
        popl        %esi
        popl        %ebx
        popl        %ebp
        ret

        // voxel->x, y, z = place
find_resting_straight:
        movswl        SEED_PLACE(%esi), %eax
        movl        %eax, VOXEL_X(%edi)
        movswl        SEED_PLACE+2(%esi), %eax
        movl        %eax, VOXEL_Y(%edi)
        movswl        SEED_PLACE+4(%esi), %eax
        movl        %eax, VOXEL_Z(%edi)
        found
        jmp        find_ring_next

        // if (!(s.flags & SEED_VALID)) continue; findPlace(v, s, place)
find_moved:
        testb        $SEED_VALID, SEED_FLAGS(%esi)
        jz        find_not
        movzwl        SEED_ROOT(%esi), %ebx
        movl        ROOTS(%ebp), %eax
        leal        (%ebx,%ebx,2), %ebx
        movl        %ecx, FIND_NEXT(%esp)
        leal        (%eax,%ebx,4), %ebx
        movl        PLACE_SHIFT(%ebp), %ecx
        // facing = (normal * (eye - (place >> 3))) >> 11; if (facing <= v.limb) continue
        place        0, 0, %edx
        movl        %edx, FIND_AWAY(%esp)
        place        4, 2, %edx
        addl        %edx, FIND_AWAY(%esp)
        place        8, 4, %ebx
        addl        FIND_AWAY(%esp), %ebx
        movl        FIND_NEXT(%esp), %ecx
        negl        %ebx
        sarl        $11, %ebx
        cmpl        LIMB(%ebp), %ebx
        jle        find_not
        cmpl        $0, TURNED(%ebp)
        je        find_found
        along        TO_RIGHT, %eax, %edx
        movl        %eax, FIND_TURNED(%esp)
        along        TO_UP, %eax, %edx
        movl        %eax, FIND_TURNED+4(%esp)
        along        TO_AHEAD, %eax, %edx
        movl        %eax, VOXEL_Z(%edi)
        movl        FIND_TURNED(%esp), %eax
        movl        %eax, VOXEL_X(%edi)
        movl        FIND_TURNED+4(%esp), %eax
        movl        %eax, VOXEL_Y(%edi)
        jmp        find_found
find_not:
        next_seed
        jmp        find_ring_next
ENDFUNC(findSeedsA)

// The stack frame of shadeSeedsA; the macros use it too.
#define SHADE_AREA   0
#define SHADE_END    4
#define SHADE_POSITION 8
#define SHADE_SHARE  12
#define SHADE_WAY_X  16
#define SHADE_WAY_Y  20
#define SHADE_OFF_X  24
#define SHADE_WIDE   28                 /* halfWidth and halfHeight of the cell's one axis */
#define SHADE_HIGH   32
#define SHADE_NORMAL 36                 /* s.normal as three 32-bit words */
#define SHADE_FRAME  48
#define SHADE_SHADING (SHADE_FRAME+20)
#define SHADE_SEEN   (SHADE_FRAME+24)
#define SHADE_VOXELS (SHADE_FRAME+28)
#define SHADE_COUNT  (SHADE_FRAME+32)

// eax = sum of products (both coordinates packed, see OnPicture) of the 8-bit vector at offset `axis` of the seed and the axes of
// the picture plane; changes ecx
.macro packed axis
        movsbl        \axis(%esi), %eax
        imull        CELL(%ebp), %eax
        movsbl        \axis+1(%esi), %ecx
        imull        CELL+4(%ebp), %ecx
        addl        %ecx, %eax
        movsbl        \axis+2(%esi), %ecx
        imull        CELL+8(%ebp), %ecx
        addl        %ecx, %eax
.endm

// ecx = column and eax = row of the packed sum in eax; the flags are those of the column
.macro unpack
        leal        0x8000(%eax), %ecx
        sarl        $16, %ecx
        cwtl
.endm

// reg = |reg|
.macro magnitude reg
        testl        \reg, \reg
        jns        1f
        negl        \reg
1:
.endm

// ecx = |x|, eax = |y| of a half axis of the cell on the picture plane
.macro on_picture axis
        packed        \axis
        unpack
        jns        1f
        negl        %ecx
1:
        magnitude        %eax
.endm

// eax = dot product of the 8-bit vector at offset `axis` of the seed and its normal; changes ecx
.macro times_normal axis
        movsbl        \axis(%esi), %eax
        imull        SHADE_NORMAL(%esp), %eax
        movsbl        \axis+1(%esi), %ecx
        imull        SHADE_NORMAL+4(%esp), %ecx
        addl        %ecx, %eax
        movsbl        \axis+2(%esi), %ecx
        imull        SHADE_NORMAL+8(%esp), %ecx
        addl        %ecx, %eax
.endm

// on_picture for a seed that is not at rest (struct Fall): off = ((axis * normal) >> 7) * share >> 14;
// |e.x * position - way.x * off >> 8|, and y likewise; changes edx
.macro fallen axis
        times_normal \axis
        sarl        $7, %eax
        imull        SHADE_SHARE(%esp), %eax
        sarl        $14, %eax
        movl        %eax, %edx
        imull        SHADE_WAY_X(%esp), %eax
        imull        SHADE_WAY_Y(%esp), %edx
        movl        %eax, SHADE_OFF_X(%esp)
        packed        \axis
        unpack
        imull        SHADE_POSITION(%esp), %ecx
        imull        SHADE_POSITION(%esp), %eax
        subl        SHADE_OFF_X(%esp), %ecx
        subl        %edx, %eax
        sarl        $8, %ecx
        jns        1f
        negl        %ecx
1:
        sarl        $8, %eax
        jns        1f
        negl        %eax
1:
.endm

// void shadeSeedsA(const Shading* shading, const Seen* seen, Voxel* voxels, int count)
//
//   ebx  seen           edi  voxel              esi  s                  ebp  shading (v)
FUNC(shadeSeedsA)
        pushl        %ebp
        pushl        %ebx
        pushl        %esi
        pushl        %edi
        subl        $SHADE_FRAME, %esp
        movl        SHADE_SHADING(%esp), %ebp
        movl        SHADE_SEEN(%esp), %ebx
        movl        SHADE_VOXELS(%esp), %edi
        movl        SHADE_COUNT(%esp), %eax
        leal        (%ebx,%eax,8), %eax
        movl        %eax, SHADE_END(%esp)
        jmp        shade_next

shade_one:
        movl        SEEN_SEED(%ebx), %esi
        // steep = min32(((v.depth + voxel.z) << 8) / facing, STEEPEST_TILT)
        movl        VOXEL_Z(%edi), %eax
        addl        DEPTH(%ebp), %eax
        shll        $8, %eax
        xorl        %edx, %edx
        divl        SEEN_FACING(%ebx)
        cmpl        $STEEPEST_TILT, %eax
        jg        shade_steepest
shade_steep:
        // voxel.tiltX = normalX * steep >> 14;  voxel.tiltY = normalY * steep >> 14
        cmpl        $0, TURNED(%ebp)
        jne        shade_turned
        movswl        SEED_NORMAL(%esi), %ecx
        movswl        SEED_NORMAL+2(%esi), %edx
        imull        %eax, %ecx
        imull        %eax, %edx
        sarl        $14, %ecx
        sarl        $14, %edx
        movw        %cx, VOXEL_TILTX(%edi)
        movw        %dx, VOXEL_TILTY(%edi)

        // cosine = s.normal * v.light >> 14; light = (cosine * BRIGHTEST + 8192) >> 14
shade_tilted:
        product        SEED_NORMAL, LIGHT, %edx, %ecx
        sarl        $14, %edx
        imull        $BRIGHTEST, %edx, %edx
        addl        $8192, %edx
        sarl        $14, %edx
        // voxel.brightness = light;  back, slopes, cut function = 0
        movzbl        %dl, %edx
        movl        $0, VOXEL_SLOPEX(%edi)
        movl        $0, VOXEL_CURVE(%edi)
        movl        %edx, VOXEL_BRIGHT(%edi)

        testb        $SEED_RESTING, SEED_FLAGS(%esi)
        jz        shade_fallen
        // if (s.area == 0 || facing < v.wholeBefore)
        movzwl        SEED_AREA(%esi), %ecx
        movl        SEEN_FACING(%ebx), %eax
        testl        %ecx, %ecx
        jz        shade_whole
        cmpl        WHOLE_BEFORE(%ebp), %eax
        jl        shade_whole
        // area = mulHigh(s.area * (facing >> 3), v.areaShare)
        sarl        $3, %eax
        imull        %ecx, %eax
        imull        AREA_SHARE(%ebp)
        movl        %edx, SHADE_AREA(%esp)
        on_picture SEED_ALONG
shade_band:
        // halfWidth (esi) >>= v.cellShift; halfHeight (eax) >>= v.cellShift
        movl        %ecx, %esi
        movl        CELL_SHIFT(%ebp), %ecx
        sarl        %cl, %esi
        sarl        %cl, %eax
        cmpl        %eax, %esi
        jle        shade_high
        // if (halfWidth > halfHeight): is the band diagonal, 3 halfHeight > 2 halfWidth? Else halfHeight += area / halfWidth
        leal        (%eax,%eax,2), %ecx
        leal        (%esi,%esi), %edx
        cmpl        %edx, %ecx
        jg        shade_diagonal
        movl        %eax, %ecx
        movl        SHADE_AREA(%esp), %eax
        xorl        %edx, %edx
        divl        %esi
        addl        %ecx, %eax
        jmp        shade_extents
        // else: is the band diagonal, 3 halfWidth > 2 halfHeight? Else, if (halfHeight > 0), halfWidth += area / halfHeight
shade_high:
        leal        (%esi,%esi,2), %ecx
        leal        (%eax,%eax), %edx
        cmpl        %edx, %ecx
        jg        shade_diagonal
        movl        %eax, %ecx
        testl        %eax, %eax
        jz        shade_extents
        movl        SHADE_AREA(%esp), %eax
        xorl        %edx, %edx
        divl        %ecx
        addl        %eax, %esi
        movl        %ecx, %eax
        jmp        shade_extents
        // share = area / (halfWidth + halfHeight); halfWidth += share; halfHeight += share
shade_diagonal:
        leal        (%esi,%eax), %edx
        movl        %eax, %ecx
        movl        %edx, SHADE_WIDE(%esp)
        movl        SHADE_AREA(%esp), %eax
        xorl        %edx, %edx
        divl        SHADE_WIDE(%esp)
        addl        %eax, %esi
        addl        %ecx, %eax
        jmp        shade_extents

        // halfWidth = (halfWidth + |across.x|) >> v.cellShift;  halfHeight = (halfHeight + |across.y|) >> v.cellShift
shade_whole:
        on_picture SEED_ACROSS
        movl        %ecx, SHADE_WIDE(%esp)
        movl        %eax, SHADE_HIGH(%esp)
        on_picture SEED_ALONG
        jmp        shade_add

        // Fall fall(s, v): position = max32(s.position >> 8, v.leastPosition)
shade_fallen:
        movl        SEED_POSITION(%esi), %eax
        sarl        $8, %eax
        cmpl        LEAST_POSITION(%ebp), %eax
        jl        shade_least_position
shade_position:
        movl        %eax, SHADE_POSITION(%esp)
        // cosine = product(s.way, s.normal) >> 7;   edx has s.area
        .irp    part, 0, 1, 2
        movswl        SEED_NORMAL+2*\part(%esi), %edx
        movl        %edx, SHADE_NORMAL+4*\part(%esp)
        .endr
        times_normal SEED_WAY
        movzwl        SEED_AREA(%esi), %edx
        sarl        $7, %eax
        // torn = magnitude(cosine) < ASLANT;   edx has 0 then
        cmpl        $ASLANT, %eax
        jl        shade_torn
shade_even:
        movl        %edx, SHADE_AREA(%esp)
        // share = (position << 14) / cosine
        movl        %eax, %ecx
        movl        SHADE_POSITION(%esp), %eax
        shll        $14, %eax
        cltd
        idivl        %ecx
        movl        %eax, SHADE_SHARE(%esp)
        // way(s.way, v)
        packed        SEED_WAY
        unpack
        movl        %ecx, SHADE_WAY_X(%esp)
        movl        %eax, SHADE_WAY_Y(%esp)
        // if (cell == 0 || facing < v.wholeBefore):  cell is 0 if the cell is torn or s.area is 0
        movl        SHADE_AREA(%esp), %ecx
        movl        SEEN_FACING(%ebx), %eax
        testl        %ecx, %ecx
        jz        shade_fallen_whole
        cmpl        WHOLE_BEFORE(%ebp), %eax
        jl        shade_fallen_whole
        // cell = fall.area(s.area);   min32((s.area * magnitude(share) >> 8) * position >> 8, AREA_MOST)
        movl        SHADE_SHARE(%esp), %edx
        magnitude        %edx
        imull        %edx, %ecx
        sarl        $8, %ecx
        imull        SHADE_POSITION(%esp), %ecx
        sarl        $8, %ecx
        jz        shade_fallen_whole
        cmpl        $AREA_MOST, %ecx
        jg        shade_area_most
shade_area:
        // area = mulHigh(cell * (facing >> 3), v.areaShare)
        sarl        $3, %eax
        imull        %ecx, %eax
        imull        AREA_SHARE(%ebp)
        movl        %edx, SHADE_AREA(%esp)
        fallen        SEED_ALONG
        jmp        shade_band

        // halfWidth (esi) = (halfWidth + |across.x|) >> v.cellShift;  halfHeight (eax) likewise
shade_fallen_whole:
        fallen        SEED_ACROSS
        movl        %ecx, SHADE_WIDE(%esp)
        movl        %eax, SHADE_HIGH(%esp)
        fallen        SEED_ALONG
shade_add:
        movl        SHADE_WIDE(%esp), %esi
        addl        SHADE_HIGH(%esp), %eax
        addl        %ecx, %esi
        movl        CELL_SHIFT(%ebp), %ecx
        sarl        %cl, %esi
        sarl        %cl, %eax

        // halfWidth (ecx) = min32(halfWidth + (halfWidth >> MARGIN_SHIFT) + MARGIN_UNITS, 0x7fff);  halfHeight (eax) likewise
shade_extents:
        movl        %esi, %edx
        sarl        $MARGIN_SHIFT, %edx
        leal        MARGIN_UNITS(%esi,%edx), %ecx
        movl        %eax, %edx
        sarl        $MARGIN_SHIFT, %edx
        leal        MARGIN_UNITS(%eax,%edx), %eax
        cmpl        $0x7fff, %ecx
        jg        shade_too_wide
shade_wide:
        cmpl        $0x7fff, %eax
        jg        shade_too_high
        // back = (v.horizonShare * facing >> 16) + 1; if (back < 256) ..
shade_extended:
        movl        HORIZON(%ebp), %edx
        imull        SEEN_FACING(%ebx), %edx
        cmpl        $255<<16, %edx
        jge        shade_ended
        // deep = (magnitude(tiltX) * halfWidth + magnitude(tiltY) * halfHeight) >> 8;   esi has it with 8 fraction bits
        movswl        VOXEL_TILTX(%edi), %esi
        magnitude        %esi
        imull        %ecx, %esi
        movswl        VOXEL_TILTY(%edi), %ebp
        magnitude        %ebp
        imull        %eax, %ebp
        addl        %ebp, %esi
        movl        SHADE_SHADING(%esp), %ebp
        // if (deep >= back * 8 || (deep >= back * 4 && ..;   edx has back * 8 with 8 fraction bits, - 1, and then back * 4
        sarl        $5, %edx
        orl        $0x7ff, %edx
        cmpl        %edx, %esi
        jg        shade_end
        shrl        $1, %edx
        cmpl        %edx, %esi
        jg        shade_near
shade_ended:
        movw        %cx, VOXEL_HALF_WIDTH(%edi)
        movw        %ax, VOXEL_HALF_HEIGHT(%edi)

        // if (light <= DARK_MIDDLE) return
        cmpb        $DARK_MIDDLE, VOXEL_BRIGHT(%edi)
        jle        shade_dark
        // slopeX (edx) = (v.gradient[0] + tiltX * v.gradientAhead) >> 12;  slopeY (esi) likewise
        movswl        VOXEL_TILTX(%edi), %edx
        imull        AHEAD(%ebp), %edx
        addl        GRADIENT(%ebp), %edx
        sarl        $12, %edx
        movswl        VOXEL_TILTY(%edi), %esi
        imull        AHEAD(%ebp), %esi
        addl        GRADIENT+4(%ebp), %esi
        sarl        $12, %esi
        // corner = (|slopeX| * halfWidth + |slopeY| * halfHeight) >> 8
        imull        %edx, %ecx
        magnitude        %ecx
        imull        %esi, %eax
        magnitude        %eax
        addl        %ecx, %eax
        // if (corner < FLAT_SHADING) return; for (; corner > STEEPEST_SHADING; corner >>= 1) ..:  one unsigned comparison for both.
        // From here on eax is corner - FLAT_SHADING with 8 fraction bits.
        subl        $FLAT_SHADING<<8, %eax
        cmpl        $(STEEPEST_SHADING+1-FLAT_SHADING)<<8, %eax
        jae        shade_flat_or_steep
        // if (corner + light * 8 <= 0) return;   voxel.brightness has the light so far
shade_softened:
        cmpb        $0, VOXEL_BRIGHT(%edi)
        jl        shade_dark_middle
        // voxel.slopeX = limited(slopeX, 127);  voxel.slopeY = limited(slopeY, 127):  most often one comparison shows that both
        // stay as they are
shade_slopes:
        leal        127(%edx), %eax
        leal        127(%esi), %ecx
        orl        %ecx, %eax
        cmpl        $254, %eax
        ja        shade_limit
shade_limited:
        movl        %esi, %ecx
        movb        %dl, VOXEL_SLOPEX(%edi)
        movb        %cl, VOXEL_SLOPEY(%edi)

shade_done:
        addl        $SEEN_SIZE, %ebx
        addl        $VOXEL_SIZE, %edi
shade_next:
        cmpl        SHADE_END(%esp), %ebx
        jb        shade_one
        addl        $SHADE_FRAME, %esp
        popl        %edi
        popl        %esi
        popl        %ebx
        popl        %ebp
        ret

        // normalX = product(s.normal, v.right);  normalY = product(s.normal, v.up)
shade_turned:
        product        SEED_NORMAL, RIGHT, %ecx, %edx
        sarl        $14, %ecx
        imull        %eax, %ecx
        sarl        $14, %ecx
        movw        %cx, VOXEL_TILTX(%edi)
        product        SEED_NORMAL, UP, %edx, %ecx
        sarl        $14, %edx
        imull        %eax, %edx
        sarl        $14, %edx
        movw        %dx, VOXEL_TILTY(%edi)
        jmp        shade_tilted

        // .. (back * 8 - deep) * back * 32 <= halfWidth * halfWidth + halfHeight * halfHeight)) ..
shade_near:
        sarl        $10, %edx
        movl        %ecx, SHADE_WIDE(%esp)
        incl        %edx
        movl        %eax, SHADE_HIGH(%esp)
        sarl        $8, %esi
        imull        %ecx, %ecx
        imull        %eax, %eax
        leal        (,%edx,8), %ebp
        addl        %eax, %ecx
        subl        %esi, %ebp
        imull        %edx, %ebp
        shll        $5, %ebp
        cmpl        %ecx, %ebp
        movl        SHADE_SHADING(%esp), %ebp
        movl        SHADE_WIDE(%esp), %ecx
        movl        SHADE_HIGH(%esp), %eax
        jg        shade_ended
        jmp        shade_behind
        // voxel.back = back, voxel.front = v.front
shade_end:
        sarl        $11, %edx
        sarl        $8, %esi
        incl        %edx
shade_behind:
        movb        %dl, VOXEL_BACK(%edi)
        movl        FRONT(%ebp), %edx
        movb        %dl, VOXEL_FRONT(%edi)
        // if (deep > v.deepest) halfWidth = halfWidth * v.deepest / deep, halfHeight = halfHeight * v.deepest / deep
        cmpl        DEEPEST(%ebp), %esi
        jle        shade_ended
        imull        DEEPEST(%ebp), %eax
        xorl        %edx, %edx
        divl        %esi
        xchgl        %eax, %ecx
        imull        DEEPEST(%ebp), %eax
        xorl        %edx, %edx
        divl        %esi
        xchgl        %eax, %ecx
        jmp        shade_ended

shade_least_position:
        movl        LEAST_POSITION(%ebp), %eax
        jmp        shade_position
        // if (magnitude(cosine) < LEAST_COSINE) cosine = cosine < 0 ? -LEAST_COSINE : LEAST_COSINE
shade_torn:
        xorl        %edx, %edx
        cmpl        $LEAST_COSINE, %eax
        jge        shade_even
        testl        %eax, %eax
        js        shade_backwards
        movl        $LEAST_COSINE, %eax
        jmp        shade_even
shade_backwards:
        cmpl        $-LEAST_COSINE, %eax
        jle        1f
        movl        $-LEAST_COSINE, %eax
1:        cmpl        $-ASLANT, %eax
        jg        shade_even
        movzwl        SEED_AREA(%esi), %edx
        jmp        shade_even
shade_area_most:
        movl        $AREA_MOST, %ecx
        jmp        shade_area

shade_steepest:
        movl        $STEEPEST_TILT, %eax
        jmp        shade_steep
shade_too_wide:
        movl        $0x7fff, %ecx
        jmp        shade_wide
shade_too_high:
        movl        $0x7fff, %eax
        jmp        shade_extended
shade_flat_or_steep:
        testl        %eax, %eax
        js        shade_flat
        // slopeX >>= 1, slopeY >>= 1
        addl        $FLAT_SHADING<<8, %eax
shade_steepest_shading:
        sarl        $1, %edx
        sarl        $1, %esi
        sarl        $1, %eax
        cmpl        $(STEEPEST_SHADING+1)<<8, %eax
        jge        shade_steepest_shading
        subl        $FLAT_SHADING<<8, %eax
        jmp        shade_softened
shade_dark_middle:
        movsbl        VOXEL_BRIGHT(%edi), %ecx
        sarl        $8, %eax
        leal        FLAT_SHADING(%eax,%ecx,8), %eax
        testl        %eax, %eax
        jg        shade_slopes
        // voxel.brightness = max32(light, 0) where a voxel has no slopes
shade_flat:
        cmpb        $0, VOXEL_BRIGHT(%edi)
        jge        shade_done
shade_dark:
        movb        $0, VOXEL_BRIGHT(%edi)
        jmp        shade_done
        // limited(): 127 with the sign of the slope
shade_limit:
        .irp    slope, %edx, %esi
        leal        127(\slope), %eax
        cmpl        $254, %eax
        jbe        1f
        sarl        $31, \slope
        addl        \slope, \slope
        addl        $1, \slope
        imull        $127, \slope, \slope
1:
        .endr
        jmp        shade_limited
ENDFUNC(shadeSeedsA)
ASM_END
