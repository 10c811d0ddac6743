#!/bin/sh
# The program as people call it, on the host: exit status, what is said where, keys and mouse from a script, dumps.
#
#   tests/cli/run.sh [DEMO]     default build/demo
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

demo=${1:-build/demo}
build "$demo"
demo=$PWD/$demo

# ends STATUS ARGUMENT...: the program ends so; what it says is in $dir/out and $dir/err.
ends() {
	want=$1
	shift
	"$demo" "$@" >"$dir/out" 2>"$dir/err" </dev/null
	got=$?
	[ "$got" -eq "$want" ] || {
		echo "status $got, expected $want"
		cat "$dir/err"
		return 1
	}
}
# refuses WORD: status 2, one line on standard error that begins with the word, nothing on standard output.
refuses() {
	ends 2 "$1" && [ ! -s "$dir/out" ] && [ "$(wc -l <"$dir/err")" -eq 1 ] &&
		case $(cat "$dir/err") in
		"$1"*) ;;
		*)
			cat "$dir/err"
			false
			;;
		esac
}
# says FILE TEXT
says() {
	grep -qF -- "$2" "$1" || {
		echo "no \"$2\" in:"
		cat "$1"
		false
	}
}
# figure NAME: its value in the statistics last written
figure() {
	sed -n "s/^$1: //p" "$dir/out"
}
is() { # is WANTED NAME
	[ "$(figure "$2")" = "$1" ] || {
		echo "$2: $(figure "$2"), expected $1"
		false
	}
}
# plays SCRIPT ARGUMENT...: with scripted keys and mouse
plays() {
	printf "$1" >"$dir/script"
	shift
	FB_INPUT=$dir/script ends 0 "$@"
}

for word in /Q /F:0 /F:101 /F:x /F: /S:9 /S:0.2 /S:x /S /N:0 /N:x /N:10000000 /T:0 /T:x /D: /M: /G:1 x -q -s:-1 /IG; do
	ok "refuses $word" refuses "$word"
done
ok "one bad switch among good ones" ends 2 /G /N:5 /Q
ok "nothing was played" test ! -s "$dir/out"
ok "a file that is not there" ends 2 "/M:$dir/none.txt"
ok "and it is named" says "$dir/err" "$dir/none.txt"

# A word that is no switch is a scene: as a file that is there, or with .FB behind its name.
printf 'sphere a size 30\n' >"$dir/ONE.FB"
top=$PWD
cd "$dir" || exit 1
for word in ONE.FB ONE ./ONE "/M:$dir/ONE" "/M=$dir/ONE.FB"; do
	ok "plays $(basename "$word")" ends 0 "$word" /N2/S4/G
	ok "that scene" test "$(figure seeds)" -lt 300
	ok "and two frames of it" is 2 frames
done
ok "refuses two scenes" ends 2 ONE ONE
cd "$top" || exit 1
ok "a scene that is not there, without its ending" ends 2 "/M:$dir/TWO"
ok "and it is named as it was given" says "$dir/err" "$dir/TWO: no such file"
# What is said about bytes that are no text is text, and one line.
odd=$(printf '/Qone\ntwo\033[31m\377')
ok "odd bytes in a switch" ends 2 "$odd"
ok "are shown as numbers" says "$dir/err" '/Qone\x0Atwo\x1B[31m\xFF: unknown switch'
ok "in one line" test "$(wc -l <"$dir/err")" -eq 1
odd=$(printf '%s/no\nfile\033' "$dir")
for switch in "/M:$odd" "/O:$odd/x" "/D:$odd/x" "/A:$odd/x"; do
	ok "odd bytes in a name" sh -c "! '$demo' /N:1 '$switch' 2>'$dir/err' >'$dir/out'"
	ok "are shown as numbers" says "$dir/err" '/no\x0Afile\x1B'
	ok "in one line" test "$(wc -l <"$dir/err")" -eq 1
