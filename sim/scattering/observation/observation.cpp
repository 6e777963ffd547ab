// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/observation.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/process/error.h"

namespace seaglint {

BistaticGeometry monostatic(const RadarBasis& basis) { return {basis, basis, true}; }

BistaticGeometry bistatic(const RadarBasis& transmit, const RadarBasis& receive) { return {transmit, receive, false}; }

PathGradient interpolate(const PathGradient& a, const PathGradient& b, double s) {
  const auto mean = [s](const Vec3& from, const Vec3& to) -> Vec3 { return from + s * (to - from); };
  return {mean(a.transmit, b.transmit), mean(a.receive, b.receive), mean(a.transmit_slide, b.transmit_slide),
          mean(a.receive_slide, b.receive_slide)};
}

Observation observation_of(const Scatterer& scatterer, const BistaticGeometry& antennas, const RadarRange& radar) {
  RadarRange to_centre = radar;
  to_centre.origin += scatterer.centre();
  return {antennas, to_centre, direction_spread(scatterer, to_centre), scatterer.centre()};
}

double direction_spread(const Scatterer& scatterer, const RadarRange& radar) {
  if (radar.range_m <= 0) return 0;
  const double reach = scatterer.radius() + radar.origin.norm();
  check_wavefront_range(reach, radar.range_m);
  return reach / radar.range_m;
}

void check_wavefront_range(double reach_m, double range_m) {
  constexpr double kNearestRadii = 10;
  if (range_m > 0 && range_m < kNearestRadii * reach_m) {
    throw InputError(fmt::format("wavefront range {} m: must be at least ten times the target radius of {:.3g} m",
                                 range_m, reach_m));
  }
}

std::optional<std::size_t> exchanged_pair(std::span<const BistaticGeometry> pairs, std::size_t i) {
  const auto exchanged = std::ranges::find_if(pairs, [&](const BistaticGeometry& other) {
    return other.transmit == pairs[i].receive && other.receive == pairs[i].transmit;
  });
  if (exchanged == pairs.end()) return std::nullopt;
  return static_cast<std::size_t>(exchanged - pairs.begin());
}

ScatteringMatrix reciprocal_mean(const ScatteringMatrix& matrix, const ScatteringMatrix& exchanged) {
  const auto mean = [&](int i, int j) { return 0.5 * (matrix[i] + exchanged[j]); };
  return {mean(0, 0), mean(1, 2), mean(2, 1), mean(3, 3)};
}

}  // namespace seaglint
