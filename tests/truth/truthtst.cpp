// Tests of the yardstick on shapes whose answer is known without it.
//
// This file exists because every figure the project shows rests on the
// yardstick: its depths are held against closed forms and against a plain
// walk along the ray, its counts against frames damaged by a known amount.
#include "truth.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace truth;

static int passed, failed;

static void check(bool good, const std::string &what) {
  if (good) {
    passed++;
  } else {
    failed++;
    std::printf("FAILED: %s\n", what.c_str());
  }
}

static void checkNear(double got, double want, double within, const std::string &what) {
  bool good = std::fabs(got - want) <= within;
  check(good, what);
  if (!good) std::printf("  got %.12g, want %.12g\n", got, want);
}

static const std::string camera =
    "time 1.200\neye 0 0 -120\nfocal 250 208.333\ncentre 160 100\nlight 0.5 0.7 -0.5\nisovalue 0.5\n";

static Scene scene(const std::string &text) {
  Scene s;
  std::string why;
  if (!parseScene(camera + text, "scene", s, why)) {
    check(false, "scene refused: " + why);
    parseScene(camera, "scene", s, why);
  }
  return s;
}

static Vec direction(const Scene &s, double column, double row) {
  return {(column - s.centreX) / s.focalX, -(row - s.centreY) / s.focalY, 1};
}

// Closed form: the depth at which the ray enters a ball, or -1.
static double enterBall(Vec eye, Vec d, Vec c, double r) {
  Vec m = eye - c;
  double a = dot(d, d), b = dot(m, d), k = b * b - a * (dot(m, m) - r * r);
  return k < 0 ? -1 : (-b - std::sqrt(k)) / a;
}

// Closed form: the depth at which the ray enters a capsule, or -1.
static double enterCapsule(Vec eye, Vec d, Vec a, Vec b, double r) {
  double best = -1;
  auto take = [&](double t) {
    if (t >= 0 && (best < 0 || t < best)) best = t;
  };
  take(enterBall(eye, d, a, r));
  take(enterBall(eye, d, b, r));
  double len = length(b - a);
  Vec u = (b - a) * (1 / len), m = eye - a;
  Vec ma = m - u * dot(m, u), da = d - u * dot(d, u);
  double qa = dot(da, da), qb = dot(ma, da), k = qb * qb - qa * (dot(ma, ma) - r * r);
  if (k >= 0 && qa > 0) {
    double t = (-qb - std::sqrt(k)) / qa, s = dot(m + d * t, u);
    if (s >= 0 && s <= len) take(t);
  }
  return best;
}

// How far above (below) the surface of the model's solid a point lies: the
// definition written down plainly, body by body.
static double solid(const Scene &s, Vec p) {
  size_t n = s.objects.size();
  std::vector<size_t> body(n);
  for (size_t i = 0; i < n; i++) body[i] = i;
  for (bool more = true; more;) {
    more = false;
    for (size_t i = 0; i < n; i++)
      for (size_t j = 0; j < n; j++)
        if (s.link[i][j] != 0 && body[j] < body[i]) body[i] = body[j], more = true;
  }
  std::vector<double> f(n);
  for (size_t i = 0; i < n; i++) f[i] = s.objects[i].strength * geoff(s.objects[i].q(p, nullptr));
  double best = -s.isovalue;
  for (size_t k = 0; k < n; k++) {
    double above = 0, below = 0;
    for (size_t i = 0; i < n; i++) {
      if (body[i] != k || s.objects[i].ghost) continue;
      double g = f[i];
      for (size_t j = 0; j < n; j++) g += s.weight[i][j] * f[j];
      above += f[i] * f[i] * g, below += f[i] * f[i];
    }
    if (below > 0) best = std::max(best, above / below - s.isovalue);
  }
  return best;
}

// A plain walk along the ray; finds no slice thinner than its step.
static double walk(const Scene &s, Vec d, double from, double to, double step) {
  double last = from;
  for (double t = from; t <= to; last = t, t += step) {
    if (solid(s, s.eye + d * t) < 0) continue;
    double a = last, b = t;
    for (int i = 0; i < 50; i++) {
      double m = (a + b) / 2;
      (solid(s, s.eye + d * m) >= 0 ? b : a) = m;
    }
    return b;
  }
  return -1;
}

static unsigned long long state = 1;
static double random01() {
  state = state * 6364136223846793005ull + 1442695040888963407ull;
  return (double)(state >> 11) / 9007199254740992.0;
}
static double random(double low, double high) { return low + (high - low) * random01(); }

// Every fifth ray or so of a scene against the plain walk.
static void againstWalk(const Scene &s, const std::string &name, int stride, bool plain = true) {
  Tracer tracer(s);
  if (!plain) tracer.forgetPlain();
  int wrong = 0, thin = 0, hits = 0, looked = 0;
  for (int row = 0; row < HEIGHT; row += stride)
    for (int column = row % stride; column < WIDTH; column += stride) {
      double c = column + random01(), r = row + random01();
      Vec d = direction(s, c, r);
      double want = walk(s, d, 60, 180, 0.05);
      Hit got = tracer.trace(c, r);
      looked++;
      hits += got.any();
      if (std::fabs(got.depth - want) < 1e-5) continue;
      // The walk may have stepped over a slice; then ours has to be a place
      // where the solid begins all the same, before the walk's.
      if (got.any() && (want < 0 || got.depth < want) && solid(s, s.eye + d * got.depth) > -1e-5) thin++;
      else wrong++;
    }
  check(wrong == 0, name + ": " + std::to_string(wrong) + " of " + std::to_string(looked) + " rays wrong");
  check(hits > looked / 100, name + ": the rays hit something");
  check(thin <= looked / 100, name + ": " + std::to_string(thin) + " thin slices is too many");
}

// The greatest distance from the origin at which `inside` holds, between 0 and `most`.
template <class Inside>
static double outermost(double most, Inside inside) {
  double low = 0, high = most;
  for (int i = 0; i < 200; i++) {
    double m = (low + high) / 2;
    (inside(m) ? low : high) = m;
  }
  return low;
}

// Rays that two scenes of the same shape answer alike.
static void checkAlike(const std::string &one, const std::string &other, const std::string &name, int stride, double depth,
                       double shade) {
  Scene a = scene(one), b = scene(other);
  Tracer ta(a), tb(b);
  int different = 0, hits = 0;
  for (int r = 0; r < HEIGHT; r += stride)
    for (int c = 0; c < WIDTH; c += stride) {
      Hit ha = ta.trace(c, r), hb = tb.trace(c, r);
      different += std::fabs(ha.depth - hb.depth) > depth || std::fabs(ha.shade - hb.shade) > shade;
      hits += hb.any();
    }
  check(different == 0 && hits > 50, name + ": " + std::to_string(different) + " rays differ");
}

// Returns how far a gradient is from that of differences of the function.
template <class Function>
static double gradientError(Function f, Vec p, Vec gradient) {
  const double e = 1e-5;
  auto slope = [&](Vec d) { return (f(p + d * e) - f(p - d * e)) / (2 * e); };
  return length(gradient - Vec{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})}) / (1 + length(gradient));
}

// The field of a scene's only body, its gradient and its strongest object at points.
static void checkField(const Scene &s, const std::string &name, bool dented) {
  Tracer tracer(s);
  double worst = 0, worstField = 0;
  int wrong = 0, near = 0;
  for (int i = 0; i < 400; i++) {
    Vec p{random(-15, 15), random(-15, 15), random(-15, 15)}, g;
    int strongest = -1;
    double F = tracer.field(0, p, &g, &strongest);
    // solid() is 0.5 below 0 at least; only a dent makes a field negative.
    worstField = std::max(worstField, std::fabs((dented ? std::max(F, 0.0) : F) - (solid(s, p) + 0.5)));
    if (strongest < 0) continue;
    near++;
    worst = std::max(worst, gradientError([&](Vec at) { return tracer.field(0, at, nullptr, nullptr); }, p, g));
    auto own = [&](const Object &o) { return o.strength * geoff(o.q(p, nullptr)); };
    wrong += s.objects[strongest].ghost;
    for (const Object &o : s.objects) wrong += !o.ghost && own(o) > own(s.objects[strongest]);
  }
  check(near > 200 && worst < 1e-4, "gradient " + name);
  check(worstField < 1e-12, "field " + name);
  check(wrong == 0, "the strongest object " + name);
}

