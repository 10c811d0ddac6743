/* The start and the end of the host, in real or V86 mode.

     host_init    detects the memory of the machine, fills in the tables, hooks Ctrl-C and critical errors
     host_enter   the entry point, as int 2Fh AX=1687h returns one: makes the caller the client
     host_exit    called when the client has ended (int 21h AH=4Ch in PM, or a crash): restores the machine

   The processor state is that of DOS until host_enter, and again from rm_exit on. */

#include "dpmi.h"
#undef i386

        SECTION(.host)
        .code16

/* Far procedure. In: ES = PSP. Out: carry and DX = message (in our segment, ends with '$') if the host cannot start. */
        .globl  host_init
host_init:
        push    %ds
        push    %cs
        pop     %ds
        mov     %es, psp_seg
        push    %cs
        pop     %es
        cld
        mov     $hbss_start, %di
        mov     $hbss_words, %cx
        xor     %ax, %ax
        rep stosw

        xor     %eax, %eax
        mov     %cs, %ax
        mov     %ax, host_seg
        mov     $rm_ptrs, %si           /* fill in the segment of pointers into the host */
1:      mov     %ax, 2(%si)
        add     $4, %si
        cmp     $rm_ptrs_end, %si
        jb      1b
        shl     $4, %eax
        mov     %eax, host_base
        add     %eax, gdtr + 2
        add     %eax, idtr + 2
        mov     $gdt_bases, %si
2:      mov     (%si), %bx
        movzwl  2(%si), %edx
        add     %eax, %edx
        mov     %dx, gdt + 2(%bx)
        shr     $16, %edx
        mov     %dl, gdt + 4(%bx)
        mov     %dh, gdt + 7(%bx)
        add     $4, %si
        cmp     $gdt_bases_end, %si
        jb      2b

        mov     host_base, %eax         /* page directory at ES:0, first page table at ES:1000h */
        add     $pages + 0xfff, %eax
        and     $~0xfff, %eax
        mov     %eax, switch_table      /* CR3 */
        lea     0x1007(%eax), %edx
        mov     %eax, %ebx
        shr     $4, %eax
        mov     %ax, %es
        mov     %edx, %es:0
        lea     0x3(%ebx), %edx         /* the directory is its own last page table: all tables appear at PTES */
        mov     %edx, %es:0xffc
        mov     host_base, %eax
        add     %eax, switch_table + 4
        add     %eax, switch_table + 8
        add     $switch_table, %eax
        mov     %eax, switch_table_linear

        call    processor
        smsw    %ax
        mov     %al, cr0_start
        andb    $6, cr0_start
        test    $1, %al
        jz      3f
        call    vcpi_init
        jmp     4f
3:      call    memory_init
4:      push    %cs
        pop     %es
        pop     %ax                     /* the caller's DS */
        jc      5f
        push    %ax

        movl    $r0_stack_top, tss + 4
        movw    $HOST_DS, tss + 8
        movw    $104, tss + 102         /* no I/O permission map is needed: IOPL is 3 */

        mov     $0xf000, %ax            /* the BIOS of DOSBox contains this name */
        mov     %ax, %fs
        cmpl    $0x42534f44, %fs:0xe061
        jne     7f
        movb    $1, fault_defer
7:
        mov     $hlts, %di
        mov     $0xf4, %al
        mov     $HLT_COUNT, %cx
        rep stosb
        call    vectors
        push    %es
        mov     $0x34, %ah              /* ES:BX = InDOS flag */
        int     $0x21
        mov     %es, %ax
        movzwl  %ax, %eax
        shl     $4, %eax
        movzwl  %bx, %ebx
        add     %ebx, %eax
        mov     %eax, in_dos
        pop     %es

        xor     %ax, %ax                /* save all vectors */
        mov     %ax, %fs
        xor     %si, %si
        mov     $ivt_copy, %di
        mov     $256, %cx
        rep movsl %fs:(%si), %es:(%di)
        cli
        mov     host_seg, %ax
        shl     $16, %eax
        mov     $rm_int24, %ax
        mov     %eax, %fs:0x24 * 4
        mov     $rm_int23, %ax
        xchg    %eax, %fs:0x23 * 4
        mov     %eax, old_23
        cmpl    $0, xms_entry
        jne     6f
        cmpw    $raw_rm_to_pm, rm_to_pm_vec
        jne     6f
        mov     host_seg, %ax           /* we use all of the BIOS's extended memory: report none to others */
        shl     $16, %eax
        mov     $rm_int15, %ax
        xchg    %eax, %fs:0x15 * 4
        mov     %eax, old_15
