// How a settled seed lies, for the 386 and up. src/surface/lie.cpp has it in C++; what it calls stands in include/lie.h and
// include/surface/shade.h and says what it is about; the tests feed both the same input. Above each group of instructions stands the
// line of C++ that it implements.
//
// A seed that faces the viewer and has one neighbour takes about 310 instructions, one that faces away 110. Of the 310,
// some fifty are multiplications (9 to 38 cycles on the 386, as many as their second factor has bits; 13 to 42 on the 486; 10
// on the Pentium), a dozen of them with products of 64 bits, and two are divisions (38 to 46 cycles; two more where
// the scale may end at the horizon). What is seldom stands behind the end, so that the way through has few jumps. Bytes and
// words are loaded with their sign (3 cycles on the 486 and Pentium, not paired): seeds are kept small.

#include "asm.h"

// struct Seed (include/model/seed.h)
#define SEED_PATHX   0
#define SEED_PATHY   4
#define SEED_PATHZ   8
#define SEED_X       20
#define SEED_Y       24
#define SEED_Z       28
#define SEED_WIDE    32
#define SEED_HIGH    34
#define SEED_TILTX   36
#define SEED_TILTY   38
#define SEED_BRIGHT  40
#define SEED_REACH   41
#define SEED_SLOPES  44
#define SEED_DIRX    52
#define SEED_DIRY    54
#define SEED_DIRZ    56
#define SEED_ALONG   60
#define SEED_ACROSS  63

// struct ShadeFrame (include/surface/lie.h)
#define EYE_X        24
#define EYE_Y        28
#define EYE_Z        32
#define EYE_RADIUS   40
#define EYE_HORIZON  44
#define EYE_LIMB     56
#define SKEW_ROOTX   60
#define SKEW_ROOTY   64
#define SKEW_ROOTZ   68
#define SKEW_DEPTH   72
#define SKEW_SHARE   76
#define SKEW_X       80
#define SKEW_Y       84
#define SKEW_NEAR    88
#define LIGHT_X      92
#define LIGHT_Y      96
#define LIGHT_Z      100
#define LIGHT_SPACING 104
#define SET_BACK     108
#define OWN_SLOPE    112
#define COUNT        116
#define SLOPES       120
#define PULLS        372
#define NORMAL       624

// struct Pull
#define PULL_X       0
#define PULL_Y       4
#define PULL_Z       8
#define PULL_RATIO   12

// Constants (include/surface/shade.h)
#define BRIGHTEST    63
#define MARGIN       768
#define MARGIN_UNITS 6
#define STRETCHED    6500
#define WHOLE        4329
#define MOST_SKEW    1024

// On the stack: what has no register. The arguments follow, and are used again.
#define ALONG      0
#define LEFT       4
#define COSINE     0
#define ALONGX     0
#define FACING     4
#define DEPTH      8
#define ALONGY     20
#define SHARE      20
#define SKEWX      24
#define SKEWY      28
#define INVERSE    32
#define LOCALS     36
#define FRAME      LOCALS+20
#define SEED       LOCALS+24
#define POSITION   LOCALS+28
#define OVER       LOCALS+32
#define SIZE       POSITION

        .text

