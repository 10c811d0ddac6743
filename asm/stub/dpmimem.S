/* The memory services of the host: int 31h AH=05h and 08h.

   The client's blocks lie in at most ARENAS pieces of extended memory, the arenas. An entry of their table is

     .base .size .handle .flags      16 bytes; handle: XMS handle + 1, or 0 for memory that is not from XMS

   With XMS an arena is allocated only when no existing arena has room, so that memory that the program does not use
   stays free for programs that it starts; an arena without blocks is freed at once. Without XMS there is one arena
   from the start: the memory that the BIOS reports, or under VCPI the pages that the server can supply.

   The entry of a block is .base, .size (both multiples of 4 KB; size 0: unused entry). Its base is its DPMI handle. */

#include "dpmi.h"

#define A_BASE      0
#define A_SIZE      4
#define A_HANDLE    8
#define ARENA_MIN   0x100000

        SECTION(.host)
        .code32

/* Calls the XMS driver. In: EAX, EDX = registers for the driver. Out: EAX, EBX, EDX as the driver returned them, also
   in rmregs. */
xms_call:
        movl    %eax, rmregs + R_EAX
        movl    %edx, rmregs + R_EDX
        movl    $0, rmregs + R_EBX
        movw    $2, rmregs + R_FLAGS
        movl    $0, rmregs + R_SP
        movl    xms_entry, %eax
        xorl    %ebx, %ebx
        xorl    %ecx, %ecx
        call    rm_call
        movl    rmregs + R_EAX, %eax
        movl    rmregs + R_EBX, %ebx
        movl    rmregs + R_EDX, %edx
        ret

/* Out: EAX = largest size in bytes of one more arena, a multiple of 4 KB; 0 if there can be none. All registers except
   EBP are lost. */
arena_possible:
        cmpl    $0, xms_entry
        je      3f
        movl    $arenas, %edi
1:      cmpl    $0, A_SIZE(%edi)
        je      2f
        addl    $16, %edi
        cmpl    $arenas_end, %edi
        jb      1b
        jmp     3f
2:      movzbl  xms_super, %eax         /* 80h with XMS 3 */
        addb    $8, %al
        shll    $8, %eax
        xorl    %edx, %edx
        call    xms_call
        cmpb    $0, xms_super
        jne     4f
        movzwl  %ax, %eax
4:      cmpl    $0x3ffffc, %eax
        jb      5f
        movl    $0x3ffffc, %eax
5:      subl    xms_slack, %eax
        jbe     3f
        shll    $10, %eax
        andl    $~0xfff, %eax
        ret
3:      xorl    %eax, %eax
        ret

/* Allocates an arena of at least ECX bytes. Out: EDI = arena, or carry. All registers except EBP are lost.
   There are few arenas, so each takes a quarter of the free memory and at least 1 MB. The first arena, for the program
   itself, takes only 1 MB if that is enough, so that a large block remains available. XMS usually returns adjacent
   memory, so that a block can extend from one arena to the next. */
arena_new:
        pushl   %ecx
        call    arena_possible
        popl    %ecx
        cmpl    %eax, %ecx
        ja      8f                      /* carry is clear here; 8 sets it */
        pushl   %ecx                    /* the requested size */
        xorl    %edx, %edx
        cmpl    $0, arenas + A_SIZE
        je      2f
        movl    %eax, %edx
        shrl    $2, %edx
        andl    $~0xfff, %edx
2:      cmpl    $ARENA_MIN, %edx
        jae     1f
        movl    $ARENA_MIN, %edx
1:      cmpl    %edx, %ecx
        jae     1f
        movl    %edx, %ecx
1:      cmpl    %eax, %ecx
        jbe     1f
        movl    %eax, %ecx
1:      movl    $arenas, %edi
2:      cmpl    $0, A_SIZE(%edi)
        je      3f
        addl    $16, %edi
        jmp     2b
