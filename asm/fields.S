// The fields of neighbours along a path, for the 386 and up: half of the time of settling a seed is spent here. The routine
// implements its C++ twin in src/surface/fields.cpp (declared in fields.h), and the tests feed both the same input. Above each
// group of instructions stands the line of C++ that it implements.
//
// The cost of a field is that of its multiplications: four for a point and seven for a segment, but two and four where the field
// does not reach, and three or six more to set a new path. A multiplication takes 9 to 38 cycles on the 386 and 13 to 42 on the
// 486, depending on the bits of its second factor, and 10 on the Pentium, in the U pipe only. There is no division.

#include "asm.h"

// struct Along (src/surface/fields.h), the base of struct Neighbour
#define ALONG_KIND   0
#define ALONG_HALF   4
#define ALONG_WAY    8
#define ALONG_A      20
#define ALONG_C      24
#define ALONG_TWICE  28
#define ALONG_Y      40
#define ALONG_B      44
#define ALONG_STEPY  48
#define ALONG_VALUE  52
#define ALONG_SLOPE  56
#define ALONG_T      60
#define ALONG_CHANGE 64
#define ALONG_K      68
#define KIND_SEGMENT 1

// struct Fields
#define FIELDS_SUM   0
#define FIELDS_SLOPE 4
#define FIELDS_STRONGEST 8
#define FIELDS_REACHING 12

// struct FieldStep (include/model/field.h)
#define STEP_VALUE   0
#define STEP_SLOPE   4

// The arguments of addFieldsA on the stack
#define ADD_FRAME    16
#define ADD_FIRST    (ADD_FRAME+4)
#define ADD_END      (ADD_FRAME+8)
#define ADD_POSITION (ADD_FRAME+12)
#define ADD_PATH     (ADD_FRAME+16)
#define ADD_FIELDS   (ADD_FRAME+20)

        .text

// eax = eax * factor, a product of 16.16 numbers; changes edx
.macro times factor
        imull        \factor
        shrdl        $16, %edx, %eax
.endm

// ecx = dot product of the vector at ebx and the vector at offset `vector` from edi, >> 4; changes eax and edx
.macro product16 vector
        movl        (%ebx), %eax
        times        \vector(%edi)
        movl        %eax, %ecx
        movl        4(%ebx), %eax
        times        \vector+4(%edi)
        addl        %eax, %ecx
        movl        8(%ebx), %eax
        times        \vector+8(%edi)
        addl        %eax, %ecx
        sarl        $4, %ecx
.endm

// Sets ecx = inner = b + p c, and eax = t = a + p inner; changes edx. With `aims` 1 ecx is b before.
.macro find_t aims
        // outer = p * c; inner = b + outer
        movl        ALONG_C(%edi), %eax
        times        ADD_POSITION(%esp)
        .if \aims
        addl        %ecx, %eax
        .else
        addl        ALONG_B(%edi), %eax
        .endif
        movl        %eax, %ecx
        // t = a + p * inner
        times        ADD_POSITION(%esp)
        addl        ALONG_A(%edi), %eax
.endm

// Sets `change` of a point, and edx to it; ecx is inner before.
.macro find_change
        // change = inner + outer;   outer is inner - b
        leal        (%ecx,%ecx), %edx
        subl        ALONG_B(%edi), %edx
        movl        %edx, ALONG_CHANGE(%edi)
.endm

// The same of a segment; changes eax and ecx.
.macro find_change_beside
        // change = inner + outer - k * (stepY + stepY);   outer is inner - b
        movl        ALONG_STEPY(%edi), %eax
        addl        %ecx, %ecx
        addl        %eax, %eax
        subl        ALONG_B(%edi), %ecx
        times        ALONG_K(%edi)
        subl        %eax, %ecx
        movl        %ecx, ALONG_CHANGE(%edi)
        movl        %ecx, %edx
.endm

// Goes on with the next neighbour, if there is one.
.macro add_next aims
        addl        $4, %esi
        cmpl        ADD_END(%esp), %esi
        jb        add_one\aims
        jmp        add_end
.endm

// The loop over all neighbours. With `aims` 1 it sets each to the path at ebx first, with 0 it does not: `path` is null then.
.macro add_all aims
add_one\aims:
        movl        (%esi), %edi
        // if (kind == POINT && path != nullptr) b = dot(path, twice16) >> 4
        cmpl        $KIND_SEGMENT, ALONG_KIND(%edi)
        jae        add_no_point\aims
        .if \aims
        product16 ALONG_TWICE
        movl        %ecx, ALONG_B(%edi)
        .endif
        find_t \aims
        movl        %eax, ALONG_T(%edi)
        // if (t >= 1) value = slope = 0. (Taken for unsigned, a negative t is large, too.)
        cmpl        $0x10000, %eax
        jae        add_outside\aims
