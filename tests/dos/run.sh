#!/bin/sh
# The PC behind the machine's seam, and DEMO.EXE on it, in DOSBox.
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
