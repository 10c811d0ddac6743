#!/bin/sh
# Runs a program that was built for this machine, also a 32-bit one where the kernel runs none: there qemu does, which
# `setup.sh test` installs.
#
#   run32.sh PROGRAM ARGUMENTS...
#   run32.sh -k                     only tells by its status whether the kernel runs 32-bit programs
set -u

# The smallest 32-bit program: one page, which holds nothing but exit(0).
kernel_runs_32() {
	file=$(mktemp "${TMPDIR:-/tmp}/run32.XXXXXX") || return 1
	{
		printf '\177ELF\1\1\1\0\0\0\0\0\0\0\0\0\2\0\3\0\1\0\0\0\124\200\4\10\64\0\0\0\0\0\0\0\0\0\0\0\64\0\40\0\1\0\0\0\0\0\0\0'
		printf '\1\0\0\0\0\0\0\0\0\200\4\10\0\200\4\10\135\0\0\0\135\0\0\0\5\0\0\0\0\20\0\0'
		printf '\270\1\0\0\0\61\333\315\200'
	} >"$file"
	chmod +x "$file"
	# What a shell says of a file that the kernel refuses is of no use here.
	"$file" >/dev/null 2>&1
	ran=$?
	rm -f "$file"
	return $ran
}

if [ "${1:-}" = -k ]; then
	kernel_runs_32
	exit
fi
# The fifth byte of an ELF file tells 32 bits from 64.
[ "$(od -An -j4 -N1 -tu1 "$1" | tr -d ' ')" != 1 ] || kernel_runs_32 || set -- qemu-i386 "$@"
exec "$@"
