// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Responses of a body to one wave, and its motion time series: the sum of its responses to all waves of a sea.

#include <array>
#include <functional>
#include <vector>

#include "sim/core/numbers/reproducible_functions.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/strip_theory/strip_theory.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Response amplitude operators, rad/m and m/m, in the time factor e^{j w_e t} of the encounter frequency; translations
// of the rotation centre. The phase reference is the elevation at the ship's origin.
struct MotionRao {
  Complex surge, sway, heave, roll, pitch, yaw;
};

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

  double value(ResponseChannel channel) const;
  double rate(ResponseChannel channel) const;  // its time derivative
  MotionSample sample() const;
  void advance() { phasors_.advance(); }

 private:
  UniformPhasors make(const WaveField& sea, const std::function<ResponseChannels(const ShipWave&)>& response,
                      double speed, double x, double y, double start, double step);

  struct Parts {
    std::vector<double> real, imaginary;
  };
  std::vector<double> omega_;
  std::array<Parts, kResponseChannels> parts_;
  std::array<bool, kResponseChannels> moves_{};  // channels that are not zero
  UniformPhasors phasors_;
};

}  // namespace seaglint
