# The EXE's stub and the tool that puts it in front of programs. Included by the Makefile; alone:
#   make -f tools/stub.mk
# leaves build/STUB.EXE and build/mkexe. STUB_CC and STUB_LD may be DJGPP's (gcc and ld) as well.

STUB_CC  ?= gcc -m32
STUB_LD  ?= ld -m elf_i386 $(if $(findstring no-warn-rwx-segments,$(shell ld --help)),--no-warn-rwx-segments)
HOST_CXX ?= g++

STUB_SRC = stub dpmiinit dpmimode dpmiint dpmisvc dpmimem dpmidata
STUB_OBJ = $(STUB_SRC:%=build/stub/%.o)

stub: build/STUB.EXE build/mkexe

build/STUB.EXE: build/stub/stub.elf build/mkexe
	build/mkexe --make-stub build/stub/stub.elf $@

build/stub/stub.elf: $(STUB_OBJ) tools/stub.ld
	$(STUB_LD) -T tools/stub.ld --no-check-sections -Map build/stub/stub.map -o $@ $(STUB_OBJ)

build/stub/%.o: asm/stub/%.S asm/asm.h asm/stub/dpmi.h
	@mkdir -p build/stub
	$(STUB_CC) -Iasm -c -o $@ $<

build/mkexe: tools/mkexe.cpp
	@mkdir -p build
	$(HOST_CXX) -std=c++17 -O2 -Wall -Wextra -o $@ $<

.PHONY: stub

# The program that tries a DPMI host, and the one that brings DOSBox to V86 mode (tests/dpmi). For the rules of DOS
# programs this needs the Makefile.
build/DTEST.EXE: build/dos/tests/dpmi/dtest.o build/dos/tests/dpmi/dtesta.o build/dos/asm/start/start.o \
		$(patsubst %.cpp,build/dos/%.o,$(wildcard src/rt/*.cpp)) build/STUB.EXE build/mkexe tools/dos.ld
	$(DOS_LINK)

build/V86.COM: tests/dpmi/v86.S
	@mkdir -p build/stub
	$(STUB_CC) -c -o build/stub/v86.o $<
	$(STUB_LD) -Ttext 0x100 -e start --oformat binary -o $@ build/stub/v86.o
