#!/bin/sh
# Takes the frames that the program makes now as the golden ones. To be run deliberately, after looking at the frames, and
# committed with the reason why the picture changed: within the location tolerance, or because it is nearer to the truth.
set -eu
cd "$(dirname "$0")/../.."
make -s build/demo
sh tests/golden/sums.sh >tests/golden/new.txt
if [ -f tests/golden/sums.txt ]; then
	echo "$(diff tests/golden/sums.txt tests/golden/new.txt | grep -c '^>' || :) of $(wc -l <tests/golden/new.txt) frames changed"
fi
mv tests/golden/new.txt tests/golden/sums.txt
