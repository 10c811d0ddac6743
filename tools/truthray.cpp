// Where a viewing ray first meets the implicit surface.
//
// This file exists to give an answer that can be trusted near tangents, where
// stepping along the ray and looking for a change of sign would miss thin
// slices. Along a ray the field of a sphere or cylinder is a chain of
// polynomials of degree six in the depth. On each link of the chain they are
// added up in Bernstein form, whose coefficients enclose the values, and the
// link is halved until the enclosure excludes the surface or the first
// crossing is pinned down. Kinds whose field is no polynomial add an enclosure
// of their own.
//
// The surface is the report's: object i's is where its own field and what its
// linked neighbours add reach the isovalue, as long as no neighbour is
// stronger there; what is seen is the nearest of all objects' surfaces. Where
// all of a group are linked to each other with weight 1, that is the surface
// of the group's sum, and is found as such.
#include "truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace truth {

double length(Vec a) { return std::sqrt(dot(a, a)); }

// F = 1 - 22/9 q + 17/9 q^2 - 4/9 q^3 [BW93].
double geoff(double q) {
  if (q >= 1) return 0;
  return 1 + q * (-22 / 9.0 + q * (17 / 9.0 - q * (4 / 9.0)));
}

double geoffSlope(double q) {
  if (q >= 1) return 0;
  return -22 / 9.0 + q * (34 / 9.0 - q * (12 / 9.0));
}

namespace {

Vec point(const Ray &ray, double t) { return ray.eye + ray.dir * t; }

// Appends the real roots of c0 + c1 t + c2 t^2 = 1, if any.
void whereOne(const double c[3], std::vector<double> &t) {
  double h = -c[1] / 2, d = h * h - c[2] * (c[0] - 1);
  if (d < 0 || c[2] <= 0) return;
  double w = std::sqrt(d);
  t.push_back((h - w) / c[2]);
  t.push_back((h + w) / c[2]);
}

bool badSize(double r) { return !(r > 0); }

// ---- sphere: x y z R. The core is a point. --------------------------------

const char *sphereSet(Object &o, const double *v) {
  o.a = o.middle = {v[0], v[1], v[2]};
  o.size = o.reach = v[3];
  return badSize(o.size) ? "the size must be above 0" : nullptr;
}

double sphereQ(const Object &o, Vec p, Vec *g) {
  Vec m = p - o.a;
  double k = 1 / (o.size * o.size);
  if (g) *g = m * (2 * k);
  return dot(m, m) * k;
}

void pointQuadratic(const Ray &ray, Vec centre, double size, double c[3]) {
  Vec m = ray.eye - centre;
  double k = 1 / (size * size);
  c[0] = dot(m, m) * k;
  c[1] = 2 * dot(m, ray.dir) * k;
  c[2] = dot(ray.dir, ray.dir) * k;
}

void sphereQuadratic(const Object &o, const Ray &ray, double, double c[3]) {
  pointQuadratic(ray, o.a, o.size, c);
}

void sphereBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  double c[3];
  pointQuadratic(ray, o.a, o.size, c);
  whereOne(c, t);
}

// ---- cylinder: x1 y1 z1 x2 y2 z2 R. The core is a line segment. ------------

// Core and bounding ball shared by the kinds with a segment for a core.
void setSegment(Object &o, const double *from, const double *to, double size) {
  Vec a{from[0], from[1], from[2]}, b{to[0], to[1], to[2]};
  o.a = a;
  o.len = length(b - a);
  o.u = o.len > 0 ? (b - a) * (1 / o.len) : Vec{1, 0, 0};
  o.middle = (a + b) * 0.5;
  o.reach = o.len / 2 + size;
}

double along(const Object &o, Vec p) {
  return std::min(std::max(dot(p - o.a, o.u), 0.0), o.len);
}

const char *cylinderSet(Object &o, const double *v) {
  o.size = v[6];
  setSegment(o, v, v + 3, o.size);
  return badSize(o.size) ? "the size must be above 0" : nullptr;
}

