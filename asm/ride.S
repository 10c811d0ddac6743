// The seeds of a patch that neighbours reach, for the 386 and up: what settling costs most of the time. src/surface/ride.cpp has it in
// C++, include/surface/ride.h says what it is about; the tests feed both the same input. Above each group of instructions stands the
// line of C++ that it implements.
//
// In assembly because it is multiplications of 32 by 32 bits of which the upper half or the middle is wanted, with hardly
// anything between: a compiler for the 386 moves all registers aside for each of them. One takes 9 to 38 cycles on the 386, as
// many as its second factor has bits, 13 to 42 on the 486 and 10 on the Pentium, where it pairs with nothing; so what stands
// between them matters little for pairing. Loads are put between a result and its use where there is something to load. The
// frame is at a fixed address and takes no register. What is seldom is called through pointers in it, and stands behind what is
// not, so that the way through has few jumps.
//
// In instructions: a seed that is asleep takes 12 to 14, one that is awake 20 besides; a neighbour that does not reach it 14, one
// that does 21; the test whether it faces away about 30; its place between two, from the profile, 40 and the shading; a look at
// the field with two neighbours 70.

#include "asm.h"

// struct Seed and SeedFlag (include/model/seed.h)
#define SEED_SIZE    68
#define SEED_PATHX   0
#define SEED_PATHY   4
#define SEED_PATHZ   8
#define SEED_POSITION 12
#define SEED_NEIGHBOUR 16
#define SEED_BRIGHT  40
#define SEED_FLAGS   48
#define SEED_REST    49
#define SEED_DIRX    52
#define SEED_DIRY    54
#define SEED_DIRZ    56
#define SEED_WAKES   58
#define VALID        1
#define PLACED       2
#define ACTIVE       4
#define KEPT         8
#define FRONT        128

// struct RideNear (include/surface/ride.h)
#define NEAR_AZERO   16
#define NEAR_CZERO   20
#define NEAR_TWICEX  24
#define NEAR_TWICEY  28
#define NEAR_TWICEZ  32
#define NEAR_MEETINGSUM 36
#define NEAR_TOUCHINGSUM 40
#define NEAR_BURYINGSUM 44
#define NEAR_MEETINGRUNSUM 48
#define NEAR_SWING   52
#define NEAR_TOUCHING 56
#define NEAR_BURYING 60
#define NEAR_SUM     64
#define NEAR_WAITAPART 68
#define NEAR_WAITBURIED 72
#define NEAR_WAITFACING 76
#define NEAR_HALFSQUARE 80
#define NEAR_AWAYLIMIT 84
#define NEAR_WAITAWAY 88
#define NEAR_PROFILE 92
#define NEAR_NEXT    96
#define NEAR_MORE    100
#define NEAR_BIT     104

// struct SeedRun (include/model/seed.h)
#define RUN_MIDDLEX  0
#define RUN_MIDDLEY  4
#define RUN_MIDDLEZ  8
#define RUN_HALFX    12
#define RUN_HALFY    16
#define RUN_HALFZ    20
#define RUN_WIDE     24
#define RUN_COUNT    28
#define RUN_TURNED   32
#define RUN_EXTRAS   33
#define RUN_BACK     34

// struct RideFrame
#define RIDE_FIRST   0
#define RIDE_TRAVEL  4
#define RIDE_LATER   8
#define RIDE_AWAYEDGE 12
#define RIDE_AWAYSHARE 16
#define RIDE_WAITALONG 20
#define RIDE_AWAYALONG 24
#define RIDE_WAITAWAY 28
#define RIDE_PACESTEPS 32
#define RIDE_PLACEDMOST 36
#define RIDE_EVENMOST 40
#define RIDE_KEPT    44
#define RIDE_KEPTTWICE 48
#define RIDE_PARTING 52
#define RIDE_PARTINGTWICE 56
#define RIDE_OVERSHOOT 60
#define RIDE_KEPTWAIT 64
#define RIDE_PLACED  68
#define RIDE_SEVERAL 72
#define RIDE_LOOKS   76
#define RIDE_SHADED  80
#define RIDE_FACING  84
#define RIDE_NORMALS 88
#define RIDE_UNSETTLED 92
#define RIDE_EXCESS  96
#define RIDE_SLOPE   100
#define RIDE_STRENGTH 104
#define RIDE_INRANGE 108
#define RIDE_REACHED 112
#define RIDE_HOLDS   116
#define RIDE_PROFILEFOR 120
#define RIDE_STAYS   124
#define RIDE_HELD    128
#define RIDE_LOST    132
#define RIDE_ROUGH   136
#define RIDE_UNEVEN  140
#define RIDE_UNEVENTWICE 144
#define RIDE_B       148
#define RIDE_BEYOND  400
#define RIDE_SHADE   652
// of which these are in its ShadeFrame (include/surface/lie.h)
#define EYE_X        RIDE_SHADE+24
#define EYE_Y        RIDE_SHADE+28
#define EYE_Z        RIDE_SHADE+32
#define EYE_AWAY     RIDE_SHADE+52
#define OWN_SLOPE    RIDE_SHADE+112
#define COUNT        RIDE_SHADE+116
#define SLOPES       RIDE_SHADE+120
#define PULLS        RIDE_SHADE+372

