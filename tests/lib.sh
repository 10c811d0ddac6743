# What the test scripts share; they read it with `.` from the top of the tree and end with `summary`.

passed=0
failed=0
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbtest.XXXXXX") || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 130' HUP INT TERM

# ok NAME COMMAND...: one check. It passes when the command does; what a failing command said is shown.
ok() {
	name=$1
	shift
	if "$@" >"$dir/said" 2>&1; then
		echo "ok $name"
		passed=$((passed + 1))
	else
		echo "FAIL $name"
		sed 's/^/  /' "$dir/said" | head -n 30
		failed=$((failed + 1))
	fi
}

# build TARGET...: builds in silence; what the compiler says is shown when it fails, and the suite ends there.
build() {
	if ! make -s -j"$(nproc 2>/dev/null || echo 2)" "$@" >"$dir/make" 2>&1; then
		cat "$dir/make"
		echo "FAIL building $*"
		failed=$((failed + 1))
		summary
		exit 1
	fi
}

# count FILE: adds the closing line of a program that counts for itself, and shows its other lines.
count() {
	last=$(tail -n 1 "$1")
	case $last in
	*" passed, "*" failed")
		sed '$d' "$1"
		passed=$((passed + ${last%% *}))
		last=${last##*passed, }
		failed=$((failed + ${last%% *}))
		;;
	*)
		tail -n 30 "$1"
		echo "FAIL $1 did not reach its end"
		failed=$((failed + 1))
		;;
	esac
}

summary() {
	echo "$passed passed, $failed failed"
	[ "$failed" -eq 0 ]
}
