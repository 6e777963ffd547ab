// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Response amplitude operators computed by other programs, turned into this project's conventions.

#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/ship_response.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// For one speed: responses at every heading and frequency of the table, heading slowest. Rad/m and m/m, phase reference
// the elevation at the body's origin, time factor e^{j w_e t}.
class RaoTable {
 public:
  // mu in rad, ascending within (-pi, pi]; omega (of the wave, not of the encounter) in rad/s, ascending, > 0. Both
  // with at least one value; `reference` is the point whose translations are told, in the body's frame.
  RaoTable(std::string source, std::vector<double> mu, std::vector<double> omega, std::vector<MotionRao> responses,
           Vec3 reference, double speed);

  // Linear in frequency and heading, about the reference point. Zero at frequencies outside of the table's.
  // Throws InputError for a heading in a gap of more than 45 deg.
  MotionRao at(double omega, double wavenumber, double mu) const;

  // Share of the variance of the sea's elevation that the table's frequencies do not cover.
  double uncovered_variance_fraction(const WaveField& sea) const;

  const std::vector<double>& headings() const { return mu_; }
  const std::vector<double>& omegas() const { return omega_; }
  const Vec3& reference() const { return reference_; }
  double speed() const { return speed_; }
  const std::string& source() const { return source_; }

 private:
  std::string source_;
  std::vector<double> mu_, omega_;
  std::vector<MotionRao> responses_;
  Vec3 reference_;
  double speed_;
};

// The largest share of the waves' variance that may lie outside of a table's frequencies.
inline constexpr double kMaxUncoveredVariance = 0.01;

// Samples at t = 0, step, ... of a body that moves as the table says; its translations are those of the reference
// point. Throws InputError for a sea that the table does not cover.
std::vector<MotionSample> simulate_rao(const RaoTable& table, const MotionSpec& spec, const WaveField& sea, double x,
                                       double y, double duration_s);

}  // namespace seaglint