static void spheres() {
  // F = 0.5 at half the size, so an unblended sphere is a ball of radius R/2.
  checkNear(geoff(0.25), 0.5, 1e-15, "Geoff at half the size");
  checkNear(geoff(0), 1, 0, "Geoff at the core");
  checkNear(geoff(1 - 1e-9), 0, 1e-12, "Geoff at the size");
  for (double q = 0.05; q < 1.2; q += 0.1)
    checkNear(geoffSlope(q), (geoff(q + 1e-6) - geoff(q - 1e-6)) / 2e-6, 1e-8, "slope of Geoff");
  Scene s = scene("sphere 1 3.25 -4 5 30\n");
  Vec c{3.25, -4, 5};
  Picture p;
  p.trace(s, 2);
  double worstDepth = 0, worstShade = 0;
  int wrong = 0, hits = 0;
  for (int row = -MARGIN; row < HEIGHT + MARGIN; row++)
    for (int column = -MARGIN; column < WIDTH + MARGIN; column++) {
      Vec d = direction(s, column + 0.5, row + 0.5);
      double t = enterBall(s.eye, d, c, 15);
      const Hit &h = p.at(column, row);
      if ((t >= 0) != h.any()) wrong++;
      if (t < 0 || !h.any()) continue;
      hits++;
      worstDepth = std::max(worstDepth, std::fabs(t - h.depth));
      Vec n = (s.eye + d * t - c) * (1 / 15.0);
      worstShade = std::max(worstShade, std::fabs(63 * std::max(0.0, dot(n, s.light)) - h.shade));
      wrong += h.object != 0;
    }
  check(wrong == 0, "sphere: every pixel hit or missed as in the closed form");
  checkNear(hits, M_PI * 15 * 15 * 250 * 208.333 / (125 * 125 - 15 * 15), 60, "sphere: area on the screen");
  check(worstDepth < 1e-6, "sphere: depth within a millionth");
  check(worstShade < 1e-4, "sphere: brightness");
  // Sizes from far to near, whole picture filled by the last.
  for (double z : {-95.0, -60.0, 0.0, 200.0}) {
    Scene v = scene("sphere 1 0 0 " + std::to_string(z) + " 40\n");
    Tracer t(v);
    checkNear(t.trace(160, 100).depth, z + 120 - 20, 1e-9, "sphere: centre ray");
  }
  check(Tracer(scene("sphere 1 0 0 -110 40\n")).eyeInside(), "eye inside is noticed");
  check(!Tracer(s).eyeInside(), "eye outside is noticed");
  check(!Tracer(scene("sphere 1 0 0 -150 40\n")).trace(160, 100).any(), "nothing behind the eye is seen");
  // Ambient: a share of the ramp that needs no light.
  Scene lit = scene("ambient 0.25\nsphere 1 3.25 -4 5 30\n");
  Hit a = Tracer(s).trace(170, 105), b = Tracer(lit).trace(170, 105);
  checkNear(b.shade, 63 * (0.25 + 0.75 * a.shade / 63), 1e-4, "ambient light");
}

static void pairs() {
  // On the line through both centres the problem has one dimension.
  Scene s = scene("sphere 1 0 0 0 20\nsphere 2 0 0 12 30\nblend 1 2\n");
  double z = outermost(60, [](double x) { return geoff(x * x / 400) + geoff((x + 12) * (x + 12) / 900) >= 0.5; });
  Hit h = Tracer(s).trace(160, 100);
  checkNear(h.depth, 120 - z, 1e-9, "linked pair: centre ray");
  check(h.depth < 110 - 0.1, "linked pair: bulges");
  checkNear(Tracer(scene("sphere 1 0 0 0 20\nsphere 2 0 0 12 30\n")).trace(160, 100).depth, 110, 1e-9,
            "unlinked pair: each for itself");
  // The saddle between two equal spheres: 2 f = 0.5 at q = (a^2 + z^2) / R^2.
  double q = outermost(1, [](double x) { return geoff(x) >= 0.25; });
  Scene saddle = scene("sphere 1 -11 0 0 20\nsphere 2 11 0 0 20\nblend 1 2\n");
  Hit mid = Tracer(saddle).trace(160, 100);
  checkNear(mid.depth, 120 - std::sqrt(q * 400 - 121), 1e-7, "linked pair: saddle");
  checkNear(mid.shade, 63 * saddle.light.z * -1, 1e-3, "linked pair: the saddle faces the viewer");
  // The neck as thin as can be: there by 1e-10 of field, or not there.
  for (double excess : {1e-4, 1e-7, 1e-10}) {
    for (int sign : {1, -1}) {
      char text[200];
      double off = std::sqrt(outermost(1, [&](double x) { return 2 * geoff(x) >= 0.5 + sign * excess; })) * 20;
      std::snprintf(text, sizeof text, "sphere 1 %.17g 0 0 20\nsphere 2 %.17g 0 0 20\nblend 1 2\n", -off, off);
      Hit thin = Tracer(scene(text)).trace(160, 100);
      check(thin.any() == (sign > 0), "neck of excess " + std::to_string(sign * excess));
      if (thin.any()) checkNear(thin.depth, 120, 0.5 * std::sqrt(excess / 1e-4), "neck: depth");
    }
  }
  // Linked but out of reach: as if alone.
  Scene apart = scene("sphere 1 -25 0 0 20\nsphere 2 25 0 0 20\nblend 1 2\n");
  Scene alone = scene("sphere 1 -25 0 0 20\n");
  checkNear(Tracer(apart).trace(110, 100).depth, Tracer(alone).trace(110, 100).depth, 1e-9, "out of reach");
}

static void tangents() {
  // Rays that pass a ball of radius 10 by a hair's breadth on either side.
  Scene s = scene("sphere 1 0 0 0 20\n");
  Tracer tracer(s);
  int wrong = 0;
  for (int i = 0; i < 360; i++)
    for (double hair : {1e-3, 1e-6, 1e-9}) {
      double angle = i * M_PI / 180;
      for (int sign : {1, -1}) {
        double sine = (10 + sign * hair) / 120, slope = sine / std::sqrt(1 - sine * sine);
        double c = 160 + 250 * slope * std::cos(angle), r = 100 - 208.333 * slope * std::sin(angle);
        wrong += tracer.trace(c, r).any() != (sign < 0);
      }
    }
  check(wrong == 0, "tangents to a sphere: " + std::to_string(wrong) + " wrong");
  // The same along a cylinder's body, and seen along its axis.
  Scene cyl = scene("cylinder 1 -40 0 0 40 0 0 20\n");
  Tracer ct(cyl);
  wrong = 0;
  for (int i = -30; i <= 30; i++)
    for (double hair : {1e-3, 1e-6, 1e-9})
      for (int sign : {1, -1}) {
        double sine = (10 + sign * hair) / 120, slope = sine / std::sqrt(1 - sine * sine);
        wrong += ct.trace(160 + i, 100 + 208.333 * slope).any() != (sign < 0);
      }
  check(wrong == 0, "tangents to a cylinder: " + std::to_string(wrong) + " wrong");
  Scene axis = scene("cylinder 1 0 0 0 0 0 40 20\n");
  checkNear(Tracer(axis).trace(160, 100).depth, 110, 1e-9, "cylinder seen along its axis");
}

static void cylinders() {
  struct {
    Vec a, b;
    double size;
  } rows[] = {{{-20, -5, 3}, {18, 9, -14}, 12}, {{0, 0, 0}, {10, 0, 0}, 30},
              {{-30, 20, 0}, {30, 20, 60}, 8},  {{5, -30, 10}, {5, 30, 10}, 25}};
  for (auto &row : rows) {
    char text[200];
    std::snprintf(text, sizeof text, "cylinder 5 %g %g %g %g %g %g %g\n", row.a.x, row.a.y, row.a.z,
                  row.b.x, row.b.y, row.b.z, row.size);
    Scene s = scene(text);
    Picture p;
    p.trace(s, 2);
    int wrong = 0, hits = 0;
    double worst = 0;
    for (int r = 0; r < HEIGHT; r++)
      for (int c = 0; c < WIDTH; c++) {
        double t = enterCapsule(s.eye, direction(s, c + 0.5, r + 0.5), row.a, row.b, row.size / 2);
        const Hit &h = p.at(c, r);
        wrong += (t >= 0) != h.any();
        if (t < 0 || !h.any()) continue;
        hits++;
        worst = std::max(worst, std::fabs(t - h.depth));
      }
    check(wrong == 0 && hits > 500, "capsule: " + std::to_string(wrong) + " wrong of " + std::to_string(hits));
    check(worst < 1e-6, "capsule: depth within a millionth");
  }
  Scene point = scene("cylinder 5 1 2 3 1 2 3 20\n"), ball = scene("sphere 1 1 2 3 20\n");
  checkNear(Tracer(point).trace(165, 98).depth, Tracer(ball).trace(165, 98).depth, 1e-9, "cylinder of no length");
}

static void unlinked() {
  // Each ball for itself: the picture is the nearest of them.
  Scene s = scene("sphere 1 -5 0 0 30\nsphere 2 5 3 4 26\nsphere 3 0 -4 -6 20\n");
  Picture p;
  p.trace(s, 2);
  int wrong = 0;
  double worst = 0;
  for (int r = 0; r < HEIGHT; r++)
    for (int c = 0; c < WIDTH; c++) {
      double best = -1;
      int who = -1;
      for (int i = 0; i < 3; i++) {
        const Object &o = s.objects[i];
        double t = enterBall(s.eye, direction(s, c + 0.5, r + 0.5), o.a, o.size / 2);
        if (t >= 0 && (best < 0 || t < best)) best = t, who = i;
      }
      const Hit &h = p.at(c, r);
      wrong += (best >= 0) != h.any() || h.object != who;
      if (best >= 0 && h.any()) worst = std::max(worst, std::fabs(best - h.depth));
    }
  check(wrong == 0, "unlinked overlap: " + std::to_string(wrong) + " wrong");
  check(worst < 1e-6, "unlinked overlap: depth");
}

