#!/bin/sh
# The zip that `make release` leaves: the same bytes from another copy of the tree; names, line ends and widths as DOS
# users have them; nothing forgotten; and it works: unpacked into an empty folder, mounted in DOSBox, every scene plays
# from it and shows the frames of the host's program.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh
tree=$(pwd)
for tool in zip unzip dosbox; do
	command -v $tool >/dev/null || {
		echo "FAIL $tool is not installed (sh tools/setup.sh test)"
		echo "0 passed, 1 failed"
		exit 1
	}
done
build release
zip=$tree/build/release/FBLOBS.ZIP

# ---- The same bytes again

# A copy elsewhere, with other rights and times, built from nothing.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || date -d 1998-04-06 +%s)
export SOURCE_DATE_EPOCH
again() {
	mkdir "$dir/copy" &&
		{ git ls-files --cached --others --exclude-standard 2>/dev/null || find . -path ./build -prune -o -type f -print; } |
			tar -cf - -T - | tar -xf - -C "$dir/copy" &&
		(cd "$dir/copy" && umask 077 && TZ=Asia/Tokyo make -s -j2 release) && cmp "$zip" "$dir/copy/build/release/FBLOBS.ZIP"
}
ok 'another copy of the tree gives the same bytes' again
rm -rf "$dir/copy"

# ---- What is in it

# Everything from here on is about the files as they come out.
c=$dir/c
mkdir "$c"
ok 'unpacks' unzip -q "$zip" -d "$c"
(cd "$c" && ls) >"$dir/names"
ok 'names that DOS knows' sh -c "! grep -v -x -E '[A-Z0-9_]{1,8}\.[A-Z]{2,3}' '$dir/names'"
for file in DEMO.EXE BENCH.BAT DEMO.BAT README.TXT FILE_ID.DIZ LICENSE.TXT $(cd tools/scenes && ls ./*.FB); do
	ok "has $file" test -s "$c/$file"
done
ok 'DEMO.EXE is the one built' cmp build/DEMO.EXE "$c/DEMO.EXE"
ok 'nothing else' test "$(wc -l <"$dir/names")" -eq $((6 + $(ls tools/scenes/*.FB | wc -l)))
for file in $(grep -v EXE "$dir/names"); do
	ok "$file: every line ends as on DOS" test "$(grep -c "$(printf '\r')\$" "$c/$file")" -eq "$(wc -l <"$c/$file")"
	ok "$file: plain ASCII" sh -c "! LC_ALL=C grep -n '[^ -~$(printf '\r')]' '$c/$file'"
	case $file in
	FILE_ID.DIZ) wide=45 ;;
	README.TXT) wide=78 ;;
	*) wide=79 ;;
	esac
	tr -d '\r' <"$c/$file" >"$dir/lines"
	# Scenes are not for reading at a prompt.
	[ "${file##*.}" = FB ] || ok "$file: at most $wide columns" \
		awk -v wide=$wide 'length($0) > wide { print; bad = 1 } END { exit bad }' "$dir/lines"
done
ok 'FILE_ID.DIZ: at most ten lines' test "$(wc -l <"$c/FILE_ID.DIZ")" -le 10
for scene in tools/scenes/*.FB; do
	scene=$(basename "$scene")
	ok "README.TXT tells of $scene" grep -q "^  $scene " "$c/README.TXT"
	ok "DEMO.BAT shows $scene" grep -q "/M:$scene " "$c/DEMO.BAT"
done
build/demo '/?' | grep -o '^  /[^ ]*' | while read -r switch; do
	grep -q -F "  $switch" "$c/README.TXT" || echo "$switch"
done >"$dir/lacking"
ok 'README.TXT tells of every switch' test ! -s "$dir/lacking"

# ---- The guide to scenes: each step of it is a scene
mkdir "$dir/steps"
awk -v to="$dir/steps/" '/^```scene/ { ++n; inside = 1; next } /^```$/ { inside = 0 } inside { print > (to n ".FB") }' \
	tools/scenes/README.md
ok 'the guide has its steps' test "$(ls "$dir/steps" | wc -l)" -ge 4
for step in "$dir"/steps/*.FB; do
	ok "step $(basename "$step" .FB) plays" sh -c "build/demo '/M:$step' /N:3 | grep -q '^frames: 3'"
done

# ---- It plays

# records FILE: how many runs /O left there, below the line of names.
records() {
	sed 1d "$1" | wc -l
}

# The scene that README.TXT prints, to be typed off.
tr -d '\r' <"$c/README.TXT" | sed -n '/^another name/,/^A scene that/s/^  \([a-z]\)/\1/p' >"$c/TYPED.FB"
ok 'README.TXT has a scene to type' grep -q '^blend' "$c/TYPED.FB"
tools/dosbox.sh -t 300 -d "$c" -- 'CALL DEMO.BAT /N:4 /R:1 /O:ALL.CSV' 'if errorlevel 1 echo x > BAD.TXT' \
	'DEMO /M:TYPED.FB /N:4 > TYPED.TXT' 'DEMO /N:4 > OUT.TXT' 'CALL BENCH.BAT B.CSV 1 > BENCH.TXT' >"$dir/said" 2>&1
ok 'DEMO plays' grep -q '^frames: 4' "$c/OUT.TXT"
ok 'the typed scene plays' grep -q '^frames: 4' "$c/TYPED.TXT"
ok 'DEMO.BAT played to its end' test ! -s "$c/BAD.TXT"
ok 'DEMO.BAT played every scene' test "$(records "$c/ALL.CSV")" -eq "$(ls tools/scenes/*.FB | wc -l)"
ok 'BENCH.BAT left its figures' test "$(records "$c/B.CSV")" -eq "$(grep -v '^REM' tools/bench.bat | grep -c 'DEMO /')"

# Every scene by itself: the frames of the host's program, byte for byte.
set --
for scene in $(cd "$c" && ls ./*.FB); do
	scene=$(basename "$scene" .FB)
	set -- "$@" "DEMO /M:$scene.FB /N:3 /R:1 /D:$scene > $scene.OUT"
done
tools/dosbox.sh -t 300 -d "$c" -- "$@" >"$dir/said" 2>&1
for scene in $(cd "$c" && ls ./*.FB); do
	scene=$(basename "$scene" .FB)
	build/demo "/M:$c/$scene.FB" /N:3 /R:1 "/D:$dir/$scene" >"$dir/out"
	ok "$scene: three frames" test "$(ls "$c/$scene" 2>/dev/null | grep -c PPM)" -eq 3
	ok "$scene: the host's frames" diff -rq "$c/$scene" "$dir/$scene"
done
summary
