// Tests of the picture tools with a decoder of their own.
//
//   picstst make DIR                writes frames that are hard to compress
//   picstst gif FILE DIR SCALE 43|- OFF DELAY FRAME...
//                                   the GIF must show exactly these frames of DIR, with no sample off by more than OFF
//   picstst png FILE PPM SCALE 43|-  the PNG must show the picture
//
// This file exists so that the tools are tested even where no other program that reads these formats is installed. The
// decoders are written from the descriptions of the formats, not from the encoders.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

typedef std::vector<uint8_t> Bytes;

[[noreturn]] static void fail(const std::string &what) {
  std::printf("%s\n", what.c_str());
  std::exit(1);
}

static Bytes readAll(const std::string &path) {
  FILE *f = std::fopen(path.c_str(), "rb");
  if (!f) fail("cannot open " + path);
  Bytes data;
  for (int c; (c = std::fgetc(f)) != EOF;) data.push_back((uint8_t)c);
  std::fclose(f);
  return data;
}

struct Rgb {
  int width = 0, height = 0;
  Bytes samples;
};

static Rgb readPpm(const std::string &path) {
  Bytes d = readAll(path);
  Rgb p;
  int used = 0;
  d.push_back(0);
  if (std::sscanf((const char *)d.data(), "P6 %d %d 255%n", &p.width, &p.height, &used) != 2 || !used)
    fail("no PPM: " + path);
  p.samples.assign(d.begin() + used + 1, d.end() - 1);
  if ((int)p.samples.size() != p.width * p.height * 3) fail("short PPM: " + path);
  return p;
}

static Rgb stretched(const Rgb &p, int scale, bool tall) {
  Rgb out;
  out.width = p.width * scale;
  out.height = p.height * scale * (tall ? 12 : 10) / 10;
  for (int y = 0; y < out.height; y++)
    for (int x = 0; x < out.width; x++)
      for (int k = 0; k < 3; k++)
        out.samples.push_back(p.samples[3 * (y * p.height / out.height * p.width + x / scale) + k]);
  return out;
}

static void same(const Rgb &got, const Rgb &want, int off, const std::string &what) {
  if (got.width != want.width || got.height != want.height) fail(what + ": wrong size");
  if (got.samples.size() != want.samples.size()) fail(what + ": wrong length");
  for (size_t i = 0; i < got.samples.size(); i++)
    if (std::abs(got.samples[i] - want.samples[i]) > off)
      fail(what + ": differs at pixel " + std::to_string(i / 3));
}

// ---- GIF ------------------------------------------------------------------------

static Bytes unpackLzw(const Bytes &in, int bits) {
  struct Entry {
    int prefix;
    uint8_t last, first;
  };
  const int clear = 1 << bits;
  std::vector<Entry> table;
  Bytes out;
  int size = 0, before = -1;
  size_t at = 0;
  auto reset = [&]() {
    table.clear();
    for (int i = 0; i < clear + 2; i++) table.push_back({-1, (uint8_t)i, (uint8_t)i});
    size = bits + 1;
    before = -1;
  };
  reset();
  for (bool started = false;;) {
    int code = 0;
    for (int i = 0; i < size; i++, at++) {
      if (at / 8 >= in.size()) fail("LZW: no end code");
      code |= (in[at / 8] >> (at % 8) & 1) << i;
    }
    if (!started && code != clear) fail("LZW: does not begin with a clear code");
    started = true;
    if (code == clear) {
      reset();
      continue;
    }
    if (code == clear + 1) break;
    if (code > (int)table.size() || (code == (int)table.size() && before < 0)) fail("LZW: bad code");
    if (before >= 0 && table.size() < 4096) {
      uint8_t head = code == (int)table.size() ? table[before].first : table[code].first;
      table.push_back({before, head, table[before].first});
      if ((int)table.size() == 1 << size && size < 12) size++;
    }
    if (code >= (int)table.size()) fail("LZW: code after a full table");
    size_t from = out.size();
    for (int c = code; c >= 0; c = table[c].prefix) out.push_back(table[c].last);
    std::reverse(out.begin() + from, out.end());
    before = code;
  }
  if ((at + 7) / 8 != in.size()) fail("LZW: data after the end code");
  return out;
}

