#!/bin/sh
# Measuring: records of /O, the switches /V and /X, BENCH.BAT, the tool that says whose instructions are and what they
# cost, and the benchmark itself, whose figures must be the same when taken again.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/DEMO.EXE build/BENCH.BAT build/TICKS.COM build/demo build/bench32 build/demo32 build/cost
host=$(pwd)/build/demo
c=$dir/c
mkdir "$c" && cp build/DEMO.EXE build/BENCH.BAT tools/scenes/GULP.FB "$c" || exit 1

dos() {
	sh tools/dosbox.sh -d "$c" "$@"
}
status() { # status N COMMAND...: the command ends with status N
	want=$1
	shift
	"$@"
	[ $? -eq "$want" ]
}
value() { # value NAME FILE
	tr -d '\r' <"$2" | sed -n "s/^$1: //p"
}
lines() { # lines N FILE
	test "$(wc -l <"$2")" -eq "$1"
}
dos_lines() { # every line ends as DOS has it
	test "$(grep -c "$(printf '\r')\$" "$1")" -eq "$(wc -l <"$1")"
}

# valgrind counts only what the kernel runs.
counts=no
command -v valgrind >/dev/null && sh tools/run32.sh -k && counts=yes

# ---- Records, on the host: the statistics, once across

(cd "$dir" && "$host" /G /S:4 /N:3 /O:REC.CSV >OUT1.TXT && "$host" /P /X /V /N:2 /O:REC.CSV >OUT2.TXT)
ok "a header and two records" lines 3 "$dir/REC.CSV"
ok "lines end as DOS has them" dos_lines "$dir/REC.CSV"
for n in 1 2; do
	tr -d '\r' <"$dir/REC.CSV" | awk -F , -v row=$((n + 1)) '
		NR == 1 { fields = split($0, name, ",") }
		NR == row { for (i = 2; i <= fields - 3; ++i) print name[i] ": " $i }' >"$dir/across"
	ok "record $n: names and values of the statistics" cmp "$dir/across" "$dir/OUT$n.TXT"
done
ok "record 1: its switches" sh -c "sed -n 2p '$dir/REC.CSV' | grep -q '^S:4 G,3,'"
ok "record 2: its switches" sh -c "sed -n 3p '$dir/REC.CSV' | grep -q '^S:2 P V X,2,'"
ok "no place for a record: status 1" status 1 sh -c "'$host' /N:1 /O:'$dir/none/REC.CSV' >'$dir/out' 2>'$dir/err'"
ok "no place for a record: the file is named" grep -q 'none/REC.CSV: ' "$dir/err"
ok "no place for a record: found out before the run" test ! -s "$dir/out"
ok "/O without a name: status 2" status 2 "$host" /N:1 /O:

# /X leaves the picture as it is.
(cd "$dir" && "$host" /N:3 /D:shown >out && "$host" /X /N:3 /D:hidden >out)
ok "/X: the same frames" diff -rq "$dir/shown" "$dir/hidden"

# ---- In DOSBox

dos -c 30000 -- 'CALL BENCH.BAT REC.CSV 1 > OUT.TXT'
ok "BENCH.BAT: a header, eight records, and one of a scene that is there" lines 10 "$c/REC.CSV"
ok "BENCH.BAT: lines end as DOS has them" dos_lines "$c/REC.CSV"
ok "BENCH.BAT: its runs" test "$(sed -n '2,$s/,.*//p' "$c/REC.CSV" | tr '\n' ';')" = \
	"S:2;S:2 G;S:2 G P;S:2 G X;S:2 G V;S:4 G;S:1 G;S:0.5 G;S:2 G;"
ok "BENCH.BAT: the last names its scene" sh -c "tail -n 1 '$c/REC.CSV' | grep -q ',\"GULP.FB\",'"
ok "BENCH.BAT: every shipped scene but the built-in one" sh -c "cd tools/scenes && for f in *.FB; do
	[ \$f = FOUR.FB ] || grep -q \"^IF EXIST \$f DEMO .*/M:\$f\" ../bench.bat || exit 1; done"
ok "BENCH.BAT: a second each" sh -c "tr -d '\r' <'$c/REC.CSV' |
	awk -F , 'NR > 1 && (\$3 < 1 || \$2 < 1) { bad = 1 } END { exit bad }'"
