/* RUN.COM: starts DEMO.EXE with the switches that follow it, with standard error going where standard output goes, so
   that `RUN /M:SCENE.FB > OUT.TXT` leaves in OUT.TXT what the program says whether it plays or not. Ends with DEMO's
   own exit status. DOS's shell has no way to redirect standard error. */
        .code16
        .text
        .globl  start
start:
        movw    $stack, %sp
        movb    $0x4a, %ah              /* only as much memory as this needs; ES is the PSP */
        movw    $(stack - start + 0x100 + 15) / 16, %bx
        int     $0x21
        movb    $0x46, %ah              /* handle 2 becomes what handle 1 is */
        movw    $1, %bx
        movw    $2, %cx
        int     $0x21
        movw    %cs, tailSegment
        movw    %cs, fcb1Segment
        movw    %cs, fcb2Segment
        movw    $0x4b00, %ax            /* load and run; the command tail is this program's own */
        movw    $program, %dx
        movw    $block, %bx
        int     $0x21
        movw    $0x4cff, %ax
        jc      1f
        movb    $0x4d, %ah              /* how it ended */
        int     $0x21
        movb    $0x4c, %ah
1:      int     $0x21

program:
        .asciz  "DEMO.EXE"
        .balign 2
block:  .word   0                       /* the environment of this program */
        .word   0x80
tailSegment:
        .word   0
        .word   0x5c
fcb1Segment:
        .word   0
        .word   0x6c
fcb2Segment:
        .word   0
        .balign 2
        .space  256
stack:
