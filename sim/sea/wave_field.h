// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea surface as a sum of plane waves to second order, at any point and time.
// eta1 = Re sum a e^{j(w t - k.x)} as in CONVENTIONS.md, so the angle here is minus the psi = k.x - w t + e of the
// literature.

#include <cstdint>
#include <vector>

#include "sim/core/linear.h"
#include "sim/core/random.h"
#include "sim/scenario/sea_spec.h"
#include "sim/sea/unit_phasors.h"

namespace seaglint {

// One linear component a cos(w t - k.x + phase), deep water, w^2 = g k.
struct WaveComponent {
  double omega = 0;       // rad/s
  double amplitude = 0;   // m
  double phase = 0;       // rad, at x = 0, t = 0
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
  // Components ascending in omega; direction of any length but zero; order 1 or 2. Components up to the cut-off enter
  // the quadratic sums of order 2.
  WaveField(std::vector<WaveComponent> components, Vec2 direction, int order, double second_order_cutoff_rad_s);

  // |w t| and |k.x| up to 2e8 rad; about 4 us for 512 components.
  SurfaceState surface(double x, double y, double t) const;

  // The field whose every amplitude is multiplied by gain(wavenumber), as a body's waterplane filters it.
  template <typename Gain>
  WaveField filtered(const Gain& gain) const {
    WaveField result = *this;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      result.components_[i].amplitude *= gain(components_[i].wavenumber);
    }
    return result;
  }

  const std::vector<WaveComponent>& components() const { return components_; }
  const Vec2& direction() const { return direction_; }
  int order() const { return order_; }
  std::size_t second_order_count() const { return second_order_count_; }

 private:
  friend class SurfaceSeries;

  std::vector<WaveComponent> components_;
  Vec2 direction_{1, 0};
  int order_ = 1;
  std::size_t second_order_count_ = 0;  // the first so many components enter the quadratic sums
};

// The surface at one fixed point at t = start + n step, n = 0, 1, 2, ...: what WaveField::surface gives, to 1e-12 of
// the significant wave height, at a third of its price. The field must outlive it.
class SurfaceSeries {
 public:
  SurfaceSeries(const WaveField& field, double x, double y, double start, double step);

  SurfaceState state() const;
  void advance() { phasors_.advance(); }

 private:
  const WaveField* field_;
  UniformPhasors phasors_;
};

// A realisation: components in strata uniform in omega from 0.4 wp to the cut-off, each at a random place of its
// stratum (so that nothing repeats) with the energy of its stratum and a random phase, then scaled so that sum a^2/2 =
// Hs^2/16. Streams kWaveFrequency and kWavePhase of (seed, index). Hs = 0 gives flat water. Throws InputError for a
// state that no sea can have: a cut-off at or below the peak, or waves steeper than breaking (Hs above 1/7 of the
// peak's wavelength).
WaveField realize_sea(const SeaState& state, std::uint64_t seed, std::uint64_t index);

// The index of a realisation of one of a scenario's sea states, both counted from 0, as data sets and commands use it;
// realisation below 1000000.
std::uint64_t realisation_index(std::size_t sea_state, std::size_t realisation);

// What a realisation holds and leaves out.
struct SeaSummary {
  double significant_wave_height_m = 0;  // 4 sqrt(sum a^2/2)
  double cutoff_rad_s = 0;
  double second_order_cutoff_rad_s = 0;  // infinite in flat water
  double energy_share_above_cutoff = 0;  // of the state's spectrum, added to the components below
  double slope_variance = 0;             // of the linear part; grows with the logarithm of the cut-off
  double skewness = 0;                   // of the elevation to leading order; 0 at order 1
};
SeaSummary summarize(const SeaState& state, const WaveField& field);

}  // namespace seaglint
