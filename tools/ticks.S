/* TICKS.COM: prints the BIOS's count of timer ticks, 18.2 a second, as eight hexadecimal digits: what the benchmark
   measures the start of DEMO.EXE with in DOSBox, from outside the program. */
	.code16
	.globl _start
_start:
	xorw %ax, %ax
	movw %ax, %es
	movl %es:0x46c, %ebx
	movw $8, %cx
digit:
	roll $4, %ebx
	movb %bl, %dl
	andb $15, %dl
	addb $'0', %dl
	cmpb $'9', %dl
	jbe 1f
	addb $'A' - '9' - 1, %dl
1:	movb $2, %ah
	int $0x21
	loop digit
	movb $13, %dl
	movb $2, %ah
	int $0x21
	movb $10, %dl
	int $0x21
	movw $0x4c00, %ax
	int $0x21
	.section .note.GNU-stack, "", @progbits
