#!/bin/sh
# Tests of scene files. scntst.cpp tests the statements, complaints and limits in process; then the program reads scene files:
# the report's four spheres from a file must give the frames of the built-in model; every shipped scene must play, give the
# same frames on the 64-bit and the 32-bit build, and read back after it was written; a bad file must end the program with
# status 2 and one line. The last line is "N passed, N failed".
set -u
cd "$(dirname "$0")/../.." || exit 1
make -s build/demo build/demo32 build/DEMO.EXE build/scntst build/mkscene || { echo "0 passed, 1 failed"; exit 1; }
dir=$(mktemp -d "${TMPDIR:-/tmp}/fbscenes.XXXXXX") || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
passed=0 failed=0
good() { passed=$((passed + 1)); }
bad() { failed=$((failed + 1)); echo "FAIL $1"; }

build/scntst >"$dir/log" 2>&1
last=$(tail -n 1 "$dir/log")
case $last in
*" passed, "*" failed")
	sed '$d' "$dir/log"
	passed=${last%% passed*}
	failed=${last##*passed, }
	failed=${failed%% failed*}
	;;
*) bad "scntst did not reach its end"; cat "$dir/log" ;;
esac

# same NAME DIR DIR: both directories must have the same files with the same contents.
same() {
	if diff -r "$2" "$3" >"$dir/log" 2>&1 && [ -n "$(ls "$2")" ]; then good; else bad "$1"; head -n 3 "$dir/log"; fi
}

# The four spheres from a file must give the same bytes in every dumped file.
for switches in "/N:60" "/N:20 /G /S:1" "/N:20 /P" "/N:20 /R:70 /S:3"; do
	rm -rf "$dir/a" "$dir/b"
	# shellcheck disable=SC2086
	build/demo $switches "/D:$dir/a" >"$dir/out.a" && build/demo $switches /M:tools/scenes/FOUR.FB "/D:$dir/b" >"$dir/out.b"
	same "four spheres from a file, $switches" "$dir/a" "$dir/b"
	if cmp -s "$dir/out.a" "$dir/out.b"; then good; else bad "statistics of the four spheres, $switches"; fi
done
echo "four spheres from a file: 120 frames compared with the model built in"

# Every scene must give the same frames on both builds, in long steps and in short ones, with which voxels go on.
frames=0
both() { # both NAME SCENE: compares the builds
	for rate in 2 35; do
		rm -rf "$dir/a" "$dir/b"
		if build/demo /N:16 /R:$rate "/M:$2" "/D:$dir/a" >"$dir/out.a" 2>&1; then good; else bad "$1: $(head -n 1 "$dir/out.a")"; fi
		sh tools/run32.sh build/demo32 /N:16 /R:$rate "/M:$2" "/D:$dir/b" >"$dir/out.b" 2>&1
		same "$1, $rate frames a second, 64 bits and 32" "$dir/a" "$dir/b"
		frames=$((frames + 16))
	done
}
for scene in tools/scenes/*.FB tests/scenes/hurt/*.FB; do
	both "$scene" "$scene"
done
for seed in $(seq 30); do
	build/mkscene $seed >"$dir/r.fb"
	both "random scene $seed" "$dir/r.fb"
	build/mkscene $seed paint >"$dir/r.fb"
	both "random scene $seed, painted" "$dir/r.fb"
done
echo "scenes: $frames frames compared between 64 bits and 32"

# The shipped scenes run in DOSBox as well, all in one go and as fast as the emulator can; in long steps and, into folders of their
# own, in short ones.
short() { # short NAME: a folder's name of eight letters
	echo "$1" | cut -c 1-6 | sed 's/$/35/'
}
if command -v dosbox >/dev/null; then
	mkdir "$dir/c"
	cp build/DEMO.EXE tools/scenes/*.FB "$dir/c"
	set --
	for scene in tools/scenes/*.FB; do
		name=$(basename "$scene" .FB)
		set -- "$@" "DEMO /N:8 /R:2 /M:$name.FB /D:$name > $name.TXT" \
			"DEMO /N:12 /R:35 /M:$name.FB /D:$(short "$name") > $name.TXT"
	done
	tools/dosbox.sh -c max -o cpu.core=dynamic -t 300 -d "$dir/c" -- "$@" >"$dir/log" 2>&1 || bad "scenes in DOSBox"
	for scene in tools/scenes/*.FB; do
		name=$(basename "$scene" .FB)
		rm -rf "$dir/a"
		build/demo /N:8 /R:2 "/M:$scene" "/D:$dir/a" >"$dir/out.a" 2>&1
		same "$scene, host and DOS" "$dir/a" "$dir/c/$name"
		rm -rf "$dir/a"
		build/demo /N:12 /R:35 "/M:$scene" "/D:$dir/a" >"$dir/out.a" 2>&1
		same "$scene, short steps, host and DOS" "$dir/a" "$dir/c/$(short "$name")"
	done
	echo "scenes: $(ls "$dir"/c/*/*.PPM | wc -l) frames compared between the host and DOS"