done
printf 'sphere a size 10\n' >"$odd.fb"
ok "the line of a benchmark" ends 0 /B /N:1 "/M:$odd.fb"
ok "has no odd bytes either" says "$dir/out" '/no\x0Afile\x1B.fb, spacing 2: '
long=$dir/$(printf '%0200d' 0)/scene.fb
ok "a long name" ends 2 "/M:$long"
ok "is told to its end" says "$dir/err" 'scene.fb: no such file'
printf 'sphere a size 300\n' >"$dir/$(printf '%0130d' 0).fb"
ok "a mistake in a file with a long name" ends 2 "/M:$dir/$(printf '%0130d' 0).fb"
ok "is told to its end, with its line" says "$dir/err" "0.fb:1: '300': expected size from 1 to 100"
ok "/F with /N" ends 0 /F:20 /N:3 "/O:$dir/held.csv"
ok "says that it has no effect" says "$dir/err" "/F has no effect with /N or /S"
ok "and the seeds are those of the spacing" is 2496 seeds
ok "/F with /S" ends 0 /F:20 /S:4 /T:1
ok "says so too" says "$dir/err" "/F has no effect with /N or /S"
# A host draws hundreds of frames a second: to hold one it takes more seeds, up to one for a pixel.
ok "/F" ends 0 /F:1 /T:1 "/O:$dir/held.csv"
ok "says nothing" test ! -s "$dir/err"
ok "more seeds" test "$(figure seeds)" -gt 4000
ok "a record of it" says "$dir/held.csv" "S:2 F:1,"
ok "F4 holds a rate" plays '3 key F4\n' /T:1
ok "more seeds with F4" test "$(figure seeds)" -gt 4000
ok "F4 with /N does not" plays '1 key F4\n' /N:200
ok "nor changes anything" is 2496 seeds
ok "F4 twice lets go" plays '3 key F4\n3 key F4\n' /T:1
ok "before any change" is 2496 seeds
ok "+ lets go" plays '3 key F4\n3 key -\n' /T:1
ok "for the user's spacing" test "$(figure seeds)" -lt 2000
printf 'sphere thin size 3\n' >"$dir/thin.fb"
ok "a thin object" ends 0 /N:1 "/M:$dir/thin.fb"
thin=$(figure seeds)
ok "let go" plays '3 key F4\n3 key -\n4 key ESC\n' "/M:$dir/thin.fb"
ok "gets fewer seeds too" test "$(figure seeds)" -lt "$thin"
ok "/R without /N" ends 0 /R:35 /T:1 /S:8
ok "says that it has no effect" says "$dir/err" "/R has no effect without /N"
ok "/R with /N" ends 0 /R:35 /N:1
ok "says nothing" test ! -s "$dir/err"

for word in '/?' '-?'; do
	ok "help by $word" ends 0 "$word"
	ok "on standard output" says "$dir/out" "/S:n"
	ok "and nowhere else" test ! -s "$dir/err"
done

# Statistics: the names in order, and what must come out exactly.
ok "ten frames" ends 0 /N:10
cat >"$dir/names" <<END
frames
seconds
fps
seeds
oversampled seeds
updated per frame
drawn per frame
iterations per update
normals per frame
field evaluations per frame
END
sed 's/: .*//' "$dir/out" | head -n 10 >"$dir/got"
ok "names in order" cmp "$dir/names" "$dir/got"
ok "frames" is 10 frames
ok "seeds" is 2496 seeds
ok "oversampled seeds" is 2480 "oversampled seeds"
cp "$dir/out" "$dir/first"
ok "every switch in the other spelling" ends 0 -n:10
ok "the same figures" cmp "$dir/first" "$dir/out"
ok "a second of real time" ends 0 /T:1 /S:4
case $(figure seconds) in
1.*) ok "lasts a second" true ;;
*) ok "lasts a second, not $(figure seconds)" false ;;
esac