static void others() {
  // Kinds that come down to another kind, and flat faces.
  struct {
    const char *one, *other, *name;
  } rows[] = {
      {"cone 1 -9 2 3 18 14 5 -7 18\n", "cylinder 1 -9 2 3 14 5 -7 18\n", "cone of even size"},
      {"disc 1 3 2 -4 0 1 0 0 30\n", "sphere 1 3 2 -4 30\n", "disc of no radius"},
      {"box 1 3 2 -4 1 0 0 0 1 0 0 0 0 30\n", "sphere 1 3 2 -4 30\n", "box of no edges"},
      {"box 1 2.5 3.5 -2 23 3 -10 0 1 0 25.2586619 0 0 18\n", "cylinder 1 -9 2 3 14 5 -7 18\n", "box of one edge"},
      {"torus 1 3 2 -4 1 1 0 0 30\n", "sphere 1 3 2 -4 30\n", "torus of no radius"},
  };
  for (auto &row : rows) checkAlike(row.one, row.other, row.name, 3, 1e-5, 1e-2);
  Hit flat = Tracer(scene("disc 1 0 0 0 0 0 -2 20 10\n")).trace(170, 90);
  checkNear(flat.depth, 115, 1e-6, "disc: its flat face");
  checkNear(flat.shade, 63 * 0.5 / std::sqrt(0.99), 1e-3, "disc: brightness");
  check(!Tracer(scene("torus 1 0 0 0 0 0 1 20 14\n")).trace(160, 100).any(), "torus: its hole");
  Scene ring = scene("torus 1 0 0 0 0 0 1 20 14\n");
  // At the depth of the ring's plane, 20 units off the axis: over the core.
  checkNear(Tracer(ring).trace(160 + 250 * 20 / 113.0, 100).depth, 113, 0.15, "torus: over its core");
  // Gradients against differences.
  Scene every = scene("sphere 1 1 2 3 20\ncylinder 2 0 0 0 9 5 2 20\ntorus 3 1 0 0 1 1 1 9 20\n"
                      "disc 4 0 1 0 1 2 0 9 20\ncone 5 0 0 0 20 9 4 4 8\n");
  for (const Object &o : every.objects) {
    double worst = 0;
    for (int i = 0; i < 200; i++) {
      Vec p{random(-15, 15), random(-15, 15), random(-15, 15)}, g;
      o.q(p, &g);
      worst = std::max(worst, gradientError([&](Vec at) { return o.q(at, nullptr); }, p, g));
    }
    check(worst < 1e-4, std::string("gradient of ") + o.kind->word);
  }
}

// A crowd at one place, all linked: n balls of one size add up to n times
// one, and above weight 1 to more. The fields there are down to 0.001.
static void crowds() {
  char text[200];
  for (int count : {2, 12, 44, 128})
    for (double weight : {0.5, 1.0, 2.0, 4.0}) {
      std::string crowd;
      for (int i = 1; i <= count; i++) {
        std::snprintf(text, sizeof text, "sphere %d 0 0 0 20\n", i);
        crowd += text;
        for (int j = 1; j < i; j++) {
          std::snprintf(text, sizeof text, "blend %d %d %g\n", i, j, weight);
          crowd += text;
        }
      }
      Scene s = scene(crowd);
      double r = outermost(20, [&](double x) { return (1 + (count - 1) * weight) * geoff(x * x / 400) >= 0.5; });
      std::snprintf(text, sizeof text, "%d balls at one place, weight %g", count, weight);
      Hit h = Tracer(s).trace(160, 100);
      checkNear(h.depth, 120 - r, 1e-9, std::string(text) + ": depth");
      // A ray beside the middle, and one that passes outside.
      Vec d = direction(s, 172, 92);
      checkNear(Tracer(s).trace(172, 92).depth, enterBall(s.eye, d, {0, 0, 0}, r), 1e-8, std::string(text) + ": beside");
      double sine = (r + 1e-4) / 120, slope = sine / std::sqrt(1 - sine * sine);
      check(!Tracer(s).trace(160 + 250 * slope, 100).any(), std::string(text) + ": passed by");
    }
  // Two balls of different sizes, 8 apart, weight 2, on the line through both:
  // the definition in one dimension.
  Scene two = scene("sphere 1 0 0 0 24\nsphere 2 0 0 -8 20\nblend 1 2 2\n");
  double z = outermost(40, [&](double x) {
    double f = geoff(x * x / 576), g = geoff((x - 8) * (x - 8) / 400);
    return f * f + g * g > 0 && (f * f * (f + 2 * g) + g * g * (g + 2 * f)) / (f * f + g * g) >= 0.5;
  });
  checkNear(Tracer(two).trace(160, 100).depth, 120 - z, 1e-9, "two balls of weight 2");
  check(z > 19, "weight 2 swells");
}

// Two fingers linked with a palm, not with each other. Half way between
// them, out of the palm's reach, both sums are the same, and no more than
// one finger's own field: they meet without a bulge.
static void fingers() {
  Scene hand = scene("cylinder 1 -6 0 0 -6 60 0 24\ncylinder 2 6 0 0 6 60 0 24\nsphere 3 0 -20 0 30\n"
                     "blend 1 3\nblend 2 3\n");
  Hit between = Tracer(hand).trace(160, 100 - 208.333 * 40 / 120);
  Vec at = hand.eye + direction(hand, 160, 100 - 208.333 * 40 / 120) * between.depth;
  checkNear(at.z, -std::sqrt(144 - 36.0), 1e-7, "fingers meet where one of them ends");
  check(Tracer(hand).bodyOf(0) == Tracer(hand).bodyOf(1), "what a third links is one body");
  // The same without the palm: two bodies, and the nearer is seen.
  Scene apart = scene("cylinder 1 -6 0 0 -6 60 0 24\ncylinder 2 6 0 -3 6 60 -3 24\nsphere 3 0 -20 0 30\n");
  check(Tracer(apart).bodyOf(0) != Tracer(apart).bodyOf(1), "no links, two bodies");
  check(Tracer(apart).trace(160, 60).object == 1, "the nearer of two bodies");
  check(Tracer(scene("sphere 1 0 0 0 9\nsphere 2 1 0 0 9\nblend 1 2 0\n")).bodyOf(1) == 1, "weight 0 is no link");
}

// A chain without the link from end to end has no step: from one pixel to
// the next the depth changes as the gradient says.
static void chains() {
  Scene chain = scene("eye -90 0 -90\nlight 1 0 1\nfocal 250 208.333\ncentre -90 100\n"
                      "sphere 1 -6 0 0 24\nsphere 2 0 0 0 24\nsphere 3 6 0 0 24\nblend 1 2\nblend 2 3\n");
  Tracer tracer(chain);
  int jumps = 0, hits = 0, colours = 0;
  for (double row : {100.0, 95.0, 110.0}) {
    Hit last;
    for (double c = -200 ; c < 520; c += 0.02) {
      Hit h = tracer.trace(c, row);
      if (last.any() && h.any()) {
        hits++;
        jumps += std::fabs(h.depth - last.depth) > 0.5;
        colours += h.object != last.object;
      }
      last = h;
    }
  }
  check(hits > 1000 && jumps == 0, "a chain without steps: " + std::to_string(jumps) + " jumps of " + std::to_string(hits));
  check(colours == 6, "three colours in each row of it: " + std::to_string(colours) + " changes");
  againstWalk(chain, "chain from the side", 6);
}

static void bodies() {
  crowds();
  fingers();
  chains();
  checkField(scene("sphere 1 1 2 3 20\ncylinder 2 0 0 0 9 5 2 20\ntorus 3 1 0 0 1 1 1 9 20\n"
                   "disc 4 0 1 0 1 2 0 9 20\ncone 5 0 0 0 20 9 4 4 8\nblend 1 2 2\nblend 2 3 0.5\nblend 3 4\n"
                   "blend 4 5 3\n"), "of a body", false);
}

static void strongAndWeak() {
  // Alone an object's surface lies where its strength times its field is the isovalue; a weak one has none.
  for (double strength : {0.25, 0.5, 0.51, 0.75, 1.0, 2.0, 4.0}) {
    Scene s = scene("sphere 1 0 0 0 20\nstrength 1 " + std::to_string(strength) + "\n");
    Hit h = Tracer(s).trace(160, 100);
    double r = outermost(20, [&](double x) { return strength * geoff(x * x / 400) >= 0.5; });
    check(h.any() == (strength > 0.5), "strength " + std::to_string(strength) + ": there or not");
    if (h.any()) checkNear(h.depth, 120 - r, 1e-6, "strength " + std::to_string(strength) + ": depth");
  }
  // Two in one place, linked: their strengths add.
  Scene two = scene("sphere 1 0 0 0 20\nsphere 2 0 0 0 20\nstrength 1 0.4\nstrength 2 0.35\nblend 1 2\n");
  double r = outermost(20, [](double x) { return 0.75 * geoff(x * x / 400) >= 0.5; });
  checkNear(Tracer(two).trace(160, 100).depth, 120 - r, 1e-6, "two weak balls in one place");
  check(Tracer(two).trace(160, 100).object == 0, "the stronger gives the colour");
}

static void dents(const Scene &dented) {
  // On the line through both centres the problem has one dimension.
  double z = outermost(60, [](double x) { return geoff(x * x / 3600) - 1.5 * geoff((x - 30) * (x - 30) / 900) >= 0.5; });
  Hit h = Tracer(dented).trace(160, 100);
  checkNear(h.depth, 120 - z, 1e-9, "dent: centre ray");
  check(h.depth > 100 && h.object == 0, "dent: hollow, and of the dented one's colour");
  check(Tracer(dented).bodyOf(1) == -1, "what only digs is no body");
  // Linked otherwise it has a surface; and what is dented into nothing has none.
  Scene both = scene("sphere 1 0 0 0 30\nsphere 2 0 0 -16 30\nsphere 3 0 30 -16 30\ndent 1 2\nblend 2 3\n");
  check(Tracer(both).trace(160, 100).object == 1 && Tracer(both).bodyOf(1) == Tracer(both).bodyOf(2), "linked, it is seen");
  check(!Tracer(scene("sphere 1 0 0 0 20\nsphere 2 0 0 0 40\ndent 1 2\n")).trace(160, 100).any(), "dug away");
  check(Tracer(scene("sphere 1 0 0 0 20\nsphere 2 0 0 0 40\ndent 1 2 0\n")).trace(160, 100).object == 1,
        "a dent of weight 0 is none");
}

