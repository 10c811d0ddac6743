#!/bin/sh
# The play command: the program's own line and exit status reach whoever typed it, with a display and without, and no
# figures of an earlier run are shown for those of this one.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/dos/lib.sh

build play-parts
if ! command -v dosbox >/dev/null; then
	echo "# no dosbox"
	summary
	exit
fi
unset DISPLAY SDL_VIDEODRIVER

# plays STATUS COMMAND...: it ends so; what it says is in $dir/out and $dir/err.
plays() {
	want=$1
	shift
	"$@" >"$dir/out" 2>"$dir/err" </dev/null
	got=$?
	[ "$got" -eq "$want" ] || {
		echo "status $got, expected $want"
		cat "$dir/out" "$dir/err"
		return 1
	}
}
spoken() { # lines that are not the program's figures
	grep -c -v '^[a-z ]*: [0-9.]*$' "$dir/out"
}

printf 'sphere a size 20\nspere b size 20\n' >"$dir/bad.fb"
ok "two frames" plays 0 sh tools/run.sh FRAMES=2
ok "the figures" has "$dir/out" "frames: 2"
ok "what it does in five lines at most" test "$(spoken)" -le 5
ok "pictures" test -s build/play/PICTURES/DEMO.GIF
ok "a bad switch" plays 2 sh tools/run.sh FRAMES=2 SWITCHES=/Q
ok "is named" has "$dir/err" '/Q: unknown switch'
ok "without the figures of the run before" lacks "$dir/out" 'frames:'
ok "a bad scene" plays 2 sh tools/run.sh FRAMES=2 SCENE="$dir/bad.fb"
ok "its line is told" has "$dir/err" "BAD.FB:2: 'spere': expected sphere"
ok "the same by make" plays 2 make run FRAMES=2 SCENE="$dir/bad.fb"
ok "its line is told by make" has "$dir/err" "BAD.FB:2: 'spere': expected sphere"
ok "a scene that is not there" plays 2 make run SCENE=nowhere
ok "with those that are" has "$dir/err" 'walk'
ok "trouble" plays 1 sh tools/run.sh FRAMES=2 'SWITCHES=/O:NODIR\R.CSV'
ok "is told" has "$dir/err" 'R.CSV: no such file'

# What the user saved under the name of a shipped scene is kept, and the shipped one is played. (The user's own files of this
# kind stay as they are.)
echo "sphere mine$$ size 20" >build/play/WALK.FB
ok "a run beside a saved scene" plays 0 sh tools/run.sh FRAMES=2
ok "the shipped scene is there" cmp tools/scenes/WALK.FB build/play/WALK.FB
echo "sphere yours$$ size 20" >build/play/WALK.FB
ok "a run of that scene" plays 0 sh tools/run.sh FRAMES=2 SCENE=walk
ok "is one of the shipped scene" cmp tools/scenes/WALK.FB build/play/WALK.FB
kept=$(grep -l -e "mine$$" -e "yours$$" build/play/WALK.O*)
ok "both saved ones are kept" test "$(echo $kept | wc -w)" -eq 2
rm -f $kept

# Not a display; no figures of the window played before.
echo 'frames: 12345' >build/play/STATS.TXT
ok "a display that cannot be opened" env DISPLAY=:77 sh -c "sh tools/run.sh FRAMES=2 SCENE=walk >'$dir/out' 2>'$dir/err'"
ok "is told" has "$dir/out" 'The display :77 cannot be opened.'
ok "and frames are played without it" has "$dir/out" 'frames: 2'
ok "nothing is left of an earlier run" lacks "$dir/out" 12345

if startDisplay; then
	ok "a bad switch, in a window" plays 2 sh tools/run.sh SWITCHES=/S:9
	ok "is named" has "$dir/err" '/S:9: a seed spacing from 0.25 to 8'
	ok "a bad scene, in a window" plays 2 make run SCENE="$dir/bad.fb"
	ok "its line is told" has "$dir/err" "BAD.FB:2: 'spere': expected sphere"
	ok "two frames in a window" plays 0 sh tools/run.sh SWITCHES=/N:2 SCENE=walk
	ok "the figures" has "$dir/out" "frames: 2"
	# Without the build, which waits for those of other suites: no window would show in time, ESC would reach nobody.
	timeout 120 sh tools/play.sh '' /S:8 >"$dir/out" 2>&1 &
	playing=$!
	ok "a window" awaitTitle DEMO
	xdotool key Escape
	ok "that ESC ends" wait $playing
	ok "with its figures" has "$dir/out" 'fps: '
else
	echo "# no Xvfb or no xdotool: windows not tried"
fi

# What the compiler says is shown when it fails, and only then.
rm -f build/dos/src/app/main.o
ok "a build that fails" plays 1 sh tools/run.sh DOS_CXX="sh -c 'echo no compiler here >&2; false'"
ok "is told" has "$dir/err" 'could not be built'
ok "and why" has "$dir/err" 'no compiler here'
build play-parts
summary
