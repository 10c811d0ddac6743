// Compares a dumped frame with its true picture, and makes the figures and the pictures of differences. This file alone
// defines what counts as a hole, as see-through, as outside, as an error and as flicker.
#include "truth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace truth {

namespace {

// Returns the 8-bit sample that the dump holds for a six-bit DAC value.
uint8_t eight(int six) { return (uint8_t)((six * 255 + 31) / 63); }

// Two ramps fit a pixel equally well if the distances of their nearest colours from the pixel's differ by at most this much.
// (Distances of colours are Euclidean, over three channels of 0 to 255.)
const double APART = 2;
// With more colours than EVEN_MOST the ramps share palette entries, which then are a few steps of the DAC off; APART_SHARED
// takes the place of APART.
const size_t EVEN_MOST = 4;
const double APART_SHARED = 8;
// A colour farther than this from all colours of a ramp does not belong to the ramp.
const double OFF = 14;
// In a painted scene all mixtures and patterns share the palette: a pixel's colour is wrong if it is further than this from
// every colour that the true point can have.
const double OFF_PAINTED = 40;

}  // namespace

Ramps::Ramps(const Scene &s)
    : ambient(s.ambient), highlight(s.highlight), paints(s.painted()), ofObject(s.objects.size(), -1) {
  std::vector<Colour> colours;
  for (size_t i = 0; i < s.objects.size(); i++) {
    auto ramp = s.ramps.find(s.objects[i].number);
    if (ramp == s.ramps.end()) continue;
    const Colour &c = ramp->second;
    size_t k = 0;
    while (k < colours.size() && !(colours[k].r == c.r && colours[k].g == c.g && colours[k].b == c.b)) k++;
    if (k == colours.size()) colours.push_back(c);
    ofObject[i] = (int)k;
  }
  for (const Colour &c : colours) steps.push_back(stepsOf(c, false));
}

// Whole numbers, rounded once for each channel, as the program computes its palette. A highlight adds the part of white that
// is perpendicular to the colour. A shiny colour turns into white itself in the last quarter of the light.
Ramps::Steps Ramps::stepsOf(const Colour &c, bool shines) const {
  const int top = RAMP - 1, dark = (int)std::lround(ambient * top), high = (int)std::lround(highlight * top);
  const int whole = 255 * top, gloss = 47;
  Steps ramp;
  const int full[3] = {(int)std::lround(c.r), (int)std::lround(c.g), (int)std::lround(c.b)};
  const int sum = full[0] + full[1] + full[2], square = full[0] * full[0] + full[1] * full[1] + full[2] * full[2];
  for (int step = 0; step < RAMP; step++)
    for (int k = 0; k < 3; k++) {
      int value = full[k] * (top * dark + step * (top - dark));
      if (shines && step > gloss)
        value += (int)((double)(top * whole - value) * (step - gloss) / (top - gloss));
      if (!shines && step > high && square > 0)
        value += (255 - 255 * sum * full[k] / square) * top * top * (step - high) / (2 * (top - high));
      value = std::min(std::max(value, 0), top * whole);
      ramp.rgb[step][k] = eight((value + whole / 2) / whole);
    }
  return ramp;
}

const Ramps::Steps &Ramps::stepsAt(const Hit &h) const {
  // Colours are distinguished to half a step of the DAC.
  auto half = [](double part) { return (uint32_t)std::lround(part / 2); };
  uint32_t key = half(h.colour.r) << 17 | half(h.colour.g) << 9 | half(h.colour.b) << 1 | (h.shines ? 1 : 0);
  auto there = pointSteps.find(key);
  if (there != pointSteps.end()) return there->second;
  return pointSteps[key] = stepsOf(h.colour, h.shines);
}

double Ramps::step(const uint8_t *rgb, const Hit &h, double *miss) const {
  if (miss) *miss = 0;
  if (!painted() || !h.any()) return step(rgb, h.object);
  const Steps &ramp = stepsAt(h);
  double least = 1e300, sum = 0;
  int count = 0;
  for (int step = 0; step < RAMP; step++) {
    double d = 0;
    for (int k = 0; k < 3; k++) d += (rgb[k] - ramp.rgb[step][k]) * (rgb[k] - ramp.rgb[step][k]);
    if (d < least) least = d, sum = 0, count = 0;
    if (d == least) sum += step, count++;
  }
  if (miss) *miss = std::sqrt(least);
  return (RAMP - 1) * ambient + (1 - ambient) * sum / count;
}

