#!/bin/sh
# Makes the six figures of src/README.md from frames that the program dumps: tests/pics/fig1.png to fig6.png.
#
#   sh tools/figures.sh
#
#   1 seeds at rest, each object alone      2 the same seeds settled on the blended surface
#   3 a scale for each seed                 4 their depths
#   5 brightness                            6 the report's methods beside ours
set -eu
cd "$(dirname "$0")/.." || exit 1
make -s build/demo build/ppm2png
to=tests/pics
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbfigures.XXXXXX")
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM

# Three balls that stand still.
cat >"$dir/APART.FB" <<'END'
light 0.35 0.55 -0.8
sphere a size 44 at -20 -6 0 colour 255 64 48
sphere b size 36 at 14 -12 -6 colour 255 200 48
sphere c size 30 at 2 18 4 colour 72 112 255
END
{
	cat "$dir/APART.FB"
	echo 'blend all'
} >"$dir/BLEND.FB"
echo '0 key *' >"$dir/pixels"

# frame NAME SCENE SWITCHES...: the second frame of a scene, in $dir/NAME.PPM and .Z.
frame() {
	name=$1
	scene=$2
	shift 2
	build/demo "/M:$dir/$scene.FB" /N:2 "$@" "/D:$dir/$name.d" >"$dir/said"
	mv "$dir/$name.d/F0000001.PPM" "$dir/$name.PPM"
	mv "$dir/$name.d/F0000001.Z" "$dir/$name.Z"
}
# pixels COMMAND...: with single pixels in place of scales.
pixels() {
	FB_INPUT=$dir/pixels
	export FB_INPUT
	"$@"
	unset FB_INPUT
}
png() { # png FROM NUMBER
	build/ppm2png --43 --scale 2 "$dir/$1.PPM" "$to/fig$2.png"
}
pixels frame apart APART /S:4
pixels frame blend BLEND /S:4
frame scales BLEND /S:4
frame fine BLEND
frame grey BLEND /G
frame printed BLEND /G /P
png apart 1
png blend 2
png scales 3

# The depths as grey: near is light, what is empty is black.
{
	printf 'P6\n320 200\n255\n'
	od -An -v -t d4 "$dir/fine.Z" | LC_ALL=C awk '
		{ for (i = 1; i <= NF; ++i) z[n++] = $i }
		END {
			near = 2147483647; far = 0
			for (i = 0; i < n; ++i) if (z[i] < 2147483647) { if (z[i] < near) near = z[i]; if (z[i] > far) far = z[i] }
			for (i = 0; i < n; ++i) {
				grey = z[i] == 2147483647 ? 1 : int(254 - 200 * (z[i] - near) / (far - near))
				printf "%c%c%c", grey, grey, grey
			}
		}'
} >"$dir/depth.PPM"
png depth 4
png grey 5

# Left halves and right halves: the report's methods, ours.
{
	printf 'P6\n640 200\n255\n'
	for row in $(seq 0 199); do
		for name in printed grey; do
			tail -c 192000 "$dir/$name.PPM" | tail -c +$((row * 960 + 1)) | head -c 960
		done
	done
} >"$dir/both.PPM"
build/ppm2png --43 "$dir/both.PPM" "$to/fig6.png"
ls -l "$to"/fig?.png
