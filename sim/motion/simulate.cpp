// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/simulate.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/error.h"
#include "sim/motion/float.h"
#include "sim/motion/ship.h"

namespace seaglint {

Vec3 rest_position(const MotionSpec& spec, double x, double y) {
  return {x, y, spec.model == MotionModel::kFloat ? spec.centre_above_water_m : 0.0};
}

Vec3 rotation_centre(const MotionSpec& spec, const Bounds& bounds) {
  if (spec.rotation_centre_m) {
    const auto& c = *spec.rotation_centre_m;
    return {c[0], c[1], c[2]};
  }
  if (spec.model == MotionModel::kShip) return {0, 0, ship_particulars(spec, bounds).centre_of_gravity};
  if (spec.model == MotionModel::kFloat) return {0, 0, -spec.centre_above_water_m};
  return Vec3::Zero();
}

Trajectory simulate_motion(const MotionSpec& spec, const Bounds& bounds, const Vec3& rest_position,
                           const WaveField& sea, double duration_s, std::uint64_t seed, std::uint64_t index) {
  SEAGLINT_CHECK(duration_s >= 0 && std::isfinite(duration_s), fmt::format("duration {} s", duration_s));
  if (spec.model == MotionModel::kFixed) return Trajectory::at_rest(rest_position);
  if (!(spec.step_s > 0)) throw InputError(fmt::format("motion.step_s: value {}: must be > 0", spec.step_s));
  if (!(spec.preroll_s >= 0)) throw InputError(fmt::format("motion.preroll_s: value {}: must be >= 0", spec.preroll_s));

  const double x = rest_position.x();
  const double y = rest_position.y();
  std::vector<MotionSample> samples =
      spec.model == MotionModel::kShip
          ? simulate_ship(ship_particulars(spec, bounds), spec, sea, x, y, duration_s)
          : simulate_float(float_particulars(spec, bounds), spec, sea, x, y, duration_s, seed, index);
  return Trajectory(0, spec.step_s, std::move(samples), rest_position, rotation_centre(spec, bounds));
}

}  // namespace seaglint
