/* Every assembly file includes this header, so that one source assembles for ELF (stock gcc -m32) and for
   DJGPP's COFF, where C symbols have a leading underscore.

   SYM(name)   a symbol shared with C or C++
   SECTION(name), SECTION_BSS(name)    start a separate section: with code and data, or zero-initialised
   FUNC(name), ENDFUNC(name)    enclose a routine that C++ calls: they define its label and, on ELF, its type and size for
               profilers
   LOCAL(name), ENDFUNC(name)   enclose a routine that is called only in its own file
   ASM_END     last line of each file: tells an ELF linker that the file needs no executable stack */
#ifndef ASM_ASM_H
#define ASM_ASM_H

#ifdef __DJGPP__
#define SYM(name) _##name
#define FUNC(name) .globl SYM(name); SYM(name):
#define LOCAL(name) name:
#define ENDFUNC(name)
#define SECTION(name) .section name, "wx"
#define SECTION_BSS(name) .section name, "b"
#define ASM_END
#else
#define SYM(name) name
#define FUNC(name) .globl name; .type name, @function; name:
#define LOCAL(name) .type name, @function; name:
#define ENDFUNC(name) .size name, . - name
#define SECTION(name) .section name, "awx", @progbits
#define SECTION_BSS(name) .section name, "aw", @nobits
#define ASM_END .section .note.GNU-stack,"",@progbits
#endif

#endif
