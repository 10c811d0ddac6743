// mkgif: makes an animated GIF from the dumped frames of a run.
//
//   mkgif [--delay N] [--43] [--scale N] [--from N] [--to N] [--every N] OUT.GIF DIR
//
// It makes the animated picture of the README from the program's own frames on a machine that has only a compiler. The
// format is CompuServe's GIF89a. Colours are exact as long as a frame has at most 256 of them; otherwise low bits are
// dropped until they fit.
#include "picture.h"

#include <algorithm>
#include <filesystem>

namespace {

void put16(std::string &out, int v) {
  out += (char)v;
  out += (char)(v >> 8);
}

// Writes the variable-length codes of GIF's LZW: packed from the low bit up and divided into blocks of 255 bytes.
class Codes {
public:
  explicit Codes(std::string &o) : out(o) {}
  void put(int code, int bits) {
    held |= (uint32_t)code << count;
    for (count += bits; count >= 8; count -= 8, held >>= 8) byte((uint8_t)held);
  }
  void end() {
    if (count > 0) byte((uint8_t)held);
    if (!block.empty()) flush();
    out += '\0';
  }
private:
  void byte(uint8_t b) {
    block += (char)b;
    if (block.size() == 255) flush();
  }
  void flush() {
    out += (char)block.size();
    out += block;
    block.clear();
  }
  std::string &out, block;
  uint32_t held = 0;
  int count = 0;
};

// Appends the compressed indices. Each index is below 1 << bits; bits is 2 to 8.
void compress(const std::vector<uint8_t> &indices, int bits, std::string &out) {
  const int clear = 1 << bits, stop = clear + 1, full = 4096;
  out += (char)bits;
  Codes codes(out);
  // next[code][index] is the code of the string of `code` followed by `index`.
  std::vector<uint16_t> next(full * 256);
  int size = bits + 1, free = stop + 1, prefix = -1;
  codes.put(clear, size);
  for (uint8_t i : indices) {
    if (prefix < 0) {
      prefix = i;
      continue;
    }
    uint16_t &longer = next[prefix * 256 + i];
    if (longer) {
      prefix = longer;
      continue;
    }
    codes.put(prefix, size);
    if (free < full) {
      // The decoder is one string behind the encoder, so codes become longer only when the string just made no longer fits.
      if (free == 1 << size) size++;
      longer = (uint16_t)free++;
    } else {
      codes.put(clear, size);
      std::fill(next.begin(), next.end(), 0);
      size = bits + 1;
      free = stop + 1;
    }
    prefix = i;
  }
  if (prefix >= 0) {
    codes.put(prefix, size);
    if (free < full && free == 1 << size) size++;
  }
  codes.put(stop, size);
  codes.end();
}

int bitsFor(size_t colours) {
  int bits = 2;
  while ((1u << bits) < colours) bits++;
  return bits;
}

void putTable(const Palette &p, std::string &out) {
  for (int i = 0; i < 1 << bitsFor(p.colours.size()); i++) {
    uint32_t c = i < (int)p.colours.size() ? p.colours[i] : 0;
    out += (char)(c >> 16);
    out += (char)(c >> 8);
    out += (char)c;
  }
}

int trouble(const std::string &what) {
  std::fprintf(stderr, "mkgif: %s\n", what.c_str());
  return 2;
}

}  // namespace

