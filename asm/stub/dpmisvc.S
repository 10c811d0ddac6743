/* The services of the host: int 31h. Each service is one short routine; the comment above it lists the client's
   registers: In, Out.

   A service finds the client's registers in the frame at EBP (F_xxx); EAX, EBX, ECX, EDX still have the client's
   values; DS = ES = HOST_DS. It stores its results in the frame. If it returns with carry set, the client gets
   carry and the error code in AX. The memory services are in dpmimem.S. */

#include "dpmi.h"

        SECTION(.host)
        .code32

        .globl  entry_int31
entry_int31:
        pushl   (%esp)
        pushl   %gs
        pushl   %fs
        pushl   %es
        pushl   %ds
        pushal
        movl    %esp, %ebp
        movl    $HOST_DS, %esi
        movw    %si, %ds
        movw    %si, %es
        cld
        cmpb    $0, fault_pending
        jne     fault_now
        andb    $0xfe, F_EFL(%ebp)
        movzbl  %ah, %esi
        cmpl    $0x0e, %esi
        ja      1f
        cmpb    svc_tables(, %esi, 4), %al      /* number of services with this AH */
        jae     1f
        movzwl  svc_tables + 2(, %esi, 4), %esi
        movzbl  %al, %edi
        movzwl  (%esi, %edi, 2), %edi
        testl   %edi, %edi
        jz      1f
        call    *%edi
        jnc     exit_frame
        jmp     2f
1:      movw    $E_UNSUPPORTED, %ax
2:      movw    %ax, F_EAX(%ebp)
        orb     $1, F_EFL(%ebp)
        jmp     exit_frame

bad_value:
        movw    $E_VALUE, %ax
        stc
        ret
bad_selector:
        movw    $E_SELECTOR, %ax
        stc
        ret

/* --- Descriptors. --- */

/* Out: EDI = address of the LDT descriptor of selector BX; or carry and AX = 8022h if BX is not one of the client's
   selectors. */
        .globl  ldt_entry
ldt_entry:
        testb   $4, %bl
        jz      bad_selector
        movzwl  %bx, %edi
        andl    $0xfff8, %edi
        cmpl    $LDT_COUNT * 8, %edi
        jae     bad_selector
        addl    $ldt, %edi
        cmpb    $0, 5(%edi)             /* unused? this also clears carry */
        je      bad_selector
        ret

/* Sets the base of descriptor EDI to EDX. */
        .globl  set_base
set_base:
        pushl   %edx
        movw    %dx, 2(%edi)
        shrl    $16, %edx
        movb    %dl, 4(%edi)
        movb    %dh, 7(%edi)
        popl    %edx
        ret

/* Out: EAX = base of descriptor EDI. */
        .globl  get_base
get_base:
        movl    2(%edi), %eax
        shll    $8, %eax
        movb    7(%edi), %al
        rorl    $8, %eax
        ret

/* Sets the limit of descriptor EDI to EAX, in units of 4 KB from 1 MB on. EAX is lost. */
        .globl  set_limit
set_limit:
        andb    $0x70, 6(%edi)
        cmpl    $0x100000, %eax
        jb      1f
        shrl    $12, %eax
        orb     $0x80, 6(%edi)
1:      movw    %ax, (%edi)
        shrl    $16, %eax
        orb     %al, 6(%edi)
        ret

/* Allocates ECX consecutive descriptors for data with base 0 and limit 0. Out: EAX = first selector, EDI = address of
   its descriptor; or carry. */
        .globl  ldt_alloc
ldt_alloc:
        jecxz   bad_value
        movl    $ldt + LDT_FIRST * 8, %edi
1:      movl    %edi, %esi              /* are the ECX descriptors from here on free? */
        movl    %ecx, %edx
2:      cmpl    $ldt + LDT_COUNT * 8, %esi
        jae     4f
        cmpb    $0, 5(%esi)
        jne     3f
        addl    $8, %esi
        decl    %edx
        jnz     2b
        pushl   %edi
