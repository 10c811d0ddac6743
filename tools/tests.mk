# How the tests are built and run. Included by the Makefile.
#
#   make test            everything: sh tests/run.sh
#   build/unit-KIND      the unit tests with that kind of Real: fixed, float, double
#   build/demo-KIND      the demo with that kind of Real: float, double
#   build/san/demo, build/san/unit    the demo under the address and undefined sanitizers, and the unit tests of its parts
#   build/fuzz, build/fuzzline        what feeds random scenes and command lines to the program, under the sanitizers
#   build/twins          each assembly routine against its C++ twin

TEST_CXX ?= $(HOST_CXX)
TEST_FLAGS = -std=c++17 -Wall -Wextra -Iinclude

# The program as the tests link it: all but main(), on the machine with nothing behind it.
TEST_PARTS = $(filter-out $(MAIN),$(PROGRAM)) src/host/host.cpp

test:
	@sh tests/run.sh

# $(call variant,NAME,FLAGS): build/NAME/X.o is the object of X.cpp compiled with FLAGS, program and tests alike.
define variant
build/$(1)/src/%.o: src/%.cpp
	@mkdir -p $$(@D)
	$$(TEST_CXX) $$(TEST_FLAGS) -fno-exceptions -fno-rtti $(2) -MMD -MP -c $$< -o $$@

build/$(1)/tests/%.o: tests/%.cpp
	@mkdir -p $$(@D)
	$$(TEST_CXX) $$(TEST_FLAGS) -fno-rtti $(2) -MMD -MP -c $$< -o $$@

-include $$(wildcard build/$(1)/*/*.d build/$(1)/*/*/*.d)
endef

$(eval $(call variant,fixed,-O2 -DFB_REAL=FB_$(REAL)))
$(eval $(call variant,float,-O1 -DFB_REAL=FB_FLOAT))
$(eval $(call variant,double,-O1 -DFB_REAL=FB_DOUBLE))
# Shifts of negative numbers are what every compiler of use makes of them, and C++20 says so too.
SANITIZE = -fsanitize=address,undefined -fno-sanitize=shift-base -fno-sanitize-recover=all
$(eval $(call variant,san,-O1 -g1 -fno-omit-frame-pointer $(SANITIZE)))

UNIT_TESTS = $(wildcard tests/unit/*.cpp)
UNIT_PARTS = $(TEST_PARTS) $(UNIT_TESTS)

build/unit-%:
	$(TEST_CXX) -o $@ $^
# The program's objects are those of build/demo.
build/unit-fixed: $(TEST_PARTS:%.cpp=build/host/%.o) $(UNIT_TESTS:%.cpp=build/fixed/%.o)
build/unit-float: $(UNIT_PARTS:%.cpp=build/float/%.o)
build/unit-double: $(UNIT_PARTS:%.cpp=build/double/%.o)

build/demo-float: $(patsubst %.cpp,build/float/%.o,$(TEST_PARTS) $(MAIN))
	$(TEST_CXX) -o $@ $^
build/demo-double: $(patsubst %.cpp,build/double/%.o,$(TEST_PARTS) $(MAIN))
	$(TEST_CXX) -o $@ $^

# The program comes first: of inline functions that both have, the linker takes the ones with the sanitizers.
build/san/unit: $(TEST_PARTS:%.cpp=build/san/%.o) $(UNIT_TESTS:%.cpp=build/fixed/%.o)
	$(TEST_CXX) $(SANITIZE) -o $@ $^
build/san/demo: $(patsubst %.cpp,build/san/%.o,$(TEST_PARTS) $(MAIN))
	$(TEST_CXX) $(SANITIZE) -o $@ $^

# The reader of scene files with everything it uses, under the sanitizers, and what feeds it; and the same for command lines.
# (Not src/math/alloc.cpp: the mutator uses the C++ library, which brings its own operator delete.)
build/fuzz: $(patsubst %.cpp,build/san/%.o,$(filter-out src/math/alloc.cpp,$(TEST_PARTS)) tests/fuzz/fuzz.cpp tests/fuzz/scenes.cpp)
	$(TEST_CXX) $(SANITIZE) -o $@ $^
build/fuzzline: $(patsubst %,build/san/%.o,tests/fuzz/lines tests/fuzz/scenes src/app/options src/math/text src/math/real)
	$(TEST_CXX) $(SANITIZE) -o $@ $^

build/twins: build/host32/tests/twins/twins.o $(patsubst %,build/host32/%.o,src/picture/blit src/picture/scales \
		src/surface/voxels src/surface/fields src/model/field $(KERNELS:%.S=%))
	$(TEST_CXX) -m32 -no-pie -static -o $@ $^

# The numbers in the assembly, for the compiler to compare with what they stand for.
build/%def.h: asm/%.S
	@mkdir -p $(@D)
	sed -n 's/^#define \([A-Z_]*\) *\([^ ].*\)/constexpr int \1 = \2;/p' $< | sed 's;\(/\*.*\*/\)\;$$;\;;' > $@
build/host32/tests/twins/twins.o: build/scalesdef.h build/voxelsdef.h build/fieldsdef.h

-include $(wildcard build/host32/tests/twins/*.d)

# What tests/frames and tests/golden hold frames together with.
build/samefrm: tests/frames/samefrm.cpp
	@mkdir -p build
	$(TEST_CXX) $(TEST_FLAGS) -O2 -o $@ $<

# Reads films and screenshots, for tests/edit.
build/filmtst: tests/edit/filmtst.cpp
	@mkdir -p build
	$(TEST_CXX) $(TEST_FLAGS) -O2 -o $@ $<

.PHONY: test
