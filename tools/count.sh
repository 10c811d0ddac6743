#!/bin/sh
# Counts a scene's instructions with callgrind, as the difference of a short and a long run. A part of tools/instr.sh, which
# runs it for several scenes at a time.
#
#   count.sh DIR FUNCTIONS SCENE SHORT LONG SWITCHES...
#
# DIR holds demo32, demo32.map and demo32.asm (objdump -d -w), and gets NAME.cost, what tools/cost.cpp tells of SHORT and
# LONG frames of the scene file SCENE with SWITCHES, and the statistics of both, NAME.short.txt and NAME.long.txt. NAME is
# that of the file.
set -eu
dir=$1 functions=$2 scene=$3 short=$4 long=$5
shift 5
name=$(basename "$scene" .FB)
for run in short long; do
	frames=$short
	[ $run = short ] || frames=$long
	valgrind --tool=callgrind --dump-instr=yes --collect-jumps=yes --compress-strings=no --compress-pos=no \
		--callgrind-out-file="$dir/$name.$run" "$dir/demo32" "$@" "/N:$frames" "/M:$scene" >"$dir/$name.$run.txt" 2>"$dir/$name.log" || {
		echo "count.sh: $scene did not run:" >&2
		tail -n 5 "$dir/$name.log" >&2
		exit 1
	}
done
build/cost -t "$functions" "$dir/demo32.map" "$dir/demo32.asm" "$dir/$name.short" "$dir/$name.long" \
	$((long - short)) >"$dir/$name.cost"