5:      movl    $0, (%edi)
        movl    $0x0000f200, 4(%edi)    /* present, ring 3, data, writeable */
        addl    $8, %edi
        loop    5b
        popl    %edi
        movl    %edi, %eax
        subl    $ldt - 7, %eax
        clc
        ret
3:      leal    8(%esi), %edi
        jmp     1b
4:      movw    $E_NO_DESCRIPTOR, %ax
        stc
        ret

/* Allocates a 64 KB data descriptor for real-mode segment EAX. Out: EAX = selector, EDI = address of the descriptor; or
   carry. */
        .globl  new_segment
new_segment:
        pushl   %eax
        movl    $1, %ecx
        call    ldt_alloc
        popl    %edx
        jc      1f
        movw    $0xffff, (%edi)
        shll    $4, %edx
        call    set_base
        clc
1:      ret

/* 0000h  allocate descriptors.  In: CX = number.  Out: AX = first selector. */
svc_0000:
        movzwl  %cx, %ecx
        call    ldt_alloc
        jc      1f
        movw    %ax, F_EAX(%ebp)
1:      ret

/* 0001h  free descriptor.  In: BX.  DS, ES, FS and GS become 0 if they hold it; a selector in CS or SS is refused. */
svc_0001:
        call    ldt_entry
        jc      2f
        cmpw    F_CS(%ebp), %bx
        je      bad_selector
        cmpw    F_SS(%ebp), %bx
        je      bad_selector
        xorl    %eax, %eax
        cmpw    shrunk, %bx
        jne     4f
        movw    %ax, shrunk
4:      movl    %eax, (%edi)
        movl    %eax, 4(%edi)
        movl    $4, %ecx
        leal    F_DS(%ebp), %edi
1:      cmpw    (%edi), %bx
        jne     3f
        movl    %eax, (%edi)
3:      addl    $4, %edi
        loop    1b
        clc
2:      ret

/* 0002h  selector for a real-mode segment.  In: BX = segment.  Out: AX, for the same segment always the same selector.
   The available bit of a descriptor marks those that were made here. */
svc_0002:
        movzwl  %bx, %eax
        shll    $4, %eax
        movl    %eax, %edx
        movl    $ldt + LDT_FIRST * 8, %edi
1:      testb   $0x10, 6(%edi)
        jz      2f
        call    get_base
        cmpl    %edx, %eax
        je      3f
2:      addl    $8, %edi
        cmpl    $ldt + LDT_COUNT * 8, %edi
        jb      1b
        movzwl  %bx, %eax
        call    new_segment
        jc      4f
        orb     $0x10, 6(%edi)
3:      movl    %edi, %eax
        subl    $ldt - 7, %eax
        movw    %ax, F_EAX(%ebp)
        clc
4:      ret

/* 0003h  selector increment.  Out: AX = 8. */
svc_0003:
        movw    $8, F_EAX(%ebp)
        ret                             /* carry is still clear */

/* 0006h  segment base.  In: BX.  Out: CX:DX. */
svc_0006:
        call    ldt_entry
        jc      1f
        call    get_base
        movw    %ax, F_EDX(%ebp)
        shrl    $16, %eax
        movw    %ax, F_ECX(%ebp)
        clc
1:      ret

/* 0007h  set base.  In: BX, CX:DX. */
svc_0007:
        call    ldt_entry
        jc      1f
        shll    $16, %ecx
        movw    %dx, %cx
        movl    %ecx, %edx
        call    set_base
        clc
1:      ret

/* 0008h  set limit.  In: BX, CX:DX; from 1 MB on the low 12 bits must be ones. */
svc_0008:
        call    ldt_entry
        jc      1f
        shll    $16, %ecx
        movw    %dx, %cx
        cmpl    $0x100000, %ecx
        jb      2f
        notl    %edx
        testl   $0x0fff, %edx
        jnz     bad_value
