// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/line_of_sight.h"

#include "sim/core/numbers/rotation.h"

namespace seaglint {
namespace {

RadarBasis turned_to(const RadarBasis& basis, const Vec3& r) {
  const Mat3 turn = rotation_between(basis.r, r).matrix();
  return {r, turn * basis.h, turn * basis.v};
}

}  // namespace

double LineOfSight::path_advance(const PropagationPath& path, const Vec3& x, double range_m) const {
  const Vec3 &there = of(path.outbound_via_sea).r, &back = of(path.return_via_sea).r;
  if (range_m <= 0) return (there + back).dot(x);
  double sum = 0;
  // R - |R r - x|, free of cancellation.
  for (const Vec3& r : {there, back})
    sum += (2 * r.dot(x) - x.squaredNorm() / range_m) / (1 + (r - x / range_m).norm());
  return sum;
}

LineOfSight line_of_sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s) {
  RadarBasis radar = radar_basis(r_hat);
  if (!sampling.line_of_sight_rate.isZero(0)) {
    const Vec3 now = (r_hat + (time_s - sampling.pulse_time_s.front()) * sampling.line_of_sight_rate).normalized();
    radar = turned_to(radar, now);
  }
  return {radar, image_basis(radar)};
}

LineOfSight line_of_sight_from(const LineOfSight& origin, const Vec3& x, double range_m) {
  if (range_m <= 0) return origin;
  const auto seen = [&](const RadarBasis& basis) { return turned_to(basis, (basis.r - x / range_m).normalized()); };
  return {seen(origin.radar), seen(origin.image)};
}

}  // namespace seaglint
