// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea surface as a sum of plane waves to second order, at any point and time.
// eta1 = Re sum a e^{j(w t - k.x)} as in CONVENTIONS.md, so psi = k.x - w t + e there is minus our phase.

#include <cstdint>
#include <vector>

#include "sim/core/linear.h"
#include "sim/core/random.h"
#include "sim/scenario/sea_spec.h"

namespace seaglint {

// One linear component a cos(w t - k.x + phase), deep water, w^2 = g k; ascending omega.
struct WaveComponent {
  double omega = 0;      // rad/s
  double amplitude = 0;  // m
  double phase = 0;      // rad, at x = 0, t = 0
  double wavenumber = 0;  // rad/m
};

struct SurfaceState {
  double elevation = 0;         // m, to the field's order
  double elevation_linear = 0;  // m
  double slope_x = 0;           // d eta / dx, to the field's order
  double slope_y = 0;
  Vec3 velocity = Vec3::Zero();  // m/s, orbital velocity of the linear waves at the mean level
};

// Long-crested: all components travel towards `direction`.
class WaveField {
 public:
  WaveField() = default;  // flat water
  WaveField(std::vector<WaveComponent> components, Vec2 direction, int order, double second_order_cutoff_rad_s);

  SurfaceState surface(double x, double y, double t) const;
  // The linear part only; what rigid bodies much longer than the waves respond to.
  const std::vector<WaveComponent>& components() const { return components_; }
  const Vec2& direction() const { return direction_; }
  int order() const { return order_; }

 private:
  std::vector<WaveComponent> components_;
  Vec2 direction_{1, 0};
  int order_ = 1;
  std::size_t second_order_count_ = 0;  // the first so many components enter the quadratic sums
};

// A realisation: components in strata uniform in omega, jittered, random phase, scaled so that sum a^2/2 = Hs^2/16 exactly.
// Streams kWaveFrequency and kWavePhase of (seed, index).
WaveField realize_sea(const SeaState& state, std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint
