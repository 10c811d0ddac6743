#!/bin/sh
# Runs every test suite, three at a time where there are two processors or more, and adds up what they say.
#
#   sh tests/run.sh [SUITE...]      the folders of tests/ with a run.sh; default: all of them
#
# LANES says how many run at a time; those in DOSBox and in a browser wait for a clock half of their time. They build in the same
# place, so each `make` waits for another lane's.
# A suite is a script tests/SUITE/run.sh, run from the top of the tree. It builds what it needs, prints a line for each
# failure ("FAIL ..." or "FAILED: ...") and closes with "N passed, N failed". One that ends without that line, or with a
# status that does not go with it, counts as a failure of its own, and so does one that takes longer than LIMIT seconds
# (900). The last line here is the sum, alone.
# The whole output of each suite is kept in build/log.
set -u
cd "$(dirname "$0")/.." || exit 1

# In this order: what is close to the cause first; then suites that compute beside ones that wait, the longest first.
order="unit twins pics tree cli truth golden dpmi bars dos san web prims bench edit release"
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

mkdir -p build/log build/lanes
rm -rf build/lanes/*
begun=$(date +%s)
lanes=${LANES:-$([ "$(nproc 2>/dev/null || echo 1)" -ge 2 ] && echo 3 || echo 1)}
command -v flock >/dev/null || lanes=1
if [ "$lanes" -ge 2 ]; then
	cat >build/lanes/make <<-END
		#!/bin/sh
		[ -z "\${FB_MAKING:-}" ] || exec $(command -v make) "\$@"
		FB_MAKING=1 exec flock '$PWD/build/lanes/lock' $(command -v make) "\$@"
	END
	chmod +x build/lanes/make
	PATH=$PWD/build/lanes:$PATH
	export PATH
fi

# one SUITE: runs it, and leaves what is to be shown in build/lanes/SUITE.said and its two counts in SUITE.done.
one() {
	suite=$1
	log=build/log/$suite.txt
	start=$(date +%s)
	timeout -k 10 "${LIMIT:-900}" sh "tests/$suite/run.sh" >"$log" 2>&1 &
	echo $! >"build/lanes/$suite.pid"
	wait $!
	status=$?
	rm -f "build/lanes/$suite.pid"
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
		echo "FAIL $suite: did not reach its end (status $status; 124 or 137: out of time)"
		good=0
		bad=1
	fi
	echo "-- $suite: $good passed, $bad failed ($took s)"
	echo "$good $bad" >"build/lanes/$suite.count"
}

# Every lane takes the next suite that nobody has taken yet.
lane() {
	for suite in $suites; do
		mkdir "build/lanes/$suite.taken" 2>/dev/null || continue
		one "$suite" >"build/lanes/$suite.said" 2>&1
		mv "build/lanes/$suite.count" "build/lanes/$suite.done"
	done
}

# Each suite is a group of processes of its own, which its `timeout` ends.
trap 'trap - TERM; kill $(cat build/lanes/*.pid 2>/dev/null) 2>/dev/null; kill 0; exit 130' HUP INT TERM
for number in $(seq "$lanes"); do
	lane &
done
passed=0
failed=0
for suite in $suites; do
	echo "== $suite"
	while [ ! -f "build/lanes/$suite.done" ]; do
		sleep 0.2
	done
	cat "build/lanes/$suite.said"
	read -r good bad <"build/lanes/$suite.done"
	passed=$((passed + good))
	failed=$((failed + bad))
done
wait
echo "== all suites: $(($(date +%s) - begun)) s"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
