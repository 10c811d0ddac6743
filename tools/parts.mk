# What the program is made of: the one list of its rooms and kernels. Included by Makefile and Makefile.djgpp before
# anything else that names a source. Objects are compiled anew when it changes: with other switches they might not fit together.
#
#   PROGRAM     every source of the program but the machine it runs on, main() included
#   KERNELS     the assembly kernels, each of which has a C++ twin
#   QUICK       where a frame's time goes, without .cpp: larger code for fewer instructions
#   FOR_386     code that a 386 runs and that is quickest on a 486. A function makes room for the arguments of its calls once, not
#               for each call. A Real is returned in a register. A value keeps one of the few registers only while it is needed
ROOMS = math model surface picture app
PROGRAM = $(wildcard $(ROOMS:%=src/%/*.cpp))
KERNELS = $(wildcard asm/*.S)
FOR_386 = -march=i386 -mtune=i486 -maccumulate-outgoing-args -freg-struct-return -flive-range-shrinkage
MAIN = src/app/main.cpp
QUICK = $(addprefix src/surface/,settle ltchange nearby path fields blend search cover border hollow \
		classify shade bend limb slopes voxels keeper) \
	$(addprefix src/picture/,view gaps)
