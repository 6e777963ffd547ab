// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/direction_lattice.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

double DirectionLattice::elevation_rad(std::int32_t circle) const {
  return std::clamp(step_rad_ * circle, -kPi / 2, kPi / 2);
}

std::int32_t DirectionLattice::azimuths(std::int32_t circle) const {
  return std::max(1, static_cast<std::int32_t>(std::ceil(2 * kPi * std::cos(elevation_rad(circle)) / step_rad_)));
}

std::array<DirectionLattice::Weighted, 4> DirectionLattice::around(const Vec3& direction) const {
  const double elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  const double turns = std::atan2(direction.y(), direction.x()) / (2 * kPi);
  const double lower = std::floor(elevation / step_rad_), above = elevation / step_rad_ - lower;
  std::array<Weighted, 4> weighted;
  for (const int up : {0, 1}) {
    const auto circle = static_cast<std::int32_t>(lower) + up;
    const std::int32_t count = azimuths(circle);
    const double before = std::floor(turns * count), beyond = turns * count - before;
    for (const int next : {0, 1}) {
      const auto azimuth = static_cast<std::int32_t>(before) + next;
      weighted[static_cast<std::size_t>(2 * up + next)] = {{circle, (azimuth % count + count) % count},
                                                           (up ? above : 1 - above) * (next ? beyond : 1 - beyond)};
    }
  }
  return weighted;
}

Vec3 DirectionLattice::vector(const LatticeDirection& direction) const {
  const double elevation = elevation_rad(direction.circle);
  const double azimuth = 2 * kPi * direction.azimuth / azimuths(direction.circle);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

}  // namespace seaglint
