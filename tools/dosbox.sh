#!/bin/sh
# Runs DOS commands in DOSBox, with or without a window, with a processor of a given speed, and comes back when they are
# done. Everything that plays, tests or measures DEMO.EXE goes through here, so that it all happens on the same machine.
#
#   dosbox.sh [-c CYCLES] [-m MEGABYTES] [-o SECTION.KEY=VALUE]... [-t SECONDS] [-w] [-l LOG] -d DIR -- COMMAND...
#
#   -c CYCLES   instructions per emulated millisecond; or "max", as many as go (the default)
#   -m MB       memory of the PC (default 16)
#   -o S.K=V    any other setting of DOSBox, such as -o dos.xms=false or -o cpu.core=dynamic
#   -t SECONDS  time limit (default 120; 0 for none)
#   -w          with a window, on $DISPLAY, or on an Xvfb of its own when there is none
#   -l LOG      keep what DOSBox itself prints (default: thrown away unless it fails)
#   -d DIR      directory that becomes drive C:, where the commands run and leave their files
#
# Each COMMAND is one line as typed at the DOS prompt, redirections and all. Exit status: 0 when DOSBox came to the end of
# them, 124 when the time ran out, otherwise DOSBox's own. (The status of a DOS program is for IF ERRORLEVEL to tell.)
set -eu

usage() {
    sed -n '/^#   dosbox.sh/,/^# them, 124/s/^# \{0,1\}//p' "$0" >&2
    exit 2
}

cycles=max
memory=16
seconds=120
window=no
log=
dir=
more=
while getopts c:m:o:t:wl:d: option; do
    case $option in
        c) cycles=$OPTARG ;;
        m) memory=$OPTARG ;;
        o) more="$more $OPTARG" ;;
        t) seconds=$OPTARG ;;
        w) window=yes ;;
        l) log=$OPTARG ;;
        d) dir=$OPTARG ;;
        *) usage ;;
    esac
done
shift $((OPTIND - 1))
[ -n "$dir" ] && [ -d "$dir" ] && [ $# -gt 0 ] || usage
dir=$(cd "$dir" && pwd)

if ! command -v dosbox > /dev/null; then
    echo "dosbox.sh: DOSBox is not installed (Debian: apt-get install dosbox)" >&2
    exit 1
fi

case $cycles in
    max) ;;
    *) cycles="fixed $cycles" ;;
esac

work=$(mktemp -d "${TMPDIR:-/tmp}/dosbox.XXXXXX")
xvfb=
finish() {
    [ -z "$xvfb" ] || kill "$xvfb" 2> /dev/null || :
    rm -rf "$work"
}
trap finish EXIT
trap 'exit 130' INT TERM HUP

{
    cat << END
[sdl]
output=surface
waitonerror=false
[dosbox]
memsize=$memory
machine=svga_s3
[render]
frameskip=0
aspect=true
[cpu]
core=normal
cputype=auto
cycles=$cycles
[mixer]
nosound=true
[midi]
mididevice=none
mpu401=none
[sblaster]
sbtype=none
oplmode=none
[speaker]
pcspeaker=false
tandy=off
disney=false
[joystick]
joysticktype=none
[serial]
serial1=disabled
serial2=disabled
END
    for setting in $more; do
        section=${setting%%.*}
        echo "[$section]"
        echo "${setting#*.}"
    done
    echo "[autoexec]"
    echo "@echo off"
    echo "mount c \"$dir\" > nul"
    echo "c:"
    for line in "$@"; do
        printf '%s\n' "$line"
    done
    echo "exit"
} > "$work/conf"

if [ $window = no ]; then
    SDL_VIDEODRIVER=dummy
elif [ -z "${DISPLAY:-}" ]; then
    if ! command -v Xvfb > /dev/null; then
        echo "dosbox.sh: no display, and no Xvfb to make one (Debian: apt-get install xvfb)" >&2
        exit 1
    fi
    # The server writes the number of the display that it found free.
    Xvfb -noreset -displayfd 3 -screen 0 800x600x24 3> "$work/display" > /dev/null 2>&1 &
    xvfb=$!
    tries=0
    while [ ! -s "$work/display" ] && [ $tries -lt 100 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
    DISPLAY=:$(cat "$work/display")
    export DISPLAY
fi
# Without this SDL would draw with letters on the terminal when the display does not answer.
[ $window = no ] || SDL_VIDEODRIVER=x11
export SDL_VIDEODRIVER
SDL_AUDIODRIVER=dummy
# DOSBox would leave its settings in the home directory.
XAUTHORITY=${XAUTHORITY:-${HOME:-/}/.Xauthority}
HOME=$work
export SDL_AUDIODRIVER XAUTHORITY HOME

status=0
if [ "$seconds" = 0 ]; then
    dosbox -conf "$work/conf" > "$work/log" 2>&1 < /dev/null || status=$?
else
    timeout -k 5 "$seconds" dosbox -conf "$work/conf" > "$work/log" 2>&1 < /dev/null || status=$?
fi
[ -z "$log" ] || cp "$work/log" "$log"
if [ $status -ne 0 ]; then
    echo "dosbox.sh: DOSBox ended with status $status (124: out of time)" >&2
    [ -n "$log" ] || tail -n 20 "$work/log" >&2
fi
exit $status