void Ramps::paint(const Hit &h, uint8_t *rgb) const {
  if (!painted()) return paint(h.object, h.shade, rgb);
  double light = ambient < 1 ? (h.shade - ambient * (RAMP - 1)) / (1 - ambient) : RAMP - 1;
  std::copy_n(stepsAt(h).rgb[std::min(std::max((int)std::floor(light + 0.5), 0), RAMP - 1)], 3, rgb);
}

const Ramps::Reading &Ramps::read(const uint8_t *rgb) const {
  uint32_t key = (uint32_t)rgb[0] << 16 | rgb[1] << 8 | rgb[2];
  auto there = known.find(key);
  if (there != known.end()) return there->second;
  Reading r{-1, -1, {}, {}};
  for (const Steps &ramp : steps) {
    double miss = 1e300, sum = 0;
    int count = 0;
    for (int step = 0; step < RAMP; step++) {
      double d = 0;
      for (int k = 0; k < 3; k++) d += (rgb[k] - ramp.rgb[step][k]) * (rgb[k] - ramp.rgb[step][k]);
      // If several steps have one colour, their mean is taken.
      if (d < miss) miss = d, sum = 0, count = 0;
      if (d == miss) sum += step, count++;
    }
    if (r.nearest < 0 || miss < r.miss[r.nearest]) r.nearest = (int)r.miss.size();
    r.miss.push_back(miss);
    r.step.push_back((RAMP - 1) * ambient + (1 - ambient) * sum / count);
  }
  if (r.nearest >= 0 && r.miss[r.nearest] <= OFF * OFF) {
    r.ramp = r.nearest;
    double least = std::sqrt(r.miss[r.nearest]), apart = steps.size() > EVEN_MOST ? APART_SHARED : APART;
    for (size_t k = 0; k < r.miss.size(); k++)
      if ((int)k != r.nearest && std::sqrt(r.miss[k]) <= least + apart) r.ramp = -1;
  }
  return known[key] = r;
}

int Ramps::shown(const uint8_t *rgb) const { return steps.empty() ? -1 : read(rgb).ramp; }

double Ramps::step(const uint8_t *rgb, int object) const {
  if (steps.empty()) return std::floor(rgb[0] * (RAMP - 1) / 255.0 + 0.5);
  const Reading &r = read(rgb);
  int k = of(object);
  const double apart = steps.size() > EVEN_MOST ? APART_SHARED : APART;
  if (k < 0 || std::sqrt(r.miss[k]) > std::sqrt(r.miss[r.nearest]) + apart) k = r.nearest;
  return r.step[k];
}

void Ramps::paint(int object, double brightness, uint8_t *rgb) const {
  int k = of(object);
  double light = k < 0 ? brightness : ambient < 1 ? (brightness - ambient * (RAMP - 1)) / (1 - ambient) : RAMP - 1;
  int step = std::min(std::max((int)std::floor(light + 0.5), 0), RAMP - 1);
  if (k >= 0) std::copy_n(steps[k].rgb[step], 3, rgb);
  else std::fill_n(rgb, 3, eight(step));
}

namespace {

// Returns whether all of the 3 by 3 pixels show the surface and, if `calm`, their depths differ by at most BEHIND.
bool whole(const Picture &t, int column, int row, bool calm) {
  double least = 1e300, most = -1e300;
  for (int y = -1; y <= 1; y++)
    for (int x = -1; x <= 1; x++) {
      const Hit &h = t.at(column + x, row + y);
      if (!h.any()) return false;
      least = std::min(least, h.depth);
      most = std::max(most, h.depth);
    }
  return !calm || most - least <= BEHIND;
}

// Returns whether there is surface within two rows and columns and within a squared distance of `limit` pixels.
bool surfaceNear(const Picture &t, int column, int row, int limit) {
  for (int y = -2; y <= 2; y++)
    for (int x = -2; x <= 2; x++)
      if (x * x + y * y <= limit && t.at(column + x, row + y).any()) return true;
  return false;
}

// Returns whether there is surface and the pixel's colour tells its object. Stores the ramps by drawn colour and by truth.
bool coloured(const Frame &f, const Picture &t, const Ramps &ramps, int column, int row, int &drawn, int &truly) {
  const Hit &h = t.at(column, row);
  if (!h.any() || h.tied || !f.drawn(column, row)) return false;
  drawn = ramps.shown(f.pixel(column, row)), truly = ramps.of(h.object);
  return drawn >= 0 && truly >= 0;
}

// Returns whether the ramp is the true one of the pixel or of a pixel right above, below or beside it.
bool rampNear(const Picture &t, const Ramps &ramps, int column, int row, int ramp) {
  const int x[] = {0, 1, -1, 0, 0}, y[] = {0, 0, 0, 1, -1};
  for (int k = 0; k < 5; k++) {
    const Hit &h = t.at(column + x[k], row + y[k]);
    if (h.any() && ramps.of(h.object) == ramp) return true;
  }
  return false;
}

// Returns the brightness of a drawn pixel in ramp steps. In a painted scene the colour is compared with the true points of
// the pixel and its four neighbours, and the nearest one counts; `miss` receives its distance.
double brightness(const Ramps &ramps, const uint8_t *rgb, const Picture &t, int column, int row, double *miss = nullptr) {
  double least, step = ramps.step(rgb, t.at(column, row), &least);
  const int x[] = {1, -1, 0, 0}, y[] = {0, 0, 1, -1};
  for (int k = 0; ramps.painted() && k < 4; k++) {
    const Hit &h = t.at(column + x[k], row + y[k]);
    double off, there = ramps.step(rgb, h, &off);
    if (h.any() && off < least) least = off, step = there;
  }
  if (miss) *miss = least;
  return step;
}

// Tells whether there is a border between a pixel and its right (dx = 1) or lower (dy = 1) neighbour, as drawn and in truth.
void borders(const Frame &f, const Picture &t, const Ramps &ramps, int column, int row, int dx, int dy, bool &drawn,
             bool &truly) {
  int d0, t0, d1, t1;
  bool both = column + dx < WIDTH && row + dy < HEIGHT && coloured(f, t, ramps, column, row, d0, t0) &&
              coloured(f, t, ramps, column + dx, row + dy, d1, t1);
  drawn = both && d0 != d1, truly = both && t0 != t1;
}

double rms(double sum, long n) { return n ? std::sqrt(sum / n) : 0; }
double share(long part, long of) { return of ? 100.0 * part / of : 0; }

}  // namespace

