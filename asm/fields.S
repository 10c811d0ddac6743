// The fields of neighbours along a path, for the 386 and up: half of what settling a seed takes. src/surface/fields.cpp has it in
// C++ and fields.h says what it does; the tests feed both the same input. Above each group of instructions stands the line of C++
// that it implements.
//
// What a field costs are its multiplications: four of a point, seven of a segment (one takes as long as its second factor has bits:
// 9 to 38 cycles on the 386, 13 to 42 on the 486; 10 on the Pentium, in the U pipe alone), and three or six when a path is taken
// up. There is no division.

#include "asm.h"

// struct FromRoot and struct Along (src/surface/fields.h)
#define FROM_A       0
#define FROM_C       4
#define FROM_TWICE   8
#define FROM_Y       20
#define FROM_ALONG   24
#define ALONG_FROM   0
#define ALONG_KIND   4
#define ALONG_HALF   8
#define ALONG_B      12
#define ALONG_STEPY  16
#define ALONG_VALUE  20
#define ALONG_SLOPE  24
#define ALONG_T      28
#define ALONG_CHANGE 32
#define ALONG_K      36
#define ALONG_SIZE   68
#define KIND_SEGMENT 1

// struct Fields
#define FIELDS_SUM   0
#define FIELDS_SLOPE 4
#define FIELDS_STRONGEST 8
#define FIELDS_TOUCHED 12

// struct FieldStep (include/model/field.h)
#define STEP_VALUE   0
#define STEP_SLOPE   4

        .text

// eax = eax * factor, as Real; edx is spare
.macro times factor
        imull        \factor
        shrdl        $16, %edx, %eax
.endm

// to = the vector at ebx times the one at `vector` of what esi points to, over 16; ecx, eax and edx are spare
.macro product16 vector, to
        movl        (%ebx), %eax
        times        \vector(%esi)
        movl        %eax, %ecx
        movl        4(%ebx), %eax
        times        \vector+4(%esi)
        addl        %eax, %ecx
        movl        8(%ebx), %eax
        times        \vector+8(%esi)
        addl        %eax, %ecx
        sarl        $4, %ecx
        movl        %ecx, \to
.endm

// void addFieldsA(Along* first, Along* end, Real position, const Vector* path, Fields* fields). edi is the field at hand, ebp the
// position.
#define ADD_FRAME    16
#define ADD_FIRST    (ADD_FRAME+4)
#define ADD_END      (ADD_FRAME+8)
#define ADD_POSITION (ADD_FRAME+12)
#define ADD_PATH     (ADD_FRAME+16)
#define ADD_FIELDS   (ADD_FRAME+20)
FUNC(addFieldsA)
        pushl        %ebp
        pushl        %ebx
        pushl        %esi
        pushl        %edi
        movl        ADD_FIRST(%esp), %edi
        movl        ADD_POSITION(%esp), %ebp
        jmp        add_next

add_one:
        // if (kind != OTHER)
        cmpl        $KIND_SEGMENT, ALONG_KIND(%edi)
        ja        add_other
        movl        ALONG_FROM(%edi), %esi
        // if (path != nullptr) b = dot(path, from->twice16) >> 4; of a segment stepY = dot(path, from->along16) >> 4
        movl        ADD_PATH(%esp), %ebx
        testl        %ebx, %ebx
        jz        add_aimed
        product16 FROM_TWICE, ALONG_B(%edi)
        cmpl        $KIND_SEGMENT, ALONG_KIND(%edi)
        jne        add_aimed
        product16 FROM_ALONG, ALONG_STEPY(%edi)
add_aimed:
        // outer = p * from->c; inner = b + outer; change = inner + outer
        movl        FROM_C(%esi), %eax
        times        %ebp
        movl        ALONG_B(%edi), %ecx
        addl        %eax, %ecx
        addl        %ecx, %eax
        movl        %eax, ALONG_CHANGE(%edi)
        // t = from->a + p * inner
        movl        %ecx, %eax
        times        %ebp
        addl        FROM_A(%esi), %eax
        cmpl        $KIND_SEGMENT, ALONG_KIND(%edi)
        je        add_segment
add_param:
        movl        %eax, ALONG_T(%edi)
add_known:
        // if (t >= 1) value = slope = 0; and what is below 0 is 0
        cmpl        $0xffff, %eax
        ja        add_outside
add_inside:
        // step = fieldSteps[t >> 8]; value = step.value + (step.slope * ((t & 255) - 128) >> 16); slope = step.slope
        movzbl        %al, %ecx
        shrl        $8, %eax
        addl        $-128, %ecx
        movl        SYM(fieldSteps)+STEP_SLOPE(,%eax,8), %ebx
        imull        %ebx, %ecx
        sarl        $16, %ecx
        addl        SYM(fieldSteps)+STEP_VALUE(,%eax,8), %ecx
        movl        %ebx, ALONG_SLOPE(%edi)
        movl        %ecx, ALONG_VALUE(%edi)
        // fields->sum += value; fields->slope += slope * change
        movl        ALONG_CHANGE(%edi), %eax
        movl        ADD_FIELDS(%esp), %esi
        times        %ebx
        addl        %ecx, FIELDS_SUM(%esi)
        addl        %eax, FIELDS_SLOPE(%esi)
        movl        $1, FIELDS_TOUCHED(%esi)
        // fields->strongest = most(fields->strongest, value)
        cmpl        FIELDS_STRONGEST(%esi), %ecx
        jle        add_done
        movl        %ecx, FIELDS_STRONGEST(%esi)
add_done:
        addl        $ALONG_SIZE, %edi
add_next:
        cmpl        ADD_END(%esp), %edi
        jb        add_one
        popl        %edi
        popl        %esi
        popl        %ebx
        popl        %ebp
        ret

add_segment:
        // y = from->y + p * stepY
        movl        %eax, %ecx
        movl        ALONG_STEPY(%edi), %eax
        times        %ebp
        addl        FROM_Y(%esi), %eax
        // k = clamp(y, -half, half)
        movl        ALONG_HALF(%edi), %edx
        movl        %eax, %ebx
        cmpl        %edx, %eax
        jg        add_beyond
        negl        %edx
        cmpl        %edx, %eax
        jge        add_beside
add_beyond:
        movl        %edx, %ebx
add_beside:
        movl        %ebx, ALONG_K(%edi)
        // t -= k * (y + y - k)
        addl        %eax, %eax
        subl        %ebx, %eax
        times        %ebx
        subl        %eax, %ecx
        // change -= k * (stepY + stepY)
        movl        ALONG_STEPY(%edi), %eax
        addl        %eax, %eax
        times        %ebx
        subl        %eax, ALONG_CHANGE(%edi)
        movl        %ecx, %eax
        jmp        add_param

add_other:
        movl        ALONG_T(%edi), %eax
        jmp        add_known
add_outside:
        testl        %eax, %eax
        movl        $0, %eax
        js        add_inside
        movl        %eax, ALONG_VALUE(%edi)
        movl        %eax, ALONG_SLOPE(%edi)
        jmp        add_done
ENDFUNC(addFieldsA)
ASM_END
