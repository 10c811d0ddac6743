# The page that plays DEMO.EXE in a browser. Included by the Makefile.
#
#   make web        build/web: static files to be put on any server; js-dos is fetched by npm
#
# To look at it: node tests/web/serve.js build/web 8000, then http://localhost:8000/
web: build/DEMO.EXE build/demo build/ppm2png build/web/RUN.COM release
	+@sh tools/web.sh

build/web/RUN.COM: tools/stderr.S
	@mkdir -p build/web build/stub
	$(STUB_CC) -c -o build/stub/run.o $<
	$(STUB_LD) -Ttext 0x100 -e start --oformat binary -o $@ build/stub/run.o

.PHONY: web