3:      pushl   %edi
        pushl   %ecx
        movl    %ecx, %edx
        shrl    $10, %edx
        addl    xms_slack, %edx
        movzbl  xms_super, %eax
        addb    $9, %al
        shll    $8, %eax                /* allocate: DX or EDX = KB */
        call    xms_call
        cmpw    $1, %ax
        jne     7f
        movzwl  %dx, %esi
        pushl   %esi
        movl    $0x0c00, %eax           /* lock: DX:BX = physical address */
        movl    %esi, %edx
        call    xms_call
        popl    %esi
        cmpw    $1, %ax
        jne     6f
        shll    $16, %edx
        movw    %bx, %dx
        cmpl    $0, xms_slack
        jne     4f
        testl   $0x0fff, %edx           /* not at a page boundary: request 3 KB more from now on, and try again */
        jz      4f
        movl    $3, xms_slack
        pushl   %esi
        movl    $0x0d00, %eax
        movl    %esi, %edx
        call    xms_call
        popl    %edx
        movl    $0x0a00, %eax
        call    xms_call
        addl    $8, %esp
        popl    %ecx
        jmp     arena_new
4:      addl    $0xfff, %edx
        andl    $~0xfff, %edx
        popl    %ecx
        popl    %edi
        addl    $4, %esp
        incl    %esi
        movl    %edx, A_BASE(%edi)
        movl    %ecx, A_SIZE(%edi)
        movl    %esi, A_HANDLE(%edi)
        clc
        ret
6:      movl    $0x0a00, %eax
        movl    %esi, %edx
        call    xms_call
7:      addl    $12, %esp
8:      stc
        ret

/* Frees arena EDI if it is from XMS and contains no block. All registers except EBP are lost. */
arena_release:
        cmpl    $0, A_HANDLE(%edi)
        je      3f
        movl    A_BASE(%edi), %edx
        movl    $blocks, %esi
1:      movl    4(%esi), %eax
        testl   %eax, %eax
        jz      2f
        addl    (%esi), %eax            /* a block lies in the arena if it ends after the arena's start */
        cmpl    %edx, %eax
        jbe     2f
        movl    (%esi), %eax            /* and begins before the arena's end */
        subl    A_SIZE(%edi), %eax
        jb      3f
        cmpl    %edx, %eax
        jb      3f
2:      addl    $8, %esi
        cmpl    $blocks_end, %esi
        jb      1b
        movl    A_HANDLE(%edi), %edx
        movl    $0, A_SIZE(%edi)
        movl    $0, A_HANDLE(%edi)
        decl    %edx
        pushl   %edx
        movl    $0x0d00, %eax           /* unlock */
        call    xms_call
        popl    %edx
        movl    $0x0a00, %eax           /* free */
        call    xms_call
3:      ret

/* Finds the first block that overlaps the ECX bytes at EDX, ignoring the entry at EBX. Out: carry and ESI = entry; no
   carry if there is none. EAX is lost. */
overlap:
        movl    $blocks, %esi
1:      movl    4(%esi), %eax
        testl   %eax, %eax
        jz      2f
        cmpl    %ebx, %esi
        je      2f
        addl    (%esi), %eax
        cmpl    %eax, %edx              /* after the block's end? */
        jae     2f
        movl    %edx, %eax
        addl    %ecx, %eax
        cmpl    (%esi), %eax            /* before the block's start? */
        ja      3f
2:      addl    $8, %esi
        cmpl    $blocks_end, %esi
        jb      1b
        clc
        ret
3:      stc
        ret

/* Out: EAX = end of arena EDI together with the arenas that follow it without a gap. ESI is lost. */
arena_end:
        movl    A_BASE(%edi), %eax
        addl    A_SIZE(%edi), %eax
1:      movl    $arenas, %esi
2:      cmpl    $0, A_SIZE(%esi)
        je      3f
        cmpl    A_BASE(%esi), %eax
        jne     3f
        addl    A_SIZE(%esi), %eax
        jmp     1b
