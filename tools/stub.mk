# The EXE's stub and the tool that puts it in front of programs. Included by the Makefile; alone:
#   make -f tools/stub.mk
# leaves build/STUB.EXE and build/mkexe. STUB_CC needs nothing but an assembler that knows --32.

STUB_CC  ?= gcc -m32
HOST_CXX ?= g++

STUB_SRC = stub dpmiinit dpmimode dpmiint dpmisvc dpmimem dpmidata
STUB_OBJ = $(STUB_SRC:%=build/stub/%.o)

stub: build/STUB.EXE build/mkexe

build/STUB.EXE: build/stub/stub.elf build/mkexe
	build/mkexe --make-stub build/stub/stub.elf $@

build/stub/stub.elf: $(STUB_OBJ) tools/stub.ld
	ld -m elf_i386 -T tools/stub.ld --no-check-sections -Map build/stub/stub.map -o $@ $(STUB_OBJ)

build/stub/%.o: asm/%.S asm/asm.h asm/dpmi.h
	@mkdir -p build/stub
	$(STUB_CC) -c -o $@ $<

build/mkexe: tools/mkexe.cpp
	@mkdir -p build
	$(HOST_CXX) -std=c++17 -O2 -Wall -Wextra -o $@ $<

.PHONY: stub
