/* The mode switches of the host: all ways between protected mode (PM) and real or V86 mode (RM).

   There are two one-way switches, both made with interrupts disabled:

     pm_to_rm   saves ESP in r0_cur, switches to RM and loads the whole register set `rmregs` there, with
                SS:SP from rm_spss; POPF and a far return from that stack then lead to the RM code.
     rm_save    stores the RM register set in `rmregs`, switches to PM, loads ESP from r0_cur and jumps to
                pm_cont.

   A call of RM code from PM (rm_call) uses the first switch with `rm_return` as return address, then the
   second switch with a plain RET as continuation. A call of PM code from RM (call-backs, hooked interrupts:
   rm_up) uses the second switch, and at its end the first one. Such calls nest: a switch to RM leaves r0_cur
   at the top of the used part of the ring 0 stack; a call of PM code continues below it and moves the TSS's
   ESP0 there, so that interrupts of the client cannot overwrite the used part. `rmregs` is in use only while
   interrupts are disabled, so a single copy is enough.

   Plain real mode and VCPI set and clear PE in different ways: two jump vectors are set at the start. */

#include "dpmi.h"

        SECTION(.host)

/* --- PM to RM. In: rmregs, rm_spss; FLAGS, IP, CS on that stack; DS = HOST_DS. It is called (rm_return then returns
       to the caller) or jumped to. --- */
        .code32
        .globl  pm_to_rm
pm_to_rm:
        movl    %esp, r0_cur
        jmp     *pm_to_rm_vec

        .globl  raw_pm_to_rm
raw_pm_to_rm:
        ljmp    $HOST_CS16, $1f
        .code16
1:      movw    $HOST_DS16, %ax         /* RM keeps the limits, which must be 64 KB, and the stack size of 16 bits */
        movw    %ax, %ss
        movw    %ax, %ds
        movw    %ax, %es
        movw    %ax, %fs
        movw    %ax, %gs
        lidtl   rm_idtr
        movl    %cr0, %eax
        andl    $0x7fffffff, %eax       /* paging off first; here linear addresses equal physical ones */
        movl    %eax, %cr0
        jmp     2f
2:      andb    $0xfe, %al
        movl    %eax, %cr0
        ljmpw   *rm_go                  /* also empties the prefetch queue */

        .globl  rm_load
rm_load:
        lssw    %cs:rmregs_ptr, %sp
        popal
        leaw    2(%esp), %sp            /* skip the flags: POPF takes them from the stack at rm_spss */
        popw    %es
        popw    %ds
        popw    %fs
        popw    %gs
        lssw    %cs:rm_spss, %sp
        popfw
        lretw

/* A shorter switch to RM and back for a hardware interrupt (rm_irq_call): no registers are passed. */
rm_irq:
        movw    $rm_load, %cs:rm_go
        lssw    %cs:rm_spss, %sp
        pushfw
        lcallw  *%cs:irq_target
        cli
        movw    $pm_return, %cs:pm_cont
        jmp     rm_to_pm

/* --- RM to PM. --- */

/* RM code that was called from PM returns here. */
        .globl  rm_return
rm_return:
        pushfw
        cli
        popw    %cs:rmregs + R_FLAGS
        movw    $pm_return, %cs:pm_cont
        jmp     rm_save

/* Entry points in RM that lead to PM: 16 call-backs, then the hooked interrupts, the raw mode switch, Ctrl-C. Each
   pushes its number. */
        .globl  up_stubs
up_stubs:
        .set    i, 0
        .rept   CALLBACKS + HOOKS + 2
        .byte   0x6a, i                 /* PUSH i */
        .byte   0xe9                    /* JMP rm_up */
        .word   rm_up - . - 2
        .set    i, i + 1
        .endr

rm_up:
        pushfw
        cli
        popw    %cs:rmregs + R_FLAGS
        popw    %cs:up_num
        movw    %sp, %cs:up_spss
        movw    %ss, %cs:up_spss + 2
        movw    $pm_up, %cs:pm_cont

