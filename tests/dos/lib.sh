# Functions that the test scripts of this folder share beyond tests/lib.sh. They source it with `.` from the top of the tree.
. tests/lib.sh

scratch=$dir
xvfb=
trap '[ -z "$xvfb" ] || kill "$xvfb" 2> /dev/null; rm -rf "$scratch"' EXIT

# dos [OPTION...] -- COMMAND...: runs tools/dosbox.sh in directory $c. The command in FB_FIRST runs first (for example
# `CWSDPMI -p`, to test with another DPMI host).
dos() {
    options=
    while [ "$1" != -- ]; do
        options="$options $1"
        shift
    done
    shift
    # shellcheck disable=SC2086  # options are words
    tools/dosbox.sh -t 120 -d "$c" $options -- ${FB_FIRST:+"$FB_FIRST"} "$@"
}

# floppy FILE: makes an image of an empty 160 KB floppy, with a boot sector and two empty FATs.
floppy() {
    dd if=/dev/zero of="$1" bs=1024 count=160 2> /dev/null
    {
        printf '\353\074\220FASTBLOB\000\002\001\001\000\002\100\000\100\001\376\001\000\010\000\001\000'
        dd if=/dev/zero bs=1 count=482 2> /dev/null
        printf '\125\252\376\377\377'
    } | dd of="$1" conv=notrunc 2> /dev/null
    printf '\376\377\377' | dd of="$1" bs=512 seek=2 conv=notrunc 2> /dev/null
}

# ran FILE: counts the lines `ok` and `FAIL` that a DOS program printed as checks of this test.
ran() {
    if [ ! -s "$1" ]; then
        ok "output in $(basename "$1")" false
        return
    fi
    tr -d '\r' < "$1" > "$scratch/ran"
    cat "$scratch/ran"
    grep -q -e '^ok ' -e '^FAIL ' "$scratch/ran" || ok "checks in $(basename "$1")" false
    passed=$((passed + $(grep -c '^ok ' "$scratch/ran")))
    failed=$((failed + $(grep -c '^FAIL ' "$scratch/ran")))
}

# has FILE TEXT: succeeds if a line of FILE contains TEXT.
has() {
    grep -q -F -- "$2" "$1" 2> /dev/null
}

# lacks FILE TEXT: succeeds if FILE exists and no line of it contains TEXT.
lacks() {
    [ -f "$1" ] && ! grep -q -F -- "$2" "$1"
}

# status N DIR: succeeds if the program before the lines $E1... ended with status N. (IF ERRORLEVEL means "at least", and a
# redirection makes its file even if the line is not executed.)
status() {
    above=$(($1 + 1))
    [ "$1" = 0 ] || [ -s "$2/E$1.TXT" ] || return 1
    [ -f "$2/E$above.TXT" ] && [ ! -s "$2/E$above.TXT" ]
}

# Command lines that write the files which status() reads; a status of N needs $E1 to $E(N+1).
E1='if errorlevel 1 echo x > E1.TXT'
E2='if errorlevel 2 echo x > E2.TXT'
E3='if errorlevel 3 echo x > E3.TXT'

# Starts an X server without a screen for programs in a window, and sets DISPLAY. Fails if there is no such server.
startDisplay() {
    command -v Xvfb > /dev/null && command -v xdotool > /dev/null || return 1
    Xvfb -noreset -displayfd 3 -screen 0 800x600x24 3> "$scratch/display" > /dev/null 2>&1 &
    xvfb=$!
    tries=0
    while [ ! -s "$scratch/display" ] && [ $tries -lt 100 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
    [ -s "$scratch/display" ] || return 1
    DISPLAY=:$(cat "$scratch/display")
    export DISPLAY
    # The server answers before it is ready for everything.
    sleep 2
}

# awaitTitle TEXT: waits until the title of DOSBox's window shows program TEXT, and then until the program is ready. Sets
# $dosWindow to the window's number.
awaitTitle() {
    tries=0
    dosWindow=
    while [ -z "$dosWindow" ] && [ $tries -lt 300 ]; do
        dosWindow=$(xdotool search --name "Program: *$1" 2> /dev/null | head -n 1)
        [ -n "$dosWindow" ] || sleep 0.1
        tries=$((tries + 1))
    done
    [ -n "$dosWindow" ] || return 1
    sleep 1.5
}
