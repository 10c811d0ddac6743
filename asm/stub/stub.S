/* The real-mode stub of the EXE: a go32 loader that needs no other file.

   The steps from the MZ header to the program:

     1. DOS loads the stub (this part and the DPMI host that follows it) and jumps to `start`.
     2. Without DOS 3 and a 386 the stub prints one line and ends with exit status 1.
     3. The file name of the program is found after the environment.
     4. Int 2Fh AX=1687h asks for a DPMI host. If there is none, the host after this part is moved above the
        transfer buffer and set up (dpmiinit.S); its entry point is of the kind that int 2Fh returns.
        From here on it makes no difference whose host it is.
     5. Memory that is not needed is returned to DOS.
     6. The COFF header that follows the stub is read from the file.
     7. The host's entry point switches to protected mode; this code goes on as a 16-bit code segment there.
     8. Code and data descriptors and one memory block for the program are allocated.
     9. .text and .data are read through the transfer buffer, .bss is cleared.
    10. Far jump to the program with DS = its data, FS = the stub information block, SS:ESP = our stack.

   The interface of steps 8 to 10 is that of DJGPP's version 2 stub (go32 stubinfo), so that both DJGPP's
   crt0 and our start code can follow it.

   Offsets in our segment, which becomes the transfer buffer when the program runs:

     0               stub information, code, messages        -- section .loader
     behind .loader  variables, header buffers, stack        -- section .lbss, up to loader_end
     0x1000          file buffer, to the end of the transfer buffer (stubinfo: minkeep, 16 KB)
     minkeep         embedded DPMI host, when it is used */

#include "asm.h"
#undef i386             /* gcc defines it; here it names an .arch */

#define FILE_BUFFER 0x1000
#define MIN_KEEP    16384

/* Offsets in the COFF file header, in its go32 optional header and in a section header. */
#define COFF_MAGIC  0x014c
#define COFF_HEADER 168         /* file header 20, optional header 28, three section headers of 40 bytes each */
#define COFF_ENTRY  (20 + 16)
#define COFF_TEXT   48
#define COFF_DATA   88
#define COFF_BSS    128
#define S_VADDR     12
#define S_SIZE      16
#define S_SCNPTR    20

        .code16
        .arch   i8086
        SECTION(.loader)

/* --- Stub information: the program finds it at FS:0. DJGPP's tools and crt0 expect these fields. --- */
stubinfo:
si_magic:       .ascii  "go32stub, v 2.05"
si_size:        .long   stubinfo_end - stubinfo
si_minstack:    .long   0x80000         /* least size of the program's stack in bytes, for DJGPP's crt0 */
si_handle:      .long   0               /* DPMI handle of the program's memory block */
si_initsize:    .long   0               /* size of that block */
si_minkeep:     .word   MIN_KEEP        /* size of the transfer buffer */
si_ds_sel:      .word   0               /* our data selector */
si_ds_seg:      .word   0               /* our segment */
si_psp_sel:     .word   0
si_cs_sel:      .word   0               /* our code selector: same base as our data */
si_env_size:    .word   0               /* size of the environment in bytes, including the program's name */
si_basename:    .fill   8, 1, 0         /* if set: load this file of our directory instead */
si_argv0:       .fill   16, 1, 0        /* if set: argv[0] for the program */
si_server:      .asciz  "CWSDPMI.EXE"   /* not used here: no separate host is loaded */
                .fill   4, 1, 0
                .balign 4
stubinfo_end:

/* --- Step 2. Only 8086 instructions up to need_386. --- */
        .globl  start
