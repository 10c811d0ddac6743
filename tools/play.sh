#!/bin/sh
# Plays DEMO.EXE in DOSBox, in a window: `make run`. Where there is no display it plays all the same, FRAMES frames (40)
# without a window, and leaves them as pictures.
#
#   play.sh [SCENE [SWITCHES...]]
#
# SCENE is the name of a shipped scene (walk), or a scene file; empty: the four spheres. What the program saves
# (SAVED.FB) and dumps is left in build/play. CYCLES, from the environment, is the speed of the processor as
# tools/dosbox.sh has it (max).
cd "$(dirname "$0")/.." || exit 1
scene=${1:-}
[ $# -eq 0 ] || shift
mkdir -p build/play || exit 1
cp build/DEMO.EXE build/play/DEMO.EXE || exit 1
if [ -n "$scene" ]; then
	file=$scene
	[ -f "$file" ] || file=tools/scenes/$(basename "$scene" | sed "s/\.[Ff][Bb]\$//" | tr '[:lower:]' '[:upper:]').FB
	if [ ! -f "$file" ]; then
		echo "play.sh: no scene '$scene'; there are $(cd tools/scenes && ls ./*.FB | sed 's/^..//; s/\.FB$//' | tr '[:upper:]\n' '[:lower:] ')" >&2
		exit 2
	fi
	cp "$file" build/play/SCENE.FB || exit 1
	set -- /M:SCENE.FB "$@"
fi
if [ -n "${DISPLAY:-}" ]; then
	sh tools/dosbox.sh -w -t 0 -c "${CYCLES:-max}" -d build/play -- "DEMO $* > STATS.TXT" || exit 1
	# What the program said: its statistics, or why it did not play.
	tr -d '\r' <build/play/STATS.TXT
	exit 0
fi

frames=${FRAMES:-40}
rm -rf build/play/FRAMES build/play/PICTURES
echo "There is no display here: DOSBox plays $frames frames of DEMO.EXE without a window."
sh tools/dosbox.sh -t 600 -c "${CYCLES:-max}" -d build/play -- "DEMO /N:$frames /D:FRAMES $* > STATS.TXT" || exit 1
tr -d '\r' <build/play/STATS.TXT
if [ ! -f build/play/FRAMES/F0000000.PPM ]; then
	echo "play.sh: DEMO.EXE left no frames" >&2
	exit 1
fi
mkdir -p build/play/PICTURES
build/mkgif --43 --delay 10 build/play/PICTURES/DEMO.GIF build/play/FRAMES >/dev/null || exit 1
for frame in build/play/FRAMES/F*0.PPM; do
	build/ppm2png --43 "$frame" "build/play/PICTURES/$(basename "$frame" .PPM).PNG" >/dev/null || exit 1
done
echo "What it showed:"
echo "  build/play/PICTURES/DEMO.GIF     all frames, animated"
echo "  build/play/PICTURES/F*.PNG       every tenth frame"
echo "  build/play/FRAMES                each frame as dumped: picture, depths, scene"
