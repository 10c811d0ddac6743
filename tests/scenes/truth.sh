#!/bin/sh
# Compares the program's frames with the true surface: one minute of the four spheres, the shipped scenes, the difficult scenes
# of tests/scenes/hurt, and random scenes, in colour, at two spacings, at ten and at seventy frames a second. It prints the bars
# and a table with one row for each scene and spacing, where a figure beyond its bar is marked '!', and last the count of rows
# beyond a bar.
#
#   sh tests/scenes/truth.sh           some of the frames, 4 random scenes (two minutes)
#   sh tests/scenes/truth.sh full      many of them, 24 random scenes (half an hour)
#   sh tests/scenes/truth.sh quick     a few, 1 random scene, for a look
#
# SCENES names other scenes instead, as for tools/truth.sh; SPACING is 2 or 1 for only one spacing; DEMO, SWITCHES, LIMITS and
# LIST are as described there. The exit status is 1 when a bar is broken or a run failed; with LIMITS, when a figure is beyond
# both its bar and its limit.
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
# The mark of a row that breaks a bar (and its limit).
mark=!
[ -z "${LIMITS:-}" ] || mark=!!

build/truth --head
# judge SCENE FRAMES
judge() {
	said=$(QUIET=1 sh tools/truth.sh "$1" "${SPACING:-both}" "$2" 2>&1)
	status=$?
	[ $status -le 1 ] || said="$said
$1: truth.sh ended with status $status"
	echo "$said"
	beyond=$((beyond + $(echo "$said" | grep -c -e "$mark" -e failed: -e truth)))
	rows=$((rows + $(echo "$said" | wc -l)))
}
if [ -n "${SCENES:-}" ]; then
	for scene in $SCENES; do judge "$scene" $frames; done
else
	judge MINUTE $minute
	for scene in tools/scenes/*.FB tests/scenes/hurt/*.FB; do
		# The four spheres have been judged as MINUTE.
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
