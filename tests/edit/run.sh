#!/bin/sh
# Tests interactive mode as a user sees it: scripts of keys and mouse moves are played to the program, and the dumped scenes,
# the saved file and the pictures are checked. The last line is "N passed, N failed".
#
# DEMO names another build of the program to test instead of build/demo.
set -u
cd "$(dirname "$0")/../.." || exit 1
top=$(pwd)
if [ -z "${DEMO:-}" ]; then
	make -s build/demo build/demo32 || { echo "0 passed, 1 failed"; exit 1; }
	DEMO=build/demo
fi
make -s build/filmtst || { echo "0 passed, 1 failed"; exit 1; }
demo=$top/$DEMO
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbedit.XXXXXX") || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir" || exit 1
passed=0 failed=0
good() { passed=$((passed + 1)); }
bad() { failed=$((failed + 1)); echo "FAIL $1"; [ ! -s log ] || head -n 12 log; }
ok() { # ok NAME COMMAND...
	name=$1
	shift
	if "$@" >log 2>&1; then good; else bad "$name"; fi
	: >log
}

# play FRAMES SWITCHES...: plays the script on standard input, and dumps the frames into d/.
play() {
	frames=$1
	shift
	cat >script
	rm -rf d
	FB_INPUT=script "$demo" /I "/N:$frames" /S:4 /D:d "$@" >out 2>&1 || bad "the program ended with $?: $(tail -n 1 out)"
}
scene() { sed 1d "$(printf 'd/F%07d.TXT' "$1")"; } # FRAME: its scene without the time
has() { scene "$1" | grep -qxF -- "$2" || { scene "$1"; return 1; }; } # FRAME LINE: the frame's scene has this line
lacks() { ! has "$1" "$2" >/dev/null; }
count() { test "$(scene "$1" | grep -c "^$2 ")" -eq "$3"; }             # FRAME WORD N: N lines begin with this word
alike() { scene "$1" >one; scene "$2" >two; diff one two; }            # FRAME FRAME: both have the same scene
picture() { cmp "$(printf 'd/F%07d.PPM' "$1")" "$(printf 'd/F%07d.PPM' "$2")"; }
depth() { cmp "$(printf 'd/F%07d.Z' "$1")" "$(printf 'd/F%07d.Z' "$2")"; }

# --- Selecting and moving
cat >one.fb <<'END'
sphere first size 20
sphere second size 20 at 30 0 0
cylinder rod size 12 length 20 at -30 0 0
END
play 6 /M:one.fb <<'END'
1 key RIGHT
2 key TAB
2 key UP
3 key TAB
3 key PGUP
4 mouse 40 20 -
5 mouse 0 -8 R
END
ok "arrow" has 1 "sphere 1 2 0 0 20"
ok "next, and up" has 2 "sphere 2 30 2 0 20"
ok "away" has 3 "cylinder 3 -30 -10 2 -30 10 2 12"
ok "mouse" has 4 "cylinder 3 -20 -15 2 -20 5 2 12"
ok "mouse with the right button" has 5 "cylinder 3 -20 -15 4 -20 5 4 12"
ok "the others stay" has 5 "sphere 1 2 0 0 20"
play 5 /M:one.fb <<'END'
1 mouse 0 0 L
2 mouse 0 0 -
3 mouse 4 0 -
4 mouse -4000 4000 -
END
ok "left button selects the next" has 3 "sphere 2 31 0 0 20"
ok "the mouse cannot lose it" has 4 "sphere 2 -76.79993 -57.59949 0 20"

# An object that has just been selected pulses: for a while all of it is brighter, and nothing else is. Of each row below the text
# and the marks, what is brighter than without the selection must be one run of pixels.
row() { od -An -v -tu1 -w960 -j15 "$1" | sed -n 140,165p; } # PICTURE
for colours in /G ""; do
	# shellcheck disable=SC2086
	play 12 /S:2 /R:24 $colours </dev/null
	row d/F0000011.PPM >plain
	# shellcheck disable=SC2086
	printf '3 key TAB\n3 key TAB\n3 key TAB\n' | play 12 /S:2 /R:24 $colours
	row d/F0000011.PPM | paste -d ' ' plain - | awk '{
		runs = within = 0
		for (i = 1; i <= NF / 2; i += 3) {
			brighter = $(i + NF / 2) > $i
			runs += brighter && !within
			within = brighter
		}
		most = runs > most ? runs : most
		bright += runs
	} END { print bright, most }' >runs
	ok "what is selected pulses as a whole $colours" grep -qx '26 1' runs
done

# Presses during the drawing of a frame must not be lost, even if they follow each other quickly.
play 4 /M:one.fb <<'END'
1 mouse 0 0 L
1 mouse 0 0 -
1 mouse 0 0 L
1 mouse 0 0 -
2 key RIGHT
END
ok "two clicks in a frame select the next but one" has 2 "cylinder 3 -28 -10 0 -28 10 0 12"

