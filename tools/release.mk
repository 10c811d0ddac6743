# The zip for people with DOS. Included by the Makefile.
#
#   make release        build/release/FBLOBS.ZIP: the program, its scenes and texts, with the line ends of DOS
#
# The zip has the same bytes whenever it is made from the same commit by the same compiler: files stand in a fixed order
# and bear the time of the commit. SOURCE_DATE_EPOCH, from the environment, names another time.
release: build/release/FBLOBS.ZIP

build/release/FBLOBS.ZIP: build/DEMO.EXE build/demo tools/release.sh tools/bench.bat LICENSE \
		$(wildcard tools/scenes/*.FB tools/release/*)
	sh tools/release.sh

# The commit's time is in it, so it is made anew each time that it is asked for.
.PHONY: release build/release/FBLOBS.ZIP
