// Finds where a viewing ray first meets the implicit surface.
//
// The answer can be trusted even where the ray is nearly tangent to the surface; stepping along the ray and looking for a
// change of sign would miss thin slices there. Along a ray the field of a sphere, cylinder or box is a chain of polynomials
// of degree six in the depth. They are kept in Bernstein form, whose coefficients bound the values. The fields of other
// kinds are enclosed by bounds until the interval is short enough for a polynomial that approximates them to the eleventh
// decimal (the eighth in warped space).
//
// Objects joined by links make one body, with one field:
//
//   F = sum f_i^2 g_i / sum f_i^2,   g_i = f_i + sum w_ij f_j
//
// F is an average of the g_i, so there is no surface where all g_i are below the isovalue, however small the f_i are.
// Elsewhere the sign of F - isovalue is the sign of sum f_i^2 (g_i - isovalue), a polynomial of degree eighteen. Where all
// objects of the body that reach an interval are linked with weight 1, F is their plain sum, of degree six. f_i is a field
// times its object's strength. An object that digs into i has a negative weight in g_i; an object that only digs is not a
// member of the sums over i and is stored after the members. An interval is halved until the bounds exclude the surface or
// the first crossing is found precisely. Bodies do not influence each other: the nearest surface is the visible one.
#include "truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>
#include <type_traits>

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

// Sets the core and the bounding sphere for kinds whose core is a segment.
void setSegment(Object &o, const double *from, const double *to, double size) {
  Vec a{from[0], from[1], from[2]}, b{to[0], to[1], to[2]};
  o.a = a;
  o.len = length(b - a);
  o.u = o.len > 0 ? (b - a) * (1 / o.len) : Vec{1, 0, 0};
  o.middle = (a + b) * 0.5;
  o.reach = o.len / 2 + size;
}

// Returns the position along the core of the core's nearest point to p, clamped to [0, len].
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

// The quadratic of an infinitely long cylinder; valid between the ends of the core.
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

// Appends the depth where a ray passes the plane perpendicular to the axis at distance `at` along the axis from o.a.
void whereAlong(const Object &o, const Ray &ray, double at, std::vector<double> &t) {
  double d = dot(ray.dir, o.u);
  if (d != 0) t.push_back((at - dot(ray.eye - o.a, o.u)) / d);
}

void cylinderBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  double c[3];
  bodyQuadratic(o, ray, c);
  whereOne(c, t);
  pointQuadratic(ray, o.a, o.size, c);
  whereOne(c, t);
  pointQuadratic(ray, o.a + o.u * o.len, o.size, c);
  whereOne(c, t);
  whereAlong(o, ray, 0, t);
  whereAlong(o, ray, o.len, t);
}

// ---- kinds without a polynomial --------------------------------------------

// Over a distance travelled, the distance to any core changes by at most that distance; this bounds q in [a, b] from its
// value in the middle.
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

// cone: x1 y1 z1 R1 x2 y2 z2 R2. The core is a line segment. The size changes linearly from R1 to R2 along the core and
// is taken at the core's nearest point.
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

// A torus is smooth except on its axis; the only possible break is the depth where the ray is nearest to the axis.
void torusBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  Vec d = ray.dir - o.u * dot(ray.dir, o.u), m = ray.eye - o.a;
  double k = dot(d, d);
  if (k > 0) t.push_back(-dot(m, d) / k);
}

// q of a disc has breaks where the ray passes the cylinder of the disc's radius about its axis.
void discBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  if (!(o.len > 0)) return;
  Object tube = o;
  tube.size = o.len;
  double c[3];
  bodyQuadratic(tube, ray, c);
  whereOne(c, t);
}

void coneBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  whereAlong(o, ray, 0, t);
  whereAlong(o, ray, o.len, t);
}

// ---- box: cx cy cz ax ay az bx by bz A B C R --------------------------------
//
// The core is a solid box about c with the edges A, B and C along its x axis a, its y axis b and its z axis a x b. q is the
// sum of the squares of the distances by which the point lies beyond each pair of planes, divided by R^2.

// Makes three perpendicular unit axes from the given x and y axes. Returns a message if that is impossible, or null.
const char *setAxes(const double *v, Vec axis[3]) {
  Vec x{v[0], v[1], v[2]}, y{v[3], v[4], v[5]};
  if (!(length(x) > 0)) return "the x axis has no direction";
  x = x * (1 / length(x));
  // Makes y exactly perpendicular to x; the program's fixed-point rotations leave an error in the last digits.
  y = y - x * dot(x, y);
  if (!(length(y) > 0)) return "the y axis has no direction of its own";
  y = y * (1 / length(y));
  axis[0] = x;
  axis[1] = y;
  axis[2] = cross(x, y);
  return nullptr;
}

const char *boxSet(Object &o, const double *v) {
  o.a = o.middle = {v[0], v[1], v[2]};
  if (const char *wrong = setAxes(v + 3, o.axis)) return wrong;
  if (v[9] < 0 || v[10] < 0 || v[11] < 0) return "an edge must not be negative";
  o.half = {v[9] / 2, v[10] / 2, v[11] / 2};
  o.size = v[12];
  o.reach = length(o.half) + o.size;
  return badSize(o.size) ? "the size must be above 0" : nullptr;
}

