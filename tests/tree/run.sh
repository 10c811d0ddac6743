#!/bin/sh
# What holds for the tree and for DEMO.EXE as a whole, whatever the program does: names that plain DOS can unpack, what
# the program may use, which instructions are in it, how large it is.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/lib.sh

build build/DEMO.EXE
elf=build/dos/DEMO.EXE.elf

# none WHAT...: the command prints nothing.
none() {
	"$@" >"$dir/found" 2>&1
	[ ! -s "$dir/found" ] || {
		cat "$dir/found"
		false
	}
}
# The files of the tree: what git knows, or everything where the tree came without it.
if git rev-parse --git-dir >/dev/null 2>&1; then
	git ls-files >"$dir/files"
else
	find . -name .git -prune -o -path ./build -prune -o -type f -print | sed 's|^\./||' >"$dir/files"
fi
ok "there are files" test "$(wc -l <"$dir/files")" -gt 50

ok "the top level" none sh -c "sed 's|/.*||' '$dir/files' | sort -u |
	grep -v -x -e '\..*' -e src -e include -e asm -e tests -e tools -e Makefile -e Makefile.djgpp -e README.md -e LICENSE"
ok "8.3 names in lower case" none sh -c "grep -E '^(src|include|asm)/' '$dir/files' | tr / '\n' | sort -u |
	grep -v -x -E '[a-z0-9_]{1,8}(\.([a-z0-9]{1,3}|S))?|README\.md'"
ok "no two names that DOS takes for one" none sh -c "tr A-Z a-z <'$dir/files' | sort | uniq -d"
ok "no places of one machine" none sh -c "grep -E '\.(cpp|h|S|sh|mk|md|ld|yml|djgpp)\$|Makefile' '$dir/files' |
	xargs grep -n -E '(^|[^[:alnum:]_.])[/](work|opt|home|root)[/]'"

# Lines are at most 132 columns wide, but for pages, pictures, and files whose lines cannot be broken.
wide() {
	grep -E '^(src|include|asm|tests|tools)/|^Makefile' "$dir/files" |
		grep -v -E '\.(md|png|gif)$|^tests/mutants/faults\.txt$|^tools/web/index\.html$' | while read -r file; do
		LC_ALL=C.UTF-8 awk -v file="$file" 'length > 132 { print file ":" FNR ": " length " columns" }' "$file"
	done
}
ok "no line over 132 columns" none wide

# Every file says at its head why it is there.
headless() {
	grep -E '^(src|include|asm|tests|tools)/.*\.(cpp|h|S|sh|mk|ld)$' "$dir/files" | while read -r file; do
		case $(head -n 2 "$file" | grep -v '^#!' | head -n 1) in
		//* | /\** | '#'\ * | '# '*) ;;
		*) echo "$file" ;;
		esac
	done
}
ok "a comment at the head of each file" none headless

# The program uses no library but what include/rt.h names, and neither exceptions nor RTTI.
ok "no C++ library in the program" none sh -c "grep -E '^(src|include)/' '$dir/files' | grep -v '^src/host/' |
	xargs grep -n '#include <' | grep -v -E '<(stdint|stddef|stdarg)\.h>' | grep -v '^include/rt.h:' | grep -v '^src/dos/'"
ok "no exceptions, no RTTI" none sh -c "grep -E '^(src|include)/.*\.(cpp|h)\$' '$dir/files' |
	xargs grep -n -E '(^|[^[:alnum:]_])(throw[ ;(]|try *[{]|catch *[(]|dynamic_cast<|typeid *[(])'"
# Only src/dos and src/rt know DOS.
ok "no DOS outside its place" none sh -c "grep -E '^(src/(math|model|surface|picture|app|host)/.*|include/.*)\$' '$dir/files' |
	xargs grep -n -i -E 'int +[\$]0x|go32|__dpmi|dpmi\.h|<dos\.h>'"

# ---- The rooms

