/* mkexe: the last step of linking; makes DOS executables from ld's output.

     mkexe --make-stub STUB.OUT OUT.EXE          the real-mode stub alone, from ld's output
     mkexe STUB.EXE IN.ELF OUT.EXE               the stub, followed by an ELF program converted to COFF (or with --elf, as below)
     mkexe --stub STUB.EXE --coff IN.EXE OUT.EXE our stub, followed by any DJGPP program (whose own stub is removed)

   A DJGPP program is a stub followed by a COFF file; the stub's MZ header tells where the COFF file starts. Here the COFF file
   consists of file header, go32 optional header and three section headers, together 168 (A8h) bytes, then .text and .data.
   Therefore .text of the ELF program has to start at an address that ends in 0A8h (10A8h in tools/dos.ld), and .data at a
   multiple of 200h, so that file offset and address agree in their last nine bits, as they do in DJGPP's own files.
   (Strip a program before it gets this stub: DJGPP's binutils 2.35 assume that every stub has 2 KB and damage the file.) */

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

using Bytes = std::vector<uint8_t>;

[[noreturn]] void fail(const std::string &what) {
    std::fprintf(stderr, "mkexe: %s\n", what.c_str());
    std::exit(1);
}

Bytes readFile(const std::string &name) {
    FILE *f = std::fopen(name.c_str(), "rb");
    if (!f) fail(name + ": cannot be opened");
    Bytes data;
    uint8_t buffer[65536];
    size_t n;
    while ((n = std::fread(buffer, 1, sizeof buffer, f)) > 0) data.insert(data.end(), buffer, buffer + n);
    if (std::ferror(f)) fail(name + ": cannot be read");
    std::fclose(f);
    return data;
}

void writeFile(const std::string &name, const Bytes &data) {
    FILE *f = std::fopen(name.c_str(), "wb");
    if (!f) fail(name + ": cannot be created");
    if (std::fwrite(data.data(), 1, data.size(), f) != data.size() || std::fclose(f) != 0)
        fail(name + ": cannot be written");
}

uint32_t get(const Bytes &b, size_t at, int bytes) {
    if (at + bytes > b.size()) fail("input file is cut short");
    uint32_t v = 0;
    for (int i = bytes - 1; i >= 0; i--) v = v << 8 | b[at + i];
    return v;
}

void put(Bytes &b, size_t at, uint32_t v, int bytes) {
    if (at + bytes > b.size()) b.resize(at + bytes);
    for (int i = 0; i < bytes; i++, v >>= 8) b[at + i] = uint8_t(v);
}

/* --- ELF --- */

void checkElf(const Bytes &elf, const std::string &name) {
    if (elf.size() < 52 || std::memcmp(elf.data(), "\177ELF\1\1", 6) != 0 || get(elf, 16, 2) != 2 || get(elf, 18, 2) != 3)
        fail(name + ": not an ELF executable for i386");
}

struct Section {
    std::string name;
    uint32_t type, flags, address, offset, size;
};

std::vector<Section> elfSections(const Bytes &elf) {
    uint32_t table = get(elf, 32, 4), entry = get(elf, 46, 2), count = get(elf, 48, 2), names = get(elf, 50, 2);
    uint32_t strings = get(elf, table + names * entry + 16, 4);
    std::vector<Section> result;
    for (uint32_t i = 0; i < count; i++) {
        size_t h = table + i * entry;
        Section s;
        for (size_t c = strings + get(elf, h, 4); get(elf, c, 1); c++) s.name += char(elf[c]);
        s.type = get(elf, h + 4, 4);
        s.flags = get(elf, h + 8, 4);
        s.address = get(elf, h + 12, 4);
        s.offset = get(elf, h + 16, 4);
        s.size = get(elf, h + 20, 4);
        result.push_back(s);
    }
    return result;
}

/* --- The stub: its sections with contents, as an image behind an MZ header. The linker's output is ELF from the stock
       tools and COFF from DJGPP's. --- */

