/* Definitions shared by the parts of the embedded DPMI host (dpmi*.S): selectors, structure offsets, sizes.

   The host lives in one real-mode segment. Its 32-bit code and data selectors have the linear address of
   that segment as base, so a symbol has the same offset in real mode, in 16-bit and in 32-bit code.
   Real mode and V86 mode are both called "real mode" (RM) below, protected mode is called "PM". */
#ifndef ASM_DPMI_H
#define ASM_DPMI_H

#include "asm.h"

/* --- Selectors in the GDT: those of ring 0, mixed with those that the client (ring 3) may hold (xx3h, xxbh). --- */
#define HOST_CS     0x08        /* 32-bit code, base = host segment */
#define HOST_DS     0x10        /* 32-bit data, base = host segment; also the ring 0 stack */
#define FLAT_DS     0x18        /* data, base 0, limit 4 GB */
#define HOST_CS16   0x20        /* HOST_CS and HOST_DS as 16-bit segments, needed just before switching to RM */
#define HOST_DS16   0x28
#define TSS_SEL     0x30
#define LDT_SEL     0x38
#define BIOS_SEL    0x43        /* index 8: the BIOS data area under its usual number 40h, for the client */
#define USER_CS     0x4b        /* ring 3 code: the table of HLT instructions (dpmiint.S) */
#define LOCK_SS     0x53        /* ring 3 data: the locked stack for handlers */
#define VCPI_SEL    0x58        /* three descriptors for the VCPI server */
#define CB_SEL      0x73        /* for each call-back one data descriptor of its real-mode stack */

#define CALLBACKS   16          /* DPMI 0.9 requires at least 16 */
#define GDT_SIZE    (0x70 + CALLBACKS * 8)
#define LDT_FIRST   16          /* 0000h does not allocate the descriptors below this index */
#define LDT_COUNT   256

/* --- Offsets in the frame that SAVE_FRAME builds on the ring 0 stack: PUSHAL, segment registers, vector, error
   code, IRET frame. --- */
#define F_EDI   0
#define F_ESI   4
#define F_EBP   8
#define F_CR2   12              /* PUSHAL's ESP is not needed; a page fault stores CR2 here */
#define F_EBX   16
#define F_EDX   20
#define F_ECX   24
#define F_EAX   28
#define F_DS    32
#define F_ES    36
#define F_FS    40
#define F_GS    44
#define F_VEC   48
#define F_ERR   52
#define F_EIP   56
#define F_CS    60
#define F_EFL   64
#define F_ESP   68
#define F_SS    72
#define F_SIZE  76

/* --- Offsets in the real-mode register structure of 0300h to 0304h. --- */
#define R_EDI   0
#define R_ESI   4
#define R_EBP   8
#define R_EBX   16
#define R_EDX   20
#define R_ECX   24
#define R_EAX   28
#define R_FLAGS 32
#define R_ES    34
#define R_DS    36
#define R_FS    38
#define R_GS    40
#define R_IP    42
#define R_CS    44
#define R_SP    46
#define R_SS    48
#define R_SIZE  50

/* --- Numbers of HLT instructions after the first 256, which reflect interrupts (see dpmiint.S). --- */
#define HLT_IRQRET  256         /* return of a PM interrupt handler called for an interrupt in PM */
#define HLT_UPRET   257         /* return of a PM interrupt handler called for an interrupt in RM */
#define HLT_CBRET   258         /* return of a real-mode call-back's PM procedure */
#define HLT_EXCRET  259         /* return of an exception handler */
#define HLT_RAWSW   260         /* raw mode switch PM to RM */
#define HLT_STATE   261         /* save/restore state: nothing to do, far return */
#define HLT_COUNT   262

/* --- Sizes, bytes unless noted. --- */
#define R0_STACK    4096        /* ring 0 stack; each nesting of PM in RM in PM takes about 100 bytes */
#define RM_STACK    8192        /* real-mode stack; each nested call gets RM_CHUNK */
#define RM_CHUNK    1024
#define LOCK_STACK  8192        /* stack of ring 3 handlers; each nested handler gets at least LOCK_CHUNK */
#define LOCK_CHUNK  1024
#define HOOKS       19          /* number of IVT entries that can lead to PM: 16 hardware interrupts, 1Ch, 23h, 24h */
#define ARENAS      16          /* number of pieces of extended memory (one XMS handle each) */
#define BLOCKS      320         /* number of the client's memory blocks; DJGPP's sbrk can use 256 */

#define AGAIN_MOST  10000       /* when exception handlers returned this often to the same fault, the program is ended */
#define FAULT_PAGES 32          /* page faults in DOSBox: most pages made present until the fault is delivered */
#define ROM_PAGE    0xf0000

#define IOPL3   0x3000
#define IF_BIT  0x0200
#define ARITH   0x08d5          /* OF SF ZF AF PF CF */

/* Error codes in AX. DPMI 0.9 has none; these are the codes of DPMI 1.0. */
#define E_UNSUPPORTED   0x8001
#define E_NO_DESCRIPTOR 0x8011
#define E_NO_LINEAR     0x8012
#define E_NO_PHYSICAL   0x8013
#define E_NO_CALLBACK   0x8015
#define E_NO_HANDLE     0x8016
#define E_VALUE         0x8021
#define E_SELECTOR      0x8022
#define E_HANDLE        0x8023
#define E_CALLBACK      0x8024
#define E_ADDRESS       0x8025

/* Linear addresses of the page tables and of the page directory: the last entry of the directory is the directory itself. */
#define PTES        0xffc00000
#define PDES        0xfffff000

#endif
