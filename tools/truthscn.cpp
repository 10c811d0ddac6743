// Reads scenes and dumped frames from files. All that the yardstick assumes about the dump format is in this file. The
// reader is strict: an unknown word, a missing file or a file of the wrong length is an error, because a figure from half a
// scene would be worse than none.
#include "truth.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace truth {

namespace {

std::vector<std::string> split(const std::string &line) {
  std::vector<std::string> words;
  size_t i = 0;
  while (true) {
    while (i < line.size() && std::strchr(" \t\r", line[i])) i++;
    if (i >= line.size()) return words;
    size_t from = i;
    while (i < line.size() && !std::strchr(" \t\r", line[i])) i++;
    words.push_back(line.substr(from, i - from));
  }
}

bool number(const std::string &word, double &v) {
  char *end;
  v = std::strtod(word.c_str(), &end);
  return *end == 0 && end != word.c_str() && std::isfinite(v);
}

// Lines that are not objects: their first word, the least and greatest count of numbers behind it, and whether a scene needs it.
struct Fact {
  const char *word;
  size_t least, most;
  bool needed;
};
// Greatest error of axes that should be perpendicular unit vectors.
const double SKEW = 0.001;
const Fact facts[] = {
    {"time", 1, 1, true},   {"eye", 3, 3, true},       {"focal", 2, 2, true},
    {"centre", 2, 2, true}, {"light", 3, 3, true},     {"isovalue", 1, 1, false},
    {"strength", 2, 2, false}, {"dent", 2, 3, false},
    {"right", 3, 3, false}, {"up", 3, 3, false},       {"ahead", 3, 3, false},
    {"blend", 2, 3, false}, {"ambient", 1, 1, false}, {"highlight", 1, 1, false},  {"ramp", 4, 4, false},
    {"mixed", 0, 0, false}, {"shiny", 1, 1, false},    {"mirror", 1, 1, false},
    {"checks", 14, 14, false}, {"stripes", 14, 14, false}, {"marble", 14, 14, false},
    {"stretch", 13, 13, false}, {"taper", 12, 12, false}, {"twist", 12, 12, false}, {"bend", 12, 12, false},
};

}  // namespace

