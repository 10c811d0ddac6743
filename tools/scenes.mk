# Scene files: the generator of random ones. Included by the Makefile; also stands alone: make -f tools/scenes.mk
HOSTCXX ?= g++

build/mkscene: tools/mkscene.cpp tools/scenes.mk
	@mkdir -p build
	$(HOSTCXX) -O2 -std=c++17 -Wall -Wextra -o $@ tools/mkscene.cpp

# The reader of scene files with everything it uses, under the sanitizers, and what feeds it.
# (Not src/math/alloc.cpp: the mutator uses the C++ library, which brings its own operator delete.)
FUZZ_FLAGS = -std=c++17 -O1 -g -fsanitize=address,undefined -fno-sanitize=shift-base -fno-sanitize-recover=all \
	-Wall -Wextra -Iinclude
FUZZ_PARTS = $(patsubst %.cpp,build/fuzzo/%.o,\
	$(filter-out $(MAIN) src/math/alloc.cpp,$(PROGRAM)) src/host/host.cpp)

build/fuzzo/%.o: %.cpp
	@mkdir -p $(@D)
	$(HOSTCXX) $(FUZZ_FLAGS) -MMD -MP -c $< -o $@

build/fuzz: $(FUZZ_PARTS) build/fuzzo/tests/fuzz/fuzz.o build/fuzzo/tests/fuzz/scenes.o tools/scenes.mk
	$(HOSTCXX) $(FUZZ_FLAGS) -o $@ $(filter %.o,$^)

# The same for command lines.
build/fuzzline: build/fuzzo/tests/fuzz/lines.o build/fuzzo/tests/fuzz/scenes.o build/fuzzo/src/app/options.o \
		build/fuzzo/src/math/text.o build/fuzzo/src/math/real.o
	$(HOSTCXX) $(FUZZ_FLAGS) -o $@ $^

-include $(wildcard build/fuzzo/*/*.d build/fuzzo/*/*/*.d)

SCNTST_PARTS = $(patsubst %.cpp,build/host/%.o,\
	$(filter-out $(MAIN),$(PROGRAM)) src/host/host.cpp)

build/scntst: tests/scenes/scntst.cpp $(SCNTST_PARTS) tools/scenes.mk
	$(HOSTCXX) -O1 -std=c++17 -Wall -Wextra -Iinclude -DFB_REAL=FB_$(REAL) -o $@ $< $(SCNTST_PARTS)

# make run                          the four spheres, in DOSBox
# make run SCENE=walk               a shipped scene (tools/scenes), or a scene file
# make run SWITCHES="/I /G"         with switches of the program
run: play-parts
	@sh tools/play.sh "$(SCENE)" $(SWITCHES)

play-parts: build/DEMO.EXE build/PLAY.COM build/mkgif build/ppm2png

build/PLAY.COM: tools/play.S
	@mkdir -p build/stub
	$(STUB_CC) -c -o build/stub/play.o $<
	$(STUB_LD) -Ttext 0x100 -e start --oformat binary -o $@ build/stub/play.o

.PHONY: run play-parts
