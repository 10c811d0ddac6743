# How the picture tools and their test are built. Included by the Makefile;
# also stands alone: make -f tools/pics.mk build/mkgif build/ppm2png
HOST_CXX ?= g++
PICS_FLAGS = -O2 -std=c++17 -Wall -Wextra

build/mkgif: tools/mkgif.cpp tools/picture.h tools/pics.mk
	@mkdir -p build
	$(HOST_CXX) $(PICS_FLAGS) -o $@ tools/mkgif.cpp

build/ppm2png: tools/ppm2png.cpp tools/picture.h tools/pics.mk
	@mkdir -p build
	$(HOST_CXX) $(PICS_FLAGS) -o $@ tools/ppm2png.cpp

build/picstst: tests/pics/picstst.cpp tools/pics.mk
	@mkdir -p build
	$(HOST_CXX) $(PICS_FLAGS) -o $@ tests/pics/picstst.cpp