start:
        push    %cs
        pop     %ds
        mov     %ds, si_ds_seg
        mov     %es, psp
        cld
        mov     $0x30, %ah              /* DOS version */
        int     $0x21
        mov     $msg_dos, %dx
        cmp     $3, %al
        jb      early_error

        pushf                           /* 8086: bits 12 to 15 are always set */
        pop     %ax
        and     $0x0fff, %ax
        push    %ax
        popf
        pushf
        pop     %ax
        mov     $msg_cpu, %dx
        and     $0xf000, %ax
        cmp     $0xf000, %ax
        je      early_error
        mov     $0x7000, %ax            /* 80286: bits 12 to 14 are always clear in real mode */
        push    %ax
        popf
        pushf
        pop     %ax
        and     $0x7000, %ax
        jnz     need_386
early_error:                            /* DX: message, ends with '$' */
        mov     %dx, %si
        mov     $msg_prefix, %dx
        call    put_string
        mov     %si, %dx
        call    put_string
        mov     $0x4c01, %ax
        int     $0x21

/* Writes the text at DS:DX, up to '$', to standard error. AX, BX, CX, DI are lost. */
put_string:
        mov     %dx, %di
1:      cmpb    $'$', (%di)
        je      2f
        inc     %di
        jmp     1b
2:      mov     %di, %cx
        sub     %dx, %cx
        mov     $2, %bx
        mov     $0x40, %ah
        int     $0x21
        ret

need_386:
        .arch   i386
        xor     %ax, %ax                /* clear NT and IOPL again */
        push    %ax
        popf

/* --- Step 3. The environment is a list of strings, an empty string, a word, and our path. --- */
        mov     psp, %es
        mov     %es:0x2c, %es
        xor     %di, %di
        xor     %al, %al
        mov     $-1, %cx
1:      repne scasb
        scasb
        jne     1b
        scasw                           /* skip the word: the number of strings that follow */
        mov     $file_name, %si
        mov     %si, %bx
2:      mov     %es:(%di), %al
        inc     %di
        mov     %al, (%si)
        test    %al, %al
        jz      4f
        inc     %si
        cmp     $file_name_end - 14, %si
        jae     4f
        cmp     $'\\', %al
        je      3f
        cmp     $'/', %al
        je      3f
        cmp     $':', %al
        jne     2b
3:      mov     %si, %bx                /* BX: address after the last separator */
        jmp     2b
4:      movb    $0, (%si)
        mov     %di, si_env_size
        cmpb    $0, si_basename
        je      6f
        mov     $si_basename, %di       /* load another file of the same directory */
        mov     $8, %cx
5:      mov     (%di), %al
        test    %al, %al
        jz      5f
        mov     %al, (%bx)
        inc     %di
        inc     %bx
        loop    5b
5:      movl    $0x4558452e, (%bx)      /* ".EXE" */
        movb    $0, 4(%bx)
6:

/* Files that the parent left open can occupy all 20 handles that we inherit: close two to be sure of free ones. */
        mov     $0x3e, %ah
        mov     $19, %bx
        int     $0x21
        mov     $0x3e, %ah
        mov     $18, %bx
        int     $0x21

/* --- Steps 4 and 5. `behind`: segment of the first paragraph after the transfer buffer. --- */
        mov     si_minkeep, %ax
        cmp     $MIN_KEEP, %ax
        jae     1f
        mov     $MIN_KEEP, %ax
1:      cmp     $0xfe00, %ax
        jbe     2f
        mov     $0xfe00, %ax
2:      add     $15, %ax
        and     $0xfff0, %ax
        mov     %ax, si_minkeep
        shr     $4, %ax
        mov     %cs, %cx
        add     %cx, %ax
        mov     %ax, behind

        mov     $0x1687, %ax
        int     $0x2f
        test    %ax, %ax
        jnz     own_host
        test    $1, %bl                 /* does it accept 32-bit clients? */
        jz      own_host
        push    %cs                     /* step 5 for a host that was present: keep only the transfer buffer */
        pop     %ss
        mov     $stack_top, %sp
        mov     %di, mode_switch
        mov     %es, mode_switch + 2
        mov     %si, switch_mem
        mov     behind, %bx
        call    resize
        mov     switch_mem, %bx
        test    %bx, %bx
        jz      load
        mov     $0x48, %ah              /* the host's private memory */
        int     $0x21
        mov     $msg_memory, %dx
        jc      error
        mov     %ax, switch_seg
        jmp     load

