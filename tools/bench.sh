#!/bin/sh
# The benchmark, `make bench`: a page of figures on standard output, kept in build/bench.txt, and the same figures as
# CSV in build/bench.csv (one a line: table, row, column, value).
#
#   bench.sh        BENCH_SECONDS=n: seconds of the animation in each run (20); FULL=1: 60, the whole of it
#
# Frames a second are DEMO.EXE's own, in DOSBox at fixed numbers of instructions a millisecond. DOSBox keeps its clock
# by the instructions it has run, so the figures do not depend on this machine, only the time it takes does. Where the
# instructions go is counted by valgrind in the 32-bit host program, which has the same sources and the same assembly:
# a run of one frame is taken from a longer one, so that the start does not count.
set -eu
cd "$(dirname "$0")/.." || exit 1

seconds=${BENCH_SECONDS:-}
[ -n "$seconds" ] || seconds=20
[ -z "${FULL:-}" ] || seconds=60
case $seconds in
'' | *[!0-9]* | 0*)
	echo "bench.sh: a number of seconds is expected, not $seconds" >&2
	exit 2
	;;
esac
command -v valgrind >/dev/null || {
	echo "bench.sh: valgrind is not installed (Debian: apt-get install valgrind)" >&2
	exit 1
}

rate=35                       # frames a second of the animation where instructions are counted
growth=${BENCH_GROWTH:-70}    # frames for each spacing
work=build/bench
csv=build/bench.csv
mkdir -p "$work"
: >"$csv"

record() { # record TABLE ROW COLUMN VALUE
	echo "$1,$2,$3,$4" >>"$csv"
}
value() { # value NAME FILE: of the statistics
	tr -d '\r' <"$2" | sed -n "s/^$1: //p"
}

# ---- Frames a second

play() { # play CYCLES NAME SWITCHES...: one run in DOSBox, its statistics in $work/NAME.txt
	cycles=$1
	name=$2
	shift 2
	rm -rf "${work:?}/$name" && mkdir "$work/$name" && cp build/DEMO.EXE "$work/$name"
	sh tools/dosbox.sh -c "$cycles" -t $((seconds * 20 + 60)) -d "$work/$name" -- "DEMO $* /T:$seconds > OUT.TXT"
	[ -n "$(value fps "$work/$name/OUT.TXT")" ]
}

page_speed() {
	cat <<-END
	Frames a second, in DOSBox (core=normal, fixed cycles): /G, spacing 2, $seconds seconds of the animation in each run.
	DOSBox counts instructions, every one alike; it is no model of a processor's timing.

	  machine         instructions  the 1998      the report's methods (/P)         ours         times the
	  class           a millisecond  report         fps  instr./frame       fps  instr./frame     report
	END
	while read -r cycles report class; do
		# Two at a time; neither looks at this machine's clock.
		play "$cycles" "own$cycles" /G &
		own=$!
		play "$cycles" "printed$cycles" /G /P || return 1
		wait $own || return 1
		fps=$(value fps "$work/own$cycles/OUT.TXT")
		printed=$(value fps "$work/printed$cycles/OUT.TXT")
		awk -v class="$class" -v cycles="$cycles" -v report="$report" -v fps="$fps" -v printed="$printed" 'BEGIN {
			printf "  %-14s %12d %10s %11.2f %13d %9.1f %13d %10s\n", class, cycles, report == 0 ? "-" : report, printed,
				cycles * 1000 / printed, fps, cycles * 1000 / fps, report == 0 ? "-" : sprintf("%.1f", fps / report)
		}'
		record fps "$cycles" class "$class"
		[ "$report" = 0 ] || record fps "$cycles" report "$report"
		record fps "$cycles" printed "$printed"
		record fps "$cycles" ours "$fps"
		record instructions "$cycles" printed "$(awk -v f="$printed" -v c="$cycles" 'BEGIN { printf "%d", c * 1000 / f }')"
		record instructions "$cycles" ours "$(awk -v f="$fps" -v c="$cycles" 'BEGIN { printf "%d", c * 1000 / f }')"
	done <<-END
	8000 0 386DX-40
	25000 1.15 486DX2-66
	42000 2.95 Pentium 75
	100000 6.63 Pentium 166
	177000 13.09 Pentium II 266
	END
}

