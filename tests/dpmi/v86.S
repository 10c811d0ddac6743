/* V86.COM: switches to protected mode by VCPI and straight back. DOSBox's memory manager offers VCPI but leaves the processor
   in real mode until a program uses VCPI; afterwards DOS runs in V86 mode, as it does under EMM386 from the start. So the
   VCPI side of the DPMI host can be tested. The exit status is 0 for V86 mode, 1 for real mode, 2 if there is no VCPI. */

        .code16
        .text
        .globl  start
start:
        xor     %cx, %cx                /* in real mode DOSBox answers only a caller that looks like JEMM */
        mov     $0x0012, %di
        mov     $0xde00, %ax
        int     $0x67
        test    %ah, %ah
        jnz     no
        mov     %cs, %ax
        add     $0x1fff, %ax            /* page directory and table, aligned to 4 KB */
        xor     %al, %al
        mov     %ax, %es
        xor     %di, %di
        xor     %ax, %ax
        mov     $4096, %cx
        cld
        rep stosw
        mov     $0x1000, %di
        mov     $gdt + 8, %si
        mov     $0xde01, %ax
        int     $0x67
        mov     %ebx, entry
        mov     %es, %cx
        shr     $8, %cx
        mov     $0xde06, %ax
        int     $0x67
        and     $0xf000, %dx
        mov     %edx, table
        inc     %cx
        mov     $0xde06, %ax
        int     $0x67
        mov     $7, %dl
        mov     %edx, %es:0
        xor     %eax, %eax
        mov     %cs, %ax
        mov     %ax, segment
        shl     $4, %eax
        mov     %eax, %esi
        add     %eax, gdtr + 2
        add     %eax, table + 4
        add     %eax, table + 8
        mov     %ax, gdt + 0x22
        mov     %ax, gdt + 0x2a
        shr     $16, %eax
        mov     %al, gdt + 0x24
        mov     %al, gdt + 0x2c
        mov     %esi, %eax
        add     $tss, %eax
        mov     %ax, gdt + 0x3a
        shr     $16, %eax
        mov     %al, gdt + 0x3c
        add     $table, %esi
        cli
        mov     $0xde0c, %ax
        int     $0x67

        .code32
pm:     mov     $0x28, %ax
        mov     %ax, %ds
        mov     %ax, %ss
        mov     $0xf000, %esp
        movzwl  segment, %eax
        push    %eax
        push    %eax
        push    %eax
        push    %eax
        push    %eax
        push    $0xf000
        push    $0x3002
        push    %eax
        push    $back
        mov     $0x30, %ax
        mov     %ax, %ds
        mov     $0xde0c, %eax
        lcall   *%ss:entry

        .code16
back:   sti
        smsw    %ax
        and     $1, %al
        xor     $1, %al
        jmp     quit
no:     mov     $2, %al
quit:   mov     $0x4c, %ah
        int     $0x21

        .balign 4
gdt:    .quad   0, 0, 0, 0              /* selectors 8, 10h, 18h: filled by the VCPI server */
        .quad   0x00409a000000ffff      /* 20h code */
        .quad   0x004092000000ffff      /* 28h data */
        .quad   0x00cf92000000ffff      /* 30h all memory */
        .quad   0x0000890000000067      /* 38h TSS */
gdtr:   .word   0x3f
        .long   gdt
idtr:   .word   0
        .long   0
table:  .long   0, gdtr, idtr
        .word   0, 0x38
        .long   pm
        .word   0x20
entry:  .long   0
        .word   8
segment: .word  0
tss:    .fill   104, 1, 0

        .section .note.GNU-stack,"",@progbits
