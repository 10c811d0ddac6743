#!/bin/sh
# Makes the pictures of the pages from the program's own frames, all of them in tests/pics:
#
#   demo.gif        six seconds of the four spheres, in colour, ten frames a second
#   worst1.png, worst2.png    the two frames of the whole minute that are farthest from the true surface: ours, the true
#                   one, and the difference (tools/truth.cpp tells its colours)
#   true1.png to true3.png    the four spheres, the walk and a scene of all kinds: ours, the true surface, the difference
#   NAME.png        a moment of each shipped scene
#   snail.png       the scene that tools/scenes/README.md makes step by step
#
#   sh tools/picture.sh               all of them
#   sh tools/picture.sh scenes DIR    those of the scenes alone, into DIR, for the page that plays
#
# Pictures are stretched to the shape that they have on a 4:3 screen.
set -eu
cd "$(dirname "$0")/.." || exit 1
to=tests/pics
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbpics.XXXXXX")
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM

make -s build/demo build/ppm2png
# Seconds at which a scene is worth a look; where none are told, 2.
scenes() { # scenes DIR
	for file in tools/scenes/*.FB; do
		name=$(basename "$file" .FB)
		case $name in
		GULP | APART | FACE) at=3 ;;
		FALL | DROP) at=4 ;;
		FLYPAST) at=5 ;;
		TOUR) at=10 ;;
		LAMP) at=15 ;;
		*) at=2 ;;
		esac
		build/demo "/M:$file" /N:$((at + 1)) /R:1 "/D:$dir/$name" >"$dir/said"
		build/ppm2png --43 "$dir/$name/F$(printf %07d "$at").PPM" "$1/$(echo "$name" | tr '[:upper:]' '[:lower:]').png"
	done
}
if [ "${1:-}" = scenes ]; then
	scenes "$2"
	exit 0
fi

make -s build/truth build/mkgif
build/demo /N:60 "/D:$dir/demo" >"$dir/said"
build/mkgif --43 --delay 10 $to/demo.gif "$dir/demo"

build/demo /N:600 "/D:$dir/minute" >"$dir/said"
mkdir "$dir/worst"
build/truth --worst 2 --out "$dir/worst" "$dir/minute" >"$dir/said"
number=0
for frame in $(sed -n 's/^worst frame: \([0-9]*\) .*/\1/p' "$dir/said"); do
	number=$((number + 1))
	build/ppm2png --43 "$dir/worst/W$(printf %07d "$frame").PPM" $to/worst$number.png
done

number=0
for file in tools/scenes/FOUR.FB tools/scenes/WALK.FB tests/scenes/speed/MIX.FB; do
	number=$((number + 1))
	build/demo "/M:$file" /N:21 "/D:$dir/true$number" >"$dir/said"
	mkdir "$dir/true$number/one" "$dir/true$number/out"
	mv "$dir/true$number"/F0000020.* "$dir/true$number/one"
	build/truth --worst 1 --out "$dir/true$number/out" "$dir/true$number/one" >"$dir/said"
	build/ppm2png --43 "$dir/true$number/out/W0000020.PPM" $to/true$number.png
done

# What stands in that page is what is drawn.
awk '/^```scene snail$/ { inside = 1; next } /^```$/ { inside = 0 } inside' tools/scenes/README.md >"$dir/SNAIL.FB"
build/demo "/M:$dir/SNAIL.FB" /N:8 /R:1 "/D:$dir/snail" >"$dir/said"
build/ppm2png --43 "$dir/snail/F0000007.PPM" $to/snail.png

scenes $to
ls -l $to