// Returns the signed distance by which m lies beyond the planes at +-half, 0 between them.
double beyond(double m, double half) { return m - std::min(std::max(m, -half), half); }

double boxQ(const Object &o, Vec p, Vec *g) {
  Vec m = p - o.a;
  double x = beyond(dot(m, o.axis[0]), o.half.x), y = beyond(dot(m, o.axis[1]), o.half.y);
  double z = beyond(dot(m, o.axis[2]), o.half.z), k = 1 / (o.size * o.size);
  if (g) *g = (o.axis[0] * x + o.axis[1] * y + o.axis[2] * z) * (2 * k);
  return (x * x + y * y + z * z) * k;
}

// Returns the depths where a ray passes the six planes, in ascending order.
std::vector<double> boxPlanes(const Object &o, const Ray &ray) {
  const double half[] = {o.half.x, o.half.y, o.half.z};
  std::vector<double> t;
  for (int i = 0; i < 3; i++) {
    double d = dot(ray.dir, o.axis[i]), m = dot(ray.eye - o.a, o.axis[i]);
    if (d == 0) continue;
    t.push_back((half[i] - m) / d);
    t.push_back((-half[i] - m) / d);
  }
  std::sort(t.begin(), t.end());
  return t;
}

void boxQuadratic(const Object &o, const Ray &ray, double t, double c[3]) {
  const double half[] = {o.half.x, o.half.y, o.half.z};
  double k = 1 / (o.size * o.size);
  c[0] = c[1] = c[2] = 0;
  for (int i = 0; i < 3; i++) {
    double d = dot(ray.dir, o.axis[i]), m = dot(ray.eye - o.a, o.axis[i]), at = m + d * t;
    if (std::fabs(at) <= half[i]) continue;
    m -= at > 0 ? half[i] : -half[i];
    c[0] += m * m * k;
    c[1] += 2 * m * d * k;
    c[2] += d * d * k;
  }
}

void boxBreaks(const Object &o, const Ray &ray, std::vector<double> &t) {
  const std::vector<double> plane = boxPlanes(o, ray);
  t.insert(t.end(), plane.begin(), plane.end());
  // Roots of q = 1 in each interval between two planes, and before the first and behind the last plane.
  for (size_t i = 0; i <= plane.size(); i++) {
    double middle = 0;
    if (!plane.empty())
        middle = i == 0 ? plane[0] - 1 : i == plane.size() ? plane[i - 1] + 1 : (plane[i - 1] + plane[i]) / 2;
    double c[3];
    boxQuadratic(o, ray, middle, c);
    whereOne(c, t);
  }
}

const Kind kinds[] = {
    {"sphere", 4, sphereSet, sphereQ, sphereBreaks, sphereQuadratic, nullptr},
    {"cylinder", 7, cylinderSet, cylinderQ, cylinderBreaks, cylinderQuadratic, nullptr},
    {"torus", 8, setRound, torusQ, torusBreaks, nullptr, distanceBounds},
    {"disc", 8, setRound, discQ, discBreaks, nullptr, distanceBounds},
    {"cone", 8, coneSet, coneQ, coneBreaks, nullptr, coneBounds},
    {"box", 13, boxSet, boxQ, boxBreaks, boxQuadratic, nullptr},
};

// ---- Bernstein form ----------------------------------------------------------

const int N = 7;   // coefficients of a form of degree six

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

// Stores the Geoff function of a quadratic in the depth as a form on [a, b].
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

// Halves the interval: `left` and `right` receive the forms on the two halves.
template <int M>
void halve(const double *c, double *left, double *right) {
  double w[M];
  std::copy(c, c + M, w);
  for (int k = 0; k < M; k++) {
    left[k] = w[0];
    right[M - 1 - k] = w[M - 1 - k];
    for (int i = 0; i < M - 1 - k; i++) w[i] = (w[i] + w[i + 1]) / 2;
  }
}

template <int M>
double value(const double *c, double x) {
  double w[M];
  std::copy(c, c + M, w);
  for (int n = M - 1; n > 0; n--)
    for (int i = 0; i < n; i++) w[i] += x * (w[i + 1] - w[i]);
  return w[0];
}

// Returns the only zero in [0, 1] of a form that starts below 0 and ends at or above 0.
template <int M>
double onlyZero(const double *c) {
  double x0 = 0, x1 = 1, f0 = c[0], f1 = c[M - 1];
  for (int i = 0; i < 160 && x1 - x0 > 1e-12; i++) {
    // Regula falsi with the Illinois rule (an end that stays has its value halved). Every third step bisects instead,
    // because the form may be flat at one end.
    double x = x0 - f0 * (x1 - x0) / (f1 - f0);
    if (i % 3 == 2 || !(x > x0 && x < x1)) x = (x0 + x1) / 2;
    double f = value<M>(c, x);
    if (f >= 0) {
      if (f == 0) return x;
      x1 = x, f1 = f, f0 /= 2;
    } else {
      x0 = x, f0 = f, f1 /= 2;
    }
  }
  return x1;
}

template <int M>
int signChanges(const double *c) {
  int changes = 0;
  for (int k = 1; k < M; k++) changes += (c[k] >= 0) != (c[k - 1] >= 0);
  return changes;
}

