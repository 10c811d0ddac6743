#!/bin/sh
# The unit tests, once for each kind of Real.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/unit-fixed build/unit-float build/unit-double
for kind in fixed float double; do
	echo "# Real: $kind"
	build/unit-$kind >"$dir/out" 2>&1
	count "$dir/out"
done
summary