# (Not by how much, for that is the program's business: the copy is less than a per cent of a frame. The number of frames and the
# time between them are given, so that every run shows the same frames. A busy machine only slows runs down: the best of three of
# each kind count.)
dos -c 30000 -- 'DEMO /B /G /R:35 /N:30 /O:X.CSV' 'DEMO /B /G /X /R:35 /N:30 /O:X.CSV' 'DEMO /B /G /R:35 /N:30 /O:X.CSV' \
	'DEMO /B /G /X /R:35 /N:30 /O:X.CSV' 'DEMO /B /G /R:35 /N:30 /O:X.CSV' 'DEMO /B /G /X /R:35 /N:30 /O:X.CSV'
best() { # best SWITCHES: frames a second
	tr -d '\r' <"$c/X.CSV" | awk -F , -v switches="$1" '$1 == switches && $4 > best { best = $4 } END { print best + 0 }'
}
ok "/X: three runs with the copy and three without" lines 7 "$c/X.CSV"
ok "/X: without the copy it is faster" awk -v a="$(best 'S:2 G X')" -v b="$(best 'S:2 G')" 'BEGIN { exit !(b > 0 && a > b) }'

# One small sphere: far above the screen's 70 a second, and held to them by /V.
printf 'sphere ONE size 8\r\n' >"$c/SMALL.FB"
dos -c 100000 -- 'DEMO /G /S:4 /M:SMALL.FB /T:2 > FREE.TXT' 'DEMO /G /S:4 /M:SMALL.FB /T:2 /V > HELD.TXT'
free=$(value fps "$c/FREE.TXT")
held=$(value fps "$c/HELD.TXT")
echo "# a small sphere at 100,000 cycles: $free frames a second, with /V $held"
ok "nothing limits the rate" awk -v f="$free" 'BEGIN { exit !(f > 75) }'
ok "/V: the screen's 70 frames a second" awk -v f="$held" 'BEGIN { exit !(f > 69 && f < 71) }'

# The same run twice; what differs is when the machine's interrupts come.
dos -c 42000 -- 'DEMO /G /T:5 > A.TXT' 'DEMO /G /T:5 > B.TXT'
ok "the same frames a second again, to within 1%" awk -v a="$(value fps "$c/A.TXT")" -v b="$(value fps "$c/B.TXT")" \
	'BEGIN { exit !(a > 0 && b > 0 && a / b < 1.01 && b / a < 1.01) }'

# ---- What the BIOS counts

cp build/TICKS.COM "$c"
printf 'sphere ONE size 8\r\n' >"$c/SMALL.FB"
dos -c 25000 -- 'TICKS > T1.TXT' 'DEMO /G /M:SMALL.FB /T:2 > OUT.TXT' 'TICKS > T2.TXT'
ticks=$((0x$(tr -d '\r\n' <"$c/T2.TXT") - 0x$(tr -d '\r\n' <"$c/T1.TXT")))
# Two seconds are 36.4 ticks; the start of so small a scene takes less than half a second.
echo "# $ticks ticks for two seconds and a start"
ok "TICKS.COM: ticks of 18.2 a second" test "$ticks" -ge 36 -a "$ticks" -le 46

