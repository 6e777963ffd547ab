// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lattice of look directions in body axes, for traces that many intervals share.

#include <array>
#include <compare>
#include <cstdint>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Direction of the lattice: on a circle of equal elevation, divided into equal azimuths.
struct LatticeDirection {
  std::int32_t circle = 0;   // of elevation circle * step
  std::int32_t azimuth = 0;  // 0 <= azimuth < number of azimuths on the circle

  auto operator<=>(const LatticeDirection&) const = default;
};

// Directions at distances of at most step_rad along and between circles of elevation, the same for every body.
class DirectionLattice {
 public:
  explicit DirectionLattice(double step_rad) : step_rad_(step_rad) {}  // 1e-6 <= step_rad <= 0.1

  struct Weighted {
    LatticeDirection direction;
    double weight = 0;
  };
  // The four directions around a unit vector, two on the circle below and two on the one above, with the weights of
  // linear interpolation in azimuth and in elevation: at least 0, sum 1.
  std::array<Weighted, 4> around(const Vec3& direction) const;

  Vec3 vector(const LatticeDirection& direction) const;  // unit

 private:
  double elevation_rad(std::int32_t circle) const;
  std::int32_t azimuths(std::int32_t circle) const;  // at least 1

  double step_rad_;
};

}  // namespace seaglint