2:      cmpw    shrunk, %bx             /* the limit of the shrunk segment changes */
        jne     3f
        movw    $0, shrunk
3:      movzwl  %bx, %eax
        lsll    %eax, %eax
        cmpl    $0x0fff, %eax           /* from more than a page to less: see exit_frame */
        jbe     4f
        cmpl    $0x0fff, %ecx
        ja      4f
        movw    %bx, shrunk
4:      movl    %ecx, %eax
        call    set_limit
        clc
1:      ret

/* Checks that access byte CL is that of a code or data segment of ring 3. Out: carry and AX = 8021h if not. */
check_rights:
        movb    %cl, %al
        andb    $0x70, %al
        cmpb    $0x70, %al
        jne     bad_value
        testb   $0x08, %cl              /* refuse conforming code, which would run in ring 3 but is of no use */
        jz      1f
        testb   $0x04, %cl
        jnz     bad_value
1:      clc
        ret

/* 0009h  set access rights.  In: BX, CL = access byte, CH bits 4, 6, 7 = available, 32 bit, 4 KB units. */
svc_0009:
        call    ldt_entry
        jc      1f
        call    check_rights
        jc      1f
        movb    %cl, 5(%edi)
        andb    $0xd0, %ch
        andb    $0x0f, 6(%edi)
        orb     %ch, 6(%edi)
        clc
1:      ret

/* 000Ah  data alias of a segment.  In: BX.  Out: AX. */
svc_000a:
        call    ldt_entry
        jc      1f
        pushl   %edi
        movl    $1, %ecx
        call    ldt_alloc
        popl    %esi
        jc      1f
        movw    %ax, F_EAX(%ebp)
        movsl
        lodsl
        andl    $0xffeff0ff, %eax       /* the alias is always writeable data */
        orl     $0x0000f200, %eax
        stosl
        clc
1:      ret

/* 000Bh  get descriptor.  In: BX, ES:EDI = 8 bytes. */
svc_000b:
        call    ldt_entry
        jc      1f
        movl    %edi, %esi
        movl    F_EDI(%ebp), %edi
        movw    F_ES(%ebp), %es
        movsl
        movsl
        clc
1:      ret

/* 000Ch  set descriptor.  In: BX, ES:EDI = 8 bytes. */
svc_000c:
        call    ldt_entry
        jc      1f
        movl    F_EDI(%ebp), %esi
        movw    F_ES(%ebp), %es
        movb    %es:5(%esi), %cl
        call    check_rights
        jc      1f
        movl    %es:(%esi), %eax
        movl    %es:4(%esi), %edx
        movl    %eax, (%edi)
        movl    %edx, 4(%edi)
        clc
1:      ret

/* 000Dh  allocate one of the first 16 descriptors.  In: BX. */
svc_000d:
        movl    %ebx, %eax
        andb    $7, %al
        cmpb    $7, %al
        jne     bad_selector
        movzwl  %bx, %edi
        cmpl    $LDT_FIRST * 8, %edi
        jae     bad_selector
        addl    $ldt - 7, %edi
        cmpb    $0, 5(%edi)
        jne     1f
        movl    $0, (%edi)
        movl    $0x0000f200, 4(%edi)
        clc
        ret
1:      movw    $E_NO_DESCRIPTOR, %ax
        stc
        ret

/* --- DOS memory. Errors: AX = DOS error code, BX = largest block in paragraphs. --- */

/* 0100h  allocate.  In: BX = paragraphs.  Out: AX = segment, DX = selector. */
svc_0100:
        movl    $0x4800, rmregs + R_EAX
        movl    %ebx, rmregs + R_EBX
        call    dos_call
        jc      dos_error
        movzwl  rmregs + R_EAX, %eax
        movw    %ax, F_EAX(%ebp)
        call    new_segment
        jc      1f
        movw    %ax, F_EDX(%ebp)
        movzwl  F_EBX(%ebp), %eax
        jmp     dos_limit
