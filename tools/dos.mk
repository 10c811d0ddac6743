# How sources become DOS programs with the stock compiler: objects, the run-time, the machine, and the link. The main
# Makefile includes this and adds which objects make up DEMO.EXE.
#
#   DOS_CXX, DOS_LD     compiler driver and linker; any g++ that knows -m32, no 32-bit libraries needed
#   DOS_CXXFLAGS        how program code is compiled; DOS_OPT what to optimise for
#   DOS_BASE            objects that every DOS program is linked with: start-up, run-time, machine
#   build/dos/X.o       the object of X.cpp or X.S, for DOS
#   build/X.EXE         is made by  $(DOS_LINK)  from objects; see MTEST.EXE below

DOS_CXX ?= $(CXX)
DOS_LD ?= ld
DOS_OPT ?= -O2

# What a program without an operating system below it takes. No exceptions, no RTTI. No x87, for a 386 need not have
# one; only a build with a floating-point Real uses it (and has square roots in line, there being no library).
DOS_CXXFLAGS = -std=c++17 -m32 $(FOR_386) $(DOS_OPT) -ffreestanding -fno-builtin-malloc -fno-pic -fno-pie \
	-fno-exceptions -fno-rtti -fno-asynchronous-unwind-tables -fno-stack-protector -fno-threadsafe-statics \
	-fomit-frame-pointer $(DOS_FLOAT) -fcf-protection=none -Wall -Wextra -DFB_RT -Iinclude $(DOS_DEFINES)
DOS_FLOAT = $(if $(filter FLOAT DOUBLE,$(REAL)),-m80387 -fno-math-errno,-mno-80387)
DOS_ASFLAGS = -m32 -Iasm

build/dos/%.o: %.cpp tools/parts.mk
	@mkdir -p $(@D)
	$(DOS_CXX) $(DOS_CXXFLAGS) -MMD -MP -c $< -o $@

build/dos/%.o: %.S
	@mkdir -p $(@D)
	$(DOS_CXX) -x assembler-with-cpp $(DOS_ASFLAGS) -MMD -MP -c $< -o $@

# The run-time and the machine are called seldom: small, not fast.
build/dos/src/rt/%.o build/dos/src/dos/%.o: DOS_OPT = -Os

DOS_BASE = build/dos/asm/start/start.o build/dos/asm/start/trap.o \
	$(patsubst %.cpp,build/dos/%.o,$(wildcard src/rt/*.cpp src/dos/*.cpp))

# Objects to an ELF file that lies where the loader puts it, and that with the stub in front. (Newer linkers warn of code
# that can be written to; under DOS all of it can, and older linkers do not know the option.)
DOS_LDFLAGS := -m elf_i386 $(if $(findstring no-warn-rwx-segments,$(shell $(DOS_LD) --help)),--no-warn-rwx-segments)
DOS_LINK = $(DOS_LD) $(DOS_LDFLAGS) -T tools/dos.ld -o build/dos/$(@F).elf $(filter %.o,$^) && \
	build/mkexe build/STUB.EXE build/dos/$(@F).elf $@

# Tests of the machine and the run-time on the machine itself.
build/MTEST.EXE: build/dos/tests/dos/mtest.o build/dos/asm/blit.o build/dos/asm/scales.o $(DOS_BASE) \
		build/STUB.EXE build/mkexe tools/dos.ld
	$(DOS_LINK)

-include $(wildcard build/dos/*/*.d build/dos/*/*/*.d)
