/* A program whose cost is known, for the test of tools/cost.cpp: it goes round once for each argument and its own name.
   Behind each instruction of a round stands #: the clocks that a 486 takes for it by the tables. Of the four parts the
   compiler takes the one that PART names. */
	.text
#if PART == 1  /* src/one/first */
	.globl _start
_start:
	movl (%esp), %esi
	xorl %ebx, %ebx
again:
	movl $value, %edi		#: 1
	movl $5, %eax			#: 1
	addl $3, %eax			#: 1
	imull %eax, %eax		#: 26
	movl value, %ecx		#: 1
	addl %eax, (%edi)		#: 3
	addl (%edi), %eax		#: 2
	movl $7, 4(%edi)		#: 2   displacement and immediate
	movl (%edi,%ebx,4), %edx	#: 2   base and index
	shldl $16, %eax, %edx		#: 2
	shrl $4, %edx			#: 2
	sarl %edx			#: 3   by one
	movzbl %al, %eax		#: 3
	cltd				#: 3
	movl $9, %ecx			#: 1
	idivl %ecx			#: 43
	addw $1, (%edi)			#: 4   prefix
	leal 4(%edi), %ebp		#: 1
	movl (%ebp), %edx		#: 2   base just written
	cmpl %edx, %edx			#: 1
	je 1f				#: 3
	hlt
1:	jne 2f				#: 1
2:	pushl %eax			#: 1
	popl %eax			#: 1
	call second			#: 3
	movl $buffer, %edi		#: 1
	movl $4, %ecx			#: 1
	rep stosl			#: 23  7 and 4 for each of 4
	call library			#: 3
	decl %esi			#: 1
	jne again			#: 3
	movl $1, %eax
	int $0x80
	.bss
value:	.skip 8
buffer:	.skip 16
#elif PART == 2  /* src/two/second */
	.globl second
second:
	movl $100, %eax			#: 1
	jmp kernel			#: 3
#elif PART == 3  /* asm/second, of the same room */
	.globl kernel
kernel:
	mull %eax			#: 26
	ret				#: 5
#else  /* nobody's */
	.globl library
library:
	incl %eax			#: 1
	ret				#: 5
#endif
	.section .note.GNU-stack, "", @progbits
