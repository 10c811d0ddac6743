#!/bin/sh
# The unit tests, once for each kind of Real.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

# UNIT_KINDS: some kinds only.
kinds=${UNIT_KINDS:-fixed float double}
build $(for kind in $kinds; do echo build/unit-$kind; done)
for kind in $kinds; do
	echo "# Real: $kind"
	build/unit-$kind >"$dir/out" 2>&1
	count "$dir/out"
done
summary
