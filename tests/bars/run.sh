#!/bin/sh
# The picture's bars: every figure of every scene of `tests/scenes/truth.sh some` holds its bar, or the limit that
# limits.txt grants it until it does. A line there is "scene spacing figure limit". The list becomes shorter and its limits lower;
# where one has to rise for a picture that is better on the whole, the commit says so. Lines that are no longer needed are named.
#
#   sh tests/bars/run.sh          the last line is "N passed, N failed"
#   sh tests/bars/regen.sh        writes limits.txt anew from the figures of the last run
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/demo build/truth build/mkscene build/ppm2png
limits=tests/bars/limits.txt
list=build/log/figures.txt
mkdir -p build/log
rm -f $list
LIMITS=$limits LIST=$list sh tests/scenes/truth.sh some >"$dir/table" 2>&1
sed 's/^/# /' "$dir/table"

# A figure is a check; so is that each scene was played and judged.
marked=$(grep -o '!!' "$dir/table" | wc -l)
grep -e '!!' -e 'failed:' -e 'truth' "$dir/table" | sed 's/^/FAIL /'
unplayed=$(grep -c -e 'failed:' -e 'truth' "$dir/table")
passed=$((passed + $(wc -l <$list) - marked))
failed=$((failed + marked + unplayed))
scenes=$(($(ls tools/scenes/*.FB tests/scenes/hurt/*.FB | wc -l) + 4))
ok "each scene has all figures but the border, at both spacings" awk -v rows=$((2 * scenes)) '
	$3 != "border" { ++n[$1 " " $2] }
	END {
		for (key in n) { ++found; if (n[key] != 7) { print key ": " n[key] " figures of 7"; bad = 1 } }
		if (found != rows) { print found + 0 " rows of " rows; bad = 1 }
		exit bad
	}' $list

# The yardstick reads the program's palette: the colours of nearly all pixels tell their object. Where many colours share the
# entries fewer do, and where objects keep apart hardly one of them is wrong.
told() { # told FRAMES PERCENT
	build/truth --worst 0 "$1" >"$dir/told" || return
	awk -F': ' -v least="$2" '
		/^drawn pixels/ { drawn = $2 }
		/^pixels whose object/ { told = $2 }
		/^pixels of another/
		END { print told " of " drawn " told"; exit !(drawn > 1000 && 100 * told >= least * drawn) }' "$dir/told"
}
build/demo /N:1 "/D:$dir/four" >"$dir/out"
ok "colours of the four spheres" told "$dir/four" 97
for i in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19; do
	echo "sphere s$i size 9 at $(((i % 5 - 2) * 20)) $((i / 5 * 18 - 27)) 0" \
		"colour $((60 + i * 10)) $((i * 67 % 200 + 40)) $((i * 131 % 200 + 30))"
done >"$dir/TWENTY.FB"
build/demo "/M:$dir/TWENTY.FB" /N:1 "/D:$dir/twenty" >"$dir/out"
ok "colours of twenty" told "$dir/twenty" 30
ok "few of them wrong" awk -F': ' '
	/^pixels whose object/ { told = $2 }
	/^pixels of another/ { seen = 1; wrong = $2 }
	END { exit !(seen && 50 * wrong < told) }' "$dir/told"
ok "each has its colour" test "$(sed -n 's/^ramp [0-9]* //p' "$dir/twenty/F0000000.TXT" | sort -u | wc -l)" -eq 20
ok "a scene that is not there" sh -c '! sh tools/truth.sh NOSUCH 2>/dev/null'

# Limits of figures that hold their bar, or that nothing has.
build/truth --head | awk '
	NR == 1 { for (i = 2; i <= NF; ++i) name[i] = $i }
	NR == 2 { for (i = 4; i <= NF; ++i) print "2", name[i - 2], $i }
	NR == 3 { for (i = 4; i <= NF; ++i) print "1", name[i - 2], $i }' >"$dir/bars"
ok "the bars can be read" test "$(wc -l <"$dir/bars")" -eq 16
awk -v bars="$dir/bars" -v limits="$limits" '
	FILENAME == bars { bar[$1 " " $2] = $3; next }
	FILENAME == limits { sub(/#.*/, ""); if (NF) limit[$1 " " $2 " " $3] = $4; next }
	{ figure[$1 " " $2 " " $3] = $4; short[$1 " " $2 " " $3] = $2 " " $3 }
	END {
		for (key in limit)
			if (!(key in figure)) print "# limit of no figure: " key
			else if (figure[key] + 0 <= bar[short[key]]) print "# limit no longer needed: " key
	}' "$dir/bars" $limits $list | sort
summary
