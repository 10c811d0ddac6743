# How the yardstick and its tests are built. Included by the Makefile; also
# stands alone: make -f tools/truth.mk build/truth
HOST_CXX ?= g++
TRUTH_FLAGS = -O2 -std=c++17 -Wall -Wextra -pthread
TRUTH_PARTS = tools/truthray.cpp tools/truthscn.cpp tools/truthcmp.cpp

build/truth: tools/truth.cpp $(TRUTH_PARTS) tools/truth.h tools/picture.h tools/truth.mk
	@mkdir -p build
	$(HOST_CXX) $(TRUTH_FLAGS) -o $@ tools/truth.cpp $(TRUTH_PARTS)

build/truthtst: tests/truth/truthtst.cpp $(TRUTH_PARTS) tools/truth.h tools/truth.mk
	@mkdir -p build
	$(HOST_CXX) $(TRUTH_FLAGS) -Itools -o $@ tests/truth/truthtst.cpp $(TRUTH_PARTS)
