#!/bin/sh
# Tests of the primitives: seeds, cores, operations and graph. Run from the top of the tree.
#
#   sh tests/prims/run.sh         all of it; the last line is "N passed, N failed"
#   build/primtst even            seeds and evenness of each primitive, as a table
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/primtst
build/primtst >"$dir/out" 2>&1
count "$dir/out"
summary
