#!/bin/sh
# The benchmark, `make bench`: a page of figures on standard output, kept in build/bench.txt. build/bench.csv has a line
# for each scene; build/figures.csv what else is on the page, one figure a line: table, row, column, value.
#
#   bench.sh        BENCH_SECONDS=n: seconds of the animation in each run in DOSBox (20); BENCH_FRAMES=n: frames counted
#                   (70); BENCH_SCENES="FOUR WALK": of the shipped scenes only these; FULL=1: whole minutes (60 s), the
#                   report's scene at five speeds beside the report's figures, and at five spacings
#
# Frames a second are DEMO.EXE's own, in DOSBox at fixed numbers of instructions a millisecond. DOSBox keeps its clock
# by the instructions it has run, so the figures do not depend on this machine, only the time it takes does. Where the
# instructions go is counted by valgrind in the 32-bit host program, which has the same sources and the same assembly
# (tools/instr.sh): a run of five frames is taken from a longer one, so that the start does not count.
set -eu
cd "$(dirname "$0")/.." || exit 1

seconds=${BENCH_SECONDS:-}
[ -n "$seconds" ] || seconds=20
[ -z "${FULL:-}" ] || seconds=${BENCH_SECONDS:-60}
frames=${BENCH_FRAMES:-}
[ -n "$frames" ] || frames=70
for number in "$seconds" "$frames"; do
	case $number in
	'' | *[!0-9]* | 0*)
		echo "bench.sh: a number is expected, not $number" >&2
		exit 2
		;;
	esac
