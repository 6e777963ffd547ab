// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/grazing_reflection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"

namespace seaglint {
namespace {

// Sine of the angle over a mirror up to which it is grazed, 2 to 6 deg. What its rim sends to the next mirror fades
// alike, since that stands in the zone which the beam, the wave beside it and what the rim diffracts share: all go over
// into wall_penumbra.h together.
constexpr std::array<double, 2> kGrazing{0.035, 0.11};
// Length of a mirror along the way, beside the height of the other over it, from which it reaches far enough to show
// that one's image.
constexpr std::array<double, 2> kReaches{1, 2};
// Cosines between normals of parallel mirrors, and of a wall, that leans by less than 49 deg, and what it stands on.
constexpr double kParallel = 1 - 1e-9, kSteep = 0.75;

// Whether one is a wall on the other.
bool stands_on(const GrazedMirror& wall, const GrazedMirror& mirror) {
  return std::abs(mirror.normal.dot(wall.normal)) < kSteep;
}

double extent(std::span<const Vec3> outline, const Vec3& along) {
  const auto [least, most] = std::ranges::minmax(outline, {}, [&](const Vec3& x) { return along.dot(x); });
  return along.dot(most - least);
}

// How much of the other's image a mirror that a way out along r grazes has room for, 0 to 1.
double reaches(const Vec3& r, const GrazedMirror& mirror, const GrazedMirror& other) {
  const Vec3 way = (r - mirror.normal.dot(r) * mirror.normal).normalized();
  return 1 - fading(extent(mirror.outline, way) / extent(other.outline, mirror.normal), kReaches);
}

// What a way that ends by one mirror leaves to the same one run backwards, that ends by the other.
double left(const Vec3& r, const GrazedMirror& by, const GrazedMirror& to) {
  const double share = stands_on(to, by) ? grazes(r, by.normal) * (1 - grazes(r, to.normal)) : 0;
  return share > 0 ? share * reaches(r, by, to) : 0;
}

}  // namespace

double grazes(double sine) { return fading(std::abs(sine), kGrazing); }

double grazes(const Vec3& s, const Vec3& n) { return grazes(n.dot(s)); }

double share_of_two(const Vec3& r, const GrazedMirror& first, const GrazedMirror& last) {
  return 1 - left(r, last, first) + left(r, first, last);
}

double share_of_more(const Vec3& r, const GrazedMirror& first, const GrazedMirror& before, const GrazedMirror& last) {
  const bool comes_back = std::abs(first.normal.dot(last.normal)) > kParallel && stands_on(before, last);
  return comes_back ? 1 - share_by_image(r, last, before) : share_of_two(r, first, last);
}

double share_by_image(const Vec3& r, const GrazedMirror& mirror, const GrazedMirror& wall) {
  const double share = stands_on(wall, mirror) ? grazes(r, mirror.normal) : 0;
  return share > 0 ? share * reaches(r, mirror, wall) : 0;
}

void give_share(double share, Footprint& footprint) {
  const double there = std::min(share, 1.0), back = share - there;
  const auto [hh, hv, vh, vv] = footprint.pattern;
  footprint.pattern = {there * hh + back * hh, there * hv + back * vh, there * vh + back * hv, there * vv + back * vv};
}

}  // namespace seaglint