# Records: a header when the file is new, then a line a run, each with as many fields.
ok "a record" ends 0 /N:3 "/O:$dir/runs.csv"
ok "another" ends 0 /N:2 /G /P /S:4 "/O:$dir/runs.csv"
ok "three lines" test "$(wc -l <"$dir/runs.csv")" -eq 3
ok "the same fields" test "$(awk -F , '{ print NF }' "$dir/runs.csv" | sort -u | wc -l)" -eq 1
ok "one header" test "$(grep -c frames "$dir/runs.csv")" -eq 1
ok "the settings of the second" sh -c "sed -n 3p '$dir/runs.csv' | grep -q '^S:4 G P'"
ok "the frames of the second" test "$(sed -n 3p "$dir/runs.csv" | cut -d , -f 2)" = 2
ok "with the scene" ends 0 /N:1 /S:8 "/M:$dir/ONE" "/O:$dir/runs.csv"
ok "in its own field" sh -c "sed -n 4p '$dir/runs.csv' | cut -d , -f 14 | grep -qF '\"$dir/ONE\"'"
ok "and day and hour" sh -c "sed -n 4p '$dir/runs.csv' | cut -d , -f 15 |
	grep -q '^20[0-9][0-9]-[01][0-9]-[0-3][0-9] [0-2][0-9]:[0-5][0-9]:[0-5][0-9]\$'"
ok "and the machine" sh -c "sed -n 4p '$dir/runs.csv' | tr -d '\r' | cut -d , -f 16 | grep -q '^$(uname -s) '"
ok "named in the header" sh -c "sed -n 1p '$dir/runs.csv' | tr -d '\r' | grep -q ',scene,date,machine\$'"
# Found out before the run: what cannot be opened, and what is another file.
: >"$dir/file"
ok "a record that cannot be kept" ends 1 /N:1 "/O:$dir/file/runs.csv"
ok "is named" says "$dir/err" "$dir/file/runs.csv"
ok "before anything was played" test ! -s "$dir/out"
cp "$dir/ONE.FB" "$dir/copy"
ok "a file that is no file of records" ends 2 /N:1 "/O:$dir/ONE.FB"
ok "is named" says "$dir/err" "$dir/ONE.FB: this is no file of records"
ok "and stays as it was" cmp "$dir/copy" "$dir/ONE.FB"
ok "nothing was played" test ! -s "$dir/out"
sed '1s/iterations/Iterations/' "$dir/runs.csv" >"$dir/other.csv"
ok "a file of other records" ends 2 /N:1 "/O:$dir/other.csv"
ok "is no file of ours" says "$dir/err" "other.csv: this is no file of records"
ok "an empty file takes a record" ends 0 /N:1 /S:8 "/O:$dir/file"
ok "with the names before it" test "$(wc -l <"$dir/file")" -eq 2
if [ -c /dev/full ]; then
	# Room for twenty bytes more.
	{
		cat "$dir/runs.csv"
		printf '%0*d\n' $((2048 - 21 - $(wc -c <"$dir/runs.csv"))) 0
	} >"$dir/small.csv"
	cp "$dir/small.csv" "$dir/copy"
	(
		trap '' XFSZ
		ulimit -f 4
		"$demo" /N:1 /S:8 "/O:$dir/small.csv" 2>"$dir/err"
		echo "status $?"
	) | cat >"$dir/out"
	ok "a disk that fills up" says "$dir/out" "status 1"
	ok "is told" says "$dir/err" "small.csv: disk full"
	ok "the statistics are told all the same" is 1 frames
	ok "and the records stay whole" cmp "$dir/copy" "$dir/small.csv"
	(
		trap '' XFSZ
		ulimit -f 0
		"$demo" /N:1 /S:8 "/O:$dir/none.csv" 2>&1
	) | cat >"$dir/out"
	ok "a full disk" says "$dir/out" "none.csv: disk full"
	ok "leaves no empty file" test ! -e "$dir/none.csv"