// class Profile (include/surface/profile.h)
#define PROFILE_TOP  0
#define PROFILE_DEPTH 4
#define PROFILE_FINE 8
#define PROFILE_EDGE 12
#define PROFILE_PLACE 16
#define PROFILE_RISE 20
#define PROFILE_CELL 8
#define NOT_MADE     -0x7fffffff-1

// Constants (include/surface/ride.h, include/model/field.h)
#define B_SHIFT      4
#define WAIT_MOST    0x3000
#define AWAY_MOST    24*65536
#define DISPLACEMENT 655
#define SHORT_STEP   3277
#define LONGEST_STEP 16384
#define LOOK_LIMIT   8
#define FLAT         -13107
#define PLACED_LEAST 62259
#define POSITION_MOST 121242
#define OVER_BACK    128
#define ISOVALUE     32768
#define OWN_FIRST    940
#define OWN_STEP     16
#define OWN_OFFSET   4
#define STEEP_OFFSET 8
#define OTHER_OFFSET 12
#define FIELD_STEP   8
#define SLOPE_OFFSET 4
#define RUN_DOUBT    262
#define RECHECK      640
#define REACHES_NONE 1
#define REACHES_BURYING 2
#define REACHES_SOME 3

// On the stack of rideA: the flags of all seeds together and, in the byte above, whether any was awake; the arguments, of which
// the last gives its place to how many seeds are left.
#define SEEN   0
#define BUSY   1
#define RUN    24
#define SEEDS  28
#define LEFT   28

# define RIDE(field) SYM(ride)+field
# define OWN(field) SYM(ownSteps)-OWN_FIRST*OWN_STEP+field

        .text

// ---------------------------------------------------------------------------------------------------------------------
// int32_t rideA(SeedRun* run, Seed* seeds)
//
//   esi  seed; the rest is anybody's

// The loop stands four times. `turned`: seeds are to be laid anew. `quiet`: no oversampled seed takes part, so that there is none
// to be put aside. `busy`: it is known that some seed was awake.
        .macro  SEEDS_LOOP name turned quiet busy
seed_\name:
        .if     \turned
        // if ((flags & (PLACED | FRONT)) == (PLACED | FRONT)) flags &= ~KEPT, and it is awake
        movb    SEED_FLAGS(%esi), %al
        andb    $PLACED|FRONT, %al
        cmpb    $PLACED|FRONT, %al
        je      turn
        .endif
        // if (static_cast<int16_t>(wakes - travel) < 0): both in the upper half of a word, below them there is no borrow
        movl    SEED_DIRZ(%esi), %eax
        subl    RIDE(RIDE_TRAVEL), %eax
        .if     \quiet && !\busy
        js      first_awake
        .else
        jns     asleep_\name
awake_\name:
        call    settle
        // if (shaded == s) ..
        cmpl    RIDE(RIDE_SHADED), %esi
        je      shaded_\name
told_\name:
        .if     !\busy
        movb    $1, BUSY(%esp)
        .endif
        .endif
asleep_\name:
        // seen |= flags;  other = seed + extra.neighbour
        movb    SEED_FLAGS(%esi), %al
        movl    SEED_SIZE+SEED_NEIGHBOUR(%esi), %ecx
        orb     %al, SEEN(%esp)
        // if (((flags | other.flags) & (PLACED | FRONT)) == (PLACED | FRONT)) ..: FRONT is the sign
        orb     SEED_FLAGS(%esi,%ecx), %al
        jns     none_\name
        testb   $PLACED, %al
        jnz     pair_\name
none_\name:
        // else extra.flags = 0
        .if     !\quiet
        movb    $0, SEED_SIZE+SEED_FLAGS(%esi)
        .endif
        addl    $2*SEED_SIZE, %esi
        decl    LEFT(%esp)
        jnz     seed_\name
        jmp     done

        .balign 4
pair_\name:
        // belt = ((flags ^ other.flags) & VALID) != 0
        movb    SEED_FLAGS(%esi), %al
        movb    SEED_FLAGS(%esi,%ecx), %dl
        movb    %al, %ah
        xorb    %dl, %ah
        testb   $VALID, %ah
        jnz     belt_\name
        // if (|position - other.position| <= parting) none
        movl    SEED_POSITION(%esi), %eax
        subl    SEED_POSITION(%esi,%ecx), %eax
        addl    RIDE(RIDE_PARTING), %eax
        cmpl    RIDE(RIDE_PARTINGTWICE), %eax
        jbe     none_\name
between_\name:
        addl    $SEED_SIZE, %esi
        .if     \turned
        movb    SEED_FLAGS(%esi), %al
        andb    $PLACED|FRONT, %al
        cmpb    $PLACED|FRONT, %al
        je      turn_extra
        .endif
        // if (!(extra.flags & ACTIVE) || passed(extra)) settle(extra)
        testb   $ACTIVE, SEED_FLAGS(%esi)
        jz      extra_\name
        movl    SEED_DIRZ(%esi), %eax
        subl    RIDE(RIDE_TRAVEL), %eax
        jns     2f
