#!/bin/sh
# The DPMI host on FreeDOS in an emulated PC. FreeDOS is in no Debian package, so this is not part of `make test`: it takes a
# bootable floppy image of 1.44 MB with KERNEL.SYS and COMMAND.COM and some 200 KB free, and uses a copy of it.
#
#   tests/dpmi/freedos.sh FLOPPY.IMG [FILE.EXE...]
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
# OUT F4h, AL; HLT: the emulator's exit
printf '\260\000\272\364\000\356\364' > "$scratch/QUIT.COM"
drivers=
files=

# run CPU MB COMMAND...: boots, runs, leaves the output files in $scratch. The clock counts instructions, so that no timer
# interrupt is late because the machine under the emulator is busy.
run() {
    cpu=$1
    memory=$2
    shift 2
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
        for line in "$@"; do
            printf '%s\r\n' "$line"
        done
        printf 'QUIT\r\n'
    } > "$scratch/AUTOEXEC.BAT"
    # shellcheck disable=SC2086
    mcopy -o -i "$a" "$scratch/CONFIG.SYS" "$scratch/AUTOEXEC.BAT" "$scratch/QUIT.COM" build/DTEST.EXE build/DEMO.EXE \
        $files ::/ || return 1
    timeout 180 nice qemu-system-i386 -cpu "$cpu" -m "$memory" -icount shift=4 -display none -serial none -monitor none \
        -no-reboot -drive "file=$a,format=raw,if=floppy" -boot a -device isa-debug-exit,iobase=0xf4,iosize=1
    rm -f "$scratch"/*.TXT
    mcopy -n -i "$a" '::/*.TXT' "$scratch" > /dev/null 2>&1
}

# all NAME CPU MB: every service, a page fault, Ctrl-C, timer interrupts, the demo
all() {
    label=$1
    run "$2" "$3" 'DTEST FREE > BEFORE.TXT' CLS 'DTEST CRASH 14' 'DTEST SCREEN > CRASH.TXT' CLS 'DTEST CRASH S' \
        'DTEST SCREEN > OVER.TXT' CLS 'DTEST BREAK' 'DTEST SCREEN > BREAK.TXT' 'DTEST TICKS 10000 400 > TICKS.TXT' \
        'DTEST ALL > ALL.TXT' 'DEMO /N:5 > DEMO.TXT' 'DTEST FREE > AFTER.TXT'
    tr -d '\r' < "$scratch/ALL.TXT" > "$scratch/all"
    grep '^FAIL ' "$scratch/all"
    good=$(grep -c '^ok ' "$scratch/all")
    failed=$((failed + $(grep -c '^FAIL ' "$scratch/all")))
    passed=$((passed + good))
    ok "$label: $good checks, to the end" has "$scratch/all" '# all well'
    ok "$label: wild pointer" has "$scratch/CRASH.TXT" 'Page fault at eip='
    ok "$label: stack overflow" has "$scratch/OVER.TXT" ' at eip='
    ok "$label: Ctrl-C" has "$scratch/BREAK.TXT" 'Control-C Pressed at eip='
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
            run pentium 16 "$exe -p" 'DTEST GOOD > ALL.TXT' 'DEMO /N:5 > DEMO.TXT'
            tr -d '\r' < "$scratch/ALL.TXT" > "$scratch/all"
            grep '^FAIL ' "$scratch/all"
            ok "$exe: $(grep -c '^ok ' "$scratch/all") checks, to the end" has "$scratch/all" '# all well'
            ok "$exe: the demo" has "$scratch/DEMO.TXT" 'seeds: 2496'
            ;;
    esac
    files=
done
summary
