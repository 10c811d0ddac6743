#!/bin/sh
# Runs every test suite, one after the other, and adds up what they say.
#
#   sh tests/run.sh [SUITE...]      the folders of tests/ with a run.sh; default: all of them
#
# A suite is a script tests/SUITE/run.sh, run from the top of the tree. It builds what it needs, prints a line for each
# failure ("FAIL ..." or "FAILED: ...") and closes with "N passed, N failed". One that ends without that line, or with a
# status that does not go with it, counts as a failure of its own. The last line here is the sum, alone.
# The whole output of each suite is kept in build/log.
set -u
cd "$(dirname "$0")/.." || exit 1

# In this order: what is quick and close to the cause first, the picture as a whole last.
order="unit twins pics truth tree cli san dpmi dos frames golden"
if [ $# -gt 0 ]; then
	suites=$*
else
	suites=
	for suite in $order; do
		[ ! -f "tests/$suite/run.sh" ] || suites="$suites $suite"
	done
	for script in tests/*/run.sh; do
		suite=$(basename "$(dirname "$script")")
		case " $order " in
		*" $suite "*) ;;
		*) suites="$suites $suite" ;;
		esac
	done
fi

mkdir -p build/log
passed=0
failed=0
begun=$(date +%s)
for suite in $suites; do
	log=build/log/$suite.txt
	start=$(date +%s)
	echo "== $suite"
	sh "tests/$suite/run.sh" >"$log" 2>&1
	status=$?
	took=$(($(date +%s) - start))
	last=$(tail -n 1 "$log" | tr -d '\r')
	if expr "$last" : '[0-9][0-9]* passed, [0-9][0-9]* failed$' >/dev/null; then
		# What passed one by one is in the log; failures and figures are shown.
		sed '$d' "$log" | grep -v '^ok ' | grep -v '^make\[' >"$log.short"
		# Failures first of all; then a page of figures.
		grep -v '^#' "$log.short" | head -n 80
		grep '^#' "$log.short" | head -n 40
		[ "$(wc -l <"$log.short")" -le 120 ] || echo "... and more in $log"
		good=${last%% passed*}
		bad=${last##*passed, }
		bad=${bad%% failed*}
		if [ "$bad" -eq 0 ] && [ "$status" -ne 0 ]; then
			echo "FAIL $suite: ended with status $status"
			bad=1
		fi
		if [ "$good" -eq 0 ] && [ "$bad" -eq 0 ]; then
			echo "FAIL $suite: nothing was tested"
			bad=1
		fi
	else
		tail -n 40 "$log"
		echo "FAIL $suite: did not reach its end (status $status)"
		good=0
		bad=1
	fi
	echo "-- $suite: $good passed, $bad failed ($took s)"
	passed=$((passed + good))
	failed=$((failed + bad))
done
echo "== all suites: $(($(date +%s) - begun)) s"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
