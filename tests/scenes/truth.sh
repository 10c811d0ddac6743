#!/bin/sh
# Holds the program's frames against the true surface: the minute of the default animation, the scenes made to hurt,
# and random scenes, at two spacings, ten frames a second, and a while at seventy for flicker. Prints a table, one row a
# run, with the bars above it; a figure beyond its bar bears a '!'. The depth marked '*' leaves out pixels beside a jump of
# the true depth and has no bar.
#
#   sh tests/scenes/truth.sh           some of the frames (a minute's work)
#   sh tests/scenes/truth.sh full      all of them, and more random scenes
#   sh tests/scenes/truth.sh quick     a few, for a look
#
# DEMO names another program, SCENES other scenes. Ends with 1 when a bar is broken or a run failed.
set -u
cd "$(dirname "$0")/../.." || exit 2
demo=${DEMO:-build/demo}
mode=${1:-some}
case $mode in
full)  every=1 hurt_every=1 minute=600 hurt=120 flick=140 seeds="1 2 3 4 5 6 7 8 9 10 11 12" ;;
some)  every=10 hurt_every=4 minute=600 hurt=60 flick=35 seeds="1 2 3" ;;
quick) every=60 hurt_every=12 minute=600 hurt=60 flick=0 seeds="1" ;;
*) echo "truth.sh: '$mode': expected full, some or quick" >&2; exit 2 ;;
esac
make -s build/truth build/mkscene || exit 2
[ -n "${DEMO:-}" ] || make -s build/demo || exit 2
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbtruth.XXXXXX") || exit 2
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
broken=0

printf '%-22s %6s %6s %8s %8s %8s %8s %8s %8s\n' run frames holes see-thr% outside% depth depth* bright flicker%
printf '%-22s %6s %6s %8s %8s %8s %8s %8s %8s\n' 'bars, spacing 2' '' 0 0.1 2 1.0 '' 5 0.1
printf '%-22s %6s %6s %8s %8s %8s %8s %8s %8s\n' 'bars, spacing 1' '' 0 0.02 1 0.6 '' 3 0.1

# row NAME SPACING EVERY SWITCHES...: plays, judges, prints a row.
row() {
	name=$1 spacing=$2 step=$3
	shift 3
	rm -rf "$dir/frames"
	if ! nice "$demo" /G "/S:$spacing" "/D:$dir/frames" "$@" >"$dir/out" 2>&1; then
		printf '%-22s failed: %s\n' "$name" "$(tail -n 1 "$dir/out")"
		broken=1
		return
	fi
	nice build/truth --every "$step" "$dir/frames" >"$dir/out" 2>&1
	if ! grep -q '^holes:' "$dir/out"; then
		printf '%-22s not judged: %s\n' "$name" "$(tail -n 1 "$dir/out")"
		broken=1
		return
	fi
	awk -F': ' -v name="$name" -v spacing="$spacing" '
		{ v[$1] = $2 }
		function cell(key, bar, form,    s) {
			if (v[key] !~ /^[0-9.]+$/) return sprintf("%8s", "-")
			s = sprintf(form, v[key])
			if (v[key] + 0 > bar) { s = s "!"; bad = 1 }
			return sprintf("%8s", s)
		}
		END {
			one = spacing == 1
			printf "%-22s %6s %s %s %s %s %s %s %s\n", name, v["frames"],
				substr(cell("holes", 0, "%d"), 3),
				cell("see-through, percent of interior pixels", one ? 0.02 : 0.1, "%.3f"),
				cell("outside, percent of drawn pixels", one ? 1 : 2, "%.2f"),
				cell("depth RMS, units", one ? 0.6 : 1.0, "%.2f"),
				cell("depth RMS away from jumps, units", 9999, "%.2f"),
				cell("brightness RMS, ramp steps", one ? 3 : 5, "%.2f"),
				cell("flicker, percent of drawn pixels", 0.1, "%.3f")
			exit bad
		}' "$dir/out" || broken=1
}

for spacing in 2 1; do
	if [ -z "${SCENES:-}" ]; then
		row "minute /S:$spacing" $spacing $every "/N:$minute"
		[ "$flick" -eq 0 ] || row "minute /S:$spacing /R:70" $spacing 1 "/N:$flick" /R:70
	fi
	for scene in ${SCENES:-tests/scenes/hurt/*.FB}; do
		called=$(basename "$scene" .FB)
		row "$called /S:$spacing" $spacing $hurt_every "/M:$scene" "/N:$hurt"
		[ "$flick" -eq 0 ] || row "$called /S:$spacing /R:70" $spacing 1 "/M:$scene" "/N:$flick" /R:70
	done
	[ -z "${SCENES:-}" ] || continue
	for seed in $seeds; do
		build/mkscene "$seed" >"$dir/RANDOM.FB" || exit 2
		row "random $seed /S:$spacing" $spacing $hurt_every "/M:$dir/RANDOM.FB" "/N:$hurt"
		[ "$flick" -eq 0 ] || row "random $seed /S:$spacing /R:70" $spacing 1 "/M:$dir/RANDOM.FB" "/N:$flick" /R:70
	done
done
exit $broken
