// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/kinematics/oscillator.h"

#include <cmath>

namespace seaglint {

Complex linear_response(const Oscillator& oscillator, double omega) {
  const double w0 = oscillator.omega0;
  return 1.0 / Complex(w0 * w0 - omega * omega, 2 * oscillator.damping * w0 * omega);
}

OscillatorState advance(const Oscillator& oscillator, OscillatorState state, double f0, double f_middle, double f1,
                        double step) {
  const auto derivative = [&](const OscillatorState& s, double f) {
    const double w0 = oscillator.omega0;
    return OscillatorState{s.rate, f - 2 * oscillator.damping * w0 * s.rate -
                                       oscillator.quadratic * std::abs(s.rate) * s.rate - w0 * w0 * s.x};
  };
  const auto moved = [&state](const OscillatorState& d, double h) {
    return OscillatorState{state.x + h * d.x, state.rate + h * d.rate};
  };
  const OscillatorState k1 = derivative(state, f0);
  const OscillatorState k2 = derivative(moved(k1, 0.5 * step), f_middle);
  const OscillatorState k3 = derivative(moved(k2, 0.5 * step), f_middle);
  const OscillatorState k4 = derivative(moved(k3, step), f1);
  return {state.x + step / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x),
          state.rate + step / 6 * (k1.rate + 2 * k2.rate + 2 * k3.rate + k4.rate)};
}

}  // namespace seaglint