own_host:
        mov     behind, %es             /* move the host's image above the transfer buffer */
        mov     psp, %ax
        mov     %es, %bx
        add     $host_paras, %bx
        push    %ds
        mov     %ax, %ds
        cmp     %bx, 2                  /* PSP: first segment after our memory block */
        pop     %ds
        mov     $msg_memory, %dx
        jb      error
        mov     $host_image, %si
        xor     %di, %di
        mov     $host_words, %cx
        rep movsw
        mov     %es, %ax
        mov     %ax, mode_switch + 2
        mov     %ax, init_entry + 2
        push    %cs                     /* only now, because our stack lies where the image was */
        pop     %ss
        mov     $stack_top, %sp
        call    resize
        mov     psp, %es
        lcall   *init_entry             /* dpmiinit.S. Carry: failure, DX = message in the host's segment */
        jnc     1f
        mov     behind, %ds
        jmp     error
1:      movw    $host_enter, mode_switch

/* --- Step 6. --- */
load:
        mov     $0x3d00, %ax
        mov     $file_name, %dx
        int     $0x21
        mov     $msg_open, %dx
        jc      error
        mov     %ax, file
        xor     %edi, %edi              /* EDI: file offset of the COFF header */
        call    read_header
        mov     header, %ax
        cmp     $COFF_MAGIC, %ax
        je      have_coff
        mov     $msg_format, %dx
        cmp     $0x5a4d, %ax            /* "MZ" */
        jne     error
        movzwl  header + 4, %edi        /* the stub's length in pages of 512 bytes, the last page partly used */
        shl     $9, %edi
        movzwl  header + 2, %eax
        test    %ax, %ax
        jz      1f
        lea     -512(%edi, %eax), %edi
1:      call    read_header
        mov     $msg_format, %dx
        cmpw    $COFF_MAGIC, header
        jne     error
have_coff:
        mov     header + COFF_ENTRY, %eax
        mov     %eax, entry
        add     %edi, header + COFF_TEXT + S_SCNPTR
        add     %edi, header + COFF_DATA + S_SCNPTR
        mov     header + COFF_BSS + S_VADDR, %eax
        add     header + COFF_BSS + S_SIZE, %eax
        cmp     $0x10001, %eax          /* crt0 needs a limit above 64 KB */
        jae     1f
        mov     $0x10001, %eax
1:      add     $0xffff, %eax
        xor     %ax, %ax
        mov     %eax, si_initsize

/* --- Step 7. --- */
        mov     switch_seg, %es
        mov     $1, %ax                 /* a 32-bit client */
        lcall   *mode_switch
        mov     $msg_switch, %dx
        jc      error
        mov     %es, si_psp_sel
        mov     %cs, si_cs_sel
        mov     %ds, si_ds_sel
        push    %ds
        pop     %es

/* --- Step 8. --- */
        call    new_descriptor
        mov     %ax, entry + 4
        call    new_descriptor
        mov     %ax, client_ds
        mov     $0x0501, %ax            /* allocate memory */
        mov     si_initsize, %cx
        mov     si_initsize + 2, %bx
        int     $0x31
        mov     $msg_ext_memory, %dx
        jc      error
        mov     %cx, client_base
        mov     %bx, client_base + 2
        mov     %di, si_handle
        mov     %si, si_handle + 2
        mov     $0xc09b, %cx            /* 32-bit code, 4 KB units, present */
        mov     entry + 4, %bx
        call    set_descriptor
        mov     $0xc093, %cx            /* 32-bit data, 4 KB units, present */
        mov     client_ds, %bx
        call    set_descriptor

