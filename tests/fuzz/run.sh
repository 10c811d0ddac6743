#!/bin/sh
# The reader of scene files under a sanitizer build, fed with mutated files.
#
#   sh tests/fuzz/run.sh [COUNT [SEED]]      COUNT files, 60000 by default; a million is the full test
#
# The last line is "N passed, N failed"; one test for each run of the mutator.
set -u
cd "$(dirname "$0")/../.." || exit 1
count=${1:-60000} seed=${2:-1}
make -s build/fuzz || { echo "0 passed, 1 failed"; exit 1; }
passed=0 failed=0
corpus="tests/fuzz/corpus/*.FB tools/scenes/*.FB tests/scenes/hurt/*.FB"
# shellcheck disable=SC2086
if nice build/fuzz "$count" "$seed" $corpus; then passed=1; else failed=1; fi
# shellcheck disable=SC2086
if nice build/fuzz --draw $((count / 100)) "$((seed + 1))" $corpus; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