else
	echo "# no /dev/full: records that do not fit on a disk not tried"
fi

# Dumps: three files a frame, the same every time, the picture changed by what should change it alone.
dump() { # dump NAME ARGUMENT...
	to=$dir/$1
	shift
	ends 0 "$@" "/D:$to"
}
ok "dump" dump a /N:3
ok "nine files" test "$(ls "$dir/a" | wc -l)" -eq 9
ok "names" test -f "$dir/a/F0000002.PPM" -a -f "$dir/a/F0000000.Z" -a -f "$dir/a/F0000001.TXT"
ok "sizes" test "$(wc -c <"$dir/a/F0000001.PPM")" -eq 192015 -a "$(wc -c <"$dir/a/F0000001.Z")" -eq 256000
ok "again" dump b -n:3
ok "the same bytes" diff -r "$dir/a" "$dir/b"
ok "into a directory that is there" dump b /N:3
ok "the same bytes again" diff -r "$dir/a" "$dir/b"
# An older dump of more frames does not show through.
ok "a longer dump" dump older /N:6 /S:8
ok "and a shorter one over it" dump older /N:3
ok "leaves nothing of the first" diff -r "$dir/a" "$dir/older"
ok "no frame at all" sh -c "echo '0 key ESC' >'$dir/script' && FB_INPUT='$dir/script' '$demo' /N:3 '/D:$dir/older' >'$dir/out'"
ok "leaves no file" test -z "$(ls "$dir/older")"
ok "time of the third" says "$dir/a/F0000002.TXT" "time 0.200"
ok "frames differ" sh -c "! cmp -s '$dir/a/F0000000.PPM' '$dir/a/F0000001.PPM'"
ok "grey" dump g /N:3 /G
ok "a longer dump in colour" dump long /N:40
ok "and in grey" dump longer /N:40 /G
rm "$dir"/long*/*.PPM "$dir"/long*/*.TXT
ok "same depths in grey" diff -r "$dir/long" "$dir/longer"
ok "other picture" sh -c "! cmp -s '$dir/a/F0000002.PPM' '$dir/g/F0000002.PPM'"
ok "coarse" dump s /N:3 /S:4
ok "same scene" sh -c "cmp '$dir/a/F0000002.TXT' '$dir/s/F0000002.TXT'"
ok "as printed" dump p /N:3 /P
ok "same scene as printed" sh -c "cmp '$dir/a/F0000002.TXT' '$dir/p/F0000002.TXT'"
: >"$dir/file"
ok "a directory that cannot be" sh -c "'$demo' /N:1 '/D:$dir/file/sub' 2>'$dir/err'; test \$? -eq 1 -o \$? -eq 2"
ok "is named in one line" sh -c "grep -qF '$dir/file/sub' '$dir/err' && test \$(wc -l <'$dir/err') -eq 1"
if [ -c /dev/full ]; then
	mkdir "$dir/full"
	ln -s /dev/full "$dir/full/F0000001.Z"
	ok "a full disk" ends 1 /N:3 "/D:$dir/full"
	ok "is told in one line" sh -c "grep -qi 'disk full' '$dir/err' && test \$(wc -l <'$dir/err') -eq 1"
	ok "with the file" says "$dir/err" F0000001.Z
else
	echo "# no /dev/full: frames that do not fit on a disk not tried"
fi