/* --- Step 9. --- */
        mov     $header + COFF_TEXT, %si
        call    read_section
        mov     $header + COFF_DATA, %si
        call    read_section
        mov     client_ds, %es
        mov     header + COFF_BSS + S_VADDR, %edi
        mov     header + COFF_BSS + S_SIZE, %ecx
        xor     %eax, %eax
        push    %cx
        shr     $2, %ecx
        addr32 rep stosl
        pop     %cx
        and     $3, %cx
        movzwl  %cx, %ecx
        addr32 rep stosb
        mov     file, %bx
        mov     $0x3e, %ah
        int     $0x21

/* --- Step 10. --- */
        push    %ds
        pop     %fs
        mov     client_ds, %ds
        ljmpl   *%fs:entry

/* --- Helpers. --- */

/* Resizes the DOS memory block of the program to end at segment BX. */
resize:
        mov     psp, %es
        mov     %es, %ax
        sub     %ax, %bx
        mov     $0x4a, %ah
        int     $0x21
        mov     $msg_memory, %dx
        jc      error
        ret

/* Reads COFF_HEADER bytes at file offset EDI into `header`. */
read_header:
        mov     %di, %dx
        mov     %edi, %ecx
        shr     $16, %ecx
        mov     file, %bx
        mov     $0x4200, %ax
        int     $0x21
        mov     $COFF_HEADER, %cx
        mov     $header, %dx
        mov     $0x3f, %ah
        int     $0x21
        mov     $msg_format, %dx
        jc      error
        cmp     $COFF_HEADER, %ax
        jne     error
        ret

/* Protected mode: allocates one descriptor. Out: AX = selector. */
new_descriptor:
        xor     %ax, %ax
        mov     $1, %cx
        int     $0x31
        mov     $msg_selectors, %dx
        jc      error
        ret

/* Protected mode: makes descriptor BX cover the program's block, with access rights CX at our privilege level. */
set_descriptor:
        mov     %cs, %ax
        and     $3, %ax
        shl     $5, %ax
        or      %ax, %cx
        mov     $0x0009, %ax            /* rights */
        int     $0x31
        mov     client_base, %dx
        mov     client_base + 2, %cx
        mov     $0x0007, %ax            /* base */
        int     $0x31
        mov     si_initsize + 2, %cx    /* the size is a multiple of 64 KB */
        dec     %cx
        mov     $0xffff, %dx
        mov     $0x0008, %ax            /* limit */
        int     $0x31
        mov     $msg_selectors, %dx
        jc      error
        ret

/* Protected mode: reads the section whose header is at SI into the program's block. */
read_section:
        mov     S_VADDR(%si), %edi
        mov     S_SIZE(%si), %ebp
        mov     S_SCNPTR(%si), %dx
        mov     S_SCNPTR + 2(%si), %cx
        mov     %cx, dos_regs + 0x18
        mov     $0x4200, %ax
        call    dos_file
1:      test    %ebp, %ebp
        jz      3f
        movzwl  si_minkeep, %ecx
        sub     $FILE_BUFFER, %cx
        cmp     %ecx, %ebp
        jae     2f
        mov     %ebp, %ecx
2:      mov     %cx, dos_regs + 0x18
        mov     $FILE_BUFFER, %dx
        mov     $0x3f00, %ax
        call    dos_file
        movzwl  dos_regs + 0x18, %ecx
        cmp     dos_regs + 0x1c, %cx
        mov     $msg_short, %dx
        jne     error
        sub     %ecx, %ebp
        push    %es
        mov     client_ds, %es
        mov     $FILE_BUFFER, %esi
        addr32 rep movsb
        pop     %es
        jmp     1b
3:      ret

/* Protected mode: calls int 21h with AX, DX, CX from dos_regs, BX = file, DS = our segment. Ends the program on an error. */
dos_file:
        call    dos
        mov     $msg_short, %dx
        jc      error
        testb   $1, dos_regs + 0x20
        jnz     error
        ret

