/* PLAY.COM: runs DEMO.EXE with the same command line, its standard error in ERRORS.TXT, and ends with its status. The
   prompt of DOS can send only the standard output to a file, and what DOSBox's window shows is gone with the window.
   For tools/play.sh. */
	.code16
	.globl	start

	.set	PSP_TAIL, 0x80		/* the command line, in our own PSP */
	.set	PSP_FCB1, 0x5c
	.set	PSP_FCB2, 0x6c
	.set	STACK, 0x800		/* where our memory ends, from the PSP on */

start:
	movw	$STACK, %sp
	movb	$0x4a, %ah		/* the memory behind it is for DEMO.EXE */
	movw	$(STACK >> 4), %bx
	int	$0x21
	jc	failed

	movb	$0x3c, %ah		/* create the file */
	xorw	%cx, %cx
	movw	$errors, %dx
	int	$0x21
	jc	failed
	movw	%ax, %bx
	movb	$0x46, %ah		/* it becomes handle 2, which programs inherit */
	movw	$2, %cx
	int	$0x21
	jc	failed
	movb	$0x3e, %ah
	int	$0x21

	movw	%cs, tail + 2
	movw	%cs, fcb1 + 2
	movw	%cs, fcb2 + 2
	movw	$0x4b00, %ax		/* load and run */
	movw	$program, %dx
	movw	$parameters, %bx
	int	$0x21
	movw	%cs, %dx		/* (old versions come back with another stack) */
	movw	%dx, %ss
	movw	$STACK, %sp
	jc	failed
	movb	$0x4d, %ah		/* its status */
	int	$0x21
	movb	$0x4c, %ah
	int	$0x21

failed:
	movw	$0x4cff, %ax
	int	$0x21

errors:		.asciz	"ERRORS.TXT"
program:	.asciz	"DEMO.EXE"
parameters:	.word	0		/* our environment */
tail:		.word	PSP_TAIL, 0
fcb1:		.word	PSP_FCB1, 0
fcb2:		.word	PSP_FCB2, 0
