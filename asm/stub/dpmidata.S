/* The tables and variables of the host. Section .host is in the file; .hbss is not, and host_init clears it. */

#include "dpmi.h"

        SECTION(.host)

/* --- Descriptors. host_init fills in the bases listed in gdt_bases. --- */
        .balign 8
        .globl  gdt
gdt:    .quad   0
        .quad   0x00409a000000ffff      /* HOST_CS */
        .quad   0x004092000000ffff      /* HOST_DS */
        .quad   0x00cf92000000ffff      /* FLAT_DS */
        .quad   0x00009a000000ffff      /* HOST_CS16 */
        .quad   0x000092000000ffff      /* HOST_DS16 */
        .quad   0x0000890000000067      /* TSS_SEL */
        .quad   0x0000820000000000 + LDT_COUNT * 8 - 1
        .quad   0x0000f200040002ff      /* BIOS_SEL */
        .quad   0x0040fa0000000000 + HLT_COUNT - 1
        .quad   0x0040f20000000000 + LOCK_STACK - 1
        .quad   0, 0, 0                 /* VCPI_SEL */
        .rept   CALLBACKS
        .quad   0x0000f2000000ffff      /* CB_SEL */
        .endr

        .globl  gdt_bases, gdt_bases_end
gdt_bases:                              /* pairs: selector, offset in the host's segment */
        .word   HOST_CS, 0, HOST_DS, 0, HOST_CS16, 0, HOST_DS16, 0
        .word   TSS_SEL, tss, LDT_SEL, ldt, USER_CS & ~3, hlts, LOCK_SS & ~3, lock_stack
gdt_bases_end:

        .globl  gdtr, idtr, rm_idtr
gdtr:   .word   GDT_SIZE - 1, gdt, 0    /* host_init makes the addresses linear */
idtr:   .word   256 * 8 - 1, idt, 0
rm_idtr: .word  0x3ff, 0, 0

/* --- Mode switch. In the pointers from rm_ptrs on, host_init fills in the host's segment. --- */
        .balign 4
        .globl  pm_to_rm_vec, rm_to_pm_vec, rm_ptrs, rm_ptrs_end
        .globl  rm_go, rmregs_ptr, rmregs_gs_ptr, rm_return_ptr, switch_stack_ptr, rm_stack_cur
pm_to_rm_vec:   .long   raw_pm_to_rm
rm_to_pm_vec:   .long   raw_rm_to_pm
rm_ptrs:
rm_go:          .word   rm_load, 0      /* RM address to which pm_to_rm jumps */
rmregs_ptr:     .word   rmregs, 0
rmregs_gs_ptr:  .word   rmregs + R_IP, 0
rm_return_ptr:  .word   rm_return, 0
switch_stack_ptr: .word switch_stack_top, 0
rm_stack_cur:   .word   rm_stack_top, 0
rm_ptrs_end:
        .globl  switch_table
switch_table:     .long   0, gdtr, idtr   /* in VCPI's layout: CR3, linear addresses of gdtr and idtr, LDT, TSS, CS:EIP */
                .word   LDT_SEL, TSS_SEL
                .long   pm_arrive
                .word   HOST_CS, 0
        .globl  map_next
map_next:       .long   0xc0000000      /* VCPI: next linear address for mapped physical memory */
        .globl  r0_cur, lock_cur, version_flags, host_seg, psp_seg
r0_cur:         .long   r0_stack_top
lock_cur:       .long   LOCK_STACK
version_flags:  .long   3               /* bit 1 is cleared under VCPI */
host_seg:       .long   0
psp_seg:        .long   0

/* The interrupt number of each hook, in the order of up_stubs. */
        .globl  hook_vec
hook_vec:       .byte   0x08, 0x09, 0x0a, 0x0b, 0x0c, 0x0d, 0x0e, 0x0f
                .byte   0x70, 0x71, 0x72, 0x73, 0x74, 0x75, 0x76, 0x77
                .byte   0x1c, 0x23, 0x24

        .balign 4
        .globl  hlt_table
hlt_table:      .long   crash, hlt_upret, hlt_cbret, hlt_excret, hlt_rawsw, hlt_state

/* The fields of two frames that must be equal for a fault to count as the same again. */
        .globl  again_fields
again_fields:   .byte   F_EIP, F_ESP, F_EAX, F_ECX, F_EDX, F_EBX, F_EBP, F_ESI, F_EDI, 0xff

/* --- Messages of a crash. --- */
        .globl  exc_names, crash_lines, msg_exception, msg_nesting, msg_base, msg_limit
        .macro  NAMES n:vararg
        .irp    name, \n
        .long   \name
        .endr
        .endm
exc_names:
        NAMES   exc_0, exc_1, exc_2, exc_3, exc_4, exc_5, exc_6, exc_7, exc_8
        NAMES   exc_9, exc_10, exc_11, exc_12, exc_13, exc_14, exc_15, exc_16, exc_17
exc_0:  .asciz  "Division by Zero"
exc_1:  .asciz  "Debug"
exc_2:  .asciz  "NMI"
exc_3:  .asciz  "Breakpoint"
exc_4:  .asciz  "Overflow"
exc_5:  .asciz  "Bounds Check"
exc_6:  .asciz  "Invalid Opcode"
exc_7:  .asciz  "Coprocessor not available"
exc_8:  .asciz  "Double Fault"
exc_9:  .asciz  "Coprocessor overrun"
exc_10: .asciz  "Invalid TSS"
exc_11: .asciz  "Segment Not Present"
exc_12: .asciz  "Stack Fault"
exc_13: .asciz  "General Protection Fault"
exc_14: .asciz  "Page fault"
exc_15: .asciz  "Exception 15"
exc_16: .asciz  "Coprocessor Error"
exc_17: .asciz  "Alignment Check"
msg_exception:  .asciz "Exception "
        .globl  msg_break
msg_break:      .asciz "Control-C Pressed"
msg_nesting:    .asciz "Interrupts or real-mode calls nested too deeply\r\n"
msg_base:       .asciz "  base="
msg_limit:      .asciz "  limit="

/* Pairs: the offset of a register in the frame, plus 80h for a selector; then the text printed before it. */
crash_lines:
        .byte   F_EIP
        .asciz  " at eip="
        .byte   F_ERR
        .asciz  ", error="
        .byte   F_EAX
        .asciz  "\r\neax="
        .byte   F_EBX
        .asciz  " ebx="
        .byte   F_ECX
        .asciz  " ecx="
        .byte   F_EDX
        .asciz  " edx="
        .byte   F_ESI
        .asciz  " esi="
        .byte   F_EDI
        .asciz  " edi="
        .byte   F_EBP
        .asciz  "\r\nebp="
        .byte   F_ESP
        .asciz  " esp="
        .byte   F_EFL
        .asciz  " eflags="
        .byte   F_CR2
        .asciz  " cr2="
        .byte   F_CS + 0x80
        .asciz  "\r\ncs: sel="
        .byte   F_DS + 0x80
        .asciz  "\r\nds: sel="
        .byte   F_ES + 0x80
        .asciz  "\r\nes: sel="
        .byte   F_FS + 0x80
        .asciz  "\r\nfs: sel="
        .byte   F_GS + 0x80
        .asciz  "\r\ngs: sel="
        .byte   F_SS + 0x80
        .asciz  "\r\nss: sel="
        .byte   0xff

/* --- Variables that are not in the file. --- */
        SECTION_BSS(.hbss)
        .balign 16
        .globl  idt, ldt, pm_vec, exc_vec, thunks, hlts, tss, callbacks, hook_old, ivt_copy
        .globl  blocks, blocks_end, arenas, arenas_end, rmregs, text
        .globl  r0_stack, r0_stack_top, rm_stack, rm_stack_top, lock_stack, switch_stack_top
