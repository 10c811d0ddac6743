#!/bin/sh
# The play command of the README: installs what lacks, builds, and plays DEMO.EXE in DOSBox. Arguments are settings for
# make (see the Makefile).
cd "$(dirname "$0")/.." || exit 1
sh tools/setup.sh play || exit 1
exec make --no-print-directory run "$@"