// Strengths, and objects that dig into others.
static void strengths() {
  strongAndWeak();
  Scene dented = scene("sphere 1 0 0 0 60\nsphere 2 0 0 -30 30\ndent 1 2 1.5\n");
  dents(dented);
  Scene mixed = scene("sphere 1 1 2 3 20\ncylinder 2 0 0 0 9 5 2 20\ntorus 3 1 0 0 1 1 1 9 20\ndisc 4 0 1 0 1 2 0 9 20\n"
                      "cone 5 0 0 0 20 9 4 4 8\nblend 1 2 2\nblend 2 3 0.5\nblend 1 3\ndent 1 4\ndent 2 4 0.4\ndent 3 5 3\n"
                      "dent 1 3 0.5\nstrength 1 3\nstrength 2 0.3\nstrength 4 1.5\n");
  checkField(mixed, "with strengths and dents", true);
  againstWalk(mixed, "all of it", 9);
  againstWalk(dented, "dented ball", 6);
  againstWalk(scene("cylinder 1 -24 0 0 24 4 -8 26\nsphere 2 4 4 -12 18\ndent 1 2\n"), "dented cylinder", 6);
  againstWalk(scene("sphere 1 -9 0 0 24\nsphere 2 9 0 0 24\nsphere 3 0 4 -9 20\nblend 1 2\ndent 1 3 2\n"), "one of two dented", 6);
  againstWalk(scene("sphere 1 -9 0 0 34\nsphere 2 9 0 4 34\ntorus 3 0 0 -12 0 0.3 1 12 10\ndent 1 3\ndent 2 3\n"),
              "a ring digs into two bodies", 9);
  againstWalk(scene("sphere 1 -8 0 0 24\nsphere 2 8 0 0 24\nstrength 1 0.4\nstrength 2 3\nblend 1 2\n"), "weak and strong", 6);
  againstWalk(scene("sphere 1 -6 0 0 24\nsphere 2 6 0 0 24\nsphere 3 6 10 0 24\nstrength 1 0.45\nstrength 2 0.45\n"
                    "strength 3 2\nblend 1 2 1.5\nblend 2 3 0.3\n"), "weak ones in a chain", 6);
  againstWalk(scene("cone 1 -20 0 0 30 20 6 0 12\ndisc 2 0 8 -10 0 1 0.4 6 12\nstrength 1 1.6\ndent 1 2 0.7\n"), "dented cone", 9);
}

static void walks() {
  char text[4096];
  for (int round = 0; round < 3; round++) {
    std::string linked, links;
    for (int i = 1; i <= 4; i++) {
      std::snprintf(text, sizeof text, "sphere %d %g %g %g %g\n", i, random(-20, 20), random(-15, 15),
                    random(-20, 20), random(12, 35));
      linked += text;
      for (int j = 1; j < i; j++) links += "blend " + std::to_string(i) + " " + std::to_string(j) + "\n";
    }
    Scene s = scene(linked + links);
    againstWalk(s, "linked spheres", 8);
    againstWalk(s, "linked spheres, body", 8, false);
    Tracer whole(s), singly(s);
    singly.forgetPlain();
    int differ = 0;
    for (int r = 0; r < HEIGHT; r += 4)
      for (int c = 0; c < WIDTH; c += 4)
        differ += std::fabs(whole.trace(c, r).depth - singly.trace(c, r).depth) > 1e-5;
    check(differ <= 2, "sum and body agree: " + std::to_string(differ));
  }
  againstWalk(scene("sphere 1 -12 0 0 24\nsphere 2 0 0 0 24\nsphere 3 12 4 0 24\nblend 1 2\nblend 2 3\n"),
              "chain", 6);
  againstWalk(scene("sphere 1 -8 0 0 24\nsphere 2 8 0 0 24\nblend 1 2 0.5\n"), "weight below 1", 6);
  againstWalk(scene("sphere 1 -9 0 0 24\nsphere 2 9 0 0 24\nblend 1 2 1.5\n"), "weight above 1", 6);
  againstWalk(scene("cylinder 1 -20 0 0 20 5 -10 16\ncylinder 2 0 -20 -5 3 20 5 20\nsphere 3 10 0 -10 20\n"
                    "blend 1 2\nblend 1 3\nblend 2 3\n"), "linked cylinders", 6);
  againstWalk(scene("sphere 1 -9 0 0 24\nsphere 2 9 0 0 24\nsphere 3 0 9 -4 20\nblend 1 2 4\nblend 2 3 0.3\n"), "weights",
              6);
  againstWalk(scene("cylinder 1 -9 0 0 -12 30 0 14\ncylinder 2 -3 0 0 -2 32 0 14\ncylinder 3 3 0 0 8 30 -4 14\n"
                    "disc 4 0 -10 0 0 0 1 12 16\nblend 1 4\nblend 2 4\nblend 3 4\n"), "hand", 6);
  againstWalk(scene("torus 1 -8 0 0 0 0 1 16 6\ntorus 2 8 0 0 0 1 0.1 16 6\nsphere 3 24 0 0 14\nblend 2 3\n"),
              "hooked tori", 6);
  againstWalk(scene("torus 1 0 0 0 0 0.2 1 18 10\ncone 2 -18 0 0 14 22 9 -9 5\nsphere 3 18 0 0 18\nblend 1 2 2\n"
                    "blend 1 3 0.7\n"), "torus, cone and ball in a chain", 9);
  againstWalk(scene("torus 1 0 0 0 0.3 0.5 1 18 14\nsphere 2 10 5 -3 22\nblend 1 2\n"), "torus and ball", 9);
  againstWalk(scene("box 1 -8 2 0 3 1 2 -1 4 0 22 9 14 12\nsphere 2 10 4 -6 22\nbox 3 -14 -16 4 1 0 0 0 1 1 12 0 18 14\n"
                    "blend 1 2\nblend 1 3 0.6\n"), "boxes and ball", 9);
  againstWalk(scene("disc 1 0 -8 0 0 1 0.2 18 12\ncone 2 0 -8 0 16 4 22 -5 8\nblend 1 2\n"), "disc and cone", 9);
}

// ---- the figures --------------------------------------------------------------

struct Made {
  Frame frame;
  Picture picture;
};

static Made made(const std::string &text) {
  Made m;
  Scene s = scene(text);
  m.picture.trace(s, 2);
  drawTruth(s, m.picture, m.frame);
  return m;
}

static int place(int column, int row) { return row * WIDTH + column; }

static void shiftDepth(Frame &f, int column, int row, double by) {
  f.z[place(column, row)] += (int)(by * 65536);
}

// Returns the leftmost column that the surface has on the row of the picture's middle.
static int rimOf(const Made &m) {
  int rim = 0;
  while (!m.picture.at(rim, 100).any()) rim++;
  return rim;
}

static void itself(const Made &m) {
  Figures f = compare(m.frame, m.picture);
  check(f.holes == 0 && f.seeThrough == 0 && f.outside == 0 && f.missing == 0, "the truth itself: no faults");
  check(f.surface == f.drawn && f.both == f.drawn, "the truth itself: drawn where there is surface");
  check(f.interior > 0 && f.interior < f.surface, "the truth itself: an interior within a rim");
  check(f.depthRms() < 1e-4, "the truth itself: depth");
  check(f.shaded == f.both && f.shadeRms() < 0.32, "the truth itself: brightness rounded to steps");
}

static void holes(const Made &m) {
  Made h = m;
  for (int i = 0; i < 7; i++) h.frame.z[place(150 + 2 * i, 100)] = EMPTY;
  Figures f = compare(h.frame, h.picture);
  check(f.holes == 7 && f.missing == 7, "seven holes");
  check(f.drawn == f.surface - 7, "seven fewer drawn");

  // A rim pixel not drawn is no hole.
  h = m;
  const int rim = rimOf(m);
  h.frame.z[place(rim, 100)] = EMPTY;
  f = compare(h.frame, h.picture);
  check(f.holes == 0 && f.missing == 1, "a rim pixel is no hole");
  h.frame.z[place(rim + 1, 100)] = EMPTY;
  check(compare(h.frame, h.picture).holes == 1, "the pixel behind the rim is one");
}

static void seeThrough(Made h) {
  for (int i = 0; i < 5; i++) shiftDepth(h.frame, 150 + i, 90, 4.5);
  for (int i = 0; i < 6; i++) shiftDepth(h.frame, 150 + i, 80, 3.5);
  for (int i = 0; i < 6; i++) shiftDepth(h.frame, 150 + i, 70, -4.5);
  shiftDepth(h.frame, rimOf(h), 100, 4.5);
  Figures f = compare(h.frame, h.picture);
  check(f.seeThrough == 5, "five see-through: further behind than 4 units, interior");
  checkNear(f.seeThroughShare(), 100.0 * 5 / f.interior, 1e-12, "see-through share of interior pixels");
}

// Draws a pixel two across and two up from the surface: 2.83 away, so out of the circle, in the square.
static bool drawAtCorner(Made &m) {
  for (int r = 0; r < HEIGHT; r++)
    for (int c = 2; c < WIDTH - 2; c++) {
      if (m.picture.at(c, r).any()) break;
      bool circle = false, square = false;
      for (int y = -2; y <= 2; y++)
        for (int x = -2; x <= 2; x++)
          if (m.picture.at(c + x, r + y).any()) {
            square = true;
            circle = circle || x * x + y * y <= 4;
          }
      if (square && !circle) {
        m.frame.z[place(c, r)] = 100 * 65536;
        return true;
      }
    }
  return false;
}