# Keys.
ok "ESC ends" plays '5 key ESC\n' /N:50
ok "after five frames" is 5 frames
ok "ESC before the first frame" plays '0 key ESC\n' /N:50
ok "no frame" is 0 frames
ok "ESC behind a key that opens a question" plays '0 key F2\n0 key ESC\n' /I /N:3
ok "no frame of it" is 0 frames
ok "ESC behind a key that loads a scene" plays '0 key n\n0 key ESC\n' /N:3
ok "no frame of that" is 0 frames
ok "- makes coarser" plays '1 key -\n1 key -\n' /N:3
ok "fewer seeds" test "$(figure seeds)" -lt 2000
ok "+ makes finer" plays '1 key +\n' /N:3
ok "more seeds" test "$(figure seeds)" -gt 3000
ok "+ and - again" plays '1 key +\n1 key -\n2 key -\n2 key +\n' /N:3
ok "as many seeds as before" is 2496 seeds
ok "+ stops at 0.25" plays '0 key +\n0 key +\n0 key +\n' /N:1 /S:0.3
most=$(figure seeds)
ends 0 /N:1 /S:0.25
ok "the same as /S:0.25" is "$most" seeds
ok "- stops at 8" plays '0 key -\n0 key -\n0 key -\n' /N:1 /S:7
least=$(figure seeds)
ends 0 /N:1 /S:8
ok "the same as /S:8" is "$least" seeds
ok "resampled and kept going" plays '1 key +\n2 key +\n3 key -\n4 key *\n5 key *\n6 key ESC\n' /N:9
ok "six frames" is 6 frames
printf '1 key *\n2 key *\n' >"$dir/script"
FB_INPUT=$dir/script dump x /N:3 >"$dir/said" 2>&1
ok "* and * again: frame 0" cmp "$dir/a/F0000000.PPM" "$dir/x/F0000000.PPM"
ok "pixels in frame 1" sh -c "! cmp -s '$dir/a/F0000001.PPM' '$dir/x/F0000001.PPM'"
ok "scales in frame 2" cmp "$dir/a/F0000002.PPM" "$dir/x/F0000002.PPM"
# While many seeds are laid out: a line of text says so, and neither ESC nor Ctrl-C waits for their end.
ok "many seeds" ends 0 /N:1 /S:0.25
ok "are told of" test "$(cat "$dir/err")" = "Laying out 158,388 seeds of 4 objects ..."
ok "few seeds" ends 0 /N:1
ok "are not" test ! -s "$dir/err"
printf 'torus T size 20 ring 40\n' >"$dir/ring.fb"
ok "a spacing beyond a limit" ends 1 /N:1 /S:0.25 "/M:$dir/ring.fb"
ok "names the limit" says "$dir/err" "65536 is the limit; try a larger spacing with /S"
for polls in 10 300 600; do
	ok "ESC after $polls looks at the keyboard" plays "0.$polls key ESC\n" /N:1 /S:0.25
	ok "no frame after $polls" is 0 frames
	printf '0.%d key BREAK\n' $polls >"$dir/script"
	ok "Ctrl-C after $polls" sh -c "FB_INPUT='$dir/script' '$demo' /N:1 /S:0.25 >'$dir/out' 2>'$dir/err'; test \$? -eq 1"
	ok "no statistics after $polls" test ! -s "$dir/out"
done
# While one object is updated: with a seed every quarter of a unit that is most of the frame.
ok "ESC in the first update" plays '0.3000 key ESC\n' /N:3 /S:0.25
ok "no frame of it" is 0 frames
printf '2 key BREAK\n' >"$dir/script"
ok "Ctrl-C" sh -c "FB_INPUT='$dir/script' '$demo' /N:50 >'$dir/out' 2>'$dir/err'; test \$? -eq 1"
ok "says so" says "$dir/err" interrupted

