// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/simulate.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"
#include "sim/motion/ship/ship.h"
#include "sim/motion/ship/ship_particulars.h"

namespace seaglint {

Vec3 rest_position(const MotionSpec& spec, double x, double y) {
  return {x, y, spec.model == MotionModel::kFloat ? spec.origin_above_waterline_m : 0.0};
}

Trajectory simulate_motion(const Body& body, const Vec3& rest_position, const WaveField& sea, double duration_s,
                           std::uint64_t seed, std::uint64_t index) {
  SEAGLINT_CHECK(duration_s >= 0 && std::isfinite(duration_s), fmt::format("duration {} s", duration_s));
  const double x = rest_position.x();
  const double y = rest_position.y();
  std::vector<MotionSample> samples;
  if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) {
    samples = simulate_ship(*ship, body.spec, sea, x, y, duration_s);
  } else if (const auto* raft = std::get_if<FloatParticulars>(&body.model)) {
    samples = simulate_float(*raft, body.spec, sea, x, y, duration_s, seed, index);
  } else if (const auto* table = std::get_if<RaoTable>(&body.model)) {
    samples = simulate_rao(*table, body.spec, sea, x, y, duration_s);
  } else if (const auto* series = std::get_if<AttitudeSeries>(&body.model)) {
    return trajectory_of(*series, body.spec.series_start_s, duration_s, body.spec.translations, rest_position,
                         body.rotation_centre);
  } else {
    return Trajectory::at_rest(rest_position);
  }
  return Trajectory(0, body.spec.step_s, std::move(samples), rest_position, body.rotation_centre);
}

}  // namespace seaglint
