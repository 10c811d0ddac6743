#!/bin/sh
# Prints the sums of the golden frames, as the program makes them now: switches, frame, checksums of picture and depth.
# Frames a second apart, so that a few of them see much of the animation.
#
#   tests/golden/sums.sh [DEMO]      default build/demo
set -eu
cd "$(dirname "$0")/../.."
demo=${1:-build/demo}
dir=$(mktemp -d "${TMPDIR:-/tmp}/golden.XXXXXX")
trap 'rm -rf "$dir"' EXIT
trap 'exit 130' HUP INT TERM

while read -r switches; do
	rm -rf "$dir/f"
	# The switches are words of their own.
	"$demo" $switches /D:"$dir/f" >/dev/null
	for picture in "$dir"/f/*.PPM; do
		depth=${picture%PPM}Z
		echo "$switches $(basename "$picture" .PPM) $(cksum <"$picture" | cut -d ' ' -f 1) $(cksum <"$depth" | cut -d ' ' -f 1)"
	done
done <<'END'
/N:8 /R:1
/N:3 /R:60
/N:4 /R:1 /G
/N:3 /R:1 /G /S:1
/N:3 /R:1 /S:4
/N:2 /S:8
/N:1 /S:0.25
/N:4 /R:1 /P
/N:2 /R:1 /P /G /S:4
END
