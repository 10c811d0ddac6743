#!/bin/sh
# Golden frames: the picture is what it was when sums.txt was committed. A change here is a fault, or it is meant, and then
# regen.sh takes it over.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/demo
sh tests/golden/sums.sh >"$dir/now" 2>"$dir/errors" || cat "$dir/errors"
ok "as many frames" test "$(wc -l <"$dir/now")" -eq "$(wc -l <tests/golden/sums.txt)"
while read -r line; do
	ok "${line% * *}" grep -qxF -- "$line" "$dir/now"
done <tests/golden/sums.txt
summary
