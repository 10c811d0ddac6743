// mkscene: makes random scenes for tests; the same SEED gives the same scene on every machine.
//
//   mkscene SEED [OBJECTS] [eye] [dents] [paint] [shapes]   writes a scene file to standard output
//
// A scene has three to nine objects (or OBJECTS) of all kinds within the view of the default camera. Some form groups, most of
// them move, some turn, swing or pulse. They are linked in one of several graphs with weights up to 4. With `dents`, one to three
// more objects dig into others, and some have a strength other than 1. With `eye`, the eye moves around the same scene. With
// `paint`, half of the objects have a finish or a pattern, and colours mix in every other scene. With `shapes`, objects are also
// stretched, tapered, twisted and bent. Random scenes test the program on cases that nobody has thought of.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

uint64_t state;

// splitmix64
uint64_t next() {
  uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

int between(int low, int high) { return low + (int)(next() % (uint64_t)(high - low + 1)); }
double tenths(int low, int high) { return between(low * 10, high * 10) / 10.0; }
// Returns true with probability 1 / times.
bool once(int times) { return between(1, times) == 1; }

// A random axis that is never 0 0 0.
void printAxis() {
  int x = between(-2, 2), y = between(-2, 2), z = between(-2, 2);
  if (!x && !y && !z) y = 1;
  printf(" axis %d %d %d", x, y, z);
}

void printTurning(const char *name) {
  if (once(2)) {
    printf("spin %s", name);
    printAxis();
    const double period = tenths(3, 12);
    printf(" period %s%.1f\n", once(2) ? "-" : "", period);
  } else {
    printf("swing %s", name);
    printAxis();
    const int angle = between(10, 70);
    const double period = tenths(2, 9);
    printf(" angle %d period %.1f phase 0.%d\n", angle, period, between(0, 9));
  }
}

void printMoving(const char *name) {
  static const char *const planes[] = {"xy", "yz", "zx", "yx", "zy", "xz"};
  switch (between(0, 3)) {
    case 0: break;
    case 1: {
      const double radius = tenths(2, 26);
      const char *plane = planes[between(0, 5)];
      const char *sign = once(2) ? "-" : "";
      const double period = tenths(2, 12);
      printf("circle %s radius %.1f plane %s period %s%.1f phase 0.%d\n", name, radius, plane, sign, period, between(0, 9));
      break;
    }
    case 2:
      printf("path %s", name);
      for (char axis = 'x'; axis <= 'z'; axis++) {
        const double amplitude = tenths(0, 20), period = tenths(2, 12);
        printf(" %c %.1f %.1f 0.%d", axis, amplitude, period, between(0, 9));
      }
      printf("\n");
      break;
    case 3: {
      const int keys = between(2, 5);
      printf("keys %s %s repeat %d\n", name, once(2) ? "smooth" : "linear", 2 * keys);
      for (int k = 0; k < keys; k++) {
        const double time = 2 * k + tenths(0, 1), x = tenths(-20, 20), y = tenths(-14, 14), z = tenths(-16, 16);
        printf("key %s %.1f %.1f %.1f %.1f", name, time, x, y, z);
        if (once(3)) printf(" angle %d", between(-180, 180));
        if (once(4)) printf(" scale %.1f", tenths(0, 1) * 0.8 + 0.6);
        printf("\n");
      }
      break;
    }
  }
}

void printGroup(int g) {
  const std::string name = "g" + std::to_string(g);
  const double x = tenths(-14, 14), y = tenths(-10, 10), z = tenths(-6, 20);
  printf("group %s at %.1f %.1f %.1f", name.c_str(), x, y, z);
  if (once(3)) printf(" scale 0.%d", between(6, 9));
  if (g == 2 && once(2)) printf(" in g1");
  printf("\n");
  if (!once(3)) printTurning(name.c_str());
  if (once(3)) {
    const int across = between(2, 12);
    printf("path %s x %d 7 0 z %d 9 0.25\n", name.c_str(), across, between(2, 12));
  }
}

enum Kind { SPHERE, CYLINDER, TORUS, DISC, CONE };

void printKind(const char *name, Kind kind, int size) {
  switch (kind) {
    case SPHERE: printf("sphere %s size %d", name, size); break;
    case CYLINDER: printf("cylinder %s size %d length %d", name, size, between(5, 44)); break;
    case TORUS: printf("torus %s size %d ring %d", name, size, std::max(between(8, 28), (size * 5 + 7) / 8)); break;
    case DISC:
      // One in three discs is replaced by a box.
      if (once(3)) {
        const int x = between(2, 30), y = between(2, 30);
        printf("box %s size %d x %d y %d z %d", name, size, x, y, between(2, 30));
      } else {
        printf("disc %s size %d disc %d", name, size, between(4, 24));
      }
      break;
    case CONE: {
      const int tip = between(3, 24);
      printf("cone %s size %d tip %d length %d", name, size, tip, std::max(between(8, 40), (abs(size - tip) + 1) / 2));
      break;
    }
  }
}

void printWarps(const char *name) {
  static const struct {
    const char *word;
    double most;
  } warps[] = {{"taper", 0.7}, {"twist", 180}, {"bend", 120}};
  for (const auto &warp : warps) {
    if (!once(4)) continue;
    const double amount = warp.most * between(-100, 100) / 100.0, swing = warp.most * between(0, 100) / 100.0;
    printf("%s %s %.2f", warp.word, name, amount);
    if (once(2)) printf(" swing %.2f period %.1f phase 0.%d", swing, tenths(3, 9), between(0, 9));
    printf("\n");
  }
}

// The object's size is at most about 16 * 2^doublings.
void printObject(int i, int doublings, int groups, bool shapes) {
  const std::string name = "o" + std::to_string(i);
  // Some kinds are more likely than others.
  static const Kind kinds[] = {SPHERE, SPHERE, SPHERE, SPHERE, CYLINDER, CYLINDER, TORUS, DISC, CONE};
  const Kind kind = kinds[between(0, 8)];
  // Sizes are chosen on a logarithmic scale: a small object is as likely as a large one.
  int size = between(5, 16);
  const int most = kind == SPHERE ? doublings : std::min(doublings, 1);
  for (int d = between(0, most); d > 0; d--) size = size * 19 / 10;
  printKind(name.c_str(), kind, size);
  const double x = tenths(-20, 20), y = tenths(-14, 14), z = tenths(-16, 30);
  printf(" at %.1f %.1f %.1f", x, y, z);
  const bool stretched = shapes && !once(3);
  // Stretch factors are from 0.25 to 2, but at most 1 along z and along the axes in which the kind is long.
  if (stretched) {
    const double x = between(25, 100) / 50.0, y = between(25, 100) / (kind == SPHERE ? 50.0 : 100.0);
    printf(" stretch %.2f %.2f %.2f", kind == TORUS || kind == DISC ? x / 2 : x, y, between(25, 100) / 100.0);
  }
  // A plain sphere looks the same however it is turned.
  const bool turns = kind != SPHERE || stretched;
  if (turns) {
    const int a = between(-180, 180), b = between(-180, 180);
    printf(" turn %d %d %d", a, b, between(-180, 180));
  }
  if (groups > 0 && !once(3)) printf(" in g%d", between(1, groups));
  printf("\n");
  printMoving(name.c_str());
  if (turns && once(2)) printTurning(name.c_str());
  if (shapes) printWarps(name.c_str());
  if (once(5)) {
    const int by = between(5, 40);
    printf("pulse %s by 0.%02d period %.1f\n", name.c_str(), by, tenths(2, 8));
  }
}

// Three of four links have weight 1, as in the report.
double weight() {
  if (!once(4)) return 1;
  return once(2) ? between(2, 9) / 10.0 : between(11, 40) / 10.0;
}

void printLink(int i, int j) {
  const double w = weight();
  printf("blend o%d o%d", i, j);
  if (w != 1) printf(" %.1f", w);
  printf("\n");
}

void printLinks(int objects) {
  switch (between(0, 7)) {
    case 0:
    case 1: printf("blend all\n"); break;
    case 2: printf("blend all %.1f\n", between(3, 40) / 10.0); break;
    case 3:
      // Each object is linked with the previous one: a chain.
      for (int i = 2; i <= objects; i++) printLink(i, i - 1);
      break;
    case 4:
      // Every object is linked with the first one.
      for (int i = 2; i <= objects; i++) printLink(1, i);
      break;
    case 5:
      // Two bodies are formed, in each of which all objects are linked.
      for (int i = 1; i <= objects; i++)
        for (int j = 1; j < i; j++)
          if ((i - j) % 2 == 0) printLink(i, j);
      break;
    default:
      // About half of all pairs are linked.
      for (int i = 1; i <= objects; i++)
        for (int j = 1; j < i; j++)
          if (once(2)) printLink(i, j);
      break;
  }
}

// An eye at some distance from the scene, on one of several paths around it; it looks at the centre, at an object, or ahead.
void printEye(int objects) {
  printf("eye 0 0 0\n");
  switch (between(0, 3)) {
    case 0:
    case 1: {
      const int radius = between(100, 125);
      const double period = tenths(6, 20);
      printf("circle eye radius %d plane zx period %s%.1f phase 0.%d\n", radius, once(2) ? "-" : "", period, between(0, 9));
      const double swell = tenths(0, 40);
      printf("path eye y %.1f %.1f 0\n", swell, tenths(4, 12));
      break;
    }
    case 2: {
      const int radius = between(100, 125), lift = between(20, 90);
      printf("circle eye u %d 0 0 v 0 %d %d period %.1f\n", radius, lift, radius, tenths(6, 20));
      break;
    }
    default:
      // It looks ahead at the scene, because it is on an arm that turns about the centre.
      printf("group arm\nspin arm axis 0 1 0 period %.1f\nswing arm axis 1 0 0 angle %d period %.1f\n", tenths(8, 20),
             between(10, 40), tenths(5, 12));
      printf("eye 0 0 -%d in arm\n", between(100, 125));
      if (once(2)) printf("roll %d\n", between(-180, 180));
      return;
  }
  if (once(3))
    printf("look o%d\n", between(1, objects));
  else
    printf("look %d %d %d\n", between(-8, 8), between(-6, 6), between(0, 14));
  if (once(4)) printf("roll %d\n", between(-180, 180));
}

void printDents(int objects) {
  // Dents come after the links, because `blend all` leaves out objects that dig. Each is near the centre of another object.
  for (int i = 1; i <= objects; i++)
    if (once(3)) printf("strength o%d %.2f\n", i, once(2) ? between(25, 95) / 100.0 : between(11, 40) / 10.0);
  const int diggers = objects < 126 ? between(1, 3) : 0;
  for (int d = 1; d <= diggers; d++) {
    const int into = between(1, objects), size = between(5, 24);
    const double x = tenths(-8, 8), y = tenths(-8, 8), z = tenths(-14, 0);
    if (once(3)) {
      printf("cylinder d%d size %d length %d", d, size, between(5, 30));
    } else {
      printf("sphere d%d size %d", d, size);
    }
    printf(" at %.1f %.1f %.1f in o%d\n", x, y, z, into);
    if (once(2)) printTurning(("d" + std::to_string(d)).c_str());
    for (int i = 1; i <= objects; i++) {
      if (i != into && !once(3)) continue;
      printf("dent o%d d%d", i, d);
      if (once(2)) printf(" %.1f", between(3, 25) / 10.0);
      printf("\n");
    }
  }
}

void printPaint(int objects) {
  static const char *const finishes[] = {"shiny", "mirror"}, *const patterns[] = {"checks", "stripes", "marble"};
  if (once(2)) printf("colours mixed\n");
  for (int i = 1; i <= objects; i++) {
    if (once(3)) printf("finish o%d %s\n", i, finishes[between(0, 1)]);
    if (!once(3)) continue;
    const char *pattern = patterns[between(0, 2)];
    const double size = tenths(4, 20);
    printf("pattern o%d %s %.1f #%06x\n", i, pattern, size, between(0, 0xffffff));
  }
}

}  // namespace