// Outside: beyond a distance of two pixels.
static void outside(const Made &m) {
  Made h;
  Figures f;
  // Left of the rim on the row of the ball's middle, which is its leftmost.
  for (int off = 1; off <= 4; off++) {
    h = m;
    h.frame.z[place(rimOf(m) - off, 100)] = 100 * 65536;
    f = compare(h.frame, h.picture);
    check(f.outside == (off > 2) && f.outsideBox == (off > 2), "outside by " + std::to_string(off));
  }
  h = m;
  for (int i = 0; i < 6; i++) h.frame.z[place(5 + i, 5)] = 100 * 65536;
  f = compare(h.frame, h.picture);
  check(f.outside == 6 && f.drawn == f.surface + 6, "six outside");
  checkNear(f.outsideShare(), 100.0 * 6 / f.drawn, 1e-12, "outside share of drawn pixels");
  h = m;
  const bool corner = drawAtCorner(h);
  f = compare(h.frame, h.picture);
  check(corner && f.outside == 1 && f.outsideBox == 0, "outside in the circle's and the square's sense");
}

static void depths(Made h) {
  for (int32_t &z : h.frame.z)
    if (z != EMPTY) z += 32768;
  Figures f = compare(h.frame, h.picture);
  checkNear(f.depthRms(), 0.5, 1e-4, "depth RMS of a shift by half a unit");
  checkNear(f.smoothRms(), 0.5, 1e-4, "depth RMS away from jumps, too");
  // Two balls one behind the other: a wrong rim weighs on the plain figure only.
  Made two = made("sphere 1 0 0 0 40\nsphere 2 12 0 40 60\n");
  f = compare(two.frame, two.picture);
  check(f.smooth > 0 && f.smooth < f.interior, "jumps are left out of the second figure");
  int jump = 160;
  while (two.picture.at(jump + 1, 100).depth - two.picture.at(jump, 100).depth < 4) jump++;
  shiftDepth(two.frame, jump + 1, 100, -20);
  f = compare(two.frame, two.picture);
  check(f.depthRms() > 0.1 && f.smoothRms() < 1e-4, "an error at a jump");
}

static void counts() {
  Made m = made("sphere 1 0 0 0 60\n");
  itself(m);
  holes(m);
  seeThrough(m);
  outside(m);
  depths(m);

  // The whole screen full: pixels at the edge have neighbours beyond it.
  Made full = made("sphere 1 0 0 0 200\n");
  Figures f = compare(full.frame, full.picture);
  check(f.surface == WIDTH * HEIGHT && f.interior == WIDTH * HEIGHT, "a full screen is all interior");
  full.frame.z[0] = EMPTY;
  check(compare(full.frame, full.picture).holes == 1, "a hole in the corner");

  Made in = made("sphere 1 0 0 -110 60\n");
  f = compare(in.frame, in.picture);
  check(f.eyeInside == 1 && f.drawn == 0 && f.interior == 0, "no figures with the eye inside");
}

// Two loops written down again, without the yardstick's own helpers.
static void definitions() {
  Made m = made("sphere 1 -10 4 0 40\nsphere 2 14 -6 10 30\nsphere 3 -60 30 0 18\nsphere 4 62 2 5 30\n"
                "blend 1 2\n");
  long interior = 0, circle = 0, square = 0;
  for (int r = 0; r < HEIGHT; r++)
    for (int c = 0; c < WIDTH; c++) {
      int near9 = 0;
      double closest = 1e300;
      bool box = false;
      for (int y = -MARGIN; y < HEIGHT + MARGIN; y++)
        for (int x = c - 3; x <= c + 3; x++) {
          if (x < -MARGIN || x >= WIDTH + MARGIN || !m.picture.at(x, y).any()) continue;
          near9 += std::abs(x - c) <= 1 && std::abs(y - r) <= 1;
          box = box || (std::abs(x - c) <= 2 && std::abs(y - r) <= 2);
          closest = std::min(closest, std::sqrt((double)(x - c) * (x - c) + (y - r) * (y - r)));
        }
      interior += near9 == 9;
      circle += closest > 2;
      square += !box;
      m.frame.z[place(c, r)] = 120 * 65536;
    }
  Figures f = compare(m.frame, m.picture);
  check(f.drawn == WIDTH * HEIGHT && f.interior == interior, "interior counted plainly");
  check(f.outside == circle && f.outsideBox == square && square < circle, "outside counted plainly");
  for (int32_t &z : m.frame.z) z = EMPTY;
  check(compare(m.frame, m.picture).holes == interior, "nothing drawn: the whole interior is holes");
  // What the picture leaves out of a ray's list of objects changes nothing.
  Tracer tracer(m.frame.scene);
  int differ = 0;
  for (int r = -MARGIN; r < HEIGHT + MARGIN; r++)
    for (int c = -MARGIN; c < WIDTH + MARGIN; c++)
      differ += tracer.trace(c + 0.5, r + 0.5).depth != m.picture.at(c, r).depth;
  check(differ == 0, "rays with and without the rest of the objects");
}

static void paintGrey(Frame &f, int column, int row, int step) {
  for (int k = 0; k < 3; k++) f.rgb[3 * place(column, row) + k] = (uint8_t)(step << 2 | step >> 4);
}

static void greySteps() {
  // All light ambient: the true step is 63 everywhere.
  Made m = made("ambient 1\nsphere 1 0 0 0 60\n");
  auto grey = [&]() { return Ramps(m.frame.scene).step(m.frame.pixel(160, 100), 0); };
  check(grey() == 63, "full grey is step 63");
  checkNear(compare(m.frame, m.picture).shadeRms(), 0, 1e-6, "brightness of the truth");
  for (int step = 0; step < 64; step++) {
    paintGrey(m.frame, 160, 100, step);
    bool a = grey() == step;
    for (int k = 0; k < 3; k++) m.frame.rgb[3 * place(160, 100) + k] = (uint8_t)std::lround(step * 255 / 63.0);
    check(a && grey() == step, "step " + std::to_string(step) + " of both ways to 8 bits");
  }
  for (int r = 0; r < HEIGHT; r++)
    for (int c = 0; c < WIDTH; c++) paintGrey(m.frame, c, r, 60);
  checkNear(compare(m.frame, m.picture).shadeRms(), 3, 1e-6, "three steps too dark");
}

static void colouredSteps() {
  // Known with the ramps, unknown without.
  Made c = made("ramp 1 255 128 0\nramp 2 0 64 255\nsphere 1 -15 0 0 40\nsphere 2 15 0 0 40\n");
  Figures f = compare(c.frame, c.picture);
  check(f.shaded == f.both && f.shadeRms() < 0.32, "brightness in colour");
  Frame without = c.frame;
  without.scene.ramps.clear();
  f = compare(without, c.picture);
  check(f.shaded == 0 && f.coloured == 0 && f.both > 0, "no ramps, no brightness figure, no colour figure");
  // Black fits both ramps where nothing is ambient; then the object that
  // should be there decides, and the colour tells nothing.
  Ramps dark(c.frame.scene);
  const uint8_t black[3] = {0, 0, 0};
  check(dark.shown(black) < 0 && dark.step(black, 0) < 1 && dark.step(black, 1) < 1, "black is anybody's");
  const uint8_t alien[3] = {0, 255, 0};
  check(dark.shown(alien) < 0, "a colour of no ramp");
}

// Paints every pixel ten steps too dark or too bright.
static void paintTenOff(Made &m) {
  Ramps ramps(m.frame.scene);
  for (int r = 0; r < HEIGHT; r++)
    for (int c = 0; c < WIDTH; c++) {
      Hit h = m.picture.at(c, r);
      if (!h.any()) continue;
      h.shade += h.shade >= 30 ? -10 : 10;
      ramps.paint(h, &m.frame.rgb[3 * place(c, r)]);
    }
}

// Light as the program divides it up.
static const std::string programLight = "ambient 0.142857\nhighlight 0.825397\n";

static void palette() {
  // The program's palette, worked out by hand: the darkest, one in the middle,
  // the last below the highlight, the brightest.
  Made p = made(programLight + "ramp 1 255 64 48\nramp 2 72 112 255\nsphere 1 -15 0 0 40\nsphere 2 15 0 0 40\n");
  Ramps ramps(p.frame.scene);
  struct {
    int light, red, green, blue;   // of 63
  } rows[] = {{0, 9, 2, 2}, {21, 27, 7, 5}, {52, 54, 13, 10}, {63, 53, 37, 36}};
  for (auto &row : rows) {
    const int six[3] = {row.red, row.green, row.blue};
    uint8_t rgb[3], painted[3];
    for (int k = 0; k < 3; k++) rgb[k] = (uint8_t)std::lround(six[k] * 255 / 63.0);
    double step = 9 + row.light * 54 / 63.0;
    ramps.paint(0, step, painted);
    const std::string name = "light " + std::to_string(row.light) + " of a ramp";
    check(std::equal(rgb, rgb + 3, painted), name);
    checkNear(ramps.step(rgb, 0), step, 0.44, name + ": back to the step");
    check(ramps.shown(rgb) == ramps.of(0), name + ": its own ramp");
    // A pixel in the other object's colour is read by that colour.
    checkNear(ramps.step(rgb, 1), step, 0.44, name + ": expected on the other");
  }
  for (int object : {0, 1})
    for (int light = 0; light < 64; light++) {
      uint8_t rgb[3];
      ramps.paint(object, 9 + light * 54 / 63.0, rgb);
      check(ramps.shown(rgb) == ramps.of(object) && std::fabs(ramps.step(rgb, object) - (9 + light * 54 / 63.0)) < 0.44,
            "there and back, object " + std::to_string(object) + ", light " + std::to_string(light));
    }
  Figures f = compare(p.frame, p.picture);
  check(f.shadeRms() < 0.5 && f.coloured == f.both, "brightness in the program's ramps");
  paintTenOff(p);
  // The ambient share leaves 54 of 63 steps to the light.
  checkNear(compare(p.frame, p.picture).shadeRms(), 10 * 63 / 54.0, 0.3, "ten steps of the ramp off in colour");
}

