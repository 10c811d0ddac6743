# How the benchmark is built. Included by the Makefile.
#
#   make bench              a page of figures, and build/bench.csv with a line for each scene (tools/bench.sh tells more)
#   make bench SECONDS=10   shorter runs; FULL=1: the whole minute of the animation in each, five speeds, five spacings
#   make bench SCENES="FOUR WALK"   of the shipped scenes only these; FRAMES=n: frames counted (70)
#   sh tools/instr.sh       the quick look: instructions a frame of every scene
#   build/cost              whose the instructions are that callgrind counted
#   build/BENCH.BAT         the runs for a real machine, beside DEMO.EXE
#   build/bench32           the 32-bit host program with tools/bench.cpp linked in, for counting instructions

all: build/BENCH.BAT

# DOS wants its own line ends.
build/BENCH.BAT: tools/bench.bat
	@mkdir -p build
	awk '{ sub(/\r$$/, ""); printf "%s\r\n", $$0 }' tools/bench.bat > $@

BENCH_WRAP = -Wl,--wrap=drawScalesA -Wl,--wrap=blitScale -Wl,--wrap=clearRows \
	-Wl,--wrap=_ZN7machine7presentEPKhPK4Span
BENCH_TWINS = build/bench/blit486.o build/bench/scales486.o
BENCH_PARTS = $(filter-out build/host32/src/picture/blit.o build/host32/src/picture/scales.o,\
	$(patsubst %.cpp,build/host32/%.o,$(HOST_SOURCES))) \
	$(KERNELS:%.S=build/host32/%.o) build/host32/tools/bench.o

# The twins as a compiler for the 486 makes them.
build/bench/%486.o: src/picture/%.cpp tools/parts.mk
	@mkdir -p $(@D)
	$(HOST_CXX) $(HOST_FLAGS) -m32 -march=i486 -fno-pic -fno-pie -DFB_ASM=1 -MMD -MP -c $< -o $@

build/bench32: $(BENCH_PARTS) $(BENCH_TWINS)
	$(HOST_CXX) -m32 -no-pie -static $(BENCH_WRAP) -o $@ $^

build/cost: tools/cost.cpp tools/clk486.h
	@mkdir -p build
	$(HOST_CXX) -std=c++17 -O2 -Wall -Wextra -o $@ $<

# What the benchmark asks DOSBox's BIOS for the time with.
build/TICKS.COM: tools/ticks.S
	@mkdir -p build/bench
	$(HOST_CXX) -m32 -c $< -o build/bench/ticks.o
	$(DOS_LD) -m elf_i386 -Ttext 0x100 --oformat binary -o $@ build/bench/ticks.o

bench: build/DEMO.EXE build/TICKS.COM build/bench32 build/demo32 build/cost
	@BENCH_SECONDS="$(SECONDS)" BENCH_FRAMES="$(FRAMES)" BENCH_SCENES="$(SCENES)" FULL="$(FULL)" sh tools/bench.sh

.PHONY: bench

-include $(wildcard build/host32/tools/*.d build/bench/*.d)