bool parseScene(const std::string &text, const std::string &name, Scene &s, std::string &why) {
  s = Scene();
  struct Link {
    int line;
    double a, b, weight;
  };
  struct Word {
    int line;
    std::string word;
    std::vector<double> v;
  };
  std::vector<Word> coats;
  std::vector<Link> links, dents, strengths;
  std::map<int, int> index;   // object number -> index
  std::map<std::string, bool> seen;
  int lineNumber = 0;
  auto fail = [&](const std::string &what) {
    why = name + ":" + std::to_string(lineNumber) + ": " + what;
    return false;
  };
  for (size_t at = 0; at < text.size();) {
    size_t end = text.find('\n', at);
    if (end == std::string::npos) end = text.size();
    std::vector<std::string> words = split(text.substr(at, end - at));
    at = end + 1;
    lineNumber++;
    if (words.empty() || words[0][0] == '#') continue;
    std::vector<double> v(words.size() - 1);
    for (size_t i = 0; i < v.size(); i++)
      if (!number(words[i + 1], v[i])) return fail("not a number: " + words[i + 1]);
    const std::string &word = words[0];
    if (const Kind *kind = findKind(word)) {
      if ((int)v.size() != kind->numbers + 1)
        return fail(word + " wants " + std::to_string(kind->numbers + 1) + " numbers");
      Object o{};
      o.kind = kind;
      o.number = (int)v[0];
      if (o.number != v[0]) return fail("an object's number must be whole");
      if (!index.insert({o.number, (int)s.objects.size()}).second)
        return fail("object " + words[1] + " is there already");
      if (const char *wrong = kind->set(o, v.data() + 1)) return fail(wrong);
      s.objects.push_back(o);
      continue;
    }
    const Fact *fact = nullptr;
    for (const Fact &f : facts)
      if (word == f.word) fact = &f;
    if (!fact) return fail("unknown word: " + word);
    if (v.size() < fact->least || v.size() > fact->most)
      return fail(word + " with " + std::to_string(v.size()) + " numbers");
    seen[word] = true;
    if (word == "time") s.time = v[0];
    if (word == "eye") s.eye = {v[0], v[1], v[2]};
    if (word == "right") s.right = {v[0], v[1], v[2]};
    if (word == "up") s.up = {v[0], v[1], v[2]};
    if (word == "ahead") s.ahead = {v[0], v[1], v[2]};
    if (word == "focal") {
      if (v[0] <= 0 || v[1] <= 0) return fail("focal lengths must be above 0");
      s.focalX = v[0], s.focalY = v[1];
    }
    if (word == "centre") s.centreX = v[0], s.centreY = v[1];
    if (word == "light") {
      Vec l{v[0], v[1], v[2]};
      if (!(length(l) > 0)) return fail("the light has no direction");
      s.light = l * (1 / length(l));
    }
    if (word == "isovalue") {
      if (v[0] <= 0) return fail("the isovalue must be above 0");
      s.isovalue = v[0];
    }
    if (word == "ambient") {
      if (v[0] < 0 || v[0] > 1) return fail("ambient must be from 0 to 1");
      s.ambient = v[0];
    }
    if (word == "highlight") {
      if (v[0] < 0 || v[0] > 1) return fail("highlight must be from 0 to 1");
      s.highlight = v[0];
    }
    if (word == "ramp") {
      if (v[1] < 0 || v[2] < 0 || v[3] < 0 || v[1] + v[2] + v[3] <= 0)
        return fail("a ramp wants a colour that is not black");
      s.ramps[(int)v[0]] = {v[1], v[2], v[3]};
    }
    if (word == "mixed") s.mixed = true;
    for (const char *coat : {"shiny", "mirror", "checks", "stripes", "marble"})
      if (word == coat) coats.push_back({lineNumber, word, v});
    if (word == "stretch" || word == "taper" || word == "twist" || word == "bend") {
      auto o = index.find((int)v[0]);
      if (o == index.end()) return fail(word + " names an object that is not there");
      if (const char *wrong = s.objects[o->second].setShape(word, v.data() + 1)) return fail(wrong);
    }
    if (word == "blend" && v.size() > 2 && v[2] < 0) return fail("a link's weight must not be negative");
    if (word == "blend") links.push_back({lineNumber, v[0], v[1], v.size() > 2 ? v[2] : 1});
    if (word == "dent" && v.size() > 2 && v[2] < 0) return fail("a dent's weight must not be negative");
    if (word == "dent") dents.push_back({lineNumber, v[0], v[1], v.size() > 2 ? v[2] : 1});
    if (word == "strength" && v[1] <= 0) return fail("a strength must be above 0");
    if (word == "strength") strengths.push_back({lineNumber, v[0], v[0], v[1]});
  }
  size_t n = s.objects.size();
  s.link.assign(n, std::vector<double>(n, 0));
  for (const Link &l : links) {
    lineNumber = l.line;
    auto a = index.find((int)l.a), b = index.find((int)l.b);
    if (a == index.end() || b == index.end()) return fail("blend names an object that is not there");
    if (a == b) return fail("blend of an object with itself");
    s.link[a->second][b->second] = s.link[b->second][a->second] = l.weight;
  }
  s.weight = s.link;
  for (const Link &l : dents) {
    lineNumber = l.line;
    auto a = index.find((int)l.a), b = index.find((int)l.b);
    if (a == index.end() || b == index.end()) return fail("dent names an object that is not there");
    if (a == b) return fail("dent of an object by itself");
    s.weight[a->second][b->second] -= l.weight;
    Object &digger = s.objects[b->second];
    digger.ghost = digger.ghost || l.weight != 0;
  }
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++)
      if (s.link[i][j] != 0) s.objects[i].ghost = false;
  for (const Link &l : strengths) {
    lineNumber = l.line;
    auto a = index.find((int)l.a);
    if (a == index.end()) return fail("strength names an object that is not there");
    s.objects[a->second].strength = l.weight;
  }
  s.coats.assign(n, Coat());
  for (const Word &w : coats) {
    lineNumber = w.line;
    auto o = index.find((int)w.v[0]);
    if (o == index.end()) return fail(w.word + " names an object that is not there");
    Coat &c = s.coats[o->second];
    if (w.word == "shiny") c.finish = Coat::SHINY;
    if (w.word == "mirror") c.finish = Coat::MIRROR;
    if (w.v.size() == 1) continue;
    c.pattern = w.word == "checks" ? Coat::CHECKS : w.word == "stripes" ? Coat::STRIPES : Coat::MARBLE;
    c.grain = w.v[1];
    c.colour = {w.v[2], w.v[3], w.v[4]};
    c.middle = {w.v[5], w.v[6], w.v[7]};
    Vec x{w.v[8], w.v[9], w.v[10]}, y{w.v[11], w.v[12], w.v[13]};
    if (!(c.grain > 0)) return fail("the size of a pattern must be above 0");
    if (std::fabs(length(x) - 1) > 0.01 || std::fabs(length(y) - 1) > 0.01 || std::fabs(dot(x, y)) > 0.01)
      return fail("the axes of a pattern must be of unit length and square to each other");
    c.axis[0] = x, c.axis[1] = y;
    c.axis[2] = {x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x};
  }
  // The axes of a turned eye (right, up, ahead) must be perpendicular unit vectors, oriented as x, y and z are.
  Vec side = {s.up.y * s.ahead.z - s.up.z * s.ahead.y, s.up.z * s.ahead.x - s.up.x * s.ahead.z,
              s.up.x * s.ahead.y - s.up.y * s.ahead.x};
  if (length(s.right - side) > SKEW || std::fabs(length(s.up) - 1) > SKEW || std::fabs(length(s.ahead) - 1) > SKEW ||
      std::fabs(dot(s.up, s.ahead)) > SKEW) {
    why = name + ": right, up and ahead are no axes of a view";
    return false;
  }
  for (const Fact &f : facts)
    if (f.needed && !seen[f.word]) {
      why = name + ": no line \"" + f.word + "\"";
      return false;
    }
  return true;
}

