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

// Says what is wrong. Returns false, for its callers to return too.
bool trouble(const std::string &what) {
  std::fprintf(stderr, "mkgif: %s\n", what.c_str());
  return false;
}

struct Options {
  long delay = 10, scale = 1, from = 0, to = 9999999, every = 1;
  bool tall = false;
  std::vector<std::string> names;   // OUT.GIF, DIR
};

bool readArguments(int argc, char **argv, Options &o) {
  struct {
    const char *name, *range;
    long least, most, *value;
  } numbers[] = {{"--delay", "1 to 65535 hundredths of a second", 1, 65535, &o.delay},
                 {"--scale", "1 to 4", 1, 4, &o.scale},
                 {"--from", "a frame's number", 0, 9999999, &o.from},
                 {"--to", "a frame's number", 0, 9999999, &o.to},
                 {"--every", "1 or more", 1, 9999999, &o.every}};
  for (int i = 1; i < argc; i++) {
    std::string a = argv[i];
    bool known = a == "--43";
    if (known) o.tall = true;
    for (auto &n : numbers) {
      if (a != n.name) continue;
      known = true;
      if (i + 1 >= argc || !wholeNumber(argv[++i], n.least, n.most, *n.value)) return trouble(a + " wants " + n.range);
    }
    if (!known && a[0] == '-') return trouble("unknown option: " + a);
    if (!known) o.names.push_back(a);
  }
  return o.names.size() == 2 ||
         trouble("usage: mkgif [--delay N] [--43] [--scale N] [--from N] [--to N] [--every N] OUT.GIF DIR");
}

// Lists the chosen frames of the directory in ascending order.
bool listFrames(const Options &o, std::vector<std::string> &files) {
  std::error_code error;
  std::filesystem::directory_iterator it(o.names[1], error), end;
  if (error) return trouble(o.names[1] + ": " + error.message());
  for (; it != end; it.increment(error)) {
    std::string name = it->path().filename().string();
    if (name.size() != 12 || name[0] != 'F' || name.substr(8) != ".PPM" ||
        name.find_first_not_of("0123456789", 1) != 8)
      continue;
    long n = std::atol(name.c_str() + 1);
    if (n >= o.from && n <= o.to && (n - o.from) % o.every == 0) files.push_back(it->path().string());
  }
  std::sort(files.begin(), files.end());
  return !files.empty() || trouble(o.names[1] + ": no frames");
}

bool readFrames(const std::vector<std::string> &files, std::vector<Image> &frames) {
  frames.resize(files.size());
  for (size_t i = 0; i < files.size(); i++) {
    std::string why;
    if (!readPpm(files[i], frames[i], why)) return trouble(why);
    if (frames[i].width != frames[0].width || frames[i].height != frames[0].height)
      return trouble(files[i] + ": is not of the first frame's size");
  }
  return true;
}

// A part of the picture: columns x0 to x1 - 1, rows y0 to y1 - 1.
struct Part {
  int x0, y0, x1, y1;
};

// Returns the smallest part that has all pixels in which two pictures differ.
Part changed(const Image &before, const Image &after) {
  Part part = {after.width, after.height, 0, 0};
  for (int y = 0; y < after.height; y++)
    for (int x = 0; x < after.width; x++)
      if (after.pixels[y * after.width + x] != before.pixels[y * after.width + x]) {
        part.x0 = std::min(part.x0, x), part.x1 = std::max(part.x1, x + 1);
        part.y0 = std::min(part.y0, y), part.y1 = std::max(part.y1, y + 1);
      }
  if (part.x1 == 0) part = {0, 0, 1, 1};   // nothing changed: one pixel is stored for its delay
  return part;
}

// Drops as few low bits of the colours as make them fit into a palette, and returns the palette.
Palette reduce(Image &p) {
  Palette own;
  uint32_t mask = 0xFFFFFF;
  for (int bits = 1; !own.add(p, mask); bits++) {
    own = Palette();
    mask = (0xFF << bits & 0xFF) * 0x010101;
  }
  for (uint32_t &c : p.pixels) c &= mask;
  return own;
}

void putHeader(int width, int height, const Palette *shared, std::string &out) {
  out += "GIF89a";
  put16(out, width);
  put16(out, height);
  out += (char)(shared ? 0xF0 | (bitsFor(shared->colours.size()) - 1) : 0x70);
  put16(out, 0);
  if (shared) putTable(*shared, out);
  out += "\x21\xFF\x0BNETSCAPE2.0";   // repeat for ever
  out += std::string("\x03\x01\x00\x00\x00", 5);
}

// Appends a part of a picture, to be shown for `delay`. The palette is stored with it if it is the picture's own.
void putPicture(const Image &p, const Part &part, long delay, const Palette &palette, bool own, std::string &out) {
  int bits = bitsFor(palette.colours.size());
  out += std::string("\x21\xF9\x04\x04", 4);   // the picture stays in place afterwards
  put16(out, (int)delay);
  out += std::string(2, '\0');
  out += ',';
  put16(out, part.x0);
  put16(out, part.y0);
  put16(out, part.x1 - part.x0);
  put16(out, part.y1 - part.y0);
  out += (char)(own ? 0x80 | (bits - 1) : 0);
  if (own) putTable(palette, out);
  std::vector<uint8_t> indices;
  for (int y = part.y0; y < part.y1; y++)
    for (int x = part.x0; x < part.x1; x++)
      indices.push_back((uint8_t)palette.place.find(p.pixels[y * p.width + x])->second);
  compress(indices, bits, out);
}

}  // namespace

int main(int argc, char **argv) {
  Options o;
  std::vector<std::string> files;
  std::vector<Image> frames;
  if (!readArguments(argc, argv, o) || !listFrames(o, files) || !readFrames(files, frames)) return 2;
  // All frames share one palette if it can hold their exact colours; otherwise each frame has its own.
  Palette shared;
  bool fits = true;
  for (const Image &frame : frames) fits = fits && shared.add(frame);

  std::string out;
  int width = (int)(frames[0].width * o.scale), height = (int)(frames[0].height * o.scale * (o.tall ? 6 : 5) / 5);
  putHeader(width, height, fits ? &shared : nullptr, out);
  Image shown;
  for (const Image &frame : frames) {
    Image p = stretch(frame, (int)o.scale, o.tall);
    Palette own;
    if (!fits) own = reduce(p);
    // Only the part that changed is stored; the rest of the picture stays on the screen.
    Part part = shown.pixels.empty() ? Part{0, 0, width, height} : changed(shown, p);
    putPicture(p, part, o.delay, fits ? shared : own, !fits, out);
    shown = std::move(p);
  }
  out += ';';

  FILE *f = std::fopen(o.names[0].c_str(), "wb");
  bool good = f && std::fwrite(out.data(), 1, out.size(), f) == out.size();
  if (f && std::fclose(f) != 0) good = false;
  if (!good) {
    trouble(o.names[0] + ": cannot be written");
    return 2;
  }
  std::printf("%s: %zu frames, %dx%d, %zu bytes, %s\n", o.names[0].c_str(), frames.size(), width,
              height, out.size(), fits ? "colours exact" : "a palette for each frame");
  return 0;
}
