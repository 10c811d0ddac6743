// A dumped frame held against its truth: the figures and the pictures.
//
// This file exists to be the one definition of what counts as a hole, as
// see-through, as outside, as an error and as flicker.
#include "truth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace truth {

// The DAC has six bits a channel, so a grey's ramp step is its DAC value. In
// colour the step is the multiple of a ramp's colour that comes nearest.
double Frame::step(int column, int row, int object) const {
  const uint8_t *p = &rgb[3 * (row * WIDTH + column)];
  if (scene.ramps.empty()) return std::floor(p[0] * (RAMP - 1) / 255.0 + 0.5);
  // The true object's own ramp is taken if it explains the pixel to within
  // the six bits; dark pixels fit any ramp.
  const double same = 3 * 4.0 * 4.0;
  double best = 1e300, step = 0;
  for (const auto &r : scene.ramps) {
    const Colour &c = r.second;
    double k = (p[0] * c.r + p[1] * c.g + p[2] * c.b) / (c.r * c.r + c.g * c.g + c.b * c.b);
    double dr = p[0] - k * c.r, dg = p[1] - k * c.g, db = p[2] - k * c.b;
    double miss = dr * dr + dg * dg + db * db;
    if (object >= 0 && scene.objects[object].number == r.first && miss <= same) miss = -1;
    if (miss < best) best = miss, step = k * (RAMP - 1);
  }
  return step;
}

namespace {

// The darkest and the brightest of DAC values seen as 8 bits.
uint8_t dac(double full, double step) {
  int six = (int)std::floor(full / 255 * step + 0.5);
  six = std::min(std::max(six, 0), 63);
  return (uint8_t)(six << 2 | six >> 4);
}

// All of the 3 by 3 pixels show the surface, without a jump of more than
// BEHIND in depth between them if `calm`.
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

// Some surface no further away than `limit` (squared pixels) within two rows
// and columns.
bool surfaceNear(const Picture &t, int column, int row, int limit) {
  for (int y = -2; y <= 2; y++)
    for (int x = -2; x <= 2; x++)
      if (x * x + y * y <= limit && t.at(column + x, row + y).any()) return true;
  return false;
}

double rms(double sum, long n) { return n ? std::sqrt(sum / n) : 0; }
double share(long part, long of) { return of ? 100.0 * part / of : 0; }

}  // namespace

void Figures::add(const Figures &o) {
  long Figures::*const counts[] = {
      &Figures::frames, &Figures::eyeInside, &Figures::surface, &Figures::drawn,
      &Figures::interior, &Figures::holes, &Figures::seeThrough,
      &Figures::outside, &Figures::outsideBox, &Figures::missing, &Figures::both,
      &Figures::smooth, &Figures::shaded, &Figures::pairs, &Figures::flickerBase,
      &Figures::flicker, &Figures::flickerEdge};
  for (auto m : counts) this->*m += o.*m;
  depth2 += o.depth2;
  smooth2 += o.smooth2;
  shade2 += o.shade2;
}

double Figures::depthRms() const { return rms(depth2, both); }
double Figures::smoothRms() const { return rms(smooth2, smooth); }
double Figures::shadeRms() const { return rms(shade2, shaded); }
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
      if (f.shaded()) {
        double e = f.step(x, y, h.object) - h.shade;
        r.shaded++;
        r.shade2 += e * e;
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
  const double jump = RAMP / 4.0, still = RAMP / 16.0;
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      bool d0 = before.drawn(x, y), d1 = after.drawn(x, y);
      const Hit &h0 = beforeTruth.at(x, y), &h1 = afterTruth.at(x, y);
      r.flickerBase += d1;
      if (!d0 && !d1) continue;
      double s0 = d0 ? before.step(x, y, h0.object) : 0;
      double s1 = d1 ? after.step(x, y, h1.object) : 0;
      double t0 = h0.any() ? h0.shade : 0, t1 = h1.any() ? h1.shade : 0;
      if (std::fabs(s1 - s0) <= jump || std::fabs(t1 - t0) >= still) continue;
      r.flickerEdge++;
      if (d0 && d1 && h0.any() && h1.any()) r.flicker++;
    }
}

namespace {

void putTruth(const Scene &s, const Hit &h, uint8_t *p) {
  double step = std::floor(h.shade + 0.5);
  Colour full{255, 255, 255};
  if (!s.ramps.empty()) {
    auto ramp = s.ramps.find(h.object < 0 ? -1 : s.objects[h.object].number);
    if (ramp != s.ramps.end()) full = ramp->second;
  }
  p[0] = dac(full.r, step);
  p[1] = dac(full.g, step);
  p[2] = dac(full.b, step);
}

}  // namespace

void drawTruth(const Scene &s, const Picture &t, Frame &f) {
  f.scene = s;
  f.rgb.assign(WIDTH * HEIGHT * 3, 0);
  f.z.assign(WIDTH * HEIGHT, EMPTY);
  f.grey = s.ramps.empty();
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      const Hit &h = t.at(x, y);
      if (!h.any()) continue;
      f.z[y * WIDTH + x] = (int32_t)std::floor(std::min(h.depth, 32767.0) * 65536 + 0.5);
      putTruth(s, h, &f.rgb[3 * (y * WIDTH + x)]);
    }
}

std::vector<uint8_t> sheet(const Frame &f, const Picture &t) {
  std::vector<uint8_t> out(SHEET_WIDTH * HEIGHT * 3, 64);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++) {
      uint8_t *ours = &out[3 * (y * SHEET_WIDTH + x)];
      uint8_t *ideal = ours + 3 * (WIDTH + 4), *gap = ideal + 3 * (WIDTH + 4);
      const Hit &h = t.at(x, y);
      bool drawn = f.drawn(x, y);
      std::copy_n(&f.rgb[3 * (y * WIDTH + x)], 3, ours);
      std::fill_n(ideal, 3, 0);
      if (h.any()) putTruth(f.scene, h, ideal);
      auto paint = [&](int r, int g, int b) {
        gap[0] = (uint8_t)r, gap[1] = (uint8_t)g, gap[2] = (uint8_t)b;
      };
      paint(0, 0, 0);
      if (!h.any()) {
        if (drawn) surfaceNear(t, x, y, 4) ? paint(96, 96, 0) : paint(255, 255, 0);
      } else if (!drawn) {
        whole(t, x, y, false) ? paint(255, 0, 0) : paint(0, 0, 160);
      } else {
        double error = f.depth(x, y) - h.depth;
        if (error > BEHIND && whole(t, x, y, false)) {
          paint(255, 0, 255);
        } else {
          double e = f.shaded() ? std::fabs(f.step(x, y, h.object) - h.shade) * 4
                                : std::fabs(error) * 32;
          int grey = (int)std::min(e, 255.0);
          paint(grey, grey, grey);
        }
      }
    }
  return out;
}

}  // namespace truth
