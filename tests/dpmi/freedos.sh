#!/bin/sh
# Tests the DPMI host on FreeDOS in an emulated PC. No Debian package contains FreeDOS, so this is not part of `make test`: it
# needs a bootable floppy image (720 KB or 1.44 MB) with KERNEL.SYS, COMMAND.COM and some 350 KB free, and uses a copy of it.
#
#   tests/dpmi/freedos.sh FLOPPY.IMG [FILE.EXE...]
#
# A boot may take FB_BOOT_SECONDS of processor time (180) and ten times that by the clock. A boot that takes more, or that the
# emulator ends, is one failure; its line names the command that ran. Checks that were not reached are not judged.
#
# A FILE may be a driver (HIMEMX, JEMM386, JEMMEX: loaded by CONFIG.SYS, one at a time, JEMM386 behind HIMEMX) or another
# DPMI host that stays resident with -p (CWSDPMI). Needs qemu-system-x86 and mtools.
set -u
. tests/dos/lib.sh

[ $# -ge 1 ] && [ -f "$1" ] || {
    sed -n '/^#   tests/p' "$0" >&2
    exit 2
}
for tool in qemu-system-i386 mcopy; do
    command -v $tool > /dev/null || {
        echo "freedos.sh: $tool is missing (Debian: apt-get install qemu-system-x86 mtools)" >&2
        exit 1
    }
done
make -s build/DTEST.EXE build/DEMO.EXE || exit 1
floppy=$1
shift
a=$scratch/a.img
MTOOLS_SKIP_CHECK=1
export MTOOLS_SKIP_CHECK
# OUT F4h, AL; HLT: ends the emulator
printf '\260\000\272\364\000\356\364' > "$scratch/QUIT.COM"
drivers=
files=

seconds=${FB_BOOT_SECONDS:-180}