std::vector<Section> coffSections(const Bytes &coff) {
    std::vector<Section> result;
    for (uint32_t i = 0, h = 20 + get(coff, 16, 2); i < get(coff, 2, 2); i++, h += 40) {
        Section s;
        for (uint32_t c = h; c < h + 8 && get(coff, c, 1); c++) s.name += char(coff[c]);
        s.address = get(coff, h + 12, 4);
        s.size = get(coff, h + 16, 4);
        s.offset = get(coff, h + 20, 4);
        s.type = s.offset ? 1 : 8;                    // ELF section type: with contents (1) or without (8)
        s.flags = 2;                                  // ELF section flags: loaded into memory
        result.push_back(s);
    }
    return result;
}

Bytes makeStub(const Bytes &elf, const std::string &name) {
    const bool coff = get(elf, 0, 2) == 0x14c && get(elf, 16, 2) == 28;
    if (!coff) checkElf(elf, name);
    const uint32_t header = 32;                       // size in bytes; the image follows, and all sizes are whole paragraphs
    Bytes image;
    for (const Section &s : coff ? coffSections(elf) : elfSections(elf)) {
        if (s.name != ".loader" && s.name != ".host") continue;
        if (s.type != 1 || !(s.flags & 2) || s.size == 0) fail(name + ": " + s.name + " is empty");
        if (s.offset + s.size > elf.size()) fail(name + ": cut short");
        if (image.size() % 16) fail(name + ": " + s.name + " does not start at a paragraph");
        image.insert(image.end(), elf.begin() + s.offset, elf.begin() + s.offset + s.size);
    }
    uint32_t size = (header + image.size() + 511) / 512 * 512;
    image.resize(size - header);

    /* The first stack lies above all memory that the loader uses: at most 64 KB of transfer buffer, and the host
       behind it. DOS must provide that much memory; the loader returns the unused part at once. */
    const uint32_t stackSegment = 0x1c00, stackSize = 0x400;
    Bytes exe(header);
    put(exe, 0, 0x5a4d, 2);
    put(exe, 2, 0, 2);                                // bytes used in the last page: 0 means all
    put(exe, 4, size / 512, 2);
    put(exe, 8, header / 16, 2);
    put(exe, 10, stackSegment + stackSize / 16 - (size - header) / 16, 2);
    put(exe, 12, 0xffff, 2);
    put(exe, 14, stackSegment, 2);
    put(exe, 16, stackSize, 2);
    put(exe, 20, get(elf, coff ? 20 + 16 : 24, 4), 2); // IP
    put(exe, 24, header, 2);                          // the relocation table is empty
    exe.insert(exe.end(), image.begin(), image.end());
    return exe;
}

/* Returns the size of the MZ part of a file, which is the offset of the data behind it; 0 if there is no MZ header. */
uint32_t mzSize(const Bytes &exe) {
    if (exe.size() < 28 || get(exe, 0, 2) != 0x5a4d) return 0;
    uint32_t size = get(exe, 4, 2) * 512, last = get(exe, 2, 2);
    return last ? size - 512 + last : size;
}

Bytes readStub(const std::string &name) {
    Bytes stub = readFile(name);
    uint32_t size = mzSize(stub);
    if (size == 0 || size > stub.size() || size % 512) fail(name + ": not a stub");
    stub.resize(size);
    return stub;
}

/* --- ELF program to COFF --- */

