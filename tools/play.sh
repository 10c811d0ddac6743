#!/bin/sh
# Plays DEMO.EXE in DOSBox, in a window: `make run`.
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
sh tools/dosbox.sh -w -t 0 -c "${CYCLES:-max}" -d build/play -- "DEMO $* > STATS.TXT" || exit 1
# What the program said: its statistics, or why it did not play.
tr -d '\r' <build/play/STATS.TXT