1:      pushl   %eax
        movw    F_EAX(%ebp), %ax        /* no descriptor: free the block again */
        call    dos_free
        popl    %eax
        stc
        ret

/* Sets the limit of descriptor EDI for a block of EAX paragraphs. */
dos_limit:
        shll    $4, %eax
        jz      1f
        decl    %eax
1:      call    set_limit
        clc
        ret

dos_error:
        movw    rmregs + R_EBX, %ax
        movw    %ax, F_EBX(%ebp)
        movw    rmregs + R_EAX, %ax
        stc
        ret

/* Frees the DOS memory block at segment AX (int 21h AH=49h). Out: the carry of DOS. */
dos_free:
        pushl   %eax
        movw    host_seg, %ax
        movw    %ax, rmregs + R_DS
        movw    $2, rmregs + R_FLAGS
        movl    $0, rmregs + R_SP
        popl    %eax
        movw    %ax, rmregs + R_ES
        movl    $0x4900, rmregs + R_EAX
        jmp     dos_int

/* Calls int 21h with rmregs. Out: the carry of DOS. */
dos_int:
        movl    $0x21, %eax
        call    rm_int
        btw     $0, rmregs + R_FLAGS
        ret

/* Out: EDI = address of the descriptor of DX, EAX = its real-mode segment; or carry and AX = 8022h if it is not a segment
   of the first MB. */
dos_segment:
        movl    %edx, %ebx
        call    ldt_entry
        jc      1f
        call    get_base
        testl   $0xfff0000f, %eax
        jnz     bad_selector
        shrl    $4, %eax
        clc
1:      ret

/* 0101h  free.  In: DX = selector. */
svc_0101:
        call    dos_segment
        jc      1f
        call    dos_free
        jc      dos_error
        movw    F_EDX(%ebp), %bx
        jmp     svc_0001
1:      ret

/* 0102h  resize.  In: DX = selector, BX = paragraphs. */
svc_0102:
        call    dos_segment
        jc      1f
        pushl   %edi
        movw    %ax, rmregs + R_ES
        movw    $2, rmregs + R_FLAGS
        movl    $0, rmregs + R_SP
        movl    $0x4a00, rmregs + R_EAX
        movl    F_EBX(%ebp), %eax
        movl    %eax, rmregs + R_EBX
        call    dos_int
        popl    %edi
        jc      dos_error
        movzwl  F_EBX(%ebp), %eax
        jmp     dos_limit
1:      ret

/* --- Interrupt and exception vectors. --- */

/* 0200h  real-mode vector.  In: BL.  Out: CX:DX. */
svc_0200:
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movzbl  %bl, %ebx
        movl    %fs:(, %ebx, 4), %eax
        movw    %ax, F_EDX(%ebp)
        shrl    $16, %eax
        movw    %ax, F_ECX(%ebp)
        clc
        ret

/* 0201h  set real-mode vector.  In: BL, CX:DX. */
svc_0201:
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movzbl  %bl, %ebx
        movw    %dx, %fs:(, %ebx, 4)
        movw    %cx, %fs:2(, %ebx, 4)
        clc
        ret

/* 0202h  exception handler.  In: BL = 0 to 1Fh.  Out: CX:EDX; the host's default handler is an entry of the HLT table. */
svc_0202:
        movzbl  %bl, %ebx
        cmpl    $32, %ebx
        jae     bad_value
        movl    exc_vec(, %ebx, 8), %edx
        movzwl  exc_vec + 4(, %ebx, 8), %ecx
        testl   %ecx, %ecx
        jnz     1f
        movl    %ebx, %edx
        movl    $USER_CS, %ecx
1:      movl    %edx, F_EDX(%ebp)
        movw    %cx, F_ECX(%ebp)
        clc
        ret

/* 0203h  set exception handler.  In: BL, CX:EDX. */
svc_0203:
        movzbl  %bl, %ebx
        cmpl    $32, %ebx
        jae     bad_value
        call    check_code
        jc      2f
        cmpw    $USER_CS, %cx
        jne     1f
        xorl    %ecx, %ecx              /* back to the default handler */
