// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Response amplitude operators computed by other programs, in the conventions of this project.

#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/response_series.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Responses at one speed for every heading and frequency of the table, heading slowest: rad/m and m/m, phase reference
// the elevation at the body origin, time factor e^{j w_e t}.
class RaoTable {
 public:
  // mu in rad, ascending within (-pi, pi]; omega (of the wave, not of the encounter) in rad/s, ascending, > 0. Both
  // with at least one value. reference: the point whose translations are given, body frame, m.
  RaoTable(std::string source, std::vector<double> mu, std::vector<double> omega, std::vector<MotionRao> responses,
           Vec3 reference, double speed);

  // Linear in frequency and heading, with the phase at the reference point; zero outside of the frequencies of the
  // table. Throws InputError for a heading in a gap of more than 45 deg.
  MotionRao at(double omega, double wavenumber, double mu) const;

  // Fraction of the variance of the sea elevation outside of the frequencies of the table.
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

// Maximum fraction of the wave variance outside of the frequencies of a table.
inline constexpr double kMaxUncoveredVariance = 0.01;

// Samples at t = 0, step, ... of a body that moves by the responses of the table; translations of the reference point.
// Throws InputError for a sea that the table does not cover.
std::vector<MotionSample> simulate_rao(const RaoTable& table, const MotionSpec& spec, const WaveField& sea, double x,
                                       double y, double duration_s);

}  // namespace seaglint
