// A picture in memory: read from a binary PPM file, with a palette made of its colours, and stretched to the shape in which
// it is shown. Both picture tools, mkgif and ppm2png, begin with these steps; truth takes from here how numbers are read.
#ifndef PICTURE_H
#define PICTURE_H

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

struct Image {
  int width = 0, height = 0;
  std::vector<uint32_t> pixels;   // 0xRRGGBB, top row first
};

// A palette of at most 256 colours, and the index of each colour.
struct Palette {
  std::vector<uint32_t> colours;
  std::map<uint32_t, int> place;
  // Adds the colours of a picture; `mask` drops their low bits. Returns false if there are more than 256 colours; the
  // palette is then unusable.
  bool add(const Image &p, uint32_t mask = 0xFFFFFF) {
    uint32_t last = ~0u;
    for (uint32_t c : p.pixels) {
      c &= mask;
      if (c == last) continue;
      last = c;
      if (!place.insert({c, (int)colours.size()}).second) continue;
      if (colours.size() == 256) return false;
      colours.push_back(c);
    }
    return true;
  }
};

// Reads a P6 picture with 8-bit samples, up to 4096 pixels wide and high. Returns false, and a reason, if the file is not
// such a picture.
inline bool readPpm(const std::string &path, Image &p, std::string &why) {
  FILE *f = std::fopen(path.c_str(), "rb");
  if (!f) {
    why = path + ": cannot be opened";
    return false;
  }
  long v[3] = {0, 0, 0};
  bool good = std::fgetc(f) == 'P' && std::fgetc(f) == '6';
  for (int i = 0; good && i < 3; i++) {
    int c = std::fgetc(f);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '#') {
      if (c == '#')
        while (c != '\n' && c != EOF) c = std::fgetc(f);
      else
        c = std::fgetc(f);
    }
    good = c >= '0' && c <= '9';
    for (; c >= '0' && c <= '9' && v[i] <= 4096; c = std::fgetc(f)) v[i] = v[i] * 10 + (c - '0');
  }
  good = good && v[0] >= 1 && v[0] <= 4096 && v[1] >= 1 && v[1] <= 4096 && v[2] == 255;
  if (good) {
    std::vector<uint8_t> rgb(v[0] * v[1] * 3);
    good = std::fread(rgb.data(), 1, rgb.size(), f) == rgb.size();
    p.width = (int)v[0];
    p.height = (int)v[1];
    p.pixels.resize(v[0] * v[1]);
    for (size_t i = 0; i < p.pixels.size(); i++)
      p.pixels[i] = (uint32_t)rgb[3 * i] << 16 | rgb[3 * i + 1] << 8 | rgb[3 * i + 2];
  }
  std::fclose(f);
  if (!good) why = path + ": is no P6 picture of 8 bits a sample";
  return good;
}

// Returns the picture `scale` times as large, by nearest pixels. With `tall` it is a fifth taller in addition, which shows
// mode 13h's pixels in their true shape on a screen with square pixels.
inline Image stretch(const Image &p, int scale, bool tall) {
  Image out;
  out.width = p.width * scale;
  out.height = p.height * scale * (tall ? 6 : 5) / 5;
  out.pixels.resize((size_t)out.width * out.height);
  for (int y = 0; y < out.height; y++)
    for (int x = 0; x < out.width; x++)
      out.pixels[(size_t)y * out.width + x] =
          p.pixels[(size_t)((long)y * p.height / out.height) * p.width + x / scale];
  return out;
}

// Reads a whole number. Returns false unless the text is a number from `least` to `most`.
inline bool wholeNumber(const char *text, long least, long most, long &v) {
  char *end;
  v = std::strtol(text, &end, 10);
  return end != text && *end == 0 && v >= least && v <= most;
}

#endif
