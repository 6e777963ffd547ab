// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Responses of a body to one wave; its motion time series, the sum of its responses to all waves of a sea; and tables
// of responses computed by other programs, in the conventions of this project.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/strip_theory/strip_theory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Response amplitude operators, rad/m and m/m, in the time factor e^{j w_e t} of the encounter frequency; translations
// of the rotation centre. The phase reference is the elevation at the ship's origin.
struct MotionRao {
  Complex surge, sway, heave, roll, pitch, yaw;
};

MotionRao operator+(const MotionRao& a, const MotionRao& b);
MotionRao scaled(const MotionRao& rao, Complex translations, Complex rotations);

// The same per channel: roll, pitch, yaw (rad/m), surge, sway, heave (m/m) and one channel chosen by the caller.
enum class ResponseChannel { kRoll, kPitch, kYaw, kSurge, kSway, kHeave, kExtra };
inline constexpr std::size_t kResponseChannels = 7;
using ResponseChannels = std::array<Complex, kResponseChannels>;

// Encounter frequency w_e = w - U k cos(mu) of a ship of speed U (m/s), rad/s; negative when it overtakes the wave.
double encounter_frequency(const ShipWave& wave, double speed);

// At t = start + n step, of a body at (x, y) at t = 0 that moves along x at `speed`, m/s. Waves below 1e-9 of the
// largest contribution to every channel are skipped.
class ResponseSynthesis {
 public:
  ResponseSynthesis(const WaveField& sea, const std::function<ResponseChannels(const ShipWave&)>& response,
                    double speed, double x, double y, double start, double step);

  // Samples at 0, step, ..., at least up to duration_s.
  std::vector<MotionSample> samples(double duration_s);

  double value(ResponseChannel channel) const;
  double rate(ResponseChannel channel) const;  // its time derivative
  void advance() { phasors_.advance(); }

 private:
  UniformPhasors make(const WaveField& sea, const std::function<ResponseChannels(const ShipWave&)>& response,
                      double speed, double x, double y, double start, double step);

  MotionSample sample() const;

  struct Parts {
    std::vector<double> real, imaginary;
  };
  double step_ = 0;
  std::vector<double> omega_;
  std::array<Parts, kResponseChannels> parts_;
  std::array<bool, kResponseChannels> moves_{};  // channels that are not zero
  UniformPhasors phasors_;
};

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
