#!/bin/sh
# Tests of the yardstick: its parts on shapes with known answers, and the tool
# as people call it, on true frames that were then damaged by a known amount.
# Run from the top of the tree. The last line is "N passed, N failed".
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh
build -f tools/truth.mk build/truth build/truthtst

tool=build/truth
status() { # status WANTED COMMAND...: the command ends with that status
	want=$1
	shift
	"$@"
	got=$?
	[ "$got" -eq "$want" ] || { echo "status $got, wanted $want"; return 1; }
}
line() { # line FILE TEXT: the file has exactly this line
	grep -qxF -- "$2" "$1" || { echo "no line: $2"; cat "$1"; return 1; }
}
says() { # says STATUS TEXT COMMAND...: ends so, and standard error has the text
	want=$1 text=$2
	shift 2
	"$@" >/dev/null 2>"$dir/error"
	got=$?
	cat "$dir/error"
	[ "$got" -eq "$want" ] && grep -qF -- "$text" "$dir/error" &&
		[ "$(wc -l <"$dir/error")" -eq 1 ]
}

# Writes bytes (octal escapes) into a file at an offset.
poke() { # poke FILE OFFSET ESCAPES
	printf "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc 2>/dev/null
}
empty='\377\377\377\177'
pixel() { echo $((($2 * 320 + $1) * 4)); }

# Four frames 1/70 s apart of two balls, one of them moving.
for n in 0 1 2 3; do
	cat >"$dir/S$n.TXT" <<END
time 0.$((n * 14 + 100))
eye 0 0 -120
focal 250 208.333
centre 160 100
light 0.5 0.7 -0.5
isovalue 0.5
sphere 1 -8.$n 0 0 60
sphere 2 25 5 8 40
blend 1 2
END
done
mkdir "$dir/true" "$dir/out"
ok "render" "$tool" --render "$dir/true" "$dir/S0.TXT" "$dir/S1.TXT" "$dir/S2.TXT" "$dir/S3.TXT"
ok "frame files" test -s "$dir/true/F0000003.PPM" -a -s "$dir/true/F0000003.TXT"
ok "depth file" test "$(wc -c <"$dir/true/F0000000.Z")" -eq 256000
"$tool" --bars spacing1 "$dir/true" >"$dir/log" 2>&1
ok "the truth holds the bars" test $? -eq 0
ok "frames counted" line "$dir/log" "frames: 4"
ok "pairs counted" line "$dir/log" "flicker pairs: 3"
ok "no holes" line "$dir/log" "holes: 0"
ok "no see-through" line "$dir/log" "see-through pixels: 0"
ok "no outside" line "$dir/log" "outside pixels: 0"
ok "depth of the truth" line "$dir/log" "depth RMS, units: 0.0000"
ok "no flicker" line "$dir/log" "flicker pixels: 0"
ok "one thread finds the same" sh -c \
	"'$tool' --threads 1 --bars spacing1 '$dir/true' | cmp - '$dir/log'"

# True pictures that are kept: the same figures, whether they are made, taken, or made anew because the scenes are others.
mkdir "$dir/truths"
ok "keeping the true pictures" sh -c "'$tool' --bars spacing1 --truths '$dir/truths' '$dir/true' | cmp - '$dir/log'"
ok "all of them" test "$(ls "$dir/truths" | wc -l)" -eq 4
cp -r "$dir/truths" "$dir/others"
ok "taking them" sh -c "'$tool' --bars spacing1 --truths '$dir/truths' '$dir/true' | cmp - '$dir/log'"
for number in 0 1 2 3; do cp "$dir/truths/0-$(((number + 1) % 4))" "$dir/others/0-$number"; done
ok "those of other scenes are not taken" sh -c "'$tool' --bars spacing1 --truths '$dir/others' '$dir/true' | cmp - '$dir/log'"
# The picture of frame 1 under the scene of frame 0: the figures show whether it is taken.
size=$(wc -c <"$dir/true/F0000001.TXT")
{ cat "$dir/true/F0000000.TXT"; tail -c +$((size + 1)) "$dir/truths/0-1"; } >"$dir/others/0-0"
ok "kept ones are used" sh -c "! '$tool' --bars spacing1 --truths '$dir/others' '$dir/true' | cmp -s - '$dir/log'"

