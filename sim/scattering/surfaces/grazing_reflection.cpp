// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/grazing_reflection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"

namespace seaglint {
namespace {

// Sine of the grazing angle, 2 to 6 deg, over which the treatment is tapered. The field that the reflector's edge
// diffracts to the next reflector has the same taper: the beam, the direct wave and the diffracted wave overlap there,
// and wall_penumbra.h replaces all three.
constexpr std::array<double, 2> kGrazingTaper{0.035, 0.11};
// Length of a reflector along the path relative to the height of the other one over it, from which on it contains the
// image.
constexpr std::array<double, 2> kCoverageTaper{1, 2};
// Cosine between the normals of parallel reflectors, and of a wall (lean below 49 deg) and the reflector it stands on.
constexpr double kParallel = 1 - 1e-9, kMaxWallCosine = 0.75;

// True when the first panel is a wall on the second.
bool is_wall_on(const ReflectorPanel& wall, const ReflectorPanel& reflector) {
  return std::abs(reflector.normal.dot(wall.normal)) < kMaxWallCosine;
}

double extent(std::span<const Vec3> outline, const Vec3& along) {
  const auto [min, max] = std::ranges::minmax(outline, {}, [&](const Vec3& x) { return along.dot(x); });
  return along.dot(max - min);
}

// Fraction 0..1 of the other panel's image that a reflector at grazing incidence contains, for an exit direction r.
double image_coverage(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& other) {
  const Vec3 way = (r - reflector.normal.dot(r) * reflector.normal).normalized();
  return 1 - smooth_taper(extent(reflector.outline, way) / extent(other.outline, reflector.normal), kCoverageTaper);
}

// Weight that a path ending on reflector `by` transfers to its reciprocal, which ends on `to`.
double reciprocal_weight(const Vec3& r, const ReflectorPanel& by, const ReflectorPanel& to) {
  const double share = is_wall_on(to, by) ? grazing_taper(r, by.normal) * (1 - grazing_taper(r, to.normal)) : 0;
  return share > 0 ? share * image_coverage(r, by, to) : 0;
}

}  // namespace

double grazing_taper(double sine) { return smooth_taper(std::abs(sine), kGrazingTaper); }

double grazing_taper(const Vec3& s, const Vec3& n) { return grazing_taper(n.dot(s)); }

double double_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& last) {
  return 1 - reciprocal_weight(r, last, first) + reciprocal_weight(r, first, last);
}

double multiple_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& before,
                              const ReflectorPanel& last) {
  const bool comes_back = std::abs(first.normal.dot(last.normal)) > kParallel && is_wall_on(before, last);
  return comes_back ? 1 - image_weight(r, last, before) : double_bounce_weight(r, first, last);
}

double image_weight(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& wall) {
  const double share = is_wall_on(wall, reflector) ? grazing_taper(r, reflector.normal) : 0;
  return share > 0 ? share * image_coverage(r, reflector, wall) : 0;
}

void weight_with_reciprocal(double share, Footprint& footprint) {
  const double there = std::min(share, 1.0), back = share - there;
  const auto [hh, hv, vh, vv] = footprint.pattern;
  footprint.pattern = {there * hh + back * hh, there * hv + back * vh, there * vh + back * hv, there * vv + back * vv};
}

}  // namespace seaglint