static std::vector<Rgb> readGif(const std::string &path, int &delay) {
  Bytes d = readAll(path);
  size_t at = 0;
  auto byte = [&]() -> int {
    if (at >= d.size()) fail("GIF: too short");
    return d[at++];
  };
  auto word = [&]() {
    int low = byte();
    return low | byte() << 8;
  };
  auto table = [&](int flags) {
    Bytes t;
    for (int i = 0; i < 3 << ((flags & 7) + 1); i++) t.push_back((uint8_t)byte());
    return t;
  };
  auto blocks = [&]() {
    Bytes all;
    for (int n; (n = byte()) != 0;)
      while (n--) all.push_back((uint8_t)byte());
    return all;
  };
  if (d.size() < 6 || std::memcmp(d.data(), "GIF89a", 6)) fail("GIF: no signature");
  at = 6;
  Rgb screen;
  screen.width = word();
  screen.height = word();
  screen.samples.assign(screen.width * screen.height * 3, 0);
  int flags = byte();
  byte();
  byte();
  Bytes shared;
  if (flags & 0x80) shared = table(flags);
  std::vector<Rgb> frames;
  bool loops = false;
  for (int c; (c = byte()) != ';';) {
    if (c == '!') {
      int kind = byte();
      Bytes b = blocks();
      if (kind == 0xF9) {
        if (b.size() != 4 || (b[0] & 1)) fail("GIF: control block");
        delay = b[1] | b[2] << 8;
      }
      loops = loops || (kind == 0xFF && b.size() == 14 && !std::memcmp(b.data(), "NETSCAPE2.0\1\0\0", 14));
      continue;
    }
    if (c != ',') fail("GIF: unknown block");
    int x0 = word(), y0 = word(), w = word(), h = word(), local = byte();
    Bytes colours = local & 0x80 ? table(local) : shared;
    int bits = byte();
    Bytes pixels = unpackLzw(blocks(), bits);
    if ((int)pixels.size() != w * h || x0 + w > screen.width || y0 + h > screen.height)
      fail("GIF: wrong number of pixels");
    for (int i = 0; i < w * h; i++) {
      if (pixels[i] * 3u >= colours.size()) fail("GIF: colour out of the table");
      std::copy_n(&colours[pixels[i] * 3], 3,
                  &screen.samples[3 * ((y0 + i / w) * screen.width + x0 + i % w)]);
    }
    frames.push_back(screen);
  }
  if (at != d.size()) fail("GIF: data after the end");
  if (!loops) fail("GIF: plays only once");
  return frames;
}

// ---- PNG ------------------------------------------------------------------------

static uint32_t crcTable(uint8_t n) {
  uint32_t c = n;
  for (int k = 0; k < 8; k++) c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
  return c;
}

