#!/bin/sh
# Tests of the PC and the run-time in DOSBox: MTEST.EXE with its various arguments, by itself and with keys and mouse in a
# window. Prints `ok` and `FAIL` lines and a count.
#
#   tests/dos/machine.sh [MTEST.EXE [FILE...]]     default build/MTEST.EXE; FILEs are put beside it (a DPMI host, say)
set -u
. tests/dos/lib.sh

program=${1:-build/MTEST.EXE}
[ $# -eq 0 ] || shift
c=$scratch/c
mkdir "$c"
cp "$program" "$c/MTEST.EXE" || exit 1
for file in "$@"; do
    cp "$file" "$c" || exit 1
done
dos -- 'MTEST STATE > BEFORE.TXT' 'MTEST ALL 200 > ALL.TXT' 'MTEST STATE > AFTER.TXT'
ran "$c/ALL.TXT"
ok 'MTEST ALL: to its end' has "$c/ALL.TXT" '# all of it'
ok 'no file of another name is left by saving' test "$(ls "$c" "$c/MTDIR" | grep -v ':$' | grep -c .)" -eq 9
ok 'vectors, timer, video and DOS memory as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"

# Arguments, up to the 126 characters of a command line.
long=aaaaaaaaaaaaaaaaaaaaaaaaaaaaaa
dos -- 'MTEST ARGS one  "two three" f"o u"r "" > ARGS.TXT' \
    "MTEST.EXE ARGS $long $long $long b1234567890123456789 > LONG.TXT" 'MTEST ARGS > NONE.TXT'
# (DJGPP's start-up code changes the program's name to small letters and slashes.)
for file in ARGS LONG NONE; do
    tr '/A-Z' '\\a-z' < "$c/$file.TXT" > "$scratch/$file"
done
printf '[one]\r\n[two three]\r\n[fo ur]\r\n[]\r\nname c:\\mtest.exe\r\nend null\r\n' > "$scratch/args"
ok 'arguments and quotes' cmp "$scratch/args" "$scratch/ARGS"
printf '[%s]\r\n[%s]\r\n[%s]\r\n[b1234567890123456789]\r\nname c:\\mtest.exe\r\nend null\r\n' $long $long $long \
    > "$scratch/long"
ok 'a long command line' cmp "$scratch/long" "$scratch/LONG"
printf 'name c:\\mtest.exe\r\nend null\r\n' > "$scratch/none"
ok 'no arguments' cmp "$scratch/none" "$scratch/NONE"

# Each exception is raised in mode 13h while the timer and the vectors are taken.
crash() {
    rm -f "$c"/*.TXT
    dos -- 'MTEST STATE > BEFORE.TXT' cls "MTEST CRASH $1 > OUT.TXT" "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT' \
        'MTEST STATE > AFTER.TXT'
    ok "exception $1: text mode" has "$c/SCREEN.TXT" 'mode 3'
    ok "exception $1: its line" has "$c/SCREEN.TXT" "DEMO: exception $2"
    ok "exception $1: status 1" status 1 "$c"
    ok "exception $1: nothing on standard output" test ! -s "$c/OUT.TXT"
    ok "exception $1: all as before" cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"
}
crash 0 '00h (division by zero)'
crash 6 '06h (invalid instruction)'
crash 13 '0dh (general protection)'

# A full disk
floppy "$scratch/floppy.img"
dos -- "imgmount a \"$scratch/floppy.img\" -t floppy > nul" 'MTEST FULL A:\X.DAT > FULL.TXT'
ran "$c/FULL.TXT"

# No VGA
rm -f "$c"/*.TXT
dos -o dosbox.machine=ega -- cls 'MTEST NOVGA' "$E1" "$E2" 'MTEST SCREEN > SCREEN.TXT'
ok 'no VGA: a line' has "$c/SCREEN.TXT" 'no VGA found'
ok 'no VGA: status 1' status 1 "$c"

# In a window: real input from keyboard and mouse.
if startDisplay; then
    play() {
        rm -f "$c/PLAY.TXT"
        dos -w -c 20000 -- 'MTEST STATE > BEFORE.TXT' 'MTEST PLAY 25 > PLAY.TXT' 'MTEST STATE > AFTER.TXT' &
        running=$!
        awaitTitle MTEST
    }
    play
    # A click makes DOSBox capture the mouse; DOSBox also counts it as a press of the left button. (xdotool complains about the
    # input focus because there is no window manager.)
    xdotool mousemove --window "$dosWindow" 300 200 sleep 0.3 mousedown 1 sleep 0.2 mouseup 1 sleep 0.5 2> /dev/null
    for i in 1 2 3 4 5; do
        xdotool mousemove_relative -- 8 -4 sleep 0.1 2> /dev/null
    done
    xdotool mousedown 1 sleep 0.2 mouseup 1 sleep 0.2 mousedown 3 sleep 0.2 mouseup 3 sleep 0.3 2> /dev/null
    xdotool key asterisk sleep 0.2 key minus sleep 0.2 key plus sleep 0.2 key F1 sleep 0.2 key Up sleep 0.2 \
        key Escape 2> /dev/null
    wait $running
    tr -d '\r' < "$c/PLAY.TXT"
    for key in 2a 2d 2b 13b 148 1b; do
        ok "key $key typed" has "$c/PLAY.TXT" "key $key"
    done
    ok 'a mouse' has "$c/PLAY.TXT" 'mouse yes'
    ok 'it moved right and up' grep -q 'dx [1-9][0-9]* dy -[1-9]' "$c/PLAY.TXT"
    ok 'both buttons' grep -q 'lefts [1-9].*rights 1' "$c/PLAY.TXT"
    ok 'not broken' has "$c/PLAY.TXT" 'broken no'

    play
    xdotool key --window "$dosWindow" ctrl+c 2> /dev/null
    wait $running
    ok 'Ctrl-C is a break' has "$c/PLAY.TXT" 'broken yes'
    ok 'and all is as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"
    # (DOSBox's keyboard has no Ctrl-Break; MTEST ALL calls its vector.)
else
    echo "# no Xvfb and xdotool: keyboard and mouse not tried"
fi

summary
