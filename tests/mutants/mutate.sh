#!/bin/sh
# Breaks the program on purpose, one fault at a time, in a copy of the tree, and sees that a test fails: a test that cannot
# fail is no test. Not part of `make test`; run it when tests or the code below them changed much.
#
#   tests/mutants/mutate.sh [TEXT]       faults whose line in faults.txt contains TEXT; default: all
#
# Each line of faults.txt is FILE, a sed expression that makes the fault, and what it is, with " :: " between.
# Prints which suite noticed each fault and closes with "N passed, N failed": failed are those that nothing noticed,
# those whose expression changes nothing any more, and those that do not compile, which try no test (but a static_assert is one).
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

copy=$dir/tree
mkdir "$copy"
tar cf - --exclude=./build --exclude=./.git . | (cd "$copy" && tar xf -)
grep -v '^#' tests/mutants/faults.txt | grep -F -- "${1:-}" >"$dir/faults"
UNIT_KINDS=fixed
# The script of hands alone, without sanitizers and DOSBox.
DEMO=build/demo
export UNIT_KINDS DEMO

cd "$copy" || exit 1
# Those that are soon done first.
suites="twins unit cli edit golden prims frames"
for suite in $suites; do
	sh "tests/$suite/run.sh" >"$dir/log" 2>&1 || {
		grep FAIL "$dir/log"
		echo "FAIL $suite fails before anything is broken"
		failed=1
		summary
		exit 1
	}
done

while read -r line; do
	file=${line%% :: *}
	rest=${line#* :: }
	change=${rest%% :: *}
	what=${rest#* :: }
	cp "$file" "$dir/whole"
	sed "$change" "$dir/whole" >"$file"
	noticed=
	if cmp -s "$file" "$dir/whole"; then
		echo "FAIL $file: $what: nothing to change"
		failed=$((failed + 1))
		continue
	fi
	for suite in $suites; do
		if ! timeout 600 sh "tests/$suite/run.sh" >"$dir/log" 2>&1; then
			noticed=$suite
			break
		fi
	done
	if [ -n "$noticed" ] && grep -q '^FAIL building' "$dir/log" && ! grep -q 'static assertion failed' "$dir/log"; then
		echo "FAIL $file: $what: does not compile: $(grep -m 1 'error: ' "$dir/log" | cut -c 1-100)"
		failed=$((failed + 1))
	elif [ -n "$noticed" ]; then
		echo "ok $file: $what: $noticed: $(grep -m 1 -e FAIL -e 'error: ' "$dir/log" | cut -c 1-100)"
		passed=$((passed + 1))
	else
		echo "FAIL $file: $what: not noticed"
		failed=$((failed + 1))
	fi
	cp "$dir/whole" "$file"
done <"$dir/faults"
summary