# --- The pointer, which starts in the middle of the screen and moves a pixel for two mickeys
play 9 /M:one.fb <<'END'
1 key m
1 mouse 125 0 -
2 mouse 0 0 L
3 mouse 48 -24 L
4 mouse 0 0 -
5 mouse 60 60 -
6 key RIGHT
7 mouse 0 100 L
8 key RIGHT
END
ok "a pointer moves no object" alike 0 1
ok "a click on it selects and moves nothing" alike 0 2
ok "held, it goes with the pointer" has 3 "sphere 2 41.51917 6.91132 0 20"
ok "let go, it stays" alike 3 5
ok "it is the selected one" has 6 "sphere 2 43.51917 6.91132 0 20"
ok "a click on nothing" alike 6 7
ok "leaves it selected" has 8 "sphere 2 45.51917 6.91132 0 20"
ok "the others stay" has 8 "sphere 1 0 0 0 20"

# With a focal length of one pixel the edges of the picture lie thousands of units aside.
printf 'focal 1 1\nsphere a size 20 at 0 0 110\n' >short.fb
play 4 /M:short.fb <<'END'
1 key RIGHT
2 key m
3 mouse 400 0 R
END
ok "moved before a very short focal length" has 1 "sphere 1 2 0 110 20"
ok "and to an end of space" has 3 "sphere 1 250 0 110 20"

# --- Input that does not wait for the end of a frame
ends() { # SCRIPT SWITCHES...: plays the script; leaves out, err and status
	printf "$1" >script
	shift
	FB_INPUT=script "$demo" "$@" >out 2>err
	echo $? >status
}
ends '4.3 key ESC\n' /N:50
ok "ESC in the middle of a frame" grep -qx "frames: 4" out
ends '4.100 key ESC\n' /N:50
ok "ESC at its end" grep -qx "frames: 5" out
# While the seeds of a hollow are laid out, between two frames.
printf 'sphere a size 30\nsphere b size 20 at 20 0 0\nblend a b\ndent a b\n' >hollow.fb
ends '1 key TAB\n1 key k\n1.3 key ESC\n' /I /N:3 /M:hollow.fb
ok "ESC while seeds are laid out" test "$(cat status) $(head -n 1 out)" = "0 frames: 1"
ends '1 key TAB\n1 key k\n1.3 key F2\n1.3 key ESC\n' /I /N:3 /M:hollow.fb
ok "ESC that only ends a question" test "$(cat status) $(head -n 1 out)" = "0 frames: 3"
rm -rf d
ends '4.3 key BREAK\n' /N:50 /D:d
ok "Ctrl-C in the middle of a frame" test "$(cat status) $(ls d/*.PPM | wc -l)" = "1 4"
rm -rf a b
ends '' /N:9 /D:a
ends '4.3 key f\n4.5 key f\n' /N:9 /D:b
ok "other keys wait, and nothing is lost of the frame" diff -r a b
printf '2 key INS\n4 key h\n6 key u\n8 key DEL\n' >script
FB_LOG=log1 FB_INPUT=script "$demo" /I /N:12 >out 2>err
ok "another palette: four times, and the first" test "$(grep -c palette log1)" -ge 5
ok "each with its frame" test "$(sed 1,/palette/d log1 |
	awk 'last == "palette" && $1 != "present" { ++bad } { last = $1 } END { print bad + 0 }')" = 0

# --- Turning, sizes
play 9 /M:one.fb <<'END'
1 key TAB
1 key TAB
1 key z
1 key z
2 key Z
2 key Z
3 key ]
4 key .
4 key 4
5 key ,
5 key [
6 key TAB
6 key 1
7 key x
END
ok "turned by 30 degrees" has 1 "cylinder 3 -25.0003 -8.66028 0 -34.9997 8.66028 0 12"
ok "and back" has 2 "cylinder 3 -30 -10 0 -30 10 0 12"
ok "greater" has 3 "cylinder 3 -30 -10 0 -30 10 0 13"
ok "longer" has 4 "cylinder 3 -30 -11 0 -30 11 0 13"
ok "shorter and smaller" has 5 "cylinder 3 -30 -10.5 0 -30 10.5 0 12"
ok "a sphere smaller" has 6 "sphere 1 0 0 0 19"
ok "a sphere turned" has 7 "sphere 1 0 0 0 19"
(
	i=0
	while [ $i -lt 25 ]; do echo "1 key 1"; i=$((i + 1)); done
	i=0
	while [ $i -lt 120 ]; do echo "2 key 2"; i=$((i + 1)); done
) | play 3 /M:one.fb
ok "no smaller than 1" has 1 "sphere 1 0 0 0 1"
ok "no greater than 100" has 2 "sphere 1 0 0 0 100"

# --- Adding, deleting, linking
play 12 /M:one.fb <<'END'
1 key TAB
1 key INS
2 mouse 0 -40 -
3 key c
4 key l
5 key k
6 key l
7 key DEL
8 key t
9 key d
10 key n
END
ok "added where the selected one is" has 1 "sphere 4 30 0 0 20"
ok "and linked with it" has 1 "blend 2 4"
ok "then it is the selected one" has 2 "sphere 4 30 10 0 20"
ok "a cylinder" has 3 "cylinder 5 30 -2 0 30 22 0 20"
ok "linked already" alike 3 4
ok "parted" lacks 5 "blend 4 5"
ok "linked again" has 6 "blend 4 5"
ok "deleted" lacks 7 "cylinder 5 30 -2 0 30 22 0 20"
ok "with its links" lacks 7 "blend 4 5"
ok "a torus" count 8 torus 1
ok "a disc" count 9 disc 1
ok "a cone" count 10 cone 1
play 9 <<'END'
1 key DEL
2 key DEL
3 key DEL
4 key DEL
5 key u
5 key u
5 key u
6 key u
END
ok "three deleted" count 3 sphere 1
ok "the last one stays" count 4 sphere 1
ok "all back" alike 0 5
ok "nothing more to undo" alike 0 6
play 6 /M:one.fb <<'END'
1 key TAB
2 key DEL
3 key u
4 key RIGHT
END
ok "what comes back is selected" has 4 "sphere 2 32 0 0 20"
play 9 /M:one.fb <<'END'
1 key RIGHT
2 key UP
3 key u
4 key TAB
4 key ]
5 key r
END
ok "after something else nothing is done again" alike 4 5
cat >keyed.fb <<'END'
sphere k size 20
key k 0 5 0 0
key k 1 9 0 0
END
play 9 /M:keyed.fb <<'END'
1 key o
2 key F2
2 key ENTER
END
ok "another motion takes the place of keys" sh -c '! grep -q "^key" SAVED.FB && grep -q "^sphere k" SAVED.FB'
rm -f SAVED.FB

