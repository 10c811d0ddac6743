#!/bin/sh
# Puts measured figures into the pages: what stands in a README.md between "<!-- measured: NAME -->" and "<!-- end -->" is
# made anew by measuring, so that no figure is typed by hand.
#
#   sh tools/readme.sh [NAME...]    stats truth hurt bench pictures; default: all but pictures (ten minutes)
#
#   stats     DEMO.EXE's statistics of 600 frames in DOSBox, by default and with /P
#   truth     the minute of the four spheres held against the true surface
#   hurt      the same of scenes made to hurt, and of random ones
#   bench     the benchmark, over the whole minute; and its frames a second once more, for the first page (speed)
#   pictures  all pictures (tools/picture.sh)
set -eu
cd "$(dirname "$0")/.." || exit 1
[ $# -gt 0 ] || set -- stats truth hurt bench
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbreadme.XXXXXX")
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM

put() { # put NAME FILE: the file becomes the contents of the block, in the page that has it
	page=$(find . -path ./build -prune -o -name README.md -exec grep -l "^<!-- measured: $1 -->\$" {} +) || :
	[ -f "$page" ] || {
		echo "readme.sh: one README.md should have a place for $1; there are: ${page:-none}" >&2
		return 1
	}
	awk -v name="$1" -v file="$2" '
		$0 == "<!-- measured: " name " -->" {
			print
			while ((getline line < file) > 0) print line
			inside = 1
		}
		$0 == "<!-- end -->" { inside = 0 }
		!inside { print }' "$page" >"$dir/README.md"
	cp "$dir/README.md" "$page"
}
value() { # value NAME FILE
	tr -d '\r' <"$2" | sed -n "s/^$1: //p"
}

stats() {
	make -s build/DEMO.EXE
	mkdir "$dir/c" && cp build/DEMO.EXE "$dir/c"
	sh tools/dosbox.sh -c 177000 -t 600 -d "$dir/c" -- 'DEMO /N:600 > OWN.TXT' 'DEMO /P /N:600 > PRINTED.TXT'
	grep -q '^fps' "$dir/c/OWN.TXT" && grep -q '^fps' "$dir/c/PRINTED.TXT" || {
		echo "readme.sh: DEMO.EXE gives no statistics" >&2
		return 1
	}
	{
		echo '| | default | `/P` | the report |'
		echo '|---|---|---|---|'
		tr -d '\r' <"$dir/c/OWN.TXT" | grep -v -e '^seconds' -e '^fps' | while IFS= read -r line; do
			name=${line%%: *}
			case $name in
			seeds) report="2,496" ;;
			"oversampled seeds") report="2,480" ;;
			"updated per frame") report="2,314 (93% of seeds)" ;;
			"drawn per frame") report="1,568 (63% of seeds)" ;;
			"iterations per update") report="5" ;;
			"normals per frame") report="894 (57% of drawn)" ;;
			"field evaluations per frame") report="11,570" ;;
			*) report= ;;
			esac
			echo "| $name | ${line#*: } | $(value "$name" "$dir/c/PRINTED.TXT") | $report |"
		done
		p=$dir/c/PRINTED.TXT
		awk -v u="$(value 'updated per frame' "$p")" -v d="$(value 'drawn per frame' "$p")" \
			-v n="$(value 'normals per frame' "$p")" -v s="$(value seeds "$p")" 'BEGIN {
			printf "\nAs shares, `/P` updates %.0f%% of the seeds, draws %.0f%%, and computes the normals of %.0f%% of those drawn.\n",
				100 * u / s, 100 * d / s, 100 * n / d
		}'
	} >"$dir/stats"
	put stats "$dir/stats"
}

truth() {
	make -s build/demo build/truth
	for spacing in 2 1; do
		build/demo /S:$spacing /N:600 "/D:$dir/f" >"$dir/said"
		build/truth "$dir/f" >"$dir/truth$spacing"
		rm -rf "$dir/f"
		build/demo /S:$spacing /R:70 /N:700 "/D:$dir/f" >"$dir/said"
		build/truth "$dir/f" >"$dir/flicker$spacing"
		rm -rf "$dir/f"
	done
	{
		echo '| | spacing 2 | aim | spacing 1 | aim |'
		echo '|---|---|---|---|---|'
		while IFS='|' read -r name text aim2 aim1; do
			file=truth
			[ "${name%%,*}" != flicker ] || file=flicker
			echo "| $text | $(value "$name" "$dir/${file}2") | $aim2 | $(value "$name" "$dir/${file}1") | $aim1 |"
		done <<-END
		holes|holes: pixels left empty inside the surface|0|0
		see-through, percent of interior pixels|see-through, % of pixels inside|0.05|0.02
		outside, percent of drawn pixels|outside, % of drawn pixels|1|0.5
		depth RMS, units|depth error, RMS, units|1.0|0.6
		brightness RMS, ramp steps|brightness error, RMS, of 64 steps|2.5|1.5
		flicker, percent of drawn pixels|flicker, % of drawn pixels|0.1|0.05
		colour, percent of drawn pixels|another object's colour more than a pixel away from it, % of drawn pixels|0.05|0.02
		border, drawn over true length|borders between colours, drawn over true length|1.3|1.2
		END
	} >"$dir/truth"
	put truth "$dir/truth"
}

hurt() {
	{
		echo '```'
		# It ends with 1 when a bar is broken, which the table shows.
		sh tests/scenes/truth.sh some || [ $? -eq 1 ]
		echo '```'
	} >"$dir/hurt"
	put hurt "$dir/hurt"
}

bench() {
	make -s bench FULL=1 >/dev/null
	{
		echo '```'
		sed '1,2d' build/bench.txt
		echo '```'
	} >"$dir/bench"
	put bench "$dir/bench"
	# The benchmark keeps its figures one a line: table, row, column, value.
	cat build/figures.csv build/bench.csv 2>/dev/null | awk -F, '$1 == "fps" { value[$2, $3] = $4; if (!seen[$2]++) order[++n] = $2 }
		END {
			print "Frames a second of the four spheres in one colour, in DOSBox, which counts instructions, every one alike:\n"
			print "| machine | instructions a millisecond | the report, 1998 | its methods (`/P`) | ours |"
			print "|---|---|---|---|---|"
			for (i = 1; i <= n; ++i) {
				c = order[i]
				printf "| %s | %d | %s | %.2f | %.1f |\n", value[c, "class"], c,
					(c, "report") in value ? value[c, "report"] : "", value[c, "printed"], value[c, "ours"]
			}
		}' >"$dir/speed"
	put speed "$dir/speed"
}

pictures() {
	sh tools/picture.sh
}

for block in "$@"; do
	case $block in
	stats | truth | hurt | bench | pictures) $block ;;
	*)
		echo "readme.sh: stats, truth, hurt, bench or pictures is expected, not $block" >&2
		exit 2
		;;
	esac
done