6:      in      $0x21, %al
        mov     %al, pic_masks
        in      $0xa1, %al
        mov     %al, pic_masks + 1
        sti
        clc
        pop     %ax
5:      mov     %ax, %ds
        lret

/* Sets cpu_type (3, 4, 5 ...) and fpu_type. The processor is known to be at least a 386. */
processor:
        mov     $3, %bl
        pushfl
        pop     %eax
        mov     %eax, %ecx
        xor     $0x40000, %eax          /* only a 486 or better can change AC */
        push    %eax
        popfl
        pushfl
        pop     %eax
        cmp     %eax, %ecx
        je      1f
        inc     %bx
        mov     %ecx, %eax
        xor     $0x200000, %eax         /* if ID can be changed, there is CPUID */
        push    %eax
        popfl
        pushfl
        pop     %eax
        push    %ecx
        popfl
        cmp     %eax, %ecx
        je      1f
        .arch   pentium
        mov     $1, %eax
        cpuid
        .arch   i386
        .arch   .387
        mov     %ah, %bl
        and     $15, %bl
        cmp     $4, %bl                 /* the family; families above 15 count as 15 */
        jae     1f
        mov     $4, %bl
1:      mov     %bl, cpu_type
        movw    $0x5a5a, up_num
        fninit
        fnstsw  up_num
        cmpb    $0, up_num
        jne     2f
        mov     $3 << 4, %al            /* 387 */
        cmp     $3, %bl
        je      3f
        mov     $4 << 4, %al            /* 486 or better: built-in coprocessor */
3:      mov     %al, fpu_type
2:      ret

/* Fills in the IDT, its thunks, and the client's default handlers. */
vectors:
        xor     %bx, %bx                /* vector */
        mov     $thunks, %di
1:      mov     $entry_exc, %ax
        cmp     $8, %bl
        jb      2f
        mov     $entry_low, %ax
        cmp     $0x10, %bl
        jb      2f
        mov     $entry_int21, %ax
        cmp     $0x21, %bl
        je      2f
        mov     $entry_int2f, %ax
        cmp     $0x2f, %bl
        je      2f
        mov     $entry_int31, %ax
        cmp     $0x31, %bl
        je      2f
        mov     $entry_irq, %ax
        cmp     $0x70, %bl
        jb      3f
        cmp     $0x78, %bl
        jb      2f
3:      mov     $entry_soft, %ax
2:      mov     %bx, %si
        shl     $3, %si
        mov     %di, idt(%si)
        movl    $0xee000000 | HOST_CS, idt + 2(%si)
        movzbw  %bl, %dx
        mov     %dx, pm_vec(%si)
        movw    $USER_CS, pm_vec + 4(%si)
        movb    $0x6a, (%di)            /* PUSH vector */
        mov     %bl, 1(%di)
        movb    $0xe9, 2(%di)           /* JMP entry */
        sub     %di, %ax
        sub     $7, %ax
        cwtl
        mov     %eax, 3(%di)
        add     $8, %di
        inc     %bx
        cmp     $256, %bx
        jb      1b
        mov     pic_base, %bl           /* VCPI: the controllers may use other vectors, which get the same thunks */
        mov     $8, %di
        call    1f
        mov     pic_base + 1, %bl
        mov     $0x70, %di