static void brightness() {
  greySteps();
  colouredSteps();
  palette();
}

static const std::string twoAlike = "sphere 1 -10 0 0 60\nsphere 2 10 0 0 60\nblend 1 2\n";
static const std::string halfLit = "eye 0 0 -200\nambient 0.5\n";
static const std::string twoRamps = "ramp 1 255 64 48\nramp 2 72 112 255\n";

// Paints a pixel in the colour of an object.
static void paintAs(Made &to, int column, int row, int object) {
  Ramps(to.frame.scene).paint(object, 40, &to.frame.rgb[3 * place(column, row)]);
}

// Two balls alike: the true border is the upright line between columns 159
// and 160, as long as the picture is high there.
struct Upright : Made {
  int high = 0, top = 0;
  Upright() : Made(made(halfLit + twoAlike + twoRamps)) {
    for (int r = 0; r < HEIGHT; r++)
      if (picture.at(159, r).any() && picture.at(160, r).any()) {
        if (!high) top = r;
        high++;
      }
  }
};

static void uprightBorder(const Upright &m) {
  Figures f = compare(m.frame, m.picture);
  check(m.high > 50 && f.borderTrue == m.high && f.border == m.high, "an upright border");
  check(f.coloured == f.drawn && f.wrongColour == 0, "colours of the truth");
}

// Scraps: five pixels apart from each other, far inside the first ball.
static void scrapsOfColour(const Upright &m) {
  Made scraps = m;
  for (int i = 0; i < 5; i++) paintAs(scraps, 130 + 3 * i, 100, 1);
  Figures f = compare(scraps.frame, scraps.picture);
  check(f.wrongColour == 5, "five scraps of colour");
  check(f.border == m.high + 20 && f.borderTrue == m.high, "a scrap has a border of four");
  checkNear(f.colourShare(), 100.0 * 5 / f.drawn, 1e-12, "their share of drawn pixels");
  checkNear(f.borderRatio(), (m.high + 20.0) / m.high, 1e-12, "border over true border");
  std::vector<uint8_t> picture = sheet(scraps.frame, scraps.picture);
  auto painted = [&](int column, int row) { return &picture[3 * (row * SHEET_WIDTH + 2 * (WIDTH + 4) + column)]; };
  check(painted(133, 100)[0] == 0 && painted(133, 100)[1] == 255 && painted(133, 100)[2] == 255, "a scrap is cyan");
  check(painted(132, 100)[0] == 0 && painted(132, 100)[1] == 128 && painted(132, 100)[2] == 0, "its border is green");
  check(painted(140, 80)[1] == painted(140, 80)[0], "the rest is grey");
}

// A pixel may have the colour of the pixel beside it, left, right, above or below.
static void besideTheBorder(const Made &m) {
  // A pixel from the other's region is near enough, two are not, nor is a diagonal.
  Made close = m;
  paintAs(close, 159, 100, 1);
  check(compare(close.frame, close.picture).wrongColour == 0, "a pixel over the border");
  paintAs(close, 158, 100, 1);
  check(compare(close.frame, close.picture).wrongColour == 1, "two pixels over the border");
  Made corner = made(halfLit + twoRamps + "sphere 1 0 0 20 120\nsphere 2 0 0 -60 40\n");
  int wrong = 0, beside = 0;
  for (int r = 1; r < HEIGHT - 1 && beside <= 60; r++)
    for (int c = 1; c < WIDTH - 1 && beside <= 60; c++) {
      auto is = [&](int x, int y) { return corner.picture.at(x, y).object == 1; };
      if (is(c, r) || !corner.picture.at(c, r).any()) continue;
      bool four = is(c + 1, r) || is(c - 1, r) || is(c, r + 1) || is(c, r - 1);
      bool diagonal = is(c + 1, r + 1) || is(c - 1, r - 1) || is(c - 1, r + 1) || is(c + 1, r - 1);
      if (!four && !diagonal) continue;
      Made one = corner;
      paintAs(one, c, r, 1);
      wrong += compare(one.frame, one.picture).wrongColour != (four ? 0 : 1);
      beside++;
    }
  check(beside > 20 && wrong == 0, "beside and diagonal: " + std::to_string(wrong) + " wrong of " + std::to_string(beside));
  // One object before another without a link: the border is its outline.
  Figures f = compare(corner.frame, corner.picture);
  check(f.borderTrue > 60 && f.border == f.borderTrue, "an outline before another object is a border");
}

// A comb: every second row reaches three pixels into the other's region.
static void comb(Upright m) {
  // Away from the picture's top and bottom all of the comb's pixels are there.
  const int bottom = m.top + m.high - 1;
  bool whole = true;
  for (int c = 157; c < 164; c++) whole = whole && m.picture.at(c, m.top).any() && m.picture.at(c, bottom).any();
  int teeth = 0, gaps = 0;
  for (int r = m.top; r <= bottom; r += 2) {
    teeth++;
    for (int c = 160; c < 163; c++) paintAs(m, c, r, 0);
    gaps += 3 * ((r > m.top) + (r < bottom));
  }
  Figures f = compare(m.frame, m.picture);
  check(whole && f.wrongColour == 2 * teeth, "a comb: two of a tooth's three pixels are wrong");
  check(f.border == m.high + gaps && f.borderTrue == m.high, "a comb's border: its teeth's sides as well");
}

// Holes and what sticks out have no colour to be judged.
static void withoutColour(const Upright &m) {
  Made hole = m;
  hole.frame.z[place(159, 100)] = EMPTY;
  Figures f = compare(hole.frame, hole.picture);
  check(f.coloured == f.surface - 1 && f.borderTrue == m.high - 1 && f.border == m.high - 1, "a hole in the border");
  Made out = m;
  out.frame.z[place(3, 3)] = 65536;
  paintAs(out, 3, 3, 0);
  check(compare(out.frame, out.picture).wrongColour == 0, "what sticks out is not judged twice");
}

// Two objects of one colour; two ramps that a palette tells apart only where it rounds; grey.
static void coloursAlike() {
  Made same = made(halfLit + twoAlike + "ramp 1 255 64 48\nramp 2 255 64 48\n");
  Figures f = compare(same.frame, same.picture);
  check(f.coloured == f.drawn && f.border == 0 && f.borderTrue == 0, "one colour, no border");
  Made alike = made(halfLit + twoAlike + "ramp 1 100 100 40\nramp 2 101 100 40\n");
  f = compare(alike.frame, alike.picture);
  check(3 * f.coloured < f.drawn && f.wrongColour == 0, "colours alike tell little");
  Made grey = made(halfLit + twoAlike);
  check(compare(grey.frame, grey.picture).coloured == 0, "grey tells nothing");
}

// Two at one place: either colour is right, and beside the third's border too.
static void eitherColour() {
  Made tied = made(halfLit + "sphere 1 -12 0 0 50\nsphere 2 -12 0 0 50\nsphere 3 14 0 0 60\nblend 1 2\nblend 2 3\nblend 1 3\n"
                    + twoRamps + "ramp 3 255 200 48\n");
  Figures f = compare(tied.frame, tied.picture);
  check(f.coloured > 0 && f.coloured < f.drawn, "where cores coincide no colour is judged");
  Figures either = f;
  for (int r = 0; r < HEIGHT; r++)
    for (int c = 0; c < WIDTH; c++)
      if (tied.picture.at(c, r).tied) paintAs(tied, c, r, (r / 3 + c / 3) % 2);
  f = compare(tied.frame, tied.picture);
  check(f.wrongColour == 0 && f.border == either.border && f.coloured == either.coloured, "either colour is right there");
}

static void colours() {
  Upright m;
  uprightBorder(m);
  scrapsOfColour(m);
  besideTheBorder(m);
  comb(m);
  withoutColour(m);
  coloursAlike();
  eitherColour();
}

static void flickers() {
  auto pair = [](double dt, int change, int pixels, bool vanish) {
    Made a = made("ambient 1\nsphere 1 0 0 0 60\n"), b = a;
    b.frame.scene.time = a.frame.scene.time + dt;
    for (int i = 0; i < pixels; i++) {
      paintGrey(b.frame, 140 + i, 100, 63 - change);
      if (vanish) b.frame.z[place(140 + i, 100)] = EMPTY;
    }
    Figures f;
    compareFlicker(a.frame, a.picture, b.frame, b.picture, f);
    return f;
  };
  Figures f = pair(0.014, 17, 9, false);
  check(f.pairs == 1 && f.flicker == 9 && f.flickerEdge == 9, "nine pixels flicker");
  checkNear(f.flickerShare(), 900.0 / f.flickerBase, 1e-12, "flicker share of drawn pixels");
  check(pair(0.015, 17, 9, false).pairs == 1, "1/70 s in whole milliseconds, rounded up");
  f = pair(0.014, 16, 9, false);
  check(f.pairs == 1 && f.flicker == 0, "a quarter of the ramp is no flicker yet");
  // In colour the ambient share leaves less of the ramp: half of it, half the jump.
  for (int change : {8, 9}) {
    Made a = made("ambient 0.5\nramp 1 255 64 48\nlight 0 0 -1\nsphere 1 0 0 0 60\n"), b = a;
    b.frame.scene.time += 0.014;
    for (int i = 0; i < 5; i++)
      Ramps(b.frame.scene).paint(0, a.picture.at(158 + i, 100).shade - change, &b.frame.rgb[3 * place(158 + i, 100)]);
    Figures c;
    compareFlicker(a.frame, a.picture, b.frame, b.picture, c);
    check(c.pairs == 1 && c.flicker == (change == 9 ? 5 : 0), "flicker in colour, " + std::to_string(change) + " steps");
  }
  check(pair(0.1, 17, 9, false).pairs == 0, "frames too far apart");
  check(pair(0, 17, 9, false).pairs == 0, "frames of the same time");
  f = pair(0.014, 0, 4, true);
  check(f.flicker == 0 && f.flickerEdge == 4, "pixels that vanish");
  // The light goes out: the true brightness moves as well.
  Made a = made("ambient 1\nsphere 1 0 0 0 60\n"), b = made("ambient 0\nsphere 1 0 0 0 60\n");
  b.frame.scene.time += 0.014;
  Figures g;
  compareFlicker(a.frame, a.picture, b.frame, b.picture, g);
  check(g.pairs == 1 && g.flicker == 0, "a true change is no flicker");
}