rm_save:
        lssw    %cs:rmregs_gs_ptr, %sp
        pushw   %gs
        pushw   %fs
        pushw   %ds
        pushw   %es
        leaw    -2(%esp), %sp
        pushal

        .globl  rm_to_pm
rm_to_pm:
        jmp     *%cs:rm_to_pm_vec

        .globl  raw_rm_to_pm
raw_rm_to_pm:
        lgdtl   %cs:gdtr
        lidtl   %cs:idtr
        movl    %cs:switch_table, %eax
        movl    %eax, %cr3
        movl    %cr0, %eax
        orl     $0x80000001, %eax
        movl    %eax, %cr0
        ljmpl   $HOST_CS, $pm_arrive

/* RM to PM under VCPI, int 67h AX=DE0Ch. ESI = linear address of the table of registers to load. */
        .globl  vcpi_rm_to_pm
vcpi_rm_to_pm:
        lssw    %cs:switch_stack_ptr, %sp
        movl    %cs:switch_table_linear, %esi
        movw    $0xde0c, %ax
        int     $0x67

        .code32
        .globl  pm_arrive
pm_arrive:
        movw    $HOST_DS, %ax
        movw    %ax, %ss
        movw    %ax, %ds
        movw    %ax, %es
        movl    r0_cur, %esp
        andb    $0xfd, gdt + TSS_SEL + 5 /* clear the busy bit, else LTR faults */
        movw    $TSS_SEL, %ax
        ltr     %ax
        movw    $LDT_SEL, %ax
        lldt    %ax
        pushl   $2                      /* NT would make the next IRET a task switch */
        popfl
        jmp     *pm_cont

pm_return:
        ret

/* PM to RM under VCPI: a far call of the server with the V86 registers on the stack. */
        .globl  vcpi_pm_to_rm
vcpi_pm_to_rm:
        movzwl  host_seg, %eax
        pushl   %eax                    /* GS */
        pushl   %eax                    /* FS */
        pushl   %eax                    /* DS */
        pushl   %eax                    /* ES */
        pushl   %eax                    /* SS */
        pushl   $switch_stack_top       /* ESP */
        pushl   $IOPL3 | 2              /* EFLAGS */
        pushl   %eax                    /* CS */
        movzwl  rm_go, %eax
        pushl   %eax                    /* EIP */
        movw    $FLAT_DS, %ax
        movw    %ax, %ds
        movl    $0xde0c, %eax
        lcall   *%ss:vcpi_entry

/* --- Calls RM code from PM.
       In:  rmregs (SS:SP = 0: use the host's stack), EAX = target CS:IP,
            BL = 1: the target returns with IRET, as from an interrupt; 0: with a far return,
            ECX = words to copy from ES:ESI to the RM stack.
       Out: rmregs. EBP is kept, all other registers are lost; DS = ES = HOST_DS. --- */
        .globl  rm_call
rm_call:
        movw    $FLAT_DS, %dx
        movw    %dx, %fs
        movl    rmregs + R_SP, %edx
        testl   %edx, %edx
        jnz     1f
        movl    rm_stack_cur, %edx
1:      movzwl  %dx, %edi
        shrl    $16, %edx
        movw    %dx, rm_spss + 2
        shll    $4, %edx                /* linear address of the stack segment */
        pushl   %ebp
        jecxz   3f
        leal    (%ecx, %ecx), %ebp      /* copy the words, the last one first */
        addl    %ebp, %esi
2:      subl    $2, %esi
        subw    $2, %di
        movw    %es:(%esi), %bp
        movw    %bp, %fs:(%edx, %edi)
        loop    2b
3:      movw    rmregs + R_FLAGS, %cx
        andw    $0x0ed5, %cx            /* clear TF, NT, IOPL */
        orw     $0x0002, %cx
        testb   $1, %bl
        jz      4f
        subw    $2, %di
        movw    %cx, %fs:(%edx, %edi)
        andw    $~IF_BIT, %cx