idt:            .skip   256 * 8
ldt:            .skip   LDT_COUNT * 8
pm_vec:         .skip   256 * 8         /* the client's interrupt handlers: offset, selector */
thunks:         .skip   256 * 8         /* code: PUSH vector, JMP entry */
exc_vec:        .skip   32 * 8          /* the client's exception handlers: offset, selector (0: no handler) */
callbacks:      .skip   CALLBACKS * 16  /* offset and selector (0: free) of the procedure, then of the register structure */
hook_old:       .skip   HOOKS * 4       /* the IVT entries before they were hooked */
ivt_copy:       .skip   1024            /* the IVT at the start */
blocks:         .skip   BLOCKS * 8
blocks_end:
arenas:         .skip   ARENAS * 16
arenas_end:
tss:            .skip   104
rmregs:         .skip   R_SIZE
                .balign 4
                .globl  fault_frame, fault_pages, fault_count, fault_pending, fault_defer
fault_frame:    .skip   F_SIZE          /* page faults in DOSBox, see dpmiint.S: the frame to be delivered */
fault_pages:    .skip   FAULT_PAGES * 4 /* numbers of the pages that must become absent again */
fault_count:    .skip   4
                .globl  again_frame, again_count
again_frame:    .skip   F_SIZE          /* the frame to which the last exception handler returned */
again_count:    .skip   4               /* how often that frame has caused the same fault again */
                .globl  shrunk
shrunk:         .skip   2               /* a selector whose limit the client made less than a page, or 0 */
fault_pending:  .skip   1               /* 1: a page fault waits to be delivered */
fault_defer:    .skip   1               /* 1: this is DOSBox */
hlts:           .skip   HLT_COUNT
                .balign 4
text:           .skip   1024
                .skip   256
switch_stack_top:
                .balign 16
rm_stack:       .skip   RM_STACK
rm_stack_top:
lock_stack:     .skip   LOCK_STACK
r0_stack:       .skip   R0_STACK
r0_stack_top:
                .globl  pages
pages:          .skip   3 * 4096        /* contains the page directory and the first page table, aligned to 4 KB */

        .globl  irq_target, xms_slack
xms_slack:      .skip   4               /* extra KB to request from XMS when its blocks do not start at page boundaries */
irq_target:     .skip   4               /* CS:IP of the RM handler that rm_irq calls */
        .globl  host_base, rm_spss, pm_cont, up_num, up_spss, xms_entry, xms_super, cpu_type, fpu_type
        .globl  pic_masks, callbacks_used, vcpi_entry, switch_table_linear, old_15, old_23, a20_mode
        .globl  exit_code, env_seg, client_ip, client_cs, client_ds, client_ss, client_sp
host_base:      .skip   4
rm_spss:        .skip   4               /* SP, SS for rm_load */
pm_cont:        .skip   4               /* address at which pm_arrive continues */
up_num:         .skip   4               /* number pushed by one of up_stubs */
up_spss:        .skip   4               /* SS:SP of the RM code that called it */
xms_entry:      .skip   4               /* 0: no XMS */
vcpi_entry:     .skip   6
                .balign 4
switch_table_linear: .skip 4
        .globl  in_dos, pic_base
in_dos:         .skip   4               /* linear address of the InDOS flag */
pic_base:       .skip   2               /* VCPI: first interrupts of the two controllers, 0 without VCPI */
                .balign 4
        .globl  pool_next, pool_end, pool_handle
pool_next:      .skip   4               /* without VCPI: the next free page for page tables, linear = physical address */
pool_end:       .skip   4               /* end of these pages */
pool_handle:    .skip   4               /* XMS handle + 1 */
old_15:         .skip   4
old_23:         .skip   4
client_ip:      .skip   2
client_cs:      .skip   2
client_ds:      .skip   2
client_ss:      .skip   2
client_sp:      .skip   2
env_seg:        .skip   2
pic_masks:      .skip   2
exit_code:      .skip   1
xms_super:      .skip   1               /* 80h: XMS 3, sizes in 32 bits */
cpu_type:       .skip   1
fpu_type:       .skip   1               /* bits 4 to 7 as in 0E00h */
callbacks_used: .skip   1
                .globl  cr0_start
cr0_start:      .skip   1               /* bits MP and EM of CR0 at the start */
a20_mode:       .skip   1               /* who switched A20 on: 0 nobody, 1 XMS, 2 port 92h, 3 keyboard controller */

        ASM_END
