// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea surface as a sum of plane waves to second order, at any point and time.
// eta1 = Re sum a e^{j(w t - k.x)} as in CONVENTIONS.md, so the angle here is minus the psi = k.x - w t + e of the
// literature.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/unit_phasors.h"
#include "sim/scenario/sea_spec.h"
#include "sim/sea/second_order.h"
#include "sim/sea/wave_component.h"

namespace seaglint {

// What is asked of a surface: elevation and slopes, or the motion of the water too.
enum class SurfaceQuantities { kElevationAndSlope, kKinematics };

// To the field's order. Order 1 takes velocity and acceleration at the mean level, order 2 at the moving surface:
// velocity = u1 + eta1 du1/dz + u2, acceleration that of the water particle there (du/dt + u.grad u).
struct SurfaceState {
  double elevation = 0;         // m
  double elevation_linear = 0;  // m
  double slope_x = 0;           // d eta / dx
  double slope_y = 0;
  Vec3 velocity = Vec3::Zero();      // m/s; NaN when only the shape was asked for
  Vec3 acceleration = Vec3::Zero();  // m/s^2; likewise
};

// Waves of one direction in deep water cost O(N) per point and time at either order, others O(N^2) at order 2
// (PairInteractions).
class WaveField {
 public:
  WaveField() = default;  // flat water
  // Components ascending in omega, each of the depth's wavenumber; order 1 or 2. Components up to the cut-off enter the
  // quadratic sums of order 2: at most PairInteractions::kMaxComponents unless all travel one way in deep water.
  WaveField(std::vector<WaveComponent> components, int order, double second_order_cutoff_rad_s,
            double depth = kDeepWater);
  // The same with all components travelling towards `direction`, of any length but zero.
  WaveField(std::vector<WaveComponent> components, Vec2 direction, int order, double second_order_cutoff_rad_s,
            double depth = kDeepWater);

  // |w t| and |k.x| up to 2e8 rad; 512 components of one direction in deep water about 10 us.
  SurfaceState surface(double x, double y, double t, SurfaceQuantities detail = SurfaceQuantities::kKinematics) const;

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
  double depth() const { return depth_; }              // m, kDeepWater when infinite
  bool long_crested() const { return long_crested_; }  // all components travel one way
  int order() const { return order_; }
  std::size_t second_order_count() const { return second_order_count_; }

  // Third cumulant of the elevation at any place, to leading order, m^3: 3 E[eta1^2 eta2]. 0 at order 1.
  double third_cumulant() const;

 private:
  friend class SurfaceSeries;

  // From the cosines and sines of all components' angles.
  SurfaceState state(std::span<const double> cosine, std::span<const double> sine, SurfaceQuantities detail) const;

  std::vector<WaveComponent> components_;
  double depth_ = kDeepWater;
  bool long_crested_ = true;
  int order_ = 1;
  std::size_t second_order_count_ = 0;             // the first so many components enter the quadratic sums
  std::shared_ptr<const PairInteractions> pairs_;  // where the quadratic sums have no closed form
};

// The surface at one fixed point at t = start + n step, n = 0, 1, 2, ...: what WaveField::surface gives, to 1e-12 of
// the significant wave height, at 60 % of its price (a quarter for the shape alone). The field must outlive it.
class SurfaceSeries {
 public:
  SurfaceSeries(const WaveField& field, double x, double y, double start, double step,
                SurfaceQuantities detail = SurfaceQuantities::kKinematics);

  SurfaceState state() const { return field_->state(phasors_.cosine(), phasors_.sine(), detail_); }
  void advance() { phasors_.advance(); }

 private:
  const WaveField* field_;
  SurfaceQuantities detail_;
  UniformPhasors phasors_;
};

}  // namespace seaglint
