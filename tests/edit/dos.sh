#!/bin/sh
# Interactive mode in a DOSBox window, with the keyboard and mouse of an X server: the saved scene must contain what was done by
# hand, and the host's program must read the scene. The last line is "N passed, N failed".
cd "$(dirname "$0")/../.." || exit 1
. tests/dos/lib.sh

if ! startDisplay; then
	echo "# no Xvfb and xdotool: hands-on editing not tried in DOSBox"
	echo "0 passed, 0 failed"
	exit 0
fi
make -s build/DEMO.EXE build/demo build/filmtst || exit 1
c=$scratch/c
mkdir "$c"
cp build/DEMO.EXE "$c/DEMO.EXE" || exit 1
printf 'sphere one size 24 at -20 0 0\r\nsphere two size 20 at 20 0 0\r\n' >"$c/HAND.FB"

type() {
	for key in "$@"; do
		xdotool key "$key" sleep 0.3 2>/dev/null
	done
}

dos -w -c 60000 -- cls 'DEMO /I /G /S:4 /M:HAND.FB > OUT.TXT' "$E1" &
running=$!
awaitTitle DEMO
type F1 F1 f
# The second object is selected; a cylinder is added in its place, turned twice and enlarged.
type Tab c z z bracketright
# The first click only makes DOSBox capture the mouse.
xdotool mousemove --window "$dosWindow" 300 200 sleep 0.5 click 1 sleep 1 2>/dev/null
for i in 1 2 3 4 5; do
	xdotool mousemove_relative -- 6 -8 sleep 0.1 2>/dev/null
done
sleep 0.5
# One more sphere is added and taken back; then the scene is saved.
type Insert u F2 Return Escape
wait $running

ok 'the program ended well' has "$c/OUT.TXT" 'frames: '
ok 'the program ended with status 0' status 0 "$c"
tr -d '\r' <"$c/SAVED.FB" >"$scratch/saved" 2>/dev/null
ok 'a saved scene' test -s "$scratch/saved"
ok 'the first sphere is as it was' has "$scratch/saved" 'sphere one size 24 at -20 0 0'
ok 'the cylinder, greater and turned' grep -q '^cylinder cylinder3 size 21 length 24 at .* turn 0 0 30 colour' "$scratch/saved"
ok 'it blends with the sphere where it began' has "$scratch/saved" 'blend cylinder3 two'
ok 'what was undone is not there' lacks "$scratch/saved" 'sphere sphere4'
set -- $(sed -n 's/^cylinder .* at \([-0-9]*\)[.0-9]* \([-0-9]*\).*/\1 \2/p' "$scratch/saved")
echo "# the mouse brought the cylinder from 20 0 to ${1:-?} ${2:-?}"
ok 'the mouse moved it right and up' test "${1:-0}" -gt 22 -a "${2:-0}" -gt 2
ok "the host's program plays it" build/demo /X /N:2 "/M:$scratch/saved"

