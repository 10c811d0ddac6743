// ppm2png: converts a PPM picture to a PNG file.
//
//   ppm2png [--43] [--scale N] IN.PPM OUT.PNG
//
// It makes the pictures of the README from dumped frames on a machine that has only a compiler. It writes a palette picture
// if 256 colours suffice, else 24-bit colour, compressed with deflate's fixed codes (RFC 1950, 1951, 2083).
#include "picture.h"

#include <algorithm>

namespace {

void put32(std::string &out, uint32_t v) {
  for (int s = 24; s >= 0; s -= 8) out += (char)(v >> s);
}

uint32_t crc(const std::string &data) {
  uint32_t c = ~0u;
  for (unsigned char b : data) {
    c ^= b;
    for (int k = 0; k < 8; k++) c = c & 1 ? c >> 1 ^ 0xEDB88320u : c >> 1;
  }
  return ~c;
}

void chunk(std::string &out, const std::string &name, const std::string &data) {
  put32(out, (uint32_t)data.size());
  out += name + data;
  put32(out, crc(name + data));
}

class Bits {
public:
  explicit Bits(std::string &o) : out(o) {}
  // Appends a number, low bit first, as deflate stores numbers.
  void number(uint32_t v, int bits) {
    for (int i = 0; i < bits; i++) bit(v >> i & 1);
  }
  // Appends a code, high bit first, as deflate stores codes.
  void code(uint32_t v, int bits) {
    for (int i = bits - 1; i >= 0; i--) bit(v >> i & 1);
  }
  void end() {
    while (count) bit(0);
  }
private:
  void bit(uint32_t b) {
    held |= b << count;
    if (++count == 8) {
      out += (char)held;
      held = 0;
      count = 0;
    }
  }
  std::string &out;
  uint32_t held = 0;
  int count = 0;
};

// Appends the fixed code of a literal or length symbol.
void symbol(Bits &bits, int s) {
  if (s < 144) bits.code(0x30 + s, 8);
  else if (s < 256) bits.code(0x190 + s - 144, 9);
  else if (s < 280) bits.code(s - 256, 7);
  else bits.code(0xC0 + s - 280, 8);
}

// Lengths (from 3) and distances (from 1) are divided into classes; the count of extra bits grows by one every four classes
// of lengths and every two classes of distances.
void putLength(Bits &bits, int length) {
  if (length == 258) return symbol(bits, 285);
  int v = length - 3, extra = 0;
  while (v >> extra >= 8) extra++;
  symbol(bits, 257 + 4 * extra + (v >> extra));
  bits.number(v & ((1 << extra) - 1), extra);
}

void putDistance(Bits &bits, int distance) {
  int v = distance - 1, extra = 0;
  while (v >> extra >= 4) extra++;
  bits.code(2 * extra + (v >> extra), 5);
  bits.number(v & ((1 << extra) - 1), extra);
}

// Returns zlib data in one block of fixed codes. Repeats are found by a hash of three bytes; at most 64 candidates are tried.
std::string deflate(const std::string &in) {
  std::string out("\x78\x01", 2);
  Bits bits(out);
  bits.number(1, 1);   // this is the last block
  bits.number(1, 2);   // fixed codes
  const int n = (int)in.size(), window = 32768;
  std::vector<int> head(65536, -1), before(n, -1);
  auto note = [&](int i) {
    if (i + 3 > n) return;
    uint32_t h = ((uint8_t)in[i] << 16 | (uint8_t)in[i + 1] << 8 | (uint8_t)in[i + 2]) * 2654435761u >> 16;
    before[i] = head[h];
    head[h] = i;
  };
  for (int i = 0; i < n;) {
    int best = 0, distance = 0;
    note(i);
    int c = before[i];
    for (int tries = 0; tries < 64 && c >= 0 && i - c <= window; tries++, c = before[c]) {
      int len = 0, most = std::min(258, n - i);
      while (len < most && in[c + len] == in[i + len]) len++;
      if (len > best) best = len, distance = i - c;
    }
    if (best >= 3) {
      putLength(bits, best);
      putDistance(bits, distance);
      for (int k = 1; k < best; k++) note(i + k);
      i += best;
    } else {
      symbol(bits, (uint8_t)in[i++]);
    }
  }
  symbol(bits, 256);
  bits.end();
  uint32_t a = 1, b = 0;
  for (unsigned char v : in) {
    a = (a + v) % 65521;
    b = (b + a) % 65521;
  }
  put32(out, b << 16 | a);
  return out;
}

int trouble(const std::string &what) {
  std::fprintf(stderr, "ppm2png: %s\n", what.c_str());
  return 2;
}

}  // namespace

int main(int argc, char **argv) {
  long scale = 1;
  bool tall = false;
  std::vector<std::string> names;
  for (int i = 1; i < argc; i++) {
    std::string a = argv[i];
    if (a == "--43") tall = true;
    else if (a == "--scale") {
      if (i + 1 >= argc || !wholeNumber(argv[++i], 1, 4, scale)) return trouble("--scale wants 1 to 4");
    } else if (a[0] == '-') return trouble("unknown option: " + a);
    else names.push_back(a);
  }
  if (names.size() != 2) return trouble("usage: ppm2png [--43] [--scale N] IN.PPM OUT.PNG");
  Image p;
  std::string why;
  if (!readPpm(names[0], p, why)) return trouble(why);
  p = stretch(p, (int)scale, tall);

  Palette palette;
  bool fits = palette.add(p);
  std::string header, rows;
  put32(header, p.width);
  put32(header, p.height);
  header += (char)8;
  header += (char)(fits ? 3 : 2);   // colour type: palette or RGB
  header += std::string(3, '\0');
  for (int y = 0; y < p.height; y++) {
    // Colour rows are stored as differences from the pixel to the left.
    rows += (char)(fits ? 0 : 1);
    uint32_t left = 0;
    for (int x = 0; x < p.width; x++) {
      uint32_t c = p.pixels[(size_t)y * p.width + x];
      if (fits) {
        rows += (char)palette.place.find(c)->second;
        continue;
      }
      for (int s = 16; s >= 0; s -= 8) rows += (char)((c >> s) - (left >> s));
      left = c;
    }
  }
  std::string out = "\x89PNG\r\n\x1A\n";
  chunk(out, "IHDR", header);
  if (fits) {
    std::string table;
    for (uint32_t c : palette.colours) {
      table += (char)(c >> 16);
      table += (char)(c >> 8);
      table += (char)c;
    }
    chunk(out, "PLTE", table);
  }
  chunk(out, "IDAT", deflate(rows));
  chunk(out, "IEND", "");
  FILE *f = std::fopen(names[1].c_str(), "wb");
  bool good = f && std::fwrite(out.data(), 1, out.size(), f) == out.size();
  if (f && std::fclose(f) != 0) good = false;
  return good ? 0 : trouble(names[1] + ": cannot be written");
}