4:      subw    $10, %di
        movw    %cx, %fs:(%edx, %edi)
        movl    %eax, %fs:2(%edx, %edi)
        movl    rm_return_ptr, %eax
        movl    %eax, %fs:6(%edx, %edi)
        movw    %di, rm_spss
        subw    $RM_CHUNK, rm_stack_cur
        cmpw    $rm_stack + RM_CHUNK, rm_stack_cur
        jb      fatal_nesting
        call    pm_to_rm
        addw    $RM_CHUNK, rm_stack_cur
        popl    %ebp
        ret

/* Calls the RM handler of hardware interrupt EAX, a vector that the client has not hooked. All registers except ESP
   are lost; DS = ES = HOST_DS. */
        .globl  rm_irq_call
rm_irq_call:
        movw    $FLAT_DS, %dx
        movw    %dx, %fs
        movl    %fs:(, %eax, 4), %eax
        movl    %eax, irq_target
        movl    rm_stack_cur, %eax
        movl    %eax, rm_spss
        movw    $rm_irq, rm_go
        subw    $RM_CHUNK, rm_stack_cur
        cmpw    $rm_stack + RM_CHUNK, rm_stack_cur
        jb      fatal_nesting
        call    pm_to_rm
        addw    $RM_CHUNK, rm_stack_cur
        ret

/* Calls RM interrupt EAX with rmregs; registers are lost and kept as in rm_call. If the vector leads to one of our
   own hooks, the handler before the hook is called. An int 23h of the client itself does not end it: that is for Ctrl-C
   which DOS reports. */
        .globl  rm_int
rm_int:
        movw    $FLAT_DS, %dx
        movw    %dx, %fs
        movl    %fs:(, %eax, 4), %eax
        movl    %eax, %edx
        shrl    $16, %edx
        cmpw    host_seg, %dx
        je      2f
1:      movb    $1, %bl
        xorl    %ecx, %ecx
        jmp     rm_call
2:      cmpw    $rm_int23, %ax
        je      3f
        movzwl  %ax, %edx
        subl    $up_stubs + CALLBACKS * 5, %edx
        jb      1b
        cmpl    $HOOKS * 5, %edx
        jae     1b
        movl    %edx, %eax
        xorl    %edx, %edx
        movl    $5, %ecx
        divl    %ecx
        movl    hook_old(, %eax, 4), %eax
        jmp     1b
3:      movl    %fs:(0x24 * 4), %eax
        jmp     1b

/* Calls int 21h for the host itself. In: EAX, EBX, EDX in rmregs. Out: the carry of DOS. */
        .globl  dos_call
dos_call:
        movw    host_seg, %ax
        movw    %ax, rmregs + R_DS
        movw    %ax, rmregs + R_ES
        movw    $2, rmregs + R_FLAGS
        movl    $0, rmregs + R_SP
        movl    $0x21, %eax
        call    rm_int
        btw     $0, rmregs + R_FLAGS
        ret

/* --- PM code called from RM. In: ESP = r0_cur, rmregs = the RM registers, up_spss = SS:SP of the RM code. --- */
pm_up:
        cmpl    $r0_stack + 512, %esp
        jb      fatal_nesting
        movzwl  up_num, %eax
        subl    $CALLBACKS, %eax
        jb      callback
        cmpl    $HOOKS, %eax
        je      raw_to_pm
        ja      ctrl_c

