// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One plane wave of the sea, the surface at one point, and the second-order interactions of all pairs of waves: any
// directions and depth, or in closed form.

#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/numbers/dispersion.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

// a cos(w t - k d.x + phase), d the unit vector of its propagation direction.
struct WaveComponent {
  double omega = 0;       // rad/s
  double amplitude = 0;   // m
  double phase = 0;       // rad, at x = 0, t = 0
  double wavenumber = 0;  // rad/m, by the dispersion relation at the depth
  Vec2 direction{1, 0};   // of propagation, unit vector, in T
};

// Quantities to evaluate: elevation and slopes, or also the motion of the water.
enum class SurfaceQuantities { kElevationAndSlope, kKinematics };

// Surface quantities to the order of the field. Velocity and acceleration: at the mean level for order 1; for order 2
// at the moving surface, velocity = u1 + eta1 du1/dz + u2, acceleration of the water particle there (du/dt + u.grad u).
struct SurfaceState {
  double elevation = 0;         // m
  double elevation_linear = 0;  // m
  double slope_x = 0;           // d eta / dx
  double slope_y = 0;
  Vec3 velocity = Vec3::Zero();      // m/s; NaN for kElevationAndSlope
  Vec3 acceleration = Vec3::Zero();  // m/s^2; likewise
};

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

// The surface of waves of one direction in deep water: the double sums reduce to running sums, exact in O(N). cosine,
// sine: of the phase angle of each component; the first `quadratic` components, ascending in omega, enter the quadratic
// sums.
SurfaceState long_crested_surface(std::span<const WaveComponent> components, std::span<const double> cosine,
                                  std::span<const double> sine, std::size_t quadratic, SurfaceQuantities detail);

}  // namespace seaglint