3:      addl    $16, %esi
        cmpl    $arenas_end, %esi
        jb      2b
        ret

/* Finds ECX free bytes that begin in arena EDI. Out: EDX = their start, or carry. EAX, EBX, ESI are lost. */
arena_fit:
        movl    A_BASE(%edi), %edx
        xorl    %ebx, %ebx
1:      movl    A_BASE(%edi), %eax      /* does the place begin in this arena? */
        addl    A_SIZE(%edi), %eax
        cmpl    %eax, %edx
        cmc
        jc      2f
        call    arena_end
        subl    %edx, %eax              /* bytes from the place to the end */
        cmpl    %ecx, %eax
        jb      2f
        call    overlap
        jnc     2f
        movl    (%esi), %edx
        addl    4(%esi), %edx
        jmp     1b
2:      ret

/* Allocates a block of ECX bytes (a multiple of 4 KB, not 0). Out: EDX = base, EDI = entry; or carry and AX = error. */
mem_alloc:
        movl    $arenas, %edi
1:      cmpl    $0, A_SIZE(%edi)
        je      2f
        call    arena_fit
        jnc     4f
2:      addl    $16, %edi
        cmpl    $arenas_end, %edi
        jb      1b
        pushl   %ecx
        call    arena_new
        popl    %ecx
        movl    $E_NO_PHYSICAL, %eax
        jc      7f
        movl    $arenas, %edi           /* from the first one: the new arena may continue an older one */
8:      cmpl    $0, A_SIZE(%edi)
        je      9f
        call    arena_fit
        jnc     4f
9:      addl    $16, %edi
        jmp     8b
4:      movl    $blocks, %edi
5:      cmpl    $0, 4(%edi)
        je      6f
        addl    $8, %edi
        cmpl    $blocks_end, %edi
        jb      5b
        movw    $E_NO_HANDLE, %ax
        stc
        ret
6:      call    mem_commit
        jc      7f
        movl    %edx, (%edi)
        movl    %ecx, 4(%edi)
7:      ret

/* --- Pages. In plain real mode linear addresses equal physical addresses; under VCPI the server supplies single
       pages. --- */

/* Calls VCPI function EAX from PM. Servers should return with RETF, but DOSBox returns with IRETD; both work here. */
vcpi_call:
        pushl   %ebp
        movl    %esp, %ebp
        pushfl
        lcall   *vcpi_entry
        movl    %ebp, %esp
        popl    %ebp
        ret

/* Maps memory to the ECX bytes at linear address EDX. Out: carry and AX = error if there is none left. Other registers
   are kept. */
mem_commit:
        pushl   %ebx
        pushl   %ecx
        pushl   %edx
        pushl   %esi
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    %edx, %ebx
1:      call    page_table
        jc      2f
        movl    %edx, %esi
        cmpl    $0, vcpi_entry
        je      4f
        movl    $0xde04, %eax           /* EDX = physical address of a page */
        call    vcpi_call
        xchgl   %edx, %esi
        testb   %ah, %ah
        jnz     2f
        andl    $~0xfff, %esi
4:      movl    %edx, %eax
        shrl    $12, %eax
        orl     $7, %esi
        movl    %esi, %fs:PTES(, %eax, 4)
        addl    $4096, %edx
        subl    $4096, %ecx
        jnz     1b
        popl    %esi
        popl    %edx
        popl    %ecx
        popl    %ebx
        clc
        ret
2:      movl    %edx, %ecx              /* unmap the pages that were mapped */
        movl    %ebx, %edx
        subl    %ebx, %ecx
        jz      3f
        call    mem_uncommit
3:      popl    %esi
        popl    %edx
        popl    %ecx
        popl    %ebx
        movw    $E_NO_PHYSICAL, %ax
        stc
        ret

/* Makes sure that there is a page table for linear address EDX. Out: carry if there is no page for the table. EAX, ESI
   are lost. FS must be FLAT_DS. */
        .globl  page_table
