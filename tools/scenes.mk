# Scene files: the generator of random ones. Included by the Makefile; also stands alone: make -f tools/scenes.mk
HOST_CXX ?= g++

build/mkscene: tools/mkscene.cpp tools/scenes.mk
	@mkdir -p build
	$(HOST_CXX) -O2 -std=c++17 -Wall -Wextra -o $@ tools/mkscene.cpp

SCNTST_PARTS = $(patsubst %.cpp,build/host/%.o,\
	$(filter-out $(MAIN),$(PROGRAM)) src/host/host.cpp)

build/scntst: tests/scenes/scntst.cpp $(SCNTST_PARTS) tools/scenes.mk
	$(HOST_CXX) -O1 -std=c++17 -Wall -Wextra -Iinclude -DFB_REAL=FB_$(REAL) -o $@ $< $(SCNTST_PARTS)

# make run                          the four spheres, in DOSBox
# make run SCENE=walk               a shipped scene (tools/scenes), or a scene file
# make run SWITCHES="/I /G"         with switches of the program
run: play-parts
	@sh tools/play.sh "$(SCENE)" $(SWITCHES)

play-parts: build/DEMO.EXE build/PLAY.COM build/mkgif build/ppm2png

build/PLAY.COM: tools/stderr.S
	@mkdir -p build/stub
	$(STUB_CC) -DAPART -c -o build/stub/play.o $<
	$(STUB_LD) -Ttext 0x100 -e start --oformat binary -o $@ build/stub/play.o

.PHONY: run play-parts