# --- Undo: forty steps are kept and taken back one by one
(
	i=0
	while [ $i -lt 10 ]; do
		f=$((i * 4 + 1))
		echo "$f key ]"
		echo "$((f + 1)) key RIGHT"
		echo "$((f + 2)) key INS"
		echo "$((f + 3)) key k"
		i=$((i + 1))
	done
	f=41
	while [ $f -lt 81 ]; do echo "$f key u"; f=$((f + 1)); done
) | play 84 /M:one.fb
ok "forty steps did something" count 40 sphere 12
steps=0
while [ $steps -le 40 ]; do
	alike $((40 - steps)) $((40 + steps)) >/dev/null || break
	steps=$((steps + 1))
done
echo "undone step by step: $((steps - 1))"
ok "forty steps undone, each as it was" test $steps -eq 41
# A continued movement is one undo step, until a pause.
(
	for f in 1 2 3 4 5 20 21 22; do echo "$f mouse 8 0 -"; done
	echo "30 key u"
	echo "31 key BREAKLESS" | sed 's/BREAKLESS/u/'
) | play 34 /M:one.fb
ok "moved" has 29 "sphere 1 16 0 0 20"
ok "the second gesture undone" has 30 "sphere 1 10 0 0 20"
ok "the first gesture undone" has 31 "sphere 1 0 0 0 20"

# --- Saving and loading: F2 asks for a name, F3 offers a list
rm -f SAVED.FB
play 8 /M:one.fb <<'END'
1 key TAB
1 key INS
1 key y
1 mouse 13 -7 -
2 key F2
2 key ENTER
3 key DEL
3 key TAB
3 key DEL
4 key F3
4 key ENTER
5 key u
6 key r
END
ok "saved" test -s SAVED.FB
ok "changed after that" count 3 sphere 1
ok "loaded: as it was saved" alike 2 4
ok "loading can be undone" alike 3 5
ok "and done again" alike 4 6
cp SAVED.FB first.fb
play 2 /M:first.fb <<'END'
0 key F2
0 key ENTER
END
ok "a file that is there is not proposed" cmp first.fb SAVED2.FB
ok "and the same scene" count 1 blend 1
play 4 /M:first.fb <<'END'
0 key F2
0 key BACKSPACE
0 key BACKSPACE
0 key BACKSPACE
0 key BACKSPACE
0 key 9
0 key ENTER
1 key DEL
2 key F2
2 key ENTER
END
ok "a name typed, without its end" test -s SAVED9.FB
ok "saved under it again, without a question" sh -c '! cmp -s first.fb SAVED9.FB'
cp SAVED.FB kept
save_over() { # one more event
	play 3 /M:one.fb <<END
0 key F2
0 key BACKSPACE
0 key BACKSPACE
0 key BACKSPACE
0 key BACKSPACE
0 key ENTER
$1
END
}
rm -f SAVED3.FB SAVED2.FB SAVED9.FB
save_over ""
ok "a file that is there is not replaced at once" cmp kept SAVED.FB
save_over "1 key ESC"
ok "nor after ESC" cmp kept SAVED.FB
save_over "1 key ENTER"
ok "but after a second Enter" sh -c '! cmp -s kept SAVED.FB'
cp kept SAVED.FB
play 4 /M:one.fb <<'END'
0 key F2
1 key ESC
2 key RIGHT
END
ok "ESC leaves the question, not the program" has 3 "sphere 1 2 0 0 20"
rm -f SAVED.FB
play 4 <<'END'
1 key F2
1 key ENTER
END
"$demo" /N:20 /S:4 /D:a >out 2>&1
"$demo" /N:20 /S:4 /D:b /M:SAVED.FB >out 2>&1
ok "the model built in, saved: the same frames" diff -r a b
mkdir none
rm -rf d
cp one.fb none/one.scene
(cd none && play 4 /M:one.scene <<'END'
1 key F3
1 key ENTER
END
	mv d ..)
ok "nothing to load: it stays" alike 0 2
echo "sphere a size 20
sphere b size" >SAVED.FB
play 4 /M:one.fb <<'END'
1 key F3
1 key HOME
1 key ENTER
2 key RIGHT
END
ok "a bad file: it stays" alike 0 1
ok "and goes on" has 2 "sphere 1 2 0 0 20"
rm -f SAVED.FB
play 4 /M:one.fb <<'END'
1 key F2
1 key BACKSPACE
1 key /
1 key x
1 key ENTER
2 key RIGHT
END
ok "nowhere to save: it goes on" has 2 "sphere 1 2 0 0 20"

