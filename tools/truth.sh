#!/bin/sh
# Judges one scene: plays it in colour, ten frames a second and seventy, holds the frames against the true surface, and
# prints a row of all figures for each spacing. A figure beyond its bar bears a '!'. build/worst/NAME-SPACING then has the
# two worst frames: ours, the true one, the difference (build/truth --help tells its colours).
#
#   sh tools/truth.sh SCENE [SPACING] [FRAMES]
#
#   SCENE     a scene by name (WALK, chain: tools/scenes, tests/scenes/*), a scene file, a number (that random scene of
#             build/mkscene; 7eye: seen by an eye that goes about it), or MINUTE (the minute of the four spheres)
#   SPACING   2, 1 or both (both)
#   FRAMES    how many are judged at each of the two rates, spread over up to 24 s and 3 s (24; at most 240)
#
# DEMO names another program, SWITCHES gives it more switches (/G: brightness of 64 steps, no colours). LIMITS names a
# list of limits beyond the bars (build/truth --help), LIST a file to append the figures to. QUIET leaves out the head and
# the pictures. Ends with 1 when a bar is broken, with 2 when a run failed.
set -u
cd "$(dirname "$0")/.." || exit 2
scene=${1:-} spacing=${2:-both} frames=${3:-24}
usage() {
	echo "truth.sh: $1 (sh tools/truth.sh SCENE [2|1|both] [FRAMES])" >&2
	exit 2
}
case $scene in
'') usage "no scene named" ;;
-h | --help) sed -n '2,/^set/s/^# \{0,1\}//p' tools/truth.sh; exit 0 ;;
esac
case $spacing in
2 | 1 | both) ;;
*) usage "'$spacing': expected a spacing of 2, 1 or both" ;;
esac
case $frames in
*[!0-9]* | '' | 0* | ????*) usage "'$frames': expected 1 to 240 frames" ;;
esac
[ "$frames" -le 240 ] || usage "'$frames': expected 1 to 240 frames"
[ -n "${QUIET:-}" ] || make -s build/truth build/mkscene build/ppm2png || exit 2
[ -n "${DEMO:-}${QUIET:-}" ] || make -s build/demo || exit 2
demo=${DEMO:-build/demo}
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbtruth.XXXXXX") || exit 2
trap 'rm -rf "$dir"' EXIT
trap 'exit 130' HUP INT TERM

# The scene's file and what the table calls it.
minute=
upper=$(echo "$scene" | tr '[:lower:]' '[:upper:]')
if [ "$upper" = MINUTE ]; then
	name=MINUTE file= minute=600
elif [ -f "$scene" ]; then
	name=$(basename "$scene" .FB) file=$scene
elif [ -z "$(echo "${scene%eye}" | tr -d 0-9)" ]; then
	name=RANDOM-$scene file=$dir/R$scene.FB
	# A number and `eye`: seen by an eye that goes about it.
	# shellcheck disable=SC2086
	build/mkscene ${scene%eye} ${scene#"${scene%eye}"} >"$file" || exit 2
else
	name=$upper file=
	for there in "tools/scenes/$upper.FB" tests/scenes/*/"$upper.FB"; do
		[ ! -f "$there" ] || file=$there
	done
	[ -n "$file" ] || usage "'$scene': no such scene"
fi

# Frames to play: more than those to be judged, so that they are spread over the motion.
least() { [ "$1" -lt "$2" ] && echo "$1" || echo "$2"; }
slow=$(least $((frames * 10)) ${minute:-240})
quick=$(least $((frames * 4)) 210)
every=$(((slow + frames - 1) / frames))
pairs=$(((2 * quick + frames - 1) / frames))
[ $pairs -ge 2 ] || pairs=2

# play DIR SWITCHES...: the program's frames into DIR; what it says when it fails.
play() {
	to=$1
	shift
	# SWITCHES are words of their own.
	# shellcheck disable=SC2086
	"$demo" ${file:+"/M:$file"} "/D:$to" ${SWITCHES:-} "$@" >"$to.out" 2>&1 && return
	printf '%-13s %s failed: %s\n' "$name" "$one" "$(tail -n 1 "$to.out")"
	return 2
}

# prepare SPACING: plays the frames that are judged. The quick ones are judged in pairs, for flicker.
prepare() {
	one=$1
	play "$dir/slow$1" "/S:$1" "/N:$slow" || return 2
	play "$dir/quick$1" "/S:$1" "/N:$quick" /R:70 || return 2
	mkdir "$dir/part$1" "$dir/sheets$1"
	for number in $(seq 0 $every $((slow - 1))); do
		mv "$dir/slow$1/$(printf F%07d "$number")".* "$dir/part$1"
	done
	mkdir "$dir/pairs$1"
	for number in $(seq 0 $pairs $((quick - 2))); do
		mv "$dir/quick$1/$(printf F%07d "$number")".* "$dir/quick$1/$(printf F%07d $((number + 1)))".* "$dir/pairs$1"
	done
	rm -rf "$dir/slow$1" "$dir/quick$1"
}

# row SPACING: a row of the table, or what prepare() has said. With `truths`, true pictures are made once for both spacings.
row() {
	[ ! -s "$dir/said$1" ] || { cat "$dir/said$1"; return 2; }
	sheets=$dir/sheets$1
	[ -z "${QUIET:-}" ] || sheets=
	build/truth --threads 2 --bars "spacing$1" --row "$name" --worst 2 ${sheets:+--out "$sheets"} \
		${LIMITS:+--limits "$LIMITS"} ${LIST:+--list "$LIST"} ${truths:+--truths "$truths"} "$dir/part$1" "$dir/pairs$1" 2>&1
}

[ -n "${QUIET:-}" ] || build/truth --head
truths=
if [ "$spacing" = both ]; then
	# A true picture takes 4 MB: those of very many frames are made twice instead.
	if [ "$frames" -le 40 ]; then
		truths=$dir/truths
		mkdir "$truths"
	fi
	prepare 1 >"$dir/said1" &
	prepare 2 >"$dir/said2"
	wait $!
	row 2
	status=$?
	row 1
	status1=$?
	[ $status -ge $status1 ] || status=$status1
else
	prepare "$spacing" >"$dir/said$spacing"
	row "$spacing"
	status=$?
fi
if [ -z "${QUIET:-}" ]; then
	for one in 2 1; do
		[ -d "$dir/sheets$one" ] || continue
		rm -rf "build/worst/$name-$one"
		mkdir -p "build/worst/$name-$one"
		for sheet in "$dir/sheets$one"/*.PPM; do
			[ ! -f "$sheet" ] || build/ppm2png "$sheet" "build/worst/$name-$one/$(basename "$sheet" .PPM).png"
		done
	done
fi
exit $status