bool readFile(const std::string &path, std::string &data, std::string &why) {
  FILE *f = std::fopen(path.c_str(), "rb");
  if (!f) {
    why = path + ": " + std::strerror(errno);
    return false;
  }
  data.clear();
  char buffer[65536];
  for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, f)) > 0;) data.append(buffer, n);
  bool bad = std::ferror(f);
  std::fclose(f);
  if (bad) why = path + ": cannot be read";
  return !bad;
}

bool writeFile(const std::string &path, const std::string &data, std::string &why) {
  FILE *f = std::fopen(path.c_str(), "wb");
  bool good = f && std::fwrite(data.data(), 1, data.size(), f) == data.size();
  if (f && std::fclose(f) != 0) good = false;
  if (!good) why = path + ": " + std::strerror(errno);
  return good;
}

bool writePpm(const std::string &path, int width, int height, const std::vector<uint8_t> &rgb,
              std::string &why) {
  std::string data = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  data.append((const char *)rgb.data(), rgb.size());
  return writeFile(path, data, why);
}

std::string frameName(const std::string &dir, long n, const char *extension) {
  char name[32];
  std::snprintf(name, sizeof name, "/F%07ld.", n);
  return dir + name + extension;
}

bool readScene(const std::string &path, Scene &s, std::string &why) {
  std::string text;
  return readFile(path, text, why) && parseScene(text, path, s, why);
}

namespace {

// Reads a P6 picture of the screen's size with 8-bit samples.
bool parsePpm(const std::string &data, const std::string &name, std::vector<uint8_t> &rgb,
              std::string &why) {
  size_t at = 2;
  long v[3] = {0, 0, 0};
  bool good = data.compare(0, 2, "P6") == 0;
  for (int i = 0; good && i < 3; i++) {
    while (at < data.size() && (std::isspace((unsigned char)data[at]) || data[at] == '#'))
      if (data[at] == '#')
        while (at < data.size() && data[at] != '\n') at++;
      else
        at++;
    size_t from = at;
    while (at < data.size() && std::isdigit((unsigned char)data[at]) && at - from < 9)
      v[i] = v[i] * 10 + (data[at++] - '0');
    good = at > from;
  }
  at++;
  size_t size = WIDTH * HEIGHT * 3;
  good = good && v[0] == WIDTH && v[1] == HEIGHT && v[2] == 255;
  if (!good || data.size() != at + size) {
    why = name + (good ? ": has the wrong length" : ": is no 320x200 P6 picture");
    return false;
  }
  rgb.assign(data.begin() + at, data.end());
  return true;
}

}  // namespace

bool readFrame(const std::string &dir, long n, Frame &f, std::string &why) {
  std::string data, name = frameName(dir, n, "PPM");
  if (!readScene(frameName(dir, n, "TXT"), f.scene, why)) return false;
  if (!readFile(name, data, why) || !parsePpm(data, name, f.rgb, why)) return false;
  name = frameName(dir, n, "Z");
  if (!readFile(name, data, why)) return false;
  if (data.size() != (size_t)WIDTH * HEIGHT * 4) {
    why = name + ": has the wrong length";
    return false;
  }
  f.z.resize(WIDTH * HEIGHT);
  for (size_t i = 0; i < f.z.size(); i++) {
    const uint8_t *b = (const uint8_t *)data.data() + 4 * i;
    f.z[i] = (int32_t)(b[0] | b[1] << 8 | b[2] << 16 | (uint32_t)b[3] << 24);
  }
  f.grey = true;
  for (size_t i = 0; i < f.z.size(); i++)
    if (f.z[i] != EMPTY)
      f.grey = f.grey && f.rgb[3 * i] == f.rgb[3 * i + 1] && f.rgb[3 * i] == f.rgb[3 * i + 2];
  return true;
}

bool listFrames(const std::string &dir, std::vector<long> &numbers, std::string &why) {
  numbers.clear();
  std::error_code error;
  std::filesystem::directory_iterator it(dir, error), end;
  if (error) {
    why = dir + ": " + error.message();
    return false;
  }
  for (; it != end; it.increment(error)) {
    std::string name = it->path().filename().string();
    if (name.size() != 12 || name[0] != 'F' || name.substr(8) != ".TXT") continue;
    if (name.find_first_not_of("0123456789", 1) != 8) continue;
    numbers.push_back(std::atol(name.c_str() + 1));
  }
  std::sort(numbers.begin(), numbers.end());
  if (numbers.empty()) why = dir + ": no frames";
  return !numbers.empty();
}

}  // namespace truth