# --- Around the scene: the eye moves, the objects stay, and End brings the eye back
objects() { scene "$1" | grep -v '^eye\|^right\|^up\|^ahead'; }
objectsAlike() { objects "$1" >one; objects "$2" >two; diff one two; }
eyeAt() { # FRAME X Y Z: the eye is there, to a hundredth of a unit
	scene "$1" | awk -v x="$2" -v y="$3" -v z="$4" '
		$1 == "eye" { found = ($2 - x) ^ 2 < 1e-4 && ($3 - y) ^ 2 < 1e-4 && ($4 - z) ^ 2 < 1e-4; print }
		END { exit !found }'
}
printf 'sphere a size 30 at -20 0 0\nsphere b size 20 at 20 0 0 colour blue\n' >two.fb
(i=0; while [ $i -lt 18 ]; do echo "1 key 6"; echo "3 key 5"; echo "5 key 7"; i=$((i + 1)); done
	echo "6 key 8"; i=0; while [ $i -lt 6 ]; do echo "6 key 9"; i=$((i + 1)); done
	echo "8 key 0"; echo "9 key END") | sort -s -n | play 12 /M:two.fb
ok "a quarter round: it looks along the row" eyeAt 1 120 0 0
ok "how it stands is told" has 1 "ahead -1 0 0"
ok "and back" eyeAt 3 0 0 -120
ok "where nothing is told" lacks 3 "ahead 0 0 1"
ok "over it, and no farther than that" eyeAt 5 0 119.54 -10.46
ok "under it again, and nearer" eyeAt 6 0 62.80 -11.07
ok "farther" eyeAt 8 0 69.78 -12.30
ok "its own view" alike 0 9
ok "the picture is what it was" depth 0 9
ok "no object has moved" sh -c 'grep -q "^sphere 1 -20 0 0 30" d/F0000001.TXT'
for f in 1 3 5 6 8; do ok "nor any other: $f" objectsAlike 0 $f; done
# Seen from the side, "right" is still the right of the view, and the pointer selects the object that is seen under it.
(i=0; while [ $i -lt 18 ]; do echo "1 key 6"; i=$((i + 1)); done
	printf '2 key RIGHT\n3 key PGUP\n4 key m\n5 mouse 0 0 L\n6 mouse 0 0 -\n7 key UP\n') | play 10 /M:two.fb
ok "to the right of the view" has 2 "sphere 1 -20 0 2 30"
ok "away from it" has 3 "sphere 1 -22 0 2 30"
ok "the nearer one is in the middle" has 7 "sphere 2 20 2 0 20"
# Seeds that faced away are updated at once: a body that looks the same from behind must cover as many pixels there.
printf 'sphere a size 30 at -9 0 0\nsphere b size 30 at 9 0 0\nblend a b\n' >alike.fb
(i=0; while [ $i -lt 36 ]; do echo "1 key 6"; i=$((i + 1)); done) | play 2 /M:alike.fb
covered() { od -An -v -tx4 -w4 "$(printf 'd/F%07d.Z' "$1")" | grep -vc 7fffffff; }
ok "from behind" eyeAt 1 0 0 120
ok "all of it is there" awk -v front="$(covered 0)" -v back="$(covered 1)" \
	'BEGIN { print front, back; exit !(front > 2000 && back > front * 0.99 && back < front * 1.01) }'
# In automatic mode the arrow keys move the eye, too.
cat >script <<'END'
2 key RIGHT
3 key UP
4 key PGUP
5 key END
END
rm -rf a d
FB_INPUT=script "$demo" /N:10 /S:4 /D:d /M:two.fb >out 2>&1
ok "turned while it plays" eyeAt 2 10.46 0 -119.54
ok "and over it" eyeAt 3 10.42 10.46 -119.09
ok "and nearer" sh -c '! cmp -s d/F0000003.Z d/F0000004.Z'
"$demo" /N:10 /S:4 /D:a /M:two.fb >out 2>&1
for f in 0 1 5 6 7 8 9; do ok "the rest is as without keys: $f" cmp "a/F000000$f.TXT" "d/F000000$f.TXT"; done
for f in 6 7 8 9; do ok "and its depths: $f" sh -c "cmp a/F000000$f.Z d/F000000$f.Z"; done

# --- Groups: their objects move in the directions of the world, however the group is turned and scaled
cat >group.fb <<'END'
group g at 10 0 0 turn 0 0 90 scale 2
sphere s size 10 at 5 0 0 in g
sphere t size 8 at 5 0 0 in s
END
play 6 /M:group.fb <<'END'
1 key RIGHT
2 key DEL
3 key u
END
ok "placed" has 0 "sphere 1 10 10 0 20"
ok "moved in the world" has 1 "sphere 1 12 10 0 20"
ok "with what it carries" has 1 "sphere 2 12 20 0 16"
ok "what it carried stays" has 2 "sphere 2 12 20 0 16"
ok "and back" alike 1 3

