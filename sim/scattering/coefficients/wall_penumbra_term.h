// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Correction to physical optics, per metre, for a wall in the penumbra of the edge of a face at near-grazing incidence
// (wall_penumbra.h), along an interval of the wall's foot.

#include <array>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Sum of three contributions with s the sine of the wave's angle over the face, l the distance on the face from edge to
// wall and x = k l s^2: at the foot of the wall, -1 / (2jks); at the edge's shadow-boundary line on the wall (s < 0) or
// on its image, e^{-2jx} / (2jks); and of the path edge - wall - edge, (l / pi k)^(1/2) e^{-j pi/4} e^{-jx} [F(x) /
// (2jx) -+ (1 - F(x))] (soft, hard); each times -jk / 2 pi.
struct WallPenumbraTerm {
  std::array<double, 2> l{};  // distance from edge to wall at both ends of the interval, m; linear in between
  double sine = 0;            // s, -1 < s < 1
  // weights of the three contributions
  double foot_weight = 0, shadow_line_weight = 1, edge_path_weight = 1;
  bool soft = false;         // true: electric field parallel to the face; false: magnetic field parallel to it
  double psi_decrement = 0;  // decrease of psi relative to that of the foot, per metre of l
  // Part of a first-order expansion in s. Near grazing the contributions diverge as 1 / s and cancel, so their sum is
  // one amplitude with its derivative. The derivative is represented by a second contribution whose path gradient has
  // an additional component g (derivative_scale_m) along the face normal: its phase gives (e^{jk g ds} - 1) / (jk g)
  // for a change ds of s. kComplete: no expansion; kValue: the sum less the derivative's amplitude; kDerivative: the
  // derivative's amplitude.
  enum class Part { kComplete, kValue, kDerivative } part = Part::kComplete;
  double derivative_scale_m = 0;  // g, m

  // Amplitude at the fraction `fraction` of the interval: times length / (j run) it is the end-point contribution there
  // to the integral of e^{jk psi} over the interval, run (rad, not zero) being the change of k psi over it. k:
  // wavenumber, rad/m.
  Complex at(double k, double fraction, double run) const;

  // Largest difference between the psi of one of the contributions and that of the phase, m: at() oscillates with k
  // over it.
  double psi_spread() const;

 private:
  Complex at_sine(double s, double k, double fraction, double run) const;
};

}  // namespace seaglint
