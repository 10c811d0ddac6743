#!/bin/sh
# The page that plays (`make web`), first as files, then in a headless browser (tests/web/webtest.js). What the browser's
# part needs is installed by `sh tools/setup.sh web`; where npm or a browser cannot be had, a line says so and only what
# was tried is counted.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

# ---- What needs nothing from outside
page=tools/web/page.js
# The same machines and figures as in the benchmark.
sed -n 's/.*name: "\([^"]*\)", cycles: \([0-9]*\), report: \([a-z0-9.]*\) .*/\2 \3 \1/p' $page |
	sed 's/ null / 0 /' >"$dir/machines"
ok 'five machines' test "$(wc -l <"$dir/machines")" -eq 5
while read -r line; do
	ok "the benchmark has $line" grep -q "^[[:space:]]*$line\$" tools/bench.sh
done <"$dir/machines"
ok 'js-dos is not kept with the source' sh -c "! git ls-files 2>/dev/null | grep -i -E 'js-dos|wdosbox|emulators|node_modules'"
ok 'the page may load nothing from elsewhere' sh -c "grep -q \"default-src 'self'\" tools/web/index.html &&
	! grep -n -E '(src|href)=\"(https?:)?//' tools/web/index.html | grep -v '<a href'"

# ---- The page
without() {
	echo "# NOT TRIED in a browser: $1"
	summary
	exit
}
command -v npm >/dev/null || without 'npm is not installed (sh tools/setup.sh web)'
if ! timeout 300 make -s web >"$dir/make" 2>&1; then
	# Only npm's part may fail.
	grep -q '^web.sh: npm cannot fetch' "$dir/make" && without 'npm cannot fetch js-dos'
	tail -n 30 "$dir/make"
	ok 'make web' false
	summary
	exit 1
fi
for file in index.html page.css page.js DEMO.EXE RUN.COM FBLOBS.ZIP \
	emulators/emulators.js emulators/wdosbox.js emulators/wdosbox.wasm; do
	ok "build/web has $file" test -s "build/web/$file"
done
ok 'its DEMO.EXE is the one built' cmp build/DEMO.EXE build/web/DEMO.EXE
ok 'nothing is left to fill in' sh -c "! grep -n '@[A-Z]*@' build/web/index.html"
for scene in tools/scenes/*.FB; do
	ok "its $(basename "$scene")" cmp "$scene" "build/web/scenes/$(basename "$scene")"
done
# RUN.COM, without which the page would not hear what is wrong.
if command -v dosbox >/dev/null; then
	mkdir "$dir/c"
	cp build/DEMO.EXE build/web/RUN.COM "$dir/c"
	tools/dosbox.sh -d "$dir/c" -- 'RUN /N:2 > GOOD.TXT' 'RUN /S:9 > BAD.TXT' 'if errorlevel 2 echo x > TWO.TXT' \
		'if errorlevel 3 echo x > THREE.TXT' >"$dir/said" 2>&1
	ok 'RUN.COM: statistics' grep -q '^frames: 2' "$dir/c/GOOD.TXT"
	ok 'RUN.COM: the message on standard error' grep -q '^/S:9: ' "$dir/c/BAD.TXT"
	ok "RUN.COM: the program's own exit status" sh -c "test -s '$dir/c/TWO.TXT' && ! test -s '$dir/c/THREE.TXT'"
else
	echo "# no dosbox: RUN.COM not tried"
fi

browser=$(command -v chromium || command -v google-chrome) || without 'no browser is installed (sh tools/setup.sh web)'
[ -f build/npm/node_modules/puppeteer-core/package.json ] || without 'puppeteer-core is not installed (sh tools/setup.sh web)'
timeout 900 node tests/web/webtest.js "$browser" >"$dir/out" 2>&1
count "$dir/out"
summary