# ---- Instructions

# count NAME PROGRAM SWITCHES...: instructions of each function of a run, in $work/NAME.cost ("COST FUNCTION"). Helpers
# that several stages share count for those who call them.
count() {
	name=$1
	shift
	valgrind --tool=callgrind --callgrind-out-file="$work/$name.out" --compress-strings=no --compress-pos=no \
		'--fn-skip=squareRoot64*' '--fn-skip=length(*' '--fn-skip=withLength(*' '--fn-skip=unit(*' \
		"$@" >"$work/$name.txt" 2>"$work/$name.log" || {
		tail -n 20 "$work/$name.log" >&2
		return 1
	}
	awk '/^fn=/ { f = substr($0, 4); next }
		/^calls=/ { called = 1; next }
		/^[0-9+*-]/ { if (called) called = 0; else cost[f] += $2 }
		END { for (f in cost) printf "%d %s\n", cost[f], f }' "$work/$name.out" >"$work/$name.cost"
}

# per_frame SHORT LONG FRAMES: instructions a frame of each stage, "STAGE COST". What is of the benchmark itself
# (tools/bench.cpp) is left out, but for two lines that are no stages: "twin", and "loop", the assembly's part of "scales".
per_frame() {
	awk -v frames="$3" '
		{ cost = $1; f = $0; sub(/^[0-9]+ /, "", f) }
		FNR == 1 { ++file }
		{ total[f] += file == 1 ? -cost : cost }
		END {
			for (f in total) {
				if (f ~ /^__wrap_|^(\(anonymous namespace\)::)?(tell|bench)/) continue
				else if (f ~ /^(drawScalesC|blitScalesC|blitFine)/) s = "twin"
				else if (f ~ /(^| )Settler::(shade|rough)|^shadeSeedA/) s = "normals"
				else if (f ~ /(^| )(Settler::|Profile::|SoftObject::(update|settle|find|inRange|tell))|^(ride.*A|settle|look)$/) s = "update"
				else if (f ~ /(^| )(Lister::|SoftObject::draw)/) s = "draw"
				else if (f ~ /^(drawScalesA|blitScalesA)|(^| )View::(project|show)/) s = "scales"
				else if (f ~ /closeGaps|closeRun|closeCorner|closeAbove|closeFrom|closeSlit|fillRow|takeOver|^drawnRunsA/) s = "gaps"
				else if (f ~ /(^| )Contours::/) s = "contours"
				else if (f ~ /^clearRowsA|(^| )View::begin/) s = "clear"
				else if (f ~ /^presentRows|(^| )View::(mark|touch|end)/) s = "present"
				else s = "other"
				sum[s] += total[f]
				if (f ~ /^(drawScalesA|blitScalesA)/) sum["loop"] += total[f]
			}
			for (s in sum) printf "%s %.0f\n", s, sum[s] / frames
		}' "$work/$1.cost" "$work/$2.cost"
}
all_stages() { # all_stages FILE: their sum
	awk '$1 != "twin" && $1 != "loop" { n += $2 } END { printf "%.0f", n }' "$1"
}
stage() { # stage NAME: what per_frame said of it
	awk -v name="$1" '$1 == name { cost = $2 } END { print cost + 0 }' "$work/stages"
}