// The matrix that turns values at N evenly spaced places into the form through these values: the inverse of the matrix of
// the Bernstein polynomials' values at these places.
struct Through {
  double m[N][N];
  Through() {
    double a[N][2 * N] = {};
    for (int r = 0; r < N; r++) {
      double x = r / double(N - 1), choose = 1;
      for (int k = 0; k < N; k++) {
        a[r][k] = choose * std::pow(x, k) * std::pow(1 - x, N - 1 - k);
        choose = choose * (N - 1 - k) / (k + 1);
      }
      a[r][N + r] = 1;
    }
    for (int k = 0; k < N; k++) {
      int most = k;
      for (int r = k; r < N; r++)
        if (std::fabs(a[r][k]) > std::fabs(a[most][k])) most = r;
      std::swap(a[k], a[most]);
      for (int r = 0; r < N; r++) {
        double s = r == k ? 0 : a[r][k] / a[k][k];
        for (int c = 0; c < 2 * N; c++) a[r][c] -= s * a[k][c];
      }
    }
    for (int r = 0; r < N; r++)
      for (int c = 0; c < N; c++) m[r][c] = a[r][N + c] / a[r][r];
  }
};
const Through through;

const int BODY = 19;   // coefficients of a form of degree eighteen
const int SQUARE = 13;

double choose(int n, int k) {
  double c = 1;
  for (int i = 0; i < k; i++) c = c * (n - i) / (i + 1);
  return c;
}

// Binomial coefficients, which scale the products of forms.
struct Choices {
  double six[N], twelve[SQUARE], eighteen[BODY];
  Choices() {
    for (int k = 0; k < N; k++) six[k] = choose(6, k);
    for (int k = 0; k < SQUARE; k++) twelve[k] = choose(12, k);
    for (int k = 0; k < BODY; k++) eighteen[k] = choose(18, k);
  }
};
const Choices choices;

// Adds f^2 g to a form of degree eighteen.
void addSquareTimes(const double f[N], const double g[N], double to[BODY]) {
  double fs[N], gs[N], square[SQUARE] = {}, all[BODY] = {};
  for (int k = 0; k < N; k++) fs[k] = f[k] * choices.six[k], gs[k] = g[k] * choices.six[k];
  for (int i = 0; i < N; i++)
    for (int k = 0; k < N; k++) square[i + k] += fs[i] * fs[k];
  for (int i = 0; i < SQUARE; i++)
    for (int k = 0; k < N; k++) all[i + k] += square[i] * gs[k];
  for (int k = 0; k < BODY; k++) to[k] += all[k] / choices.eighteen[k];
}

// Length of the shortest interval of depth that is searched. The field missed in an interval this short is less than its
// length times the steepest slope, 1.6/R.
const double FINEST = 1e-7;
// Fields that differ by a smaller share count as equally strong: a band about a thousandth of a unit wide at a border.
const double TIE = 1e-4;
// Greatest difference between a field and the form that approximates it.
const double FOLLOWS = 1e-11;
// The limit in warped space, where the curvature of a field has kinks that no break marks.
const double FOLLOWS_WARPED = 1e-8;

}  // namespace

const Kind *findKind(const std::string &word) {
  for (const Kind &k : kinds)
    if (word == k.word) return &k;
  return nullptr;
}

// ---- own space ---------------------------------------------------------------
//
// stretch n cx cy cz ax ay az bx by bz X Y Z
// taper, twist, bend n cx cy cz ax ay az bx by bz A H
//
// Object n has its own space about c, with the x axis a, the y axis b and a z axis perpendicular to both. The object's own
// line describes it in plain space. That space is stretched by X, Y and Z. Then x and z are scaled by 1 + A y / H, with y
// clamped to [-H, H]; space is turned about the y axis by A y / 2H degrees, from z to x (y is not clamped); and the y axis
// between -H and H becomes part of a circle of A degrees towards x, continued by straight lines at its ends.

const char *Object::setShape(const std::string &word, const double *v) {
  if (plain) {
    plain = false;
    centre = {v[0], v[1], v[2]};
    // The bounding sphere is enlarged so that it is centred on `centre`.
    reach += length(middle - centre);
    middle = centre;
    if (const char *wrong = setAxes(v + 3, own)) return wrong;
  }
  if (word == "stretch") {
    stretch = {v[9], v[10], v[11]};
    if (!(std::min(stretch.x, std::min(stretch.y, stretch.z)) > 0)) return "a factor must be above 0";
    reach *= std::max(stretch.x, std::max(stretch.y, stretch.z));
    return nullptr;
  }
  h = v[10];
  if (!(h > 0)) return "the height must be above 0";
  const double amount = v[9] * M_PI / 180;
  if (word == "taper") {
    taper = v[9];
    if (std::fabs(taper) >= 1) return "a taper must lie between -1 and 1";
    reach *= 1 + std::fabs(taper);
  }
  if (word == "twist") twist = amount;
  if (word == "bend") {
    bend = amount;
    reach *= 1.5;
  }
  return nullptr;
}

namespace {

// Maps a point of the bent x-y plane back. The bent axis is part of a circle about (1/k, 0), k = bend / 2h.
void unbend(double bend, double h, double &x, double &y) {
  if (bend < 0) {
    x = -x;
    unbend(-bend, h, x, y);
    x = -x;
    return;
  }
  const double radius = 2 * h / bend, dx = x - radius, end = bend / 2;
  const double angle = std::atan2(y, -dx), on = std::min(std::max(angle, -end), end);
  if (on == angle) {
    x = radius - std::hypot(dx, y);
    y = angle * radius;
    return;
  }
  // Beyond the end of the circle the axis follows the tangent.
  const double fromX = x - radius * (1 - std::cos(on)), fromY = y - radius * std::sin(on);
  x = fromX * std::cos(on) - fromY * std::sin(on);
  y = on * radius + fromX * std::sin(on) + fromY * std::cos(on);
}

}  // namespace