# Caps Lock must not change anything. A pointer (from the middle of the screen, two mickeys a pixel) selects what it clicks on.
rm -f "$c"/*.TXT "$c/SAVED.FB"
dos -w -c 60000 -- cls 'DEMO /I /G /S:4 /M:HAND.FB /A:HAND.FLI > OUT.TXT' "$E1" &
running=$!
awaitTitle DEMO
xdotool mousemove --window "$dosWindow" 300 200 sleep 0.5 click 1 sleep 1 2>/dev/null
type Caps_Lock Tab z Caps_Lock m
for i in 1 2 3 4 5 6 7 8; do
	xdotool mousemove_relative -- -10 0 sleep 0.1 2>/dev/null
done
xdotool mousedown 1 sleep 0.05 mouseup 1 sleep 0.5 2>/dev/null
# tests/edit/run.sh tests that a short click between two frames of a slow machine is not lost.
type bracketright semicolon apostrophe j F2 Return F1
sleep 0.5
type Escape
wait $running
ok 'a second run ended well' has "$c/OUT.TXT" 'frames: '
tr -d '\r' <"$c/SAVED.FB" >"$scratch/saved" 2>/dev/null
grep '^sphere' "$scratch/saved" | sed 's/^/# /'
ok 'x y z turn the same way with Caps Lock' sh -c "grep -c 'turn 0 0 15' '$scratch/saved' | grep -qx 1"
ok 'the click picked the sphere on the left' grep -q '^sphere one size 25 ' "$scratch/saved"
ok 'it is stretched' grep -q '^sphere one .* stretch 1 1.25 1 ' "$scratch/saved"
ok 'its finish' has "$scratch/saved" 'finish one shiny'
ok 'its pattern' grep -q '^pattern one checks 6 ' "$scratch/saved"
ok 'the other is as large as it was' grep -q '^sphere two size 20 ' "$scratch/saved"
ok 'a film of it' build/filmtst frames "$c/HAND.FLI"
build/filmtst frames "$c/HAND.FLI" | sed 's/^/# /'

# A film and a screenshot must have the same bytes as the host's; the screenshot is made after the selected object has pulsed.
build/demo /N:30 /S:4 "/A:$scratch/host.fli" >/dev/null
printf '20 key p\n21 key ESC\n' >"$scratch/script"
host=$PWD/build/demo
(cd "$scratch" && FB_INPUT=script "$host" /I /S:4 /N:40 /M:c/HAND.FB >/dev/null)
rm -f "$c"/*.TXT
dos -w -c 60000 -- 'DEMO /N:30 /S:4 /A:DOS.FLI > FILM.TXT' 'DEMO /I /S:4 /M:HAND.FB /T:60 > OUT.TXT' &
running=$!
tries=0
while [ ! -s "$c/FILM.TXT" ] && [ $tries -lt 100 ]; do
	sleep 0.2
	tries=$((tries + 1))
done
awaitTitle DEMO
sleep 2
type p
sleep 1
type Escape
wait $running
ok 'a film: the bytes of the host' cmp "$scratch/host.fli" "$c/DOS.FLI"
ok 'a screenshot: the bytes of the host' cmp "$scratch/SHOT0001.PCX" "$c/SHOT0001.PCX"

# The keys of a PC move the eye around the scene: the view must equal the host's, and the eye must come back.
printf '2 key RIGHT\n2 key RIGHT\n2 key UP\n2 key PGUP\n3 key p\n4 key ESC\n' >"$scratch/script"
rm -f "$c"/*.PCX "$scratch"/*.PCX
(cd "$scratch" && FB_INPUT=script "$host" /S:4 /N:40 /M:c/HAND.FB >/dev/null)
dos -w -c 60000 -- cls 'DEMO /S:4 /M:HAND.FB /T:60 > OUT.TXT' &
running=$!
awaitTitle DEMO
sleep 3
type p Right Right Up Prior p End
sleep 5
type p
sleep 1
type Escape
wait $running
ok 'about the scene: the bytes of the host' cmp "$scratch/SHOT0001.PCX" "$c/SHOT0002.PCX"
ok 'it is another view' sh -c "! cmp -s '$c/SHOT0001.PCX' '$c/SHOT0002.PCX'"
ok 'End: its own view' cmp "$c/SHOT0001.PCX" "$c/SHOT0003.PCX"

# The next scene in the program's folder.
rm -f "$c"/*.FB "$c"/*.TXT
printf 'sphere a size 11\r\n' >"$c/A.FB"
printf 'sphere b size 12\r\n' >"$c/B.FB"
dos -w -c 60000 -- 'DEMO /S:8 /D:F > OUT.TXT' &
running=$!
awaitTitle DEMO
type n n
sleep 1
type Escape
wait $running
ok 'n: the first scene' grep -q '^sphere 1 0 0 0 11' "$c/F/"*.TXT
ok 'n: the second scene' grep -q '^sphere 1 0 0 0 12' "$c/F/"*.TXT
summary