double cylinderQ(const Object &o, Vec p, Vec *g) {
  Vec m = p - (o.a + o.u * along(o, p));
  double k = 1 / (o.size * o.size);
  if (g) *g = m * (2 * k);
  return dot(m, m) * k;
}

void bodyQuadratic(const Object &o, const Ray &ray, double c[3]) {
  Vec m = ray.eye - o.a;
  m = m - o.u * dot(m, o.u);
  Vec d = ray.dir - o.u * dot(ray.dir, o.u);
  double k = 1 / (o.size * o.size);
  c[0] = dot(m, m) * k;
  c[1] = 2 * dot(m, d) * k;
  c[2] = dot(d, d) * k;
}

void cylinderQuadratic(const Object &o, const Ray &ray, double t, double c[3]) {
  double s = dot(point(ray, t) - o.a, o.u);
  if (s <= 0) pointQuadratic(ray, o.a, o.size, c);
  else if (s >= o.len) pointQuadratic(ray, o.a + o.u * o.len, o.size, c);
  else bodyQuadratic(o, ray, c);
}

void cylinderBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  double c[3];
  bodyQuadratic(o, ray, c);
  whereOne(c, t);
  pointQuadratic(ray, o.a, o.size, c);
  whereOne(c, t);
  pointQuadratic(ray, o.a + o.u * o.len, o.size, c);
  whereOne(c, t);
  double d = dot(ray.dir, o.u), s = dot(ray.eye - o.a, o.u);
  if (d != 0) {
    t.push_back(-s / d);
    t.push_back((o.len - s) / d);
  }
}

// ---- kinds without a polynomial --------------------------------------------

// The distance to any core changes by at most the distance travelled, which
// bounds q from its value in the middle.
void distanceBounds(const Object &o, const Ray &ray, double a, double b, double &low, double &high) {
  double d = std::sqrt(o.kind->q(o, point(ray, (a + b) / 2), nullptr));
  double h = (b - a) / 2 * length(ray.dir) / o.size;
  low = d > h ? (d - h) * (d - h) : 0;
  high = (d + h) * (d + h);
}

const char *setRound(Object &o, const double *v) {
  o.a = o.middle = {v[0], v[1], v[2]};
  o.u = {v[3], v[4], v[5]};
  double n = length(o.u);
  if (!(n > 0)) return "the normal has no direction";
  o.u = o.u * (1 / n);
  o.len = v[6];
  o.size = v[7];
  o.reach = o.len + o.size;
  if (o.len < 0) return "the radius must not be negative";
  return badSize(o.size) ? "the size must be above 0" : nullptr;
}

// torus: cx cy cz nx ny nz ring R. The core is a circle of radius ring.
double torusQ(const Object &o, Vec p, Vec *g) {
  Vec m = p - o.a;
  double h = dot(m, o.u);
  Vec across = m - o.u * h;
  double rho = length(across), d = rho - o.len, k = 1 / (o.size * o.size);
  if (g) *g = (o.u * h + across * (rho > 0 ? d / rho : 0)) * (2 * k);
  return (h * h + d * d) * k;
}

// disc: cx cy cz nx ny nz rad R. The core is a flat disc of radius rad.
double discQ(const Object &o, Vec p, Vec *g) {
  Vec m = p - o.a;
  double h = dot(m, o.u);
  Vec across = m - o.u * h;
  double rho = length(across), d = std::max(rho - o.len, 0.0), k = 1 / (o.size * o.size);
  if (g) *g = (o.u * h + across * (rho > 0 ? d / rho : 0)) * (2 * k);
  return (h * h + d * d) * k;
}

// cone: x1 y1 z1 R1 x2 y2 z2 R2. The core is a line segment; the size is
// taken at the nearest point of it and goes evenly from R1 to R2.
const char *coneSet(Object &o, const double *v) {
  o.size = v[3];
  o.size2 = v[7];
  setSegment(o, v, v + 4, std::max(o.size, o.size2));
  return badSize(o.size) || badSize(o.size2) ? "the sizes must be above 0" : nullptr;
}

double coneTaper(const Object &o) { return o.len > 0 ? (o.size2 - o.size) / o.len : 0; }

