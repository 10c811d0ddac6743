// mkscene: random scenes for tests, the same one for the same seed on every machine.
//
//   mkscene SEED [OBJECTS]      writes a scene file to standard output
//
// Two to eight spheres (or as many as asked for) of sizes from 5 to 60, on paths of every kind, most of them linked,
// within what the default camera sees. This file exists so that the picture is tried on scenes nobody chose.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

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

}  // namespace

int main(int count, char **arguments) {
  char *end = nullptr;
  const unsigned long long seed = count > 1 ? strtoull(arguments[1], &end, 10) : 0;
  if (count < 2 || count > 3 || end == arguments[1] || *end != 0) {
    fputs("usage: mkscene SEED [OBJECTS, 1 to 128]\n", stderr);
    return 2;
  }
  state = seed;
  int objects = between(2, 8);
  if (count == 3) {
    objects = atoi(arguments[2]);
    if (objects < 1 || objects > 128) {
      fprintf(stderr, "mkscene: '%s': expected 1 to 128 objects\n", arguments[2]);
      return 2;
    }
  }
  printf("# Random scene %llu of %d spheres.\n", seed, objects);
  static const char *const planes[] = {"xy", "yz", "zx", "yx", "zy", "xz"};
  for (int i = 1; i <= objects; i++) {
    // Sizes on a scale where halving is as likely as doubling; many objects are small.
    int size = between(5, 16);
    for (int d = between(0, objects > 8 ? 1 : 2); d > 0; d--) size = size * 19 / 10;
    printf("sphere s%d size %d at %.1f %.1f %.1f\n", i, size, tenths(-20, 20), tenths(-14, 14), tenths(-20, 30));
    switch (between(0, 3)) {
      case 0: break;
      case 1:
        printf("circle s%d radius %.1f plane %s period %s%.1f phase 0.%d\n", i, tenths(2, 26), planes[between(0, 5)],
               between(0, 1) ? "-" : "", tenths(2, 12), between(0, 9));
        break;
      case 2:
        printf("path s%d", i);
        for (char axis = 'x'; axis <= 'z'; axis++)
          printf(" %c %.1f %.1f 0.%d", axis, tenths(0, 20), tenths(2, 12), between(0, 9));
        printf("\n");
        break;
      case 3: {
        const int keys = between(2, 5);
        printf("keys s%d %s repeat %d\n", i, between(0, 1) ? "smooth" : "linear", 2 * keys);
        for (int k = 0; k < keys; k++)
          printf("key s%d %.1f %.1f %.1f %.1f\n", i, 2 * k + tenths(0, 1), tenths(-20, 20), tenths(-14, 14), tenths(-16, 16));
        break;
      }
    }
  }
  switch (between(0, 3)) {
    case 0:
      // About half of the pairs.
      for (int i = 1; i <= objects; i++)
        for (int j = 1; j < i; j++)
          if (between(0, 1)) printf("blend s%d s%d\n", i, j);
      break;
    default: printf("blend all\n"); break;
  }
  return 0;
}