play 12 /M:one.fb <<'END'
1 key TAB
1 key g
2 key s
3 key RIGHT
4 key s
5 key RIGHT
6 key G
7 key u
8 key TAB
8 key g
9 key G
END
ok "into a group: all stay where they are" alike 0 1
ok "the whole group moves" sh -c '! cmp -s d/F0000002.TXT d/F0000003.TXT'
moved() { # FRAME FRAME SPHERE: prints how far the sphere moves along x
	echo "$(scene "$1" | grep "^sphere $3 ") $(scene "$2" | grep "^sphere $3 ")" | awk '{ print $9 - $3 }'
}
ok "both of it" test "$(moved 2 3 1) $(moved 2 3 2) $(moved 2 3 3)" = "2 2 0"
ok "then one alone" test "$(moved 4 5 1) $(moved 4 5 2)" = "0 2"
ok "out of it again: it stays where it is" alike 5 6
ok "undone" alike 5 7
ok "a third one joins" alike 5 8
play 9 <<'END'
1 key TAB
1 key g
3 key TAB
3 key g
5 key G
END
ok "what goes its way stays on it" alike 0 2
ok "and a third one" alike 0 4
ok "and out of the group" alike 0 6

# --- Colour, weight, motion, light; undo, redo
rm -f SAVED*.FB
play 16 /M:one.fb <<'END'
1 key h
2 key h
3 key H
4 key TAB
4 key l
5 key w
6 key W
7 key W
7 key W
7 key W
8 key q
9 key e
10 key Q
10 key E
11 key u
12 key r
END
ok "another colour" lacks 1 "ramp 1 255 64 48"
ok "and another" sh -c '! grep -qxF "$(grep "^ramp 1 " d/F0000001.TXT)" d/F0000002.TXT'
ok "and back" alike 1 3
ok "linked" has 4 "blend 1 2"
ok "a greater weight" has 5 "blend 1 2 1.25"
ok "and less" has 6 "blend 1 2"
ok "and less" has 7 "blend 1 2 0.25"
ok "the light comes from elsewhere" lacks 8 "light 0.5 0.7 -0.5"
ok "and still elsewhere" sh -c '! grep -qxF "$(grep "^light " d/F0000008.TXT)" d/F0000009.TXT'
ok "undone" sh -c '! cmp -s d/F0000010.TXT d/F0000011.TXT'
ok "done again" alike 10 12
# A change that fails is no step, and what was undone before can still be done again. (With seeds so close a ring of 31 would need
# too many of them; and an object does not join a group that it carries itself.)
cat >fails.fb <<'END'
torus first size 20 ring 30
group g at 10 0 0 in first
sphere second size 20 in g
END
cat >script <<'END'
1 key h
2 key .
3 key u
4 key .
5 key TAB
5 key TAB
5 key g
6 key r
7 key .
8 key u
END
rm -rf d
FB_INPUT=script "$demo" /I /N:9 /S:0.305 /M:fails.fb /D:d >out 2>&1
ok "another colour" lacks 1 "$(scene 0 | grep '^ramp 1 ')"
ok "no larger ring" alike 1 2
ok "the colour undone" alike 0 3
ok "still no larger ring" alike 0 4
ok "not into the group that it carries" alike 0 5
ok "the colour done again" alike 1 6
ok "no larger ring even so" alike 1 7
ok "and the colour undone" alike 0 8
printf '1 key h\n2 key j\n3 key u\n' >script
rm -rf d
FB_INPUT=script "$demo" /I /N:4 /S:0.305 /M:fails.fb /D:d >out 2>&1
ok "no stretched ring" alike 1 2
ok "which is no step either" alike 0 3
# What an object has dug closes when the object is deleted.
printf 'sphere far size 10 at 60 0 0\nsphere one size 40 at 0 0 10\n' >whole.fb
{ echo "sphere dig size 20"; cat whole.fb; echo "dent one dig"; } >dug.fb
play 6 /M:whole.fb </dev/null
mv d whole
for switches in "" /P; do
	# shellcheck disable=SC2086
	play 6 /M:dug.fb $switches <<'END'
2 key DEL
END
	ok "the hollow closes $switches" sh -c '! cmp -s d/F0000001.Z d/F0000005.Z'
	[ -n "$switches" ] || ok "as if it had never been" cmp d/F0000005.Z whole/F0000005.Z