1:      test    %bl, %bl
        jz      3f
        xor     %bh, %bh
        mov     $8, %cx
        shl     $3, %bx
        shl     $3, %di
2:      lea     thunks(%di), %ax
        mov     %ax, idt(%bx)
        add     $8, %bx
        add     $8, %di
        loop    2b
3:      ret

/* --- Memory and A20 in plain real mode. Linear addresses equal physical addresses. Only the first MB and the client's
       allocated blocks are mapped, so that a wild pointer causes a page fault. The 64 KB above the first MB are not
       mapped: a stack that overflows below the program's first byte faults there, even when the limit of the stack
       segment does not stop it (emulators do not check it; it may be 4 GB). Page tables come from a separate pool.
       In: ES = page directory. Out: carry and DX = message on failure. --- */
memory_init:
        mov     $0x1000, %di
        mov     $7, %eax
1:      stosl
        add     $0x1000, %eax
        cmp     $0x100000, %eax
        jb      1b
        mov     $0x4300, %ax
        int     $0x2f
        cmp     $0x80, %al
        jne     1f
        mov     $0x4310, %ax
        push    %es
        int     $0x2f
        mov     %bx, xms_entry
        mov     %es, xms_entry + 2
        pop     %es
        xor     %ah, %ah                /* version */
        lcall   *xms_entry
        cmp     $0x0300, %ax
        jb      2f
        movb    $0x80, xms_super
2:      mov     $0x05, %ah              /* local A20 enable */
        lcall   *xms_entry
        mov     $msg_a20, %dx
        cmp     $1, %ax
        jne     9f
        movb    $1, a20_mode
        mov     xms_super, %ah          /* EDX = free KB: reserve a page table for each 4 MB, and some more */
        add     $8, %ah
        xor     %edx, %edx
        lcall   *xms_entry
        cmpb    $0, xms_super
        jne     3f
        movzwl  %dx, %edx
3:      shr     $12, %edx
        add     $8, %dx
        shl     $2, %dx
        mov     %dx, %si
        mov     $0x09, %ah
        lcall   *xms_entry
        cmp     $1, %ax
        mov     %dx, %di
        mov     $msg_no_memory, %dx
        jne     9f
        mov     %di, %dx
        inc     %dx
        mov     %dx, pool_handle
        dec     %dx
        mov     $0x0c, %ah              /* DX:BX = physical address */
        lcall   *xms_entry
        cmp     $1, %ax
        mov     $msg_no_memory, %ax
        xchg    %ax, %dx
        jne     9f
        shl     $16, %eax
        mov     %bx, %ax
        movzwl  %si, %esi
        shl     $10, %esi
        add     %eax, %esi
        and     $~0xfff, %esi
        mov     %esi, pool_end
        add     $0xfff, %eax
        and     $~0xfff, %eax
        mov     %eax, pool_next
        clc
        ret

/* Without XMS the BIOS tells the memory. E801h counts KB up to 16 MB, and units of 64 KB above; 88h counts KB. Memory
   above 16 MB is used only if there is no hole below it. */
1:      mov     $0xe801, %ax
        xor     %cx, %cx
        xor     %dx, %dx
        int     $0x15
        jc      3f
        test    %ax, %ax
        jnz     4f
        mov     %cx, %ax
        mov     %dx, %bx
4:      movzwl  %ax, %eax
        shl     $10, %eax
        cmp     $0xf00000, %eax
        jne     5f
        movzwl  %bx, %ebx
        shl     $16, %ebx
        add     %ebx, %eax
        jmp     5f
3:      mov     $0x88, %ah
        int     $0x15
        movzwl  %ax, %eax
        shl     $10, %eax
