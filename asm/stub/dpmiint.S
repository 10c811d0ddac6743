/* The interrupts of the host: the handlers of all gates of the IDT.

     0 to 7          processor exceptions
     8 to 15         hardware interrupts 0 to 7 and processor exceptions, distinguished by the error code
     21h, 2Fh, 31h   DOS (only its exit function is handled here), the question for the mode, DPMI
     70h to 77h      hardware interrupts 8 to 15
     all others      reflected to RM

   A software interrupt for which the client has set a handler (0205h) does not come here: its gate leads
   directly to the handler.

   The client runs in ring 3 with IOPL 3, the host in ring 0 with interrupts always disabled. Therefore a gate
   is always entered on a fresh ring 0 stack, whatever state the client's stack is in. This matters: DJGPP signals
   a program by shrinking its data and stack segment, and a stack overflow must end in a message.

   The addresses in the host that a client may call (default handlers, ends of handlers) lie in a table of HLT
   instructions. HLT faults in ring 3, and the EIP of the fault tells which service is called. */

#include "dpmi.h"

        SECTION(.host)
        .code32

/* Completes a frame. On the stack: vector, error code (or a dummy), IRET frame. */
        .macro  SAVE_FRAME
        pushl   %gs
        pushl   %fs
        pushl   %es
        pushl   %ds
        pushal
        movl    %esp, %ebp
        movl    $HOST_DS, %edx
        movw    %dx, %ds
        movw    %dx, %es
        cld
        .endm

/* Returns to the client. A selector that has become invalid in the meantime (DJGPP's crt0 frees its own selectors
   when the program ends) is replaced by 0: see host_fault. */
        .globl  exit_frame
exit_frame:
        cmpw    $0, %ss:shrunk
        jne     1f
exit_now:
        popal
pop_ds: popl    %ds
pop_es: popl    %es
pop_fs: popl    %fs
pop_gs: popl    %gs
        addl    $8, %esp
exit_iret:
        iretl

/* DJGPP interrupts its programs (alarm, Ctrl-C as a signal) by making their data and stack segment so small that
   the next access faults. Emulators do not check limits, so the host does: a return to a shrunk stack causes a
   general protection fault. */
1:      movw    %ss:shrunk, %ax
        cmpw    %ax, F_SS(%esp)
        jne     exit_now
        movl    %esp, %ebp
        movl    $HOST_DS, %edx
        movw    %dx, %ds
        movw    %dx, %es
        cld
shrunk_fault:
        movl    $13, %eax
        movl    %eax, F_VEC(%ebp)
        movl    $0, F_ERR(%ebp)
        jmp     deliver

/* --- Software interrupts. The thunk of each entry has pushed the vector. --- */
        .globl  entry_int21, entry_int2f, entry_soft
entry_int2f:
        cmpw    $0x1686, %ax            /* the question for protected mode: AX = 0 means yes */
        jne     entry_soft
        xorl    %eax, %eax
        addl    $4, %esp
        iretl
entry_int21:
        cmpb    $0x4c, %ah
        je      1f
entry_soft:
        pushl   (%esp)
        SAVE_FRAME
        cmpb    $0, fault_pending
        jne     fault_now
        movzbl  F_VEC(%ebp), %eax
        call    reflect
        jmp     exit_frame
1:      movw    $HOST_DS, %dx
        movw    %dx, %ds
        movw    %dx, %es
        cld
        jmp     host_exit               /* dpmiinit.S; AL = exit status */

/* Calls RM interrupt EAX for the client whose frame is at EBP. General registers and arithmetic flags are passed to
   RM and back. */
reflect:
        pushl   %eax
        call    frame_to_rmregs
        movl    F_EFL(%ebp), %eax
        movw    %ax, rmregs + R_FLAGS
        movw    host_seg, %ax
        movw    %ax, rmregs + R_DS
        movw    %ax, rmregs + R_ES
        movw    %ax, rmregs + R_FS
        movw    %ax, rmregs + R_GS
        movl    $0, rmregs + R_SP
        popl    %eax
        call    rm_int
        call    rmregs_to_frame
        movl    F_EFL(%ebp), %eax
        andl    $~ARITH, %eax
        movzwl  rmregs + R_FLAGS, %edx
        andl    $ARITH, %edx
        orl     %edx, %eax
        movl    %eax, F_EFL(%ebp)
        ret

