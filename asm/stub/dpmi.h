/* What the parts of the embedded DPMI host (dpmi*.S) share: selectors, structure offsets, sizes.

   The host lives in one real-mode segment. Its 32-bit code and data selectors have that segment's
   linear address as base, so a symbol is the same offset in real mode, in 16-bit and in 32-bit code.
   Real mode and V86 mode are both called "real mode" (RM), protected mode "PM" below. */
#ifndef ASM_DPMI_H
#define ASM_DPMI_H

#include "asm.h"

/* --- Selectors. GDT: ring 0 ones first, then what the client (ring 3) may hold. --- */
#define HOST_CS     0x08        /* 32-bit code, base = host segment */
#define HOST_DS     0x10        /* 32-bit data, base = host segment; also the ring 0 stack */
#define FLAT_DS     0x18        /* data, base 0, limit 4 GB */
#define HOST_CS16   0x20        /* the same as HOST_CS and HOST_DS, but 16 bit: the last stop before RM */
#define HOST_DS16   0x28
#define TSS_SEL     0x30
#define LDT_SEL     0x38
#define BIOS_SEL    0x43        /* index 8: the BIOS data area under its usual number 40h, for the client */
#define USER_CS     0x4b        /* ring 3 code: the table of HLTs (dpmiint.S) */
#define LOCK_SS     0x53        /* ring 3 data: the locked stack for handlers */
#define VCPI_SEL    0x58        /* three descriptors that belong to a VCPI server */
#define CB_SEL      0x73        /* one data descriptor for each call-back's real-mode stack */

#define CALLBACKS   16          /* DPMI 0.9 asks for at least 16 */
#define GDT_SIZE    (0x70 + CALLBACKS * 8)
#define LDT_FIRST   16          /* descriptors below are not given out by 0000h */
#define LDT_COUNT   256

/* --- Frame on the ring 0 stack after SAVE_FRAME: PUSHAL, segments, vector, error code, IRET frame. --- */
#define F_EDI   0
#define F_ESI   4
#define F_EBP   8
#define F_CR2   12              /* PUSHAL's ESP; a crash stores CR2 here */
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

/* --- Real-mode register structure of 0300h-0304h. --- */
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

/* --- Entries in the table of HLTs above the 256 that reflect an interrupt (see dpmiint.S). --- */
#define HLT_IRQRET  256         /* return of a PM interrupt handler called for an interrupt in PM */
#define HLT_UPRET   257         /* the same, called for an interrupt in RM */
#define HLT_CBRET   258         /* return of a real-mode call-back's PM procedure */
#define HLT_EXCRET  259         /* return of an exception handler */
#define HLT_RAWSW   260         /* raw mode switch PM to RM */
#define HLT_STATE   261         /* save/restore state: nothing to do, far return */
#define HLT_COUNT   262

/* --- Sizes. --- */
#define R0_STACK    4096        /* ring 0: about 100 bytes for each nesting of PM in RM in PM */
#define RM_STACK    8192        /* real mode: RM_CHUNK for each nested call */
#define RM_CHUNK    1024
#define LOCK_STACK  8192        /* ring 3 handlers: LOCK_CHUNK for each nested handler at least */
#define LOCK_CHUNK  1024
#define HOOKS       19          /* IVT entries that can lead to PM: 16 hardware interrupts, 1Ch, 23h, 24h */
#define ARENAS      16          /* pieces of extended memory (one XMS handle each) */
#define BLOCKS      320         /* client's memory blocks; DJGPP's sbrk can use 256 */

#define AGAIN_MOST  10000       /* exception handlers that return to the same fault one after the other: the program's end */
#define FAULT_PAGES 32          /* page faults in DOSBox: pages that the rest of an instruction may need */
#define ROM_PAGE    0xf0000

#define IOPL3   0x3000
#define IF_BIT  0x0200
#define ARITH   0x08d5          /* OF SF ZF AF PF CF */

/* DPMI 0.9 has no error codes in AX; these are the ones that DPMI 1.0 gave it. */
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

/* Where the page tables and the page directory are seen: the directory is its own last entry. */
#define PTES        0xffc00000
#define PDES        0xfffff000

#endif
