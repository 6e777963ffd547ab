// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Second-order interactions of all pairs of waves: any directions, any depth.

#include <cstddef>
#include <span>
#include <vector>

#include "sim/sea/wave_component.h"

namespace seaglint {

// Second-order part of the surface at one point and time.
struct SecondOrder {
  double elevation = 0;  // m
  Vec2 slope = Vec2::Zero();
  double elevation_t = 0;        // d elevation / dt, m/s
  double elevation_tt = 0;       // m/s^2
  Vec2 velocity = Vec2::Zero();  // gradient of the second-order potential at the mean level, m/s
};

// Sums and differences of all pairs, with kernels computed once (Sharma and Dean 1981; see second_order.cpp). Memory
// and evaluation time are quadratic in the number of components.
class PairInteractions {
 public:
  static constexpr std::size_t kMaxComponents = 2048;  // 134 MB of kernels

  // Components of one depth, at most kMaxComponents.
  PairInteractions(std::span<const WaveComponent> components, double depth);

  // cosine, sine: a cos and a sin of the angle w t - k.x + phase of each component. The components are those of the
  // constructor, possibly with other amplitudes. Without motion the last three fields remain 0.
  SecondOrder evaluate(std::span<const WaveComponent> components, std::span<const double> cosine,
                       std::span<const double> sine, bool motion) const;

  // Third cumulant of the elevation to leading order, m^3.
  double third_cumulant(std::span<const WaveComponent> components) const;

  std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
  std::size_t stride_ = 0;  // of a column: size_ rounded up to kLanes
  // B+ + B-, B+ - B-, P+ + P-, P+ - P- of all pairs, column by column.
  std::vector<double> elevation_even_, elevation_odd_, potential_even_, potential_odd_;
};

}  // namespace seaglint