1:      movl    %edx, exc_vec(, %ebx, 8)
        movw    %cx, exc_vec + 4(, %ebx, 8)
        clc
2:      ret

/* Checks that CX is a code selector of the client. Out: carry and AX = 8022h if not. EAX, ESI are lost. */
check_code:
        testb   $3, %cl
        jz      bad_selector
        movzwl  %cx, %esi
        larl    %esi, %eax
        jnz     bad_selector
        andl    $0x9800, %eax
        cmpl    $0x9800, %eax
        jne     bad_selector
        clc
        ret

/* 0204h  protected-mode vector.  In: BL.  Out: CX:EDX. */
svc_0204:
        movzbl  %bl, %ebx
        movl    pm_vec(, %ebx, 8), %edx
        movl    %edx, F_EDX(%ebp)
        movw    pm_vec + 4(, %ebx, 8), %cx
        movw    %cx, F_ECX(%ebp)
        clc
        ret

/* 0205h  set protected-mode vector.  In: BL, CX:EDX.  For hardware interrupts, 1Ch, 23h and 24h the handler is also
   called for interrupts in RM. For other software interrupts the IDT leads directly to the handler. 31h cannot be set. */
svc_0205:
        movzbl  %bl, %ebx
        cmpl    $0x31, %ebx
        je      bad_value
        call    check_code
        jc      9f
        movl    %edx, pm_vec(, %ebx, 8)
        movw    %cx, pm_vec + 4(, %ebx, 8)
        movl    $HOOKS - 1, %esi
1:      cmpb    hook_vec(%esi), %bl
        je      2f
        decl    %esi
        jns     1b
        jmp     5f
2:      movw    $FLAT_DS, %ax
        movw    %ax, %fs
        leal    (%esi, %esi, 4), %eax
        addl    $up_stubs + CALLBACKS * 5, %eax
        movl    host_seg, %edi
        shll    $16, %edi
        addl    %edi, %eax              /* the RM address that leads to the handler */
        cmpw    $USER_CS, %cx
        je      3f
        cmpl    %fs:(, %ebx, 4), %eax
        je      5f
        xchgl   %fs:(, %ebx, 4), %eax
        movl    %eax, hook_old(, %esi, 4)
        jmp     5f
3:      cmpl    %fs:(, %ebx, 4), %eax   /* default handler: unhook, unless others have hooked the vector after us */
        jne     5f
        movl    hook_old(, %esi, 4), %eax
        movl    %eax, %fs:(, %ebx, 4)
5:      cmpl    $0x10, %ebx             /* 0 to 0Fh, 70h to 77h: the gates always lead to the host */
        jb      8f
        cmpl    $0x70, %ebx
        jb      6f
        cmpl    $0x78, %ebx
        jb      8f
6:      movl    $HOST_CS, %eax
        leal    thunks(, %ebx, 8), %edi
        movl    $0xee00, %esi           /* interrupt gate */
        cmpw    $USER_CS, %cx
        je      7f
        movl    %ecx, %eax
        movl    %edx, %edi
        movl    $0xef00, %esi           /* trap gate: a software interrupt does not change IF */
7:      movw    %di, idt(, %ebx, 8)
        movw    %ax, idt + 2(, %ebx, 8)
        movw    %si, %di
        movl    %edi, idt + 4(, %ebx, 8)
8:      clc
9:      ret

/* --- Real-mode code. --- */

/* 0300h  simulate interrupt.  In: BL = number, CX = words to copy from the stack, ES:EDI = registers. */
svc_0300:
        pushl   %ebx
        call    client_to_rmregs
        popl    %eax
        movzbl  %al, %eax
        movw    $FLAT_DS, %dx
        movw    %dx, %fs
        movl    %fs:(, %eax, 4), %eax
        call    client_stack_keep
        movzwl  F_ECX(%ebp), %ecx
        movb    $1, %bl
        call    rm_call
        call    rmregs_to_client
        clc
        ret

