// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/fade_windows.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/real_functions.h"

namespace seaglint {

double fringe_forward_taper(const Vec3& k_hat, const Vec3& s) {
  return smooth_taper(k_hat.dot(s), kFringeForwardWindow);
}

double diffraction_forward_taper(const Vec3& k_hat, const Vec3& s) {
  return smooth_taper(k_hat.dot(s), kDiffractionForwardWindow);
}

double grazing_taper(const Vec3& s, const Vec3& n) { return smooth_taper(std::abs(n.dot(s)), kGrazingWindow); }

namespace {

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
  const Vec3 forward = (r - reflector.normal.dot(r) * reflector.normal).normalized();
  return 1 -
         smooth_taper(extent(reflector.outline, forward) / extent(other.outline, reflector.normal), kCoverageWindow);
}

// Weight that a path ending on reflector `by` transfers to its reciprocal, which ends on `to`.
double reciprocal_weight(const Vec3& r, const ReflectorPanel& by, const ReflectorPanel& to) {
  const double weight = is_wall_on(to, by) ? grazing_taper(r, by.normal) * (1 - grazing_taper(r, to.normal)) : 0;
  return weight > 0 ? weight * image_coverage(r, by, to) : 0;
}

}  // namespace

double double_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& last) {
  return 1 - reciprocal_weight(r, last, first) + reciprocal_weight(r, first, last);
}

double multiple_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& before,
                              const ReflectorPanel& last) {
  const bool comes_back = std::abs(first.normal.dot(last.normal)) > kParallel && is_wall_on(before, last);
  return comes_back ? 1 - image_weight(r, last, before) : double_bounce_weight(r, first, last);
}

double image_weight(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& wall) {
  const double weight = is_wall_on(wall, reflector) ? grazing_taper(r, reflector.normal) : 0;
  return weight > 0 ? weight * image_coverage(r, reflector, wall) : 0;
}

double beam_incidence_taper(const Vec3& beam, const Vec3& s, const Vec3& last) {
  const double lands = last.dot(s) * last.dot(beam) > 0 ? 1 - grazing_taper(beam, last) : 0,
               leaves = 1 - grazing_taper(s, last);
  return lands < leaves ? lands / leaves : 1;
}

double reflected_edge_weight(const Vec3& n, const Vec3& t, const Vec3& k_hat, const Vec3& s, const Vec3& last) {
  if (n.dot(k_hat) >= 0) return 0;
  return diffraction_forward_taper(k_hat, s) * (1 - grazing_taper(k_hat, n)) * (1 - grazing_taper(s, last)) *
         smooth_taper(std::abs(t.dot(s - k_hat)), kOffConeWindow);
}

PenumbraWeights penumbra_weights(double sine) {
  // Incident along k_hat on the face z = 0; the wall at x < 0 turns the exit path along s back to the radar.
  const double cosine = std::sqrt(1 - sine * sine);
  const Vec3 k_hat(-cosine, 0, -sine), s(-cosine, 0, sine), wall = Vec3::UnitX();
  return {1 - reflected_edge_weight(Vec3::UnitZ(), Vec3::UnitY(), k_hat, s, wall), 1 - grazing_wave_weight(k_hat, s)};
}

double grazing_wave_weight(const Vec3& k_hat, const Vec3& s) { return diffraction_forward_taper(k_hat, s); }

}  // namespace seaglint