double coneQ(const Object &o, Vec p, Vec *g) {
  double s = along(o, p), taper = coneTaper(o), size = o.size + taper * s;
  Vec m = p - (o.a + o.u * s);
  double k = 1 / (size * size), d2 = dot(m, m);
  if (g) {
    *g = m * (2 * k);
    if (s > 0 && s < o.len) *g = *g - o.u * (2 * d2 * k / size * taper);
  }
  return d2 * k;
}

void coneBounds(const Object &o, const Ray &ray, double a, double b, double &low, double &high) {
  Vec p = point(ray, (a + b) / 2);
  double s = along(o, p), taper = coneTaper(o), size = o.size + taper * s;
  double d = length(p - (o.a + o.u * s)), h = (b - a) / 2 * length(ray.dir);
  double drift = std::fabs(taper) * h;
  double least = std::max(size - drift, std::min(o.size, o.size2));
  double most = std::min(size + drift, std::max(o.size, o.size2));
  low = d > h ? (d - h) * (d - h) / (most * most) : 0;
  high = (d + h) * (d + h) / (least * least);
}

const Kind kinds[] = {
    {"sphere", 4, sphereSet, sphereQ, sphereBreaks, sphereQuadratic, nullptr},
    {"cylinder", 7, cylinderSet, cylinderQ, cylinderBreaks, cylinderQuadratic, nullptr},
    {"torus", 8, setRound, torusQ, nullptr, nullptr, distanceBounds},
    {"disc", 8, setRound, discQ, nullptr, nullptr, distanceBounds},
    {"cone", 8, coneSet, coneQ, nullptr, nullptr, coneBounds},
};

// ---- Bernstein form ----------------------------------------------------------

const int N = 7;   // coefficients of degree six

// The product of a quadratic and a quartic, all in Bernstein form.
void product(const double q[3], const double s[5], double c[N]) {
  c[0] = q[0] * s[0];
  c[1] = (2 * q[0] * s[1] + q[1] * s[0]) / 3;
  c[2] = (6 * q[0] * s[2] + 8 * q[1] * s[1] + q[2] * s[0]) / 15;
  c[3] = (q[0] * s[3] + 3 * q[1] * s[2] + q[2] * s[1]) / 5;
  c[4] = (q[0] * s[4] + 8 * q[1] * s[3] + 6 * q[2] * s[2]) / 15;
  c[5] = (q[1] * s[4] + 2 * q[2] * s[3]) / 3;
  c[6] = q[2] * s[4];
}

// The Geoff function of a quadratic in the depth, on [a, b].
void fieldForm(const double quad[3], double a, double b, double f[N]) {
  const double one2[3] = {1, 1, 1}, one4[5] = {1, 1, 1, 1, 1};
  double q[3], s[5], linear[N], square[N], cube[N];
  q[0] = quad[0] + a * (quad[1] + a * quad[2]);
  q[2] = quad[0] + b * (quad[1] + b * quad[2]);
  q[1] = q[0] + (quad[1] + 2 * a * quad[2]) * (b - a) / 2;
  s[0] = q[0] * q[0];
  s[1] = q[0] * q[1];
  s[2] = (q[0] * q[2] + 2 * q[1] * q[1]) / 3;
  s[3] = q[1] * q[2];
  s[4] = q[2] * q[2];
  product(q, one4, linear);
  product(one2, s, square);
  product(q, s, cube);
  for (int k = 0; k < N; k++)
    f[k] = 1 - 22 / 9.0 * linear[k] + 17 / 9.0 * square[k] - 4 / 9.0 * cube[k];
}

// Halves the interval: left and right are the forms on the two halves.
void halve(const double c[N], double left[N], double right[N]) {
  double w[N];
  std::copy(c, c + N, w);
  for (int k = 0; k < N; k++) {
    left[k] = w[0];
    right[N - 1 - k] = w[N - 1 - k];
    for (int i = 0; i < N - 1 - k; i++) w[i] = (w[i] + w[i + 1]) / 2;
  }
}