else
	echo "# no dosbox or no DEMO.EXE: scenes not tried in DOS"
fi

# Places depend on the time only: they must be equal at 4 s, whatever frames were drawn before.
for scene in tools/scenes/*.FB; do
	rm -rf "$dir/a" "$dir/b"
	build/demo /X /N:5 /R:1 "/M:$scene" "/D:$dir/a" >"$dir/out.a" 2>&1
	build/demo /X /N:29 /R:7 "/M:$scene" "/D:$dir/b" >"$dir/out.b" 2>&1
	# The first line is the time, which may differ in the last decimals.
	sed 1d "$dir/a/F0000004.TXT" >"$dir/out.a"
	sed 1d "$dir/b/F0000028.TXT" >"$dir/out.b"
	if [ -s "$dir/out.a" ] && cmp -s "$dir/out.a" "$dir/out.b"; then good; else bad "$scene: other places at 4 s"; fi
done

# The generator must make the same file for the same seed, and the program must accept it.
build/mkscene 5 >"$dir/one.fb"
build/mkscene 5 >"$dir/two.fb"
if cmp -s "$dir/one.fb" "$dir/two.fb"; then good; else bad "mkscene: two files for one seed"; fi
for seed in $(seq 30); do
	build/mkscene $seed >"$dir/r.fb"
	cat "$dir/r.fb" >>"$dir/all.fb"
	if build/demo /X /N:1 "/M:$dir/r.fb" >"$dir/out" 2>&1; then good; else bad "random scene $seed: $(head -n 1 "$dir/out")"; fi
done
# The scenes together must contain all statements that authors write: every kind, every motion, groups, and various weights.
for word in '^sphere' '^cylinder' '^torus' '^disc' '^cone' '^box' '^group' ' in g' '^circle' '^path' '^spin' '^swing' '^pulse' \
	'^key .* angle' '^key .* scale' '^blend all$' '^blend o[0-9]* o[0-9]*$' '^blend o.* 0\.[1-9]$' '^blend o.* [1-4]\.[0-9]$'; do
	if grep -q -- "$word" "$dir/all.fb"; then good; else bad "mkscene: thirty scenes without $word"; fi
done
for seed in $(seq 10); do
	build/mkscene $seed paint >"$dir/r.fb"
	cat "$dir/r.fb" >>"$dir/paint.fb"
	if build/demo /X /N:1 "/M:$dir/r.fb" >"$dir/out" 2>&1; then
		good
	else
		bad "random scene $seed with paint: $(head -n 1 "$dir/out")"
	fi
done
for word in '^colours mixed$' '^finish o.* shiny$' '^finish o.* mirror$' '^pattern o.* checks' \
	'^pattern o.* stripes' '^pattern o.* marble'; do
	if grep -q -- "$word" "$dir/paint.fb"; then good; else bad "mkscene: ten scenes without $word"; fi
done
for seed in $(seq 10); do
	build/mkscene $seed dents >"$dir/r.fb"
	cat "$dir/r.fb" >>"$dir/dents.fb"
	if build/demo /X /N:1 "/M:$dir/r.fb" >"$dir/out" 2>&1; then
		good
	else
		bad "random scene $seed with dents: $(head -n 1 "$dir/out")"
	fi
done
for word in '^dent o[0-9]* d[0-9]*$' '^dent o.* 0\.[1-9]$' '^dent o.* [12]\.[0-9]$' '^strength o.* 0' '^strength o.* [1-4]'; do
	if grep -q -- "$word" "$dir/dents.fb"; then good; else bad "mkscene: ten scenes without $word"; fi
done
for seed in $(seq 20); do
	build/mkscene $seed 6 shapes >"$dir/r.fb"
	cat "$dir/r.fb" >>"$dir/shapes.fb"
	if build/demo /X /N:2 "/M:$dir/r.fb" >"$dir/out" 2>&1; then
		good
	else
		bad "random scene $seed of shapes: $(head -n 1 "$dir/out")"
	fi
done
for word in 'stretch' '^taper' '^twist' '^bend' 'swing'; do
	if grep -q -- "$word" "$dir/shapes.fb"; then good; else bad "mkscene: twenty scenes without $word"; fi
done
# The same scenes are seen by an eye that moves around them.
: >"$dir/all.fb"
for seed in $(seq 30); do
	build/mkscene $seed >"$dir/r.fb"
	build/mkscene $seed eye >"$dir/e.fb"
	cat "$dir/e.fb" >>"$dir/all.fb"
	if head -n "$(wc -l <"$dir/r.fb")" "$dir/e.fb" | cmp -s - "$dir/r.fb"; then
		good
	else
		bad "mkscene: another scene for an eye, $seed"
	fi
	if build/demo /X /N:1 "/M:$dir/e.fb" >"$dir/out" 2>&1; then good; else bad "random scene $seed, eye: $(head -n 1 "$dir/out")"; fi
done
for word in '^circle eye radius' '^circle eye u' '^path eye' '^eye .* in arm' '^look o' '^look [-0-9]' '^roll'; do
	if grep -q -- "$word" "$dir/all.fb"; then good; else bad "mkscene: thirty eyes without $word"; fi
done
build/mkscene 1 128 >"$dir/r.fb"
if build/demo /X /N:1 /S:8 "/M:$dir/r.fb" >"$dir/out" 2>&1; then good; else bad "a random scene of 128"; fi

# refused NAME WORDS SWITCHES...: the program must end with status 2, with these words as the only line on standard error, and
# must not write a frame.
refused() {
	name=$1 words=$2
	shift 2
	rm -rf "$dir/d"
	build/demo /N:1 "/D:$dir/d" "$@" >"$dir/out" 2>"$dir/err"
	status=$?
	if [ $status -eq 2 ] && [ "$(cat "$dir/err")" = "$words" ] && [ ! -s "$dir/out" ] && [ ! -e "$dir/d/F0000000.PPM" ]; then
		good
	else
		bad "$name: status $status, $(cat "$dir/err")"
	fi
}
refused "missing file" "$dir/none.fb: no such file or directory" "/M:$dir/none.fb"
refused "directory" "$dir: access denied" "/M:$dir"
printf 'sphere a size 20\nsphere b size 20\nspere c size 20\n' >"$dir/bad.fb"
statements='sphere, cylinder, torus, disc, cone, box, group, blend, dent, strength, circle, path, spin, swing, pulse, taper, '\
'twist, bend, keys, key, colours, finish, pattern, eye, look, roll, focal, light or title'
refused "bad line" "$dir/bad.fb:3: 'spere': expected $statements" "/M:$dir/bad.fb"
: >"$dir/empty.fb"
refused "empty file" "$dir/empty.fb:1: 'end of file': expected at least one object" "/M:$dir/empty.fb"
head -c 3000 build/demo >"$dir/binary.fb"
build/demo /N:1 "/M:$dir/binary.fb" >"$dir/out" 2>"$dir/err"
if [ $? -eq 2 ] && [ "$(wc -l <"$dir/err")" -eq 1 ]; then good; else bad "a binary file: $(cat "$dir/err")"; fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