// Finishes, from a normal: what is scattered, what is mirrored of the light, what of the surroundings.
static void finishes() {
  Scene plain = scene("light 0 0 -1\nsphere 1 0 0 0 60\n");
  Tracer t(plain);
  Coat matt, shiny, mirror;
  shiny.finish = Coat::SHINY, mirror.finish = Coat::MIRROR;
  const double h = std::sqrt(0.5), c8 = std::cos(3.14159265358979 / 8);
  checkNear(t.brightness(matt, {0, h, -h}), h, 1e-12, "matt: the cosine");
  checkNear(t.brightness(shiny, {0, 0, -1}), 1, 1e-12, "shiny: full where it mirrors the light");
  checkNear(t.brightness(shiny, {0, h, -h}), 0.75 * h + (1 - 0.75 * h) / 256, 1e-12, "shiny: aside of it");
  checkNear(t.brightness(shiny, {0, 1, 0}), 0, 1e-12, "shiny: edge-on");
  checkNear(t.brightness(mirror, {0, h, -h}), 0.5 + 0.5 / 256, 1e-12, "a mirror that looks up");
  checkNear(t.brightness(mirror, {0, -h, -h}), 0.5 + 0.5 / 256, 1e-12, "down");
  checkNear(t.brightness(mirror, {1, 0, 0}), 13 / 24.0, 1e-12, "at the horizon");
  checkNear(t.brightness(mirror, {0, std::sqrt(1 - c8 * c8), -c8}),
            1 - 0.5 * (h - 0.3) / 0.7 + 0.5 * (h - 0.3) / 0.7 * std::pow(c8, 16), 1e-12, "at the sky");
}

static const std::string mixedBalls =
    programLight + "ramp 1 200 0 100\nramp 2 0 100 50\nsphere 1 -12 0 0 50\nsphere 2 12 0 0 50\n";

static void checkColour(Colour c, double r, double g, double b, const std::string &name) {
  check(std::fabs(c.r - r) + std::fabs(c.g - g) + std::fabs(c.b - b) < 1e-9, name);
}

// Colours that mix.
static void mixtures() {
  Scene apart = scene(mixedBalls + "mixed\n"), one = scene(mixedBalls + "blend 1 2\n");
  Scene both = scene(mixedBalls + "blend 1 2\nmixed\n");
  const Vec mid{0, 0, -15};
  checkColour(Tracer(both).colour(0, mid), 100, 50, 75, "half way between two");
  checkColour(Tracer(one).colour(0, mid), 200, 0, 100, "not where colours do not mix");
  checkColour(Tracer(apart).colour(0, mid), 200, 0, 100, "nor between bodies");
  checkColour(Tracer(both).colour(0, {-40, 0, 0}), 200, 0, 100, "nor where the other does not reach");
  const double a = geoff(4 / 2500.0), b = geoff(484 / 2500.0);
  checkColour(Tracer(both).colour(0, {-10, 0, 0}), 200 * a / (a + b), 100 * b / (a + b), (100 * a + 50 * b) / (a + b),
              "by the fields");
}

// Patterns, in their own axes: x along z, y along x, so z along y.
static void patterns() {
  const std::string at = " 2 0 0 5 0 0 1 1 0 0\n";
  auto pattern = [&](const std::string &word, Vec p) {
    Scene s = scene("ramp 1 200 0 100\nsphere 1 0 0 0 60\n" + word + " 1 4 80 160" + at);
    return Tracer(s).colour(0, p);
  };
  checkColour(pattern("checks", {1, 1, 6}), 200, 0, 100, "the first check");
  checkColour(pattern("checks", {1, 1, 10}), 80, 160, 2, "one on");
  checkColour(pattern("checks", {1, -1, 10}), 200, 0, 100, "and down");
  checkColour(pattern("checks", {-1, -1, 10}), 80, 160, 2, "and to the left");
  checkColour(pattern("stripes", {1, -1, 10}), 80, 160, 2, "a stripe");
  checkColour(pattern("stripes", {-9, -7, 10}), 80, 160, 2, "all along");
  checkColour(pattern("stripes", {1, 1, 4}), 80, 160, 2, "on both sides");
  checkColour(pattern("stripes", {1, 1, 6}), 200, 0, 100, "between");
  const double turn = 2 * 3.14159265358979,
               vein = 0.5 + 0.5 * std::sin(turn * (0.5 * 0.25 + 0.3 * std::sin(turn * (0.35 * 0.5 + 0.2)) +
                                                   0.2 * std::sin(turn * (0.55 * 0.75 + 0.2 * 0.5))));
  checkColour(pattern("marble", {2, 3, 6}), 200 + vein * (80 - 200), vein * 160, 100 + vein * (2 - 100), "marble");
}

// True frames, judged; and damaged.
static void paintedFrames() {
  const std::string all = mixedBalls + "blend 1 2\nmixed\nshiny 2\nchecks 1 12 250 250 250 -12 0 0 0.8 0.6 0 -0.6 0.8 0\n";
  Made m = made(all);
  Figures f = compare(m.frame, m.picture);
  check(f.shaded == f.both && f.shadeRms() < 0.6 && f.coloured == f.both && f.wrongColour == 0, "the truth itself, painted");
  check(f.border == 0 && f.borderTrue == 0, "its borders are not judged");
  paintTenOff(m);
  checkNear(compare(m.frame, m.picture).shadeRms(), 10 * 63 / 54.0, 1, "ten steps of the ramp off, painted");
  m = made(all);
  int spoilt = 0;
  for (int y = 90; y < 96; y++)
    for (int x = 140; x < 146; x++) {
      check(m.picture.at(x, y).any(), "a pixel to spoil");
      const uint8_t alien[3] = {0, 230, 0};
      std::copy(alien, alien + 3, &m.frame.rgb[3 * place(x, y)]);
      spoilt++;
    }
  check(compare(m.frame, m.picture).wrongColour == spoilt, "strange colours are counted");
  // In grey a finish is judged, colours are not.
  Made grey = made("shiny 1\nsphere 1 0 0 0 60\n");
  f = compare(grey.frame, grey.picture);
  check(f.shaded == f.both && f.shadeRms() < 0.32 && f.coloured == 0, "a finish in grey");
}

static void paints() {
  finishes();
  mixtures();
  patterns();
  paintedFrames();
}

// Where a place of plain space goes, as the words of a dump say; angles in degrees, axes those of the world.
static Vec shaped(Vec p, Vec by, double taper, double twist, double bend, double h) {
  p = {p.x * by.x, p.y * by.y, p.z * by.z};
  double on = std::min(std::max(p.y, -h), h), wide = 1 + taper * on / h, a = twist * M_PI / 180 * p.y / (2 * h);
  Vec v{wide * (p.x * std::cos(a) + p.z * std::sin(a)), p.y, wide * (p.z * std::cos(a) - p.x * std::sin(a))};
  if (bend == 0) return v;
  double radius = 2 * h / (bend * M_PI / 180), t = on / radius, beyond = p.y - on;
  return {radius + (v.x - radius) * std::cos(t) + beyond * std::sin(t), beyond * std::cos(t) - (v.x - radius) * std::sin(t), v.z};
}

static void ellipsoids() {
  // A stretched sphere is an ellipsoid: a ball for rays that are stretched back.
  Scene e = scene("sphere 1 3 2 -4 30\nstretch 1 3 2 -4 0.6 0.8 0 -0.8 0.6 0 2 0.5 1.5\n");
  Tracer te(e);
  int wrong = 0, hits = 0;
  auto back = [](Vec v) {
    return Vec{(0.6 * v.x + 0.8 * v.y) / 2, (-0.8 * v.x + 0.6 * v.y) / 0.5, v.z / 1.5};
  };
  for (int r = 0; r < HEIGHT; r += 3)
    for (int c = 0; c < WIDTH; c += 3) {
      double want = enterBall(back(e.eye - Vec{3, 2, -4}), back(direction(e, c, r)), {0, 0, 0}, 15), got = te.trace(c, r).depth;
      wrong += std::fabs(got - want) > 1e-6;
      hits += want >= 0;
    }
  check(wrong == 0 && hits > 100, "ellipsoid: " + std::to_string(wrong) + " rays wrong");
}

static const std::string axes = " 1 0 0 0 1 0 ";

// What comes down to a plain object.
static void idleShapes() {
  struct {
    std::string one, other, name;
  } rows[] = {
      {"sphere 1 3 2 -4 15\nstretch 1 3 2 -4" + axes + "2 2 2\n", "sphere 1 3 2 -4 30\n", "a sphere stretched alike"},
      {"cylinder 1 5 -14 0 5 14 0 20\ntwist 1 5 0 0" + axes + "200 24\n", "cylinder 1 5 -14 0 5 14 0 20\n", "a round twist"},
      {"box 1 5 0 0" + axes + "8 30 8 16\ntaper 1 5 0 0" + axes + "0 23\n", "box 1 5 0 0" + axes + "8 30 8 16\n", "no taper"},
      {"cylinder 1 5 -14 0 5 14 0 20\nbend 1 5 0 0" + axes + "0.001 24\n", "cylinder 1 5 -14 0 5 14 0 20\n", "next to no bend"},
  };
  for (auto &row : rows) checkAlike(row.one, row.other, row.name, 5, 2e-3, 0.1);
}

