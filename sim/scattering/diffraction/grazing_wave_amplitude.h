// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Amplitude of multiple diffraction along an interval of the last edge: 1 / sqrt(k l) of a face-grazing diffracted wave
// of length l, times transition functions near the shadow boundaries of the edge that launches it and of the one that
// diffracts it last.

#include <array>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct GrazingWaveAmplitude {
  std::array<double, 2> l{};  // length of the last grazing wave at the ends of the interval, m; linear in between
  double launch_parameter = 0, exit_parameter = 0;  // transition_parameter() at the first and at the last edge
  double first_length_m = 0;  // mean length of the first grazing wave, used when there are several
  int grazing_waves = 1;      // successive waves along the face

  // Amplitude at a fraction 0..1 of the interval, in m^(-1/2) k^(-grazing_waves / 2): times length / (j run) it is the
  // end-point term of the integral of e^{jk psi} along the interval, run (rad, not zero) being the change of k psi.
  Complex at(double k, double fraction, double run) const;
};

}  // namespace seaglint
