#!/bin/sh
# Random sessions of keys and mouse with the sanitizers looking on: any report, any other end than a normal one or Ctrl-C,
# and a session that does not end are faults.
#
#   tests/san/monkey.sh FIRST LAST      the seeds of the first and the last session
set -u
cd "$(dirname "$0")/../.." || exit 1
demo=$PWD/build/san/demo
monkey=$PWD/tests/san/monkey.awk
dir=$(mktemp -d "${TMPDIR:-/tmp}/monkey.XXXXXX") || exit 1
trap 'rm -rf "$dir"' EXIT
trap 'exit 130' HUP INT TERM
# A folder of its own, for some keys save files; with scenes beside the program.
mkdir "$dir/play"
ln -s "$demo" "$dir/play/demo"
cp tools/scenes/FOUR.FB tools/scenes/GULP.FB tools/scenes/TOUR.FB "$dir/play"
echo "sphere bad size" >"$dir/play/HALF.FB"
cd "$dir/play" || exit 1
seed=$1
bad=0
while [ "$seed" -le "$2" ]; do
	case $((seed % 6)) in
	0) switches=/P ;;
	1) switches="/I /P /G" ;;
	2) switches=/A:FILM.FLI ;;
	3) switches="/I /A:FILM.FLI" ;;
	*) switches=/I ;;
	esac
	awk -v seed="$seed" -f "$monkey" >../script
	# The switches are words of their own.
	FB_INPUT=../script timeout 100 ./demo /N:26 /S:4 $switches >../out 2>../err
	status=$?
	if [ $status -ne 0 ] && ! { [ $status -eq 1 ] && [ "$(cat ../err)" = interrupted ]; }; then
		echo "session $seed ($switches): status $status"
		head -n 20 ../err
		bad=$((bad + 1))
	fi
	seed=$((seed + 1))
	# Not more of them than a list has to show.
	[ $((seed % 20)) -ne 0 ] || rm -f SHOT*.PCX SAVED*.FB
done
echo "$((seed - $1)) sessions, $bad bad"
[ $bad -eq 0 ]
