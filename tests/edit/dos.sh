#!/bin/sh
# Hands on in DOSBox, in a window, with the keyboard and the mouse of an X server: what was done by hand is in the scene
# that the program saves, and the host's program reads it. Closes with "N passed, N failed".
cd "$(dirname "$0")/../.." || exit 1
. tests/dos/lib.sh

if ! startDisplay; then
	echo "# no Xvfb and xdotool: hands-on editing not tried in DOSBox"
	echo "0 passed, 0 failed"
	exit 0
fi
make -s build/DEMO.EXE build/demo || exit 1
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
# The second is selected; a cylinder comes where it is, turned twice and made greater.
type Tab c z z bracketright
# The first click only gives DOSBox the mouse.
xdotool mousemove --window "$dosWindow" 300 200 sleep 0.5 click 1 sleep 1 2>/dev/null
for i in 1 2 3 4 5; do
	xdotool mousemove_relative -- 6 -8 sleep 0.1 2>/dev/null
done
sleep 0.5
# A sphere too many, taken back; then saved.
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
summary