// Unpacks zlib data that consists of stored blocks and blocks of fixed codes.
static Bytes inflate(const Bytes &in) {
  static const int lengths[] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
  static const int lengthBits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                   2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
  static const int distances[] = {1,   2,   3,   4,   5,   7,    9,    13,   17,   25,
                                  33,  49,  65,  97,  129, 193,  257,  385,  513,  769,
                                  1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
  static const int distanceBits[] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                     6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
  if (in.size() < 6 || (in[0] & 15) != 8 || (in[0] * 256 + in[1]) % 31) fail("PNG: no zlib header");
  size_t at = 16;
  auto bit = [&]() -> int {
    if (at / 8 >= in.size()) fail("PNG: data too short");
    int b = in[at / 8] >> (at % 8) & 1;
    at++;
    return b;
  };
  auto number = [&](int n) {
    int v = 0;
    for (int i = 0; i < n; i++) v |= bit() << i;
    return v;
  };
  auto code = [&](int n) {
    int v = 0;
    while (n--) v = v * 2 + bit();
    return v;
  };
  Bytes out;
  for (bool last = false; !last;) {
    last = bit();
    if (number(2) != 1) fail("PNG: not the fixed codes");
    while (true) {
      int v = code(7), s;
      if (v <= 23) s = 256 + v;
      else if ((v = v * 2 + bit()) >= 48 && v <= 191) s = v - 48;
      else if (v >= 192 && v <= 199) s = 280 + v - 192;
      else s = 144 + (v * 2 + bit()) - 400;
      if (s == 256) break;
      if (s < 256) {
        out.push_back((uint8_t)s);
        continue;
      }
      int length = lengths[s - 257] + number(lengthBits[s - 257]), d = code(5);
      if (d > 29) fail("PNG: bad distance");
      size_t back = distances[d] + number(distanceBits[d]);
      if (back > out.size()) fail("PNG: distance too far");
      while (length--) out.push_back(out[out.size() - back]);
    }
  }
  at = (at + 7) / 8;
  uint32_t a = 1, b = 0;
  for (uint8_t v : out) a = (a + v) % 65521, b = (b + a) % 65521;
  uint8_t sum[4] = {(uint8_t)(b >> 8), (uint8_t)b, (uint8_t)(a >> 8), (uint8_t)a};
  if (at + 4 != in.size() || std::memcmp(&in[at], sum, 4)) fail("PNG: Adler sum");
  return out;
}

static Rgb readPng(const std::string &path) {
  Bytes d = readAll(path), table, data;
  if (d.size() < 8 || std::memcmp(d.data(), "\x89PNG\r\n\x1A\n", 8)) fail("PNG: no signature");
  Rgb p;
  int kind = -1;
  std::string name;
  for (size_t at = 8; name != "IEND";) {
    auto word = [&](size_t i) {
      if (i + 4 > d.size()) fail("PNG: too short");
      return (uint32_t)d[i] << 24 | d[i + 1] << 16 | d[i + 2] << 8 | d[i + 3];
    };
    uint32_t n = word(at), c = ~0u;
    word(at + 8 + n);
    name.assign(d.begin() + at + 4, d.begin() + at + 8);
    for (size_t i = at + 4; i < at + 8 + n; i++) c = crcTable((uint8_t)(c ^ d[i])) ^ c >> 8;
    if (~c != word(at + 8 + n)) fail("PNG: CRC of " + name);
    Bytes body(d.begin() + at + 8, d.begin() + at + 8 + n);
    if (name == "IHDR") {
      p.width = (int)word(at + 8), p.height = (int)word(at + 12);
      kind = body[9];
      if (n != 13 || body[8] != 8 || body[10] || body[11] || body[12]) fail("PNG: header");
    }
    if (name == "PLTE") table = body;
    if (name == "IDAT") data.insert(data.end(), body.begin(), body.end());
    at += 12 + n;
    if (name == "IEND" && at != d.size()) fail("PNG: data after the end");
  }
  if (kind != 2 && kind != 3) fail("PNG: kind of colour");
  Bytes rows = inflate(data);
  int each = kind == 3 ? 1 : 3, row = p.width * each + 1;
  if ((int)rows.size() != row * p.height) fail("PNG: wrong number of rows");
  for (int y = 0; y < p.height; y++) {
    uint8_t *r = &rows[y * row + 1];
    if (r[-1] > 1) fail("PNG: filter");
    if (r[-1] == 1)
      for (int i = each; i < row - 1; i++) r[i] = (uint8_t)(r[i] + r[i - each]);
    for (int i = 0; i < row - 1; i++) {
      if (kind == 2) {
        p.samples.push_back(r[i]);
      } else {
        if (r[i] * 3u + 2 >= table.size()) fail("PNG: colour out of the table");
        p.samples.insert(p.samples.end(), &table[r[i] * 3], &table[r[i] * 3] + 3);
      }
    }
  }
  return p;
}

// ---- pictures to try ----------------------------------------------------------------

static void make(const std::string &dir) {
  uint32_t state = 1;
  auto noise = [&]() { return (state = state * 1664525u + 1013904223u) >> 24; };
  for (int n = 0; n < 8; n++) {
    Bytes rgb(320 * 200 * 3);
    for (int y = 0; y < 200; y++)
      for (int x = 0; x < 320; x++) {
        uint8_t *p = &rgb[3 * (y * 320 + x)];
        int v = 0;
        if (n == 1 || n == 2) v = std::max(0, 255 - ((x - 100 - 9 * n) * (x - 100 - 9 * n) + (y - 90) * (y - 90)) / 9);
        if (n == 3) v = (int)noise();              // all 256 greys in random order
        if (n == 4 || n == 5) v = (x + y) % 2 * 255;   // two greys in alternation; frames 4 and 5 are the same
        p[0] = p[1] = p[2] = (uint8_t)v;
        if (n == 6) p[0] = (uint8_t)x, p[1] = (uint8_t)y;         // thousands of colours
        if (n == 7) p[0] = (uint8_t)(x / 20 * 16), p[1] = (uint8_t)(y / 13 * 16);   // hundreds of colours
      }
    char name[32];
    std::snprintf(name, sizeof name, "/F%07d.PPM", n);
    FILE *f = std::fopen((dir + name).c_str(), "wb");
    if (!f) fail("cannot write into " + dir);
    std::fprintf(f, "P6\n320 200\n255\n");
    std::fwrite(rgb.data(), 1, rgb.size(), f);
    std::fclose(f);
  }
}

int main(int argc, char **argv) {
  std::string what = argc > 1 ? argv[1] : "";
  if (what == "make" && argc == 3) {
    make(argv[2]);
  } else if (what == "gif" && argc >= 7) {
    // The arguments that follow are the frame numbers, after the delay.
    int delay = -1;
    std::vector<Rgb> frames = readGif(argv[2], delay);
    if (delay != std::atoi(argv[7])) fail("delay " + std::to_string(delay));
    if ((int)frames.size() != argc - 8) fail(std::to_string(frames.size()) + " frames");
    for (int i = 8; i < argc; i++) {
      char name[32];
      std::snprintf(name, sizeof name, "/F%07d.PPM", std::atoi(argv[i]));
      same(frames[i - 8], stretched(readPpm(argv[3] + std::string(name)), std::atoi(argv[4]),
                                    !std::strcmp(argv[5], "43")), std::atoi(argv[6]), argv[i]);
    }
  } else if (what == "png" && argc == 6) {
    same(readPng(argv[2]), stretched(readPpm(argv[3]), std::atoi(argv[4]), !std::strcmp(argv[5], "43")), 0,
         argv[2]);
  } else {
    fail("usage: picstst make DIR | gif FILE DIR SCALE 43|- OFF DELAY FRAME... | png FILE PPM SCALE 43|-");
  }
  return 0;
}
