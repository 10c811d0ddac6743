#!/bin/sh
# The program and the unit tests under the address and undefined-behaviour sanitizers, and the program under valgrind, which
# knows what was never written: any report ends the program, so what passes here has none.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/san/demo build/san/unit
# The program has an operator delete of its own, and the C++ library of the tests gets that too.
ASAN_OPTIONS=detect_leaks=1:alloc_dealloc_mismatch=0
UBSAN_OPTIONS=print_stacktrace=1
export ASAN_OPTIONS UBSAN_OPTIONS

plays() {
	build/san/demo "$@"
}
ok "30 frames" plays /N:30
ok "grey" plays /N:30 /G /S:4
ok "as printed" plays /N:30 /P
ok "as printed, coarse" plays /N:30 /P /S:8
ok "fine" plays /N:30 /S:1
ok "very fine" plays /N:3 /S:0.25
ok "as printed, fine" plays /N:5 /P /S:0.5
ok "dumped" plays /N:30 "/D:$dir/d"
ok "the same as without the sanitizers" sh -c "make -s build/demo && build/demo /N:30 '/D:$dir/e' && diff -r '$dir/d' '$dir/e'"
cat >"$dir/script" <<END
1 key -
1 mouse 40 10 L
2 mouse -30 10 -
3 key *
4 mouse 20000 -20000 R
5 key +
6 key TAB
6 key LEFT
6 key PGUP
7 mouse -30000 0 LR
8 key +
9 key -
END
ok "interactive" env FB_INPUT="$dir/script" build/san/demo /I /N:30
ok "every shipped scene" sh -c 'for f in tools/scenes/*.FB; do
	build/san/demo /N:30 "/M:$f" || exit 1
done'
ok "the smallest beside the largest" build/san/demo /N:40 /R:8 /M:tests/fuzz/corpus/TINY.FB
ok "the same, with heavy links" build/san/demo /N:12 /R:8 /S:5 /M:tests/fuzz/corpus/SMALL.FB
ok "the same, warped" build/san/demo /N:12 /R:8 /S:5 /M:tests/fuzz/corpus/WARPED.FB
ok "a torus that meets itself" build/san/demo /N:12 /R:8 /S:5 /M:tests/fuzz/corpus/SPINDLE.FB
ok "thin tips that dig" build/san/demo /N:14 /R:35 /S:6 /M:tests/fuzz/corpus/TIPS.FB
ok "heavy links of many kinds" build/san/demo /N:14 /R:35 /S:6 /M:tests/fuzz/corpus/HEAVY.FB
ok "any keys and moves" sh tests/san/monkey.sh 1 12
# What memory happens to hold may not be seen: it differs from build to build.
build build/demo build/mkscene
knows() {
	valgrind -q --error-exitcode=9 build/demo /R:35 /N:8 "/M:$1"
}
for scene in WALK FACE TOUR; do
	ok "$scene reads only what was written" knows "tools/scenes/$scene.FB"
done
for scene in 17 '4 dents' '5 dents' '1 paint' '3 6 shapes'; do
	build/mkscene $scene >"$dir/r.fb"
	ok "so does random scene $scene" knows "$dir/r.fb"
done
sh tests/cli/run.sh build/san/demo >"$dir/cli" 2>&1
count "$dir/cli" >"$dir/counted"
grep -v '^ok' "$dir/counted"
build/san/unit >"$dir/unit" 2>&1
count "$dir/unit" >"$dir/counted"
grep -v '^ok' "$dir/counted"
summary
