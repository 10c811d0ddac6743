#!/bin/sh
# The test command of the README: installs what lacks, then tests everything.
cd "$(dirname "$0")/.." || exit 1
sh tools/setup.sh test || exit 1
exec make --no-print-directory test
