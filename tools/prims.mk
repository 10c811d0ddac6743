# The tests of the primitives. Included by the Makefile, after tools/tests.mk's variants.
build/primtst: $(patsubst %.cpp,build/host/%.o,$(filter-out $(MAIN),$(PROGRAM)) src/host/host.cpp) \
		$(patsubst %.cpp,build/fixed/%.o,$(wildcard tests/prims/*.cpp))
	$(HOST_CXX) -o $@ $^
