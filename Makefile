# make        build/DEMO.EXE (DOS, stock compiler) and build/demo (host)
# make run    plays DEMO.EXE in DOSBox        make test   everything that can be tested
# make bench  frames per second and where the instructions go
CXX ?= g++
HOST_CXX ?= $(CXX)
REAL ?= FIXED

HOST_FLAGS = -std=c++17 -O2 -fno-exceptions -fno-rtti -Wall -Wextra -Iinclude -DFB_REAL=FB_$(REAL) $(HOST_DEFINES)
SOURCES = $(wildcard src/*.cpp)

all: build/DEMO.EXE build/demo

build/host/%.o: %.cpp
	@mkdir -p $(@D)
	$(HOST_CXX) $(HOST_FLAGS) -MMD -MP -c $< -o $@

build/demo: $(patsubst %.cpp,build/host/%.o,$(SOURCES) src/host/host.cpp)
	$(HOST_CXX) -o $@ $^

clean:
	rm -rf build

.PHONY: all clean

-include $(wildcard build/host/src/*.d build/host/src/host/*.d)
