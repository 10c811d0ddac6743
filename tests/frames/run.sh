#!/bin/sh
# Tests that all builds draw the same frames: the 64-bit host, the 32-bit host with the assembly, and DEMO.EXE in DOSBox must
# dump the same bytes for the same switches. Builds whose Real is floating point must show nearly the same picture.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/demo build/demo32 build/DEMO.EXE build/demo-float build/demo-double build/samefrm
c=$dir/c
mkdir "$c"
cp build/DEMO.EXE "$c"
same() { # same NAME A B
	echo "# $1: $(build/samefrm "$2" "$3")"
	ok "$1" build/samefrm "$2" "$3"
}

# Each line has a number of frames and switches; DOSBox writes about fifteen frames a second.
sets='60
40 /G
16 /S:1
16 /S:4 /G
24 /P
10 /P /G /S:4'

# DEMO.EXE plays all sets in one go, as fast as the emulator can.
number=0
echo "$sets" >"$dir/sets"
set --
while read -r frames switches; do
	number=$((number + 1))
	set -- "$@" "DEMO /N:$frames /D:D$number $switches > OUT$number.TXT"
done <"$dir/sets"
ok "DEMO.EXE plays" tools/dosbox.sh -c max -o cpu.core=dynamic -t 300 -d "$c" -- "$@"

total=0
number=0
while read -r frames switches; do
	number=$((number + 1))
	label="/N:$frames${switches:+ $switches}"
	# The switches must be split into words, so they are not quoted.
	build/demo /N:"$frames" /D:"$dir/h" $switches >"$dir/h.txt"
	sh tools/run32.sh build/demo32 /N:"$frames" /D:"$dir/w" $switches >"$dir/w.txt"
	ok "frames dumped, $label" test "$(ls "$dir/h" | grep -c PPM)" -eq "$frames"
	same "32-bit host, $label" "$dir/h" "$dir/w"
	same "DEMO.EXE, $label" "$dir/h" "$c/D$number"
	# The statistics must be the same, too, except for the time taken.
	grep -v -e '^seconds' -e '^fps' "$dir/h.txt" >"$dir/h.cmp"
	tr -d '\r' <"$c/OUT$number.TXT" | grep -v -e '^seconds' -e '^fps' >"$dir/c.cmp"
	ok "statistics of the 32-bit host, $label" cmp "$dir/h.txt" "$dir/w.txt"
	ok "statistics of DEMO.EXE, $label" cmp "$dir/h.cmp" "$dir/c.cmp"
	total=$((total + frames))
	rm -rf "$dir/h" "$dir/w" "$c/D$number"
done <"$dir/sets"
echo "# $total frames from each of three builds"
ok "a hundred frames and more" test "$total" -ge 100

# The emulator's other core, which interprets instructions one by one. Here no picture is copied to the card, which must not
# change what is dumped.
build/demo /N:3 /D:"$dir/h" >"$dir/h.txt"
tools/dosbox.sh -c max -o cpu.core=normal -t 120 -d "$c" -- 'DEMO /N:3 /X /D:NORMAL > OUT.TXT'
same "DEMO.EXE interpreted" "$dir/h" "$c/NORMAL"

# The same program, made by DJGPP if its compiler is installed.
if command -v "${CROSS:-i586-pc-msdosdjgpp-}g++" >/dev/null; then
	ok "DJGPP builds it" make -s -f Makefile.djgpp
	cp build/djgpp/DEMO.EXE "$c/DJDEMO.EXE"
	ok "DJGPP's DEMO.EXE plays" tools/dosbox.sh -c max -o cpu.core=dynamic -t 200 -d "$c" -- \
		'DJDEMO /N:20 /D:DJ1 > OUT.TXT' 'DJDEMO /N:10 /P /G /D:DJ2 > OUT.TXT'
	build/demo /N:20 /D:"$dir/j1" >/dev/null
	build/demo /N:10 /P /G /D:"$dir/j2" >/dev/null
	same "DEMO.EXE by DJGPP, /N:20" "$dir/j1" "$c/DJ1"
	same "DEMO.EXE by DJGPP, /N:10 /P /G" "$dir/j2" "$c/DJ2"
	rm -rf "$dir/j1" "$dir/j2" "$c/DJ1" "$c/DJ2"
else
	echo "# no DJGPP compiler here: its DEMO.EXE was not compared"
fi

