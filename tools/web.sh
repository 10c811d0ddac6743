#!/bin/sh
# Puts the page that plays DEMO.EXE together in build/web (`make web`): the texts of tools/web, the program, the scenes
# with their pictures, the zip, and the emulator, js-dos, fetched by npm and never kept with the source.
set -eu
cd "$(dirname "$0")/.." || exit 1

version=8.4.1
# What npm says of the package, so that a page never holds anything else.
sum=sha512-rnFHQ/XFfodmmOFABNW7rql5K/qQTfKoCgkEJTKatLLIrB80mhUVZxxkwA7MbXLCRp54kbrhkhJLbPOxkLIktg==
to=build/web
package=build/npm/js-dos-$version.tgz
fetch=build/npm/js-dos-$version
if [ ! -f "$fetch/package.json" ]; then
	command -v npm >/dev/null || {
		echo "web.sh: npm is not installed (sh tools/setup.sh page)" >&2
		exit 1
	}
	mkdir -p build/npm
	(cd build/npm && npm pack --silent "js-dos@$version" >/dev/null) || {
		echo "web.sh: npm cannot fetch js-dos $version" >&2
		exit 1
	}
	is=sha512-$(node -p '
		require("crypto").createHash("sha512").update(require("fs").readFileSync(process.argv[1])).digest("base64")' "$package")
	[ "$is" = "$sum" ] || {
		echo "web.sh: js-dos $version is not the package that was tried: $is" >&2
		exit 1
	}
	rm -rf "$fetch" && mkdir "$fetch" && tar -xzf "$package" -C "$fetch" --strip-components=1
fi

mkdir -p $to/emulators $to/pics
rm -rf $to/scenes && mkdir $to/scenes
for file in emulators.js wdosbox.js wdosbox.wasm; do
	cp "$fetch/dist/emulators/$file" $to/emulators/
done
cp build/DEMO.EXE build/release/FBLOBS.ZIP tools/web/page.css tools/web/page.js $to/
cp tools/scenes/*.FB $to/scenes/
sh tools/picture.sh scenes $to/pics

# A button for each scene, the report's first. Its words are the scene's title, or else those at its head up to the first
# stop.
list=$to/scenes.tmp
for file in tools/scenes/FOUR.FB $(ls tools/scenes/*.FB | grep -v /FOUR.FB); do
	name=$(basename "$file" .FB)
	words=$(sed -n 's/^title  *//p' "$file" | head -n 1)
	[ -n "$words" ] || words=$(sed -n '1s/^# *\([^.:,]*\).*/\1/p' "$file")
	picture=$(echo "$name" | tr '[:upper:]' '[:lower:]').png
	echo "<button type=\"button\" data-scene=\"$name\">" \
		"<img src=\"pics/$picture\" alt=\"\" width=\"320\" height=\"240\">$words</button>"
done >$list
licence=$(sed -n 's/.*"license": *"\([^"]*\)".*/\1/p' "$fetch/package.json")
sed -e "/@SCENES@/{s/@SCENES@.*//;r $list" -e 'a </div>' -e '}' \
	-e "s/@JSDOS@/$version/" -e "s/@JSDOSLICENCE@/$licence/" \
	-e "s/@EXESIZE@/$(wc -c <build/DEMO.EXE | tr -d ' ')/" -e "s/@ZIPSIZE@/$(wc -c <build/release/FBLOBS.ZIP | tr -d ' ')/" \
	tools/web/index.html >$to/index.html
rm $list
echo "build/web: $(find $to -type f | wc -l) files, $(du -sk $to | cut -f 1) KB"