/* A hooked interrupt. The ring 0 stack keeps the segment registers and SS:SP of the RM code; the general registers
   are passed to the handler and back, so that it can return results in them (int 24h does so in AL). */
        movzbl  hook_vec(%eax), %eax
        pushl   rmregs + R_FS
        pushl   rmregs + R_ES
        pushl   up_spss
        call    lock_stack_enter        /* EDX: stack pointer for the handler */
        movl    $HLT_UPRET, lock_stack - 12(%edx)
        movl    $USER_CS, lock_stack - 8(%edx)
        movl    $IOPL3 | 2, lock_stack - 4(%edx)
        subl    $12, %edx
        pushl   $LOCK_SS
        pushl   %edx
        pushl   $IOPL3 | 2
        movzwl  pm_vec + 4(, %eax, 8), %ecx
        pushl   %ecx
        pushl   pm_vec(, %eax, 8)
        movl    rmregs + R_EDI, %edi
        movl    rmregs + R_ESI, %esi
        movl    rmregs + R_EBP, %ebp
        movl    rmregs + R_EBX, %ebx
        movl    rmregs + R_EDX, %edx
        movl    rmregs + R_ECX, %ecx
        xorl    %eax, %eax
        movw    %ax, %es
        movw    %ax, %fs
        movw    %ax, %gs
        movl    rmregs + R_EAX, %eax
        pushl   $0
        popl    %ds
        iretl

/* Pushes the old lock_cur and the old ESP0 for lock_stack_leave, allocates a piece of the locked stack, and makes
   interrupts use the ring 0 stack below ESP. Out: EDX = offset in the locked stack. ECX is lost. */
lock_stack_enter:
        popl    %ecx
        movl    lock_cur, %edx
        pushl   %edx
        subl    $LOCK_CHUNK, lock_cur
        js      fatal_nesting
        pushl   tss + 4
        movl    %esp, tss + 4
        jmp     *%ecx

/* Undoes lock_stack_enter; the ring 0 stack is then where it was when lock_stack_enter was called. */
lock_stack_leave:
        popl    %ecx
        movl    tss + 4, %esp
        popl    tss + 4
        popl    lock_cur
        jmp     *%ecx

/* The handler's IRET led to HLT_UPRET. EBP = frame. */
        .globl  hlt_upret
hlt_upret:
        call    frame_to_rmregs
        call    lock_stack_leave
        popl    rm_spss
        popl    rmregs + R_ES
        popl    rmregs + R_FS
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movzwl  rm_spss, %edi
        movzwl  rm_spss + 2, %edx
        shll    $4, %edx
        addl    %edx, %edi
        movl    %fs:(%edi), %eax        /* reorder IP, CS, FLAGS (for IRET) to FLAGS, IP, CS (for pm_to_rm) */
        movw    %fs:4(%edi), %cx
        movw    %cx, %fs:(%edi)
        movl    %eax, %fs:2(%edi)
        jmp     pm_to_rm

/* Call-back number EAX + CALLBACKS. The client's procedure gets DS:ESI = SS:SP of the RM code, and ES:EDI = its own
   register structure, filled with the RM registers. */
callback:
        leal    CALLBACKS(%eax), %eax
        movl    %eax, %ebx
        shll    $4, %ebx                /* 16 bytes each */
        addl    $callbacks, %ebx
        leal    CB_SEL(, %eax, 8), %ebp /* its selector for the RM stack */
        movzwl  up_spss + 2, %edx
        shll    $4, %edx
        leal    gdt - 3(%ebp), %edi
        call    set_base
        movw    12(%ebx), %es           /* if it was freed this faults, while tss + 4 still leads to the client's frame */
        call    lock_stack_enter
        movl    $HLT_CBRET, lock_stack - 12(%edx)
        movl    $USER_CS, lock_stack - 8(%edx)
        movl    $IOPL3 | 2, lock_stack - 4(%edx)
        subl    $12, %edx
        pushl   $LOCK_SS
        pushl   %edx
        pushl   $IOPL3 | 2
        movzwl  4(%ebx), %ecx
        pushl   %ecx
        pushl   0(%ebx)
        movl    up_spss, %eax
        movl    %eax, rmregs + R_SP
        movl    8(%ebx), %edi
        movl    $rmregs, %esi
        movl    $R_SIZE / 2, %ecx
        rep movsw
        movl    8(%ebx), %edi
        movzwl  up_spss, %esi
        xorl    %eax, %eax
        movw    %ax, %fs
        movw    %ax, %gs
        movw    %bp, %ds
        iretl

/* The procedure's IRET led to HLT_CBRET: the RM code goes on with the registers in ES:EDI. EBP = frame. */
        .globl  hlt_cbret