void Figures::add(const Figures &o) {
  long Figures::*const counts[] = {
      &Figures::frames, &Figures::eyeInside, &Figures::surface, &Figures::drawn,
      &Figures::interior, &Figures::holes, &Figures::seeThrough,
      &Figures::outside, &Figures::outsideBox, &Figures::missing, &Figures::both,
      &Figures::smooth, &Figures::shaded, &Figures::coloured, &Figures::wrongColour,
      &Figures::borderTrue, &Figures::border, &Figures::pairs, &Figures::flickerBase,
      &Figures::flicker, &Figures::flickerEdge};
  for (auto m : counts) this->*m += o.*m;
  depth2 += o.depth2;
  smooth2 += o.smooth2;
  shade2 += o.shade2;
}

double Figures::depthRms() const { return rms(depth2, both); }
double Figures::smoothRms() const { return rms(smooth2, smooth); }
double Figures::shadeRms() const { return rms(shade2, shaded); }
double Figures::colourShare() const { return share(wrongColour, drawn); }
double Figures::borderRatio() const { return borderTrue ? (double)border / borderTrue : 0; }
double Figures::seeThroughShare() const { return share(seeThrough, interior); }
double Figures::outsideShare() const { return share(outside, drawn); }
double Figures::outsideBoxShare() const { return share(outsideBox, drawn); }
double Figures::flickerShare() const { return share(flicker, flickerBase); }
double Figures::flickerEdgeShare() const { return share(flickerEdge, flickerBase); }

Figures compare(const Frame &f, const Picture &t) {
  Figures r;
  r.frames = 1;
  if (t.eyeInside) {
    r.eyeInside = 1;
    return r;
  }
  const Ramps ramps(f.scene);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      const Hit &h = t.at(x, y);
      bool drawn = f.drawn(x, y);
      r.drawn += drawn;
      if (!h.any()) {
        if (drawn && !surfaceNear(t, x, y, 4)) {
          r.outside++;
          if (!surfaceNear(t, x, y, 8)) r.outsideBox++;
        }
        continue;
      }
      r.surface++;
      bool interior = whole(t, x, y, false);
      r.interior += interior;
      if (!drawn) {
        r.missing++;
        r.holes += interior;
        continue;
      }
      double error = f.depth(x, y) - h.depth;
      if (interior && error > BEHIND) r.seeThrough++;
      r.both++;
      r.depth2 += error * error;
      if (whole(t, x, y, true)) {
        r.smooth++;
        r.smooth2 += error * error;
      }
      double miss = 0;
      if (f.shaded()) {
        double e = (brightness(ramps, f.pixel(x, y), t, x, y, &miss) - h.shade) * f.scene.lightSteps();
        r.shaded++;
        r.shade2 += e * e;
      }
      if (ramps.painted()) {
        r.coloured++;
        r.wrongColour += !h.tied && miss > OFF_PAINTED;
        continue;
      }
      int shown, truly;
      if (!coloured(f, t, ramps, x, y, shown, truly)) continue;
      r.coloured++;
      r.wrongColour += !rampNear(t, ramps, x, y, shown);
      for (int k = 0; k < 2; k++) {
        bool ours, real;
        borders(f, t, ramps, x, y, k == 0, k == 1, ours, real);
        r.border += ours, r.borderTrue += real;
      }
    }
  return r;
}