Vec Object::plainPoint(Vec p) const {
  if (plain) return p;
  const Vec m = p - centre;
  double x = dot(m, own[0]), y = dot(m, own[1]), z = dot(m, own[2]);
  if (bend != 0) unbend(bend, h, x, y);
  if (twist != 0) {
    const double angle = twist * y / (2 * h), s = std::sin(angle), c = std::cos(angle), turned = x * c - z * s;
    z = x * s + z * c;
    x = turned;
  }
  const double wide = 1 + taper * std::min(std::max(y / h, -1.0), 1.0);
  return centre + own[0] * (x / wide / stretch.x) + own[1] * (y / stretch.y) + own[2] * (z / wide / stretch.z);
}

// Only for a space that is not warped, where lines stay straight.
Ray Object::plainRay(const Ray &ray) const {
  if (plain) return ray;
  return {plainPoint(ray.eye), plainPoint(centre + ray.dir) - centre};
}

double Object::steepest(Vec p, double distance) const {
  // The bound covers three times the reach of the field, so it also holds somewhat outside the field.
  const double wide = 3 * reach, narrow = 1 - std::fabs(taper);
  double most = (1 + wide * std::fabs(taper) / h) / narrow * (1 + wide * std::fabs(twist) / (2 * h));
  if (bend != 0) {
    const double radius = 2 * h / std::fabs(bend);
    const Vec m = p - centre;
    const double x = dot(m, own[0]) * (bend < 0 ? -1 : 1) - radius, y = dot(m, own[1]), away = std::hypot(x, y) - distance;
    // There is no bound near the middle of the circle, and on its far side, where the two ends of the axis meet.
    if (away <= 0 || (x > -distance && std::fabs(y) <= distance)) return 1e30;
    most *= std::max(1.0, radius / away);
  }
  return most / std::min(stretch.x, std::min(stretch.y, stretch.z));
}