hlt_cbret:
        call    client_to_rmregs
        call    lock_stack_leave
        movl    rmregs + R_SP, %edx

/* Goes on in RM with rmregs and SS:SP = EDX. */
rm_resume:
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        subw    $6, %dx
        movl    %edx, rm_spss
        movzwl  %dx, %edi
        shrl    $16, %edx
        shll    $4, %edx
        movw    rmregs + R_FLAGS, %ax
        andw    $0x0ed5, %ax
        movw    %ax, %fs:(%edx, %edi)
        movl    rmregs + R_IP, %eax
        movl    %eax, %fs:2(%edx, %edi)
        jmp     pm_to_rm

/* --- Raw mode switches (0306h). In both directions the caller passes the new registers: AX = DS, CX = ES, DX = SS,
       (E)BX = (E)SP, SI = CS, (E)DI = (E)IP; EBP is kept. --- */

/* The client jumped to HLT_RAWSW. EBP = frame. */
        .globl  hlt_rawsw
hlt_rawsw:
        call    frame_to_rmregs
        movw    F_EAX(%ebp), %ax
        movw    %ax, rmregs + R_DS
        movw    F_ECX(%ebp), %ax
        movw    %ax, rmregs + R_ES
        xorl    %eax, %eax
        movl    %eax, rmregs + R_FS
        movw    F_EDI(%ebp), %ax
        movw    %ax, rmregs + R_IP
        movw    F_ESI(%ebp), %ax
        movw    %ax, rmregs + R_CS
        movw    F_EFL(%ebp), %ax
        movw    %ax, rmregs + R_FLAGS
        movzwl  F_EDX(%ebp), %edx
        shll    $16, %edx
        movw    F_EBX(%ebp), %dx
        movl    tss + 4, %esp
        jmp     rm_resume

/* RM code jumped to the entry of up_stubs for raw mode switches. */
raw_to_pm:
        movl    tss + 4, %esp
        movzwl  rmregs + R_EDX, %eax
        pushl   %eax
        pushl   rmregs + R_EBX
        movzwl  rmregs + R_FLAGS, %eax
        orl     $IOPL3, %eax
        pushl   %eax
        movzwl  rmregs + R_ESI, %eax
        pushl   %eax
        pushl   rmregs + R_EDI
        movl    rmregs + R_EBP, %ebp
        xorl    %eax, %eax
        movw    %ax, %fs
        movw    %ax, %gs
        movw    rmregs + R_ECX, %es
        movw    rmregs + R_EAX, %ds
        iretl

/* --- Copying register sets. --- */

/* Copies the general registers of the frame at EBP to rmregs. ESI, EDI, ECX are lost. */
        .globl  frame_to_rmregs
frame_to_rmregs:
        movl    %ebp, %esi
        movl    $rmregs, %edi
        movl    $8, %ecx
        rep movsl
        ret

/* Copies the general registers of rmregs to the frame at EBP. */
        .globl  rmregs_to_frame
rmregs_to_frame:
        movl    $rmregs, %esi
        movl    %ebp, %edi
        movl    $8, %ecx
        rep movsl
        ret

/* Copies the register structure at the client's ES:EDI to rmregs. ECX, ESI, EDI are lost. */
        .globl  client_to_rmregs
client_to_rmregs:
        movl    F_EDI(%ebp), %esi
        movl    $rmregs, %edi
        movl    $R_SIZE / 2, %ecx
        movw    F_ES(%ebp), %ds
        rep movsw
        pushl   %ss
        popl    %ds
        ret

/* Copies rmregs to the register structure at the client's ES:EDI, except CS:IP and SS:SP. */
        .globl  rmregs_to_client
rmregs_to_client:
        movl    F_EDI(%ebp), %edi
        movl    $rmregs, %esi
        movl    $R_IP / 2, %ecx
        movw    F_ES(%ebp), %es
        rep movsw
        pushl   %ss
        popl    %es
        ret

        ASM_END