page_table:
        movl    %edx, %esi
        shrl    $22, %esi
        testb   $1, %fs:PDES(, %esi, 4)
        jnz     1f                      /* no carry */
        pushl   %edx
        cmpl    $0, vcpi_entry
        je      3f
        movl    $0xde04, %eax
        call    vcpi_call
        testb   %ah, %ah
        jnz     5f
        andl    $~0xfff, %edx
        jmp     4f
3:      movl    pool_next, %edx
        cmpl    pool_end, %edx
        jae     5f
        addl    $4096, pool_next
4:      orl     $7, %edx
        movl    %edx, %fs:PDES(, %esi, 4)
        shll    $12, %esi               /* clear the new table, which is visible at PTES now */
        pushl   %ecx
        movl    $1024, %ecx
2:      movl    $0, %fs:PTES - 4(%esi, %ecx, 4)
        loop    2b
        popl    %ecx
        popl    %edx
        clc
1:      ret
5:      popl    %edx
        stc
        ret

/* Unmaps the ECX bytes at linear address EDX. All registers except EAX are kept. */
mem_uncommit:
        pushl   %ecx
        pushl   %edx
        pushl   %esi
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        shrl    $12, %edx
        shrl    $12, %ecx
1:      movl    %edx, %esi
        movl    %fs:PTES(, %esi, 4), %edx
        movl    $0, %fs:PTES(, %esi, 4)
        cmpl    $0, vcpi_entry
        je      2f
        andl    $~0xfff, %edx
        movl    $0xde05, %eax           /* free page */
        call    vcpi_call
2:      leal    1(%esi), %edx
        loop    1b
        movl    %cr3, %eax              /* flush the processor's address translations */
        movl    %eax, %cr3
        popl    %esi
        popl    %edx
        popl    %ecx
        ret

/* At the end of the client: under VCPI returns all pages to the server. */
        .globl  mem_free_all
mem_free_all:
        cmpl    $0, vcpi_entry
        je      9f
        movl    $blocks, %edi
1:      movl    (%edi), %edx
        movl    4(%edi), %ecx
        jecxz   2f
        call    mem_uncommit
2:      addl    $8, %edi
        cmpl    $blocks_end, %edi
        jb      1b
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    $1022, %edi
3:      movl    %fs:PDES(, %edi, 4), %edx
        testb   $1, %dl
        jz      4f
        movl    $0, %fs:PDES(, %edi, 4)
        andl    $~0xfff, %edx
        movl    $0xde05, %eax
        call    vcpi_call
4:      decl    %edi
        jnz     3b                      /* entry 0, the first page table, lies in DOS memory */
9:      ret

/* Frees the block with entry EDI, and arenas that are now empty. All registers except EBP are lost. */
mem_free:
        movl    (%edi), %edx
        movl    4(%edi), %ecx
        call    mem_uncommit
        movl    $0, 4(%edi)
        movl    $arenas, %edi
1:      cmpl    $0, A_SIZE(%edi)
        je      2f
        pushl   %edi
        call    arena_release
        popl    %edi
2:      addl    $16, %edi
        cmpl    $arenas_end, %edi
        jb      1b
        ret

/* Out: EDI = entry of the block with the client's handle SI:DI, or carry and AX = 8023h. */
block_entry:
        movzwl  F_ESI(%ebp), %eax
        shll    $16, %eax
        movw    F_EDI(%ebp), %ax
/* Out: EDI = entry of the block with handle EAX, or carry and AX = 8023h. */
block_find:
        movl    $blocks, %edi
1:      cmpl    $0, 4(%edi)
        je      2f
        cmpl    %eax, (%edi)
        je      3f
2:      addl    $8, %edi
        cmpl    $blocks_end, %edi
        jb      1b
        movw    $E_HANDLE, %ax
        stc
3:      ret