# Frames do not tell what was before: a ball that has leapt to its place looks as if it had always been there.
cat >"$dir/still.fb" <<END
sphere a size 40
sphere b size 40 at 22 14 0
blend a b
END
cat >"$dir/leap.fb" <<END
sphere a size 40
sphere b size 40
blend a b
keys b linear
key b 0 100 100 0
key b 0.5 100 100 0
key b 0.55 22 14 0
END
for scene in still leap; do
	build/demo /M:"$dir/$scene.fb" /N:14 /R:10 /D:"$dir/$scene" >/dev/null
done
ok "what has leapt looks as if it had stayed" cmp "$dir/leap/F0000013.PPM" "$dir/still/F0000013.PPM"
# In grey only one of the two objects at a hollow's wall may be painted.
for shiny in a d; do
	printf 'sphere a size 40\nsphere d size 16 at 0 0 -20\ndent a d\nfinish %s shiny\n' $shiny >"$dir/hollow.fb"
	for program in demo demo32; do
		ok "$program: a hollow, $shiny shines" sh tools/run32.sh build/$program /M:"$dir/hollow.fb" /G /N:3 /D:"$dir/$program"
	done
	same "32-bit host, a hollow, $shiny shines" "$dir/demo" "$dir/demo32"
	rm -rf "$dir/demo" "$dir/demo32"
done
# The report's method: what turns is lit anew, though no position on any path changes.
cat >"$dir/turns.fb" <<END
group g
spin g axis 0 1 0 period 4
cylinder a size 24 length 30 at -14 0 0 in g
cylinder b size 24 length 30 at 14 0 0 turn 0 0 90 in g
blend a b
END
build/demo /M:"$dir/turns.fb" /P /N:12 /R:10 >"$dir/out"
ok "the report's method lights what turns" test "$(sed -n 's/^normals per frame: \([0-9]*\).*/\1/p' "$dir/out")" -gt 300

# Seeds are changed while the program runs, and objects are moved by the mouse: from a script, so on the host builds only.
cat >"$dir/script" <<END
1 key -
2 mouse 40 10 L
3 mouse -30 -10 -
4 key *
5 mouse 0 -400 R
6 key +
7 key *
8 key +
END
for program in demo demo32; do
	FB_INPUT=$dir/script sh tools/run32.sh build/$program /I /N:12 /D:"$dir/$program" >/dev/null
done
same "32-bit host, interactive" "$dir/demo" "$dir/demo32"

# A user who tries everything, imitated by random input; each run has an empty folder, because it may save files.
top=$PWD
for seed in 11 12 13; do
	awk -v seed=$seed -f tests/san/monkey.awk >"$dir/script"
	for program in demo demo32; do
		rm -rf "${dir:?}/at" "${dir:?}/m$program"
		mkdir "$dir/at"
		(cd "$dir/at" && FB_INPUT=$dir/script sh "$top/tools/run32.sh" "$top/build/$program" /I /N:26 /S:4 /D:"$dir/m$program" >/dev/null)
	done
	same "32-bit host, any keys and moves, $seed" "$dir/mdemo" "$dir/mdemo32"
done

# Builds whose Real is float or double.
for switches in '' '/G /S:1' '/P'; do
	rm -rf "$dir/h"
	build/demo /N:40 /D:"$dir/h" $switches >"$dir/h.txt"
	for kind in float double; do
		rm -rf "$dir/f"
		build/demo-$kind /N:40 /D:"$dir/f" $switches >"$dir/f.txt"
		echo "# $kind $switches: $(build/samefrm -near "$dir/h" "$dir/f")"
		ok "nearly the same with $kind $switches" build/samefrm -near "$dir/h" "$dir/f"
	done
done
# The next frame must not count as "nearly" the same.
mkdir "$dir/one" "$dir/two"
for end in PPM Z TXT; do
	cp "$dir/h/F0000004.$end" "$dir/one/F0000000.$end"
	cp "$dir/h/F0000005.$end" "$dir/two/F0000000.$end"
done
ok "another frame is not nearly the same" sh -c "! build/samefrm -near '$dir/one' '$dir/two'"
printf 'x' | dd of="$dir/two/F0000000.TXT" bs=1 seek=3 conv=notrunc 2>/dev/null
cp "$dir/one/F0000000.PPM" "$dir/one/F0000000.Z" "$dir/two"
ok "one byte is noticed" sh -c "! build/samefrm '$dir/one' '$dir/two'"
summary
