#!/bin/sh
# Makes the pictures of the README from the program's own frames, all of them in tests/pics:
#
#   demo.gif        six seconds of the four spheres, in colour, ten frames a second
#   worst1.png, worst2.png    the two frames of the whole minute that are farthest from the true surface: ours, the true
#                   one, and the difference (tools/truth.cpp tells its colours)
#   NAME.png        a moment of each shipped scene
#
#   sh tools/picture.sh
#
# Pictures are stretched to the shape that they have on a 4:3 screen.
set -eu
cd "$(dirname "$0")/.." || exit 1
make -s build/demo build/truth build/mkgif build/ppm2png
to=tests/pics
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbpics.XXXXXX")
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM

build/demo /N:60 "/D:$dir/demo" >"$dir/said"
build/mkgif --43 --delay 10 $to/demo.gif "$dir/demo"

build/demo /G /N:600 "/D:$dir/minute" >"$dir/said"
mkdir "$dir/worst"
build/truth --worst 2 --out "$dir/worst" "$dir/minute" >"$dir/said"
number=0
for frame in $(sed -n 's/^worst frame: \([0-9]*\) .*/\1/p' "$dir/said"); do
	number=$((number + 1))
	build/ppm2png --43 "$dir/worst/W$(printf %07d "$frame").PPM" $to/worst$number.png
done

# Seconds at which a scene is worth a look.
while read -r name at; do
	build/demo "/M:tools/scenes/$name.FB" /N:$((at + 1)) /R:1 "/D:$dir/$name" >"$dir/said"
	build/ppm2png --43 "$dir/$name/F$(printf %07d "$at").PPM" "$to/$(echo "$name" | tr '[:upper:]' '[:lower:]').png"
done <<-END
WALK 2
GULP 3
FALL 4
APART 3
FLYPAST 5
WORM 2
END
ls -l $to
