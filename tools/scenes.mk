# Scene files: the generator of random ones. Included by the Makefile; also stands alone: make -f tools/scenes.mk
HOSTCXX ?= g++

build/mkscene: tools/mkscene.cpp tools/scenes.mk
	@mkdir -p build
	$(HOSTCXX) -O2 -std=c++17 -Wall -Wextra -o $@ tools/mkscene.cpp
