#!/bin/sh
# Plays DEMO.EXE in DOSBox, in a window: `make run`. Where there is no display that can be opened it plays all the same,
# FRAMES frames (40) without a window, and leaves them as pictures.
#
#   play.sh [SCENE [SWITCHES...]]
#
# SCENE is the name of a shipped scene (walk), or a scene file; empty: the four spheres. What the program saves and dumps
# is left in build/play. CYCLES, from the environment, is the speed of the processor as tools/dosbox.sh has it (max).
# What the program says is said here; exit status: the program's own, 0, 1 or 2.
cd "$(dirname "$0")/.." || exit 1
scene=${1:-}
[ $# -eq 0 ] || shift
play=build/play
mkdir -p $play || exit 1
cp build/DEMO.EXE build/PLAY.COM $play || exit 1

# put FILE NAME: FILE becomes the scene NAME beside the program. Another scene that is there under this name, for the user may
# have saved it, is kept as NAME.OLD, or NAME.O1, NAME.O2 and so on.
put() {
	if [ -f "$play/$2" ] && ! cmp -s "$1" "$play/$2"; then
		old=OLD
		number=0
		while [ -f "$play/${2%.FB}.$old" ] && ! cmp -s "$play/$2" "$play/${2%.FB}.$old"; do
			number=$((number + 1))
			old=O$number
		done
		mv "$play/$2" "$play/${2%.FB}.$old" || exit 1
	fi
	cp "$1" "$play/$2" || exit 1
}

name=
what="the four spheres"
if [ -n "$scene" ]; then
	file=$scene
	[ -f "$file" ] || file=tools/scenes/$(basename "$scene" | sed "s/\.[Ff][Bb]\$//" | tr '[:lower:]' '[:upper:]').FB
	if [ ! -f "$file" ]; then
		known=$(cd tools/scenes && ls ./*.FB | sed 's/^..//; s/\.FB$//' | tr '[:upper:]\n' '[:lower:] ')
		echo "play.sh: no scene '$scene'; there are $known" >&2
		exit 2
	fi
	# Under its own name, which mistakes in it are told with, where DOS has such names.
	name=$(basename "$file" | tr '[:lower:]' '[:upper:]')
	expr "$name" : '[A-Z0-9_-]\{1,8\}\.FB$' >/dev/null || name=SCENE.FB
	put "$file" "$name"
	set -- "/M:$name" "$@"
	what=$file
fi
# The key N goes through all scenes beside the program.
for file in tools/scenes/*.FB; do
	[ "$(basename "$file")" = "$name" ] || put "$file" "$(basename "$file")"
done

# dos OPTION... -- COMMANDLINE: plays. True when DOSBox came as far as DOS.
dos() {
	rm -f $play/BEGUN.TXT $play/STATS.TXT $play/ERRORS.TXT $play/E1.TXT $play/E2.TXT
	options=
	while [ "$1" != -- ]; do
		options="$options $1"
		shift
	done
	shift
	# shellcheck disable=SC2086  # options are words
	sh tools/dosbox.sh $options -c "${CYCLES:-max}" -d $play -- 'echo x > BEGUN.TXT' "PLAY $* > STATS.TXT" \
		'if errorlevel 1 echo x > E1.TXT' 'if errorlevel 2 echo x > E2.TXT' >$play/dosbox.log 2>&1 || cat $play/dosbox.log >&2
	[ -s $play/BEGUN.TXT ]
}

# What the program said, and its status.
report() {
	tr -d '\r' <$play/STATS.TXT
	[ ! -f $play/ERRORS.TXT ] || tr -d '\r' <$play/ERRORS.TXT >&2
	[ ! -s $play/E2.TXT ] || exit 2
	[ ! -s $play/E1.TXT ] || exit 1
}

if [ -n "${DISPLAY:-}" ]; then
	echo "Playing $what in a DOSBox window: F1 shows the keys, ESC ends."
	if dos -w -t 0 -- "$@"; then
		report
		[ -s $play/STATS.TXT ] || echo "The window was closed before the program came to its end: no statistics."
		exit 0
	fi
	echo "The display $DISPLAY cannot be opened."
fi

frames=${FRAMES:-40}
rm -rf $play/FRAMES $play/PICTURES
echo "Playing $frames frames of $what in DOSBox without a window, for there is no display."
if ! dos -t 600 -- "/N:$frames /D:FRAMES $*"; then
	echo "play.sh: DOSBox did not start" >&2
	exit 1
fi
report
if [ ! -f $play/FRAMES/F0000000.PPM ]; then
	echo "play.sh: DEMO.EXE left no frames" >&2
	exit 1
fi
mkdir -p $play/PICTURES
build/mkgif --43 --delay 10 $play/PICTURES/DEMO.GIF $play/FRAMES >/dev/null || exit 1
for frame in $play/FRAMES/F*0.PPM; do
	build/ppm2png --43 "$frame" "$play/PICTURES/$(basename "$frame" .PPM).PNG" >/dev/null || exit 1
done
echo "Look at $play/PICTURES: DEMO.GIF has all frames, F*.PNG every tenth; $play/FRAMES has them as dumped."
