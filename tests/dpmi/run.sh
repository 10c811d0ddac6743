#!/bin/sh
# Tests the stub's DPMI host in DOSBox: every service with every kind of memory, timer interrupts, ends by exceptions and by
# Ctrl-C, the mouse driver's call-back, and fifty programs in a row. Prints `ok` and `FAIL` lines and a count.
#
#   tests/dpmi/run.sh [quick] [HOST.EXE]
#
# quick: runs twenty thousand timer interrupts instead of a million. HOST.EXE: another DPMI host that stays resident with -p
# (CWSDPMI), which the stub must use.
set -u
. tests/dos/lib.sh

make -s build/DTEST.EXE build/V86.COM || exit 1
c=$scratch/c
mkdir "$c"
cp build/DTEST.EXE build/V86.COM "$c" || exit 1
dos() {
    rm -f "$c"/*.TXT
    tools/dosbox.sh -t 90 -d "$c" "$@"
}

# all NAME OPTION...: runs all checks in DOSBox with these options; prints only failures and the count of checks.
all() {
    label=$1
    shift
    dos "$@" 'DTEST FREE > BEFORE.TXT' 'DTEST ALL > ALL.TXT' 'DTEST FREE > AFTER.TXT'
    tr -d '\r' < "$c/ALL.TXT" > "$scratch/all"
    grep '^FAIL ' "$scratch/all"
    good=$(grep -c '^ok ' "$scratch/all")
    failed=$((failed + $(grep -c '^FAIL ' "$scratch/all")))
    passed=$((passed + good))
    ok "$label: $good checks, to the end" has "$scratch/all" '# all well'
    ok "$label: free memory as before" cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"
}
all 'XMS, 16 MB' --
all 'XMS, 4 MB' -m 4 --
all 'XMS, 63 MB' -m 63 --
all 'dynamic core' -o cpu.core=dynamic --
all 'no EMS' -o dos.ems=false --
all 'no UMB' -o dos.umb=false --
all 'no XMS' -o dos.xms=false --
all 'no XMS, EMS, UMB' -o dos.xms=false -o dos.ems=false -o dos.umb=false --
all 'no XMS, EMS, UMB, 4 MB' -m 4 -o dos.xms=false -o dos.ems=false -o dos.umb=false --
all 'no XMS, EMS, UMB, 63 MB' -m 63 -o dos.xms=false -o dos.ems=false -o dos.umb=false --
all 'V86 mode, VCPI' -- V86
all 'V86 mode, VCPI, 4 MB' -m 4 -- V86
all 'V86 mode, VCPI, dynamic core' -o cpu.core=dynamic -- V86
all '386' -o cpu.cputype=386 --
all '486' -o cpu.cputype=486_slow --

# No timer interrupt may be lost while DOS and the host are called. At 50 kHz there are 800 instructions for each.
n=1000000
if [ "${1:-}" = quick ]; then
    n=20000
    shift
fi
host=${1:-}
dos -c 40000 -- "DTEST TICKS $n 24 > TICKS.TXT"
ran "$c/TICKS.TXT"
dos -c 40000 -- V86 "DTEST TICKS 20000 50 > TICKS.TXT"
ran "$c/TICKS.TXT"

# An end by an exception must leave text mode, a line that names the exception, an exit status, and all memory free.
crash() {
    how=$1
    text=$2
    shift 2
    dos "$@" 'DTEST FREE > BEFORE.TXT' cls "DTEST $how > OUT.TXT" "$E1" "if errorlevel 255 echo x > E255.TXT" \
        'DTEST SCREEN > SCREEN.TXT' 'DTEST FREE > AFTER.TXT' 'DTEST ALL > ALL.TXT'
    ok "$how: text mode" has "$c/SCREEN.TXT" 'mode 3'
    ok "$how: $text" has "$c/SCREEN.TXT" "$text"
    ok "$how: registers" has "$c/SCREEN.TXT" 'ss: sel='
    ok "$how: status 255" test -s "$c/E255.TXT"
    ok "$how: program did not go on" lacks "$c/OUT.TXT" FAIL
    ok "$how: free memory as before" cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"
    ok "$how: DOS goes on" has "$c/ALL.TXT" '# all well'
}
crash 'CRASH 0' 'Division by Zero at eip=' --
crash 'CRASH 6' 'Invalid Opcode at eip=' --
crash 'CRASH 13' 'General Protection Fault at eip=' --
crash 'CRASH 14' 'Page fault at eip=' --
crash 'CRASH S' ' at eip=' --
crash 'CRASH L' ' at eip=' --
crash 'CRASH L' ' at eip=' -o dos.xms=false -o dos.ems=false -o dos.umb=false --
crash 'CRASH L' ' at eip=' -- V86
crash 'CRASH R' 'Page fault at eip=' --
crash 'CRASH 14' 'Page fault at eip=' -o cpu.core=dynamic --
crash 'CRASH 14' 'Page fault at eip=' -- V86
crash 'CRASH 0' 'Division by Zero at eip=' -- V86
crash 'CRASH H' 'General Protection Fault at eip=' --
crash 'CRASH H' 'General Protection Fault at eip=' -- V86
crash BREAK 'Control-C Pressed at eip=' --
crash BREAK 'Control-C Pressed at eip=' -- V86
dos -- 'DTEST CATCH > CATCH.TXT' V86 'DTEST CATCH > CATCH86.TXT'
ran "$c/CATCH.TXT"
ok 'CATCH: to its end' has "$c/CATCH.TXT" 'ok 0205 given back'
ok 'CATCH in V86 mode: to its end' has "$c/CATCH86.TXT" 'ok 0205 given back'

# Fifty programs in a row
set -- 'DTEST FREE > BEFORE.TXT'
i=0
while [ $i -lt 50 ]; do
    set -- "$@" 'DTEST FREE > AFTER.TXT'
    i=$((i + 1))
done
dos -- "$@"
ok 'fifty in a row: free memory as before' cmp "$c/BEFORE.TXT" "$c/AFTER.TXT"
ok 'fifty in a row: some free memory' has "$c/AFTER.TXT" 'extended 1'

# Load errors
head -c "$(wc -c < build/STUB.EXE)" build/DTEST.EXE > "$c/EMPTY.EXE"
head -c 20000 build/DTEST.EXE > "$c/SHORT.EXE"
dos -- cls EMPTY "$E1" "$E2" 'DTEST SCREEN > SCREEN.TXT'
ok 'no program behind the stub: a line' has "$c/SCREEN.TXT" 'Load error: C:\EMPTY.EXE: no COFF program'
ok 'no program behind the stub: status 1' status 1 "$c"
dos -- cls SHORT "$E1" "$E2" 'DTEST SCREEN > SCREEN.TXT'
ok 'program cut short: a line' has "$c/SCREEN.TXT" 'Load error: C:\SHORT.EXE: file is cut short'
ok 'program cut short: status 1' status 1 "$c"
dos -m 1 -- cls DTEST "$E1" "$E2"
ok 'no memory: status 1' status 1 "$c"

# Another host is loaded first. (Wild pointers are left out: they end DOSBox under any host but the stub's.)
if [ -n "$host" ]; then
    cp "$host" "$c/HOST.EXE"
    cp build/DEMO.EXE "$c"
    dos -- 'HOST -p' 'DTEST GOOD NOWILD > ALL.TXT' 'DTEST FREE > FREE.TXT' 'DEMO /N:5 > DEMO.TXT'
    ran "$c/ALL.TXT"
    ok 'another host: the demo' has "$c/DEMO.TXT" 'seeds: 2496'
fi

# The mouse driver's call-back is called, and is removed at the end of the program
if startDisplay; then
    rm -f "$c"/*.TXT
    tools/dosbox.sh -w -c 20000 -t 60 -d "$c" -- 'DTEST MOUSE 20 > MOUSE.TXT' 'DTEST ALL > ALL.TXT' &
    running=$!
    if awaitTitle DTEST; then
        xdotool mousemove --window "$dosWindow" 300 200 sleep 0.3 mousedown 1 sleep 0.2 mouseup 1 sleep 0.5 2> /dev/null
        for i in 1 2 3 4 5 6 7 8; do
            xdotool mousemove_relative -- 8 -4 sleep 0.1 2> /dev/null
        done
        for i in 1 2 3 4 5 6 7 8; do
            xdotool mousemove_relative -- -8 4 sleep 0.1 2> /dev/null
        done
    fi
    wait $running
    ran "$c/MOUSE.TXT"
    ok 'afterwards all is well' has "$c/ALL.TXT" '# all well'
else
    echo '# no Xvfb and xdotool: the mouse driver was not tried'
fi

summary