add_inside\aims:
        find_change
add_changing\aims:
        // step = fieldSteps[t >> 8]; value = step.value + (step.slope * ((t & 255) - 128) >> 16); slope = step.slope
        movzbl        %al, %ecx
        shrl        $8, %eax
        addl        $-128, %ecx
        imull        SYM(fieldSteps)+STEP_SLOPE(,%eax,8), %ecx
        sarl        $16, %ecx
        addl        SYM(fieldSteps)+STEP_VALUE(,%eax,8), %ecx
        movl        SYM(fieldSteps)+STEP_SLOPE(,%eax,8), %eax
        movl        %ecx, ALONG_VALUE(%edi)
        movl        %eax, ALONG_SLOPE(%edi)
        // fields->sum += value; fields->slope += slope * change; ++fields->reaching
        times        %edx
        addl        %ecx, FIELDS_SUM(%ebp)
        addl        %eax, FIELDS_SLOPE(%ebp)
        incl        FIELDS_REACHING(%ebp)
        // fields->strongest = max(fields->strongest, value)
        cmpl        FIELDS_STRONGEST(%ebp), %ecx
        jle        add_done\aims
        movl        %ecx, FIELDS_STRONGEST(%ebp)
add_done\aims:
        add_next \aims

add_outside\aims:
        testl        %eax, %eax
        js        add_below\aims
        movl        $0, ALONG_VALUE(%edi)
        movl        $0, ALONG_SLOPE(%edi)
        add_next \aims

        // t = max(t, 0)
add_below\aims:
        cmpl        $KIND_SEGMENT, ALONG_KIND(%edi)
        movl        $0, %eax
        jb        add_inside\aims
        find_change_beside
        xorl        %eax, %eax
        jmp        add_changing\aims

add_no_point\aims:
        ja        add_other\aims
        // if (path != nullptr) b = dot(path, twice16) >> 4; stepY = dot(path, along16) >> 4
        .if \aims
        product16 ALONG_WAY
        movl        %ecx, ALONG_STEPY(%edi)
        product16 ALONG_TWICE
        movl        %ecx, ALONG_B(%edi)
        .endif
        find_t \aims
        movl        %eax, ALONG_T(%edi)
        // at = y + p * stepY
        movl        ALONG_STEPY(%edi), %eax
        times        ADD_POSITION(%esp)
        addl        ALONG_Y(%edi), %eax
        // k = clamp(at, -half, half)
        movl        ALONG_HALF(%edi), %edx
        cmpl        %edx, %eax
        jg        add_clamped\aims
        negl        %edx
        cmpl        %edx, %eax
        jl        add_clamped\aims
        movl        %eax, %edx
add_clamped\aims:
        movl        %edx, ALONG_K(%edi)
        // t -= k * (at + at - k)
        addl        %eax, %eax
        subl        %edx, %eax
        times        ALONG_K(%edi)
        subl        %eax, ALONG_T(%edi)
        movl        ALONG_T(%edi), %eax
        // if (t >= 1) value = slope = 0
        cmpl        $0x10000, %eax
        jae        add_outside\aims
        find_change_beside
        movl        ALONG_T(%edi), %eax
        jmp        add_changing\aims

        // The t and the change of other neighbours are known.
add_other\aims:
        movl        ALONG_T(%edi), %eax
        movl        ALONG_CHANGE(%edi), %edx
        cmpl        $0x10000, %eax
        jge        add_outside\aims
        testl        %eax, %eax
        jns        add_changing\aims
        xorl        %eax, %eax
        jmp        add_changing\aims
.endm

// void addFieldsA(Neighbour* const* first, Neighbour* const* end, Real position, const Vector* path, Fields* fields)
//
//   esi  at             edi  along (**at)       ebp  fields             ebx  path
FUNC(addFieldsA)
        pushl        %ebp
        pushl        %ebx
        pushl        %esi
        pushl        %edi
        movl        ADD_FIRST(%esp), %esi
        movl        ADD_FIELDS(%esp), %ebp
        movl        ADD_PATH(%esp), %ebx
        cmpl        ADD_END(%esp), %esi
        jae        add_end
        testl        %ebx, %ebx
        jz        add_one0
        add_all 1
        add_all 0
add_end:
        popl        %edi
        popl        %esi
        popl        %ebx
        popl        %ebp
        ret
ENDFUNC(addFieldsA)
ASM_END
