#!/bin/sh
# Gives random scenes to the reader and random command lines to the program, all under the sanitizers.
#
#   sh tests/fuzz/run.sh [SCENES [LINES [RUNS [SEED]]]]
#
# The reader gets SCENES scenes (20000 by default), and a twentieth as many of which one in four is played. LINES command lines
# are parsed (20000 by default), and RUNS are given to the program (100). Another SEED than 1 makes others of each. The last line
# is "N passed, N failed".
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh
scenes=${1:-20000} lines=${2:-20000} runs=${3:-100} seed=${4:-1}

build build/fuzz build/fuzzline build/san/demo
ASAN_OPTIONS=detect_leaks=1:alloc_dealloc_mismatch=0
export ASAN_OPTIONS
corpus="tests/fuzz/corpus/*.FB tools/scenes/*.FB tests/scenes/hurt/*.FB"
mkdir "$dir/runs"
printf 'title One\nsphere a size 30 colour pink\ncircle a radius 10 period 5\n' >"$dir/runs/ONE.FB"

# fuzz NAME COMMAND...: runs one check and shows what it has counted.
fuzz() {
	ok "$@"
	sed 's/^/# /' "$dir/said"
}
# shellcheck disable=SC2086  # the files are words
fuzz "scenes" nice build/fuzz "$scenes" "$seed" $corpus
# shellcheck disable=SC2086
fuzz "scenes, played" nice build/fuzz --draw $((scenes / 20)) $((seed + 1)) $corpus
fuzz "command lines" nice build/fuzzline "$lines" "$seed"
fuzz "command lines for the program" nice build/fuzzline --run build/san/demo "$dir/runs" "$runs" "$seed"
summary
