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

// Greatest error of axes that should be perpendicular unit vectors.
const double SKEW = 0.001;

// What a line may say: its first word, the least and greatest count of numbers behind it, and whether a scene needs it.
struct Fact {
  const char *word;
  size_t least, most;
  bool needed;
  // Stores what is said of the scene, and checks what is said of objects; null: nothing to do. Returns false, for the reason
  // `wrong`, if the numbers are wrong.
  bool (*take)(Scene &, const double *v);
  const char *wrong = "";
  // Stores what is said of the objects with the indices a and b. The first numbers name them; there are `objects` of them, 0 to
  // 2. Returns a message if the numbers are wrong, or null.
  int objects = 0;
  const char *(*store)(Scene &, const struct Line &, int a, int b) = nullptr;
};

// A line that is no object. A number that may be left out and is left out is 1.
struct Line {
  int number;
  const Fact *fact;
  std::vector<double> v;
};

const char *storeShape(Scene &s, const Line &l, int a, int) { return s.objects[a].setShape(l.fact->word, l.v.data() + 1); }

const char *storeLink(Scene &s, const Line &l, int a, int b) {
  if (a == b) return "blend of an object with itself";
  s.link[a][b] = s.link[b][a] = s.weight[a][b] = s.weight[b][a] = l.v[2];
  return nullptr;
}

const char *storeDent(Scene &s, const Line &l, int a, int b) {
  if (a == b) return "dent of an object by itself";
  s.weight[a][b] -= l.v[2];
  const std::vector<double> &links = s.link[b];
  const bool linked = std::any_of(links.begin(), links.end(), [](double weight) { return weight != 0; });
  if (l.v[2] != 0 && !linked) s.objects[b].ghost = true;
  return nullptr;
}

const char *storeStrength(Scene &s, const Line &l, int a, int) {
  s.objects[a].strength = l.v[1];
  return nullptr;
}

const char *storeCoat(Scene &s, const Line &l, int a, int) {
  const std::string word = l.fact->word;
  const std::vector<double> &v = l.v;
  Coat &c = s.coats[a];
  if (word == "shiny") c.finish = Coat::SHINY;
  if (word == "mirror") c.finish = Coat::MIRROR;
  if (v.size() == 1) return nullptr;
  c.pattern = word == "checks" ? Coat::CHECKS : word == "stripes" ? Coat::STRIPES : Coat::MARBLE;
  c.grain = v[1];
  c.colour = {v[2], v[3], v[4]};
  c.middle = {v[5], v[6], v[7]};
  Vec x{v[8], v[9], v[10]}, y{v[11], v[12], v[13]};
  if (!(c.grain > 0)) return "the size of a pattern must be above 0";
  if (std::fabs(length(x) - 1) > 0.01 || std::fabs(length(y) - 1) > 0.01 || std::fabs(dot(x, y)) > 0.01)
    return "the axes of a pattern must be of unit length and square to each other";
  c.axis[0] = x, c.axis[1] = y, c.axis[2] = cross(x, y);
  return nullptr;
}

bool takeLight(Scene &s, const double *v) {
  Vec l{v[0], v[1], v[2]};
  s.light = l * (1 / length(l));
  return length(l) > 0;
}

bool takeRamp(Scene &s, const double *v) {
  s.ramps[(int)v[0]] = {v[1], v[2], v[3]};
  return v[1] >= 0 && v[2] >= 0 && v[3] >= 0 && v[1] + v[2] + v[3] > 0;
}

bool goodShare(double v) { return v >= 0 && v <= 1; }
bool takeWeight(Scene &, const double *v) { return v[2] >= 0; }

const Fact facts[] = {
    {"time", 1, 1, true, [](Scene &s, const double *v) { s.time = v[0]; return true; }},
    {"eye", 3, 3, true, [](Scene &s, const double *v) { s.eye = {v[0], v[1], v[2]}; return true; }},
    {"right", 3, 3, false, [](Scene &s, const double *v) { s.right = {v[0], v[1], v[2]}; return true; }},
    {"up", 3, 3, false, [](Scene &s, const double *v) { s.up = {v[0], v[1], v[2]}; return true; }},
    {"ahead", 3, 3, false, [](Scene &s, const double *v) { s.ahead = {v[0], v[1], v[2]}; return true; }},
    {"focal", 2, 2, true, [](Scene &s, const double *v) { s.focalX = v[0], s.focalY = v[1]; return v[0] > 0 && v[1] > 0; },
     "focal lengths must be above 0"},
    {"centre", 2, 2, true, [](Scene &s, const double *v) { s.centreX = v[0], s.centreY = v[1]; return true; }},
    {"light", 3, 3, true, takeLight, "the light has no direction"},
    {"isovalue", 1, 1, false, [](Scene &s, const double *v) { s.isovalue = v[0]; return v[0] > 0; },
     "the isovalue must be above 0"},
    {"ambient", 1, 1, false, [](Scene &s, const double *v) { s.ambient = v[0]; return goodShare(v[0]); },
     "ambient must be from 0 to 1"},
    {"highlight", 1, 1, false, [](Scene &s, const double *v) { s.highlight = v[0]; return goodShare(v[0]); },
     "highlight must be from 0 to 1"},
    {"ramp", 4, 4, false, takeRamp, "a ramp wants a colour that is not black"},
    {"mixed", 0, 0, false, [](Scene &s, const double *) { return s.mixed = true; }},
    {"stretch", 13, 13, false, nullptr, "", 1, storeShape},
    {"taper", 12, 12, false, nullptr, "", 1, storeShape},
    {"twist", 12, 12, false, nullptr, "", 1, storeShape},
    {"bend", 12, 12, false, nullptr, "", 1, storeShape},
    {"blend", 2, 3, false, takeWeight, "a link's weight must not be negative", 2, storeLink},
    {"dent", 2, 3, false, takeWeight, "a dent's weight must not be negative", 2, storeDent},
    {"strength", 2, 2, false, [](Scene &, const double *v) { return v[1] > 0; }, "a strength must be above 0", 1, storeStrength},
    {"shiny", 1, 1, false, nullptr, "", 1, storeCoat},
    {"mirror", 1, 1, false, nullptr, "", 1, storeCoat},
    {"checks", 14, 14, false, nullptr, "", 1, storeCoat},
    {"stripes", 14, 14, false, nullptr, "", 1, storeCoat},
    {"marble", 14, 14, false, nullptr, "", 1, storeCoat},
};