double value(const double c[N], double x) {
  double w[N];
  std::copy(c, c + N, w);
  for (int n = N - 1; n > 0; n--)
    for (int i = 0; i < n; i++) w[i] += x * (w[i + 1] - w[i]);
  return w[0];
}

// The only zero in [0, 1] of a form that starts below and ends above or at 0.
double onlyZero(const double c[N]) {
  double x0 = 0, x1 = 1, f0 = c[0], f1 = c[N - 1];
  for (int i = 0; i < 60 && x1 - x0 > 1e-11; i++) {
    // False position, its weight halved where one end stays (Illinois).
    double x = x0 - f0 * (x1 - x0) / (f1 - f0);
    if (!(x > x0 && x < x1)) x = (x0 + x1) / 2;
    double f = value(c, x);
    if (f >= 0) {
      if (f < 1e-14) return x;
      x1 = x, f1 = f, f0 /= 2;
    } else {
      x0 = x, f0 = f, f1 /= 2;
      if (f > -1e-14) return x;
    }
  }
  return x1;
}

// Shortest stretch of depth looked into. Field missed in a stretch this short
// is less than its length times the steepest slope, 1.6/R.
const double FINEST = 1e-7;
// How far another object may be the stronger one at a belt: above rounding,
// far below anything that shows.
const double BELT = 1e-6;
// Own surface value from which on a meeting is a seam and not a belt.
const double SEAM = 1e-3;

}  // namespace

const Kind *findKind(const std::string &word) {
  for (const Kind &k : kinds)
    if (word == k.word) return &k;
  return nullptr;
}

// What one call of trace() works with. The functions of one surface have to be
// at or above zero together: the surface's own sum less the isovalue, and the
// object's lead over each linked neighbour.
struct Tracer::Work {
  Ray ray;
  std::vector<double> t;          // depths where polynomials change
  std::vector<int> live;          // objects whose field reaches the stretch
  std::vector<double> form;       // their Bernstein coefficients, N each
  std::vector<double> start;      // coefficients of the functions at hand
  struct Term {
    int fn, object;
    double weight;
  };
  std::vector<Term> terms;        // fields without a polynomial
  const Scene *scene;

  double field(int i, double at) const {
    const Object &o = scene->objects[i];
    return geoff(o.kind->q(o, point(ray, at), nullptr));
  }
};

Tracer::Tracer(const Scene &s) : scene(s), group(s.objects.size(), -1) {
  int n = (int)s.objects.size();
  // A group is an object with all it is linked to, if they are linked alike.
  for (int i = 0; i < n; i++) {
    if (group[i] >= 0) continue;
    bool whole = true;
    auto in = [&](int j) { return j == i || s.weight[i][j] != 0; };
    for (int j = 0; whole && j < n; j++)
      for (int k = 0; whole && in(j) && k < n; k++)
        if (k != j) whole = in(k) ? s.weight[j][k] == 1 : s.weight[j][k] == 0;
    if (whole)
      for (int j = 0; j < n; j++)
        if (in(j)) group[j] = i;
  }
}

void Tracer::forgetGroups() { std::fill(group.begin(), group.end(), -1); }

// The rays of one row lie in a plane through the eye.
bool Tracer::inRow(int i, double row) const {
  const Object &o = scene.objects[i];
  double slope = -(row - scene.centreY) / scene.focalY;
  Vec m = o.middle - scene.eye;
  return std::fabs(m.y - slope * m.z) <= o.reach * std::sqrt(1 + slope * slope);
}

bool Tracer::inColumn(int i, double column) const {
  const Object &o = scene.objects[i];
  double slope = (column - scene.centreX) / scene.focalX;
  Vec m = o.middle - scene.eye;
  return std::fabs(m.x - slope * m.z) <= o.reach * std::sqrt(1 + slope * slope);
}