// The field at a place is the plain one where it came from, and its gradient that of the field.
static void warps() {
  const Vec by{1.5, 0.8, 0.6};
  Scene s = scene("box 1 0 0 0" + axes + "10 40 6 16\nstretch 1 0 0 0" + axes + "1.5 0.8 0.6\ntaper 1 0 0 0" + axes +
                  "0.4 22.4\ntwist 1 0 0 0" + axes + "100 22.4\nbend 1 0 0 0" + axes + "-70 22.4\n");
  Object plain = s.objects[0];
  plain.plain = true;
  double off = 0, slope = 0;
  for (int i = 0; i < 2000; i++) {
    Vec p{random(-9, 9), random(-27, 27), random(-9, 9)}, there = shaped(p, by, 0.4, 100, -70, 22.4);
    off = std::max(off, std::fabs(s.objects[0].q(there, nullptr) - plain.kind->q(plain, p, nullptr)));
    Vec g, step{random(-1, 1), random(-1, 1), random(-1, 1)};
    s.objects[0].q(there, &g);
    const double small = 1e-6;
    slope =
        std::max(slope, std::fabs((s.objects[0].q(there + step * small, nullptr) - s.objects[0].q(there - step * small, nullptr)) /
                                      (2 * small) -
                                  dot(g, step)));
  }
  check(off < 1e-9, "a field in warped space is off by " + std::to_string(off));
  check(slope < 1e-3, "its gradient is off by " + std::to_string(slope));
  againstWalk(s, "a warped box", 11);
  againstWalk(scene("cylinder 1 0 -20 0 0 20 0 20\nbend 1 0 0 0" + axes + "120 30\nsphere 2 10 -16 -8 26\nstretch 2 10 -16 -8" +
                    axes + "0.5 1.5 2\nblend 1 2\n"),
              "a bent cylinder and an ellipsoid", 11);
}

static void spaces() {
  ellipsoids();
  idleShapes();
  warps();
  for (const char *bad : {"stretch 2 0 0 0 1 0 0 0 1 0 1 1 1\n", "stretch 1 0 0 0 1 0 0 0 1 0 1 0 1\n",
                          "taper 1 0 0 0 1 0 0 0 1 0 1 9\n", "twist 1 0 0 0 1 0 0 0 1 0 9 0\n", "bend 1 0 0 0 0 0 0 0 1 0 9 9\n",
                          "bend 1 0 0 0 1 0 0 2 0 0 9 9\n", "bend 1 0 0 0 1 0 0 0 1 0 9\n"}) {
    Scene none;
    std::string why;
    check(!parseScene(camera + "sphere 1 0 0 0 9\n" + bad, "X.TXT", none, why) && why.find("X.TXT:8") == 0,
          std::string("refused: ") + bad + why);
  }
}

static void texts() {
  struct {
    const char *text, *word;
  } bad[] = {
      {"blob 1 2 3\n", "unknown word"},       {"sphere 1 2 3 4\n", "wants 5"},
      {"sphere 1 2 3 x 5\n", "not a number"}, {"sphere 1 2 3 4 0\n", "above 0"},
      {"sphere 1 2 3 4 -5\n", "above 0"},     {"sphere 1 0 0 0 nan\n", "not a number"},
      {"blend 1 2\n", "not there"},           {"sphere 1 0 0 0 9\nsphere 1 0 0 0 9\n", "already"},
      {"sphere 1 0 0 0 9\nblend 1 1\n", "itself"}, {"light 0 0 0\n", "no direction"},
      {"shiny 1\n", "not there"},             {"mixed 1\n", "with 1 numbers"},
      {"sphere 1 0 0 0 9\nchecks 1 5 1 2 3 0 0 0 1 0 0\n", "with 11 numbers"},
      {"sphere 1 0 0 0 9\nchecks 1 0 1 2 3 0 0 0 1 0 0 0 1 0\n", "above 0"},
      {"sphere 1 0 0 0 9\nmarble 1 5 1 2 3 0 0 0 1 0 0 0.6 0.8 0\n", "square"},
      {"sphere 1 0 0 0 9\nstripes 1 5 1 2 3 0 0 0 2 0 0 0 1 0\n", "unit length"},
      {"dent 1 2\n", "not there"},            {"strength 1 2\n", "not there"},
      {"sphere 1 0 0 0 9\ndent 1 1\n", "itself"}, {"sphere 1 0 0 0 9\nstrength 1 0\n", "above 0"},
      {"sphere 1 0 0 0 9\nsphere 2 0 0 0 9\ndent 1 2 -1\n", "negative"}, {"strength 1\n", "1 numbers"},
      {"right 0 0 1\n", "no axes"},           {"ahead 0 0 -1\n", "no axes"},
      {"right 0 0 1\nahead 1 0 0\n", "no axes"}, {"up 0 1\n", "with 2 numbers"},
      {"focal 0 200\n", "above 0"},           {"torus 1 0 0 0 0 0 0 5 5\n", "no direction"},
  };
  for (auto &row : bad) {
    Scene s;
    std::string why;
    bool good = parseScene(camera + row.text, "X.TXT", s, why);
    check(!good && why.find(row.word) != std::string::npos && why.find("X.TXT:") == 0,
          std::string("refused: ") + row.text + "  says: " + why);
  }
  Scene s;
  std::string why;
  check(!parseScene("time 1\nfocal 1 1\ncentre 0 0\nlight 0 0 1\n", "X", s, why) &&
            why.find("eye") != std::string::npos, "a scene without an eye");
  check(parseScene(camera + "\r\n# a remark\nsphere 1 3.25 -4 0 20\r\ncylinder 5 0 0 0 10 0 0 12\nblend 1 5\n",
                   "X", s, why) && s.objects.size() == 2 && s.weight[0][1] == 1 && s.weight[1][0] == 1,
        "the contract's scene, with carriage returns");
  checkNear(length(s.light), 1, 1e-12, "the light is a direction");
  check(s.time == 1.2 && s.objects[1].number == 5 && s.objects[1].size == 12, "what it says is kept");
}

// An eye that stands otherwise: every ray as one of its axes has it, and a picture the same as that of the scene turned the
// other way before an eye that looks along z.
static void turnedEyes() {
  Scene s = scene("eye 40 30 -60\nright 0.8 0 0.6\nup -0.36 0.8 0.48\nahead -0.48 -0.6 0.64\nsphere 1 -10 -20 5 40\n");
  Vec c{-10, -20, 5};
  int met = 0, wrong = 0;
  for (int r = 0; r < HEIGHT; r += 7)
    for (int k = 0; k < WIDTH; k += 7) {
      Vec d = direction(s, k + 0.5, r + 0.5);
      Vec way = s.right * d.x + s.up * d.y + s.ahead * d.z;
      double t = enterBall(s.eye, way, c, 20);
      Hit got = Tracer(s).trace(k + 0.5, r + 0.5);
      met += t >= 0;
      wrong += std::fabs(got.depth - t) > 1e-7;
    }
  check(met > 100 && wrong == 0, "a turned eye: depths of a ball");

  auto turn = [&](Vec v) { return Vec{dot(v, s.right), dot(v, s.up), dot(v, s.ahead)}; };
  auto three = [](Vec v) { return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + " "; };
  const Vec eye{40, 30, -60}, ends[] = {{-30, -20, 15}, {10, 0, -10}}, middle{-5, -30, 20}, axis{0.6, 0, 0.8}, light{0, 1, -1};
  const std::string links = "blend 1 2\nblend 2 3 0.5\n";
  Scene world = scene("eye " + three(eye) + "\nright 0.8 0 0.6\nup -0.36 0.8 0.48\nahead -0.48 -0.6 0.64\nlight " + three(light) +
                      "\nsphere 1 " + three(middle) + "36\ncylinder 2 " + three(ends[0]) + three(ends[1]) + "20\ntorus 3 " +
                      three(middle) + three(axis) + "30 16\n" + links);
  Scene view = scene("eye " + three(turn(eye)) + "\nlight " + three(turn(light)) + "\nsphere 1 " + three(turn(middle)) +
                     "36\ncylinder 2 " + three(turn(ends[0])) + three(turn(ends[1])) + "20\ntorus 3 " + three(turn(middle)) +
                     three(turn(axis)) + "30 16\n" + links);
  Picture a, b;
  a.trace(world, 1);
  b.trace(view, 1);
  int seen = 0, other = 0;
  for (int r = 0; r < HEIGHT; r++)
    for (int k = 0; k < WIDTH; k++) {
      const Hit &x = a.at(k, r), &y = b.at(k, r);
      seen += x.any();
      // The text has six decimals: on the outline a ray may pass.
      other += x.any() != y.any() || (x.any() && (std::fabs(x.depth - y.depth) > 0.01 || std::fabs(x.shade - y.shade) > 0.1 ||
                                                  x.object != y.object));
    }
  check(seen > 5000 && other < seen / 500, "a turned eye: the picture of the turned scene");
}

int main() {
  spheres();
  turnedEyes();
  pairs();
  tangents();
  cylinders();
  unlinked();
  others();
  bodies();
  strengths();
  walks();
  counts();
  definitions();
  brightness();
  colours();
  flickers();
  paints();
  spaces();
  texts();
  std::printf("%d passed, %d failed\n", passed, failed);
  return failed != 0;
}
