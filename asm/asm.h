/* What every assembly file includes: it lets one source assemble for ELF (stock gcc -m32) and for
   DJGPP's COFF, where C symbols carry a leading underscore.

   SYM(name)   a symbol shared with C or C++
   SECTION(name), SECTION_BSS(name)    a section of its own, with code and data, or without contents
   FUNC(name), ENDFUNC(name)    round a routine that C++ calls: its label and, on ELF, its type and size, by which profilers
               know it
   LOCAL(name), ENDFUNC(name)   the same of one that only its own file calls
   ASM_END     last line of each file: on ELF it says that the file needs no executable stack */
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
