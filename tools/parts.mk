# What the program is made of: the one list of its rooms and kernels. Included by Makefile and Makefile.djgpp before
# anything else that names a source. Objects are compiled anew when it changes: with other switches they might not fit together.
#
#   PROGRAM     every source of the program but the machine it runs on, main() included
#   KERNELS     the assembly kernels, each of which has a C++ twin
#   QUICK       where a frame's time goes, without .cpp: larger code for fewer instructions
#   FOR_386     code for a 386, quickest on a 486; room on the stack for what calls hand over is made once for a function, a Real is
#               returned in a register, and values are kept in the few registers for no longer than they are needed
ROOMS = math model surface picture app
PROGRAM = $(wildcard $(ROOMS:%=src/%/*.cpp))
KERNELS = $(wildcard asm/*.S)
FOR_386 = -march=i386 -mtune=i486 -maccumulate-outgoing-args -freg-struct-return -flive-range-shrinkage
MAIN = src/app/main.cpp
QUICK = $(addprefix src/surface/,settle ltchange nearby path fields blend search cover border hollow \
		classify shade bend limb slopes voxels keeper) \
	$(addprefix src/picture/,view gaps)
