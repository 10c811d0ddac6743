#!/bin/sh
# Tests of the picture tools: the test's own decoder reads what mkgif and ppm2png write, and compares it with the frames from
# which it was made. Run it from the top of the tree. The last line is "N passed, N failed".
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh
build -f tools/pics.mk build/mkgif build/ppm2png build/picstst

gif=build/mkgif png=build/ppm2png test=build/picstst
says() { # says TEXT COMMAND...: ends with 2 and one line that has the text
	text=$1
	shift
	"$@" >/dev/null 2>"$dir/error"
	[ $? -eq 2 ] && grep -qF -- "$text" "$dir/error" && [ "$(wc -l <"$dir/error")" -eq 1 ]
}

mkdir "$dir/f"
$test make "$dir/f" || exit 1
# Frames 0 to 5 have 256 greys together, so one exact palette is possible.
ok "greys" $gif --to 5 "$dir/a.gif" "$dir/f"
ok "greys read back" $test gif "$dir/a.gif" "$dir/f" 1 - 0 10 0 1 2 3 4 5
$gif --to 5 --43 --delay 7 "$dir/a.gif" "$dir/f" >"$dir/log"
ok "said to be exact, and how large" grep -q ": 6 frames, 320x240, .* exact" "$dir/log"
ok "4:3 and delay" $test gif "$dir/a.gif" "$dir/f" 1 43 0 7 0 1 2 3 4 5
ok "twice as large" $gif --from 1 --to 2 --scale 2 --43 "$dir/a.gif" "$dir/f"
ok "twice as large read back" $test gif "$dir/a.gif" "$dir/f" 2 43 0 10 1 2
ok "every second" $gif --from 1 --to 5 --every 2 "$dir/a.gif" "$dir/f"
ok "every second read back" $test gif "$dir/a.gif" "$dir/f" 1 - 0 10 1 3 5
ok "one frame of one colour" $gif --to 0 "$dir/a.gif" "$dir/f"
ok "one frame of one colour read back" $test gif "$dir/a.gif" "$dir/f" 1 - 0 10 0
# Frame 7 has 256 colours of its own, and the frames together have more: the colours must still be exact.
ok "a palette for each" $gif --from 3 --to 7 --every 4 "$dir/a.gif" "$dir/f"
ok "a palette for each read back" $test gif "$dir/a.gif" "$dir/f" 1 - 0 10 3 7
ok "too many colours" $gif --from 6 --to 6 "$dir/a.gif" "$dir/f"
ok "too many colours read back" $test gif "$dir/a.gif" "$dir/f" 1 - 31 10 6
for n in 0 1 3 6 7; do
	ok "png of frame $n" $png "$dir/f/F000000$n.PPM" "$dir/a.png"
	ok "png of frame $n read back" $test png "$dir/a.png" "$dir/f/F000000$n.PPM" 1 -
done
ok "large png" $png --scale 3 --43 "$dir/f/F0000001.PPM" "$dir/a.png"
ok "large png read back" $test png "$dir/a.png" "$dir/f/F0000001.PPM" 3 43
# The decoder itself must notice damage.
ok "small png" $png "$dir/f/F0000001.PPM" "$dir/a.png"
printf '\125' | dd of="$dir/a.png" bs=1 seek=2000 conv=notrunc 2>/dev/null
ok "a damaged png is noticed" sh -c "! $test png '$dir/a.png' '$dir/f/F0000001.PPM' 1 -"
$gif --to 2 "$dir/a.gif" "$dir/f" >/dev/null
ok "another frame is noticed" sh -c "! $test gif '$dir/a.gif' '$dir/f' 1 - 0 10 0 2 2"
# Errors give one line and status 2.
ok "no directory" says "$dir/none" $gif "$dir/a.gif" "$dir/none"
ok "no frames" says "no frames" $gif --from 50 "$dir/a.gif" "$dir/f"
ok "unwritable gif" says "cannot be written" $gif "$dir/none/a.gif" "$dir/f"
ok "bad delay" says "--delay wants" $gif --delay x "$dir/a.gif" "$dir/f"
ok "unknown option" says "--frob" $gif --frob "$dir/a.gif" "$dir/f"
ok "no arguments" says "usage" $gif
ok "no picture" says "no P6" $png tools/pics.mk "$dir/a.png"
ok "unwritable png" says "cannot be written" $png "$dir/f/F0000000.PPM" "$dir/none/a.png"
ok "no arguments to ppm2png" says "usage" $png
summary