/* --- Hardware interrupts. --- */

/* Vectors 8 to 15. For an interrupt in ring 3 the stack has exactly the vector and the IRET frame; for an exception
   it has an error code, too. */
        .globl  entry_low, entry_irq
entry_low:
        pushl   %eax
        leal    28(%esp), %eax
        cmpl    %eax, %ss:tss + 4
        popl    %eax
        jne     entry_exc_code
entry_irq:
        pushl   %eax
        movzbl  4(%esp), %eax
        cmpw    $USER_CS, %ss:pm_vec + 4(, %eax, 8)
        popl    %eax
        jne     irq_to_client
        pushl   (%esp)
        SAVE_FRAME
        cmpb    $0, fault_pending
        jne     irq_and_fault
        movzbl  F_VEC(%ebp), %eax
        call    rm_irq_call
        jmp     exit_frame

/* The timer tick that a pending page fault was waiting for: reflects the tick to RM, then delivers the fault. */
irq_to_rm:
        pushl   (%esp)
        SAVE_FRAME
irq_and_fault:
        movzbl  F_VEC(%ebp), %eax
        movw    $2, rmregs + R_FLAGS
        movl    $0, rmregs + R_SP
        call    rm_int
        jmp     fault_now

/* Calls the client's handler on the locked stack. The state of the interrupted code stays on the ring 0 stack (old
   ESP0, old lock_cur, IRET frame), and interrupts use the ring 0 stack below it. */
irq_to_client:
        cmpb    $0, %ss:fault_pending
        jne     irq_to_rm
        subl    $4, %esp
        pushl   %eax
        pushl   %edx
        movl    %ss:lock_cur, %edx
        cmpw    $LOCK_SS, 32(%esp)      /* on the locked stack already: continue below its ESP */
        jne     1f
        movl    28(%esp), %edx
1:      movzbl  12(%esp), %eax
        pushl   %eax
        movl    %ss:tss + 4, %eax
        movl    %eax, 12(%esp)
        movl    %ss:lock_cur, %eax
        movl    %eax, 16(%esp)
        leal    -LOCK_CHUNK(%edx), %eax
        testl   %eax, %eax
        js      fatal_nesting
        movl    %eax, %ss:lock_cur
        leal    12(%esp), %eax
        movl    %eax, %ss:tss + 4
        cmpl    $r0_stack + 512, %esp
        jb      fatal_nesting
        popl    %eax
        movl    $HLT_IRQRET, %ss:lock_stack - 12(%edx)
        movl    $USER_CS, %ss:lock_stack - 8(%edx)
        movl    $IOPL3 | 2, %ss:lock_stack - 4(%edx)
        subl    $12, %edx
        pushl   $LOCK_SS
        pushl   %edx
        pushl   $IOPL3 | 2
        movzwl  %ss:pm_vec + 4(, %eax, 8), %edx
        pushl   %edx
        pushl   %ss:pm_vec(, %eax, 8)
        movl    20(%esp), %edx
        movl    24(%esp), %eax
        iretl

/* --- HLT instructions of the table. On the stack: vector, error code, IRET frame; EIP is the number of the HLT. --- */
hlt_trap:
        cmpl    $HLT_IRQRET, 8(%esp)
        jne     1f
        movl    %ss:tss + 4, %esp
        popl    %ss:tss + 4
        popl    %ss:lock_cur
        cmpw    $0, %ss:shrunk
        jne     4f
        iretl
4:      pushl   $0                      /* exit_frame checks whether the stack is the shrunk one */
        pushl   $13
        SAVE_FRAME
        jmp     exit_frame
1:      SAVE_FRAME
        movl    F_EIP(%ebp), %eax
        cmpl    $256, %eax
        jae     2f

/* The default handler of interrupt EAX, to which a client's handler has jumped: reflects the interrupt, then does an
   IRET from the client's stack. */
        cmpl    $0x21, %eax
        jne     3f
        cmpb    $0x4c, F_EAX + 1(%ebp)
        jne     3f
        movzbl  F_EAX(%ebp), %eax
        jmp     host_exit
