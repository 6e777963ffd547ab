// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/float/random_yaw.h"

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/unit_phasors.h"

namespace seaglint {

// The rate's spectrum 1 / (1 + (w tau)^2) has the distribution (2/pi) atan(w tau): harmonic m is drawn from the m-th of
// the intervals of equal probability.
RandomYaw::RandomYaw(double rate, double period, double damping, std::uint64_t seed, std::uint64_t index) {
  if (rate <= 0) return;
  Random random({seed, Stream::kFloatYaw, index});
  if (period <= 0) heading_ = 2 * kPi * (random.uniform() - 0.5);
  double variance = 0;
  for (int m = 0; m < kYawHarmonics; ++m) {
    const double omega = std::tan(0.5 * kPi * (m + random.uniform()) / kYawHarmonics) / kYawCorrelationTime;
    double amplitude = 1;
    if (period > 0) {
      const Oscillator spring{2 * kPi / period, damping, 0};
      amplitude = omega * omega * std::abs(linear_response(spring, omega));
    }
    omega_.push_back(omega);
    phase_.push_back(2 * kPi * random.uniform());
    amplitude_.push_back(amplitude);
    variance += 0.5 * amplitude * amplitude;
  }
  for (double& amplitude : amplitude_) amplitude *= rate / std::sqrt(variance);
  if (period <= 0) heading_ -= at(0).x - heading_;
}

OscillatorState RandomYaw::at(double t) const {
  std::array<double, kYawHarmonics> angle, cosine, sine;
  const std::size_t count = omega_.size();
  for (std::size_t m = 0; m < count; ++m) angle[m] = omega_[m] * t + phase_[m];
  unit_phasors({angle.data(), count}, {cosine.data(), count}, {sine.data(), count});
  OscillatorState yaw{heading_, 0};
  for (std::size_t m = 0; m < count; ++m) {
    yaw.x += amplitude_[m] * sine[m] / omega_[m];
    yaw.rate += amplitude_[m] * cosine[m];
  }
  return yaw;
}

}  // namespace seaglint