/* Rounds the size BX:CX up to whole pages. Out: ECX = size; or carry and AX = 8021h for 0 and for sizes near 4 GB. */
block_size:
        shll    $16, %ebx
        movw    %cx, %bx
        movl    %ebx, %ecx
        testl   %ecx, %ecx
        jz      1f
        addl    $0xfff, %ecx
        jc      1f
        andl    $~0xfff, %ecx
        ret
1:      movw    $E_VALUE, %ax
        stc
        ret

/* Returns the block at EDX to the client: BX:CX = address, SI:DI = handle. */
block_result:
        movw    %dx, F_ECX(%ebp)
        movw    %dx, F_EDI(%ebp)
        shrl    $16, %edx
        movw    %dx, F_EBX(%ebp)
        movw    %dx, F_ESI(%ebp)
        clc
        ret

/* 0500h  free memory information.  In: ES:EDI = buffer of 30h bytes.  Out: the buffer; unknown fields are -1. Locked and
   unlocked pages are all physical pages, and there is no swap file. */
        .globl  svc_0500
svc_0500:
        call    arena_possible
        pushl   %eax                    /* total free */
        pushl   %eax                    /* largest piece */
        pushl   $0                      /* size of all arenas */
        movl    $arenas, %edi
1:      movl    A_SIZE(%edi), %eax
        addl    %eax, (%esp)
        movl    A_BASE(%edi), %edx      /* walk through the gaps of the arena */
2:      movl    A_BASE(%edi), %ecx
        addl    A_SIZE(%edi), %ecx      /* ECX = start of the next block above EDX, or end of the arena */
        cmpl    %ecx, %edx
        jae     6f
        movl    $blocks, %esi
3:      movl    4(%esi), %eax
        testl   %eax, %eax
        jz      4f
        addl    (%esi), %eax
        cmpl    %eax, %edx              /* after this block? */
        jae     4f
        cmpl    (%esi), %edx            /* inside this block? */
        jae     5f
        cmpl    (%esi), %ecx
        jbe     4f
        movl    (%esi), %ecx
4:      addl    $8, %esi
        cmpl    $blocks_end, %esi
        jb      3b
        movl    %ecx, %eax              /* a gap from EDX to ECX */
        subl    %edx, %eax
        addl    %eax, 8(%esp)
        cmpl    4(%esp), %eax
        jbe     7f
        movl    %eax, 4(%esp)
7:      movl    %ecx, %edx
        jmp     2b
5:      movl    %eax, %edx              /* go on at the block's end */
        jmp     2b
6:      addl    $16, %edi
        cmpl    $arenas_end, %edi
        jb      1b
        movw    F_ES(%ebp), %es
        movl    F_EDI(%ebp), %edi
        movl    $12, %ecx
        movl    $-1, %eax
        pushl   %edi
        rep stosl
        popl    %edi
        popl    %ecx                    /* arenas */
        popl    %edx                    /* largest */
        popl    %eax                    /* free */
        movl    %edx, %es:(%edi)        /* 00h largest block in bytes */
        shrl    $12, %edx
        movl    %edx, %es:4(%edi)       /* 04h largest unlocked, 08h largest lockable, in pages */
        movl    %edx, %es:8(%edi)
        shrl    $12, %eax
        movl    %eax, %es:0x10(%edi)    /* 10h unlocked pages, 14h free pages */
        movl    %eax, %es:0x14(%edi)
        movl    %eax, %es:0x1c(%edi)    /* 1Ch free linear space in pages */
        cmpl    $0, xms_entry
        je      8f
        shrl    $12, %ecx
        addl    %eax, %ecx
        jmp     9f
8:      shrl    $12, %ecx
9:      movl    %ecx, %es:0x0c(%edi)    /* 0Ch linear space, 18h physical pages */
        movl    %ecx, %es:0x18(%edi)
        movl    $0, %es:0x20(%edi)      /* 20h size of the swap file */
        clc
        ret

/* 0501h  allocate.  In: BX:CX = bytes.  Out: BX:CX = linear address, SI:DI = handle. */
        .globl  svc_0501
svc_0501:
        call    block_size
        jc      1f
        call    mem_alloc
        jc      1f
        jmp     block_result