client_stack_keep:                      /* as client_stack, but keeps EAX */
        pushl   %eax
        call    client_stack
        popl    %eax
        ret

/* 0301h  call with far return.  In: CX = words to copy, ES:EDI = registers, which contain CS:IP. */
svc_0301:
        xorl    %ebx, %ebx
        jmp     1f

/* 0302h  call with IRET.  In: as 0301h. */
svc_0302:
        movl    $1, %ebx
1:      call    client_to_rmregs
        movl    rmregs + R_IP, %eax
        call    client_stack_keep
        movzwl  F_ECX(%ebp), %ecx
        call    rm_call
        call    rmregs_to_client
        clc
        ret

/* 0303h  allocate call-back.  In: DS:ESI = procedure, ES:EDI = registers.  Out: CX:DX = RM address. */
svc_0303:
        xorl    %ebx, %ebx
        movl    $callbacks, %edi
1:      cmpw    $0, 4(%edi)
        je      2f
        addl    $16, %edi
        incl    %ebx
        cmpl    $CALLBACKS, %ebx
        jb      1b
        movw    $E_NO_CALLBACK, %ax
        stc
        ret
2:      movl    F_DS(%ebp), %ecx
        call    check_code
        jc      3f
        movl    F_ESI(%ebp), %eax
        movl    %eax, (%edi)
        movl    %ecx, 4(%edi)
        movl    F_EDI(%ebp), %eax
        movl    %eax, 8(%edi)
        movl    F_ES(%ebp), %eax
        movl    %eax, 12(%edi)
        movw    host_seg, %ax
        movw    %ax, F_ECX(%ebp)
        leal    up_stubs(%ebx, %ebx, 4), %eax
        movw    %ax, F_EDX(%ebp)
        movb    $1, callbacks_used
        clc
3:      ret

/* 0304h  free call-back.  In: CX:DX. */
svc_0304:
        cmpw    host_seg, %cx
        jne     1f
        movzwl  %dx, %eax
        subl    $up_stubs, %eax
        jb      1f
        xorl    %edx, %edx
        movl    $5, %ecx
        divl    %ecx
        testl   %edx, %edx
        jnz     1f
        cmpl    $CALLBACKS, %eax
        jae     1f
        shll    $4, %eax
        cmpw    $0, callbacks + 4(%eax)
        je      1f
        movw    $0, callbacks + 4(%eax)
        clc
        ret
1:      movw    $E_CALLBACK, %ax
        stc
        ret

/* 0305h  save/restore state addresses.  Out: AX = size, 0 bytes; BX:CX in RM, SI:EDI in PM: both routines only return. */
svc_0305:
        movw    $0, F_EAX(%ebp)
        movl    $HLT_STATE, F_EDI(%ebp)
        movl    $rm_state, %eax
        jmp     1f

/* 0306h  raw mode switch addresses.  Out: BX:CX from RM to PM, SI:EDI from PM to RM. */
svc_0306:
        movl    $HLT_RAWSW, F_EDI(%ebp)
        movl    $up_stubs + (CALLBACKS + HOOKS) * 5, %eax
1:      movw    %ax, F_ECX(%ebp)
        movw    host_seg, %ax
        movw    %ax, F_EBX(%ebp)
        movw    $USER_CS, F_ESI(%ebp)
        clc
        ret

/* 0400h  version.  Out: AX = 0.90, BX = bit 0: 32-bit host, bit 1: interrupts are reflected to real mode, not to V86 mode;
   CL = processor, DH, DL = interrupt bases of the slave and master controller. */
svc_0400:
        movw    $0x005a, F_EAX(%ebp)
        movzwl  version_flags, %eax
        movw    %ax, F_EBX(%ebp)
        movb    cpu_type, %al
        movb    %al, F_ECX(%ebp)
        movw    $0x7008, F_EDX(%ebp)
        clc
        ret

