#!/bin/sh
# The play command of the README: installs what is missing, builds, and plays DEMO.EXE in DOSBox. Arguments are settings for
# make (see the Makefile). It says what it does in a line each; what the compiler says is shown when it fails.
cd "$(dirname "$0")/.." || exit 1
sh tools/setup.sh play || exit 1
mkdir -p build || exit 1
echo "Building DEMO.EXE, which takes a minute the first time."
if ! make -j"$(nproc 2>/dev/null || echo 2)" play-parts "$@" >build/run.log 2>&1; then
	cat build/run.log >&2
	echo "run.sh: DEMO.EXE could not be built" >&2
	exit 1
fi
scene=
switches=
for setting in "$@"; do
	case $setting in
	SCENE=*) scene=${setting#SCENE=} ;;
	SWITCHES=*) switches=${setting#SWITCHES=} ;;
	FRAMES=* | CYCLES=*) export "${setting?}" ;;
	esac
done
# shellcheck disable=SC2086  # switches are words
exec sh tools/play.sh "$scene" $switches