/* As dos_file, but the caller handles errors. In: AX, DX; CX in dos_regs. */
dos:
        mov     %ax, dos_regs + 0x1c
        mov     %dx, dos_regs + 0x14
        mov     file, %ax
        mov     %ax, dos_regs + 0x10
        mov     si_ds_seg, %ax
        mov     %ax, dos_regs + 0x24
        xor     %eax, %eax
        mov     %ax, dos_regs + 0x20    /* flags */
        mov     %eax, dos_regs + 0x2e   /* SS:SP = 0: the host supplies the stack */
        push    %edi
        mov     $0x0300, %ax
        mov     $0x0021, %bx
        xor     %cx, %cx
        mov     $dos_regs, %edi
        int     $0x31
        pop     %edi
        ret

/* Writes "Load error: FILE: message" to standard error and ends with exit status 1. In: DS:DX = message. Works in
   both modes; in real mode the message may lie in the host's segment. */
error:
        cmpw    $0, %cs:si_cs_sel       /* not 0 in protected mode */
        jne     2f
        mov     %dx, %si
        mov     $message, %di
        push    %cs
        pop     %es
1:      lodsb
        stosb
        cmp     $'$', %al
        jne     1b
        push    %cs
        pop     %ds
        mov     $message, %dx
2:      push    %dx
        mov     $msg_prefix, %dx
        call    put
        mov     $file_name, %dx
        call    put
        mov     $msg_colon, %dx
        call    put
        pop     %dx
        call    put
        mov     $msg_newline, %dx
        call    put
        mov     $0x4c01, %ax
        int     $0x21

/* Writes the text at DS:DX, up to '$' or NUL, to standard error. It writes single characters through one buffer,
   which works in both modes. */
put:
        mov     %dx, %si
        push    %ds
        pop     %es
1:      lodsb
        cmp     $'$', %al
        je      3f
        test    %al, %al
        jz      3f
        mov     %al, one_char
        mov     $one_char, %dx
        cmpw    $0, si_cs_sel
        jne     2f
        mov     $1, %cx
        mov     $2, %bx
        mov     $0x40, %ah
        int     $0x21
        jmp     1b
2:      movw    $1, dos_regs + 0x18
        movw    $2, file
        mov     $0x4000, %ax
        call    dos
        jmp     1b
3:      ret

msg_prefix:     .ascii  "Load error: $"
msg_colon:      .ascii  ": $"
msg_newline:    .ascii  "\r\n$"
msg_dos:        .ascii  "DOS 3 or later is needed\r\n$"
msg_cpu:        .ascii  "a 386 or better is needed\r\n$"
msg_memory:     .ascii  "not enough DOS memory$"
msg_open:       .ascii  "cannot be opened$"
msg_format:     .ascii  "no COFF program behind the stub$"
msg_switch:     .ascii  "the DPMI host refuses a 32-bit program$"
msg_selectors:  .ascii  "the DPMI host has no free descriptors$"
msg_ext_memory: .ascii  "not enough extended memory$"
msg_short:      .ascii  "file is cut short or cannot be read$"

/* Offset in the host's segment; the code above fills in the segment. */
init_entry:     .word   host_init, 0

/* Variables that are used before the host's image is moved; until then it occupies .lbss. */
psp:            .word   0
behind:         .word   0
mode_switch:    .word   0, 0
switch_mem:     .word   0
switch_seg:     .word   0
file_name:      .fill   96, 1, 0
file_name_end:

        SECTION_BSS(.lbss)
file:           .skip   2
entry:          .skip   6       /* EIP, then the program's code selector */
client_ds:      .skip   2
client_base:    .skip   4
one_char:       .skip   2
        .globl  message, message_end
message:        .skip   160     /* one of the host's messages; stub.ld checks that all of them together would fit */
message_end:
        .balign 4
dos_regs:       .skip   52
header:         .skip   COFF_HEADER
        .balign 16
                .skip   1024
stack_top:

        ASM_END