done
command -v valgrind >/dev/null || {
	echo "bench.sh: valgrind is not installed (Debian: apt-get install valgrind)" >&2
	exit 1
}
shipped=${BENCH_SCENES:-}
[ -n "$shipped" ] || shipped=$(cd tools/scenes && ls ./*.FB | sed 's/^..//; s/\.FB$//')
shipped=$(echo $shipped)
for name in $shipped; do
	[ -f "tools/scenes/$name.FB" ] || {
		echo "bench.sh: no shipped scene '$name'" >&2
		exit 2
	}
done

cycles=25000    # instructions a millisecond: a 486DX2-66
starts=4        # times that a scene is started, for the BIOS counts only 18.2 ticks a second
work=build/bench
csv=build/bench.csv
mkdir -p "$work"
: >build/figures.csv

record() { # record TABLE ROW COLUMN VALUE
	echo "$1,$2,$3,$4" >>build/figures.csv
}
value() { # value NAME FILE: of the statistics
	tr -d '\r' <"$2" | sed -n "s/^$1: //p"
}
bar() { # bar NAME: of tools/bars.txt
	awk -v name="$1" '$1 == name { print $2 }' tools/bars.txt
}

# ---- Frames a second and start, in DOSBox

# play CYCLES NAME SWITCHES...: one run, its statistics in $work/NAME/OUT.TXT
play() {
	speed=$1
	name=$2
	shift 2
	rm -rf "${work:?}/$name" && mkdir "$work/$name" && cp build/DEMO.EXE tools/scenes/*.FB "$work/$name"
	sh tools/dosbox.sh -c "$speed" -t $((seconds * 20 + 60)) -d "$work/$name" -- "DEMO $* /T:$seconds > OUT.TXT"
	[ -n "$(value fps "$work/$name/OUT.TXT")" ]
}

# start SCENE: ticks before and after the command that shows one frame, given $starts times
start() {
	place=$work/start$1
	rm -rf "$place" && mkdir "$place" && cp build/DEMO.EXE build/TICKS.COM "tools/scenes/$1.FB" "$place"
	command="DEMO /G /N:1 /M:$1.FB > OUT.TXT"
	set -- 'TICKS > BEFORE.TXT'
	while [ $# -le $starts ]; do set -- "$@" "$command"; done
	sh tools/dosbox.sh -c $cycles -t 300 -d "$place" -- "$@" 'TICKS > AFTER.TXT'
	[ "$(value frames "$place/OUT.TXT")" = 1 ]
}
started() { # started SCENE: seconds
	before=$(tr -d '\r\n' <"$work/start$1/BEFORE.TXT")
	after=$(tr -d '\r\n' <"$work/start$1/AFTER.TXT")
	awk -v ticks=$((0x$after - 0x$before)) -v starts=$starts 'BEGIN { printf "%.2f", ticks * 65536 / 1193182 / starts }'
}

# DOSBox keeps real time at this speed, and so leaves room for others.
play_scenes() {
	running=
	for name in $shipped; do
		start "$name" &
		running="$running $!"
		play $cycles "play$name" /G "/M:$name.FB" &
		running="$running $!"
		[ "$(echo "$running" | wc -w)" -lt 6 ] || { finish_runs || return 1; }
	done
	finish_runs
}
finish_runs() {
	for run in $running; do wait "$run" || return 1; done
	running=
}

# ---- Scenes

# scenes_of DIR NAME...: a line of CSV for each scene counted there; millions a frame
head=scene,fps,start,instructions,bar,aim,math,model,surface,picture,app,rest,clocks,scales
scenes_of() {
	place=$1
	shift
	for name in "$@"; do
		fps='' begun=''
		case " $shipped " in
		*" $name "*)
			fps=$(value fps "$work/play$name/OUT.TXT")
			begun=$(started "$name")
			;;
		esac
		awk -v name="$name" -v fps="$fps" -v begun="$begun" -v frames="$frames" '
			FILENAME ~ /bars/ { if ($1 == name || ($1 == "other" && !bar)) { bar = $2; aim = $3 } next }
			FILENAME ~ /short/ { if ($1 == "frames:") n = $2; if ($1 == "drawn") drawn -= n * $4; next }
			FILENAME ~ /long/ { if ($1 == "frames:") n = $2; if ($1 == "drawn") drawn += n * $4; next }
			$1 == "all" { all = $3; clocks = $4 }
			$1 == "room" { room[$2] = $3 }
			END {
				rest = all
				split("math model surface picture app", names, " ")
				line = ""
				for (i = 1; i <= 5; ++i) { rest -= room[names[i]]; line = line sprintf("%.0f,", room[names[i]]) }
				printf "%s,%s,%s,%.0f,%.0f,%.0f,%s%.0f,%.0f,%.1f\n", name, fps, begun, all, bar * 1e6, aim * 1e6, line, rest,
					clocks, drawn / frames
			}' tools/bars.txt "$place/$name.short.txt" "$place/$name.long.txt" "$place/$name.cost"
	done
}
worst_first() { # of lines of CSV
	awk -F , '{ printf "%012.6f,%s\n", $4 / $5, $0 }' | sort -r | cut -d , -f 2-
}
field() { # field SCENE NUMBER: of its line
	awk -F , -v name="$1" -v number="$2" '$1 == name { print $number }' $csv
}

page_scenes() {
	echo "Every shipped scene, the worst against its bar first; ! beyond a bar."
	echo
	echo "  fps, start    frames a second, and seconds from the command to the first frame (bar: $(bar start)): DEMO.EXE in DOSBox,"
	echo "                core=normal, 25,000 instructions a millisecond, /G, $seconds seconds of the animation"
	echo "  all           millions of instructions a frame, 32-bit host program, /G /R:35, $frames frames after the first five;"
	echo "                math to app: in which room of src they are spent, rest: the machine and the C library"
	echo "  clocks        millions of clocks a frame that a 486 takes for them, and frames a second at 66 MHz: an estimate"
	echo "                from the tables of the i486 manual, without waits for memory (tools/clk486.h has the assumptions)"
	echo
	# What is short is counted first; DOSBox would be in its way.
	sh tools/instr.sh -n "$frames" -d $work/two $shipped $(ls tests/scenes/speed/*.FB) >$work/instr.txt || return 1
	play_scenes || return 1
	speed=$(cd tests/scenes/speed && ls ./*.FB | sed 's/^..//; s/\.FB$//')
	{
		echo $head
		{ scenes_of $work/two $shipped | worst_first; }
		{ scenes_of $work/two $speed | worst_first; }
	} >$csv
	echo "  scene       fps  start     all   bar    aim    math   model surface picture    app   rest  clocks   fps"
	awk -F , -v start="$(bar start)" 'NR > 1 {
		if ($2 == "" && !told) { told = 1; print ""; print "  Scenes made for speed (tests/scenes/speed):"; print "" }
		printf "  %-8s %6s %6s %7.3f%s %5.2f %5s %7.3f %7.3f %7.3f %7.3f %6.3f %6.3f %7.2f %5.1f\n",
			$1, $2 == "" ? "" : sprintf("%.1f", $2),
			$3 == "" ? "" : sprintf("%.2f", $3) ($3 > start + 0 ? "!" : " "), $4 / 1e6, ($4 > $5) ? "!" : " ", $5 / 1e6,
			($6 > 0) ? sprintf("%.2f", $6 / 1e6) : "-", $7 / 1e6, $8 / 1e6, $9 / 1e6, $10 / 1e6, $11 / 1e6, $12 / 1e6, $13 / 1e6, 66e6 / $13
	}' $csv
}

# ---- Growth

grown() { # grown TABLE ROW WHAT FROM TO BAR: a line of the page
	awk -v what="$3" -v from="$4" -v to="$5" -v bar="$6" 'BEGIN {
		printf "  %-62s %8.2f %s %5s\n", what, to / from, (to / from > bar) ? "!" : " ", bar
	}'
	record "$1" "$2" times "$(awk -v from="$4" -v to="$5" 'BEGIN { printf "%.3f", to / from }')"
}
page_growth() {
	sh tools/instr.sh -s 1 -n "$frames" -d $work/one $shipped >$work/instr1.txt || return 1
	echo
	echo "Growth, in instructions:                                             times    bar"
	echo
	for name in $shipped; do
		grown spacing "$name" "spacing 2 to 1, $name" "$(field "$name" 4)" "$(awk '$1 == "all" { print $3 }' "$work/one/$name.cost")" \
			"$(bar spacing)"
	done
	grown apart unlinked "4 to 64 balls that stand apart, not linked" "$(field APART4 4)" "$(field APART64 4)" "$(bar apart)"
	grown apart linked "4 to 64 balls that stand apart, all linked" "$(field APART4L 4)" "$(field APART64L 4)" "$(bar apart)"
	case " $shipped " in
	*" FOUR "*)
		each=$(awk -v c="$(field FOUR 4)" -v n="$(field FOUR 14)" 'BEGIN { printf "%.3f", c / n }')
		many=$(awk -v c="$(field BODY64 4)" -v n="$(field BODY64 14)" 'BEGIN { printf "%.3f", c / n }')
		grown body scale "FOUR to 64 balls in one body, for each scale drawn" "$each" "$many" "$(bar body)"
		;;
	esac
}

page_spacings() {
	echo
	echo "FOUR with finer sampling ($frames frames, 35 a second):"
	echo
	echo "  spacing     seeds   instructions a frame   times the spacing before"
	before=
	for spacing in 4 2 1 0.5 0.25; do
		sh tools/instr.sh -s $spacing -n "$frames" -d $work/finer FOUR >$work/finer.txt || return 1
		cost=$(awk '$1 == "all" { print $3 }' $work/finer/FOUR.cost)
		seeds=$(($(value seeds $work/finer/FOUR.long.txt) + $(value 'oversampled seeds' $work/finer/FOUR.long.txt)))
		awk -v spacing=$spacing -v seeds="$seeds" -v cost="$cost" -v before="$before" 'BEGIN {
			printf "  %-7s %9d %22d %26s\n", spacing, seeds, cost, before == "" ? "-" : sprintf("%.2f", cost / before)
		}'
		record growth $spacing instructions "$cost"
		before=$cost
	done
}

# ---- The loops that draw scales

# functions NAME FRAMES: callgrind's "COST FUNCTION" of a run of build/bench32, in $work/NAME.cost
functions() {
	valgrind --tool=callgrind --callgrind-out-file="$work/$1.out" --compress-strings=no --compress-pos=no \
		build/bench32 /G /R:35 "/N:$2" >"$work/$1.txt" 2>"$work/$1.log" || {
		tail -n 20 "$work/$1.log" >&2
		return 1
	}
	awk '/^fn=/ { f = substr($0, 4); next }
		/^calls=/ { called = 1; next }
		/^[0-9+*-]/ { if (called) called = 0; else cost[f] += $2 }
		END { for (f in cost) printf "%d %s\n", cost[f], f }' "$work/$1.out" >"$work/$1.cost"
}

# The assembly and its C++ twin (tools/bench.cpp) are told by what the two are called.
loop() { # loop PATTERN: instructions of the functions that match, of the frames counted
	awk -v pattern="$1" '
		FNR == 1 { ++file }
		{ f = $0; sub(/^[0-9]+ /, "", f); if (f ~ pattern) sum += file == 1 ? -$1 : $1 }
		END { printf "%.0f", sum }' $work/few.cost $work/many.cost
}
page_loops() {
	functions few 5 && functions many $((frames + 5)) || return 1
	scales=$(($(value scales "$work/many.txt") - $(value scales "$work/few.txt")))
	others=$(($(value 'scales by the view' "$work/many.txt") - $(value 'scales by the view' "$work/few.txt")))
	pixels=$(($(value 'scale pixels' "$work/many.txt") - $(value 'scale pixels' "$work/few.txt")))
	echo
	awk -v scales=$scales -v others=$others -v pixels=$pixels -v frames="$frames" 'BEGIN {
		printf "Projecting and drawing the scales of FOUR, %.0f a frame (%.1f%% of them projected by the view and only\n", \
			scales / frames, 100 * others / scales
		printf "drawn here), %.0f pixels covered a frame:\n", pixels / frames
	}'
	echo
	echo "                                          instructions    a scale   a covered pixel"
	for which in assembly twin; do
		name=assembly
		pattern='^drawScalesA'
		[ $which = assembly ] || {
			name="C++ twin (-O2 -march=i486)"
			pattern='^(drawScalesC|blitScale)'
		}
		cost=$(loop "$pattern")
		[ "$cost" -gt 0 ] || {
			echo "bench.sh: no instruction of the $which was counted" >&2
			return 1
		}
		awk -v name="$name" -v cost="$cost" -v frames="$frames" -v scales=$scales -v pixels=$pixels 'BEGIN {
			printf "  %-40s %11d %10.1f %17.2f\n", name, cost / frames, cost / scales, cost / pixels
		}'
		record loop $which instructions "$(awk -v cost="$cost" -v frames="$frames" 'BEGIN { printf "%.0f", cost / frames }')"
	done
	record loop scales number $((scales / frames))
	record loop pixels number $((pixels / frames))
}

# ---- The report's scene at five speeds

page_speed() {
	cat <<-END

	The report's four spheres at five speeds, in DOSBox: /G, spacing 2, $seconds seconds of the animation in each run.
	DOSBox counts instructions, every one alike; it is no model of a processor's timing.

	  machine         instructions  the 1998      the report's methods (/P)         ours         times the
	  class           a millisecond  report         fps  instr./frame       fps  instr./frame     report
	END
	while read -r speed report class; do
		# Two at a time; neither looks at this machine's clock.
		play "$speed" "own$speed" /G &
		own=$!
		play "$speed" "printed$speed" /G /P || return 1
		wait $own || return 1
		fps=$(value fps "$work/own$speed/OUT.TXT")
		printed=$(value fps "$work/printed$speed/OUT.TXT")
		awk -v class="$class" -v cycles="$speed" -v report="$report" -v fps="$fps" -v printed="$printed" 'BEGIN {
			printf "  %-14s %12d %10s %11.2f %13d %9.1f %13d %10s\n", class, cycles, report == 0 ? "-" : report, printed,
				cycles * 1000 / printed, fps, cycles * 1000 / fps, report == 0 ? "-" : sprintf("%.1f", fps / report)
		}'
		record fps "$speed" class "$class"
		[ "$report" = 0 ] || record fps "$speed" report "$report"
		record fps "$speed" printed "$printed"
		record fps "$speed" ours "$fps"
		record instructions "$speed" printed "$(awk -v f="$printed" -v c="$speed" 'BEGIN { printf "%d", c * 1000 / f }')"
		record instructions "$speed" ours "$(awk -v f="$fps" -v c="$speed" 'BEGIN { printf "%d", c * 1000 / f }')"
	done <<-END
	8000 0 386DX-40
	25000 1.15 486DX2-66
	42000 2.95 Pentium 75
	100000 6.63 Pentium 166
	177000 13.09 Pentium II 266
	END
}

page() {
	echo "Fast Blobs: benchmark"
	echo
	page_scenes && page_growth && page_loops || return 1
	[ -z "${FULL:-}" ] || { page_speed && page_spacings; }
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