bool Tracer::eyeInside() const {
  for (size_t i = 0; i < scene.objects.size(); i++) {
    const Object &o = scene.objects[i];
    double f = geoff(o.kind->q(o, scene.eye, nullptr)), sum = f;
    bool strongest = true;
    for (size_t j = 0; j < scene.objects.size(); j++) {
      double w = scene.weight[i][j];
      if (w == 0) continue;
      const Object &p = scene.objects[j];
      double g = geoff(p.kind->q(p, scene.eye, nullptr));
      sum += w * g;
      if (std::min(w, 1.0) * g > f + BELT) strongest = false;
    }
    if (strongest && sum >= scene.isovalue) return true;
  }
  return false;
}

// The least depth in [a, b] at which all `fn` functions are at or above zero;
// below 0 if there is none. c holds their polynomial parts, N each.
double Tracer::first(Work &w, int fn, const double *c, double a, double b) const {
  if (fn == 1 && w.terms.empty()) {
    double high = *std::max_element(c, c + N);
    if (high < 0) return -1;
    if (c[0] >= 0) return a;
    int changes = 0;
    for (int k = 1; k < N; k++) changes += (c[k] >= 0) != (c[k - 1] >= 0);
    if (changes == 1) return a + (b - a) * onlyZero(c);
  } else {
    bool now = true;
    for (int k = 0; k < fn; k++) {
      const double *p = c + k * N;
      double high = *std::max_element(p, p + N), here = p[0];
      for (const Work::Term &t : w.terms)
        if (t.fn == k) {
          const Object &o = scene.objects[t.object];
          double lowQ, highQ;
          o.kind->bounds(o, w.ray, a, b, lowQ, highQ);
          high += t.weight * geoff(t.weight > 0 ? lowQ : highQ);
        }
      if (high < 0) return -1;
      for (const Work::Term &t : w.terms)
        if (now && t.fn == k) here += t.weight * w.field(t.object, a);
      now = now && here >= 0;
    }
    if (now) return a;
  }
  if (b - a < FINEST) {
    for (int k = 0; k < fn; k++) {
      double there = c[k * N + N - 1];
      for (const Work::Term &t : w.terms)
        if (t.fn == k) there += t.weight * w.field(t.object, b);
      if (there < 0) return -1;
    }
    return b;
  }
  double few[2 * 4 * N];
  std::vector<double> many;
  double *left = few;
  if (fn > 4) {
    many.resize(2 * fn * N);
    left = many.data();
  }
  double *right = left + fn * N;
  for (int k = 0; k < fn; k++) halve(c + k * N, left + k * N, right + k * N);
  double mid = (a + b) / 2, t = first(w, fn, left, a, mid);
  return t >= 0 ? t : first(w, fn, right, mid, b);
}

Hit Tracer::trace(double column, double row) const {
  std::vector<int> all(scene.objects.size());
  for (size_t i = 0; i < all.size(); i++) all[i] = (int)i;
  return trace(column, row, all.data(), (int)all.size());
}

