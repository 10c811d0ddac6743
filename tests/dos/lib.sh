# What the test scripts of this folder share; they read it with `.`. From the top of the tree.

passed=0
failed=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/fbdos.XXXXXX")
xvfb=

cleanup() {
    [ -z "$xvfb" ] || kill "$xvfb" 2> /dev/null || :
    rm -rf "$scratch"
}
trap cleanup EXIT
trap 'exit 130' INT TERM HUP

# ok NAME COMMAND...: one check; it passes when the command does.
ok() {
    name=$1
    shift
    if "$@"; then
        echo "ok $name"
        passed=$((passed + 1))
    else
        echo "FAIL $name"
        failed=$((failed + 1))
    fi
}

# ran FILE: the lines `ok` and `FAIL` that a DOS program printed, as checks of ours.
ran() {
    if [ ! -s "$1" ]; then
        ok "output in $(basename "$1")" false
        return
    fi
    tr -d '\r' < "$1" > "$scratch/ran"
    cat "$scratch/ran"
    passed=$((passed + $(grep -c '^ok ' "$scratch/ran")))
    failed=$((failed + $(grep -c '^FAIL ' "$scratch/ran")))
}

# has FILE TEXT: a line of FILE contains TEXT.
has() {
    grep -q -F -- "$2" "$1" 2> /dev/null
}

# lacks FILE TEXT: FILE is there and no line of it contains TEXT.
lacks() {
    [ -f "$1" ] && ! grep -q -F -- "$2" "$1"
}

# status N DIR: the program that wrote E1.TXT... of levels() ended with status N. (IF ERRORLEVEL asks for "at least", and a
# redirection makes its file whether or not the line is done.)
status() {
    n=$1
    dir=$2
    below=$((n + 1))
    [ "$n" = 0 ] || [ -s "$dir/E$n.TXT" ] || return 1
    [ -f "$dir/E$below.TXT" ] && [ ! -s "$dir/E$below.TXT" ]
}

# The command lines that leave what status() reads; as arguments for dosbox.sh.
E1='if errorlevel 1 echo x > E1.TXT'
E2='if errorlevel 2 echo x > E2.TXT'
E3='if errorlevel 3 echo x > E3.TXT'

# Starts an X server without a screen, for programs in a window; DISPLAY says where. False when there is none.
startDisplay() {
    command -v Xvfb > /dev/null && command -v xdotool > /dev/null || return 1
    Xvfb -displayfd 3 -screen 0 800x600x24 3> "$scratch/display" > /dev/null 2>&1 &
    xvfb=$!
    tries=0
    while [ ! -s "$scratch/display" ] && [ $tries -lt 100 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
    [ -s "$scratch/display" ] || return 1
    DISPLAY=:$(cat "$scratch/display")
    export DISPLAY
    # It answers before it is ready for all.
    sleep 2
}

# awaitTitle TEXT: until DOSBox's window says that program TEXT runs, then until it had time to get going. The window's
# number is in $dosWindow.
awaitTitle() {
    tries=0
    dosWindow=
    while [ -z "$dosWindow" ] && [ $tries -lt 100 ]; do
        dosWindow=$(xdotool search --name "Program: *$1" 2> /dev/null | head -n 1)
        [ -n "$dosWindow" ] || sleep 0.1
        tries=$((tries + 1))
    done
    [ -n "$dosWindow" ] || return 1
    sleep 1.5
}

summary() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}
