// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion in time as the sum of a body's responses to every wave of a sea.

#include <array>
#include <functional>
#include <vector>

#include "sim/core/numbers/unit_phasors.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/strip_theory/strip_theory.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Roll, pitch, yaw (rad/m), surge, sway, heave (m/m) and one more that the caller chooses, per metre of a wave.
enum ResponseChannel { kRollAngle, kPitchAngle, kYawAngle, kSurgeShift, kSwayShift, kHeaveShift, kExtra };
inline constexpr std::size_t kResponseChannels = 7;
using ResponseChannels = std::array<Complex, kResponseChannels>;

// w_e = w - U k cos(mu): how often a ship of speed U (m/s) meets a wave; negative when it overtakes it.
double encounter_frequency(const ShipWave& wave, double speed);

// At t = start + n step, of a body that starts at (x, y) at t = 0 and goes on along x with `speed`. Waves with less
// than 1e-9 of the largest contribution to each channel are left out.
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