5:      and     $~0xfff, %eax
        jz      vcpi_init               /* perhaps a memory manager has all of it */
        mov     %eax, %edx
        shr     $22, %edx
        add     $8, %dx
        shl     $12, %edx
        sub     %edx, %eax
        jbe     7f
        mov     %eax, arenas + 4
        movl    $0x100000, pool_next
        add     $0x100000, %edx
        mov     %edx, pool_end
        mov     %edx, arenas
        call    a20_test
        jnz     8f
        in      $0x92, %al              /* switch A20 on through port 92h, which is fast */
        mov     %al, %ah
        or      $2, %al
        and     $0xfe, %al              /* bit 0 resets the machine */
        out     %al, $0x92
        movb    $2, a20_mode
        call    a20_wait
        jnz     8f
        mov     $0xdf, %ah              /* else through the keyboard controller */
        call    kbc_output
        movb    $3, a20_mode
        call    a20_wait
        jnz     8f
        movb    $0, a20_mode
        mov     $msg_a20, %dx
9:      stc
        ret
7:      mov     $msg_no_memory, %dx
        stc
        ret
8:      clc
        ret

/* Writes AH to the output port of the keyboard controller. AL, CX are lost. */
kbc_output:
        call    kbc_ready
        mov     $0xd1, %al
        out     %al, $0x64
        call    kbc_ready
        mov     %ah, %al
        out     %al, $0x60
kbc_ready:
        xor     %cx, %cx
1:      in      $0x64, %al
        test    $2, %al
        loopnz  1b
        ret

/* Waits a while for A20. Out: zero flag clear if A20 is on. */
a20_wait:
        mov     $0x1000, %si
1:      call    a20_test
        jnz     2f
        dec     %si
        jnz     1b
2:      ret

/* Tests A20. Out: zero flag clear if it is on: then the BIOS's scratch area at 4F0h and the word 1 MB above it differ. */
a20_test:
        push    %cx
        push    %dx
        xor     %cx, %cx
        mov     %cx, %fs
        dec     %cx
        mov     %cx, %gs
        mov     %fs:0x4f0, %dx
        mov     $16, %cx
1:      incw    %fs:0x4f0
        mov     %fs:0x4f0, %bx
        cmp     %gs:0x500, %bx
        loope   1b
        mov     %dx, %fs:0x4f0
        pop     %dx
        pop     %cx
        ret

/* Sets up memory in V86 mode: the VCPI server fills our first page table; its pages are mapped to the rest of the
   linear address space when memory is allocated (dpmimem.S). In real mode this is the last resort. In: ES = page
   directory. Out: carry and DX = message on failure. */
vcpi_init:
        xor     %ax, %ax
        mov     %ax, %fs
        smsw    %ax
        mov     $msg_v86, %dx
        test    $1, %al
        jnz     5f
        mov     $msg_no_memory, %dx
5:      mov     %dx, %bp
        cmpl    $0, %fs:0x67 * 4
        je      9f
        xor     %cx, %cx                /* is there VCPI? DOSBox needs these values in CX and DI */
        mov     $0x0012, %di
        mov     $0xde00, %ax
        int     $0x67
        mov     %bp, %dx
        test    %ah, %ah
        jnz     9f
        mov     $0x1000, %di
        mov     $gdt + VCPI_SEL, %si
        mov     $0xde01, %ax            /* EBX = entry in the server's code segment */
        int     $0x67
        mov     %ebx, vcpi_entry
        movw    $VCPI_SEL, vcpi_entry + 4
        mov     $0x1000, %si            /* let ring 3 use the mapped pages */
1:      testb   $1, %es:(%si)
        jz      2f
        orb     $7, %es:(%si)
2:      add     $4, %si
        cmp     $0x2000, %si
        jb      1b
        mov     %es, %cx
        shr     $8, %cx
        call    physical
        mov     %edx, switch_table      /* CR3 */
        or      $3, %dl
        mov     %edx, %es:0xffc
        inc     %cx
        call    physical
        or      $7, %dl
        mov     %edx, %es:0
        mov     $0xde03, %ax            /* EDX = free pages; some will become page tables */
        int     $0x67
        mov     %edx, %eax
        shr     $10, %eax
        sub     %eax, %edx
        dec     %edx
        cmp     $0xb0000, %edx          /* keep below C0000000h, where physical memory is mapped (0800h) */
        jbe     3f
        mov     $0xb0000, %edx