# A room includes its own headers and those of the rooms before it. What is for the machine (dos, host, rt, and the headers
# machine.h and rt.h) includes nothing of a room; dos and rt include headers of each other.
rooms='math model surface picture app'
below() {
	grep -E '^(src|include)/[a-z]+/.*\.(cpp|h)$|^include/(machine|rt)\.h$' "$dir/files" | while read -r file; do
		room=${file#*/}
		room=${room%%/*}
		# The folders that this one may not use: all rooms for the machine, else those behind it, and the machine's.
		case " $rooms " in
		*" $room "*) barred="${rooms##*"$room"} dos host rt" ;;
		*) barred=$rooms ;;
		esac
		for other in $barred; do
			sed -n "s|^#include \"\(\([^\"]*/\)\{0,1\}$other/[^\"]*\)\".*|$file includes \1|p" "$file"
		done
	done
}
below >"$dir/below"
ok "no room includes from a room behind it" none cat "$dir/below"
ok "every room is in the order" none sh -c "sed -n 's|^src/\([a-z]*\)/.*|\1|p' '$dir/files' | sort -u |
	grep -v -x -E '$(echo $rooms dos host rt | tr ' ' '|')'"

# ---- The pages

# A page in each folder: what comes in, what goes out, where to begin. The others are guides.
for folder in $(sed -n 's|^\(src/[a-z]*\)/.*|\1|p' "$dir/files" | sort -u) asm asm/start include tests tools; do
	ok "$folder/README.md" test -s "$folder/README.md"
	ok "$folder/README.md: at most twenty lines" test "$(wc -l <"$folder/README.md")" -le 20
	ok "$folder/README.md: what to read first" grep -q '^Read first: ' "$folder/README.md"
done
for guide in README.md src/README.md asm/stub/README.md tools/scenes/README.md tests/truth/README.md tests/bench/README.md; do
	ok "$guide" test -s "$guide"
done
ok "README.md: at most 150 lines" test "$(wc -l <README.md)" -le 150
# Whatever a page links to is there.
links() {
	grep 'README\.md$' "$dir/files" | while read -r page; do
		grep -o ']([^)]*)' "$page" | sed 's/^](//; s/)$//; s/#.*//' | grep -v -E '^$|^https?:' | while read -r link; do
			[ -e "$(dirname "$page")/$link" ] || echo "$page: $link"
		done
	done
}
ok "links of the pages" none links
# Whatever file a page names in backquotes by its path is there.
named() {
	grep 'README\.md$' "$dir/files" | while read -r page; do
		grep -o '`\(src\|include\|asm\|tests\|tools\)/[A-Za-z0-9_./-]*`' "$page" | tr -d '`' |
			grep -v NAME | sort -u | while read -r file; do
			[ -e "$file" ] || echo "$page: $file"
		done
	done
}
ok "files that the pages name" none named

# A fault of tests/mutants that changes nothing any more tries no test.
stale() {
	grep -v '^#' tests/mutants/faults.txt | while read -r line; do
		file=${line%% :: *}
		rest=${line#* :: }
		if sed "${rest%% :: *}" "$file" | cmp -s - "$file"; then
			echo "$line"
		fi
	done
}
ok "faults that the tests must notice" none stale

# An assembly routine that the twins do not try is not finished.
routines=$(sed -n -e 's/^[[:space:]]*\.globl[[:space:]]*SYM(\(.*\))/\1/p' -e 's/^[[:space:]]*FUNC(\(.*\))/\1/p' asm/*.S)
ok "assembly routines found" test "$(echo $routines | wc -w)" -ge 3
for routine in $routines; do
	ok "the twins try $routine" grep -q "$routine(" tests/twins/twins.cpp
done

# Instructions.
# Of the objects: in the linked program the constants stand among the code.
objdump -d --no-show-raw-insn $(find build/dos/src build/dos/asm -name '*.o') >"$dir/code"
ok "disassembled" test "$(wc -l <"$dir/code")" -gt 5000
awk -F '\t' 'NF > 1 {
	split($2, part, " ")
	print part[1] ~ /^(rep|repz|repnz|lock|data16|addr16|cs|ds|es|fs|gs|ss)$/ ? part[2] : part[1]
}' "$dir/code" | sort | uniq -c >"$dir/words"
ok "no x87 instruction" none awk '$2 ~ /^f/' "$dir/words"
ok "no MMX or SSE register" none grep -m 5 -E '%[xy]?mm[0-7]' "$dir/code"
newer='cmov|bswap|xadd|cmpxchg|cpuid|rdtsc|invlpg|invd|wbinvd|set.*bnd|endbr|movbe|popcnt|[lt]zcnt|prefetch'
ok "nothing a 386 lacks" none awk -v newer="^($newer)" '$2 ~ newer' "$dir/words"
# The linker script puts what the objects have for them between these two symbols.
constructors() {
	nm "$elf" | awk '$3 == "__init_array_start" { start = $1 } $3 == "__init_array_end" { end = $1 }
		END { exit start == "" || start != end }'
}
ok "no static constructors" constructors
ok "nothing undefined" none sh -c "nm -u '$elf'"

# DEMO.EXE as a DOS program.
ok "an MZ program" test "$(head -c 2 build/DEMO.EXE)" = MZ
if command -v i586-pc-msdosdjgpp-objdump >/dev/null; then
	ok "a go32 program to the DJGPP tools" sh -c "i586-pc-msdosdjgpp-objdump -f build/DEMO.EXE | grep -q coff-go32-exe"
else
	echo "# no DJGPP binutils: its tools were not asked what DEMO.EXE is"
fi
ok "the stub has at most 16 KB" test "$(wc -c <build/STUB.EXE)" -le 16384
echo "# DEMO.EXE: $(($(wc -c <build/DEMO.EXE))) bytes, $(($(wc -c <build/STUB.EXE))) of them the stub;" \
	"$(size "$elf" | awk 'NR == 2 { print $1 " code and constants, " $2 " data, " $3 " cleared memory" }')"
echo "# $(awk '{ n += $1 } END { print n }' "$dir/words") instructions disassembled, of $(wc -l <"$dir/words" | tr -d ' ') kinds"
summary