Hit Tracer::trace(double column, double row, const int *which, int count) const {
  static thread_local Work w;
  Hit hit;
  w.scene = &scene;
  w.ray.eye = scene.eye;
  w.ray.dir = {(column - scene.centreX) / scene.focalX, -(row - scene.centreY) / scene.focalY, 1};
  w.t.clear();
  for (int n = 0; n < count; n++) {
    const Object &o = scene.objects[which[n]];
    if (o.kind->breaks) {
      o.kind->breaks(o, w.ray, w.t);
    } else {
      double c[3];
      pointQuadratic(w.ray, o.middle, o.reach, c);
      whereOne(c, w.t);
    }
  }
  w.t.push_back(0);
  std::sort(w.t.begin(), w.t.end());

  double found = -1;
  int owner = -1;
  for (size_t link = 0; link + 1 < w.t.size() && found < 0; link++) {
    double a = w.t[link], b = w.t[link + 1];
    if (a < 0 || b <= a) continue;
    w.live.clear();
    for (int n = 0; n < count; n++) {
      const Object &o = scene.objects[which[n]];
      Vec m = point(w.ray, (a + b) / 2);
      bool on = o.kind->breaks ? o.kind->q(o, m, nullptr) < 1
                               : dot(m - o.middle, m - o.middle) < o.reach * o.reach;
      if (on) w.live.push_back(which[n]);
    }
    if (w.live.empty()) continue;
    int lives = (int)w.live.size();
    w.form.assign(lives * N, 0);
    for (int n = 0; n < lives; n++) {
      const Object &o = scene.objects[w.live[n]];
      if (!o.kind->breaks) continue;
      double quad[3];
      o.kind->quadratic(o, w.ray, (a + b) / 2, quad);
      fieldForm(quad, a, b, &w.form[n * N]);
    }
    // Adds `weight` times a live object's field to function fn.
    auto add = [&](int fn, int n, double weight) {
      if (scene.objects[w.live[n]].kind->breaks)
        for (int k = 0; k < N; k++) w.start[fn * N + k] += weight * w.form[n * N + k];
      else
        w.terms.push_back({fn, w.live[n], weight});
    };
    for (int n = 0; n < lives; n++) {
      int i = w.live[n], fns = 1;
      w.terms.clear();
      w.start.assign(N, -scene.isovalue);
      if (group[i] >= 0) {
        bool done = false;
        for (int m = 0; m < n; m++) done = done || group[w.live[m]] == group[i];
        if (done) continue;
        for (int m = n; m < lives; m++)
          if (group[w.live[m]] == group[i]) add(0, m, 1);
      } else {
        add(0, n, 1);
        for (int m = 0; m < lives; m++) {
          double weight = m == n ? 0 : scene.weight[i][w.live[m]];
          if (weight == 0) continue;
          add(0, m, weight);
          w.start.resize((fns + 1) * N, BELT);
          add(fns, n, 1);
          add(fns, m, -std::min(weight, 1.0));
          fns++;
        }
      }
      double t = first(w, fns, w.start.data(), a, b);
      if (t >= 0 && (found < 0 || t < found)) found = t, owner = i;
    }
  }
  if (found < 0) return hit;

  // The owner's surface, its gradient, and who is strongest there.
  Vec p = point(w.ray, found), gradient{0, 0, 0};
  double sum = 0, most = -1;
  for (int n = 0; n < count; n++) {
    int j = which[n];
    double weight = j == owner ? 1 : scene.weight[owner][j];
    if (weight == 0) continue;
    const Object &o = scene.objects[j];
    Vec g;
    double q = o.kind->q(o, p, &g), f = geoff(q);
    sum += weight * f;
    gradient = gradient + g * (weight * geoffSlope(q));
    if (f > most && (group[owner] >= 0 || j == owner)) most = f, hit.object = j;
  }
  hit.depth = found;
  hit.seam = sum - scene.isovalue > SEAM;
  double len = length(gradient);
  double cosine = len > 0 ? std::max(0.0, -dot(gradient, scene.light) / len) : 0;
  hit.shade = (float)((RAMP - 1) * (scene.ambient + (1 - scene.ambient) * cosine));
  return hit;
}

void Picture::trace(const Scene &scene, int threads) {
  Tracer tracer(scene);
  eyeInside = tracer.eyeInside();
  int n = (int)scene.objects.size(), across = WIDTH + 2 * MARGIN;
  std::vector<char> inColumn(across * n);
  for (int c = 0; c < across; c++)
    for (int i = 0; i < n; i++) inColumn[c * n + i] = tracer.inColumn(i, c - MARGIN + 0.5);
  std::atomic<int> next(-MARGIN);
  auto work = [&]() {
    std::vector<int> inRow, list;
    for (int row; (row = next++) < HEIGHT + MARGIN;) {
      inRow.clear();
      for (int i = 0; i < n; i++)
        if (tracer.inRow(i, row + 0.5)) inRow.push_back(i);
      for (int c = 0; c < across; c++) {
        list.clear();
        for (int i : inRow)
          if (inColumn[c * n + i]) list.push_back(i);
        Hit hit;
        if (!list.empty()) hit = tracer.trace(c - MARGIN + 0.5, row + 0.5, list.data(), (int)list.size());
        hits[(row + MARGIN) * across + c] = hit;
      }
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; i++) others.emplace_back(work);
  work();
  for (std::thread &t : others) t.join();
}

}  // namespace truth
