// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea surface as a sum of plane waves to second order, at any point and time.
// eta1 = Re sum a e^{j(w t - k.x)} as in CONVENTIONS.md, so that the angle is minus psi = k.x - w t + e of the
// literature.

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/scenario/sea_spec.h"
#include "sim/sea/second_order.h"

namespace seaglint {

// Sum of plane waves. Cost per point and time: O(N) for waves of one direction in deep water and for order 1, else
// O(N^2) (PairInteractions).
class WaveField {
 public:
  WaveField() = default;  // flat water
  // Components ascending in omega, wavenumbers by the dispersion relation at the depth; order 1 or 2. Components up to
  // the cut-off enter the quadratic sums of order 2: at most PairInteractions::kMaxComponents, unless all have one
  // direction in deep water.
  WaveField(std::vector<WaveComponent> components, int order, double second_order_cutoff_rad_s,
            double depth = kDeepWater);

  // Valid for |w t| and |k.x| up to 2e8 rad. About 10 us for 512 components of one direction in deep water.
  SurfaceState surface(double x, double y, double t, SurfaceQuantities detail = SurfaceQuantities::kKinematics) const;

  // The field with every amplitude multiplied by gain(wavenumber), e.g. the filter of a body's waterplane.
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
  bool long_crested() const { return long_crested_; }  // all components have one direction
  int order() const { return order_; }
  std::size_t second_order_count() const { return second_order_count_; }

  // Third cumulant of the elevation at any point, to leading order, m^3: 3 E[eta1^2 eta2]. 0 at order 1.
  double third_cumulant() const;

 private:
  friend class SurfaceSeries;

  // Evaluation from the cosines and sines of the angles of all components.
  SurfaceState state(std::span<const double> cosine, std::span<const double> sine, SurfaceQuantities detail) const;

  std::vector<WaveComponent> components_;
  double depth_ = kDeepWater;
  bool long_crested_ = true;
  int order_ = 1;
  std::size_t second_order_count_ = 0;             // number of leading components in the quadratic sums
  std::shared_ptr<const PairInteractions> pairs_;  // null where the quadratic sums have a closed form
};

// The surface at one fixed point at t = start + n step, n = 0, 1, 2, ..., or along a line at one time: equal to
// WaveField::surface to 1e-12 of the significant wave height, at 60 % of its cost (a quarter for kElevationAndSlope).
// The field must outlive it.
class SurfaceSeries {
 public:
  SurfaceSeries(const WaveField& field, double x, double y, double start, double step,
                SurfaceQuantities detail = SurfaceQuantities::kKinematics);
  // At the points start + n step, m, at time t.
  static SurfaceSeries along_line(const WaveField& field, const Vec2& start, const Vec2& step, double t,
                                  SurfaceQuantities detail = SurfaceQuantities::kKinematics);

  SurfaceState state() const { return field_->state(phasors_.cosine(), phasors_.sine(), detail_); }
  void advance() { phasors_.advance(); }

 private:
  SurfaceSeries(const WaveField& field, UniformPhasors phasors, SurfaceQuantities detail)
      : field_(&field), detail_(detail), phasors_(std::move(phasors)) {}

  const WaveField* field_;
  SurfaceQuantities detail_;
  UniformPhasors phasors_;
};

}  // namespace seaglint