void compareFlicker(const Frame &before, const Picture &beforeTruth,
                    const Frame &after, const Picture &afterTruth, Figures &r) {
  double dt = after.scene.time - before.scene.time;
  if (!(dt > 0 && dt <= PAIR) || !before.shaded() || !after.shaded()) return;
  if (beforeTruth.eyeInside || afterTruth.eyeInside) return;
  r.pairs++;
  const Ramps ramps0(before.scene), ramps1(after.scene);
  const double steps = after.scene.lightSteps(), jump = RAMP / 4.0 / steps, still = RAMP / 16.0 / steps;
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      bool d0 = before.drawn(x, y), d1 = after.drawn(x, y);
      const Hit &h0 = beforeTruth.at(x, y), &h1 = afterTruth.at(x, y);
      r.flickerBase += d1;
      if (!d0 && !d1) continue;
      double s0 = d0 ? brightness(ramps0, before.pixel(x, y), beforeTruth, x, y) : 0;
      double s1 = d1 ? brightness(ramps1, after.pixel(x, y), afterTruth, x, y) : 0;
      double t0 = h0.any() ? h0.shade : 0, t1 = h1.any() ? h1.shade : 0;
      if (std::fabs(s1 - s0) <= jump || std::fabs(t1 - t0) >= still) continue;
      r.flickerEdge++;
      if (d0 && d1 && h0.any() && h1.any()) r.flicker++;
    }
}

void drawTruth(const Scene &s, const Picture &t, Frame &f) {
  f.scene = s;
  f.rgb.assign(WIDTH * HEIGHT * 3, 0);
  f.z.assign(WIDTH * HEIGHT, EMPTY);
  f.grey = s.ramps.empty();
  const Ramps ramps(s);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      const Hit &h = t.at(x, y);
      if (!h.any()) continue;
      f.z[y * WIDTH + x] = (int32_t)std::floor(std::min(h.depth, 32767.0) * 65536 + 0.5);
      ramps.paint(h, &f.rgb[3 * (y * WIDTH + x)]);
    }
}

std::vector<uint8_t> sheet(const Frame &f, const Picture &t) {
  const Ramps ramps(f.scene);
  std::vector<uint8_t> out(SHEET_WIDTH * HEIGHT * 3, 64);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      uint8_t *ours = &out[3 * (y * SHEET_WIDTH + x)];
      uint8_t *ideal = ours + 3 * (WIDTH + 4), *gap = ideal + 3 * (WIDTH + 4);
      const Hit &h = t.at(x, y);
      bool drawn = f.drawn(x, y);
      std::copy_n(&f.rgb[3 * (y * WIDTH + x)], 3, ours);
      std::fill_n(ideal, 3, 0);
      if (h.any()) ramps.paint(h, ideal);
      auto paint = [&](int r, int g, int b) {
        gap[0] = (uint8_t)r, gap[1] = (uint8_t)g, gap[2] = (uint8_t)b;
      };
      paint(0, 0, 0);
      if (!h.any()) {
        if (drawn) surfaceNear(t, x, y, 4) ? paint(96, 96, 0) : paint(255, 255, 0);
      } else if (!drawn) {
        whole(t, x, y, false) ? paint(255, 0, 0) : paint(0, 0, 160);
      } else {
        double error = f.depth(x, y) - h.depth, miss;
        const double step = brightness(ramps, f.pixel(x, y), t, x, y, &miss);
        int shown, truly;
        bool stray = false;
        for (int k = 0; !ramps.painted() && k < 2; k++) {
          bool mine, real;
          borders(f, t, ramps, x, y, k == 0, k == 1, mine, real);
          stray = stray || (mine && !real);
        }
        if (error > BEHIND && whole(t, x, y, false)) {
          paint(255, 0, 255);
        } else if (ramps.painted() ? miss > OFF_PAINTED
                                   : coloured(f, t, ramps, x, y, shown, truly) && !rampNear(t, ramps, x, y, shown)) {
          paint(0, 255, 255);
        } else if (stray) {
          paint(0, 128, 0);
        } else {
          double e = f.shaded() ? std::fabs(step - h.shade) * 4
                                : std::fabs(error) * 32;
          int grey = (int)std::min(e, 255.0);
          paint(grey, grey, grey);
        }
      }
    }
  return out;
}

}  // namespace truth