int main(int count, char **arguments) {
  // Returns whether `word` is the last argument, and drops it. Words are asked for from the last one in the usage to the first.
  auto endsWith = [&](const char *word) {
    const bool there = count > 2 && std::string(arguments[count - 1]) == word;
    if (there) count--;
    return there;
  };
  const bool shapes = endsWith("shapes"), paint = endsWith("paint"), dents = endsWith("dents"), eye = endsWith("eye");
  char *end = nullptr;
  const unsigned long long seed = count > 1 ? strtoull(arguments[1], &end, 10) : 0;
  if (count < 2 || count > 3 || end == arguments[1] || *end != 0) {
    fputs("usage: mkscene SEED [OBJECTS, 1 to 128] [eye] [dents] [paint] [shapes]\n", stderr);
    return 2;
  }
  state = seed;
  int objects = between(3, 9);
  if (count == 3) {
    objects = atoi(arguments[2]);
    if (objects < 1 || objects > 128) {
      fprintf(stderr, "mkscene: '%s': expected 1 to 128 objects\n", arguments[2]);
      return 2;
    }
  }
  printf("# Random scene %llu of %d objects.\n", seed, objects);

  const int groups = std::max(between(-1, 2), 0);
  for (int g = 1; g <= groups; g++) printGroup(g);
  // If there are many objects, few of them may be large.
  const int doublings = objects > 24 ? 0 : objects > 9 ? 1 : 2;
  for (int i = 1; i <= objects; i++) printObject(i, doublings, groups, shapes);
  printLinks(objects);
  if (eye) printEye(objects);
  if (dents) printDents(objects);
  if (paint) printPaint(objects);
  return 0;
}
