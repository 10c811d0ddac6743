// truth: compares dumped frames with the surface that they should show.
//
//   truth [options] DIR...         figures of the frames in the directories
//   truth --render OUT SCENE...    writes the true frames of scene texts to OUT
//
// This file is the command line of the yardstick: it reads the frames, prints the figures (one `name: value` per line, or
// one row of a table), and compares the figures with their limits.
#include "picture.h"
#include "truth.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

using namespace truth;

namespace {

const char usage[] =
    "truth [options] DIR...          hold the frames in the directories against the surface\n"
    "truth --render OUT SCENE...     write the true frames of scene texts into OUT\n"
    "truth --head                    the head of the table: figures and bars\n"
    "  -v               one line for every frame\n"
    "  --csv FILE       one record for every frame\n"
    "  --worst N        list the N worst frames (3)\n"
    "  --out OUT        and write them as pictures: ours, true, difference (red:\n"
    "                   hole, magenta: see-through, yellow: outside, blue: rim\n"
    "                   not drawn, cyan: another object's colour, green: a border\n"
    "                   of colours where there is none, grey: error of brightness\n"
    "                   x 4)\n"
    "  --bars NAME      spacing2 or spacing1: exit 1 if a bar is broken\n"
    "  --row NAME       with --bars: print a row of the table instead, a figure\n"
    "                   beyond its bar with a '!'\n"
    "  --limits FILE    with --row: lines \"name spacing figure limit\", figures as\n"
    "                   the table has them. A figure listed for this name and\n"
    "                   spacing breaks its bar only beyond its limit; one\n"
    "                   that breaks it bears '!!'\n"
    "  --truths DIR     keep the true pictures in DIR, and take those from there that\n"
    "                   show the same scene: true pictures of several runs are made\n"
    "                   once\n"
    "  --list FILE      with --row: append the figures to FILE, as such lines\n"
    "  --every N        judge only every Nth frame (1; more leaves flicker out)\n"
    "  --pairs          and the frame after each of them, for flicker\n"
    "  --threads N      1 to 16 (2)\n";

// The limits (bars) that a picture has to meet, and the figures that are compared with them.
struct Bar {
  const char *name;
  const char *column;   // head of the figure's column in the table
  int decimals;
  double spacing2, spacing1;
  double (*value)(const Figures &);
  bool (*known)(const Figures &);
  double most(int spacing) const { return spacing == 2 ? spacing2 : spacing1; }
};

const Bar bars[] = {
    {"holes", "holes", 0, 0, 0, [](const Figures &f) { return (double)f.holes; },
     [](const Figures &f) { return f.interior > 0; }},
    {"see-through, percent of interior pixels", "see-through", 3, 0.05, 0.02,
     [](const Figures &f) { return f.seeThroughShare(); },
     [](const Figures &f) { return f.interior > 0; }},
    {"outside, percent of drawn pixels", "outside", 3, 1, 0.5,
     [](const Figures &f) { return f.outsideShare(); },
     [](const Figures &f) { return f.drawn > 0; }},
    {"depth RMS, units", "depth", 3, 1.0, 0.6, [](const Figures &f) { return f.depthRms(); },
     [](const Figures &f) { return f.both > 0; }},
    {"brightness RMS, ramp steps", "brightness", 2, 2.5, 1.5,
     [](const Figures &f) { return f.shadeRms(); },
     [](const Figures &f) { return f.shaded > 0; }},
    {"flicker, percent of drawn pixels", "flicker", 3, 0.1, 0.05,
     [](const Figures &f) { return f.flickerShare(); },
     [](const Figures &f) { return f.pairs > 0; }},
    {"colour, percent of drawn pixels", "colour", 3, 0.05, 0.02,
     [](const Figures &f) { return f.colourShare(); },
     [](const Figures &f) { return f.coloured > 0; }},
    {"border, drawn over true length", "border", 2, 1.3, 1.2,
     [](const Figures &f) { return f.borderRatio(); },
     [](const Figures &f) { return f.borderTrue > 0; }},
};

// Returns how bad a frame is: the sum of its figures divided by their bars (a hole counts as 1).
double badness(const Figures &f) {
  double sum = 0;
  for (const Bar &b : bars)
    if (b.known(f)) sum += b.spacing2 > 0 ? b.value(f) / b.spacing2 : b.value(f);
  return sum;
}

int trouble(const std::string &what) {
  std::fprintf(stderr, "truth: %s\n", what.c_str());
  return 2;
}

int render(const std::string &out, const std::vector<std::string> &scenes, int threads) {
  std::string why;
  for (size_t n = 0; n < scenes.size(); n++) {
    std::string text;
    Scene s;
    if (!readFile(scenes[n], text, why) || !parseScene(text, scenes[n], s, why)) return trouble(why);
    Picture picture;
    picture.trace(s, threads);
    Frame f;
    drawTruth(s, picture, f);
    std::string z;
    for (int32_t v : f.z)
      for (int b = 0; b < 4; b++) z += (char)((uint32_t)v >> (8 * b));
    if (!writePpm(frameName(out, n, "PPM"), WIDTH, HEIGHT, f.rgb, why) ||
        !writeFile(frameName(out, n, "Z"), z, why) ||
        !writeFile(frameName(out, n, "TXT"), text, why))
      return trouble(why);
  }
  return 0;
}

void printTotals(const Figures &f) {
  auto count = [](const char *name, long v) { std::printf("%s: %ld\n", name, v); };
  auto real = [](const char *name, double v, bool known) {
    if (known) std::printf("%s: %.4f\n", name, v);
    else std::printf("%s: not measured\n", name);
  };
  count("frames", f.frames);
  count("frames with the eye inside the surface, left out", f.eyeInside);
  count("surface pixels", f.surface);
  count("interior pixels", f.interior);
  count("drawn pixels", f.drawn);
  count("holes", f.holes);
  count("see-through pixels", f.seeThrough);
  real("see-through, percent of interior pixels", f.seeThroughShare(), f.interior);
  count("outside pixels", f.outside);
  real("outside, percent of drawn pixels", f.outsideShare(), f.drawn);
  real("outside 5x5, percent of drawn pixels", f.outsideBoxShare(), f.drawn);
  count("rim pixels not drawn", f.missing - f.holes);
  real("depth RMS, units", f.depthRms(), f.both);
  real("depth RMS away from jumps, units", f.smoothRms(), f.smooth);
  real("brightness RMS, ramp steps", f.shadeRms(), f.shaded);
  count("pixels whose object their colour tells", f.coloured);
  count("pixels of another object's colour", f.wrongColour);
  real("colour, percent of drawn pixels", f.colourShare(), f.coloured);
  count("true border", f.borderTrue);
  count("drawn border", f.border);
  real("border, drawn over true length", f.borderRatio(), f.borderTrue);
  count("flicker pairs", f.pairs);
  count("flicker pixels", f.flicker);
  real("flicker, percent of drawn pixels", f.flickerShare(), f.pairs);
  real("flicker with edges, percent of drawn pixels", f.flickerEdgeShare(), f.pairs);
}

const char csvHead[] =
    "frame,time,surface,interior,drawn,holes,seethrough,seethrough_pct,outside,outside_pct,"
    "outside5x5_pct,rim_missing,depth_rms,depth_rms_smooth,brightness_rms,flicker,flicker_pct,"
    "flicker_edge_pct,colour,colour_pct,border\n";

// Returns a record of the CSV file. Figures that were not measured are empty fields.
std::string csvLine(long n, double time, const Figures &f) {
  char b[512];
  std::snprintf(b, sizeof b, "%ld,%.3f,%ld,%ld,%ld,%ld,%ld,%.4f,%ld,%.4f,%.4f,%ld,%.4f,%.4f,", n,
                time, f.surface, f.interior, f.drawn, f.holes, f.seeThrough,
                f.seeThroughShare(), f.outside, f.outsideShare(), f.outsideBoxShare(),
                f.missing - f.holes, f.depthRms(), f.smoothRms());
  std::string line = b;
  if (f.shaded) std::snprintf(b, sizeof b, "%.4f,", f.shadeRms());
  else std::snprintf(b, sizeof b, ",");
  line += b;
  if (f.pairs)
    std::snprintf(b, sizeof b, "%ld,%.4f,%.4f,", f.flicker, f.flickerShare(), f.flickerEdgeShare());
  else
    std::snprintf(b, sizeof b, ",,,");
  line += b;
  if (f.coloured) std::snprintf(b, sizeof b, "%ld,%.4f,", f.wrongColour, f.colourShare());
  else std::snprintf(b, sizeof b, ",,");
  line += b;
  if (f.borderTrue) std::snprintf(b, sizeof b, "%.4f\n", f.borderRatio());
  else std::snprintf(b, sizeof b, "\n");
  return line + b;
}

void printFrame(long n, double time, const Figures &f) {
  std::printf("frame %ld time %.3f holes %ld see-through %.3f%% outside %.3f%% depth %.3f smooth %.3f",
              n, time, f.holes, f.seeThroughShare(), f.outsideShare(), f.depthRms(), f.smoothRms());
  if (f.shaded) std::printf(" brightness %.2f", f.shadeRms());
  if (f.pairs) std::printf(" flicker %.3f%%", f.flickerShare());
  if (f.coloured) std::printf(" colour %.3f%%", f.colourShare());
  if (f.borderTrue) std::printf(" border %.3f", f.borderRatio());
  std::printf("\n");
}

void printHead() {
  std::printf("%-16s", "scene");
  for (const Bar &b : bars) std::printf(" %11s", b.column);
  for (int spacing : {2, 1}) {
    std::printf("\nbars, spacing %d ", spacing);
    for (const Bar &b : bars) std::printf(" %11g", b.most(spacing));
  }
  std::printf("\n");
}

// One line of the file given by --limits.
struct Limit {
  std::string scene, spacing, figure;
  double most;
};

bool readLimits(const std::string &path, std::vector<Limit> &limits, std::string &why) {
  std::string text, line;
  if (!readFile(path, text, why)) return false;
  std::istringstream lines(text);
  for (int number = 1; std::getline(lines, line); number++) {
    std::istringstream words(line.substr(0, line.find('#')));
    Limit l;
    std::string more;
    if (!(words >> l.scene)) continue;
    bool good = words >> l.spacing >> l.figure >> l.most && !(words >> more);
    bool known = false;
    for (const Bar &b : bars) known = known || l.figure == b.column;
    if (!good || !known) {
      why = path + ":" + std::to_string(number) + ": expected scene, spacing, figure and limit";
      return false;
    }
    limits.push_back(l);
  }
  return true;
}

struct Options {
  bool verbose = false, rendering = false, pairs = false, limited = false;
  std::string csv, out, row, list, truths;   // as given to the options of these names
  std::vector<Limit> limits;
  std::vector<std::string> names;    // the directories, or with --render the scenes
  long worst = 3, threads = 2, every = 1;
  int spacing = 0;                   // whose bars are compared; 0: none are
};

// Takes the argument at argv[i]. If it is an option with a value, i moves on to the value.
bool takeArgument(char **argv, int &i, Options &o, std::string &why) {
  const std::pair<const char *, bool *> switches[] = {{"-v", &o.verbose}, {"--pairs", &o.pairs}};
  const std::pair<const char *, std::string *> texts[] = {
      {"--row", &o.row}, {"--list", &o.list}, {"--truths", &o.truths}, {"--csv", &o.csv}, {"--out", &o.out}, {"--render", &o.out}};
  const struct {
    const char *name, *range;
    long least, most, *value;
  } numbers[] = {{"--worst", "0 to 1000", 0, 1000, &o.worst},
                 {"--every", "1 or more", 1, 1000000, &o.every},
                 {"--threads", "1 to 16", 1, 16, &o.threads}};
  const std::string a = argv[i];
  const char *value = argv[i + 1];   // null behind the last argument
  for (const auto &[name, on] : switches)
    if (a == name) return *on = true;
  for (const auto &n : numbers)
    if (a == n.name) {
      i++;
      if (value && wholeNumber(value, n.least, n.most, *n.value)) return true;
      why = a + " wants " + n.range;
      return false;
    }
  if (a[0] != '-') {
    o.names.push_back(a);
    return true;
  }
  i++;
  for (const auto &[name, text] : texts)
    if (value && a == name) {
      *text = value;
      o.rendering = o.rendering || a == "--render";
      return true;
    }
  if (value && a == "--limits") {
    o.limited = true;
    return readLimits(value, o.limits, why);
  }
  if (value && a == "--bars") {
    const std::string name = value;
    o.spacing = name == "spacing2" ? 2 : name == "spacing1" ? 1 : 0;
    if (!o.spacing) why = "--bars wants spacing2 or spacing1, not " + name;
    return o.spacing != 0;
  }
  why = "unknown option, or one without its value: " + a + " (--help lists them)";
  return false;
}

// Prints one row of the table. Returns false if a figure exceeds both its bar and its limit, or if the list cannot be
// written; `why` is set in the latter case.
bool printRow(const Options &o, const Figures &f, std::string &why) {
  const std::string number = std::to_string(o.spacing);
  bool good = true;
  std::string list;
  std::printf("%-13s %s ", o.row.c_str(), number.c_str());
  for (const Bar &b : bars) {
    if (!b.known(f)) {
      std::printf(" %11s", "-");
      continue;
    }
    double v = b.value(f), most = b.most(o.spacing);
    const char *mark = v > most ? "!" : "";
    for (const Limit &l : o.limits)
      if (l.scene == o.row && l.spacing == number && l.figure == b.column) most = std::max(most, l.most);
    if (v > most) {
      good = false;
      if (o.limited) mark = "!!";
    }
    char cell[48];
    std::snprintf(cell, sizeof cell, "%.*f%s", b.decimals, v, mark);
    std::printf(" %11s", cell);
    std::snprintf(cell, sizeof cell, " %.*f\n", b.decimals, v);
    list += o.row + " " + number + " " + b.column + cell;
  }
  std::printf("\n");
  if (o.list.empty()) return good;
  FILE *file = std::fopen(o.list.c_str(), "a");
  bool written = file && std::fputs(list.c_str(), file) >= 0;
  if (file && std::fclose(file) != 0) written = false;
  if (!written) why = o.list + ": cannot be written";
  return good && written;
}

// A frame, and how bad it is.
struct Rank {
  double badness;
  size_t dir;
  long number;
};

// Makes the true picture of a frame. With --truths it is kept, and taken from there if it is of the same scene.
bool makeTruth(const Options &o, size_t dir, long n, const Frame &frame, Picture &picture, std::string &why) {
  std::string text, kept, none;
  const std::string file = o.truths + "/" + std::to_string(dir) + "-" + std::to_string(n);
  if (!o.truths.empty()) {
    if (!readFile(frameName(o.names[dir], n, "TXT"), text, why)) return false;
    if (readFile(file, kept, none) && kept.compare(0, text.size(), text) == 0 && picture.take(kept.substr(text.size())))
      return true;
  }
  picture.trace(frame.scene, (int)o.threads);
  return o.truths.empty() || writeFile(file, text + picture.bytes(), why);
}

// Compares the frames of all directories with the surface, and ranks them from the worst on.
bool judge(const Options &o, Figures &total, std::vector<Rank> &ranks, std::string &why) {
  std::string csv = csvHead;
  Frame frame, before;
  Picture picture, beforePicture;
  for (size_t d = 0; d < o.names.size(); d++) {
    std::vector<long> numbers;
    if (!listFrames(o.names[d], numbers, why)) return false;
    long last = -1;
    for (size_t k = 0; k < numbers.size(); k++) {
      if (k % o.every != 0 && !(o.pairs && k % o.every == 1)) continue;
      long n = numbers[k];
      std::swap(frame, before);
      std::swap(picture, beforePicture);
      if (!readFrame(o.names[d], n, frame, why) || !makeTruth(o, d, n, frame, picture, why)) return false;
      Figures f = compare(frame, picture);
      // Flicker is measured only between neighbouring frames of a run.
      if (last >= 0 && last == n - 1) compareFlicker(before, beforePicture, frame, picture, f);
      last = n;
      total.add(f);
      ranks.push_back({badness(f), d, n});
      if (o.verbose) printFrame(n, frame.scene.time, f);
      if (!o.csv.empty()) csv += csvLine(n, frame.scene.time, f);
    }
  }
  std::stable_sort(ranks.begin(), ranks.end(),
                   [](const Rank &a, const Rank &b) { return a.badness > b.badness; });
  return o.csv.empty() || writeFile(o.csv, csv, why);
}

// Writes a frame as a picture: ours, true, difference.
bool writeSheet(const Options &o, const Rank &r, std::string &why) {
  Frame frame;
  Picture picture;
  if (!readFrame(o.names[r.dir], r.number, frame, why)) return false;
  picture.trace(frame.scene, (int)o.threads);
  char name[48];
  // Frames of the second and later directories have the directory's number in their names.
  if (r.dir) std::snprintf(name, sizeof name, "/W%07ld-%d.PPM", r.number, (int)r.dir + 1);
  else std::snprintf(name, sizeof name, "/W%07ld.PPM", r.number);
  return writePpm(o.out + name, SHEET_WIDTH, HEIGHT, sheet(frame, picture), why);
}

bool showWorst(const Options &o, const std::vector<Rank> &ranks, std::string &why) {
  for (size_t k = 0; k < ranks.size() && k < (size_t)o.worst; k++) {
    const Rank &r = ranks[k];
    if (o.row.empty()) {
      std::printf("worst frame: %ld (%.2f bars)", r.number, r.badness);
      if (o.names.size() > 1) std::printf(" in %s", o.names[r.dir].c_str());
      std::printf("\n");
    }
    if (!o.out.empty() && !writeSheet(o, r, why)) return false;
  }
  return true;
}

// Returns whether all figures hold their bars.
bool printBars(int spacing, const Figures &total) {
  bool held = true;
  for (const Bar &b : bars) {
    double most = b.most(spacing), v = b.value(total);
    if (!b.known(total)) {
      std::printf("bar not judged: %s\n", b.name);
    } else if (v > most) {
      std::printf("bar broken: %s: %.4f, at most %g\n", b.name, v, most);
      held = false;
    }
  }
  if (held) std::printf("bars: held\n");
  return held;
}

}  // namespace

int main(int argc, char **argv) {
  Options o;
  std::string why;
  for (int i = 1; i < argc; i++) {
    std::string a = argv[i];
    if (a == "-h" || a == "--help") {
      std::fputs(usage, stdout);
      return 0;
    }
    if (a == "--head") {
      printHead();
      return 0;
    }
    if (!takeArgument(argv, i, o, why)) return trouble(why);
  }
  if (o.names.empty()) return trouble(o.rendering ? "no scene named" : "no directory named (--help lists the options)");
  if (o.rendering) return render(o.out, o.names, (int)o.threads);
  if (!o.row.empty() && o.spacing == 0) return trouble("--row wants --bars");

  Figures total;
  std::vector<Rank> ranks;
  if (!judge(o, total, ranks, why) || !showWorst(o, ranks, why)) return trouble(why);
  if (!o.row.empty()) {
    bool good = printRow(o, total, why);
    return why.empty() ? !good : trouble(why);
  }
  printTotals(total);
  return o.spacing != 0 && !printBars(o.spacing, total);
}
