#!/bin/sh
# Holds the program's frames against the true surface: the minute of the four spheres, the shipped scenes, the scenes made
# to hurt and random ones, in colour, at two spacings, ten frames a second and seventy. Prints a table, one row a scene and
# spacing, with the bars above it; a figure beyond its bar bears a '!'. The last line counts the rows beyond a bar.
#
#   sh tests/scenes/truth.sh           some of the frames, 4 random scenes (two minutes)
#   sh tests/scenes/truth.sh full      many of them, 24 random scenes (half an hour)
#   sh tests/scenes/truth.sh quick     a few, 1 random scene, for a look
#
# SCENES names other scenes instead, as tools/truth.sh takes them; SPACING is 2 or 1 for one spacing only; DEMO, SWITCHES,
# LIMITS and LIST are as there. Ends with 1 when a bar is broken or a run failed; with LIMITS, when a figure is beyond both
# its bar and its limit.
set -u
cd "$(dirname "$0")/../.." || exit 2
mode=${1:-some}
case $mode in
full) frames=100 minute=240 seeds=24 ;;
some) frames=10 minute=40 seeds=4 ;;
quick) frames=4 minute=10 seeds=1 ;;
*) echo "truth.sh: '$mode': expected full, some or quick" >&2; exit 2 ;;
esac
make -s build/truth build/mkscene || exit 2
[ -n "${DEMO:-}" ] || make -s build/demo || exit 2
rows=0
beyond=0
# What a row that does not hold bears.
mark=!
[ -z "${LIMITS:-}" ] || mark=!!

build/truth --head
# judge SCENE FRAMES
judge() {
	said=$(QUIET=1 sh tools/truth.sh "$1" "${SPACING:-both}" "$2" 2>&1)
	echo "$said"
	beyond=$((beyond + $(echo "$said" | grep -c -e "$mark" -e failed: -e truth)))
	rows=$((rows + $(echo "$said" | wc -l)))
}
if [ -n "${SCENES:-}" ]; then
	for scene in $SCENES; do judge "$scene" $frames; done
else
	judge MINUTE $minute
	for scene in tools/scenes/*.FB tests/scenes/hurt/*.FB; do
		# The four spheres are the minute's.
		[ "$scene" = tools/scenes/FOUR.FB ] || judge "$scene" $frames
	done
	for seed in $(seq $seeds); do judge "$seed" $frames; done
fi
if [ -n "${LIMITS:-}" ]; then
	echo "$beyond of $rows rows beyond a bar and its limit"
else
	echo "$beyond of $rows rows beyond a bar"
fi
[ $beyond -eq 0 ]