# Known damage: 3 holes in frame 1 and 2 see-through pixels in frame 2 (more
# than four units further than the truth), 5 pixels drawn far outside in
# frame 3, of which 2 lie in the picture's corners.
cp -r "$dir/true" "$dir/bad"
for x in 150 151 170; do poke "$dir/bad/F0000001.Z" "$(pixel $x 100)" "$empty"; done
for x in 150 152; do poke "$dir/bad/F0000002.Z" "$(pixel $x 90)" '\000\000\310\000'; done
for at in "0 0" "319 199" "5 5" "6 5" "7 5"; do
	poke "$dir/bad/F0000003.Z" "$(pixel $at)" '\000\000\144\000'
done
"$tool" -v --worst 2 --out "$dir/out" --csv "$dir/csv" --bars spacing2 "$dir/bad" >"$dir/log" 2>&1
ok "a broken bar ends with 1" test $? -eq 1
ok "holes" line "$dir/log" "holes: 3"
ok "see-through" line "$dir/log" "see-through pixels: 2"
ok "outside" line "$dir/log" "outside pixels: 5"
ok "the bar is named" line "$dir/log" "bar broken: holes: 3.0000, at most 0"
ok "no other bar is broken" test "$(grep -c '^bar broken' "$dir/log")" -eq 1
ok "worst frame" grep -q '^worst frame: 1 ' "$dir/log"
ok "two worst frames" test "$(grep -c '^worst frame' "$dir/log")" -eq 2
ok "a line for each frame" test "$(grep -c '^frame ' "$dir/log")" -eq 4
ok "picture of the worst" test "$(wc -c <"$dir/out/W0000001.PPM")" -eq $((968 * 200 * 3 + 15))
ok "pictures of two only" test "$(ls "$dir/out" | wc -l)" -eq 2
ok "records" test "$(wc -l <"$dir/csv")" -eq 5
ok "as many fields in each" test "$(awk -F, '{ print NF }' "$dir/csv" | sort -u)" = 21
ok "record of the holes" test "$(awk -F, '$1 == 1 { print $6 }' "$dir/csv")" = 3

# Flicker: eleven pixels of frame 2 go dark and come back, so both pairs with
# frame 2 in them see them.
cp -r "$dir/true" "$dir/dark"
head=15 # bytes before the samples: "P6\n320 200\n255\n"
for i in 0 1 2 3 4 5 6 7 8 9 10; do
	poke "$dir/dark/F0000002.PPM" $((head + ($((90 * 320 + 150 + i))) * 3)) '\004\004\004'
done
"$tool" "$dir/dark" >"$dir/log" 2>&1
ok "flicker" line "$dir/log" "flicker pixels: 22"
"$tool" --every 2 "$dir/dark" >"$dir/log" 2>&1
ok "every second frame" line "$dir/log" "frames: 2"
ok "no flicker over a gap" line "$dir/log" "flicker, percent of drawn pixels: not measured"

# Colour without ramps: the figure is missing and says so.
cp -r "$dir/true" "$dir/colour"
poke "$dir/colour/F0000000.PPM" $((head + (90 * 320 + 150) * 3)) '\377\000\000'
for n in 1 2 3; do rm "$dir/colour/F000000$n".*; done
"$tool" --bars spacing2 "$dir/colour" >"$dir/log" 2>&1
ok "colour without ramps" line "$dir/log" "brightness RMS, ramp steps: not measured"
ok "not judged either" line "$dir/log" "bar not judged: brightness RMS, ramp steps"
sed 's/^time/ramp 1 255 64 0\
ramp 2 0 128 255\
time/' "$dir/S0.TXT" >"$dir/ramps.txt"
mkdir "$dir/ramped"
ok "render in colour" "$tool" --render "$dir/ramped" "$dir/ramps.txt"
"$tool" --bars spacing1 "$dir/ramped" >"$dir/log" 2>&1
ok "no colour is wrong" line "$dir/log" "pixels of another object's colour: 0"
ok "the border is the true one" line "$dir/log" "border, drawn over true length: 1.0000"
ok "colour with ramps" sh -c "grep '^brightness RMS' '$dir/log' | grep -q ': 0\.'"