Bytes makeCoff(const Bytes &elf, const std::string &name) {
    checkElf(elf, name);
    Section text{}, data{}, bss{};
    for (const Section &s : elfSections(elf)) {
        if (!(s.flags & 2) || s.size == 0) continue;
        Section *into = s.name == ".text" ? &text : s.name == ".data" ? &data : s.name == ".bss" ? &bss : nullptr;
        if (!into) fail(name + ": section " + s.name + " is neither .text, .data nor .bss");
        *into = s;
    }
    if (text.size == 0 || text.type != 1) fail(name + ": no .text");
    const uint32_t textOffset = 20 + 28 + 3 * 40;
    if (text.address % 512 != textOffset) fail(name + ": .text does not start at an address that ends in 0A8h");
    if (data.size == 0) data.address = (text.address + text.size + 511) / 512 * 512;
    if (data.address % 512) fail(name + ": .data is not aligned to 200h");
    if (data.size && data.type != 1) fail(name + ": .data has no contents");
    if (bss.size == 0) bss.address = data.address + data.size;
    if (data.address < text.address + text.size || bss.address < data.address + data.size)
        fail(name + ": sections are not in the order .text, .data, .bss");

    uint32_t dataOffset = (textOffset + text.size + 511) / 512 * 512;
    uint32_t dataSize = (data.size + 3) / 4 * 4;
    Bytes coff(dataOffset + dataSize);
    put(coff, 0, 0x14c, 2);                           // i386
    put(coff, 2, 3, 2);                               // count of sections
    put(coff, 16, 28, 2);                             // size of the optional header
    put(coff, 18, 0x010f, 2);                         // no relocations, line numbers, symbols; executable, 32-bit LE
    put(coff, 20, 0x010b, 2);                         // demand paged
    put(coff, 24, text.size, 4);
    put(coff, 28, dataSize, 4);
    put(coff, 32, bss.size, 4);
    put(coff, 36, get(elf, 24, 4), 4);                // entry
    put(coff, 40, text.address, 4);
    put(coff, 44, data.address, 4);
    struct { const char *name; const Section &s; uint32_t size, offset, flags; } headers[] = {
        {".text", text, text.size, textOffset, 0x20},
        {".data", data, dataSize, dataSize ? dataOffset : 0, 0x40},
        {".bss", bss, bss.size, 0, 0x80},
    };
    size_t h = 48;
    for (const auto &s : headers) {
        std::memcpy(&coff[h], s.name, std::strlen(s.name));
        put(coff, h + 8, s.s.address, 4);
        put(coff, h + 12, s.s.address, 4);
        put(coff, h + 16, s.size, 4);
        put(coff, h + 20, s.offset, 4);
        put(coff, h + 36, s.flags, 4);
        h += 40;
    }
    if (text.offset + text.size > elf.size() || data.offset + (data.type == 1 ? data.size : 0) > elf.size())
        fail(name + ": cut short");
    std::memcpy(&coff[textOffset], &elf[text.offset], text.size);
    if (data.size) std::memcpy(&coff[dataOffset], &elf[data.offset], data.size);
    return coff;
}

/* Returns the COFF part of a DJGPP program with or without a stub. */
Bytes takeCoff(const std::string &name) {
    Bytes exe = readFile(name);
    uint32_t start = mzSize(exe);
    if (start > exe.size()) fail(name + ": cut short");
    Bytes coff(exe.begin() + start, exe.end());
    if (coff.size() < 168 || get(coff, 0, 2) != 0x14c || get(coff, 16, 2) != 28) fail(name + ": no COFF program in it");
    return coff;
}

} // namespace

int main(int argc, char **argv) {
    std::vector<std::string> a(argv + 1, argv + argc);
    if (a.size() == 3 && a[0] == "--make-stub") {
        writeFile(a[2], makeStub(readFile(a[1]), a[1]));
        return 0;
    }
    if (a.size() == 3 && a[0][0] != '-') a = {"--stub", a[0], "--elf", a[1], a[2]};
    if (a.size() == 5 && a[0] == "--stub" && (a[2] == "--elf" || a[2] == "--coff")) {
        Bytes exe = readStub(a[1]);
        Bytes coff = a[2] == "--elf" ? makeCoff(readFile(a[3]), a[3]) : takeCoff(a[3]);
        exe.insert(exe.end(), coff.begin(), coff.end());
        writeFile(a[4], exe);
        return 0;
    }
    std::fprintf(stderr, "use: mkexe --make-stub STUB.OUT OUT.EXE\n"
                         "     mkexe STUB.EXE IN.ELF OUT.EXE\n"
                         "     mkexe --stub STUB.EXE --coff IN.EXE OUT.EXE\n");
    return 2;
}