# From the command to the first frame: the bar of tools/bars.txt, for every shipped scene. Twice each, for a tick is 0.055 s.
cp tools/scenes/*.FB "$c"
for scene in tools/scenes/*.FB; do
	name=$(basename "$scene" .FB)
	rm -f "$c/OUT.TXT"
	dos -c 25000 -- 'TICKS > T1.TXT' "DEMO /G /N:1 $name.FB > OUT.TXT" "DEMO /G /N:1 $name.FB > OUT.TXT" 'TICKS > T2.TXT'
	ok "$name: its first frame" grep -q '^frames: 1' "$c/OUT.TXT"
	ticks=$((0x$(tr -d '\r\n' <"$c/T2.TXT") - 0x$(tr -d '\r\n' <"$c/T1.TXT")))
	awk -v name="$name" -v ticks=$ticks 'BEGIN { printf "# %s: its first frame after %.2f s\n", name, ticks / 18.2065 / 2 }'
	ok "$name: soon there" awk -v ticks=$ticks '
		$1 == "start" { good = ticks > 0 && ticks / 18.2065 / 2 <= $2 } END { exit !good }' tools/bars.txt
done

# ---- Whose the instructions are, and what they cost, by a program of known cost

if [ $counts = yes ]; then
	mkdir -p "$dir/src/one" "$dir/src/two" "$dir/asm" "$dir/lib"
	part=0
	for object in src/one/first src/two/second asm/second lib/library; do
		part=$((part + 1))
		${CXX:-g++} -m32 -DPART=$part -c tests/bench/seq.S -o "$dir/$object.o"
	done
	${CXX:-g++} -m32 -nostdlib -static -no-pie -Wl,-Map="$dir/seq.map" -o "$dir/seq" "$dir/src/one/first.o" \
		"$dir/src/two/second.o" "$dir/asm/second.o" "$dir/lib/library.o"
	objdump -d -w "$dir/seq" >"$dir/seq.asm"
	round() { # round FILE ARGUMENTS...: counts a run
		out=$1
		shift
		valgrind --tool=callgrind --dump-instr=yes --collect-jumps=yes --compress-strings=no --compress-pos=no \
			--callgrind-out-file="$dir/$out" "$dir/seq" "$@" >"$dir/log" 2>&1
	}
	round short
	round long 2 3 4 5 6 7 8 9 10 11
	build/cost -t 9 "$dir/seq.map" "$dir/seq.asm" "$dir/short" "$dir/long" 10 >"$dir/cost"
	# What the comments of the program say of each part; `rep stosl` counts for each of four words and for finding the end.
	awk '/PART|^#else/ { ++part }
		{ at = index($0, "#: ") }
		at { split(substr($0, at + 3), word, " "); clocks[part] += word[1]; count[part] += $1 == "rep" ? 5 : 1 }
		END {
			print "all all", count[2] + count[3] + count[4] + count[5], clocks[2] + clocks[3] + clocks[4] + clocks[5]
			print "room one", count[2] + count[5], clocks[2] + clocks[5]
			print "room two", count[3] + count[4], clocks[3] + clocks[4]
			print "room library 0 0"
			print "source one/first", count[2] + count[5], clocks[2] + clocks[5]
			print "source two/second", count[3] + count[4], clocks[3] + clocks[4]
			print "unknown all 0 0"
		}' tests/bench/seq.S >"$dir/known"
	grep -v '^function' "$dir/cost" >"$dir/told"
	ok "instructions and clocks of a known program" diff "$dir/known" "$dir/told"
	ok "its functions: two" test "$(grep -c '^function' "$dir/cost")" -eq 2
	ok "no counts: status 1" status 1 build/cost "$dir/seq.map" "$dir/seq.asm" "$dir/none" "$dir/long" 10
	ok "counts not by address: status 1" status 1 build/cost "$dir/seq.map" "$dir/seq.asm" "$dir/log" "$dir/long" 10
	ok "the code of another program: status 1" status 1 sh -c "sed 's/^ 8049/ 9049/' '$dir/seq.asm' >'$dir/other.asm' &&
		build/cost '$dir/seq.map' '$dir/other.asm' '$dir/short' '$dir/long' 10"
fi

# ---- The benchmark, as short as it goes

ok "every bar is a number" awk '!/^#/ && (NF != 3 || $2 + 0 <= 0 || $3 + 0 < 0) { exit 1 }' tools/bars.txt
ok "every shipped scene has a bar of its own" sh -c "cd tools/scenes &&
	for f in *.FB; do grep -q \"^\${f%.FB} \" ../bars.txt || exit 1; done"
for scene in tests/scenes/speed/*.FB; do
	ok "$scene plays" "$host" /S:4 /N:1 "/M:$scene"
done
if [ $counts = yes ]; then
	ok "make bench" make -s bench FULL=1 SECONDS=1 FRAMES=5 SCENES="FOUR GULP"
	awk -F , '
		NR == 1 { columns = NF; for (i = 1; i <= NF; ++i) column[$i] = i; next }
		NF != columns { print "line " NR ": " NF " columns of " columns; bad = 1 }
		{ seen[$1] = 1; ++lines }
		{ sum = 0; for (i = column["math"]; i <= column["rest"]; ++i) { sum += $i; if ($i < 0) bad = 1 } }
		# Rounded, each room by itself.
		sum < $column["instructions"] - 7 || sum > $column["instructions"] + 7 {
			print $1 ": rooms are " sum " of " $column["instructions"]
			bad = 1
		}
		# The model of a mean instruction of 1 to 10 clocks holds for any program.
		$column["clocks"] < $column["instructions"] || $column["clocks"] > 10 * $column["instructions"] {
			print $1 ": " $column["clocks"] " clocks"
			bad = 1
		}
		$column["rest"] > $column["instructions"] / 10 { print $1 ": a room has got lost"; bad = 1 }
		$column["scales"] <= 0 { print $1 ": no scales"; bad = 1 }
		{ above = $column["instructions"] / $column["bar"] }
		($column["fps"] != "") { if (played && above > last) { print $1 " stands too low"; bad = 1 } played += 1; last = above }
		# What is counted on the host is what DOSBox counts, but for interrupts and what is drawn at another pace.
		($column["fps"] != "") {
			other = 25000000 / $column["fps"]
			print "# " $1 ": instructions a frame: " $column["instructions"] " counted, " int(other) " by DOSBox"
			if ($1 == "FOUR" && ($column["instructions"] > 1.5 * other || other > 1.5 * $column["instructions"])) bad = 1
			if ($column["start"] < 0.1 || $column["start"] > 60) { print $1 ": start " $column["start"]; bad = 1 }
		}
		END { if (played != 2 || lines < 3 || !seen["FOUR"] || !seen["GULP"] || !seen["BODY64"]) bad = 1; exit bad }
		' build/bench.csv >"$dir/csv"
	ok "bench.csv: a line a scene, and its parts agree" test $? -eq 0
	sed 's/^\([^#]\)/# \1/' "$dir/csv"
	awk -F , 'NF != 4 || $4 == "" { print; bad = 1 }
		{ seen[$1] += 1; number[$1, $2, $3] = $4 }
		END {
			if (seen["spacing"] != 2 || seen["apart"] != 2 || seen["body"] != 1 || seen["loop"] != 4) bad = 1
			if (seen["fps"] != 19 || seen["instructions"] != 10 || seen["growth"] != 5) bad = 1
			# Seeds: four times as many at each step, and a cost that grows.
			if (number["growth", "0.25", "instructions"] <= number["growth", "1", "instructions"]) { print "spacings"; bad = 1 }
			# Four times the seeds cost more, but less than eight times as much.
			if (number["spacing", "FOUR", "times"] < 1 || number["spacing", "FOUR", "times"] > 8) { print "growth"; bad = 1 }
			if (number["loop", "assembly", "instructions"] <= 0) bad = 1
			if (number["loop", "assembly", "instructions"] >= number["loop", "twin", "instructions"]) {
				print "the assembly does not pay"
				bad = 1
			}
			exit bad
		}' build/figures.csv >"$dir/figures"
	ok "figures.csv: complete" test $? -eq 0
	sed 's/^/# /' "$dir/figures"
	ok "one page" test "$(wc -l <build/bench.txt)" -le 90

	# Once more; by instr.sh alone, for frames a second are tried above.
	counted() { awk -F , '$1 == "GULP" { print $4 }' build/bench.csv; }
	sh tools/instr.sh -n 5 -d "$dir/again" -t 3 gulp >"$dir/instr"
	again=$(awk '$1 == "all" { print $3 }' "$dir/again/GULP.cost")
	ok "the same instructions again, to within 1%" awk -v a="$again" -v b="$(counted)" \
		'BEGIN { exit !(a > 0 && a / b < 1.01 && b / a < 1.01) }'
	ok "instr.sh: a line for the scene" test "$(grep -c '^GULP .*\..*\..*\.' "$dir/instr")" -eq 1
	ok "instr.sh: three functions" test "$(grep -c '^ *[0-9].*/.*:' "$dir/instr")" -ge 3
	ok "instr.sh: no such scene: status 2" status 2 sh tools/instr.sh nosuch
	ok "a scene that is not shipped is refused" status 2 env BENCH_SCENES=NONE sh tools/bench.sh
	ok "a wrong number of frames is refused" status 2 env BENCH_FRAMES=x sh tools/bench.sh
else
	echo "# no valgrind, or a kernel that runs no 32-bit programs: make bench is not tried"
fi
ok "a wrong number of seconds is refused" status 2 env BENCH_SECONDS=x sh tools/bench.sh
summary