# run NAME CPU MB COMMAND...: boots, runs the commands, and leaves the output files in $scratch. The clock counts instructions,
# so that timer interrupts are on time even if the real machine is busy. If the commands did not all finish, it prints a line
# that says what happened, and fails.
run() {
    boot=$1
    cpu=$2
    memory=$3
    shift 3
    rm -f "$scratch"/*.TXT
    cp "$floppy" "$a"
    chmod u+w "$a"
    mdel -i "$a" ::README.TXT > /dev/null 2>&1
    {
        for driver in $drivers; do
            printf 'DEVICE=A:\\%s\r\n' "$driver"
        done
        printf 'SWITCHES=/N\r\nDOS=HIGH\r\nFILES=20\r\nSHELL=A:\\COMMAND.COM /E:512 /P\r\n'
    } > "$scratch/CONFIG.SYS"
    {
        printf '@ECHO OFF\r\n'
        step=0
        for line in "$@"; do
            step=$((step + 1))
            printf 'ECHO %d > AT.TXT\r\n%s\r\n' "$step" "$line"
        done
        printf 'QUIT\r\n'
    } > "$scratch/AUTOEXEC.BAT"
    # shellcheck disable=SC2086
    mcopy -o -i "$a" "$scratch/CONFIG.SYS" "$scratch/AUTOEXEC.BAT" "$scratch/QUIT.COM" build/DTEST.EXE build/DEMO.EXE \
        $files ::/ > "$scratch/said" 2>&1 || {
        echo "FAIL $boot: the floppy cannot take the programs"
        sed 's/^/  /' "$scratch/said"
        failed=$((failed + 1))
        return 1
    }
    (
        ulimit -t "$seconds"
        exec timeout "$((10 * seconds))" nice qemu-system-i386 -cpu "$cpu" -m "$memory" -icount shift=4 -display none \
            -serial none -monitor none -no-reboot -drive "file=$a,format=raw,if=floppy" -boot a \
            -device isa-debug-exit,iobase=0xf4,iosize=1
    ) > "$scratch/said" 2>&1
    status=$?
    mcopy -n -i "$a" '::/*.TXT' "$scratch" > /dev/null 2>&1
    [ $status -ne 1 ] || return 0 # what QUIT asks for
    at=$(tr -cd '0-9' < "$scratch/AT.TXT" 2> /dev/null)
    if [ -n "$at" ] && [ "$at" -gt 0 ] && [ "$at" -le $# ]; then
        shift $((at - 1))
        at="at: $1"
    else
        at='DOS had not started'
    fi
    case $status in
        124) why="no end in $((10 * seconds)) s by the clock" ;;
        137 | 152) why="no end in $seconds s of the processor's time" ;;
        *) why="the emulator ended with status $status" ;;
    esac
    echo "FAIL $boot: $why; $at"
    sed 's/^/  /' "$scratch/said"
    failed=$((failed + 1))
    return 1
}

# all NAME CPU MB: tests every service, a page fault, stack overflows, Ctrl-C, timer interrupts, and the demo
all() {
    label=$1
    run "$label" "$2" "$3" 'DTEST FREE > BEFORE.TXT' CLS 'DTEST CRASH 14' 'DTEST SCREEN > CRASH.TXT' CLS 'DTEST CRASH S' \
        'DTEST SCREEN > OVER.TXT' CLS 'DTEST CRASH L' 'DTEST SCREEN > FRAMES.TXT' CLS 'DTEST CRASH R' \
        'DTEST SCREEN > RETURNS.TXT' CLS 'DTEST CRASH H' 'DTEST SCREEN > HOST.TXT' CLS 'DTEST BREAK' \
        'DTEST SCREEN > BREAK.TXT' 'DTEST CATCH > CATCH.TXT' 'DTEST TICKS 10000 400 > TICKS.TXT' 'DTEST ALL > ALL.TXT' \
        'DEMO /N:5 > DEMO.TXT' 'DTEST FREE > AFTER.TXT' || return
    tr -d '\r' < "$scratch/ALL.TXT" > "$scratch/all"
    grep '^FAIL ' "$scratch/all"
    good=$(grep -c '^ok ' "$scratch/all")
    failed=$((failed + $(grep -c '^FAIL ' "$scratch/all")))
    passed=$((passed + good))
    ok "$label: $good checks, to the end" has "$scratch/all" '# all well'
    ok "$label: wild pointer" has "$scratch/CRASH.TXT" 'Page fault at eip='
    ok "$label: stack overflow" has "$scratch/OVER.TXT" ' at eip='
    ok "$label: stack overflow with large frames" has "$scratch/FRAMES.TXT" ' at eip='
    ok "$label: an exception handler that returns" has "$scratch/RETURNS.TXT" 'Page fault at eip='
    ok "$label: a fault in the host" has "$scratch/HOST.TXT" 'General Protection Fault at eip='
    ok "$label: Ctrl-C" has "$scratch/BREAK.TXT" 'Control-C Pressed at eip='
    ok "$label: Ctrl-C at a program that has the keyboard" has "$scratch/CATCH.TXT" 'ok 0205 given back'
    ok "$label: timer interrupts" has "$scratch/TICKS.TXT" 'ok 10000 timer'
    ok "$label: the demo" has "$scratch/DEMO.TXT" 'seeds: 2496'
    ok "$label: free memory as before" cmp "$scratch/BEFORE.TXT" "$scratch/AFTER.TXT"
}
all '486, 16 MB' 486 16
all '486, 4 MB' 486 4
all 'Pentium, 64 MB' pentium 64
himem=
for file in "$@"; do
    exe=$(basename "$file" | tr a-z A-Z)
    cp "$file" "$scratch/$exe"
    files=$scratch/$exe
    case $exe in
        HIMEM*) himem=$scratch/$exe ;;
        JEMM386*) files="$himem $files" ;;
    esac
    case $exe in
        HIMEM*|JEMM*)
            drivers=
            for f in $files; do
                drivers="$drivers $(basename "$f")"
            done
            all "$exe, 486, 16 MB" 486 16
            all "$exe, Pentium, 64 MB" pentium 64
            drivers=
            ;;
        *)
            run "$exe" pentium 16 "$exe -p" 'DTEST GOOD > ALL.TXT' 'DEMO /N:5 > DEMO.TXT' || continue
            tr -d '\r' < "$scratch/ALL.TXT" > "$scratch/all"
            grep '^FAIL ' "$scratch/all"
            ok "$exe: $(grep -c '^ok ' "$scratch/all") checks, to the end" has "$scratch/all" '# all well'
            ok "$exe: the demo" has "$scratch/DEMO.TXT" 'seeds: 2496'
            ;;
    esac
    files=
done
summary