/* 0600h, 0601h  lock, unlock linear memory; 0602h, 0603h pageable RM memory; 0702h, 0703h paging advice;
   0801h unmap physical memory. There is nothing to do, because nothing is ever paged. */
svc_nothing:
        ret                             /* carry is still clear */

/* 0604h  page size.  Out: BX:CX = 4096. */
svc_0604:
        movw    $0, F_EBX(%ebp)
        movw    $4096, F_ECX(%ebp)
        clc
        ret

/* 0900h  disable interrupts.  Out: AL = 1 if they were enabled. */
svc_0900:
        call    svc_0902
        andb    $~(IF_BIT >> 8), F_EFL + 1(%ebp)
        clc
        ret

/* 0901h  enable interrupts.  Out: AL = 1 if they were enabled. */
svc_0901:
        call    svc_0902
        orb     $IF_BIT >> 8, F_EFL + 1(%ebp)
        clc
        ret

/* 0902h  interrupt state.  Out: AL = 1 if they are enabled. */
svc_0902:
        movl    F_EFL(%ebp), %eax
        shrl    $9, %eax
        andb    $1, %al
        movb    %al, F_EAX(%ebp)
        clc
        ret

/* 0E00h  coprocessor state.  Out: AX bits 0, 1 = MP, EM of the client, 2, 3 = MP, EM of the host, 4 to 7 = type. */
svc_0e00:
        movl    %cr0, %eax
        shrl    $1, %eax
        andl    $3, %eax                /* host and client share MP and EM */
        leal    (%eax, %eax, 4), %eax
        orb     fpu_type, %al
        movw    %ax, F_EAX(%ebp)
        clc
        ret

/* 0E01h  set emulation.  In: BX bit 0 = MP, bit 1 = EM. */
svc_0e01:
        andl    $3, %ebx
        shll    $1, %ebx
        movl    %cr0, %eax
        andl    $~6, %eax
        orl     %ebx, %eax
        movl    %eax, %cr0
        clc
        ret

/* --- Tables: for each AH the number of services and the address of a table of their routines; 0: no such service. --- */
        .balign 4
        .macro  SVCS table
        .word   (\table\()_end - \table) / 2, \table
        .endm
svc_tables:
        SVCS    svc_00
        SVCS    svc_01
        SVCS    svc_02
        SVCS    svc_03
        SVCS    svc_04
        SVCS    svc_05
        SVCS    svc_06
        SVCS    svc_07
        SVCS    svc_08
        SVCS    svc_09
        .word   0, 0, 0, 0, 0, 0, 0, 0  /* 0A00h to 0DFFh */
        SVCS    svc_0e

svc_00: .word   svc_0000, svc_0001, svc_0002, svc_0003, 0, 0, svc_0006, svc_0007
        .word   svc_0008, svc_0009, svc_000a, svc_000b, svc_000c, svc_000d
svc_00_end:
svc_01: .word   svc_0100, svc_0101, svc_0102
svc_01_end:
svc_02: .word   svc_0200, svc_0201, svc_0202, svc_0203, svc_0204, svc_0205
svc_02_end:
svc_03: .word   svc_0300, svc_0301, svc_0302, svc_0303, svc_0304, svc_0305, svc_0306
svc_03_end:
svc_04: .word   svc_0400
svc_04_end:
svc_05: .word   svc_0500, svc_0501, svc_0502, svc_0503, 0, 0, 0, svc_0507
svc_05_end:
svc_06: .word   svc_nothing, svc_nothing, svc_nothing, svc_nothing, svc_0604
svc_06_end:
svc_07: .word   0, 0, svc_nothing, svc_nothing
svc_07_end:
svc_08: .word   svc_0800, svc_nothing
svc_08_end:
svc_09: .word   svc_0900, svc_0901, svc_0902
svc_09_end:
svc_0e: .word   svc_0e00, svc_0e01
svc_0e_end:

        ASM_END