3:      call    reflect
        call    client_stack
        movl    %es:(%esi), %eax
        movl    %eax, F_EIP(%ebp)
        movl    %es:4(%esi), %eax
        movl    %eax, F_CS(%ebp)
        movl    %es:8(%esi), %eax
        andl    $~ARITH, %eax
        movl    F_EFL(%ebp), %edx
        andl    $ARITH, %edx
        orl     %edx, %eax
        call    set_eflags
        addl    $12, F_ESP(%ebp)
        jmp     exit_frame

2:      cmpl    $HLT_STATE, %eax
        ja      crash
        jmp     *hlt_table - 256 * 4(, %eax, 4)

        .globl  hlt_state
hlt_state:                              /* far return */
        call    client_stack
        movl    %es:(%esi), %eax
        movl    %eax, F_EIP(%ebp)
        movl    %es:4(%esi), %eax
        movl    %eax, F_CS(%ebp)
        addl    $8, F_ESP(%ebp)
        jmp     exit_frame

/* Out: ES:ESI = the client's SS:ESP. EAX is lost. */
        .globl  client_stack
client_stack:
        movl    F_ESP(%ebp), %esi
        movl    F_SS(%ebp), %eax
        movw    %ax, %es
        larl    %eax, %eax
        testl   $0x400000, %eax         /* 16-bit stack? */
        jnz     1f
        movzwl  %si, %esi
1:      ret

/* Sets F_EFL to those flags of EAX that the client may change. */
set_eflags:
        andl    $0x40fd5, %eax          /* AC, OF DF IF TF SF ZF AF PF CF */
        orl     $IOPL3 | 2, %eax
        movl    %eax, F_EFL(%ebp)
        ret

/* --- Processor exceptions. --- */
        .globl  entry_exc, entry_exc_code
entry_exc:                              /* no error code */
        pushl   (%esp)
        movl    $0, 4(%esp)
entry_exc_code:
        cmpw    $USER_CS, 12(%esp)
        je      hlt_trap
        testb   $3, 12(%esp)
        jz      host_fault
        SAVE_FRAME
        movl    F_VEC(%ebp), %eax
        cmpl    $2, %eax                /* the BIOS handles NMI */
        jne     1f
        call    reflect
        jmp     exit_frame
1:      cmpb    $0, fault_pending
        jne     fault_again
        cmpl    $14, %eax
        jne     deliver
        cmpb    $0, fault_defer
        jne     fault_first
        movl    %cr2, %edx
        movl    %edx, F_CR2(%ebp)
deliver:
        pushl   %eax                    /* count handlers that returned to the same fault with the same registers */
        movl    $again_fields, %esi
1:      xorl    %eax, %eax
        lodsb
        cmpb    $0xff, %al
        je      2f
        movl    (%ebp, %eax), %edx
        cmpl    again_frame(%eax), %edx
        je      1b
        movl    $-1, again_count
2:      incl    again_count
        cmpl    $AGAIN_MOST, again_count
        popl    %eax
        ja      crash
        movzwl  exc_vec + 4(, %eax, 8), %ebx
        testl   %ebx, %ebx
        jz      2f

/* Calls the client's handler (0203h) on the locked stack. Its frame, upwards: return address (HLT_EXCRET), error
   code, EIP, CS, EFLAGS, ESP, SS. The frame contains the whole state, because the handler may never return. */
        movl    exc_vec(, %eax, 8), %ecx
        movl    lock_cur, %edx
        cmpw    $LOCK_SS, F_SS(%ebp)
        jne     4f
        movl    F_ESP(%ebp), %edx
        cmpl    $LOCK_STACK, %edx
        ja      crash
        cmpl    $128, %edx              /* the stack is used up: handlers that fault themselves */
        jb      crash
4:      leal    lock_stack - 32(%edx), %edi
        leal    F_ERR(%ebp), %esi
        pushl   %ecx
        movl    $HLT_EXCRET, %eax
        stosl
        movl    $USER_CS, %eax
        stosl
        movl    $6, %ecx
        rep movsl
        popl    F_EIP(%ebp)
        movl    %ebx, F_CS(%ebp)
        subl    $32, %edx
        movl    %edx, F_ESP(%ebp)
        movl    $LOCK_SS, F_SS(%ebp)
        andl    $~(IF_BIT | 0x100), F_EFL(%ebp)
        jmp     exit_frame