done
rm -rf whole
# Strengths and dents
play 16 /M:one.fb <<'END'
1 key i
2 key I
2 key I
3 key u
4 key TAB
4 key l
5 key b
6 key w
7 key W
7 key W
8 key F2
8 key ENTER
9 key b
10 key u
10 key u
10 key u
11 key DEL
12 key u
END
ok "stronger" has 1 "strength 1 1.25"
ok "weaker" has 2 "strength 1 0.75"
ok "undone" count 3 strength 0
ok "linked" has 4 "blend 1 2"
ok "it digs in" has 5 "dent 1 2 1"
ok "and is parted" lacks 5 "blend 1 2"
ok "by more" has 6 "dent 1 2 1.25"
ok "and less" has 7 "dent 1 2 0.75"
ok "saved" grep -qxF "dent $(awk 'NR == 4 { print $2 }' SAVED.FB) $(awk 'NR == 5 { print $2 }' SAVED.FB) 0.75" SAVED.FB
ok "filled" count 9 dent 0
ok "undone step by step" has 10 "blend 1 2"
ok "deleted and back" alike 10 12
rm -f SAVED.FB
# Finish, pattern, stretch
play 17 /M:one.fb <<'END'
1 key ;
2 key ;
3 key ;
4 key '
5 key '
6 key '
7 key '
8 key j
9 key J
9 key J
10 key u
11 key '
11 key ;
12 key j
13 key F2
13 key ENTER
14 key u
14 key u
14 key u
END
ok "shiny" has 1 "shiny 1"
ok "a mirror" has 2 "mirror 1"
ok "and matt again" alike 0 3
ok "checks, as large as they say" sh -c "grep -q '^checks 1 6 ' d/F0000004.TXT"
ok "stripes" sh -c "grep -q '^stripes 1 6 ' d/F0000005.TXT"
ok "marble" sh -c "grep -q '^marble 1 6 ' d/F0000006.TXT"
ok "and none" alike 0 7
ok "stretched" sh -c "grep -q '^stretch 1 .* 1 1.25 1\$' d/F0000008.TXT"
ok "and flattened" sh -c "grep -q '^stretch 1 .* 1 0.75 1\$' d/F0000009.TXT"
ok "undone" alike 0 10
ok "all three" sh -c "grep -c -e '^shiny 1$' -e '^checks 1 ' -e '^stretch 1 ' d/F0000012.TXT | grep -qx 3"
ok "are undone" alike 0 14
"$demo" /M:SAVED.FB /N:1 /S:4 /D:is >out 2>&1
ok "and saved" sh -c 'sed 1d d/F0000012.TXT >one; sed 1d is/F0000000.TXT | diff one -'
rm -rf is
rm -f SAVED.FB
# Everything that the format can express is saved, also after an undone step: the saved scene plays like the loaded one.
cat >all.fb <<'END'
title Everything
colours mixed
group g at 0 4 0 turn 0 20 0 scale 1.25
swing g axis 0 1 0 angle 20 period 5
sphere a size 30 stretch 1.5 0.75 1 in g colour red
finish a shiny
pattern a checks 6 #2040c0
strength a 1.5
taper a 0.3 swing 0.2 period 4 phase 0.25
cylinder b size 16 length 40 at 20 0 0 turn 0 0 80 in g colour 10 200 90
finish b mirror
twist b 40 swing 60 period 3
bend b -50
pattern b stripes 4 white
box c size 14 x 10 y 20 z 6 at -30 0 0
pattern c marble 9 black
keys c smooth repeat 6 axis 0 1 0
key c 0 0 0 0
key c 2 5 5 0 angle 90 scale 0.8
torus t size 8 ring 14 at -30 20 0 stretch 1 1 0.5
disc d size 10 disc 9 at 30 -20 0
cone k size 14 tip 6 length 20 at 30 24 0
pulse k by 0.2 period 2
sphere e size 18 at 8 4 -12
path e x 4 3 0 x 3 2 0.5
circle e radius 6 plane yz period 4
dent a e 0.75
dent b e
blend a b 0.5
blend a c
light 0.2 0.6 -0.8
focal 260 216.666667
eye 0 10 -110 turn 0 5 0
circle eye radius 12 plane xy period 9
look a
roll 7
END
for file in all.fb "$top"/tools/scenes/*.FB; do
	rm -f SAVED.FB
	play 5 "/M:$file" <<'END'
1 key i
2 key u
3 key F2
3 key ENTER
END
	rm -rf d was is
	"$demo" "/M:$file" /N:6 /R:1 /S:4 /D:was >out 2>&1 || bad "$file"
	"$demo" /M:SAVED.FB /N:6 /R:1 /S:4 /D:is >out 2>&1 || bad "$file, saved"
	# Links may be in another order.
	for text in was/*.TXT is/*.TXT; do
		sort -o "$text" "$text"
	done
	ok "$file saved plays the same" sh -c 'test "$(ls was | wc -l)" -eq 18 && diff -r was is'
done
rm -f SAVED.FB
# After a change of the light, the picture must equal that of a scene which has this light from the start.
play 40 /M:one.fb <<'END'
1 key e
1 key F2
1 key ENTER
39 key p
END
cp SAVED.FB lit.fb
mv d d1
play 40 /M:lit.fb </dev/null
ok "seen in the new light" cmp d1/F0000002.Z d/F0000002.Z
"$top/build/filmtst" pcx SHOT0001.PCX shot.ppm
ok "a screenshot is what is shown" cmp shot.ppm d1/F0000039.PPM
ok "as bright as from the start" cmp d1/F0000038.PPM d/F0000038.PPM
rm -f SAVED*.FB SHOT*.PCX
# Each kind of motion moves the object while time runs; the last choice stops the object.
play 80 /M:one.fb <<'END'
0 key SPACE
1 key o
10 key o
20 key o
30 key o
40 key o
50 key o
60 key o
61 key v
END
for from in 2 12 42 62; do
	# (A spinning or swinging ball looks the same in all frames.)
	ok "it moves: frame $from" sh -c "! cmp -s \"$(printf 'd/F%07d.Z' $from)\" \"$(printf 'd/F%07d.Z' $((from + 4)))\""
done
ok "then it stands" alike 52 56

# Taper, twist and bend are no motion that another takes the place of; when they swing, their period is one of all.
printf 'cylinder c size 16 length 40\ntaper c 0.3 swing 0.2 period 4 phase 0.25\nbend c -50\n' >warped.fb
play 3 /M:warped.fb <<'END'
1 key o
1 key v
1 key F2
1 key ENTER
END
ok "the taper stays, and is faster" grep -qx "taper .* 0.3 swing 0.2 period 3.2.* phase 0.25" SAVED.FB
ok "the bend stays" grep -qx "bend .* -50" SAVED.FB
ok "it goes round" grep -qx "circle .* period 4.8.*" SAVED.FB
rm -f SAVED.FB

# --- Running: nothing moves unless time runs
play 12 <<'END'
2 key SPACE
7 key SPACE
END
ok "it stands" alike 0 1
ok "it runs" sh -c '! cmp -s d/F0000003.TXT d/F0000005.TXT'
ok "it stands again" alike 8 11

# --- Texts on the screen
play 40 /M:one.fb <<'END'
10 key F1
12 key F1
END
ok "the help page" sh -c '! cmp -s d/F0000009.PPM d/F0000010.PPM'
ok "leaves no trace" picture 9 13
ok "and does not touch depths" depth 9 10
cat >script <<'END'
4 key F1
6 key F1
8 key f
END
rm -rf a b
"$demo" /N:10 /S:4 /D:a >out 2>&1
FB_INPUT=script "$demo" /N:10 /S:4 /D:b >out 2>&1
ok "automatic: nothing unless a key asks" cmp a/F0000003.PPM b/F0000003.PPM
ok "automatic: the help page" sh -c '! cmp -s a/F0000004.PPM b/F0000004.PPM'
ok "automatic: gone again" cmp a/F0000006.PPM b/F0000006.PPM
ok "automatic: frames a second" sh -c '! cmp -s a/F0000008.PPM b/F0000008.PPM'
same=0
for f in 0 1 2 3 4 5 6 7 8 9; do
	cmp -s "a/F000000$f.Z" "b/F000000$f.Z" && cmp -s "a/F000000$f.TXT" "b/F000000$f.TXT" && same=$((same + 1))
done
ok "automatic: depths and scenes untouched" test $same -eq 10
cat >script <<'END'
2 key DEL
3 key INS
4 key TAB
5 key F3
END
rm -rf b
FB_INPUT=script "$demo" /N:10 /S:4 /D:b >out 2>&1
ok "automatic: no key edits" diff -r a b

# A long name takes a second line; a long message hides the frame rate.
ink() { "$top/build/filmtst" ink "$(printf 'd/F%07d.PPM' "$1")" "$2" "$3" "$4" "$5"; } # frame x y wide high
cat >long.fb <<'END'
sphere averyveryverylo size 20.125
cone theotherlongone size 20.125 tip 12.25 length 30.375 at 10 0 0
END
play 60 /M:long.fb <<'END'
20 key f
30 key TAB
32 key l
40 key F2
40 key /
40 key x
40 key y
40 key ENTER
END
ok "one line at the top" test "$(ink 10 0 12 320 9)" -eq 0
ok "two where there is more to say" test "$(ink 34 0 12 320 9)" -gt 50
ok "the frame rate" test "$(ink 25 240 189 80 11)" -gt 50
ok "is not written over" test "$(ink 25 240 150 80 50)" -eq "$(ink 42 240 150 80 50)"
ok "a long message beside it" test "$(ink 42 0 180 240 20)" -gt 200

# --- Automatic mode: time is stopped, stepped, restarted, slowed down and sped up
auto() { # FRAMES SWITCHES...: plays the script on standard input, and dumps the frames into d/
	frames=$1
	shift
	cat >script
	rm -rf d
	FB_INPUT=script "$demo" "/N:$frames" /R:8 /S:8 /D:d "$@" >out 2>&1 || bad "the program ended with $?: $(tail -n 1 out)"
}
auto 40 </dev/null
rm -rf plain
mv d plain
was() { # FRAME PLAIN: the scene equals that of frame PLAIN of the run without keys
	scene "$1" >one
	sed 1d "$(printf 'plain/F%07d.TXT' "$2")" | diff one -
}
auto 30 <<'END'
10 key SPACE
12 key .
13 key .
15 key SPACE
18 key HOME
20 key .
END
ok "space holds it" was 11 9
ok "a step" was 12 10
ok "another" was 14 11
ok "space lets it go" was 17 14
ok "from the start" was 19 2
ok "a step holds it too" was 29 3
auto 20 <<'END'
0 key >
5 key <
10 key <
END
ok "faster" was 4 8
ok "slower again" was 9 13
ok "and half as fast" was 19 18
(i=0; while [ $i -lt 9 ]; do echo "0 key >"; i=$((i + 1)); done) | auto 4
ok "at most eight times" was 3 24
(i=0; while [ $i -lt 9 ]; do echo "0 key <"; i=$((i + 1)); done; echo "1 key SPACE") | auto 12
ok "a message tells so" test "$(ink 2 0 185 200 15)" -gt 50
auto 6 <<'END'
1 key +
2 key -
END
ok "the spacing is told" test "$(ink 1 0 185 200 15)" -gt 50
ok "and frames without keys bear no words" test "$(ink 0 0 0 320 200)" -eq 0

# The next scene: the scenes in the program's folder, in order.
mkdir beside
cp "$demo" beside/demo
printf 'title a ball all alone\nsphere a size 11\n' >beside/A.FB
echo "sphere b size" >beside/B.FB
echo "sphere c size 13" >beside/c.fb
printf '1 key n\n2 key n\n3 key n\n4 key n\n' >script
rm -rf d
FB_INPUT=script beside/demo /N:6 /S:8 /D:d >out 2>&1
ok "the first scene" has 1 "sphere 1 0 0 0 11"
ok "with its title" test "$(ink 1 50 185 100 15)" -gt 50
ok "the third has none" test "$(ink 3 50 185 100 15)" -eq 0
ok "a bad one: it stays" alike 1 2
ok "and says why" test "$(ink 2 0 180 320 20)" -gt 100
ok "the one behind it" has 3 "sphere 1 0 0 0 13"
ok "then the first again" alike 4 1
rm -rf d
FB_INPUT=script beside/demo /N:6 /S:8 /D:d /M:beside/B.FB >out 2>&1
ok "a bad scene from the start ends it" test ! -e d
FB_INPUT=script beside/demo /N:6 /S:8 /D:d /M:beside/A.FB >out 2>&1
ok "on from the one that was loaded" has 2 "sphere 1 0 0 0 13"
rm -rf none
mkdir none
cp "$demo" none/demo
FB_INPUT=script none/demo /N:6 /S:8 /D:none/d >out 2>&1
ok "no scenes: it goes on" test -s none/d/F0000005.PPM

# Films must show the dumped frames, on 64 and 32 bits, in colour and grey; and the first messages of a run in real time.
film() { "$top/build/filmtst" "$@"; }
rm -rf d
printf '5 key h\n7 key INS\n9 key F1\n11 key F1\n' >script
FB_INPUT=script "$demo" /I /N:30 /D:d /A:f.fli >out 2>&1
ok "a film is what was shown, colours that change too" film same f.fli 0 d
rm -rf d
"$demo" /N:20 /R:35 /G /D:d /A:f.fli >out 2>&1
ok "in grey" film same f.fli 0 d
ok "at its pace" sh -c "'$top/build/filmtst' frames f.fli | grep -q '^20 frames of 2/70 s'"
if [ -c /dev/full ]; then
	ok "a full disk" sh -c "! '$demo' /N:2 /A:/dev/full 2>err && grep -q 'disk full' err"
else
	echo "# no /dev/full: a film that does not fit on a disk not tried"
fi
(trap '' XFSZ; ulimit -f 200; exec "$demo" /N:200 /A:part.fli) >out 2>&1
ok "what fits of a film is kept" sh -c 'test $(od -An -tu4 -N4 part.fli) -eq $(wc -c <part.fli) &&
	test $(od -An -tu2 -j6 -N2 part.fli) -gt 10'
cp f.fli older.fli
ok "a scene is not replaced by a film" sh -c "! '$demo' /N:2 /M:one.fb /A:one.fb 2>err && grep -q 'one.fb: this is no film' err"
ok "and is still there" grep -q sphere one.fb
ok "nor is a film, when there can be no dump" sh -c "! '$demo' /N:2 /D:one.fb/d /A:f.fli 2>err && cmp f.fli older.fli"
ok "a film that cannot be" sh -c "! '$demo' /N:2 /A:none/none/x.fli 2>err && grep -q 'none/none/x.fli: no such file' err"
timeout -s INT 4.5 "$demo" /S:8 /A:f.fli >out 2>&1
ok "broken off, it is whole" film frames f.fli
mkdir -p d
film frame f.fli 30 d/F0000000.PPM
film frame f.fli 120 d/F0000001.PPM
ok "F1 help, ESC ends" test "$(ink 0 0 185 200 15)" -gt 50
ok "after three seconds no more" test "$(ink 1 0 185 200 15)" -eq 0
"$demo" /T:1 /S:8 /A:f.fli >out 2>&1
film frame f.fli 20 d/F0000000.PPM
ok "not in a run of so many seconds" test "$(ink 0 0 0 320 200)" -eq 0
# On a busy machine the last frame of that second may take long.
for _ in 1 2 3; do
	"$demo" /B /T:1 /S:8 >out 2>&1
	! grep -q "in 1.0[0-9] seconds" out || break
done
ok "a benchmark says one line" sh -c 'test $(wc -l <out) -eq 1 &&
	grep -q "^four spheres, spacing 8: [0-9.]* frames a second ([0-9]* frames in 1.0[0-9] seconds)$" out'

# --- The same tests on the 32-bit build
if [ -x "$top/build/demo32" ] && [ "$DEMO" = build/demo ]; then
	cat >script <<'END'
1 key TAB
2 key c
2 key x
3 mouse 30 -20 -
4 key ]
5 key F1
7 key f
8 key l
9 key u
10 key SPACE
END
	rm -rf a b
	FB_INPUT=script "$demo" /I /N:20 /D:a >out 2>&1
	FB_INPUT=script sh "$top/tools/run32.sh" "$top/build/demo32" /I /N:20 /D:b >out 2>&1
	ok "64 bits and 32: the same frames" diff -r a b
	# All tests above are repeated with the sanitizers.
	(cd "$top" && make -s build/san/demo && DEMO=build/san/demo sh tests/edit/run.sh) >san 2>&1
	ok "under the sanitizers: $(tail -n 1 san)" grep -q ' passed, 0 failed$' san
	# The tests in DOSBox, by keyboard and mouse.
	(cd "$top" && sh tests/edit/dos.sh) >dos 2>&1
	grep -v '^ok ' dos | sed '$d'
	last=$(tail -n 1 dos)
	case $last in
	*" passed, "*" failed")
		passed=$((passed + ${last%% *}))
		last=${last##*passed, }
		failed=$((failed + ${last%% *}))
		;;
	*) bad "tests/edit/dos.sh did not reach its end" ;;
	esac
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
