#!/bin/sh
# The test command of the README: installs what is missing, then tests everything.
cd "$(dirname "$0")/.." || exit 1
sh tools/setup.sh test || exit 1
# A browser is not worth a failure: where none can be had in five minutes, the suite `web` says what it left out.
timeout 300 sh tools/setup.sh web || echo "test.sh: no browser; the page that plays is tested as files only"
exec make --no-print-directory test