/* Without an exception handler, exceptions 0 to 7 go to the client's interrupt handler, if there is one. */
2:      cmpl    $8, %eax
        jae     crash
        movzwl  pm_vec + 4(, %eax, 8), %ebx
        cmpl    $USER_CS, %ebx
        je      crash
        movl    pm_vec(, %eax, 8), %ecx
        call    client_stack
        movl    F_EFL(%ebp), %eax
        movl    %eax, %es:-4(%esi)
        movl    F_CS(%ebp), %eax
        movl    %eax, %es:-8(%esi)
        movl    F_EIP(%ebp), %eax
        movl    %eax, %es:-12(%esi)
        movl    %ecx, F_EIP(%ebp)
        movl    %ebx, F_CS(%ebp)
        subl    $12, F_ESP(%ebp)
        andl    $~(IF_BIT | 0x100), F_EFL(%ebp)
        jmp     exit_frame

/* --- Page faults in DOSBox. DOSBox runs the handler of a page fault inside the faulting instruction, and it stops with
       "Pagefault didn't correct page" when the program ends there. Therefore the host lets the instruction complete on
       any available page and delivers the fault later, with the registers of the fault, at the next interrupt. The
       timer is programmed to interrupt at once for this, and afterwards to the rate of the BIOS. --- */

/* EAX = 14, EBP = frame. */
fault_first:
        movl    %cr2, %eax
        movl    %eax, F_CR2(%ebp)
        movl    %ebp, %esi
        movl    $fault_frame, %edi
        movl    $F_SIZE / 4, %ecx
        rep movsl
        call    fault_alarm
        jmp     1f

/* An exception while a page fault is pending. */
fault_again:
        cmpl    $14, %eax
        jne     fault_now
1:      call    fault_let_through
        andb    $~1, F_EFL + 1(%ebp)    /* no TF */
        orb     $IF_BIT >> 8, F_EFL + 1(%ebp)
        jmp     exit_frame

/* The host has accessed a bad address for the client. On the stack: vector, error code, EIP, CS, EFLAGS. */
fault_in_host:
        pushl   %gs
        pushl   %fs
        pushl   %es
        pushl   %ds
        pushal
        movl    $HOST_DS, %edx
        movw    %dx, %ds
        movw    %dx, %es
        cld
        cmpb    $0, fault_pending
        jne     1f
        movl    tss + 4, %esi           /* deliver the client's frame with this fault */
        subl    $F_SIZE, %esi
        movl    $fault_frame, %edi
        movl    $F_SIZE / 4, %ecx
        rep movsl
        movl    %cr2, %eax
        movl    %eax, fault_frame + F_CR2
        movl    $14, fault_frame + F_VEC
        movl    F_ERR(%esp), %eax
        movl    %eax, fault_frame + F_ERR
        call    fault_alarm
1:      call    fault_let_through
        popal
        popl    %ds
        popl    %es
        popl    %fs
        popl    %gs
        addl    $8, %esp
        iretl

fault_alarm:
        movl    $0, fault_count
        movb    $1, fault_pending
        movb    $0x30, %al              /* timer: counter 0, mode 0, count 2: an interrupt after 2 microseconds */
        outb    %al, $0x43
        movb    $2, %al
        outb    %al, $0x40
        xorl    %eax, %eax
        outb    %al, $0x40
        ret

/* Makes the page at CR2 present: the client's own page if 0507h made it absent, otherwise a page of the BIOS's ROM. */
fault_let_through:
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    %cr2, %edx
        call    page_table
        jc      2f
        shrl    $12, %edx
        movl    %fs:PTES(, %edx, 4), %eax
        testl   %eax, %eax
        jnz     1f
        movl    $ROM_PAGE, %eax
1:      orb     $7, %al
        movl    %eax, %fs:PTES(, %edx, 4)
        movl    fault_count, %eax       /* remember the page: fault_now makes it absent again */
        cmpl    $FAULT_PAGES, %eax
        jae     2f
        movl    %edx, fault_pages(, %eax, 4)
        incl    fault_count
2:      ret