extra_\name:
        call    settle
        movb    $1, BUSY(%esp)
        cmpl    RIDE(RIDE_SHADED), %esi
        je      shaded_extra_\name
2:
        // extra.flags |= ACTIVE;  seen |= extra.flags;  extras = true
        movb    SEED_FLAGS(%esi), %al
        orb     $ACTIVE, %al
        movb    %al, SEED_FLAGS(%esi)
        orb     %al, SEEN(%esp)
        movl    RUN(%esp), %ecx
        movb    $1, RUN_EXTRAS(%ecx)
        addl    $SEED_SIZE, %esi
        decl    LEFT(%esp)
        jnz     seed_\name
        jmp     done
        .if     !\quiet || \busy
shaded_\name:
        call    shaded_seed
        jmp     told_\name
        .endif
shaded_extra_\name:
        call    shaded_extra
        jmp     2b
belt_\name:
        // if (flags & other.flags & PLACED) none
        andb    %dl, %al
        testb   $PLACED, %al
        jnz     none_\name
        jmp     between_\name
        .endm

        .balign 16
        FUNC(rideA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        pushl   $0
        movl    RUN(%esp), %ecx
        movl    SEEDS(%esp), %esi
        // left = count;  turned = extras = false
        movl    RUN_COUNT(%ecx), %eax
        movb    RUN_TURNED(%ecx), %dl
        movb    RUN_EXTRAS(%ecx), %dh
        movl    %eax, LEFT(%esp)
        movw    $0, RUN_TURNED(%ecx)
        testb   %dl, %dl
        jnz     seed_turned
        testb   %dh, %dh
        jnz     seed_extras
        .balign 4
        SEEDS_LOOP quiet 0 1 0
first_awake:
        movb    $1, BUSY(%esp)
        jmp     awake_busy
        .balign 4
        SEEDS_LOOP busy 0 1 1
        .balign 4
        SEEDS_LOOP extras 0 0 0
        .balign 4
turn:
        andb    $~KEPT, SEED_FLAGS(%esi)
        jmp     awake_turned
turn_extra:
        andb    $~KEPT, SEED_FLAGS(%esi)
        jmp     extra_turned
        .balign 4
        SEEDS_LOOP turned 1 0 0
done:
        // back = !(seen & FRONT)
        movl    RUN(%esp), %ecx
        popl    %eax
        movb    %al, %dl
        popl    %edi
        notb    %dl
        popl    %esi
        shrb    $7, %dl
        popl    %ebx
        movb    %dl, RUN_BACK(%ecx)
        popl    %ebp
        shrl    $8, %eax
        ret
        ENDFUNC(rideA)

// ---------------------------------------------------------------------------------------------------------------------
// Settles the seed esi, which alone is kept.
//
//   ebx  neighbour     edi  met     ebp  apart

        .balign 16
        LOCAL(settle)
        movl    RIDE(RIDE_FIRST), %ebx
        xorl    %edi, %edi
        xorl    %ebp, %ebp
next:
        // sum = mulHigh(path.x, twice.x) + mulHigh(path.y, twice.y) + mulHigh(path.z, twice.z)
        movl    SEED_PATHX(%esi), %eax
        imull   NEAR_TWICEX(%ebx)
        movl    %edx, %ecx
        movl    SEED_PATHY(%esi), %eax
        imull   NEAR_TWICEY(%ebx)
        addl    %edx, %ecx
        movl    SEED_PATHZ(%esi), %eax
        imull   NEAR_TWICEZ(%ebx)
        addl    %ecx, %edx
        // if (sum >= meetingSum) continue
        cmpl    NEAR_MEETINGSUM(%ebx), %edx
        jl      met
        movl    %edx, NEAR_SUM(%ebx)
        movl    NEAR_NEXT(%ebx), %ebx
        testl   %ebx, %ebx
        jnz     next
        jmp     all_looked_at
        .balign 4
met:
        // if (sum < buryingSum) ..;  apart += sum >= touchingSum
        cmpl    NEAR_BURYINGSUM(%ebx), %edx
        jl      buried
        cmpl    NEAR_TOUCHINGSUM(%ebx), %edx
        jge     only_met
touched:
        // b[met] = sum << B_SHIFT;  pulls[met++] = near
        shll    $B_SHIFT, %edx
        movl    %ebx, RIDE(PULLS)(,%edi,4)
        movl    %edx, RIDE(RIDE_B)(,%edi,4)
        movl    NEAR_NEXT(%ebx), %ebx
        incl    %edi
        testl   %ebx, %ebx
        jnz     next
all_looked_at:
        // if (met == apart) ..
        cmpl    %ebp, %edi
        je      at_rest
        // along = dirX * eye.x + dirY * eye.y + dirZ * eye.z
        movswl  SEED_DIRX(%esi), %ecx
        imull   RIDE(EYE_X), %ecx
        movswl  SEED_DIRY(%esi), %eax
        imull   RIDE(EYE_Y), %eax
        addl    %eax, %ecx
        movswl  SEED_DIRZ(%esi), %eax
        imull   RIDE(EYE_Z), %eax
        addl    %eax, %ecx
        movl    %edi, RIDE(COUNT)
        // if (along < awayAlong) ..
        cmpl    RIDE(RIDE_AWAYALONG), %ecx
        jl      may_face_away
faces:
        // if (met != 1) ..
        decl    %edi
        jnz     several

        // One neighbour alone reaches it.
        //   ebx  neighbour     ecx  position
        movl    RIDE(PULLS), %ebx
        incl    RIDE(RIDE_PLACED)
        // in = top - b;  if (in >= depth) ..;  in >>= fine
        movl    NEAR_PROFILE(%ebx), %ebp
place:
        movl    PROFILE_TOP(%ebp), %eax
        movl    PROFILE_FINE(%ebp), %ecx
        subl    RIDE(RIDE_B), %eax
        cmpl    PROFILE_DEPTH(%ebp), %eax
        jge     no_place
        testl   %eax, %eax
        jl      above
        sarl    %cl, %eax
        // position = cells[in >> 8].position + (cells[in >> 8].rise * (in & 255) >> 8)
        movzbl  %al, %ecx
        shrl    $8, %eax
        imull   PROFILE_RISE(%ebp,%eax,PROFILE_CELL), %ecx
        sarl    $8, %ecx
        addl    PROFILE_PLACE(%ebp,%eax,PROFILE_CELL), %ecx
placed:
        // if (position > placedMost) ..
        cmpl    RIDE(RIDE_PLACEDMOST), %ecx
        jg      too_far
        // wakes = travel
        movw    RIDE(RIDE_TRAVEL+2), %ax
        movw    %ax, SEED_WAKES(%esi)
        // if ((flags & KEPT) && |position - seed.position| <= kept) return
        testb   $KEPT, SEED_FLAGS(%esi)
        jz      lay
        movl    %ecx, %eax
        subl    SEED_POSITION(%esi), %eax
        addl    RIDE(RIDE_KEPT), %eax
        cmpl    RIDE(RIDE_KEPTTWICE), %eax
        jbe     lies
lay:
        // ownSlope = ownQuick(position).slope;  slopes[0] = .otherSlope
        movl    %ecx, %edx
        movl    %ecx, SEED_POSITION(%esi)
        sarl    $2, %edx
        andl    $-OWN_STEP, %edx
        movl    OWN(OWN_OFFSET)(%edx), %eax
        movl    OWN(OTHER_OFFSET)(%edx), %edx
        movl    %eax, RIDE(OWN_SLOPE)
        movl    %edx, RIDE(SLOPES)
        // facing = shadeSeed(&shade, &s, position, position > evenMost ? OVER_BACK : 0)
        xorl    %eax, %eax
        cmpl    RIDE(RIDE_EVENMOST), %ecx
        jg      beyond_border
shade:
        pushl   %eax
        pushl   %ecx
        pushl   %esi
        pushl   $RIDE(RIDE_SHADE)
        call    SYM(shadeSeedA)
        addl    $16, %esp
        // if (facing <= 0) ..
        testl   %eax, %eax
        jle     faces_not
        // ++normals;  flags = VALID | PLACED | KEPT | FRONT
        incl    RIDE(RIDE_NORMALS)
        movb    $VALID|PLACED|KEPT|FRONT, SEED_FLAGS(%esi)
        movl    %esi, RIDE(RIDE_SHADED)
        movl    %eax, RIDE(RIDE_FACING)
lies:
        ret

        // Rests where it would be alone. steps = WAIT_MOST, and for each that may come near
        //   edi  steps
        .balign 4
at_rest:
        movl    RIDE(RIDE_FIRST), %ebx
        movl    $WAIT_MOST, %edi
1:
        // steps = lesser(steps, stepsOf((sum << B_SHIFT) - touching, waitApart))
        movl    NEAR_SUM(%ebx), %eax
        shll    $B_SHIFT, %eax
        subl    NEAR_TOUCHING(%ebx), %eax
        cmpl    $65536, %eax
        jle     2f
        movl    $65536, %eax
2:
        imull   NEAR_WAITAPART(%ebx)
        cmpl    %edi, %edx
        jge     2f
        movl    %edx, %edi
2:
        movl    NEAR_NEXT(%ebx), %ebx
        testl   %ebx, %ebx
        jnz     1b
        // brightness = restBrightness;  position = 1
        movb    SEED_REST(%esi), %dl
        movb    SEED_FLAGS(%esi), %al
        movb    %dl, SEED_BRIGHT(%esi)
        movl    $65536, SEED_POSITION(%esi)
        // flags = (flags & (KEPT | PLACED)) == KEPT ? VALID | KEPT | (flags & FRONT) : VALID | FRONT
        movb    %al, %dl
        andb    $KEPT|PLACED, %dl
        andb    $FRONT, %al
        cmpb    $KEPT, %dl
        je      2f
        movb    $FRONT^KEPT, %al
2:
        xorb    $VALID|KEPT, %al
        addl    RIDE(RIDE_LATER), %edi
        movb    %al, SEED_FLAGS(%esi)
        movw    %di, SEED_WAKES(%esi)
        ret

        // ++apart
only_met:
        movl    %edx, NEAR_SUM(%ebx)
        incl    %ebp
        jmp     touched

        // Inside whatever the others do.  wait(0, stepsOf(burying - (sum << B_SHIFT), waitBuried))
        .balign 4
buried:
        movl    NEAR_BURYING(%ebx), %eax
        shll    $B_SHIFT, %edx
        movl    $65536, SEED_POSITION(%esi)
        subl    %edx, %eax
        cmpl    $65536, %eax
        jle     1f
        movl    $65536, %eax
1:
        imull   NEAR_WAITBURIED(%ebx)
        xorl    %eax, %eax

        // flags = al;  wakes = later + (edx < WAIT_MOST ? edx : WAIT_MOST)
wait:
        cmpl    $WAIT_MOST, %edx
        jle     1f
        movl    $WAIT_MOST, %edx
1:
        addl    RIDE(RIDE_LATER), %edx
        movb    %al, SEED_FLAGS(%esi)
        movw    %dx, SEED_WAKES(%esi)
        ret

        // Faces away?
        //   ecx  along     ebp  share, then steps     edi  neighbours left
        .balign 4
may_face_away:
        // share = (along >> 14 << 11) * awayShare
        movl    %ecx, %eax
        sarl    $14, %eax
        shll    $11, %eax
        imull   RIDE(RIDE_AWAYSHARE)
        shrdl   $16, %edx, %eax
        movl    %eax, %ebp
1:
        // term = share - b[n] * halfSquare;  if (term > 0) term += term
        movl    RIDE(PULLS-4)(,%edi,4), %ebx
        movl    RIDE(RIDE_B-4)(,%edi,4), %eax
        imull   NEAR_HALFSQUARE(%ebx)
        shrdl   $16, %edx, %eax
        movl    %ebp, %edx
        subl    %eax, %edx
        jle     2f
        addl    %edx, %edx
2:
        // beyond[n] = awayLimit - term;  if (beyond[n] <= 0) ..
        movl    NEAR_AWAYLIMIT(%ebx), %eax
        subl    %edx, %eax
        jle     may_be_seen
        movl    %eax, RIDE(RIDE_BEYOND-4)(,%edi,4)
        decl    %edi
        jnz     1b
        // It does.  steps = stepsOf(awayEdge - (along >> 14 << 11), AWAY_MOST, waitAlong)
        sarl    $14, %ecx
        movl    RIDE(RIDE_AWAYEDGE), %eax
        shll    $11, %ecx
        subl    %ecx, %eax
        cmpl    $AWAY_MOST, %eax
        jle     1f
        movl    $AWAY_MOST, %eax
1:
        imull   RIDE(RIDE_WAITALONG)
        movl    %edx, %ebp
        movl    RIDE(COUNT), %edi
1:
        // steps = lesser(steps, stepsOf(beyond[n], AWAY_MOST, waitAway))
        movl    RIDE(PULLS-4)(,%edi,4), %ebx
        movl    RIDE(RIDE_BEYOND-4)(,%edi,4), %eax
        cmpl    $AWAY_MOST, %eax
        jle     2f
        movl    $AWAY_MOST, %eax
2:
        imull   NEAR_WAITAWAY(%ebx)
        cmpl    %ebp, %edx
        jge     2f
        movl    %edx, %ebp
2:
        decl    %edi
        jnz     1b
        // counted = 2 * paceSteps;  if (steps > counted) steps = steps < 2 * counted ? counted : steps >> 1
        movl    RIDE(RIDE_PACESTEPS), %eax
        movl    %ebp, %edx
        addl    %eax, %eax
        cmpl    %eax, %ebp
        jle     1f
        addl    %eax, %eax
        sarl    $1, %edx
        cmpl    %eax, %ebp
        jge     1f
        sarl    $1, %eax
        movl    %eax, %edx
1:
        // wait(flags & VALID ? VALID | PLACED : flags & PLACED, steps)
        movb    SEED_FLAGS(%esi), %al
        andb    $VALID|PLACED, %al
        testb   $VALID, %al
        jz      wait
        orb     $PLACED, %al
        jmp     wait

        // if (((eye.away - along) >> 14) > 0) wait(0, mulShift16((eye.away - along) >> 14, waitAway))
        .balign 4
may_be_seen:
        movl    RIDE(EYE_AWAY), %eax
        movl    RIDE(COUNT), %edi
        subl    %ecx, %eax
        sarl    $14, %eax
        testl   %eax, %eax
        jle     faces
        imull   RIDE(RIDE_WAITAWAY)
        shrdl   $16, %edx, %eax
        movl    %eax, %edx
        xorl    %eax, %eax
        jmp     wait

        // More than one neighbour.
        .balign 4
several:
        // ++several;  wakes = travel
        movw    RIDE(RIDE_TRAVEL+2), %ax
        incl    RIDE(RIDE_SEVERAL)
        movw    %ax, SEED_WAKES(%esi)
        // if (!(flags & (VALID | PLACED))) lost(&s, position), return
        movl    SEED_POSITION(%esi), %ebp
        testb   $VALID|PLACED, SEED_FLAGS(%esi)
        jz      lost
        // rideLook(position)
        call    look
        // if ((flags & KEPT) && strength <= 0 && |excess| <= DISPLACEMENT) ..
        testb   $KEPT, SEED_FLAGS(%esi)
        jz      newton
        cmpl    $0, RIDE(RIDE_STRENGTH)
        jg      newton
        movl    RIDE(RIDE_EXCESS), %eax
        addl    $DISPLACEMENT, %eax
        cmpl    $2*DISPLACEMENT, %eax
        jbe     stays

        // Newton's method.
        //   ebp  position
newton:
        pushl   $LOOK_LIMIT
newton_step:
        // if (slope > FLAT) return false;  step = quotient(-excess, slope)
        movl    RIDE(RIDE_SLOPE), %ecx
        movl    $-65536, %eax
        cmpl    $FLAT, %ecx
        jg      newton_fails
        imull   RIDE(RIDE_EXCESS)
        idivl   %ecx
        // step = clamp(step, -LONGEST_STEP, LONGEST_STEP)
        leal    LONGEST_STEP(%eax), %edx
        cmpl    $2*LONGEST_STEP, %edx
        ja      limit_step
step_limited:
        // position += step;  if (position < PLACED_LEAST || position > POSITION_MOST) return false
        addl    %eax, %ebp
        leal    -PLACED_LEAST(%ebp), %edx
        cmpl    $POSITION_MOST-PLACED_LEAST, %edx
        ja      newton_fails
        // if (|step| <= SHORT_STEP) return true
        addl    $SHORT_STEP, %eax
        cmpl    $2*SHORT_STEP, %eax
        jbe     settled
        // if (i < LOOK_LIMIT) rideLook(position)
        decl    (%esp)
        jz      unsettled
        call    look
        jmp     newton_step
settled:
        popl    %edx
        // seed.position = position;  if (strength > 0) held(&s)
        movl    RIDE(RIDE_STRENGTH), %edx
        movl    %ebp, %ecx
        movl    %ebp, SEED_POSITION(%esi)
        testl   %edx, %edx
        jg      held
        // else shade(s, position, strength + overshoot > 0)
        xorl    %eax, %eax
        addl    RIDE(RIDE_OVERSHOOT), %edx
        jle     shade
        movl    $OVER_BACK, %eax
        jmp     shade

        // shaded = null;  if (differ(*s, other) || (i < count && differ(*s, s[-2]))) rough(s).  With a return address more than
        // the loop on the stack
        .macro  DIFFER
        subl    %eax, %edx
        addl    RIDE(RIDE_UNEVEN), %edx
        cmpl    RIDE(RIDE_UNEVENTWICE), %edx
        ja      rough
        .endm

shaded_seed:
        movzbl  SEED_BRIGHT(%esi), %eax
        movl    SEED_SIZE+SEED_NEIGHBOUR(%esi), %ecx
        movl    $0, RIDE(RIDE_SHADED)
        addl    %esi, %ecx
        movzbl  SEED_BRIGHT(%ecx), %edx
        DIFFER
        movl    4+RUN(%esp), %edx
        movl    RUN_COUNT(%edx), %edx
        cmpl    4+LEFT(%esp), %edx
        je      1f
        movzbl  SEED_BRIGHT-2*SEED_SIZE(%esi), %edx
        DIFFER
1:
        ret
        // The same of an oversampled one and the two that it lies between
shaded_extra:
        movzbl  SEED_BRIGHT(%esi), %eax
        movl    SEED_NEIGHBOUR(%esi), %ecx
        movl    $0, RIDE(RIDE_SHADED)
        addl    %esi, %ecx
        movzbl  SEED_BRIGHT-SEED_SIZE(%esi), %edx
        DIFFER
        movzbl  SEED_BRIGHT-SEED_SIZE(%ecx), %edx
        DIFFER
        ret
rough:
        pushl   %esi
        call    *RIDE(RIDE_ROUGH)
        popl    %ecx
        ret

held:
        pushl   %esi
        call    *RIDE(RIDE_HELD)
        popl    %ecx
        ret
stays:
        // if (keptWait) stays(&s)
        cmpl    $0, RIDE(RIDE_KEPTWAIT)
        je      1f
        pushl   %esi
        call    *RIDE(RIDE_STAYS)
        popl    %ecx
1:
        ret
unsettled:
        incl    RIDE(RIDE_UNSETTLED)
newton_fails:
        // lost(&s, 1)
        popl    %edx
        movl    $65536, %ebp
lost:
        pushl   %ebp
        pushl   %esi
        call    *RIDE(RIDE_LOST)
        addl    $8, %esp
        ret
limit_step:
        // step < 0 ? -LONGEST_STEP : LONGEST_STEP
        sarl    $31, %eax
        andl    $-2*LONGEST_STEP, %eax
        addl    $LONGEST_STEP, %eax
        jmp     step_limited

        // Seldom
above:
        // position = a0 + c0 + b >= 1 ? 1 : cells[0].position
        movl    RIDE(RIDE_B), %eax
        movl    $65536, %ecx
        addl    NEAR_AZERO(%ebx), %eax
        addl    NEAR_CZERO(%ebx), %eax
        cmpl    %ecx, %eax
        jge     placed
        movl    PROFILE_PLACE(%ebp), %ecx
        jmp     placed
beyond_border:
        movl    $OVER_BACK, %eax
        jmp     shade
faces_not:
        // wait(VALID | PLACED, mulShift16(-facing, the least waitFacing))
        movl    RIDE(COUNT), %edi
        negl    %eax
        movl    $0x7fffffff, %ecx
1:
        movl    RIDE(PULLS-4)(,%edi,4), %ebx
        cmpl    %ecx, NEAR_WAITFACING(%ebx)
        jge     2f
        movl    NEAR_WAITFACING(%ebx), %ecx
2:
        decl    %edi
        jnz     1b
        imull   %ecx
        shrdl   $16, %edx, %eax
        movl    %eax, %edx
        movb    $VALID|PLACED, %al
        jmp     wait
no_place:
        // if (!made()) profileFor(&near), and again
        cmpl    $NOT_MADE, PROFILE_DEPTH(%ebp)
        jne     1f
        pushl   %ebx
        call    *RIDE(RIDE_PROFILEFOR)
        popl    %ecx
        jmp     place
1:
        // position = 1;  wait(0, ..)
        xorl    %ebp, %ebp
        movl    $65536, %ecx
        jmp     1f
too_far:
        // wait(PLACED, stepsOf(most(edge - b, 0), waitApart))
        movl    $PLACED, %ebp
1:
        movl    %ecx, SEED_POSITION(%esi)
        movl    NEAR_PROFILE(%ebx), %eax
        movl    PROFILE_EDGE(%eax), %eax
        subl    RIDE(RIDE_B), %eax
        jge     1f
        xorl    %eax, %eax
1:
        cmpl    $65536, %eax
        jle     1f
        movl    $65536, %eax
1:
        imull   NEAR_WAITAPART(%ebx)
        movl    %ebp, %eax
        jmp     wait
        ENDFUNC(settle)

// ---------------------------------------------------------------------------------------------------------------------
// The field at the position ebp of a path. Keeps esi and ebp.
//
//   ebx  neighbour     edi  neighbours left

        .balign 16
        LOCAL(look)
        incl    RIDE(RIDE_LOOKS)
        // excess = ownQuick(position).value - ISOVALUE;  slope = .steep;  ownSlope = .slope;  strongest = 0
        movl    %ebp, %eax
        sarl    $2, %eax
        andl    $-OWN_STEP, %eax
        movl    OWN(STEEP_OFFSET)(%eax), %ecx
        movl    OWN(OWN_OFFSET)(%eax), %edx
        movl    %ecx, RIDE(RIDE_SLOPE)
        movl    %edx, RIDE(OWN_SLOPE)
        movl    OWN(0)(%eax), %eax
        pushl   %eax
        subl    $ISOVALUE, %eax
        movl    RIDE(COUNT), %edi
        movl    %eax, RIDE(RIDE_EXCESS)
        movl    $0, RIDE(RIDE_STRENGTH)
1:
        // c = position * c0;  sum = b[n] + c;  t = a0 + position * sum
        movl    RIDE(PULLS-4)(,%edi,4), %ebx
        movl    NEAR_CZERO(%ebx), %eax
        imull   %ebp
        shrdl   $16, %edx, %eax
        movl    %eax, %ecx
        addl    RIDE(RIDE_B-4)(,%edi,4), %eax
        addl    %eax, %ecx
        imull   %ebp
        shrdl   $16, %edx, %eax
        addl    NEAR_AZERO(%ebx), %eax
        // if (t < 0 || t >= 1) ..
        cmpl    $65535, %eax
        ja      no_field
        // step = geoffQuick(t);  excess += step.value;  strongest = most(strongest, step.value)
        shrl    $6, %eax
        movl    SYM(fieldSteps)(,%eax,FIELD_STEP), %edx
        movl    SYM(fieldSteps)+SLOPE_OFFSET(,%eax,FIELD_STEP), %eax
        addl    %edx, RIDE(RIDE_EXCESS)
        cmpl    RIDE(RIDE_STRENGTH), %edx
        jle     2f
        movl    %edx, RIDE(RIDE_STRENGTH)
2:
        // slopes[n] = step.slope;  slope += step.slope * (sum + c)
        movl    %eax, RIDE(SLOPES-4)(,%edi,4)
        imull   %ecx
        shrdl   $16, %edx, %eax
        addl    %eax, RIDE(RIDE_SLOPE)
        decl    %edi
        jnz     1b
looked:
        // strength = strongest - ownQuick(position).value - overshoot
        popl    %eax
        addl    RIDE(RIDE_OVERSHOOT), %eax
        subl    %eax, RIDE(RIDE_STRENGTH)
        ret
no_field:
        // slopes[n] = 0
        movl    $0, RIDE(SLOPES-4)(,%edi,4)
        decl    %edi
        jnz     1b
        jmp     looked
        ENDFUNC(look)

// ---------------------------------------------------------------------------------------------------------------------
// int32_t rideReachA(const SeedRun* run)
//
//   esi  run     ebx  neighbour     edi  touched, then steps

        .balign 16
        FUNC(rideReachA)
        pushl   %ebp
        pushl   %ebx
        pushl   %esi
        pushl   %edi
        movl    RIDE(RIDE_INRANGE), %ebx
        movl    20(%esp), %esi
        xorl    %edi, %edi
        movl    $0, RIDE(RIDE_REACHED)
        testl   %ebx, %ebx
        jz      reach_none
1:
        // sum = alongSum(middle, twice)
        movl    RUN_MIDDLEX(%esi), %eax
        imull   NEAR_TWICEX(%ebx)
        movl    %edx, %ecx
        movl    RUN_MIDDLEY(%esi), %eax
        imull   NEAR_TWICEY(%ebx)
        addl    %edx, %ecx
        movl    RUN_MIDDLEZ(%esi), %eax
        imull   NEAR_TWICEZ(%ebx)
        addl    %edx, %ecx
        // change = |alongSum(half, twice)| + scaledProduct(wide, swing) + (RUN_DOUBT >> B_SHIFT)
        movl    RUN_HALFX(%esi), %eax
        imull   NEAR_TWICEX(%ebx)
        movl    %edx, %ebp
        movl    RUN_HALFY(%esi), %eax
        imull   NEAR_TWICEY(%ebx)
        addl    %edx, %ebp
        movl    RUN_HALFZ(%esi), %eax
        imull   NEAR_TWICEZ(%ebx)
        movl    RUN_WIDE(%esi), %eax
        addl    %edx, %ebp
        jns     2f
        negl    %ebp
2:
        imull   NEAR_SWING(%ebx)
        leal    RUN_DOUBT>>B_SHIFT(%ebp,%edx), %ebp
        // if (sum + change < buryingSum) ..
        leal    (%ecx,%ebp), %eax
        subl    %ebp, %ecx
        cmpl    NEAR_BURYINGSUM(%ebx), %eax
        jl      reach_burying
        // near.sum = sum - change;  if (near.sum < touchingSum) touched
        movl    %ecx, NEAR_SUM(%ebx)
        cmpl    NEAR_TOUCHINGSUM(%ebx), %ecx
        jge     2f
        incl    %edi
2:
        // if (near.sum < meetingRunSum) reached |= bit
        cmpl    NEAR_MEETINGRUNSUM(%ebx), %ecx
        jge     2f
        movl    NEAR_BIT(%ebx), %eax
        orl     %eax, RIDE(RIDE_REACHED)
2:
        movl    NEAR_MORE(%ebx), %ebx
        testl   %ebx, %ebx
        jnz     1b

        // if (touched) holds = RECHECK, and for each that does not reach it
        movl    RIDE(RIDE_INRANGE), %ebx
        testl   %edi, %edi
        jz      reach_none
        movl    $RECHECK, %edi
1:
        // holds = lesser(holds, stepsOf((sum - meetingRunSum) << B_SHIFT, waitApart))
        movl    NEAR_SUM(%ebx), %eax
        subl    NEAR_MEETINGRUNSUM(%ebx), %eax
        jl      3f
        cmpl    $65536>>B_SHIFT, %eax
        jle     2f
        movl    $65536>>B_SHIFT, %eax
2:
        shll    $B_SHIFT, %eax
        imull   NEAR_WAITAPART(%ebx)
        cmpl    %edi, %edx
        jge     3f
        movl    %edx, %edi
3:
        movl    NEAR_MORE(%ebx), %ebx
        testl   %ebx, %ebx
        jnz     1b
        movl    $REACHES_SOME, %eax
reach_done:
        movl    %edi, RIDE(RIDE_HOLDS)
        popl    %edi
        popl    %esi
        popl    %ebx
        popl    %ebp
        ret

        // Else holds = WAIT_MOST, and for each
reach_none:
        movl    $WAIT_MOST, %edi
        testl   %ebx, %ebx
        jz      3f
1:
        // holds = lesser(holds, stepsOf((sum - touchingSum) << B_SHIFT, waitApart))
        movl    NEAR_SUM(%ebx), %eax
        subl    NEAR_TOUCHINGSUM(%ebx), %eax
        cmpl    $65536>>B_SHIFT, %eax
        jle     2f
        movl    $65536>>B_SHIFT, %eax
2:
        shll    $B_SHIFT, %eax
        imull   NEAR_WAITAPART(%ebx)
        cmpl    %edi, %edx
        jge     2f
        movl    %edx, %edi
2:
        movl    NEAR_MORE(%ebx), %ebx
        testl   %ebx, %ebx
        jnz     1b
3:
        movl    $REACHES_NONE, %eax
        jmp     reach_done

        // holds = stepsOf((buryingSum - (sum + change)) << B_SHIFT, waitBuried)
reach_burying:
        negl    %eax
        addl    NEAR_BURYINGSUM(%ebx), %eax
        cmpl    $65536>>B_SHIFT, %eax
        jle     1f
        movl    $65536>>B_SHIFT, %eax
1:
        shll    $B_SHIFT, %eax
        imull   NEAR_WAITBURIED(%ebx)
        movl    $REACHES_BURYING, %eax
        movl    %edx, %edi
        jmp     reach_done
        ENDFUNC(rideReachA)

// void rideLookA(Real position)
        .balign 4
        FUNC(rideLookA)
        pushl   %ebp
        pushl   %ebx
        pushl   %edi
        movl    16(%esp), %ebp
        call    look
        popl    %edi
        popl    %ebx
        popl    %ebp
        ret
        ENDFUNC(rideLookA)

ASM_END