3:      shl     $12, %edx
        mov     %edx, arenas + 4
        movl    $0x400000, arenas
        mov     $0xde0a, %ax            /* BX, CX = first vectors of the two interrupt controllers */
        int     $0x67
        mov     %bl, pic_base
        mov     %cl, pic_base + 1
        movw    $vcpi_pm_to_rm, pm_to_rm_vec
        movw    $vcpi_rm_to_pm, rm_to_pm_vec
        movb    $1, version_flags
        clc
        ret
9:      stc
        ret

/* Out: EDX = physical address of page CX of the first MB. */
physical:
        mov     $0xde06, %ax
        int     $0x67
        and     $0xf000, %dx
        ret

/* --- The entry point as for int 2Fh AX=1687h, a far procedure. In: AX bit 0 = 1 for a 32-bit client. Out: carry if
       refused; else in PM, with CS, DS, SS = selectors for the same segments, ES = PSP (100h bytes), FS = GS = 0. --- */
        .globl  host_enter
host_enter:
        test    $1, %al
        jnz     1f
        mov     $E_VALUE, %ax
        stc
        lret
1:      cli
        push    %ds
        push    %cs
        pop     %ds
        popw    client_ds
        popw    client_ip
        popw    client_cs
        mov     %ss, client_ss
        mov     %sp, client_sp
        movw    $pm_enter, pm_cont
        jmp     rm_to_pm

        .code32
pm_enter:
        movzwl  client_ds, %eax
        call    new_segment
        pushl   %eax                    /* DS; allocating the first descriptors cannot fail */
        movzwl  client_ss, %ebx
        cmpw    client_ds, %bx
        je      1f
        movl    %ebx, %eax
        call    new_segment
1:      pushl   %eax                    /* the IRET frame: SS */
        movzwl  client_sp, %eax
        pushl   %eax
        pushl   $IOPL3 | IF_BIT | 2
        movzwl  client_cs, %eax
        call    new_segment
        movb    $0xfa, 5(%edi)          /* code */
        pushl   %eax
        movzwl  client_ip, %eax
        pushl   %eax
        movzwl  psp_seg, %eax           /* in the PSP, the environment's segment is replaced by a selector */
        movl    %eax, %ebx
        shll    $4, %ebx
        movw    $FLAT_DS, %cx
        movw    %cx, %fs
        call    new_segment
        movw    $0x00ff, (%edi)
        pushl   %eax
        movzwl  %fs:0x2c(%ebx), %eax
        movw    %ax, env_seg
        testl   %eax, %eax
        jz      2f
        call    new_segment
        movw    %ax, %fs:0x2c(%ebx)
2:      popl    %es
        xorl    %eax, %eax
        movw    %ax, %fs
        movw    %ax, %gs
        movw    20(%esp), %ds
        iretl

/* --- The end of the client. Jumped to in PM. In: AL = exit status; DS = HOST_DS. --- */
        .globl  host_exit
host_exit:
        movb    %al, exit_code
        movl    %cr0, %eax              /* restore the coprocessor bits, which 0E01h can change */
        andb    $~6, %al
        orb     cr0_start, %al
        movl    %eax, %cr0
        call    mem_free_all
        movl    host_seg, %eax
        shll    $16, %eax
        movl    %eax, %edx
        movw    $rm_stack_top - 6, %dx
        movl    %edx, rm_spss
        movw    $2, rm_stack_top - 6
        movw    $rm_exit, %ax
        movl    %eax, rm_stack_top - 4
        movl    $r0_stack_top, %esp
        jmp     pm_to_rm

        .code16
