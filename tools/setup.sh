#!/bin/sh
# Installs what is missing on this machine to play or to test, by apt (Debian, Ubuntu). Harmless when run again; does nothing
# where everything is there, and then needs neither the network nor any rights.
#
#   sh tools/setup.sh play      to build and play: make, g++, DOSBox
#   sh tools/setup.sh test      to test as well
#   sh tools/setup.sh release   to build the zip for DOS: make, g++, zip
#   sh tools/setup.sh page      to build the page that plays in a browser: make, g++, zip, node, npm
#   sh tools/setup.sh web       to test that page as well: a browser, and puppeteer-core (from npm, into build/npm)
#
# Exit status 0 when what is needed is there; 1 and a line that names what is missing otherwise.
set -u
cd "$(dirname "$0")/.." || exit 1

what=${1:-play}
case $what in
play | test | release | page | web) ;;
*)
	echo "setup.sh: play, test, release, page or web is expected, not $what" >&2
	exit 2
	;;
esac

has() {
	command -v "$1" >/dev/null 2>&1
}

# Compiles and links; headers alone do not tell that a library is there.
compiles() { # compiles FLAGS...
	work=$(mktemp -d "${TMPDIR:-/tmp}/setup.XXXXXX") || return 1
	echo '#include <vector>
int main() { return static_cast<int>(std::vector<int>(3).size()) - 3; }' >"$work/a.cpp"
	g++ "$@" -o "$work/a" "$work/a.cpp" >/dev/null 2>&1
	compiled=$?
	rm -rf "$work"
	return $compiled
}

# What drives the browser; of the versions that the node of Debian 12 runs.
PUPPETEER=puppeteer-core@24.43.1
driver() {
	[ -f build/npm/node_modules/puppeteer-core/package.json ]
}

missing() {
	has make || echo make
	{ has g++ && compiles; } || echo g++
	has ld || echo binutils
	case $what in
	play | test) has dosbox || echo dosbox ;;
	esac
	[ "$what" = play ] || has zip || echo zip
	case $what in
	page | web)
		has node || echo nodejs
		has npm || echo npm
		;;
	esac
	if [ "$what" = web ]; then
		has chromium || has google-chrome || echo chromium
	fi
	[ "$what" = test ] || return 0
	has unzip || echo unzip
	{ has g++ && compiles -m32; } || echo g++-multilib
	has Xvfb || echo xvfb
	has xdotool || echo xdotool
	has valgrind || echo valgrind
	# Where the kernel runs no 32-bit programs.
	sh tools/run32.sh -k || has qemu-i386 || echo qemu-user
	has i586-pc-msdosdjgpp-objdump || echo binutils-djgpp
	has cmp || echo diffutils
	has git || echo git
}

# The driver is for this tree alone.
finish() {
	[ "$what" = web ] && ! driver || exit 0
	echo "setup.sh: fetching $PUPPETEER"
	mkdir -p build/npm
	if ! npm install --silent --no-audit --no-fund --no-package-lock --prefix build/npm "$PUPPETEER" || ! driver; then
		echo "setup.sh: npm cannot fetch $PUPPETEER" >&2
		exit 1
	fi
	exit 0
}

packages=$(missing)
[ -n "$packages" ] || finish
# One line, for the messages.
packages=$(echo $packages)

if ! has apt-get; then
	echo "setup.sh: please install: $packages" >&2
	exit 1
fi
sudo=
if [ "$(id -u)" -ne 0 ]; then
	if ! has sudo; then
		echo "setup.sh: neither root nor sudo; please install: $packages" >&2
		exit 1
	fi
	sudo=sudo
fi
echo "setup.sh: installing $packages"
log=$(mktemp "${TMPDIR:-/tmp}/setup.XXXXXX") || exit 1
trap 'rm -f "$log"' EXIT
apt() {
	$sudo env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" >>"$log" 2>&1
}
apt update || echo "setup.sh: apt-get update failed; trying with the lists that are there" >&2
if ! apt install --no-install-recommends $packages; then
	# One at a time, so that one missing package does not keep the others out.
	for package in $packages; do
		apt install --no-install-recommends "$package" || echo "setup.sh: cannot install $package" >&2
	done
fi
packages=$(echo $(missing))
if [ -n "$packages" ]; then
	tail -n 20 "$log" >&2
	echo "setup.sh: still missing: $packages" >&2
	exit 1
fi
finish
