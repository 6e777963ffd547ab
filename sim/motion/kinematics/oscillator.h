// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One degree of freedom: x'' + 2 z w0 x' + b |x'| x' + w0^2 x = f(t), f an acceleration.

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct Oscillator {
  double omega0 = 0;     // natural angular frequency, rad/s; 0 = free, no spring
  double damping = 0;    // z, ratio to critical
  double quadratic = 0;  // b, 1/rad (1/m for a translation)
};

struct OscillatorState {
  double x = 0;
  double rate = 0;
};

// Steady response to f = Re{e^{j w t}} of the oscillator without its quadratic damping, per unit of f; w > 0.
Complex linear_response(const Oscillator& oscillator, double omega);

// One step of the classical Runge-Kutta method of fourth order; f at the step's begin, middle and end.
OscillatorState advance(const Oscillator& oscillator, OscillatorState state, double f0, double f_middle, double f1,
                        double step);

// Steps of h with omega0 h up to this are taken whole (an error of 2e-6 per step), longer ones are divided.
inline constexpr double kLongestTurn = 0.2;

}  // namespace seaglint