int main(int argc, char **argv) {
  long delay = 10, scale = 1, from = 0, to = 9999999, every = 1;
  bool tall = false;
  std::vector<std::string> names;
  struct {
    const char *name, *range;
    long least, most, *value;
  } options[] = {{"--delay", "1 to 65535 hundredths of a second", 1, 65535, &delay},
                 {"--scale", "1 to 4", 1, 4, &scale},
                 {"--from", "a frame's number", 0, 9999999, &from},
                 {"--to", "a frame's number", 0, 9999999, &to},
                 {"--every", "1 or more", 1, 9999999, &every}};
  for (int i = 1; i < argc; i++) {
    std::string a = argv[i];
    bool known = a == "--43";
    if (known) tall = true;
    for (auto &o : options) {
      if (a != o.name) continue;
      known = true;
      if (i + 1 >= argc || !wholeNumber(argv[++i], o.least, o.most, *o.value))
        return trouble(a + " wants " + o.range);
    }
    if (!known && a[0] == '-') return trouble("unknown option: " + a);
    if (!known) names.push_back(a);
  }
  if (names.size() != 2)
    return trouble("usage: mkgif [--delay N] [--43] [--scale N] [--from N] [--to N] [--every N] OUT.GIF DIR");

  std::vector<std::string> files;
  std::error_code error;
  std::filesystem::directory_iterator it(names[1], error), end;
  if (error) return trouble(names[1] + ": " + error.message());
  for (; it != end; it.increment(error)) {
    std::string name = it->path().filename().string();
    if (name.size() != 12 || name[0] != 'F' || name.substr(8) != ".PPM" ||
        name.find_first_not_of("0123456789", 1) != 8)
      continue;
    long n = std::atol(name.c_str() + 1);
    if (n >= from && n <= to && (n - from) % every == 0) files.push_back(it->path().string());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) return trouble(names[1] + ": no frames");

  std::vector<Image> frames(files.size());
  Palette shared;
  bool fits = true;
  for (size_t i = 0; i < files.size(); i++) {
    std::string why;
    if (!readPpm(files[i], frames[i], why)) return trouble(why);
    if (frames[i].width != frames[0].width || frames[i].height != frames[0].height)
      return trouble(files[i] + ": is not of the first frame's size");
    fits = fits && shared.add(frames[i]);
  }
  int width = (int)(frames[0].width * scale), height = (int)(frames[0].height * scale * (tall ? 6 : 5) / 5);

  std::string out = "GIF89a";
  put16(out, width);
  put16(out, height);
  // All frames share one palette if it can hold their exact colours; otherwise each frame has its own.
  out += (char)(fits ? 0xF0 | (bitsFor(shared.colours.size()) - 1) : 0x70);
  put16(out, 0);
  if (fits) putTable(shared, out);
  out += "\x21\xFF\x0BNETSCAPE2.0";   // repeat for ever
  out += std::string("\x03\x01\x00\x00\x00", 5);

  Image shown;
  for (const Image &frame : frames) {
    Image p = stretch(frame, (int)scale, tall);
    Palette own;
    uint32_t mask = 0xFFFFFF;
    for (int bits = 1; !fits && !own.add(p, mask); bits++) {
      own = Palette();
      mask = (0xFF << bits & 0xFF) * 0x010101;
    }
    const Palette &palette = fits ? shared : own;
    for (uint32_t &c : p.pixels) c &= mask;
    // Only the rectangle that changed is stored; the rest of the picture stays on the screen.
    int x0 = 0, y0 = 0, x1 = width, y1 = height;
    if (!shown.pixels.empty()) {
      x0 = width, y0 = height, x1 = y1 = 0;
      for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
          if (p.pixels[y * width + x] != shown.pixels[y * width + x]) {
            x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
            y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
          }
      if (x1 == 0) x0 = y0 = 0, x1 = y1 = 1;   // nothing changed: one pixel is stored for its delay
    }
    int bits = bitsFor(palette.colours.size());
    out += std::string("\x21\xF9\x04\x04", 4);   // the picture stays in place afterwards
    put16(out, (int)delay);
    out += std::string(2, '\0');
    out += ',';
    put16(out, x0);
    put16(out, y0);
    put16(out, x1 - x0);
    put16(out, y1 - y0);
    out += (char)(fits ? 0 : 0x80 | (bits - 1));
    if (!fits) putTable(palette, out);
    std::vector<uint8_t> indices;
    for (int y = y0; y < y1; y++)
      for (int x = x0; x < x1; x++)
        indices.push_back((uint8_t)palette.place.find(p.pixels[y * width + x])->second);
    compress(indices, bits, out);
    shown = std::move(p);
  }
  out += ';';

  FILE *f = std::fopen(names[0].c_str(), "wb");
  bool good = f && std::fwrite(out.data(), 1, out.size(), f) == out.size();
  if (f && std::fclose(f) != 0) good = false;
  if (!good) return trouble(names[0] + ": cannot be written");
  std::printf("%s: %zu frames, %dx%d, %zu bytes, %s\n", names[0].c_str(), frames.size(), width,
              height, out.size(), fits ? "colours exact" : "a palette for each frame");
  return 0;
}