page_stages() {
	frames=$((seconds * rate))
	count one build/bench32 /G /R:$rate /N:1 || return 1
	count many build/bench32 /G /R:$rate /N:$((frames + 1)) || return 1
	per_frame one many $frames >"$work/stages"
	all=$(all_stages "$work/stages")
	echo
	echo "Instructions a frame by stage ($frames frames, $rate a second):"
	echo
	while read -r name what; do
		cost=$(stage "$name")
		awk -v what="$what" -v cost="$cost" -v all="$all" 'BEGIN {
			printf "  %-52s %10d %6.1f %%\n", what, cost, 100 * cost / all
		}'
		record stage "$name" instructions "$cost"
	done <<-END
	update update: settle the seeds
	normals normals and shading
	draw draw: scales of seeds
	scales scales: project and draw them (assembly but for few)
	gaps close what gaps are left
	contours put outlines right
	clear clear (assembly; string instructions, by repetition)
	present present (assembly; likewise)
	other other: move the objects, and the rest
	END
	printf '  %-52s %10d\n' "all" "$all"
	record stage all instructions "$all"

	# The loops that draw: cost over the same scales, of the same runs.
	scales=$(($(value scales "$work/many.txt") - $(value scales "$work/one.txt")))
	others=$(($(value 'scales by the view' "$work/many.txt") - $(value 'scales by the view' "$work/one.txt")))
	pixels=$(($(value 'scale pixels' "$work/many.txt") - $(value 'scale pixels' "$work/one.txt")))
	echo
	awk -v scales=$scales -v others=$others -v pixels=$pixels -v frames=$frames 'BEGIN {
		printf "Projecting and drawing the scales of these frames, %.0f a frame (%.1f%% of them projected by the view and only\n", \
			scales / frames, 100 * others / scales
		printf "drawn here), %.0f pixels covered a frame:\n", pixels / frames
	}'
	echo
	echo "                                          instructions    a scale   a covered pixel"
	for which in loop twin; do
		name=assembly
		[ $which = loop ] || name="C++ twin (-O2 -march=i486)"
		awk -v name="$name" -v cost="$(stage $which)" -v frames=$frames -v scales=$scales -v pixels=$pixels 'BEGIN {
			printf "  %-40s %11d %10.1f %17.2f\n", name, cost, cost * frames / scales, cost * frames / pixels
		}'
		record loop $which instructions "$(stage $which)"
	done
	record loop scales number $((scales / frames))
	record loop others number $((others / frames))
	record loop pixels number $((pixels / frames))
}

page_growth() {
	echo
	echo "Growth with finer sampling ($growth frames, $rate a second):"
	echo
	echo "  spacing     seeds   instructions a frame   times the spacing before"
	before=
	for spacing in 4 2 1 0.5 0.25; do
		count short build/demo32 /G /R:$rate /S:$spacing /N:1 || return 1
		count long build/demo32 /G /R:$rate /S:$spacing /N:$((growth + 1)) || return 1
		per_frame short long $growth >"$work/grown"
		cost=$(all_stages "$work/grown")
		seeds=$(($(value seeds "$work/long.txt") + $(value 'oversampled seeds' "$work/long.txt")))
		awk -v spacing=$spacing -v seeds="$seeds" -v cost="$cost" -v before="$before" 'BEGIN {
			printf "  %-7s %9d %22d %26s\n", spacing, seeds, cost, before == "" ? "-" : sprintf("%.2f", cost / before)
		}'
		record growth $spacing instructions "$cost"
		before=$cost
	done
}

page() {
	echo "Fast Blobs: benchmark"
	echo
	page_speed && page_stages && page_growth
}

# What must not be, whatever the figures.
sound() {
	good=0
	[ "$(value 'scales differing' "$work/many.txt")" = 0 ] || {
		echo "bench.sh: assembly and C++ drew differently in $(value 'scales differing' "$work/many.txt") calls" >&2
		good=1
	}
	[ "$(value 'frames not cleared' "$work/many.txt")" = 0 ] || {
		echo "bench.sh: $(value 'frames not cleared' "$work/many.txt") frames began with something left of the one before" >&2
		good=1
	}
	return $good
}

# (The status of a pipe's first command is lost; a file tells.)
rm -f "$work/good"
{ page && : >"$work/good"; } | tee build/bench.txt
[ -f "$work/good" ] && sound