# The mouse: which object moves, and how.
place() { # place DIRECTORY FRAME OBJECT: x y z
	sed -n "s/^sphere $3 \([^ ]* [^ ]* [^ ]*\) .*/\1/p" "$dir/$1/F000000$2.TXT"
}
moves() { # moves NAME SCRIPT ARGUMENT...
	rm -rf "${dir:?}/$1"
	printf "$2" >"$dir/script"
	name=$1
	shift 2
	FB_INPUT=$dir/script dump "$name" /I "$@"
}
compare() { # compare OBJECT AWK-CONDITION on x y z (before) and X Y Z (after), frames 1 and 3 of m
	echo "$(place m 1 "$1") $(place m 3 "$1")" |
		awk "{ x = \$1; y = \$2; z = \$3; X = \$4; Y = \$5; Z = \$6; if (!($2)) { print; exit 1 } }"
}
ok "the mouse moves" moves m '2 mouse 20 0 -\n' /N:4
ok "right" compare 1 'X > x && Y == y && Z == z'
ok "others stay" compare 2 'X == x && Y == y && Z == z'
moves m '2 mouse 0 -20 -\n' /N:4
ok "up" compare 1 'X == x && Y > y && Z == z'
moves m '2 mouse 0 20 R\n' /N:4
ok "with the right button along z" compare 1 'X == x && Y == y && Z != z'
moves m '1 mouse 0 0 L\n1 mouse 0 0 -\n2 mouse 20 0 -\n' /N:4
ok "the left button selects the next" compare 2 'X > x && Y == y && Z == z'
ok "and the first stays" compare 1 'X == x && Y == y && Z == z'
script='1 mouse 0 0 L\n1 mouse 0 0 -\n1 mouse 0 0 L\n1 mouse 0 0 -\n1 mouse 0 0 L\n1 mouse 0 0 -\n1 mouse 0 0 L\n1 mouse 0 0 -\n'
moves m "${script}10 mouse 20 0 -\n" /N:12
at() { # at FRAME OBJECT
	sed -n "s/^sphere $2 \([^ ]* [^ ]* [^ ]*\) .*/\1/p" "$dir/m/F00000$1.TXT"
}
ok "after the last comes the first" test "$(at 01 1)" != "$(at 11 1)"
ok "and no other" test "$(at 01 2)" = "$(at 11 2)"
# Once round all four, and once more, for the names of the selected one and the one before are on the screen.
moves m '0 mouse 0 0 L\n1 mouse 0 0 -\n2 mouse 0 0 L\n3 mouse 0 0 -\n4 mouse 0 0 L\n5 mouse 0 0 -\n6 mouse 0 0 L\n7 mouse 0 0 -\n'\
'20 mouse 0 0 L\n21 mouse 0 0 -\n22 mouse 0 0 L\n23 mouse 0 0 -\n'\
'24 mouse 0 0 L\n25 mouse 0 0 -\n26 mouse 0 0 L\n' /N:40
ok "nothing moves by itself" cmp "$dir/m/F0000019.PPM" "$dir/m/F0000016.PPM"
ok "the selected one pulses" sh -c "! cmp -s '$dir/m/F0000029.PPM' '$dir/m/F0000039.PPM'"
ok "and is as before again" cmp "$dir/m/F0000019.PPM" "$dir/m/F0000039.PPM"
for far in '30000 0 -' '-30000 0 -' '0 30000 -' '0 -30000 -' '0 30000 R' '0 -30000 R' '30000 30000 R'; do
	moves m "2 mouse $far\n" /N:4
	ok "kept in view: $far" compare 1 'Z > -110 && Z < 300 && X * X * 62500 <= (Z + 120) * (Z + 120) * 26000 &&
		Y * Y * 43403 <= (Z + 120) * (Z + 120) * 10200'
done
ok "without a mouse it says so" plays '9 key ESC\n' /I /N:3
ok "in words, beside the statistics" sh -c "grep -qi 'mouse' '$dir/err' && ! grep -qi 'mouse' '$dir/out'"
ok "a benchmark of few frames has a rate" sh -c "'$demo' /B /N:20 | grep -q ': [1-9][0-9.]* frames a second'"
ok "a time ends a run of frames" timeout 20 "$demo" /N:9999999 /T:1
printf 'nonsense\n' >"$dir/script"
ok "half a script is no script" sh -c "FB_INPUT='$dir/script' '$demo' /N:1 >/dev/null 2>&1; test \$? -ne 0"
summary