// ---------------------------------------------------------------------------------------------------------------------
// int32_t shadeSeedA(const ShadeFrame* frame, Seed* seed, Real position, int32_t over)
//
//   ebp  seed     ebx, esi, edi  normal, until the extents     ecx  frame, until the extents

        .balign 16
        FUNC(shadeSeedA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        subl    $LOCALS, %esp
        // along = ownSlope;  g = 0
        movl    FRAME(%esp), %ebp
        movl    OWN_SLOPE(%ebp), %eax
        movl    COUNT(%ebp), %ecx
        movl    %eax, ALONG(%esp)
        xorl    %ebx, %ebx
        xorl    %esi, %esi
        xorl    %edi, %edi
        decl    %ecx
        js      pulled
pull:
        // share = slopes[n] * pull.ratio;  along += share
        movl    SLOPES(%ebp,%ecx,4), %eax
        movl    PULLS(%ebp,%ecx,4), %ebp
        movl    %ecx, LEFT(%esp)
        imull   PULL_RATIO(%ebp)
        shrdl   $16, %edx, %eax
        addl    %eax, ALONG(%esp)
        // g -= pull.fromIt16 * share
        movl    %eax, %ecx
        imull   PULL_X(%ebp)
        shrdl   $16, %edx, %eax
        subl    %eax, %ebx
        movl    PULL_Y(%ebp), %eax
        imull   %ecx
        shrdl   $16, %edx, %eax
        subl    %eax, %esi
        movl    PULL_Z(%ebp), %eax
        imull   %ecx
        shrdl   $16, %edx, %eax
        movl    LEFT(%esp), %ecx
        subl    %eax, %edi
        movl    FRAME(%esp), %ebp
        decl    %ecx
        jns     pull
pulled:
        // g -= path * (along * position / 16)
        movl    ALONG(%esp), %eax
        imull   POSITION(%esp)
        movl    SEED(%esp), %ebp
        shrdl   $20, %edx, %eax
        movl    %eax, %ecx
        imull   SEED_PATHX(%ebp)
        shrdl   $16, %edx, %eax
        subl    %eax, %ebx
        movl    SEED_PATHY(%ebp), %eax
        imull   %ecx
        shrdl   $16, %edx, %eax
        subl    %eax, %esi
        movl    SEED_PATHZ(%ebp), %eax
        imull   %ecx
        shrdl   $16, %edx, %eax
        subl    %eax, %edi
        // bits = (x < 0 ? ~x : x) | ...: here twice that, for x ^ 2x has its highest bit where the sign ends
        leal    (%ebx,%ebx), %eax
        leal    (%esi,%esi), %edx
        xorl    %ebx, %eax
        xorl    %esi, %edx
        orl     %edx, %eax
        leal    (%edi,%edi), %edx
        xorl    %edi, %edx
        orl     %edx, %eax
        // excess = 18 - clz(bits);  x >>= excess, y >>= excess, z >>= excess
        bsrl    %eax, %ecx
        jz      no_direction
        subl    $14, %ecx
        jl      short_one
        sarl    %cl, %ebx
        sarl    %cl, %esi
        sarl    %cl, %edi
scaled:
        // inverse = inverseRoots[(x * x + y * y + z * z) >> 20]
        movl    %ebx, %eax
        imull   %ebx, %eax
        movl    %esi, %edx
        imull   %esi, %edx
        addl    %edx, %eax
        movl    %edi, %edx
        imull   %edi, %edx
        addl    %edx, %eax
        shrl    $20, %eax
        movzwl  SYM(inverseRoots)(,%eax,2), %ecx
        // normal = x * inverse >> 14, ...
        imull   %ecx, %ebx
        imull   %ecx, %esi
        imull   %ecx, %edi
        sarl    $14, %ebx
        sarl    $14, %esi
        sarl    $14, %edi
normal:
        // cosine = (normal.x * dirX + normal.y * dirY + normal.z * dirZ) >> 14
        movswl  SEED_DIRX(%ebp), %eax
        imull   %ebx, %eax
        movswl  SEED_DIRY(%ebp), %edx
        imull   %esi, %edx
        addl    %edx, %eax
        movswl  SEED_DIRZ(%ebp), %edx
        imull   %edi, %edx
        addl    %edx, %eax
        movl    POSITION(%esp), %edx
        sarl    $14, %eax
        // facing = (n.x * eye.x + n.y * eye.y + n.z * eye.z - cosine * (radius * (position >> 8) >> 8)) >> 14
        movl    FRAME(%esp), %ecx
        sarl    $8, %edx
        movl    %eax, COSINE(%esp)
        imull   EYE_RADIUS(%ecx), %edx
        sarl    $8, %edx
        imull   %edx, %eax
        movl    EYE_X(%ecx), %edx
        imull   %ebx, %edx
        subl    %eax, %edx
        movl    EYE_Y(%ecx), %eax
        imull   %esi, %eax
        addl    %eax, %edx
        movl    EYE_Z(%ecx), %eax
        imull   %edi, %eax
        addl    %edx, %eax
        sarl    $14, %eax
        movl    %eax, FACING(%esp)
        // if (facing <= limb) return facing - limb
        subl    EYE_LIMB(%ecx), %eax
        jle     away
        // out = path * position;  z = out.z >> 8;  depth = skew.depth + (out.z >> 11)
        movl    SEED_PATHZ(%ebp), %eax
        imull   POSITION(%esp)
        shrdl   $24, %edx, %eax
        movl    %eax, SEED_Z(%ebp)
        sarl    $3, %eax
        addl    SKEW_DEPTH(%ecx), %eax
        movl    %eax, DEPTH(%esp)
        // normal = n;  tiltX = n.x >> 6;  tiltY = n.y >> 6
        movl    %ebx, NORMAL(%ecx)
        movl    %ebx, %eax
        movl    %esi, NORMAL+4(%ecx)
        movl    %esi, %edx
        movl    %edi, NORMAL+8(%ecx)
        sarl    $6, %eax
        movw    %ax, SEED_TILTX(%ebp)
        sarl    $6, %edx
        movw    %dx, SEED_TILTY(%ebp)
        // brightness = (((n.x * light.x + n.y * light.y + n.z * light.z) >> 14) * BRIGHTEST + 8192) >> 14, limited
        movl    LIGHT_X(%ecx), %eax
        imull   %ebx, %eax
        movl    LIGHT_Y(%ecx), %edx
        imull   %esi, %edx
        addl    %edx, %eax
        movl    LIGHT_Z(%ecx), %edx
        imull   %edi, %edx
        addl    %edx, %eax
        sarl    $14, %eax
        imull   $BRIGHTEST, %eax, %eax
        addl    $8192, %eax
        sarl    $14, %eax
        cmpl    $BRIGHTEST, %eax
        ja      limit_bright
bright_limited:
        // brightness, and reach = slopeX = slopeY = 0
        movw    %ax, SEED_BRIGHT(%ebp)
        movw    $0, SEED_SLOPES(%ebp)
        cmpb    $0, SKEW_NEAR(%ecx)
        jne     near_viewer
        // x = out.x >> 8;  skewX = skew.x + ((out.x >> 11) * share >> 12)
        movl    SEED_PATHX(%ebp), %eax
        imull   POSITION(%esp)
        shrdl   $24, %edx, %eax
        movl    %eax, SEED_X(%ebp)
        sarl    $3, %eax
        imull   SKEW_SHARE(%ecx), %eax
        sarl    $12, %eax
        addl    SKEW_X(%ecx), %eax
        movl    %eax, SKEWX(%esp)
        // y = out.y >> 8;  skewY = skew.y + ((out.y >> 11) * share >> 12)
        movl    SEED_PATHY(%ebp), %eax
        imull   POSITION(%esp)
        shrdl   $24, %edx, %eax
        movl    %eax, SEED_Y(%ebp)
        sarl    $3, %eax
        imull   SKEW_SHARE(%ecx), %eax
        sarl    $12, %eax
        addl    SKEW_Y(%ecx), %eax
        movl    %eax, SKEWY(%esp)
skewed:
        // size = spacing * (position >> 8) >> 8
        movl    POSITION(%esp), %eax
        sarl    $8, %eax
        imull   LIGHT_SPACING(%ecx), %eax
        sarl    $8, %eax
        movl    %eax, SIZE(%esp)
        // inverse = (1 << 26) / (cosine < 6500 ? 6500 : cosine)
        cmpl    $STRETCHED, COSINE(%esp)
        jl      limit_cosine
cosine_limited:
        movl    $1<<26, %eax
        xorl    %edx, %edx
        divl    COSINE(%esp)
        movl    %eax, INVERSE(%esp)
        movl    %eax, %ecx
        // along = ((s.along[0] * n.x + s.along[1] * n.y + s.along[2] * n.z) >> 8) * inverse >> 10
        movsbl  SEED_ALONG(%ebp), %eax
        imull   %ebx, %eax
        movsbl  SEED_ALONG+1(%ebp), %edx
        imull   %esi, %edx
        addl    %edx, %eax
        movsbl  SEED_ALONG+2(%ebp), %edx
        imull   %edi, %edx
        addl    %edx, %eax
        sarl    $8, %eax
        imull   %ecx, %eax
        sarl    $10, %eax
        // across = ((s.across[0] * n.x + s.across[1] * n.y + s.across[2] * n.z) >> 8) * inverse >> 10
        movsbl  SEED_ACROSS+2(%ebp), %edx
        imull   %edx, %edi
        movsbl  SEED_ACROSS(%ebp), %edx
        imull   %ebx, %edx
        addl    %edx, %edi
        movsbl  SEED_ACROSS+1(%ebp), %edx
        imull   %esi, %edx
        addl    %edx, %edi
        sarl    $8, %edi
        imull   %ecx, %edi
        sarl    $10, %edi
        // alongZ = s.along[2] - (dirZ * along >> 22);  acrossZ = s.across[2] - (dirZ * across >> 22)
        movswl  SEED_DIRZ(%ebp), %edx
        movl    %edx, %ecx
        imull   %eax, %edx
        imull   %edi, %ecx
        sarl    $22, %edx
        movsbl  SEED_ALONG+2(%ebp), %ebx
        sarl    $22, %ecx
        movsbl  SEED_ACROSS+2(%ebp), %esi
        subl    %edx, %ebx
        subl    %ecx, %esi
        // All four with the other sign:  alongX = s.along[0] * 256 - (dirX * along >> 14) - alongZ * skewX;  ax = |alongX|
        movswl  SEED_DIRX(%ebp), %ecx
        imull   %eax, %ecx
        movl    %ebx, %edx
        sarl    $14, %ecx
        imull   SKEWX(%esp), %edx
        addl    %edx, %ecx
        movsbl  SEED_ALONG(%ebp), %edx
        shll    $8, %edx
        subl    %edx, %ecx
        movl    %ecx, ALONGX(%esp)
        jns     1f
        negl    %ecx
1:
        // alongY = s.along[1] * 256 - (dirY * along >> 14) - alongZ * skewY;  ay = |alongY|
        movswl  SEED_DIRY(%ebp), %edx
        imull   %edx, %eax
        imull   SKEWY(%esp), %ebx
        sarl    $14, %eax
        movsbl  SEED_ALONG+1(%ebp), %edx
        addl    %ebx, %eax
        shll    $8, %edx
        subl    %edx, %eax
        movl    %eax, ALONGY(%esp)
        jns     1f
        negl    %eax
1:
        // acrossX = s.across[0] * 256 - (dirX * across >> 14) - acrossZ * skewX
        movswl  SEED_DIRX(%ebp), %edx
        imull   %edi, %edx
        movl    %esi, %ebx
        sarl    $14, %edx
        imull   SKEWX(%esp), %ebx
        addl    %ebx, %edx
        movsbl  SEED_ACROSS(%ebp), %ebx
        shll    $8, %ebx
        subl    %ebx, %edx
        // acrossY = s.across[1] * 256 - (dirY * across >> 14) - acrossZ * skewY
        movswl  SEED_DIRY(%ebp), %ebx
        imull   %ebx, %edi
        imull   SKEWY(%esp), %esi
        sarl    $14, %edi
        movsbl  SEED_ACROSS+1(%ebp), %ebx
        addl    %esi, %edi
        shll    $8, %ebx
        movl    %eax, %esi
        subl    %ebx, %edi
        // if (inverse > WHOLE) wide = ax + |acrossX|, high = ay + |acrossY|
        cmpl    $WHOLE, INVERSE(%esp)
        ja      whole_cell
        // if (ax > ay) wide = ax, high = ay + |acrossY - acrossX * (alongY * 64 / alongX) / 64|
        cmpl    %eax, %ecx
        jle     taller
        movl    %edx, %ebx
        movl    ALONGY(%esp), %eax
        shll    $6, %eax
        cltd
        idivl   ALONGX(%esp)
        imull   %ebx, %eax
        cltd
        andl    $63, %edx
        addl    %edx, %eax
        sarl    $6, %eax
        addl    $MARGIN, %ecx
        subl    %edi, %eax
        jns     1f
        negl    %eax
1:
        leal    MARGIN(%esi,%eax), %esi
extents:
        // wide = ((wide + MARGIN) * size >> 14) + MARGIN_UNITS;  high = ((high + MARGIN) * size >> 14) + MARGIN_UNITS
        imull   SIZE(%esp), %ecx
        imull   SIZE(%esp), %esi
        sarl    $14, %ecx
        sarl    $14, %esi
        addl    $MARGIN_UNITS, %ecx
        addl    $MARGIN_UNITS, %esi
        movw    %cx, SEED_WIDE(%ebp)
        movw    %si, SEED_HIGH(%ebp)
        movswl  %cx, %ecx
        movswl  %si, %esi
        // if (2 * facing < depth && depth >= 32) ..
        movl    FRAME(%esp), %edi
        movl    FACING(%esp), %eax
        movl    DEPTH(%esp), %ebx
        addl    %eax, %eax
        cmpl    %ebx, %eax
        jl      near_horizon
whole:
        // z += (mulHigh(wide * wide + high * high, setBack) >> 7) + over
        imull   %ecx, %ecx
        imull   %esi, %esi
        leal    (%ecx,%esi), %eax
        imull   SET_BACK(%edi)
        sarl    $7, %edx
        addl    OVER(%esp), %edx
        addl    %edx, SEED_Z(%ebp)
        movl    FACING(%esp), %eax
away:
        addl    $LOCALS, %esp
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

        // The skew of each place from its own depth.  share = (1 << 20) / (away < 32 ? 32 : away), away = (root.z + out.z) >> 11
        .balign 4
near_viewer:
        movl    SEED_PATHZ(%ebp), %eax
        imull   POSITION(%esp)
        shrdl   $16, %edx, %eax
        addl    SKEW_ROOTZ(%ecx), %eax
        sarl    $11, %eax
        cmpl    $32, %eax
        jl      limit_away
away_limited:
        movl    %eax, SHARE(%esp)
        xorl    %edx, %edx
        movl    $1<<20, %eax
        divl    SHARE(%esp)
        movl    %eax, SHARE(%esp)
        // x = out.x >> 8;  skewX = limited(((root.x + out.x) >> 11) * share >> 12)
        movl    SEED_PATHX(%ebp), %eax
        imull   POSITION(%esp)
        shrdl   $16, %edx, %eax
        movl    %eax, %edx
        addl    SKEW_ROOTX(%ecx), %eax
        sarl    $8, %edx
        sarl    $11, %eax
        movl    %edx, SEED_X(%ebp)
        imull   SHARE(%esp), %eax
        sarl    $12, %eax
        leal    MOST_SKEW(%eax), %edx
        cmpl    $2*MOST_SKEW, %edx
        ja      limit_skewX
skewX_limited:
        movl    %eax, SKEWX(%esp)
        // y = out.y >> 8;  skewY = limited(((root.y + out.y) >> 11) * share >> 12)
        movl    SEED_PATHY(%ebp), %eax
        imull   POSITION(%esp)
        shrdl   $16, %edx, %eax
        movl    %eax, %edx
        addl    SKEW_ROOTY(%ecx), %eax
        sarl    $8, %edx
        sarl    $11, %eax
        movl    %edx, SEED_Y(%ebp)
        imull   SHARE(%esp), %eax
        sarl    $12, %eax
        leal    MOST_SKEW(%eax), %edx
        cmpl    $2*MOST_SKEW, %edx
        ja      limit_skewY
skewY_limited:
        movl    %eax, SKEWY(%esp)
        jmp     skewed

        // Much deformed: the whole cell.
whole_cell:
        testl   %edx, %edx
        jns     1f
        negl    %edx
1:
        testl   %edi, %edi
        jns     1f
        negl    %edi
1:
        leal    MARGIN(%ecx,%edx), %ecx
        leal    MARGIN(%esi,%edi), %esi
        jmp     extents

        // The rows lie upright.  else if (ay > 0) high = ay, wide = ax + |acrossX - acrossY * (alongX * 64 / alongY) / 64|
        .balign 4
taller:
        testl   %eax, %eax
        jz      no_extent
        movl    %edx, %ebx
        movl    ALONGX(%esp), %eax
        shll    $6, %eax
        cltd
        idivl   ALONGY(%esp)
        imull   %edi, %eax
        cltd
        andl    $63, %edx
        addl    %edx, %eax
        sarl    $6, %eax
        addl    $MARGIN, %esi
        subl    %ebx, %eax
        jns     1f
        negl    %eax
1:
        leal    MARGIN(%ecx,%eax), %ecx
        jmp     extents

        // reach = mulDiv(mulDiv(facing, facing, depth), 2 * horizon, 2 * depth) + 1
        .balign 4
near_horizon:
        cmpl    $32, %ebx
        jl      whole
        sarl    $1, %eax
        imull   %eax
        idivl   %ebx
        imull   EYE_HORIZON(%edi)
        idivl   %ebx
        incl    %eax
        // if (reach < 256 && (|tiltX * wide| + |tiltY * high|) >> 11 >= reach)
        cmpl    $255, %eax
        jg      whole
        movl    %eax, %ebx
        movswl  SEED_TILTX(%ebp), %eax
        imull   %ecx, %eax
        testl   %eax, %eax
        jns     1f
        negl    %eax
1:
        movswl  SEED_TILTY(%ebp), %edx
        imull   %esi, %edx
        testl   %edx, %edx
        jns     1f
        negl    %edx
1:
        addl    %edx, %eax
        sarl    $11, %eax
        cmpl    %ebx, %eax
        jl      whole
        movb    %bl, SEED_REACH(%ebp)
        jmp     whole

        // Seldom
short_one:
        // if (bits == 0) return {0, 0, -16384};  x <<= -excess, ...
        negl    %ecx
        cmpl    $14, %ecx
        je      no_direction
        shll    %cl, %ebx
        shll    %cl, %esi
        shll    %cl, %edi
        jmp     scaled
no_direction:
        xorl    %ebx, %ebx
        xorl    %esi, %esi
        movl    $-16384, %edi
        jmp     normal
limit_bright:
        // step < 0 ? 0 : BRIGHTEST
        sarl    $31, %eax
        notl    %eax
        andl    $BRIGHTEST, %eax
        jmp     bright_limited
limit_away:
        movl    $32, %eax
        jmp     away_limited
limit_skewX:
        sarl    $31, %eax               // 0 or -1
        andl    $-2*MOST_SKEW, %eax
        addl    $MOST_SKEW, %eax        // MOST_SKEW or -MOST_SKEW
        jmp     skewX_limited
limit_skewY:
        sarl    $31, %eax
        andl    $-2*MOST_SKEW, %eax
        addl    $MOST_SKEW, %eax
        jmp     skewY_limited
limit_cosine:
        movl    $STRETCHED, COSINE(%esp)
        jmp     cosine_limited
no_extent:
        addl    $MARGIN, %ecx
        addl    $MARGIN, %esi
        jmp     extents
        ENDFUNC(shadeSeedA)

ASM_END
