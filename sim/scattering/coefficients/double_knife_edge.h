// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Amplitude of double knife-edge diffraction along an interval of an edge: the effective width of a beam between two
// edges near each other along the transmit or the receive path, times k. Derivation: radiation/beam_boundary.h.

#include <array>
#include <limits>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct DoubleKnifeEdge {
  // of the path over both edges, at the ends of the interval, m: the distance between the edges along the beam, and the
  // excess of the path over both edges above that over the second edge alone
  std::array<double, 2> separation{}, excess_path{};
  double psi_slope = 0;  // of psi across the edges, towards the shadow
  // excess of the path over both edges above the exit path over the first edge alone, m; negative where the second edge
  // obstructs that path
  std::array<double, 2> exit_excess{};
  bool second_in_shadow = false;                 // of the first edge
  double off_axis_weight = 0, axial_weight = 1;  // weights of the forms for slope != 0 and for slope = 0

  // k times the effective width, dimensionless, at a fraction 0..1 of the interval. `run`: phase change over the
  // interval, rad, which displaces an end point; infinite: none.
  Complex at(double k, double fraction, double run = std::numeric_limits<double>::infinity()) const;

  // True where the phase changes by ten cycles or more over an interval: end-point terms then have an error of the
  // change of the width within one cycle.
  static bool endpoints_suffice(double phase);

  // Mean of at(k, x) e^{j phase (y - 1/2)} over a part of the interval, x its fractions `from` to `to` and y those of
  // the part. Gauss-Legendre quadrature with four points per three radians, since the width varies as the square root
  // of the distance between edges that meet.
  Complex mean(double k, double phase, double from, double to) const;

  // Upper bound of |at| for all k >= lowest.
  double upper_bound(double lowest) const;

 private:
  Complex off_axis_width(double k, double fraction) const;
  // Taper of the forward form: 1 in the forward direction, 0 where k d slope^2 / 2 >= 1 rad, from where on the
  // end-point contributions are moved instead.
  double axial_taper(double k, double distance_m) const;
};

}  // namespace seaglint
