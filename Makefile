# make        build/DEMO.EXE (DOS, stock compiler) and build/demo (host)
# make run    plays DEMO.EXE in DOSBox        make test   everything that can be tested
# make bench  frames per second and where the instructions go
HOST_CXX ?= $(CXX)
REAL ?= FIXED

all: build/DEMO.EXE build/demo

include tools/parts.mk

HOST_SOURCES = $(PROGRAM) $(wildcard src/host/*.cpp)
HOST_OPT = -O2
HOST_FLAGS = -std=c++17 $(HOST_OPT) -fno-exceptions -fno-rtti -Wall -Wextra -Iinclude -DFB_REAL=FB_$(REAL) $(HOST_DEFINES)

DOS_DEFINES = -DFB_ASM=1 -DFB_REAL=FB_$(REAL)
include $(filter-out tools/parts.mk,$(wildcard tools/*.mk))

# The host program: any C++17 compiler, 64 bits or 32, loops in C++.
build/host/%.o: %.cpp tools/parts.mk
	@mkdir -p $(@D)
	$(HOST_CXX) $(HOST_FLAGS) -MMD -MP -c $< -o $@

build/demo: $(patsubst %.cpp,build/host/%.o,$(HOST_SOURCES))
	$(HOST_CXX) -o $@ $^

# The same with 32 bits and the assembly loops; static, so that valgrind needs no 32-bit libraries.
HOST32_FLAGS = -m32 $(FOR_386) -fno-pic -fno-pie -DFB_ASM=1

build/host32/%.o: %.cpp tools/parts.mk
	@mkdir -p $(@D)
	$(HOST_CXX) $(HOST_FLAGS) $(HOST32_FLAGS) -MMD -MP -c $< -o $@

build/host32/%.o: %.S
	@mkdir -p $(@D)
	$(HOST_CXX) -m32 -x assembler-with-cpp -Iasm -MMD -MP -c $< -o $@

build/demo32: $(patsubst %.cpp,build/host32/%.o,$(HOST_SOURCES)) $(KERNELS:%.S=build/host32/%.o)
	$(HOST_CXX) -m32 -no-pie -static -Wl,-Map=$@.map -o $@ $^

build/DEMO.EXE: $(patsubst %.cpp,build/dos/%.o,$(PROGRAM)) $(KERNELS:%.S=build/dos/%.o) $(DOS_BASE) \
		build/STUB.EXE build/mkexe tools/dos.ld
	$(DOS_LINK)

# Where a frame's time goes: larger code, 7% fewer instructions a frame.
$(QUICK:%=build/host/%.o) $(QUICK:%=build/host32/%.o): HOST_OPT = -O3
$(QUICK:%=build/dos/%.o): DOS_OPT = -O3

clean:
	rm -rf build

.PHONY: all clean

-include $(wildcard build/host/src/*/*.d build/host32/src/*/*.d build/host32/asm/*.d)
