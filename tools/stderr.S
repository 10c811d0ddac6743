/* Runs DEMO.EXE with the same command line and its standard error redirected, which the prompt of DOS cannot do, and ends
   with its status.

     RUN.COM     for the page: standard error goes where standard output goes, so that `RUN /M:SCENE.FB > OUT.TXT` leaves
                 in OUT.TXT what the program says whether it plays or not
     PLAY.COM    for tools/play.sh, assembled with -DAPART: it goes to ERRORS.TXT */
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

	movw	$1, %bx			/* standard output */
#ifdef APART
	movb	$0x3c, %ah		/* create the file */
	xorw	%cx, %cx
	movw	$errors, %dx
	int	$0x21
	jc	failed
	movw	%ax, %bx
#endif
	movb	$0x46, %ah		/* handle 2, which programs inherit, becomes the same */
	movw	$2, %cx
	int	$0x21
	jc	failed
#ifdef APART
	movb	$0x3e, %ah
	int	$0x21
#endif

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

#ifdef APART
errors:		.asciz	"ERRORS.TXT"
#endif
program:	.asciz	"DEMO.EXE"
parameters:	.word	0		/* our environment */
tail:		.word	PSP_TAIL, 0
fcb1:		.word	PSP_FCB1, 0
fcb2:		.word	PSP_FCB2, 0
