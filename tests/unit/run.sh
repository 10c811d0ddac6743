#!/bin/sh
# The unit tests, once for each kind of Real.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

# UNIT_KINDS: some kinds only.
for kind in ${UNIT_KINDS:-fixed float double}; do
	build build/unit-$kind
done
for kind in ${UNIT_KINDS:-fixed float double}; do
	echo "# Real: $kind"
	build/unit-$kind >"$dir/out" 2>&1
	count "$dir/out"
done
summary
