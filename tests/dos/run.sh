#!/bin/sh
# Tests in DOSBox: the machine interface on a PC (machine.sh), and DEMO.EXE (demo.sh).
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/DEMO.EXE build/MTEST.EXE build/demo
for script in machine demo; do
	echo "# $script"
	sh tests/dos/$script.sh >"$dir/out" 2>&1
	count "$dir/out"
done
summary
