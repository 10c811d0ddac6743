#!/bin/sh
# Tests of the primitives: seeds, cores, operations and graph; and small scenes with each of them, alone and turned,
# blending with a ball, with one of its kind and with all kinds, held against the true surface. Run from the top of the
# tree. Scenes whose name ends in _dented or _digs have a ball that digs into each, or each dig into a ball.
#
#   sh tests/prims/run.sh         all of it; the last line is "N passed, N failed"
#   build/primtst even            seeds and evenness of each primitive, as a table
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/primtst build/truth
build/primtst >"$dir/out" 2>&1
count "$dir/out"

# What the yardstick says of a scene, against the bars of the picture: none or, where objects blend, at most two pixels
# through which nothing shows, little that shows through, little that sticks out, depths that are right where the surface
# has no jumps. Scenes whose name ends in _1 have seeds one unit apart, the others two.
fair() {
	build/truth --worst 0 "$dir/frames/$1" | awk -F': ' -v scene="$1" -v holes="$2" -v known="${3:-}" -v shows="${4:-}" '
		{ value[$1] = $2 }
		END {
			fine = scene ~ /_1$/
			through = value["see-through, percent of interior pixels"]
			outside = value["outside, percent of drawn pixels"]
			depth = value["depth RMS away from jumps, units"]
			printf "%-16s pixels %6d holes %d see-through %.4f%% outside %.3f%% depth %.3f brightness %.2f\n", scene,
				value["interior pixels"], value["holes"], through, outside, depth, value["brightness RMS, ramp steps"]
			exit !(value["interior pixels"] > 5000 && value["holes"] <= holes && through <= (shows ? shows : fine ? 0.02 : 0.1) &&
				outside <= (fine ? 1 : 2) && depth <= (known ? known : fine ? 0.6 : 1))
		}' >"$dir/fair" 2>&1
	status=$?
	sed 's/^/# /' "$dir/fair"
	return $status
}
mkdir "$dir/frames"
ok "scenes drawn" build/primtst draw "$dir/frames"
for scene in "$dir"/frames/*; do
	scene=$(basename "$scene")
	# A cylinder that runs past the viewer at 60 units is known to fall short: single pixels of its neck with a ball stay
	# open, and scales there are too flat.
	known='' through=''
	case $scene in
	*_turned*) holes=0 ;;
	torus_digs*) holes=2 through=0.06 ;; # what a ring leaves standing in its middle lies steep to all paths
	near) holes=6 known=1.35 ;;
	near_1) holes=30 known=0.9 ;; # the tip of a neck: gaps that lead outside are not closed over it any more
	cylinder_dented) holes=3 ;; # at the rim of a hollow
	*) holes=2 ;;
	esac
	if fair "$scene" $holes "$known" "$through"; then
		passed=$((passed + 1))
	else
		echo "FAIL $scene against the true surface"
		failed=$((failed + 1))
	fi
done
summary
