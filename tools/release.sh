#!/bin/sh
# Packs build/release/FBLOBS.ZIP from build/DEMO.EXE and the texts of tools/release, tools/scenes and tools/bench.bat
# (`make release`). What is packed is left in build/release/FBLOBS.
set -eu
cd "$(dirname "$0")/.." || exit 1
command -v zip >/dev/null || {
	echo "release.sh: zip is not installed (sh tools/setup.sh release)" >&2
	exit 1
}
# Zips hold local time, in steps of two seconds.
TZ=UTC
export TZ
time=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || :)}
# Without git: the day of the report.
[ -n "$time" ] || time=$(date -d 1998-04-06 +%s)

to=build/release/FBLOBS
rm -rf build/release
mkdir -p "$to"
dos() { # dos FROM TO: a text with the line ends of DOS
	awk '{ sub(/\r$/, ""); printf "%s\r\n", $0 }' "$1" >"$to/$2"
}
# The program itself says which switches and keys it knows; its first line is its name.
build/demo '/?' | sed 1,2d >build/release/help
sed -e '/^@HELP@$/{' -e 'r build/release/help' -e 'd' -e '}' tools/release/README.TXT >build/release/readme
dos build/release/readme README.TXT
dos tools/release/FILE_ID.DIZ FILE_ID.DIZ
dos tools/release/DEMO.BAT DEMO.BAT
dos tools/bench.bat BENCH.BAT
dos LICENSE LICENSE.TXT
cp build/DEMO.EXE "$to/DEMO.EXE"
for scene in tools/scenes/*.FB; do
	dos "$scene" "$(basename "$scene")"
done
rm build/release/help build/release/readme
chmod 644 "$to"/*
touch -d "@$time" "$to"/*
# In an order that is the same everywhere; -k: as DOS made it, without owners and rights.
(cd "$to" && LC_ALL=C ls | LC_ALL=C sort | zip -q -9 -k -X ../FBLOBS.ZIP -@)
ls -l build/release/FBLOBS.ZIP
