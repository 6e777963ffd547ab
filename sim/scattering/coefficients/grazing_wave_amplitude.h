// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Amplitude of multiple diffraction along an interval of the last edge: 1 / sqrt(k l) of a face-grazing diffracted wave
// of length l, times transition functions near the shadow boundaries of the edge that launches it and of the one that
// diffracts it last. Near its edge a wave is thus limited to the field there, sqrt(2 pi d) times its coefficient, d its
// transition_parameter(), at most that of the incident wave.

#include <array>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Successive grazing waves: on a face with two edges the third edge is the first one again, and the fourth the second;
// near grazing all orders are equally large.
inline constexpr int kMaxGrazingWaves = 3;

struct GrazingWaveAmplitude {
  std::array<double, 2> l{};  // length of the last grazing wave at the ends of the interval, m; linear in between
  // transition_parameter() where the last wave starts, and at the last edge
  double launch_parameter = 0, exit_parameter = 0;
  // of the waves before, mean length times twice that parameter, m: argument of their transition functions over k
  std::array<double, kMaxGrazingWaves - 1> detour_m{};
  int grazing_waves = 1;  // successive waves along the face

  // Amplitude at a fraction 0..1 of the interval, in m^(-1/2) k^(-grazing_waves / 2): times length / (j run) it is the
  // end-point term of the integral of e^{jk psi} along the interval, run (rad, not zero) being the change of k psi.
  Complex at(double k, double fraction, double run) const;
};

}  // namespace seaglint