1:      ret

/* 0502h  free.  In: SI:DI = handle. */
        .globl  svc_0502
svc_0502:
        call    block_entry
        jc      1f
        call    mem_free
        clc
1:      ret

/* Tells whether block EBX can grow to ECX bytes in place. Out: EDX = its base; carry if it cannot. With carry, the zero
   flag is clear if only the end of the arena prevents it, which is EAX bytes after the base; it is set if another block
   does. EAX, ESI, EDI are lost. */
room_behind:
        movl    (%ebx), %edx
        movl    $arenas, %edi
1:      movl    %edx, %eax
        subl    A_BASE(%edi), %eax
        cmpl    A_SIZE(%edi), %eax
        jb      2f
        addl    $16, %edi
        jmp     1b
2:      call    overlap
        jc      3f
        call    arena_end
        subl    %edx, %eax
        cmpl    %ecx, %eax
        ret
3:      xorl    %eax, %eax              /* zero */
        stc
        ret

/* 0503h  resize.  In: BX:CX = bytes, SI:DI = handle.  Out: as 0501h; when the block moves, its contents are copied. */
        .globl  svc_0503
svc_0503:
        call    block_size
        jc      9f
        call    block_entry
        jc      9f
        movl    (%edi), %edx
        cmpl    4(%edi), %ecx
        je      block_result
        jb      5f
        movl    %edi, %ebx              /* larger: is there room after the block? */
        call    room_behind
        jnc     2f
        jz      4f                      /* no: another block is there */
        pushl   %ebx                    /* the arena ends: perhaps a new arena continues it */
        pushl   %ecx
        subl    %eax, %ecx              /* the bytes that are missing */
        call    arena_new
        popl    %ecx
        popl    %ebx
        call    room_behind
        jc      4f
2:      movl    %ebx, %edi
        pushl   %ecx
        pushl   %edx
        movl    4(%edi), %eax
        addl    %eax, %edx
        subl    %eax, %ecx
        call    mem_commit
        popl    %edx
        popl    %ecx
        jc      9f
3:      movl    %ecx, 4(%edi)
        jmp     block_result
5:      pushl   %ecx                    /* smaller: the block stays in place */
        pushl   %edx
        addl    %ecx, %edx
        subl    4(%edi), %ecx
        negl    %ecx
        call    mem_uncommit
        popl    %edx
        popl    %ecx
        jmp     3b
4:      pushl   %ebx                    /* no room: allocate a new block and copy */
        call    mem_alloc
        popl    %ebx
        jc      9f
        pushl   %edx
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    (%ebx), %esi            /* for the copy, make pages present that 0507h made absent, and mark them */
        movl    4(%ebx), %ecx
        shrl    $12, %esi
        shrl    $12, %ecx
6:      testb   $1, %fs:PTES(, %esi, 4)
        jnz     7f
        orl     $0x201, %fs:PTES(, %esi, 4)
7:      incl    %esi
        loop    6b
        movl    %edx, %edi
        movl    (%ebx), %esi
        movl    4(%ebx), %ecx
        shrl    $2, %ecx
        movw    $FLAT_DS, %ax
        movw    %ax, %ds
        movw    %ax, %es
        rep movsl
        pushl   %ss
        popl    %ds
        pushl   %ss
        popl    %es
        movl    (%ebx), %esi            /* make the marked pages absent at the new place */
        movl    4(%ebx), %ecx
        shrl    $12, %esi
        shrl    $12, %ecx
        shrl    $12, %edx
6:      testl   $0x200, %fs:PTES(, %esi, 4)
        jz      7f
        andb    $~1, %fs:PTES(, %edx, 4)
7:      incl    %esi
        incl    %edx
        loop    6b
        movl    %ebx, %edi
        call    mem_free
        popl    %edx
        jmp     block_result
9:      ret