class SceneReader {
public:
  SceneReader(const std::string &name, Scene &s, std::string &why) : name(name), s(s), why(why) {}
  bool read(const std::string &text) {
    for (size_t at = 0; at < text.size();) {
      size_t end = std::min(text.find('\n', at), text.size());
      std::vector<std::string> words = split(text.substr(at, end - at));
      at = end + 1;
      lineNumber++;
      if (!words.empty() && words[0][0] != '#' && !readLine(words)) return false;
    }
    return storeLines() && checkScene();
  }
private:
  bool fail(const std::string &what) {
    why = name + ":" + std::to_string(lineNumber) + ": " + what;
    return false;
  }
  bool readLine(const std::vector<std::string> &words) {
    std::vector<double> v(words.size() - 1);
    for (size_t i = 0; i < v.size(); i++)
      if (!number(words[i + 1], v[i])) return fail("not a number: " + words[i + 1]);
    if (const Kind *kind = findKind(words[0])) return addObject(*kind, words, v);
    for (const Fact &f : facts)
      if (words[0] == f.word) return addFact(f, v);
    return fail("unknown word: " + words[0]);
  }
  bool addObject(const Kind &kind, const std::vector<std::string> &words, const std::vector<double> &v) {
    if ((int)v.size() != kind.numbers + 1)
      return fail(words[0] + " wants " + std::to_string(kind.numbers + 1) + " numbers");
    Object o{};
    o.kind = &kind;
    o.number = (int)v[0];
    if (o.number != v[0]) return fail("an object's number must be whole");
    if (!index.insert({o.number, (int)s.objects.size()}).second)
      return fail("object " + words[1] + " is there already");
    if (const char *wrong = kind.set(o, v.data() + 1)) return fail(wrong);
    s.objects.push_back(o);
    return true;
  }
  bool addFact(const Fact &f, std::vector<double> &v) {
    if (v.size() < f.least || v.size() > f.most)
      return fail(std::string(f.word) + " with " + std::to_string(v.size()) + " numbers");
    seen[f.word] = true;
    v.resize(f.most, 1);
    if (f.take && !f.take(s, v.data())) return fail(f.wrong);
    if (f.store == storeShape) return store({lineNumber, &f, v});
    if (f.store) lines.push_back({lineNumber, &f, v});
    return true;
  }
  // Stores what a line says of objects.
  bool store(const Line &l) {
    lineNumber = l.number;
    int which[2] = {0, 0};
    for (int i = 0; i < l.fact->objects; i++) {
      auto o = index.find((int)l.v[i]);
      if (o == index.end()) return fail(std::string(l.fact->word) + " names an object that is not there");
      which[i] = o->second;
    }
    const char *wrong = l.fact->store(s, l, which[0], which[1]);
    return !wrong || fail(wrong);
  }
  // Stores the lines about objects, now that all objects are known. Links come first, because dents change their weights.
  bool storeLines() {
    size_t n = s.objects.size();
    s.link.assign(n, std::vector<double>(n, 0));
    s.weight = s.link;
    s.coats.assign(n, Coat());
    for (auto pass : {storeLink, storeDent, storeStrength, storeCoat})
      for (const Line &l : lines)
        if (l.fact->store == pass && !store(l)) return false;
    return true;
  }
  bool checkScene() {
    // The axes of a turned eye (right, up, ahead) must be perpendicular unit vectors, oriented as x, y and z are.
    if (length(s.right - cross(s.up, s.ahead)) > SKEW || std::fabs(length(s.up) - 1) > SKEW ||
        std::fabs(length(s.ahead) - 1) > SKEW || std::fabs(dot(s.up, s.ahead)) > SKEW) {
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
  const std::string &name;
  Scene &s;
  std::string &why;
  int lineNumber = 0;
  std::map<int, int> index;          // object number -> index
  std::map<std::string, bool> seen;  // first words of lines
  std::vector<Line> lines;           // those about objects that are stored at the end
};

}  // namespace

bool parseScene(const std::string &text, const std::string &name, Scene &s, std::string &why) {
  s = Scene();
  return SceneReader(name, s, why).read(text);
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
