// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Oscillator of one degree of freedom: x'' + 2 z w0 x' + b |x'| x' + w0^2 x = f(t), f an acceleration.

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct Oscillator {
  double omega0 = 0;     // natural angular frequency, rad/s; 0 = no restoring force
  double damping = 0;    // z, ratio to critical
  double quadratic = 0;  // b, 1/rad (1/m for a translation)
};

struct OscillatorState {
  double x = 0;
  double rate = 0;
};

// Steady response to f = Re{e^{j w t}} per unit of f, without the quadratic damping; w > 0.
Complex linear_response(const Oscillator& oscillator, double omega);

// One step of the classical Runge-Kutta method of fourth order; f at the start, middle and end of the step.
OscillatorState advance(const Oscillator& oscillator, OscillatorState state, double f0, double f_middle, double f1,
                        double step);

// Largest omega0 h of one step h (error 2e-6 per step); longer steps are subdivided.
inline constexpr double kLongestTurn = 0.2;

}  // namespace seaglint
