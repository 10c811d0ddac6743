#!/bin/sh
# Tests DEMO.EXE in DOSBox from end to end: statistics, bad input and other errors, restored state, frames compared with the
# host's, and keys and mouse in a window. Prints `ok` and `FAIL` lines and a count.
#
#   tests/dos/demo.sh [DEMO.EXE [FILE...]]     default build/DEMO.EXE; FILEs are put beside it (a DPMI host, say)
#
# build/demo (the host's program) and MTEST.EXE, beside DEMO.EXE or in build/, must have been built.
set -u
. tests/dos/lib.sh

program=${1:-build/DEMO.EXE}
[ $# -eq 0 ] || shift
host=$(pwd)/build/demo
helper=$(dirname "$program")/MTEST.EXE
[ -f "$helper" ] || helper=build/MTEST.EXE
c=$scratch/c
mkdir "$c"
cp "$program" "$c/DEMO.EXE" && cp "$helper" "$c/MTEST.EXE" || exit 1
for file in "$@"; do
    cp "$file" "$c" || exit 1
done
# ---- A run

NAMES='frames
seconds
fps
seeds
oversampled seeds
updated per frame
drawn per frame
iterations per update
normals per frame
field evaluations per frame'

names() {
    tr -d '\r' < "$1" | sed -n '1,10s/: [0-9][0-9.]*$//p'
}

dos -- 'MTEST STATE > BEFORE.TXT' cls 'DEMO /N:20 > OUT.TXT' "$E1" 'MTEST SCREEN > SCREEN.TXT' 'MTEST STATE > AFTER.TXT'
ok 'a run: the statistics, by name and in order' test "$(names "$c/OUT.TXT")" = "$NAMES"
ok 'a run: lines end as DOS has them' test "$(grep -c "$(printf '\r')\$" "$c/OUT.TXT")" = "$(wc -l < "$c/OUT.TXT")"
ok 'a run: 20 frames' has "$c/OUT.TXT" 'frames: 20'
ok 'a run: the seeds of the report' has "$c/OUT.TXT" 'seeds: 2496'
ok 'a run: and its oversampled ones' has "$c/OUT.TXT" 'oversampled seeds: 2480'
ok 'a run: status 0' status 0 "$c"
ok 'a run: text mode afterwards' has "$c/SCREEN.TXT" 'mode 3'
ok 'a run: vectors, timer, DOS memory as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"

dos -c 20000 -- 'DEMO /T:3 > OUT.TXT'
ok '/T:3 lasts three seconds' grep -q '^seconds: 3\.[01]' "$c/OUT.TXT"

# ---- Bad input gives a line that names it and status 2, and does not touch the screen

bad() {
    rm -f "$c"/*.TXT
    dos -- cls 'echo untouched' "DEMO $1 > OUT.TXT" "$E1" "$E2" "$E3" 'MTEST SCREEN > SCREEN.TXT'
    ok "bad $1: status 2" status 2 "$c"
    ok "bad $1: named" has "$c/SCREEN.TXT" "$2"
    ok "bad $1: the screen is untouched" has "$c/SCREEN.TXT" untouched
    ok "bad $1: nothing on standard output" test ! -s "$c/OUT.TXT"
}
bad /Q /Q
bad /S:9 /S:9
bad /N:0 /N:0
bad -T:abc -T:abc

rm -f "$c"/*.TXT
dos -- 'DEMO /? > OUT.TXT' "$E1" 'DEMO /M:NONE.TXT /N:1' 'MTEST SCREEN > SCREEN.TXT'
ok '/? on standard output' has "$c/OUT.TXT" '/N:n'
ok '/? has status 0' status 0 "$c"
ok 'a missing file is named' has "$c/SCREEN.TXT" NONE.TXT

# ---- Other errors give a line and status 1 in text mode

trouble() {
    ok "$1: a line" has "$c/SCREEN.TXT" "$2"
    ok "$1: status 1" status 1 "$c"
    ok "$1: text mode" has "$c/SCREEN.TXT" 'mode 3'
}

rm -f "$c"/*.TXT
dos -o dosbox.machine=ega -- cls 'DEMO /N:5 > OUT.TXT' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT'
trouble 'no VGA' VGA

floppy "$scratch/floppy.img"
rm -f "$c"/*.TXT
dos -- "imgmount a \"$scratch/floppy.img\" -t floppy > nul" cls 'MTEST STATE > BEFORE.TXT' 'DEMO /N:5 /D:A:\ > OUT.TXT' \
    "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT' 'MTEST STATE > AFTER.TXT'
trouble 'a full disk' 'disk full'
ok 'a full disk: all as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"

rm -f "$c"/*.TXT
dos -- cls 'DEMO /N:5 /D:NODIR\SUB > OUT.TXT' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT'
trouble 'a directory that cannot be made' 'NODIR'

rm -f "$c"/*.TXT
# 2 MB do not even hold the program, and whoever loads it says so; 3 MB hold the four spheres, but not with seeds this close.
dos -m 2 -- cls 'DEMO /N:5 > OUT.TXT' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT'
trouble 'too little memory to load' 'not enough'

rm -f "$c"/*.TXT
dos -m 3 -- cls 'DEMO /N:5 /S:0.5 > OUT.TXT' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT'
trouble 'too little memory' 'not enough memory'

rm -f "$c"/*.TXT
dos -- cls 'DEMO /N:5 /O:NODIR\R.CSV > OUT.TXT' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT'
trouble 'a record that cannot be kept' 'NODIR'
ok 'a record that cannot be kept: nothing was played' test ! -s "$c/OUT.TXT"

# ---- Scenes by name, records, dumps

printf 'sphere a size 30\r\n' > "$c/ONE.FB"
cp "$c/ONE.FB" "$scratch/one.fb"
rm -rf "$c"/*.TXT "$c/F"
dos -- cls 'DEMO ONE /G/S4/N=6 /D:F /O:R.CSV > OUT.TXT' "$E1" 'DEMO -n:2 one.fb /d:f /o:r.csv > OUT2.TXT' \
    'DEMO /N:1 /O:ONE.FB > OUT3.TXT' "$E2" "$E3" 'MTEST SCREEN > SCREEN.TXT'
ok 'a scene by its name alone' grep -q '^frames: 6' "$c/OUT.TXT"
ok 'and again with its ending' grep -q '^frames: 2' "$c/OUT2.TXT"
ok 'a header and two records' test "$(wc -l < "$c/R.CSV")" -eq 3
ok 'with scene, date and machine' grep -q '"ONE",20..-..-.. ..:..:..,DOS [0-9.]* 80[3-6]86' "$c/R.CSV"
ok 'nothing left of the older dump' test "$(ls "$c/F" | wc -l)" -eq 6
ok 'a file that is no file of records: status 2' status 2 "$c"
ok 'a file that is no file of records: named' has "$c/SCREEN.TXT" 'ONE.FB: this is no file of records'
ok 'a file that is no file of records: as it was' cmp "$scratch/one.fb" "$c/ONE.FB"
rm -rf "$c/F"

# ---- Frames must be byte for byte those of the host (only a few; tests/frames compares many)

frames() {
    rm -rf "$c/F" "$scratch/F"
    dos -- "DEMO $* /D:F > OUT.TXT" || :
    (cd "$scratch" && "$host" "$@" /D:F > out.txt)
    ok "frames of $*: as many" test "$(ls "$c/F" | wc -l)" = "$(ls "$scratch/F" | wc -l)"
    ok "frames of $*: the same bytes" diff -rq "$c/F" "$scratch/F"
    # Times differ, but all counts must be equal.
    tr -d '\r' < "$c/OUT.TXT" | grep -v -E '^(seconds|fps):' > "$scratch/dos.txt"
    grep -v -E '^(seconds|fps):' "$scratch/out.txt" > "$scratch/host.txt"
    ok "frames of $*: the same counts" cmp "$scratch/dos.txt" "$scratch/host.txt"
    rm -rf "$c/F" "$scratch/F"
}
frames /N:5
frames /P /G /N:3
frames /S:0.75 /N:3

# ---- Small and old machines

rm -f "$c"/*.TXT
dos -m 4 -o cpu.cputype=386 -- 'DEMO /N:5 > OUT.TXT' "$E1"
ok 'a 386 with 4 MB' has "$c/OUT.TXT" 'frames: 5'
ok 'a 386 with 4 MB: status 0' status 0 "$c"

# Every shipped scene must run, and the four spheres with the finest sampling that 16 MB allow.
cp tools/scenes/*.FB "$c"
for scene in tools/scenes/*.FB; do
    name=$(basename "$scene" .FB)
    rm -f "$c"/*.TXT
    dos -m 4 -- "DEMO /N:3 $name.FB > OUT.TXT"
    ok "$name in 4 MB" has "$c/OUT.TXT" 'frames: 3'
done
rm -f "$c"/*.TXT
dos -m 16 -- cls 'DEMO /N:2 /R:1 /S:0.25 > OUT.TXT' 'MTEST SCREEN > SCREEN.TXT'
ok '/S:0.25 in 16 MB' has "$c/OUT.TXT" 'frames: 2'
ok '/S:0.25: statistics alone on standard output' lacks "$c/OUT.TXT" Laying

# ---- A constant frame rate on a 386

rm -f "$c"/*.TXT
dos -c 8000 -m 4 -- 'DEMO /G /F:10 /T:20 > OUT.TXT'
fps=$(tr -d '\r' < "$c/OUT.TXT" | sed -n 's/^fps: //p')
echo "# /F:10 at 8,000 instructions a millisecond: $fps frames a second"
ok '/F:10 reaches about ten, and soon' awk -v fps="$fps" 'BEGIN { exit !(fps > 8 && fps < 13) }'

# ---- Keys and mouse, in a window

# far N: prints how many pixels of the first (N 1) or last (N $) dumped frame are empty (0x7fffffff).
far() {
    tr -cd '\177' < "$(ls "$c/F/"*.Z | sed -n "$1p")" | wc -c
}
# scene N: prints the lines of sphere N in the first and in the last dumped frame.
scene() {
    for file in $(ls "$c/F/"*.TXT | sed -n '1p;$p'); do
        tr -d '\r' < "$file" | grep "^sphere $1 "
    done
}
# moved N COLUMN: succeeds if sphere N was moved along an axis (column 3 is x, 4 is y, 5 is z).
moved() {
    test "$(scene "$1" | cut -d ' ' -f "$2" | sort -u | wc -l)" = 2
}

if startDisplay; then
    window() {
        rm -rf "$c"/*.TXT "$c/F"
        dos -w -c 60000 -- 'MTEST STATE > BEFORE.TXT' cls "DEMO $* > OUT.TXT" "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT' \
            'MTEST STATE > AFTER.TXT' &
        running=$!
        awaitTitle DEMO
    }
    type() {
        for key in "$@"; do
            xdotool key "$key" sleep 0.3 2> /dev/null
        done
    }
    drag() {
        for i in 1 2 3 4 5; do
            xdotool mousemove_relative -- "$1" "$2" sleep 0.1 2> /dev/null
        done
    }

    window /G
    type Escape
    wait $running
    ok 'ESC ends' test "$(names "$c/OUT.TXT")" = "$NAMES"
    ok 'ESC: status 0' status 0 "$c"

    # Input while the seeds are laid out, which takes twenty seconds on a 386.
    slow() {
        rm -f "$c"/*.TXT
        dos -w -c 8000 -- cls 'DEMO /S:0.25 > OUT.TXT' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT' &
        running=$!
        awaitTitle DEMO
        started=$(date +%s%N)
        xdotool key "$1" 2> /dev/null
        wait $running
        ended=$((($(date +%s%N) - started) / 1000000))
        echo "# $1 while seeds are laid out: all over after $ended ms"
    }
    slow Escape
    ok 'ESC while seeds are laid out' has "$c/OUT.TXT" 'frames: 0'
    ok 'ESC while seeds are laid out: told what it was' has "$c/SCREEN.TXT" 'Laying out 158,388 seeds of 4 objects'
    ok 'ESC while seeds are laid out: status 0' status 0 "$c"
    ok 'ESC while seeds are laid out: at once' test $ended -lt 4000
    slow ctrl+c
    trouble 'Ctrl-C while seeds are laid out' interrupted
    ok 'Ctrl-C while seeds are laid out: at once' test $ended -lt 4000

    window
    type minus minus Escape
    wait $running
    ok '- makes fewer seeds' test "$(sed -n 's/^seeds: \([0-9]*\).*/\1/p' "$c/OUT.TXT")" -lt 2000
    window
    type plus plus Escape
    wait $running
    ok '+ makes more seeds' test "$(sed -n 's/^seeds: \([0-9]*\).*/\1/p' "$c/OUT.TXT")" -gt 3000

    window /D:F
    type asterisk
    sleep 1
    type Escape
    wait $running
    ok '* shows pixels in place of scales' test "$(far '$')" -gt $(($(far 1) * 11 / 10))

    # The first click only makes DOSBox capture the mouse. The pauses are long because writing frames is slow.
    window /I /S:6 /D:F
    xdotool mousemove --window "$dosWindow" 300 200 sleep 0.5 click 1 sleep 1 2> /dev/null
    drag 10 0
    drag 0 -6
    sleep 1
    type Escape
    wait $running
    moves=0
    for n in 1 2 3 4; do
        if moved $n 3 && moved $n 4; then
            moves=$((moves + 1))
        fi
        ok "/I: sphere $n keeps its depth" test "$(scene $n | cut -d ' ' -f 5 | sort -u | wc -l)" = 1
    done
    ok '/I: the mouse moved one sphere right and up' test $moves = 1

    # The left button selects another object, and the right button is held.
    before=$(scene 2 | head -n 1)
    window /I /S:6 /D:F
    xdotool mousemove --window "$dosWindow" 300 200 sleep 0.5 click 1 sleep 1 mousedown 1 sleep 1 mouseup 1 sleep 0.5 \
        mousedown 3 sleep 1 2> /dev/null
    drag 10 0
    drag 0 -6
    sleep 1
    xdotool mouseup 3 sleep 0.5 2> /dev/null
    type Escape
    wait $running
    ok '/I: the left button selects the next sphere' test "$before" != "$(scene 2 | tail -n 1)"
    moves=0
    for n in 1 2 3 4; do
        if moved $n 3 && moved $n 5; then
            moves=$((moves + 1))
        fi
        ok "/I, right button: sphere $n keeps its height" test "$(scene $n | cut -d ' ' -f 4 | sort -u | wc -l)" = 1
    done
    ok '/I, right button: one sphere moved in x and z' test $moves = 1
    ok '/I: all as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"

    window
    xdotool key ctrl+c 2> /dev/null
    wait $running
    trouble Ctrl-C interrupted
    ok 'Ctrl-C: all as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"
else
    echo "# no Xvfb and xdotool: keys and mouse not tried"
fi

summary