# Several directories, and a part of the frames with the ones after them.
"$tool" "$dir/true" "$dir/bad" >"$dir/log" 2>&1
ok "two directories" line "$dir/log" "frames: 8"
ok "pairs within each" line "$dir/log" "flicker pairs: 6"
ok "holes of both" line "$dir/log" "holes: 3"
"$tool" --every 3 --pairs "$dir/true" >"$dir/log" 2>&1
ok "frames 0, 1 and 3" line "$dir/log" "frames: 3"
ok "one pair" line "$dir/log" "flicker pairs: 1"

# Rows of the table, and limits beyond the bars.
"$tool" --head >"$dir/log"
ok "head and two bars" test "$(wc -l <"$dir/log")" -eq 3
"$tool" --bars spacing2 --row TRUE "$dir/true" >"$dir/log"
ok "a row that holds" test $? -eq 0
ok "one line" test "$(wc -l <"$dir/log")" -eq 1
ok "no mark" sh -c "! grep -q '!' '$dir/log'"
"$tool" --bars spacing2 --row BAD "$dir/bad" >"$dir/log"
ok "a row that does not" test $? -eq 1
ok "three holes marked" grep -q ' 3! ' "$dir/log"
printf '# known\nBAD 2 holes 3\nBAD 1 holes 2\nTRUE 2 holes 2\n' >"$dir/limits"
"$tool" --bars spacing2 --row BAD --limits "$dir/limits" --list "$dir/list" "$dir/bad" >"$dir/log"
ok "within its limit" test $? -eq 0
ok "still marked" grep -q ' 3! ' "$dir/log"
ok "figures listed" line "$dir/list" "BAD 2 holes 3"
"$tool" --bars spacing1 --row BAD --limits "$dir/limits" "$dir/bad" >"$dir/log"
ok "beyond its limit" test $? -eq 1
ok "marked twice" grep -q ' 3!! ' "$dir/log"
"$tool" --bars spacing2 --row TRUE --limits "$dir/limits" "$dir/bad" >"$dir/log"
ok "another's limit does not help" test $? -eq 1
echo "BAD 2 hole 3" >"$dir/limits"
ok "a limit of no figure" says 2 "limits:1: expected" "$tool" --bars spacing2 --row A --limits "$dir/limits" "$dir/true"
ok "a row without bars" says 2 "--row wants --bars" "$tool" --row A "$dir/true"

# Trouble: one line, status 2.
ok "no directory" says 2 "no directory" "$tool"
ok "unknown option" says 2 "--frob" "$tool" --frob "$dir/true"
ok "unknown bars" says 2 "spacing3" "$tool" --bars spacing3 "$dir/true"
ok "no such directory" says 2 "$dir/none" "$tool" "$dir/none"
ok "empty directory" says 2 "no frames" sh -c "mkdir '$dir/void' && '$tool' '$dir/void'"
cp -r "$dir/true" "$dir/short"
dd if="$dir/true/F0000000.Z" of="$dir/short/F0000000.Z" bs=1000 count=255 2>/dev/null
ok "short depth file" says 2 "F0000000.Z: has the wrong length" "$tool" "$dir/short"
cp "$dir/true/F0000000.Z" "$dir/short"
printf 'P5\n320 200\n255\n' >"$dir/short/F0000001.PPM"
ok "bad picture" says 2 "F0000001.PPM: is no" "$tool" "$dir/short"
rm "$dir/short/F0000001.PPM"
ok "missing picture" says 2 "F0000001.PPM" "$tool" "$dir/short"
cp "$dir/true/F0000001.PPM" "$dir/short"
echo "blob 9 0 0 0" >>"$dir/short/F0000002.TXT"
ok "unknown word" says 2 "F0000002.TXT:10: unknown word: blob" "$tool" "$dir/short"
ok "help" status 0 "$tool" --help

build/truthtst >"$dir/log" 2>&1
count "$dir/log"
summary