double Object::q(Vec p, Vec *g) const {
  double value = kind->q(*this, plainPoint(p), g);
  if (!g || plain) return value;
  const Vec steps[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double small = 1e-5;
  double out[3];
  for (int k = 0; k < 3; k++)
    out[k] = dot(*g, plainPoint(p + steps[k] * small) - plainPoint(p - steps[k] * small)) / (2 * small);
  *g = {out[0], out[1], out[2]};
  return value;
}

void Object::breaks(const Ray &ray, std::vector<double> &t) const {
  if (!warped()) kind->breaks(*this, plainRay(ray), t);
}

void Object::quadratic(const Ray &ray, double t, double c[3]) const { kind->quadratic(*this, plainRay(ray), t, c); }

void Object::bounds(const Ray &ray, double a, double b, double &low, double &high) const {
  if (!warped()) {
    kind->bounds(*this, plainRay(ray), a, b, low, high);
    return;
  }
  const Vec middle = point(ray, (a + b) / 2);
  const double distance = (b - a) / 2 * length(ray.dir), least = size2 > 0 ? std::min(size, size2) : size;
  const double drift = size2 > 0 && len > 0 ? (size2 - size) / len : 0;
  const double h = distance * steepest(middle, distance) / least * std::sqrt(1 + 9 * drift * drift);
  const double d = std::sqrt(q(middle, nullptr));
  // Over a long interval q may have any value.
  low = 0, high = 1e30;
  if (h > 0.5) return;
  low = d > h ? (d - h) * (d - h) : 0;
  high = (d + h) * (d + h);
}

// Working storage of one call of trace().
struct Tracer::Work {
  Ray ray;
  std::vector<double> t;          // depths of the breaks, ascending
  std::vector<int> live;          // objects whose fields reach the interval
  std::vector<double> form;       // Bernstein coefficients of their fields, N each
  std::vector<char> known;        // whether the coefficients of an object are set
  std::vector<int> with;          // indices in `live` of the objects that dig into the current body
};

Tracer::Tracer(const Scene &s) : scene(s), body(s.objects.size(), -1) {
  int n = (int)s.objects.size();
  std::vector<int> reached;
  for (int i = 0; i < n; i++) {
    if (body[i] >= 0 || s.objects[i].ghost) continue;
    int number = bodies++;
    body[i] = number;
    reached.assign(1, i);
    for (size_t k = 0; k < reached.size(); k++)
      for (int j = 0; j < n; j++)
        if (body[j] < 0 && s.link[reached[k]][j] != 0) body[j] = number, reached.push_back(j);
    bool alike = true;
    for (int j : reached) {
      for (int k : reached) alike = alike && (j == k || s.weight[j][k] == 1);
      for (int k = 0; k < n; k++) alike = alike && (body[k] == number || s.weight[j][k] == 0);
    }
    plain.push_back(alike);
  }
}

void Tracer::forgetPlain() {
  usePlain = false;
  std::fill(plain.begin(), plain.end(), 0);
}

// Returns the field of an object at a point, times the object's strength.
double Tracer::strengthened(int i, Vec p) const {
  const Object &o = scene.objects[i];
  return o.strength * geoff(o.q(p, nullptr));
}

// Returns whether an object that is not one of the n members digs into one of them.
bool Tracer::digs(int object, const int *members, int n) const {
  for (int k = 0; k < n; k++)
    if (scene.weight[members[k]][object] != 0) return true;
  return false;
}

double Tracer::field(int number, Vec p, Vec *gradient, int *strongest) const {
  int n = (int)scene.objects.size();
  static thread_local std::vector<double> f;
  static thread_local std::vector<Vec> df;
  static thread_local std::vector<int> here;
  f.clear(), df.clear(), here.clear();
  double most = 0;
  auto add = [&](int i) {
    const Object &o = scene.objects[i];
    Vec g{0, 0, 0};
    double q = o.q(p, gradient ? &g : nullptr);
    if (q >= 1) return;
    here.push_back(i), f.push_back(o.strength * geoff(q)), df.push_back(g * (o.strength * geoffSlope(q)));
  };
  for (int i = 0; i < n; i++) {
    if (body[i] != number) continue;
    add(i);
    if (here.empty() || here.back() != i || f.back() <= most) continue;
    most = f.back();
    if (strongest) *strongest = i;
  }
  if (!(most > 0)) return 0;
  size_t members = here.size();
  for (int i = 0; i < n; i++)
    if (body[i] != number && digs(i, here.data(), (int)members)) add(i);
  // Fields are divided by the strongest one, so that the squares of small fields do not underflow.
  double above = 0, below = 0;
  size_t m = here.size();
  std::vector<double> sum(members);
  for (size_t i = 0; i < members; i++) {
    sum[i] = f[i];
    for (size_t j = 0; j < m; j++)
      if (i != j) sum[i] += scene.weight[here[i]][here[j]] * f[j];
    double share = f[i] / most * (f[i] / most);
    above += share * sum[i], below += share;
  }
  double F = above / below;
  if (gradient) {
    *gradient = {0, 0, 0};
    for (size_t i = 0; i < members; i++) {
      double share = f[i] / most;
      *gradient = *gradient + df[i] * (2 * share / most * (sum[i] - F) + share * share);
      for (size_t j = 0; j < m; j++)
        if (i != j) *gradient = *gradient + df[j] * (share * share * scene.weight[here[i]][here[j]]);
    }
    *gradient = *gradient * (1 / below);
  }
  return F;
}

// The rays of one row lie in a plane through the eye; the distance of the bounding sphere's middle from it is tested.
bool Tracer::inRow(int i, double row) const {
  const Object &o = scene.objects[i];
  double slope = -(row - scene.centreY) / scene.focalY;
  Vec m = o.middle - scene.eye;
  return std::fabs(dot(m, scene.up) - slope * dot(m, scene.ahead)) <= o.reach * std::sqrt(1 + slope * slope);
}

bool Tracer::inColumn(int i, double column) const {
  const Object &o = scene.objects[i];
  double slope = (column - scene.centreX) / scene.focalX;
  Vec m = o.middle - scene.eye;
  return std::fabs(dot(m, scene.right) - slope * dot(m, scene.ahead)) <= o.reach * std::sqrt(1 + slope * slope);
}

bool Tracer::eyeInside() const {
  for (int k = 0; k < bodies; k++)
    if (field(k, scene.eye, nullptr, nullptr) >= scene.isovalue) return true;
  return false;
}

namespace {

// Returns the least depth in [a, b] at which the form is at or above zero, or -1 if there is none.
double firstOf(const double *c, double a, double b) {
  if (*std::max_element(c, c + N) < 0) return -1;
  if (c[0] >= 0) return a;
  if (signChanges<N>(c) == 1) return a + (b - a) * onlyZero<N>(c);
  if (b - a < FINEST) return c[N - 1] >= 0 ? b : -1;
  double left[N], right[N], mid = (a + b) / 2;
  halve<N>(c, left, right);
  double t = firstOf(left, a, mid);
  return t >= 0 ? t : firstOf(right, mid, b);
}

// Returns the least depth in [a, b] at which the form of degree eighteen, and at least one of the n forms g_i - isovalue in
// `sums`, are at or above zero, or -1 if there is none.
double firstOfBody(const double *c, const double *sums, int n, double a, double b) {
  if (*std::max_element(sums, sums + n * N) < 0) return -1;
  if (*std::max_element(c, c + BODY) < 0) return -1;
  bool starts = false, ends = false;
  for (int k = 0; k < n; k++) {
    starts = starts || sums[k * N] >= 0;
    ends = ends || sums[k * N + N - 1] >= 0;
  }
  if (c[0] >= 0 && starts) return a;
  if (ends && signChanges<BODY>(c) == 1 && c[0] < 0) return a + (b - a) * onlyZero<BODY>(c);
  if (b - a < FINEST) return ends && c[BODY - 1] >= 0 ? b : -1;
  double left[BODY], right[BODY], mid = (a + b) / 2;
  std::vector<double> half(2 * n * N);
  halve<BODY>(c, left, right);
  for (int k = 0; k < n; k++) halve<N>(sums + k * N, &half[k * N], &half[(n + k) * N]);
  double t = firstOfBody(left, half.data(), n, a, mid);
  return t >= 0 ? t : firstOfBody(right, half.data() + n * N, n, mid, b);
}

}  // namespace

// Returns whether the field of another object of the body, in another colour, is as strong at p.
bool Tracer::tie(int object, Vec p) const {
  auto colour = [&](int i) {
    auto ramp = scene.ramps.find(scene.objects[i].number);
    return ramp == scene.ramps.end() ? Colour{-1, -1, -1} : ramp->second;
  };
  double most = strengthened(object, p);
  for (int i = 0; i < (int)scene.objects.size(); i++) {
    if (i == object || body[i] != body[object]) continue;
    if (strengthened(i, p) < most * (1 - TIE)) continue;
    Colour a = colour(object), b = colour(i);
    if (a.r != b.r || a.g != b.g || a.b != b.b) return true;
  }
  return false;
}

// Stores a form on [a, b] that approximates an object's field. Returns false if no form of degree six is near enough.
bool Tracer::follow(const Work &w, int i, double a, double b, double *form) const {
  const Object &o = scene.objects[i];
  // A longer interval could hide features between the sampled places.
  double least = o.size2 > 0 ? std::min(o.size, o.size2) : o.size;
  const double whole = (b - a) * length(w.ray.dir);
  if (o.warped() ? whole * o.steepest(point(w.ray, (a + b) / 2), whole) > least / 2
                 : (b - a) * length(o.plainRay(w.ray).dir) > least / 2)
    return false;
  auto at = [&](double x) { return strengthened(i, point(w.ray, a + (b - a) * x)); };
  double v[N];
  for (int k = 0; k < N; k++) v[k] = at(k / double(N - 1));
  for (int k = 0; k < N; k++) {
    form[k] = 0;
    for (int j = 0; j < N; j++) form[k] += through.m[k][j] * v[j];
  }
  for (double x : {1 / 12.0, 5 / 12.0, 7 / 12.0, 11 / 12.0})
    if (std::fabs(value<N>(form, x) - at(x)) > (o.warped() ? FOLLOWS_WARPED : FOLLOWS)) return false;
  return true;
}

// The objects that reach an interval: first the members of a body, then the objects that dig into it.
struct Tracer::Group {
  const int *which;
  int count, members;
  bool sum;  // F is the plain sum of the fields
  double weight(const Scene &scene, int k, int j) const { return j == k ? 0 : scene.weight[which[k]][which[j]]; }
};

// Returns whether bounds of the fields in [a, b] exclude the surface. `form` holds the fields where `known` is set.
bool Tracer::excludes(const Work &w, const Group &group, const double *form, const char *known, double a, double b) const {
  const int n = group.count;
  std::vector<double> low(n), high(n);
  for (int k = 0; k < n; k++) {
    if (known[k]) {
      low[k] = std::max(*std::min_element(form + k * N, form + k * N + N), 0.0);
      high[k] = std::max(*std::max_element(form + k * N, form + k * N + N), 0.0);
    } else {
      const Object &o = scene.objects[group.which[k]];
      double lowQ, highQ;
      o.bounds(w.ray, a, b, lowQ, highQ);
      low[k] = o.strength * geoff(highQ), high[k] = o.strength * geoff(lowQ);
    }
  }
  double excess = 0, most = -1;
  if (group.sum) {
    for (int k = 0; k < n; k++) excess += high[k];
    return excess - scene.isovalue < 0;
  }
  for (int k = 0; k < group.members; k++) {
    double g = high[k] - scene.isovalue;
    for (int j = 0; j < n; j++) {
      double weight = group.weight(scene, k, j);
      g += weight * (weight > 0 ? high[j] : low[j]);
    }
    most = std::max(most, g);
    excess += g * (g > 0 ? high[k] * high[k] : low[k] * low[k]);
  }
  return most < 0 || excess < 0;
}

// Returns the least depth in [a, b] at which the body's field is at or above the isovalue, or -1 if there is none. `form` holds
// the fields of all objects of the group.
double Tracer::firstOfForms(const Group &group, const double *form, double a, double b) const {
  const int n = group.count, members = group.members;
  if (group.sum) {
    double c[N];
    std::fill(c, c + N, -scene.isovalue);
    for (int k = 0; k < n * N; k++) c[k % N] += form[k];
    return firstOf(c, a, b);
  }
  std::vector<double> sums(members * N);
  for (int k = 0; k < members; k++)
    for (int c = 0; c < N; c++) sums[k * N + c] = form[k * N + c] - scene.isovalue;
  for (int k = 0; k < members; k++)
    for (int j = 0; j < n; j++) {
      double weight = group.weight(scene, k, j);
      if (weight != 0)
        for (int c = 0; c < N; c++) sums[k * N + c] += weight * form[j * N + c];
    }
  if (*std::max_element(sums.begin(), sums.end()) < 0) return -1;
  double c[BODY] = {};
  for (int k = 0; k < members; k++) addSquareTimes(form + k * N, &sums[k * N], c);
  return firstOfBody(c, sums.data(), members, a, b);
}

// Does the same where `form` holds only the fields of which `known` is set.
double Tracer::first(const Work &w, const Group &group, const double *form, const char *known, double a, double b) const {
  const int n = group.count;
  if (std::find(known, known + n, 0) == known + n) return firstOfForms(group, form, a, b);
  // Bounds may exclude the surface, which saves fitting polynomials.
  if (excludes(w, group, form, known, a, b)) return -1;
  std::vector<double> now(form, form + n * N);
  std::vector<char> have(known, known + n);
  bool all = true;
  for (int k = 0; k < n && all; k++)
    if (!have[k]) all = follow(w, group.which[k], a, b, &now[k * N]), have[k] = all;
  if (all) return firstOfForms(group, now.data(), a, b);
  if (b - a < FINEST)
    return field(body[group.which[0]], point(w.ray, b), nullptr, nullptr) >= scene.isovalue ? b : -1;
  std::vector<double> left(n * N), right(n * N);
  for (int k = 0; k < n; k++)
    if (have[k]) halve<N>(&now[k * N], &left[k * N], &right[k * N]);
  double mid = (a + b) / 2, t = first(w, group, left.data(), have.data(), a, mid);
  return t >= 0 ? t : first(w, group, right.data(), have.data(), mid, b);
}

Hit Tracer::trace(double column, double row) const {
  std::vector<int> all(scene.objects.size());
  for (size_t i = 0; i < all.size(); i++) all[i] = (int)i;
  return trace(column, row, all.data(), (int)all.size());
}

// Sets the ray through an image position, and the depths between which no field begins or ends.
void Tracer::aim(double column, double row, const int *which, int count, Work &w) const {
  w.ray.eye = scene.eye;
  w.ray.dir = scene.right * ((column - scene.centreX) / scene.focalX) +
              scene.up * (-(row - scene.centreY) / scene.focalY) + scene.ahead;
  w.t.clear();
  for (int n = 0; n < count; n++) {
    const Object &o = scene.objects[which[n]];
    o.breaks(w.ray, w.t);
    if (!o.quadratic()) {
      double c[3];
      pointQuadratic(w.ray, o.middle, o.reach, c);
      whereOne(c, w.t);
    }
  }
  w.t.push_back(0);
  std::sort(w.t.begin(), w.t.end());
}

// Finds the objects that reach the interval [a, b], those of one body side by side, and the forms of the fields that are known.
void Tracer::gather(const int *which, int count, double a, double b, Work &w) const {
  w.live.clear();
  const Vec m = point(w.ray, (a + b) / 2);
  for (int n = 0; n < count; n++) {
    const Object &o = scene.objects[which[n]];
    bool on = o.quadratic() ? o.q(m, nullptr) < 1 : dot(m - o.middle, m - o.middle) < o.reach * o.reach;
    if (on) w.live.push_back(which[n]);
  }
  std::stable_sort(w.live.begin(), w.live.end(), [&](int i, int j) { return body[i] < body[j]; });
  const int lives = (int)w.live.size();
  w.form.assign(lives * N, 0);
  w.known.assign(lives, 0);
  for (int n = 0; n < lives; n++) {
    const Object &o = scene.objects[w.live[n]];
    if (!o.quadratic()) continue;
    double quad[3];
    o.quadratic(w.ray, (a + b) / 2, quad);
    fieldForm(quad, a, b, &w.form[n * N]);
    for (int k = 0; k < N; k++) w.form[n * N + k] *= o.strength;
    w.known[n] = 1;
  }
}

// Returns whether the fields of the objects `from` to before `end` of Work::live, which are those of a body, are to be added up.
bool Tracer::isSum(const Work &w, int from, int end) const {
  if (plain[body[w.live[from]]]) return true;
  if (!usePlain) return false;
  for (int i = from; i < end; i++)
    for (int j = from; j < end; j++)
      if (i != j && scene.weight[w.live[i]][w.live[j]] != 1) return false;
  return true;
}

// Returns the least depth in [a, b] at which the surface of a body is, or -1 if there is none. Its members are the objects `from`
// to before `end` of Work::live.
double Tracer::firstOfMembers(Work &w, int from, int end, double a, double b) const {
  const int lives = (int)w.live.size(), members = end - from;
  w.with.clear();
  for (int i = 0; i < lives; i++)
    if ((i < from || i >= end) && digs(w.live[i], &w.live[from], members)) w.with.push_back(i);
  if (w.with.empty())
    return first(w, {&w.live[from], members, members, isSum(w, from, end)}, &w.form[from * N], &w.known[from], a, b);
  // Objects that dig into the body are appended to copies of the members' lists.
  std::vector<int> which(w.live.begin() + from, w.live.begin() + end);
  std::vector<double> form(w.form.begin() + from * N, w.form.begin() + end * N);
  std::vector<char> known(w.known.begin() + from, w.known.begin() + end);
  for (int i : w.with) {
    which.push_back(w.live[i]);
    form.insert(form.end(), w.form.begin() + i * N, w.form.begin() + (i + 1) * N);
    known.push_back(w.known[i]);
  }
  return first(w, {which.data(), (int)which.size(), members, false}, form.data(), known.data(), a, b);
}

// Returns the least depth in [a, b] at which the surface of any body is, or -1 if there is none; `owner` receives the body.
double Tracer::firstOfBodies(Work &w, double a, double b, int &owner) const {
  double found = -1;
  const int lives = (int)w.live.size();
  for (int n = 0, end; n < lives; n = end) {
    const int number = body[w.live[n]];
    for (end = n; end < lives && body[w.live[end]] == number;) end++;
    if (number < 0) continue;
    const double t = firstOfMembers(w, n, end, a, b);
    if (t >= 0 && (found < 0 || t < found)) found = t, owner = number;
  }
  return found;
}

// Returns what a ray shows that meets the surface of a body at this depth.
Hit Tracer::hitAt(const Ray &ray, double depth, int owner) const {
  Hit hit;
  const Vec p = point(ray, depth);
  Vec gradient;
  field(owner, p, &gradient, &hit.object);
  hit.tied = !scene.mixed && tie(hit.object, p);
  hit.depth = depth;
  double len = length(gradient);
  const Coat &coat = scene.coats[hit.object];
  double light = len > 0 ? brightness(coat, gradient * (-1 / len)) : 0;
  hit.shade = (float)((RAMP - 1) * (scene.ambient + (1 - scene.ambient) * light));
  hit.colour = colour(hit.object, p);
  hit.shines = coat.finish != Coat::MATT;
  return hit;
}

Hit Tracer::trace(double column, double row, const int *which, int count) const {
  static thread_local Work w;
  aim(column, row, which, count, w);
  for (size_t link = 0; link + 1 < w.t.size(); link++) {
    double a = w.t[link], b = w.t[link + 1];
    if (a < 0 || b <= a) continue;
    gather(which, count, a, b, w);
    int owner = -1;
    double found = firstOfBodies(w, a, b, owner);
    if (found >= 0) return hitAt(w.ray, found, owner);
  }
  return Hit();
}

// A matt surface scatters light by the cosine between its normal and the light. A shiny surface scatters three quarters of
// that and adds a highlight: the cosine between its normal and the direction half way between light and viewer, to the
// 16th power, times what is missing to full brightness. A mirror has the same highlight, on a reflection of the
// surroundings (ground, horizon, sky) that depends on the height of the reflected direction only. The viewer is taken to be
// far away along the viewing axis.
double Tracer::brightness(const Coat &coat, Vec normal) const {
  double cosine = std::max(0.0, dot(normal, scene.light));
  if (coat.finish == Coat::MATT) return cosine;
  const Vec ahead = scene.ahead;
  double light = 0.75 * cosine;
  if (coat.finish == Coat::MIRROR) {
    Vec looks = ahead - normal * (2 * dot(normal, ahead));
    const double height[] = {-1, -0.3, 0.3, 1}, bright[] = {1 / 2.0, 1 / 12.0, 1, 1 / 2.0};
    int k = looks.y < height[1] ? 0 : looks.y < height[2] ? 1 : 2;
    light = bright[k] + (looks.y - height[k]) / (height[k + 1] - height[k]) * (bright[k + 1] - bright[k]);
  }
  Vec half = scene.light - ahead;
  double len = length(half), mirrored = len > 0 ? std::max(0.0, dot(normal, half) / len) : 0;
  return std::min(1.0, light + (1 - light) * std::pow(mirrored, 16));
}

namespace {

// Returns the share, 0 to 1, of the pattern's second colour at p.
double other(const Coat &c, Vec p) {
  const double turn = 2 * 3.14159265358979323846;
  Vec m = p - c.middle;
  double u[3];
  for (int i = 0; i < 3; i++) u[i] = dot(m, c.axis[i]) / c.grain;
  switch (c.pattern) {
    case Coat::CHECKS: return (long)(std::floor(u[0]) + std::floor(u[1]) + std::floor(u[2])) & 1;
    case Coat::STRIPES: return (long)std::floor(u[0]) & 1;
    case Coat::MARBLE:
      return 0.5 + 0.5 * std::sin(turn * (u[0] / 2 + 0.3 * std::sin(turn * (0.35 * u[1] + 0.2)) +
                                          0.2 * std::sin(turn * (0.55 * u[2] + 0.2 * u[1]))));
    default: return 0;
  }
}

}  // namespace

Colour Tracer::colour(int object, Vec p) const {
  double sum = 0, parts[3] = {0, 0, 0};
  auto add = [&](int i, double f) {
    auto ramp = scene.ramps.find(scene.objects[i].number);
    if (ramp == scene.ramps.end()) return;
    sum += f, parts[0] += f * ramp->second.r, parts[1] += f * ramp->second.g, parts[2] += f * ramp->second.b;
  };
  if (!scene.mixed) add(object, 1);
  for (int i = 0; scene.mixed && i < (int)scene.objects.size(); i++)
    if (body[i] == body[object]) add(i, strengthened(i, p));
  if (!(sum > 0)) return {0, 0, 0};
  const Coat &coat = scene.coats[object];
  double share = other(coat, p);
  auto mean = [&](double part, double pattern) { return part / sum * (1 - share) + pattern * share; };
  return {mean(parts[0], coat.colour.r), mean(parts[1], coat.colour.g), mean(parts[2], coat.colour.b)};
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

std::string Picture::bytes() const {
  std::string bytes((const char *)hits.data(), hits.size() * sizeof hits[0]);
  return bytes + (eyeInside ? '1' : '0');
}

bool Picture::take(const std::string &bytes) {
  static_assert(std::is_trivially_copyable<Hit>::value, "hits are copied as they lie in memory");
  size_t size = hits.size() * sizeof hits[0];
  if (bytes.size() != size + 1) return false;
  std::memcpy((void *)hits.data(), bytes.data(), size);
  eyeInside = bytes[size] == '1';
  return true;
}

}  // namespace truth