rm_exit:
        mov     %cs, %ax
        mov     %ax, %ds
        xor     %ax, %ax
        mov     %ax, %es
        cld
        cmpb    $0, callbacks_used
        je      1f
        cmpl    $0, %es:0x33 * 4        /* a mouse driver may hold one of the call-backs */
        je      1f
        xor     %cx, %cx
        xor     %dx, %dx
        mov     $0x0c, %ax
        int     $0x33
1:      xor     %ax, %ax
        mov     %ax, %es
        mov     host_seg, %ax           /* restore the vectors that lead to us */
        xor     %di, %di
2:      cmp     %es:2(%di), %ax
        jne     3f
        mov     ivt_copy(%di), %edx
        mov     %edx, %es:(%di)
3:      add     $4, %di
        cmp     $1024, %di
        jb      2b
        mov     $arenas, %si
4:      mov     8(%si), %dx             /* handle + 1 */
        sub     $1, %dx
        jc      5f
        push    %dx
        mov     $0x0d, %ah              /* unlock, free */
        lcall   *xms_entry
        pop     %dx
        mov     $0x0a, %ah
        lcall   *xms_entry
5:      add     $16, %si
        cmp     $arenas_end, %si
        jb      4b
        mov     pool_handle, %dx
        sub     $1, %dx
        jc      9f
        push    %dx
        mov     $0x0d, %ah
        lcall   *xms_entry
        pop     %dx
        mov     $0x0a, %ah
        lcall   *xms_entry
9:      mov     a20_mode, %al
        dec     %al
        jnz     6f
        mov     $0x06, %ah              /* local A20 disable */
        lcall   *xms_entry
6:      dec     %al
        jnz     7f
        in      $0x92, %al
        and     $0xfc, %al
        out     %al, $0x92
        xor     %al, %al
7:      dec     %al
        jnz     8f
        mov     $0xdd, %ah
        call    kbc_output
8:      mov     psp_seg, %es
        mov     env_seg, %ax
        mov     %ax, %es:0x2c
        sti
        mov     exit_code, %al
        mov     $0x4c, %ah
        int     $0x21

/* --- Real-mode handlers. --- */

/* Critical error: makes the DOS call fail. */
        .globl  rm_int24
rm_int24:
        mov     $3, %al
        iret

/* Ctrl-C: prints the registers and ends the client. In a program that the client has started, the old handler is
   called. A client that has hooked the keyboard interrupt (DJGPP's libc does) has already seen the key and reacted;
   DOS finds the key later in the BIOS's buffer. This is not a second Ctrl-C, so DOS simply goes on. */
        .globl  rm_int23
rm_int23:
        push    %ax
        push    %bx
        mov     $0x51, %ah              /* BX = current PSP */
        int     $0x21
        cmp     %cs:psp_seg, %bx
        pop     %bx
        pop     %ax
        je      1f
        ljmp    *%cs:old_23
1:      cmpw    $USER_CS, %cs:pm_vec + 9 * 8 + 4
        je      up_stubs + (CALLBACKS + HOOKS + 1) * 5
        iret

/* Reports that no extended memory is left (int 15h AH=88h, AX=E801h). */
rm_int15:
        cmp     $0x88, %ah
        je      1f
        cmp     $0xe801, %ax
        je      2f
        ljmp    *%cs:old_15
2:      xor     %bx, %bx
        xor     %cx, %cx
        xor     %dx, %dx
1:      xor     %ax, %ax
        push    %bp
        mov     %sp, %bp
        andb    $0xfe, 6(%bp)           /* carry clear */
        pop     %bp
        iret

/* Save or restore state in RM (0305h): nothing to do. */
        .globl  rm_state
rm_state:
        lret

        .globl  host_messages, host_messages_end
host_messages:
msg_a20:        .ascii  "address line A20 cannot be switched on$"
msg_no_memory:  .ascii  "no extended memory$"
msg_v86:        .ascii  "a memory manager without VCPI is loaded: load a DPMI host too (CWSDPMI), or remove it$"
host_messages_end:

        ASM_END