/* Delivers the pending page fault. EBP = frame that the frame of the fault replaces. */
        .globl  fault_now
fault_now:
        movl    $fault_frame, %esi
        movl    %ebp, %edi
        movl    $F_SIZE / 4, %ecx
        rep movsl
        movb    $0, fault_pending
        movb    $0x36, %al              /* timer: counter 0, mode 3, divisor 65536, as the BIOS sets it */
        outb    %al, $0x43
        xorl    %eax, %eax
        outb    %al, $0x40
        outb    %al, $0x40
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    fault_count, %ecx
        jecxz   3f
1:      movl    fault_pages - 4(, %ecx, 4), %edx
        movl    %fs:PTES(, %edx, 4), %eax
        andl    $~0xfff, %eax
        cmpl    $ROM_PAGE, %eax
        movl    $0, %eax
        je      2f
        movl    %fs:PTES(, %edx, 4), %eax
        andb    $~1, %al
2:      movl    %eax, %fs:PTES(, %edx, 4)
        loop    1b
        movl    %cr3, %eax
        movl    %eax, %cr3
3:      movl    F_CR2(%ebp), %eax
        movl    %eax, %cr2
        movl    F_VEC(%ebp), %eax
        jmp     deliver

/* The far return of the exception handler led to HLT_EXCRET; the rest of the frame is on the handler's stack. */
        .globl  hlt_excret
hlt_excret:
        call    client_stack
        movl    %es:4(%esi), %eax
        movl    %eax, F_EIP(%ebp)
        movl    %es:8(%esi), %eax
        movl    %eax, F_CS(%ebp)
        movl    %es:12(%esi), %eax
        call    set_eflags
        movl    %es:16(%esi), %eax
        movl    %eax, F_ESP(%ebp)
        movl    %es:20(%esi), %eax
        movl    %eax, F_SS(%ebp)
        pushl   %ds
        popl    %es
        movl    %ebp, %esi
        movl    $again_frame, %edi
        movl    $F_SIZE / 4, %ecx
        rep movsl
        jmp     exit_frame

/* A fault in the host. On the stack: vector, error code, EIP, CS, EFLAGS, then the host's data. A fault is expected
   only when exit_frame pops a selector. Any other fault means that the client has passed bad arguments; the client's
   frame is at the start of the ring 0 stack. */
host_fault:
        cmpl    $2, (%esp)              /* NMI */
        je      3f
        cmpl    $pop_ds, 8(%esp)
        jb      1f
        cmpl    $pop_gs, 8(%esp)
        ja      1f
        movl    $0, 20(%esp)            /* replace the invalid selector that was about to be popped */
3:      addl    $8, %esp
        iretl
1:      cmpl    $14, (%esp)
        jne     4f
        cmpb    $0, %ss:fault_defer
        jne     fault_in_host
4:      movw    $HOST_DS, %dx
        movw    %dx, %ds
        movw    %dx, %es
        movl    tss + 4, %ebp
        subl    $F_SIZE, %ebp
        movl    (%esp), %eax
        movl    %eax, F_VEC(%ebp)
        movl    4(%esp), %eax
        movl    %eax, F_ERR(%ebp)
        movl    %cr2, %eax
        movl    %eax, F_CR2(%ebp)
        cld
        jmp     crash

/* Ctrl-C in a DOS call of the client, whose frame is at the start of the ring 0 stack. */
        .globl  ctrl_c
ctrl_c:
        movl    tss + 4, %ebp
        subl    $F_SIZE, %ebp
        movl    $0x23, F_VEC(%ebp)
        movl    $0, F_ERR(%ebp)

/* --- Ends the client: prints the frame at EBP in the format of DJGPP programs, restores text mode, exits with status
       255. --- */
        .globl  crash
crash:
        movl    tss + 4, %esp           /* keep the frame, drop the rest of the stack */
        subl    $F_SIZE, %esp
        cmpl    %esp, %ebp
        jae     1f
        movl    %ebp, %esp
1:      movl    $text, %edi
        movl    F_VEC(%ebp), %eax
        cmpl    $17, %eax
        ja      2f
        movl    exc_names(, %eax, 4), %esi
        call    put_text
        jmp     3f
2:      movl    $msg_break, %esi
        cmpl    $0x23, %eax
        je      7f
        movl    $msg_exception, %esi
