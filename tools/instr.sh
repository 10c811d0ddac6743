#!/bin/sh
# Instructions a frame of scenes, by the room of the program that they are spent in, beside the bars of tools/bars.txt:
# the quick look while one works on the speed. `make bench` tells more.
#
#   instr.sh [-t N] [-f] [-s SPACING] [-n FRAMES] [-d DIR] [SCENE...]
#
#   -t N        the N dearest functions of each scene, too: instructions and estimated clocks a frame
#   -f          the sources behind each scene's rooms, too
#   -s SPACING  another spacing than 2 (the bars are for 2)
#   -n FRAMES   another number of frames than 70
#   -d DIR      another place than build/instr for what was counted: NAME.long for callgrind_annotate, NAME.cost
#   SCENE       the name of a scene of tools/scenes or tests/scenes/speed (walk), or a scene file; default: all of both
#
# The 32-bit host program is run under callgrind with /G /R:35, once for 5 frames and once for 75; the difference is 70
# frames. Two scenes run at a time.
set -eu
cd "$(dirname "$0")/.." || exit 1

functions=0 sources=no spacing=2 frames=70 work=build/instr
while getopts t:fs:n:d: option; do
	case $option in
	t) functions=$OPTARG ;;
	f) sources=yes ;;
	s) spacing=$OPTARG ;;
	n) frames=$OPTARG ;;
	d) work=$OPTARG ;;
	*) sed -n 's/^#   \(instr.sh\)/usage: \1/p' "$0" >&2 && exit 2 ;;
	esac
done
shift $((OPTIND - 1))
command -v valgrind >/dev/null || {
	echo "instr.sh: valgrind is not installed (Debian: apt-get install valgrind)" >&2
	exit 1
}
[ $# -gt 0 ] || set -- tools/scenes/*.FB tests/scenes/speed/*.FB
mkdir -p "$work"
: >"$work/list"
for scene in "$@"; do
	file=$scene
	if [ ! -f "$file" ]; then
		name=$(basename "$scene" .FB | tr '[:lower:]' '[:upper:]')
		file=tools/scenes/$name.FB
		[ -f "$file" ] || file=tests/scenes/speed/$name.FB
	fi
	[ -f "$file" ] || {
		echo "instr.sh: no scene '$scene'" >&2
		exit 2
	}
	echo "$file" >>"$work/list"
done
[ -f build/demo32.map ] || rm -f build/demo32
make -s -j2 build/demo32 build/cost
# What is counted stays the same when the program is built anew meanwhile.
cp build/demo32 build/demo32.map "$work"
objdump -d -w "$work/demo32" >"$work/demo32.asm"

xargs -P 2 -I FILE sh tools/count.sh "$work" "$functions" FILE 5 $((frames + 5)) /G /R:35 "/S:$spacing" <"$work/list"

# The worst first: by how far it is above its bar.
while read -r file; do
	name=$(basename "$file" .FB)
	awk -v name="$name" '
		FILENAME ~ /bars/ { if ($1 == name || ($1 == "other" && !bar)) { bar = $2; aim = $3 } next }
		$1 == "all" { all = $3 / 1e6; clocks = $4 / 1e6 }
		$1 == "room" { room[$2] = $3 / 1e6 }
		END {
			# What has no column of its own: the machine, the C library, a kernel without a twin.
			rest = all
			line = ""
			n = split("math model surface picture app", names, " ")
			for (i = 1; i <= n; ++i) { rest -= room[names[i]]; line = line sprintf(" %8.3f", room[names[i]]) }
			printf "%012.6f %-8s %8.3f %6.2f%s %6s %s %8.3f %8.2f\n", all / bar, name, all, bar, (all > bar) ? "!" : " ",
				(aim > 0) ? sprintf("%.2f", aim) : "-", line, rest, clocks
		}' tools/bars.txt "$work/$name.cost"
done <"$work/list" | sort -r | sed 's/^[^ ]* //' >"$work/table"
echo "Millions of instructions a frame ($frames frames, 35 a second, spacing $spacing); ! above its bar."
echo "clocks: millions a frame on a 486, an estimate (tools/clk486.h); 6.6 are ten frames a second at 66 MHz."
echo
echo "scene         all    bar     aim      math    model  surface  picture      app     rest   clocks"
cat "$work/table"
while read -r name rest; do
	[ $sources = yes ] || [ "$functions" -gt 0 ] || break
	echo
	echo "$name"
	[ $sources = no ] || awk '$1 == "source" && $3 > 0 { printf "  %10d %10d  %s\n", $3, $4, $2 }' "$work/$name.cost"
	awk '$1 == "function" { printf "  %10d %10d  %s\n", $3, $4, $2 }' "$work/$name.cost"
done <"$work/table"