/* 0507h  set page attributes, a DPMI 1.0 function that DJGPP's crt0 calls to make NULL pointers fault.
   In: ESI = handle, EBX = offset in the block, ECX = number of pages, ES:EDX = a word for each page: bits 0
   to 2 = 0 absent, 1 present, 3 unchanged; bit 3 = writeable.  Out: on a bad word, ECX = number of pages done. */
        .globl  svc_0507
svc_0507:
        movl    F_ESI(%ebp), %eax
        call    block_find
        jc      9f
        testl   $0x0fff, %ebx
        jnz     8f
        movl    F_ECX(%ebp), %ecx
        cmpl    $0x100000, %ecx
        jae     8f
        movl    %ecx, %eax
        shll    $12, %eax
        addl    %ebx, %eax
        jc      8f
        cmpl    4(%edi), %eax
        ja      8f
        jecxz   4f
        addl    (%edi), %ebx            /* linear */
        shrl    $12, %ebx
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        movl    F_EDX(%ebp), %esi
        movw    F_ES(%ebp), %es
1:      movzwl  %es:(%esi), %eax
        movl    %fs:PTES(, %ebx, 4), %edx
        andb    $~2, %dl                /* not writeable */
        testb   $8, %al
        jz      2f
        orb     $2, %dl
2:      andb    $7, %al
        cmpb    $3, %al
        je      3f
        andb    $~1, %dl                /* absent; the entry keeps the address, as the page still belongs to the block */
        cmpb    $1, %al
        jb      3f
        ja      7f
        orb     $1, %dl
3:      movl    %edx, %fs:PTES(, %ebx, 4)
        incl    %ebx
        addl    $2, %esi
        loop    1b
        movl    %cr3, %eax
        movl    %eax, %cr3
4:      clc
        ret
7:      movl    %cr3, %eax              /* the pages before the bad word have changed */
        movl    %eax, %cr3
        movl    F_ECX(%ebp), %eax
        subl    %ecx, %eax
        movl    %eax, F_ECX(%ebp)
8:      movw    $E_VALUE, %ax
        stc
9:      ret

/* 0800h  map physical memory.  In: BX:CX = physical address, SI:DI = bytes.  Out: BX:CX = linear address. It equals the
   physical address in plain real mode; under VCPI linear addresses from C0000000h on are used and never freed. */
        .globl  svc_0800
svc_0800:
        shll    $16, %ebx
        movw    %cx, %bx
        cmpl    $0x100000, %ebx
        jb      1f
        movzwl  F_ESI(%ebp), %eax
        shll    $16, %eax
        movw    F_EDI(%ebp), %ax
        testl   %eax, %eax
        jz      1f
        leal    -1(%eax, %ebx), %ecx    /* the last byte */
        cmpl    %ebx, %ecx
        jb      1f
        movw    $FLAT_DS, %ax
        movw    %ax, %fs
        andl    $~0xfff, %ebx
        movl    %ebx, %edx
        cmpl    $0, vcpi_entry
        je      3f
        movl    map_next, %edx
3:      pushl   %edx
2:      cmpl    $PTES, %edx
        jae     4f
        call    page_table
        jc      4f
        movl    %edx, %esi
        shrl    $12, %esi
        leal    7(%ebx), %eax
        movl    %eax, %fs:PTES(, %esi, 4)
        addl    $4096, %edx
        addl    $4096, %ebx
        jc      5f
        cmpl    %ecx, %ebx
        jbe     2b
5:      cmpl    $0, vcpi_entry
        je      6f
        movl    %edx, map_next
6:      popl    %edx
        movl    F_ECX(%ebp), %eax       /* the offset in the page stays */
        andl    $0x0fff, %eax
        addl    %edx, %eax
        movw    %ax, F_ECX(%ebp)
        shrl    $16, %eax
        movw    %ax, F_EBX(%ebp)
        clc
        ret
4:      popl    %edx
        movw    $E_NO_LINEAR, %ax
        stc
        ret
1:      movw    $E_VALUE, %ax
        stc
        ret

        ASM_END