7:      call    put_text
        movl    F_VEC(%ebp), %eax
        cmpl    $0x23, %eax
        je      3f
        call    put_hex2
3:      movl    $crash_lines, %ebx
4:      movzbl  (%ebx), %ecx            /* offset in the frame */
        cmpb    $0xff, %cl
        je      6f
        leal    1(%ebx), %esi
        call    put_text
        movl    %esi, %ebx
        testb   $0x80, %cl              /* a selector: four digits */
        jnz     5f
        movl    (%ebp, %ecx), %eax
        call    put_hex8
        jmp     4b
5:      andl    $0x7f, %ecx
        movl    (%ebp, %ecx), %eax
        call    put_selector
        jmp     4b
6:      movl    $text, %edx
        subl    %edx, %edi
        jmp     crash_exit

/* Ends the client because interrupts or calls are nested too deeply. */
        .globl  fatal_nesting
fatal_nesting:
        movw    $HOST_DS, %dx
        movw    %dx, %ds
        movw    %dx, %es
        cld
        movl    $msg_nesting, %esi
        movl    $text, %edi
        call    put_text
        movl    $text, %edx
        subl    %edx, %edi
        movl    $r0_stack_top, tss + 4
        movl    tss + 4, %esp

/* Writes EDI bytes at `text` to standard error, restores timer, interrupt controllers and video mode, and exits. */
crash_exit:
        pushl   %edi
        movl    $rm_stack_top - 64, %eax /* drop all nested RM calls */
        movw    %ax, rm_stack_cur
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    in_dos, %eax            /* an interrupted DOS call will never continue: DOS is not busy */
        movb    $0, %fs:(%eax)
        movb    %fs:0x449, %al          /* video mode */
        cmpb    $3, %al
        jbe     1f
        cmpb    $7, %al
        je      1f
        movl    $3, rmregs + R_EAX
        movl    $0, rmregs + R_SP
        movl    $0x10, %eax
        call    rm_int
1:      movb    $0x36, %al              /* clock: 18.2 Hz */
        outb    %al, $0x43
        xorl    %eax, %eax
        outb    %al, $0x40
        outb    %al, $0x40
        movb    pic_masks, %al
        outb    %al, $0x21
        movb    pic_masks + 1, %al
        outb    %al, $0xa1
        movl    $0x4000, rmregs + R_EAX
        movl    $2, rmregs + R_EBX
        movl    $text, rmregs + R_EDX
        popl    rmregs + R_ECX
        call    dos_call
        movb    $0xff, %al
        jmp     host_exit

/* Copies the text at ESI, up to its NUL, to EDI. Out: ESI = address after the NUL, EDI = end of the copy. */
put_text:
        lodsb
        testb   %al, %al
        jz      1f
        stosb
        jmp     put_text
1:      ret

/* Write the lowest 2, 4 or 8 hexadecimal digits of EAX to EDI. ECX is kept. */
put_hex2:
        shll    $24, %eax
        movb    $2, %dl
        jmp     1f
put_hex4:
        shll    $16, %eax
        movb    $4, %dl
        jmp     1f
put_hex8:
        movb    $8, %dl
1:      roll    $4, %eax
        pushl   %eax
        andb    $15, %al
        cmpb    $10, %al
        jb      2f
        addb    $'a' - '0' - 10, %al
2:      addb    $'0', %al
        stosb
        popl    %eax
        decb    %dl
        jnz     1b
        ret

/* Writes selector EAX with its base and limit to EDI. */
put_selector:
        pushl   %ebx
        pushl   %eax
        call    put_hex4
        popl    %ebx
        movzwl  %bx, %ebx
        pushl   %edi
        call    ldt_entry
        movl    %edi, %ecx
        popl    %edi
        jc      1f
        pushl   %ebx
        movl    $msg_base, %esi
        call    put_text
        movl    2(%ecx), %eax
        shll    $8, %eax
        movb    7(%ecx), %al
        rorl    $8, %eax
        call    put_hex8
        movl    $msg_limit, %esi
        call    put_text
        popl    %ebx
        lsll    %ebx, %eax
        call    put_hex8
1:      popl    %ebx
        ret

        ASM_END
